//! Settings of relaxation that the user can change.

use serde::{Deserialize, Serialize};

use crate::cloth::Skips;

/// Settings of relaxation. Lengths are in metres on a body 1.5 m large; `Surface::scale` multiplies them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RelaxSettings {
    /// Stiffness of shape matching, 0..=1.
    pub stretch: f64,
    /// Strength of flattening, 0..=1 (paper A's alpha).
    pub flatten: f64,
    /// Gravity, as the strain at the top of a metre of hanging cloth, 0..=0.1. It is small: it serves to drape the
    /// cloth, and does not simulate its weight.
    pub gravity: f64,
    /// Coefficient of Coulomb friction between cloth and skin, 0..=2.
    pub friction: f64,
    /// Height of the cloth above the skin, metres, 0.0005..=0.05.
    pub offset: f64,
    /// Rotation used in shape matching.
    #[serde(skip_serializing_if = "is_default")]
    pub rotation: Rotation,
    /// Allowed shortcuts. Not a setting of the user, and not saved with the document.
    #[serde(skip)]
    pub skips: Skips,
}

/// The rotation that matches a triangle's rest shape to its present one. Below, z are the present and w the rest
/// corners about their centroids, as complex numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rotation {
    /// Angle of sum z conj(w): the rotation with the least sum of squares, so that no step raises the energy.
    #[default]
    LeastSquares,
    /// Paper A's: angle of sum z conj(w) / |w|, which weights all corners alike, whatever their distance from the centroid.
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
