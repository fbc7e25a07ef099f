//! Search for the best start of a garment: ways to put it on are tried one after the other until one has no fault.

mod as_built;
mod progress;
mod refined;

use std::sync::Arc;

use crate::body::Surface;
use crate::cloth::Skip;
use crate::fit::{BodyIndex, Moved, Report, TightPlace, measure, tight_places, tops};
use crate::geometry::words::{Words, words};
use crate::place::Turned;
use crate::sim::fault::{Fault, Lies, faults};
use crate::sim::source::DrapeSource;
use crate::sim::source::GarmentSource;
use crate::sim::start::{AsBuilt, Start, StartChoice, Started, Tried, Trying};
use crate::sim::world::World;
use crate::sim::world::coarse::coarse_edge;
use crate::wrap::suggested;

pub use as_built::BodyAndPose;
use as_built::{Try, tries};
use progress::Overall;
use refined::Refinement;

/// Ticks for each layer after which a start is judged even if its cloth still moves, unless it is the only one. One that is done in
/// parts counts as one, so that it does not depend on the number of triangles. Chosen by trial: with 1000 a shirt that came to rest
/// without a fault was given up.
const MOST_TICKS: u32 = 2000;
/// Edge length of the mesh in which starts that are nearly clean are tried once more, in edge lengths of the first.
const FINER: f64 = 0.9;

/// Judgement of the cloth.
pub(in crate::sim) struct Judged {
    pub faults: Vec<Fault>,
    pub tight: Vec<TightPlace>,
    /// Number of self-intersections, wrong triangles and vertices, open seams, and buttons that do not close.
    pub places: usize,
    /// Whether the body does not pass through an opening, or some cloth was never laid: draping cannot mend that.
    pub is_astray: bool,
}

/// Starts being tried.
#[derive(Clone, Debug)]
pub struct Trials {
    source: Arc<GarmentSource>,
    body: Arc<Surface>,
    fabrics: Arc<DrapeSource>,
    choice: StartChoice,
    /// The starts, the last first.
    order: Vec<Try>,
    left: Vec<Try>,
    /// Whether they are tried once more, in a finer mesh.
    finer: bool,
    /// The body in the pose that it is built in. None: that is the pose that it has, or marks lead the garment to where it is.
    built: Option<Arc<Surface>>,
    /// Whether the present start is tried on that body.
    as_built: bool,
    /// Whether the cloth of the present start is carried from there to the body's pose, or was.
    carrying: bool,
    /// Its cloth there before it was draped, where that has no fault.
    undraped: Option<Arc<World>>,
    now: Start,
    /// Whether [`Trials`] is draping the start, as it does after the wrap of [`Start::Marks`].
    draping: bool,
    /// Ticks of the present start.
    ticks: u32,
    /// Number of starts that were begun.
    begun: usize,
    overall: Overall,
    tried: Vec<Tried>,
    /// The best result so far, as a world and an index in `tried`.
    best: Option<(Arc<World>, usize)>,
    /// Failure of the last tick, in words.
    broken: Option<Words>,
    /// Edge length of the garment's own mesh, metres, if `source` has a coarser one.
    fine: Option<f64>,
    /// Result of the trials, while the cloth of the start that was taken settles in the garment's own mesh.
    refining: Option<Started>,
    /// What that cloth does now.
    refinement: Refinement,
    /// The cloth of the coarser mesh, from which it began.
    coarse: Option<Arc<World>>,
    /// That cloth once it was draped and had faults all the same, with those faults and their number of places.
    draped_fine: Option<(Arc<World>, Vec<Words>, usize)>,
}

impl Trials {
    /// The source of the garment.
    pub(in crate::sim) fn source(&self) -> &Arc<GarmentSource> {
        &self.source
    }

    /// The present start, and whether it is being draped.
    pub fn now(&self) -> (Start, bool) {
        (self.now, self.draping || self.now == Start::Placement)
    }

    /// The present start, whether it is being draped, and its number.
    pub fn shown(&self) -> Trying {
        let (start, draped) = self.now();
        Trying { start, draped, number: self.begun }
    }

    /// Progress over all starts, 0..=1. It never falls.
    pub fn progress(&self) -> f64 {
        self.overall.now()
    }

