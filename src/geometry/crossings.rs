//! Intersections of edges with triangles: exact tests on candidates from a bounding volume hierarchy.

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::bvh::{Aabb, Bvh};
use crate::geometry::mesh::TriMesh;
use crate::geometry::parallel::LEAST_SHARE;

/// Determinant (cubic metres) up to which a segment counts as parallel to a triangle and does not meet it.
const PARALLEL: f64 = 1e-18;

/// Whether the segment from `p` to `q` meets triangle `abc`, borders included (Möller and Trumbore 1997).
pub fn segment_meets_triangle([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
    let (d, e1, e2) = (q - p, b - a, c - a);
    let h = d.cross(e2);
    let det = e1.dot(h);
    if det.abs() <= PARALLEL {
        return false;
    }
    let s = p - a;
    let u = s.dot(h) / det;
    let k = s.cross(e1);
    let v = d.dot(k) / det;
    let t = e2.dot(k) / det;
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (0.0..=1.0).contains(&t)
}

/// Pairs (index in `edges`, triangle of `mesh`) that intersect, ascending. `tree` is over the triangles of `mesh`.
pub fn meetings(edge_positions: &[DVec3], edges: &[[u32; 2]], mesh: &TriMesh, tree: &Bvh) -> Vec<[u32; 2]> {
    let Some(all) = tree.nodes.first().map(|root| root.bounds) else {
        return Vec::new();
    };
    edges
        .par_iter()
        .enumerate()
        .with_min_len(LEAST_SHARE)
        .flat_map_iter(|(e, ends)| {
            let segment = ends.map(|v| edge_positions[v as usize]);
            let mut found = Vec::new();
            if Aabb::around(&segment).meets(&all) {
                tree.along(segment, |t| {
                    if segment_meets_triangle(segment, mesh.corners(t as usize)) {
                        found.push([e as u32, t]);
                    }
                });
            }
            found.sort_unstable();
            found
        })
        .collect()
}

/// Self-intersections of a mesh: pairs (index in `edges`, triangle) that intersect without sharing a vertex,
/// ascending. `edges` are all edges of `mesh`, each with its lower vertex first, ascending; `tree` is over the
/// triangles.
pub fn self_crossings(mesh: &TriMesh, edges: &[[u32; 2]], tree: &Bvh) -> Vec<[u32; 2]> {
    let boxes = mesh.boxes();
    let nodes = (0..tree.nodes.len() as u32).into_par_iter().with_min_len(LEAST_SHARE);
    let mut found: Vec<[u32; 2]> = nodes
        .flat_map_iter(|node| {
            let mut found = Vec::new();
            tree.leaves_between(node, |one, other| {
                let [ones, others] = [one, other].map(|leaf| tree.items_of(leaf));
                for (k, &s) in ones.iter().enumerate() {
                    let others = if one == other { &others[k + 1..] } else { others };
                    for &t in others.iter().filter(|&&t| boxes[t as usize].meets(&boxes[s as usize])) {
                        find_through(mesh, edges, &boxes, [s, t], &mut found);
                        find_through(mesh, edges, &boxes, [t, s], &mut found);
                    }
                }
            });
            found
        })
        .collect();
    found.sort_unstable();
    // An edge between two triangles was found from both.
    found.dedup();
    found
}

/// Adds to `found` the edges of triangle `s` that pass through triangle `t` and share no vertex with it.
fn find_through(
    mesh: &TriMesh,
    edges: &[[u32; 2]],
    boxes: &[Aabb],
    [s, t]: [u32; 2],
    found: &mut Vec<[u32; 2]>,
) {
    let [corners, others] = [s, t].map(|t| mesh.triangles[t as usize]);
    let shared = corners.map(|v| others.contains(&v));
    for k in 0..3 {
        let after = (k + 1) % 3;
        if shared[k] || shared[after] {
            continue;
        }
        let edge = [corners[k].min(corners[after]), corners[k].max(corners[after])];
        let segment = edge.map(|v| mesh.positions[v as usize]);
        if Aabb::around(&segment).meets(&boxes[t as usize])
            && segment_meets_triangle(segment, mesh.corners(t as usize))
            && let Ok(e) = edges.binary_search(&edge)
        {
            found.push([e as u32, t]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::adjacency::Adjacency;

    const TRIANGLE: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    #[test]
    fn a_segment_meets_a_triangle_or_not() {
        let through =
            |x, y| segment_meets_triangle([DVec3::new(x, y, -1.0), DVec3::new(x, y, 2.0)], TRIANGLE);
        assert!(through(0.25, 0.25) && through(0.0, 0.0) && through(0.5, 0.5));
        assert!(!through(0.6, 0.5) && !through(-0.1, 0.2) && !through(0.2, -0.1));
        // It ends before the triangle, or lies in its plane.
        assert!(!segment_meets_triangle([DVec3::splat(0.2), DVec3::new(0.2, 0.2, 0.1)], TRIANGLE));
        assert!(!segment_meets_triangle([DVec3::new(-1.0, 0.2, 0.0), DVec3::new(1.0, 0.2, 0.0)], TRIANGLE));
    }

    /// A sheet of `n` by `n` squares with a wave that folds over itself.
    fn folded_sheet(n: u32) -> TriMesh {
        let mut mesh = TriMesh::default();
        for i in 0..=n {
            for k in 0..=n {
                let (x, y) = (f64::from(i) / f64::from(n), f64::from(k) / f64::from(n));
                mesh.positions.push(DVec3::new(x + 0.3 * (9.0 * x + y).sin(), y, 0.2 * (9.0 * x).cos()));
            }
        }
        for i in 0..n {
            for k in 0..n {
                let a = i * (n + 1) + k;
                mesh.triangles.extend([[a, a + n + 1, a + 1], [a + 1, a + n + 1, a + n + 2]]);
            }
        }
        mesh
    }

    #[test]
    fn the_tree_misses_nothing() {
        let mesh = folded_sheet(14);
        let edges = Adjacency::new(mesh.positions.len(), &mesh.triangles).edges;
        let mut exact = 0;
        for e in &edges {
            for (t, corners) in mesh.triangles.iter().enumerate() {
                let apart = !e.iter().any(|v| corners.contains(v));
                let segment = e.map(|v| mesh.positions[v as usize]);
                exact += usize::from(apart && segment_meets_triangle(segment, mesh.corners(t)));
            }
        }
        assert!(exact > 0);
        assert_eq!(self_crossings(&mesh, &edges, &mesh.tree()).len(), exact);
    }
}
