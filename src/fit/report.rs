//! The figures of a dressed garment.

use crate::geometry::crossings::self_crossings;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::cloth::{ClothState, Garment};
use crate::fit::causes::{Causes, causes};
use crate::fit::laid::Laid;
use crate::fit::on_body::{BodyIndex, on_body};
use crate::fit::openings::Opening;
use crate::fit::shape;
use crate::geometry::ids::{PieceId, SeamId};
use crate::pattern::Pattern;

/// A seam whose two sides are nowhere further apart than this (metres) is closed.
pub(super) const CLOSED: f64 = 1e-4;

/// Everything measured on a garment, over the triangles that lie in space.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Triangles that lie in space.
    pub triangles: usize,
    /// Their sewn vertices.
    pub vertices: usize,
    /// Vertices of the garment that have no place on the body yet.
    pub unmapped_vertices: usize,
    /// Vertices that have one, but not a finite one.
    pub not_finite_vertices: usize,
    /// Strain of the edges.
    pub strain: Strain,
    /// Why they are strained.
    #[serde(default)]
    pub strain_causes: Causes,
    /// What became of each piece, in id order.
    pub pieces: Vec<PieceChange>,
    /// The seams.
    pub seams: Seams,
    /// Those that are open, by number and pieces.
    #[serde(default)]
    pub open_seams: Vec<String>,
    /// Sewn vertices that belong to more than one piece.
    pub vertices_shared_by_pieces: usize,
    /// Parts connected in space.
    pub pieces_in_space: usize,
    /// Parts that the pattern's seams would make.
    pub pieces_expected: usize,
    /// Triangles without area.
    pub degenerate_faces: usize,
    /// Edges between two triangles.
    pub interior_edges: usize,
    /// Those of them whose triangles lie folded onto each other.
    pub folded_edges: usize,
    /// Pairs of an edge and a triangle of the cloth that cross without sharing a vertex.
    pub self_crossings: usize,
    /// Cloth inside the body.
    pub penetration: Penetration,
    /// Pairs of a cloth edge and a triangle of the skin that cross.
    pub edges_through_body: usize,
    /// Pairs of an edge of the skin and a cloth triangle that cross.
    pub body_edges_through_garment: usize,
    /// Triangles with their middle within 2 cm of the body.
    pub faces_near_body: usize,
    /// Those of them that show the body their outer side.
    pub flipped_faces: usize,
    /// Those of these that lie in folds: on them or under them is cloth the right way round.
    #[serde(default)]
    pub faces_in_folds: usize,
    /// Those of the rest that hang between two parts of the body: they show their inner side to skin too.
    #[serde(default)]
    pub faces_between: usize,
    /// How far above the skin the vertices lie.
    pub clearance: Clearance,
    /// Hems, neck, cuffs; longest first.
    pub openings: Vec<Opening>,
}

/// |l / l0 - 1| over the edges of the flat cloth; an edge in a seam counts once for each piece.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Strain {
    /// How many edges.
    pub edges: usize,
    /// The largest.
    pub max: f64,
    /// 99 of 100 are smaller.
    pub p99: f64,
    /// 95 of 100 are smaller.
    pub p95: f64,
    /// Root of the mean square.
    pub rms: f64,
    /// The middle one.
    pub median: f64,
    /// Of the stretched edges only, the others counting 0.
    pub stretch_p99: f64,
    /// Of the compressed edges only, the others counting 0.
    pub compress_p99: f64,
    /// Edges stretched to more than twice their length.
    #[serde(default)]
    pub doubled: usize,
}

/// What became of a piece.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PieceChange {
    /// Its name.
    pub name: String,
    /// Triangles that lie in space.
    pub triangles: usize,
    /// Triangles that do not.
    pub missing_triangles: usize,
    /// Area over flat area, less one.
    pub area_change: f64,
    /// Length of the border over its flat length, less one.
    pub perimeter_change: f64,
}

/// The seams.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seams {
    /// Sides nowhere more than 0.1 mm apart.
    pub closed: usize,
    /// All others, also those that could not be sewn at all.
    pub open: usize,
    /// Largest distance between two points sewn together, metres.
    pub max_gap: f64,
}

/// Cloth inside the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Penetration {
    /// Vertices.
    pub vertices: usize,
    /// Triangles with one of seven samples inside.
    pub faces: usize,
    /// Of the deepest vertex or sample, metres.
    pub max_depth: f64,
}

/// Signed distances of the vertices from the skin, metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Clearance {
    /// The middle one.
    pub median: f64,
    /// 95 of 100 are smaller.
    pub p95: f64,
}

