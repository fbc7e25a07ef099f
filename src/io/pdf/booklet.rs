//! Documents of A4 pages on which others lay out words, lines and pictures, and how wide words are.

use std::sync::Arc;

use ab_glyph::{Font, FontRef};
use glam::DVec2;
use image::RgbaImage;

use crate::io::pdf::draw::Canvas;
pub use crate::io::pdf::draw::Ink;
use crate::io::pdf::{MOST_PAGES, PdfError, pens, settings, titled};

/// Width and height of a page, millimetres.
pub const PAGE: DVec2 = DVec2::new(210.0, 297.0);

/// Something drawn on a page; positions are millimetres from its upper left corner, y down.
#[derive(Clone, Debug)]
pub enum Mark {
    /// Words in one line that begins at `at`, on their base line; `size` is the font size, millimetres.
    Words { at: DVec2, size: f64, words: String, ink: Ink },
    /// A line of `width` millimetres; `dash` holds the lengths of dashes and gaps, none for a whole line.
    Line { points: Vec<DVec2>, is_closed: bool, ink: Ink, width: f64, dash: &'static [f64] },
    /// What the points enclose, filled.
    Fill { points: Vec<DVec2>, ink: Ink },
    /// A picture from its upper left corner, in this size.
    Picture { picture: Arc<RgbaImage>, at: DVec2, size: DVec2 },
}

/// Writes `pages` as a document called `title`.
///
/// # Errors
/// More pages than a document may have, or the PDF library failed.
pub fn write(title: &str, pages: &[Vec<Mark>]) -> Result<Vec<u8>, PdfError> {
    if pages.len() > MOST_PAGES {
        return Err(PdfError::TooManyPages(pages.len()));
    }
    let (mut document, pens) = (titled(title), pens()?);
    for marks in pages {
        let mut page = document.start_page_with(settings(PAGE)?);
        let mut surface = page.surface();
        let mut canvas = Canvas::new(&mut surface, &pens);
        for mark in marks {
            draw(&mut canvas, mark);
        }
    }
    document.finish().map_err(|e| PdfError::Library(format!("{e:?}")))
}

fn draw(canvas: &mut Canvas<'_, '_>, mark: &Mark) {
    match mark {
        Mark::Words { at, size, words, ink } => canvas.words(*at, *size, words, *ink),
        Mark::Line { points, is_closed, ink, width, dash } => {
            canvas.polyline(points, *is_closed, *ink, *width, dash);
        }
        Mark::Fill { points, ink } => canvas.fill(points, *ink),
        Mark::Picture { picture, at, size } => canvas.picture(picture, *at, *size),
    }
}

/// The letters that words are written in.
#[derive(Debug)]
pub struct Letters {
    font: FontRef<'static>,
}

impl Letters {
    /// The built-in letters.
    ///
    /// # Errors
    /// They cannot be read.
    pub fn new() -> Result<Self, PdfError> {
        let font = FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT);
        font.map(|font| Self { font }).map_err(|why| PdfError::Library(why.to_string()))
    }

    /// Width of `words` in one line of font size `size`, in the unit of `size`; without kerning.
    pub fn width(&self, words: &str, size: f64) -> f64 {
        let em = f64::from(self.font.units_per_em().unwrap_or(1000.0));
        let advance = |c: char| f64::from(self.font.h_advance_unscaled(self.font.glyph_id(c)));
        words.chars().map(advance).sum::<f64>() * size / em
    }

    /// Whether there is a letter for every character of `words`; a box is drawn for each other.
    pub fn have(&self, words: &str) -> bool {
        words.chars().all(|c| c.is_control() || self.font.glyph_id(c).0 != 0)
    }

    /// `words`, or as much of their beginning as is at most `width` wide, with "…".
    pub fn cut(&self, words: &str, size: f64, width: f64) -> String {
        if self.width(words, size) <= width {
            return words.to_owned();
        }
        let mut kept = String::new();
        let mut left = width - self.width("…", size);
        for c in words.chars() {
            left -= self.width(c.encode_utf8(&mut [0; 4]), size);
            if left < 0.0 {
                break;
            }
            kept.push(c);
        }
        kept.truncate(kept.trim_end().len());
        kept + "…"
    }

    /// `words` in lines at most `width` wide, broken at spaces; a word that is wider by itself is broken anywhere.
    pub fn lines(&self, words: &str, size: f64, width: f64) -> Vec<String> {
        let mut lines = Vec::new();
        let mut line = String::new();
        for word in words.split_whitespace() {
            let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
            if self.width(&longer, size) <= width {
                line = longer;
                continue;
            }
            if !line.is_empty() {
                lines.push(std::mem::take(&mut line));
            }
            for c in word.chars() {
                let longer = format!("{line}{c}");
                if self.width(&longer, size) > width && !line.is_empty() {
                    lines.push(std::mem::take(&mut line));
                }
                line.push(c);
            }
        }
        lines.push(line);
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_broken_to_the_width_that_they_have() {
        let letters = Letters::new().expect("letters");
        let width = letters.width("the quick brown", 3.0);
        assert_eq!(letters.lines("the quick brown fox", 3.0, width), ["the quick brown", "fox"]);
        assert_eq!(letters.lines("", 3.0, 10.0), [""]);
        let long = "x".repeat(100);
        let lines = letters.lines(&long, 3.0, 20.0);
        assert!(lines.concat() == long && lines.iter().all(|line| letters.width(line, 3.0) <= 20.0));
        assert!(lines.len() > 3 && letters.lines(&long, 3.0, 0.1).len() == 100);
        let cut = letters.cut(&long, 3.0, 20.0);
        assert!(cut.ends_with('…') && letters.width(&cut, 3.0) <= 20.0, "{cut}");
        assert_eq!(letters.cut("short", 3.0, 20.0), "short");
        assert!(letters.have("Ärmel, links Рукав") && !letters.have("袖"));
    }

    #[test]
    fn the_same_pages_give_the_same_bits() {
        let picture = Arc::new(RgbaImage::from_pixel(4, 3, image::Rgba([200, 30, 40, 128])));
        let corners = [DVec2::ZERO, DVec2::X, DVec2::Y].map(|p| p * 50.0).to_vec();
        let marks = vec![
            Mark::Words { at: DVec2::splat(20.0), size: 5.0, words: "Größe".to_owned(), ink: Ink::Black },
            Mark::Line { points: corners.clone(), is_closed: true, ink: Ink::Grey, width: 0.2, dash: &[] },
            Mark::Fill { points: corners, ink: Ink::Own([250, 240, 230]) },
            Mark::Picture { picture, at: DVec2::splat(60.0), size: DVec2::new(40.0, 30.0) },
        ];
        let written = || write("a title", &[marks.clone(), Vec::new()]).expect("a document");
        assert_eq!(written(), written());
        let pdf = lopdf::Document::load_mem(&written()).expect("a PDF");
        assert_eq!(pdf.get_pages().len(), 2);
    }
}
