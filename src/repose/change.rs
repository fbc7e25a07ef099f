//! A change of pose under way, in pieces that are each soon done.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::body::Surface;
use crate::cloth::ClothState;
use crate::repose::conform::{carried, conformed};
use crate::repose::distance_map::DistanceMap;
use crate::repose::limit::{limited, raised};
use crate::repose::normal_check::Looks;
use crate::repose::reposer::Reposer;
use crate::repose::settings::{Outcome, ReposeSettings};

/// Conforming that strained no more than this, and left nothing inside, is left as it is.
const EXACT: f64 = 1e-6;
/// Global steps in each pose on the way at most.
const STEPS_PER_SUBSTEP: usize = 12;
/// Conforming that strained more than this is not tried to be mended at once, but through poses on the way.
const AT_ONCE: f64 = 0.15;
/// Global steps that spread the strain over so much cloth that edge by edge the rest is done.
const FEW_STEPS: usize = 8;
/// Global steps between two looks at the strain.
const STEPS_PER_LOOK: usize = 4;
/// Most rounds in which strain is spread, each in contacts looked for anew: for cloth that stays,
const ROUNDS: usize = 60;
/// and for a picture.
const LIVE_ROUNDS: usize = 6;
/// Steps in which a mend must take effect.
const STEPS_PER_MEND: usize = 8;
/// Strain that 99 of 100 edges do not exceed is spread edge by edge.
const SPREADABLE: f64 = 0.03;
/// Where the excess that 99 of 100 edges do not exceed is larger than this, there is nowhere to spread it to.
const TOO_TIGHT: f64 = 0.05;
/// Times for each mend that strain is spread and faces that cut the body are raised.
const LIMITS_PER_MEND: usize = 2;
/// Global steps that carrying takes as long as, about,
const COST_OF_CARRYING: usize = 8;
/// and one look for contacts with the sweeps after it.
const COST_OF_LIMITING: usize = 2;

/// A change of pose under way.
///
/// The cloth goes there at once, and with care through poses on the way where that does not come out well.
#[derive(Clone, Debug)]
pub struct Change {
    to: Arc<Surface>,
    care: ReposeSettings,
    outcome: Outcome,
    /// The cloth as it comes along.
    state: ClothState,
    /// Where carrying alone puts each vertex, and how its skin turned.
    carried: Vec<(DVec3, DQuat)>,
    /// Where conforming alone puts each vertex.
    conformed: Vec<DVec3>,
    /// It goes there at once, not through poses on the way.
    at_once: bool,
    stage: Stage,
}

/// What is done next.
#[derive(Clone, Debug)]
enum Stage {
    Carry,
    /// Strain control: `done` of `most` global steps.
    Control {
        done: usize,
        most: usize,
        looks: Box<Looks>,
    },
    /// Faces that cut the body are raised, followed by some steps.
    Mend,
    Spread(Option<Box<Spreading>>),
    /// Out of the body with what is left inside.
    Finish,
    SetOut,
    Pass(Box<Passing>),
    Arrive,
    Done,
}

/// Strain that is being spread.
#[derive(Clone, Debug)]
struct Spreading {
    /// As it was, and how much strained.
    before: ClothState,
    was: f64,
    /// Times left that it is spread and its faces raised.
    left: usize,
    /// Times left that contacts are looked for anew while it is spread.
    rounds: usize,
}

/// Poses on the way.
#[derive(Clone, Debug)]
struct Passing {
    bodies: Vec<Arc<Surface>>,
    /// At which each vertex was bound to the pose before.
    heights: Vec<f64>,
    /// The one it is in, and the global steps done there.
    at: usize,
    done: usize,
}

impl Reposer {
    /// Where the cloth is on `to`, the same body in another pose, all at once. None when `to` has another topology.
    pub fn reposed(&mut self, to: &Arc<Surface>, care: ReposeSettings) -> Option<(ClothState, Outcome)> {
        let mut change = Change::new(self, Arc::clone(to), care)?;
        while !change.is_done() {
            change.step(self);
        }
        Some(change.into_cloth())
    }
}

