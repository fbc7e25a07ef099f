//! Collars, one strip in front and one at the back, sewn to the neckline; standing, or turned over.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use serde::Serialize;

use crate::draft::bodice::{CLEARANCE, OUTER, OVERLAP, Trunk};
use crate::draft::form::Form;
use crate::draft::garment::{Facing, Garment, Part};
use crate::draft::path::{Path, to_the_right};
use crate::geometry::ids::PieceId;
use crate::geometry::polygon;
use crate::geometry::random::Random;
use crate::pattern::{Edge, Fold, InternalLine, Piece};

/// Distance at which the strips are placed in front of and behind the neck, metres.
const BESIDE: f64 = 0.10;
/// Distance of the halves of a collar that opens from the middle, as placed, metres.
const APART: f64 = 0.005;
/// Distance at which a collar that turns over is placed in front of and behind the skin of the bust line, metres: outside of the
/// bodice, on which its fall comes to lie.
const OUTSIDE: f64 = CLEARANCE + 0.08;
/// Distance at which such a collar is placed below the lowest point of the neckline, metres: what is pulled down over the bodice is
/// pushed up, fall first.
const BELOW: f64 = 0.02;
/// Distance at which the fall is placed outside of its stand, metres.
const OVER_STAND: f64 = 0.004;
/// Angle by which the fall of a collar is turned over, radians.
const TURNED: f64 = 170.0 * PI / 180.0;
/// Chords by which outlines are flattened, metres.
const CHORDS: f64 = 1e-4;
/// Distance of the points of a collar from the middle line, metres.
const TIP: f64 = 0.006;

/// Measures of a collar, metres.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Collar {
    /// Height; without the fall.
    pub height: f64,
    /// Length of its upper edge over that of the neckline: below 1 it leans to the neck, above 1 it opens like a funnel. With a fall,
    /// which lies farther out at its outer edge, that of the fall's outer edge, and above 1.
    pub flare: f64,
    /// The part that is turned over, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fall: Option<Fall>,
}

/// The part of a collar that is turned over, on to its outside.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Fall {
    /// Height from the roll line to the outer edge, metres; more than the collar's height, so that it hides the neckline.
    pub depth: f64,
    /// Length by which the fall is deeper at its points in front, metres.
    pub point: f64,
    /// Whether it is cut in one with the stand and folded, as that of a camp shirt is, instead of sewn to it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub in_one: bool,
}

impl Collar {
    /// A stand collar, a funnel or a turtleneck, drawn at random.
    pub fn drawn(random: &mut Random) -> Self {
        let (height, flare) = random.one_of([(0.035, 0.96), (0.045, 1.08), (0.08, 1.0), (0.065, 1.15)]);
        Self { height: height * random.between(0.85, 1.15), flare, fall: None }
    }
}

/// Drafts both strips, places them round the neck and sews them to the neckline of `trunk`.
pub fn collar(garment: &mut Garment, form: &Form, cut: &Collar, trunk: &Trunk) {
    if let Some(fall) = &cut.fall {
        return turned(garment, form, cut, fall, trunk);
    }
    let neck = form.shoulder_at(trunk.yoke.neck[0].x);
    let halves = [0, 1].map(|side| garment.length(&trunk.neckline(garment, side)) / 2.0);
    // The same lean in front and at the back, so that the side edges have the same length.
    let lean = (cut.flare - 1.0) * (halves[0] + halves[1]) / 2.0;
    let strips: [Vec<PieceId>; 2] = [0, 1].map(|side| {
        let half = halves[side];
        let (name, facing) = [("collar front", Facing::Front), ("collar back", Facing::Back)][side];
        let path = Path::from(DVec2::new(0.0, 0.0))
            .line("collar seam", DVec2::new(half, 0.0))
            .line("collar side", DVec2::new(half + lean, cut.height))
            .line("collar edge", DVec2::new(0.0, cut.height));
        let z = neck.z + [BESIDE, -BESIDE][side];
        let at = DVec3::new(0.0, neck.y + [0.0, 0.015][side], z);
        if side == 1 || !trunk.opens {
            return vec![garment.stand(path.whole(name), Part::Body, facing, at)];
        }
        let left = path.half(&format!("{name} left"), "centre");
        let right = Piece { layer: OUTER, ..to_the_right(&left) };
        [(left, DVec3::X * APART), (right, DVec3::new(-APART, 0.0, OVERLAP))]
            .map(|(piece, aside)| garment.stand(piece, Part::Body, facing, at + aside))
            .into()
    });
    for (side, strips) in strips.iter().enumerate() {
        let runs = [garment.run(strips, "collar seam", DVec3::X), trunk.neckline(garment, side)];
        garment.sew(&runs[0], &runs[1]);
    }
    let labels = ["collar side left", "collar side right"];
    garment.sew_alike(&strips[0], &strips[1], &labels, DVec3::Y);
}

