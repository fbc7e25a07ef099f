//! Rotation of the skin round each vertex of a body from one pose to another.
//!
//! The rotation of a triangle comes from the polar decomposition of its deformation gradient, with normal mapped to normal. It is
//! the full frame, not the smallest rotation between the normals, which would lose the rotation about them and is undefined for
//! opposite ones (ALGORITHMS.md 1.C). A vertex has the area-weighted mean of its triangles, so that neighbouring points of the
//! skin rotate alike.

use glam::{DMat3, DMat4, DQuat, DVec2, DVec3, DVec4};
use rayon::prelude::*;

use crate::body::Surface;
use crate::geometry::parallel::LEAST_SHARE;

/// Rotation at each of `vertices`; None where neither the vertex nor its triangles have moved.
pub(super) fn turns(from: &Surface, to: &Surface, vertices: &[u32]) -> Vec<Option<DQuat>> {
    let (before, after) = (&from.mesh.positions, &to.mesh.positions);
    let moved = |v: u32| before[v as usize] != after[v as usize];
    let turn = |&v: &u32| {
        let around = from.adjacency.vertex_triangles.of(v);
        if !around.iter().flat_map(|&t| from.mesh.triangles[t as usize]).any(moved) {
            return None;
        }
        let turns = around.iter().map(|&t| {
            let corners = from.mesh.corners(t as usize);
            (triangle_turn(corners, to.mesh.corners(t as usize)), area(corners))
        });
        Some(mean(turns))
    };
    vertices.par_iter().with_min_len(LEAST_SHARE).map(turn).collect()
}

/// Rotation of the body as a whole: the mean over its surface. By area, as the vertices of hands and face lie close together and may
/// be as many as all the others.
///
/// The mean is the eigenvector of the largest eigenvalue of Σ w q qᵀ, so that the signs of the quaternions do not matter (Markley,
/// Cheng, Crassidis and Oshman 2007, "Averaging Quaternions").
pub(super) fn whole_turn(from: &Surface, to: &Surface) -> DQuat {
    let squared = |t: usize| {
        let corners = from.mesh.corners(t);
        let turn = DVec4::from(triangle_turn(corners, to.mesh.corners(t)));
        DMat4::from_cols_array_2d(&turn.to_array().map(|part| (turn * part * area(corners)).to_array()))
    };
    let all: Vec<DMat4> =
        (0..from.mesh.triangles.len()).into_par_iter().with_min_len(LEAST_SHARE).map(squared).collect();
    let mut power = all.into_iter().fold(DMat4::ZERO, |sum, one| sum + one);
    // Squared thirty times the matrix has the eigenvector in every column, unless two eigenvalues are the same.
    for _ in 0..30 {
        let trace: f64 = (0..4).map(|k| power.col(k)[k]).sum();
        if trace <= f64::MIN_POSITIVE {
            return DQuat::IDENTITY;
        }
        power *= 1.0 / trace;
        power = power * power;
    }
    let longest =
        (0..4).map(|k| power.col(k)).max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    longest.and_then(DVec4::try_normalize).map_or(DQuat::IDENTITY, DQuat::from_vec4)
}

/// Weighted mean of rotations that are close to each other; the identity where there are none.
pub(super) fn mean(turns: impl Iterator<Item = (DQuat, f64)>) -> DQuat {
    let mut sum = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
    for (turn, weight) in turns {
        let near = if sum.dot(turn) < 0.0 { -turn } else { turn };
        sum += near * weight;
    }
    if sum.length_squared() > f64::MIN_POSITIVE { sum.normalize() } else { DQuat::IDENTITY }
}

fn area([a, b, c]: [DVec3; 3]) -> f64 {
    (b - a).cross(c - a).length() / 2.0
}

/// Rotation in the polar decomposition of the map that takes one triangle and its normal to the other.
pub(super) fn triangle_turn(from: [DVec3; 3], to: [DVec3; 3]) -> DQuat {
    let (Some((frame_from, flat_from)), Some((frame_to, flat_to))) = (framed(from), framed(to)) else {
        return DQuat::IDENTITY;
    };
    // In each plane the first side lies along x: the gradient is [[s, k], [0, t]], whose rotation has a closed form.
    let s = flat_to[0].x / flat_from[0].x;
    let k = (flat_to[1].x - s * flat_from[1].x) / flat_from[1].y;
    let t = flat_to[1].y / flat_from[1].y;
    let in_plane = DMat3::from_rotation_z(-k.atan2(s + t));
    DQuat::from_mat3(&(frame_to * in_plane * frame_from.transpose()))
}

