//! Many small steps of extended position-based dynamics (Macklin et al. 2016, 2019), with one pass over the constraints each.
//!
//! With one pass, cloth that hangs L metres stretches by a strain of 2 g L h² / l² beyond what its stiffness allows, l being the
//! edge length: this law sets the step size h. Springs along edges stand for the membrane (Van Gelder 1998), so shear stiffness
//! and Poisson's ratio are those of a spring net. Bending is an explicit force, evaluated as rarely as is stable.

use std::sync::Arc;

use glam::DVec3;

use crate::body::Surface;
use crate::contact::separation::Touch;
use crate::contact::{Obstacle, Separation};
use crate::drape::contact::body::Collider;
use crate::drape::forces::bands::Bands;
use crate::drape::forces::bending::Bending;
use crate::drape::forces::folds::Folds;
use crate::drape::forces::limits::StrainLimits;
use crate::drape::sheet::Sheet;
use crate::drape::solver::advance::Advance;
use crate::drape::solver::advance::At;
use crate::drape::solver::net::{Net, Spring};
use crate::drape::solver::off_body::{Colliding, Knowing};
use crate::drape::solver::shares::{Creases, Plane, Share, shares, side_by_side};
use crate::drape::solver::steps::Scene;
use crate::drape::solver::surroundings::EASE;
use crate::drape::solver::surroundings::Surroundings;
use crate::drape::solver::ties::{Fastened, SewingSpring};
use crate::drape::state::State;

/// Safety factor on the stability limit of explicit bending. A little below 1, as the highest frequency is bounded from above by
/// Gershgorin's theorem.
const SAFE: f64 = 0.9;
/// Small steps ahead for which the broad phase looks, at the present speed. With more, separating planes between neighbouring
/// parts of the cloth that fall side by side would hold them up.
const AHEAD: f64 = 12.0;
/// Smallest and largest search distance of the broad phase, metres. The smallest saves searches for cloth that hardly moves, the
/// largest bounds the number of pairs of cloth that flies.
const REACH: (f64, f64) = (0.001, 0.05);

/// Solver of small steps with its memory.
#[derive(Clone, Debug)]
pub struct SmallSteps {
    net: Net,
    inverse_mass: Vec<f64>,
    /// Area per mass of each vertex, m²/kg.
    spread: Vec<f64>,
    /// Largest angular frequency of bending, 1/s.
    bending_rate: f64,
    /// Softened bending, where that of the scene is not stable in steps of this size.
    softened: Option<Arc<Bending>>,
    planes: Vec<Plane>,
    /// For each part of the net its vertices in creases, with the side of the crease that is not in `planes`.
    creases: Vec<Creases>,
    /// Distance that each vertex keeps from the body besides the offset, metres.
    lift: Vec<f64>,
    /// Whether cloth leaves the body without momentum where it is deeper than its motion brought it, see [`EASE`]; for a body at
    /// rest.
    eases: bool,
    /// Drag constraint, if any.
    pub hand: Option<GrabConstraint>,
    /// Sewing springs.
    pub ties: Vec<SewingSpring>,
    /// Fastened buttons.
    pub fastened: Vec<Fastened>,
    /// Fold lines.
    pub folds: Folds,
    /// Elastic sewn along edges.
    pub bands: Bands,
    /// How far elastic moved each vertex in this small step, metres; empty without elastic.
    pulled: Vec<f64>,
    /// Constraints that keep the cloth from crossing itself and the body.
    pub separation: Option<Separation>,
    /// Surface that `separation` was given as its obstacle.
    body: Option<Arc<Surface>>,
    /// Time by which velocities lag behind positions, s: half a small step.
    lag: f64,
    /// Displacement of each vertex since bending was last evaluated, metres, and the time that took, s; only for cloth that
    /// [settles](Surroundings::settles).
    gone: (Vec<DVec3>, f64),
    /// Nearest-point queries of the body.
    pub queries: u64,
    /// Queries saved because the vertex was known to be far from the body.
    pub skipped: u64,
}

/// Drag constraint: a spring that pulls one vertex towards a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrabConstraint {
    /// Index of the vertex.
    pub vertex: u32,
    /// Target position, metres.
    pub target: DVec3,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Largest force, N.
    pub most: f64,
}

