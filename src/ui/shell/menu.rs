//! The menu bar and context menus. All entries come from the table of actions.

use egui::style::ScrollStyle;
use egui::{Button, ScrollArea, TextWrapMode};

use crate::drag::DragMode;
use crate::io::pdf::Paper;
use crate::render::Light;
use crate::session::demos::Demo;
use crate::session::samples::Sample;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::FrameContext;
use crate::ui::actions::layout::Panes;
use crate::ui::actions::{Action, PATTERN_TOOLS, Tool, VIEWS};
use crate::ui::language::keys::shortcut_text;
use crate::ui::language::{say, tr};
use crate::ui::look::scheme::Theme;
use crate::ui::maps;
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::units::LengthUnit;
use crate::ui::scenery::body_look::BodyLook;

/// Height that the frame of a menu takes, and least height of its entries, points.
const FRAME: f32 = 20.0;
const LOWEST: f32 = 80.0;

/// Draws the menu bar.
pub fn menu_bar_ui(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks) {
    egui::MenuBar::new().ui(ui, |ui| {
        menu(ui, tr("File"), |ui| file_ui(ui, now, asks));
        menu(ui, tr("Edit"), |ui| {
            items(ui, now, asks, &[Action::Undo, Action::Redo]);
            ui.separator();
            items(ui, now, asks, &[Action::SelectAll, Action::Duplicate, Action::Delete]);
            ui.separator();
            items(ui, now, asks, &[Action::RaiseMark, Action::LowerMark, Action::DeleteMark]);
            ui.separator();
            items(ui, now, asks, &[Action::ToggleLaser, Action::SuggestMarks, Action::ClearMarks]);
            ui.separator();
            items(ui, now, asks, &[Action::Preferences]);
        });
        menu(ui, tr("Pattern"), |ui| pattern_ui(ui, now, asks));
        menu(ui, tr("Garment"), |ui| {
            items(
                ui,
                now,
                asks,
                &[Action::Dress, Action::Wrap, Action::Rewrap, Action::Cancel, Action::DressAllSizes],
            );
            items(ui, now, asks, &[Action::Unwrap]);
            ui.separator();
            items(ui, now, asks, &[Action::Choose(Tool::Place), Action::BringPieces]);
            items(ui, now, asks, &[Action::ToggleRolled, Action::Unplace, Action::Sew]);
            ui.separator();
            items(ui, now, asks, &[Action::ToggleRelaxing, Action::ToggleDrape, Action::StepDrape]);
            ui.separator();
            let drags = [DragMode::Surface, DragMode::Vertex, DragMode::Rigid];
            items(ui, now, asks, &drags.map(|mode| Action::Choose(Tool::Drag(mode))));
            items(ui, now, asks, &[Action::Choose(Tool::Pin), Action::ClearPins]);
            items(ui, now, asks, &[Action::Choose(Tool::ClothLine)]);
            ui.separator();
            ui.menu_button(tr("Bones"), |ui| {
                items(ui, now, asks, &[Action::Choose(Tool::Bone), Action::OwnBones, Action::NoBones]);
            });
        });
        menu(ui, tr("View"), |ui| view_ui(ui, now, asks));
        menu(ui, tr("Help"), |ui| help_ui(ui, now, asks));
    });
}

/// A menu of the bar. Where the window is lower than it, it scrolls: its last entries could not be reached otherwise.
fn menu(ui: &mut egui::Ui, name: &str, contents: impl FnOnce(&mut egui::Ui)) {
    let below = ui.ctx().content_rect().bottom() - ui.max_rect().bottom() - FRAME;
    ui.menu_button(name, |ui| {
        ui.set_max_height(below.max(LOWEST));
        // The bar has a place of its own, and does not lie over the keys.
        ui.spacing_mut().scroll = ScrollStyle::thin();
        ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
        ScrollArea::vertical().show(ui, contents);
    });
}

