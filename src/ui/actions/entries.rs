//! How tools and what is done to the pattern are shown and reached.

use egui::Key;

use crate::drag::DragMode;
use crate::ui::actions::layout::Panes;
use crate::ui::actions::{Action, Entry, Tool, ctrl, ctrl_shift, entry, key, shift};

impl Tool {
    /// How it is shown and reached.
    pub fn entry(self) -> Entry {
        match self {
            Self::Mark => entry(
                "Mark",
                "Paint a mark with the left button, on a piece and then on the body where it should lie",
                &[key(Key::K)],
            ),
            Self::Erase => entry("Erase", "Click a mark to take it away", &[key(Key::X)]),
            Self::Move => entry(
                "Move",
                "Select, move, scale and turn pieces on the table; double-click turns one over",
                &[key(Key::V)],
            ),
            Self::Points => {
                entry("Edit points", "Move points, edges and the handles of curves", &[key(Key::A)])
            }
            Self::Pen => entry("Pen", "Draw a piece: a click is a corner, a drag a curve", &[key(Key::B)]),
            Self::Rectangle => entry("Rectangle", "Draw a rectangular piece", &[key(Key::R)]),
            Self::Ellipse => entry("Ellipse", "Draw a round piece", &[key(Key::E)]),
            Self::Sew => entry(
                "Sew",
                "Click an edge and the one it is sewn to, or drag along stretches",
                &[key(Key::S)],
            ),
            Self::Line => entry("Line", "Draw a line inside a piece", &[key(Key::I)]),
            Self::Hole => entry("Hole", "Cut a hole into a piece", &[key(Key::O)]),
            Self::Cut => entry("Cut", "Cut a piece in two along a line from edge to edge", &[key(Key::C)]),
            Self::Dart => entry("Dart", "Drag from an edge into the cloth", &[key(Key::T)]),
            Self::Notch => entry("Notch", "Click an edge where something is to meet", &[key(Key::J)]),
            Self::Grain => entry("Grainline", "Drag along the warp of a piece", &[key(Key::G)]),
            Self::Drag(DragMode::Surface) => {
                entry("Drag", "Drag the cloth along the skin; pins hold it back", &[key(Key::D)])
            }
            Self::Drag(DragMode::Vertex) => {
                entry("Drag a point", "Drag one point of the cloth; the rest follows as it relaxes", &[])
            }
            Self::Drag(DragMode::Rigid) => entry("Drag rigidly", "Move the whole cloth through space", &[]),
            Self::Pin => entry(
                "Pin",
                "Click to pin the cloth where it is, drag for a row of pins, click a pin to pull it out",
                &[key(Key::P)],
            ),
            Self::Place => entry(
                "Place pieces",
                "Stand pieces round the body before they are sewn: select one, then click a dot; drag it, an arrow or a ring",
                &[shift(Key::B)],
            ),
            Self::Bone => entry(
                "Draw bones",
                "Drag through the body to draw a bone, which cloth cannot be pulled across; Ctrl+click takes one away",
                &[],
            ),
        }
    }
}