/// Number of small steps that keep the extra strain below `strain` in a step of `h` seconds, for cloth that hangs `extent` metres
/// with edges of `edge` metres. See the law at the top of this file.
pub fn substeps(h: f64, strain: f64, gravity: f64, extent: f64, edge: f64) -> usize {
    if gravity == 0.0 {
        return 1;
    }
    let longest = edge * (strain / (2.0 * gravity * extent)).sqrt();
    (h / longest).ceil().max(1.0) as usize
}

/// Largest angular frequency of bending, 1/s, by Gershgorin's bound. `mass` in kg per vertex.
fn fastest(bending: &Bending, mass: &[f64]) -> f64 {
    (0..mass.len()).map(|i| bending.stiffest(i) / mass[i]).fold(0.0, f64::max).sqrt()
}

/// Largest angular frequency ω of bending, 1/s, that is stable in explicit steps of `small` seconds with stiffness-proportional
/// `damping` τ in seconds: steps must be shorter than 2/(ω + ω² τ).
pub fn stable_rate(small: f64, damping: f64) -> f64 {
    let most = SAFE * 2.0 / small;
    // ω (1 + ω τ) = most.
    2.0 * most / (1.0 + (1.0 + 4.0 * most * damping).sqrt())
}

/// Longest time in 1/ω for which the bending force is held where it is damped by τ = `damped`/ω and evaluated with the mean velocity
/// since it was last. With s = ωτ and h = ωH, what swings with ω comes to rest while (h²/2)(1 + s/h)(3 + 2s/h) < 1 + 2s/h (Jury's
/// criterion); this is below that for every s.
fn longest_hold(damped: f64) -> f64 {
    0.75 / (1.0 + 0.4 * damped)
}

impl SmallSteps {
    /// A solver for `scene` with membrane `stiffness`, N/m, and steps of `small` seconds.
    pub fn new(scene: &Scene, stiffness: f64, small: f64) -> Self {
        let Scene { sheet, elastic, mass, pinned, .. } = scene;
        let limits = StrainLimits::new(sheet, 0.0, stiffness);
        let springs = limits.springs().map(|(ends, length, stiffness)| Spring { ends, length, stiffness });
        let mut bands = elastic.bands.clone();
        let springs = bands.take_springs(springs).into_iter();
        let most = stable_rate(small, 0.0);
        let softened = (fastest(&elastic.bending, mass) > most)
            .then(|| Arc::new(Bending::slower_than(most, mass, sheet, |_| &elastic.plate)));
        let bending = softened.as_deref().unwrap_or(&elastic.bending);
        let folds = elastic.folds.clone();
        Self {
            softened: softened.clone(),
            folds,
            bands,
            ..Self::of(springs, f64::MAX, sheet, bending, mass, pinned)
        }
    }

    /// A solver for any springs, rigid beyond a strain of `limit`. `mass` in kg per vertex; `pinned` vertices are held.
    pub fn of(
        springs: impl Iterator<Item = Spring>,
        limit: f64,
        sheet: &Sheet,
        bending: &Bending,
        mass: &[f64],
        pinned: &[bool],
    ) -> Self {
        let bending_rate = fastest(bending, mass);
        let inverse = |(m, pinned): (&f64, &bool)| if *pinned { 0.0 } else { 1.0 / m };
        let net = Net::new(mass.len(), &springs.collect::<Vec<_>>(), limit);
        let parts = net.parts().len();
        Self {
            creases: vec![Vec::new(); parts],
            net,
            inverse_mass: mass.iter().zip(pinned).map(inverse).collect(),
            spread: sheet.vertex_area.iter().zip(mass).map(|(area, m)| area / m).collect(),
            bending_rate,
            softened: None,
            planes: vec![Plane::default(); mass.len()],
            lift: vec![0.0; mass.len()],
            eases: false,
            hand: None,
            ties: Vec::new(),
            fastened: Vec::new(),
            folds: Folds::default(),
            bands: Bands::default(),
            pulled: Vec::new(),
            separation: None,
            body: None,
            lag: 0.0,
            gone: (Vec::new(), 0.0),
            queries: 0,
            skipped: 0,
        }
    }

