//! Self-collision of cloth in implicit steps: vertex-triangle and edge-edge pairs, pushed apart by penalty springs.
//!
//! Pairs that could come into contact during a step are collected when it begins, with the side they are on; springs push towards
//! that side.

use glam::DMat3;
use glam::DVec3;
use rayon::prelude::*;

use crate::body::closest::closest_on_triangle;
use crate::drape::contact::pair::{Pair, segments_apart};
use crate::drape::sheet::Sheet;
use crate::geometry::bvh::{Aabb, Bvh};
use crate::geometry::parallel::LEAST_SHARE;

/// Factor on the expected displacements in a step, which widens the distance within which pairs are collected. Chosen by trial;
/// with more, pairs are collected that do not meet.
const LOOK_AHEAD: f64 = 1.5;

/// Candidate pairs of one step, and those in contact.
#[derive(Clone, Debug, Default)]
pub struct SelfContact {
    thickness: f64,
    pairs: Vec<Pair>,
    active: Vec<Push>,
    stiffness: Vec<f64>,
    /// Bounding volume hierarchies of triangles, edges and vertices.
    trees: [Bvh; 3],
    /// Candidate pairs tested since the start.
    pub looked_at: u64,
}

/// A pair in contact. Its distance is linear in its four vertices: n·Σ wᵢxᵢ.
#[derive(Clone, Copy, Debug)]
struct Push {
    vertices: [u32; 4],
    weights: [f64; 4],
    normal: DVec3,
    depth: f64,
    stiffness: f64,
}

/// Test of candidate pairs: which features of a sheet at `x`, with expected displacements `ways`, come near each other in the
/// step.
struct Near<'a> {
    sheet: &'a Sheet,
    x: &'a [DVec3],
    ways: &'a [DVec3],
    /// Distance, in metres, from which two features count as near, before their displacements are added.
    reach: f64,
}

impl Near<'_> {
    /// Whether features `a` and `b` share a vertex or are joined by an edge. Such pairs are left out: features that share a
    /// vertex cannot collide, and neighbours pushed apart at a sharp fold would fly off.
    fn hinged(&self, a: &[u32], b: &[u32]) -> bool {
        let neighbours = &self.sheet.adjacency.vertex_neighbours;
        let beside = |a: u32, b: u32| a == b || neighbours.of(a).binary_search(&b).is_ok();
        a.iter().any(|&a| b.iter().any(|&b| beside(a, b)))
    }

    /// Distance, in metres, up to which features `a` and `b` are a pair. Neighbouring cloth moves alike, so the largest
    /// difference of their displacements counts.
    fn apart(&self, a: &[u32], b: &[u32]) -> f64 {
        let way = |v: u32| self.ways[v as usize];
        let ways = a.iter().flat_map(|&a| b.iter().map(move |&b| way(a) - way(b)));
        self.reach + LOOK_AHEAD * ways.map(|w| w.length_squared()).fold(0.0, f64::max).sqrt()
    }

    /// The pair of vertex `v` and triangle `t`; None where it is too far apart or joined.
    fn corner(&self, v: u32, t: u32) -> Option<Pair> {
        let vs @ [a, b, c] = self.sheet.triangles[t as usize];
        if self.hinged(&[v], &vs) {
            return None;
        }
        let (p, [pa, pb, pc]) = (self.x[v as usize], vs.map(|i| self.x[i as usize]));
        let reach = self.apart(&[v], &vs);
        let side = (pb - pa).cross(pc - pa).dot(p - pa).signum();
        (closest_on_triangle(p, pa, pb, pc).0.distance(p) <= reach).then_some(Pair {
            vertices: [v, a, b, c],
            edges: false,
            side,
            reach,
        })
    }

    /// The pair of edges `e` and `f`; None where it is too far apart or joined.
    fn edges(&self, e: u32, f: u32) -> Option<Pair> {
        let [[a, b], [c, d]] = [e.min(f), e.max(f)].map(|e| self.sheet.adjacency.edges[e as usize]);
        if self.hinged(&[a, b], &[c, d]) {
            return None;
        }
        let ends = [a, b, c, d].map(|i| self.x[i as usize]);
        let reach = self.apart(&[a, b], &[c, d]);
        let [pa, pb, pc, pd] = ends;
        let side = (pb - pa).cross(pd - pc).dot(pc - pa).signum();
        (segments_apart(ends) <= reach).then_some(Pair { vertices: [a, b, c, d], edges: true, side, reach })
    }
}

impl SelfContact {
    /// Self-collision with a collision thickness in metres and contact stiffness per vertex, N/m. A thickness of zero turns it
    /// off.
    pub fn new(sheet: &Sheet, thickness: f64, stiffness: Vec<f64>) -> Self {
        // Thicker, and neighbours in flat cloth would be in contact.
        let thickness = thickness.min(0.7 * sheet.mean_edge());
        Self { thickness, stiffness, ..Self::default() }
    }

