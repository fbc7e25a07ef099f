//! The unit of length of a drawing.

use std::fmt;
use std::str::FromStr;

use glam::DVec2;

use crate::geometry::words::{Words, decimal, words};

/// A unit of length that the numbers of a drawing may be in.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize,
)]
#[serde(rename_all = "snake_case")]
pub enum DrawingUnit {
    /// 1 mm.
    #[default]
    Millimetre,
    /// 10 mm.
    Centimetre,
    /// 1 m.
    Metre,
    /// 25.4 mm.
    Inch,
    /// A CSS pixel, 1/96 inch.
    Pixel,
    /// A pixel of Inkscape before version 0.92, 1/90 inch.
    OldPixel,
    /// A typographic point, which is also the pixel of Illustrator: 1/72 inch.
    Point,
}

impl DrawingUnit {
    /// All units.
    pub const ALL: [Self; 7] = [
        Self::Millimetre,
        Self::Centimetre,
        Self::Metre,
        Self::Inch,
        Self::Pixel,
        Self::OldPixel,
        Self::Point,
    ];

    /// Length of one unit, metres.
    pub fn metres(self) -> f64 {
        match self {
            Self::Millimetre => 1e-3,
            Self::Centimetre => 1e-2,
            Self::Metre => 1.0,
            Self::Inch => 25.4e-3,
            Self::Pixel => 25.4e-3 / 96.0,
            Self::OldPixel => 25.4e-3 / 90.0,
            Self::Point => 25.4e-3 / 72.0,
        }
    }

    /// The abbreviation to type: "mm", "cm", "m", "in", "px", "px90", "pt".
    pub fn short(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Metre => "m",
            Self::Inch => "in",
            Self::Pixel => "px",
            Self::OldPixel => "px90",
            Self::Point => "pt",
        }
    }

    /// The name for messages, in the plural: "millimetres".
    pub fn long(self) -> &'static str {
        match self {
            Self::Millimetre => "millimetres",
            Self::Centimetre => "centimetres",
            Self::Metre => "metres",
            Self::Inch => "inches",
            Self::Pixel => "pixels, 96 to an inch",
            Self::OldPixel => "pixels, 90 to an inch (old Inkscape)",
            Self::Point => "points, 72 to an inch (Illustrator)",
        }
    }
}

impl fmt::Display for DrawingUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.short())
    }
}

impl FromStr for DrawingUnit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL
            .into_iter()
            .find(|unit| unit.short() == text)
            .ok_or_else(|| format!("{text:?} is none of {}", Self::ALL.map(Self::short).join(", ")))
    }
}

/// The question which unit a drawing is in, for the user. The drawing must be read again with one of the candidates.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleQuestion {
    /// Why the unit is not known: one sentence without its full stop.
    pub why: Words,
    /// Width and height of the largest piece, in units of the drawing.
    pub largest: DVec2,
    /// Units to choose from, likely ones first.
    pub candidates: Vec<DrawingUnit>,
}

impl ScaleQuestion {
    /// Width and height of the largest piece (metres) if the drawing is in `unit`.
    pub fn size(&self, unit: DrawingUnit) -> DVec2 {
        self.largest * unit.metres()
    }

    /// A choice in words: "mm (the largest piece is 30.0 × 62.0 cm)".
    fn choice(&self, unit: DrawingUnit) -> Words {
        let size = self.size(unit) * 100.0;
        words!(
            "{unit} (the largest piece is {width} × {height} cm)",
            unit = unit.short(),
            width = decimal(size.x, 1),
            height = decimal(size.y, 1)
        )
    }

    /// The question in words, with its choices.
    pub fn words(&self) -> Words {
        let choices = Words::joined(self.candidates.iter().map(|&unit| self.choice(unit)), ", ");
        words!("{why}; its unit may be {choices}", why = self.why, choices)
    }
}

impl fmt::Display for ScaleQuestion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.words().fmt(f)
    }
}
