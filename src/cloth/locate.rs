//! Which triangle lies under a flat point of the pattern.

use glam::{DVec2, DVec3};

use crate::cloth::Garment;
use crate::geometry::bvh::{Aabb, Bvh};
use crate::geometry::ids::PieceId;

/// How near a flat point counts as inside a triangle, in barycentric coordinates.
const INSIDE: f64 = -1e-9;

/// The triangles of one piece, flat.
pub struct FlatPiece {
    triangles: Vec<u32>,
    tree: Bvh,
}

impl FlatPiece {
    /// The triangles of `piece`; none when the garment lacks it.
    pub fn new(garment: &Garment, piece: PieceId) -> Self {
        let triangles: Vec<u32> = (0..garment.triangles.len() as u32)
            .filter(|&t| garment.triangle_pieces[t as usize] == piece)
            .collect();
        let boxes: Vec<Aabb> =
            triangles.iter().map(|&t| Aabb::around(&flat(garment, t).map(|p| p.extend(0.0)))).collect();
        Self { tree: Bvh::new(&boxes), triangles }
    }

    /// The three vertices of the triangle under `p`, or of the one that needs least extending, with their shares.
    pub fn shares(&self, garment: &Garment, p: DVec2) -> Option<[(u32, f64); 3]> {
        let bounds = self.tree.nodes.first()?.bounds;
        let whole = (bounds.upper - bounds.lower).length();
        let mut reach = whole * 1e-6;
        loop {
            let around = DVec3::splat(reach);
            let query = Aabb { lower: p.extend(0.0) - around, upper: p.extend(0.0) + around };
            let mut best: Option<(f64, u32, [f64; 3])> = None;
            self.tree.near(&query, |i| {
                let t = self.triangles[i as usize];
                let Some(shares) = barycentric(flat(garment, t), p) else { return };
                let least = shares[0].min(shares[1]).min(shares[2]);
                let better = |b: &(f64, u32, [f64; 3])| least > b.0 || (least == b.0 && t < b.1);
                if best.as_ref().is_none_or(better) {
                    best = Some((least, t, shares));
                }
            });
            // A leaf's box holds triangles that are not near: look a little farther before one is extended.
            if let Some((least, t, shares)) = best
                && (least >= INSIDE || reach > whole * 0.01)
            {
                let vs = garment.triangles[t as usize];
                return Some([0, 1, 2].map(|k| (vs[k], shares[k])));
            }
            if reach > 2.0 * whole {
                return None;
            }
            reach *= 8.0;
        }
    }
}

fn flat(garment: &Garment, t: u32) -> [DVec2; 3] {
    garment.triangle_corners[t as usize].map(|c| garment.corners[c as usize].uv)
}

fn barycentric([a, b, c]: [DVec2; 3], p: DVec2) -> Option<[f64; 3]> {
    let area = (b - a).perp_dot(c - a);
    let shares = [(c - b).perp_dot(p - b) / area, (a - c).perp_dot(p - c) / area];
    let shares = [shares[0], shares[1], 1.0 - shares[0] - shares[1]];
    shares.iter().all(|s| s.is_finite()).then_some(shares)
}
