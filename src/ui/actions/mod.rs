//! Everything that can be chosen: the actions with their table, the tools, and the requests of panes and panels.

pub(in crate::ui) mod asks;
pub(in crate::ui) mod context;
pub(in crate::ui) mod drawer;
pub mod keymap;
pub(in crate::ui) mod layout;
pub(in crate::ui) mod picked;
pub(in crate::ui) mod row;
pub mod rows;
pub(in crate::ui) mod sight;

use crate::body::NamedPose;
use crate::drag::DragMode;
use crate::fit::MapKind;
use crate::io::pdf::Paper;
use crate::render::{Light, View};
use crate::session::demos::Demo;
use crate::session::samples::Sample;
use crate::ui::actions::layout::Panes;
use crate::ui::look::scheme::Theme;
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::units::LengthUnit;
use crate::ui::scenery::body_look::BodyLook;

/// A tool, which the left mouse button uses in the panes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Paints marks on cloth and body.
    #[default]
    Mark,
    /// Deletes marks.
    Erase,
    /// Selects, moves, scales, turns and flips pieces.
    Move,
    /// Moves points, edges and curves of outlines.
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
    /// Places pieces around the body before they are sewn.
    Place,
    /// Cuts darts into edges.
    Dart,
    /// Cuts notches into edges.
    Notch,
    /// Draws the grainline.
    Grain,
    /// Moves, scales and turns graphics on pieces.
    Graphic,
    /// Drags dressed cloth.
    Drag(DragMode),
    /// Pins dressed cloth to where it is.
    Pin,
    /// Draws lines of pieces on the dressed cloth.
    ClothLine,
    /// Draws bones inside the body.
    Bone,
}

/// An action: something that can be chosen in menus, on buttons or by keys.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    New,
    StartPage,
    Sample(Sample),
    Open,
    /// Open the file at this index (from 0) of the recent files.
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
    /// Take an image into the document.
    AddImage,
    PoseFromFile,
    /// Read numbered OBJ files as an animation of the body.
    Sequence,
    Sizes,
    UseMannequin,
    /// Put the mannequin in this pose.
    Pose(NamedPose),
    /// Cut all pieces from the fabric with this number (from 0) among the presets.
    Fabric(u8),
    Export,
    FitPage,
    TechPack,
    Marker,
    /// Dress all sizes of the pattern.
    DressAllSizes,
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
    /// Move the placed pieces to the body, and sleeves to its arms.
    BringPieces,
    /// Roll placed pieces round the limbs, or make them flat.
    ToggleRolled,
    /// Remove the placement of pieces.
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
    ToggleFold,
    ToggleElastic,
    ToggleTopstitch,
    ToggleHem,
    TogglePiping,
    ToggleWrinkle,
    /// Ask for a bow at the selected place.
    AddBow,
    ToggleZip,
    ToggleFastened,
    TurnSeam,
    MakeEqual,
    FreeLengths,
    Untwist,
    Dress,
    Wrap,
    Rewrap,
    Cancel,
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
    Light(Light),
    /// Light the scene by an image of the surroundings.
    EnvironmentMap,
    /// Light the scene by that image, or put it aside.
    ToggleEnvironment,
    /// Show or hide the bar that rotates the environment map.
    RotateEnvironment,
    /// Blur what is out of focus, or nothing.
    ToggleDepthOfField,
    /// Show or hide the bar of the aperture.
    SetAperture,
    BodyLook(BodyLook),
    /// Draw stitches along seams, or seams as lines alone.
    ToggleSeamStitches,
    TogglePanel,
    Show(Panes),
    SwapPanes,
    ToggleHistory,
    ToggleLog,
    /// Colour the cloth by a map; None: by its own colours.
    Map(Option<MapKind>),
    ToggleMapTable,
    Compare,
    ToggleDifference,
    ChangeSides,
    CloseComparison,
    Theme(Theme),
    Mouse(Mouse),
    Paper(Paper),
    CommandPalette,
    Shortcuts,
    Manual,
    Tour,
    Demo(Demo),
    StopDemo,
}

/// Tools of the pattern pane in the order of their strip and menu, group by group.
pub const PATTERN_TOOLS: [&[Tool]; 4] = [
    &[Tool::Move, Tool::Points],
    &[Tool::Pen, Tool::Rectangle, Tool::Ellipse],
    &[Tool::Sew],
    &[Tool::Line, Tool::Hole, Tool::Cut, Tool::Dart, Tool::Notch, Tool::Grain, Tool::Graphic],
];

/// Whether `shortcut` is a key without modifiers, which a focused widget may need itself.
pub fn is_plain(shortcut: egui::KeyboardShortcut) -> bool {
    shortcut.modifiers.is_none()
}

/// Views with a name, in menu order.
pub const VIEWS: [View; 7] =
    [View::Front, View::Back, View::Left, View::Right, View::Top, View::Below, View::ThreeQuarter];
