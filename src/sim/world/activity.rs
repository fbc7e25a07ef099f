//! Cloth that is held: pinned vertices, frozen and deactivated pieces.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::cloth::{ClothState, Garment};
use crate::fit::Moved;
use crate::geometry::ids::PieceId;
use crate::pattern::Pattern;
use crate::pattern::activity::Activity;
use crate::sim::source::GarmentSource;
use crate::sim::world::World;

impl World {
    /// Sets the activity of these pieces; all others become active.
    pub fn set_activities(&mut self, activities: &BTreeMap<PieceId, Activity>) {
        let before = self.held();
        let Some(source) = &mut self.source else { return };
        let set = |source: &mut GarmentSource| {
            for (id, piece) in &mut Arc::make_mut(&mut source.pattern).pieces {
                let activity = activities.get(id).copied().unwrap_or_default();
                if piece.activity != activity {
                    Arc::make_mut(piece).activity = activity;
                }
            }
        };
        set(Arc::make_mut(source));
        self.change_trials(set);
        let asleep = self.active.is_some();
        self.part_active();
        if asleep || self.active.is_some() {
            self.drape_anew();
        }
        self.hold(&before);
    }

    /// Builds [`World::active`], the garment without its deactivated pieces.
    pub(in crate::sim) fn part_active(&mut self) {
        let activities = self.source.as_ref().map(|source| source.pattern.activities()).unwrap_or_default();
        let asleep: BTreeSet<PieceId> = activities
            .into_iter()
            .filter(|(_, activity)| activity.is_deactivated())
            .map(|(id, _)| id)
            .collect();
        let garment = self.garment.as_ref().filter(|_| !asleep.is_empty());
        self.active = garment.map(|garment| Arc::new(garment.without(&asleep)));
    }

    /// Held vertices: those under pins and, unless a wrap is laying cloth just now, those of [`staying`].
    pub(in crate::sim) fn held(&self) -> Vec<u32> {
        let pins = self.pinned.iter().flatten().copied();
        let grows = self.dressing.as_ref().is_some_and(|dressing| dressing.relaxer().is_none());
        let staying = match (&self.source, &self.garment) {
            (Some(source), Some(garment)) if !grows => staying(&source.pattern, garment, &self.cloth),
            _ => BTreeSet::new(),
        };
        pins.chain(staying).collect()
    }

    /// Holds the vertices of [`World::held`]. Where a vertex of `before` is no longer held, the cloth settles.
    pub(in crate::sim) fn hold(&mut self, before: &[u32]) {
        if self.dragging.is_some() || self.sewing.is_some() {
            return; // What is in the hand settles later, and what is being sewn is held when it lies.
        }
        let held = self.held();
        if self.hold_draped(&held) {
            return;
        }
        if self.moved == Moved::Draped && self.dressing.is_none() {
            return; // What was draped and is not touched since stays as it lies until it is draped on.
        }
        let stays: BTreeSet<u32> = held.iter().copied().collect();
        if before.iter().any(|v| !stays.contains(v)) {
            self.settle();
        } else if let Some(dressing) = &mut self.dressing {
            Arc::make_mut(dressing).fix(&held);
        }
    }
}

/// Laid vertices of frozen pieces, including their seams, and laid vertices that belong to deactivated pieces only.
pub(in crate::sim) fn staying(pattern: &Pattern, garment: &Garment, cloth: &ClothState) -> BTreeSet<u32> {
    let activities = pattern.activities();
    if activities.is_empty() {
        return BTreeSet::new();
    }
    let of = |wanted: Activity| -> BTreeSet<u32> {
        let activity = |piece: &PieceId| activities.get(piece).copied().unwrap_or_default();
        let pieces = garment.triangles.iter().zip(&garment.triangle_pieces);
        let vertices = pieces.filter(|(_, piece)| activity(piece) == wanted).flat_map(|(vs, _)| *vs);
        vertices.filter(|&v| cloth.mapped[v as usize]).collect()
    };
    let (active, frozen, mut asleep) =
        (of(Activity::Active), of(Activity::Frozen), of(Activity::Deactivated));
    asleep.retain(|v| !active.contains(v));
    asleep.extend(frozen);
    asleep
}
