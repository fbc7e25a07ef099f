//! The owner of the moving state: takes requests between ticks, does one bounded piece of work in a tick, sleeps at rest.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use crate::card::CardSlot;
use crate::cloth::Skips;
use crate::fit::TightPlace;
use crate::geometry::words::{Words, words};
use crate::sim::checkpoints::{Checkpoints, DEFAULT_CAPACITY};
use crate::sim::fault::Fault;
use crate::sim::protocol::{Event, Request, RequestKind, Snapshot};
use crate::sim::start::Trying;
use crate::sim::stats::Stats;
use crate::sim::world::World;
use crate::sim::world::posed::Then;
use crate::sim::world::trials::{BodyAndPose, Judged};
use crate::wrap::Phase;

/// Faults and tight places found on cloth at rest.
#[derive(Debug, Default)]
struct Looked {
    faults: Arc<Vec<Fault>>,
    tight: Arc<Vec<TightPlace>>,
}

/// Runs the stages. The same requests in the same ticks give the same bits, on any thread.
#[derive(Debug)]
pub struct Simulation {
    world: World,
    checkpoints: Checkpoints,
    tick: u64,
    seq: u64,
    stats: Stats,
    events: Vec<Event>,
    looked: Option<Looked>,
    skips: Skips,
    card: Option<Arc<CardSlot>>,
}

impl Default for Simulation {
    fn default() -> Self {
        Self::with_memory(DEFAULT_CAPACITY)
    }
}

impl Simulation {
    /// A simulation with nothing on the body, and about `capacity` bytes for checkpoints.
    pub fn with_memory(capacity: usize) -> Self {
        Self {
            world: World::default(),
            checkpoints: Checkpoints::new(capacity),
            tick: 0,
            seq: 0,
            stats: Stats::default(),
            events: Vec::new(),
            looked: None,
            skips: Skips::default(),
            card: None,
        }
    }

    /// Allows exactly these savings of work.
    pub fn set_skips(&mut self, skips: Skips) {
        self.skips = skips;
        if let Some(source) = &mut self.world.source {
            Arc::make_mut(source).relax.skips = skips;
        }
    }

    /// Carries out `request`; building a garment happens here. A failure is reported by [`Event::Failed`].
    pub fn apply(&mut self, request: Request) {
        if matches!(request.kind, RequestKind::Hash) {
            self.report_hash(Some(request.seq));
            return;
        }
        if let RequestKind::UseCard(card) = request.kind {
            self.card = card;
            return;
        }
        self.looked = None;
        self.world.card.clone_from(&self.card);
        let before = self.world.clone();
        if request.checkpoint {
            self.keep(request.seq);
        }
        self.seq = request.seq;
        self.events.push(Event::Applied { seq: request.seq, tick: self.tick });
        let done = catch_unwind(AssertUnwindSafe(|| self.carry_out(request.kind)));
        let problem = match done {
            Ok(Ok(())) => self.world.not_finite().map(not_a_number),
            Ok(Err(words)) => Some(words),
            Err(panic) => Some(panic_words(&*panic)),
        };
        if let Some(words) = problem {
            self.world = before;
            self.fail(words);
        }
    }

    /// Does a tick of work. True when there is more to do; at rest it does nothing and counts no tick.
    pub fn tick(&mut self) -> bool {
        if self.is_at_rest() {
            return false;
        }
        self.tick += 1;
        self.looked = None;
        self.count_tick();
        self.world.card.clone_from(&self.card);
        let problem = match catch_unwind(AssertUnwindSafe(|| self.world.step())) {
            Ok(()) => self.world.not_finite().map(not_a_number),
            Err(panic) => Some(panic_words(&*panic)),
        };
        if let Some(words) = problem
            && !self.world.break_start(words.clone())
        {
            self.world = self.checkpoints.newest().cloned().unwrap_or_default();
            self.fail(words);
        }
        if self.is_at_rest() {
            self.report_hash(None);
        }
        !self.is_at_rest()
    }

    /// Whether a tick would change nothing.
    pub fn is_at_rest(&self) -> bool {
        self.world.is_at_rest()
    }

    /// Ticks executed so far.
    pub fn ticks(&self) -> u64 {
        self.tick
    }

    /// Number of the last request that took effect; 0: none.
    pub fn seq(&self) -> u64 {
        self.seq
    }

    /// Phase of dressing; None without a garment.
    pub fn phase(&self) -> Option<Phase> {
        self.world.phase()
    }

    /// While starts are tried: the present one.
    pub fn trying(&self) -> Option<Trying> {
        self.world.trials.as_ref().map(|trials| trials.shown())
    }

