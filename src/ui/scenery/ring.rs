//! The ring round a tight place.

use glam::DVec2;

use crate::fit::TightPlace;
use crate::geometry::ids::PieceId;
use crate::sim::ClothPlace;

/// Radius of the ring, metres on the flat cloth.
const RING: f64 = 0.025;
/// Number of corners of the ring.
const CORNERS: u32 = 40;

/// Position of a tight place on the flat cloth.
pub fn flat(place: &TightPlace) -> ClothPlace {
    ClothPlace { piece: place.piece, at: place.flat }
}

/// The ring round a place as a polyline in its piece's own plane.
pub fn ring(place: ClothPlace) -> (PieceId, Vec<DVec2>) {
    let turn = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(CORNERS);
    (place.piece, (0..=CORNERS).map(|i| place.at + DVec2::from_angle(turn(i)) * RING).collect())
}