    /// A result of the present start.
    fn result(&self, faults: Vec<Words>, places: usize) -> Tried {
        let (draped, finer, ticks) = (self.now().1, self.finer, self.ticks);
        let as_built =
            self.as_built.then_some(if self.carrying { AsBuilt::Carried } else { AsBuilt::Dressed });
        Tried { start: self.now, draped, finer, as_built, faults, places, ticks }
    }

    /// Whether the present start has used up its time. An only start has as much as it needs, for example to sew several layers.
    fn is_out_of_time(&self) -> bool {
        let is_last = self.best.is_none() && self.left.is_empty();
        let layers = u32::from(self.source.pattern.outermost()) + 1;
        self.ticks >= MOST_TICKS * layers && !is_last && self.refining.is_none()
    }

    /// The number of the result that is being worked for, from 0.
    pub fn count(&self) -> usize {
        match &self.refining {
            Some(started) if self.refinement == Refinement::Undraped => started.tried.len(),
            Some(started) => started.taken,
            None => self.tried.len(),
        }
    }

    /// Records the result of the present start, whose cloth is in `world`: it can be taken, unless the body has another pose there.
    fn note(&mut self, world: World, faults: Vec<Words>, places: usize) {
        let tried = self.result(faults, places);
        if self.is_on_built() {
            if !tried.draped && self.is_clean(&tried) {
                self.undraped = Some(Arc::new(world));
            }
            return self.tried.push(tried);
        }
        let is_clean = self.is_clean(&tried);
        let rank = |tried: &Tried| {
            let is_wanted = tried.draped || !self.choice.draped;
            (!is_wanted, tried.faults.len(), tried.places, !tried.draped)
        };
        let is_better = self.best.as_ref().is_none_or(|(_, best)| rank(&tried) < rank(&self.tried[*best]));
        if is_better || (is_clean && tried.draped) {
            self.best = Some((Arc::new(world), self.tried.len()));
        }
        self.tried.push(tried);
    }

    /// Whether `tried` is acceptable and has no fault.
    fn is_clean(&self, tried: &Tried) -> bool {
        tried.faults.is_empty() && (tried.draped || !self.choice.draped)
    }

    /// Whether the starts are to be tried once more in a finer mesh.
    fn is_worth_a_finer_mesh(&self) -> bool {
        // Where the pattern's faults left out pieces their seams stay open in any mesh.
        let has_all = |world: &World| {
            let count = world.garment.as_ref().map(|garment| garment.pieces.len());
            count == Some(self.source.pattern.pieces.len())
        };
        let is_near = self
            .best
            .as_ref()
            .is_some_and(|(world, best)| self.tried[*best].is_nearly_clean() && has_all(world));
        is_near && !self.finer && self.source.relax.skips.allow(Skip::Fine)
    }

    /// Begins all starts again, in a finer mesh. What comes of them is carried to the garment's own.
    fn begin_finer(&mut self) {
        self.fine.get_or_insert(self.source.edge_length);
        (self.finer, self.left) = (true, self.order.clone());
        Arc::make_mut(&mut self.source).edge_length *= FINER;
    }

    /// Whether the best result has no fault.
    fn has_clean(&self) -> bool {
        self.best.as_ref().is_some_and(|(_, best)| self.is_clean(&self.tried[*best]))
    }
}

