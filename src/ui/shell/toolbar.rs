//! The toolbar: tools, undo, and the main button. Where the window is too narrow for one row its buttons are tighter, and if that is
//! not enough it has several.

use std::ops::Range;

use egui::accesskit::Role;
use egui::{Align, Button, Id, Layout, RichText, Separator, WidgetInfo};

use crate::drag::DragMode;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::{FrameContext, Stops};
use crate::ui::actions::{Action, Tool};
use crate::ui::language::keys::shortcut_text;
use crate::ui::language::{tr, translated};
use crate::ui::look::theme::Palette;
use crate::ui::maps::chooser_ui;

/// Height of the buttons, points.
const HEIGHT: f32 = 30.0;
/// Space between two buttons, points.
const SPACING: f32 = 4.0;
/// Width of the line between two groups, and the space on each of its sides, points.
const LINE: f32 = 6.0;
/// Space between two groups of a row, points.
const GAP: f32 = SPACING + LINE + LINE + SPACING + LINE;
/// Space beside the text of a button, points, where one row would otherwise not have room for all.
const TIGHT: f32 = 6.0;
/// Number of buttons, with that of the maps.
const BUTTONS: f32 = 13.0;
/// Number of groups of buttons. After them comes what stands at the right end: the maps, and what is shown.
const GROUPS: usize = 5;

/// Widths of the groups and of the right end, points.
type Widths = [f32; GROUPS + 1];

/// Draws the toolbar. Returns its first button, for the keyboard focus.
///
/// Which parts share a row follows from their widths in the last frame.
pub fn toolbar_ui(ui: &mut egui::Ui, now: &FrameContext, palette: &Palette, asks: &mut Asks) -> Option<Id> {
    let waits_for_pose = now.stops == Some(Stops::Pose) && now.drape.is_some_and(|drape| drape.way.is_some());
    let main = if now.wrapping || waits_for_pose {
        Action::Cancel
    } else if now.is_for_dress() {
        Action::Dress
    } else {
        Action::Wrap
    };
    let tools = [Tool::Mark, Tool::Erase, Tool::Drag(DragMode::Surface), Tool::Pin].map(Action::Choose);
    let groups: [&[Action]; GROUPS] = [
        &tools,
        &[Action::ToggleLaser],
        &[Action::Undo, Action::Redo],
        &[main],
        &[Action::ToggleRelaxing, Action::ToggleDrape],
    ];
    let id = Id::unique("widths of the toolbar");
    let (known, was_tight): (Widths, bool) = ui.data(|d| d.get_temp(id)).unwrap_or_default();
    let is_tight = is_tight(&known, was_tight, ui.spacing().button_padding.x, ui.available_width());
    if is_tight {
        ui.spacing_mut().button_padding.x = TIGHT;
    }
    let mut widths = known;
    let mut first = None;
    for row in rows(&known, ui.available_width()) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = SPACING;
            for part in row.clone() {
                let Some(group) = groups.get(part) else {
                    widths[part] = right_end_ui(ui, now, asks);
                    continue;
                };
                if part > row.start {
                    gap(ui);
                }
                let left = ui.cursor().left();
                for &action in *group {
                    let id = button_ui(ui, now, palette, asks, action);
                    first = first.or(Some(id));
                }
                widths[part] = ui.min_rect().right() - left;
            }
        });
    }
    if is_tight != was_tight || widths.iter().zip(&known).any(|(new, old)| (new - old).abs() > 0.1) {
        ui.data_mut(|d| d.insert_temp(id, (widths, is_tight)));
        ui.ctx().request_repaint();
    }
    first
}

/// Whether the buttons are to be tight: with the usual space `padding` beside their texts they have no room in one row of `room` points.
/// `widths` are those of buttons that were tight, or were not.
fn is_tight(widths: &Widths, were_tight: bool, padding: f32, room: f32) -> bool {
    let saved = if were_tight { 2.0 * (padding - TIGHT) * BUTTONS } else { 0.0 };
    one_row(widths) + saved > room
}

/// Width of a row of all parts, points.
fn one_row(widths: &Widths) -> f32 {
    widths.iter().sum::<f32>() + (GROUPS - 1) as f32 * GAP + SPACING
}

