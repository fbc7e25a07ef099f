//! Everything that can be chosen, in one table: menus, buttons, tooltips and shortcuts all read it.

pub(in crate::ui) mod asks;
pub mod catalogue;
pub(in crate::ui) mod context;
pub(in crate::ui) mod drawer;
pub(in crate::ui) mod entries;
pub(in crate::ui) mod keymap;
pub(in crate::ui) mod layout;
pub(in crate::ui) mod picked;
pub(in crate::ui) mod sight;

use egui::{Key, KeyboardShortcut, Modifiers, ThemePreference};

use crate::drag::DragMode;
use crate::fit::MapKind;
use crate::io::pdf::Paper;
use crate::render::View;
use crate::session::demos::Demo;
use crate::session::samples::Sample;
use crate::ui::actions::layout::Panes;
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::units::LengthUnit;

/// What the left mouse button does in the panes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Paints marks on cloth and body.
    #[default]
    Mark,
    /// Takes marks away.
    Erase,
    /// Selects, moves, scales, turns and flips pieces.
    Move,
    /// Moves points, edges and curves of pieces.
    Points,
    /// Draws pieces point by point.
    Pen,
    /// Draws rectangular pieces.
    Rectangle,
    /// Draws round pieces.
    Ellipse,
    /// Sews edges together.
    Sew,
    /// Draws lines on pieces.
    Line,
    /// Cuts holes into pieces.
    Hole,
    /// Cuts pieces in two.
    Cut,
    /// Stands pieces round the body, before they are sewn.
    Place,
    /// Cuts darts into edges.
    Dart,
    /// Cuts notches into edges.
    Notch,
    /// Draws the arrow along the warp.
    Grain,
    /// Drags dressed cloth.
    Drag(DragMode),
    /// Pins dressed cloth to where it is.
    Pin,
    /// Draws bones in the body.
    Bone,
}

/// Something that can be chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    New,
    StartPage,
    Sample(Sample),
    Open,
    /// The file with this place in the list of those opened before, from 0.
    OpenRecent(u8),
    ClearRecent,
    Save,
    SaveAs,
    SaveCopy,
    SaveNext,
    Revert,
    ImportPattern,
    ExportPattern,
    ImportBody,
    PoseFromFile,
    /// Take numbered OBJ files as an animation of the body.
    Sequence,
    Sizes,
    UseMannequin,
    Export,
    FitPage,
    Picture,
    SaveRecording,
    Preferences,
    Quit,
    Undo,
    Redo,
    Delete,
    DeleteMark,
    RaiseMark,
    LowerMark,
    ClearMarks,
    ClearPins,
    OwnBones,
    NoBones,
    /// Bring the pieces to where they belong on this body.
    BringPieces,
    /// Roll standing pieces, or make them flat.
    ToggleRolled,
    /// Take pieces from the body: they stand nowhere.
    Unplace,
    SuggestMarks,
    AcceptMarks,
    DismissMarks,
    ToggleLaser,
    Choose(Tool),
    SelectAll,
    Duplicate,
    Twin,
    MakeSymmetric,
    Unfold,
    Fold,
    Unlink,
    TurnOver,
    ToggleLock,
    ToggleFrozen,
    ToggleDeactivated,
    Hide,
    ShowPieces,
    InsertPoint,
    ToggleSmooth,
    Straighten,
    Curve,
    Arc,
    TurnSeam,
    MakeEqual,
    FreeLengths,
    Untwist,
    Dress,
    Wrap,
    Rewrap,
    CancelWrap,
    Unwrap,
    Sew,
    ToggleRelaxing,
    ToggleDrape,
    StepDrape,
    Look(View),
    FrameAll,
    FrameSelection,
    TrueSize,
    NextPane,
    PreviousPane,
    ToggleSnapping,
    ClearGuides,
    Unit(LengthUnit),
    ToggleParallel,
    ToggleFreeTurning,
    ToggleCloth,
    ToggleWire,
    ToggleSheer,
    ToggleXray,
    TogglePairs,
    TogglePanel,
    Show(Panes),
    SwapPanes,
    ToggleHistory,
    ToggleLog,
    /// Colours the cloth; None: as it is.
    Map(Option<MapKind>),
    ToggleMapTable,
    Compare,
    ToggleDifference,
    ChangeSides,
    CloseComparison,
    Theme(ThemePreference),
    Mouse(Mouse),
    Paper(Paper),
    CommandPalette,
    Shortcuts,
    Tour,
    Demo(Demo),
    StopDemo,
}