impl World {
    /// Begins to try the starts that `choice` allows. The error, in words, says that none of them can be begun.
    pub fn dressed(
        source: Arc<GarmentSource>,
        body: BodyAndPose,
        fabrics: Arc<DrapeSource>,
        choice: StartChoice,
    ) -> Result<Self, Words> {
        let BodyAndPose { body, built } = body.checked();
        let is_marked = source.marks.pairs().next().is_some();
        // No mark that could be suggested leads what is only tacked on, as a bow is.
        let is_allowed = |start: &Start| match choice.only {
            Some(only) => only == *start,
            None => is_marked || *start == Start::Placement || !source.pattern.has_tacks(),
        };
        let mut starts: Vec<Start> = Start::ALL.into_iter().filter(is_allowed).collect();
        // What turns over is sewn as it is placed: wrapped round the body a collar stands, and does not turn over any more. Marks
        // that the user made go before.
        let turns_over = source.pattern.turns_over_at_a_seam() || !Turned::new(&source.pattern).is_empty();
        if turns_over && !is_marked {
            starts.reverse();
        }
        let built = built.filter(|_| !is_marked);
        let mut order = tries(&starts, built.is_some());
        order.reverse();
        let (coarse, own) = (coarse_edge(&source), source.edge_length);
        let source = match coarse {
            Some(edge_length) => Arc::new(GarmentSource { edge_length, ..GarmentSource::clone(&source) }),
            None => source,
        };
        let mut trials = Trials {
            fine: coarse.map(|_| own),
            refining: None,
            refinement: Refinement::First,
            coarse: None,
            draped_fine: None,
            source,
            fabrics,
            choice,
            left: order.clone(),
            order,
            finer: false,
            built,
            body,
            as_built: false,
            carrying: false,
            undraped: None,
            now: Start::Marks,
            draping: false,
            ticks: 0,
            begun: 0,
            overall: Overall::default(),
            tried: Vec::new(),
            best: None,
            broken: None,
        };
        match Self::next_start(&mut trials) {
            Some(world) => Ok(Self { trials: Some(Arc::new(trials)), ..world }),
            None => Err(Words::joined(trials.tried.iter().flat_map(|tried| tried.faults.clone()), "; ")),
        }
    }

    /// Begins the next start that can be begun, or the first once more in a finer mesh; failures are recorded.
    fn next_start(trials: &mut Trials) -> Option<Self> {
        loop {
            while let Some(Try { start, as_built }) = trials.left.pop() {
                trials.as_built = as_built;
                (trials.now, trials.draping, trials.carrying, trials.ticks) = (start, false, false, 0);
                trials.undraped = None;
                match begun(start, trials) {
                    Ok(world) => {
                        trials.begun += 1;
                        return Some(world);
                    }
                    Err(words) => trials.tried.push(trials.result(vec![words], 0)),
                }
            }
            if !trials.is_worth_a_finer_mesh() {
                return None;
            }
            trials.begin_finer();
        }
    }

    /// Does a tick while starts are tried: one of the present start, or the transition to the next.
    pub(in crate::sim) fn try_on(&mut self) {
        self.try_further();
        self.note_progress();
    }

    fn try_further(&mut self) {
        let Some(mut trials) = self.trials.take() else { return };
        let now = Arc::make_mut(&mut trials);
        let broken = now.broken.take();
        let is_over = broken.is_some() || self.lies_still() || now.is_out_of_time();
        if !is_over {
            now.ticks += u32::from(!self.is_mid_tick());
            // Kept in place in case this tick fails.
            self.trials = Some(trials);
            return self.advance();
        }
        match self.after_start(now, broken) {
            Some(world) => *self = world,
            None => self.trials = Some(trials),
        }
    }

    /// Records the failure of the present start, in words. False where none is being tried.
    pub fn break_start(&mut self, words: Words) -> bool {
        let Some(trials) = &mut self.trials else { return false };
        Arc::make_mut(trials).broken = Some(words);
        true
    }

    /// Starts the trials again with changed `source` and `body`; None where none are in progress.
    pub(in crate::sim) fn tried_again(
        &self,
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
    ) -> Option<Result<Self, Words>> {
        let trials = self.trials.as_ref()?;
        let source = match trials.fine {
            Some(edge_length) => Arc::new(GarmentSource { edge_length, ..GarmentSource::clone(&source) }),
            None => source,
        };
        let body = BodyAndPose { body, built: trials.built.clone() };
        let again = Self::dressed(source, body, Arc::clone(&trials.fabrics), trials.choice);
        Some(again.map(|world| Self { relaxing: self.relaxing, ..world }))
    }

    /// Applies `change` to the source of the starts still to be tried.
    pub(in crate::sim) fn change_trials(&mut self, change: impl FnOnce(&mut GarmentSource)) {
        if let Some(trials) = &mut self.trials {
            change(Arc::make_mut(&mut Arc::make_mut(trials).source));
        }
    }

    /// Replaces the fabrics of the starts still to be tried.
    pub(in crate::sim) fn change_trial_fabrics(&mut self, fabrics: &Arc<DrapeSource>) {
        if let Some(trials) = &mut self.trials {
            Arc::make_mut(trials).fabrics = Arc::clone(fabrics);
        }
    }

