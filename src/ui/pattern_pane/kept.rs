//! What the tools of the table keep from one use to the next.

/// Kept while the program runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The two sides of a cut are sewn together again.
    pub sew_cut: bool,
    /// Of the next dart, metres.
    pub dart_width: f64,
    /// Of the next dart, metres.
    pub dart_depth: f64,
    /// Editing keeps the lengths of sewn edges as they are to each other.
    pub keep_equal: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { sew_cut: true, dart_width: 0.025, dart_depth: 0.1, keep_equal: true }
    }
}
