//! A change of pose, done in short steps.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::body::Surface;
use crate::cloth::ClothState;
use crate::repose::conform::{carried, conformed};
use crate::repose::distance_map::DistanceMap;
use crate::repose::limit::{limited, raised};
use crate::repose::normal_check::Looks;
use crate::repose::reposer::{Reposer, STEPS_PER_LOOK};
use crate::repose::settings::{Outcome, ReposeSettings};

/// Strains (99th percentile) that decide what is done next.
struct Strains {
    /// Up to which conforming alone counts as exact, provided that it left no vertex inside the body.
    exact: f64,
    /// Up to which strain limiting, edge by edge, can do the rest.
    spreadable: f64,
    /// Above which the cloth is too tight for strain limiting: no other edges can take it up.
    too_tight: f64,
    /// Up to which the cloth goes to the new pose directly. More is resolved through intermediate poses.
    at_once: f64,
}

/// Chosen by trial, but for `exact`, which is above rounding and far below what can be seen.
const STRAINS: Strains = Strains { exact: 1e-6, spreadable: 0.03, too_tight: 0.05, at_once: 0.15 };

/// Global steps in which what changed in one place takes effect round it: they spread strain over enough cloth for strain limiting
/// to do the rest, and follow each repair. Chosen by trial.
const FEW_STEPS: usize = 2 * STEPS_PER_LOOK;
/// Cost of conforming, in global steps. Work is cut into ticks by it; no result depends on it.
const COST_OF_CARRYING: usize = FEW_STEPS;
/// Cost of one round of strain limiting, in global steps. See [`COST_OF_CARRYING`].
const COST_OF_LIMITING: usize = 2;

/// A change of pose in progress.
///
/// The cloth goes directly to the new pose. Where that does not turn out well it goes again, through intermediate poses.
#[derive(Clone, Debug)]
pub struct Change {
    to: Arc<Surface>,
    care: ReposeSettings,
    outcome: Outcome,
    /// The cloth in its present state.
    state: ClothState,
    /// Position of each vertex after conforming and joining, and the rotation of its skin.
    carried: Vec<(DVec3, DQuat)>,
    /// Position of each vertex after conforming alone.
    conformed: Vec<DVec3>,
    /// Whether the cloth goes directly, not through intermediate poses.
    at_once: bool,
    /// How often some global steps were added because the cloth had come directly, but not well.
    added: usize,
    stage: Stage,
}

/// What the next call of [`Change::step`] does.
#[derive(Clone, Debug)]
enum Stage {
    Carry,
    /// Strain control: `done` of `most` global steps.
    Control {
        done: usize,
        most: usize,
        looks: Box<Looks>,
    },
    /// Raises faces that cut the body, followed by some global steps.
    Mend,
    Spread(Option<Box<Spreading>>),
    /// Moves vertices that are still inside out of the body.
    Finish,
    SetOut,
    Pass(Box<Passing>),
    Arrive,
    Done,
}

/// Strain limiting in progress.
#[derive(Clone, Debug)]
struct Spreading {
    /// The cloth before.
    before: ClothState,
    /// Its strain (99th percentile).
    was: f64,
    /// Passes left of strain limiting and raising faces.
    left: usize,
    /// Rounds left in this pass, each with contacts found anew.
    rounds: usize,
    /// Whether a face was too near the body at the end of the last pass.
    cuts: bool,
}

/// The way through intermediate poses.
#[derive(Clone, Debug)]
struct Passing {
    bodies: Vec<Arc<Surface>>,
    /// Height of each vertex above the skin in the pose before, metres.
    heights: Vec<f64>,
    /// Index of the present intermediate pose.
    at: usize,
    /// Global steps done in it.
    done: usize,
}

impl Reposer {
    /// The cloth on `to`, the same body in another pose, computed in one call. None when `to` has another topology.
    pub fn reposed(&mut self, to: &Arc<Surface>, care: ReposeSettings) -> Option<(ClothState, Outcome)> {
        let mut change = Change::new(self, Arc::clone(to), care)?;
        while !change.is_done() {
            change.step(self);
        }
        Some(change.into_cloth())
    }
}

