//! The report: measurements of a dressed garment.

use serde::{Deserialize, Serialize};

use crate::fit::causes::Causes;
use crate::fit::fastenings::Fastenings;
use crate::fit::on_body::{Clearance, Penetration};
use crate::fit::openings::Opening;
use crate::fit::shape::{PieceChange, Strain};
use crate::geometry::words::Words;

/// All measurements of a garment, over the triangles that have positions in space.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Triangles with positions in space.
    pub triangles: usize,
    /// Sewn vertices of those triangles.
    pub vertices: usize,
    /// Vertices of the garment without a position on the body.
    pub unmapped_vertices: usize,
    /// Vertices with a position that is not finite.
    pub not_finite_vertices: usize,
    /// Strain of the edges.
    pub strain: Strain,
    /// 99th percentile of |l / l0 - 1|, without edges eased on a seam of unequal sides.
    #[serde(default)]
    pub uneased_p99: f64,
    /// Strained edges by cause.
    #[serde(default)]
    pub strain_causes: Causes,
    /// Each piece compared with its flat shape, in id order.
    pub pieces: Vec<PieceChange>,
    /// The seams.
    pub seams: Seams,
    /// Open seams, by number and pieces.
    #[serde(default)]
    pub open_seams: Vec<Words>,
    /// Buttons and zips.
    #[serde(default, skip_serializing_if = "Fastenings::is_none")]
    pub fastenings: Fastenings,
    /// Sewn vertices that belong to more than one piece.
    pub vertices_shared_by_pieces: usize,
    /// Connected components in space.
    pub pieces_in_space: usize,
    /// Connected components that the pattern's seams should make.
    pub pieces_expected: usize,
    /// Triangles without area.
    pub degenerate_faces: usize,
    /// Edges between two triangles.
    pub interior_edges: usize,
    /// Interior edges whose triangles are folded onto each other.
    pub folded_edges: usize,
    /// Pairs of an edge and a triangle of the cloth that cross without sharing a vertex.
    pub self_crossings: usize,
    /// Cloth inside the body.
    pub penetration: Penetration,
    /// Pairs of a cloth edge and a triangle of the skin that cross.
    pub edges_through_body: usize,
    /// Pairs of an edge of the skin and a cloth triangle that cross.
    pub body_edges_through_garment: usize,
    /// How many of these two are near places where parts of the body pass through each other.
    #[serde(default)]
    pub cuts_at_body_overlaps: usize,
    /// Triangles whose centroid is within 2 cm of the body.
    pub faces_near_body: usize,
    /// Triangles near the body with their outer side towards it.
    pub flipped_faces: usize,
    /// Flipped triangles that are in folds: above or below them is cloth the right way round.
    #[serde(default)]
    pub faces_in_folds: usize,
    /// Flipped triangles outside of folds that hang between two parts of the body, where skin faces their inner side too, or
    /// crumpled beside other skin.
    #[serde(default)]
    pub faces_between: usize,
    /// Flipped triangles of smooth cloth with other skin, such as a hand, beside them; the two counts before are without them.
    #[serde(default)]
    pub faces_beside: usize,
    /// Distances of the vertices from the skin.
    pub clearance: Clearance,
    /// Openings (hems, neck, cuffs), longest first.
    pub openings: Vec<Opening>,
}

/// How cloth came to where it lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Moved {
    /// It was wrapped or sewn: it should lie smooth.
    #[default]
    Wrapped,
    /// It was carried to another pose of the body: it may have folds.
    Carried,
    /// Physics moved it: it may have folds, and hangs on the body.
    Draped,
}

impl Report {
    /// Flipped triangles that are a fault: cloth beside other skin is none, nor are folds and cloth between two parts of the body
    /// where it may have folds.
    pub fn wrong_side_out(&self, moved: Moved) -> usize {
        let may_fold = moved != Moved::Wrapped;
        let hangs_so = if may_fold { self.faces_in_folds + self.faces_between } else { 0 };
        self.flipped_faces - self.faces_beside - hangs_so
    }

    /// The openings through which the body should pass and does not, with their indices. A single border is that of a cloth or a
    /// cape, through which it need not pass. A garment has several, and the body passes through each: where it does not, a sleeve is
    /// on one side of its arm, or a seam has a hole. But the hem of what is on the body may hang lower than its feet, or than a bust.
    pub fn missed_openings(&self) -> impl Iterator<Item = (usize, &Opening)> {
        let all = if self.openings.len() < 2 { &[] } else { &self.openings[..] };
        let is_on = all.iter().any(|opening| opening.body_through);
        let is_right = move |opening: &Opening| opening.body_through || (is_on && opening.below_body);
        all.iter().enumerate().filter(move |(_, opening)| !is_right(opening))
    }
}

/// Summary of the seams.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seams {
    /// Seams whose sides are nowhere more than 0.1 mm apart.
    pub closed: usize,
    /// All other seams, including those that could not be sewn.
    pub open: usize,
    /// Largest distance between two points sewn together, metres.
    pub max_gap: f64,
}
