//! Minimisation of the energy of cloth under loads, by Newton's method with a sparse Cholesky factor.
//!
//! One struct owns the matrix, its factor and the right-hand side, and rebuilds them together from the same positions and
//! contacts, so that none can be out of date.

use glam::{DMat3, DVec3};

use crate::drape::contact::body::{Collider, Contacts};
use crate::drape::contact::itself::SelfContact;
use crate::drape::forces::elastic::Elastic;
use crate::drape::sheet::Sheet;
use crate::drape::solver::blocks::{BlockMatrix, Slot, solve};
use crate::geometry::factor::Factor;

/// Inertia and external loads as a quadratic energy of each vertex: w/2 |x - y|² - f·x.
#[derive(Clone, Debug, Default)]
pub struct Loads {
    /// Inertial stiffness w of each vertex, N/m.
    pub inertia: Vec<f64>,
    /// Inertial target y of each vertex, metres.
    pub target: Vec<DVec3>,
    /// External force f on each vertex, N.
    pub force: Vec<DVec3>,
}

/// Stopping criteria, and the kind of Hessian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonSettings {
    /// Converged when no vertex has a larger residual force, N.
    pub residual: f64,
    /// Converged when the largest Newton update is at most this, metres.
    pub motion: f64,
    /// Most iterations.
    pub most_iterations: usize,
    /// Whether to use the exact Hessian where it is positive definite. It converges faster near an equilibrium, and only it
    /// proves that the equilibrium is stable.
    pub exact: bool,
}

/// Result of a minimisation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Solved {
    /// Newton iterations.
    pub iterations: usize,
    /// Largest residual force, N.
    pub residual: f64,
    /// Whether a stopping criterion was met.
    pub converged: bool,
    /// Whether the last factor was of the exact Hessian, which therefore was positive definite.
    pub stable: bool,
    /// The first vertex whose force is not finite.
    pub lost: Option<usize>,
}

/// Work counters since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Work {
    /// Time steps.
    pub steps: u64,
    /// Newton iterations.
    pub iterations: u64,
    /// Matrix factorisations.
    pub factors: u64,
    /// Evaluations of energy and gradient.
    pub evaluations: u64,
    /// Nearest-point queries of the body.
    pub queries: u64,
    /// Queries saved because the vertex was known to be far from the body.
    pub skipped_queries: u64,
    /// Self-collision pairs tested.
    pub self_pairs: u64,
    /// Self-collision pairs whose test was saved in small steps.
    pub skipped_self_pairs: u64,
}

/// Newton solver with its memory.
#[derive(Debug)]
pub struct Newton {
    matrix: BlockMatrix,
    diagonal: Vec<Slot>,
    /// Matrix blocks of each triangle: corners (0,0) (1,0) (1,1) (2,0) (2,1) (2,2).
    corners: Vec<[Slot; 6]>,
    bends: Vec<(Slot, f64)>,
    factor: Option<Factor>,
    /// Whether `factor` is of the exact Hessian.
    whole: bool,
    limits: Vec<f64>,
    scratch: Vec<f64>,
    /// Work done.
    pub work: Work,
}

/// Minimisation problem: everything that stays fixed meanwhile.
pub struct Task<'a> {
    /// The cloth.
    pub sheet: &'a Sheet,
    /// Its elasticity.
    pub elastic: &'a Elastic,
    /// Vertices that are held.
    pub pinned: &'a [bool],
    /// Inertia and external loads.
    pub loads: &'a Loads,
    /// Positions at the start of the step, metres.
    pub start: &'a [DVec3],
    /// The body, if any.
    pub collider: Option<&'a Collider>,
    /// Contact stiffness of each vertex, N/m.
    pub stiffness: &'a [f64],
}

impl Newton {
    /// A solver for `sheet` with this elasticity. None when the matrix does not fit in memory.
    pub fn new(sheet: &Sheet, elastic: &Elastic) -> Option<Self> {
        let edges = sheet.adjacency.edges.iter().copied();
        let bent = (0..sheet.len()).flat_map(|i| elastic.bending.row(i).map(move |(j, _)| [i as u32, j]));
        let matrix = BlockMatrix::new(sheet.len(), edges.chain(bent).chain(elastic.folds.pairs()))?;
        let diagonal: Option<Vec<Slot>> = (0..sheet.len() as u32).map(|v| matrix.slot(v, v)).collect();
        let corners = sheet.triangles.iter().map(|vs| {
            let slot = |k: usize, l: usize| matrix.slot(vs[k], vs[l]);
            Some([slot(0, 0)?, slot(1, 0)?, slot(1, 1)?, slot(2, 0)?, slot(2, 1)?, slot(2, 2)?])
        });
        let corners: Option<Vec<[Slot; 6]>> = corners.collect();
        let mut bends = Vec::new();
        for i in 0..sheet.len() {
            for (j, q) in elastic.bending.row(i).filter(|&(j, _)| j as usize <= i) {
                bends.push((matrix.slot(i as u32, j)?, q));
            }
        }
        Some(Self {
            diagonal: diagonal?,
            corners: corners?,
            bends,
            matrix,
            factor: None,
            whole: false,
            limits: vec![0.0; sheet.len()],
            scratch: Vec::new(),
            work: Work::default(),
        })
    }

