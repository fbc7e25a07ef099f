//! The result of reading a pattern file: the pattern, or an error.

use crate::io::garmentcode::GarmentCodeError;
use crate::io::scale::ScaleQuestion;
use crate::pattern::Pattern;

/// A pattern read from a file, and notes for the user about how it was read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadPattern {
    /// Pieces and seams, arranged in the pattern plane.
    pub pattern: Pattern,
    /// Notes for the user, one line each.
    pub notes: Vec<String>,
}

/// Why a file cannot be read as a pattern.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PatternFileError {
    /// A part of the file is faulty.
    #[error("{place}: {words}")]
    Bad {
        /// The position in the file: "line 12", "/pattern/panels", or the id of an element.
        place: String,
        /// The reason.
        words: String,
    },
    /// The file as a whole is faulty.
    #[error("{0}")]
    Whole(String),
    /// The file exceeds one of the [`Limits`](crate::io::Limits); the text names it.
    #[error("{0}")]
    OverLimit(String),
    /// The file does not state its unit of length, or states an unlikely one; the user has to choose.
    #[error("{0}")]
    Scale(ScaleQuestion),
}

impl PatternFileError {
    pub(super) fn bad(place: impl ToString, words: impl ToString) -> Self {
        Self::Bad { place: place.to_string(), words: words.to_string() }
    }
}

impl From<GarmentCodeError> for PatternFileError {
    fn from(error: GarmentCodeError) -> Self {
        match error {
            GarmentCodeError::Json(error) => Self::Whole(error.to_string()),
            error @ GarmentCodeError::OverLimit { .. } => Self::OverLimit(error.to_string()),
        }
    }
}
