//! Maps keys to actions.

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::FrameContext;
use crate::ui::actions::{Action, is_plain};
use crate::ui::app::App;

impl App {
    pub(in crate::ui) fn keys(&self, ctx: &egui::Context, now: &FrameContext, asks: &mut Asks) {
        if self.dialog.is_some() || self.shell.is_asking() || ctx.text_edit_focused() {
            return;
        }
        let table = &self.pattern_pane;
        let scene = &self.scene_pane;
        let focused = ctx.memory(|m| m.focused().is_some()) && !table.has_focus(ctx) && !scene.has_focus(ctx);
        let menu = egui::Popup::is_any_open(ctx);
        if now.demo && !menu && ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)) {
            return asks.push(Ask::Act(Action::StopDemo));
        }
        let on_cloth = scene.is_drawing_line();
        let drawing = table.is_busy() || on_cloth || !scene.stroke().is_empty();
        let at_table = table.hovered || table.has_focus(ctx);
        if now.proposed > 0 && !menu && !drawing {
            for action in [Action::AcceptMarks, Action::DismissMarks] {
                let keys = action.row().keys;
                let wanted = |k: &KeyboardShortcut| !(focused && k.logical_key == Key::Enter);
                if keys.iter().filter(|k| wanted(k)).any(|k| ctx.input_mut(|i| i.consume_shortcut(k))) {
                    asks.push(Ask::Act(action));
                }
            }
        }
        let escape = ctx.input(|i| i.key_pressed(Key::Escape)) && !menu && !drawing && now.stops.is_none();
        if escape && self.selected.is_some() {
            asks.push(Ask::Select(None));
        }
        for (action, keys) in now.keymap.bound() {
            // A focused button uses Enter and Space itself; Space over the table moves the view; Esc first cancels a stroke.
            let of_table = [Key::Enter, Key::Backspace, Key::Delete].contains(&keys.logical_key);
            let is_figure = keys.logical_key.symbol_or_name().parse::<u8>().is_ok();
            if self.shell.start.is_some() && !(action.row().on_start_page || action == Action::New) {
                continue;
            }
            let taken = is_plain(keys)
                && (menu
                    || (focused && [Key::Enter, Key::Space].contains(&keys.logical_key))
                    || ((table.is_busy() || on_cloth) && of_table)
                    || (scene.has_focus(ctx) && scene.takes_key(keys.logical_key))
                    || (table.takes_numbers() && at_table && is_figure)
                    || (keys.logical_key == Key::Space && at_table)
                    || (action == Action::Cancel && (drawing || self.drag.is_some())));
            let refusal = now.refusal(action);
            // Keys that panes use too are left to them while the action is disabled.
            let is_left = refusal.is_some() && !is_of_actions_only(keys);
            if !taken && !is_left && ctx.input_mut(|i| i.consume_shortcut(&keys)) {
                // An open menu would go on showing what was so before.
                egui::Popup::close_all(ctx);
                asks.push(refusal.map_or(Ask::Act(action), Ask::Say));
            }
        }
    }
}

/// Whether no pane uses `keys`: letters, with or without modifiers, Space over the body, and Ctrl+Enter.
fn is_of_actions_only(keys: KeyboardShortcut) -> bool {
    let name = keys.logical_key.name().as_bytes();
    let is_letter = name.len() == 1 && name[0].is_ascii_alphabetic();
    is_letter || keys.logical_key == Key::Space || (keys.logical_key == Key::Enter && keys.modifiers.command)
}
