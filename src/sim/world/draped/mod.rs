//! Draping: physics moves the garment on the body until it rests.

mod pose_end;
mod walk;

use std::sync::Arc;

use glam::DVec3;

use crate::body::Surface;
use crate::cloth::{ClothState, Garment, Skips};
use crate::contact::Splits;
use crate::drag::Ray;
use crate::drape::{DrapedGarment, DrapedSettings, Undrapable};
use crate::fit::{Moved, tops};
use crate::geometry::words::{Words, words};
use crate::sim::protocol::DrapeState;
use crate::sim::source::{ClothPlace, DrapeSource};
use crate::sim::world::World;
use crate::sim::world::draped::pose_end::EndOfPose;
use crate::sim::world::draped::walk::Walk;
use crate::wrap::Phase;

/// Draping in progress, paused or at rest.
#[derive(Clone, Debug)]
pub struct Draping {
    source: Arc<DrapeSource>,
    /// The garment simulation; None until all of the cloth is laid.
    worn: Option<DrapedGarment>,
    /// Ticks left; None: until it rests.
    left: Option<u32>,
    /// Whether the cloth is dragged.
    held: bool,
    /// Set while draping ends a change of pose.
    ends: Option<EndOfPose>,
    /// The way to the pose, which the cloth is draped along before it is draped in the pose.
    walk: Option<Arc<Walk>>,
}

impl Draping {
    fn new(source: Arc<DrapeSource>) -> Self {
        Self { source, worn: None, left: None, held: false, ends: None, walk: None }
    }

    /// Whether a tick is partly done.
    pub(super) fn is_mid_tick(&self) -> bool {
        self.worn.as_ref().is_some_and(DrapedGarment::is_mid_tick)
    }

    fn runs(&self) -> bool {
        self.left != Some(0) && self.worn.as_ref().is_none_or(|worn| !worn.progress().at_rest)
    }
}

impl World {
    /// Starts draping, as soon as all of the cloth is laid, or stops it (false). Does nothing where nothing is dressed.
    pub fn set_draping(&mut self, on: bool, source: Arc<DrapeSource>) {
        self.trials = None;
        self.release();
        match on {
            true => self.drape_for(None, source),
            false => self.stop_draping(),
        }
    }

    /// Drapes for `ticks` ticks; None: until the cloth rests.
    pub fn drape_for(&mut self, ticks: Option<u32>, source: Arc<DrapeSource>) {
        if self.sewing.is_some() || (!self.cloth.mapped.contains(&true) && self.dressing.is_none()) {
            return; // Sewing ends with draping.
        }
        let known = self.draping.take().filter(|draping| draping.source == source);
        let mut draping = known.map_or_else(|| Draping::new(source), Arc::unwrap_or_clone);
        (draping.left, draping.ends) = (ticks, None);
        if let Some(worn) = draping.worn.as_mut().filter(|worn| worn.progress().at_rest) {
            worn.resume();
        }
        self.draping = Some(Arc::new(draping));
    }

    /// Stops draping; the cloth stays as it is.
    pub fn stop_draping(&mut self) {
        let Some(draping) = &mut self.draping else { return };
        if draping.worn.is_none() {
            self.draping = None;
            return;
        }
        Arc::make_mut(draping).left = Some(0);
        self.split_draped();
    }

    /// Replaces the fabrics of draped cloth.
    pub fn set_fabrics(&mut self, source: Arc<DrapeSource>) {
        self.change_trial_fabrics(&source);
        if let Some(draping) = &mut self.draping {
            let draping = Arc::make_mut(draping);
            (draping.source, draping.worn, draping.held) = (source, None, false);
            self.dragged = None;
        }
    }

    /// Starts draping again with the present active pieces.
    pub(in crate::sim) fn drape_anew(&mut self) {
        if let Some(source) = self.draping.as_ref().map(|draping| Arc::clone(&draping.source)) {
            self.set_fabrics(source);
        }
    }

