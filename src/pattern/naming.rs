//! Descriptions of seams and edges, by the names that people gave their pieces.

use crate::geometry::ids::SeamId;
use crate::geometry::words::{Words, words};
use crate::pattern::{EdgeRef, Pattern};

/// Describes a seam and the edges it joins.
pub fn seam_place(pattern: &Pattern, id: SeamId) -> Words {
    pattern.seams.get(&id).map_or_else(
        || id.into(),
        |seam| {
            let [a, b] = seam.sides.map(|side| place(pattern, side.first_edge()));
            words!("{id}: {a} and {b}", id, a, b)
        },
    )
}

/// Describes an edge: "front (piece 1), edge 3".
pub fn place(pattern: &Pattern, edge: EdgeRef) -> Words {
    match pattern.pieces.get(&edge.piece) {
        Some(piece) => {
            words!("{name} ({piece}), edge {n}", name = piece.name, piece = edge.piece, n = edge.edge)
        }
        None => words!("{piece}, edge {n}", piece = edge.piece, n = edge.edge),
    }
}
