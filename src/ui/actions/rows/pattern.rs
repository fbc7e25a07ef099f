//! Actions of the Pattern menu: drawing tools, and changes to the selection.

use egui::Key;

use crate::ui::actions::row::{Need, Row, ctrl, ctrl_shift, key, row, shift};
use crate::ui::actions::{Action, Tool};

/// The rows in the order of the menus.
pub const ROWS: &[Row] = &[
    row(
        "Pattern › Tools",
        Action::Choose(Tool::Move),
        "Move",
        "Select, move, scale and turn pieces on the table; double-click turns one over",
    )
    .keys(&[key(Key::V)]),
    row(
        "Pattern › Tools",
        Action::Choose(Tool::Points),
        "Edit points",
        "Move points, edges and the handles of curves",
    )
    .keys(&[key(Key::A)]),
    row(
        "Pattern › Tools",
        Action::Choose(Tool::Sew),
        "Sew",
        "Click an edge and the one it is sewn to, or drag along stretches",
    )
    .keys(&[key(Key::S)]),
    row(
        "Pattern › Tools",
        Action::Choose(Tool::Pen),
        "Pen",
        "Draw a piece: a click is a corner, a drag a curve",
    )
    .keys(&[key(Key::B)]),
    row("Pattern › Tools", Action::Choose(Tool::Rectangle), "Rectangle", "Draw a rectangular piece")
        .keys(&[key(Key::R)]),
    row("Pattern › Tools", Action::Choose(Tool::Ellipse), "Ellipse", "Draw a round piece")
        .keys(&[key(Key::E)]),
    row("Pattern › Tools", Action::Choose(Tool::Line), "Line", "Draw a line inside a piece")
        .keys(&[key(Key::I)]),
    row("Pattern › Tools", Action::Choose(Tool::Hole), "Hole", "Cut a hole into a piece")
        .keys(&[key(Key::O)]),
    row(
        "Pattern › Tools",
        Action::Choose(Tool::Cut),
        "Cut",
        "Cut a piece in two along a line from edge to edge",
    )
    .keys(&[key(Key::C)]),
    row("Pattern › Tools", Action::Choose(Tool::Dart), "Dart", "Drag from an edge into the cloth")
        .keys(&[key(Key::T)]),
    row("Pattern › Tools", Action::Choose(Tool::Notch), "Notch", "Click an edge where something is to meet")
        .keys(&[key(Key::J)]),
    row("Pattern › Tools", Action::Choose(Tool::Grain), "Grainline", "Drag along the warp of a piece")
        .keys(&[key(Key::G)]),
    row(
        "Pattern › Tools",
        Action::Choose(Tool::Graphic),
        "Graphics",
        "Move, scale and turn images on pieces",
    ),
    row(
        "Pattern",
        Action::Twin,
        "Add a twin",
        "Lay the mirror image of the selected pieces beside them; both stay mirror images",
    )
    .keys(&[ctrl_shift(Key::D)])
    .needs(&[Need::PickedPiece]),
    row(
        "Pattern",
        Action::MakeSymmetric,
        "Make symmetric",
        "Mirror the left half over: of the upright middle, or of the line through two \
         selected points",
    )
    .keys(&[ctrl(Key::M)])
    .needs(&[Need::PickedPiece]),
    row("Pattern", Action::Unfold, "Unfold", "Open half a piece out along the selected straight edge")
        .keys(&[ctrl(Key::U)])
        .needs(&[Need::PickedStraight]),
    row("Pattern", Action::Fold, "Fold", "Keep the left half of a symmetric piece only")
        .needs(&[Need::PickedSymmetric]),
    row(
        "Pattern",
        Action::Unlink,
        "Unlink",
        "Stop the selected pieces from following their twins or their other half",
    )
    .needs(&[Need::PickedLinked]),
    row("Pattern", Action::TurnOver, "Flip", "Turn the selected pieces over: see their other side")
        .keys(&[key(Key::M)])
        .needs(&[Need::PickedPiece]),
    row(
        "Pattern",
        Action::ToggleLock,
        "Lock",
        "Keep the selected pieces from being changed by the pointer, or the selected \
         pins where they are",
    )
    .keys(&[ctrl(Key::L)])
    .needs(&[Need::PickedPieceOrPin]),
    row(
        "Pattern",
        Action::ToggleFrozen,
        "Freeze",
        "Draping and relaxing leave the selected pieces where they lie on the body; \
         others collide with them and hang from them",
    )
    .keys(&[ctrl(Key::K)])
    .needs(&[Need::PickedPiece]),
    row(
        "Pattern",
        Action::ToggleDeactivated,
        "Deactivate",
        "Leave the selected pieces out: they stay where they lie, nothing touches them, \
         and their seams to others do not hold",
    )
    .keys(&[ctrl(Key::J)])
    .needs(&[Need::PickedPiece]),
    row("Pattern", Action::Hide, "Hide", "Do not show the selected pieces; they are sewn all the same")
        .keys(&[ctrl(Key::H)])
        .needs(&[Need::PickedPiece]),
    row("Pattern", Action::ShowPieces, "Show all pieces", "Show hidden pieces again")
        .keys(&[ctrl_shift(Key::H)])
        .needs(&[Need::Hidden]),
    row("Pattern", Action::InsertPoint, "Insert a point", "Put a point in the middle of the selected edges")
        .needs(&[Need::PickedEdge]),
    row(
        "Pattern",
        Action::ToggleSmooth,
        "Smooth",
        "Make outlines and lines smooth at the selected points, or break them there",
    )
    .needs(&[Need::PickedPoint]),
    row("Pattern", Action::Straighten, "Straight", "Make the selected edges straight")
        .needs(&[Need::PickedEdge]),
    row("Pattern", Action::Curve, "Curve", "Give the selected edges handles to bend them by")
        .needs(&[Need::PickedEdge]),
    row("Pattern", Action::Arc, "Arc", "Make the selected edges round: arcs of circles, bent by dragging")
        .needs(&[Need::PickedEdge]),
    row("Pattern", Action::ToggleFold, "Fold line", "Crease draped cloth along the selected edges and lines")
        .needs(&[Need::PickedLine]),
    row("Pattern", Action::ToggleElastic, "Elastic", "Sew elastic along the selected edges and lines")
        .needs(&[Need::PickedLine]),
    row("Pattern", Action::ToggleTopstitch, "Topstitching", "Stitch along the selected edges and lines")
        .needs(&[Need::PickedLine]),
    row("Pattern", Action::ToggleHem, "Hem", "Turn in the selected edges and sew them down")
        .needs(&[Need::PickedEdge]),
    row(
        "Pattern",
        Action::TogglePiping,
        "Piping",
        "Sew a covered cord in along the selected edges and lines",
    )
    .needs(&[Need::PickedLine]),
    row(
        "Pattern",
        Action::ToggleWrinkle,
        "Wrinkle",
        "Raise the cloth to a soft wrinkle along the selected lines, or smooth it out",
    )
    .needs(&[Need::PickedInnerLine]),
    row(
        "Pattern",
        Action::AddBow,
        "Bow…",
        "Tack a bow of ribbon to the selected place: a mark on the cloth, a point, a line, an edge or the middle of a piece",
    )
    .needs(&[Need::BowPlace]),
    row("Pattern", Action::ToggleZip, "Zip", "Put a zip into the selected seams, or take it out")
        .needs(&[Need::PickedSeam]),
    row("Pattern", Action::ToggleFastened, "Fasten buttons", "Fasten all buttons, or unfasten them")
        .needs(&[Need::Buttons]),
    row("Pattern", Action::TurnSeam, "Reverse seam", "Sew the selected seams the other way round")
        .keys(&[shift(Key::S)])
        .needs(&[Need::PickedSeam]),
    row(
        "Pattern",
        Action::MakeEqual,
        "Make equal",
        "Give both sides of the selected seams one length, and keep it",
    )
    .needs(&[Need::PickedSeam]),
    row(
        "Pattern",
        Action::FreeLengths,
        "Free lengths",
        "Let each side of the selected seams change its length alone",
    )
    .needs(&[Need::PickedSeam]),
    row("Pattern", Action::Untwist, "Untwist all seams", "Turn every seam that joins a front to a back")
        .keys(&[key(Key::U)])
        .needs(&[Need::Twisted]),
];
