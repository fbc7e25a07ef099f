//! Headings, words and tables that flow from page to page.

use std::sync::Arc;

use glam::DVec2;
use image::RgbaImage;

use crate::io::pdf::booklet::{Ink, Letters, Mark, PAGE};
use crate::language::say;

/// Blank margin at the sides, millimetres.
pub const MARGIN: f64 = 15.0;
/// Where the contents of a page begin and end, millimetres from its upper edge.
const TOP: f64 = 22.0;
const BOTTOM: f64 = PAGE.y - 18.0;
/// Width and height that the contents of a page have, millimetres.
pub const ROOM: DVec2 = DVec2::new(PAGE.x - 2.0 * MARGIN, BOTTOM - TOP);
/// Font size and distance of lines of tables and words, millimetres.
const TEXT: f64 = 3.05;
const LINE: f64 = 4.2;
/// Font size of headings and of the titles of columns, millimetres.
const HEADING: f64 = 5.2;
const TITLE: f64 = 2.6;
/// Blank space between columns, and above and below the words of a row, millimetres.
const BETWEEN: f64 = 3.0;
const PADDING: f64 = 0.9;
/// Height below which a heading goes to the next page with what follows, millimetres.
const TOGETHER: f64 = 42.0;
/// Most lines of a cell: the rest is left out.
const MOST_LINES: usize = 30;
/// Most rows of a table: the rest is left out.
const MOST_ROWS: usize = 1500;
/// Side of a patch of colour, millimetres.
const SWATCH: f64 = 2.8;
/// Colour of weak lines, sRGB.
const FAINT: Ink = Ink::Own([205, 205, 205]);

/// A cell of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cell {
    pub words: String,
    /// Colour of a patch before the words, sRGB.
    pub swatch: Option<[u8; 3]>,
}

impl<T: Into<String>> From<T> for Cell {
    fn from(words: T) -> Self {
        Self { words: words.into(), swatch: None }
    }
}

/// A table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Titles of the columns, and whether they hold numbers, which stand at the right.
    pub columns: Vec<(String, bool)>,
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table with these columns; a title that begins with "#" is of a column of numbers.
    pub fn new<'t>(titles: impl IntoIterator<Item = &'t str>) -> Self {
        let column = |title: &str| match title.strip_prefix('#') {
            Some(title) => (title.to_owned(), true),
            None => (title.to_owned(), false),
        };
        Self { columns: titles.into_iter().map(column).collect(), rows: Vec::new() }
    }
}

impl Table {
    /// It without the columns in which there is nothing.
    fn without_empty(&self) -> Self {
        let is_filled =
            |k: &usize| self.rows.iter().any(|row| row.get(*k).is_some_and(|cell| *cell != Cell::default()));
        let kept: Vec<usize> = (0..self.columns.len()).filter(is_filled).collect();
        let row = |row: &Vec<Cell>| kept.iter().filter_map(|&k| row.get(k).cloned()).collect();
        Self {
            columns: kept.iter().map(|&k| self.columns[k].clone()).collect(),
            rows: self.rows.iter().map(row).collect(),
        }
    }
}

/// Pages in the making.
#[derive(Debug)]
pub struct Flow {
    letters: Letters,
    pages: Vec<Vec<Mark>>,
    /// Where the next thing goes, millimetres from the upper edge of the last page.
    y: f64,
}

impl Flow {
    /// Begins with an empty page.
    pub fn new(letters: Letters) -> Self {
        Self { letters, pages: vec![Vec::new()], y: TOP }
    }

    pub fn letters(&self) -> &Letters {
        &self.letters
    }

    pub fn mark(&mut self, mark: Mark) {
        if let Some(page) = self.pages.last_mut() {
            page.push(mark);
        }
    }

    /// Begins a new page, unless the last one is empty.
    pub fn turn(&mut self) {
        if self.pages.last().is_some_and(|page| !page.is_empty()) {
            self.pages.push(Vec::new());
        }
        self.y = TOP;
    }

    /// Makes sure that so many millimetres are left on the page.
    fn need(&mut self, height: f64) {
        if self.y + height > BOTTOM && self.y > TOP {
            self.turn();
        }
    }

