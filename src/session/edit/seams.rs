//! Seams.

use std::sync::Arc;

use crate::geometry::ids::SeamId;
use crate::pattern::Seam;
use crate::session::command::Rejection;
use crate::session::document::Document;
use crate::session::edit::{Edit, checks};

pub fn add(mut document: Document, seam: Seam) -> Result<Edit, Rejection> {
    if seam.sides[0] == seam.sides[1] {
        return Err(Rejection::new("an edge cannot be sewn to itself"));
    }
    let mut names = Vec::new();
    for side in seam.sides {
        let piece = checks::find_piece(&document.pattern, side.piece)?;
        if side.edge >= piece.outline.len() {
            return Err(Rejection(format!("{} has no edge {}", piece.name, side.edge + 1)));
        }
        let sewn = document.pattern.seams.values().any(|s| s.sides.contains(&side));
        if sewn {
            return Err(Rejection(format!("edge {} of {} is sewn already", side.edge + 1, piece.name)));
        }
        names.push(piece.name.clone());
    }
    Arc::make_mut(&mut document.pattern).add_seam(seam);
    Ok(Edit::new(format!("sew {} to {}", names[0], names[1]), document))
}

pub fn delete(mut document: Document, id: SeamId) -> Result<Edit, Rejection> {
    checks::find_seam(&document.pattern, id)?;
    Arc::make_mut(&mut document.pattern).seams.remove(&id);
    Ok(Edit::new(format!("unpick {id}"), document))
}

pub fn reverse(mut document: Document, id: SeamId) -> Result<Edit, Rejection> {
    checks::find_seam(&document.pattern, id)?;
    if let Some(seam) = Arc::make_mut(&mut document.pattern).seams.get_mut(&id) {
        seam.same_direction = !seam.same_direction;
    }
    Ok(Edit::new(format!("turn {id} round"), document))
}
