//! What the user can turn.

use serde::{Deserialize, Serialize};

use crate::cloth::Skips;

/// How the cloth relaxes. Lengths in metres on a body 1.5 m large; `Surface::scale` multiplies them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RelaxSettings {
    /// How strongly the flat shape is kept, 0..=1.
    pub stretch: f64,
    /// How strongly folds are flattened, 0..=1 (paper A's alpha).
    pub flatten: f64,
    /// Strain that a metre of cloth hanging by its edge has at the top, 0..=0.1. Small: it lays cloth, it does not weigh it.
    pub gravity: f64,
    /// Coulomb's coefficient between cloth and skin, 0..=2.
    pub friction: f64,
    /// How far above the skin the cloth lies, metres, 0.0005..=0.05.
    pub offset: f64,
    /// What may be left out. Not the user's, and not kept with the document.
    #[serde(skip)]
    pub skips: Skips,
}

impl Default for RelaxSettings {
    fn default() -> Self {
        Self {
            stretch: 1.0,
            flatten: 0.2,
            gravity: 0.004,
            friction: 0.3,
            offset: 0.004,
            skips: Skips::default(),
        }
    }
}
