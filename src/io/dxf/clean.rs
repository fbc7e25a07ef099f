//! Checks and reduces DXF text before the `dxf` crate reads it: what that crate would silently drop or fail on is reported with
//! its line, and what no pattern needs is left out.

use std::collections::BTreeMap;
use std::fmt::Write;

use encoding_rs::Encoding;

use crate::geometry::words::{Words, within_quotes, words};
use crate::io::Limits;
use crate::io::pattern_file::PatternFileError;
use crate::io::words::line;

/// The first bytes of a binary DXF file.
const BINARY: &[u8] = b"AutoCAD Binary DXF";
/// Faults reported one by one; further ones are only counted.
const MOST_NOTES: usize = 8;
/// Group codes that shapes and texts of a pattern use. Handles, references and markers are not among them.
const CODES: [i32; 26] =
    [0, 1, 2, 3, 8, 10, 11, 20, 21, 30, 31, 39, 40, 41, 42, 43, 44, 45, 50, 51, 66, 70, 71, 72, 73, 90];
const ENTITIES: [&str; 10] =
    ["LINE", "POINT", "TEXT", "MTEXT", "INSERT", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "VERTEX"];

/// A DXF file reduced to what is needed.
#[derive(Debug, Default)]
pub struct Clean {
    /// The sections BLOCKS and ENTITIES as valid ASCII DXF, encoded in UTF-8.
    pub text: String,
    /// Faults that the reader could skip, with their lines.
    pub notes: Vec<Words>,
    /// `$INSUNITS`, if it is there.
    pub units: Option<i64>,
    /// Number of entities (shapes and texts) kept.
    pub entities: usize,
}

/// Whether a file begins as DXF (text or binary) or as DWG does.
pub fn looks_like(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.starts_with(BINARY) || is_dwg(bytes) {
        return true;
    }
    let start = &bytes[..bytes.len().min(4096)];
    let mut lines =
        start.split(|b| *b == b'\n' || *b == b'\r').map(<[u8]>::trim_ascii).filter(|l| !l.is_empty());
    // A DXF text begins with "0 SECTION" or with a comment, "999 …".
    match lines.next() {
        Some(b"0") => lines.next().is_some_and(|l| l == b"SECTION" || l == b"EOF"),
        Some(b"999") => true,
        _ => false,
    }
}

fn is_dwg(bytes: &[u8]) -> bool {
    bytes.len() >= 6 && bytes.starts_with(b"AC10") && bytes[4..6].iter().all(u8::is_ascii_digit)
}

/// Checks and reduces a file.
pub fn clean(bytes: &[u8]) -> Result<Clean, PatternFileError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.trim_ascii().is_empty() {
        return Err(PatternFileError::Whole(words!("the file is empty")));
    }
    if bytes.starts_with(BINARY) {
        return Err(PatternFileError::Whole(words!(
            "this is a binary DXF; save it as ASCII DXF (R12) in the program it comes from"
        )));
    }
    if is_dwg(bytes) {
        return Err(PatternFileError::Whole(words!(
            "this is a DWG drawing; save it as DXF (R12) in the program it comes from"
        )));
    }
    let text = decoded(bytes);
    let limits = Limits::default();
    let mut cleaner = Cleaner::new(&limits);
    for record in Records::new(&text, &limits) {
        cleaner.take(record?)?;
    }
    cleaner.finish()
}

/// The text as Unicode: UTF-8 if it is valid, else decoded by the code page that the header names.
fn decoded(bytes: &[u8]) -> std::borrow::Cow<'_, str> {
    if let Ok(text) = std::str::from_utf8(bytes) {
        return text.into();
    }
    code_page(bytes).decode_without_bom_handling(bytes).0
}

