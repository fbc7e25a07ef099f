//! Units of length of imported bodies.

use std::fmt;
use std::str::FromStr;

use crate::geometry::words::{Words, within_quotes, words};

/// A unit of length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// Metre, 1 m.
    #[default]
    Metre,
    /// Decimetre, 0.1 m.
    Decimetre,
    /// Centimetre, 0.01 m.
    Centimetre,
    /// Millimetre, 0.001 m.
    Millimetre,
    /// Inch, 0.0254 m.
    Inch,
}

impl Unit {
    /// All units, the likeliest first.
    pub const ALL: [Self; 5] = [Self::Metre, Self::Centimetre, Self::Millimetre, Self::Inch, Self::Decimetre];

    /// Length of the unit, metres.
    pub fn metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Decimetre => 0.1,
            Self::Centimetre => 0.01,
            Self::Millimetre => 0.001,
            Self::Inch => 0.0254,
        }
    }

    /// The symbol, such as "cm".
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Decimetre => "dm",
            Self::Centimetre => "cm",
            Self::Millimetre => "mm",
            Self::Inch => "in",
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}

/// Error: a text that names no unit.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub struct UnknownUnit(pub String);

impl UnknownUnit {
    /// The error in words.
    pub fn words(&self) -> Words {
        let text = within_quotes(&self.0);
        words!("\"{text}\" is no unit of length; m, dm, cm, mm and in are known", text)
    }
}

impl FromStr for Unit {
    type Err = UnknownUnit;

    fn from_str(text: &str) -> Result<Self, UnknownUnit> {
        match text.trim().to_ascii_lowercase().as_str() {
            "m" | "metre" | "metres" | "meter" | "meters" => Ok(Self::Metre),
            "dm" | "decimetre" | "decimetres" | "decimeter" | "decimeters" => Ok(Self::Decimetre),
            "cm" | "centimetre" | "centimetres" | "centimeter" | "centimeters" => Ok(Self::Centimetre),
            "mm" | "millimetre" | "millimetres" | "millimeter" | "millimeters" => Ok(Self::Millimetre),
            "in" | "inch" | "inches" | "\"" => Ok(Self::Inch),
            _ => Err(UnknownUnit(text.chars().take(40).collect())),
        }
    }
}

/// The unit in which a body `height` units high is 0.5 to 2.5 m tall; of several the one that brings it nearest to
/// 1.7 m. None when no unit does.
pub fn guess_unit(height: f64) -> Option<Unit> {
    let off = |unit: Unit| (height * unit.metres() / 1.7).ln().abs();
    Unit::ALL
        .into_iter()
        .filter(|unit| (0.5..=2.5).contains(&(height * unit.metres())))
        .min_by(|&a, &b| off(a).total_cmp(&off(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_guessed_from_a_height() {
        assert_eq!(guess_unit(1.72), Some(Unit::Metre));
        assert_eq!(guess_unit(16.7), Some(Unit::Decimetre));
        assert_eq!(guess_unit(172.0), Some(Unit::Centimetre));
        assert_eq!(guess_unit(1720.0), Some(Unit::Millimetre));
        assert_eq!(guess_unit(67.0), Some(Unit::Inch));
        assert_eq!(guess_unit(0.02), None);
        assert_eq!(guess_unit(0.0), None);
    }

    #[test]
    fn units_are_read() {
        for unit in Unit::ALL {
            assert_eq!(unit.symbol().parse(), Ok(unit));
        }
        assert!("furlong".parse::<Unit>().is_err());
    }
}
