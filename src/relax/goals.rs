//! Shape matching of triangles: the rest shape rotated on to the present corners gives their goals.
//!
//! Paper A, "Relaxation". The rotation is that of least squares unless the paper's own is asked for: with it, moving
//! every vertex to the mean of its goals never raises the energy, the sum of |x - c - R w|^2.

use glam::{DVec2, DVec3};

use crate::relax::Rotation;

/// Goals of a triangle's corners relative to their centroid: the rest shape `rest` (about its centroid, front up)
/// rotated in the plane of `corners` to match them best. For collapsed corners `keep` gives the normal of the plane.
#[inline]
pub fn turned_rest(
    corners: [DVec3; 3],
    rest: &[DVec2; 3],
    keep: impl FnOnce() -> DVec3,
    by: Rotation,
) -> [DVec3; 3] {
    let (u, v) = (corners[1] - corners[0], corners[2] - corners[0]);
    let area = u.cross(v);
    let (length, size) = (u.length_squared(), area.length());
    // With a height below a millionth of its first side it has collapsed.
    if size > 1e-6 * length && length > 0.0 {
        let n = area * size.recip();
        if by == Rotation::LeastSquares {
            return turned_about(n, [u, v], rest);
        }
        // In the plane of u and v: u points along x, v lies above it.
        let length = length.sqrt();
        let x = u / length;
        let (p, q) = (v.dot(x), size / length);
        let centre = DVec2::new(length + p, q) / 3.0;
        let flat = [-centre, DVec2::new(length, 0.0) - centre, DVec2::new(p, q) - centre];
        return turned([x, n.cross(x)], flat, rest, by);
    }
    turned_rest_facing(corners, rest, area.try_normalize().unwrap_or_else(keep), by)
}

/// `rest` rotated about the unit normal `n` of a triangle, whose `sides` start at its first corner, to match it best
/// by least squares. With a0 and a1 the sums over corners of position times rest.x and rest.y, the rotated x axis is
/// along a0 + a1 x n: A plus its cofactors, whose length is the sum of the singular values of A and so never 0.
#[inline(always)]
fn turned_about(n: DVec3, [u, v]: [DVec3; 2], rest: &[DVec2; 3]) -> [DVec3; 3] {
    let [a, b, c] = *rest;
    // The rest shape sums to 0 about its centroid: positions may be relative to any point.
    let (along_x, along_y) = (u * b.x + v * c.x, u * b.y + v * c.y);
    let x = along_x + along_y.cross(n);
    let x = x * x.length().recip();
    let y = n.cross(x);
    [x * a.x + y * a.y, x * b.x + y * b.y, x * c.x + y * c.y]
}

/// Goals as from [`turned_rest`], but in the plane perpendicular to `normal` (paper A's temporary normal): a triangle
/// that faces away from it is turned over.
pub fn turned_rest_facing(corners: [DVec3; 3], rest: &[DVec2; 3], normal: DVec3, by: Rotation) -> [DVec3; 3] {
    let n = normal.try_normalize().unwrap_or(DVec3::Z);
    let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    let edge = corners[1] - corners[0];
    let x = (edge - n * n.dot(edge)).try_normalize().unwrap_or_else(|| n.any_orthonormal_vector());
    let y = n.cross(x);
    let flat = corners.map(|p| DVec2::new((p - centre).dot(x), (p - centre).dot(y)));
    turned([x, y], flat, rest, by)
}

/// `rest` rotated to match `flat` best, both about their centroids, in the plane of the axes `x` and `y`.
#[inline(always)]
fn turned([x, y]: [DVec3; 2], flat: [DVec2; 3], rest: &[DVec2; 3], by: Rotation) -> [DVec3; 3] {
    let wanted = match by {
        Rotation::LeastSquares => *rest,
        Rotation::Paper => rest.map(DVec2::normalize_or_zero),
    };
    let one = |k: usize| DVec2::new(flat[k].dot(wanted[k]), wanted[k].perp_dot(flat[k]));
    let turn = one(0) + one(1) + one(2);
    let size = |of: &[DVec2; 3]| of[0].length_squared() + of[1].length_squared() + of[2].length_squared();
    let (present, wanted) = (size(&flat), size(&wanted));
    let length = turn.length_squared();
    // The rotation is undefined for a mirrored triangle, where the best one matches less than a thousandth of what could: its first
    // edge then keeps its direction.
    let turn = if length > 1e-6 * present * wanted && length > 0.0 {
        turn / length.sqrt()
    } else {
        let w = rest[1] - rest[0];
        DVec2::new(w.x, -w.y).normalize_or(DVec2::X)
    };
    let (x, y) = (x * turn.x + y * turn.y, y * turn.x - x * turn.y);
    let [u, v, w] = *rest;
    [x * u.x + y * u.y, x * v.x + y * v.y, x * w.x + y * w.y]
}

