//! Progress of a layout being made on another thread, and the wish to stop it. Neither changes the result.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// What two threads share about a layout in the making.
#[derive(Debug, Default)]
pub struct Watch {
    /// Looks at pairs of parts that may be spent.
    work: AtomicU64,
    /// Looks spent.
    spent: AtomicU64,
    is_stopped: AtomicBool,
}

impl Watch {
    /// Share of the work that is spent, 0..=1. A search that finds nothing shorter may end before 1.
    pub fn share(&self) -> f64 {
        let work = self.work.load(Ordering::Relaxed).max(1);
        (self.spent.load(Ordering::Relaxed) as f64 / work as f64).min(1.0)
    }

    /// Asks the layout to stop at its next safe point.
    pub fn stop(&self) {
        self.is_stopped.store(true, Ordering::Relaxed);
    }

    /// Whether the layout was asked to stop.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }

    /// Begins to count, with this much work to spend.
    pub(super) fn begin(&self, work: u64) {
        self.work.store(work, Ordering::Relaxed);
    }

    /// Counts work as spent.
    pub(super) fn spend(&self, work: u64) {
        self.spent.fetch_add(work, Ordering::Relaxed);
    }
}
