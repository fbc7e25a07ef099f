//! The moving state of cloth.

use glam::DVec3;

/// Position and velocity of each vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Position of each vertex, metres.
    pub positions: Vec<DVec3>,
    /// Velocity of each vertex, m/s.
    pub velocities: Vec<DVec3>,
}

impl State {
    /// All vertices at `positions` with velocity zero.
    pub fn at_rest(positions: Vec<DVec3>) -> Self {
        let velocities = vec![DVec3::ZERO; positions.len()];
        Self { positions, velocities }
    }

    /// The first vertex whose position or velocity is not finite.
    pub fn lost(&self) -> Option<usize> {
        let known = self.positions.iter().zip(&self.velocities).map(|(x, v)| x.is_finite() && v.is_finite());
        known.enumerate().find(|(_, known)| !known).map(|(v, _)| v)
    }
}
