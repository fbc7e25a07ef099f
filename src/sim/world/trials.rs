//! The best start for a garment without marks: ways to put it on are tried one after the other until one has no fault.

use std::sync::Arc;

use crate::body::{Surface, landmarks};
use crate::fit::{BodyIndex, Report, TightPlace, measure, tight_places};
use crate::sim::fault::{Fault, Lies, faults};
use crate::sim::source::DrapeSource;
use crate::sim::source::GarmentSource;
use crate::sim::start::{Start, StartChoice, Started, Tried};
use crate::sim::world::World;
use crate::sim::world::coarse::coarse_edge;
use crate::wrap::suggested;

/// Ticks after which a start is judged as its cloth lies, unless there is no other start.
const MOST_TICKS: u32 = 2000;

/// What cloth is judged by.
pub(in crate::sim) struct Judged {
    pub faults: Vec<Fault>,
    pub tight: Vec<TightPlace>,
    /// Crossings, triangles and vertices that are wrong, and open seams.
    pub places: usize,
    /// The body does not pass through an opening, or cloth never reached it: no draping mends that.
    pub is_astray: bool,
}

/// Starts being tried.
#[derive(Clone, Debug)]
pub struct Trials {
    source: Arc<GarmentSource>,
    body: Arc<Surface>,
    fabrics: Arc<DrapeSource>,
    choice: StartChoice,
    left: Vec<Start>,
    now: Start,
    /// The start is being draped by [`Trials`], as marks are after their wrap.
    draping: bool,
    /// Of this start so far.
    ticks: u32,
    tried: Vec<Tried>,
    /// What was kept of those that may be taken, and which of `tried` it is.
    best: Option<(Arc<World>, usize)>,
    /// The last tick broke down.
    broken: Option<String>,
    /// The garment's own edge length, metres, where `source` has a coarser one.
    fine: Option<f64>,
    /// What was taken, once its cloth goes on in the garment's own mesh.
    refining: Option<Started>,
}

impl Trials {
    /// What is being dressed.
    pub(in crate::sim) fn source(&self) -> &Arc<GarmentSource> {
        &self.source
    }

    /// The start under way, and whether it is draped already.
    pub fn now(&self) -> (Start, bool) {
        (self.now, self.draping || self.now == Start::Placement)
    }

    /// Whether the start under way has had its time. It has all it needs where there is no other, as where several layers are sewn
    /// over each other.
    fn is_out_of_time(&self) -> bool {
        let is_last = self.best.is_none() && self.left.is_empty();
        self.ticks >= MOST_TICKS && !is_last && self.refining.is_none()
    }

    /// How many starts have been judged.
    pub fn count(&self) -> usize {
        self.tried.len()
    }

    /// Notes what came of the start under way, whose cloth is `world`.
    fn note(&mut self, world: World, faults: Vec<String>, places: usize) {
        let tried = Tried { start: self.now, draped: self.now().1, faults, places, ticks: self.ticks };
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

    /// Whether `tried` may be taken and has no fault.
    fn is_clean(&self, tried: &Tried) -> bool {
        tried.faults.is_empty() && (tried.draped || !self.choice.draped)
    }

    /// Whether one without a fault was kept.
    fn has_clean(&self) -> bool {
        self.best.as_ref().is_some_and(|(_, best)| self.is_clean(&self.tried[*best]))
    }
}

impl World {
    /// Begins to try the starts that `choice` allows. The error is in words: none of them can be begun.
    pub fn dressed(
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
        fabrics: Arc<DrapeSource>,
        choice: StartChoice,
    ) -> Result<Self, String> {
        let mut left: Vec<Start> =
            Start::ALL.into_iter().filter(|s| choice.only.is_none_or(|o| o == *s)).collect();
        left.reverse();
        let (coarse, own) = (coarse_edge(&source), source.edge_length);
        let source = match coarse {
            Some(edge_length) => Arc::new(GarmentSource { edge_length, ..GarmentSource::clone(&source) }),
            None => source,
        };
        let mut trials = Trials {
            fine: coarse.map(|_| own),
            refining: None,
            source,
            body,
            fabrics,
            choice,
            left,
            now: Start::Marks,
            draping: false,
            ticks: 0,
            tried: Vec::new(),
            best: None,
            broken: None,
        };
        match Self::next_start(&mut trials) {
            Some(world) => Ok(Self { trials: Some(Arc::new(trials)), ..world }),
            None => {
                Err(trials.tried.iter().flat_map(|tried| tried.faults.clone()).collect::<Vec<_>>().join("; "))
            }
        }
    }

