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
    /// Which turn each triangle is matched by.
    #[serde(skip_serializing_if = "is_default")]
    pub rotation: Rotation,
    /// What may be left out. Not the user's, and not kept with the document.
    #[serde(skip)]
    pub skips: Skips,
}

/// The turn that lays a triangle's flat shape over its present one. With z the present and w the flat corners about their
/// centroids, as complex numbers:
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rotation {
    /// The angle of sum z conj(w): of all turns the one with the least sum of squares, so that no step raises the energy.
    #[default]
    LeastSquares,
    /// Paper A's, the angle of sum z conj(w) / |w|: every corner counts alike, however far out it is.
    Paper,
}

fn is_default(rotation: &Rotation) -> bool {
    *rotation == Rotation::default()
}

impl Default for RelaxSettings {
    fn default() -> Self {
        Self {
            stretch: 1.0,
            flatten: 0.2,
            gravity: 0.004,
            friction: 0.3,
            offset: 0.004,
            rotation: Rotation::default(),
            skips: Skips::default(),
        }
    }
}