fn file_ui(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks) {
    items(ui, now, asks, &[Action::New]);
    ui.menu_button(tr("Samples"), |ui| {
        for sample in Sample::ALL {
            item(ui, now, asks, Action::Sample(sample));
        }
    });
    items(ui, now, asks, &[Action::Open]);
    ui.menu_button(tr("Open recent"), |ui| recent_ui(ui, now, asks));
    items(ui, now, asks, &[Action::StartPage]);
    ui.separator();
    items(ui, now, asks, &[Action::Save, Action::SaveAs, Action::SaveCopy, Action::SaveNext, Action::Revert]);
    ui.separator();
    items(
        ui,
        now,
        asks,
        &[
            Action::ImportPattern,
            Action::ImportBody,
            Action::AddImage,
            Action::UseMannequin,
            Action::Sizes,
            Action::PoseFromFile,
            Action::Sequence,
        ],
    );
    ui.separator();
    items(ui, now, asks, &[Action::ExportPattern]);
    ui.menu_button(tr("Paper"), |ui| items(ui, now, asks, &Paper::ALL.map(Action::Paper)));
    items(
        ui,
        now,
        asks,
        &[
            Action::Export,
            Action::Marker,
            Action::TechPack,
            Action::FitPage,
            Action::Picture,
            Action::SaveRecording,
        ],
    );
    ui.separator();
    items(ui, now, asks, &[Action::Quit]);
}

fn recent_ui(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks) {
    if now.recent.is_empty() {
        ui.weak(tr("No file was open before"));
    }
    for (i, file) in now.recent.iter().enumerate() {
        let (name, folder) = file.name();
        let why_not = now.why_not(Action::OpenRecent(i as u8));
        let button = Button::new(name).shortcut_text(folder).min_size(egui::vec2(260.0, 0.0));
        let response = ui.add_enabled(why_not.is_none(), button);
        let words = say!("Open again: {name}", name = file.name().0);
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::accesskit::Role::Button, why_not.is_none(), words.clone())
        });
        let response = response.on_hover_text(file.path.display().to_string());
        if response.on_disabled_hover_text(why_not.unwrap_or_default()).clicked() {
            asks.push(Ask::Act(Action::OpenRecent(i as u8)));
            ui.close();
        }
    }
    ui.separator();
    item(ui, now, asks, Action::ClearRecent);
}

fn pattern_ui(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks) {
    ui.menu_button(tr("Tools"), |ui| {
        for (i, tools) in PATTERN_TOOLS.into_iter().enumerate() {
            if i > 0 {
                ui.separator();
            }
            tools.iter().for_each(|&tool| item(ui, now, asks, Action::Choose(tool)));
        }
    });
    ui.separator();
    selection_ui(ui, now, asks);
    ui.separator();
    items(ui, now, asks, &[Action::Untwist, Action::ShowPieces]);
}

/// Draws the entries for the selection in the pattern.
pub fn selection_ui(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks) {
    items(
        ui,
        now,
        asks,
        &[Action::Twin, Action::MakeSymmetric, Action::Unfold, Action::Fold, Action::Unlink],
    );
    ui.separator();
    items(
        ui,
        now,
        asks,
        &[
            Action::TurnOver,
            Action::ToggleLock,
            Action::ToggleFrozen,
            Action::ToggleDeactivated,
            Action::Hide,
        ],
    );
    ui.separator();
    items(
        ui,
        now,
        asks,
        &[Action::InsertPoint, Action::ToggleSmooth, Action::Straighten, Action::Curve, Action::Arc],
    );
    ui.separator();
    items(ui, now, asks, &TRIMS);
    ui.separator();
    items(ui, now, asks, &[Action::TurnSeam, Action::MakeEqual, Action::FreeLengths]);
}

/// What is worked along edges, lines and seams.
const TRIMS: [Action; 9] = [
    Action::ToggleFold,
    Action::ToggleElastic,
    Action::ToggleTopstitch,
    Action::ToggleHem,
    Action::TogglePiping,
    Action::ToggleWrinkle,
    Action::AddBow,
    Action::ToggleZip,
    Action::ToggleFastened,
];

/// Draws the context menu of the table.
pub fn context_ui(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks) {
    let picked = &now.picked;
    let mut groups: Vec<&[Action]> = Vec::new();
    if picked.points + picked.edges > 0 {
        groups.push(&[
            Action::InsertPoint,
            Action::ToggleSmooth,
            Action::Straighten,
            Action::Curve,
            Action::Arc,
            Action::Unfold,
        ]);
    }
    if picked.seams > 0 {
        groups.push(&[Action::TurnSeam, Action::MakeEqual, Action::FreeLengths]);
    }
    if picked.pieces > 0 {
        groups.push(&[Action::Duplicate, Action::Twin, Action::MakeSymmetric, Action::Fold, Action::Unlink]);
        groups.push(&[
            Action::TurnOver,
            Action::ToggleLock,
            Action::ToggleFrozen,
            Action::ToggleDeactivated,
            Action::Hide,
        ]);
    }
    groups.push(&[Action::Delete, Action::SelectAll, Action::ShowPieces]);
    groups.push(&[Action::FrameAll, Action::FrameSelection]);
    for (i, group) in groups.into_iter().enumerate() {
        if i > 0 {
            ui.separator();
        }
        items(ui, now, asks, group);
    }
}

