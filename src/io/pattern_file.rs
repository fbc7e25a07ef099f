//! What a file of a pattern gives: the pattern, or why there is none.

use crate::io::garmentcode::GarmentCodeError;
use crate::io::scale::ScaleQuestion;
use crate::pattern::Pattern;

/// A pattern, and what a person should know about how it was read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadPattern {
    /// Pieces and seams, laid out.
    pub pattern: Pattern,
    /// A line each.
    pub notes: Vec<String>,
}

/// Why a file gives no pattern.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PatternFileError {
    /// Something in it is wrong.
    #[error("{place}: {words}")]
    Bad {
        /// "line 12", "/pattern/panels", the id of an element.
        place: String,
        /// The reason.
        words: String,
    },
    /// The whole of it is wrong.
    #[error("{0}")]
    Whole(String),
    /// More than [`Limits`](crate::io::Limits) allows.
    #[error("{0}")]
    OverLimit(String),
    /// It does not say how large it is.
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
