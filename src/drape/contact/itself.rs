//! Cloth against itself in implicit steps: vertices against triangles and edges against edges, pushed apart by springs.
//!
//! Pairs that could meet in a step are gathered when it begins, with the side they are on; the springs push to that side.

use glam::DMat3;
use glam::DVec3;
use rayon::prelude::*;

use crate::body::closest::closest_on_triangle;
use crate::drape::contact::pair::{Pair, segments_apart};
use crate::drape::sheet::Sheet;
use crate::geometry::bvh::{Aabb, Bvh};

/// Of the mean edge: nearer than this in the flat cloth is no contact.
const MOST_THICKNESS: f64 = 0.7;

/// Of a vertex's expected way that is looked over.
const LOOK_AHEAD: f64 = 1.5;

/// Vertices or edges one thread takes at a time.
const LEAST_SHARE: usize = 256;

/// What may meet in one step, and what does.
#[derive(Clone, Debug, Default)]
pub struct SelfContact {
    thickness: f64,
    pairs: Vec<Pair>,
    active: Vec<Push>,
    stiffness: Vec<f64>,
    /// Of triangles, of edges and of vertices.
    trees: [Bvh; 3],
    /// Pairs looked at since the start.
    pub looked_at: u64,
}

/// Distance as a sum over four vertices: n·Σ w x.
#[derive(Clone, Copy, Debug)]
struct Push {
    vertices: [u32; 4],
    weights: [f64; 4],
    normal: DVec3,
    depth: f64,
    stiffness: f64,
}

/// Which features of a sheet at `x` that goes its `ways` come near each other.
struct Near<'a> {
    sheet: &'a Sheet,
    x: &'a [DVec3],
    ways: &'a [DVec3],
    /// Metres, besides what they go.
    reach: f64,
}

impl Near<'_> {
    /// What is joined bends like a hinge and cannot meet. What is beside one another is left alone, too: bent sharply it would
    /// fly apart.
    fn hinged(&self, a: &[u32], b: &[u32]) -> bool {
        let neighbours = &self.sheet.adjacency.vertex_neighbours;
        let beside = |a: u32, b: u32| a == b || neighbours.of(a).binary_search(&b).is_ok();
        a.iter().any(|&a| b.iter().any(|&b| beside(a, b)))
    }

    /// So near they count. Neighbours in the cloth move alike: what counts is how much farther the one goes than the other.
    fn apart(&self, a: &[u32], b: &[u32]) -> f64 {
        let way = |v: u32| self.ways[v as usize];
        let ways = a.iter().flat_map(|&a| b.iter().map(move |&b| way(a) - way(b)));
        self.reach + LOOK_AHEAD * ways.map(|w| w.length_squared()).fold(0.0, f64::max).sqrt()
    }

    /// Vertex `v` at triangle `t`.
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

    /// Edges `e` and `f` at each other.
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
    /// Cloth that keeps `thickness` metres from itself; contact stiffness per vertex, N/m. Thickness zero: it passes through.
    pub fn new(sheet: &Sheet, thickness: f64, stiffness: Vec<f64>) -> Self {
        let thickness = thickness.min(MOST_THICKNESS * sheet.mean_edge());
        Self { thickness, stiffness, ..Self::default() }
    }

    /// Gathers what could meet while the vertices at `x` move about as far as `ways` and `slack` metres more.
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
        // The order of a tree is no order of meaning.
        self.pairs.sort_by_key(Pair::key);
    }

    /// Adds the gradient at `x`, N, and gives the energy, J.
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

    /// Blocks on the diagonal that bound the Hessian from above, N/m: those between vertices are left to them, so that the
    /// matrix keeps its pattern.
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

    /// Whether anything of the cloth pushes vertex by vertex.
    pub fn mark_touching(&self, touching: &mut [bool]) {
        for push in &self.active {
            push.vertices.iter().for_each(|&v| touching[v as usize] = true);
        }
    }

    /// Largest depth into the thickness, metres.
    pub fn deepest(&self) -> f64 {
        self.active.iter().map(|p| p.depth).fold(0.0, f64::max)
    }
}

/// Calls `found` for every two items whose `boxes` meet, one of a leaf of the one tree and one of the other's; of one leaf alone
/// for every two of it once.
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

/// Cloth keeps its neighbours: a tree made once stays a good one.
fn refit(tree: &mut Bvh, boxes: &[Aabb]) {
    match tree.items.len() == boxes.len() {
        true => tree.refit(boxes),
        false => *tree = Bvh::new(boxes),
    }
}
