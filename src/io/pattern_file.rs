//! The result of reading a pattern file: the pattern, or an error.

use crate::geometry::words::Words;
use crate::io::garmentcode::GarmentCodeError;
use crate::io::scale::ScaleQuestion;
use crate::pattern::Pattern;

/// A pattern read from a file, and notes for the user about how it was read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadPattern {
    /// Pieces and seams, arranged in the pattern plane.
    pub pattern: Pattern,
    /// Notes for the user, one line each.
    pub notes: Vec<Words>,
}

/// Why a file cannot be read as a pattern.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.words())]
pub enum PatternFileError {
    /// A part of the file is faulty.
    Bad {
        /// The position in the file: "line 12", "/pattern/panels", or the id of an element.
        place: Words,
        /// The reason.
        words: Words,
    },
    /// The file as a whole is faulty.
    Whole(Words),
    /// The file exceeds one of the [`Limits`](crate::io::Limits); the text names it.
    OverLimit(Words),
    /// The file does not state its unit of length, or states an unlikely one; the user has to choose.
    Scale(ScaleQuestion),
}

impl PatternFileError {
    pub(super) fn bad(place: Words, words: Words) -> Self {
        Self::Bad { place, words }
    }

    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::Bad { place, words } => place.clone().and(": ", words.clone()),
            Self::Whole(words) | Self::OverLimit(words) => words.clone(),
            Self::Scale(question) => question.words(),
        }
    }
}

impl From<GarmentCodeError> for PatternFileError {
    fn from(error: GarmentCodeError) -> Self {
        match error {
            GarmentCodeError::Json(error) => Self::Whole(error.words()),
            error @ GarmentCodeError::OverLimit { .. } => Self::OverLimit(error.words()),
        }
    }
}