    /// Takes a strip of this height, of at most a page, and gives its upper left corner.
    pub fn strip(&mut self, height: f64) -> DVec2 {
        self.need(height);
        let at = DVec2::new(MARGIN, self.y);
        self.y += height;
        at
    }

    /// Writes words in one line.
    pub fn write(&mut self, at: DVec2, size: f64, words: &str, ink: Ink) {
        self.mark(Mark::Words { at, size, words: words.to_owned(), ink });
    }

    /// Writes words in one line whose middle is at `at`.
    pub fn centred(&mut self, at: DVec2, size: f64, words: &str, ink: Ink) {
        let width = self.letters.width(words, size);
        self.write(at - DVec2::X * width / 2.0, size, words, ink);
    }

    /// Draws a straight line.
    pub fn rule(&mut self, ends: [DVec2; 2], ink: Ink, width: f64) {
        self.mark(Mark::Line { points: ends.to_vec(), is_closed: false, ink, width, dash: &[] });
    }

    /// The title at the beginning, and a line below it.
    pub fn title(&mut self, name: &str, below: &str) {
        for line in self.letters.lines(name, 9.0, ROOM.x).into_iter().take(3) {
            let at = self.strip(10.0);
            self.write(at + DVec2::Y * 4.0, 9.0, &line, Ink::Black);
        }
        for line in self.letters.lines(below, 3.4, ROOM.x).into_iter().take(3) {
            let at = self.strip(4.8);
            self.write(at + DVec2::Y * 2.0, 3.4, &line, Ink::Grey);
        }
        self.y += 3.0;
    }

    /// A heading, on the same page as what begins below it.
    pub fn heading(&mut self, words: &str) {
        self.need(TOGETHER);
        if self.y > TOP {
            self.y += 5.0;
        }
        let at = self.strip(8.0);
        self.write(at + DVec2::Y * 4.4, HEADING, words, Ink::Black);
    }

    /// A paragraph.
    pub fn words(&mut self, words: &str, ink: Ink) {
        for line in self.letters.lines(words, TEXT, ROOM.x) {
            let at = self.strip(LINE);
            self.write(at + DVec2::Y * TEXT, TEXT, &line, ink);
        }
        self.y += 1.2;
    }

    /// A paragraph with a dot before it.
    pub fn item(&mut self, words: &str) {
        for (i, line) in self.letters.lines(words, TEXT, ROOM.x - 4.0).into_iter().enumerate() {
            let at = self.strip(LINE) + DVec2::Y * TEXT;
            if i == 0 {
                self.write(at, TEXT, "•", Ink::Grey);
            }
            self.write(at + DVec2::X * 4.0, TEXT, &line, Ink::Black);
        }
        self.y += 0.6;
    }

    /// Pictures side by side in a strip of at most this height, each with its title below.
    pub fn pictures(&mut self, most: f64, pictures: &[(String, Arc<RgbaImage>)]) {
        let width = ROOM.x / pictures.len().max(1) as f64;
        let room = DVec2::new(width - 4.0, most - 6.0);
        let on_page = |picture: &RgbaImage| {
            let own = DVec2::new(f64::from(picture.width()), f64::from(picture.height()));
            own * (room / own.max(DVec2::ONE)).min_element()
        };
        let tallest = pictures.iter().map(|(_, picture)| on_page(picture).y).fold(0.0, f64::max);
        let at = self.strip(tallest + 6.0);
        for (i, (title, picture)) in pictures.iter().enumerate() {
            let size = on_page(picture);
            let middle = at + DVec2::X * width * (i as f64 + 0.5);
            let corner = middle + DVec2::new(-size.x / 2.0, tallest - size.y);
            self.mark(Mark::Picture { picture: Arc::clone(picture), at: corner, size });
            self.centred(middle + DVec2::Y * (tallest + 4.5), TEXT, title, Ink::Grey);
        }
    }

