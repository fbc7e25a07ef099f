//! Seams.

use std::sync::Arc;

use crate::geometry::ids::SeamId;
use crate::pattern::Seam;
use crate::pattern::edit::fits;
use crate::session::command::Rejection;
use crate::session::document::Document;
use crate::session::edit::{Edit, checks};

pub fn add(mut document: Document, seam: Seam) -> Result<Edit, Rejection> {
    fits(&document.pattern, &seam).map_err(Rejection)?;
    let name = |k: usize| document.pattern.pieces[&seam.sides[k].piece].name.clone();
    let label = format!("sew {} to {}", name(0), name(1));
    Arc::make_mut(&mut document.pattern).add_seam(seam);
    Ok(Edit::new(label, document))
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
