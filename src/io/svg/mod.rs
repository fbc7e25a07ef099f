//! Patterns as SVG: one unit is one millimetre, y down, a layer for each kind of line.
//!
//! Files of this program name the kind of each line and its piece in `data-` attributes and are read by these. In others,
//! closed lines inside no other are pieces; a line inside one and near it all round is its seam line, and it the cut line;
//! another closed part of the same path is a hole; everything else inside is an internal line.
//! The files hold neither seams nor places round the body.

mod clean;
mod line;
mod pieces;
mod read;
mod write;

pub use read::read;
pub use write::write;

/// On the root of files of this program.
const OURS: &str = "data-toile";
/// What a line is.
const KIND: &str = "data-kind";
/// The number of the piece it belongs to.
const PIECE: &str = "data-piece";
/// The name of that piece.
const NAME: &str = "data-name";
/// How many edges the line has.
const EDGES: &str = "data-edges";
/// At which of them it runs on smoothly.
const SMOOTH: &str = "data-smooth";
