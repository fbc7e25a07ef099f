//! What is known of an action: its words, its keys, where it is found and what it needs.

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::ui::actions::Action;

/// One row of the table of actions.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Which.
    pub action: Action,
    /// The menu it is found in.
    pub menu: &'static str,
    /// In menus and on buttons.
    pub text: &'static str,
    /// In tooltips.
    pub tip: &'static str,
    /// Keys, the first one shown.
    pub keys: &'static [KeyboardShortcut],
    /// What must be before it can be chosen; the first that lacks is told.
    pub needs: &'static [Need],
    /// It may be chosen while a demo is shown: it changes nothing but the view.
    pub in_demos: bool,
    /// The start page stays when it is chosen there; everything else goes to the panes.
    pub on_start_page: bool,
    /// It is not found among all others: it can be chosen only where it is offered.
    pub aside: bool,
}

/// What an action may need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// A demo is shown.
    Demo,
    /// The file that was open before is still there.
    RecentFile,
    /// Some file was open before.
    Recent,
    /// No pictures are being made.
    NotPicturing,
    /// A graphics adapter.
    Adapter,
    /// Something to undo.
    Undo,
    /// Something to do again.
    Redo,
    /// The project is in a file.
    File,
    /// A piece on the table.
    Pieces,
    /// A body that cloth can be put on.
    Body,
    /// Cloth on the body.
    Dressed,
    /// A wrap is under way.
    Growing,
    /// None is.
    NotGrowing,
    /// No start is being tried.
    NotTrying,
    /// Physics is not moving the cloth.
    NotDraping,
    /// A piece that stands round the body,
    Placed,
    /// to be sewn from there,
    PlacedFirst,
    /// or a pair of marks.
    PlacedOrPairs,
    /// A pair of marks.
    Pairs,
    /// A pair of marks for cloth that is dressed.
    NewPairs,
    /// Any mark.
    Marks,
    /// A selected mark.
    Mark,
    /// It can be given the number before,
    NotFirstMark,
    /// or after.
    NotLastMark,
    /// A pin.
    Pins,
    /// Another garment shown beside.
    Comparison,
    /// A selection that can be deleted.
    Selection,
    /// A selected piece,
    PickedPiece,
    /// or pin.
    PickedPieceOrPin,
    /// A selected straight edge of an outline.
    PickedStraight,
    /// A selected symmetric piece,
    PickedSymmetric,
    /// or twin.
    PickedLinked,
    /// A selected piece that stands round the body.
    Standing,
    /// A selected edge.
    PickedEdge,
    /// A selected point.
    PickedPoint,
    /// A selected seam.
    PickedSeam,
    /// A hidden piece.
    Hidden,
    /// A twisted seam.
    Twisted,
}

/// An action of `menu` that can always be chosen and has no keys.
pub const fn row(menu: &'static str, action: Action, text: &'static str, tip: &'static str) -> Row {
    let (keys, needs): (&[KeyboardShortcut], &[Need]) = (&[], &[]);
    Row { action, menu, text, tip, keys, needs, in_demos: false, on_start_page: false, aside: false }
}

impl Row {
    /// With these keys.
    pub const fn keys(self, keys: &'static [KeyboardShortcut]) -> Self {
        Self { keys, ..self }
    }

    /// Only where there is all of this.
    pub const fn needs(self, needs: &'static [Need]) -> Self {
        Self { needs, ..self }
    }

    /// Also while a demo is shown.
    pub const fn in_demos(self) -> Self {
        Self { in_demos: true, ..self }
    }

    /// The start page stays.
    pub const fn on_start_page(self) -> Self {
        Self { on_start_page: true, ..self }
    }

    /// Only where it is offered.
    pub const fn aside(self) -> Self {
        Self { aside: true, ..self }
    }
}

/// `key` alone,
pub const fn key(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

/// with Shift,
pub const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

/// with Ctrl (Cmd on a Mac),
pub const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

/// with both.
pub const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
}
