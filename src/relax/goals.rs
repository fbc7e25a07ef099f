//! Triangle matching: where each triangle would like its corners, with its flat shape laid over where they are.
//!
//! Paper A, "Relaxation"; the rotation is the least-squares one, theta = arg(sum z conj(w)), so that pulling every vertex to
//! the mean of its goals never raises the energy sum |x - c - R w|^2.

use glam::{DVec2, DVec3};

/// Corners of the flat shape `rest` (about its centroid, front up), turned in the plane of `corners` to lie closest to
/// them, relative to their centroid. `keep` is used where no turn is better than another (collapsed or mirrored).
pub fn turned_rest(corners: [DVec3; 3], rest: &[DVec2; 3], keep: DVec3) -> [DVec3; 3] {
    let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    in_plane(corners, centre, rest, area, keep)
}

/// The same in the plane across `normal` (paper A's temporary normal): a triangle that faces away from it is turned over.
pub fn turned_rest_facing(corners: [DVec3; 3], rest: &[DVec2; 3], normal: DVec3) -> [DVec3; 3] {
    let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    in_plane(corners, centre, rest, normal, normal)
}

fn in_plane(corners: [DVec3; 3], centre: DVec3, rest: &[DVec2; 3], normal: DVec3, keep: DVec3) -> [DVec3; 3] {
    let mut n = normal.normalize_or_zero();
    if n == DVec3::ZERO {
        n = keep.try_normalize().unwrap_or(DVec3::Z);
    }
    let edge = corners[1] - corners[0];
    let x = (edge - n * n.dot(edge)).try_normalize().unwrap_or_else(|| n.any_orthonormal_vector());
    let y = n.cross(x);
    let mut turn = DVec2::ZERO;
    let mut size = 0.0;
    for k in 0..3 {
        let z = DVec2::new((corners[k] - centre).dot(x), (corners[k] - centre).dot(y));
        let w = rest[k];
        turn += DVec2::new(z.dot(w), w.perp_dot(z));
        size += z.length() * w.length();
    }
    let length = turn.length();
    // Undefined for a mirrored triangle: its longest edge (here the first) keeps its direction.
    let turn = if length > 1e-3 * size && length > 0.0 {
        turn / length
    } else {
        let w = rest[1] - rest[0];
        DVec2::new(w.x, -w.y).normalize_or(DVec2::X)
    };
    rest.map(|w| {
        let r = turn.rotate(w);
        x * r.x + y * r.y
    })
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
        for (goal, corner) in turned_rest(corners, &REST, DVec3::Z).iter().zip(corners) {
            assert!((*goal + centre - corner).length() < 1e-12);
        }
    }

    #[test]
    fn a_stretched_triangle_keeps_its_direction() {
        let corners = placed(0.4, DVec3::ZERO).map(|p| p * 1.3);
        let goals = turned_rest(corners, &REST, DVec3::Z);
        let exact = placed(0.4, DVec3::ZERO);
        for (goal, exact) in goals.iter().zip(exact) {
            assert!((*goal - exact).length() < 1e-12);
        }
    }

    #[test]
    fn a_flipped_triangle_is_turned_over_to_face_the_normal() {
        let corners = placed(0.0, DVec3::ZERO).map(|p| DVec3::new(p.y, p.x, p.z));
        let goals = turned_rest_facing(corners, &REST, DVec3::Z);
        assert!((goals[1] - goals[0]).cross(goals[2] - goals[0]).z > 0.0);
    }

    #[test]
    fn a_collapsed_triangle_gives_finite_goals() {
        for corners in [[DVec3::ONE; 3], [DVec3::ZERO, DVec3::X, DVec3::X * 2.0]] {
            let goals = turned_rest(corners, &REST, DVec3::Y);
            assert!(goals.iter().all(|g| g.is_finite()));
            assert!((goals[1] - goals[0]).length() > 1.0);
        }
    }
}
