//! What pointer and keys did over the table since the last frame.

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Response};
use glam::DVec2;

use crate::ui::pointer::clicks::clicks;
use crate::ui::pointer::mouse::{Mouse, PointerAction};

/// For the tool in hand; what moves the view is left out.
#[derive(Clone, Debug, Default)]
pub struct Input {
    /// Where the pointer is, or the keyboard's cursor.
    pub hover: Option<Pos2>,
    /// Where was clicked, in order.
    pub clicks: Vec<Pos2>,
    /// The clicks are presses of Space at the keyboard's cursor.
    pub by_keys: bool,
    /// The last click was the second of two.
    pub double: bool,
    /// A drag began there.
    pub pressed: Option<Pos2>,
    /// Where a drag has been since the last frame.
    pub trail: Vec<Pos2>,
    /// The drag is over.
    pub let_go: bool,
    /// Keys held.
    pub held: Modifiers,
    /// Enter: what is being made is ready.
    pub enter: bool,
    /// Backspace: the last point goes.
    pub backspace: bool,
    /// Tab (1) or Shift+Tab (-1): the next or the last thing.
    pub next: i32,
    /// Arrow keys, metres.
    pub nudge: DVec2,
}

/// How far arrow keys go, and with Shift, metres.
const NUDGE: [f64; 2] = [0.001, 0.01];

impl Input {
    /// Reads what the pointer did. `dragging`: the tool is at work on a drag.
    pub fn of_pointer(ui: &egui::Ui, response: &Response, mouse: Mouse, dragging: bool) -> Self {
        let (held, space) = ui.input(|i| (i.modifiers, i.key_down(Key::Space)));
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

    /// Adds the keys that are the pane's.
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

/// Whether the release of a button would not be seen.
fn is_lost(input: &egui::InputState) -> bool {
    input.events.contains(&Event::WindowFocused(false)) || input.events.contains(&Event::PointerGone)
}
