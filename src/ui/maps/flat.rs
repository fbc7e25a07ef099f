//! The map on the flat pieces of the pattern pane.

use glam::DVec2;

use super::ShownMap;
use crate::cloth::FlatPlace;
use crate::geometry::barycentric;
use crate::geometry::ids::PieceId;
use crate::render::Rgb;

/// Tolerance of barycentric coordinates for points just outside a triangle.
const EDGE: f64 = 1e-6;

impl ShownMap {
    /// The triangles of `piece` in its own plane, with a colour for each corner.
    pub fn flat(&self, piece: PieceId) -> impl Iterator<Item = [(DVec2, Rgb); 3]> {
        let corner = |c: u32| {
            let corner = self.outfit.garment.corners[c as usize];
            (corner.uv, self.colours[corner.vertex as usize])
        };
        let own = self.outfit.garment.triangle_corners.iter().zip(&self.outfit.garment.triangle_pieces);
        own.filter(move |(_, of)| **of == piece).map(move |(corners, _)| corners.map(corner))
    }

    /// The value at a point of a piece's own plane.
    pub fn value_on(&self, piece: PieceId, p: DVec2) -> Option<f64> {
        let triangles = 0..self.outfit.garment.triangles.len();
        let mut own = triangles.filter(|&t| self.outfit.garment.triangle_pieces[t] == piece);
        let place = own.find_map(|t| {
            let corners =
                self.outfit.garment.triangle_corners[t].map(|c| self.outfit.garment.corners[c as usize].uv);
            let shares =
                barycentric::in_plane(corners, p).filter(|shares| shares.iter().all(|&s| s >= -EDGE))?;
            Some(FlatPlace { triangle: t as u32, shares })
        });
        self.value(place?)
    }
}