/// Drafts a collar of stand and fall, open in front, places it clear of `trunk`, the fall turned over already, and sews it to the
/// neckline. Of a collar in one piece the part beyond its fold is placed turned over.
fn turned(garment: &mut Garment, form: &Form, cut: &Collar, fall: &Fall, trunk: &Trunk) {
    let necklines = [0, 1].map(|side| trunk.neckline(garment, side));
    let halves = necklines.each_ref().map(|neckline| garment.length(neckline) / 2.0);
    let lean = (cut.flare - 1.0) * (halves[0] + halves[1]) / 2.0;
    let mut stands: [Vec<PieceId>; 2] = Default::default();
    let mut falls: [Vec<PieceId>; 2] = Default::default();
    for side in 0..2 {
        let half = halves[side];
        let out = [1.0, -1.0][side];
        let z = form.depth[side] + OUTSIDE * out;
        let at = DVec3::new(0.0, lowest(garment, &trunk.sides[side]) - BELOW, z);
        if fall.in_one {
            let half = fall.in_one_path(cut.height, half, lean, side);
            stands[side] = strips(garment, side, ["collar front", "collar back"], half, at, DQuat::IDENTITY);
            stands[side].iter().for_each(|id| fold_across(garment, *id, cut.height));
            garment.sew(&garment.run(&stands[side], "collar seam", DVec3::X), &necklines[side]);
            continue;
        }
        let turn = DQuat::from_rotation_x(TURNED * out);
        let over = at + DVec3::new(0.0, cut.height, OVER_STAND * out);
        stands[side] = strips(
            garment,
            side,
            ["stand front", "stand back"],
            stand(cut.height, half),
            at,
            DQuat::IDENTITY,
        );
        let path = fall.path(cut.flare, half, side);
        falls[side] = strips(garment, side, ["collar front", "collar back"], path, over, turn);
        garment.sew(&garment.run(&stands[side], "collar seam", DVec3::X), &necklines[side]);
        let roll = [&stands[side], &falls[side]].map(|pieces| garment.run(pieces, "roll line", DVec3::X));
        garment.sew(&roll[0], &roll[1]);
    }
    let labels = |part: &str| [format!("{part} left"), format!("{part} right")];
    for (part, [front, back]) in [("collar side", &stands), ("stand side", &stands), ("fall side", &falls)] {
        for label in labels(part) {
            garment.sew_alike(front, back, &[&label], DVec3::Y);
        }
    }
}

/// Half a straight stand of this `height` and lower edge, metres.
fn stand(height: f64, half: f64) -> Path {
    Path::from(DVec2::ZERO)
        .line("collar seam", DVec2::new(half, 0.0))
        .line("stand side", DVec2::new(half, height))
        .line("roll line", DVec2::new(0.0, height))
}

impl Fall {
    /// Half of a collar in one piece in front (0) or at the back (1), `half` metres long at the neckline, that leans outwards by `lean`
    /// metres from there to the outer edge.
    fn in_one_path(&self, stand: f64, half: f64, lean: f64, side: usize) -> Path {
        let total = stand + self.depth;
        let corner = DVec2::new(half + lean, total);
        let path =
            Path::from(DVec2::ZERO).line("collar seam", DVec2::new(half, 0.0)).line("collar side", corner);
        if side == 1 {
            return path.line("collar edge", DVec2::new(0.0, total));
        }
        let (tip, control) = (DVec2::new(TIP, total + self.point), DVec2::new(half / 2.0, total));
        path.curve("collar edge", corner.lerp(control, 2.0 / 3.0), tip.lerp(control, 2.0 / 3.0), tip)
    }

