//! Turn-ups: strips sewn to the hem of a leg or a sleeve and folded up there, on to its outside.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use crate::draft::garment::Garment;
use crate::draft::path::Path;
use crate::geometry::ids::PieceId;
use crate::pattern::{Fold, Piece, SpacePose, curve};

/// Angle by which a turn-up is folded, radians.
const TURNED: f64 = 170.0 * PI / 180.0;
/// Angle by which it is folded as placed, radians: flat along the cloth under it, so that its corners get past those of the hem on the
/// outside while the sides are sewn. Placed at 150 or 170 degrees some were caught inside the leg.
const PLACED: f64 = 177.0 * PI / 180.0;
/// Distance of a turn-up from the hem as placed, along the cloth and outwards, metres: it stays with the hem from the first.
const GAP: f64 = 0.003;
/// Length by which the free edge of a half is longer, at either end, than the cloth under it, metres: it lies outside of that.
const EASE: f64 = 0.008;
/// Distance from the hem beyond which the lean of the edges that it ends at is taken, metres.
const NEAR: f64 = 0.01;
/// Label of the edge of a turn-up at which it is folded.
const SEAM: &str = "turn-up seam";

/// Drafts a turn-up of this `height` (m) for both `halves` of a tube. They are placed flat, before and behind a limb, and have a straight
/// edge called `hem`. Each half of the turn-up is placed outside of its hem, folded up, and sewn to it; then their edges called as one of
/// `sides`, like the edges that the hem ends at, are sewn.
pub fn turn_up(garment: &mut Garment, height: f64, halves: [PieceId; 2], hem: &str, sides: [&str; 2]) {
    let ends = halves.map(|half| HemEnd::of(garment, half, hem, height));
    let [Some(front), Some(back)] = &ends else { return };
    // Trued: edges that are sewn to each other are as long as both on average.
    let trued = |label: &str| {
        let both = [front, back].map(|end| end.side_length(label).unwrap_or(height));
        f64::midpoint(both[0], both[1])
    };
    let [front, back] = [front, back].map(|end| end.add_strip(garment, hem, trued));
    garment.sew_alike(&[front.0], &[back.0], &sides, front.1);
}

/// The end of half of a tube at its hem, and what the turn-up there is like, in the half's own plane.
struct HemEnd {
    half: PieceId,
    piece: Arc<Piece>,
    pose: SpacePose,
    /// Ends of the hem, in the direction of the outline, metres.
    ends: [DVec2; 2],
    /// Unit direction from the first to the second.
    along: DVec2,
    /// Unit direction in which the cloth would go on.
    on: DVec2,
    /// 1 where the outer side of the piece faces +z of its plane, else -1.
    outer: f64,
    /// Labels of the edges that the hem ends at.
    sides: [String; 2],
    /// How far beside each end of the hem, along it, the free edge ends, metres.
    aside: [f64; 2],
    /// Height of the turn-up, metres.
    height: f64,
}

impl HemEnd {
    /// None where the half has no such hem, or is not placed.
    fn of(garment: &Garment, half: PieceId, hem: &str, height: f64) -> Option<Self> {
        let piece = garment.pattern.pieces.get(&half).map(Arc::clone)?;
        let edge = piece.outline.iter().position(|edge| edge.label.as_deref() == Some(hem))?;
        let pose = piece.placement?;
        let (a, b) = piece.edge_ends(edge);
        let along = (b - a).normalize_or(DVec2::X);
        let outer = if piece.signed_area() < 0.0 { -1.0 } else { 1.0 };
        let on = along.perp() * -outer;
        let sides = [(edge + piece.outline.len() - 1) % piece.outline.len(), piece.next_edge(edge)];
        let lean = |k: usize| lean(&piece, sides[k], [a, b][k], [along, on]) * height;
        let aside = [lean(0) - EASE, lean(1) + EASE];
        let sides = sides.map(|side| piece.outline[side].label.clone().unwrap_or_default());
        Some(Self { half, pose, ends: [a, b], along, on, outer, sides, aside, height, piece })
    }

    /// Length of the turn-up's edge with this label, metres, at its height.
    fn side_length(&self, label: &str) -> Option<f64> {
        let k = self.sides.iter().position(|side| side == label)?;
        Some(self.height.hypot(self.aside[k]))
    }

    /// Adds the turn-up, places it and sews it to its hem; `trued` tells the length of the edges with a label, metres. Returns it, and
    /// the direction in which the half ends, as placed.
    fn add_strip(&self, garment: &mut Garment, hem: &str, trued: impl Fn(&str) -> f64) -> (PieceId, DVec3) {
        let strip = Piece { placement: Some(self.folded_up()), ..self.strip(trued) };
        let strip = garment.pattern.add_piece(strip);
        let [along, on] = [self.along, self.on].map(|way| self.pose.rotation * way.extend(0.0));
        let runs =
            [(self.half, hem), (strip, SEAM)].map(|(piece, label)| garment.run(&[piece], label, along));
        garment.sew(&runs[0], &runs[1]);
        (strip, on)
    }

    /// The turn-up, with the hem's first end at its origin: the mirror image, at the hem, of the cloth under it.
    fn strip(&self, trued: impl Fn(&str) -> f64) -> Piece {
        let [first, second] = [0, 1].map(|k| {
            let (long, aside) = (trued(&self.sides[k]), self.aside[k]);
            self.on * (long * long - aside * aside).max(0.0).sqrt() + self.along * aside
        });
        let across = self.ends[1] - self.ends[0];
        let path = Path::from(across)
            .line(SEAM, DVec2::ZERO)
            .line(&self.sides[0], first)
            .line("turn-up edge", across + second);
        let mut strip = path.closed(&format!("{} turn-up", self.piece.name), &self.sides[1]);
        strip.outline[0].trims.fold = Some(Fold::pressed(TURNED));
        Piece { label: self.piece.label.clone(), layer: self.piece.layer, ..strip }
    }

