//! Body self-intersection exclusion. Parts of a posed body may intersect, such as a forearm and the trunk: cloth that
//! belongs to one part then ignores the skin of the other there, and the other part may come through it.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::body::Surface;
use crate::geometry::adjacency::NONE;
use crate::geometry::disjoint_sets::DisjointSets;

/// Distance along the skin from a self-intersection within which the intersecting parts exclude each other, metres on a body 1.5 m
/// large. Chosen by trial; it bounds how much of the other part's skin cloth ignores.
const REACH: f64 = 0.15;
/// Distance along the skin within which intersections belong to one part, metres on a body 1.5 m large. A fold whose
/// two sides are so near intersects only itself, and excludes nothing.
const ONE_PART: f64 = 0.06;

/// Which skin each cloth vertex ignores in contact.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BodyOverlaps {
    /// The part that each vertex of the cloth belongs to; [`NONE`] away from self-intersections.
    of_vertex: Vec<u32>,
    /// The part that each triangle of the body is of; [`NONE`] away from self-intersections.
    of_triangle: Vec<u32>,
    /// For each two parts whether they intersect; a square matrix, row by row.
    cross: Vec<bool>,
    parts: usize,
}

impl BodyOverlaps {
    /// Finds the intersecting parts of a body; None where there are none. `bound` gives for each cloth vertex the
    /// triangle of the body to which it belongs.
    pub fn of(surface: &Surface, bound: &[Option<u32>]) -> Option<Self> {
        let (mesh, edges) = (&surface.mesh, &surface.adjacency.edges);
        let crossings = surface.self_crossings();
        let mut sets = DisjointSets::new(mesh.positions.len());
        let mut seeds = Vec::new();
        for &[e, t] in crossings {
            for &at in surface.adjacency.edge_triangles.of(e).iter().chain([&t]) {
                let [a, b, c] = mesh.triangles[at as usize];
                sets.join(a, b);
                sets.join(a, c);
                seeds.extend([a, b, c]);
            }
        }
        seeds.sort_unstable();
        seeds.dedup();
        let (nearest, far) = grown(surface, &seeds);
        for &[a, b] in edges {
            let [p, q] = [a, b].map(|v| nearest[v as usize]);
            let length = mesh.positions[a as usize].distance(mesh.positions[b as usize]);
            let between = far[a as usize] + length + far[b as usize];
            if p != NONE && q != NONE && between < ONE_PART * surface.scale() {
                sets.join(p, q);
            }
        }
        let mut roots: Vec<u32> = seeds.iter().map(|&v| sets.root(v)).collect();
        roots.sort_unstable();
        roots.dedup();
        let mut part = |v: u32| match nearest[v as usize] {
            NONE => NONE,
            seed => roots.binary_search(&sets.root(seed)).map_or(NONE, |at| at as u32),
        };
        let parts = roots.len();
        let mut cross = vec![false; parts * parts];
        for &[e, t] in crossings {
            let [p, q] = [edges[e as usize][0], mesh.triangles[t as usize][0]].map(|v| part(v) as usize);
            if p != q {
                (cross[p * parts + q], cross[q * parts + p]) = (true, true);
            }
        }
        if !cross.contains(&true) {
            return None;
        }
        let of_triangle: Vec<u32> = mesh.triangles.iter().map(|corners| part(corners[0])).collect();
        let of_vertex = bound.iter().map(|bound| bound.map_or(NONE, |t| of_triangle[t as usize])).collect();
        Some(Self { of_vertex, of_triangle, cross, parts })
    }

    /// Whether another part of the body passes through it at `triangle` or near it.
    pub fn is_crossed(&self, triangle: u32) -> bool {
        let part = self.of_triangle[triangle as usize];
        part != NONE && self.cross[part as usize * self.parts..][..self.parts].contains(&true)
    }

