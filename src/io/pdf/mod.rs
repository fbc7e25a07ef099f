//! Patterns as PDF at true size: on one page, or on pages of a printer's paper to be glued together.
//!
//! The first page of several is an overview: how the pages lie, and a square of 50 mm to measure before cutting.
//!
//! `booklet` writes pages of words, lines and pictures that others lay out.

pub mod booklet;
mod draw;
mod paper;

use glam::DVec2;
use krilla::Document;
use krilla::metadata::Metadata;
use krilla::page::PageSettings;

use crate::geometry::words::{Words, words};
use crate::io::trace::{self, Traced};
use crate::io::written::{self, Part};
use crate::io::{ClothSheet, Written};
use crate::pattern::Pattern;
use draw::{Canvas, Pens};
pub use paper::Paper;
use paper::{MARGIN, Tiling};

/// Parts of a pattern that paper can show or that a person who cuts it does not need; the others are reported as left out.
const HOLDS: [Part; 14] = [
    Part::Curves,
    Part::SmoothPoints,
    Part::EdgeNames,
    Part::Holes,
    Part::Lines,
    Part::LineNames,
    Part::Notches,
    Part::Grainline,
    Part::Allowance,
    Part::CutLine,
    Part::Symmetry,
    Part::Twin,
    Part::Placement,
    Part::PlaceOnBody,
];
/// Side of the test square for checking the printed scale, millimetres.
const SQUARE: f64 = 50.0;
/// Height of the strip under the pieces of a single page, for the test square and its text, millimetres.
const FOOT: f64 = 75.0;
/// Longest side of a PDF page, millimetres: 14400 points.
const LARGEST_PAGE: f64 = 14_400.0 / POINTS;
/// Length of cloth up to which a marker is printed on one page, and of the pages of a longer one, millimetres.
const LONGEST_CLOTH: f64 = 5000.0;
/// Points in a millimetre.
const POINTS: f64 = 72.0 / 25.4;

/// Why there is no PDF.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub enum PdfError {
    /// The pattern has no pieces.
    Empty,
    /// The pattern does not fit a single PDF page.
    TooLarge {
        /// Width of the page that would be needed, millimetres.
        width: u64,
        /// Height of the page that would be needed, millimetres.
        height: u64,
        /// Longest side of a PDF page, millimetres.
        most: u64,
    },
    /// The pattern would take more than `MOST_PAGES` pages; their number.
    TooManyPages(usize),
    /// The PDF library failed.
    Library(String),
}

impl PdfError {
    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::Empty => words!("the pattern has no pieces"),
            Self::TooLarge { width, height, most } => words!(
                "one page would be {width} × {height} mm, and a PDF page is at most {most} mm long; print on A4 or Letter",
                width,
                height,
                most
            ),
            Self::TooManyPages(n) => words!(
                "it would take {n} pages; {most} are allowed: check the size of the pattern",
                n,
                most = MOST_PAGES
            ),
            Self::Library(why) => words!("the PDF could not be made: {why}", why),
        }
    }
}

const MOST_PAGES: usize = 2000;

/// Writes the pieces at their positions in the pattern plane, titled `name`.
///
/// # Errors
/// See [`PdfError`].
pub fn write(pattern: &Pattern, name: &str, paper: Paper) -> Result<Written, PdfError> {
    write_on(pattern, name, paper, None)
}

/// Writes the pieces like [`write`], on `cloth` if there is one. A cloth longer than a PDF page is printed on several.
///
/// # Errors
/// See [`PdfError`].
pub fn write_on(
    pattern: &Pattern,
    name: &str,
    paper: Paper,
    cloth: Option<&ClothSheet>,
) -> Result<Written, PdfError> {
    let pieces: Vec<Traced> = pattern.pieces.values().map(|piece| trace::on_table(piece)).collect();
    if pieces.is_empty() {
        return Err(PdfError::Empty);
    }
    let (mut document, pens) = (titled(name), pens()?);
    let sheet = Sheet::new(&pieces, cloth);
    match paper.size() {
        None if cloth.is_some_and(|cloth| cloth.size.x * 1000.0 > LONGEST_CLOTH) => {
            sheet.tiles(
                &mut document,
                &pens,
                name,
                DVec2::new(LONGEST_CLOTH, sheet.size.y + 2.0 * MARGIN),
            )?;
        }
        None => sheet.one_page(&mut document, &pens, name)?,
        Some(size) => sheet.tiles(&mut document, &pens, name, size)?,
    }
    let bytes = document.finish().map_err(|e| PdfError::Library(format!("{e:?}")))?;
    Ok(Written { bytes, left_out: written::left_out(pattern, &HOLDS), rules: None })
}

