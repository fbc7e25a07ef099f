//! Actions of the View menu.

use egui::Key;

use crate::render::View;
use crate::ui::actions::Action;
use crate::ui::actions::layout::Panes;
use crate::ui::actions::row::{Need, Row, ctrl, key, row, shift};
use crate::ui::look::scheme::Theme;

/// The rows in the order of the menus.
pub const ROWS: &[Row] = &[
    row("View", Action::Look(View::Front), "Front", "Look from the front").keys(&[key(Key::Num1)]).in_demos(),
    row("View", Action::Look(View::Back), "Back", "Look from behind").keys(&[ctrl(Key::Num1)]).in_demos(),
    row("View", Action::Look(View::Left), "Left", "Look from the body's left")
        .keys(&[ctrl(Key::Num3)])
        .in_demos(),
    row("View", Action::Look(View::Right), "Right", "Look from the body's right")
        .keys(&[key(Key::Num3)])
        .in_demos(),
    row("View", Action::Look(View::Top), "Top", "Look from above").keys(&[key(Key::Num7)]).in_demos(),
    row("View", Action::Look(View::Below), "Below", "Look from below").keys(&[ctrl(Key::Num7)]).in_demos(),
    row(
        "View",
        Action::Look(View::ThreeQuarter),
        "Three-quarter",
        "Look from the front and left, a little above",
    )
    .keys(&[key(Key::Num2)])
    .in_demos(),
    row("View", Action::FrameAll, "Show all", "Fit everything in the pane under the pointer")
        .keys(&[key(Key::Home)])
        .in_demos(),
    row(
        "View",
        Action::FrameSelection,
        "Show the selection",
        "Fit what is selected in the pane under the pointer, or everything where nothing is",
    )
    .keys(&[key(Key::F), key(Key::Period), shift(Key::F)])
    .in_demos(),
    row(
        "View",
        Action::TrueSize,
        "True size",
        "Show the pattern as large as it is, on a screen that tells its size",
    )
    .keys(&[ctrl(Key::Num0)])
    .in_demos(),
    row(
        "View",
        Action::ToggleParallel,
        "Parallel projection",
        "Show near and far at the same size (orthographic)",
    )
    .keys(&[key(Key::Num5)])
    .in_demos(),
    row(
        "View",
        Action::ToggleFreeTurning,
        "Free turning",
        "Turn the body like a ball instead of keeping it upright",
    )
    .in_demos(),
    row("View", Action::ToggleCloth, "Show the cloth", "Show or hide the cloth, to paint beneath it")
        .keys(&[key(Key::H)])
        .needs(&[Need::Dressed]),
    row("View", Action::ToggleWire, "Wireframe", "Show the triangles of the cloth")
        .keys(&[key(Key::W)])
        .in_demos(),
    row("View", Action::ToggleSheer, "See through the body", "Make the body half transparent")
        .keys(&[key(Key::Q)])
        .in_demos(),
    row(
        "View",
        Action::ToggleXray,
        "X-ray",
        "Marks, pins and seams show through; hidden ones can be clicked",
    )
    .keys(&[key(Key::Y)])
    .in_demos(),
    row(
        "View",
        Action::TogglePairs,
        "Pair lines",
        "Join each mark on the table to its partner on the body until the cloth is dressed",
    )
    .in_demos(),
    row(
        "View",
        Action::ToggleSnapping,
        "Snap",
        "Snap the pointer to points, edges, guides and the grid; hold Alt to move freely",
    )
    .keys(&[shift(Key::G)]),
    row(
        "View",
        Action::ClearGuides,
        "Clear guides",
        "Remove all guides; new ones are dragged out of the rulers",
    ),
    row("View", Action::TogglePanel, "Side panel", "Marks, cloth settings and problems")
        .keys(&[key(Key::N)])
        .in_demos(),
    row("View", Action::Show(Panes::Both), "Pattern and body", "Show both panes side by side")
        .keys(&[ctrl(Key::F9)]),
    row("View", Action::Show(Panes::Pattern), "Only the pattern", "The pattern takes the whole window")
        .keys(&[key(Key::F9)]),
    row("View", Action::Show(Panes::Body), "Only the body", "The body takes the whole window")
        .keys(&[key(Key::F10)]),
    row("View", Action::SwapPanes, "Body on the left", "Swap the two panes"),
    row("View", Action::ToggleHistory, "History", "Every step; a click goes back to it"),
    row("View", Action::ToggleLog, "Messages", "What was told so far, to be read again and copied")
        .in_demos(),
    row("View › Map", Action::Map(None), "No map", "Show the cloth in its own colours").in_demos(),
    row(
        "View › Map",
        Action::ToggleMapTable,
        "Table of the map",
        "What the map shows, in figures, piece by piece",
    )
    .in_demos(),
    row(
        "View",
        Action::Compare,
        "Compare with…",
        "Show the dressed garment of another project of this pattern beside, and how the \
         maps differ",
    )
    .needs(&[Need::Dressed]),
    row(
        "View",
        Action::ToggleDifference,
        "Difference",
        "Colour the cloth by its difference to the garment beside",
    )
    .needs(&[Need::Comparison])
    .in_demos(),
    row("View", Action::ChangeSides, "Swap sides", "Put the other garment on the other side of this one")
        .needs(&[Need::Comparison])
        .in_demos(),
    row("View", Action::CloseComparison, "Close comparison", "Show only this garment again")
        .needs(&[Need::Comparison])
        .in_demos(),
    row(
        "View",
        Action::NextPane,
        "Next pane",
        "Give the keyboard to the next pane or bar: pattern, body, side panel, tools, menus",
    )
    .keys(&[key(Key::F6)])
    .in_demos(),
    row("View", Action::PreviousPane, "Previous pane", "The same, the other way round")
        .keys(&[shift(Key::F6)])
        .in_demos(),
    row("View › Theme", Action::Theme(Theme::Dark), Theme::Dark.name(), "Light text on dark")
        .in_demos()
        .on_start_page(),
    row("View › Theme", Action::Theme(Theme::Light), Theme::Light.name(), "Dark text on light")
        .in_demos()
        .on_start_page(),
    row(
        "View › Theme",
        Action::Theme(Theme::HighContrast),
        Theme::HighContrast.name(),
        "White on black, with strong lines and borders",
    )
    .in_demos()
    .on_start_page(),
    row("View › Theme", Action::Theme(Theme::System), Theme::System.name(), "Follow the desktop")
        .in_demos()
        .on_start_page(),
    row(
        "View › Theme",
        Action::EnvironmentMap,
        "Environment map…",
        "Light the scene from all sides by an image of the surroundings (HDRI)",
    )
    .in_demos(),
    row(
        "View › Theme",
        Action::ToggleEnvironment,
        "Light by environment map",
        "Light the scene by the environment map that was chosen last, or by the light alone",
    )
    .needs(&[Need::KeptEnvironment])
    .in_demos(),
    row(
        "View › Theme",
        Action::RotateEnvironment,
        "Rotate environment map",
        "Turn the light of the environment map about the vertical axis",
    )
    .needs(&[Need::EnvironmentMap])
    .in_demos(),
    row(
        "View › Theme",
        Action::ToggleSeamStitches,
        "Seam stitches",
        "Draw stitches along seams, or seams as lines alone, as in a picture of the garment",
    )
    .in_demos(),
    row(
        "View › Theme",
        Action::ToggleDepthOfField,
        "Depth of field",
        "Blur what is nearer or farther than the surface in the middle of the picture, as a lens does",
    )
    .needs(&[Need::Perspective, Need::Blurring])
    .in_demos(),
    row(
        "View › Theme",
        Action::SetAperture,
        "Set aperture",
        "Choose the f-number: the smaller it is, the stronger the blur",
    )
    .needs(&[Need::Perspective, Need::DepthOfField])
    .in_demos(),
];
