//! Picks the point of the cloth under the pointer.

use glam::{DVec2, DVec3};

use crate::cloth::{ClothState, FlatPlace, Garment};
use crate::drag::Ray;
use crate::sim::ClothPlace;

/// A picked point of dressed cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClothHit {
    /// Position in the flat pattern.
    pub place: ClothPlace,
    /// Triangle and barycentric coordinates.
    pub flat: FlatPlace,
    /// Position in space, metres.
    pub point: DVec3,
    /// Distance from the ray's origin, metres.
    pub distance: f64,
}

/// The first point of the placed cloth that `ray` hits, from either side.
pub fn cloth_under(garment: &Garment, state: &ClothState, ray: &Ray) -> Option<ClothHit> {
    let direction = ray.direction.normalize();
    let mut best: Option<(f64, usize, DVec2)> = None;
    for (t, vs) in garment.triangles.iter().enumerate() {
        if !vs.iter().all(|&v| state.mapped[v as usize]) {
            continue;
        }
        let corners = vs.map(|v| state.positions[v as usize]);
        if let Some((distance, uv)) = meets(ray.origin, direction, corners)
            && best.is_none_or(|(least, ..)| distance < least)
        {
            best = Some((distance, t, uv));
        }
    }
    let (distance, t, uv) = best?;
    let [a, b, c] = garment.triangle_corners[t].map(|c| garment.corners[c as usize].uv);
    let at = a + (b - a) * uv.x + (c - a) * uv.y;
    let place = ClothPlace { piece: garment.triangle_pieces[t], at };
    let flat = FlatPlace { triangle: t as u32, shares: [1.0 - uv.x - uv.y, uv.x, uv.y] };
    Some(ClothHit { place, flat, point: ray.origin + direction * distance, distance })
}

/// Ray-triangle intersection: distance along the ray and barycentric weights of the second and third corner (Moeller and Trumbore
/// 1997).
pub(in crate::ui) fn meets(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<(f64, DVec2)> {
    let (ab, ac) = (b - a, c - a);
    let across = direction.cross(ac);
    let det = ab.dot(across);
    if det.abs() < 1e-18 {
        return None;
    }
    let from = origin - a;
    let u = from.dot(across) / det;
    let other = from.cross(ab);
    let v = direction.dot(other) / det;
    let t = ac.dot(other) / det;
    const EDGE: f64 = 1e-9;
    (u >= -EDGE && v >= -EDGE && u + v <= 1.0 + EDGE && t > 0.0).then_some((t, DVec2::new(u, v)))
}
