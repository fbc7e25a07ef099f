//! Drop-down lists that keys lead through: arrows, Home and End, and the first letters of an entry.

use egui::style::ScrollAnimation;
use egui::{Button, ComboBox, Event, FocusDirection, Id, Key, Modifiers, Popup, Response, Ui};

/// Longest time between two letters of one beginning, seconds.
const TOGETHER: f64 = 1.0;

/// Shows `list` with the entries that `fill` adds. Returns its button.
///
/// The keyboard begins at the present entry. A list that a key opened is scrolled to it, and gives the keyboard back when a key closes
/// it. One that the pointer opened does not move below the pointer: it is scrolled by keys alone.
pub fn list_ui(ui: &mut Ui, list: ComboBox<'_>, fill: impl FnOnce(&mut Entries<'_>)) -> Response {
    let shown = list.show_ui(ui, |ui| {
        let popup = ui.layer_id().id;
        let mut entries = Entries { ui, all: Vec::new(), present: 0 };
        fill(&mut entries);
        entries.keys(popup);
        popup
    });
    if let Some(popup) = shown.inner.filter(|popup| !Popup::is_id_open(ui.ctx(), *popup)) {
        let open: Option<Open> = ui.data_mut(|d| d.remove_temp(popup));
        let is_clicked = ui.input(|i| i.pointer.any_click());
        if let Some(opener) = open.and_then(|open| open.opener).filter(|_| !is_clicked) {
            ui.memory_mut(|m| m.request_focus(opener));
        }
    }
    shown.response
}

/// The entries of an open list.
pub struct Entries<'a> {
    ui: &'a mut Ui,
    /// Those that can be chosen, with their texts.
    all: Vec<(Response, String)>,
    /// Index of the one that is chosen now, or the first.
    present: usize,
}

impl Entries<'_> {
    /// Adds an entry.
    pub fn add(&mut self, is_present: bool, text: impl Into<String>) -> Response {
        self.add_enabled(true, is_present, text)
    }

    /// Adds an entry that can be chosen only if `is_enabled`.
    pub fn add_enabled(&mut self, is_enabled: bool, is_present: bool, text: impl Into<String>) -> Response {
        let text = text.into();
        if is_enabled && is_present {
            self.present = self.all.len();
        }
        self.put(is_enabled, Button::selectable(is_present, text.as_str()), text.clone())
    }

    /// Adds a button below the choices.
    pub fn add_button(&mut self, text: impl Into<String>) -> Response {
        let text = text.into();
        self.put(true, Button::new(text.as_str()), text.clone())
    }

    /// Adds an entry that sets `value` to `choice`.
    pub fn add_value<T: PartialEq>(&mut self, value: &mut T, choice: T, text: impl Into<String>) {
        if self.add(*value == choice, text).clicked() {
            *value = choice;
        }
    }

    fn put(&mut self, is_enabled: bool, button: Button<'_>, text: String) -> Response {
        let entry = self.ui.add_enabled(is_enabled, button);
        if entry.clicked() {
            // Only the mouse closes the list by itself.
            self.ui.close();
        }
        if is_enabled {
            self.all.push((entry.clone(), text));
        }
        entry
    }

    /// Handles the keys of this frame. The list's state is kept under `id`.
    fn keys(&self, id: Id) {
        let pass = self.ui.ctx().cumulative_pass_nr();
        let focused = self.ui.memory(|m| m.focused());
        let mut open: Open = self.ui.data(|d| d.get_temp(id)).unwrap_or_default();
        if pass > open.pass + 1 {
            let is_clicked = self.ui.input(|i| i.pointer.any_click());
            open = Open { opener: focused.filter(|_| !is_clicked), ..Open::default() };
        }
        open.pass = pass;
        // While the list is measured its entries are not where they will be.
        if !self.ui.is_sizing_pass() {
            match open.at {
                None => self.lead_to(self.present, &mut open),
                // The keyboard goes on from there after a click on the scroll bar, too.
                Some(at) => {
                    let entry = self.all.iter().position(|(entry, _)| Some(entry.id) == focused);
                    if let Some(at) = entry.or(focused.is_none().then_some(at)) {
                        self.lead_on(at, &mut open);
                    }
                }
            }
        }
        self.ui.data_mut(|d| d.insert_temp(id, open));
    }

    /// Gives the keyboard to the entry `at`.
    fn lead_to(&self, at: usize, open: &mut Open) {
        let Some((entry, _)) = self.all.get(at) else { return };
        entry.request_focus();
        if open.at.is_some() || open.opener.is_some() {
            entry.scroll_to_me_animation(None, ScrollAnimation::none());
        }
        open.at = Some(at);
    }

    /// Gives the keyboard to the entry that the keys of this frame lead to from the entry `at`.
    fn lead_on(&self, at: usize, open: &mut Open) {
        let pressed = |key| self.ui.input_mut(|i| i.count_and_consume_key(Modifiers::NONE, key));
        let arrows = [Key::ArrowUp, Key::ArrowDown, Key::ArrowLeft, Key::ArrowRight].map(pressed);
        if arrows != [0; 4] {
            // Otherwise they would lead to whatever is nearest on the screen, too.
            self.ui.memory_mut(|m| m.move_focus(FocusDirection::None));
        }
        let last = self.all.len().saturating_sub(1);
        let [up, down, ..] = arrows;
        let mut wanted = (at + down).min(last).saturating_sub(up);
        for (key, end) in [(Key::Home, 0), (Key::End, last)] {
            if pressed(key) > 0 {
                wanted = end;
            }
        }
        wanted = self.led_by_letters(wanted, open);
        if wanted != at {
            self.lead_to(wanted, open);
        }
    }

    /// The entry that the letters typed in this frame lead to from the entry `at`.
    fn led_by_letters(&self, mut at: usize, open: &mut Open) -> usize {
        let now = self.ui.input(|i| i.time);
        let typed: String = self.ui.input(|i| {
            let texts = i.events.iter().filter_map(|event| match event {
                Event::Text(text) => Some(text.as_str()),
                _ => None,
            });
            texts.collect()
        });
        let texts: Vec<&str> = self.all.iter().map(|(_, text)| text.as_str()).collect();
        // Space chooses the entry.
        for letter in typed.chars().filter(|c| !c.is_whitespace()) {
            if now - open.when > TOGETHER {
                open.typed.clear();
            }
            open.when = now;
            at = found(&texts, at, &mut open.typed, letter).unwrap_or(at);
        }
        at
    }
}