    /// Turns on easing, for a body at rest: see [`EASE`].
    pub fn easing(self) -> Self {
        Self { eases: true, ..self }
    }

    /// Replaces the set of pinned vertices; `mass` in kg per vertex.
    pub fn pin(&mut self, mass: &[f64], pinned: &[bool]) {
        let inverse = |(m, pinned): (&f64, &bool)| if *pinned { 0.0 } else { 1.0 / m };
        self.inverse_mass = mass.iter().zip(pinned).map(inverse).collect();
        self.net.forget();
    }

    /// Inverse mass of each vertex, 1/kg; zero where it is pinned.
    pub fn inverse_mass(&self) -> &[f64] {
        &self.inverse_mass
    }

    /// Distance that each vertex keeps from the body besides the offset, metres.
    pub fn lift(&self) -> &[f64] {
        &self.lift
    }

    /// Replaces [`Self::lift()`], and moves the known planes accordingly.
    pub fn set_lift(&mut self, lift: &[f64]) {
        for ((plane, old), new) in self.planes.iter_mut().zip(&mut self.lift).zip(lift) {
            plane.height += new - *old;
            *old = *new;
        }
    }

    /// Unit normal of the skin near vertex `v` at its last nearest-point query, and the height of `x` above the offset and the
    /// lift, metres. None where the body is far.
    pub fn height(&self, v: usize, x: DVec3) -> Option<(DVec3, f64)> {
        let plane = &self.planes[v];
        (plane.normal != DVec3::ZERO).then(|| (plane.normal, plane.normal.dot(x) - plane.height))
    }

    /// Discards what is known of the body near each vertex.
    pub fn forget_planes(&mut self) {
        self.planes.fill(Plane::default());
        self.creases.iter_mut().for_each(Vec::clear);
    }

    /// Advances by `h` seconds in `count` small steps. `offset` and `friction` as in
    /// [`Contacts`](crate::drape::contact::body::Contacts).
    pub fn step(
        &mut self,
        scene: &Scene,
        state: &mut State,
        (offset, friction): (f64, f64),
        h: f64,
        count: usize,
    ) {
        self.see_body(scene);
        let friction = vec![friction; state.positions.len()];
        let softened = self.softened.clone();
        let around = Surroundings {
            bending: softened.as_deref().unwrap_or(&scene.elastic.bending),
            bending_damping: 0.0,
            settles: false,
            gravity: scene.gravity,
            damping: scene.damping,
            collider: scene.collider.as_ref(),
            floor: None,
            offset,
            friction: &friction,
            grip: f64::INFINITY,
        };
        self.advance(&around, state, h, count);
    }

    /// Gives `separation` the body of the scene as an obstacle, unless the body moves.
    fn see_body(&mut self, scene: &Scene) {
        let Some(separation) = &mut self.separation else { return };
        let still = scene.collider.as_ref().filter(|collider| collider.motion.is_empty());
        let surface = still.map(|collider| &collider.surface);
        let is_known = match (surface, &self.body) {
            (Some(surface), Some(known)) => Arc::ptr_eq(surface, known),
            (None, None) => true,
            _ => false,
        };
        if !is_known {
            separation.set_obstacle(surface.map(|surface| Arc::new(Obstacle::of(surface))));
            self.body = surface.cloned();
        }
    }

    /// Advances by `h` seconds in `count` small steps.
    pub fn advance(&mut self, around: &Surroundings<'_>, state: &mut State, h: f64, count: usize) {
        let mut advance = Advance::new(h, count);
        while !advance.is_done() {
            self.go_on(&mut advance, around, state);
        }
    }

    /// Makes one small step of `advance`, or the part of one up to the next search for features near each other. True when the step
    /// is complete.
    pub fn go_on(&mut self, advance: &mut Advance, around: &Surroundings<'_>, state: &mut State) -> bool {
        let (small, part) = (advance.small, 1.0 / advance.count as f64);
        match std::mem::take(&mut advance.at) {
            At::Begin if self.look_ahead(around, state, (small, part)) => {
                advance.at = At::Known;
                return false;
            }
            At::Begin | At::Known => {
                self.move_freely(advance, around, state);
                advance.at = self.truncated(None, 0, &mut state.positions);
            }
            At::Truncated { wanted, searches } => {
                if let Some(separation) = &mut self.separation {
                    let speed = |v: usize| wanted[v].distance(advance.before[v]) / small;
                    detect(separation, around, &state.positions, speed, (small, part));
                }
                state.positions.copy_from_slice(&wanted);
                advance.at = self.truncated(Some(wanted), searches + 1, &mut state.positions);
            }
        }
        let is_complete = matches!(advance.at, At::Begin);
        if is_complete {
            self.complete(advance, around, state);
        }
        is_complete
    }

