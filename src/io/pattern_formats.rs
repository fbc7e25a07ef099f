//! The formats of pattern files: add one here. Menus, command line and file dialogs list them from [`PatternFormat::ALL`].

use crate::geometry::words::{Words, words};
use crate::io::pattern_file::{PatternFileError, ReadPattern};
use crate::io::pdf::{Paper, PdfError};
use crate::io::scale::DrawingUnit;
use crate::io::words::any_of;
use crate::io::{Limits, Written, dxf, garmentcode, pdf, rul, svg};
use crate::pattern::Pattern;

/// A file format of patterns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatternFormat {
    /// PDF for printing at true size; it is written only.
    Pdf,
    /// Scalable Vector Graphics.
    Svg,
    /// DXF in the layers of AAMA-292 and ASTM D6673.
    Dxf,
    /// JSON of GarmentCode and of the Garment Pattern Generator.
    GarmentCode,
}

impl PatternFormat {
    /// All formats, in the order of file dialogs.
    pub const ALL: [Self; 4] = [Self::Pdf, Self::Svg, Self::Dxf, Self::GarmentCode];

    /// The extension of the format's file names, without the dot.
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Pdf => "pdf",
            Self::Svg => "svg",
            Self::Dxf => "dxf",
            Self::GarmentCode => "json",
        }
    }

    /// Whether files of this format can be read; all can be written.
    pub const fn is_read(self) -> bool {
        match self {
            Self::Pdf => false,
            Self::Svg | Self::Dxf | Self::GarmentCode => true,
        }
    }

    /// The format whose extension is `ending`, in small or capital letters.
    pub fn of_ending(ending: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.ending().eq_ignore_ascii_case(ending))
    }
}

/// The extensions of `formats` in words: ".svg, .dxf or .json".
pub fn endings(formats: impl IntoIterator<Item = PatternFormat>) -> Words {
    any_of(formats.into_iter().map(PatternFormat::ending))
}

/// The format that `bytes` seem to be in, by their beginning; None for anything else, such as a mesh.
pub fn format(bytes: &[u8]) -> Option<PatternFormat> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = bytes.trim_ascii_start();
    if text.starts_with(b"%PDF-") {
        return Some(PatternFormat::Pdf);
    }
    if dxf::looks_like(bytes) {
        return Some(PatternFormat::Dxf);
    }
    match text.first()? {
        b'<' => Some(PatternFormat::Svg),
        b'{' | b'[' | b'"' => Some(PatternFormat::GarmentCode),
        // GarmentCode's JSON may begin with a comment in its oldest dialect.
        b'/' if text.starts_with(b"//") || text.starts_with(b"/*") => Some(PatternFormat::GarmentCode),
        // Compressed SVG (SVGZ).
        0x1f if text.starts_with(b"\x1f\x8b") => Some(PatternFormat::Svg),
        _ => None,
    }
}

/// Reads a pattern of any format. `unit`, if given, is the length of a drawing unit and overrides what the file states.
///
/// # Errors
/// What is wrong with the file and where, or a question when the unit of length is not known.
pub fn read(bytes: &[u8], unit: Option<DrawingUnit>) -> Result<ReadPattern, PatternFileError> {
    read_with_rules(bytes, unit, None)
}

/// Reads a pattern like [`read`], with the bytes of the grade rule table beside it; formats other than DXF have none.
///
/// # Errors
/// As for [`read`]; what is wrong with the rule table says so.
pub fn read_with_rules(
    bytes: &[u8],
    unit: Option<DrawingUnit>,
    rules: Option<&[u8]>,
) -> Result<ReadPattern, PatternFileError> {
    let limits = Limits::default();
    if bytes.len() > limits.file_bytes {
        let (count, most) = (bytes.len(), limits.file_bytes);
        let words = words!("the file has {count} bytes; {most} are allowed", count, most);
        return Err(PatternFileError::OverLimit(words));
    }
    let mut read = match format(bytes) {
        Some(PatternFormat::Dxf) => {
            let in_table = |error: PatternFileError| match error {
                PatternFileError::OverLimit(words) => PatternFileError::OverLimit(words),
                error => PatternFileError::bad(words!("the rule table beside it"), error.words()),
            };
            let rules = rules.map(rul::read).transpose().map_err(in_table)?;
            dxf::read_with_rules(bytes, unit, rules.as_ref())?
        }
        Some(PatternFormat::Svg) => svg::read(bytes, unit)?,
        Some(PatternFormat::Pdf) => {
            let formats = PatternFormat::ALL.into_iter().filter(|format| format.is_read());
            let endings = endings(formats);
            let words = words!("a PDF is for printing and is not read: {endings} are", endings);
            return Err(PatternFileError::Whole(words));
        }
        None if bytes.contains(&0) => {
            let formats = PatternFormat::ALL.into_iter().filter(|format| format.is_read());
            let endings = endings(formats);
            let words = words!("this is a binary file, no pattern: {endings} are text", endings);
            return Err(PatternFileError::Whole(words));
        }
        Some(PatternFormat::GarmentCode) | None => {
            ReadPattern { pattern: garmentcode::read(bytes)?, notes: Vec::new() }
        }
    };
    // No format tells which seams are gathers, so each seam keeps the ratio of its lengths when edited.
    read.pattern.keep_ratios();
    Ok(read)
}

/// Writes `pattern`, titled `name`, in `format`. `paper` is for PDF only.
///
/// # Errors
/// Why no PDF can be made of the pattern.
pub fn write(
    format: PatternFormat,
    pattern: &Pattern,
    name: &str,
    paper: Paper,
) -> Result<Written, PdfError> {
    match format {
        PatternFormat::Pdf => pdf::write(pattern, name, paper),
        PatternFormat::Svg => Ok(svg::write(pattern)),
        PatternFormat::Dxf => Ok(dxf::write(pattern)),
        PatternFormat::GarmentCode => Ok(garmentcode::write(pattern)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_format_that_is_read_knows_what_it_wrote() {
        let mut pattern = Pattern::default();
        let corners = [(0.0, 0.0), (0.3, 0.0), (0.3, 0.2), (0.0, 0.2)].map(glam::DVec2::from);
        pattern.add_piece(crate::pattern::Piece::polygon("front", &corners));
        for one in PatternFormat::ALL {
            let written = write(one, &pattern, "front", Paper::A4).expect("a small pattern");
            assert_eq!(PatternFormat::of_ending(&one.ending().to_uppercase()), Some(one));
            assert_eq!(format(&written.bytes), Some(one));
            if !one.is_read() {
                let why = read(&written.bytes, None).expect_err("not read").to_string();
                assert!(why.contains(".svg, .dxf or .json"), "{why}");
            } else {
                assert_eq!(
                    read(&written.bytes, None).map(|read| read.pattern.pieces.len()),
                    Ok(1),
                    "{one:?}"
                );
            }
        }
        let read: Vec<_> = PatternFormat::ALL.into_iter().filter(|format| format.is_read()).collect();
        assert_eq!(endings(read), ".svg, .dxf or .json");
    }
}