impl Change {
    /// A change to `to` from the pose that `reposer` was bound in. None when `to` has another topology.
    pub fn new(reposer: &mut Reposer, to: Arc<Surface>, care: ReposeSettings) -> Option<Self> {
        if to.mesh.triangles != reposer.from().mesh.triangles {
            return None;
        }
        reposer.refactor(care);
        let (state, outcome, stage) = (ClothState::default(), Outcome::default(), Stage::Carry);
        Some(Self {
            to,
            care,
            outcome,
            state,
            carried: Vec::new(),
            conformed: Vec::new(),
            at_once: false,
            added: 0,
            stage,
        })
    }

    /// Whether the cloth has arrived in the new pose.
    pub fn is_done(&self) -> bool {
        matches!(self.stage, Stage::Done)
    }

    /// Progress, 0..=1: the share of the poses, intermediate ones and the last, that are done.
    pub fn progress(&self) -> f64 {
        let on_the_way = self.outcome.substeps;
        let behind = match &self.stage {
            Stage::Carry | Stage::SetOut => 0,
            Stage::Pass(passing) => passing.at,
            Stage::Control { .. } | Stage::Mend | Stage::Spread(_) | Stage::Finish | Stage::Arrive => {
                on_the_way
            }
            Stage::Done => on_the_way + 1,
        };
        behind as f64 / (on_the_way + 1) as f64
    }

    /// The cloth in its present state: from the first step on, in or on the way to the new pose.
    pub fn cloth(&self) -> &ClothState {
        &self.state
    }

    /// The final cloth, and statistics.
    pub fn into_cloth(self) -> (ClothState, Outcome) {
        (self.state, self.outcome)
    }

    /// Does one step; pass the same `reposer` each time. Returns its cost, in global steps.
    pub fn step(&mut self, reposer: &mut Reposer) -> usize {
        match std::mem::replace(&mut self.stage, Stage::Done) {
            Stage::Carry => self.carry(reposer),
            Stage::Control { done, most, looks } => self.control(reposer, done, most, looks),
            Stage::Mend => self.mend(reposer),
            Stage::Spread(spreading) => self.spread(reposer, spreading),
            Stage::Finish => self.finish(reposer),
            Stage::SetOut => self.set_out(reposer),
            Stage::Pass(passing) => self.pass(reposer, passing),
            Stage::Arrive => self.arrive(reposer),
            Stage::Done => 0,
        }
    }

    fn carry(&mut self, reposer: &mut Reposer) -> usize {
        let mut carried = carried(reposer.map(), reposer.from(), &self.to, &reposer.cloth.positions);
        self.conformed = carried.iter().map(|(p, _)| *p).collect();
        self.state = ClothState { positions: self.conformed.clone(), mapped: reposer.cloth.mapped.clone() };
        let stays = self.to.mesh.positions == reposer.from().mesh.positions;
        if stays && self.state.positions == reposer.cloth.positions {
            return COST_OF_CARRYING;
        }
        self.outcome.conformed_p99 = reposer.lengths.p99(&self.state);
        if self.outcome.conformed_p99 > STRAINS.exact {
            reposer.join(&mut carried);
            carried.iter().zip(&mut self.state.positions).for_each(|((place, _), p)| *p = *place);
            self.outcome.joined_p99 = reposer.lengths.p99(&self.state);
        }
        self.carried = carried;
        if self.care.mends == 0 {
            reposer.go_on(&mut self.state, &self.carried, self.outcome.joined_p99);
        }
        reposer.apart = None;
        self.outcome.conformed_inside = self.enter(reposer);
        if self.outcome.conformed_inside > 0 && self.care.mends > 0 {
            reposer.apart = reposer.parts_of(&self.to);
            if reposer.apart.is_some() {
                self.carried.iter().zip(&mut self.state.positions).for_each(|((place, _), p)| *p = *place);
                self.outcome.conformed_inside = self.enter(reposer);
            }
        }
        self.outcome.excess_p99 = reposer.lengths.p99(&self.state);
        if self.outcome.conformed_inside == 0 && self.outcome.excess_p99 <= STRAINS.exact {
            return COST_OF_CARRYING;
        }
        self.at_once = self.outcome.joined_p99 <= STRAINS.at_once || self.care.most_substeps == 0;
        self.stage = match self.at_once {
            true => Stage::control(reposer, FEW_STEPS.min(self.care.most_steps)),
            false => Stage::SetOut,
        };
        COST_OF_CARRYING
    }