impl Action {
    /// How what is done to the pattern is shown and reached.
    pub(in crate::ui) fn pattern_entry(self) -> Entry {
        match self {
            Self::SelectAll => entry("Select all", "Select every piece that is shown", &[ctrl(Key::A)]),
            Self::Duplicate => {
                entry("Duplicate", "Copy the selected pieces and the seams among them", &[ctrl(Key::D)])
            }
            Self::Twin => entry(
                "Add a twin",
                "Lay the mirror image of the selected pieces beside them; both stay mirror images",
                &[ctrl_shift(Key::D)],
            ),
            Self::MakeSymmetric => entry(
                "Make symmetric",
                "Mirror the left half over: of the upright middle, or of the line through two selected points",
                &[ctrl(Key::M)],
            ),
            Self::Unfold => {
                entry("Unfold", "Open half a piece out along the selected straight edge", &[ctrl(Key::U)])
            }
            Self::Fold => entry("Fold", "Keep the left half of a symmetric piece only", &[]),
            Self::Unlink => {
                entry("Unlink", "The selected pieces no longer follow their twins or their other half", &[])
            }
            Self::TurnOver => entry("Turn over", "See the other side of the selected pieces", &[key(Key::M)]),
            Self::ToggleLock => entry(
                "Lock",
                "Keep the selected pieces from being changed by the pointer, or the selected pins where they are",
                &[ctrl(Key::L)],
            ),
            Self::ToggleFrozen => entry(
                "Freeze",
                "Draping and relaxing leave the selected pieces where they lie on the body; others collide with them and hang from them",
                &[ctrl(Key::K)],
            ),
            Self::ToggleDeactivated => entry(
                "Deactivate",
                "The selected pieces stay where they lie and count for nothing: nothing touches them, and their seams to others do not hold",
                &[ctrl(Key::J)],
            ),
            Self::Hide => {
                entry("Hide", "Do not show the selected pieces; they are sewn all the same", &[ctrl(Key::H)])
            }
            Self::ShowPieces => entry("Show all pieces", "Show hidden pieces again", &[ctrl_shift(Key::H)]),
            Self::InsertPoint => {
                entry("Insert a point", "Put a point in the middle of the selected edges", &[])
            }
            Self::ToggleSmooth => {
                entry("Smooth", "The outline runs on smoothly at the selected points, or breaks there", &[])
            }
            Self::Straighten => entry("Straight", "Make the selected edges straight", &[]),
            Self::Curve => entry("Curve", "Give the selected edges handles to bend them by", &[]),
            Self::Arc => {
                entry("Arc", "Make the selected edges round: arcs of circles, bent by dragging", &[])
            }
            Self::TurnSeam => {
                entry("Turn seam round", "Sew the selected seams the other way round", &[shift(Key::S)])
            }
            Self::MakeEqual => {
                entry("Make equal", "Give both sides of the selected seams one length, and keep it", &[])
            }
            Self::FreeLengths => {
                entry("Free lengths", "Each side of the selected seams may change alone", &[])
            }
            Self::Untwist => {
                entry("Untwist all seams", "Turn every seam that joins a front to a back", &[key(Key::U)])
            }
            _ => entry("", "", &[]),
        }
    }

    /// How what belongs to the window itself is shown and reached.
    pub(in crate::ui) fn shell_entry(self) -> Entry {
        match self {
            Self::StartPage => {
                entry("Start page", "Begin anew, open a file or a sample, or take the tour", &[])
            }
            Self::OpenRecent(_) => entry("Open again", "Open a file that was open before", &[]),
            Self::ClearRecent => entry("Clear the list", "Forget which files were open before", &[]),
            Self::Picture => entry(
                "Save a picture…",
                "Write the body pane as PNG: any size, any side, on nothing at all, or a full turn",
                &[ctrl_shift(Key::P)],
            ),
            Self::Preferences => {
                entry("Preferences…", "Theme, size, units, mouse, keys", &[ctrl(Key::Comma)])
            }
            Self::ToggleWire => entry("Wireframe", "Show the triangles of the cloth", &[key(Key::W)]),
            Self::ToggleSheer => {
                entry("See through the body", "The body is half transparent", &[key(Key::Q)])
            }
            Self::ToggleXray => entry(
                "X-ray",
                "Marks, pins and seams show through; hidden ones can be clicked",
                &[key(Key::Y)],
            ),
            Self::TogglePairs => entry(
                "Pair lines",
                "Join each mark on the table to its partner on the body until the cloth is dressed",
                &[],
            ),
            Self::Show(Panes::Both) => {
                entry("Pattern and body", "Show both panes side by side", &[ctrl(Key::F9)])
            }
            Self::Show(Panes::Pattern) => {
                entry("Only the pattern", "The pattern takes the whole window", &[key(Key::F9)])
            }
            Self::Show(Panes::Body) => {
                entry("Only the body", "The body takes the whole window", &[key(Key::F10)])
            }
            Self::SwapPanes => entry("Body on the left", "The panes change places", &[]),
            Self::ToggleHistory => entry("History", "Every step; a click goes back to it", &[]),
            Self::ToggleLog => entry("Messages", "What was told so far, to be read again and copied", &[]),
            Self::ToggleMapTable => {
                entry("Table of the map", "What the map shows, in figures, piece by piece", &[])
            }
            Self::Compare => entry(
                "Compare with…",
                "Show the dressed garment of another project of this pattern beside, and how the maps differ",
                &[],
            ),
            Self::ToggleDifference => {
                entry("Difference", "Colour the cloth by what it has more than the one beside", &[])
            }
            Self::ChangeSides => {
                entry("Change sides", "The other garment stands on the other side of this one", &[])
            }
            Self::CloseComparison => entry("End the comparison", "Show only this garment again", &[]),
            Self::CommandPalette => entry(
                "Find a command…",
                "Type a few letters of what you want to do",
                &[ctrl(Key::P), key(Key::F3)],
            ),
            Self::Tour => entry("Tour", "From an empty table to a dressed body in five steps", &[]),
            _ => entry("", "", &[]),
        }
    }
}
