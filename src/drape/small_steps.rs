//! Many small steps of extended position-based dynamics (Macklin et al. 2016, 2019), one pass each.
//!
//! A pass lets cloth that hangs L metres stretch by 2 g L h² / l² beyond what its stiffness allows, l being an edge's length: that
//! law says how small the steps must be. Edges stand for the membrane as springs (Van Gelder 1998), so that shear and Poisson's
//! ratio are those of a net; bending is an explicit force, in as few of the steps as is stable.

use glam::DVec3;

use crate::drape::contact::Collider;
use crate::drape::itself::Itself;
use crate::drape::limits::StrainLimits;
use crate::drape::state::State;
use crate::drape::steps::Scene;

/// A body's nearest point is looked up again after a way of so many offsets: over a round of radius R what is taken for its plane
/// then is off by twice the offset squared over R.
const STALE: f64 = 2.0;
/// Of the limit of stability that bending's steps take.
const SAFE: f64 = 0.5;

/// The solver with its memory.
#[derive(Debug)]
pub struct SmallSteps {
    /// In groups without common vertices, so that the work on one edge does not wait for that on the one before.
    edges: Vec<Edge>,
    inverse_mass: Vec<f64>,
    /// Bending's greatest angular frequency, 1/s.
    bending_rate: f64,
    /// For which step the edges are made ready, s.
    ready_for: f64,
    planes: Vec<Plane>,
    /// Velocities are those of half a step ago, s.
    lag: f64,
    /// Nearest points looked up.
    pub queries: u64,
    /// Vertices known to be far without one.
    pub skipped: u64,
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    ends: [u32; 2],
    /// Rest length squared, m².
    squared: f64,
    stiffness: f64,
    /// Shares of the correction that each end takes.
    shares: [f64; 2],
}

/// What a vertex knows of a body: beyond the plane n·x = height it is free.
#[derive(Clone, Copy, Debug, Default)]
struct Plane {
    normal: DVec3,
    height: f64,
    /// Where that was found, and how far one may go before it is looked up again.
    place: DVec3,
    good_for: f64,
}

/// Substeps that keep `strain` in a step of `h` seconds: cloth of `extent` metres and edges of `edge` metres.
pub fn substeps(h: f64, strain: f64, gravity: f64, extent: f64, edge: f64) -> usize {
    if gravity == 0.0 {
        return 1;
    }
    let longest = edge * (strain / (2.0 * gravity * extent)).sqrt();
    (h / longest).ceil().max(1.0) as usize
}

impl SmallSteps {
    /// `stiffness` of the membrane, N/m.
    pub fn new(scene: &Scene, stiffness: f64) -> Self {
        let sheet = &scene.sheet;
        let springs = StrainLimits::new(sheet, 0.0, stiffness);
        let edges = springs.springs().map(|(ends, length, stiffness)| Edge {
            ends,
            squared: length * length,
            stiffness,
            shares: [0.0; 2],
        });
        let edges = in_groups(sheet.len(), &edges.collect::<Vec<_>>());
        let inverse = |(m, pinned): (&f64, &bool)| if *pinned { 0.0 } else { 1.0 / m };
        let bending = &scene.elastic.bending;
        // Gershgorin's bound.
        let most = |i: usize| bending.row(i).map(|(_, q)| q.abs()).sum::<f64>() / scene.mass[i];
        let bending_rate = (0..sheet.len()).map(most).fold(0.0, f64::max).sqrt();
        Self {
            edges,
            inverse_mass: scene.mass.iter().zip(&scene.pinned).map(inverse).collect(),
            bending_rate,
            ready_for: 0.0,
            planes: vec![Plane::default(); sheet.len()],
            lag: 0.0,
            queries: 0,
            skipped: 0,
        }
    }

    /// Goes `h` seconds on in `count` steps. `offset` and `friction` as in [`Contacts`](crate::drape::contact::Contacts).
    pub fn step(
        &mut self,
        scene: &Scene,
        state: &mut State,
        itself: &mut Itself,
        (offset, friction): (f64, f64),
        h: f64,
        count: usize,
    ) {
        let small = h / count as f64;
        self.ready(small);
        let every = self.bending_every(small).min(count);
        let drag = (-scene.damping * small).exp();
        let vertices = state.positions.len();
        let ways: Vec<DVec3> = state.velocities.iter().map(|v| *v * h).collect();
        let slack = scene.gravity.length() * h * h;
        itself.gather(&scene.sheet, &state.positions, &ways, slack);
        let mut bent = vec![DVec3::ZERO; vertices];
        let mut before = state.positions.clone();
        for s in 0..count {
            let x = &mut state.positions;
            let kick = if s == 0 { self.lag + small / 2.0 } else { small };
            if s % every == 0 && self.bending_rate > 0.0 {
                bent.fill(DVec3::ZERO);
                scene.elastic.bending.add_gradient(x, &mut bent);
                let span = small * every.min(count - s) as f64;
                for (v, (f, w)) in state.velocities.iter_mut().zip(bent.iter().zip(&self.inverse_mass)) {
                    *v -= *f * (span * w);
                }
            }
            before.copy_from_slice(x);
            for (i, v) in state.velocities.iter_mut().enumerate() {
                if self.inverse_mass[i] > 0.0 {
                    *v = *v * drag + scene.gravity * kick;
                    x[i] += *v * small;
                }
            }
            project(&self.edges, x);
            itself.project(x, &self.inverse_mass);
            if let Some(collider) = &scene.collider {
                let left = 1.0 - (s + 1) as f64 / count as f64;
                self.collide(collider, &before, x, offset, friction, left, 1.0 / count as f64);
            }
            for (v, (now, then)) in state.velocities.iter_mut().zip(x.iter().zip(&before)) {
                *v = (*now - *then) / small;
            }
        }
        self.lag = small / 2.0;
        if scene.collider.as_ref().is_some_and(|c| !c.motion.is_empty()) {
            self.planes.fill(Plane::default());
        }
    }