    /// Drapes the cloth as that of `before` was draped.
    pub(in crate::sim) fn drape_like(&mut self, before: &Self) {
        self.draping = before.draping.as_ref().map(|draping| {
            let Draping { source, left, .. } = &**draping;
            Arc::new(Draping { left: *left, ..Draping::new(Arc::clone(source)) })
        });
    }

    /// Begins draping with these vertex velocities, m/s.
    pub(in crate::sim) fn begin_moving(&mut self, velocities: &[DVec3]) {
        if let Err(Undrapable(words)) = self.begin_draping() {
            return self.fail_draping(words);
        }
        if let Some(worn) = self.draping.as_mut().and_then(|d| Arc::make_mut(d).worn.as_mut()) {
            worn.set_velocities(velocities);
        }
    }

    /// Whether the next tick is one of draping.
    pub(in crate::sim) fn drapes_now(&self) -> bool {
        let lies = self.dragging.is_none()
            && self.dressing.as_ref().is_none_or(|dressing| {
                dressing.phase() == Phase::AtRest || (!self.relaxing && dressing.relaxer().is_some())
            });
        self.draping.as_ref().is_some_and(|draping| draping.runs() && (draping.worn.is_some() || lies))
    }

    /// Whether physics controls the cloth, moving or not.
    pub(in crate::sim) fn is_draped(&self) -> bool {
        self.draping.as_ref().is_some_and(|draping| draping.worn.is_some())
    }

    /// Does a tick of draping, or a part of one.
    pub(in crate::sim) fn drape(&mut self) {
        if self.draping.as_ref().is_some_and(|draping| draping.walk.is_some()) {
            return self.walk();
        }
        // To begin takes about as long as a part of the first tick, the longest.
        if !self.is_draped() {
            return self.begin_draping().unwrap_or_else(|Undrapable(words)| self.fail_draping(words));
        }
        let Some(draping) = self.draping.as_mut().map(Arc::make_mut) else { return };
        let Some(worn) = &mut draping.worn else { return };
        let gone_on = worn.go_on(Arc::make_mut(&mut self.cloth));
        self.separated = self.separated.and(worn.take_separation());
        self.moved_by_card |= worn.was_on_card();
        match gone_on {
            Ok(true) => {}
            Ok(false) => return,
            Err(Undrapable(words)) => return self.fail_draping(words),
        }
        draping.left = draping.left.map(|left| left.saturating_sub(1));
        let rests = worn.progress().at_rest;
        if !draping.runs() {
            self.split_draped();
        }
        if rests {
            self.tell_short_seams();
            self.sew_next_layer();
            self.finish_pose();
        }
    }

    fn begin_draping(&mut self) -> Result<(), Undrapable> {
        let held = self.held();
        let (Some(garment), Some(body), Some(source), Some(draping)) =
            (&self.garment, &self.body, &self.source, &mut self.draping)
        else {
            return Err(Undrapable(words!("there is no cloth on the body")));
        };
        let hangs = self.dressing.is_some() || self.moved == Moved::Wrapped;
        if hangs && !self.was_sewn && self.trials.is_none() {
            self.hung_at = Some(tops(garment, &self.cloth).into());
        }
        let garment = Arc::clone(self.active.as_ref().unwrap_or(garment));
        let skips = source.relax.skips;
        let worn = worn((garment, &self.cloth), Arc::clone(body), &draping.source, &held, skips)?;
        let worn = if self.moved == Moved::Draped { worn.rested(&self.cloth) } else { worn };
        let worn = if self.trials.is_some() { worn.let_down() } else { worn };
        Arc::make_mut(draping).worn = Some(match &self.card {
            Some(slot) => worn.with_card(slot),
            None => worn,
        });
        (self.dressing, self.splits, self.posed) = (None, None, None);
        self.moved = Moved::Draped;
        Ok(())
    }

    fn fail_draping(&mut self, words: Words) {
        self.draping = None;
        self.tell(words!("garment"), words);
    }