impl Change {
    /// To `to` from where `reposer` was bound. None when `to` has another topology.
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
            stage,
        })
    }

    /// Whether the cloth has come there.
    pub fn is_done(&self) -> bool {
        matches!(self.stage, Stage::Done)
    }

    /// 0..=1: of the poses on the way and the last one how many are behind it.
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

    /// The cloth as it comes along: after the first piece carried to the new pose.
    pub fn cloth(&self) -> &ClothState {
        &self.state
    }

    /// The cloth, once it is there, and what came of it.
    pub fn into_cloth(self) -> (ClothState, Outcome) {
        (self.state, self.outcome)
    }

    /// A piece of it, with the same `reposer` each time. So many times was about every vertex moved in it.
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
        if self.outcome.conformed_p99 > EXACT {
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
        if self.outcome.conformed_inside == 0 && self.outcome.excess_p99 <= EXACT {
            return COST_OF_CARRYING;
        }
        self.at_once = self.outcome.joined_p99 <= AT_ONCE || self.care.most_substeps == 0;
        self.stage = match self.at_once {
            true => Stage::control(reposer, FEW_STEPS.min(self.care.most_steps)),
            false => Stage::SetOut,
        };
        COST_OF_CARRYING
    }

    /// On the body in its new pose, out of it. How many vertices were inside.
    fn enter(&mut self, reposer: &mut Reposer) -> usize {
        reposer.enter(&self.to, &self.state);
        let heights = reposer.map().heights.clone();
        reposer.recover(&mut self.state, &heights)
    }

    /// Global steps in contact until the strain is what it may be, or so little that it can be spread.
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
            // What is folded over does not come apart edge by edge; where cloth has to be folded it stays.
            let spreads = until >= FEW_STEPS && looks.is_unfolded();
            well |= strain <= if spreads { SPREADABLE } else { self.care.excess };
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
            for done in 1..=STEPS_PER_MEND {
                reposer.step(&mut self.state, self.care, done);
                self.outcome.steps += 1;
            }
            self.outcome.mends += 1;
            self.stage = Stage::Mend;
            return STEPS_PER_MEND;
        }
        // Folds do not go away by spreading.
        let by_steps = self.at_once && self.care.most_substeps > 0;
        let folded = by_steps && reposer.folds.count(&self.state) > reposer.folds.bound;
        self.stage = if folded { Stage::SetOut } else { Stage::Spread(None) };
        1
    }

    /// Spreads strain that is left in a few places, unless there is so much of it that the cloth is too tight; takes it back
    /// where that did not help.
    fn spread(&mut self, reposer: &mut Reposer, spreading: Option<Box<Spreading>>) -> usize {
        self.stage = Stage::Finish;
        let Some(mut spreading) = spreading else {
            let was = reposer.lengths.p99(&self.state);
            if was <= TOO_TIGHT {
                let (before, left) = (self.state.clone(), LIMITS_PER_MEND * self.care.mends);
                let live = self.care.mends == 0 && was > self.care.excess;
                let rounds = if live { LIVE_ROUNDS } else { 0 };
                self.stage = Stage::Spread(Some(Box::new(Spreading { before, was, left, rounds })));
            }
            return 1;
        };
        if spreading.rounds > 0 {
            let limited = limited(&reposer.lengths, &mut reposer.relaxer, &mut self.state, self.care.excess);
            spreading.rounds = if limited { 0 } else { spreading.rounds - 1 };
            if spreading.rounds == 0 && self.care.mends > 0 {
                match reposer.lift_faces(&self.state) {
                    0 => spreading.left = 0,
                    _ => raised(&mut reposer.relaxer, &mut self.state),
                }
            }
            self.stage = Stage::Spread(Some(spreading));
            return COST_OF_LIMITING;
        }
        if spreading.left > 0 && reposer.lengths.p99(&self.state) > self.care.excess {
            (spreading.left, spreading.rounds) = (spreading.left - 1, ROUNDS);
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
            self.stage = Stage::SetOut;
        } else if self.care.mends == 0 {
            reposer.remember(&self.state, &self.carried);
        } else {
            self.outcome.crossings = reposer.crossings_of(&self.state);
        }
        COST_OF_LIMITING
    }

    /// The poses on the way.
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

    /// Some steps in one of the poses on the way; bound anew to it, then, on to the next.
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
        if *done < STEPS_PER_SUBSTEP && reposer.lengths.p99(&self.state) > SPREADABLE {
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
