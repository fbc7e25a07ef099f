//! How far cloth marks have come to lie from their partners.

use glam::{DVec2, DVec3};

use crate::body::Surface;
use crate::cloth::{ClothState, FlatPiece, Garment};
use crate::wrap::Marks;
use crate::wrap::roots::{Stroke, lifted};

/// Points compared on each pair, ends included.
const SAMPLES: usize = 51;

/// Distances between points of cloth marks and the points of their partners at the same fraction of their length, at the
/// offset above the skin; metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct MarkError {
    /// How many points were compared: points of marks that lie on cloth that lies on the body.
    pub points: usize,
    /// Their mean distance.
    pub mean: f64,
    /// The largest.
    pub max: f64,
}

/// The error of all pairs of `marks` on a garment that lies `offset` metres above the skin.
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
        for i in 0..SAMPLES {
            let fraction = i as f64 / (SAMPLES - 1) as f64;
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
