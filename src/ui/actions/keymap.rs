//! Keyboard shortcuts: the defaults of the table of actions, or the user's own.

use std::collections::BTreeMap;

use egui::{Key, KeyboardShortcut, Modifiers};
use serde::{Deserialize, Serialize};

use crate::ui::actions::Action;
use crate::ui::actions::rows::all;

/// The user's own keyboard shortcuts; every other action has its default ones.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Keymap {
    /// The user's keys by the action's id, each key as [`written`]. An empty list leaves the action without keys.
    own: BTreeMap<String, Vec<String>>,
}

impl Keymap {
    /// The keys of `action`; menus show the first.
    pub fn keys(&self, action: Action) -> Vec<KeyboardShortcut> {
        match self.own.get(&action.id()) {
            Some(own) => own.iter().filter_map(|text| read(text)).collect(),
            None => action.row().keys.to_vec(),
        }
    }

    /// All actions with keys, combinations with most modifiers first, so that Ctrl+Shift+Z is not taken for Ctrl+Z.
    pub fn bound(&self) -> Vec<(Action, KeyboardShortcut)> {
        let mut all: Vec<(Action, KeyboardShortcut)> =
            all().flat_map(|action| self.keys(action).into_iter().map(move |k| (action, k))).collect();
        all.sort_by_key(|(_, k)| {
            3 - [k.modifiers.shift, k.modifiers.command, k.modifiers.alt].iter().filter(|m| **m).count()
        });
        all
    }

    /// Other actions that `keys` are bound to.
    pub fn others(&self, action: Action, keys: KeyboardShortcut) -> Vec<Action> {
        let others = self.bound().into_iter().filter(|(other, k)| *other != action && *k == keys);
        others.map(|(other, _)| other).collect()
    }

    /// Whether the user has changed the keys of `action`.
    pub fn is_own(&self, action: Action) -> bool {
        self.own.contains_key(&action.id())
    }

    /// Binds `keys` to `action` and to no other.
    pub fn bind(&mut self, action: Action, keys: KeyboardShortcut) {
        for other in self.others(action, keys) {
            let left = self.keys(other).into_iter().filter(|k| *k != keys).map(written).collect();
            self.set(other, left);
        }
        self.set(action, vec![written(keys)]);
    }

    /// Removes all keys of `action`.
    pub fn unbind(&mut self, action: Action) {
        self.set(action, Vec::new());
    }

    /// Restores the default keys of `action` and removes them from other actions.
    pub fn reset(&mut self, action: Action) {
        self.own.remove(&action.id());
        for keys in self.keys(action) {
            for other in self.others(action, keys) {
                let left = self.keys(other).into_iter().filter(|k| *k != keys).map(written).collect();
                self.set(other, left);
            }
        }
    }

    fn set(&mut self, action: Action, keys: Vec<String>) {
        let usual: Vec<String> = action.row().keys.iter().copied().map(written).collect();
        if keys == usual {
            self.own.remove(&action.id());
        } else {
            self.own.insert(action.id(), keys);
        }
    }
}

/// Name of the key for commands: Cmd on a Mac, where it is Ctrl elsewhere. Either name is read on any system.
const COMMAND: &str = if cfg!(target_os = "macos") { "Cmd+" } else { "Ctrl+" };

/// A key combination in words, such as "Ctrl+Shift+Z".
pub fn written(keys: KeyboardShortcut) -> String {
    let held = keys.modifiers;
    let named = [(held.command || held.ctrl, COMMAND), (held.shift, "Shift+"), (held.alt, "Alt+")];
    let mut text: String = named.into_iter().filter(|(is, _)| *is).map(|(_, name)| name).collect();
    text.push_str(keys.logical_key.name());
    text
}

/// The reverse of [`written`]; None if `text` is not a key combination.
fn read(text: &str) -> Option<KeyboardShortcut> {
    let mut modifiers = Modifiers::NONE;
    let mut rest = text;
    for (name, modifier) in [
        ("Ctrl+", Modifiers::COMMAND),
        ("Cmd+", Modifiers::COMMAND),
        ("Shift+", Modifiers::SHIFT),
        ("Alt+", Modifiers::ALT),
    ] {
        if let Some(after) = rest.strip_prefix(name) {
            (modifiers, rest) = (modifiers.plus(modifier), after);
        }
    }
    Some(KeyboardShortcut::new(modifiers, Key::from_name(rest)?))
}

/// A pressed key combination, the same on all systems: Ctrl and Cmd are one.
pub fn pressed(key: Key, held: Modifiers) -> KeyboardShortcut {
    let mut modifiers = Modifiers::NONE;
    for (is, modifier) in [
        (held.command || held.ctrl, Modifiers::COMMAND),
        (held.shift, Modifiers::SHIFT),
        (held.alt, Modifiers::ALT),
    ] {
        if is {
            modifiers = modifiers.plus(modifier);
        }
    }
    KeyboardShortcut::new(modifiers, key)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ui::actions::row::{ctrl, ctrl_shift};

    #[test]
    fn no_key_does_two_things() {
        let all = Keymap::default().bound();
        for (i, (a, k)) in all.iter().enumerate() {
            for (b, other) in &all[i + 1..] {
                assert!(k != other, "{a:?} and {b:?} share {k:?}");
            }
        }
        let place = |action| all.iter().position(|(a, _)| *a == action).expect("bound");
        assert!(place(Action::Redo) < place(Action::Undo));
    }

    #[test]
    fn every_key_of_the_table_is_written_and_read() {
        for (action, keys) in Keymap::default().bound() {
            assert_eq!(read(&written(keys)), Some(keys), "{action:?}");
        }
        for nonsense in ["", "Ctrl+", "Ctrl+Nothing", "Z+Ctrl"] {
            assert_eq!(read(nonsense), None, "{nonsense:?}");
        }
    }

    #[test]
    fn a_key_given_to_one_action_is_taken_from_the_other_and_comes_back() {
        let mut keymap = Keymap::default();
        keymap.bind(Action::Wrap, ctrl(Key::Z));
        assert_eq!(keymap.keys(Action::Wrap), [ctrl(Key::Z)]);
        assert_eq!(keymap.keys(Action::Undo), []);
        let text = serde_json::to_string(&keymap).expect("text");
        assert_eq!(serde_json::from_str::<Keymap>(&text).expect("a keymap"), keymap);
        keymap.reset(Action::Undo);
        assert_eq!(keymap.keys(Action::Undo), [ctrl(Key::Z)]);
        assert_eq!(keymap.keys(Action::Wrap), []);
        keymap.reset(Action::Wrap);
        assert_eq!(keymap, Keymap::default());
        keymap.bind(Action::Undo, ctrl_shift(Key::Z));
        assert_eq!(keymap.keys(Action::Redo), [ctrl(Key::Y)], "the other key of redo stays");
    }
}
