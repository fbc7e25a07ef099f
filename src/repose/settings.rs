//! How thoroughly cloth is carried to another pose, and what came of it.

use serde::{Deserialize, Serialize};

/// How much is done to carry cloth over.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReposeSettings {
    /// Strain beyond what it had before that 99 of 100 edges shall not exceed, 0..=0.1.
    pub excess: f64,
    /// Global steps at most, 0..=1000.
    pub most_steps: usize,
    /// Poses on the way at most, 0..=50: where conforming alone would strain it too much, it goes there by turns of a few
    /// degrees.
    pub most_substeps: usize,
    /// So often at most, 0..=20, faces that cut the body are raised at the end, followed by some steps. With any, cloth that
    /// faces the skin of another limb is sent off it all along, and layers that run through each other are parted.
    pub mends: usize,
}

impl ReposeSettings {
    /// For a picture every frame.
    pub const LIVE: Self = Self { excess: 0.01, most_steps: 4, most_substeps: 0, mends: 0 };
    /// For cloth that stays as it comes out.
    pub const THOROUGH: Self = Self { excess: 0.01, most_steps: 120, most_substeps: 12, mends: 3 };
}

/// What came of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// |l / l_before - 1| that 99 of 100 edges do not exceed, after conforming,
    pub conformed_p99: f64,
    /// after the shapes of the triangles were joined,
    pub joined_p99: f64,
    /// and at the end.
    pub excess_p99: f64,
    /// Vertices that conforming put into the body,
    pub conformed_inside: usize,
    /// and that are there at the end, by the nearest skin.
    pub inside: usize,
    /// Poses on the way.
    pub substeps: usize,
    /// Global steps done.
    pub steps: usize,
    /// Times it was mended.
    pub mends: usize,
    /// Places where the cloth runs through itself at the end; not looked for in what was only a picture.
    pub crossings: usize,
}
