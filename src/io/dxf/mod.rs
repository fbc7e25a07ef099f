//! Patterns as DXF in the layers of AAMA-292 and ASTM D6673: one block for each piece.
//!
//! | layer | holds |
//! | --- | --- |
//! | 1 | the cut line; where there is no layer 14, the only outline there is |
//! | 14 | the seam line (in Valentina's AAMA files on layer 8) |
//! | 2, 3 | corners, points of curves; a point on both is an end of an edge where the line runs on smoothly; texts "# 7" at points with a grade rule of that number in the table beside the file (`io::rul`) |
//! | 4, 80–83 | notches |
//! | 7 | grainline |
//! | 8, 6 | internal lines, mirror line |
//! | 11 | cut-outs |
//! | 84–87 | copies for checking; not read |
//!
//! DXF files of patterns hold curves as polylines. Reading fits curves between the corners (see `io::trace::fit`). The files hold
//! neither seams nor placements on the body.

mod clean;
mod drawn;
mod pieces;
mod read;
mod units;
mod write;

pub use clean::looks_like;
pub use read::{read, read_with_rules};
pub use write::{write, write_on};

/// Layer numbers of AAMA-292 and ASTM D6673.
mod layer {
    pub const BOUNDARY: u32 = 1;
    pub const CORNER: u32 = 2;
    pub const CURVE: u32 = 3;
    pub const NOTCH: u32 = 4;
    pub const MIRROR: u32 = 6;
    pub const GRAIN: u32 = 7;
    pub const INTERNAL: u32 = 8;
    pub const CUT_OUT: u32 = 11;
    pub const SEAM: u32 = 14;
    pub const ANNOTATION: u32 = 15;
    /// Further layers of internal lines: a line read from one is named after its layer and is written to it again.
    pub const OTHERS: [u32; 3] = [5, 9, 10];
    /// Layers of notches of other shapes than the plain one on layer 4.
    pub const NOTCHES: std::ops::RangeInclusive<u32> = 80..=83;
    /// Layers of copies of curves for checking; they are not read.
    pub const COPIES: std::ops::RangeInclusive<u32> = 84..=87;
}
