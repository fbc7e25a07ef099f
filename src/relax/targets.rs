//! What each vertex wants in a global step besides its triangles' shapes: to keep off the skin, to get away from skin that is
//! not its own, to stay with its mark.

use glam::DVec3;

use crate::contact::{Plane, Tracker};
use crate::relax::step::GlobalStep;

/// Keeps the matrix regular where nothing holds the cloth.
const PROXIMAL_WEIGHT: f64 = 1e-4;
/// How much of the last sliding move is tried again: the contact term holds a vertex where it was, this lets it slide on.
const SLIDE_MOMENTUM: f64 = 0.9;
/// The same under gravity and friction.
const WEIGHTED_MOMENTUM: f64 = 0.8;
/// A contact's push beyond the offset grows no further than this, metres on a body 1.5 m large.
const MOST_PUSH: f64 = 0.1;
/// Cloth is on the wrong side of the skin next to it when their normals have a smaller cosine.
const WRONG_SIDE: f64 = 0.0;
/// Cloth on the wrong side is sent away by this in a step, metres on a body 1.5 m large.
const SEND_AWAY: f64 = 0.003;
/// Weight of sending layers apart that ran into each other: against that of a few triangles, as only the cloth itself is in
/// the way.
const PARTING_WEIGHT: f64 = 0.3;

/// One global step's wants. Slices hold one entry per vertex.
pub(super) struct Targets<'a> {
    pub tracker: &'a Tracker,
    /// Of the cloth, front up.
    pub normals: &'a [DVec3],
    /// Where cloth on the wrong side is sent, in steps of [`SEND_AWAY`].
    pub sent: &'a [DVec3],
    /// The same for layers that ran into each other.
    pub parted: &'a [DVec3],
    /// Extra offset, metres.
    pub lift: &'a [f64],
    /// Where marks want their vertices.
    pub held: &'a [Option<DVec3>],
    /// Positions before the last step.
    pub previous: &'a [DVec3],
    pub step: GlobalStep,
    /// How many times as far as solved the step goes.
    pub pace: f64,
    /// Metres.
    pub offset: f64,
    /// Coulomb's coefficient.
    pub friction: f64,
    /// With how much force each vertex clings to skin it touches, per unit of friction.
    pub cling: &'a [f64],
    /// Cloth on the wrong side this near the skin is sent away, metres.
    pub reach: f64,
    /// Of the body: what paper A's lengths are multiplied by.
    pub scale: f64,
}

impl Targets<'_> {
    /// Weight of the mapped vertex `v` at `x`, and the way to its target. Its contact multiplier `push` grows by what is lacking to the
    /// offset, and friction takes from the `force` on it.
    pub fn of(&self, v: usize, x: DVec3, push: &mut f64, force: &mut DVec3) -> (f64, DVec3) {
        let away = SEND_AWAY * self.scale;
        let contact = self.step.contact;
        let mut weight = PROXIMAL_WEIGHT;
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
            Some((plane, below)) if self.step.unfold && plane.normal.dot(self.normals[v]) < WRONG_SIDE => {
                *push = 0.0;
                // Fading out towards the reach and towards the right side, so that it comes to rest.
                let facing = (-plane.normal.dot(self.normals[v]) * 4.0).clamp(0.0, 1.0);
                let near = ((self.reach - plane.height(x)) / self.reach * 2.0).clamp(0.0, 1.0);
                want(contact, x + plane.normal * (below.max(0.0) + away * facing * near));
            }
            // In the band above the offset the weight stays, so that the factor need not change when a vertex lifts off.
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

    /// Where a vertex in contact, `below` metres under its offset, is drawn.
    fn contact_target(&self, v: usize, x: DVec3, plane: Plane, below: f64, push: f64) -> DVec3 {
        let tangential = |d: DVec3| d - plane.normal * d.dot(plane.normal);
        let height = if push > 0.0 { below + push } else { 0.0 };
        let target = x + plane.normal * height;
        let slid = self.previous[v] != DVec3::ZERO;
        let slide = if slid { tangential(x - self.previous[v]) } else { DVec3::ZERO };
        let momentum = if self.step.weight { WEIGHTED_MOMENTUM } else { SLIDE_MOMENTUM };
        // What is tried again must not grow by being gone farther than solved.
        target + slide.clamp_length_max(self.step.cap) * (momentum / self.pace)
    }

    /// Coulomb friction: what a contact takes of the force along the skin, as far as its pressure allows. Cloth also clings
    /// to skin it touches, so that it does not creep down under its own weight (paper A's threshold).
    fn rub(&self, v: usize, force: DVec3, push: f64, normal: DVec3) -> DVec3 {
        let tangential = force - normal * force.dot(normal);
        let pressure = self.step.contact * push + self.cling[v];
        tangential.clamp_length_max(self.friction * pressure)
    }
}
