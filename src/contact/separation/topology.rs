//! Vertices, edges and triangles of a mesh, each vertex and edge owned by one triangle, so that a search over
//! triangles finds every pair of features once.

use glam::DVec3;

use crate::body::Surface;
use crate::contact::separation::broad::Broad;
use crate::geometry::adjacency::Adjacency;
use crate::geometry::bvh::Aabb;

/// Rounding errors of heights and distances, metres and as a share.
const SLACK: f64 = 1e-9;

/// What a distance has to exceed to be larger than `far` metres in spite of rounding errors.
pub(super) fn surely(far: f64) -> f64 {
    far * (1.0 + SLACK) + SLACK
}

/// The features of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Topology {
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle its edges, from corner k to the next.
    pub triangle_edges: Vec<[u32; 3]>,
    /// For each edge its end vertices.
    pub edges: Vec<[u32; 2]>,
    /// For each triangle which corners (bits 0..3) and edges (bits 3..6) it owns.
    owned: Vec<u8>,
}

impl Topology {
    pub fn new(triangles: &[[u32; 3]], adjacency: &Adjacency) -> Self {
        Self {
            triangles: triangles.to_vec(),
            triangle_edges: adjacency.triangle_edges.clone(),
            edges: adjacency.edges.clone(),
            owned: adjacency.owned(triangles),
        }
    }

    /// The corners (0..3) that triangle `t` owns.
    pub fn corners_of(&self, t: u32) -> impl Iterator<Item = usize> {
        let owned = self.owned[t as usize];
        (0..3).filter(move |k| owned & (1 << k) != 0)
    }

    /// The sides (0..3, from that corner to the next) whose edges triangle `t` owns.
    pub fn sides_of(&self, t: u32) -> impl Iterator<Item = usize> {
        let owned = self.owned[t as usize];
        (0..3).filter(move |k| owned & (8 << k) != 0)
    }

    /// The edges that triangle `t` owns.
    pub fn edges_of(&self, t: u32) -> impl Iterator<Item = u32> {
        self.sides_of(t).map(move |k| self.triangle_edges[t as usize][k])
    }

    /// Positions of the corners of triangle `t`.
    pub fn corners(&self, x: &[DVec3], t: u32) -> [DVec3; 3] {
        self.triangles[t as usize].map(|v| x[v as usize])
    }

    /// Positions of the ends of edge `e`.
    pub fn ends(&self, x: &[DVec3], e: u32) -> [DVec3; 2] {
        self.edges[e as usize].map(|v| x[v as usize])
    }
}

/// A triangle at the time of a detection.
#[derive(Clone, Debug)]
pub(super) struct PlacedTriangle {
    pub vertices: [u32; 3],
    pub corners: [DVec3; 3],
    /// Reach of each corner, metres.
    pub reach: [f64; 3],
    /// Largest reach of the corners, metres.
    pub farthest: f64,
    /// Bounding box of the corners.
    pub around: Aabb,
    /// Unit normal; zero where the triangle has no area.
    normal: DVec3,
    /// Height of its plane along the normal, metres.
    height: f64,
}

impl PlacedTriangle {
    /// Triangle `t` of a mesh with vertices at `x` that have this `reach`, metres; an empty `reach` means 0.
    pub fn new(topology: &Topology, x: &[DVec3], reach: &[f64], t: u32) -> Self {
        let vertices = topology.triangles[t as usize];
        let corners = topology.corners(x, t);
        let reach = vertices.map(|v| reach.get(v as usize).copied().unwrap_or_default());
        let farthest = reach.into_iter().fold(0.0, f64::max);
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let height = normal.dot(a);
        Self { vertices, corners, reach, farthest, around: Aabb::around(&corners), normal, height }
    }

    /// Whether `other` is wholly on one side of this triangle's plane, farther from it than `far` metres.
    pub fn is_off(&self, other: &Self, far: f64) -> bool {
        self.gap(other) > surely(far)
    }

    /// How far `other` is from this triangle's plane at least, metres; 0 where it is on both sides.
    pub fn gap(&self, other: &Self) -> f64 {
        let [a, b, c] = other.corners.map(|p| self.normal.dot(p) - self.height);
        a.min(b).min(c).max(-a.max(b).max(c)).max(0.0)
    }

    /// The vertices of side `k`.
    pub fn ends(&self, k: usize) -> [u32; 2] {
        [self.vertices[k], self.vertices[(k + 1) % 3]]
    }

    /// Positions of the ends of side `k`, metres.
    pub fn side(&self, k: usize) -> [DVec3; 2] {
        [self.corners[k], self.corners[(k + 1) % 3]]
    }

    /// The larger reach of the ends of side `k`, metres.
    pub fn side_reach(&self, k: usize) -> f64 {
        self.reach[k].max(self.reach[(k + 1) % 3])
    }
}

/// A mesh that does not move, with a bounding volume hierarchy.
#[derive(Debug)]
pub struct Obstacle {
    pub(super) topology: Topology,
    pub(super) positions: Vec<DVec3>,
    pub(super) placed: Vec<PlacedTriangle>,
    pub(super) broad: Broad,
}

impl Obstacle {
    /// The obstacle of a body's mesh.
    pub fn of(body: &Surface) -> Self {
        Self::new(&body.mesh.positions, &body.mesh.triangles, &body.adjacency)
    }

    /// The obstacle of a mesh at these `positions`, metres.
    pub fn new(positions: &[DVec3], triangles: &[[u32; 3]], adjacency: &Adjacency) -> Self {
        let topology = Topology::new(triangles, adjacency);
        let placed: Vec<PlacedTriangle> =
            (0..triangles.len() as u32).map(|t| PlacedTriangle::new(&topology, positions, &[], t)).collect();
        let boxes: Vec<Aabb> = placed.iter().map(|placed| placed.around).collect();
        Self { topology, positions: positions.to_vec(), broad: Broad::over(&boxes), placed }
    }
}