    /// Moves the cloth by a small step as if nothing were in its way but the body near each vertex.
    fn move_freely(&mut self, advance: &mut Advance, around: &Surroundings<'_>, state: &mut State) {
        let Advance { small, count, done: s, .. } = *advance;
        let part = 1.0 / count as f64;
        self.net.ready(small, &self.inverse_mass);
        let every = self.bending_every(small, around).min(count);
        let drag = (-around.damping * small).exp();
        let Advance { bent, before, .. } = advance;
        bent.resize(state.positions.len(), DVec3::ZERO);
        before.resize(state.positions.len(), DVec3::ZERO);
        let x = &mut state.positions;
        let kick = if s == 0 { self.lag + small / 2.0 } else { small };
        if s % every == 0 && self.bending_rate > 0.0 {
            self.bend(around, (x, &mut state.velocities), (before, bent), (small, every.min(count - s)));
            self.gone.0.fill(DVec3::ZERO);
            self.gone.1 = 0.0;
        }
        let net = &self.net;
        let of_body = (&mut self.planes[..], &mut self.creases[..]);
        let mut work = shares(net, x, before, &mut state.velocities, of_body);
        side_by_side(&mut work, |p, share| {
            let Share { first, x, before, velocities, .. } = share;
            before.copy_from_slice(x);
            for (i, (x, v)) in x.iter_mut().zip(velocities.iter_mut()).enumerate() {
                if self.inverse_mass[*first + i] > 0.0 {
                    *v = *v * drag + around.gravity * kick - bent[*first + i];
                    *x += *v * small;
                }
            }
            net.project_part(p, x);
        });
        net.project_between(x);
        self.bands.project(x, &self.inverse_mass, self.net.limit(), small, &mut self.pulled);
        self.folds.project(x, before, &self.inverse_mass, small);
        if let Some(separation) = &mut self.separation {
            let friction = if around.grip > 0.0 { around.friction } else { &[] };
            let touch = Touch { inverse_mass: &self.inverse_mass, friction, ease: EASE * small };
            separation.push_apart(x, before, touch);
        }
        self.pull(x, small);
        self.draw(x, f64::INFINITY, small);
        if let Some(collider) = around.collider {
            let left = 1.0 - (s + 1) as f64 / count as f64;
            let scene = Colliding { around, collider, left, part, small };
            let of_body = (&mut self.planes[..], &mut self.creases[..]);
            let mut work = shares(&self.net, x, before, &mut state.velocities, of_body);
            let this = Knowing {
                inverse_mass: &self.inverse_mass,
                lift: &self.lift,
                spread: &self.spread,
                pulled: &self.pulled,
                eases: self.eases,
            };
            let looked = side_by_side(&mut work, |_, share| this.collide(&scene, share));
            for (queries, skipped) in looked {
                self.queries += queries;
                self.skipped += skipped;
            }
            // Sewn ends less than 2 mm apart are kept together even though the body pushes them apart.
            self.draw(x, 0.002, small);
        }
    }

    /// Takes the velocities from where the cloth came in a small step, and counts the step.
    fn complete(&mut self, advance: &mut Advance, around: &Surroundings<'_>, state: &mut State) {
        let places = state.positions.iter().zip(&advance.before);
        for (v, (now, then)) in state.velocities.iter_mut().zip(places) {
            *v = (*now - *then) / advance.small;
        }
        if around.settles && self.bending_rate > 0.0 {
            let (ways, time) = &mut self.gone;
            ways.resize(state.positions.len(), DVec3::ZERO);
            ways.iter_mut().zip(&state.velocities).for_each(|(way, v)| *way += *v * advance.small);
            *time += advance.small;
        } else {
            self.gone = (Vec::new(), 0.0);
        }
        advance.done += 1;
        if advance.is_done() {
            self.lag = advance.small / 2.0;
            if around.collider.is_some_and(|c| !c.motion.is_empty()) {
                self.forget_planes();
            }
        }
    }

