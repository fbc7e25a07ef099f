//! Work counters. The same on every machine and for any number of threads.

use serde::Serialize;

use crate::cloth::Counters;
use crate::contact::separation;

/// Counters since the simulation began.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Stats {
    /// Ticks that did work.
    pub ticks: u64,
    /// Ticks that laid cloth on the body.
    pub growing_ticks: u64,
    /// Ticks that relaxed or draped it.
    pub settling_ticks: u64,
    /// Wraps begun.
    pub wraps: u64,
    /// Triangles of all garments built.
    pub triangles_built: u64,
    /// Vertex positions computed: vertices on the body, summed over ticks.
    pub vertices_moved: u64,
    /// Checkpoints stored.
    pub checkpoints: u64,
    /// Checkpoints restored.
    pub restores: u64,
    /// Ticks and requests that failed and were undone.
    pub failures: u64,
    /// Work of the present wrap, growing and settling.
    pub work: Counters,
    /// Work of collision in sewing and draping.
    pub contact: separation::Counters,
}
