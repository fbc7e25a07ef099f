//! Cutting holes into pieces and closing them.

use crate::geometry::ids::PieceId;
use crate::geometry::polygon::{contains, signed_area};
use crate::geometry::words::{Words, words};
use crate::pattern::edit::pieces::change;
use crate::pattern::edit::{Change, find};
use crate::pattern::piece::flattened_loop;
use crate::pattern::{Edge, Pattern, curve};

/// Tolerance of the polylines of outline and hole, metres.
const TOLERANCE: f64 = 1e-4;

pub(super) fn add_hole(pattern: &mut Pattern, id: PieceId, edges: &[Edge]) -> Result<Change, Words> {
    let piece = find(pattern, id)?;
    let outline = piece.flattened(TOLERANCE);
    let hole = flattened_loop(edges, TOLERANCE);
    if edges.len() < 2 || !hole.iter().all(|&p| contains(&outline, p)) {
        return Err(words!("a hole lies inside the outline of {name}", name = piece.name));
    }
    // The cloth must be on the same side of all closed lines, so that seams join them front to front.
    let against = signed_area(&hole) * piece.signed_area() < 0.0;
    let edges = if against { edges.to_vec() } else { curve::reversed(edges) };
    change(pattern, id, |p| p.holes.push(edges));
    Ok(Change::new(words!("cut a hole")))
}

pub(super) fn delete_hole(pattern: &mut Pattern, id: PieceId, hole: usize) -> Result<Change, Words> {
    let piece = find(pattern, id)?;
    if hole >= piece.holes.len() {
        return Err(words!("{name} has no hole {n}", name = piece.name, n = hole.saturating_add(1)));
    }
    drop_hole(pattern, id, hole);
    Ok(Change::new(words!("close a hole")))
}

/// Removes hole `hole` with its seams; the edges of later holes get lower numbers.
pub(super) fn drop_hole(pattern: &mut Pattern, id: PieceId, hole: usize) {
    let Some(piece) = pattern.pieces.get(&id).cloned() else { return };
    let first: usize = piece.loops().take(hole + 1).map(Vec::len).sum();
    let count = piece.holes[hole].len();
    let gone = |edge: usize| (first..first + count).contains(&edge);
    let moved = |edge: usize| if edge >= first { edge - count } else { edge };
    pattern.seams.retain(|_, seam| seam.sides.iter().all(|side| side.piece != id || !gone(side.edge)));
    for seam in pattern.seams.values_mut() {
        for side in seam.sides.iter_mut().filter(|side| side.piece == id) {
            side.edge = moved(side.edge);
        }
    }
    change(pattern, id, |p| {
        p.holes.remove(hole);
        p.notches.retain(|notch| !gone(notch.edge));
        p.notches.iter_mut().for_each(|notch| notch.edge = moved(notch.edge));
    });
}
