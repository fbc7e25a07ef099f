//! A skirt of knife pleats all round, on a waistband.
//!
//! Every panel has one pleat and is sewn to the next along that pleat's inner fold, where the seam does not show. A pleat is sewn shut
//! along its upper edge, and lies over the panel before it, to the wearer's right in front.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use crate::draft::band::GAP;
use crate::draft::form::Form;
use crate::draft::garment::{Facing, Garment, Part};
use crate::draft::path::{Path, solved};
use crate::geometry::ids::PieceId;
use crate::pattern::{Edge, EdgeRef, Fold, InternalLine, Pattern, Piece, Roll, Seam};

/// Distance of the ring of panels as placed, at their seams, from the body taken as round, metres.
const OUTSIDE: f64 = 0.064;
/// Distance of the waistband as placed from the waist taken as round, metres.
const OUTSIDE_BAND: f64 = 0.052;
/// Edges of a panel, after the three of its hem: along the inner fold of the next panel's pleat, at the waist, along both halves of its
/// own pleat's upper edge, and along its pleat's inner fold.
const NEXT: usize = 3;
const WAIST: usize = 4;
const TOPS: [usize; 2] = [5, 6];
const OWN: usize = 7;

/// Measures of a pleated skirt; metres.
#[derive(Clone, Copy, Debug)]
pub struct Pleats {
    /// Number of pleats in front, and as many at the back.
    pub count: u32,
    /// Distance from the inner to the outer fold of a pleat.
    pub depth: f64,
    /// Angle by which pleats are folded, radians.
    pub angle: f64,
    /// Ease added to the girth of the waist.
    pub waist_ease: f64,
    /// Ease added to the girth of the hip, all pleats closed; where it is below 0, they open there.
    pub hip_ease: f64,
    /// Height of the waistband.
    pub band: f64,
    /// Length from the waist down, as a share of the waist's height above the ground.
    pub length: f64,
}

/// Drafts the skirt for the body of `form`, places panels and waistband in rings round it and sews them.
pub fn pleated_skirt(form: &Form, cut: &Pleats) -> Pattern {
    let mut garment = Garment::default();
    let girth = form.measurements.waist + cut.waist_ease;
    let count = 2 * cut.count as usize;
    let panel = panel(form, cut, girth / count as f64);
    let middle = (form.hip_depth[0] + form.hip_depth[1]) / 2.0;
    let ring = Ring { middle: DVec3::new(0.0, form.waist, middle), count };
    let panels = ring.panels(&mut garment, &panel, form.measurements.hip / TAU + OUTSIDE);
    let bands = ring.bands(&mut garment, girth, cut.band);
    let mut sew = |a: (PieceId, usize), b: (PieceId, usize)| {
        let sides = [a, b].map(|(piece, edge)| EdgeRef { piece, edge });
        garment.pattern.add_seam(Seam::of_edges(sides, false));
    };
    let half = cut.count as usize;
    for (i, &panel) in panels.iter().enumerate() {
        sew((bands[i / half], i % half), (panel, WAIST));
        sew((panel, TOPS[0]), (panel, TOPS[1]));
        sew((panel, NEXT), (panels[(i + 1) % count], OWN));
    }
    for (i, &band) in bands.iter().enumerate() {
        sew((band, half), (bands[1 - i], half + 2));
    }
    garment.pattern
}

