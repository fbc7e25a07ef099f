//! Reads size tables (CSV): a header that names measurements of the mannequin, then a row for each size, its name first.

use crate::body::Unit;
use crate::body::mannequin::Measurements;
use crate::geometry::names;
use crate::geometry::words::{Value, Words, within_quotes, words};
use crate::io::words::readable_words;

/// Largest size of a table, bytes.
const MOST_BYTES: usize = 1 << 20;
/// Largest number of sizes in a table.
const MOST_SIZES: usize = 1000;
/// Largest measurement that is accepted, metres; a larger one was given in another unit.
const LONGEST: f64 = 10.0;

/// Why a file cannot be read as a size table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub enum SizesError {
    /// The file as a whole is faulty.
    File(Words),
    /// A cell is faulty.
    Cell {
        /// Line number in the file, from 1.
        row: u64,
        /// Column number, from 1, and, below the header, the column's title.
        column: String,
        /// What is wrong.
        words: Words,
    },
    /// A size is faulty in a way that follows from several of its cells.
    Row {
        /// Line number in the file, from 1.
        row: u64,
        /// What is wrong.
        words: Words,
    },
    /// The table exceeds a limit; the text names it.
    OverLimit(Words),
}

impl SizesError {
    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::File(words) => words.clone(),
            Self::Cell { row, column, words } => {
                words!("row {row}, column {column}", row, column).and(": ", words.clone())
            }
            Self::Row { row, words } => words!("row {row}", row).and(": ", words.clone()),
            Self::OverLimit(what) => words!("over the limit: {what}", what),
        }
    }
}

/// A size of the table: a name and its body measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct Size {
    /// Name as in the table, without surrounding spaces; not empty.
    pub name: String,
    /// Body measurements; those that the table leaves out are in proportion. They may be out of the mannequin's range.
    pub measurements: Measurements,
    /// Line number in the file, from 1.
    row: u64,
    /// Names of the measurements that the table gives, each with its column for error messages.
    given: Vec<(&'static str, String)>,
}

impl Size {
    /// The measurements, if a mannequin can be built to them.
    ///
    /// # Errors
    /// The row, the column and the range of a measurement that is out of range.
    pub fn checked(&self) -> Result<Measurements, SizesError> {
        self.measurements.check().map(|()| self.measurements).map_err(|error| {
            let column = self.given.iter().find(|(name, _)| *name == error.name);
            let (row, name) = (self.row, &self.name);
            match column {
                Some((_, column)) => cell(row, column, words!("size {name}", name).and(": ", error.words())),
                None => {
                    let words = words!("size {name}, what follows from its other measurements", name);
                    SizesError::Row { row, words: words.and(": ", error.words()) }
                }
            }
        })
    }
}

/// The size called `name` in a table; the error lists the names that there are.
pub fn chosen<'a>(sizes: &'a [Size], name: &str) -> Result<&'a Size, SizesError> {
    let found = names::found(sizes.iter().map(|size| size.name.as_str()), name).map(|i| &sizes[i]);
    let all = || sizes.iter().map(|size| size.name.as_str()).collect::<Vec<_>>().join(", ");
    found.ok_or_else(|| {
        let name = within_quotes(name);
        SizesError::File(words!("there is no size \"{name}\" in it; there are {names}", name, names = all()))
    })
}

/// A column of the table: its measurement and unit.
struct Column {
    name: &'static str,
    unit: Unit,
    /// Column number and title, for error messages.
    place: String,
}

/// Reads a table. Cells are separated by commas, semicolons or tabs, whichever is in the header. Numbers are in centimetres where
/// the header names no unit, with a decimal point or, unless commas separate the cells, a decimal comma. An empty cell leaves its
/// measurement out.
pub fn read(bytes: &[u8]) -> Result<Vec<Size>, SizesError> {
    if bytes.len() > MOST_BYTES {
        return Err(SizesError::OverLimit(words!("the file has more than {most} bytes", most = MOST_BYTES)));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes).map_err(|e| {
        SizesError::File(words!("it is no text in UTF-8, from byte {n} on", n = e.valid_up_to() + 1))
    })?;
    let delimiter = delimiter(text);
    let mut rows = csv::ReaderBuilder::new();
    rows.has_headers(false).flexible(true).trim(csv::Trim::All).delimiter(delimiter);
    let mut columns: Option<Vec<Column>> = None;
    let mut sizes: Vec<Size> = Vec::new();
    for row in rows.from_reader(text.as_bytes()).records() {
        let cells = row.map_err(|e| SizesError::File(Words::plain(e.to_string())))?;
        let line = cells.position().map_or(1, |position| line(text, position));
        if cells.iter().all(str::is_empty) {
            continue; // Spreadsheets write rows of nothing below the last.
        }
        let Some(columns) = &columns else {
            columns = Some(header(&cells, line)?);
            continue;
        };
        let size = size(&cells, line, columns, delimiter != b',')?;
        if sizes.iter().any(|known| known.name == size.name) {
            return Err(cell(line, "1", words!("the size {name} is there twice", name = size.name)));
        }
        sizes.push(size);
        if sizes.len() > MOST_SIZES {
            return Err(SizesError::OverLimit(words!("more than {most} sizes", most = MOST_SIZES)));
        }
    }
    match (columns, sizes.is_empty()) {
        (None, _) => Err(SizesError::File(words!("the file is empty"))),
        (_, true) => Err(SizesError::File(words!("there is no size below the header"))),
        (_, false) => Ok(sizes),
    }
}

