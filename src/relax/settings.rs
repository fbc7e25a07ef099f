//! What the user can turn.

use serde::{Deserialize, Serialize};

/// How the cloth relaxes. Lengths in metres on a body 1.5 m large; `Surface::scale` multiplies them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RelaxSettings {
    /// How strongly the flat shape is kept, 0..=1.
    pub stretch: f64,
    /// How strongly folds are flattened, 0..=1 (paper A's alpha).
    pub flatten: f64,
    /// How far gravity moves a free vertex in one step, metres, 0..=0.01.
    pub gravity: f64,
    /// Moves along the body shorter than this stick, metres, 0..=0.02.
    pub friction: f64,
    /// How far above the skin the cloth lies, metres, 0.0005..=0.05.
    pub offset: f64,
}

impl Default for RelaxSettings {
    fn default() -> Self {
        Self { stretch: 1.0, flatten: 0.2, gravity: 0.0004, friction: 0.0008, offset: 0.004 }
    }
}
