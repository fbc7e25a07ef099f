//! Actions of the Edit menu, and the tools for marks.

use egui::Key;

use crate::ui::actions::row::{Need, Row, ctrl, ctrl_shift, key, row};
use crate::ui::actions::{Action, Tool};

/// The rows in the order of the menus.
pub const ROWS: &[Row] = &[
    row("Edit", Action::Preferences, "Preferences…", "Theme, size, units, mouse, keys")
        .keys(&[ctrl(Key::Comma)])
        .in_demos()
        .on_start_page(),
    row("Edit", Action::Undo, "Undo", "Take the last step back").keys(&[ctrl(Key::Z)]).needs(&[Need::Undo]),
    row("Edit", Action::Redo, "Redo", "Do the step again")
        .keys(&[ctrl_shift(Key::Z), ctrl(Key::Y)])
        .needs(&[Need::Redo]),
    row("Edit", Action::Delete, "Delete", "Take away what is selected: marks, pieces, points, seams")
        .keys(&[key(Key::Delete), key(Key::Backspace)])
        .needs(&[Need::Selection]),
    row("Edit", Action::SelectAll, "Select all", "Select every piece that is shown")
        .keys(&[ctrl(Key::A)])
        .needs(&[Need::Pieces]),
    row("Edit", Action::Duplicate, "Duplicate", "Copy the selected pieces and the seams among them")
        .keys(&[ctrl(Key::D)])
        .needs(&[Need::PickedPiece]),
    row("Edit", Action::DeleteMark, "Delete mark", "Take the selected mark away").needs(&[Need::Mark]),
    row("Edit", Action::RaiseMark, "Move mark up", "Give the selected mark the number before")
        .keys(&[ctrl(Key::ArrowUp)])
        .needs(&[Need::Mark, Need::NotFirstMark]),
    row("Edit", Action::LowerMark, "Move mark down", "Give the selected mark the number after")
        .keys(&[ctrl(Key::ArrowDown)])
        .needs(&[Need::Mark, Need::NotLastMark]),
    row(
        "Edit",
        Action::ToggleLaser,
        "Laser",
        "Strokes go through: front and back of the body, and every piece that lies there",
    )
    .keys(&[key(Key::L)]),
    row(
        "Edit",
        Action::SuggestMarks,
        "Suggest marks",
        "Propose marks from where the pattern file puts the pieces round the body",
    ),
    row("Edit", Action::AcceptMarks, "Accept", "Take the proposed marks instead of those there are")
        .keys(&[key(Key::Enter)])
        .aside(),
    row("Edit", Action::DismissMarks, "Dismiss", "Forget the proposed marks")
        .keys(&[key(Key::Escape)])
        .aside(),
    row("Edit", Action::ClearMarks, "Clear all marks", "Take every mark away, on cloth and body")
        .needs(&[Need::Marks]),
    row(
        "Tools",
        Action::Choose(Tool::Mark),
        "Mark",
        "Paint a mark with the left button, on a piece and then on the body where it \
         should lie",
    )
    .keys(&[key(Key::K)]),
    row("Tools", Action::Choose(Tool::Erase), "Erase", "Click a mark to take it away").keys(&[key(Key::X)]),
];
