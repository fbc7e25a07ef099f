//! Patterns as DXF in the layers of AAMA-292 and ASTM D6673: one block a piece.
//!
//! | layer | holds |
//! | --- | --- |
//! | 1 | the line it is cut on; where there is no layer 14, the only line there is |
//! | 14 | the line it is sewn on (in Valentina's AAMA files on layer 8) |
//! | 2, 3 | corners, points of curves; a point on both is an end of an edge where the line runs on smoothly |
//! | 4, 80–83 | notches |
//! | 7 | grainline |
//! | 8, 6 | internal lines, mirror line |
//! | 11 | cut-outs |
//! | 84–87 | copies for checking; not read |
//!
//! Curves are polylines there. They come in as curves fitted between corners (see `io::trace::fit`).
//! The files hold neither seams nor places round the body.

mod clean;
mod drawn;
mod pieces;
mod read;
mod units;
mod write;

pub use clean::looks_like;
pub use read::read;
pub use write::write;

/// Layers by number.
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
    /// Lines that people draw and machines do not use.
    pub const OTHERS: [u32; 3] = [5, 9, 10];
    /// Other shapes of notches.
    pub const NOTCHES: std::ops::RangeInclusive<u32> = 80..=83;
    /// Copies for checking.
    pub const COPIES: std::ops::RangeInclusive<u32> = 84..=87;
}
