//! What stays where it is: pinned vertices and frozen pieces.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::cloth::{ClothState, Garment};
use crate::geometry::ids::PieceId;
use crate::pattern::Pattern;
use crate::pattern::activity::Activity;
use crate::sim::world::World;

impl World {
    /// From now on these pieces are what they are named with, all others active.
    pub fn set_activities(&mut self, activities: &BTreeMap<PieceId, Activity>) {
        let before = self.held();
        let Some(source) = &mut self.source else { return };
        let pattern = Arc::make_mut(&mut Arc::make_mut(source).pattern);
        for (id, piece) in &mut pattern.pieces {
            let activity = activities.get(id).copied().unwrap_or_default();
            if piece.activity != activity {
                Arc::make_mut(piece).activity = activity;
            }
        }
        self.hold(&before);
    }

    /// The vertices that stay: those under pins, then, unless a wrap lays them just now, those of frozen pieces.
    pub(super) fn held(&self) -> Vec<u32> {
        let pins = self.pinned.iter().flatten().copied();
        let grows = self.dressing.as_ref().is_some_and(|dressing| dressing.relaxer().is_none());
        let frozen = match (&self.source, &self.garment) {
            (Some(source), Some(garment)) if !grows => frozen(&source.pattern, garment, &self.cloth),
            _ => BTreeSet::new(),
        };
        pins.chain(frozen).collect()
    }

    /// Holds what stays now; where something that stayed `before` no longer does, the cloth settles.
    pub(super) fn hold(&mut self, before: &[u32]) {
        if self.dragging.is_some() || self.sewing.is_some() {
            return; // What is in the hand settles later, and what is being sewn is held when it lies.
        }
        let held = self.held();
        if self.hold_draped(&held) {
            return;
        }
        let stays: BTreeSet<u32> = held.iter().copied().collect();
        if before.iter().any(|v| !stays.contains(v)) {
            self.settle();
        } else if let Some(dressing) = &mut self.dressing {
            Arc::make_mut(dressing).fix(&held);
        }
    }
}

/// The laid vertices of frozen pieces, seams with others among them.
pub(super) fn frozen(pattern: &Pattern, garment: &Garment, cloth: &ClothState) -> BTreeSet<u32> {
    let activities = pattern.activities();
    if activities.is_empty() {
        return BTreeSet::new();
    }
    let is_frozen = |piece: &PieceId| activities.get(piece) == Some(&Activity::Frozen);
    let pieces = garment.triangles.iter().zip(&garment.triangle_pieces);
    let vertices = pieces.filter(|(_, piece)| is_frozen(piece)).flat_map(|(vs, _)| *vs);
    vertices.filter(|&v| cloth.mapped[v as usize]).collect()
}
