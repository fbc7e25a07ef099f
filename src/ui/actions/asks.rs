//! What panes and panels ask for. They read the document and never change it.

use crate::fit::MapKind;
use crate::geometry::ids::MarkId;
use crate::session::Command;
use crate::sim::ClothPlace;
use crate::ui::actions::Action;
use crate::ui::selection::Selection;

/// One wish.
#[derive(Clone, Debug, PartialEq)]
pub enum Ask {
    /// Choose something.
    Act(Action),
    /// Carry out a command as a step of its own.
    Do(Command),
    /// Carry out a command as part of the drag under way.
    Drag(Command),
    /// The drag is over.
    EndDrag,
    /// Take the drag back.
    CancelDrag,
    /// Select a mark, or none.
    Select(Option<MarkId>),
    /// Select this of the pattern, and nothing else.
    Pick(Selection),
    /// Select the first of the pairs of marks with these numbers (from 1), and show them all.
    ShowMarks(Vec<usize>),
    /// Select the piece of this tight place, ring the place and turn the view to it.
    ShowPlace(ClothPlace),
    /// Go this many steps back (less than 0) or forth in the history.
    Jump(i32),
    /// Let the colours of a map span this, in the unit that is shown; None: as far as its values do.
    MapRange(MapKind, Option<[f64; 2]>),
    /// Say something to the person.
    Say(String),
}

/// Wishes in order.
pub type Asks = Vec<Ask>;

/// Asks for `commands` as one step of undo.
pub fn in_one_step(commands: Vec<Command>, asks: &mut Asks) {
    if !commands.is_empty() {
        asks.extend(commands.into_iter().map(Ask::Drag));
        asks.push(Ask::EndDrag);
    }
}
