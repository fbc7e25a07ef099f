//! Arguments of `toile marker`.

use std::path::PathBuf;

use clap::Args;

use crate::io::pdf::Paper;
use crate::io::scale::DrawingUnit;
use crate::marker::Order;

/// Lays out all pieces of a pattern on a width of cloth, as short as it can, and writes what to cut from as .svg, .dxf or .pdf
///
/// Every piece is cut once for each garment, by its cutting line (seam allowance included), with its grainline along the cloth and
/// its front up. Prints the length of cloth, its yield (the share that is in pieces) and what a garment takes. The same input and
/// seed give the same bits on any machine.
#[derive(Debug, Args)]
pub struct Marker {
    /// Project, pattern or sample (sample:NAME)
    pub project: PathBuf,
    /// Width of the cloth that can be used, without its selvedges, metres
    #[arg(long, value_name = "METRES", value_parser = width)]
    pub width: f64,
    /// One garment of each of these sizes, with commas between; without sizes and quantities, one in the base size
    #[arg(long, value_name = "SIZES", value_delimiter = ',', conflicts_with = "quantity")]
    pub sizes: Vec<String>,
    /// So many garments of a size; can be repeated. N alone: of the base size, or of a pattern without sizes
    #[arg(long, value_name = "SIZE=N")]
    pub quantity: Vec<String>,
    /// Least distance between pieces, metres
    #[arg(long, value_name = "METRES", default_value_t = Order::default().gap)]
    pub gap: f64,
    /// The cloth has a nap or a one-way print: all pieces point the same way. Otherwise they may be turned by 180 degrees
    #[arg(long)]
    pub nap: bool,
    /// Pieces may also be tilted out of the grain by this many degrees, 0 to 45
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0)]
    pub tilt: f64,
    /// How long to look for a shorter layout: what a usual processor does in these seconds. It is counted, not timed, so that the
    /// result is the same on any machine
    #[arg(long, value_name = "SECONDS", default_value_t = Order::default().effort.seconds)]
    pub seconds: f64,
    /// Another seed finds another layout
    #[arg(long, default_value_t = Order::default().effort.seed)]
    pub seed: u64,
    /// The file to write; its ending gives the format
    #[arg(short, long, visible_alias = "out", value_name = "FILE")]
    pub output: PathBuf,
    /// The paper of a PDF: one large page, or a4 or letter, to be glued together
    #[arg(long, default_value = "one", value_name = "a4|letter|one")]
    pub paper: Paper,
    /// The unit of a DXF or SVG pattern: mm, cm, m, in, px, px90 or pt
    #[arg(long, value_name = "UNIT")]
    pub scale: Option<DrawingUnit>,
    /// Prints the report: length, yield, consumption, piece list, and where each piece lies
    #[arg(long)]
    pub json: bool,
    /// Number of threads; the result is the same
    #[arg(long)]
    pub threads: Option<usize>,
}

/// A width of cloth, metres.
pub fn width(text: &str) -> Result<f64, String> {
    let width = text.parse::<f64>().ok().filter(|width| *width > 0.0 && *width <= crate::marker::WIDEST);
    width.ok_or_else(|| {
        format!("{text:?} is no width of cloth: more than 0 and at most {} metres", crate::marker::WIDEST)
    })
}
