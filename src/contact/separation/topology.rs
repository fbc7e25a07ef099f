//! The vertices, edges and triangles of a mesh, each owned by one triangle, so that a search over triangles finds every pair of
//! features once.

use glam::DVec3;

use crate::body::Surface;
use crate::geometry::adjacency::Adjacency;
use crate::geometry::bvh::{Aabb, Bvh};

/// A mesh whose features are looked for.
#[derive(Clone, Debug)]
pub(super) struct Topology {
    pub triangles: Vec<[u32; 3]>,
    /// The edges of each triangle: from corner k to the next.
    pub triangle_edges: Vec<[u32; 3]>,
    /// The ends of each edge.
    pub edges: Vec<[u32; 2]>,
    /// Of each triangle which corners (bits 0..3) and edges (bits 3..6) it owns.
    owned: Vec<u8>,
}

impl Topology {
    pub fn new(vertices: usize, triangles: &[[u32; 3]], adjacency: &Adjacency) -> Self {
        let mut owned = vec![0; triangles.len()];
        let mut known = vec![false; vertices];
        let mut known_edges = vec![false; adjacency.edges.len()];
        for (t, (vs, es)) in triangles.iter().zip(&adjacency.triangle_edges).enumerate() {
            for k in 0..3 {
                if !std::mem::replace(&mut known[vs[k] as usize], true) {
                    owned[t] |= 1 << k;
                }
                if !std::mem::replace(&mut known_edges[es[k] as usize], true) {
                    owned[t] |= 8 << k;
                }
            }
        }
        Self {
            triangles: triangles.to_vec(),
            triangle_edges: adjacency.triangle_edges.clone(),
            edges: adjacency.edges.clone(),
            owned,
        }
    }

    /// The vertices that triangle `t` owns.
    pub fn vertices_of(&self, t: u32) -> impl Iterator<Item = u32> {
        let (owned, vs) = (self.owned[t as usize], self.triangles[t as usize]);
        (0..3).filter(move |k| owned & (1 << k) != 0).map(move |k: usize| vs[k])
    }

    /// The edges that triangle `t` owns.
    pub fn edges_of(&self, t: u32) -> impl Iterator<Item = u32> {
        let (owned, es) = (self.owned[t as usize], self.triangle_edges[t as usize]);
        (0..3).filter(move |k| owned & (8 << k) != 0).map(move |k: usize| es[k])
    }

    /// The corners of triangle `t`.
    pub fn corners(&self, x: &[DVec3], t: u32) -> [DVec3; 3] {
        self.triangles[t as usize].map(|v| x[v as usize])
    }

    /// The ends of edge `e`.
    pub fn ends(&self, x: &[DVec3], e: u32) -> [DVec3; 2] {
        self.edges[e as usize].map(|v| x[v as usize])
    }
}

/// A mesh that does not move, in a tree.
#[derive(Debug)]
pub struct Obstacle {
    pub(super) topology: Topology,
    pub(super) positions: Vec<DVec3>,
    pub(super) boxes: Vec<Aabb>,
    pub(super) tree: Bvh,
}

impl Obstacle {
    /// Of a body.
    pub fn of(body: &Surface) -> Self {
        Self::new(&body.mesh.positions, &body.mesh.triangles, &body.adjacency)
    }

    /// Of a mesh at these `positions`, metres.
    pub fn new(positions: &[DVec3], triangles: &[[u32; 3]], adjacency: &Adjacency) -> Self {
        let boxes: Vec<Aabb> =
            triangles.iter().map(|vs| Aabb::around(&vs.map(|v| positions[v as usize]))).collect();
        Self {
            topology: Topology::new(positions.len(), triangles, adjacency),
            positions: positions.to_vec(),
            tree: Bvh::new(&boxes),
            boxes,
        }
    }
}
