//! Errors of marks: distances between cloth marks and their partners on the body.

use glam::{DVec2, DVec3};

use crate::body::Surface;
use crate::cloth::{ClothState, FlatPiece, Garment};
use crate::wrap::Marks;
use crate::wrap::roots::{Stroke, lifted};

/// Distances, metres, between points of cloth marks and points of their partners (raised to the offset above the
/// skin) at the same fraction of their length.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct MarkError {
    /// Number of points compared: those of marks on cloth that is placed.
    pub points: usize,
    /// Mean distance, metres.
    pub mean: f64,
    /// Largest distance, metres.
    pub max: f64,
}

/// The error of all pairs of `marks` on a garment `offset` metres above the skin.
pub fn mark_error(
    garment: &Garment,
    state: &ClothState,
    surface: &Surface,
    marks: &Marks,
    offset: f64,
) -> MarkError {
    let mut error = MarkError::default();
    let mut sum = 0.0;
    for (cloth, body) in marks.pairs().filter(|(c, b)| !c.points.is_empty() && !b.points.is_empty()) {
        let flat = Stroke::new(cloth.points.clone(), DVec2::length);
        let skin =
            Stroke::new(body.points.iter().map(|&p| lifted(surface, p, offset)).collect(), DVec3::length);
        let piece = FlatPiece::new(garment, cloth.piece);
        // The ends and 49 points between: on a stroke half a metre long one every centimetre.
        for i in 0..=50 {
            let fraction = f64::from(i) / 50.0;
            let uv = flat.at(fraction * flat.length());
            let place = piece.inside(garment, uv).and_then(|place| place.point(garment, state));
            let Some(place) = place else { continue };
            let distance = place.distance(skin.at(fraction * skin.length()));
            error.points += 1;
            error.max = error.max.max(distance);
            sum += distance;
        }
    }
    error.mean = sum / error.points.max(1) as f64;
    error
}