fn code_page(bytes: &[u8]) -> &'static Encoding {
    let header = String::from_utf8_lossy(&bytes[..bytes.len().min(1 << 16)]);
    let named = header.split_once("$DWGCODEPAGE").and_then(|(_, rest)| {
        let mut lines = rest.lines().skip(1).map(str::trim);
        lines.next().filter(|code| *code == "3").and_then(|_| lines.next())
    });
    let name = named.unwrap_or_default().to_ascii_lowercase();
    let label = match name.trim_start_matches("ansi_").trim_start_matches("dos") {
        "932" => "shift_jis",
        "936" => "gbk",
        "949" => "euc-kr",
        "950" => "big5",
        "866" => "ibm866",
        "874" => "windows-874",
        number => &format!("windows-{number}"),
    };
    Encoding::for_label(label.as_bytes()).unwrap_or(encoding_rs::WINDOWS_1252)
}

/// A group code and its value.
#[derive(Clone, Copy, Debug)]
struct Tag<'a> {
    code: i32,
    value: &'a str,
    /// Line of the value, from 1.
    line: usize,
}

/// A tag with group code 0, which begins a record, and the tags up to the next such tag.
#[derive(Debug)]
struct Record<'a> {
    kind: &'a str,
    line: usize,
    tags: Vec<Tag<'a>>,
}

/// Splits a text into records.
struct Records<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    next: Option<Tag<'a>>,
    line_bytes: usize,
    tag_limit: usize,
    /// Whether the first record has begun; comments and values before it are skipped.
    begun: bool,
}

impl<'a> Records<'a> {
    fn new(text: &'a str, limits: &Limits) -> Self {
        let lines = text.lines().enumerate();
        Self { lines, next: None, line_bytes: limits.line_bytes, tag_limit: limits.dxf_tags, begun: false }
    }

    /// The next tag; None at the end of the file, also where the file ends between a code and its value.
    fn tag(&mut self) -> Option<Result<Tag<'a>, PatternFileError>> {
        let (number, code) = self.lines.find(|(_, line)| self.begun || !line.trim().is_empty())?;
        if code.len() > self.line_bytes {
            return Some(Err(over_line(number + 1, code.len(), self.line_bytes)));
        }
        let code = code.trim();
        let (value_number, value) = self.lines.next()?;
        if value.len() > self.line_bytes {
            return Some(Err(over_line(value_number + 1, value.len(), self.line_bytes)));
        }
        match code.parse::<i32>() {
            Ok(code) => Some(Ok(Tag { code, value: value.trim(), line: value_number + 1 })),
            Err(_) if code.is_empty() && value.trim().is_empty() => None,
            Err(_) => {
                let shown: String = code.chars().take(20).collect();
                let words = words!(
                    "\"{code}\" is no group code; the file is no DXF, or cut out of one",
                    code = within_quotes(&shown)
                );
                Some(Err(PatternFileError::bad(line(number + 1), words)))
            }
        }
    }
}

fn over_line(number: usize, bytes: usize, limit: usize) -> PatternFileError {
    let words = words!("it has {count} bytes; {most} are allowed", count = bytes, most = limit);
    PatternFileError::OverLimit(line(number).and(": ", words))
}

impl<'a> Iterator for Records<'a> {
    type Item = Result<Record<'a>, PatternFileError>;

    fn next(&mut self) -> Option<Self::Item> {
        let start = loop {
            let tag = match self.next.take() {
                Some(tag) => tag,
                None => match self.tag()? {
                    Ok(tag) => tag,
                    Err(error) => return Some(Err(error)),
                },
            };
            if tag.code == 0 {
                break tag;
            }
        };
        self.begun = true;
        let mut record = Record { kind: start.value, line: start.line, tags: Vec::new() };
        while let Some(tag) = self.tag() {
            match tag {
                Err(error) => return Some(Err(error)),
                Ok(tag) if tag.code == 0 => {
                    self.next = Some(tag);
                    break;
                }
                Ok(_) if record.tags.len() >= self.tag_limit => {
                    let words = words!("it has more than {most} tags", most = self.tag_limit);
                    return Some(Err(PatternFileError::OverLimit(line(record.line).and(": ", words))));
                }
                Ok(tag) => record.tags.push(tag),
            }
        }
        Some(Ok(record))
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    None,
    Header,
    Blocks,
    Entities,
    Other,
}

struct Cleaner<'l> {
    out: Clean,
    section: Section,
    in_block: bool,
    in_polyline: bool,
    ended: bool,
    left_out: BTreeMap<String, usize>,
    more_notes: usize,
    limits: &'l Limits,
}