/// The state of an open list.
#[derive(Clone, Debug, Default)]
struct Open {
    /// The pass in which it was last shown.
    pass: u64,
    /// What had the keyboard when a key opened the list.
    opener: Option<Id>,
    /// Index of the entry that the keyboard was led to last.
    at: Option<usize>,
    /// The letters typed so far, and when the last was.
    typed: String,
    when: f64,
}

/// The entry that `letter` leads to from the entry `at`, after the letters `typed`: one that begins with all of them, else the next
/// that begins with `letter`.
fn found(texts: &[&str], at: usize, typed: &mut String, letter: char) -> Option<usize> {
    let next = |from: usize, beginning: &str| {
        let begins = |text: &str| text.to_lowercase().starts_with(&beginning.to_lowercase());
        (from..from + texts.len()).map(|i| i % texts.len()).find(|&i| begins(texts[i]))
    };
    let is_first = typed.is_empty();
    typed.push(letter);
    let longer = if is_first { None } else { next(at, typed) };
    longer.or_else(|| {
        *typed = letter.to_string();
        next(at + 1, typed)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_lead_to_the_next_entry_that_begins_with_them() {
        let texts = ["No map", "Shear", "Strain along seams", "Change of area", "Ärmel"];
        let lead = |mut at: usize, letters: &str| {
            let mut typed = String::new();
            for letter in letters.chars() {
                at = found(&texts, at, &mut typed, letter).unwrap_or(at);
            }
            at
        };
        assert_eq!([lead(0, "s"), lead(1, "s"), lead(2, "S"), lead(0, "ss")], [1, 2, 1, 2]);
        assert_eq!([lead(0, "st"), lead(2, "sh"), lead(1, "c"), lead(0, "ä")], [2, 1, 3, 4]);
        assert_eq!([lead(3, "x"), lead(0, "sc")], [3, 3]);
    }
}
