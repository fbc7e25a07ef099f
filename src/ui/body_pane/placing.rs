//! Data of the placement tool: the arrangement points of the body, and the placed pieces.

use std::sync::Arc;

use crate::body::Surface;
use crate::contact::Bone;
use crate::place::{Point, points};
use crate::session::Document;
use crate::ui::body_pane::Places;
use crate::ui::body_pane::standing::Standing;
use crate::ui::selection::Selection;

/// Arrangement points and placed pieces, computed anew when body or pattern change.
#[derive(Debug, Default)]
pub struct Placing {
    standing: Standing,
    of: Option<(Arc<Surface>, Arc<Vec<Bone>>)>,
    points: Vec<Point>,
}

impl Placing {
    /// Updates both for the pieces and the body of `document`.
    pub fn update(&mut self, document: &Document, body: Option<&Arc<Surface>>, bones: &Arc<Vec<Bone>>) {
        self.standing.update(&document.pattern);
        let Some(body) = body else {
            (self.of, self.points) = (None, Vec::new());
            return;
        };
        let is_same =
            |(surface, old): &(Arc<Surface>, Arc<Vec<Bone>>)| Arc::ptr_eq(surface, body) && old == bones;
        if !self.of.as_ref().is_some_and(is_same) {
            self.of = Some((Arc::clone(body), Arc::clone(bones)));
            self.points = points(body, bones);
        }
    }

    /// The part of it that the pane shows.
    pub fn places<'a>(&'a self, selection: &'a Selection) -> Places<'a> {
        Places { points: &self.points, standing: &self.standing, selected: &selection.pieces }
    }
}