impl<'l> Cleaner<'l> {
    fn new(limits: &'l Limits) -> Self {
        let out = Clean {
            text: "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n0\nENDSEC\n".to_owned(),
            ..Clean::default()
        };
        Self {
            out,
            section: Section::None,
            in_block: false,
            in_polyline: false,
            ended: false,
            left_out: BTreeMap::new(),
            more_notes: 0,
            limits,
        }
    }

    fn note(&mut self, words: Words) {
        if self.out.notes.len() < MOST_NOTES {
            self.out.notes.push(words);
        } else {
            self.more_notes += 1;
        }
    }

    fn take(&mut self, record: Record<'_>) -> Result<(), PatternFileError> {
        if self.ended {
            return Ok(());
        }
        if self.in_polyline && !["VERTEX", "SEQEND"].contains(&record.kind) {
            self.note(line(record.line).and(": ", words!("a polyline has no SEQEND")));
            self.end_polyline();
        }
        match record.kind {
            "SECTION" => self.begin_section(&record),
            "ENDSEC" => self.end_section(),
            "EOF" => self.ended = true,
            "BLOCK" if self.section == Section::Blocks => {
                self.end_block();
                self.in_block = true;
                self.write(&record)?;
            }
            "ENDBLK" => self.end_block(),
            "SEQEND" => self.end_polyline(),
            kind => {
                let drawn = self.in_block || self.section == Section::Entities;
                if drawn {
                    self.entity(kind, &record)?;
                }
            }
        }
        Ok(())
    }

    fn begin_section(&mut self, record: &Record<'_>) {
        self.end_section();
        let name = record.tags.iter().find(|t| t.code == 2).map_or("", |t| t.value);
        self.section = match name {
            "HEADER" => Section::Header,
            "BLOCKS" => Section::Blocks,
            "ENTITIES" => Section::Entities,
            _ => Section::Other,
        };
        match self.section {
            Section::Header => self.read_header(record),
            Section::Blocks | Section::Entities => {
                // Writing to a String cannot fail.
                let _ = write!(self.out.text, "0\nSECTION\n2\n{name}\n");
            }
            Section::None | Section::Other => {}
        }
    }

    /// Reads `$INSUNITS` from the header, all of whose variables are tags of its SECTION record.
    fn read_header(&mut self, record: &Record<'_>) {
        let at = record.tags.iter().position(|t| t.code == 9 && t.value == "$INSUNITS");
        self.out.units = at.and_then(|at| record.tags.get(at + 1)?.value.parse().ok());
    }

    fn end_section(&mut self) {
        self.end_block();
        self.end_polyline();
        if matches!(self.section, Section::Blocks | Section::Entities) {
            self.out.text.push_str("0\nENDSEC\n");
        }
        self.section = Section::None;
    }

    fn end_block(&mut self) {
        self.end_polyline();
        if self.in_block {
            self.out.text.push_str("0\nENDBLK\n8\n0\n");
        }
        self.in_block = false;
    }

    fn end_polyline(&mut self) {
        if self.in_polyline {
            self.out.text.push_str("0\nSEQEND\n8\n0\n");
        }
        self.in_polyline = false;
    }

    fn entity(&mut self, kind: &str, record: &Record<'_>) -> Result<(), PatternFileError> {
        if !ENTITIES.contains(&kind) {
            if kind != "ATTRIB" && kind != "ATTDEF" {
                let name: String = kind.chars().take(40).collect();
                *self.left_out.entry(name).or_default() += 1;
            }
            return Ok(());
        }
        if kind == "VERTEX" && !self.in_polyline {
            self.note(line(record.line).and(": ", words!("a VERTEX without a POLYLINE was left out")));
            return Ok(());
        }
        self.out.entities += 1;
        if self.out.entities > self.limits.dxf_entities {
            let words = words!("more than {most} shapes and texts", most = self.limits.dxf_entities);
            return Err(PatternFileError::OverLimit(words));
        }
        if self.write(record)? && kind == "POLYLINE" {
            self.in_polyline = true;
        }
        Ok(())
    }

