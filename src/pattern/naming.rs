//! Descriptions of seams and edges, by the names that people gave their pieces.

use crate::geometry::ids::SeamId;
use crate::pattern::{EdgeRef, Pattern};

/// Describes a seam and the edges it joins.
pub fn seam_place(pattern: &Pattern, id: SeamId) -> String {
    pattern.seams.get(&id).map_or_else(
        || id.to_string(),
        |seam| {
            let [a, b] = seam.sides.map(|side| place(pattern, side.first_edge()));
            format!("{id}: {a} and {b}")
        },
    )
}

/// Describes an edge: "front (piece 1), edge 3".
pub fn place(pattern: &Pattern, edge: EdgeRef) -> String {
    match pattern.pieces.get(&edge.piece) {
        Some(piece) => format!("{} ({}), edge {}", piece.name, edge.piece, edge.edge),
        None => format!("{}, edge {}", edge.piece, edge.edge),
    }
}