    /// Number of nonzeros in the Cholesky factor.
    pub fn fill(&self) -> usize {
        self.matrix.fill()
    }

    /// Moves `x` to a minimum of the energy.
    pub fn minimise(
        &mut self,
        task: &Task,
        contacts: &mut Contacts,
        itself: &mut SelfContact,
        settings: &NewtonSettings,
        x: &mut Vec<DVec3>,
    ) -> Solved {
        let mut gradient = vec![DVec3::ZERO; x.len()];
        let mut energy = self.evaluate(task, contacts, itself, x, &mut gradient);
        contacts.write_limits(&mut self.limits);
        let mut solved = Solved::default();
        let mut refused = false;
        let mut small_before = false;
        while solved.iterations < settings.most_iterations {
            solved.residual = largest(&gradient);
            if solved.residual <= settings.residual {
                solved.converged = true;
                break;
            }
            let Some(direction) =
                self.direction(task, contacts, itself, settings.exact && !refused, x, &gradient)
            else {
                break;
            };
            solved.iterations += 1;
            self.work.iterations += 1;
            let wanted = largest(&direction);
            let slope: f64 = gradient.iter().zip(&direction).map(|(g, d)| g.dot(*d)).sum();
            let last = wanted <= settings.motion;
            let moved = (slope < 0.0)
                && self.search(task, contacts, itself, x, &direction, &mut gradient, &mut energy, slope);
            // Whether a vertex sticks or slides can change by a small step: with contacts two small updates in a row are needed.
            if moved && last && (small_before || contacts.touches().is_empty()) {
                solved.residual = largest(&gradient);
                solved.converged = true;
                break;
            }
            small_before = last;
            if !moved {
                // The exact Hessian may have led astray; its positive semidefinite part cannot.
                if refused || !settings.exact {
                    solved.converged = last;
                    break;
                }
                refused = true;
            } else {
                refused = false;
            }
        }
        solved.stable = self.whole;
        solved.lost = gradient.iter().position(|g| !g.is_finite());
        solved
    }

    /// Energy (J) at `x` and its gradient (N), zero at pinned vertices.
    fn evaluate(
        &mut self,
        task: &Task,
        contacts: &mut Contacts,
        itself: &mut SelfContact,
        x: &[DVec3],
        gradient: &mut [DVec3],
    ) -> f64 {
        self.work.evaluations += 1;
        let loads = task.loads;
        let mut energy = 0.0;
        for v in 0..x.len() {
            let way = x[v] - loads.target[v];
            energy +=
                loads.inertia[v] * way.length_squared() / 2.0 - loads.force[v].dot(x[v] - task.start[v]);
            gradient[v] = way * loads.inertia[v] - loads.force[v];
        }
        energy += task.elastic.add_gradient(x, gradient);
        if let Some(collider) = task.collider {
            contacts.find(collider, task.start, x, task.stiffness);
            contacts.add_gradient(gradient);
            energy += contacts.energy(&self.limits);
        }
        energy += itself.add_gradient(x, gradient);
        for (g, _) in gradient.iter_mut().zip(task.pinned).filter(|(_, pinned)| **pinned) {
            *g = DVec3::ZERO;
        }
        energy
    }

    /// Line search along `direction`. False when the energy does not fall enough.
    #[allow(clippy::too_many_arguments, reason = "the state of one search, used once")]
    fn search(
        &mut self,
        task: &Task,
        contacts: &mut Contacts,
        itself: &mut SelfContact,
        x: &mut Vec<DVec3>,
        direction: &[DVec3],
        gradient: &mut Vec<DVec3>,
        energy: &mut f64,
        slope: f64,
    ) -> bool {
        let mut step = 1.0;
        let mut after = vec![DVec3::ZERO; x.len()];
        // Down to a two-thousandth of the step: then the direction is no use.
        for _ in 0..12 {
            let there: Vec<DVec3> = x.iter().zip(direction).map(|(x, d)| *x + *d * step).collect();
            let reached = self.evaluate(task, contacts, itself, &there, &mut after);
            let slope_after: f64 = after.iter().zip(direction).map(|(g, d)| g.dot(*d)).sum();
            let rounding = 1e-13 * (energy.abs() + reached.abs());
            let falls = reached <= *energy + 1e-4 * step * slope;
            let flat = reached <= *energy + rounding && slope_after.abs() <= 0.9 * slope.abs();
            // The energy of friction belongs to the earlier normal forces; with contacts a slope that lessens is as good a sign
            // of progress.
            let lessens = !contacts.touches().is_empty() && slope_after.abs() <= 0.9 * slope.abs();
            if reached.is_finite() && (falls || flat || lessens) {
                let old = self.limits.clone();
                contacts.write_limits(&mut self.limits);
                *energy = reached - contacts.energy(&old) + contacts.energy(&self.limits);
                *x = there;
                std::mem::swap(gradient, &mut after);
                return true;
            }
            step *= 0.5;
        }
        *energy = self.evaluate(task, contacts, itself, x, gradient);
        false
    }

