//! Marks proposed and not accepted yet: they are seen, and never in the document.

use std::sync::Arc;

use crate::body::Surface;
use crate::pattern::Pattern;
use crate::session::{Document, Session};
use crate::wrap::{Marks, suggested};

/// Proposed marks, and what they were proposed for.
#[derive(Clone, Debug)]
pub struct Ghosts {
    /// At least one pair.
    pub marks: Arc<Marks>,
    pattern: Arc<Pattern>,
    surface: Arc<Surface>,
}

impl Ghosts {
    /// Marks for the pattern and body of `session`. None when none can be proposed.
    pub fn proposed(session: &Session) -> Option<Self> {
        let document = session.document();
        let surface = session.surface()?;
        let offset = document.settings.relax.offset * surface.scale();
        Self::of(Arc::new(suggested(&document.pattern, surface, offset)), session)
    }

    /// These marks, proposed for the pattern and body of `session`. None without a pair or a body.
    pub fn of(marks: Arc<Marks>, session: &Session) -> Option<Self> {
        marks.pairs().next()?;
        let surface = Arc::clone(session.surface()?);
        Some(Self { marks, pattern: Arc::clone(&session.document().pattern), surface })
    }

    /// Whether pieces and body are still those they were proposed for. Pieces may have been moved on the table.
    pub fn fit(&self, document: &Document, surface: Option<&Arc<Surface>>) -> bool {
        let outlines =
            |p: &Pattern| p.pieces.iter().map(|(id, piece)| (*id, piece.outline.clone())).collect::<Vec<_>>();
        surface.is_some_and(|s| Arc::ptr_eq(s, &self.surface))
            && (Arc::ptr_eq(&self.pattern, &document.pattern)
                || outlines(&self.pattern) == outlines(&document.pattern))
    }
}
