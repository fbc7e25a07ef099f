//! Contact pairs of cloth with itself: a vertex and a triangle, or two edges.

use glam::DVec3;

use crate::body::closest::{Part, closest_on_triangle};

/// Weights of the four vertices in the distance vector, contact normal, and signed distance in metres: negative after a
/// penetration.
pub(super) type Found = ([f64; 4], DVec3, f64);

#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// A vertex and a triangle's corners, or the ends of two edges.
    pub vertices: [u32; 4],
    pub edges: bool,
    /// The side of the second feature on which the first one is, ±1.
    pub side: f64,
    /// Largest possible approach in the step, metres. A pair that seems farther behind has moved round the other feature, not
    /// through it.
    pub reach: f64,
}

impl Pair {
    /// Sort key.
    pub fn key(&self) -> (bool, [u32; 4]) {
        (self.edges, self.vertices)
    }

    /// Weights, normal and signed distance of the pair at `x`; None where the two do not face each other.
    pub fn found(&self, x: &[DVec3]) -> Option<Found> {
        if self.edges { crossing(self, x) } else { corner(self, x) }
    }
}

/// Weights, normal and signed distance of a vertex and a triangle. None where the vertex is behind the triangle and outside its
/// border.
fn corner(pair: &Pair, x: &[DVec3]) -> Option<Found> {
    let [p, a, b, c] = pair.vertices.map(|v| x[v as usize]);
    let normal = (b - a).cross(c - a).normalize_or_zero() * pair.side;
    let (near, part) = closest_on_triangle(p, a, b, c);
    let signed = normal.dot(p - near);
    if matches!(part, Part::Face) {
        let (u, v) = barycentric(near, a, b, c)?;
        return Some(([1.0, u + v - 1.0, -u, -v], normal, signed));
    }
    if signed < 0.0 {
        return None;
    }
    let way = p - near;
    let distance = way.length();
    let (u, v) = barycentric(near, a, b, c)?;
    (distance > 0.0).then(|| ([1.0, u + v - 1.0, -u, -v], way / distance, distance))
}

fn barycentric(p: DVec3, a: DVec3, b: DVec3, c: DVec3) -> Option<(f64, f64)> {
    let (u, v, w) = (b - a, c - a, p - a);
    let (uu, uv, vv, wu, wv) = (u.dot(u), u.dot(v), v.dot(v), w.dot(u), w.dot(v));
    let whole = uu * vv - uv * uv;
    (whole > 0.0).then(|| ((vv * wu - uv * wv) / whole, (uu * wv - uv * wu) / whole))
}

/// Weights, normal and signed distance of two edges whose common perpendicular meets both within their lengths; None otherwise.
fn crossing(pair: &Pair, x: &[DVec3]) -> Option<Found> {
    let [a, b, c, d] = pair.vertices.map(|v| x[v as usize]);
    let (u, v, w) = (b - a, d - c, c - a);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    let whole = uu * vv - uv * uv;
    // Nearly parallel edges touch at their ends, which the vertex-triangle pairs cover.
    if whole <= 1e-6 * uu * vv {
        return None;
    }
    let (s, t) = ((vv * uw - uv * vw) / whole, (uv * uw - uu * vw) / whole);
    if !(0.0..=1.0).contains(&s) || !(0.0..=1.0).contains(&t) {
        return None;
    }
    let normal = u.cross(v).normalize_or_zero() * pair.side;
    Some(([s - 1.0, -s, 1.0 - t, t], normal, normal.dot(w)))
}

/// Distance of the segments ab and cd (Ericson, Real-Time Collision Detection, 5.1.9).
pub(super) fn segments_apart([a, b, c, d]: [DVec3; 4]) -> f64 {
    let (u, v, w) = (b - a, d - c, a - c);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    if uu == 0.0 || vv == 0.0 {
        return w.length().min((b - c).length());
    }
    let whole = uu * vv - uv * uv;
    let s = if whole > 1e-12 * uu * vv { ((uv * vw - vv * uw) / whole).clamp(0.0, 1.0) } else { 0.0 };
    let t = ((uv * s + vw) / vv).clamp(0.0, 1.0);
    let s = ((uv * t - uw) / uu).clamp(0.0, 1.0);
    (w + u * s - v * t).length()
}
