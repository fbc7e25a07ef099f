//! Hoods of a left and a right half, sewn to each other over the crown and to the neckline.

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec2, DVec3};
use serde::Serialize;

use crate::draft::bodice::Trunk;
use crate::draft::form::Form;
use crate::draft::garment::{Facing, Garment, Part};
use crate::draft::path::{Path, to_the_right};
use crate::geometry::random::Random;

/// Distance at which the halves are placed beside the middle of the neck, metres.
const BESIDE: f64 = 0.13;
/// Slopes of the hood's neckline: its fall to the front and its rise to the back, radians.
const SLOPES: [f64; 2] = [0.62, 0.14];

/// Measures of a hood, metres.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Hood {
    /// Room above the crown of the head.
    pub above: f64,
    /// Distance from the back of the neckline out to the back of the head.
    pub fullness: f64,
}

impl Hood {
    /// A roomy hood, drawn at random.
    pub fn drawn(random: &mut Random) -> Self {
        Self { above: random.between(0.03, 0.07), fullness: random.between(0.02, 0.05) }
    }
}

/// Drafts both halves, places them beside the head and sews them to the neckline of `trunk`.
pub fn hood(garment: &mut Garment, form: &Form, cut: &Hood, trunk: &Trunk) {
    let half = |side: usize| garment.length(&trunk.neckline(garment, side)) / 2.0;
    let (front, back) = (half(0), half(1));
    let neck = form.shoulder_at(trunk.yoke.neck[0].x);
    // Seen from the left of the body: the face points to -x.
    let face = DVec2::new(-SLOPES[0].cos(), -SLOPES[0].sin()) * front;
    let nape = DVec2::from_angle(SLOPES[1]) * back;
    let top = form.crown - neck.y + cut.above;
    let occiput = DVec2::new(nape.x + cut.fullness, 0.55 * top);
    let brow = DVec2::new(face.x - 0.015, top - 0.005);
    let left = Path::from(face)
        .line("hood front", DVec2::ZERO)
        .line("hood back", nape)
        .curve("crown", nape + DVec2::Y * 0.06, occiput - DVec2::Y * 0.07, occiput)
        .curve(
            "crown",
            occiput + DVec2::Y * (0.30 * top),
            DVec2::new(occiput.x - 0.06, top + 0.005),
            DVec2::new(occiput.x - 0.10, top + 0.005),
        )
        .line("crown", brow)
        .closed("hood left", "face");
    let right = to_the_right(&left);
    let at = DVec3::new(BESIDE, neck.y + 0.02, neck.z);
    let pieces = [(left, 1.0), (right, -1.0)].map(|(piece, side)| {
        let turn = DQuat::from_rotation_y(side * FRAC_PI_2);
        garment.stand_turned(piece, Part::Body, Facing::Front, at * DVec3::new(side, 1.0, 1.0), turn)
    });
    let runs = pieces.map(|piece| garment.run(&[piece], "crown", DVec3::new(0.0, 1.0, 0.6)));
    garment.sew(&runs[0], &runs[1]);
    // Runs from the middle of front and back to the shoulder seams.
    let hands = [("left", DVec3::X), ("right", DVec3::NEG_X)];
    let labels = [("hood front", DVec3::NEG_Z), ("hood back", DVec3::Z)];
    for (piece, (hand, outwards)) in pieces.into_iter().zip(hands) {
        for (half, (label, axis)) in labels.into_iter().enumerate() {
            let own = garment.run(&[piece], label, axis);
            let neckline = garment.run(&trunk.sides[half], &format!("neck {hand}"), outwards);
            garment.sew(&own, &neckline);
        }
    }
}
