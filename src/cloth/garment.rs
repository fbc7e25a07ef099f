//! The sewn garment: its fixed topology and rest shape, and its moving state.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec2, DVec3};

use crate::cloth::trims::GarmentTrims;
use crate::geometry::adjacency::Adjacency;
use crate::geometry::ids::{PieceId, SeamId};

/// A flat corner: a point of a piece in that piece's own plane. On a seam each side has corners of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The piece.
    pub piece: PieceId,
    /// Position, metres, in the piece's own plane (the coordinates of its `outline`).
    pub uv: DVec2,
    /// The sewn vertex that the corner belongs to.
    pub vertex: u32,
}

/// The sewn mesh: vertices are shared across seams, and every triangle keeps its flat rest shape.
#[derive(Clone, Debug, Default)]
pub struct Garment {
    /// Number of sewn vertices.
    pub vertex_count: usize,
    /// Sewn vertices of each triangle, counter-clockwise seen from the front (outer) side of the cloth.
    pub triangles: Vec<[u32; 3]>,
    /// Flat corners, grouped by piece in the order of piece ids.
    pub corners: Vec<Corner>,
    /// For each triangle its three flat corners, in the same order as its vertices in `triangles`.
    pub triangle_corners: Vec<[u32; 3]>,
    /// For each triangle its piece.
    pub triangle_pieces: Vec<PieceId>,
    /// For each triangle its flat rest shape about its centroid, metres, counter-clockwise seen from the front, turned so that
    /// the warp runs along y.
    pub rest: Vec<[DVec2; 3]>,
    /// Adjacency of the sewn mesh.
    pub adjacency: Adjacency,
    /// For each seam the pairs of corners that it joins.
    pub seam_pairs: Vec<(SeamId, Vec<[u32; 2]>)>,
    /// Ids and names of the pieces in the garment, in the order of their ids.
    pub pieces: Vec<(PieceId, String)>,
    /// Layers of the pieces that are not on layer 0.
    pub layers: BTreeMap<PieceId, u8>,
    /// Unit vector along the warp, in the piece's plane seen from the front, of each piece whose warp does not run along y.
    pub grains: BTreeMap<PieceId, DVec2>,
    /// What is worked along its edges.
    pub trims: GarmentTrims,
}

impl Garment {
    /// Mean rest length of the triangles' sides, metres; zero without triangles.
    pub fn mean_edge(&self) -> f64 {
        let sides = |rest: &[DVec2; 3]| (0..3).map(|k| (rest[(k + 1) % 3] - rest[k]).length()).sum::<f64>();
        self.rest.iter().map(sides).sum::<f64>() / (3 * self.rest.len()).max(1) as f64
    }

    /// Turns `corners` (metres, in the plane of `piece` seen from the front) so that the warp of the piece runs along y.
    pub fn along_grain(&self, piece: PieceId, corners: [DVec2; 3]) -> [DVec2; 3] {
        match self.grains.get(&piece) {
            None => corners,
            Some(&warp) => corners.map(|p| DVec2::new(p.perp_dot(warp), p.dot(warp))),
        }
    }

    /// The layer of a piece; layer 0 is next to the skin.
    pub fn layer(&self, piece: PieceId) -> u8 {
        self.layers.get(&piece).copied().unwrap_or(0)
    }

    /// The garment without the triangles of these pieces; vertices and corners keep their numbers.
    pub fn without(&self, pieces: &BTreeSet<PieceId>) -> Self {
        let kept: Vec<usize> =
            (0..self.triangles.len()).filter(|&t| !pieces.contains(&self.triangle_pieces[t])).collect();
        let triangles: Vec<[u32; 3]> = kept.iter().map(|&t| self.triangles[t]).collect();
        Self {
            vertex_count: self.vertex_count,
            adjacency: Adjacency::new(self.vertex_count, &triangles),
            triangles,
            corners: self.corners.clone(),
            triangle_corners: kept.iter().map(|&t| self.triangle_corners[t]).collect(),
            triangle_pieces: kept.iter().map(|&t| self.triangle_pieces[t]).collect(),
            rest: kept.iter().map(|&t| self.rest[t]).collect(),
            seam_pairs: self.seam_pairs.clone(),
            pieces: self.pieces.iter().filter(|(id, _)| !pieces.contains(id)).cloned().collect(),
            layers: self.layers.clone(),
            grains: self.grains.clone(),
            trims: self.trims.clone(),
        }
    }

    /// Memory used, bytes.
    pub fn bytes(&self) -> usize {
        let pairs: usize = self.seam_pairs.iter().map(|(_, pairs)| pairs.len() * size_of::<[u32; 2]>()).sum();
        self.triangles.len() * (2 * size_of::<[u32; 3]>() + size_of::<PieceId>() + size_of::<[DVec2; 3]>())
            + self.corners.len() * size_of::<Corner>()
            + pairs
            + self.adjacency.bytes()
    }
}

/// The moving state of the cloth.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClothState {
    /// Position of each sewn vertex, metres. Meaningless where `mapped` is false.
    pub positions: Vec<DVec3>,
    /// Whether each vertex has been placed on the body yet.
    pub mapped: Vec<bool>,
}
