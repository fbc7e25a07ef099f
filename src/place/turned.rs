//! Parts of pieces that are placed folded over: what lies beyond a fold line that turns over, as the fall of a collar or the turn-up of
//! a leg in one piece. Sewn flat they would stand, and a ring of cloth does not turn over any more.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::geometry::ids::PieceId;
use crate::geometry::polygon;
use crate::pattern::fineness::CHORDS;
use crate::pattern::{Fold, InternalLine, Pattern, Piece, SpacePose, Stretch, curve};
use crate::wrap::{AT_AN_EDGE, EDGE_SAMPLES};

/// Largest distance of a fold line from the straight line through its ends, as a share of its length. Chosen by trial: a fold that
/// is bowed more does not turn over flat.
const BOWED: f64 = 0.1;
/// Share of a seam's side that may lie on the other side of the end of a fold, as drawn by hand. Chosen by trial.
const LOOSE: f64 = 0.02;
/// Largest angle by which cloth is placed folded, radians: its layers must not lie in each other.
const PLACED: f64 = 170.0 * std::f64::consts::PI / 180.0;

/// The parts of a pattern's pieces that are placed folded over.
#[derive(Clone, Debug, Default)]
pub struct Turned(BTreeMap<PieceId, Vec<Part>>);

/// The part of a piece beyond a fold.
#[derive(Clone, Debug)]
struct Part {
    /// An end of the fold, and the unit vector along it; the part lies on its left, metres.
    from: DVec2,
    along: DVec2,
    /// Angle out of the plane of the piece, radians, positive towards its +z.
    angle: f64,
    /// Its stretch of the outline as numbers of edges and shares of them; the second is the larger, by up to the number of edges.
    run: [f64; 2],
    /// The number of edges of that outline.
    around: f64,
    /// Its border as a polygon, metres.
    border: Vec<DVec2>,
    /// Number of the internal line that is the fold.
    line: usize,
}

/// How a side of a seam lies to a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lies {
    Apart,
    Across,
    Within,
}

impl Turned {
    /// The parts of `pattern` that turn over: those beyond a nearly straight fold line from border to border, that are sewn only to each
    /// other. Where both parts of a piece could turn over, it is the smaller.
    pub fn new(pattern: &Pattern) -> Self {
        let of_piece = |(id, piece): (&PieceId, &Arc<Piece>)| {
            let pairs = (0..piece.lines.len()).filter_map(|line| parts(piece, line));
            (*id, pairs.flatten().collect::<Vec<Part>>())
        };
        let mut all =
            Self(pattern.pieces.iter().map(of_piece).filter(|(_, parts)| !parts.is_empty()).collect());
        while all.drop_sewn(pattern) {}
        for parts in all.0.values_mut() {
            parts.sort_by(|a, b| a.area().total_cmp(&b.area()));
            for part in std::mem::take(parts) {
                if parts.iter().all(|smaller| part.is_beside(smaller)) {
                    parts.push(part);
                }
            }
        }
        all
    }

    /// Whether nothing turns over.
    pub fn is_empty(&self) -> bool {
        self.0.values().all(Vec::is_empty)
    }

    /// The position in space of the point `p` (metres, in the own plane) of a piece with this `pose`.
    pub fn at(&self, piece: PieceId, pose: &SpacePose, p: DVec2) -> DVec3 {
        let parts = self.0.get(&piece).into_iter().flatten();
        let Some((part, beyond)) = parts.filter_map(|part| Some((part, part.beyond(p)?))).next() else {
            return pose.at(p);
        };
        let (sin, cos) = part.angle.sin_cos();
        let under = p + part.along.perp() * (beyond * (cos - 1.0));
        let [x, y] = pose.axes_at(under);
        pose.at(under) + x.cross(y) * (beyond * sin)
    }