    /// Velocities at the end of the step, m/s: what they are behind, gravity makes up for.
    pub fn velocity_now(&self, scene: &Scene, v: DVec3) -> DVec3 {
        v + scene.gravity * self.lag
    }

    fn ready(&mut self, h: f64) {
        if self.ready_for == h {
            return;
        }
        self.ready_for = h;
        for edge in &mut self.edges {
            let [a, b] = edge.ends.map(|v| self.inverse_mass[v as usize]);
            let whole = a + b + 1.0 / (edge.stiffness * h * h);
            edge.shares = [a / whole, b / whole];
        }
    }

    /// Bending acts once in so many small steps.
    fn bending_every(&self, small: f64) -> usize {
        match self.bending_rate * small {
            0.0 => usize::MAX,
            rate => ((SAFE * 2.0 / rate) as usize).max(1),
        }
    }

    #[allow(clippy::too_many_arguments, reason = "one use")]
    fn collide(
        &mut self,
        collider: &Collider,
        before: &[DVec3],
        x: &mut [DVec3],
        offset: f64,
        friction: f64,
        left: f64,
        part: f64,
    ) {
        for (i, x) in x.iter_mut().enumerate() {
            if self.inverse_mass[i] == 0.0 {
                continue;
            }
            let plane = &mut self.planes[i];
            if x.distance_squared(plane.place) > plane.good_for * plane.good_for {
                self.queries += 1;
                *plane = look(collider, *x, before[i], offset, left);
            } else if plane.normal == DVec3::ZERO {
                self.skipped += 1;
                continue;
            }
            let depth = plane.height - plane.normal.dot(*x);
            if depth > 0.0 {
                *x += plane.normal * depth;
                let carried = collider.carried_near(before[i]) * part;
                let slip = *x - before[i] - carried;
                let slip = slip - plane.normal * slip.dot(plane.normal);
                let length = slip.length();
                let hold = friction * depth;
                *x -= if length <= hold { slip } else { slip * (hold / length) };
            }
        }
    }
}

/// The body's plane at `x`; `left` of the body's motion is still to come.
fn look(collider: &Collider, x: DVec3, before: DVec3, offset: f64, left: f64) -> Plane {
    let back = collider.carried_near(x) * left;
    let near = collider.surface.nearest(x + back);
    let moving = collider.motion.iter().map(|m| m.length_squared()).fold(0.0, f64::max).sqrt();
    let clear = near.distance - offset - moving * left;
    if clear > offset {
        return Plane { normal: DVec3::ZERO, height: 0.0, place: x, good_for: clear };
    }
    let mut normal = near.normal;
    let mut point = near.point - back;
    let way = x - before;
    if way.length() > near.distance.abs()
        && let Some(hit) = collider.surface.ray(before + back, way)
        && hit.distance < way.length()
        && hit.normal.dot(way) < 0.0
    {
        (normal, point) = (hit.normal, hit.point - back);
    }
    let good_for = if moving > 0.0 { 0.0 } else { STALE * offset.max(1e-4) };
    Plane { normal, height: normal.dot(point) + offset, place: x, good_for }
}

/// Pulls every edge towards its length. With d² for l² the correction (d² - l²)/(d² + l²) is that of length to second order in
/// the strain, without a root.
fn project(edges: &[Edge], x: &mut [DVec3]) {
    for edge in edges {
        let [a, b] = edge.ends.map(|v| v as usize);
        let along = x[b] - x[a];
        let squared = along.length_squared();
        let pull = along * ((squared - edge.squared) / (squared + edge.squared));
        x[a] += pull * edge.shares[0];
        x[b] -= pull * edge.shares[1];
    }
}

/// The edges group by group, no vertex twice in a group; within one as they were.
fn in_groups(vertices: usize, edges: &[Edge]) -> Vec<Edge> {
    let mut taken = vec![0u64; vertices];
    let mut groups: Vec<(u32, usize)> = Vec::with_capacity(edges.len());
    for (e, edge) in edges.iter().enumerate() {
        let [a, b] = edge.ends.map(|v| v as usize);
        let group = (taken[a] | taken[b]).trailing_ones().min(63);
        taken[a] |= 1 << group;
        taken[b] |= 1 << group;
        groups.push((group, e));
    }
    groups.sort_unstable();
    groups.into_iter().map(|(_, e)| edges[e]).collect()
}
