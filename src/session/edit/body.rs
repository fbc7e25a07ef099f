//! The body.

use std::sync::Arc;

use crate::contact::Bone;
use crate::session::body::BodyCache;
use crate::session::carry::carried;
use crate::session::command::Rejection;
use crate::session::document::{BodyChoice, Document};
use crate::session::edit::{ClothChange, Edit, checks};

/// Strokes on the old body are carried to the new one.
pub fn set(mut document: Document, body: &BodyChoice, bodies: &mut BodyCache) -> Result<Edit, Rejection> {
    checks::body(body)?;
    if document.body == *body {
        return Err(Rejection::new("that is the body already"));
    }
    let to = bodies.body(body)?;
    let mut problems = Vec::new();
    if !document.marks.body.is_empty() {
        let from = bodies.body(&document.body).ok();
        let (marks, lost) = carried(&document.marks, from.as_deref(), &to, body.name());
        document.marks = Arc::new(marks);
        problems = lost;
    }
    document.drop_pins();
    document.bones = None;
    document.body = body.clone();
    Ok(Edit { problems, ..Edit::new("change the body", document).with(ClothChange::Clear) })
}

/// Bones drawn by the user, or the body's own again.
pub fn set_bones(mut document: Document, bones: Option<&[Bone]>) -> Result<Edit, Rejection> {
    bones.map_or(Ok(()), checks::bones)?;
    document.bones = bones.map(|bones| Arc::new(bones.to_vec()));
    Ok(Edit::new("bones", document))
}
