//! Collars of two strips, one in front and one at the back, sewn to the neckline.

use glam::{DVec2, DVec3};
use serde::Serialize;

use crate::draft::bodice::{OUTER, OVERLAP, Trunk};
use crate::draft::form::Form;
use crate::draft::garment::{Facing, Garment, Part};
use crate::draft::path::{Path, to_the_right};
use crate::geometry::ids::PieceId;
use crate::geometry::random::Random;
use crate::pattern::Piece;

/// Distance at which the strips are placed in front of and behind the neck, metres.
const BESIDE: f64 = 0.10;
/// Distance of the halves of a collar that opens from the middle, as placed, metres.
const APART: f64 = 0.005;

/// Measures of a collar, metres.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Collar {
    /// Height.
    pub height: f64,
    /// Length of its upper edge over that of the neckline: below 1 it leans to the neck, above 1 it opens like a funnel.
    pub flare: f64,
}

impl Collar {
    /// A stand collar, a funnel or a turtleneck, drawn at random.
    pub fn drawn(random: &mut Random) -> Self {
        let (height, flare) = random.one_of([(0.035, 0.96), (0.045, 1.08), (0.08, 1.0), (0.065, 1.15)]);
        Self { height: height * random.between(0.85, 1.15), flare }
    }
}

/// Drafts both strips, places them round the neck and sews them to the neckline of `trunk`.
pub fn collar(garment: &mut Garment, form: &Form, cut: &Collar, trunk: &Trunk) {
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
        let left = path.half(&format!("{name} left"));
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
