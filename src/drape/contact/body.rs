//! Contact of cloth with a body: penetration depth, normal force and Coulomb friction of each vertex, by penalty springs.
//!
//! A vertex nearer than `offset` to the surface is pushed out by a spring of stiffness k; the normal force is N = k × depth.
//! Friction holds the vertex at an anchor by a spring of the same stiffness until that pulls with µN; from there the anchor
//! slides along. The friction limit therefore always belongs to the normal force at the positions being solved for, never to that
//! of an earlier iterate.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use crate::body::Surface;

/// A collision body, at rest or moving along straight lines during one step.
#[derive(Clone, Debug)]
pub struct Collider {
    /// Surface at the end of the step.
    pub surface: Arc<Surface>,
    /// Displacement of each of its vertices over the step, metres; empty for a body at rest.
    pub motion: Vec<DVec3>,
}

impl Collider {
    /// A body at rest.
    pub fn still(surface: Arc<Surface>) -> Self {
        Self { surface, motion: Vec::new() }
    }

    /// Largest displacement of any of its vertices over the step, metres.
    pub fn farthest(&self) -> f64 {
        self.motion.iter().map(|m| m.length_squared()).fold(0.0, f64::max).sqrt()
    }

    /// Displacement of the body over the step, metres, at the surface point nearest to `x`.
    pub fn carried_near(&self, x: DVec3) -> DVec3 {
        if self.motion.is_empty() {
            return DVec3::ZERO;
        }
        let near = self.surface.nearest(x);
        carried(self, near.triangle, near.point)
    }
}

/// Contacts of cloth with a body, and cached distances of vertices that do not touch it.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    /// Distance that cloth keeps from the body, metres.
    pub offset: f64,
    /// Coulomb friction coefficient.
    pub friction: f64,
    touches: Vec<Touch>,
    /// Per vertex the position of its last nearest-point query and the distance to the surface there, metres.
    known: Vec<(DVec3, f64)>,
    /// Per vertex its friction anchor, metres; NaN where it was not in contact.
    anchors: Vec<DVec3>,
    /// Nearest-point queries since the start.
    pub queries: u64,
    /// Queries saved because the cached distance showed that the vertex is far from the body.
    pub skipped: u64,
}

/// A vertex in contact with the body.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// Its index.
    pub vertex: u32,
    /// Outward unit normal of the surface.
    pub normal: DVec3,
    /// Penetration into the offset, metres: offset minus distance.
    pub depth: f64,
    /// Displacement from its friction anchor along the surface, metres.
    pub slip: DVec3,
    /// Stiffness of the contact spring, N/m.
    pub stiffness: f64,
    /// Largest friction force, N.
    limit: f64,
}

impl Touch {
    /// Share of the anchor spring's force that friction can transmit, 0..=1.
    fn grip(&self, limit: f64) -> f64 {
        let pull = self.stiffness * self.slip.length();
        if pull > limit { limit / pull } else { 1.0 }
    }

    /// Gradient of the contact energy, N.
    pub fn gradient(&self) -> DVec3 {
        self.slip * (self.stiffness * self.grip(self.limit)) - self.normal * (self.stiffness * self.depth)
    }

    /// Hessian of the contact energy, N/m; made positive semidefinite.
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
                // A sliding vertex meets a constant force along its direction of sliding: no stiffness there.
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
    /// No contacts yet.
    pub fn new(vertices: usize, offset: f64, friction: f64) -> Self {
        Self {
            offset,
            friction,
            known: vec![(DVec3::ZERO, 0.0); vertices],
            anchors: vec![DVec3::NAN; vertices],
            ..Self::default()
        }
    }

    /// Contacts found by the last [`Self::find`].
    pub fn touches(&self) -> &[Touch] {
        &self.touches
    }

    /// Finds the contacts of the cloth at `x`, which was at `start` when the step began. `stiffness` of the contact springs per
    /// vertex, N/m; vertices with 0 are left out.
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
        // A vertex that was outside and moved far may have tunnelled through the body: the first surface on its path counts.
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

    /// Contact energy, J, with the friction force of each vertex limited by `limits`, N.
    pub fn energy(&self, limits: &[f64]) -> f64 {
        self.touches.iter().map(|t| t.energy(limits[t.vertex as usize])).sum()
    }

    /// Writes the largest friction force of each vertex at the present contacts, N; 0 where there is none.
    pub fn write_limits(&self, limits: &mut [f64]) {
        limits.fill(0.0);
        self.touches.iter().for_each(|t| limits[t.vertex as usize] = t.limit);
    }

    /// Adds the gradient of the contact energy, N.
    pub fn add_gradient(&self, gradient: &mut [DVec3]) {
        self.touches.iter().for_each(|t| gradient[t.vertex as usize] += t.gradient());
    }

    /// Ends a step with the cloth at `x`: moves the anchors of sliding vertices along, and drops those of vertices without
    /// contact.
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

/// Displacement of the body over the step at `point` of `triangle`, metres.
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
