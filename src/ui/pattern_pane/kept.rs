//! Options of the pattern tools.

/// Options of the pattern tools, kept while the program runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Whether the two sides of a cut are sewn together.
    pub sew_cut: bool,
    /// Width of the next dart, metres.
    pub dart_width: f64,
    /// Depth of the next dart, metres.
    pub dart_depth: f64,
    /// Whether editing keeps the ratio of the lengths of sewn edges.
    pub keep_equal: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { sew_cut: true, dart_width: 0.025, dart_depth: 0.1, keep_equal: true }
    }
}
