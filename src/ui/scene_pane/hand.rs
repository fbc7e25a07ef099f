//! Dragging and pinning dressed cloth with the pointer.

use std::collections::BTreeMap;
use std::sync::Arc;

use egui::{Rect, Response};
use glam::DVec3;

use crate::cloth::{EdgeMetric, FlatPiece, Garment};
use crate::drag::{DragMode, Graph, Ray};
use crate::geometry::ids::{PieceId, PinId};
use crate::session::{Command, Pin};
use crate::sim::ClothPlace;
use crate::ui::actions::Tool;
use crate::ui::asks::Ask;
use crate::ui::pick::{ClothHit, cloth_under};
use crate::ui::scene_pane::{ScenePane, Seen};

/// Pins of a row stand this far apart, metres on a body 1.5 m large.
const ROW_STEP: f64 = 0.03;

/// The cloth under a ray, if the body is not before it.
pub fn cloth_at(seen: &Seen<'_>, ray: Ray) -> Option<ClothHit> {
    let (garment, state) = seen.cloth?;
    let hit = cloth_under(garment, state, &ray)?;
    let skin = seen.body.and_then(|b| b.ray(ray.origin, ray.direction));
    skin.is_none_or(|skin| skin.distance > hit.distance - 1e-3).then_some(hit)
}

/// What begins when the button goes down on cloth with one of the tools of the hand.
pub fn begun(seen: &Seen<'_>, hit: &ClothHit) -> Ask {
    let (piece, at) = (hit.place.piece, hit.place.at);
    Ask::Drag(match seen.tool {
        Tool::Pin => Command::AddPin { piece, at },
        Tool::Drag(mode) => Command::Grab { piece, at, mode },
        _ => Command::Grab { piece, at, mode: DragMode::Surface },
    })
}

/// The next pin of a row whose last one is at `last`, when the pointer has come far enough.
pub fn next_in_row(seen: &Seen<'_>, last: DVec3, hit: &ClothHit) -> Option<Ask> {
    let scale = seen.body.map_or(1.0, |b| b.scale());
    (hit.point.distance(last) > ROW_STEP * scale)
        .then_some(Ask::Drag(Command::AddPin { piece: hit.place.piece, at: hit.place.at }))
}

/// The pins of the document with the places of the cloth they hold. Where the simulation has found them may be of pins
/// there were before: their own places count.
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

/// How much of a drag from under the pointer would reach each vertex, and what that was worked out for.
#[derive(Debug, Default)]
pub struct Reach {
    metric: Option<(Arc<Garment>, EdgeMetric)>,
    from: Option<(u32, Vec<u32>)>,
    shares: Option<Arc<Vec<f32>>>,
}

impl Reach {
    /// From `hand` against `pins`; worked out anew only when they change.
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
    /// What a drag would reach, as shown in the last frame.
    pub fn reached(&self) -> Option<&[f32]> {
        self.reach.shares.as_ref().map(|shares| &shares[..])
    }

    /// Before a drag: what it would reach, where pins hold cloth back.
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
}