    /// While starts are tried: the number of the result that is being worked for, from 0.
    pub fn result_in_work(&self) -> Option<usize> {
        self.world.trials.as_ref().map(|trials| trials.count())
    }

    /// Whether the cloth is following its body to another pose.
    pub fn is_posing(&self) -> bool {
        self.world.posing.is_some()
    }

    /// Progress of growing and settling, or over all starts while they are tried, 0..=1.
    pub fn progress(&self) -> f64 {
        self.world.progress()
    }

    /// Hash of the moving state.
    pub fn hash(&self) -> u64 {
        self.world.hash()
    }

    /// A snapshot of the state.
    pub fn snapshot(&self) -> Snapshot {
        let world = &self.world;
        let (cloth, source, body) = world.shown();
        Snapshot {
            tick: self.tick,
            seq: self.seq,
            garment: world.garment.clone(),
            source: source.cloned(),
            body: body.cloned(),
            cloth: Arc::clone(cloth),
            split: world.drawn(),
            phase: world.phase(),
            progress: world.progress(),
            pinned: Arc::clone(&world.pinned),
            dragged: world.dragged.clone(),
            relaxing: world.relaxing,
            working: !world.is_at_rest(),
            stats: Stats { work: world.work(), contact: world.separated, ..self.stats },
            problems: Arc::clone(&world.problems),
            reposed: world.outcome(),
            verdict: self.looked.as_ref().map(|looked| Arc::clone(&looked.faults)),
            tight: self.looked.as_ref().map_or_else(Arc::default, |looked| Arc::clone(&looked.tight)),
            is_posing: world.posing.is_some(),
            is_carried: world.is_carried(),
            drape: world.drape_state(),
            moved: world.moved,
            was_sewn: world.was_sewn,
            hung_at: world.hung_at.clone(),
            is_sewing: world.sewing.is_some(),
            trying: world.trials.as_ref().map(|trials| trials.shown()),
            started: world.started.clone(),
        }
    }

    /// Looks for faults and tight places of cloth at rest; snapshots contain them from then on. True when there was cloth that
    /// had not been looked at. Moves nothing.
    pub fn judge(&mut self) -> bool {
        let world = &self.world;
        if self.looked.is_some() || !self.is_at_rest() || !world.cloth.mapped.contains(&true) {
            return false;
        }
        match catch_unwind(AssertUnwindSafe(|| world.judged())) {
            Ok(None) => return false,
            Ok(Some(Judged { faults, tight, .. })) => {
                self.looked = Some(Looked { faults: Arc::new(faults), tight: Arc::new(tight) });
            }
            Err(panic) => {
                self.looked = Some(Looked::default());
                self.fail(panic_words(&*panic));
            }
        }
        true
    }

    /// Events since the last call, in order.
    pub fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    fn carry_out(&mut self, kind: RequestKind) -> Result<(), Words> {
        match kind {
            // A new change of pose starts from the cloth as it was before the one in progress.
            RequestKind::Repose { .. } | RequestKind::Resize { .. } => self.world.posing = None,
            RequestKind::SetRelaxing(_) => {}
            // These replace the cloth: no need to finish the change of pose.
            RequestKind::Restore { .. }
            | RequestKind::Clear
            | RequestKind::Wrap { .. }
            | RequestKind::Adopt { .. }
            | RequestKind::Sew { .. }
            | RequestKind::Dress { .. } => {}
            // All others act on the cloth in the new pose.
            _ => self.world.finish_posing(),
        }
        let by_card = self.world.moved_by_card && keeps_cloth(&kind);
        match self.with_skips(kind) {
            RequestKind::Wrap { source, body } => self.set_world(World::wrapped(source, body)),
            RequestKind::Rewrap { source, body, pairs } => {
                let world = self.world.rewrapped(source, body, &pairs);
                self.set_world(world);
            }
            RequestKind::Adopt { source, body, cloth, moved } => {
                self.set_world(World::adopted(source, body, cloth, moved)?);
            }
            RequestKind::Resew { pattern, marks, pins, carried } => {
                if let Some(world) = self.world.resewn(pattern, marks, pins, &carried) {
                    self.set_world(world);
                }
            }
            RequestKind::Repose { body, marks, fabrics, settle, draft } => {
                let then = match (draft, settle) {
                    (true, _) => Then::Nothing,
                    (false, true) => Then::Settle(fabrics),
                    (false, false) => Then::Part(fabrics),
                };
                if let Some(world) = self.world.reposed(body, marks, then)? {
                    self.set_world(world);
                }
                if draft {
                    self.world.finish_posing();
                }
            }
            RequestKind::Resize { through, body, marks, fabrics } => {
                if let Some(world) = self.world.resized(through, body, marks, fabrics)? {
                    self.set_world(world);
                }
            }
            RequestKind::SetRelax(relax) => self.world.set_relax(relax),
            RequestKind::SetRelaxing(on) => self.world.relaxing = on,
            RequestKind::SetDraping { on, source } => self.world.set_draping(on, source),
            RequestKind::StepDraping { ticks, source } => {
                self.world.trials = None;
                self.world.drape_for(Some(ticks), source);
            }
            RequestKind::Sew { source, body, fabrics } => {
                self.set_world(World::sewn(source, body, fabrics)?);
            }
            RequestKind::Dress { source, body, built, fabrics, choice } => {
                self.set_world(World::dressed(source, BodyAndPose { body, built }, fabrics, choice)?);
            }
            RequestKind::SetFabrics(source) => self.world.set_fabrics(source),
            RequestKind::SetActivities(activities) => self.world.set_activities(&activities),
            RequestKind::SetPins(places) => self.world.set_pins(&places),
            RequestKind::Grab { at, mode, bones } => self.world.grab(at, mode, &bones),
            RequestKind::DragTo(pointer) => self.world.drag_to(pointer),
            RequestKind::Release => self.world.release(),
            RequestKind::Clear => self.world = World::default(),
            RequestKind::Restore { before_seq } => self.restore(before_seq)?,
            RequestKind::UseCard(_) | RequestKind::Hash => {}
        }
        self.world.moved_by_card |= by_card;
        Ok(())
    }