fn view_ui(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks) {
    ui.menu_button(tr("Look from"), |ui| items(ui, now, asks, &VIEWS.map(Action::Look)));
    items(ui, now, asks, &[Action::FrameAll, Action::FrameSelection, Action::TrueSize]);
    items(ui, now, asks, &[Action::ToggleParallel, Action::ToggleFreeTurning]);
    ui.separator();
    items(ui, now, asks, &[Action::ToggleWire, Action::ToggleSheer, Action::ToggleXray, Action::TogglePairs]);
    ui.menu_button(tr("Look of the body"), |ui| items(ui, now, asks, &BodyLook::ALL.map(Action::BodyLook)));
    ui.menu_button(tr("Map"), |ui| {
        maps::choices().for_each(|kind| item(ui, now, asks, Action::Map(kind)));
        ui.separator();
        item(ui, now, asks, Action::ToggleMapTable);
    });
    items(ui, now, asks, &[Action::Compare]);
    if now.difference.is_some() {
        items(ui, now, asks, &[Action::ToggleDifference, Action::ChangeSides, Action::CloseComparison]);
    }
    ui.separator();
    items(ui, now, asks, &[Action::ToggleSnapping, Action::ClearGuides]);
    ui.menu_button(tr("Unit"), |ui| items(ui, now, asks, &LengthUnit::ALL.map(Action::Unit)));
    ui.separator();
    ui.menu_button(tr("Panes"), |ui| {
        items(ui, now, asks, &Panes::ALL.map(Action::Show));
        items(ui, now, asks, &[Action::SwapPanes]);
    });
    items(ui, now, asks, &[Action::ToggleCloth, Action::TogglePanel]);
    items(ui, now, asks, &[Action::ToggleHistory, Action::ToggleLog]);
    ui.separator();
    ui.menu_button(tr("Theme"), |ui| {
        items(ui, now, asks, &Theme::ALL.map(Action::Theme));
        ui.separator();
        items(ui, now, asks, &Light::ALL.map(Action::Light));
        let environment = [Action::EnvironmentMap, Action::ToggleEnvironment, Action::RotateEnvironment];
        items(ui, now, asks, &environment);
        ui.separator();
        items(ui, now, asks, &[Action::ToggleDepthOfField, Action::SetAperture]);
        ui.separator();
        item(ui, now, asks, Action::ToggleSeamStitches);
    });
    ui.menu_button(tr("Mouse"), |ui| items(ui, now, asks, &Mouse::ALL.map(Action::Mouse)));
}

fn help_ui(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks) {
    items(ui, now, asks, &[Action::CommandPalette, Action::Manual, Action::Shortcuts]);
    ui.separator();
    items(ui, now, asks, &[Action::Tour]);
    let (walks, figures): (Vec<Demo>, Vec<Demo>) = Demo::ALL.iter().partition(|demo| demo.is_walk());
    for (name, demos) in [(tr("Walks"), walks), (tr("Demos"), figures)] {
        ui.menu_button(name, |ui| {
            let actions: Vec<Action> = demos.into_iter().map(Action::Demo).collect();
            items(ui, now, asks, &actions);
        });
    }
    items(ui, now, asks, &[Action::StopDemo]);
}

fn items(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks, actions: &[Action]) {
    for &action in actions {
        item(ui, now, asks, action);
    }
}

fn item(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks, action: Action) {
    let why_not = now.why_not(action);
    let mut button = Button::selectable(now.is_on(action), now.text(action));
    if let Some(keys) = now.keymap.keys(action).first() {
        button = button.shortcut_text(shortcut_text(ui.ctx(), keys));
    }
    let response = ui.add_enabled(why_not.is_none(), button.min_size(egui::vec2(190.0, 0.0)));
    // Only disabled entries have a tooltip: over an enabled one it would hide the next entry.
    let response = response.on_disabled_hover_text(why_not.unwrap_or_default());
    if response.clicked() {
        asks.push(Ask::Act(action));
        ui.close();
    }
}
