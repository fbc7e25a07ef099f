//! Targets of each vertex in a global step besides shape matching: off the skin, away from skin on whose wrong side
//! it is, apart from intersecting layers, at its mark.

use glam::DVec3;

use crate::contact::{Plane, Tracker};
use crate::relax::step::{GlobalStep, STEP_OUT};

/// Fraction of the last sliding move that is added to the target: it counters the contact weight, which resists sliding. Chosen by
/// trial; 1 would let sliding go on for ever.
const SLIDE_MOMENTUM: f64 = 0.9;
/// Fraction of the last sliding move that is added to the target in steps with gravity and friction. Chosen by trial.
const WEIGHTED_MOMENTUM: f64 = 0.8;
/// Largest push of a contact beyond the offset, metres on a body 1.5 m large. So much that it can carry tight cloth: at a lower
/// bound, such cloth trembled at the shoulders.
const MOST_PUSH: f64 = 0.1;
/// Weight of separating intersecting layers: that of a few triangles, as only the cloth itself is in the way. With a tenth of it,
/// deep folds stayed crossed.
const PARTING_WEIGHT: f64 = 0.3;

/// What the targets of one global step are computed from. Slices hold one entry per vertex.
pub(super) struct Targets<'a> {
    pub tracker: &'a Tracker,
    /// Normals of the cloth on its front side.
    pub normals: &'a [DVec3],
    /// Directions away from skin on whose wrong side the cloth was, in steps of [`STEP_OUT`].
    pub sent: &'a [DVec3],
    /// Directions that separate intersecting layers, in steps of [`STEP_OUT`].
    pub parted: &'a [DVec3],
    /// Extra offsets, metres.
    pub lift: &'a [f64],
    /// Positions to which marks hold their vertices.
    pub held: &'a [Option<DVec3>],
    /// Positions before the last step, metres.
    pub previous: &'a [DVec3],
    pub step: GlobalStep,
    /// Over-relaxation of the step, see [`Acceleration::along`](crate::relax::Acceleration::along).
    pub pace: f64,
    /// Height above the skin that the cloth keeps, metres.
    pub offset: f64,
    /// Coefficient of Coulomb friction.
    pub friction: f64,
    /// Forces by which vertices cling to skin that they touch, per unit of friction.
    pub cling: &'a [f64],
    /// Distance from the skin within which cloth on the wrong side is moved away, metres.
    pub reach: f64,
    /// Scale of the body, by which paper A's lengths are multiplied.
    pub scale: f64,
}

impl Targets<'_> {
    /// Weight of the mapped vertex `v` at `x`, and the move to its target, metres. Its contact multiplier `push`
    /// grows by what it lacks to the offset, and friction is subtracted from the `force` on it.
    pub fn of(&self, v: usize, x: DVec3, push: &mut f64, force: &mut DVec3) -> (f64, DVec3) {
        let away = STEP_OUT * self.scale;
        let contact = self.step.contact;
        // Of the present position: it keeps the matrix regular where nothing holds the cloth.
        let mut weight = 1e-4;
        let mut pull = DVec3::ZERO;
        let mut want = |w: f64, target: DVec3| {
            weight += w;
            pull += (target - x) * w;
        };
        for (weight, way) in [(contact, self.sent[v]), (PARTING_WEIGHT, self.parted[v])] {
            if way != DVec3::ZERO {
                want(weight, x + way * away);
            }
        }
        let below = self.tracker.plane(v).map(|p| (p, self.offset + self.lift[v] - p.height(x)));
        match below {
            // On the wrong side of the skin: facing against it.
            Some((plane, below)) if self.step.unfold && plane.normal.dot(self.normals[v]) < 0.0 => {
                *push = 0.0;
                // Fade out towards the reach and towards the right side, so that the cloth comes to rest.
                let facing = (-plane.normal.dot(self.normals[v]) * 4.0).clamp(0.0, 1.0);
                let near = ((self.reach - plane.height(x)) / self.reach * 2.0).clamp(0.0, 1.0);
                want(contact, x + plane.normal * (below.max(0.0) + away * facing * near));
            }
            // In a band above the offset the weight is kept, so that the factor need not change when a vertex lifts off.
            Some((plane, below)) if below > -self.offset => {
                *push = (*push + below).clamp(0.0, MOST_PUSH * self.scale);
                if self.step.weight {
                    *force -= self.rub(v, *force, *push, plane.normal);
                }
                want(contact, self.contact_target(v, x, plane, below, *push));
            }
            _ => *push = 0.0,
        }
        if let Some(held) = self.held[v]
            && self.step.hold > 0.0
        {
            let slack = self.step.slack;
            want(self.step.hold, held + (x - held).clamp_length_max(slack));
        }
        (weight, pull / weight)
    }

    /// Target of a vertex in contact that is `below` metres under its offset.
    fn contact_target(&self, v: usize, x: DVec3, plane: Plane, below: f64, push: f64) -> DVec3 {
        let tangential = |d: DVec3| d - plane.normal * d.dot(plane.normal);
        let height = if push > 0.0 { below + push } else { 0.0 };
        let target = x + plane.normal * height;
        let slid = self.previous[v] != DVec3::ZERO;
        let slide = if slid { tangential(x - self.previous[v]) } else { DVec3::ZERO };
        let momentum = if self.step.weight { WEIGHTED_MOMENTUM } else { SLIDE_MOMENTUM };
        // Divided by the over-relaxation, so that the added slide does not grow.
        target + slide.clamp_length_max(self.step.cap) * (momentum / self.pace)
    }

    /// Coulomb friction: the part of the force along the skin that a contact takes, limited by its pressure. Cloth
    /// also clings to skin that it touches, so that it does not creep down under its own weight (paper A's threshold).
    fn rub(&self, v: usize, force: DVec3, push: f64, normal: DVec3) -> DVec3 {
        let tangential = force - normal * force.dot(normal);
        let pressure = self.step.contact * push + self.cling[v];
        tangential.clamp_length_max(self.friction * pressure)
    }
}
