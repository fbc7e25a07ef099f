//! The toolbar: tools, undo, and the main button.

use egui::{Align, Button, Id, Layout, RichText};

use crate::drag::DragMode;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::FrameContext;
use crate::ui::actions::{Action, Tool};
use crate::ui::language::keys::shortcut_text;
use crate::ui::language::tr;
use crate::ui::look::theme::Palette;
use crate::ui::maps::chooser_ui;

/// Height of the buttons, points.
const HEIGHT: f32 = 30.0;

/// Draws the toolbar. Returns its first button, for the keyboard focus.
pub fn toolbar_ui(ui: &mut egui::Ui, now: &FrameContext, palette: &Palette, asks: &mut Asks) -> Option<Id> {
    let mut first = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for tool in [Tool::Mark, Tool::Erase, Tool::Drag(DragMode::Surface), Tool::Pin] {
            let id = plain(ui, now, asks, Action::Choose(tool), None);
            first = first.or(Some(id));
        }
        gap(ui);
        plain(ui, now, asks, Action::ToggleLaser, None);
        gap(ui);
        plain(ui, now, asks, Action::Undo, Some(tr("Undo")));
        plain(ui, now, asks, Action::Redo, Some(tr("Redo")));
        gap(ui);
        if now.wrapping {
            primary(ui, now, asks, Action::CancelWrap, palette.stop, palette);
        } else if now.is_for_dress() {
            primary(ui, now, asks, Action::Dress, palette.accent, palette);
        } else {
            primary(ui, now, asks, Action::Wrap, palette.accent, palette);
        }
        gap(ui);
        plain(ui, now, asks, Action::ToggleRelaxing, None);
        plain(ui, now, asks, Action::ToggleDrape, None);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            plain(ui, now, asks, Action::TogglePanel, None);
            plain(ui, now, asks, Action::ToggleCloth, None);
            chooser_ui(ui, now, asks);
        });
    });
    first
}

fn gap(ui: &mut egui::Ui) {
    ui.add_space(6.0);
    ui.separator();
    ui.add_space(6.0);
}

fn plain(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks, action: Action, text: Option<&str>) -> Id {
    let entry = action.row();
    let button = Button::new(text.unwrap_or(tr(entry.text)));
    let button = button.selected(now.is_on(action)).min_size(egui::vec2(0.0, HEIGHT));
    press(ui, now, asks, action, button)
}

fn primary(
    ui: &mut egui::Ui,
    now: &FrameContext,
    asks: &mut Asks,
    action: Action,
    fill: egui::Color32,
    palette: &Palette,
) {
    let mut text = RichText::new(tr(action.row().text)).size(15.5).strong();
    let mut button_fill = ui.visuals().widgets.inactive.weak_bg_fill;
    if now.why_not(action).is_none() {
        text = text.color(palette.on_accent);
        button_fill = fill;
    }
    press(ui, now, asks, action, Button::new(text).fill(button_fill).min_size(egui::vec2(108.0, HEIGHT)));
}

fn press(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks, action: Action, button: Button<'_>) -> Id {
    let entry = action.row();
    let why_not = now.why_not(action);
    let keys = now.keymap.keys(action).first().map(|k| format!("  ({})", shortcut_text(ui.ctx(), k)));
    let tip = match action {
        Action::Undo | Action::Redo => now.text(action),
        _ => tr(entry.tip).to_owned(),
    };
    let response = ui
        .add_enabled(why_not.is_none(), button)
        .on_hover_text(format!("{tip}{}", keys.unwrap_or_default()))
        .on_disabled_hover_text(why_not.unwrap_or_default());
    if response.clicked() {
        asks.push(Ask::Act(action));
    }
    response.id
}