/// All pieces with their bounding boxes, in millimetres with y down from the upper left corner of all.
struct Sheet<'a> {
    pieces: Vec<(&'a Traced, [DVec2; 2])>,
    /// The upper left corner in the pattern plane, millimetres with y up; it becomes the origin.
    corner: DVec2,
    size: DVec2,
    cloth: Option<&'a ClothSheet>,
}

impl<'a> Sheet<'a> {
    fn new(pieces: &'a [Traced], cloth: Option<&'a ClothSheet>) -> Self {
        let around = |piece: &Traced| {
            let [lower, upper] = piece.bounds().map(|p| p * 1000.0);
            [lower - DVec2::ONE, upper + DVec2::ONE]
        };
        let boxes: Vec<[DVec2; 2]> = pieces.iter().map(around).collect();
        let drawn = || {
            boxes.iter().copied().chain(cloth.map(|cloth| [DVec2::NEG_ONE, cloth.size * 1000.0 + DVec2::ONE]))
        };
        let lower = drawn().map(|b| b[0]).reduce(DVec2::min).unwrap_or_default();
        let upper = drawn().map(|b| b[1]).reduce(DVec2::max).unwrap_or_default();
        let corner = DVec2::new(lower.x, upper.y);
        let down = |p: DVec2| DVec2::new(p.x - corner.x, corner.y - p.y);
        let on_sheet = boxes.iter().map(|[lo, hi]| {
            let (a, b) = (down(*lo), down(*hi));
            [a.min(b), a.max(b)]
        });
        Self { pieces: pieces.iter().zip(on_sheet).collect(), corner, size: upper - lower, cloth }
    }

    /// Draws the pieces that reach into the rectangle from `from` to `to` of the sheet, whose corner comes to `at` on the page.
    fn draw(&self, canvas: &mut Canvas<'_, '_>, [from, to]: [DVec2; 2], at: DVec2) {
        canvas.shift = DVec2::new(self.corner.x, self.corner.y) + DVec2::new(from.x - at.x, at.y - from.y);
        if let Some(cloth) = self.cloth {
            canvas.cloth(cloth);
        }
        for (piece, [lower, upper]) in &self.pieces {
            if (lower.cmple(to) & upper.cmpge(from)).all() {
                canvas.piece(piece);
            }
        }
    }

    fn one_page(&self, document: &mut Document, pens: &Pens, name: &str) -> Result<(), PdfError> {
        let size = self.size + DVec2::new(2.0 * MARGIN, 2.0 * MARGIN + FOOT);
        let size = size.max(DVec2::new(120.0, 0.0));
        if size.max_element() > LARGEST_PAGE {
            let [width, height] = [size.x, size.y].map(|mm| mm.ceil() as u64);
            return Err(PdfError::TooLarge { width, height, most: LARGEST_PAGE as u64 });
        }
        let mut page = document.start_page_with(settings(size)?);
        let mut surface = page.surface();
        let mut canvas = Canvas::new(&mut surface, pens);
        self.draw(&mut canvas, [DVec2::ZERO, self.size], DVec2::splat(MARGIN));
        let foot = DVec2::new(MARGIN, size.y - MARGIN - SQUARE);
        canvas.test_square(foot, SQUARE);
        let beside = foot + DVec2::new(SQUARE + 6.0, 24.0);
        canvas.text(beside, 5.0, name);
        for (i, words) in self.words().iter().enumerate() {
            canvas.text(beside + DVec2::Y * 7.0 * (i + 1) as f64, 5.0, words);
        }
        Ok(())
    }

