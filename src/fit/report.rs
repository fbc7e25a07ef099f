//! The figures of a dressed garment.

use serde::{Deserialize, Serialize};

use crate::fit::causes::Causes;
use crate::fit::on_body::{Clearance, Penetration};
use crate::fit::openings::Opening;
use crate::fit::shape::{PieceChange, Strain};

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
    /// |l / l0 - 1| that 99 of 100 edges do not exceed, without those that a seam of unequal sides eases.
    #[serde(default)]
    pub uneased_p99: f64,
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
