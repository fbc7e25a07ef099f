//! Keyboard shortcuts in the language of the window.

use egui::{Key, KeyboardShortcut, ModifierNames};

use crate::ui::language::translated;

/// The shortcut as it is written on keyboards of the language; as egui writes it where the table does not name the keys.
pub fn shortcut_text(ctx: &egui::Context, keys: &KeyboardShortcut) -> String {
    let is_mac = ctx.os().is_mac();
    let [Some(ctrl), Some(shift)] = [translated("Ctrl"), translated("Shift")] else {
        return ctx.format_shortcut(keys);
    };
    if is_mac {
        return ctx.format_shortcut(keys);
    }
    let names = ModifierNames { ctrl, shift, ..ModifierNames::NAMES };
    let pressed = names.format(&keys.modifiers, is_mac);
    let key = key_name(keys.logical_key);
    if pressed.is_empty() { key.to_owned() } else { format!("{pressed}{}{key}", names.concat) }
}

fn key_name(key: Key) -> &'static str {
    let english = match key {
        Key::ArrowLeft => "Arrow left key",
        Key::ArrowRight => "Arrow right key",
        Key::ArrowUp => "Arrow up key",
        Key::ArrowDown => "Arrow down key",
        Key::Escape => "Escape key",
        Key::Enter => "Enter key",
        Key::Space => "Space key",
        Key::Backspace => "Backspace key",
        Key::Delete => "Delete key",
        Key::Insert => "Insert key",
        Key::PageUp => "Page up key",
        Key::PageDown => "Page down key",
        Key::Home => "Home key",
        Key::End => "End key",
        Key::Comma => "Comma key",
        Key::Period => "Period key",
        Key::Plus => "Plus key",
        Key::Minus => "Minus key",
        other => return other.name(),
    };
    translated(english).unwrap_or(key.name())
}
