//! The body.

use std::sync::Arc;

use crate::session::command::Rejection;
use crate::session::document::{BodyChoice, Document};
use crate::session::edit::{ClothChange, Edit, checks};

/// Strokes on the old body mean nothing on the new one.
pub fn set(mut document: Document, body: &BodyChoice) -> Result<Edit, Rejection> {
    checks::body(body)?;
    if document.body == *body {
        return Err(Rejection::new("that is the body already"));
    }
    document.body = body.clone();
    if !document.marks.body.is_empty() {
        Arc::make_mut(&mut document.marks).body.clear();
    }
    document.drop_pins();
    Ok(Edit::new("change the body", document).with(ClothChange::Clear))
}
