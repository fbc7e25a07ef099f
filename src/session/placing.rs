//! Placement of the pieces of a pattern round the document's body.

use std::sync::Arc;

use crate::pattern::Pattern;
use crate::place::{Moved, onto};
use crate::session::body::Body;
use crate::session::document::Document;

/// The placement of `pattern`, as a file has it, adapted to the body of `document`, which is `body`.
pub fn brought(pattern: &Pattern, document: &Document, body: &Body) -> Moved {
    let bones = document.bones.clone().unwrap_or_else(|| Arc::clone(body.bones()));
    let offset = document.settings.relax.offset * body.surface.scale();
    onto(pattern, &body.surface, &bones, offset)
}
