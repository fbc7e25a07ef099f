//! Barycentric coordinates: a point of a triangle as weights of its corners, called shares, which sum to 1.

use glam::{DVec2, DVec3};

/// The point with these barycentric coordinates (`shares`) in the triangle with these corners.
pub fn place(shares: [f64; 3], [a, b, c]: [DVec3; 3]) -> DVec3 {
    a * shares[0] + b * shares[1] + c * shares[2]
}

/// Barycentric coordinates, none negative, of the point of a triangle that is nearest to `p` (Ericson, Real-Time
/// Collision Detection, 3.4). For a triangle without area they are those of its nearest corner.
pub fn on_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let (u, v, w) = (b - a, c - a, p - a);
    let (uu, uv, vv, wu, wv) = (u.dot(u), u.dot(v), v.dot(v), w.dot(u), w.dot(v));
    let det = uu * vv - uv * uv;
    if det <= f64::EPSILON * uu * vv {
        let far = [a, b, c].map(|q| q.distance_squared(p));
        let nearest = (0..3).min_by(|&i, &j| far[i].total_cmp(&far[j])).unwrap_or(0);
        return [0, 1, 2].map(|k| f64::from(u8::from(k == nearest)));
    }
    let (s, t) = ((vv * wu - uv * wv) / det, (uu * wv - uv * wu) / det);
    let shares = [1.0 - s - t, s, t].map(|x| x.clamp(0.0, 1.0));
    let sum: f64 = shares.iter().sum();
    shares.map(|x| x / sum)
}

/// Barycentric coordinates of a point of the triangle's plane; outside the triangle some are negative. None where the
/// triangle has no area.
pub fn in_plane([a, b, c]: [DVec2; 3], p: DVec2) -> Option<[f64; 3]> {
    let area = (b - a).perp_dot(c - a);
    let shares = [(c - b).perp_dot(p - b) / area, (a - c).perp_dot(p - c) / area];
    let shares = [shares[0], shares[1], 1.0 - shares[0] - shares[1]];
    shares.iter().all(|s| s.is_finite()).then_some(shares)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [DVec3; 3] =
        [DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.0, 0.4, -0.2), DVec3::new(0.3, 1.1, 0.6)];

    #[test]
    fn shares_give_the_point_back() {
        for shares in [[0.2, 0.3, 0.5], [1.0, 0.0, 0.0], [0.0, 0.6, 0.4]] {
            let p = place(shares, CORNERS);
            assert!(place(on_triangle(p, CORNERS), CORNERS).distance(p) < 1e-15);
            let found = in_plane(CORNERS.map(|c| c.truncate()), p.truncate()).expect("an area");
            assert!(found.iter().zip(shares).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?}");
        }
    }

    #[test]
    fn without_area_there_is_a_nearest_corner_or_nothing() {
        let line = [0.0, 1.0, 3.0].map(|x| DVec3::new(x, 0.0, 0.0));
        assert_eq!(on_triangle(DVec3::new(2.5, 0.0, 0.0), line), [0.0, 0.0, 1.0]);
        assert_eq!(in_plane(line.map(|c| c.truncate()), DVec2::ZERO), None);
    }
}
