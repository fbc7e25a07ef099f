//! How much memory a garment on a body takes.

use serde::Serialize;

/// Bytes, by what becomes of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Memory {
    /// Topology and flat shape of the garment: made once, shared by all who use it.
    pub garment: usize,
    /// Where the cloth is and all it remembers from step to step: contacts, their pressure, what sends it away. The rest
    /// can be made anew from this and the garment.
    pub state: usize,
    /// Made from the garment once: folds, and the pattern of the matrix without its factor.
    pub tables: usize,
    /// Filled anew in every step.
    pub scratch: usize,
}
