//! Proposed marks that are not accepted yet: they are shown, but are not part of the document.

use std::sync::Arc;

use crate::body::Surface;
use crate::pattern::Pattern;
use crate::session::carry::moved;
use crate::session::{Document, Session};
use crate::wrap::{Marks, suggested};

/// Proposed marks, with the pattern and body they were proposed for.
#[derive(Clone, Debug)]
pub struct Ghosts {
    /// The marks, at least one pair.
    pub marks: Arc<Marks>,
    pattern: Arc<Pattern>,
    surface: Arc<Surface>,
}

impl Ghosts {
    /// Proposes marks for the pattern and body of `session`; None when none can be proposed.
    pub fn proposed(session: &Session) -> Option<Self> {
        let document = session.document();
        let surface = session.surface()?;
        let offset = document.settings.relax.offset * surface.scale();
        Self::of(Arc::new(suggested(&document.pattern, surface, offset)), session)
    }

    /// `marks` as proposed for the pattern and body of `session`; None without a pair or a body.
    pub fn of(marks: Arc<Marks>, session: &Session) -> Option<Self> {
        marks.pairs().next()?;
        let surface = Arc::clone(session.surface()?);
        Some(Self { marks, pattern: Arc::clone(&session.document().pattern), surface })
    }

    /// These on the body as it is now: moved with its skin where only its pose or size has changed. None if the pieces or the body
    /// are others than those that the marks were proposed for. Moving pieces on the table does not matter.
    pub fn now(mut self, document: &Document, surface: Option<&Arc<Surface>>) -> Option<Self> {
        let outlines =
            |p: &Pattern| p.pieces.iter().map(|(id, piece)| (*id, piece.outline.clone())).collect::<Vec<_>>();
        let surface = surface?;
        if !Arc::ptr_eq(&self.pattern, &document.pattern)
            && outlines(&self.pattern) != outlines(&document.pattern)
        {
            return None;
        }
        if !Arc::ptr_eq(surface, &self.surface) {
            self.marks = Arc::new(moved(&self.marks, &self.surface, surface)?);
            self.surface = Arc::clone(surface);
        }
        Some(self)
    }
}
