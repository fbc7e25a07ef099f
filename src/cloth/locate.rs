//! Point location: the triangle at a flat point of the pattern.

use glam::{DVec2, DVec3};

use crate::cloth::trims::ClothPoint;
use crate::cloth::{ClothState, Garment};
use crate::geometry::barycentric;
use crate::geometry::bvh::{Aabb, Bvh};
use crate::geometry::ids::PieceId;
use crate::pattern::PiecePoint;

/// Smallest barycentric coordinate at which a flat point counts as inside a triangle.
const INSIDE: f64 = -1e-9;

/// Smallest barycentric coordinate at which a flat point counts as on its piece; wider than [`INSIDE`], because
/// strokes end on the outline.
const ON_PIECE: f64 = -1e-6;

/// A point of the flat cloth, by triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatPlace {
    /// The triangle at the point.
    pub triangle: u32,
    /// Barycentric coordinates; their sum is one.
    pub shares: [f64; 3],
}

impl FlatPlace {
    /// The triangle's vertices with the barycentric coordinates as weights.
    pub fn vertices(&self, garment: &Garment) -> [(u32, f64); 3] {
        let vs = garment.triangles[self.triangle as usize];
        [0, 1, 2].map(|k| (vs[k], self.shares[k]))
    }

    /// Position in space, metres; None while the triangle is not on the body.
    pub fn point(&self, garment: &Garment, state: &ClothState) -> Option<DVec3> {
        let vertices = self.vertices(garment);
        let laid = vertices.iter().all(|&(v, _)| state.mapped[v as usize]);
        laid.then(|| vertices.iter().map(|&(v, share)| state.positions[v as usize] * share).sum())
    }
}

/// The flat triangles of one piece, prepared for point location.
pub struct FlatPiece {
    triangles: Vec<u32>,
    tree: Bvh,
}

impl FlatPiece {
    /// Prepares the triangles of `piece`; there are none when the garment lacks it.
    pub fn new(garment: &Garment, piece: PieceId) -> Self {
        let triangles: Vec<u32> = (0..garment.triangles.len() as u32)
            .filter(|&t| garment.triangle_pieces[t as usize] == piece)
            .collect();
        let boxes: Vec<Aabb> =
            triangles.iter().map(|&t| Aabb::around(&flat(garment, t).map(|p| p.extend(0.0)))).collect();
        Self { tree: Bvh::new(&boxes), triangles }
    }

    /// The place of the flat point `p`; None when it is not on the piece.
    pub fn inside(&self, garment: &Garment, p: DVec2) -> Option<FlatPlace> {
        self.nearest(garment, p).filter(|place| place.shares.iter().all(|&share| share >= ON_PIECE))
    }

    /// The place of the flat point `p`: in the triangle that contains it, or outside all triangles in the one with
    /// the least extrapolation. None without triangles, or far off the piece.
    pub fn nearest(&self, garment: &Garment, p: DVec2) -> Option<FlatPlace> {
        let bounds = self.tree.nodes.first()?.bounds;
        let whole = (bounds.upper - bounds.lower).length();
        let mut reach = whole * 1e-6;
        loop {
            let around = DVec3::splat(reach);
            let query = Aabb { lower: p.extend(0.0) - around, upper: p.extend(0.0) + around };
            let mut best: Option<(f64, u32, [f64; 3])> = None;
            self.tree.near(&query, |i| {
                let t = self.triangles[i as usize];
                let Some(shares) = barycentric::in_plane(flat(garment, t), p) else { return };
                let least = shares[0].min(shares[1]).min(shares[2]);
                let better = |b: &(f64, u32, [f64; 3])| least > b.0 || (least == b.0 && t < b.1);
                if best.as_ref().is_none_or(better) {
                    best = Some((least, t, shares));
                }
            });
            // A leaf's box also holds triangles that are not near: search a little farther before one is extrapolated.
            if let Some((least, t, shares)) = best
                && (least >= INSIDE || reach > whole * 0.01)
            {
                return Some(FlatPlace { triangle: t, shares });
            }
            if reach >= 2.0 * whole {
                return None;
            }
            reach *= 8.0;
        }
    }
}

fn flat(garment: &Garment, t: u32) -> [DVec2; 3] {
    garment.triangle_corners[t as usize].map(|c| garment.corners[c as usize].uv)
}

impl ClothPoint {
    /// The point of a piece; None when it is not on the cloth of `garment`.
    pub fn new(garment: &Garment, point: PiecePoint) -> Option<Self> {
        let place = FlatPiece::new(garment, point.piece).inside(garment, point.at)?;
        Some(Self { corners: garment.triangle_corners[place.triangle as usize], shares: place.shares })
    }

    /// The vertices round the point with the barycentric coordinates as weights.
    pub fn vertices(&self, garment: &Garment) -> [(u32, f64); 3] {
        [0, 1, 2].map(|k| (garment.corners[self.corners[k] as usize].vertex, self.shares[k]))
    }

    /// Position in space, metres; None while it is not on the body.
    pub fn place(&self, garment: &Garment, state: &ClothState) -> Option<DVec3> {
        let vertices = self.vertices(garment);
        let is_laid = vertices.iter().all(|&(v, _)| state.mapped[v as usize]);
        is_laid.then(|| vertices.iter().map(|&(v, share)| state.positions[v as usize] * share).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::build;
    use crate::pattern::{Pattern, Piece};

    #[test]
    fn shares_give_the_point_back_and_what_is_off_the_piece_has_none() {
        let corners = [(0.0, 0.0), (0.4, 0.0), (0.5, 0.3), (0.0, 0.4)].map(|(x, y)| DVec2::new(x, y));
        let mut pattern = Pattern::default();
        let id = pattern.add_piece(Piece::polygon("kite", &corners));
        let (garment, _) = build(&pattern, 0.05);
        let piece = FlatPiece::new(&garment, id);
        for p in [DVec2::new(0.1, 0.1), DVec2::new(0.41, 0.2), DVec2::ZERO, DVec2::new(0.2, 0.0)] {
            let place = piece.inside(&garment, p).expect("on the piece");
            let flat = flat(&garment, place.triangle);
            let sum: DVec2 = (0..3).map(|k| flat[k] * place.shares[k]).sum();
            assert!((sum - p).length() < 1e-12, "{sum} is not {p}");
        }
        let off = DVec2::new(0.2, -0.01);
        assert!(piece.inside(&garment, off).is_none() && piece.nearest(&garment, off).is_some());
        assert!(FlatPiece::new(&garment, PieceId(99)).nearest(&garment, off).is_none());
    }
}
