//! Mouse button mappings, one table for each program that users may be used to. Panes, status bar and help read them.

use egui::{Modifiers, PointerButton};
use serde::{Deserialize, Serialize};

use crate::ui::language::{say, tr};

/// A mouse button mapping, after the program it is taken from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mouse {
    /// Paper A: left paints and pins, right drags cloth or turns the body.
    #[default]
    Paper,
    /// CLO, Marvelous Designer: right turns the view, also over cloth.
    Clo,
    /// Blender: the middle button turns the view.
    Blender,
    /// Maya: Alt with any button moves the view.
    Maya,
}

/// What a mouse button does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointerAction {
    /// Uses the chosen tool.
    Tool,
    /// Drags the cloth under the pointer; elsewhere turns the view.
    HandOrTurn,
    /// Drags the cloth under the pointer, with a drag tool.
    Hand,
    /// Turns the view.
    Turn,
    /// Moves (pans) the view.
    Pan,
    /// Zooms the view.
    Zoom,
}

/// A row of a mapping: modifier keys, button, and what the button does with them.
pub type Row = (Modifiers, PointerButton, PointerAction);

const NONE: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;
const CTRL: Modifiers = Modifiers::CTRL;
const ALT: Modifiers = Modifiers::ALT;

/// The modifier keys that are held, the same on all systems.
pub fn held(ui: &egui::Ui) -> Modifiers {
    alike(ui.input(|i| i.modifiers))
}

/// On a Mac Ctrl is as good as Cmd, as it is for shortcuts: texts that speak of Ctrl are true there, too.
fn alike(held: Modifiers) -> Modifiers {
    Modifiers { command: held.command || held.ctrl, ..held }
}

impl Mouse {
    /// All mappings, in the order of the menu.
    pub const ALL: [Self; 4] = [Self::Paper, Self::Clo, Self::Blender, Self::Maya];

    /// The rows of the mapping; rows with modifier keys come before those without.
    pub fn table(self) -> &'static [Row] {
        use PointerButton::{Middle, Primary, Secondary};
        match self {
            Self::Paper => &[
                (SHIFT, Secondary, PointerAction::Pan),
                (NONE, Secondary, PointerAction::HandOrTurn),
                (NONE, Middle, PointerAction::Pan),
                (NONE, Primary, PointerAction::Tool),
            ],
            Self::Clo => &[
                (SHIFT, Secondary, PointerAction::Pan),
                (NONE, Secondary, PointerAction::Turn),
                (NONE, Middle, PointerAction::Pan),
                (NONE, Primary, PointerAction::Tool),
            ],
            Self::Blender => &[
                (SHIFT, Middle, PointerAction::Pan),
                (CTRL, Middle, PointerAction::Zoom),
                (NONE, Middle, PointerAction::Turn),
                (NONE, Secondary, PointerAction::Hand),
                (NONE, Primary, PointerAction::Tool),
            ],
            Self::Maya => &[
                (ALT, Primary, PointerAction::Turn),
                (ALT, Middle, PointerAction::Pan),
                (ALT, Secondary, PointerAction::Zoom),
                (NONE, Secondary, PointerAction::Hand),
                (NONE, Middle, PointerAction::Pan),
                (NONE, Primary, PointerAction::Tool),
            ],
        }
    }

    /// What `button` does with the modifier keys `held`: the first row whose keys are all held.
    pub fn deed(self, button: PointerButton, held: Modifiers) -> Option<PointerAction> {
        let among = |keys: Modifiers| {
            (!keys.shift || held.shift)
                && (!keys.ctrl || held.ctrl || held.command)
                && (!keys.alt || held.alt)
        };
        let row = self.table().iter().find(|(keys, of, _)| *of == button && among(*keys));
        row.map(|(.., deed)| *deed)
    }

    /// Name for menus.
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "Left paints and pins, right drags and turns",
            Self::Clo => "Like CLO: right turns",
            Self::Blender => "Like Blender: middle turns",
            Self::Maya => "Like Maya: Alt moves the view",
        }
    }

    /// Tooltip.
    pub fn tip(self) -> &'static str {
        match self {
            Self::Paper => {
                "The right button drags the cloth under it, with any tool, and turns the view elsewhere"
            }
            Self::Clo => "The right button turns the view, the middle one moves it",
            Self::Blender => "The middle button turns the view, with Shift it moves it, with Ctrl it zooms",
            Self::Maya => "Alt and the left, middle or right button turns, moves or zooms the view",
        }
    }

    /// How the body's view is moved, for the status bar.
    pub fn view_hint(self) -> String {
        self.hint(|deed| match deed {
            PointerAction::Turn => Some(tr("turn")),
            PointerAction::HandOrTurn => Some(tr("drag cloth, or turn")),
            PointerAction::Pan => Some(tr("move the view")),
            PointerAction::Zoom => Some(tr("zoom")),
            PointerAction::Tool | PointerAction::Hand => None,
        })
    }

    /// How the table's view is moved, for the status bar.
    pub fn table_hint(self) -> String {
        self.hint(|deed| match deed {
            PointerAction::Pan | PointerAction::Turn | PointerAction::HandOrTurn => Some(tr("move the view")),
            PointerAction::Zoom => Some(tr("zoom")),
            PointerAction::Tool | PointerAction::Hand => None,
        })
    }

    fn hint(self, words: impl Fn(PointerAction) -> Option<&'static str>) -> String {
        let mut parts: Vec<(String, &str)> = Vec::new();
        for &(keys, button, deed) in self.table() {
            let Some(does) = words(deed) else { continue };
            let named = named(keys, button);
            match parts.iter_mut().find(|(_, known)| *known == does) {
                // Of two ways to do the same, the one without modifier keys is named.
                Some((known, _)) if keys.is_none() => *known = named,
                Some(_) => {}
                None => parts.push((named, does)),
            }
        }
        let told = parts.iter().map(|(button, deed)| say!("{button} drag: {deed}", button, deed));
        let told: Vec<String> = told.collect();
        say!("{drags} · Wheel: zoom", drags = told.join(" · "))
    }

    /// All rows in words, for the help.
    pub fn help(self) -> Vec<(String, &'static str)> {
        let words = |deed| match deed {
            PointerAction::Tool => tr("What the chosen tool does"),
            PointerAction::HandOrTurn => tr("Drag the cloth that lies there; elsewhere turn the view"),
            PointerAction::Hand => tr("Drag the cloth that lies there (tools Drag and Pin)"),
            PointerAction::Turn => tr("Turn the view; on the table move it"),
            PointerAction::Pan => tr("Move the view"),
            PointerAction::Zoom => tr("Zoom"),
        };
        self.table()
            .iter()
            .map(|&(keys, button, deed)| (say!("{button} drag", button = named(keys, button)), words(deed)))
            .collect()
    }
}

