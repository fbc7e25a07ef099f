//! The part of a garment that has positions in space.

use glam::DVec3;

use crate::cloth::{ClothState, Garment};
use crate::geometry::ids::PieceId;
use crate::geometry::mesh::TriMesh;

/// The triangles whose vertices all have a finite position.
pub(super) struct Laid {
    /// Sewn vertices and triangles; vertices of no triangle here have no meaning.
    pub mesh: TriMesh,
    /// Flat corners of each triangle.
    pub corners: Vec<[u32; 3]>,
    /// Piece of each triangle.
    pub pieces: Vec<PieceId>,
    /// Vertices of at least one triangle, ascending.
    pub used: Vec<u32>,
    /// Edges, lower vertex first, ascending, each once.
    pub edges: Vec<[u32; 2]>,
}

impl Laid {
    pub fn new(garment: &Garment, state: &ClothState) -> Self {
        let positions: Vec<DVec3> = (0..garment.vertex_count)
            .map(|v| state.positions.get(v).copied().unwrap_or(DVec3::NAN))
            .collect();
        let lies = |v: u32| state.mapped.get(v as usize) == Some(&true) && positions[v as usize].is_finite();
        let kept: Vec<usize> =
            (0..garment.triangles.len()).filter(|&t| garment.triangles[t].iter().all(|&v| lies(v))).collect();
        let triangles: Vec<[u32; 3]> = kept.iter().map(|&t| garment.triangles[t]).collect();
        let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        Self {
            corners: kept.iter().map(|&t| garment.triangle_corners[t]).collect(),
            pieces: kept.iter().map(|&t| garment.triangle_pieces[t]).collect(),
            used,
            edges: edges(&triangles),
            mesh: TriMesh { positions, triangles },
        }
    }
}

/// Edges of `triangles`, lower vertex first, ascending, each once.
pub(super) fn edges(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut edges: Vec<[u32; 2]> = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}
