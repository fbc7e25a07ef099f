//! Transfer of cloth positions and vertex values from one mesh of a garment to another, by flat points of the pattern.

use crate::cloth::locate::FlatPiece;
use crate::cloth::{ClothState, Garment};
use crate::pattern::edit::Carried;

/// For each vertex of the target mesh: vertices of the source mesh and their weights, which sum to one.
#[derive(Clone, Debug, Default)]
pub struct Carry {
    starts: Vec<usize>,
    shares: Vec<(u32, f64)>,
}

impl Carry {
    /// Transfer between two meshes of one pattern. A point of a curved edge may be outside the other mesh's chords:
    /// the nearest triangle is then extrapolated. A vertex on a seam is the mean over its pieces. Vertices of pieces
    /// that `from` lacks get no weights.
    pub fn new(from: &Garment, to: &Garment) -> Self {
        Self::moved(from, to, &[])
    }

    /// Transfer between meshes of two patterns, where `carried` tells how points of pieces moved from the first to the second.
    pub fn moved(from: &Garment, to: &Garment, carried: &[Carried]) -> Self {
        let mut said: Vec<Vec<(u32, f64)>> = vec![Vec::new(); to.vertex_count];
        let mut corners = to.corners.as_slice();
        while let Some(piece) = corners.first().map(|c| c.piece) {
            let count = corners.iter().take_while(|c| c.piece == piece).count();
            let (mine, rest) = corners.split_at(count);
            corners = rest;
            let way = carried.iter().find(|way| way.to == piece);
            let flat = FlatPiece::new(from, way.map_or(piece, |way| way.from));
            let back = way.map(|way| way.map.inverse());
            for corner in mine {
                let uv = back.map_or(corner.uv, |back| back.transform_point2(corner.uv));
                let place = flat.nearest(from, uv);
                said[corner.vertex as usize].extend(place.iter().flat_map(|place| place.vertices(from)));
            }
        }
        let mut carry = Self { starts: vec![0], shares: Vec::new() };
        for said in said {
            let pieces = (said.len() / 3).max(1) as f64;
            carry.shares.extend(said.into_iter().map(|(v, share)| (v, share / pieces)));
            carry.starts.push(carry.shares.len());
        }
        carry
    }

    /// Writes positions interpolated from `from` into `to`. A vertex counts as mapped when all vertices it depends on are.
    pub fn places(&self, from: &ClothState, to: &mut ClothState) {
        for v in 0..to.positions.len() {
            let shares = self.of(v);
            to.mapped[v] = !shares.is_empty() && shares.iter().all(|&(w, _)| from.mapped[w as usize]);
            if to.mapped[v] {
                to.positions[v] = shares.iter().map(|&(w, s)| from.positions[w as usize] * s).sum();
            }
        }
    }

    /// Interpolates values per vertex of the source mesh to the target mesh; 0 for vertices without weights.
    pub fn values(&self, from: &[f64]) -> Vec<f64> {
        (0..self.starts.len() - 1)
            .map(|v| self.of(v).iter().map(|&(w, s)| from[w as usize] * s).sum())
            .collect()
    }

    fn of(&self, v: usize) -> &[(u32, f64)] {
        &self.shares[self.starts[v]..self.starts[v + 1]]
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::cloth::build;
    use crate::pattern::EdgeShape;
    use crate::pattern::{Pattern, Piece};

    /// A square with sides of 0.4 m and one rounded edge.
    fn square(edge: f64) -> Garment {
        let corners = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.4), (0.0, 0.4)].map(|(x, y)| DVec2::new(x, y));
        let mut piece = Piece::polygon("square", &corners);
        piece.outline[1].shape = EdgeShape::Quadratic { control: DVec2::new(0.5, 0.2) };
        let mut pattern = Pattern::default();
        pattern.add_piece(piece);
        build(&pattern, edge).0
    }

    fn laid(garment: &Garment, place: impl Fn(DVec2) -> DVec3) -> ClothState {
        let mut state = ClothState {
            positions: vec![DVec3::ZERO; garment.vertex_count],
            mapped: vec![true; garment.vertex_count],
        };
        for c in &garment.corners {
            state.positions[c.vertex as usize] = place(c.uv);
        }
        state
    }

    #[test]
    fn a_plane_is_carried_exactly_even_beyond_a_chord() {
        let place = |p: DVec2| DVec3::new(p.x + 2.0 * p.y, 1.0 - p.x, 3.0 * p.y);
        let (coarse, fine) = (square(0.11), square(0.02));
        let mut to = laid(&fine, |_| DVec3::ZERO);
        Carry::new(&coarse, &fine).places(&laid(&coarse, place), &mut to);
        for (got, exact) in to.positions.iter().zip(laid(&fine, place).positions) {
            assert!((*got - exact).length() < 1e-12, "{got} is not {exact}");
        }
    }

    #[test]
    fn what_is_not_laid_is_not_carried() {
        let (coarse, fine) = (square(0.11), square(0.05));
        let mut from = laid(&coarse, |p| p.extend(0.0));
        from.mapped.fill(false);
        let mut to = laid(&fine, |_| DVec3::ZERO);
        Carry::new(&coarse, &fine).places(&from, &mut to);
        assert!(to.mapped.iter().all(|m| !m));
    }
}