/// Measures a garment on a body. Same input, same figures, on any number of threads.
pub fn measure(pattern: &Pattern, garment: &Garment, state: &ClothState, body: &BodyIndex<'_>) -> Report {
    let laid = Laid::new(garment, state);
    let tree = laid.mesh.tree();
    let (strain, pieces) = shape::strain_and_pieces(garment, &laid);
    let (interior_edges, folded_edges) = shape::interior_and_folded_edges(&laid);
    let sits = on_body(&laid, &tree, body);
    let unmapped = (0..garment.vertex_count).filter(|&v| state.mapped.get(v) != Some(&true)).count();
    Report {
        triangles: laid.mesh.triangles.len(),
        vertices: laid.used.len(),
        unmapped_vertices: unmapped,
        not_finite_vertices: not_finite(garment, state),
        strain,
        strain_causes: causes(garment, state, &laid, body),
        pieces,
        seams: seams(pattern, garment, state),
        open_seams: open_seams(pattern, garment, state),
        vertices_shared_by_pieces: shape::vertices_shared_by_pieces(&laid),
        pieces_in_space: shape::pieces_in_space(&laid),
        pieces_expected: pieces_expected(pattern),
        degenerate_faces: shape::degenerate_faces(&laid),
        interior_edges,
        folded_edges,
        self_crossings: self_crossings(&laid.mesh, &laid.edges, &tree).len(),
        penetration: sits.penetration,
        edges_through_body: sits.edges_through_body,
        body_edges_through_garment: sits.body_edges_through_garment,
        faces_near_body: sits.faces_near_body,
        flipped_faces: sits.flipped_faces,
        faces_in_folds: sits.faces_in_folds,
        faces_between: sits.faces_between,
        clearance: sits.clearance,
        openings: sits.openings,
    }
}

fn not_finite(garment: &Garment, state: &ClothState) -> usize {
    (0..garment.vertex_count)
        .filter(|&v| {
            state.mapped.get(v) == Some(&true) && !state.positions.get(v).is_some_and(|p| p.is_finite())
        })
        .count()
}

fn seams(pattern: &Pattern, garment: &Garment, state: &ClothState) -> Seams {
    let mut found = Seams::default();
    for gap in garment.seam_pairs.iter().filter_map(|(_, pairs)| widest_gap(garment, state, pairs)) {
        found.max_gap = found.max_gap.max(gap);
        found.closed += usize::from(gap <= CLOSED);
    }
    found.open = pattern.seams.len().max(garment.seam_pairs.len()) - found.closed;
    found
}

/// "seam 2 (front and back)" for each seam of the pattern that does not hold everywhere.
fn open_seams(pattern: &Pattern, garment: &Garment, state: &ClothState) -> Vec<String> {
    let holds = |pairs: &[[u32; 2]]| widest_gap(garment, state, pairs).is_some_and(|gap| gap <= CLOSED);
    let is_closed = |id: &SeamId| {
        let mut parts = garment.seam_pairs.iter().filter(|(of, _)| of == id).peekable();
        parts.peek().is_some() && parts.all(|(_, pairs)| holds(pairs))
    };
    let name = |id: PieceId| pattern.pieces.get(&id).map_or_else(|| id.to_string(), |p| p.name.clone());
    let open = pattern.seams.iter().filter(|(id, _)| !is_closed(id));
    open.map(|(id, seam)| format!("{id} ({} and {})", name(seam.sides[0].piece), name(seam.sides[1].piece)))
        .collect()
}

/// The widest gap of a seam, metres; none when one of its points lies nowhere.
pub(super) fn widest_gap(garment: &Garment, state: &ClothState, pairs: &[[u32; 2]]) -> Option<f64> {
    pairs.iter().try_fold(0.0, |widest: f64, pair| {
        let [a, b] = pair.map(|c| garment.corners[c as usize].vertex as usize);
        let lie = [a, b].iter().all(|&v| state.mapped.get(v) == Some(&true));
        let gap = state.positions.get(a)?.distance(*state.positions.get(b)?);
        (lie && gap.is_finite()).then_some(widest.max(gap))
    })
}

/// Groups of pieces that the seams join.
fn pieces_expected(pattern: &Pattern) -> usize {
    groups(pattern).iter().filter(|(id, g)| id == g).count()
}

/// For each piece the lowest of those that the seams join it to; deactivated ones count for nothing.
pub(super) fn groups(pattern: &Pattern) -> BTreeMap<PieceId, PieceId> {
    let mut group: BTreeMap<PieceId, PieceId> = {
        let pieces = pattern.pieces.iter().filter(|(_, piece)| !piece.activity.is_deactivated());
        pieces.map(|(&id, _)| (id, id)).collect()
    };
    for seam in pattern.seams.values() {
        let [Some(&a), Some(&b)] = seam.sides.map(|side| group.get(&side.piece)) else { continue };
        let (low, high) = (a.min(b), a.max(b));
        for g in group.values_mut().filter(|g| **g == high) {
            *g = low;
        }
    }
    group
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
