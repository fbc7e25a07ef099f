//! Simulation of any cloth mesh: picks the cheaper of the two time steppers, implicit or small steps.

use serde::Serialize;

use crate::contact::Separation;
use crate::drape::contact::body::Contacts;
use crate::drape::contact::itself::SelfContact;
use crate::drape::solver::newton::{NewtonSettings, Work, largest};
use crate::drape::solver::small_steps::{SmallSteps, substeps};
use crate::drape::solver::steps::{CONTACT_OVER_INERTIA, Integrator, Scene, Steps};
use crate::drape::state::State;

/// Cost of one implicit step per number in its Cholesky factor, in costs of one small step per mesh edge. Measured on one machine.
const IMPLICIT_PER_NUMBER: f64 = 2.5;

/// Upper bound of [`concentration`], a ratio. Of a sheet held at two corners the 99th percentile of edge strain was measured as
/// 3.3, 3.0, 2.1 and 1.8 times what the law for a held row predicts, at 0.5, 1, 10 and 40 thousand triangles; 1.9 to 2.0 times
/// where the sheet lies on a ball.
const MOST_CONCENTRATION: f64 = 4.0;

/// Time stepper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Newton's method on whole steps ([`crate::drape::solver::steps`]).
    Implicit,
    /// Position-based dynamics in many small steps ([`crate::drape::solver::small_steps`]).
    SmallSteps,
}

/// Settings of a [`Drape`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrapeSettings {
    /// The stepper to use; None picks the cheaper one.
    pub method: Option<Method>,
    /// Strain that small steps may add through unconverged constraints, beyond what the cloth's stiffness allows, 1e-4..0.2.
    pub strain: f64,
    /// Distance that cloth keeps from bodies and from itself, metres.
    pub thickness: f64,
    /// Coulomb friction coefficient.
    pub friction: f64,
    /// Whether cloth collides with itself.
    pub self_collision: bool,
    /// Time integrator of implicit steps.
    pub integrator: Integrator,
    /// Membrane stiffness that the springs of small steps stand for, N/m.
    pub stiffness: f64,
    /// Convergence tolerance of an implicit step: the largest Newton update still allowed, as a share of the mean edge length.
    pub accuracy: f64,
}

/// Why a step could not be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DrapeError {
    /// The solver's matrix does not fit in memory.
    #[error("the solver's matrix does not fit in memory")]
    Memory,
    /// This vertex became infinite or not a number; the state is the one before the step.
    #[error("vertex {0} (from 0) went nowhere; the step was taken back")]
    Lost(usize),
}

/// A cloth simulation: scene, moving state and the chosen solver.
#[derive(Debug)]
pub struct Drape {
    /// The cloth, its elasticity and its loads, which do not change between steps; the collider may be replaced.
    pub scene: Scene,
    state: State,
    settings: DrapeSettings,
    contacts: Contacts,
    itself: SelfContact,
    solver: Solver,
    residual: f64,
    unconverged: u64,
}

#[derive(Debug)]
enum Solver {
    Implicit(Box<Steps>),
    Small(Box<SmallSteps>, usize),
}

impl Drape {
    /// A simulation prepared for steps of `h` seconds.
    pub fn new(scene: Scene, state: State, settings: DrapeSettings, h: f64) -> Result<Self, DrapeError> {
        let count = scene.sheet.len();
        let solver = chosen(&scene, &settings, h)?;
        let thickness = if settings.self_collision { settings.thickness } else { 0.0 };
        let stiffness = scene.mass.iter().map(|m| CONTACT_OVER_INERTIA * m / (h * h)).collect();
        let itself = SelfContact::new(&scene.sheet, thickness, stiffness);
        let contacts = Contacts::new(count, settings.thickness, settings.friction);
        Ok(Self { scene, state, settings, contacts, itself, solver, residual: 0.0, unconverged: 0 })
    }

