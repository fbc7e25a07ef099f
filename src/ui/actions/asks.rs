//! Requests that panes and panels make to the app. They read the document and never change it themselves.

use crate::fit::MapKind;
use crate::geometry::ids::MarkId;
use crate::session::Command;
use crate::sim::ClothPlace;
use crate::ui::actions::Action;
use crate::ui::pattern_pane::nests::SizeView;
use crate::ui::selection::Selection;

/// A request to the app.
#[derive(Clone, Debug, PartialEq)]
pub enum Ask {
    /// Run an action, as if it was chosen in a menu.
    Act(Action),
    /// Apply a command as an undo step of its own.
    Do(Command),
    /// Apply a command as part of the drag in progress.
    Drag(Command),
    /// End the drag.
    EndDrag,
    /// Undo what the drag has done and end it.
    CancelDrag,
    /// Select a mark, or no mark.
    Select(Option<MarkId>),
    /// Replace the selection in the pattern.
    Pick(Selection),
    /// Select the first of the pairs of marks with these numbers (from 1), and turn the view to all of them.
    ShowMarks(Vec<usize>),
    /// Select the piece of this tight place, draw a ring round the place and turn the view to it.
    ShowPlace(ClothPlace),
    /// Go this many steps through the history: negative undoes, positive redoes.
    Jump(i32),
    /// Set the range of values that the colours of a map span, in the unit that is shown; None: the range of its values.
    MapRange(MapKind, Option<[f64; 2]>),
    /// Show these sizes of the pattern.
    ShowSizes(SizeView),
    /// Show a message to the user.
    Say(String),
}

/// Requests in the order in which they were made.
pub type Asks = Vec<Ask>;

/// Requests that `commands` are applied as one undo step.
pub fn in_one_step(commands: Vec<Command>, asks: &mut Asks) {
    if !commands.is_empty() {
        asks.extend(commands.into_iter().map(Ask::Drag));
        asks.push(Ask::EndDrag);
    }
}
