//! Straightest walks against closed forms: B21.

use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use toile::body::Surface;
use toile::geometry::mesh::TriMesh;
use toile::geometry::walk::{WalkEnd, straightest};

use super::shapes::{ball, cone};
use crate::common::exact::cylinder;

fn walk(body: &Surface, start: DVec3, direction: DVec3, distance: f64) -> WalkEnd {
    let near = body.nearest(start);
    straightest(&body.mesh, &body.adjacency, near.point, near.triangle, direction, distance)
}

fn body(mesh: TriMesh) -> Surface {
    Surface::new(mesh).expect("a body")
}

/// `side` x `side` squares of 0.1 m in the plane y = 0, with crooked inner vertices.
fn sheet(side: u32) -> TriMesh {
    let mut mesh = TriMesh::default();
    for i in 0..=side {
        for j in 0..=side {
            let inner = i > 0 && j > 0 && i < side && j < side;
            let crooked =
                if inner { 0.03 * DVec2::from_angle(f64::from(i * 7 + j * 13)) } else { DVec2::ZERO };
            let p = DVec2::new(f64::from(i), f64::from(j)) * 0.1 + crooked;
            mesh.positions.push(DVec3::new(p.x, 0.0, p.y));
        }
    }
    let n = side + 1;
    for i in 0..side {
        for j in 0..side {
            let a = i * n + j;
            mesh.triangles.extend([[a, a + 1, a + n + 1], [a, a + n + 1, a + n]]);
        }
    }
    mesh
}

/// Where a walk on the unfolded side of a regular `round`-sided cone ends: facets are folded back one by one.
fn on_pyramid(half: f64, round: u32, start: DVec2, step: DVec2) -> DVec3 {
    // In a facet: x level from its middle, y up to the apex at the slant height.
    let facet = PI / f64::from(round);
    let (foot, height) = (half.tan() * facet.cos(), 1.0);
    let slant = foot.hypot(height);
    let opening = 2.0 * (half.tan() * facet.sin() / slant).atan();
    // Polar about the apex; the angle grows with the azimuth.
    let end = start + step - DVec2::new(0.0, slant);
    let (rho, turn) = (end.length(), end.x.atan2(-end.y));
    let whole = (turn / opening).round();
    let left = turn - whole * opening;
    let azimuth = whole * 2.0 * facet;
    let down = DVec3::new(foot / slant * azimuth.sin(), -height / slant, foot / slant * azimuth.cos());
    let level = DVec3::new(azimuth.cos(), 0.0, -azimuth.sin());
    DVec3::Y + down * (rho * left.cos()) + level * (rho * left.sin())
}

proptest! {
    #[test]
    fn on_a_plane_it_is_a_line(from in [0.2..0.8f64, 0.2..0.8f64], turn in 0.0..TAU, far in 0.0..3.0f64) {
        static SHEET: LazyLock<Surface> = LazyLock::new(|| body(sheet(10)));
        let start = DVec3::new(from[0], 0.0, from[1]);
        let direction = DVec3::new(turn.cos(), 0.0, turn.sin());
        let end = walk(&SHEET, start, direction, far);
        prop_assert!((end.point - start - direction * far).length() < 1e-9);
        prop_assert!((end.direction - direction).length() < 1e-9);
    }

    #[test]
    fn on_a_cylinder_it_is_a_helix(up in -0.3..0.3f64, along in -1.2..1.2f64) {
        const RADIUS: f64 = 0.15;
        const ROUND: u32 = 720;
        static BODY: LazyLock<Surface> = LazyLock::new(|| body(cylinder(RADIUS, 1.0, ROUND, 40)));
        let (radius, round) = (RADIUS, ROUND);
        let half = PI / f64::from(round);
        let facet = 2.0 * radius * half.sin();
        // Azimuths are measured from the middle of the first facet.
        let place = |way: f64, y: f64| {
            let whole = (way / facet).round();
            let angle = half + whole * 2.0 * half;
            let middle = DVec3::new(angle.sin(), 0.0, angle.cos()) * (radius * half.cos());
            middle + DVec3::new(angle.cos(), 0.0, -angle.sin()) * (way - whole * facet) + DVec3::Y * y
        };
        let start = place(1e-4 * facet, 0.5123);
        let direction = DVec3::new(half.cos(), 0.0, -half.sin()) * along + DVec3::Y * up;
        let end = walk(&BODY, start, direction, direction.length());
        prop_assert!((end.point - place(along + 1e-4 * facet, 0.5123 + up)).length() < 1e-9);
        // And of the round cylinder it is as near as the facets are.
        let angle = half + along / radius;
        let helix = DVec3::new(radius * angle.sin(), 0.5123 + up, radius * angle.cos());
        prop_assert!((end.point - helix).length() < 3e-5, "{}", (end.point - helix).length());
    }

    #[test]
    fn on_a_cone_it_is_a_line_of_the_unfolded_one(turn in 0.0..TAU, far in 0.0..0.25f64) {
        const HALF: f64 = 0.4;
        const ROUND: u32 = 300;
        static BODY: LazyLock<Surface> = LazyLock::new(|| body(cone(HALF, 30, ROUND)));
        let (half, round) = (HALF, ROUND);
        let facet = PI / f64::from(round);
        let slant = 1f64.hypot(half.tan() * facet.cos());
        let start = DVec2::new(1e-4, 0.45 * slant);
        // Facets here have their middles at odd multiples of half their width.
        let unturned = |p: DVec3| glam::DQuat::from_rotation_y(facet) * p;
        let begin = unturned(on_pyramid(half, round, start, DVec2::ZERO));
        let ahead = unturned(on_pyramid(half, round, start, DVec2::from_angle(turn) * 1e-7)) - begin;
        let end = walk(&BODY, begin, ahead, far);
        let exact = unturned(on_pyramid(half, round, start, DVec2::from_angle(turn) * far));
        prop_assert!((end.point - exact).length() < 1e-6, "{} {exact}", end.point);
    }
}

/// Great circles, as near as flat triangles allow: a straightest way passes each vertex on one side or the other, so that the
/// error falls with the length of the edges and no faster.
#[test]
fn on_a_sphere_it_is_a_great_circle() {
    let mut errors = Vec::new();
    for rings in [24, 48, 96] {
        let body = body(ball(1.0, rings, 2 * rings));
        let mut worst = 0.0f64;
        for k in 0..40 {
            let k = f64::from(k);
            // Away from the poles of the mesh, where its triangles are needles.
            let (sin, cos) = (k * 0.7).sin_cos();
            let start = DVec3::new(sin * 0.98, 0.2 * (k * 1.3).sin(), cos * 0.98).normalize();
            let east = DVec3::Y.cross(start).normalize();
            let turn = 0.9 * (k * 2.1).sin();
            let direction = (east * turn.cos() + start.cross(east) * turn.sin()).normalize();
            let far = 1.0f64;
            let exact = start * far.cos() + direction * far.sin();
            worst = worst.max((walk(&body, start, direction, far).point.normalize() - exact).length());
        }
        errors.push(worst);
    }
    println!("{errors:?}");
    assert!(errors[2] < 4e-3, "{errors:?}");
    assert!(errors[0] / errors[2] > 4.0, "{errors:?}");
}