    /// Pairs of features that self-collision has tested.
    pub fn pairs(&self) -> u64 {
        self.separation.as_ref().map_or(0, |separation| separation.counters.pairs)
    }

    /// Applies bending for the next `steps` steps of `small` seconds. Without damping, as one impulse on the velocities now; with
    /// damping, as `bent`, a velocity change (m/s) in each of them. `scratch` has room for every vertex.
    fn bend(
        &self,
        around: &Surroundings<'_>,
        (x, velocities): (&[DVec3], &mut [DVec3]),
        (scratch, bent): (&mut [DVec3], &mut [DVec3]),
        (small, steps): (f64, usize),
    ) {
        let span = small * steps as f64;
        // An occasional impulse conserves energy but shakes cloth that should come to rest. A force held constant lags by half of
        // the time that it is held, so it is evaluated that much ahead.
        if around.bending_damping > 0.0 {
            // The energy is quadratic: the force at x + τ v is the elastic force plus the damping force. The velocity of a moment
            // would shake what swings faster than the force is evaluated; the mean one is that of half its time ago.
            let (ways, time) = &self.gone;
            let is_known = *time > 0.0;
            let lag = if is_known { span - small / 2.0 } else { span / 2.0 };
            let ahead = around.bending_damping + lag;
            for (i, (place, (x, v))) in scratch.iter_mut().zip(x.iter().zip(velocities.iter())).enumerate() {
                *place = *x + if is_known { ways[i] / *time } else { *v } * ahead;
            }
            around.bending.write_forces(scratch, bent, |i| small * self.inverse_mass[i]);
        } else {
            around.bending.write_forces(x, bent, |i| span * self.inverse_mass[i]);
            velocities.iter_mut().zip(&*bent).for_each(|(v, b)| *v -= *b);
            bent.fill(DVec3::ZERO);
        }
    }

    /// Looks again for features near each other where some vertex is about to leave its search distance. Returns whether it had to.
    fn look_ahead(&mut self, around: &Surroundings<'_>, state: &State, (small, part): (f64, f64)) -> bool {
        let Some(separation) = &mut self.separation else { return false };
        if separation.holds(|v| state.positions[v] + state.velocities[v] * small) {
            return false;
        }
        let speed = |v: usize| state.velocities[v].length();
        detect(separation, around, &state.positions, speed, (small, part));
        true
    }

    /// Truncates the motion to `x`, which is `wanted` if given, so that no new intersection arises. A vertex that leaves its search
    /// distance, as cloth that is struck does, continues after another search; after the third it stays where it is.
    fn truncated(&mut self, wanted: Option<Vec<DVec3>>, searches: usize, x: &mut [DVec3]) -> At {
        let Some(separation) = &mut self.separation else { return At::Begin };
        let wanted = wanted.unwrap_or_else(|| x.to_vec());
        if separation.truncate(x) == 0 || searches == 3 {
            return At::Begin;
        }
        At::Truncated { wanted, searches }
    }

    /// Whether the cloth at `x` is known to cross neither itself nor the body; looks where that is not known.
    pub fn is_clean(&mut self, x: &[DVec3], collider: &Collider) -> bool {
        let Some(separation) = &mut self.separation else { return false };
        if !separation.is_clean() {
            separation.detect(x, |_| REACH.0, |v| collider.surface.contains(x[v]));
        }
        separation.is_clean()
    }

    /// Whether the last detection found the cloth to cross neither itself nor the body.
    pub fn is_known_clean(&self) -> bool {
        self.separation.as_ref().is_some_and(Separation::is_clean)
    }

    /// Moves the vertices at `x` by `ways`, metres, truncated so that no new intersection arises.
    pub fn send(&mut self, x: &mut [DVec3], collider: &Collider, ways: &[DVec3]) {
        if let Some(separation) = &mut self.separation {
            let reach = |v: usize| ways[v].length().max(REACH.0);
            separation.detect(x, reach, |v| collider.surface.contains(x[v]));
        }
        x.iter_mut().zip(ways).for_each(|(x, way)| *x += *way);
        if let Some(separation) = &mut self.separation {
            separation.truncate(x);
        }
    }

