//! The row of an action in the table: its texts, keys, menu and needs.

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::session::samples::Sample;
use crate::ui::actions::Action;
use crate::ui::language::{tr, translated};

/// One row of the table of actions.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The action.
    pub action: Action,
    /// The menu that it is in.
    pub menu: &'static str,
    /// Label in menus and on buttons.
    pub text: &'static str,
    /// Tooltip.
    pub tip: &'static str,
    /// Default keys; menus show the first.
    pub keys: &'static [KeyboardShortcut],
    /// What the action needs to be enabled; the first need that is not met gives the reason.
    pub needs: &'static [Need],
    /// Whether it is enabled while a demo is shown: it changes nothing but the view.
    pub in_demos: bool,
    /// Whether the start page stays open when it is chosen there.
    pub on_start_page: bool,
    /// Whether it is left out of the list of all actions: it can be chosen only where it is offered.
    pub aside: bool,
}

/// A condition for an action to be enabled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// A demo is shown.
    Demo,
    /// The recent file still exists.
    RecentFile,
    /// There are recent files.
    Recent,
    /// No pictures are being made.
    NotPicturing,
    /// There is a graphics adapter.
    Adapter,
    /// There is a step to undo.
    Undo,
    /// There is a step to redo.
    Redo,
    /// The project has a file.
    File,
    /// The pattern has a piece.
    Pieces,
    /// The pattern has sizes.
    Sizes,
    /// There is a body that cloth can be put on.
    Body,
    /// The body has joints that take poses by name.
    Joints,
    /// There is cloth on the body.
    Dressed,
    /// Work on the cloth is in progress that can be stopped.
    Work,
    /// No wrap is in progress.
    NotGrowing,
    /// No start is being tried.
    NotTrying,
    /// Draping is not moving the cloth.
    NotDraping,
    /// A piece is placed around the body.
    Placed,
    /// A piece is placed around the body. The message says how to place one.
    PlacedFirst,
    /// A piece is placed around the body, or there is a pair of marks.
    PlacedOrPairs,
    /// There is a pair of marks.
    Pairs,
    /// There is a pair of marks. The message asks to paint new ones for dressed cloth.
    NewPairs,
    /// There is a mark.
    Marks,
    /// A mark is selected.
    Mark,
    /// The selected mark is not the first.
    NotFirstMark,
    /// The selected mark is not the last.
    NotLastMark,
    /// There is a pin.
    Pins,
    /// Another garment is shown beside.
    Comparison,
    /// An environment map is chosen; it may be put aside.
    KeptEnvironment,
    /// An environment map lights the scene.
    EnvironmentMap,
    /// The projection is perspective.
    Perspective,
    /// The graphics adapter can draw depth of field.
    Blurring,
    /// What is out of focus is blurred.
    DepthOfField,
    /// Something that can be deleted is selected.
    Selection,
    /// A piece is selected.
    PickedPiece,
    /// A piece or a pin is selected.
    PickedPieceOrPin,
    /// A straight edge of an outline is selected.
    PickedStraight,
    /// A symmetric piece is selected.
    PickedSymmetric,
    /// A symmetric piece or a twin is selected.
    PickedLinked,
    /// A piece that is placed around the body is selected.
    Standing,
    /// An edge is selected.
    PickedEdge,
    /// An edge or a line inside a piece is selected.
    PickedLine,
    /// A line inside a piece is selected.
    PickedInnerLine,
    /// A place for a bow is selected: a mark on the cloth, or something of one piece.
    BowPlace,
    /// There is a button.
    Buttons,
    /// A point is selected.
    PickedPoint,
    /// A seam is selected.
    PickedSeam,
    /// A piece is hidden.
    Hidden,
    /// A seam is twisted.
    Twisted,
}

/// An action of `menu` that is always enabled and has no keys.
pub const fn row(menu: &'static str, action: Action, text: &'static str, tip: &'static str) -> Row {
    let (keys, needs): (&[KeyboardShortcut], &[Need]) = (&[], &[]);
    Row { action, menu, text, tip, keys, needs, in_demos: false, on_start_page: false, aside: false }
}

impl Row {
    /// The label in the language of the window.
    pub fn label(&self) -> &'static str {
        // Only in English the sample is called like the action that puts it on.
        let is_garment = self.action == Action::Sample(Sample::Dress);
        let garment = if is_garment { translated("Dress, a sample") } else { None };
        garment.unwrap_or(tr(self.text))
    }

    /// The menu that it is in, in the language of the window.
    pub fn place(&self) -> String {
        self.menu.split(" › ").map(tr).collect::<Vec<_>>().join(" › ")
    }

    /// The row with these default keys.
    pub const fn keys(self, keys: &'static [KeyboardShortcut]) -> Self {
        Self { keys, ..self }
    }

    /// The row with these needs.
    pub const fn needs(self, needs: &'static [Need]) -> Self {
        Self { needs, ..self }
    }

    /// The row of an action that is also enabled while a demo is shown.
    pub const fn in_demos(self) -> Self {
        Self { in_demos: true, ..self }
    }

    /// The row of an action that leaves the start page open.
    pub const fn on_start_page(self) -> Self {
        Self { on_start_page: true, ..self }
    }

    /// The row of an action that is left out of the list of all actions.
    pub const fn aside(self) -> Self {
        Self { aside: true, ..self }
    }
}

/// The shortcut of `key` alone.
pub const fn key(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

/// The shortcut of `key` with Shift.
pub const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

/// The shortcut of `key` with Ctrl (Cmd on a Mac).
pub const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

/// The shortcut of `key` with Shift and Ctrl (Cmd on a Mac).
pub const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
}
