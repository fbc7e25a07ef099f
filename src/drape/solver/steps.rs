//! Implicit time integration.
//!
//! Second-order backward differences (BDF2: Curtiss and Hirschfelder 1952) damp oscillations far less than implicit Euler and are
//! exact in free fall. At a vertex in contact, or that was in the last step, the history before the impact is not valid, and
//! implicit Euler is used.

use glam::DVec3;

use crate::drape::contact::body::{Collider, Contacts};
use crate::drape::contact::itself::SelfContact;
use crate::drape::forces::elastic::Elastic;
use crate::drape::sheet::Sheet;
use crate::drape::solver::newton::{Loads, Newton, NewtonSettings, Solved, Task};
use crate::drape::state::State;

/// Time integrator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrator {
    /// Implicit Euler: first order; energy never rises.
    Euler,
    /// BDF2: second order, at vertices without contact.
    Bdf2,
}

/// Ratio of contact stiffness to inertial stiffness m/h²: a vertex that arrives at speed v stops at a depth of v h / (1 + this).
pub(in crate::drape) const CONTACT_OVER_INERTIA: f64 = 400.0;
/// Smallest contact stiffness per area, N/m³: that of cloth of 0.2 kg/m² at 60 steps a second. Light cloth under tension presses
/// with far more than its weight.
const CONTACT_PER_AREA: f64 = 3e5;

/// Everything that stays the same over steps.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The cloth.
    pub sheet: Sheet,
    /// Its elasticity.
    pub elastic: Elastic,
    /// Mass of each vertex, kg.
    pub mass: Vec<f64>,
    /// Vertices that are held.
    pub pinned: Vec<bool>,
    /// Gravity, m/s².
    pub gravity: DVec3,
    /// Rate at which motion dies away, 1/s.
    pub damping: f64,
    /// The body, if any.
    pub collider: Option<Collider>,
}

/// Implicit time stepper with its memory.
#[derive(Debug)]
pub struct Steps {
    newton: Newton,
    integrator: Integrator,
    before: Vec<(DVec3, DVec3)>,
    /// Whether each vertex uses implicit Euler in the next step.
    euler: Vec<bool>,
    step_before: f64,
    loads: Loads,
}

impl Steps {
    /// A stepper for `scene`. None when the matrix does not fit in memory.
    pub fn new(scene: &Scene, integrator: Integrator) -> Option<Self> {
        let count = scene.sheet.len();
        Some(Self {
            newton: Newton::new(&scene.sheet, &scene.elastic)?,
            integrator,
            before: Vec::new(),
            euler: vec![integrator == Integrator::Euler; count],
            step_before: 0.0,
            loads: Loads::default(),
        })
    }

    /// The Newton solver, for its work counters.
    pub fn newton(&self) -> &Newton {
        &self.newton
    }

    /// Discards the history, so that the next step starts anew.
    pub fn forget(&mut self) {
        self.before.clear();
    }