    /// The placement of the turn-up, folded up on the outside of the half.
    fn folded_up(&self) -> SpacePose {
        let pose = self.pose;
        let (on, out) = (self.on.extend(0.0), DVec3::Z * self.outer);
        let at = pose.at(self.ends[0]) + pose.rotation * ((on + out) * GAP);
        SpacePose::flat(at, pose.rotation * DQuat::from_axis_angle(on.cross(out), PLACED))
    }
}

/// Lean of the edge `side` where it ends at the point `end` of the hem: length along the hem per length away from it. `along` is the
/// unit vector along the hem, `on` the one in which the cloth would go on.
fn lean(piece: &Piece, side: usize, end: DVec2, [along, on]: [DVec2; 2]) -> f64 {
    let ((from, to), mut line) = (piece.edge_ends(side), Vec::new());
    curve::flatten(from, piece.outline[side].shape, to, 1e-4, &mut line);
    line.push(to);
    let away = line.into_iter().map(|p| p - end).filter(|way| -way.dot(on) > NEAR);
    let way = away.min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    way.map_or(0.0, |way| way.dot(along) / -way.dot(on))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Measurements, NamedPose};
    use crate::draft::{Bottom, Design, Form, Kind, Top};
    use crate::geometry::random::Random;
    use crate::pattern::sampling::sampling;
    use crate::pattern::{CutPattern, Pattern};

    const HEIGHT: f64 = 0.04;

    /// The first garment of this kind, with turn-ups, for the mannequin with its arms as in `pose`.
    fn turned_up(kind: Kind, pose: NamedPose) -> Pattern {
        let form = Form::new(&Measurements::default(), pose).expect("a form");
        let mut design = Design::of_kind(kind, &mut Random::stream(3, 0));
        if let Some(Top::Cut(upper)) = &mut design.top {
            let sleeve = upper.sleeve.as_mut().expect("sleeves");
            (sleeve.cuff, sleeve.turn_up) = (None, Some(HEIGHT));
        }
        if let Some(Bottom::Trousers(cut)) = &mut design.bottom {
            cut.turn_up = Some(HEIGHT);
        }
        design.drafted(&form)
    }

    /// Each turn-up of `pattern`, and the piece that it is sewn to.
    fn turn_ups(pattern: &Pattern) -> Vec<(PieceId, PieceId)> {
        let own = |id: PieceId| pattern.pieces[&id].name.ends_with(" turn-up");
        let seams = pattern.seams.values().map(|seam| seam.sides.map(|side| side.piece));
        seams.filter(|[half, strip]| !own(*half) && own(*strip)).map(|[half, strip]| (strip, half)).collect()
    }

    fn check(kind: Kind, pose: NamedPose) {
        let pattern = turned_up(kind, pose);
        assert!(pattern.turns_over_at_a_seam());
        let pairs = turn_ups(&pattern);
        assert_eq!(pairs.len(), 4, "{kind:?}");
        let (cut, mut problems) = CutPattern::new(&pattern);
        sampling(&cut, 0.02, &mut problems);
        let unequal = problems.iter().filter(|problem| problem.place.to_string().contains("turn-up"));
        assert_eq!(unequal.count(), 0, "{kind:?}: {problems:?}");
        for (strip, half) in pairs {
            let (strip, half) = (&pattern.pieces[&strip], &pattern.pieces[&half]);
            let (own, under) = (strip.placement.expect("placed"), half.placement.expect("placed"));
            assert!(own.is_sound());
            let out = under.rotation * DVec3::Z * half.signed_area().signum();
            assert!((own.rotation * DVec3::Z * strip.signed_area().signum()).dot(out) < -0.99);
            let beyond = |p: DVec2| (own.at(p) - under.translation).dot(out);
            let from = |p: DVec2, k: usize| own.at(p).distance(own.at(strip.outline[k].start));
            let [seam, free] = [0, 2].map(|k| strip.outline[k].start);
            assert!(beyond(seam) > 0.002 && beyond(free) > 0.002, "{} is not outside", strip.name);
            assert!((HEIGHT..1.3 * HEIGHT).contains(&from(free, 1)), "{}: {}", strip.name, from(free, 1));
            let hem = half.outline.iter().position(|edge| {
                edge.label.as_deref().is_some_and(|label| label == "hem" || label == "sleeve hem")
            });
            let hem = hem.expect("a hem");
            assert!((strip.exact_edge_length(0) - half.exact_edge_length(hem)).abs() < 1e-9);
            // It goes back along the half, not on beyond its hem.
            let (a, b) = half.edge_ends(hem);
            let on = under.rotation * ((b - a).perp() * -half.signed_area().signum()).normalize().extend(0.0);
            let back = (own.at(free) - own.at(strip.outline[1].start)).dot(on);
            // Sides that are sewn to each other are trued, which moves a corner by a few millimetres.
            assert!((back + HEIGHT).abs() < 0.1 * HEIGHT, "{}: {back}", strip.name);
        }
    }

    #[test]
    fn turn_ups_are_placed_outside_of_legs_folded_up() {
        check(Kind::Shorts, NamedPose::A);
        check(Kind::Trousers, NamedPose::A);
    }

    #[test]
    fn turn_ups_are_placed_outside_of_sleeves_folded_up() {
        check(Kind::Raglan, NamedPose::A);
        check(Kind::Shirt, NamedPose::T);
    }
}
