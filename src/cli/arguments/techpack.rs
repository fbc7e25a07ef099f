//! Arguments of `toile techpack`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::arguments::marker::width;
use crate::io::scale::DrawingUnit;

/// Writes the tech pack: what a garment maker needs to know, as PDF on A4 pages
///
/// Pictures of the dressed garment from both sides, cloths and colours, how much of each cloth is needed (in every size of a graded
/// pattern), girths and ease, the piece list, what is worked on the pieces, what is bought, the seams, measures in every size,
/// colourways, and the pieces drawn to scale. Of a project that is not dressed, or without a graphics adapter, it has the flat
/// pieces in place of the pictures. The same input gives the same bits.
#[derive(Debug, Args)]
pub struct TechPack {
    /// Project, pattern or sample (sample:NAME)
    pub project: PathBuf,
    /// The file to write; its name ends in .pdf
    #[arg(short, long, visible_alias = "out", value_name = "FILE")]
    pub output: PathBuf,
    /// Width of the cloth that can be used, without its selvedges, metres
    #[arg(long, value_name = "METRES", value_parser = width, default_value = "1.5")]
    pub width: f64,
    /// The cloth has a nap or a one-way print: all pieces point the same way
    #[arg(long)]
    pub nap: bool,
    /// How long to look for short layouts of the pieces on the cloths, all together: what a usual processor does in these seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 5.0)]
    pub seconds: f64,
    /// Another seed finds other layouts
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The language of the pages: en, de, or that of a table beside the preferences (toile help install)
    #[arg(long, value_name = "CODE", default_value = "en")]
    pub language: String,
    /// Leaves out the pictures
    #[arg(long)]
    pub no_picture: bool,
    /// The unit of a DXF or SVG pattern: mm, cm, m, in, px, px90 or pt
    #[arg(long, value_name = "UNIT")]
    pub scale: Option<DrawingUnit>,
    /// Prints all that is in it, in English
    #[arg(long)]
    pub json: bool,
    /// Number of threads; the result is the same
    #[arg(long)]
    pub threads: Option<usize>,
}