    /// The next start that can be begun; those that cannot are noted.
    fn next_start(trials: &mut Trials) -> Option<Self> {
        while let Some(start) = trials.left.pop() {
            (trials.now, trials.draping, trials.ticks) = (start, false, 0);
            match begun(start, trials) {
                Ok(world) => return Some(world),
                Err(words) => {
                    let draped = trials.now().1;
                    trials.tried.push(Tried { start, draped, faults: vec![words], places: 0, ticks: 0 });
                }
            }
        }
        None
    }

    /// A tick while starts are tried: of the one under way, or what comes after it.
    pub(in crate::sim) fn try_on(&mut self) {
        let Some(mut trials) = self.trials.take() else { return };
        let now = Arc::make_mut(&mut trials);
        let broken = now.broken.take();
        let is_over = broken.is_some() || self.lies_still() || now.is_out_of_time();
        if !is_over {
            now.ticks += 1;
            // Kept where this tick breaks down.
            self.trials = Some(trials);
            return self.advance();
        }
        match self.after_start(now, broken) {
            Some(world) => *self = world,
            None => self.trials = Some(trials),
        }
    }

    /// The start under way failed with these words. False where none is under way.
    pub fn break_start(&mut self, words: String) -> bool {
        let Some(trials) = &mut self.trials else { return false };
        Arc::make_mut(trials).broken = Some(words);
        true
    }

    /// Tries all starts again with what has changed meanwhile; None where none is being tried.
    pub(in crate::sim) fn tried_again(
        &self,
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
    ) -> Option<Result<Self, String>> {
        let trials = self.trials.as_ref()?;
        let source = match trials.fine {
            Some(edge_length) => Arc::new(GarmentSource { edge_length, ..GarmentSource::clone(&source) }),
            None => source,
        };
        let again = Self::dressed(source, body, Arc::clone(&trials.fabrics), trials.choice);
        Some(again.map(|world| Self { relaxing: self.relaxing, ..world }))
    }

    /// Starts that are still to be tried begin with what `change` makes of the garment.
    pub(in crate::sim) fn change_trials(&mut self, change: impl FnOnce(&mut GarmentSource)) {
        if let Some(trials) = &mut self.trials {
            change(Arc::make_mut(&mut Arc::make_mut(trials).source));
        }
    }

    /// They are made of something else.
    pub(in crate::sim) fn change_trial_fabrics(&mut self, fabrics: &Arc<DrapeSource>) {
        if let Some(trials) = &mut self.trials {
            Arc::make_mut(trials).fabrics = Arc::clone(fabrics);
        }
    }