    fn refactor(
        &mut self,
        task: &Task,
        contacts: &Contacts,
        itself: &SelfContact,
        exact: bool,
        x: &[DVec3],
    ) -> bool {
        let memory = self.factor.take();
        if exact {
            self.assemble(task, contacts, itself, true, x, 0.0);
            self.factor = self.matrix.factor(memory);
            self.work.factors += 1;
            self.whole = self.factor.is_some();
        }
        if self.factor.is_none() {
            self.whole = false;
            self.assemble(task, contacts, itself, false, x, 0.0);
            self.factor = self.matrix.factor(None);
            self.work.factors += 1;
        }
        if self.factor.is_none() {
            // Only rounding, or a part that nothing holds, makes this matrix singular.
            let shift = 1e-8 * self.matrix.largest();
            self.assemble(task, contacts, itself, false, x, shift);
            self.factor = self.matrix.factor(None);
            self.work.factors += 1;
        }
        self.factor.is_some()
    }

    fn assemble(
        &mut self,
        task: &Task,
        contacts: &Contacts,
        itself: &SelfContact,
        exact: bool,
        x: &[DVec3],
        shift: f64,
    ) {
        let matrix = &mut self.matrix;
        matrix.clear();
        let at = |k: usize, l: usize| k * (k + 1) / 2 + l;
        let corners = &self.corners;
        task.elastic.membrane.hessian(x, exact, |t, k, l, block| matrix.add(corners[t][at(k, l)], &block));
        if exact {
            task.elastic.pressure_hessian(x, |t, k, l, block| matrix.add(corners[t][at(k, l)], &block));
        }
        for &(slot, q) in &self.bends {
            matrix.add(slot, &DMat3::from_diagonal(DVec3::splat(q)));
        }
        for (&slot, w) in self.diagonal.iter().zip(&task.loads.inertia) {
            matrix.add(slot, &DMat3::from_diagonal(DVec3::splat(w + shift)));
        }
        if task.collider.is_some() {
            for touch in contacts.touches() {
                matrix.add(self.diagonal[touch.vertex as usize], &touch.hessian());
            }
        }
        let mut spring = |[a, b]: [u32; 2], block: DMat3| {
            matrix.add(self.diagonal[a as usize], &block);
            matrix.add(self.diagonal[b as usize], &block);
            if let Some(slot) = matrix.slot(b, a) {
                matrix.add(slot, &(block * -1.0));
            }
        };
        if let Some(limits) = &task.elastic.limits {
            limits.hessian(x, exact, &mut spring);
        }
        task.elastic.bands.hessian(x, spring);
        task.elastic.folds.hessian(x, |[i, j], block| {
            if let Some(slot) = matrix.slot(i, j) {
                matrix.add(slot, &block);
            }
        });
        itself.hessian(|v, block| matrix.add(self.diagonal[v as usize], &block));
        matrix.hold(task.pinned);
    }

    /// Newton direction; None when the matrix cannot be factored.
    fn direction(
        &mut self,
        task: &Task,
        contacts: &Contacts,
        itself: &SelfContact,
        exact: bool,
        x: &[DVec3],
        gradient: &[DVec3],
    ) -> Option<Vec<DVec3>> {
        if !self.refactor(task, contacts, itself, exact, x) {
            return None;
        }
        let mut direction: Vec<DVec3> = gradient.iter().map(|g| -*g).collect();
        solve(self.factor.as_ref()?, &mut direction, &mut self.scratch).then_some(())?;
        direction.iter().all(|d| d.is_finite()).then_some(direction)
    }

    /// Whether the exact Hessian at `x`, without contacts, is positive definite: the equilibrium is stable.
    pub fn is_stable(&mut self, task: &Task, x: &[DVec3]) -> bool {
        self.assemble(task, &Contacts::default(), &SelfContact::default(), true, x, 0.0);
        self.matrix.factor(None).is_some()
    }
}

/// Length of the longest vector; NaN where one is.
pub fn largest(vectors: &[DVec3]) -> f64 {
    let longer = |most: f64, next: f64| if next > most || next.is_nan() { next } else { most };
    vectors.iter().map(|v| v.length_squared()).fold(0.0, longer).sqrt()
}