/// The parts of each row: as many as stand beside each other in `room` points. A part that is wider has a row of its own.
fn rows(widths: &Widths, room: f32) -> Vec<Range<usize>> {
    let mut rows = Vec::new();
    let (mut start, mut used) = (0, widths[0]);
    for (part, width) in widths.iter().enumerate().skip(1) {
        used += width + if part == GROUPS { SPACING } else { GAP };
        if used > room {
            rows.push(start..part);
            (start, used) = (part, *width);
        }
    }
    rows.push(start..widths.len());
    rows
}

/// Draws what stands at the right end of its row. Returns its width, points.
fn right_end_ui(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks) -> f32 {
    let drawn = ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        plain(ui, now, asks, Action::TogglePanel);
        plain(ui, now, asks, Action::ToggleCloth);
        chooser_ui(ui, now, asks);
        ui.min_rect().width()
    });
    drawn.inner
}

fn gap(ui: &mut egui::Ui) {
    ui.add_space(LINE);
    ui.add(Separator::default().spacing(LINE));
    ui.add_space(LINE);
}

fn button_ui(
    ui: &mut egui::Ui,
    now: &FrameContext,
    palette: &Palette,
    asks: &mut Asks,
    action: Action,
) -> Id {
    match action {
        Action::Cancel => primary(ui, now, asks, action, palette.stop, palette),
        Action::Dress | Action::Wrap => primary(ui, now, asks, action, palette.accent, palette),
        _ => plain(ui, now, asks, action),
    }
}

/// A shorter text for the button of `action`, where the language has long words for it: in German the toolbar would take two rows in a
/// window of 1024 points.
fn short(action: Action) -> Option<&'static str> {
    match action {
        Action::Undo => translated("Undo (short)"),
        Action::Redo => translated("Redo (short)"),
        Action::ToggleCloth => translated("Show the cloth (short)"),
        Action::TogglePanel => translated("Side panel (short)"),
        _ => None,
    }
}

fn plain(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks, action: Action) -> Id {
    let button = Button::new(short(action).unwrap_or(tr(action.row().text)));
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
) -> Id {
    let mut text = RichText::new(tr(action.row().text)).size(15.5).strong();
    let mut button_fill = ui.visuals().widgets.inactive.weak_bg_fill;
    if now.why_not(action).is_none() {
        text = text.color(palette.on_accent);
        button_fill = fill;
    }
    press(ui, now, asks, action, Button::new(text).fill(button_fill).min_size(egui::vec2(108.0, HEIGHT)))
}

fn press(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks, action: Action, button: Button<'_>) -> Id {
    let entry = action.row();
    let why_not = now.why_not(action);
    let keys = now.keymap.keys(action).first().map(|k| format!("  ({})", shortcut_text(ui.ctx(), k)));
    let name = tr(entry.text);
    // What a short text stands for.
    let named = |tip: &str| if short(action).is_some() { format!("{name}: {tip}") } else { tip.to_owned() };
    let tip = match action {
        Action::Undo | Action::Redo => now.text(action),
        _ => named(tr(entry.tip)),
    };
    let is_enabled = why_not.is_none();
    let response = ui
        .add_enabled(is_enabled, button)
        .on_hover_text(format!("{tip}{}", keys.unwrap_or_default()))
        .on_disabled_hover_text(named(why_not.unwrap_or_default()));
    if short(action).is_some() {
        let is_on = now.is_on(action);
        response.widget_info(|| WidgetInfo::selected(Role::Button, is_enabled, is_on, name));
    }
    if response.clicked() {
        asks.push(Ask::Act(action));
    }
    response.id
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As in English.
    const WIDTHS: Widths = [195.0, 50.0, 103.0, 108.0, 108.0, 308.0];

    #[test]
    fn parts_share_a_row_while_there_is_room() {
        let ends = |room| rows(&WIDTHS, room).iter().map(|row| row.end).collect::<Vec<_>>();
        let one_row = one_row(&WIDTHS);
        assert_eq!(ends(one_row), [6]);
        assert_eq!(ends(one_row - 0.5), [5, 6]);
        assert_eq!(ends(663.0), [4, 6]);
        assert_eq!(ends(10.0), [1, 2, 3, 4, 5, 6]);
    }

    #[test]
    fn buttons_are_tight_where_that_saves_a_row() {
        let room = one_row(&WIDTHS);
        assert_eq!([room, room - 0.5].map(|room| is_tight(&WIDTHS, false, 9.0, room)), [false, true]);
        assert_eq!([room, room + 78.0].map(|room| is_tight(&WIDTHS, true, 9.0, room)), [true, false]);
    }
}