#[cfg(test)]
mod tests {
    use super::*;

    const REST: [DVec2; 3] = [DVec2::new(-1.0, -1.0), DVec2::new(2.0, -1.0), DVec2::new(-1.0, 2.0)];

    fn placed(turn: f64, at: DVec3) -> [DVec3; 3] {
        REST.map(|w| DVec2::from_angle(turn).rotate(w).extend(0.0) + at)
    }

    #[test]
    fn an_unstrained_triangle_stays() {
        let corners = placed(0.7, DVec3::new(3.0, 2.0, 1.0));
        let centre = corners.iter().sum::<DVec3>() / 3.0;
        for (goal, corner) in
            turned_rest(corners, &REST, || DVec3::Z, Rotation::LeastSquares).iter().zip(corners)
        {
            assert!((*goal + centre - corner).length() < 1e-12);
        }
    }

    #[test]
    fn a_stretched_triangle_keeps_its_direction() {
        let corners = placed(0.4, DVec3::ZERO).map(|p| p * 1.3);
        let goals = turned_rest(corners, &REST, || DVec3::Z, Rotation::LeastSquares);
        let exact = placed(0.4, DVec3::ZERO);
        for (goal, exact) in goals.iter().zip(exact) {
            assert!((*goal - exact).length() < 1e-12);
        }
    }

    /// The turn straight in space is the one in the plane.
    #[test]
    fn both_ways_to_the_least_squares_turn_agree() {
        let corners = [DVec3::new(0.2, 0.1, -0.4), DVec3::new(2.9, 0.6, 0.3), DVec3::new(-0.3, 3.1, 1.0)];
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let straight = turned_rest(corners, &REST, || DVec3::Z, Rotation::LeastSquares);
        let in_plane = turned_rest_facing(corners, &REST, normal, Rotation::LeastSquares);
        assert!(straight.iter().zip(in_plane).all(|(a, b)| (*a - b).length() < 1e-12));
    }

    #[test]
    fn a_flipped_triangle_is_turned_over_to_face_the_normal() {
        let corners = placed(0.0, DVec3::ZERO).map(|p| DVec3::new(p.y, p.x, p.z));
        let goals = turned_rest_facing(corners, &REST, DVec3::Z, Rotation::LeastSquares);
        assert!((goals[1] - goals[0]).cross(goals[2] - goals[0]).z > 0.0);
    }

    #[test]
    fn a_collapsed_triangle_gives_finite_goals() {
        for corners in [[DVec3::ONE; 3], [DVec3::ZERO, DVec3::X, DVec3::X * 2.0]] {
            let goals = turned_rest(corners, &REST, || DVec3::Y, Rotation::LeastSquares);
            assert!(goals.iter().all(|g| g.is_finite()));
            assert!((goals[1] - goals[0]).length() > 1.0);
        }
    }

    /// ALGORITHMS.md 1.A8: at 10 % of random strain the two turns differ by 0.19 degrees in the middle, by 1.3 at most in 99
    /// of 100 cases.
    #[test]
    fn the_papers_turn_is_close_to_the_least_squares_one() {
        let mut chance = 1u64;
        let mut next = || {
            chance = chance.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (chance >> 11) as f64 / (1u64 << 53) as f64 * 2.0 - 1.0
        };
        let mut apart: Vec<f64> = (0..2000)
            .map(|_| {
                let corners = placed(next() * 3.0, DVec3::ZERO);
                let strained = corners.map(|p| p + DVec3::new(next(), next(), 0.0) * 0.1 * 2.0);
                let [a, b] = [Rotation::LeastSquares, Rotation::Paper]
                    .map(|by| turned_rest(strained, &REST, || DVec3::Z, by))
                    .map(|goals| goals[1] - goals[0]);
                a.angle_between(b).to_degrees()
            })
            .collect();
        apart.sort_by(f64::total_cmp);
        assert!(apart[1000] > 0.02 && apart[1000] < 0.6, "{}", apart[1000]);
        assert!(apart[1980] > apart[1000] && apart[1980] < 2.5, "{}", apart[1980]);
    }
}