    /// Advances by `h` seconds.
    pub fn step(
        &mut self,
        scene: &Scene,
        state: &mut State,
        contacts: &mut Contacts,
        itself: &mut SelfContact,
        settings: &NewtonSettings,
        h: f64,
    ) -> Solved {
        let count = scene.sheet.len();
        if self.before.is_empty() || self.step_before != h {
            self.begin(scene, state, h);
        }
        let (rate, span) = self.load(scene, state, h);
        let (x, v, loads) = (&state.positions, &state.velocities, &self.loads);
        let stiffness: Vec<f64> = (0..count)
            .map(|i| match scene.pinned[i] {
                true => 0.0,
                false => {
                    let inertia = CONTACT_OVER_INERTIA * scene.mass[i] / (h * h);
                    inertia.max(CONTACT_PER_AREA * scene.sheet.vertex_area[i])
                }
            })
            .collect();
        let start = x.clone();
        let mut after: Vec<DVec3> =
            (0..count).map(|i| if scene.pinned[i] { x[i] } else { x[i] + v[i] * h }).collect();
        let ways: Vec<DVec3> = loads.target.iter().zip(x).map(|(y, x)| *y - *x).collect();
        itself.gather(&scene.sheet, x, &ways, scene.gravity.length() * h * h);
        let task = Task {
            sheet: &scene.sheet,
            elastic: &scene.elastic,
            pinned: &scene.pinned,
            loads,
            start: &start,
            collider: scene.collider.as_ref(),
            stiffness: &stiffness,
        };
        let solved = self.newton.minimise(&task, contacts, itself, settings, &mut after);
        self.newton.work.steps += 1;
        self.newton.work.queries = contacts.queries;
        self.newton.work.skipped_queries = contacts.skipped;
        self.newton.work.self_pairs = itself.looked_at;
        let mut touching = vec![self.integrator == Integrator::Euler; count];
        contacts.touches().iter().for_each(|t| touching[t.vertex as usize] = true);
        itself.mark_touching(&mut touching);
        if let Some(collider) = &scene.collider {
            contacts.settle_anchors(collider, &after);
        }
        for i in 0..count {
            self.before[i] = (state.positions[i], state.velocities[i]);
            let touched = touching[i];
            state.velocities[i] = match (scene.pinned[i], touched) {
                (true, _) => DVec3::ZERO,
                (false, true) => (after[i] - start[i]) / h,
                (false, false) => (after[i] - rate[i]) / span[i],
            };
            self.euler[i] = touched;
        }
        state.positions = after;
        self.step_before = h;
        solved
    }

    /// Writes the loads of a step of `h` seconds: inertia, gravity and drag. Returns per vertex `rate` and `span`: the velocity
    /// after the step is (x' - rate) / span.
    fn load(&mut self, scene: &Scene, state: &State, h: f64) -> (Vec<DVec3>, Vec<f64>) {
        let count = scene.sheet.len();
        let (x, v) = (&state.positions, &state.velocities);
        let mut rate = vec![DVec3::ZERO; count];
        let mut span = vec![h; count];
        let loads = &mut self.loads;
        loads.inertia.resize(count, 0.0);
        loads.target.resize(count, DVec3::ZERO);
        loads.force.clear();
        loads.force.resize(count, DVec3::ZERO);
        for i in 0..count {
            let (x0, v0) = self.before[i];
            let (from, speed) = match self.euler[i] {
                true => (x[i], v[i]),
                false => {
                    span[i] = 2.0 / 3.0 * h;
                    ((x[i] * 4.0 - x0) / 3.0, (v[i] * 4.0 - v0) / 3.0)
                }
            };
            rate[i] = from;
            let s = span[i];
            let drag = 1.0 + scene.damping * s;
            loads.inertia[i] = scene.mass[i] * drag / (s * s);
            loads.target[i] = from + (speed * s + scene.gravity * (s * s)) / drag;
        }
        (rate, span)
    }

    /// Makes up a history for BDF2: a vertex that starts at rest or in free fall is taken to have moved so before.
    fn begin(&mut self, scene: &Scene, state: &State, h: f64) {
        let mut force = vec![DVec3::ZERO; scene.sheet.len()];
        scene.elastic.add_gradient(&state.positions, &mut force);
        // A vertex that begins with more than three times the acceleration of gravity neither rests nor falls freely.
        let bound = 3.0 * scene.gravity.length().max(1.0);
        self.before.clear();
        for (i, force) in force.into_iter().enumerate() {
            let (x, v) = (state.positions[i], state.velocities[i]);
            let a = scene.gravity - force / scene.mass[i] - v * scene.damping;
            let calm = a.length() <= bound && !scene.pinned[i];
            self.euler[i] = self.integrator == Integrator::Euler || !calm;
            self.before.push((x - v * h + a * (h * h / 2.0), v - a * h));
        }
    }
}
