//! Moves newly placed pieces outwards, until they are outside of the cloth that is draped already.
//!
//! Files place the pieces of each garment about the bare body. Pieces sewn from within an inner layer would end up under it, or
//! intersect it for good.

use glam::DVec3;

use crate::cloth::{ClothState, Garment};
use crate::drape::garment::SEARCH_STEP;
use crate::geometry::crossings::meetings;
use crate::geometry::ids::PieceId;
use crate::geometry::mesh::TriMesh;

/// Distance (m) in front of a piece within which draped cloth counts as an inner layer that the piece must be outside of. Chosen by
/// trial; it bounds how far under what is worn a file may have placed a piece.
const SIGHT: f64 = 0.15;

/// Returns `places` (metres, one per flat corner of `garment`) with the pieces that are sewn `now` translated along their outer
/// normal, each as a rigid whole, until they neither intersect the draped part of `worn` nor are behind it.
pub fn cleared(
    garment: &Garment,
    worn: &ClothState,
    places: &[Option<DVec3>],
    now: &dyn Fn(PieceId) -> bool,
) -> Vec<Option<DVec3>> {
    let mut places = places.to_vec();
    let laid = |vs: &&[u32; 3]| vs.iter().all(|&v| worn.mapped[v as usize]);
    let triangles: Vec<[u32; 3]> = garment.triangles.iter().filter(laid).copied().collect();
    if triangles.is_empty() {
        return places;
    }
    let inner = TriMesh { positions: worn.positions.clone(), triangles };
    let inner_tree = inner.tree();
    let is_laid = |e: &&[u32; 2]| e.iter().all(|&v| worn.mapped[v as usize]);
    let inner_edges: Vec<[u32; 2]> = garment.adjacency.edges.iter().filter(is_laid).copied().collect();
    for (piece, _) in garment.pieces.iter().filter(|(id, _)| now(*id)) {
        let Some(panel) = Panel::of(garment, &places, *piece) else { continue };
        let clear = |shift: DVec3| {
            let mesh = panel.moved(shift);
            let (before, sights) = panel.sights(&mesh);
            let is_behind = |&[_, t]: &[u32; 2]| {
                let [a, b, c] = inner.corners(t as usize);
                (b - a).cross(c - a).dot(panel.out) > 0.0
            };
            meetings(&mesh.positions, &panel.edges, &inner, &inner_tree).is_empty()
                && meetings(&inner.positions, &inner_edges, &mesh, &mesh.tree()).is_empty()
                && !meetings(&before, &sights, &inner, &inner_tree).iter().any(is_behind)
        };
        // A piece that still intersects 40 cm away is left where it was placed.
        let shifts = (0..=40).map(|k| panel.out * (SEARCH_STEP * f64::from(k)));
        let Some(shift) = shifts.into_iter().find(|&shift| clear(shift)) else { continue };
        for (place, corner) in places.iter_mut().zip(&garment.corners) {
            if corner.piece == *piece {
                *place = place.map(|p| p + shift);
            }
        }
    }
    places
}

/// A flat piece placed in space.
struct Panel {
    mesh: TriMesh,
    edges: Vec<[u32; 2]>,
    /// Unit outer normal.
    out: DVec3,
}

impl Panel {
    /// The panel of `piece`; None where the piece is not placed.
    fn of(garment: &Garment, places: &[Option<DVec3>], piece: PieceId) -> Option<Self> {
        let first = garment.corners.iter().position(|corner| corner.piece == piece)?;
        let count = garment.corners[first..].iter().take_while(|corner| corner.piece == piece).count();
        let positions: Vec<DVec3> = places[first..first + count].iter().copied().collect::<Option<_>>()?;
        let own = |vs: &[u32; 3]| vs.map(|c| c - first as u32);
        let of_piece = garment.triangle_corners.iter().zip(&garment.triangle_pieces);
        let triangles: Vec<[u32; 3]> =
            of_piece.filter(|(_, p)| **p == piece).map(|(vs, _)| own(vs)).collect();
        let mesh = TriMesh { positions, triangles };
        let area = |t: usize| {
            let [a, b, c] = mesh.corners(t);
            (b - a).cross(c - a)
        };
        let out = (0..mesh.triangles.len()).map(area).sum::<DVec3>().try_normalize()?;
        let mut edges: Vec<[u32; 2]> = Vec::new();
        for vs in &mesh.triangles {
            edges.extend([[vs[0], vs[1]], [vs[1], vs[2]], [vs[2], vs[0]]].map(|[a, b]| [a.min(b), a.max(b)]));
        }
        edges.sort_unstable();
        edges.dedup();
        Some(Self { mesh, edges, out })
    }

    fn moved(&self, shift: DVec3) -> TriMesh {
        let positions = self.mesh.positions.iter().map(|&p| p + shift).collect();
        TriMesh { positions, triangles: self.mesh.triangles.clone() }
    }

    /// A line of sight along the outer normal from each vertex: end points, and the two points of each line.
    fn sights(&self, mesh: &TriMesh) -> (Vec<DVec3>, Vec<[u32; 2]>) {
        let count = mesh.positions.len() as u32;
        let tips = mesh.positions.iter().map(|&p| p + self.out * SIGHT);
        let ends = mesh.positions.iter().copied().chain(tips).collect();
        (ends, (0..count).map(|v| [v, v + count]).collect())
    }
}
