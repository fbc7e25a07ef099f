//! A seam joins two edges.

use serde::{Deserialize, Serialize};

use crate::geometry::ids::PieceId;

/// An edge of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct EdgeRef {
    /// The piece.
    pub piece: PieceId,
    /// Index into its outline.
    pub edge: usize,
}

/// Two edges sewn together along their whole length, points paired by arc-length fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Seam {
    /// The two sides.
    pub sides: [EdgeRef; 2],
    /// False: the start of one meets the end of the other (fronts on one side). True: start meets start.
    pub same_direction: bool,
}