    /// What is told about the cloth.
    fn words(&self) -> &[String] {
        self.cloth.map_or(&[], |cloth| &cloth.words)
    }

    fn tiles(&self, document: &mut Document, pens: &Pens, name: &str, paper: DVec2) -> Result<(), PdfError> {
        let boxes: Vec<[DVec2; 2]> = self.pieces.iter().map(|(_, b)| *b).collect();
        let tiling = Tiling::new(self.size, paper, &boxes);
        if tiling.tiles.len() > MOST_PAGES {
            return Err(PdfError::TooManyPages(tiling.tiles.len()));
        }
        let mut page = document.start_page_with(settings(paper)?);
        let mut surface = page.surface();
        self.overview(&mut Canvas::new(&mut surface, pens), name, paper, &tiling);
        surface.finish();
        page.finish();
        for (i, tile) in tiling.tiles.iter().enumerate() {
            let mut page = document.start_page_with(settings(paper)?);
            let mut surface = page.surface();
            let mut canvas = Canvas::new(&mut surface, pens);
            let corner = DVec2::splat(MARGIN);
            canvas.clip([corner, corner + tiling.frame]);
            self.draw(&mut canvas, [tile.from, tile.from + tiling.frame], corner);
            canvas.unclip();
            let words = format!("{name}: page {} of {}", i + 1, tiling.tiles.len());
            canvas.page_marks(tile, &tiling, &words);
        }
        Ok(())
    }

    /// Draws the overview page: how the pages lie, at a reduced scale, and the test square.
    fn overview(&self, canvas: &mut Canvas<'_, '_>, name: &str, paper: DVec2, tiling: &Tiling) {
        let left = MARGIN + 5.0;
        canvas.text(DVec2::new(left, MARGIN + 10.0), 7.0, name);
        let rows = tiling.tiles.len();
        let words = [
            format!("{rows} pages of {} by {} mm. Print at 100 %, not fitted to the page.", paper.x, paper.y),
            "Measure the square. Cut or fold along the frames, lay equal letters on each other, glue."
                .to_owned(),
            "Black: cut. Blue: sew. Grey: lines on the piece, and the way of the grain.".to_owned(),
        ];
        for (i, words) in words.iter().chain(self.words()).enumerate() {
            canvas.text(DVec2::new(left, MARGIN + 19.0 + 5.5 * i as f64), 3.5, words);
        }
        let below = MARGIN + 40.0 + 5.5 * self.words().len() as f64;
        canvas.test_square(DVec2::new(left, below), SQUARE);
        let room = [DVec2::new(left, below + 65.0), paper - DVec2::splat(MARGIN + 5.0)];
        let whole = tiling.whole();
        let scale = ((room[1] - room[0]) / whole).min_element().min(0.25);
        for tile in &tiling.tiles {
            let from = room[0] + tile.from * scale;
            canvas.frame([from, from + tiling.frame * scale]);
            canvas.grey_text(from + DVec2::new(1.0, 4.0), 3.0, &tile.name());
        }
        for (piece, _) in &self.pieces {
            canvas.miniature(piece, self.corner, room[0], scale);
        }
    }
}

/// A document without pages; there is no date in it, so that the same input gives the same bits.
fn titled(name: &str) -> Document {
    let mut document = Document::new();
    document.set_metadata(Metadata::new().title(name.to_owned()).creator("Toile".to_owned()));
    document
}

fn pens() -> Result<Pens, PdfError> {
    Pens::new().ok_or_else(|| PdfError::Library("its letters cannot be read".to_owned()))
}

fn settings(size: DVec2) -> Result<PageSettings, PdfError> {
    let [width, height] = [size.x, size.y].map(|mm| (mm * POINTS) as f32);
    PageSettings::from_wh(width, height).ok_or_else(|| PdfError::Library("a page without size".to_owned()))
}

#[cfg(test)]
mod tests;
