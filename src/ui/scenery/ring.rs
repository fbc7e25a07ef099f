//! The ring round a tight place that is shown.

use glam::DVec2;

use crate::fit::TightPlace;
use crate::geometry::ids::PieceId;
use crate::sim::ClothPlace;

/// Radius of the ring round a place that is shown, metres on the flat cloth.
const RING: f64 = 0.025;
/// Corners of that.
const CORNERS: u32 = 40;

/// Where a tight place is on the flat cloth.
pub fn flat(place: &TightPlace) -> ClothPlace {
    ClothPlace { piece: place.piece, at: place.flat }
}

/// The line round a place, in its piece's own plane.
pub fn ring(place: ClothPlace) -> (PieceId, Vec<DVec2>) {
    let turn = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(CORNERS);
    (place.piece, (0..=CORNERS).map(|i| place.at + DVec2::from_angle(turn(i)) * RING).collect())
}