    /// Drops parts that are sewn to what does not turn over with them; returns whether there were any.
    fn drop_sewn(&mut self, pattern: &Pattern) -> bool {
        let before = self.0.clone();
        let how = |part: &Part, side: &Stretch| {
            pattern.pieces.get(&side.piece).map_or(Lies::Apart, |piece| part.holds(piece, side))
        };
        let goes_with = |part: &Part, own: Stretch, other: Stretch| {
            let lies = how(part, &own);
            let others = before.get(&other.piece).into_iter().flatten();
            lies == Lies::Apart || others.into_iter().any(|part| how(part, &other) == lies)
        };
        let mut has_dropped = false;
        for (id, parts) in &mut self.0 {
            parts.retain(|part| {
                let sides =
                    pattern.seams.values().flat_map(|seam| [seam.sides, [seam.sides[1], seam.sides[0]]]);
                let stays =
                    sides.filter(|[own, _]| own.piece == *id).all(|[own, other]| goes_with(part, own, other));
                has_dropped |= !stays;
                stays
            });
        }
        has_dropped
    }
}

impl Part {
    /// Distance of `p` from the fold, metres; None where `p` is not beyond it.
    fn beyond(&self, p: DVec2) -> Option<f64> {
        let beyond = self.along.perp_dot(p - self.from);
        let is_in = || {
            let near = polygon::sides(&self.border).map(|[a, b]| polygon::distance_to_segment(p, a, b));
            polygon::contains(&self.border, p) || near.fold(f64::INFINITY, f64::min) < CHORDS
        };
        (beyond > 0.0 && is_in()).then_some(beyond)
    }

    fn area(&self) -> f64 {
        polygon::signed_area(&self.border).abs()
    }

    /// Whether this part lies beyond another fold than `other`, and shares nothing of the outline with it.
    fn is_beside(&self, other: &Self) -> bool {
        self.line != other.line && self.shared(other.run) == 0.0
    }

    /// How much of a run along the outline is this part's, in edges.
    fn shared(&self, [from, to]: [f64; 2]) -> f64 {
        let [start, end] = self.run;
        let turned = |turns: f64| {
            let by = turns * self.around;
            (end.min(to + by) - start.max(from + by)).max(0.0)
        };
        [-1.0, 0.0, 1.0].map(turned).iter().sum()
    }

    /// How a side of a seam on `piece` lies to this part.
    fn holds(&self, piece: &Piece, side: &Stretch) -> Lies {
        let parts = side.parts(piece).unwrap_or_default();
        let (mut all, mut inside) = (0.0, 0.0);
        for (edge, from, to) in parts.into_iter().filter(|(edge, ..)| *edge < piece.outline.len()) {
            let length = piece.edge_length(edge);
            all += (to - from) * length;
            inside += self.shared([from, to].map(|share| edge as f64 + share)) * length;
        }
        if inside <= LOOSE * all {
            Lies::Apart
        } else if inside >= (1.0 - LOOSE) * all {
            Lies::Within
        } else {
            Lies::Across
        }
    }
}

/// Both parts of `piece` beside one of its lines, where that is a fold that turns over from border to border.
fn parts(piece: &Piece, line: usize) -> Option<[Part; 2]> {
    let InternalLine { edges, end, .. } = &piece.lines[line];
    let angles: Vec<f64> = edges
        .iter()
        .filter_map(|edge| edge.trims.fold)
        .filter(Fold::turns_over)
        .map(|fold| fold.angle)
        .collect();
    let is_outwards = angles.first().is_some_and(|angle| *angle > 0.0);
    if angles.len() != edges.len() || angles.iter().any(|angle| (*angle > 0.0) != is_outwards) {
        return None;
    }
    let smallest = angles.iter().map(|angle| angle.abs()).fold(PLACED, f64::min);
    // The front of a piece is the side from which its outline runs counter-clockwise.
    let angle = smallest * if is_outwards == (piece.signed_area() > 0.0) { 1.0 } else { -1.0 };
    let fold = piece.lines[line].flattened(CHORDS);
    let (from, to) = (edges.first()?.start, *end);
    let along = (to - from).try_normalize()?;
    let bow = fold.iter().map(|p| along.perp_dot(*p - from).abs()).fold(0.0, f64::max);
    if bow > BOWED * from.distance(to) {
        return None;
    }
    let [start, stop] = [place_on(piece, from)?, place_on(piece, to)?];
    let around = piece.outline.len() as f64;
    let part = |[first, last]: [f64; 2], fold: &mut dyn Iterator<Item = DVec2>| {
        let run = [first, if last > first { last } else { last + around }];
        let mut border: Vec<DVec2> = fold.collect();
        stretch(piece, run, &mut border);
        let middle = border.iter().map(|p| along.perp_dot(*p - from)).sum::<f64>();
        let (from, along) = if middle > 0.0 { (from, along) } else { (to, -along) };
        Part { from, along, angle, run, around, border, line }
    };
    Some([
        part([stop, start], &mut fold.iter().copied()),
        part([start, stop], &mut fold.iter().rev().copied()),
    ])
}

