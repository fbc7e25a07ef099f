//! What can be said of a selection.

use std::collections::BTreeSet;

use crate::geometry::ids::PieceId;
use crate::pattern::Pattern;
use crate::pattern::activity::Activity;
use crate::ui::pattern_pane::edits::{deletions, is_rolled, is_straight};
use crate::ui::selection::Selection;

/// What can be said of the selection, for menus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Picked {
    /// Pieces, or pieces that points and edges are of.
    pub pieces: usize,
    pub points: usize,
    pub edges: usize,
    pub seams: usize,
    pub pins: usize,
    /// One of the pieces is its own mirror image.
    pub symmetric: bool,
    /// One of the pieces follows another, or its other half.
    pub linked: bool,
    /// One of the edges is straight and on an outline.
    pub straight: bool,
    /// All of the pieces are locked.
    pub locked: bool,
    /// What draping does with all of the pieces, where that is the same.
    pub activity: Option<Activity>,
    /// Anything that can be deleted.
    pub deletable: bool,
    /// Some piece of the pattern is hidden.
    pub hidden: bool,
    /// One of the pieces stands round the body.
    pub standing: bool,
    /// All of those that do are rolled.
    pub rolled: bool,
}

impl Picked {
    /// Of `selection`.
    pub fn new(pattern: &Pattern, selection: &Selection) -> Self {
        let touched: BTreeSet<PieceId> = selection.pieces_touched();
        let pieces = || touched.iter().filter_map(|id| pattern.pieces.get(id));
        let first = pieces().next().map(|piece| piece.activity);
        Self {
            pieces: touched.len(),
            points: selection.points.len(),
            edges: selection.edges.len(),
            seams: selection.seams.len(),
            pins: selection.pins.len(),
            symmetric: pieces().any(|piece| piece.symmetric),
            linked: pieces().any(|piece| piece.symmetric || piece.twin.is_some()),
            straight: selection.edges.iter().any(|edge| is_straight(pattern, *edge)),
            locked: !touched.is_empty() && pieces().all(|piece| piece.locked),
            activity: first.filter(|first| pieces().all(|piece| piece.activity == *first)),
            deletable: !selection.pins.is_empty() || !deletions(pattern, selection).is_empty(),
            hidden: pattern.pieces.values().any(|piece| piece.hidden),
            standing: pieces().any(|piece| piece.placement.is_some()),
            rolled: is_rolled(pattern, &touched),
        }
    }
}
