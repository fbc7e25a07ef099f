//! What acts on cloth in small steps.

use glam::DVec3;

use crate::drape::contact::body::Collider;
use crate::drape::forces::bending::Bending;

/// Speed at which cloth leaves a body when it is deeper than its own motion brought it, m/s; it gains no momentum by that. Chosen
/// by trial; it bounds how fast cloth that begins inside the body comes out of it.
pub const EASE: f64 = 0.3;

/// Forces on cloth besides those of its springs.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// Bending energy of the cloth.
    pub bending: &'a Bending,
    /// Stiffness-proportional damping of bending, seconds.
    pub bending_damping: f64,
    /// Whether the cloth has come down and is to come to rest: damped bending is then evaluated more often, so that nothing trembles.
    pub settles: bool,
    /// Gravity, m/s².
    pub gravity: DVec3,
    /// Rate at which motion dies away, 1/s.
    pub damping: f64,
    /// The body, if any.
    pub collider: Option<&'a Collider>,
    /// Height of the floor, metres, if there is one.
    pub floor: Option<f64>,
    /// Distance kept from the body and the floor, metres.
    pub offset: f64,
    /// Coulomb friction coefficient per vertex.
    pub friction: &'a [f64],
    /// Largest pressure that friction sees, Pa: friction should not hold cloth against strain control.
    pub grip: f64,
}
