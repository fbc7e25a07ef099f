//! Draping: physics moves the garment on the body until it rests.

use std::sync::Arc;

use glam::DVec3;

use crate::body::Surface;
use crate::cloth::{ClothState, Garment, Skips};
use crate::contact::Splits;
use crate::drag::Ray;
use crate::drape::{DrapedGarment, DrapedSettings, Undrapable};
use crate::fit::{fallen_from, tops};
use crate::geometry::words::{Words, words};
use crate::sim::protocol::DrapeState;
use crate::sim::source::{ClothPlace, DrapeSource};
use crate::sim::world::World;
use crate::sim::world::posed::Posed;
use crate::sim::world::walk::{Going, Walk};
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

/// What is still to be done for a change of pose once the cloth rests.
#[derive(Clone, Debug)]
struct EndOfPose {
    /// The change of pose; None where the body got other triangles with it.
    posed: Option<Arc<Posed>>,
    /// For cloth that is draped along the way: what it would be otherwise.
    otherwise: Option<Otherwise>,
}

/// The result of a change of pose, kept while the cloth is draped along the way.
#[derive(Clone, Debug)]
struct Otherwise {
    cloth: Arc<ClothState>,
    splits: Option<Arc<Splits>>,
    /// Number of its faults, and of places with them.
    faults: (usize, usize),
}

