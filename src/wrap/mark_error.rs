//! How far cloth marks have come to lie from their partners.

use glam::{DVec2, DVec3};

use crate::body::Surface;
use crate::cloth::{ClothState, Garment};
use crate::geometry::ids::PieceId;
use crate::wrap::Marks;
use crate::wrap::roots::{Stroke, lifted};

/// Points compared on each pair, ends included.
const SAMPLES: usize = 51;
/// How far outside of a triangle (barycentric) a point may lie and still belong to it.
const SLACK: f64 = 1e-6;

/// Distances between points of cloth marks and the points of their partners at the same fraction of their length, at the
/// offset above the skin; metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
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
        for i in 0..SAMPLES {
            let fraction = i as f64 / (SAMPLES - 1) as f64;
            let uv = flat.at(fraction * flat.length());
            let Some(place) = place_of(garment, state, cloth.piece, uv) else { continue };
            let distance = place.distance(skin.at(fraction * skin.length()));
            error.points += 1;
            error.max = error.max.max(distance);
            sum += distance;
        }
    }
    error.mean = sum / error.points.max(1) as f64;
    error
}

/// Where the point `uv` of `piece` lies in space; None off the piece and where its triangle is not on the body.
fn place_of(garment: &Garment, state: &ClothState, piece: PieceId, uv: DVec2) -> Option<DVec3> {
    (0..garment.triangles.len()).filter(|&t| garment.triangle_pieces[t] == piece).find_map(|t| {
        let weights = barycentric(uv, garment.triangle_corners[t].map(|c| garment.corners[c as usize].uv))?;
        let vertices = garment.triangles[t].map(|v| v as usize);
        let laid = vertices.iter().all(|&v| state.mapped[v]);
        laid.then(|| (0..3).map(|k| state.positions[vertices[k]] * weights[k]).sum())
    })
}

/// None outside of the triangle.
fn barycentric(p: DVec2, [a, b, c]: [DVec2; 3]) -> Option<[f64; 3]> {
    let area = (b - a).perp_dot(c - a);
    let u = (c - b).perp_dot(p - b) / area;
    let v = (a - c).perp_dot(p - c) / area;
    let weights = [u, v, 1.0 - u - v];
    weights.iter().all(|&w| w >= -SLACK).then_some(weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn barycentric_weights_give_the_point_back() {
        let [a, b, c] = [DVec2::new(0.1, 0.0), DVec2::new(0.0, 2.0), DVec2::new(-1.0, 0.3)];
        for corners in [[a, b, c], [a, c, b]] {
            let p = a * 0.2 + b * 0.5 + c * 0.3;
            let w = barycentric(p, corners).expect("inside");
            assert!((corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2] - p).length() < 1e-12);
            assert!(barycentric(a * 1.5 - b * 0.5, corners).is_none());
        }
    }
}