    /// Once cloth rests, splits edges that would cut the body.
    fn split_draped(&mut self) {
        if let (Some(garment), Some(body), Some(worn)) =
            (&self.garment, &self.body, self.draping.as_ref().and_then(|d| d.worn.as_ref()))
        {
            let offset = worn.offset() / body.scale();
            self.splits = Splits::of_lying(garment, &self.cloth, body, offset).map(Arc::new);
        }
    }

    /// Pins exactly these vertices of draped cloth. False where nothing is draped.
    pub(in crate::sim) fn hold_draped(&mut self, held: &[u32]) -> bool {
        // Cloth on its way to a pose goes there with the pins that it had; with others it stays as it came to the pose.
        self.draping.take_if(|draping| draping.walk.is_some());
        let Some(draping) = self.draping.as_mut().map(Arc::make_mut) else { return false };
        let Some(worn) = &mut draping.worn else { return false };
        worn.pin(held);
        draping.ends = None;
        true
    }

    /// Drags cloth that is being draped. False where it is not: then the drag of the relaxer takes over.
    pub(in crate::sim) fn grab_draped(&mut self, at: ClothPlace) -> bool {
        if !self.draping.as_ref().is_some_and(|d| d.left.is_none() && d.worn.is_some()) {
            self.draping = None;
            return false;
        }
        if let (Some((vertex, _)), Some(draping)) = (self.under(at), &mut self.draping) {
            let draping = Arc::make_mut(draping);
            (draping.held, draping.ends) = (true, None);
            draping.worn.iter_mut().for_each(|worn| worn.take(vertex));
            // All of the cloth may follow.
            self.dragged = Some(Arc::new(vec![1.0; self.cloth.positions.len()]));
        }
        true
    }

    /// Moves the target of the drag to the point of the ray `pointer` that is nearest to the dragged vertex.
    pub(in crate::sim) fn drag_draped(&mut self, pointer: Ray) {
        let Some(draping) = self.draping.as_mut().filter(|d| d.held) else { return };
        let Some(worn) = &mut Arc::make_mut(draping).worn else { return };
        if let (Some(at), Some(way)) = (worn.in_hand(), pointer.direction.try_normalize()) {
            worn.pull_to(pointer.origin + way * (at - pointer.origin).dot(way));
        }
    }

    /// Ends the drag of draped cloth.
    pub(in crate::sim) fn release_draped(&mut self) {
        if let Some(draping) = self.draping.as_mut().filter(|d| d.held) {
            let draping = Arc::make_mut(draping);
            draping.held = false;
            draping.worn.iter_mut().for_each(DrapedGarment::let_go);
            self.dragged = None;
        }
    }

    /// The state of draping; None where there is none.
    pub fn drape_state(&self) -> Option<DrapeState> {
        let draping = self.draping.as_ref()?;
        let progress = draping.worn.as_ref().map(DrapedGarment::progress);
        Some(DrapeState {
            on: draping.left.is_none(),
            waits: progress.is_none() && draping.walk.is_none(),
            runs: draping.runs(),
            restless: progress.is_some_and(|p| p.restless),
            residual: progress.map_or(1.0, |p| p.residual),
            speed: progress.map_or(0.0, |p| p.speed),
            ticks: progress.map_or(0, |p| p.ticks),
            substeps: draping.worn.as_ref().map_or(0, DrapedGarment::substeps),
            card: draping.worn.as_ref().is_some_and(DrapedGarment::was_on_card),
            way: draping.walk.as_ref().map(|walk| walk.progress()),
        })
    }
}

/// The simulation of a garment of these fabrics, with the vertices `held` held.
fn worn(
    (garment, cloth): (Arc<Garment>, &ClothState),
    body: Arc<Surface>,
    fabrics: &DrapeSource,
    held: &[u32],
    skips: Skips,
) -> Result<DrapedGarment, Undrapable> {
    let settings = DrapedSettings { strain: fabrics.strain, self_collision: true, skips };
    DrapedGarment::new(garment, cloth, body, (&fabrics.of_pieces, &fabrics.fabric), held, settings)
}
