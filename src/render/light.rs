//! Light of a picture's surroundings.

use std::str::FromStr;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::scene::Rgb;

/// Surroundings of a picture, which give its light and its background.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Light {
    /// A lamp above the viewer's left shoulder in a bright room, in the colours of the [`Look`](super::Look).
    #[default]
    Studio,
    /// The sun high in a blue sky.
    Daylight,
    /// The low sun of the evening.
    Evening,
}

impl Light {
    /// All of them, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Studio, Self::Daylight, Self::Evening];

    /// Name for users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Studio => "studio",
            Self::Daylight => "daylight",
            Self::Evening => "evening",
        }
    }

    /// Background at the top and at the bottom, and the floor; None: those of the look.
    pub(super) fn backdrop(self) -> Option<[Rgb; 3]> {
        match self {
            Self::Studio => None,
            Self::Daylight => Some([[128, 172, 222], [222, 234, 244], [206, 208, 204]]),
            Self::Evening => Some([[78, 74, 110], [240, 178, 132], [150, 122, 108]]),
        }
    }

    /// Tint of the lamp, a factor of that of the studio.
    pub(super) fn tint(self) -> Vec3 {
        match self {
            Self::Studio => Vec3::ONE,
            Self::Daylight => Vec3::new(1.1, 1.06, 0.98),
            Self::Evening => Vec3::new(1.42, 0.92, 0.52),
        }
    }

    /// Direction of the lamp: how far left of the eye, radians, and how far above and before the scene.
    pub(super) fn lamp(self) -> [f32; 3] {
        match self {
            Self::Studio => [0.72, 0.82, 0.78],
            Self::Daylight => [0.5, 1.0, 0.6],
            Self::Evening => [1.05, 0.36, 0.93],
        }
    }
}

impl FromStr for Light {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let names = || Self::ALL.map(Self::name).join(", ");
        let found = Self::ALL.into_iter().find(|light| light.name() == text);
        found.ok_or_else(|| format!("there is no light {text:?}; there are {}", names()))
    }
}
