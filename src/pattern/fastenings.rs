//! Fastenings: buttons with their buttonholes, and zips.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, words};

/// Range of the diameter of a button, metres.
pub const BUTTON_DIAMETERS: std::ops::RangeInclusive<f64> = 0.003..=0.08;
/// Share of a zip below which it counts as closed, or above the rest of which as wide open.
const NEARLY: f64 = 1e-3;

/// A point of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PiecePoint {
    /// The piece.
    pub piece: PieceId,
    /// The point, metres in the piece's own plane.
    pub at: DVec2,
}

/// A button, and the buttonhole through which it goes. Snaps, hooks and laces fasten alike.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Button {
    /// Where the button is sewn on.
    pub button: PiecePoint,
    /// Where the buttonhole is.
    pub hole: PiecePoint,
    /// Diameter of the button, metres, within [`BUTTON_DIAMETERS`].
    pub diameter: f64,
    /// Colour of the button, sRGB.
    pub colour: [u8; 3],
    /// Whether it is a tack instead: a few stitches, not seen, that hold the place called `hole` in front of the other. What is only
    /// tacked on, as a bow is, need not go round the body.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub tack: bool,
    /// Whether it is unfastened.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub open: bool,
}

impl Button {
    /// Diameter of the button of a shirt, metres.
    pub const SHIRT: f64 = 0.011;
    /// Colour of mother of pearl, sRGB.
    pub const PEARL: [u8; 3] = [236, 232, 222];

    /// A tack that holds `on`, of a part tacked on, in front of the place `at`.
    pub fn tack(at: PiecePoint, on: PiecePoint) -> Self {
        Self { button: at, hole: on, diameter: Self::SHIRT, colour: Self::PEARL, tack: true, open: false }
    }

    /// The pieces that it joins.
    pub fn pieces(&self) -> [PieceId; 2] {
        [self.button.piece, self.hole.piece]
    }

    /// What is out of range, in words.
    pub fn problem(&self) -> Option<Words> {
        let (least, most) = (BUTTON_DIAMETERS.start(), BUTTON_DIAMETERS.end());
        (!BUTTON_DIAMETERS.contains(&self.diameter)).then(|| {
            words!(
                "a button measures {least} to {most} m, not {diameter}",
                least,
                most,
                diameter = self.diameter
            )
        })
    }
}

/// A zip along a seam. Its open part is not sewn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Zip {
    /// Share of the seam's length that is open, 0..=1.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub open: f64,
    /// Whether it opens from the end of the seam's first side, not from its start.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub from_end: bool,
    /// Colour of the teeth, sRGB.
    pub colour: [u8; 3],
}

impl Zip {
    /// Colour of brass, sRGB.
    pub const BRASS: [u8; 3] = [188, 158, 96];
    /// The zip that a seam is given first.
    pub const CLOSED: Self = Self { open: 0.0, from_end: false, colour: Self::BRASS };

    /// The closed part of the seam's first side, from and to as shares of its length; None where all of it is open.
    pub fn closed(&self) -> Option<[f64; 2]> {
        if self.open >= 1.0 - NEARLY {
            return None;
        }
        let open = if self.open <= NEARLY { 0.0 } else { self.open };
        Some(if self.from_end { [0.0, 1.0 - open] } else { [open, 1.0] })
    }

    /// What is out of range, in words.
    pub fn problem(&self) -> Option<Words> {
        (!(0.0..=1.0).contains(&self.open))
            .then(|| words!("the open share of a zip is 0 to 1, not {open}", open = self.open))
    }
}

fn is_zero(x: &f64) -> bool {
    *x == 0.0
}
