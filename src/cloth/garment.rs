//! Fixed topology and rest shape of the sewn garment, and its moving state.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec2, DVec3};

use crate::geometry::adjacency::Adjacency;
use crate::geometry::ids::{PieceId, SeamId};

/// A corner of the flat cloth: a point of a piece in that piece's own plane. Both sides of a seam have their own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The piece.
    pub piece: PieceId,
    /// Metres, in the piece's own plane (its `outline` coordinates).
    pub uv: DVec2,
    /// The sewn vertex it is part of.
    pub vertex: u32,
}

/// The merged mesh: sewn vertices are shared, every triangle keeps its flat shape.
#[derive(Clone, Debug, Default)]
pub struct Garment {
    /// Number of sewn vertices.
    pub vertex_count: usize,
    /// Sewn vertices of each triangle, counter-clockwise seen from the front (outer) side of the cloth.
    pub triangles: Vec<[u32; 3]>,
    /// Flat corners; pieces in id order, each piece's corners together.
    pub corners: Vec<Corner>,
    /// For each triangle its three flat corners, in the order of `triangles`.
    pub triangle_corners: Vec<[u32; 3]>,
    /// The piece of each triangle.
    pub triangle_pieces: Vec<PieceId>,
    /// Flat shape of each triangle, counter-clockwise seen from the front, metres, about its centroid; the warp runs along y.
    pub rest: Vec<[DVec2; 3]>,
    /// Neighbours over sewn vertices.
    pub adjacency: Adjacency,
    /// Pairs of corners sewn together, per seam.
    pub seam_pairs: Vec<(SeamId, Vec<[u32; 2]>)>,
    /// Names of the pieces that are in it, in id order.
    pub pieces: Vec<(PieceId, String)>,
    /// The layers of those that are not worn next to the skin.
    pub layers: BTreeMap<PieceId, u8>,
    /// Unit vectors along the warp, in the plane of `rest` before it is turned, of those in which it does not run along y.
    pub grains: BTreeMap<PieceId, DVec2>,
}

impl Garment {
    /// Mean rest length of the triangles' sides, metres; zero without triangles.
    pub fn mean_edge(&self) -> f64 {
        let sides = |rest: &[DVec2; 3]| (0..3).map(|k| (rest[(k + 1) % 3] - rest[k]).length()).sum::<f64>();
        self.rest.iter().map(sides).sum::<f64>() / (3 * self.rest.len()).max(1) as f64
    }

    /// `corners`, places in the plane of `piece` seen from the front, metres, turned so that its warp runs along y.
    pub fn along_grain(&self, piece: PieceId, corners: [DVec2; 3]) -> [DVec2; 3] {
        match self.grains.get(&piece) {
            None => corners,
            Some(&warp) => corners.map(|p| DVec2::new(p.perp_dot(warp), p.dot(warp))),
        }
    }

    /// The layer that a piece is worn on; 0 lies next to the skin.
    pub fn layer(&self, piece: PieceId) -> u8 {
        self.layers.get(&piece).copied().unwrap_or(0)
    }

    /// The same vertices and corners, without the triangles of these pieces.
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
        }
    }

    /// Bytes it takes.
    pub fn bytes(&self) -> usize {
        let pairs: usize = self.seam_pairs.iter().map(|(_, pairs)| pairs.len() * size_of::<[u32; 2]>()).sum();
        self.triangles.len() * (2 * size_of::<[u32; 3]>() + size_of::<PieceId>() + size_of::<[DVec2; 3]>())
            + self.corners.len() * size_of::<Corner>()
            + pairs
            + self.adjacency.bytes()
    }
}

/// What moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClothState {
    /// Position of each sewn vertex, metres. Meaningless where `mapped` is false.
    pub positions: Vec<DVec3>,
    /// Whether the vertex has been put on the body yet.
    pub mapped: Vec<bool>,
}