    fn with_skips(&self, mut kind: RequestKind) -> RequestKind {
        match &mut kind {
            RequestKind::Wrap { source, .. }
            | RequestKind::Rewrap { source, .. }
            | RequestKind::Adopt { source, .. }
            | RequestKind::Sew { source, .. }
            | RequestKind::Dress { source, .. }
                if source.relax.skips != self.skips =>
            {
                Arc::make_mut(source).relax.skips = self.skips;
            }
            RequestKind::SetRelax(relax) => relax.skips = self.skips,
            _ => {}
        }
        kind
    }

    fn set_world(&mut self, world: World) {
        self.stats.wraps += u64::from(world.dressing.is_some());
        self.stats.triangles_built += world.garment.as_ref().map_or(0, |g| g.triangles.len() as u64);
        self.world = world;
        self.world.part_active();
    }

    fn restore(&mut self, before_seq: u64) -> Result<(), Words> {
        let world = self
            .checkpoints
            .before(before_seq)
            .ok_or_else(|| words!("the cloth of that time is no longer kept"))?;
        self.world = world.clone();
        self.stats.restores += 1;
        Ok(())
    }

    fn keep(&mut self, seq: u64) {
        self.stats.checkpoints += 1;
        if let Some(before_seq) = self.checkpoints.store(seq, self.world.clone()) {
            self.events.push(Event::Forgotten { before_seq });
        }
    }

    fn count_tick(&mut self) {
        self.stats.ticks += 1;
        match self.world.phase() {
            Some(Phase::Growing) => self.stats.growing_ticks += 1,
            _ => self.stats.settling_ticks += 1,
        }
        self.stats.vertices_moved += self.world.cloth.mapped.iter().filter(|&&m| m).count() as u64;
    }

    fn fail(&mut self, words: Words) {
        self.world.relaxing = false;
        self.world.stop_draping();
        self.stats.failures += 1;
        self.events.push(Event::Failed { tick: self.tick, seq: self.seq, words });
    }

    fn report_hash(&mut self, asked: Option<u64>) {
        let (tick, seq) = (self.tick, self.seq);
        let cloth = (!self.world.moved_by_card).then(|| self.world.hash());
        self.events.push(Event::Hash { tick, seq, cloth, asked });
    }
}

/// Whether the request makes another garment of the cloth as it lies.
fn keeps_cloth(kind: &RequestKind) -> bool {
    use RequestKind::{Repose, Resew, Resize, Rewrap};
    matches!(kind, Rewrap { .. } | Resew { .. } | Repose { .. } | Resize { .. })
}

fn not_a_number(vertex: usize) -> Words {
    words!("vertex {n} of the cloth is no longer a finite point", n = vertex)
}

fn panic_words(panic: &(dyn std::any::Any + Send)) -> Words {
    let words = panic
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("no words");
    words!("a step of the simulation failed: {words}", words)
}

#[cfg(test)]
#[path = "simulation_tests.rs"]
pub(in crate::sim) mod tests;
