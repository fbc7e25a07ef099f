//! Cloth against a body: how deep each vertex is, and what pushes and holds it.
//!
//! A vertex nearer than `offset` to the surface is pushed out by a spring of stiffness k; N = k × depth. Friction holds it at an
//! anchor by the same spring until that pulls with µN; then the anchor slides after. So the limit always belongs to the normal
//! force of the very positions that are solved for, never to that of an earlier iterate.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use crate::body::Surface;

/// A body at rest or on its way through one step.
#[derive(Clone, Debug)]
pub struct Collider {
    /// Where it is when the step ends.
    pub surface: Arc<Surface>,
    /// How far each of its vertices comes in the step, metres; empty for a body at rest.
    pub motion: Vec<DVec3>,
}

impl Collider {
    /// At rest.
    pub fn still(surface: Arc<Surface>) -> Self {
        Self { surface, motion: Vec::new() }
    }

    /// How far any of its vertices comes in the step, metres.
    pub fn farthest(&self) -> f64 {
        self.motion.iter().map(|m| m.length_squared()).fold(0.0, f64::max).sqrt()
    }

    /// How far the body moves in the step where it is nearest to `x`.
    pub fn carried_near(&self, x: DVec3) -> DVec3 {
        if self.motion.is_empty() {
            return DVec3::ZERO;
        }
        let near = self.surface.nearest(x);
        carried(self, near.triangle, near.point)
    }
}

/// What touches, and what is known of what does not.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    /// Distance kept, metres.
    pub offset: f64,
    /// Coulomb's coefficient.
    pub friction: f64,
    touches: Vec<Touch>,
    /// Per vertex a place and its distance to the surface there, metres.
    known: Vec<(DVec3, f64)>,
    /// Per vertex where friction holds it; NaN where it touched nothing.
    anchors: Vec<DVec3>,
    /// Nearest points looked up since the start.
    pub queries: u64,
    /// Vertices passed over because they were known to be far.
    pub skipped: u64,
}

/// A vertex that is pushed.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// Which.
    pub vertex: u32,
    /// Outward unit normal of the surface.
    pub normal: DVec3,
    /// How much nearer than the offset, metres.
    pub depth: f64,
    /// How far from its anchor along the surface, metres.
    pub slip: DVec3,
    /// Of the spring, N/m.
    pub stiffness: f64,
    /// Most that friction can pull, N.
    limit: f64,
}

impl Touch {
    /// The share of the spring that friction can pull with, 0..=1.
    fn grip(&self, limit: f64) -> f64 {
        let pull = self.stiffness * self.slip.length();
        if pull > limit { limit / pull } else { 1.0 }
    }

    /// N.
    pub fn gradient(&self) -> DVec3 {
        self.slip * (self.stiffness * self.grip(self.limit)) - self.normal * (self.stiffness * self.depth)
    }

    /// N/m, positive semidefinite.
    pub fn hessian(&self) -> DMat3 {
        let across = DMat3::from_cols(
            self.normal * self.normal.x,
            self.normal * self.normal.y,
            self.normal * self.normal.z,
        );
        let mut along = DMat3::ZERO;
        if self.limit > 0.0 {
            let grip = self.grip(self.limit);
            along = (DMat3::IDENTITY - across) * (self.stiffness * grip);
            if grip < 1.0 {
                // Along its way what slides meets the same force wherever it is.
                let u = self.slip.normalize_or_zero();
                along -= DMat3::from_cols(u * u.x, u * u.y, u * u.z) * (self.stiffness * grip);
            }
        }
        across * self.stiffness + along
    }

    fn energy(&self, limit: f64) -> f64 {
        let slip = self.slip.length();
        let k = self.stiffness;
        let held =
            if k * slip > limit { limit * slip - limit * limit / (2.0 * k) } else { k * slip * slip / 2.0 };
        k * self.depth * self.depth / 2.0 + held
    }
}

impl Contacts {
    /// Nothing touches yet.
    pub fn new(vertices: usize, offset: f64, friction: f64) -> Self {
        Self {
            offset,
            friction,
            known: vec![(DVec3::ZERO, 0.0); vertices],
            anchors: vec![DVec3::NAN; vertices],
            ..Self::default()
        }
    }

