//! What was done, counted. The same on every machine and for any number of threads.

use serde::Serialize;

use crate::cloth::Counters;
use crate::contact::separation;

/// Counts of work since the simulation began.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Stats {
    /// Ticks that did work.
    pub ticks: u64,
    /// Ticks that laid cloth on the body.
    pub growing_ticks: u64,
    /// Ticks that evened it out.
    pub settling_ticks: u64,
    /// Wraps begun.
    pub wraps: u64,
    /// Triangles of all garments built for them.
    pub triangles_built: u64,
    /// Vertex positions computed: vertices on the body, summed over ticks.
    pub vertices_moved: u64,
    /// Checkpoints taken.
    pub checkpoints: u64,
    /// Checkpoints gone back to.
    pub restores: u64,
    /// Ticks that failed and were taken back.
    pub failures: u64,
    /// Work of the wrap on the body, growing and settling.
    pub work: Counters,
    /// Work of the contact that cannot cross, sewing and draping.
    pub contact: separation::Counters,
}