fn cell(row: u64, column: impl Into<String>, words: Words) -> SizesError {
    SizesError::Cell { row, column: column.into(), words: readable_words(words) }
}

/// The line in which a row begins, from 1.
fn line(text: &str, position: &csv::Position) -> u64 {
    // The crate's position is before the empty lines that it skips.
    let rest = &text.as_bytes()[(position.byte() as usize).min(text.len())..];
    let skipped = rest.iter().take_while(|byte| matches!(byte, b'\r' | b'\n'));
    position.line() + skipped.filter(|byte| **byte == b'\n').count() as u64
}

/// The cell separator. Spreadsheets of countries with a decimal comma write semicolons.
fn delimiter(text: &str) -> u8 {
    let header = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    *[b';', b'\t'].iter().find(|&&c| header.as_bytes().contains(&c)).unwrap_or(&b',')
}

/// Reads the header: a measurement for each column but the first, which holds the names of sizes.
fn header(cells: &csv::StringRecord, line: u64) -> Result<Vec<Column>, SizesError> {
    let mut columns: Vec<Column> = Vec::new();
    for (i, head) in cells.iter().enumerate().skip(1) {
        let number = (i + 1).to_string();
        let (name, unit) = named(head).map_err(|words| cell(line, &number, words))?;
        if columns.iter().any(|known| known.name == name) {
            return Err(cell(line, &number, words!("the measurement {name} is there twice", name)));
        }
        columns.push(Column { name, unit, place: format!("{number} ({})", beginning(head)) });
    }
    match columns.is_empty() {
        true => Err(cell(line, "2", words!("there is no measurement; there are {names}", names = known()))),
        false => Ok(columns),
    }
}

/// Reads a column title, such as "bust", "Upper_arm (mm)", "hip [in]" or "waist cm", as a measurement and its unit.
fn named(head: &str) -> Result<(&'static str, Unit), Words> {
    let letters = |text: &str| -> String {
        text.chars().filter(|c| c.is_alphanumeric()).collect::<String>().to_lowercase()
    };
    let measurement = |text: &str| {
        let all = Measurements::default().named();
        all.into_iter().map(|(name, _)| name).find(|name| letters(name) == letters(text))
    };
    if let Some(name) = measurement(head) {
        return Ok((name, Unit::Centimetre));
    }
    let head = head.trim_end_matches([')', ']']);
    let (text, unit) = head.rsplit_once(['(', '[', ' ', '_', '/']).unwrap_or((head, ""));
    match (measurement(text), unit.parse::<Unit>()) {
        (Some(name), Ok(unit)) => Ok((name, unit)),
        (Some(_), Err(why)) => Err(why.words()),
        (None, _) => Err(words!(
            "there is no measurement \"{name}\"; there are {names}",
            name = short(head),
            names = known()
        )),
    }
}

fn known() -> String {
    Measurements::default().named().map(|(name, _)| name).join(", ")
}

fn size(cells: &csv::StringRecord, line: u64, columns: &[Column], comma: bool) -> Result<Size, SizesError> {
    let name: String = cells.get(0).into_iter().flat_map(str::chars).filter(|c| !c.is_control()).collect();
    if name.is_empty() {
        return Err(cell(line, "1", words!("a size without a name")));
    }
    if cells.len() > columns.len() + 1 {
        let words = words!(
            "there is no measurement at the head of this cell, \"{text}\"",
            text = short(&cells[columns.len() + 1])
        );
        return Err(cell(line, (columns.len() + 2).to_string(), words));
    }
    let (mut given, mut places) = (Vec::new(), Vec::new());
    for (column, text) in columns.iter().zip(cells.iter().skip(1)).filter(|(_, text)| !text.is_empty()) {
        let text = if comma { text.replace(',', ".") } else { text.to_owned() };
        let metres = text.parse::<f64>().map_or(f64::NAN, |number| number * column.unit.metres());
        if !(metres > 0.0 && metres <= LONGEST) {
            let (text, unit) = (short(&text), column.unit.to_string());
            let words = words!("\"{text}\" is no length in {unit}", text, unit);
            return Err(cell(line, &column.place, words));
        }
        given.push((column.name, metres));
        places.push((column.name, column.place.clone()));
    }
    let of = |name: &str| given.iter().find(|(known, _)| *known == name).map(|(_, metres)| *metres);
    Ok(Size { name, measurements: Measurements::completed(of), row: line, given: places })
}

fn beginning(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(40).collect()
}

/// The beginning of `text` as it stands between quotes.
fn short(text: &str) -> Value {
    within_quotes(&beginning(text))
}

#[cfg(test)]
#[path = "sizes_tests.rs"]
mod tests;