    /// Moves `reposer` to the new pose and the cloth out of the body. Returns how many vertices were inside.
    fn enter(&mut self, reposer: &mut Reposer) -> usize {
        reposer.enter(&self.to, &self.state);
        let heights = reposer.map().heights.clone();
        reposer.recover(&mut self.state, &heights)
    }

    /// Global steps with contact, until the strain is within the settings or small enough for strain limiting.
    fn control(&mut self, reposer: &mut Reposer, done: usize, most: usize, mut looks: Box<Looks>) -> usize {
        let until = (done + STEPS_PER_LOOK).min(most);
        for done in done + 1..=until {
            reposer.step(&mut self.state, self.care, done);
            self.outcome.steps += 1;
        }
        let mut well = until == most;
        if until > done && until.is_multiple_of(STEPS_PER_LOOK) {
            let strain = reposer.lengths.p99(&self.state);
            looks.see(&self.state, reposer.folds.count(&self.state), strain);
            // Folds do not come apart by strain limiting; where cloth has to fold they stay.
            let spreads = until >= FEW_STEPS && looks.is_unfolded();
            well |= strain <= if spreads { STRAINS.spreadable } else { self.care.excess };
        }
        self.stage = match well {
            true => {
                looks.give_back(&mut self.state);
                Stage::Mend
            }
            false => Stage::Control { done: until, most, looks },
        };
        until - done
    }

    fn mend(&mut self, reposer: &mut Reposer) -> usize {
        if self.outcome.mends < self.care.mends && reposer.lift_faces(&self.state) > 0 {
            for done in 1..=FEW_STEPS {
                reposer.step(&mut self.state, self.care, done);
                self.outcome.steps += 1;
            }
            self.outcome.mends += 1;
            self.stage = Stage::Mend;
            return FEW_STEPS;
        }
        // Folds do not go away by strain limiting.
        let by_steps = self.at_once && self.care.most_substeps > 0;
        let folded = by_steps && reposer.folds.count(&self.state) > reposer.folds.most;
        self.stage = if folded { self.not_well(reposer) } else { Stage::Spread(None) };
        1
    }

    /// What is done with cloth that went directly and did not turn out well: some more global steps, as often as repairs may be made,
    /// then the way through intermediate poses, which takes several times as long.
    fn not_well(&mut self, reposer: &Reposer) -> Stage {
        if self.added >= self.care.mends {
            return Stage::SetOut;
        }
        self.added += 1;
        self.outcome.mends = 0;
        Stage::control(reposer, FEW_STEPS)
    }

    /// Strain limiting for strain that remains in a few places. Skipped where the cloth is too tight; undone where it did not
    /// help.
    fn spread(&mut self, reposer: &mut Reposer, spreading: Option<Box<Spreading>>) -> usize {
        self.stage = Stage::Finish;
        let Some(mut spreading) = spreading else {
            let was = reposer.lengths.p99(&self.state);
            if was <= STRAINS.too_tight {
                let (before, left) = (self.state.clone(), self.care.passes);
                let live = self.care.mends == 0 && was > self.care.excess;
                let rounds = if live { self.care.rounds } else { 0 };
                self.stage =
                    Stage::Spread(Some(Box::new(Spreading { before, was, left, rounds, cuts: false })));
            }
            return 1;
        };
        if spreading.rounds > 0 {
            let limited = limited(&reposer.lengths, &mut reposer.relaxer, &mut self.state, self.care.excess);
            spreading.rounds = if limited { 0 } else { spreading.rounds - 1 };
            if spreading.rounds == 0 && self.care.mends > 0 {
                spreading.cuts = reposer.lift_faces(&self.state) > 0;
                match spreading.cuts {
                    true => raised(&mut reposer.relaxer, &mut self.state),
                    false => spreading.left = 0,
                }
            }
            self.stage = Stage::Spread(Some(spreading));
            return COST_OF_LIMITING;
        }
        let is_done = !spreading.cuts && reposer.lengths.p99(&self.state) <= self.care.excess;
        if spreading.left > 0 && !is_done {
            (spreading.left, spreading.rounds) = (spreading.left - 1, self.care.rounds);
            self.stage = Stage::Spread(Some(spreading));
        } else if reposer.lengths.p99(&self.state) > spreading.was {
            self.state = spreading.before;
        }
        1
    }

