//! The input of pointer and keys over the table since the last frame.

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Response};
use glam::DVec2;

use crate::ui::pointer::clicks::clicks;
use crate::ui::pointer::mouse::{Mouse, PointerAction, held};

/// The input for the chosen tool, without what moves the view.
#[derive(Clone, Debug, Default)]
pub struct Input {
    /// Position of the pointer, or of the keyboard's cursor.
    pub hover: Option<Pos2>,
    /// Positions of clicks, in order.
    pub clicks: Vec<Pos2>,
    /// Whether the clicks are presses of Space at the keyboard's cursor.
    pub by_keys: bool,
    /// Whether the last click was the second of a double-click.
    pub double: bool,
    /// Position where a drag began in this frame.
    pub pressed: Option<Pos2>,
    /// Positions of the pointer during a drag since the last frame.
    pub trail: Vec<Pos2>,
    /// Whether a drag ended.
    pub let_go: bool,
    /// Modifier keys held.
    pub held: Modifiers,
    /// Enter: finish what is being drawn.
    pub enter: bool,
    /// Backspace: remove the last point.
    pub backspace: bool,
    /// Tab (1) or Shift+Tab (-1): select the next or previous item; else 0.
    pub next: i32,
    /// Page down (1) or Page up (-1): select an item of the next or previous kind; else 0.
    pub next_kind: i32,
    /// Space: keep what is selected while more is, or no longer.
    pub keeps: bool,
    /// Movement by arrow keys, metres.
    pub nudge: DVec2,
}

/// Step of arrow keys, and with Shift, metres.
const NUDGE: [f64; 2] = [0.001, 0.01];

impl Input {
    /// Reads the input of the pointer. `dragging`: the tool is following a drag.
    pub fn of_pointer(ui: &egui::Ui, response: &Response, mouse: Mouse, dragging: bool) -> Self {
        let (held, space) = (held(ui), ui.input(|i| i.key_down(Key::Space)));
        let of_tool = !space && mouse.deed(PointerButton::Primary, held) == Some(PointerAction::Tool);
        let by_pointer = ui.input(|i| i.events.iter().any(|e| matches!(e, Event::PointerButton { .. })));
        let clicks =
            if of_tool && by_pointer { clicks(ui, response, PointerButton::Primary) } else { Vec::new() };
        let pressed = (of_tool && response.drag_started_by(PointerButton::Primary))
            .then(|| ui.input(|i| i.pointer.press_origin()))
            .flatten();
        let down = dragging || pressed.is_some();
        Self {
            hover: response.hover_pos().or_else(|| ui.input(|i| i.pointer.latest_pos()).filter(|_| down)),
            double: !clicks.is_empty() && response.double_clicked(),
            clicks,
            pressed,
            trail: if down { ui.input(trail) } else { Vec::new() },
            let_go: down && ui.input(|i| !i.pointer.primary_down() || is_lost(i)),
            held,
            ..Self::default()
        }
    }

    /// Adds the keys that the pane uses.
    pub fn read_keys(&mut self, ui: &egui::Ui) {
        let pressed = |key| ui.input(|i| i.num_presses(key) as i32);
        let step = NUDGE[usize::from(self.held.shift)];
        let along = |more, less| f64::from(pressed(more) - pressed(less)) * step;
        if !self.held.command && !self.held.alt {
            self.nudge =
                DVec2::new(along(Key::ArrowRight, Key::ArrowLeft), along(Key::ArrowUp, Key::ArrowDown));
            self.enter = pressed(Key::Enter) > 0;
            self.backspace = pressed(Key::Backspace) > 0;
        }
    }
}

fn trail(input: &egui::InputState) -> Vec<Pos2> {
    let moved = input.events.iter().filter_map(|e| match e {
        Event::PointerMoved(p) => Some(*p),
        _ => None,
    });
    moved.collect()
}

/// Whether the release of a button may be missed, since the window lost the focus or the pointer.
fn is_lost(input: &egui::InputState) -> bool {
    input.events.contains(&Event::WindowFocused(false)) || input.events.contains(&Event::PointerGone)
}