/// The place on the outline of `piece` nearest to `p`, as a number of edges and a share of one; None where it is not at `p`.
fn place_on(piece: &Piece, p: DVec2) -> Option<f64> {
    let near = (0..piece.outline.len()).map(|i| (i, curve::nearest(&piece.edge_segments(i), p)));
    let (edge, (share, distance)) = near.min_by(|a, b| a.1.1.total_cmp(&b.1.1))?;
    (distance <= AT_AN_EDGE).then_some(edge as f64 + share)
}

/// Adds points along the outline of `piece`, from the first place to the second.
fn stretch(piece: &Piece, [from, to]: [f64; 2], border: &mut Vec<DVec2>) {
    let count = piece.outline.len();
    for edge in from as usize..=to as usize {
        let own = [from, to].map(|t| (t - edge as f64).clamp(0.0, 1.0));
        let share = |k| own[0] + (own[1] - own[0]) * f64::from(k) / f64::from(EDGE_SAMPLES);
        let shares: Vec<f64> = (0..=EDGE_SAMPLES).map(share).collect();
        border.extend(piece.edge_points(edge % count, &shares));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{Edge, EdgeRef, Seam, Trims};
    use glam::DQuat;

    /// A strip 0.4 m wide and 0.1 m high with a fold at `height`.
    fn folded(height: f64, angle: f64) -> Piece {
        let points = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.1), (0.0, 0.1)].map(|(x, y)| DVec2::new(x, y));
        let trims = Trims::from(Fold::pressed(angle));
        let edge = Edge { start: DVec2::new(0.0, height), trims, ..Edge::default() };
        let line =
            InternalLine { edges: vec![edge], end: DVec2::new(0.4, height), ..InternalLine::default() };
        Piece { lines: vec![line], ..Piece::polygon("strip", &points) }
    }

    fn pose() -> SpacePose {
        SpacePose::flat(DVec3::new(0.1, 1.0, 0.2), DQuat::from_rotation_y(0.5))
    }

    /// The pattern of these pieces, sewn at these edges.
    fn sewn(pieces: Vec<Piece>, seams: &[[usize; 4]]) -> (Pattern, Vec<PieceId>) {
        let mut pattern = Pattern::default();
        let ids: Vec<PieceId> = pieces.into_iter().map(|piece| pattern.add_piece(piece)).collect();
        for &[one, a, other, b] in seams {
            let sides = [(one, a), (other, b)].map(|(piece, edge)| EdgeRef { piece: ids[piece], edge });
            pattern.add_seam(Seam::of_edges(sides, false));
        }
        (pattern, ids)
    }

    #[test]
    fn the_smaller_part_of_a_strip_is_folded_on_to_its_front() {
        let (pattern, ids) = sewn(vec![folded(0.07, 2.9)], &[]);
        let turned = Turned::new(&pattern);
        let at = |x: f64, y: f64| {
            pose().rotation.inverse() * (turned.at(ids[0], &pose(), DVec2::new(x, y)) - pose().translation)
        };
        assert!(at(0.1, 0.05).distance(DVec3::new(0.1, 0.05, 0.0)) < 1e-12);
        let expected = DVec3::new(0.1, 0.07 + 0.03 * 2.9f64.cos(), 0.03 * 2.9f64.sin());
        assert!(at(0.1, 0.1).distance(expected) < 1e-12, "{}", at(0.1, 0.1));
        // A fold of 180 degrees leaves room between the layers.
        let (pattern, ids) = sewn(vec![folded(0.03, -std::f64::consts::PI)], &[]);
        let under = Turned::new(&pattern).at(ids[0], &pose(), DVec2::new(0.1, 0.0));
        let under = pose().rotation.inverse() * (under - pose().translation);
        let expected = DVec3::new(0.1, 0.03 - 0.03 * PLACED.cos(), -0.03 * PLACED.sin());
        assert!(under.distance(expected) < 1e-12, "{under}");
    }

    #[test]
    fn the_front_of_a_piece_drawn_from_its_back_is_on_the_other_side() {
        let mut piece = folded(0.07, 2.9);
        piece.outline = curve::reversed(&piece.outline);
        let (pattern, ids) = sewn(vec![piece], &[]);
        let at = Turned::new(&pattern).at(ids[0], &pose(), DVec2::new(0.1, 0.1));
        assert!((pose().rotation.inverse() * (at - pose().translation)).z < -0.005);
    }

    #[test]
    fn folded_cloth_is_as_large_as_flat_cloth_round_a_tube_too() {
        let (pattern, ids) = sewn(vec![folded(0.07, 2.9)], &[]);
        let turned = Turned::new(&pattern);
        let roll = crate::pattern::Roll { centre: DVec2::new(0.2, 0.05), along: DVec2::Y, radius: 0.08 };
        let pose = SpacePose { roll: Some(roll), ..pose() };
        let at = |x: f64, y: f64| turned.at(ids[0], &pose, DVec2::new(x, y));
        for x in [0.05, 0.2, 0.33] {
            assert!((at(x, 0.07).distance(at(x, 0.1)) - 0.03).abs() < 1e-9);
            let round = at(x, 0.1).distance(at(x + 0.001, 0.1)) / 0.001;
            let grown = 1.0 + 0.03 * 2.9f64.sin() / 0.08;
            assert!((round - grown).abs() < 1e-3, "{round}, not {grown}");
        }
    }

    #[test]
    fn what_is_sewn_beyond_the_fold_is_not_turned_over() {
        let panel = Piece { lines: Vec::new(), ..folded(0.05, 2.9) };
        // The upper edge of the strip is sewn to a panel, so that the lower part turns.
        let (pattern, ids) = sewn(vec![folded(0.03, 2.9), panel.clone()], &[[0, 2, 1, 0]]);
        let turned = Turned::new(&pattern);
        let moves = |y: f64| {
            turned.at(ids[0], &pose(), DVec2::new(0.1, y)).distance(pose().at(DVec2::new(0.1, y))) > 0.01
        };
        assert!(moves(0.0) && !moves(0.1));
        let both = [[0, 2, 1, 0], [0, 0, 1, 2]];
        assert!(Turned::new(&sewn(vec![folded(0.03, 2.9), panel.clone()], &both).0).is_empty());
        let at_the_side = [[0, 2, 1, 0], [0, 1, 1, 3]];
        assert!(Turned::new(&sewn(vec![folded(0.03, 2.9), panel], &at_the_side).0).is_empty());
        // Sides that turn over with each other do not matter.
        let ring = [[0, 1, 1, 3], [0, 3, 1, 1]];
        let turned = Turned::new(&sewn(vec![folded(0.03, 2.9), folded(0.03, 2.9)], &ring).0);
        assert_eq!(turned.0.values().map(Vec::len).collect::<Vec<_>>(), [1, 1]);
    }

    #[test]
    fn lines_that_do_not_fold_over_from_border_to_border_turn_nothing() {
        let none = |piece: Piece| Turned::new(&sewn(vec![piece], &[]).0).is_empty();
        assert!(none(folded(0.07, 1.0)) && !none(folded(0.07, 2.9)));
        let mut short = folded(0.07, 2.9);
        short.lines[0].end.x = 0.3;
        assert!(none(short));
        let mut bowed = folded(0.07, 2.9);
        let edge = Edge { start: DVec2::new(0.2, 0.02), ..bowed.lines[0].edges[0].clone() };
        bowed.lines[0].edges.push(edge);
        assert!(none(bowed));
        let mut flat = folded(0.07, 2.9);
        let edge = Edge { start: DVec2::new(0.2, 0.07), ..Edge::default() };
        flat.lines[0].edges.push(edge);
        assert!(none(flat), "half of the line is not folded");
    }
}
