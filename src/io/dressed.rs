//! Dressed cloth as the arrays of each of its pieces, which scene formats hold.

use glam::{DVec2, DVec3};

use crate::cloth::{ClothState, Corner, Garment};
use crate::geometry::ids::PieceId;
use crate::io::materials::Textures;
use crate::pattern::Pattern;

/// A garment with its current vertex positions.
#[derive(Clone, Copy, Debug)]
pub struct Dressed<'a> {
    /// Topology and rest shape of the cloth.
    pub garment: &'a Garment,
    /// Current positions.
    pub state: &'a ClothState,
    /// The pattern, for the poses of its pieces in the pattern plane.
    pub pattern: &'a Pattern,
}

impl Dressed<'_> {
    /// Indices of the triangles all of whose vertices are placed on the body.
    pub(super) fn laid(&self) -> Vec<usize> {
        let is_laid = |t: &usize| {
            self.garment.triangles[*t].iter().all(|&v| self.state.mapped.get(v as usize) == Some(&true))
        };
        (0..self.garment.triangles.len()).filter(is_laid).collect()
    }

    /// The flat corners of `piece`, and the number of the first.
    pub(super) fn corners(&self, piece: PieceId) -> (&[Corner], usize) {
        let all = &self.garment.corners;
        let first = all.partition_point(|c| c.piece < piece);
        (&all[first..all.partition_point(|c| c.piece <= piece)], first)
    }
}

/// Vertex positions of the garment and the body in one frame.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Positions of the garment's vertices, metres.
    pub cloth: Vec<DVec3>,
    /// Positions of the body's vertices, metres.
    pub body: Vec<DVec3>,
}

/// Vertex arrays of a piece: one entry per flat corner (a vertex of one piece in the pattern plane).
#[derive(Clone, Debug)]
pub(super) struct PieceArrays {
    pub positions: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    /// Texture coordinates, v upwards: the pattern plane in metres, or the atlas.
    pub uv: Vec<DVec2>,
    /// Places in repeats of the weave; empty: no weave.
    pub weave: Vec<DVec2>,
    pub triangles: Vec<[u32; 3]>,
}

impl PieceArrays {
    /// The arrays of `piece` with its `triangles`; `normals` are those of all vertices of the garment.
    pub fn new(
        dressed: &Dressed<'_>,
        piece: PieceId,
        triangles: impl Iterator<Item = usize>,
        normals: &[DVec3],
        textures: Option<&Textures>,
    ) -> Self {
        let Dressed { garment, state, pattern } = dressed;
        let (corners, first) = dressed.corners(piece);
        let pose = pattern.pieces.get(&piece).map(|p| p.pose).unwrap_or_default();
        let weave = textures.and_then(|textures| textures.weave_from_piece.get(&piece));
        let uv = |at: DVec2| match textures {
            Some(textures) => textures.atlas.uv(piece, at),
            None => pose.plane_from_piece(at),
        };
        Self {
            weave: weave
                .map(|map| corners.iter().map(|c| map.transform_point2(c.uv)).collect())
                .unwrap_or_default(),
            positions: corners.iter().map(|c| state.positions[c.vertex as usize]).collect(),
            normals: corners.iter().map(|c| normals[c.vertex as usize]).collect(),
            uv: corners.iter().map(|c| uv(c.uv)).collect(),
            triangles: triangles.map(|t| garment.triangle_corners[t].map(|c| c - first as u32)).collect(),
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::pattern::{EdgeRef, Piece, Seam};

    /// Two squares sewn along one edge, bent at the seam.
    pub(in crate::io) fn two_squares() -> (Pattern, Garment, ClothState) {
        let square = [DVec2::ZERO, DVec2::X * 0.1, DVec2::splat(0.1), DVec2::Y * 0.1];
        let mut pattern = Pattern::default();
        let ids = ["a", "b"].map(|name| pattern.add_piece(Piece::polygon(name, &square)));
        let sides = [EdgeRef { piece: ids[0], edge: 1 }, EdgeRef { piece: ids[1], edge: 3 }];
        pattern.add_seam(Seam::of_edges(sides, false));
        let (garment, problems) = crate::cloth::build(&pattern, 0.03);
        assert!(problems.is_empty(), "{problems:?}");
        let mut positions = vec![DVec3::ZERO; garment.vertex_count];
        for c in &garment.corners {
            positions[c.vertex as usize] =
                if c.piece == ids[0] { c.uv.extend(0.0) } else { DVec3::new(0.1, c.uv.y, -c.uv.x) };
        }
        let mapped = vec![true; garment.vertex_count];
        (pattern, garment, ClothState { positions, mapped })
    }
}