/// A panel with the waist at the top, x = 0 in the middle between its folds at the waist: its pleat at the left, as seen from
/// outside, and to the right of that the part that shows, `face` metres wide at the waist.
fn panel(form: &Form, cut: &Pleats, face: f64) -> Piece {
    let count = 2.0 * f64::from(cut.count);
    let at_hip = (form.measurements.hip + cut.hip_ease) / count;
    // Only the part that shows is wider below: folds along its pleat are parallel, so that it can be folded flat.
    let opens = (at_hip - face) / (form.waist - form.hip);
    let length = cut.length * form.waist;
    let (mut top, mut angle) = (DVec2::ZERO, -opens / 2.0);
    let low = |top: DVec2, angle: f64| top + DVec2::from_angle(angle - FRAC_PI_2) * length;
    let mut ends = vec![[top, low(top, angle)]];
    for (width, turns) in [(cut.depth, 0.0), (cut.depth, 0.0), (face, opens)] {
        top += DVec2::from_angle(angle + turns / 2.0) * width;
        angle += turns;
        ends.push([top, low(top, angle)]);
    }
    let to_middle = DVec2::new(-top.x / 2.0, 0.0);
    let at = |i: usize| ends[i].map(|p| p + to_middle);
    let path = (1..4).fold(Path::from(at(0)[1]), |path, i| path.line("hem", at(i)[1]));
    let path = path.line("next pleat", at(3)[0]).line("waist", at(2)[0]);
    let path = path.line("pleat top", at(1)[0]).line("pleat top", at(0)[0]);
    let mut piece = path.closed("pleat", "inner fold");
    piece.outline[NEXT].trims.fold = Some(Fold::pressed(cut.angle));
    let [end, start] = at(1);
    let outer = Edge { start, trims: Fold::pressed(-cut.angle).into(), ..Edge::default() };
    piece.lines.push(InternalLine {
        edges: vec![outer],
        end,
        name: "outer fold".to_owned(),
        ..InternalLine::default()
    });
    piece
}

/// A ring of pieces round the body, from its right side over the front.
struct Ring {
    /// Its centre, at the height of the waist, metres.
    middle: DVec3,
    /// Number of panels.
    count: usize,
}

impl Ring {
    /// Places copies of `panel`, rolled so that their sides meet on a circle of this `radius` (m): so folded to begin with they do not
    /// crumple when they are sewn.
    fn panels(&self, garment: &mut Garment, panel: &Piece, radius: f64) -> Vec<PieceId> {
        let share = PI / self.count as f64;
        let width = panel.outline[NEXT + 1].start.distance(panel.outline[OWN].start);
        let narrowed = 2.0 * radius * share.sin() / width;
        let half = solved(1e-3, PI, |half| half.sin() / half - narrowed);
        let bent = width / (2.0 * half);
        let out = radius * share.cos() + bent * (1.0 - half.cos());
        let place = |i: usize| {
            let name = format!("{} {}", panel.name, i + 1);
            let turn = (2 * i + 1) as f64 * share - FRAC_PI_2;
            self.rolled(garment, Piece { name, ..panel.clone() }, [out, 0.0], turn, (Part::Leg, bent))
        };
        (0..self.count).map(place).collect()
    }

    /// Places both halves of a waistband `girth` metres round and `height` metres high. Their lower edges have a point at every pleat.
    fn bands(&self, garment: &mut Garment, girth: f64, height: f64) -> [PieceId; 2] {
        let (half, radius) = (girth / 4.0, girth / TAU + OUTSIDE_BAND);
        let faces = self.count / 2;
        [("waistband front", 0.0), ("waistband back", PI)].map(|(name, turn)| {
            let below = |i: usize| DVec2::new(half * (2.0 * i as f64 / faces as f64 - 1.0), 0.0);
            let path = (1..=faces).fold(Path::from(below(0)), |path, i| path.line("band seam", below(i)));
            let path = path.line("band side", DVec2::new(half, height));
            let path = path.line("band top", DVec2::new(-half, height));
            let piece = path.closed(name, "band side");
            self.rolled(garment, piece, [radius, GAP], turn, (Part::Body, radius))
        })
    }

    /// Adds `piece`, rolled to a radius (m), its middle this far out from the ring's axis and up from the waist (m), `turn` radians
    /// from the front to the wearer's left.
    fn rolled(
        &self,
        garment: &mut Garment,
        piece: Piece,
        [out, up]: [f64; 2],
        turn: f64,
        (part, radius): (Part, f64),
    ) -> PieceId {
        let turn = DQuat::from_rotation_y(turn);
        let at = self.middle + DVec3::Y * up + turn * (DVec3::Z * out);
        let id = garment.stand_turned(piece, part, Facing::Front, at, turn);
        if let Some(pose) =
            garment.pattern.pieces.get_mut(&id).and_then(|piece| Arc::make_mut(piece).placement.as_mut())
        {
            pose.roll = Some(Roll { centre: DVec2::ZERO, along: DVec2::Y, radius });
        }
        id
    }
}