    /// Writes a record. If one of its numbers is not valid the record is left out with a note, and the result is false.
    fn write(&mut self, record: &Record<'_>) -> Result<bool, PatternFileError> {
        for tag in record.tags.iter().filter(|t| CODES.contains(&t.code)) {
            if let Some(words) = fault(*tag)? {
                if record.kind == "POLYLINE" || record.kind == "BLOCK" {
                    continue;
                }
                let kind = record.kind;
                let words = words!("{words}; the {kind} was left out", words, kind);
                self.note(line(tag.line).and(": ", words));
                return Ok(false);
            }
        }
        let _ = write!(self.out.text, "0\n{}\n", record.kind);
        for tag in
            record.tags.iter().filter(|t| CODES.contains(&t.code) && !matches!(fault(**t), Ok(Some(_))))
        {
            // Code 66 announces attributes of an INSERT. They are left out, so the code must go too.
            if tag.code == 66 && record.kind == "INSERT" {
                continue;
            }
            let value = match (tag.code, whole(tag.value)) {
                (60..=79, Some(number)) => number.to_string(),
                _ => tag.value.to_owned(),
            };
            let _ = write!(self.out.text, "{}\n{value}\n", tag.code);
        }
        if record.kind == "POLYLINE" && !record.tags.iter().any(|t| t.code == 66) {
            self.out.text.push_str("66\n1\n");
        }
        Ok(true)
    }

    fn finish(mut self) -> Result<Clean, PatternFileError> {
        if self.out.text.is_empty()
            || (self.section == Section::None && !self.ended && self.out.entities == 0)
        {
            return Err(PatternFileError::Whole(words!("there is nothing drawn in it")));
        }
        if !self.ended {
            let n = self.out.entities;
            let words = words!("the file ends early; {n} shapes and texts were read", n);
            self.out.notes.insert(0, words);
        }
        self.end_section();
        self.out.text.push_str("0\nEOF\n");
        if self.more_notes > 0 {
            self.out.notes.push(words!("{n} more faults of this kind", n = self.more_notes));
        }
        for (kind, count) in self.left_out.into_iter().take(MOST_NOTES) {
            self.out.notes.push(words!("{count} × {kind} left out: not a shape of a pattern", count, kind));
        }
        Ok(self.out)
    }
}

/// A whole number that fits 16 bits; some programs write 1.0 for 1.
fn whole(text: &str) -> Option<i16> {
    let number = text.parse::<f64>().ok()?;
    (number.fract() == 0.0 && number.abs() <= f64::from(i16::MAX)).then_some(number as i16)
}

/// The fault of a tag's number that can be skipped with a note, or None if the number is valid. A number that is infinite or NaN
/// is an error and ends the reading.
fn fault(tag: Tag<'_>) -> Result<Option<Words>, PatternFileError> {
    let value = || within_quotes(&tag.value.chars().take(30).collect::<String>());
    match tag.code {
        10..=59 => match tag.value.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(None),
            Ok(_) => {
                let words = words!("\"{value}\" is not a finite number", value = value());
                Err(PatternFileError::bad(line(tag.line), words))
            }
            Err(_) if tag.value.contains(',') => {
                Ok(Some(words!("\"{value}\" is no number (a decimal comma?)", value = value())))
            }
            Err(_) => Ok(Some(words!("\"{value}\" is no number", value = value()))),
        },
        60..=79 => {
            let sound = whole(tag.value).is_some();
            Ok((!sound).then(|| words!("\"{value}\" is no small whole number", value = value())))
        }
        90..=99 => {
            let sound = tag.value.parse::<i32>().is_ok();
            Ok((!sound).then(|| words!("\"{value}\" is no whole number", value = value())))
        }
        _ => Ok(None),
    }
}