    /// Projects fastened buttons, and sewing springs whose ends are at most `within` metres apart.
    fn draw(&self, x: &mut [DVec3], within: f64, small: f64) {
        self.ties.iter().for_each(|tie| tie.draw(x, &self.inverse_mass, within, small));
        self.fastened.iter().for_each(|tie| tie.draw(x, &self.inverse_mass, small));
    }

    /// Projects the drag constraint in one small step.
    fn pull(&self, x: &mut [DVec3], small: f64) {
        let Some(hand) = self.hand else { return };
        let v = hand.vertex as usize;
        let softness = 1.0 / (hand.stiffness * small * small);
        let share = self.inverse_mass[v] / (self.inverse_mass[v] + softness);
        let most = hand.most * self.inverse_mass[v] * small * small;
        x[v] += ((hand.target - x[v]) * share).clamp_length_max(most);
    }

    /// Whether nothing acts on the cloth besides springs, bending, a hand, contact and [`Surroundings`].
    pub fn is_plain(&self) -> bool {
        self.ties.is_empty() && self.fastened.is_empty() && self.folds.is_empty() && self.bands.is_empty()
    }

    /// Velocity at the end of the step, m/s: `v` of the state lags by half a small step, which gravity makes up for.
    pub fn velocity_now(&self, scene: &Scene, v: DVec3) -> DVec3 {
        v + scene.gravity * self.lag
    }

    /// Number of small steps between two evaluations of bending.
    fn bending_every(&self, small: f64, around: &Surroundings<'_>) -> usize {
        if self.bending_rate == 0.0 {
            return usize::MAX;
        }
        // Explicit steps of bending are stable while they are shorter than 2/(ω + ω² τ), τ being the damping.
        let damped = self.bending_rate * around.bending_damping;
        let every = SAFE * 2.0 / (self.bending_rate * (1.0 + damped) * small);
        debug_assert!(every > 1.0 - 1e-6, "bending was made for shorter steps than {small} s: {every}");
        let every = if around.settles { longest_hold(damped) / (self.bending_rate * small) } else { every };
        (every as usize).max(1)
    }
}

/// Broad phase for vertices at `x` whose speeds are `speed`, m/s.
fn detect(
    separation: &mut Separation,
    around: &Surroundings<'_>,
    x: &[DVec3],
    speed: impl Fn(usize) -> f64,
    (small, part): (f64, f64),
) {
    let span = AHEAD * small;
    let of_body = around.collider.map_or(0.0, |collider| collider.farthest() * part * AHEAD);
    let more = of_body + around.gravity.length() * span * span / 2.0;
    let reach = |v: usize| (speed(v) * span + more).clamp(REACH.0, REACH.1);
    separation.detect(x, reach, |v| around.collider.is_some_and(|c| c.surface.contains(x[v])));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What swings with ω = 1 under the held force, in `n` small steps for each evaluation, `beyond` times as long as they may be.
    fn left(damped: f64, n: usize, beyond: f64) -> f64 {
        let hold = longest_hold(damped) * beyond;
        let small = hold / n as f64;
        let (mut x, mut v, mut mean) = (1.0, 0.0, 0.0);
        for _ in 0..4000 {
            let force = -(x + (damped + hold - small / 2.0) * mean);
            let before = x;
            for _ in 0..n {
                v += force * small;
                x += v * small;
            }
            mean = (x - before) / hold;
            if x.abs() > 1e6 {
                break;
            }
        }
        x.abs().max(v.abs())
    }

    #[test]
    fn bending_that_is_held_brings_what_swings_to_rest() {
        for damped in [0.01, 0.1, 0.3, 1.0, 3.0, 10.0] {
            for n in [2, 3, 8, 30] {
                assert!(left(damped, n, 1.0) < 1e-6, "τ {damped}, {n} steps: {}", left(damped, n, 1.0));
            }
        }
        assert!(left(0.01, 30, 1.2) > 1e3 && left(0.3, 30, 1.3) > 1e3, "and hardly longer");
    }
}