    /// What touches now.
    pub fn touches(&self) -> &[Touch] {
        &self.touches
    }

    /// Finds what touches with the cloth at `x`, which was at `start` when the step began. `stiffness` per vertex, N/m.
    pub fn find(&mut self, collider: &Collider, start: &[DVec3], x: &[DVec3], stiffness: &[f64]) {
        self.touches.clear();
        for v in 0..x.len() {
            if stiffness[v] == 0.0 {
                continue;
            }
            let (place, distance) = self.known[v];
            if distance - x[v].distance(place) > self.offset {
                self.skipped += 1;
                self.anchors[v] = DVec3::NAN;
                continue;
            }
            self.look(collider, start[v], x[v], v, stiffness[v]);
        }
    }

    fn look(&mut self, collider: &Collider, start: DVec3, x: DVec3, v: usize, stiffness: f64) {
        self.queries += 1;
        let surface = &collider.surface;
        let near = surface.nearest(x);
        let (mut normal, mut depth) = (near.normal, self.offset - near.distance);
        self.known[v] = (x, near.distance.max(0.0));
        let carried = carried(collider, near.triangle, near.point);
        // Who was outside and has come far may have passed right through: what it met first counts.
        let from = start + carried;
        let way = x - from;
        if way.length() > near.distance.abs()
            && let Some(hit) = surface.ray(from, way)
            && hit.distance < way.length()
            && hit.normal.dot(way) < 0.0
            && (hit.point - x).dot(near.normal).abs() > 2.0 * self.offset
        {
            normal = hit.normal;
            depth = self.offset - (x - hit.point).dot(hit.normal);
            self.known[v].1 = 0.0;
        }
        if depth <= 0.0 {
            self.anchors[v] = DVec3::NAN;
            return;
        }
        let anchor = match self.anchors[v].is_nan() {
            true => from,
            false => self.anchors[v] + carried,
        };
        let away = x - anchor;
        let slip = away - normal * away.dot(normal);
        let limit = self.friction * stiffness * depth;
        self.touches.push(Touch { vertex: v as u32, normal, depth, slip, stiffness, limit });
    }

    /// J, with friction at most what it was at `limits`.
    pub fn energy(&self, limits: &[f64]) -> f64 {
        self.touches.iter().map(|t| t.energy(limits[t.vertex as usize])).sum()
    }

    /// The most that friction can pull each vertex now, N.
    pub fn write_limits(&self, limits: &mut [f64]) {
        limits.fill(0.0);
        self.touches.iter().for_each(|t| limits[t.vertex as usize] = t.limit);
    }

    /// Adds the gradient, N.
    pub fn add_gradient(&self, gradient: &mut [DVec3]) {
        self.touches.iter().for_each(|t| gradient[t.vertex as usize] += t.gradient());
    }

    /// The step is over with the cloth at `x`: anchors that could not hold slide after.
    pub fn settle_anchors(&mut self, collider: &Collider, x: &[DVec3]) {
        for anchor in &mut self.anchors {
            *anchor = DVec3::NAN;
        }
        for t in &self.touches {
            let v = t.vertex as usize;
            self.anchors[v] = x[v] - t.slip * t.grip(t.limit);
        }
        if !collider.motion.is_empty() {
            self.known.iter_mut().for_each(|k| k.1 = 0.0);
        }
    }
}

/// How far the body moves at `point` of `triangle`.
fn carried(collider: &Collider, triangle: u32, point: DVec3) -> DVec3 {
    if collider.motion.is_empty() {
        return DVec3::ZERO;
    }
    let mesh = &collider.surface.mesh;
    let vs = mesh.triangles[triangle as usize];
    let [a, b, c] = vs.map(|v| mesh.positions[v as usize]);
    let across = (b - a).cross(c - a);
    let whole = across.length_squared();
    if whole == 0.0 {
        return collider.motion[vs[0] as usize];
    }
    let wb = (point - a).cross(c - a).dot(across) / whole;
    let wc = (b - a).cross(point - a).dot(across) / whole;
    let [ma, mb, mc] = vs.map(|v| collider.motion[v as usize]);
    ma * (1.0 - wb - wc) + mb * wb + mc * wc
}