impl Draping {
    fn new(source: Arc<DrapeSource>) -> Self {
        Self { source, worn: None, left: None, held: false, ends: None, walk: None }
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
            worn.wake();
        }
        self.draping = Some(Arc::new(draping));
    }

    /// Drapes cloth that has just come to another pose until it rests; then its position counts as the result of that change of
    /// pose.
    pub(in crate::sim) fn drape_posed(&mut self, source: Arc<DrapeSource>) {
        let ends = Some(EndOfPose { posed: self.posed.clone(), otherwise: None });
        self.draping = Some(Arc::new(Draping { ends, ..Draping::new(source) }));
    }

    /// Begins to drape draped cloth along the way to the pose that it has come to by `posed`, where it had no fault before and has one
    /// now.
    pub(in crate::sim) fn walk_if_worse(&mut self, posed: Option<Arc<Posed>>, source: &Arc<DrapeSource>) {
        let Some(posed) = posed.filter(|_| self.was_draped) else { return };
        let before = || Self {
            cloth: Arc::new(posed.reposer.cloth().clone()),
            body: Some(Arc::clone(posed.reposer.from())),
            splits: None,
            ..self.clone()
        };
        let Some(judged) = self.judged().filter(|judged| !judged.faults.is_empty()) else { return };
        if before().judged().is_some_and(|before| before.faults.is_empty())
            && let Some(walk) = self.begun_walk(&posed, source)
        {
            let (cloth, splits) = (Arc::clone(&self.cloth), self.splits.clone());
            let faults = (judged.faults.len(), judged.places);
            let otherwise = Some(Otherwise { cloth, splits, faults });
            let ends = Some(EndOfPose { posed: Some(posed), otherwise });
            let walk = Some(Arc::new(walk));
            self.draping = Some(Arc::new(Draping { ends, walk, ..Draping::new(Arc::clone(source)) }));
        }
    }

    fn begun_walk(&self, posed: &Posed, fabrics: &DrapeSource) -> Option<Walk> {
        let garment = Arc::clone(self.active.as_ref().or(self.garment.as_ref())?);
        let (held, skips) = (self.held(), self.source.as_ref()?.relax.skips);
        Walk::new(posed.reposer.clone(), Arc::clone(self.body.as_ref()?), |cloth, body| {
            worn((garment, cloth), body, fabrics, &held, skips).ok()
        })
    }

    /// Does a part of a tick on the way to a pose.
    fn walk(&mut self) {
        let Some(draping) = self.draping.as_mut().map(Arc::make_mut) else { return };
        let Some(walk) = &mut draping.walk else { return };
        match Arc::make_mut(walk).go_on() {
            Going::On => {}
            Going::Arrived => {
                let Some(Walk { mut worn, cloth, .. }) = draping.walk.take().map(Arc::unwrap_or_clone) else {
                    return;
                };
                self.separated = self.separated.and(worn.take_separation());
                draping.worn = Some(match &self.card {
                    Some(slot) => worn.with_card(slot),
                    None => worn,
                });
                // Where it would hang had it not been draped, as far as that is known.
                self.hung_at = self.garment.as_ref().map(|garment| tops(garment, &self.cloth).into());
                self.cloth = Arc::new(cloth);
                (self.splits, self.posed) = (None, None);
            }
            Going::Stuck => self.go_otherwise(),
        }
    }

    /// Takes the cloth as it came to the pose without being draped along the way.
    fn go_otherwise(&mut self) {
        let ends = self.draping.take().and_then(|draping| draping.ends.clone());
        let Some(EndOfPose { posed: Some(posed), otherwise: Some(otherwise) }) = ends else { return };
        (self.cloth, self.splits, self.hung_at) = (otherwise.cloth, otherwise.splits, None);
        self.lies_as(posed);
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
        if !self.is_draped()
            && let Err(Undrapable(words)) = self.begin_draping()
        {
            return self.fail_draping(words);
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

    fn finish_pose(&mut self) {
        let Some(draping) = self.draping.clone() else { return };
        let Some(EndOfPose { posed, otherwise }) = draping.ends.clone() else { return };
        if let Some(otherwise) = otherwise {
            let judged = self.judged().map(|judged| (judged.faults.len(), judged.places));
            let is_better = judged.is_some_and(|faults| faults <= otherwise.faults) && !self.has_fallen();
            self.hung_at = None;
            return if is_better { self.end_pose(posed) } else { self.go_otherwise() };
        }
        self.end_pose(posed.clone());
        self.walk_if_worse(posed, &draping.source);
    }

    /// Whether pieces hang much lower than they did.
    fn has_fallen(&self) -> bool {
        let (Some(tops), Some(source), Some(garment)) = (&self.hung_at, &self.source, &self.garment) else {
            return false;
        };
        !fallen_from(tops, &source.pattern, garment, &self.cloth).is_empty()
    }

    fn end_pose(&mut self, posed: Option<Arc<Posed>>) {
        self.draping = None;
        if let Some(posed) = posed {
            self.lies_as(posed);
        }
    }

    fn begin_draping(&mut self) -> Result<(), Undrapable> {
        let held = self.held();
        let (Some(garment), Some(body), Some(source), Some(draping)) =
            (&self.garment, &self.body, &self.source, &mut self.draping)
        else {
            return Err(Undrapable(words!("there is no cloth on the body")));
        };
        let garment = Arc::clone(self.active.as_ref().unwrap_or(garment));
        let skips = source.relax.skips;
        let worn = worn((garment, &self.cloth), Arc::clone(body), &draping.source, &held, skips)?;
        let worn = if self.trials.is_some() { worn.let_down() } else { worn };
        Arc::make_mut(draping).worn = Some(match &self.card {
            Some(slot) => worn.with_card(slot),
            None => worn,
        });
        (self.dressing, self.splits, self.posed) = (None, None, None);
        self.was_draped = true;
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
            let mut dragged = vec![0.0; self.cloth.positions.len()];
            dragged[vertex as usize] = 1.0;
            self.dragged = Some(Arc::new(dragged));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::simulation::tests::{ball, cotton, source};
    use crate::sim::world::posed::Then;

    /// A patch that was draped on a ball without a fault, carried to where the ball is moved to, and damaged there.
    fn damaged() -> World {
        let mut world = World::wrapped(source(), ball());
        while !world.lies_still() {
            world.advance();
        }
        let piece = *source().pattern.pieces.keys().next().expect("a piece");
        let at = [(0.0, 0.1), (0.2, 0.1)].map(|at| ClothPlace { piece, at: at.into() });
        world.set_pins(&at);
        world.was_draped = true;
        let aside = ball().mesh.positions.iter().map(|p| *p + DVec3::X * 0.05).collect();
        let there = Arc::new(ball().reposed(aside).expect("as many vertices"));
        let moved = world.reposed(there, Arc::default(), Then::Part(cotton()));
        let mut world = moved.expect("moved").expect("there is cloth");
        world.finish_posing();
        assert!(world.draping.is_none() && world.outcome().is_some(), "carried without a fault");
        let middle = DVec3::X * 0.05;
        Arc::make_mut(&mut world.cloth).positions.iter_mut().for_each(|p| *p = p.lerp(middle, 0.5));
        world.walk_if_worse(world.posed.clone(), &cotton());
        assert!(world.drape_state().is_some_and(|state| state.way == Some(0.0) && state.runs));
        world
    }

    fn at_rest(mut world: World) -> World {
        while world.drapes_now() {
            world.step();
        }
        assert!(world.draping.is_none() && world.outcome().is_some(), "the end of a change of pose");
        world
    }

    #[test]
    fn what_has_a_fault_in_a_pose_is_draped_along_the_way_there() {
        let world = at_rest(damaged());
        let faults = world.judged().expect("a garment").faults;
        assert!(faults.is_empty(), "{faults:?}");
    }

    #[test]
    fn what_comes_out_worse_on_the_way_stays_as_it_was() {
        let mut damaged = damaged();
        let before = Arc::clone(&damaged.cloth);
        let otherwise = Otherwise { cloth: Arc::clone(&before), splits: None, faults: (9, 9) };
        let ends = Arc::make_mut(damaged.draping.as_mut().expect("begun")).ends.as_mut().expect("a pose");
        ends.otherwise = Some(otherwise);
        while damaged.draping.as_ref().is_some_and(|draping| draping.walk.is_some()) {
            damaged.step();
        }
        // It lies below where it was to lie, as if it had slid down.
        damaged.hung_at = Some(vec![10.0].into());
        assert!(Arc::ptr_eq(&at_rest(damaged).cloth, &before));
    }
}