    /// A table; its titles are repeated on each page that it goes on to, and columns in which there is nothing are left out.
    pub fn table(&mut self, table: &Table) {
        let table = &table.without_empty();
        let widths = widths(&self.letters, table);
        self.need(20.0);
        self.titles(table, &widths);
        for row in table.rows.iter().take(MOST_ROWS) {
            let cells: Vec<Vec<String>> =
                row.iter().zip(&widths).map(|(cell, width)| self.cell_lines(cell, *width)).collect();
            let lines = cells.iter().map(Vec::len).max().unwrap_or(1);
            let height = lines as f64 * LINE + 2.0 * PADDING;
            if self.y + height > BOTTOM {
                self.turn();
                self.titles(table, &widths);
            }
            let at = self.strip(height);
            self.row(row, &cells, (table, &widths), at);
            self.rule([at + DVec2::Y * height, at + DVec2::new(ROOM.x, height)], FAINT, 0.1);
        }
        if table.rows.len() > MOST_ROWS {
            let words = say!("{n} more rows are left out here.", n = table.rows.len() - MOST_ROWS);
            self.words(&words, Ink::Grey);
        }
        self.y += 3.0;
    }

    fn cell_lines(&self, cell: &Cell, width: f64) -> Vec<String> {
        let width = width - BETWEEN - if cell.swatch.is_some() { SWATCH + 1.2 } else { 0.0 };
        let mut lines = self.letters.lines(&cell.words, TEXT, width);
        if lines.len() > MOST_LINES {
            lines.truncate(MOST_LINES);
            lines[MOST_LINES - 1] += "…";
        }
        lines
    }

    fn row(&mut self, row: &[Cell], cells: &[Vec<String>], (table, widths): (&Table, &[f64]), at: DVec2) {
        let mut x = at.x;
        for (k, lines) in cells.iter().enumerate() {
            let swatch = row[k].swatch;
            if let Some(colour) = swatch {
                self.patch(DVec2::new(x, at.y + PADDING + 0.5), colour);
            }
            let inset = if swatch.is_some() { SWATCH + 1.2 } else { 0.0 };
            for (i, line) in lines.iter().enumerate() {
                let base = at.y + PADDING + LINE * i as f64 + TEXT;
                let left = match table.columns[k].1 {
                    true => x + widths[k] - BETWEEN - self.letters.width(line, TEXT),
                    false => x + inset,
                };
                self.write(DVec2::new(left, base), TEXT, line, Ink::Black);
            }
            x += widths[k];
        }
    }

    /// A patch of colour.
    fn patch(&mut self, at: DVec2, colour: [u8; 3]) {
        let points: Vec<DVec2> =
            [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|p| at + p * SWATCH).to_vec();
        self.mark(Mark::Fill { points: points.clone(), ink: Ink::Own(colour) });
        self.mark(Mark::Line { points, is_closed: true, ink: Ink::Grey, width: 0.1, dash: &[] });
    }

    fn titles(&mut self, table: &Table, widths: &[f64]) {
        let titles: Vec<Vec<String>> = table
            .columns
            .iter()
            .zip(widths)
            .map(|((title, _), width)| self.letters.lines(title, TITLE, width - BETWEEN))
            .collect();
        let lines = titles.iter().map(Vec::len).max().unwrap_or(1);
        let height = lines as f64 * 3.4 + 1.6;
        let at = self.strip(height);
        let mut x = at.x;
        for (k, own) in titles.iter().enumerate() {
            for (i, line) in own.iter().enumerate() {
                let base = at.y + 3.4 * (lines - own.len() + i) as f64 + TITLE;
                let left = match table.columns[k].1 {
                    true => x + widths[k] - BETWEEN - self.letters.width(line, TITLE),
                    false => x,
                };
                self.write(DVec2::new(left, base), TITLE, line, Ink::Grey);
            }
            x += widths[k];
        }
        let below = at + DVec2::Y * height;
        self.rule([below, below + DVec2::X * ROOM.x], Ink::Grey, 0.25);
    }

    /// The pages, with `name` above all but the first, and their numbers.
    pub fn finish(mut self, name: &str) -> Vec<Vec<Mark>> {
        let count = self.pages.len();
        let mut pages = std::mem::take(&mut self.pages);
        for (i, page) in pages.iter_mut().enumerate() {
            let mut words = |at: DVec2, words: String| {
                page.push(Mark::Words { at, size: TITLE, words, ink: Ink::Grey });
            };
            if i > 0 {
                let name = self.letters.cut(name, TITLE, ROOM.x);
                words(DVec2::new(MARGIN, 14.0), name);
            }
            let number = say!("Page {page} of {count}", page = i + 1, count);
            let width = self.letters.width(&number, TITLE);
            words(DVec2::new(PAGE.x - MARGIN - width, PAGE.y - 10.0), number);
            words(DVec2::new(MARGIN, PAGE.y - 10.0), format!("Toile {}", env!("CARGO_PKG_VERSION")));
        }
        pages
    }
}

