//! The files to cut from.

use glam::DVec2;

use crate::io::pdf::{self, Paper, PdfError};
use crate::io::{ClothSheet, dxf, svg};
use crate::marker::layout::Marker;

/// A file format of markers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkerFormat {
    /// Scalable Vector Graphics.
    Svg,
    /// DXF in the layers of AAMA-292 and ASTM D6673.
    Dxf,
    /// PDF at true size.
    Pdf,
}

impl MarkerFormat {
    /// All formats, in the order of file dialogs.
    pub const ALL: [Self; 3] = [Self::Pdf, Self::Svg, Self::Dxf];

    /// The extension of the format's file names, without the dot.
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Dxf => "dxf",
            Self::Pdf => "pdf",
        }
    }

    /// The format whose extension is `ending`, in small or capital letters.
    pub fn of_ending(ending: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.ending().eq_ignore_ascii_case(ending))
    }
}

/// The marker as a file, titled `name`, with `words` below the cloth. `paper` is for PDF only.
///
/// # Errors
/// Why no PDF can be made of it.
pub fn write(
    format: MarkerFormat,
    marker: &Marker,
    name: &str,
    words: &[String],
    paper: Paper,
) -> Result<Vec<u8>, PdfError> {
    let pattern = marker.pattern();
    let sized = pattern.pieces.keys().zip(&marker.placed).filter(|(_, placed)| !placed.size.is_empty());
    let cloth = ClothSheet {
        size: DVec2::new(marker.length, marker.order.width),
        words: words.to_vec(),
        sizes: sized.map(|(&id, placed)| (id, placed.size.clone())).collect(),
    };
    Ok(match format {
        MarkerFormat::Svg => svg::write_on(&pattern, Some(&cloth)).bytes,
        MarkerFormat::Dxf => dxf::write_on(&pattern, Some(&cloth)).bytes,
        MarkerFormat::Pdf => pdf::write_on(&pattern, name, paper, Some(&cloth))?.bytes,
    })
}