    /// Collects the pairs that could collide while the vertices at `x` move by about `ways`, and `slack` metres more.
    pub fn gather(&mut self, sheet: &Sheet, x: &[DVec3], ways: &[DVec3], slack: f64) {
        self.pairs.clear();
        self.active.clear();
        if self.thickness == 0.0 {
            return;
        }
        let drift = ways.iter().sum::<DVec3>() / ways.len() as f64;
        let near = self.thickness + slack;
        let grown = |vs: &[u32]| {
            let now = vs.iter().map(|&v| x[v as usize]);
            let then = vs.iter().map(|&v| x[v as usize] + (ways[v as usize] - drift) * LOOK_AHEAD);
            let points = Aabb::around(&now.chain(then).collect::<Vec<_>>());
            Aabb { lower: points.lower - near / 2.0, upper: points.upper + near / 2.0 }
        };
        let near = Near { sheet, x, ways, reach: near };
        let of_triangles: Vec<Aabb> = sheet.triangles.par_iter().map(|vs| grown(vs)).collect();
        refit(&mut self.trees[0], &of_triangles);
        let of_vertices: Vec<Aabb> = (0..x.len() as u32).into_par_iter().map(|v| grown(&[v])).collect();
        refit(&mut self.trees[2], &of_vertices);
        let edges = &sheet.adjacency.edges;
        let boxes: Vec<Aabb> = edges.par_iter().map(|e| grown(e)).collect();
        refit(&mut self.trees[1], &boxes);
        let [triangles, tree, vertices] = &self.trees;
        let leaves: Vec<u32> = vertices.leaves().collect();
        let at_corners = leaves.par_iter().with_min_len(LEAST_SHARE).map(|&leaf| {
            let (mut pairs, mut looked_at) = (Vec::new(), 0u64);
            let mut see = |v: u32, t: u32| {
                looked_at += 1;
                pairs.extend(near.corner(v, t));
            };
            triangles.leaves_near(&vertices.nodes[leaf as usize].bounds, |other| {
                each_that_meets(
                    [vertices, triangles],
                    [&of_vertices, &of_triangles],
                    [leaf, other],
                    &mut see,
                );
            });
            (pairs, looked_at)
        });
        let mut found: Vec<(Vec<Pair>, u64)> = at_corners.collect();
        let nodes = (0..tree.nodes.len() as u32).into_par_iter().with_min_len(LEAST_SHARE);
        let at_edges = nodes.map(|node| {
            let (mut pairs, mut looked_at) = (Vec::new(), 0u64);
            let mut see = |e: u32, f: u32| {
                looked_at += 1;
                pairs.extend(near.edges(e, f));
            };
            tree.leaves_between(node, |one, other| {
                each_that_meets([tree; 2], [&boxes; 2], [one, other], &mut see);
            });
            (pairs, looked_at)
        });
        found.par_extend(at_edges);
        self.looked_at += found.iter().map(|(_, looked_at)| looked_at).sum::<u64>();
        self.pairs = found.into_iter().flat_map(|(pairs, _)| pairs).collect();
        // Sorted, because the traversal order of a tree means nothing.
        self.pairs.sort_by_key(Pair::key);
    }

    /// Adds the gradient of the contact energy at `x`, N, and returns the energy, J.
    pub fn add_gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        self.active.clear();
        let mut energy = 0.0;
        for pair in &self.pairs {
            let Some((weights, normal, distance)) = pair.found(x) else { continue };
            let depth = self.thickness - distance;
            if depth <= 0.0 || distance < -pair.reach {
                continue;
            }
            let share = |(v, w): (&u32, &f64)| w.abs() * self.stiffness[*v as usize];
            let stiffness = pair.vertices.iter().zip(&weights).map(share).sum::<f64>() / 2.0;
            energy += stiffness * depth * depth / 2.0;
            for (&v, w) in pair.vertices.iter().zip(weights) {
                gradient[v as usize] -= normal * (w * depth * stiffness);
            }
            self.active.push(Push { vertices: pair.vertices, weights, normal, depth, stiffness });
        }
        energy
    }

    /// Diagonal blocks that bound the Hessian from above, N/m. They stand in for the blocks between vertices, so that the
    /// sparsity pattern of the matrix does not change.
    pub fn hessian(&self, mut block: impl FnMut(u32, DMat3)) {
        for push in &self.active {
            let n = push.normal;
            let outer = DMat3::from_cols(n * n.x, n * n.y, n * n.z);
            let whole: f64 = push.weights.iter().map(|w| w.abs()).sum();
            for (&v, w) in push.vertices.iter().zip(push.weights) {
                block(v, outer * (push.stiffness * w.abs() * whole));
            }
        }
    }

    /// Sets `touching` for the vertices of all pairs in contact.
    pub fn mark_touching(&self, touching: &mut [bool]) {
        for push in &self.active {
            push.vertices.iter().for_each(|&v| touching[v as usize] = true);
        }
    }

    /// Largest penetration into the thickness, metres.
    pub fn deepest(&self) -> f64 {
        self.active.iter().map(|p| p.depth).fold(0.0, f64::max)
    }
}

/// Calls `found` for every two items whose `boxes` overlap, one from each of two leaves. Within a single leaf every pair is
/// visited once.
fn each_that_meets(trees: [&Bvh; 2], boxes: [&[Aabb]; 2], leaves: [u32; 2], mut found: impl FnMut(u32, u32)) {
    let [ones, others] = [0, 1].map(|k| trees[k].items_of(leaves[k]));
    let bounds = &trees[1].nodes[leaves[1] as usize].bounds;
    let alone = std::ptr::eq(ones, others);
    for (k, &i) in ones.iter().enumerate() {
        let own = &boxes[0][i as usize];
        if own.meets(bounds) {
            let others = if alone { &others[k + 1..] } else { others };
            others.iter().filter(|&&j| boxes[1][j as usize].meets(own)).for_each(|&j| found(i, j));
        }
    }
}

/// Updates a tree for moved boxes. Cloth keeps its neighbours, so the tree's structure stays good.
fn refit(tree: &mut Bvh, boxes: &[Aabb]) {
    match tree.items.len() == boxes.len() {
        true => tree.refit(boxes),
        false => *tree = Bvh::new(boxes),
    }
}