/// How an action is shown and reached.
#[derive(Clone, Debug)]
pub struct Entry {
    /// In menus and on buttons.
    pub text: &'static str,
    /// In tooltips.
    pub tip: &'static str,
    /// Keys, the first one shown.
    pub keys: Vec<KeyboardShortcut>,
}

pub(in crate::ui) const fn key(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

pub(in crate::ui) const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

pub(in crate::ui) const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

pub(in crate::ui) const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
}

pub(in crate::ui) fn entry(text: &'static str, tip: &'static str, keys: &[KeyboardShortcut]) -> Entry {
    Entry { text, tip, keys: keys.to_vec() }
}

impl Action {
    /// How it is shown and reached.
    pub fn entry(self) -> Entry {
        match self {
            Self::New => entry("New", "Start with an empty table and the mannequin", &[ctrl(Key::N)]),
            Self::Sample(sample) => entry(sample.name(), "Open this sample with its marks", &[]),
            Self::Open => entry("Open…", "Open a project", &[ctrl(Key::O)]),
            Self::Save => entry("Save", "Save the project", &[ctrl(Key::S)]),
            Self::SaveAs => entry("Save as…", "Save the project under another name", &[ctrl_shift(Key::S)]),
            Self::SaveCopy => {
                entry("Save a copy…", "Save the project under another name and go on with this one", &[])
            }
            Self::SaveNext => entry(
                "Save the next version",
                "Save the project beside its file, with the next number in its name",
                &[KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::ALT), Key::S)],
            ),
            Self::Revert => entry("Revert…", "Go back to what the file holds", &[]),
            Self::ImportPattern => {
                entry("Import pattern…", "Take the pieces of a DXF, SVG or GarmentCode file", &[ctrl(Key::I)])
            }
            Self::ImportBody => entry("Import body…", "Take a body from an OBJ or glTF file", &[]),
            Self::PoseFromFile => entry(
                "Pose from a file…",
                "Lead the body to its pose in an OBJ or glTF file or through the animations there, or the mannequin through a BVH motion",
                &[],
            ),
            Self::Sequence => entry(
                "Sequence of OBJ files…",
                "Take numbered OBJ files, one for each picture, as an animation of the body",
                &[],
            ),
            Self::Sizes => entry(
                "Sizes from a table…",
                "Read the sizes of a table (CSV), to build the mannequin to one of them",
                &[],
            ),
            Self::UseMannequin => entry("Use the mannequin", "Go back to the built-in figure", &[]),
            Self::ExportPattern => entry(
                "Export pattern…",
                "Write the pieces as .pdf in true size, .svg, .dxf or .json (GarmentCode)",
                &[ctrl_shift(Key::E)],
            ),
            Self::Export => entry("Export…", "Write the dressed garment as .obj or .glb", &[ctrl(Key::E)]),
            Self::FitPage => entry(
                "Fit report…",
                "Write views, ease, seams, strain and maps of the dressed garment on one page (HTML)",
                &[],
            ),
            Self::SaveRecording => {
                entry("Save recording…", "Write everything done so far as a script that can be replayed", &[])
            }
            Self::Quit => entry("Quit", "Leave Toile", &[ctrl(Key::Q)]),
            Self::Undo => entry("Undo", "Take the last step back", &[ctrl(Key::Z)]),
            Self::Redo => entry("Redo", "Do the step again", &[ctrl_shift(Key::Z), ctrl(Key::Y)]),
            Self::Delete => entry(
                "Delete",
                "Take away what is selected: marks, pieces, points, seams",
                &[key(Key::Delete), key(Key::Backspace)],
            ),
            Self::DeleteMark => entry("Delete mark", "Take the selected mark away", &[]),
            Self::RaiseMark => {
                entry("Move mark up", "Give the selected mark the number before", &[ctrl(Key::ArrowUp)])
            }
            Self::LowerMark => {
                entry("Move mark down", "Give the selected mark the number after", &[ctrl(Key::ArrowDown)])
            }
            Self::ClearMarks => entry("Clear all marks", "Take every mark away, on cloth and body", &[]),
            Self::SuggestMarks => entry(
                "Suggest marks",
                "Propose marks from where the pattern file puts the pieces round the body",
                &[],
            ),
            Self::AcceptMarks => {
                entry("Accept", "Take the proposed marks instead of those there are", &[key(Key::Enter)])
            }
            Self::DismissMarks => entry("Dismiss", "Forget the proposed marks", &[key(Key::Escape)]),
            Self::ToggleLaser => entry(
                "Laser",
                "Strokes go through: front and back of the body, and every piece that lies there",
                &[key(Key::L)],
            ),
            Self::Choose(tool) => tool.entry(),
            Self::SelectAll
            | Self::Duplicate
            | Self::Twin
            | Self::MakeSymmetric
            | Self::Unfold
            | Self::Fold
            | Self::Unlink
            | Self::TurnOver
            | Self::ToggleLock
            | Self::ToggleFrozen
            | Self::ToggleDeactivated
            | Self::Hide
            | Self::ShowPieces
            | Self::InsertPoint
            | Self::ToggleSmooth
            | Self::Straighten
            | Self::Curve
            | Self::Arc
            | Self::TurnSeam
            | Self::MakeEqual
            | Self::FreeLengths
            | Self::Untwist => self.pattern_entry(),
            Self::OwnBones => {
                entry("The body's own bones", "Those it came with, or those found in it, and none drawn", &[])
            }
            Self::NoBones => entry("No bones", "Cloth can be pulled across everything", &[]),
            Self::BringPieces => entry(
                "Bring pieces to the body",
                "Move the pieces as a whole to where they belong on this body, and sleeves on to its arms",
                &[],
            ),
            Self::ToggleRolled => {
                entry("Roll", "Roll the pieces that stand round a limb into tubes, or make them flat", &[])
            }
            Self::Unplace => entry(
                "Take pieces from the body",
                "They stand nowhere and are not sewn from placement; the table keeps them",
                &[],
            ),
            Self::ClearPins => entry("Pull all pins out", "Nothing holds the cloth any more", &[]),
            Self::Dress => entry(
                "Dress",
                "Put the garment on by the best start: marks, its own or suggested ones, or sewn from placement",
                &[ctrl(Key::Enter)],
            ),
            Self::Wrap => {
                entry("Wrap", "Grow the cloth round the body so that the marks meet", &[key(Key::Enter)])
            }
            Self::Rewrap => entry(
                "Rewrap",
                "Wrap the dressed cloth again by its new marks; pins keep what lies beyond them",
                &[KeyboardShortcut::new(Modifiers::SHIFT, Key::Enter)],
            ),
            Self::CancelWrap => {
                entry("Cancel", "Stop, and bring back what was on the body before", &[key(Key::Escape)])
            }
            Self::Unwrap => entry("Take the cloth off", "The body is bare again; the marks stay", &[]),
            Self::ToggleRelaxing => {
                let keys = &[KeyboardShortcut::new(Modifiers::SHIFT, Key::Space)];
                entry("Relax", "Let the cloth even itself out, or hold it still", keys)
            }
            Self::Sew => entry(
                "Sew from placement",
                "Draw the seams shut from where the pieces stand round the body, and drape",
                &[],
            ),
            Self::ToggleDrape => entry(
                "Drape",
                "Let weight and fabric move the dressed cloth until it rests, or pause",
                &[key(Key::Space)],
            ),
            Self::StepDrape => entry("Drape a step", "Drape for a sixtieth of a second", &[]),
            Self::Look(view) => look_entry(view),
            Self::StartPage
            | Self::OpenRecent(_)
            | Self::ClearRecent
            | Self::Picture
            | Self::Preferences
            | Self::ToggleWire
            | Self::ToggleSheer
            | Self::ToggleXray
            | Self::TogglePairs
            | Self::Show(_)
            | Self::SwapPanes
            | Self::ToggleHistory
            | Self::ToggleLog
            | Self::ToggleMapTable
            | Self::Compare
            | Self::ToggleDifference
            | Self::ChangeSides
            | Self::CloseComparison
            | Self::CommandPalette
            | Self::Tour => self.shell_entry(),
            Self::Map(None) => entry("No map", "Show the cloth in its own colours", &[]),
            Self::Map(Some(kind)) => entry(kind.title(), kind.tip(), &[]),
            Self::FrameAll => {
                entry("Show all", "Fit everything in the pane under the pointer", &[key(Key::Home)])
            }
            Self::FrameSelection => entry(
                "Show the selection",
                "Fit what is selected in the pane under the pointer, or everything where nothing is",
                &[key(Key::F), key(Key::Period), shift(Key::F)],
            ),
            Self::TrueSize => entry(
                "True size",
                "Show the pattern as large as it is, on a screen that tells its size",
                &[ctrl(Key::Num0)],
            ),
            Self::NextPane => entry(
                "Next pane",
                "Give the keyboard to the pattern, the body, the side panel or the tools",
                &[key(Key::F6)],
            ),
            Self::PreviousPane => entry("Previous pane", "The same, the other way round", &[shift(Key::F6)]),
            Self::ToggleSnapping => entry(
                "Snap",
                "Points, edges, guides and the grid draw the pointer on; Alt keeps it free",
                &[shift(Key::G)],
            ),
            Self::ClearGuides => entry("Clear guides", "Guides are dragged out of the rulers", &[]),
            Self::Unit(unit) => entry(unit.name(), "Show lengths in this unit", &[]),
            Self::ToggleParallel => {
                entry("Parallel projection", "Near and far look the same size", &[key(Key::Num5)])
            }
            Self::ToggleFreeTurning => {
                entry("Free turning", "Turn the body like a ball instead of keeping it upright", &[])
            }
            Self::ToggleCloth => {
                entry("Show the cloth", "Hide the cloth to paint beneath it", &[key(Key::H)])
            }
            Self::TogglePanel => entry("Side panel", "Marks, cloth settings and problems", &[key(Key::N)]),
            Self::Theme(ThemePreference::Light) => entry("Light", "Dark text on light", &[]),
            Self::Theme(ThemePreference::Dark) => entry("Dark", "Light text on dark", &[]),
            Self::Theme(ThemePreference::System) => entry("As the system", "Follow the desktop", &[]),
            Self::Mouse(mouse) => entry(mouse.name(), mouse.tip(), &[]),
            Self::Paper(Paper::A4) => entry("A4", "Patterns as PDF are A4 pages to be glued together", &[]),
            Self::Paper(Paper::Letter) => {
                entry("Letter", "Patterns as PDF are Letter pages to be glued together", &[])
            }
            Self::Paper(Paper::One) => {
                entry("One page", "Patterns as PDF are one page as large as it must be, for a plotter", &[])
            }
            Self::Demo(demo) => entry(demo.name(), demo.tells(), &[]),
            Self::StopDemo => entry("Stop the demo", "Go back to your own work", &[]),
            Self::Shortcuts => entry("Keys and mouse", "What each key and button does", &[key(Key::F1)]),
        }
    }

    /// Whether it may be chosen while a demo is shown: what changes nothing but the view.
    pub fn is_for_demos(self) -> bool {
        matches!(
            self,
            Self::Look(_)
                | Self::FrameAll
                | Self::FrameSelection
                | Self::ToggleWire
                | Self::ToggleSheer
                | Self::ToggleXray
                | Self::TogglePairs
                | Self::ToggleLog
                | Self::Map(_)
                | Self::ToggleMapTable
                | Self::ToggleDifference
                | Self::ChangeSides
                | Self::CloseComparison
                | Self::CommandPalette
                | Self::Preferences
                | Self::Picture
                | Self::TrueSize
                | Self::NextPane
                | Self::PreviousPane
                | Self::Unit(_)
                | Self::ToggleParallel
                | Self::ToggleFreeTurning
                | Self::TogglePanel
                | Self::Theme(_)
                | Self::Mouse(_)
                | Self::Paper(_)
                | Self::Shortcuts
                | Self::Demo(_)
                | Self::StopDemo
                | Self::Quit
        )
    }

    /// Whether the start page stays when it is chosen there; everything else goes to the panes.
    pub fn stays_on_start_page(self) -> bool {
        matches!(
            self,
            Self::StartPage
                | Self::Open
                | Self::OpenRecent(_)
                | Self::CommandPalette
                | Self::ClearRecent
                | Self::Preferences
                | Self::Shortcuts
                | Self::Quit
                | Self::Unit(_)
                | Self::Theme(_)
                | Self::Mouse(_)
                | Self::Paper(_)
        )
    }

    /// Whether a plain key belongs to it, which a focused widget may want for itself.
    pub fn is_plain(shortcut: KeyboardShortcut) -> bool {
        shortcut.modifiers.is_none()
    }
}

fn look_entry(view: View) -> Entry {
    match view {
        View::Front => entry("Front", "Look from the front", &[key(Key::Num1)]),
        View::Back => entry("Back", "Look from behind", &[ctrl(Key::Num1)]),
        View::Right => entry("Right", "Look from the body's right", &[key(Key::Num3)]),
        View::Left => entry("Left", "Look from the body's left", &[ctrl(Key::Num3)]),
        View::Top => entry("Top", "Look from above", &[key(Key::Num7)]),
        View::Below => entry("Below", "Look from below", &[ctrl(Key::Num7)]),
        View::ThreeQuarter => {
            entry("Three-quarter", "Look from the front and left, a little above", &[key(Key::Num2)])
        }
        View::Angles { .. } => entry("View", "Look from there", &[]),
    }
}

/// Views with a name, in menu order.
pub const VIEWS: [View; 7] =
    [View::Front, View::Back, View::Left, View::Right, View::Top, View::Below, View::ThreeQuarter];
