//! Dragging and pinning dressed cloth with the pointer.

use std::collections::BTreeMap;
use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Key as Button, PointerButton, Pos2, Rect, Response, WidgetInfo};
use glam::DVec3;

use super::sight::REACH;
use super::{Drag, ScenePane, Seen, is_lost};
use crate::cloth::{EdgeMetric, FlatPiece, Garment};
use crate::drag::{DragMode, Graph, Ray};
use crate::geometry::ids::{PieceId, PinId};
use crate::session::{Command, Pin};
use crate::sim::ClothPlace;
use crate::ui::actions::Tool;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::body_pane::pick::{ClothHit, cloth_under};
use crate::ui::language::say;
use crate::ui::panels::pins::named;
use crate::ui::selection::Selection;

/// Distance between the pins of a row, metres on a body 1.5 m tall.
const ROW_STEP: f64 = 0.03;

/// The cloth under a ray, unless the body is in front of it.
pub fn cloth_at(seen: &Seen<'_>, ray: Ray) -> Option<ClothHit> {
    let (garment, state) = seen.cloth?;
    let hit = cloth_under(garment, state, &ray)?;
    let skin = seen.body.and_then(|b| b.ray(ray.origin, ray.direction));
    skin.is_none_or(|skin| skin.distance > hit.distance - 1e-3).then_some(hit)
}

/// The request when the button goes down on cloth with the drag or pin tool.
pub fn begun(seen: &Seen<'_>, hit: &ClothHit) -> Ask {
    let (piece, at) = (hit.place.piece, hit.place.at);
    Ask::Drag(match seen.tool {
        Tool::Pin => Command::AddPin { piece, at },
        Tool::Drag(mode) => Command::Grab { piece, at, mode },
        _ => Command::Grab { piece, at, mode: DragMode::Surface },
    })
}

/// The next pin of a row whose last pin is at `last`, once the pointer is far enough from it.
pub fn next_in_row(seen: &Seen<'_>, last: DVec3, hit: &ClothHit) -> Option<Ask> {
    let scale = seen.body.map_or(1.0, |b| b.scale());
    (hit.point.distance(last) > ROW_STEP * scale)
        .then_some(Ask::Drag(Command::AddPin { piece: hit.place.piece, at: hit.place.at }))
}

/// The pins of the document with their positions on the cloth, metres. The simulation's positions may be those of older pins, so
/// the pins' own places are used.
pub fn pins(seen: &Seen<'_>) -> Vec<(PinId, DVec3)> {
    let Some((garment, state)) = seen.cloth else { return Vec::new() };
    let mut pieces: BTreeMap<PieceId, FlatPiece> = BTreeMap::new();
    let mut place = |pin: &Pin| {
        let ClothPlace { piece, at } = pin.place;
        let flat = pieces.entry(piece).or_insert_with(|| FlatPiece::new(garment, piece));
        Some((pin.id, flat.nearest(garment, at)?.point(garment, state)?))
    };
    seen.document.pins.iter().filter_map(&mut place).collect()
}

/// Cache of the fraction of a drag's motion that would reach each vertex.
#[derive(Debug, Default)]
pub struct Reach {
    metric: Option<(Arc<Garment>, EdgeMetric)>,
    from: Option<(u32, Vec<u32>)>,
    shares: Option<Arc<Vec<f32>>>,
}

impl Reach {
    /// The fractions for a drag at the vertex `hand` with the vertices `pins` fixed; computed only when these change.
    fn of(
        &mut self,
        garment: &Arc<Garment>,
        laid: &[bool],
        hand: u32,
        pins: Vec<u32>,
    ) -> Option<Arc<Vec<f32>>> {
        if !self.metric.as_ref().is_some_and(|(known, _)| Arc::ptr_eq(known, garment)) {
            *self = Self { metric: Some((Arc::clone(garment), EdgeMetric::new(garment))), ..Self::default() };
        }
        let from = Some((hand, pins));
        if let (Some((_, metric)), Some((hand, pins))) = (&self.metric, &from)
            && self.from != from
        {
            let shares = Graph::new(metric, *hand, pins, laid).shares(garment.vertex_count);
            self.shares = Some(Arc::new(shares));
            self.from = from;
        }
        self.shares.clone()
    }
}

impl ScenePane {
    /// The fractions shown in the last frame.
    pub fn reached(&self) -> Option<&[f32]> {
        self.reach.shares.as_ref().map(|shares| &shares[..])
    }

    /// Before a drag: the fractions for a drag from under the pointer, where pins hold the cloth.
    pub(super) fn reach_under(
        &mut self,
        seen: &Seen<'_>,
        pane: Rect,
        response: &Response,
    ) -> Option<Arc<Vec<f32>>> {
        let is_drag = seen.tool == Tool::Drag(DragMode::Surface) && self.drag.is_none();
        let at =
            response.hover_pos().filter(|_| is_drag && !seen.growing && !seen.document.pins.is_empty())?;
        let (garment, state) = seen.cloth?;
        let ClothPlace { piece, at } = cloth_at(seen, self.ray(pane, at))?.place;
        let shares = FlatPiece::new(garment, piece).nearest(garment, at)?.vertices(garment);
        let (hand, _) = shares.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let pins = seen.pinned.iter().flatten().copied().collect();
        self.reach.of(garment, &state.mapped, hand, pins)
    }