fn named(keys: Modifiers, button: PointerButton) -> String {
    let held = match (keys.shift, keys.ctrl, keys.alt) {
        (true, ..) => Some(tr("Shift")),
        (_, true, _) => Some(tr("Ctrl")),
        (_, _, true) => Some("Alt"),
        _ => None,
    };
    let button = match (button, held.is_none()) {
        (PointerButton::Primary, true) => tr("Left"),
        (PointerButton::Primary, false) => tr("left"),
        (PointerButton::Secondary, true) => tr("Right"),
        (PointerButton::Secondary, false) => tr("right"),
        (PointerButton::Middle, true) => tr("Middle"),
        (PointerButton::Middle, false) => tr("middle"),
        (_, true) => tr("Extra"),
        (_, false) => tr("extra"),
    };
    held.map_or(button.to_owned(), |held| format!("{held}+{button}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use PointerButton::{Middle, Primary, Secondary};

    #[test]
    fn each_habit_finds_its_rows() {
        let cases = [
            (Mouse::Paper, Secondary, NONE, PointerAction::HandOrTurn),
            (Mouse::Paper, Secondary, SHIFT, PointerAction::Pan),
            (Mouse::Paper, Primary, Modifiers::COMMAND, PointerAction::Tool),
            (Mouse::Clo, Secondary, NONE, PointerAction::Turn),
            (Mouse::Blender, Middle, NONE, PointerAction::Turn),
            (Mouse::Blender, Middle, Modifiers::COMMAND, PointerAction::Zoom),
            (Mouse::Blender, Middle, SHIFT, PointerAction::Pan),
            (Mouse::Maya, Primary, ALT, PointerAction::Turn),
            (Mouse::Maya, Primary, NONE, PointerAction::Tool),
            (Mouse::Maya, Secondary, ALT, PointerAction::Zoom),
        ];
        for (mouse, button, held, deed) in cases {
            assert_eq!(mouse.deed(button, held), Some(deed), "{mouse:?} {button:?} {held:?}");
        }
    }

    #[test]
    fn every_habit_paints_turns_and_moves_the_view() {
        for mouse in Mouse::ALL {
            let does = |deed| mouse.table().iter().any(|(.., d)| *d == deed);
            assert!(does(PointerAction::Tool) && does(PointerAction::Pan), "{mouse:?}");
            assert!(does(PointerAction::Turn) || does(PointerAction::HandOrTurn), "{mouse:?}");
            assert!(
                does(PointerAction::Hand) || does(PointerAction::HandOrTurn) || mouse == Mouse::Clo,
                "{mouse:?}"
            );
            // A row can be reached: none before it has the same button and fewer keys.
            for (i, (keys, button, _)) in mouse.table().iter().enumerate() {
                assert!(
                    mouse.table()[..i].iter().all(|(k, b, _)| b != button || (k != keys && !k.is_none()))
                );
            }
        }
    }

    #[test]
    fn hints_come_from_the_table() {
        assert_eq!(
            Mouse::Paper.view_hint(),
            "Middle drag: move the view · Right drag: drag cloth, or turn · Wheel: zoom"
        );
        assert!(Mouse::Maya.view_hint().contains("Alt+left drag: turn"));
        assert!(Mouse::Blender.view_hint().contains("Ctrl+middle drag: zoom"));
    }

    #[test]
    fn ctrl_and_cmd_are_one() {
        let on_mac = [Modifiers::CTRL, Modifiers::MAC_CMD | Modifiers::COMMAND];
        assert!(on_mac.into_iter().all(|held| alike(held).command));
        for held in [NONE, SHIFT, ALT] {
            assert_eq!(alike(held), held);
        }
    }
}