    /// Judges the start that has ended. What was taken, once it is known; else this is now the next one.
    fn after_start(&mut self, trials: &mut Trials, broken: Option<String>) -> Option<Self> {
        let mut faults: Vec<String> = broken.into_iter().collect();
        let (mut places, mut is_astray) = (0, false);
        if faults.is_empty() {
            if let Some(judged) = self.judged() {
                let words = |fault: Fault| format!("{}: {}", fault.problem.place, fault.problem.words);
                faults.extend(judged.faults.into_iter().map(words));
                (places, is_astray) = (judged.places, judged.is_astray);
            }
            if trials.is_out_of_time() && !self.lies_still() {
                faults.push("it still moves".to_owned());
            }
            if trials.draping && !self.was_draped {
                let why = self.problems.last().map(|problem| problem.words.clone()).unwrap_or_default();
                faults.push(format!("it was not draped: {why}"));
            }
        }
        if let Some(mut started) = trials.refining.take() {
            let taken = &mut started.tried[started.taken];
            (taken.faults, taken.places, taken.ticks) = (faults, places, taken.ticks + trials.ticks);
            return Some(Self { started: Some(Arc::new(started)), ..self.clone() });
        }
        let lies = self.cloth.mapped.contains(&true) && self.not_finite().is_none();
        let drapes_next = trials.now == Start::Marks && !trials.draping && lies && !is_astray;
        trials.note(self.clone(), faults, places);
        if drapes_next {
            (trials.draping, trials.ticks) = (true, 0);
            self.drape_for(None, Arc::clone(&trials.fabrics));
            return None;
        }
        // The same marks without draping may have been clean.
        if !trials.has_clean() {
            let relaxing = self.relaxing;
            if let Some(next) = Self::next_start(trials) {
                *self = Self { relaxing, ..next };
                return None;
            }
        }
        let (world, taken) = trials.best.take()?;
        let started = Started { tried: std::mem::take(&mut trials.tried), taken };
        let world = Arc::unwrap_or_clone(world);
        if let Some(edge_length) = trials.fine {
            (trials.now, trials.draping) = (started.taken().start, started.taken().draped);
            (trials.refining, trials.ticks) = (Some(started), 0);
            *self = world.refined(edge_length, Arc::clone(&trials.fabrics));
            return None;
        }
        Some(Self { started: Some(Arc::new(started)), ..world })
    }

    /// What is wrong with the cloth as it lies and where it is tight; None where there is no garment.
    pub(in crate::sim) fn judged(&self) -> Option<Judged> {
        let (source, garment, body) = (self.source.as_ref()?, self.garment.as_ref()?, self.body.as_ref()?);
        let split = self.drawn();
        let (garment, cloth) =
            split.as_ref().map_or((garment, &self.cloth), |(garment, cloth)| (garment, cloth));
        let lies = Lies { draped: self.was_draped, sewn: self.was_sewn };
        let index = BodyIndex::new(body);
        let report = measure(&source.pattern, garment, cloth, &index);
        Some(Judged {
            faults: faults(&report, source, garment, cloth, &index, lies),
            tight: tight_places(&report, garment, cloth, || landmarks::found(&body.mesh)),
            places: places(&report, lies),
            is_astray: is_astray(&report),
        })
    }
}

/// The garment of `trials` begun by `start`; the error is in words.
fn begun(start: Start, trials: &Trials) -> Result<World, String> {
    let (source, body) = (Arc::clone(&trials.source), Arc::clone(&trials.body));
    if start == Start::Placement {
        return World::placed(source, body, Arc::clone(&trials.fabrics));
    }
    if source.marks.pairs().next().is_some() {
        return Ok(World::wrapped(source, body));
    }
    if source.pattern.outermost() > 0 {
        return Err("marks are suggested for one layer only: several are sewn over each other".to_owned());
    }
    let marks = suggested(&source.pattern, &body, source.relax.offset * body.scale());
    if marks.pairs().next().is_none() {
        return Err("no marks can be suggested: none of its pieces is placed in front of or behind the body"
            .to_owned());
    }
    Ok(World::wrapped(
        Arc::new(GarmentSource { marks: Arc::new(marks), ..GarmentSource::clone(&source) }),
        body,
    ))
}

/// In how many places a garment is wrong.
fn places(report: &Report, lies: Lies) -> usize {
    let folds = if lies.draped { report.faces_in_folds + report.faces_between } else { 0 };
    let inside = report.penetration.vertices + report.penetration.faces;
    let through = report.edges_through_body + report.body_edges_through_garment;
    let cloth = report.self_crossings + report.degenerate_faces + report.strain.doubled;
    let missing: usize = report.pieces.iter().map(|piece| piece.missing_triangles).sum();
    inside + through + cloth + missing + report.seams.open + (report.flipped_faces - folds)
}

/// Whether cloth is where no draping can mend it.
fn is_astray(report: &Report) -> bool {
    let is_missed = report.openings.len() > 1 && report.openings.iter().any(|opening| !opening.body_through);
    is_missed || report.pieces.iter().any(|piece| piece.missing_triangles > 0)
}
