//! Depth of field of the body pane and of its pictures.

use serde::{Deserialize, Serialize};

use super::or_default;
use crate::render::Lens;

/// Depth of field of the body pane and of its pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct DepthOfField {
    /// Whether what is out of focus is blurred.
    #[serde(deserialize_with = "or_default")]
    pub is_on: bool,
    /// The aperture.
    #[serde(deserialize_with = "or_default")]
    pub f_number: FNumber,
}

/// Focal length divided by the diameter of the aperture; limited to [`Lens::F_NUMBERS`] when it is used.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct FNumber(pub f32);

impl Default for FNumber {
    fn default() -> Self {
        Self(2.8)
    }
}

impl FNumber {
    /// The number within [`Lens::F_NUMBERS`].
    pub fn limited(self) -> f32 {
        self.0.clamp(*Lens::F_NUMBERS.start(), *Lens::F_NUMBERS.end())
    }
}

impl DepthOfField {
    /// The lens, which each picture focuses by what its middle shows; None while everything is sharp.
    pub fn lens(&self) -> Option<Lens> {
        self.is_on.then(|| Lens { f_number: self.f_number.limited(), focus: None })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_understood_costs_nothing_else() {
        let read = |text: &str| serde_json::from_str::<DepthOfField>(text).expect("depth of field");
        assert_eq!(read("{}"), DepthOfField::default());
        assert_eq!(DepthOfField::default().lens(), None);
        let on = DepthOfField { is_on: true, f_number: FNumber(4.0) };
        assert_eq!(read(r#"{"is_on": true, "f_number": 4.0}"#), on);
        assert_eq!(on.lens(), Some(Lens { f_number: 4.0, focus: None }));
        let newer = read(r#"{"is_on": true, "f_number": "wide", "more": 1}"#);
        assert_eq!(newer, DepthOfField { is_on: true, f_number: FNumber::default() });
        for (given, used) in [(0.0, 1.4), (-3.0, 1.4), (5.6, 5.6), (1e30, 22.0)] {
            assert_eq!(FNumber(given).limited(), used);
        }
    }
}