    /// Judges the start that has ended. Returns the world that was taken, or None where another stage or start has begun.
    fn after_start(&mut self, trials: &mut Trials, broken: Option<Words>) -> Option<Self> {
        let mut faults: Vec<Words> = broken.into_iter().collect();
        let (mut places, mut is_astray) = (0, false);
        if faults.is_empty() {
            if let Some(judged) = self.judged() {
                let words = |fault: Fault| fault.problem.in_words();
                faults.extend(judged.faults.into_iter().map(words));
                (places, is_astray) = (judged.places, judged.is_astray);
            }
            if trials.is_out_of_time() && !self.lies_still() {
                faults.push(words!("it still moves"));
            }
            if trials.draping && self.moved != Moved::Draped {
                let why = self.problems.last().map(|problem| problem.words.clone()).unwrap_or_default();
                faults.push(words!("it was not draped: {why}", why));
            }
        }
        if trials.refining.is_some() && self.mends_refined(trials, &faults, places) {
            return None;
        }
        if let Some(started) = trials.refining.take() {
            let ended = self.ended(trials, started, (faults, places));
            let Some(next) = Self::after_faulty(trials, &ended) else { return Some(ended) };
            *self = Self { relaxing: self.relaxing, ..next };
            return None;
        }
        let lies = self.cloth.mapped.contains(&true) && self.not_finite().is_none();
        let drapes_next = trials.now == Start::Marks && !trials.draping && lies && !is_astray;
        let goes_on = lies && trials.goes_into_pose(&faults, places);
        trials.note(self.clone(), faults, places);
        if goes_on && self.carry_into_pose(trials) {
            return None;
        }
        if drapes_next {
            (trials.draping, trials.ticks) = (true, 0);
            self.hung_at = self.garment.as_ref().map(|garment| tops(garment, &self.cloth).into());
            self.drape_for(None, Arc::clone(&trials.fabrics));
            return None;
        }
        // The same marks may have been without fault before draping.
        if !trials.has_clean() {
            if self.carry_undraped(trials) {
                return None;
            }
            let relaxing = self.relaxing;
            if let Some(next) = Self::next_start(trials) {
                *self = Self { relaxing, ..next };
                return None;
            }
        }
        let (world, taken) = trials.best.take().unwrap_or_else(|| trials.left_on_built(self));
        let started = Started { tried: std::mem::take(&mut trials.tried), taken };
        let world = Arc::unwrap_or_clone(world);
        let is_in =
            |edge_length: f64| world.source.as_ref().is_some_and(|source| source.edge_length == edge_length);
        if let Some(edge_length) = trials.fine.filter(|own| !is_in(*own)) {
            (trials.now, trials.draping) = (started.taken().start, started.taken().draped);
            (trials.refining, trials.ticks) = (Some(started), 0);
            trials.coarse = Some(Arc::new(world.clone()));
            *self = world.refined(edge_length, Arc::clone(&trials.fabrics));
            return None;
        }
        Some(Self { started: Some(Arc::new(started)), ..world })
    }

    /// Faults and tight places of the cloth; None where there is no garment.
    pub(in crate::sim) fn judged(&self) -> Option<Judged> {
        let (source, garment, body) = (self.source.as_ref()?, self.garment.as_ref()?, self.body.as_ref()?);
        let split = self.drawn();
        let (garment, cloth) =
            split.as_ref().map_or((garment, &self.cloth), |(garment, cloth)| (garment, cloth));
        let hung_at = self.hung_at.as_deref().filter(|_| self.moved == Moved::Draped);
        let unbalanced = self.drape_state().and_then(|drape| drape.unbalanced());
        let lies = Lies { moved: self.moved, sewn: self.was_sewn, hung_at, unbalanced };
        let index = BodyIndex::new(body);
        let report = measure(&source.pattern, garment, cloth, &index);
        Some(Judged {
            faults: faults(&report, source, garment, cloth, &index, lies),
            tight: tight_places(&report, garment, cloth, || body.landmarks()),
            places: places(&report, lies),
            is_astray: is_astray(&report),
        })
    }
}