/// Deformation gradient: the map that takes one triangle and its unit normal to the other. None where one of them has no area.
pub(super) fn gradient(from: [DVec3; 3], to: [DVec3; 3]) -> Option<DMat3> {
    framed(from)?;
    let columns = |[a, b, c]: [DVec3; 3]| {
        let normal = (b - a).cross(c - a);
        DMat3::from_cols(b - a, c - a, normal / normal.length())
    };
    framed(to).map(|_| columns(to) * columns(from).inverse())
}

/// Frame of a triangle (first side, perpendicular to it in the plane, normal), and the two sides from the first corner in that
/// frame.
fn framed([a, b, c]: [DVec3; 3]) -> Option<(DMat3, [DVec2; 2])> {
    let (u, v) = (b - a, c - a);
    let (length, normal) = (u.length(), u.cross(v));
    let size = normal.length();
    // Without a height it has no rotation.
    if size <= 1e-9 * length * length || length == 0.0 {
        return None;
    }
    let (x, z) = (u / length, normal / size);
    let frame = DMat3::from_cols(x, z.cross(x), z);
    Some((frame, [DVec2::new(length, 0.0), DVec2::new(v.dot(x), size / length)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::mesh::TriMesh;
    use crate::geometry::shapes::icosphere;

    const FROM: [DVec3; 3] =
        [DVec3::new(0.3, 0.1, -0.2), DVec3::new(1.2, 0.4, 0.1), DVec3::new(0.5, 1.1, 0.3)];

    #[test]
    fn a_turned_triangle_gives_its_turn_also_about_its_normal_and_over_its_head() {
        for axis in [DVec3::X, DVec3::new(1.0, 2.0, -0.5).normalize(), (FROM[1] - FROM[0]).normalize()] {
            for angle in [0.0, 1e-7, 0.4, 2.0, std::f64::consts::PI] {
                let turn = DQuat::from_axis_angle(axis, angle);
                let found = triangle_turn(FROM, FROM.map(|p| turn * p + DVec3::Y));
                assert!((found.dot(turn).abs() - 1.0).abs() < 1e-12, "{axis} {angle}");
            }
        }
    }

    #[test]
    fn a_stretch_turns_nothing() {
        let flat = FROM.map(|p| DVec3::new(p.x, p.y, 0.0));
        // A symmetric map in the plane is a stretch: its polar factor is the identity.
        let stretched = flat.map(|p| DVec3::new(1.4 * p.x + 0.3 * p.y, 0.3 * p.x + 0.9 * p.y, 0.0));
        let turn = triangle_turn(flat, stretched);
        assert!(turn.to_scaled_axis().length() < 1e-12, "{turn}");
    }

    #[test]
    fn a_collapsed_triangle_turns_nothing() {
        assert_eq!(triangle_turn([DVec3::ZERO; 3], FROM), DQuat::IDENTITY);
        assert_eq!(triangle_turn(FROM, [DVec3::ZERO, DVec3::X, DVec3::X * 2.0]), DQuat::IDENTITY);
    }

    #[test]
    fn the_turn_of_a_whole_body_is_that_of_its_larger_part_however_fine_the_other() {
        // A finely triangulated ball of 2 cm beside a coarse one of 30 cm.
        let (large, small) = (icosphere(0.3, 2), icosphere(0.02, 4));
        let count = large.positions.len();
        assert!(small.positions.len() > 10 * count);
        let placed = |turns: [DQuat; 2]| {
            let one = large.positions.iter().map(|p| turns[0] * *p);
            let other = small.positions.iter().map(|p| turns[1] * *p + DVec3::X);
            one.chain(other).collect::<Vec<_>>()
        };
        let others = small.triangles.iter().map(|t| t.map(|v| v + count as u32));
        let triangles = large.triangles.iter().copied().chain(others).collect();
        let mesh = TriMesh { positions: placed([DQuat::IDENTITY; 2]), triangles };
        let from = Surface::new(mesh).expect("two balls");
        let to = |turns| from.reposed(placed(turns)).expect("as many vertices");
        let (little, over) = (DQuat::from_rotation_z(0.2), DQuat::from_rotation_x(3.0));
        let found = whole_turn(&from, &to([little, over]));
        assert!(found.angle_between(little) < 0.03, "{}", found.angle_between(little));
        let found = whole_turn(&from, &to([over, over]));
        assert!(found.angle_between(over) < 1e-9, "{}", found.angle_between(over));
    }

    #[test]
    fn a_mean_is_halfway_whatever_the_signs() {
        let turn = |angle: f64| DQuat::from_rotation_y(angle);
        let found = mean([(turn(0.2), 1.0), (-turn(0.6), 1.0)].into_iter());
        assert!((found.dot(turn(0.4)).abs() - 1.0).abs() < 1e-12);
        assert_eq!(mean(std::iter::empty()), DQuat::IDENTITY);
    }
}
