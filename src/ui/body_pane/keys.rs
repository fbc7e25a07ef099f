//! Painting, pinning and dragging by keyboard: arrow keys move a cursor over the picture, Space presses there.

use egui::{EventFilter, Key, Modifiers, Painter, Pos2, Rect, Response, Stroke};
use glam::DVec3;

use super::hand::{begun, cloth_at};
use super::{FOLLOW_STEP, ScenePane, Seen, painted, size_of};
use crate::session::Command;
use crate::ui::actions::Tool;
use crate::ui::actions::asks::{Ask, Asks, in_one_step};
use crate::ui::language::{say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::pointer::mouse::held;
use crate::ui::pointer::stroke;

/// Step of the cursor by an arrow key, and with Shift, logical pixels.
const STEPS: [f32; 2] = [8.0, 1.0];
/// Half the size of the cursor's cross, logical pixels.
const ARM: f32 = 8.0;

/// State of painting and dragging by keys.
#[derive(Debug, Default)]
pub(super) struct ByKeys {
    /// The cursor relative to the centre of the pane, logical pixels; None before the first arrow key.
    cross: Option<egui::Vec2>,
    /// Strokes on the near and, with the laser, on the far side; empty when none is in progress.
    strokes: [Vec<DVec3>; 2],
    /// Whether cloth is being dragged.
    holds: bool,
}

impl ByKeys {
    /// The strokes in progress on the near and the far side.
    pub fn strokes(&self) -> Option<&[Vec<DVec3>; 2]> {
        (!self.strokes[0].is_empty()).then_some(&self.strokes)
    }

    fn place(&self, pane: Rect) -> Option<Pos2> {
        self.cross.map(|away| pane.center() + away)
    }

    /// Draws the keyboard's cursor, and a frame round a pane that has the keyboard focus.
    pub fn draw(&self, painter: &Painter, pane: Rect, focused: bool, palette: &Palette) {
        if focused {
            let ring = Stroke::new(1.5, palette.accent);
            painter.rect_stroke(pane, 0.0, ring, egui::StrokeKind::Inside);
        }
        let Some(at) = self.place(pane) else { return };
        for (width, ink) in [(4.0, palette.overlay), (1.5, palette.accent)] {
            let stroke = Stroke::new(width, ink);
            painter.hline(at.x - ARM..=at.x + ARM, at.y, stroke);
            painter.vline(at.x, at.y - ARM..=at.y + ARM, stroke);
        }
    }
}

impl ScenePane {
    /// Whether a stroke or drag by keys is in progress, which Esc cancels.
    pub(super) fn is_busy_by_keys(&self) -> bool {
        self.by_keys.holds || self.by_keys.strokes().is_some()
    }

    /// Whether the pane uses `key` itself now.
    pub fn takes_key(&self, key: Key) -> bool {
        match key {
            Key::Enter => self.is_busy_by_keys() || self.is_drawing_line(),
            Key::Space => self.by_keys.cross.is_some(),
            _ => false,
        }
    }

    /// Whether the pane has the keyboard focus.
    pub fn has_focus(&self, ctx: &egui::Context) -> bool {
        self.id.is_some() && ctx.memory(|m| m.focused()) == self.id
    }

    /// The hint for the status bar about keys; None while the pointer is used.
    pub fn hint_by_keys(&self, tool: Tool, next: usize) -> Option<String> {
        let busy = self.is_busy_by_keys();
        self.by_keys.cross?;
        Some(match tool {
            Tool::Mark if busy => {
                say!("Arrows and Space: on along the skin · Enter: paint mark {next} · Esc: give up", next)
            }
            Tool::Mark => say!("Arrows and Space: begin mark {next} · Shift: small steps", next),
            Tool::Drag(_) if busy => {
                tr("Arrows: drag the cloth · Space: let go · Esc: put it back").to_owned()
            }
            Tool::Drag(_) => tr("Arrows and Space: take the cloth · Shift: small steps").to_owned(),
            Tool::Pin => tr("Arrows and Space: pin the cloth, or pull the pin out").to_owned(),
            Tool::ClothLine if self.is_drawing_line() => tr(
                "Arrows and Space: the next corner · Enter: done · Backspace: one corner back · Esc: give up",
            )
            .to_owned(),
            Tool::ClothLine => tr("Arrows and Space: begin a line · Shift: small steps").to_owned(),
            _ => tr("Arrows and Space: what a click does").to_owned(),
        })
    }

    /// Position of the keyboard's cursor on the screen.
    pub(super) fn cross(&self, pane: Rect) -> Option<Pos2> {
        self.by_keys.place(pane)
    }

    /// Handles the keys while the pane has the focus. A movement of the pointer ends the use of the cursor.
    pub(super) fn listen_to_keys(
        &mut self,
        ui: &egui::Ui,
        seen: &Seen<'_>,
        pane: Rect,
        response: &Response,
        asks: &mut Asks,
    ) {
        if !response.has_focus() || ui.input(|i| i.pointer.is_moving() || i.pointer.any_down()) {
            if self.is_busy_by_keys() {
                self.give_up_by_keys(asks);
            }
            self.by_keys.cross = None;
            return;
        }
        let filter = EventFilter {
            horizontal_arrows: true,
            vertical_arrows: true,
            escape: true,
            ..Default::default()
        };
        ui.ctx().memory_mut(|m| m.set_focus_lock_filter(response.id, filter));
        if held(ui).command || held(ui).alt {
            return;
        }
        self.move_cross(ui, pane, asks);
        let pressed = |key| ui.input(|i| i.key_pressed(key));
        if pressed(Key::Escape) {
            match self.is_busy_by_keys() {
                true => self.give_up_by_keys(asks),
                false => ui.ctx().memory_mut(|m| m.surrender_focus(response.id)),
            }
        }
        if pressed(Key::Space)
            && let Some(at) = self.cross(pane)
        {
            self.press(seen, pane, at, asks);
        } else if pressed(Key::Enter) {
            self.end_by_keys(seen, asks);
        }
    }

    fn move_cross(&mut self, ui: &egui::Ui, pane: Rect, asks: &mut Asks) {
        let count = |key| ui.input(|i| i.num_presses(key)) as f32;
        let step = STEPS[usize::from(ui.input(|i| i.modifiers.shift))];
        let by = egui::vec2(
            count(Key::ArrowRight) - count(Key::ArrowLeft),
            count(Key::ArrowDown) - count(Key::ArrowUp),
        );
        if by == egui::Vec2::ZERO {
            return;
        }
        let half = pane.size() / 2.0 - egui::vec2(1.0, 1.0);
        let to = self.by_keys.cross.map_or(egui::Vec2::ZERO, |from| from + by * step).clamp(-half, half);
        self.by_keys.cross = Some(to);
        if self.by_keys.holds {
            asks.push(Ask::Drag(Command::DragTo { ray: self.ray(pane, pane.center() + to) }));
        }
    }

    /// Space: adds a corner to a stroke, grabs or releases cloth, or does what a click does.
    fn press(&mut self, seen: &Seen<'_>, pane: Rect, at: Pos2, asks: &mut Asks) {
        match seen.tool {
            Tool::Mark => self.add_corner(seen, pane, at, asks),
            Tool::Drag(_) if self.by_keys.holds => self.end_by_keys(seen, asks),
            Tool::Drag(_) => {
                let hit = cloth_at(seen, self.ray(pane, at)).filter(|_| !seen.growing);
                self.by_keys.holds = hit.is_some();
                match hit {
                    Some(hit) => asks.push(begun(seen, &hit)),
                    None => asks.push(Ask::Say(tr("There is no cloth under the cross.").to_owned())),
                }
            }
            Tool::ClothLine => self.click_line(seen, pane, at, (Modifiers::NONE, false), asks),
            _ => self.click(seen, pane, at, [seen.tool == Tool::Erase, false], asks),
        }
    }

    /// Continues the stroke along the skin to the point under the cursor, even if the view was turned meanwhile.
    fn add_corner(&mut self, seen: &Seen<'_>, pane: Rect, at: Pos2, asks: &mut Asks) {
        let last = self.by_keys.strokes[0].last().and_then(|p| {
            let place = self.camera.project(p.as_vec3(), size_of(pane))?;
            Some(pane.min + egui::vec2(place.pixel.x, place.pixel.y))
        });
        let from = last.unwrap_or(at);
        let steps = (from.distance(at) / FOLLOW_STEP).ceil().max(1.0);
        let places = (1..=steps as u32).map(|i| from.lerp(at, i as f32 / steps));
        let hits: Vec<[Option<DVec3>; 2]> = places.map(|place| self.hits(seen, pane, place)).collect();
        if hits.last().is_none_or(|hit| hit[0].is_none()) {
            asks.push(Ask::Say(tr("There is no skin under the cross.").to_owned()));
            return;
        }
        for hit in hits {
            for (points, hit) in self.by_keys.strokes.iter_mut().zip(hit) {
                points.extend(hit);
            }
        }
    }

    /// Enter: finishes the stroke, releases the cloth.
    fn end_by_keys(&mut self, seen: &Seen<'_>, asks: &mut Asks) {
        if std::mem::take(&mut self.by_keys.holds) {
            asks.push(Ask::Drag(Command::Release));
            asks.push(Ask::EndDrag);
        }
        let strokes = std::mem::take(&mut self.by_keys.strokes);
        in_one_step(painted(seen, strokes.map(|points| stroke::finished(&points))), asks);
    }

    fn give_up_by_keys(&mut self, asks: &mut Asks) {
        if std::mem::take(&mut self.by_keys.holds) {
            asks.push(Ask::CancelDrag);
        }
        self.by_keys.strokes = Default::default();
    }
}
