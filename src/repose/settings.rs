//! Settings (quality) and statistics of carrying cloth to another pose.

use serde::{Deserialize, Serialize};

/// Re-pose settings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReposeSettings {
    /// Target for the 99th percentile of additional strain, 0..=0.1.
    pub excess: f64,
    /// Most global steps, 0..=1000.
    pub most_steps: usize,
    /// Most intermediate poses, 0..=50, each a few degrees from the next. They are used where going directly would strain the
    /// cloth too much.
    pub most_substeps: usize,
    /// Most repairs at the end, 0..=20: raising faces that cut the body, followed by some steps. Above 0, cloth that is near the
    /// skin of another limb is also moved off it, and intersecting layers are separated.
    pub mends: usize,
    /// Most passes of strain limiting, 0..=20, each followed by raising faces that cut the body. With none there is one, which raises
    /// nothing.
    pub passes: usize,
    /// Most rounds of strain limiting in a pass, 0..=100, each with contacts found anew.
    pub rounds: usize,
}

impl ReposeSettings {
    /// Preview, computed every frame.
    pub const LIVE: Self =
        Self { excess: 0.01, most_steps: 4, most_substeps: 0, mends: 0, passes: 0, rounds: 9 };
    /// Final result.
    pub const THOROUGH: Self =
        Self { excess: 0.01, most_steps: 120, most_substeps: 12, mends: 3, passes: 6, rounds: 60 };
}

/// Statistics of a re-pose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// 99th percentile of |l / l_before - 1| after conforming.
    pub conformed_p99: f64,
    /// 99th percentile of |l / l_before - 1| after the triangles were joined.
    pub joined_p99: f64,
    /// 99th percentile of |l / l_before - 1| at the end.
    pub excess_p99: f64,
    /// Vertices inside the body after conforming.
    pub conformed_inside: usize,
    /// Vertices inside the body at the end, by the nearest skin.
    pub inside: usize,
    /// Intermediate poses.
    pub substeps: usize,
    /// Global steps done.
    pub steps: usize,
    /// Repairs done.
    pub mends: usize,
    /// Self-intersections at the end; not counted in a preview.
    pub crossings: usize,
}
