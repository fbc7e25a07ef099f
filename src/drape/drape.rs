//! Cloth under physics, with the solver that suits it.

use serde::Serialize;

use crate::contact::Separation;
use crate::drape::contact::body::Contacts;
use crate::drape::contact::itself::SelfContact;
use crate::drape::solver::newton::{NewtonSettings, Work, largest};
use crate::drape::solver::small_steps::{SmallSteps, substeps};
use crate::drape::solver::steps::{CONTACT_OVER_INERTIA, Integrator, Scene, Steps};
use crate::drape::state::State;

/// Work of one small step per edge, vertex and entry of bending against that of an implicit step per number in its factor: what
/// both took on one machine. The choice needs no more than their ratio.
const SMALL_PER_EDGE: f64 = 1.0;
const IMPLICIT_PER_NUMBER: f64 = 2.5;

/// A sheet held by two corners strains so many times as much, at its worst hundredth of edges, as the law for a held row says:
/// measured 3.3, 3.0, 2.1 and 1.8 at 0.5, 1, 10 and 40 thousand triangles, and 1.9 to 2.0 where it lies on a ball.
const MOST_CONCENTRATION: f64 = 4.0;

/// How cloth is moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Newton's method on whole steps.
    Implicit,
    /// Position-based dynamics in many small ones.
    SmallSteps,
}

/// What one is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrapeSettings {
    /// One method; without, the cheaper.
    pub method: Option<Method>,
    /// Strain that the solver may leave beyond the cloth's own, 1e-4..0.2.
    pub strain: f64,
    /// Distance kept from bodies and from itself, metres.
    pub thickness: f64,
    /// Coulomb's coefficient.
    pub friction: f64,
    /// Whether cloth meets itself.
    pub self_collision: bool,
    /// Of implicit steps.
    pub integrator: Integrator,
    /// Membrane stiffness that springs stand for, N/m.
    pub stiffness: f64,
    /// Largest move that an implicit step may leave undone, as a share of the mean edge.
    pub accuracy: f64,
}

/// A step could not be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DrapeError {
    /// The matrix needs more memory than there is.
    #[error("the solver's matrix does not fit in memory")]
    Memory,
    /// Something became infinite; the state is that before the step.
    #[error("vertex {0} (from 0) went nowhere; the step was taken back")]
    Lost(usize),
}

/// Moving cloth.
#[derive(Debug)]
pub struct Drape {
    /// What stays the same. The collider may be replaced between steps.
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
    /// Ready for steps of `h` seconds.
    pub fn new(scene: Scene, state: State, settings: DrapeSettings, h: f64) -> Result<Self, DrapeError> {
        let count = scene.sheet.len();
        let solver = chosen(&scene, &settings, h)?;
        let thickness = if settings.self_collision { settings.thickness } else { 0.0 };
        let stiffness = scene.mass.iter().map(|m| CONTACT_OVER_INERTIA * m / (h * h)).collect();
        let itself = SelfContact::new(&scene.sheet, thickness, stiffness);
        let contacts = Contacts::new(count, settings.thickness, settings.friction);
        Ok(Self { scene, state, settings, contacts, itself, solver, residual: 0.0, unconverged: 0 })
    }

    /// Where the cloth is.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Goes `h` seconds on, or stays where it is.
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

    /// What was chosen, in words.
    pub fn chosen(&self) -> String {
        match &self.solver {
            Solver::Implicit(steps) => {
                format!("implicit steps, {} numbers in the factor", steps.newton().fill())
            }
            Solver::Small(_, count) => format!("{count} small steps each"),
        }
    }

    /// The method chosen.
    pub fn method(&self) -> Method {
        match self.solver {
            Solver::Implicit(_) => Method::Implicit,
            Solver::Small(..) => Method::SmallSteps,
        }
    }

    /// Small steps in each step; none of an implicit one.
    pub fn substeps(&self) -> usize {
        match self.solver {
            Solver::Implicit(_) => 0,
            Solver::Small(_, count) => count,
        }
    }

    /// The largest force that no vertex's motion accounts for after the last step, N; small steps do not know theirs.
    pub fn residual(&self) -> f64 {
        self.residual
    }

    /// Implicit steps that ended before they were as accurate as asked.
    pub fn unconverged(&self) -> u64 {
        self.unconverged
    }

    /// Work done.
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

    /// The fastest vertex, m/s.
    pub fn speed(&self) -> f64 {
        largest(&self.state.velocities)
    }
}

/// How many times as much hangs from a vertex that is held as from one of a row of `row` that is held as a whole, as far as the
/// strain of all but the edges next to it feels it. What a body will hold nobody knows before.
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
            let work = SMALL_PER_EDGE * (count * sheet.adjacency.edges.len()) as f64;
            let other = IMPLICIT_PER_NUMBER * steps.newton().fill() as f64;
            Ok(if work <= other { small() } else { Solver::Implicit(Box::new(steps)) })
        }
    }
}

/// What keeps the cloth from crossing itself.
fn separation(scene: &Scene, thickness: f64) -> Separation {
    let sheet = &scene.sheet;
    let rest: Vec<f64> = (0..sheet.adjacency.edges.len()).map(|e| sheet.rest_length(e)).collect();
    Separation::new(sheet.len(), &sheet.triangles, &sheet.adjacency, (&rest, thickness), None, None)
}
