//! Cloth on the move.

use glam::DVec3;

/// Where each vertex is and how fast.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Metres.
    pub positions: Vec<DVec3>,
    /// m/s.
    pub velocities: Vec<DVec3>,
}

impl State {
    /// At rest at `positions`.
    pub fn at_rest(positions: Vec<DVec3>) -> Self {
        let velocities = vec![DVec3::ZERO; positions.len()];
        Self { positions, velocities }
    }

    /// The first vertex that is nowhere.
    pub fn lost(&self) -> Option<usize> {
        let known = self.positions.iter().zip(&self.velocities).map(|(x, v)| x.is_finite() && v.is_finite());
        known.enumerate().find(|(_, known)| !known).map(|(v, _)| v)
    }
}