    /// Positions and velocities.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Advances by `h` seconds. On an error the state stays as it was.
    pub fn step(&mut self, h: f64) -> Result<(), DrapeError> {
        let before = self.state.clone();
        let lost = match &mut self.solver {
            Solver::Implicit(steps) => {
                let edge = self.scene.sheet.mean_edge();
                let settings = NewtonSettings {
                    residual: 0.0,
                    motion: self.settings.accuracy * edge,
                    most_iterations: 60,
                    exact: false,
                };
                let (contacts, itself) = (&mut self.contacts, &mut self.itself);
                let solved = steps.step(&self.scene, &mut self.state, contacts, itself, &settings, h);
                self.residual = solved.residual;
                self.unconverged += u64::from(!solved.converged);
                solved.lost
            }
            Solver::Small(small, count) => {
                let contact = (self.settings.thickness, self.settings.friction);
                small.step(&self.scene, &mut self.state, contact, h, *count);
                self.residual = 0.0;
                None
            }
        };
        match lost.or(self.state.lost()) {
            None => Ok(()),
            Some(vertex) => {
                self.state = before;
                if let Solver::Implicit(steps) = &mut self.solver {
                    steps.forget();
                }
                Err(DrapeError::Lost(vertex))
            }
        }
    }

    /// The chosen solver, in words for the user.
    pub fn chosen(&self) -> String {
        match &self.solver {
            Solver::Implicit(steps) => {
                format!("implicit steps, {} numbers in the factor", steps.newton().fill())
            }
            Solver::Small(_, count) => format!("{count} small steps each"),
        }
    }

    /// The chosen time stepper.
    pub fn method(&self) -> Method {
        match self.solver {
            Solver::Implicit(_) => Method::Implicit,
            Solver::Small(..) => Method::SmallSteps,
        }
    }

    /// Small steps in each step; 0 for an implicit stepper.
    pub fn substeps(&self) -> usize {
        match self.solver {
            Solver::Implicit(_) => 0,
            Solver::Small(_, count) => count,
        }
    }

    /// Largest unbalanced force on a vertex after the last implicit step, N; 0 for small steps, which do not compute it.
    pub fn residual(&self) -> f64 {
        self.residual
    }

    /// Number of implicit steps that ended before they converged.
    pub fn unconverged(&self) -> u64 {
        self.unconverged
    }

    /// Work done since the start.
    pub fn work(&self) -> Work {
        match &self.solver {
            Solver::Implicit(steps) => steps.newton().work,
            Solver::Small(small, _) => Work {
                queries: small.queries,
                skipped_queries: small.skipped,
                self_pairs: small.pairs(),
                ..Work::default()
            },
        }
    }

    /// Speed of the fastest vertex, m/s.
    pub fn speed(&self) -> f64 {
        largest(&self.state.velocities)
    }
}

/// Load concentration, 1..=[`MOST_CONCENTRATION`]: how many times the weight that hangs from a pinned vertex exceeds what would
/// hang from each vertex of a pinned row of `row` vertices. Edges next to the pins are not counted. How much a body will support
/// is not known before, so cloth on one gets the upper bound.
fn concentration(scene: &Scene, row: f64) -> f64 {
    match (scene.pinned.iter().filter(|held| **held).count(), &scene.collider) {
        (0, None) => 1.0,
        (0, Some(_)) => MOST_CONCENTRATION,
        (held, _) => (row / held as f64).clamp(1.0, MOST_CONCENTRATION),
    }
}

fn chosen(scene: &Scene, settings: &DrapeSettings, h: f64) -> Result<Solver, DrapeError> {
    let sheet = &scene.sheet;
    let (extent, edge) = (sheet.areas.iter().sum::<f64>().sqrt(), sheet.mean_edge());
    let hanging = extent * concentration(scene, extent / edge);
    let count = substeps(h, settings.strain, scene.gravity.length(), hanging, edge);
    let small = || {
        let mut small = SmallSteps::new(scene, settings.stiffness, h / count as f64);
        if settings.self_collision {
            small.separation = Some(separation(scene, settings.thickness));
        }
        Solver::Small(Box::new(small), count)
    };
    let implicit = || Steps::new(scene, settings.integrator).ok_or(DrapeError::Memory);
    match settings.method {
        Some(Method::SmallSteps) => Ok(small()),
        Some(Method::Implicit) => Ok(Solver::Implicit(Box::new(implicit()?))),
        None => {
            let steps = implicit()?;
            let work = (count * sheet.adjacency.edges.len()) as f64;
            let other = IMPLICIT_PER_NUMBER * steps.newton().fill() as f64;
            Ok(if work <= other { small() } else { Solver::Implicit(Box::new(steps)) })
        }
    }
}

/// Self-collision constraints for small steps.
fn separation(scene: &Scene, thickness: f64) -> Separation {
    let sheet = &scene.sheet;
    let rest: Vec<f64> = (0..sheet.adjacency.edges.len()).map(|e| sheet.rest_length(e)).collect();
    Separation::new(&sheet.triangles, &sheet.adjacency, (&rest, thickness), None, None)
}
