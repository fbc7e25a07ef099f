//! Memory used by a garment on a body.

use serde::Serialize;

/// Memory used, bytes, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Memory {
    /// Topology and rest shape of the garment: made once, shared by all users.
    pub garment: usize,
    /// Positions of the cloth and everything kept from step to step: contacts, their pressure, directions away from
    /// faults. The rest can be computed from this and the garment.
    pub state: usize,
    /// Computed once from the garment: hinges, and the pattern of the matrix without its factor.
    pub tables: usize,
    /// Values that every step recomputes.
    pub scratch: usize,
}
