//! Closest points of mesh features (vertex, edge, triangle), and planes that separate two features.

use glam::DVec3;

use crate::body::closest::closest_on_triangle;

/// Separation of two features along the direction between their closest points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// Unit vector from the second feature to the first.
    pub normal: DVec3,
    /// Largest height of the second feature along the normal, metres.
    pub below: f64,
    /// Smallest height of the first feature along the normal, minus `below`: the width of the gap, metres, positive.
    pub gap: f64,
}

/// Separation of a vertex (first) and a triangle (second); None where they touch.
pub(super) fn vertex_and_triangle(p: DVec3, corners: [DVec3; 3]) -> Option<Seen> {
    let [a, b, c] = corners;
    between(p - closest_on_triangle(p, a, b, c).0, &[p], &corners)
}

/// Separation of two edges; None where they touch.
pub(super) fn edges(one: [DVec3; 2], other: [DVec3; 2]) -> Option<Seen> {
    let [p, q] = closest_on_segments(one, other);
    between(p - q, &one, &other)
}

/// The vector (m) between the closest points of two features, from the second to the first, and the weight of each of
/// the four vertices in it.
pub(super) fn contact(is_edges: bool, [a, b, c, d]: [DVec3; 4]) -> ([f64; 4], DVec3) {
    if is_edges {
        let [p, q] = closest_on_segments([a, b], [c, d]);
        let (s, t) = (along(p, a, b), along(q, c, d));
        return ([1.0 - s, s, t - 1.0, -t], p - q);
    }
    let q = closest_on_triangle(a, b, c, d).0;
    let [u, v] = barycentric(q, b, c, d);
    ([1.0, u + v - 1.0, -u, -v], a - q)
}

/// The weight of b at the point `p` of the segment from a to b.
fn along(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let (way, squared) = (b - a, (b - a).length_squared());
    if squared > 0.0 { ((p - a).dot(way) / squared).clamp(0.0, 1.0) } else { 0.0 }
}

/// The weights of b and c at the point `p` of triangle abc.
fn barycentric(p: DVec3, a: DVec3, b: DVec3, c: DVec3) -> [f64; 2] {
    let (u, v, w) = (b - a, c - a, p - a);
    let (uu, uv, vv, wu, wv) = (u.dot(u), u.dot(v), v.dot(v), w.dot(u), w.dot(v));
    let whole = uu * vv - uv * uv;
    if whole > 0.0 { [(vv * wu - uv * wv) / whole, (uu * wv - uv * wu) / whole] } else { [0.0; 2] }
}

/// Separation of two features along `way`, which leads from `other` to `one`; None where `way` does not separate them.
fn between(way: DVec3, one: &[DVec3], other: &[DVec3]) -> Option<Seen> {
    let distance = way.length();
    // Features that touch have no direction between them.
    if distance < 1e-12 {
        return None;
    }
    let normal = way / distance;
    let above = one.iter().map(|p| normal.dot(*p)).fold(f64::INFINITY, f64::min);
    let below = other.iter().map(|p| normal.dot(*p)).fold(f64::NEG_INFINITY, f64::max);
    let gap = above - below;
    (gap > 0.0).then_some(Seen { normal, below, gap })
}

/// The closest points of segments ab and cd (Ericson, Real-Time Collision Detection, 5.1.9).
pub(super) fn closest_on_segments([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> [DVec3; 2] {
    let (u, v, w) = (b - a, d - c, a - c);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    if uu == 0.0 && vv == 0.0 {
        return [a, c];
    }
    if uu == 0.0 {
        return [a, c + v * (vw / vv).clamp(0.0, 1.0)];
    }
    if vv == 0.0 {
        return [a + u * (-uw / uu).clamp(0.0, 1.0), c];
    }
    let whole = uu * vv - uv * uv;
    let s = if whole > 1e-12 * uu * vv { ((uv * vw - vv * uw) / whole).clamp(0.0, 1.0) } else { 0.0 };
    let t = ((uv * s + vw) / vv).clamp(0.0, 1.0);
    let s = ((uv * t - uw) / uu).clamp(0.0, 1.0);
    [a + u * s, c + v * t]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }

    fn point(seed: &mut u64) -> DVec3 {
        DVec3::new(random(seed), random(seed), random(seed))
    }

    /// The gap is the distance: no points of the two, found by trying many, are nearer.
    #[test]
    fn the_gap_between_two_features_is_their_distance() {
        let mut seed = 7;
        for _ in 0..300 {
            let [a, b, c, d] = [0; 4].map(|_| point(&mut seed));
            let seen = edges([a, b], [c, d]).expect("apart");
            let of_triangle = vertex_and_triangle(a, [b, c, d]).expect("apart");
            let (mut least, mut least_triangle) = (f64::MAX, f64::MAX);
            for i in 0..=40 {
                for j in 0..=40 {
                    let (s, t) = (f64::from(i) / 40.0, f64::from(j) / 40.0);
                    least = least.min(a.lerp(b, s).distance(c.lerp(d, t)));
                    least_triangle = least_triangle.min(a.distance(b.lerp(c, s).lerp(d, t)));
                }
            }
            assert!(seen.gap <= least + 1e-9 && seen.gap > least - 0.05, "{} {least}", seen.gap);
            assert!(of_triangle.gap <= least_triangle + 1e-9 && of_triangle.gap > least_triangle - 0.05);
        }
    }

    #[test]
    fn what_touches_is_not_parted() {
        let [a, b, c] = [DVec3::ZERO, DVec3::X, DVec3::Y];
        assert!(vertex_and_triangle(DVec3::new(0.2, 0.2, 0.0), [a, b, c]).is_none());
        assert!(edges([a, b], [DVec3::new(0.5, -1.0, 0.0), DVec3::new(0.5, 1.0, 0.0)]).is_none());
        // Parallel edges, and edges without length, are parted.
        assert!(edges([a, b], [c, c + b]).is_some_and(|seen| seen.gap == 1.0));
        assert!(edges([a, a], [c, c]).is_some_and(|seen| seen.gap == 1.0));
    }
}
