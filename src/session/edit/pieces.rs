//! Pieces.

use std::sync::Arc;

use crate::geometry::ids::PieceId;
use crate::pattern::{Edge, Pattern, Piece, PlanePose};
use crate::session::command::Rejection;
use crate::session::document::Document;
use crate::session::edit::marks::remove_number;
use crate::session::edit::{ClothChange, Edit, checks};
use crate::wrap::Marks;

pub fn add(mut document: Document, piece: &Arc<Piece>) -> Result<Edit, Rejection> {
    checks::piece(piece)?;
    if document.pattern.pieces.len() >= checks::MOST_PIECES {
        return Err(Rejection(format!("a pattern may have {} pieces", checks::MOST_PIECES)));
    }
    Arc::make_mut(&mut document.pattern).add_piece(Piece::clone(piece));
    Ok(Edit::new(format!("add {}", piece.name), document))
}

pub fn delete(mut document: Document, id: PieceId) -> Result<Edit, Rejection> {
    let label = format!("delete {}", checks::find_piece(&document.pattern, id)?.name);
    let pattern = Arc::make_mut(&mut document.pattern);
    pattern.pieces.remove(&id);
    pattern.seams.retain(|_, seam| seam.sides.iter().all(|side| side.piece != id));
    let marks = Arc::make_mut(&mut document.marks);
    while let Some(i) = marks.cloth.iter().position(|m| m.piece == id) {
        remove_number(marks, i + 1);
    }
    if document.pins.iter().any(|pin| pin.place.piece == id) {
        Arc::make_mut(&mut document.pins).retain(|pin| pin.place.piece != id);
        return Ok(Edit::new(label, document).with(ClothChange::SetPins));
    }
    Ok(Edit::new(label, document))
}

pub fn rename(mut document: Document, id: PieceId, name: &str) -> Result<Edit, Rejection> {
    checks::name(name)?;
    let piece = piece_mut(&mut document, id)?;
    let label = format!("rename {} to {name}", piece.name);
    name.clone_into(&mut piece.name);
    Ok(Edit::new(label, document))
}

pub fn set_pose(mut document: Document, id: PieceId, pose: PlanePose) -> Result<Edit, Rejection> {
    checks::pose(&pose)?;
    let piece = piece_mut(&mut document, id)?;
    let label = format!("move {}", piece.name);
    piece.pose = pose;
    Ok(Edit::new(label, document))
}

pub fn set_outline(mut document: Document, id: PieceId, outline: &[Edge]) -> Result<Edit, Rejection> {
    checks::outline(outline)?;
    let sewn = document.pattern.seams.values().any(|s| s.sides.iter().any(|side| side.piece == id));
    let piece = piece_mut(&mut document, id)?;
    if sewn && piece.outline.len() != outline.len() {
        return Err(Rejection(format!(
            "{} is sewn by its {} edges: undo its seams before giving it {}",
            piece.name,
            piece.outline.len(),
            outline.len()
        )));
    }
    let label = format!("redraw {}", piece.name);
    piece.outline = outline.to_vec();
    Ok(Edit::new(label, document))
}

pub fn replace_all(
    mut document: Document,
    name: &str,
    pattern: &Arc<Pattern>,
    marks: &Arc<Marks>,
) -> Result<Edit, Rejection> {
    checks::name(name)?;
    checks::pattern(pattern)?;
    checks::marks(marks, pattern)?;
    document.pattern = Arc::clone(pattern);
    document.take_marks(Arc::clone(marks));
    document.drop_pins();
    Ok(Edit::new(format!("take {name}"), document).with(ClothChange::Clear))
}

fn piece_mut(document: &mut Document, id: PieceId) -> Result<&mut Piece, Rejection> {
    let pattern = Arc::make_mut(&mut document.pattern);
    let piece = pattern.pieces.get_mut(&id).ok_or_else(|| Rejection(format!("there is no {id}")))?;
    Ok(Arc::make_mut(piece))
}
