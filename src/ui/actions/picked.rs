//! A summary of the selection in the pattern, for menus.

use std::collections::BTreeSet;

use crate::geometry::ids::PieceId;
use crate::pattern::activity::Activity;
use crate::pattern::{Pattern, RulePoint};
use crate::ui::pattern_pane::edits::{deletions, is_rolled, is_straight};
use crate::ui::selection::Selection;

/// What the selection in the pattern consists of, for menus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Picked {
    /// Number of selected pieces, including those of selected points and edges.
    pub pieces: usize,
    /// Number of selected points at which a line can be smooth or have a corner: all but the ends of lines inside pieces.
    pub points: usize,
    pub edges: usize,
    /// Number of selected lines inside pieces.
    pub lines: usize,
    /// Whether the pattern has a button.
    pub buttons: bool,
    pub seams: usize,
    pub pins: usize,
    /// Whether one of the pieces is symmetric.
    pub symmetric: bool,
    /// Whether one of the pieces is a twin or symmetric.
    pub linked: bool,
    /// Whether one of the edges is straight and part of an outline.
    pub straight: bool,
    /// Whether all of the pieces are locked.
    pub locked: bool,
    /// The activity in draping, if it is the same for all of the pieces.
    pub activity: Option<Activity>,
    /// Whether something selected can be deleted.
    pub deletable: bool,
    /// Whether some piece of the pattern is hidden.
    pub hidden: bool,
    /// Whether one of the pieces is placed around the body.
    pub standing: bool,
    /// Whether all of the placed pieces are rolled.
    pub rolled: bool,
}

impl Picked {
    /// The summary of `selection`.
    pub fn new(pattern: &Pattern, selection: &Selection) -> Self {
        let touched: BTreeSet<PieceId> = selection.pieces_touched();
        let pieces = || touched.iter().filter_map(|id| pattern.pieces.get(id));
        let has_corner = |at: &RulePoint| pattern.pieces.get(&at.piece)?.is_smooth_at(at);
        let first = pieces().next().map(|piece| piece.activity);
        Self {
            pieces: touched.len(),
            points: selection.all_points().filter(|at| has_corner(at).is_some()).count(),
            edges: selection.edges.len(),
            lines: selection.lines.len(),
            buttons: !pattern.buttons.is_empty(),
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