/// Begins `start` with the garment of `trials`; the error is in words.
fn begun(start: Start, trials: &Trials) -> Result<World, Words> {
    let (source, body) = trials.source_and_body();
    if start == Start::Placement {
        return World::placed(source, body, Arc::clone(&trials.fabrics));
    }
    if source.marks.pairs().next().is_some() {
        return Ok(World::wrapped(source, body));
    }
    if source.pattern.outermost() > 0 {
        return Err(words!("marks are suggested for one layer only: several are sewn over each other"));
    }
    let marks = suggested(&source.pattern, &body, source.relax.offset * body.scale());
    if marks.pairs().next().is_none() {
        return Err(words!(
            "no marks can be suggested: none of its pieces is placed in front of or behind the body"
        ));
    }
    Ok(World::wrapped(
        Arc::new(GarmentSource { marks: Arc::new(marks), ..GarmentSource::clone(&source) }),
        body,
    ))
}

/// Number of places with faults.
fn places(report: &Report, lies: Lies<'_>) -> usize {
    let inside = report.penetration.vertices + report.penetration.faces;
    let through = report.edges_through_body + report.body_edges_through_garment;
    let cloth = report.self_crossings + report.degenerate_faces + report.strain.doubled;
    let missing: usize = report.pieces.iter().map(|piece| piece.missing_triangles).sum();
    let open = report.seams.open + report.fastenings.apart;
    inside + through + cloth + missing + open + report.wrong_side_out(lies.moved)
}

/// Whether the cloth is where draping cannot mend it.
fn is_astray(report: &Report) -> bool {
    report.missed_openings().next().is_some() || report.pieces.iter().any(|piece| piece.missing_triangles > 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::simulation::tests::{ball, cotton, source};

    pub(super) fn rested(mut world: World) -> World {
        while !world.lies_still() {
            world.advance();
        }
        world
    }

    /// Sewn over each other, more layers take longer than any of several starts may.
    #[test]
    fn an_only_start_has_as_long_as_it_needs() {
        let begun = World::dressed(source(), ball().into(), cotton(), StartChoice::default());
        let mut trials = Arc::unwrap_or_clone(begun.expect("begun").trials.take().expect("begun"));
        let layers = u32::from(trials.source.pattern.outermost()) + 1;
        assert!(layers == 1 && !trials.left.is_empty());
        trials.ticks = MOST_TICKS - 1;
        assert!(!trials.is_out_of_time());
        trials.ticks = MOST_TICKS;
        assert!(trials.is_out_of_time(), "another is left");
        trials.left.clear();
        assert!(!trials.is_out_of_time(), "no other is left, and nothing was reached");
        trials.best = Some((Arc::default(), 0));
        assert!(trials.is_out_of_time(), "there is another result");
    }

    #[test]
    fn starts_with_few_faults_are_tried_once_more_in_a_finer_mesh_and_carried_to_their_own() {
        let begun = World::dressed(source(), ball().into(), cotton(), StartChoice::default());
        let mut world = begun.expect("begun");
        let mut trials = Arc::unwrap_or_clone(world.trials.take().expect("begun"));
        let own = trials.source.edge_length;
        trials.left.clear();
        let crosses = || vec![Words::plain("it crosses itself")];
        trials.note(world.clone(), crosses(), Tried::FEW + 1);
        assert!(World::next_start(&mut trials).is_none(), "many places are no chance");
        trials.note(world, crosses(), Tried::FEW);
        let world = World::next_start(&mut trials).expect("once more");
        assert_eq!((trials.fine, trials.source.edge_length), (Some(own), own * FINER));
        let mut world = rested(world);
        let refined = loop {
            match world.after_start(&mut trials, None) {
                Some(world) => break world,
                None => world = rested(world),
            }
        };
        let started = refined.started.as_ref().expect("told");
        let told: Vec<bool> = started.tried.iter().map(|tried| tried.finer).collect();
        assert_eq!((&told[..3], started.taken().finer), (&[false, false, true][..], true));
        assert!(started.taken().faults.is_empty());
        assert_eq!(refined.source.expect("a garment").edge_length, own);
        // A second time they are not.
        trials.left.clear();
        trials.best = Some((Arc::default(), 0));
        trials.tried = started.tried.clone();
        trials.tried[0].places = 1;
        assert!(trials.tried[0].is_nearly_clean());
        assert!(World::next_start(&mut trials).is_none());
    }
}
