//! How long a unit of a drawing is.

use std::fmt;
use std::str::FromStr;

use glam::DVec2;

/// What a number in a drawing may count.
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
    /// A pixel of the web, 96 to an inch.
    Pixel,
    /// A pixel of Inkscape before 0.92, 90 to an inch.
    OldPixel,
    /// A point of print, and a pixel of Illustrator: 72 to an inch.
    Point,
}

impl DrawingUnit {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Millimetre,
        Self::Centimetre,
        Self::Metre,
        Self::Inch,
        Self::Pixel,
        Self::OldPixel,
        Self::Point,
    ];

    /// Metres in one.
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

    /// As it is typed: "mm", "cm", "m", "in", "px", "px90", "pt".
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

    /// As it is read: "millimetres".
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

/// A drawing does not say how large it is. Read it again with one of the candidates.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleQuestion {
    /// Why it is not known, one sentence without its full stop.
    pub why: String,
    /// Width and height of the largest piece, in units of the drawing.
    pub largest: DVec2,
    /// Likely ones first.
    pub candidates: Vec<DrawingUnit>,
}

impl ScaleQuestion {
    /// Width and height of the largest piece if a unit is `unit`, metres.
    pub fn size(&self, unit: DrawingUnit) -> DVec2 {
        self.largest * unit.metres()
    }

    /// "mm (the largest piece is 30.0 × 62.0 cm)".
    pub fn words(&self, unit: DrawingUnit) -> String {
        let size = self.size(unit) * 100.0;
        format!("{unit} (the largest piece is {:.1} × {:.1} cm)", size.x, size.y)
    }
}

impl fmt::Display for ScaleQuestion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let each: Vec<String> = self.candidates.iter().map(|&unit| self.words(unit)).collect();
        write!(f, "{}; its unit may be {}", self.why, each.join(", "))
    }
}
