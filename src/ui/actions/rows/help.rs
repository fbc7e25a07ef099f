//! Actions of the Help menu.

use egui::Key;

use crate::ui::actions::Action;
use crate::ui::actions::row::{Need, Row, ctrl, key, row, shift};

/// The rows in the order of the menus.
pub const ROWS: &[Row] = &[
    row("Help", Action::CommandPalette, "Find a command…", "Type a few letters of what you want to do")
        .keys(&[ctrl(Key::P), key(Key::F3)])
        .in_demos()
        .on_start_page(),
    row("Help", Action::Shortcuts, "Keys and mouse", "What each key and button does")
        .keys(&[key(Key::F1)])
        .in_demos()
        .on_start_page(),
    row("Help", Action::Manual, "Manual", "What the program does, topic by topic")
        .keys(&[shift(Key::F1)])
        .in_demos()
        .on_start_page(),
    row("Help", Action::Tour, "Tour", "From an empty table to a dressed body in five steps"),
    row("Help", Action::StopDemo, "Stop the demo", "Go back to your own work")
        .needs(&[Need::Demo])
        .in_demos(),
];
