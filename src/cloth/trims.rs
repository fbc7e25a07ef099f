//! Trims of the sewn garment along edges of its mesh: folds, elastic, buttons, hems, piping and wrinkles.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec2;

use crate::cloth::wrinkles::{Bend, bends};
use crate::geometry::ids::PieceId;
use crate::geometry::polygon::distance_to_segment;
use crate::pattern::{CutPattern, Elastic, Fold, Piece, PieceMesh, Piping, Trims};

/// The trims of a garment. Edges are given by flat corners, so that they hold for open pieces too.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GarmentTrims {
    /// Edges that are creased.
    pub folds: Vec<Along<Fold>>,
    /// Edges along which elastic is sewn.
    pub elastics: Vec<Along<Elastic>>,
    /// Both points of each fastened button.
    pub buttons: Vec<[ClothPoint; 2]>,
    /// Flat corners that lie in a hem.
    pub hemmed: Vec<u32>,
    /// Edges along which piping is sewn in, with its radius, metres. On a seam each side that names it has edges of its own.
    pub piped: Vec<Along<f64>>,
    /// Edges in wrinkles.
    pub wrinkles: Vec<Along<Bend>>,
}

/// A point of the flat cloth, by flat corners, so that it holds for open pieces too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClothPoint {
    /// The corners of the triangle at the point.
    pub corners: [u32; 3],
    /// Barycentric coordinates; their sum is one.
    pub shares: [f64; 3],
}

/// An edge of the mesh and what is worked along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along<T> {
    /// The edge: two flat corners of one piece.
    pub corners: [u32; 2],
    /// What is worked.
    pub what: T,
}

impl Along<f64> {
    /// Mass of a metre of the piping along the edge, kg/m.
    pub fn kg_per_m(&self) -> f64 {
        Piping::kg_per_m(self.what)
    }
}

impl GarmentTrims {
    /// The trims of the pieces of `cut` with these `meshes`; `first_corner` numbers the flat corners of each piece.
    pub fn of(
        cut: &CutPattern,
        meshes: &BTreeMap<PieceId, Arc<PieceMesh>>,
        first_corner: &BTreeMap<PieceId, u32>,
    ) -> Self {
        let mut trims = Self::default();
        for (id, mesh) in meshes {
            let (piece, first) = (&cut.pieces[id], first_corner[id]);
            for (edge, points) in mesh.edge_points.iter().enumerate() {
                let worked = piece.edge(edge).trims;
                points.windows(2).for_each(|w| trims.put(worked, [first + w[0], first + w[1]]));
            }
            trims.hemmed.extend(hemmed(piece, mesh).into_iter().map(|v| first + v));
            for link in &mesh.line_edges {
                let worked = piece.lines[link.line].edges[link.edge].trims;
                trims.put(worked, link.ends.map(|v| first + v));
            }
            let bends = bends(piece, mesh).into_iter();
            trims.wrinkles.extend(bends.map(|(ends, what)| Along { corners: ends.map(|v| first + v), what }));
        }
        trims
    }

    fn put(&mut self, worked: Trims, corners: [u32; 2]) {
        self.folds.extend(worked.fold.map(|what| Along { corners, what }));
        self.elastics.extend(worked.elastic.map(|what| Along { corners, what }));
        self.piped.extend(worked.piping.map(|piping| Along { corners, what: piping.radius }));
    }

    /// Flat corners at which cloth is as stiff as a hem: those in hems and along piping. Some come more than once.
    pub fn stiff_corners(&self) -> impl Iterator<Item = u32> {
        let piped = self.piped.iter().flat_map(|along| along.corners);
        self.hemmed.iter().copied().chain(piped)
    }

    /// The trims with corner c as corner `place[c]`.
    pub fn renumbered(&self, place: &[u32]) -> Self {
        let moved = |p: ClothPoint| ClothPoint { corners: p.corners.map(|c| place[c as usize]), ..p };
        Self {
            folds: renumbered(&self.folds, place),
            elastics: renumbered(&self.elastics, place),
            hemmed: self.hemmed.iter().map(|&c| place[c as usize]).collect(),
            buttons: self.buttons.iter().map(|ends| ends.map(moved)).collect(),
            piped: renumbered(&self.piped, place),
            wrinkles: renumbered(&self.wrinkles, place),
        }
    }
}

fn renumbered<T: Copy>(all: &[Along<T>], place: &[u32]) -> Vec<Along<T>> {
    all.iter().map(|a| Along { corners: a.corners.map(|c| place[c as usize]), ..*a }).collect()
}

/// Points of a mesh that lie in a hem of the piece, ascending.
fn hemmed(piece: &Piece, mesh: &PieceMesh) -> Vec<u32> {
    let hems: Vec<(f64, &Vec<u32>)> = mesh
        .edge_points
        .iter()
        .enumerate()
        .filter_map(|(edge, points)| Some((piece.edge(edge).trims.hem?.width, points)))
        .collect();
    let at = |v: u32| mesh.points[v as usize];
    let is_in = |p: DVec2| {
        hems.iter().any(|(width, points)| {
            points.windows(2).any(|w| distance_to_segment(p, at(w[0]), at(w[1])) <= *width)
        })
    };
    match hems.is_empty() {
        true => Vec::new(),
        false => (0..mesh.points.len() as u32).filter(|&v| is_in(at(v))).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::build;
    use crate::pattern::{Hem, Pattern};

    #[test]
    fn cloth_is_stiff_along_piping_and_in_hems_only() {
        let corners = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.2), (0.0, 0.2)].map(DVec2::from);
        let stiff = |change: fn(&mut Trims), is_in: fn(DVec2) -> bool| {
            let mut piece = Piece::polygon("square", &corners);
            change(&mut piece.outline[1].trims);
            let mut pattern = Pattern::default();
            pattern.add_piece(piece);
            let garment = build(&pattern, 0.05).0;
            let stiff: std::collections::BTreeSet<u32> = garment.trims.stiff_corners().collect();
            for (c, corner) in garment.corners.iter().enumerate() {
                assert_eq!(stiff.contains(&(c as u32)), is_in(corner.uv), "{}", corner.uv);
            }
        };
        stiff(|trims| trims.piping = Some(Piping::USUAL), |at| at.x > 0.2 - 1e-9);
        stiff(|trims| trims.hem = Some(Hem { width: 0.06, ..Hem::USUAL }), |at| at.x > 0.14 - 1e-9);
        stiff(|_| (), |_| false);
    }
}