    fn finish(&mut self, reposer: &mut Reposer) -> usize {
        self.outcome.inside = reposer.send_out(&mut self.state);
        self.outcome.excess_p99 = reposer.lengths.p99(&self.state);
        let may_be_better = self.at_once && self.care.most_substeps > 0;
        if may_be_better && !reposer.is_well(&self.state, self.care, self.outcome) {
            self.stage = self.not_well(reposer);
        } else if self.care.mends == 0 {
            reposer.remember(&self.state, &self.carried);
        } else {
            self.outcome.crossings = reposer.crossings_of(&self.state);
        }
        COST_OF_LIMITING
    }

    /// Computes the intermediate poses.
    fn set_out(&mut self, reposer: &mut Reposer) -> usize {
        let bodies = reposer.between(&self.to, self.care.most_substeps);
        (self.outcome.substeps, self.outcome.mends) = (bodies.len(), 0);
        let Some(first) = bodies.first() else {
            if !std::mem::take(&mut self.at_once) {
                self.state.positions.clone_from(&self.conformed);
                self.enter(reposer);
            }
            self.stage = Stage::control(reposer, self.care.most_steps);
            return COST_OF_CARRYING;
        };
        self.at_once = false;
        self.state.positions = conformed(reposer.map(), reposer.from(), first, &reposer.cloth.positions);
        let heights = reposer.map().heights.clone();
        self.stage = Stage::Pass(Box::new(Passing { bodies, heights, at: 0, done: 0 }));
        COST_OF_CARRYING
    }

    /// Makes some global steps in an intermediate pose; when they are done, binds the cloth to it and carries it to the next
    /// pose.
    fn pass(&mut self, reposer: &mut Reposer, mut passing: Box<Passing>) -> usize {
        let Passing { bodies, heights, at, done } = &mut *passing;
        let body = &bodies[*at];
        if *done == 0 {
            reposer.enter(body, &self.state);
            reposer.recover(&mut self.state, heights);
            reposer.relaxer.walk(true);
        }
        for _ in 0..STEPS_PER_LOOK {
            *done += 1;
            reposer.step(&mut self.state, self.care, *done);
            self.outcome.steps += 1;
        }
        // Three looks in each intermediate pose: what is left is taken on to the next.
        if *done < 3 * STEPS_PER_LOOK && reposer.lengths.p99(&self.state) > STRAINS.spreadable {
            self.stage = Stage::Pass(passing);
            return STEPS_PER_LOOK;
        }
        reposer.relaxer.walk(false);
        let next = bodies.get(*at + 1);
        let map = DistanceMap::apart(body, &self.state, reposer.apart.as_deref());
        self.state.positions = conformed(&map, body, next.unwrap_or(&self.to), &self.state.positions);
        if next.is_some() {
            (*heights, *at, *done) = (map.heights, *at + 1, 0);
            self.stage = Stage::Pass(passing);
        } else {
            self.stage = Stage::Arrive;
        }
        STEPS_PER_LOOK + COST_OF_CARRYING
    }

    fn arrive(&mut self, reposer: &mut Reposer) -> usize {
        self.enter(reposer);
        self.stage = Stage::control(reposer, self.care.most_steps);
        COST_OF_CARRYING
    }
}

impl Stage {
    fn control(reposer: &Reposer, most: usize) -> Self {
        Self::Control { done: 0, most, looks: Box::new(Looks::new(reposer.folds.bound)) }
    }
}
