//! Patterns as SVG: one unit is one millimetre, y down, a layer for each kind of line.
//!
//! Files of this program give the kind of each line and its piece in `data-` attributes and are read by these. In other files, a
//! closed line inside no other is a piece. A closed line inside it and near it all round is its seam line, and the outer line is
//! then its cut line. Another closed part of the same path is a hole; everything else inside is an internal line. The files hold
//! neither seams nor placements on the body.

mod clean;
mod line;
mod pieces;
mod read;
mod write;

pub use read::read;
pub use write::{write, write_on};

/// Attribute of the root element that marks files of this program.
const OURS: &str = "data-toile";
/// Attribute: the kind of a line, one of those in `write::LAYERS`.
const KIND: &str = "data-kind";
/// Attribute: the number of the piece that a line belongs to.
const PIECE: &str = "data-piece";
/// Attribute: the name of the piece or of the internal line.
const NAME: &str = "data-name";
/// Attribute: the number of edges of a line.
const EDGES: &str = "data-edges";
/// Attribute: indices of the edges at whose start the line runs on smoothly.
const SMOOTH: &str = "data-smooth";