    /// Whether cloth vertex `vertex` ignores `triangle` of the body.
    pub fn leaves_out(&self, vertex: usize, triangle: u32) -> bool {
        let [p, q] = [self.of_vertex[vertex], self.of_triangle[triangle as usize]];
        p != NONE && q != NONE && self.cross[p as usize * self.parts + q as usize]
    }
}

/// For each vertex of the body the nearest of `seeds` along the edges, up to [`REACH`], and the distance to it, metres.
fn grown(surface: &Surface, seeds: &[u32]) -> (Vec<u32>, Vec<f64>) {
    let positions = &surface.mesh.positions;
    let reach = REACH * surface.scale();
    let (mut nearest, mut far) = (vec![NONE; positions.len()], vec![f64::INFINITY; positions.len()]);
    // Distances are not negative, so that their bits sort as they do.
    let mut open: BinaryHeap<Reverse<(u64, u32)>> = BinaryHeap::new();
    for &v in seeds {
        (nearest[v as usize], far[v as usize]) = (v, 0.0);
        open.push(Reverse((0, v)));
    }
    while let Some(Reverse((bits, v))) = open.pop() {
        let so_far = f64::from_bits(bits);
        if so_far > far[v as usize] {
            continue;
        }
        for &w in surface.adjacency.vertex_neighbours.of(v) {
            let next = so_far + positions[v as usize].distance(positions[w as usize]);
            if next < far[w as usize] && next <= reach {
                (nearest[w as usize], far[w as usize]) = (nearest[v as usize], next);
                open.push(Reverse((next.to_bits(), w)));
            }
        }
    }
    (nearest, far)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::mesh::TriMesh;
    use crate::geometry::shapes::cylinder;
    use glam::DVec3;

    fn trunk() -> TriMesh {
        cylinder(0.15, 1.5, 48, 60)
    }

    /// A trunk 0.3 m thick along y, and an arm 0.1 m thick beside it, `apart` metres from axis to axis.
    fn trunk_and_arm(apart: f64) -> Surface {
        let mut mesh = trunk();
        let (arm, first) = (cylinder(0.05, 1.5, 24, 60), mesh.positions.len() as u32);
        // Laid over, so that it passes the trunk in one place.
        mesh.positions.extend(arm.positions.iter().map(|p| DVec3::new(p.z + apart, p.x + 0.7, p.y - 0.75)));
        mesh.triangles.extend(arm.triangles.iter().map(|t| t.map(|v| v + first)));
        Surface::new(mesh).expect("a body")
    }

    #[test]
    fn parts_that_do_not_meet_are_all_touched() {
        assert_eq!(BodyOverlaps::of(&trunk_and_arm(0.25), &[Some(0)]), None);
    }

    #[test]
    fn cloth_of_a_trunk_is_not_pushed_by_an_arm_that_runs_through_it() {
        let surface = trunk_and_arm(0.17);
        let trunk = trunk().triangles.len() as u32;
        let at = |p: DVec3, own: &dyn Fn(u32) -> bool| {
            let all = surface.nearest_round_about(p, 0.2);
            all.iter().map(|&(_, t)| t).find(|&t| own(t)).expect("skin")
        };
        let of_trunk = at(DVec3::new(0.15, 0.7, 0.0), &|t| t < trunk);
        let of_arm = at(DVec3::new(0.12, 0.7, 0.0), &|t| t >= trunk);
        let elsewhere = surface.nearest(DVec3::new(-0.15, 0.1, 0.0)).triangle;
        let bound = [Some(of_trunk), Some(of_arm), Some(elsewhere), None];
        let apart = BodyOverlaps::of(&surface, &bound).expect("they cross");
        assert!(apart.leaves_out(0, of_arm) && !apart.leaves_out(0, of_trunk), "cloth of the trunk");
        assert!(apart.leaves_out(1, of_trunk) && !apart.leaves_out(1, of_arm), "cloth of the arm");
        assert!(!apart.leaves_out(0, elsewhere), "skin far from where they cross");
        assert!([2, 3].iter().all(|&v| !apart.leaves_out(v, of_arm)), "cloth that is bound elsewhere");
    }
}
