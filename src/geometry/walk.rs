//! Straightest geodesics over a triangle mesh: triangles are unfolded one after the other (Polthier and Schmies
//! 1998).

use glam::DVec3;

use crate::geometry::adjacency::{Adjacency, NONE};
use crate::geometry::mesh::TriMesh;

/// Number of triangles after which a walk ends early.
const MOST_TRIANGLES: usize = 10_000;

/// The end of a walk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WalkEnd {
    /// The end point, metres: on the mesh, or, if the walk left it at a border, straight ahead of the border.
    pub point: DVec3,
    /// The last triangle of the walk.
    pub triangle: u32,
    /// Direction of the walk at its end, a unit vector; zero where the walk had no direction along the surface.
    pub direction: DVec3,
}

/// Walks `distance` metres along the surface from `start` on `triangle` towards `direction` (projected to the
/// triangle's plane). At a border the walk goes straight on in space. Where `direction` has no tangential part, it
/// ends at `start`.
pub fn straightest(
    mesh: &TriMesh,
    adjacency: &Adjacency,
    start: DVec3,
    triangle: u32,
    direction: DVec3,
    distance: f64,
) -> WalkEnd {
    let mut point = start;
    let mut triangle = triangle;
    let mut direction = in_plane(mesh, triangle, direction);
    let mut rest = distance;
    let mut entered = None;
    for _ in 0..MOST_TRIANGLES {
        if direction == DVec3::ZERO || rest <= 0.0 {
            break;
        }
        let Some((edge, step)) = exit(mesh, triangle, point, direction, entered) else { break };
        if step >= rest {
            break;
        }
        point += direction * step;
        rest -= step;
        let next = adjacency.across[triangle as usize][edge];
        if next == NONE {
            break;
        }
        let shared = adjacency.triangle_edges[triangle as usize][edge];
        let [a, b] = adjacency.edges[shared as usize].map(|v| mesh.positions[v as usize]);
        direction = unfolded(mesh, triangle, next, (b - a).normalize_or_zero(), direction);
        entered = adjacency.triangle_edges[next as usize].iter().position(|&e| e == shared);
        triangle = next;
    }
    WalkEnd { point: point + direction * rest, triangle, direction }
}

fn normal(mesh: &TriMesh, triangle: u32) -> DVec3 {
    let [a, b, c] = mesh.corners(triangle as usize);
    (b - a).cross(c - a).normalize_or_zero()
}

fn in_plane(mesh: &TriMesh, triangle: u32, direction: DVec3) -> DVec3 {
    let n = normal(mesh, triangle);
    (direction - n * n.dot(direction)).normalize_or_zero()
}

/// The edge (index of its first corner) through which a ray in the plane of the triangle leaves it, and the distance
/// to it.
fn exit(
    mesh: &TriMesh,
    triangle: u32,
    point: DVec3,
    direction: DVec3,
    entered: Option<usize>,
) -> Option<(usize, f64)> {
    let corners = mesh.corners(triangle as usize);
    let n = normal(mesh, triangle);
    let mut best: Option<(usize, f64)> = None;
    for k in 0..3 {
        if Some(k) == entered {
            continue;
        }
        let a = corners[k];
        let outward = (corners[(k + 1) % 3] - a).cross(n);
        let speed = direction.dot(outward);
        if speed <= 1e-14 * outward.length() {
            continue;
        }
        let step = ((a - point).dot(outward) / speed).max(0.0);
        if best.is_none_or(|(_, s)| step < s) {
            best = Some((k, step));
        }
    }
    best
}

/// `direction` turned about the shared edge from the plane of one triangle into that of the next.
fn unfolded(mesh: &TriMesh, from: u32, to: u32, edge: DVec3, direction: DVec3) -> DVec3 {
    let along = direction.dot(edge);
    let (n_from, n_to) = (normal(mesh, from), normal(mesh, to));
    let across = direction.dot(edge.cross(n_from));
    (edge * along + edge.cross(n_to) * across).normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cylinder of radius 1 about y, `n` flat facets round it.
    fn cylinder(n: u32) -> (TriMesh, Adjacency) {
        let mut mesh = TriMesh::default();
        for row in 0..=8 {
            for i in 0..n {
                let a = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
                mesh.positions.push(DVec3::new(a.sin(), f64::from(row) * 0.5, a.cos()));
            }
        }
        for row in 0..8 {
            for i in 0..n {
                let (a, b) = (row * n + i, row * n + (i + 1) % n);
                mesh.triangles.extend([[a, b, b + n], [a, b + n, a + n]]);
            }
        }
        let adjacency = Adjacency::new(mesh.positions.len(), &mesh.triangles);
        (mesh, adjacency)
    }

    #[test]
    fn a_walk_on_a_cylinder_is_a_helix() {
        let n = 200;
        let (mesh, adjacency) = cylinder(n);
        let start = (mesh.positions[0] + mesh.positions[1]) / 2.0;
        let (along, up) = (1.5, 2.0);
        // In the plane of the first facet.
        let (sin, cos) = (std::f64::consts::PI / f64::from(n)).sin_cos();
        let direction = DVec3::new(along * cos, up, -along * sin);
        let end = straightest(&mesh, &adjacency, start, 0, direction, direction.length());
        // On the prism the way round is measured along its facets.
        let facet = 2.0 * (std::f64::consts::PI / f64::from(n)).sin();
        let angle = (along / facet + 0.5) * std::f64::consts::TAU / f64::from(n);
        let exact = DVec3::new(angle.sin(), up, angle.cos());
        assert!((end.point - exact).length() < 2e-4, "{} {}", end.point, exact);
        assert!((end.direction.y - direction.normalize().y).abs() < 1e-9);
    }

    #[test]
    fn a_walk_leaves_the_border_straight() {
        let (mesh, adjacency) = cylinder(12);
        let start = mesh.corners(0).iter().sum::<DVec3>() / 3.0;
        let end = straightest(&mesh, &adjacency, start, 0, DVec3::Y, 10.0);
        assert!((end.point - start - DVec3::Y * 10.0).length() < 1e-9);
    }
}
