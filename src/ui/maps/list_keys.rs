//! Keys in an open list: arrows, Home and End, and the first letters of an entry.

use egui::{EventFilter, Id, Key, Modifiers, Response};

/// Longest time between two letters of one beginning, seconds.
const TOGETHER: f64 = 1.0;

/// The state of an open list.
#[derive(Clone, Debug, Default)]
struct Open {
    /// The pass in which it was last shown.
    pass: u64,
    /// Whether the present entry is still to get the keyboard.
    begins: bool,
    /// The letters typed so far, and when the last was.
    typed: String,
    when: f64,
}

/// Handles the keys of an open list of `entries`, each with its text. The keyboard begins at the entry `present`.
pub(super) fn list_keys(ui: &egui::Ui, id: Id, entries: &[(Response, &str)], present: usize) {
    let (pass, now) = (ui.ctx().cumulative_pass_nr(), ui.input(|i| i.time));
    let mut open: Open = ui.data(|d| d.get_temp(id)).unwrap_or_default();
    if pass > open.pass + 1 {
        open = Open { begins: true, ..Open::default() };
    }
    open.pass = pass;
    let at = entries.iter().position(|(entry, _)| entry.has_focus());
    open.begins &= at.is_none();
    let wanted = match at {
        None => open.begins.then_some(present),
        Some(at) => asked(ui, entries, at, &mut open, now),
    };
    if let Some((entry, _)) = wanted.and_then(|wanted| entries.get(wanted)) {
        entry.request_focus();
        entry.scroll_to_me(None);
    }
    // Otherwise the arrows would lead to whatever is nearest on the screen.
    let arrows = EventFilter { vertical_arrows: true, horizontal_arrows: true, ..EventFilter::default() };
    if let Some((entry, _)) = at.and_then(|at| entries.get(at)) {
        ui.memory_mut(|m| m.set_focus_lock_filter(entry.id, arrows));
    }
    ui.data_mut(|d| d.insert_temp(id, open));
}

/// The entry that the keys of this frame lead to from the entry `at`.
fn asked(ui: &egui::Ui, entries: &[(Response, &str)], at: usize, open: &mut Open, now: f64) -> Option<usize> {
    let pressed = |key| ui.input_mut(|i| i.count_and_consume_key(Modifiers::NONE, key));
    let last = entries.len().saturating_sub(1);
    let (up, down) = (pressed(Key::ArrowUp), pressed(Key::ArrowDown));
    let mut wanted = (at + down).min(last).saturating_sub(up);
    for (key, end) in [(Key::Home, 0), (Key::End, last)] {
        if pressed(key) > 0 {
            wanted = end;
        }
    }
    let typed: String = ui.input(|i| {
        let texts = i.events.iter().filter_map(|event| match event {
            egui::Event::Text(text) => Some(text.as_str()),
            _ => None,
        });
        texts.collect()
    });
    let texts: Vec<&str> = entries.iter().map(|(_, text)| *text).collect();
    // Space chooses the entry.
    for letter in typed.chars().filter(|c| !c.is_whitespace()) {
        if now - open.when > TOGETHER {
            open.typed.clear();
        }
        open.when = now;
        wanted = found(&texts, wanted, &mut open.typed, letter).unwrap_or(wanted);
    }
    (wanted != at).then_some(wanted)
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