    /// A click with the pin tool: removes the pin under the pointer, or adds one.
    pub(super) fn pin_or_pull(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> Option<Ask> {
        let hit = cloth_at(seen, self.ray(pane, at))?;
        Some(Ask::Do(match self.pin_at(seen, pane, at) {
            Some(pin) => Command::DeletePin { pin },
            None => Command::AddPin { piece: hit.place.piece, at: hit.place.at },
        }))
    }

    /// The visible pin near a point of the screen.
    pub(super) fn pin_at(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> Option<PinId> {
        let away = |p: DVec3| self.place_of(p, pane).map(|place| place.distance(at));
        let near = pins(seen)
            .into_iter()
            .filter_map(|(id, place)| Some((id, place, away(place)?)))
            .filter(|&(_, place, away)| away <= REACH && self.is_in_sight(seen, place));
        near.min_by(|a, b| a.2.total_cmp(&b.2)).map(|(id, ..)| id)
    }

    /// A click that selects a pin: with the selection tool, or with Shift and the pin tool.
    pub(super) fn picked_pin(&self, seen: &Seen<'_>, pane: Rect, at: Pos2, add: bool) -> Option<Ask> {
        let selects = seen.tool == Tool::Move || (add && seen.tool == Tool::Pin);
        let pin = self.pin_at(seen, pane, at).filter(|_| selects)?;
        let before = Selection { pins: seen.selected_pins.clone(), ..Selection::default() };
        Some(Ask::Pick(before.clicked_pin(pin, add)))
    }

    /// Publishes the position of each pin to screen readers and tests.
    pub(super) fn publish_pins(&self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect) {
        for (pin, (id, place)) in seen.document.pins.iter().zip(pins(seen)) {
            let Some(at) = self.place_of(place, pane).filter(|_| pin.id == id) else { continue };
            let rect = Rect::from_center_size(at, egui::vec2(12.0, 12.0));
            let node = ui.interact(rect, ui.scope_id().with(("pin", id)), egui::Sense::hover());
            let name = named(id);
            let words = if pin.locked { say!("{name}, locked", name) } else { name };
            let selected = seen.selected_pins.contains(&id);
            node.widget_info(|| WidgetInfo::selected(Role::Label, true, selected, &words));
        }
    }

    /// Begins to drag cloth or a row of pins; false when there is no cloth under the pointer.
    pub(super) fn take_cloth(
        &mut self,
        ui: &egui::Ui,
        seen: &Seen<'_>,
        pane: Rect,
        button: PointerButton,
        asks: &mut Asks,
    ) -> bool {
        let origin = ui.input(|i| i.pointer.press_origin());
        let hit = origin.filter(|_| !seen.growing).and_then(|at| cloth_at(seen, self.ray(pane, at)));
        let Some(hit) = hit else { return false };
        let pin = origin.filter(|_| seen.tool == Tool::Pin && button == PointerButton::Primary);
        if let Some(pin) = pin.and_then(|at| self.pin_at(seen, pane, at)) {
            self.drag = Some(Drag::Pin(pin));
            return true;
        }
        let row = seen.tool == Tool::Pin && button == PointerButton::Primary;
        let tool = if row || matches!(seen.tool, Tool::Drag(_)) { seen.tool } else { Tool::default() };
        asks.push(begun(&Seen { tool, ..*seen }, &hit));
        self.drag = Some(if row { Drag::Row(hit.point) } else { Drag::Cloth(button) });
        true
    }

    pub(super) fn go_on_by_hand(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect, asks: &mut Asks) {
        let at = ui.input(|i| i.pointer.latest_pos());
        let moved = ui.input(|i| i.pointer.delta() != egui::Vec2::ZERO);
        match (&mut self.drag, at) {
            (Some(Drag::Cloth(_)), Some(at)) if moved => {
                asks.push(Ask::Drag(Command::DragTo { ray: self.ray(pane, at) }));
            }
            (Some(Drag::Row(last)), Some(at)) => {
                let last = *last;
                if let Some(hit) = cloth_at(seen, self.ray(pane, at))
                    && let Some(ask) = next_in_row(seen, last, &hit)
                {
                    asks.push(ask);
                    self.drag = Some(Drag::Row(hit.point));
                }
            }
            (Some(Drag::Pin(pin)), Some(at)) if moved => {
                let pin = *pin;
                if let Some(hit) = cloth_at(seen, self.ray(pane, at)) {
                    let ClothPlace { piece, at } = hit.place;
                    asks.push(Ask::Drag(Command::MovePin { pin, piece, at }));
                }
            }
            (Some(Drag::Stand(_)), Some(at)) if moved => {
                asks.extend(self.stand_on(pane, at, ui.input(|i| i.modifiers.shift)));
            }
            _ => {}
        }
        let button = match self.drag {
            Some(Drag::Cloth(button)) => button,
            _ => PointerButton::Primary,
        };
        if ui.input(|i| i.key_pressed(Button::Escape)) {
            asks.push(Ask::CancelDrag);
            self.drag = Some(Drag::Over);
        } else if ui.input(|i| !i.pointer.button_down(button) || is_lost(i)) {
            if matches!(self.drag, Some(Drag::Cloth(_))) {
                asks.push(Ask::Drag(Command::Release));
            }
            asks.push(Ask::EndDrag);
            self.drag = None;
        }
    }
}
