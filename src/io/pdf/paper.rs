//! Paper sizes, and how a sheet is divided into pages.

use std::fmt;
use std::str::FromStr;

use glam::DVec2;
use serde::{Deserialize, Serialize};

/// Blank margin of a page, millimetres: printers do not reach the edge.
pub const MARGIN: f64 = 10.0;
/// Width of the strip that neighbouring pages both show, millimetres.
pub const OVERLAP: f64 = 10.0;

/// The paper that a pattern is printed on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Paper {
    /// Pages of 210 × 297 mm, to be glued together.
    #[default]
    A4,
    /// Pages of 8.5 × 11 inches, to be glued together.
    Letter,
    /// One page as large as the pattern, for a plotter or a copy shop.
    One,
}

impl Paper {
    /// All choices of paper.
    pub const ALL: [Self; 3] = [Self::A4, Self::Letter, Self::One];

    /// Width and height of a page, millimetres; None where the pattern decides.
    pub fn size(self) -> Option<DVec2> {
        match self {
            Self::A4 => Some(DVec2::new(210.0, 297.0)),
            Self::Letter => Some(DVec2::new(215.9, 279.4)),
            Self::One => None,
        }
    }
}

impl fmt::Display for Paper {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::A4 => "a4",
            Self::Letter => "letter",
            Self::One => "one",
        })
    }
}

impl FromStr for Paper {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|paper| paper.to_string() == text.to_ascii_lowercase());
        found.ok_or_else(|| format!("{text:?} is none of a4, letter, one"))
    }
}

/// One page of a tiled sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tile {
    /// Row from the top, from 0.
    pub row: usize,
    /// Column from the left, from 0.
    pub column: usize,
    /// Its upper left corner on the sheet, millimetres.
    pub from: DVec2,
}

impl Tile {
    /// The page's name: a letter for the row and a number for the column, such as "B3" for the second row and third column.
    pub fn name(&self) -> String {
        let mut letters = String::new();
        let mut row = self.row + 1;
        while row > 0 {
            letters.insert(0, char::from(b'A' + ((row - 1) % 26) as u8));
            row = (row - 1) / 26;
        }
        format!("{letters}{}", self.column + 1)
    }
}

/// The division of a sheet into pages that overlap.
#[derive(Clone, Debug)]
pub struct Tiling {
    /// Width and height of the part of the sheet that one page shows, millimetres.
    pub frame: DVec2,
    /// Number of rows of pages.
    pub rows: usize,
    pub columns: usize,
    /// The pages, row by row; pages that no piece reaches are left out.
    pub tiles: Vec<Tile>,
}

impl Tiling {
    /// Divides a sheet of `size` into pages of `paper`, both in millimetres. `boxes` are the bounding boxes of the pieces.
    pub fn new(size: DVec2, paper: DVec2, boxes: &[[DVec2; 2]]) -> Self {
        let frame = paper - DVec2::splat(2.0 * MARGIN);
        let step = frame - DVec2::splat(OVERLAP);
        let count = |length: f64, step: f64| (((length - OVERLAP) / step).ceil() as usize).max(1);
        let (columns, rows) = (count(size.x, step.x), count(size.y, step.y));
        let mut tiles = Vec::new();
        for row in 0..rows {
            for column in 0..columns {
                let from = DVec2::new(column as f64, row as f64) * step;
                let reaches =
                    |[lower, upper]: &[DVec2; 2]| (lower.cmplt(from + frame) & upper.cmpgt(from)).all();
                if boxes.iter().any(reaches) {
                    tiles.push(Tile { row, column, from });
                }
            }
        }
        Self { frame, rows, columns, tiles }
    }

    /// Width and height of all pages glued together, millimetres.
    pub fn whole(&self) -> DVec2 {
        let step = self.frame - DVec2::splat(OVERLAP);
        DVec2::new(self.columns as f64, self.rows as f64) * step + DVec2::splat(OVERLAP)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_cover_the_sheet_and_overlap() {
        let size = DVec2::new(800.0, 600.0);
        let tiling = Tiling::new(size, DVec2::new(210.0, 297.0), &[[DVec2::ZERO, size]]);
        assert_eq!((tiling.rows, tiling.columns, tiling.tiles.len()), (3, 5, 15));
        assert!(tiling.whole().cmpge(size).all());
        assert_eq!(tiling.tiles[7].name(), "B3");
        let next = tiling.tiles[1].from.x - tiling.tiles[0].from.x;
        assert_eq!(next, tiling.frame.x - OVERLAP);
        let corner = [DVec2::ZERO, DVec2::splat(100.0)];
        assert_eq!(
            Tiling::new(size, DVec2::new(210.0, 297.0), &[corner]).tiles.len(),
            1,
            "the rest is empty"
        );
        assert_eq!(Tile { row: 27, column: 0, from: DVec2::ZERO }.name(), "AB1");
    }
}