    /// Half of the fall in front (0) or at the back (1), `half` metres long at the roll line: bent in its plane so that the outer
    /// edge is `flare` times as long.
    fn path(&self, flare: f64, half: f64, side: usize) -> Path {
        let radius = self.depth / (flare - 1.0);
        let at = |along: f64, up: f64| {
            DVec2::from_angle(FRAC_PI_2 - along / radius) * (radius + up) - DVec2::Y * radius
        };
        let corner = at(half, self.depth);
        let path =
            Path::from(DVec2::ZERO).arc("roll line", radius, false, at(half, 0.0)).line("fall side", corner);
        if side == 1 {
            return path.arc("collar edge", radius + self.depth, true, at(0.0, self.depth));
        }
        let (tip, control) = (at(TIP, self.depth + self.point), at(half / 2.0, self.depth));
        path.curve("collar edge", corner.lerp(control, 2.0 / 3.0), tip.lerp(control, 2.0 / 3.0), tip)
    }
}

/// Adds a fold across a piece, at this height of its own plane, metres.
fn fold_across(garment: &mut Garment, id: PieceId, height: f64) {
    let Some(piece) = garment.pattern.pieces.get_mut(&id).map(Arc::make_mut) else { return };
    let outline = piece.flattened(CHORDS);
    let met = polygon::sides(&outline).filter(|[a, b]| (a.y < height) != (b.y < height));
    let mut ends: Vec<f64> = met.map(|[a, b]| a.lerp(b, (height - a.y) / (b.y - a.y)).x).collect();
    ends.sort_by(f64::total_cmp);
    let [first, .., last] = ends[..] else { return };
    let edge =
        Edge { start: DVec2::new(first, height), trims: Fold::pressed(TURNED).into(), ..Edge::default() };
    let end = DVec2::new(last, height);
    piece.lines.push(InternalLine { edges: vec![edge], end, name: "roll line".into(), end_rule: None });
}

/// Places two halves in front, or a whole at the back, with the fold at the roll line of what is turned by `turn`.
fn strips(
    garment: &mut Garment,
    side: usize,
    names: [&str; 2],
    half: Path,
    at: DVec3,
    turn: DQuat,
) -> Vec<PieceId> {
    let name = names[side];
    let pieces = match side {
        0 => {
            let left = half.half(&format!("{name} left"), "centre");
            let right = to_the_right(&left);
            vec![(left, APART), (right, -APART)]
        }
        _ => vec![(half.whole(name), 0.0)],
    };
    let facing = [Facing::Front, Facing::Back][side];
    let placed = |(mut piece, aside): (Piece, f64)| {
        let is_roll =
            |edge: &&mut Edge| edge.label.as_deref().is_some_and(|label| label.starts_with("roll line"));
        for edge in piece.outline.iter_mut().filter(is_roll).filter(|_| turn != DQuat::IDENTITY) {
            edge.trims.fold = Some(Fold::pressed(TURNED));
        }
        garment.stand_turned(piece, Part::Body, facing, at + DVec3::X * aside, turn)
    };
    pieces.into_iter().map(placed).collect()
}

/// Height of the lowest point of the neckline of `pieces` as placed, metres.
fn lowest(garment: &Garment, pieces: &[PieceId]) -> f64 {
    let pieces = pieces.iter().filter_map(|id| garment.pattern.pieces.get(id));
    let ends = pieces.flat_map(|piece| {
        let is_neck =
            |i: &usize| piece.outline[*i].label.as_deref().is_some_and(|label| label.starts_with("neck"));
        let place = |p: DVec2| piece.placement.map_or(0.0, |pose| pose.at(p).y);
        let edges = (0..piece.outline.len()).filter(is_neck).map(|i| piece.edge_ends(i));
        edges.map(move |(a, b)| place(a).min(place(b))).collect::<Vec<_>>()
    });
    ends.fold(f64::MAX, f64::min)
}