/// Widths of the columns of a table, which together are as wide as the page: each as wide as its widest cell; where that is too
/// much the widest have to break their words.
fn widths(letters: &Letters, table: &Table) -> Vec<f64> {
    let natural = |k: usize| {
        let swatch = |cell: &Cell| if cell.swatch.is_some() { SWATCH + 1.2 } else { 0.0 };
        let cells = table.rows.iter().take(MOST_ROWS).filter_map(|row| row.get(k));
        let widest = cells.map(|cell| letters.width(&cell.words, TEXT) + swatch(cell)).fold(0.0, f64::max);
        let title = letters.width(&table.columns[k].0, TITLE);
        widest.max(title.min(24.0)) + BETWEEN + 0.01
    };
    let natural: Vec<f64> = (0..table.columns.len()).map(natural).collect();
    let all: f64 = natural.iter().sum();
    if all <= ROOM.x {
        // What is left goes to the columns of words, in proportion.
        let of_words = |k: usize| if table.columns[k].1 { 0.0 } else { natural[k] };
        let words: f64 = (0..natural.len()).map(of_words).sum();
        let left = ROOM.x - all;
        let more = |k: usize| match words > 0.0 {
            true => left * of_words(k) / words,
            false => left / natural.len() as f64,
        };
        return (0..natural.len()).map(|k| natural[k] + more(k)).collect();
    }
    // The width to which all wider columns are cut.
    let mut sorted = natural.clone();
    sorted.sort_by(f64::total_cmp);
    let mut left = ROOM.x;
    for (i, width) in sorted.iter().enumerate() {
        let share = left / (sorted.len() - i) as f64;
        if *width > share {
            return natural.iter().map(|width| width.min(share)).collect();
        }
        left -= width;
    }
    natural
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flow() -> Flow {
        Flow::new(Letters::new().expect("letters"))
    }

    fn texts(page: &[Mark]) -> Vec<&str> {
        let texts = page.iter().filter_map(|mark| match mark {
            Mark::Words { words, .. } => Some(words.as_str()),
            _ => None,
        });
        texts.collect()
    }

    #[test]
    fn long_tables_go_on_with_their_titles_and_pages_are_numbered() {
        let mut flow = flow();
        let mut table = Table::new(["Piece", "#Area"]);
        table.rows = (0..150).map(|i| vec![format!("piece {i}").into(), "1.0".into()]).collect();
        flow.heading("Pieces");
        flow.table(&table);
        let pages = flow.finish("a shirt");
        assert_eq!(pages.len(), 4);
        for (i, page) in pages.iter().enumerate() {
            let texts = texts(page);
            let number = format!("Page {} of 4", i + 1);
            assert!(texts.contains(&"Area") && texts.contains(&number.as_str()), "{texts:?}");
            assert_eq!(texts.contains(&"a shirt"), i > 0);
        }
        let rows: usize =
            pages.iter().map(|page| texts(page).iter().filter(|t| t.starts_with("piece ")).count()).sum();
        assert_eq!(rows, 150);
    }

    #[test]
    fn columns_fill_the_page_and_only_the_widest_are_cut() {
        let letters = Letters::new().expect("letters");
        let mut table = Table::new(["Piece", "Where", "#Area"]);
        table.rows = vec![vec!["a".into(), "b".into(), "12.5".into()]];
        let fits = widths(&letters, &table);
        assert!((fits.iter().sum::<f64>() - ROOM.x).abs() < 1e-9, "{fits:?}");
        table.rows[0][1] = "long words ".repeat(100).into();
        let cut = widths(&letters, &table);
        assert!((cut.iter().sum::<f64>() - ROOM.x).abs() < 1e-9, "{cut:?}");
        assert!(cut[1] > 100.0 && cut[2] > letters.width("12.5", TEXT));
    }

    #[test]
    fn a_cell_without_end_is_cut() {
        let mut flow = flow();
        let mut table = Table::new(["Name"]);
        table.rows = vec![vec!["å ".repeat(100_000).into()]];
        flow.table(&table);
        assert_eq!(flow.finish("").len(), 1);
    }
}
