//! Problems of patterns and bodies that a person can fix.

use serde::{Deserialize, Serialize};

use crate::geometry::words::Words;

/// What kind of thing is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProblemKind {
    /// The outline crosses itself.
    SelfCrossing,
    /// A seam names a piece or edge that is not there.
    SeamToNothing,
    /// An edge is sewn twice.
    EdgeSewnTwice,
    /// A piece is sewn to nothing.
    PieceUnsewn,
    /// An edge or a piece has no length or area.
    ZeroLength,
    /// The two sides of a seam differ in length.
    UnequalSeam,
    /// The two sides of a seam differ in length, in the ratio that the seam keeps.
    Gather,
    /// A seam joins a front to a back.
    TwistedSeam,
    /// A piece could not be triangulated.
    NotTriangulated,
    /// A mark lies off its piece, or its number has no partner.
    Mark,
    /// A button or buttonhole lies off the cloth.
    Fastening,
    /// The body is open, non-manifold, inside out or crosses itself.
    Body,
    /// The wrap did not come out as a dressed garment.
    Dressing,
}

impl ProblemKind {
    /// Whether this kind is only a note, which does not make `check` fail.
    pub fn is_note(self) -> bool {
        matches!(self, Self::UnequalSeam | Self::Gather | Self::PieceUnsewn)
    }
}

/// One problem: its kind, its place, and a description.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Problem {
    /// The kind of problem.
    pub kind: ProblemKind,
    /// Piece, edge, seam or mark, by name and number.
    #[serde(rename = "where")]
    pub place: Words,
    /// What is wrong and what to do.
    pub words: Words,
}

impl Problem {
    /// Where and what: "PLACE: WORDS".
    pub fn in_words(&self) -> Words {
        self.place.clone().and(": ", self.words.clone())
    }
}
