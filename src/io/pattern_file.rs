//! Patterns of every format: which one a file is in is told from its first bytes.

use crate::io::garmentcode::{self, GarmentCodeError};
use crate::io::scale::{DrawingUnit, ScaleQuestion};
use crate::io::{Limits, dxf, svg};
use crate::pattern::Pattern;

/// A format patterns come in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatternFormat {
    /// GarmentCode and Garment Pattern Generator.
    Json,
    /// DXF-AAMA and ASTM D6673.
    Dxf,
    /// Scalable Vector Graphics.
    Svg,
}

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
    /// More than [`Limits`] allows.
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

/// Which format `bytes` seem to be in. None for anything else, such as a mesh.
pub fn format(bytes: &[u8]) -> Option<PatternFormat> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = bytes.trim_ascii_start();
    if dxf::looks_like(bytes) {
        return Some(PatternFormat::Dxf);
    }
    match text.first()? {
        b'<' => Some(PatternFormat::Svg),
        b'{' | b'[' | b'"' => Some(PatternFormat::Json),
        // The oldest dialect of GarmentCode's JSON has comments.
        b'/' if text.starts_with(b"//") || text.starts_with(b"/*") => Some(PatternFormat::Json),
        // Zipped text: SVGZ.
        0x1f if text.starts_with(b"\x1f\x8b") => Some(PatternFormat::Svg),
        _ => None,
    }
}

/// Reads a pattern of any format. `unit` is what a unit of the drawing is, where it does not say so or says it wrongly.
///
/// # Errors
/// What is wrong with the file and where, or the question how large it is.
pub fn read(bytes: &[u8], unit: Option<DrawingUnit>) -> Result<ReadPattern, PatternFileError> {
    let limits = Limits::default();
    if bytes.len() > limits.file_bytes {
        let words = format!("the file has {} bytes; {} are allowed", bytes.len(), limits.file_bytes);
        return Err(PatternFileError::OverLimit(words));
    }
    let mut read = match format(bytes) {
        Some(PatternFormat::Dxf) => dxf::read(bytes, unit)?,
        Some(PatternFormat::Svg) => svg::read(bytes, unit)?,
        Some(PatternFormat::Json) | None => {
            ReadPattern { pattern: garmentcode::read(bytes)?, notes: Vec::new() }
        }
    };
    // No format tells which seams are gathers: editing keeps what is there.
    read.pattern.keep_ratios();
    Ok(read)
}
