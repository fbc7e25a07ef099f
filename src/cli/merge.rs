//! `toile report merge`: one table of the lines that `dress --list` left in its folders.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::{Map, Value};

use crate::cli::arguments::Merge;
use crate::cli::failure::Failure;
use crate::cli::verdict::PICTURE_NAME;
use crate::cli::{files, lines, output};

/// Columns that come first; the others follow in the order of their names.
const FIRST: [&str; 8] =
    ["garment", "folder", "project", "outcome", "exit_code", "error", "seconds", "processor_seconds"];
/// The column of the paths of pictures.
const PICTURE: &str = "picture";

/// A line of a garment, in the words of JSON.
type Line = Map<String, Value>;

/// Writes the table and prints its summary.
pub fn merge(arguments: &Merge) -> Result<(), Failure> {
    let mut rows = Vec::new();
    let mut unread = 0;
    for folder in &arguments.folders {
        let (newest, wrong) = newest(folder)?;
        unread += wrong;
        for (garment, line) in newest {
            rows.push(row(folder, &garment, line, arguments.picture));
        }
    }
    let summary = Summary::new(&rows, unread);
    output::write(&arguments.out, &table(&rows)?)?;
    output::say(&match arguments.json {
        true => serde_json::to_string(&summary).map_err(|e| Failure::Internal(e.to_string()))?,
        false => summary.to_string(),
    });
    Ok(())
}

/// The newest line of each garment in `folder`, by name, and the number of lines that could not be read.
fn newest(folder: &Path) -> Result<(BTreeMap<String, Line>, usize), Failure> {
    let files = lines::files_in(folder)?;
    if files.is_empty() {
        return Err(Failure::input(folder, "there are no lines*.jsonl in it, which dress --list writes"));
    }
    let mut newest: BTreeMap<String, (f64, Line)> = BTreeMap::new();
    let mut unread = 0;
    for path in files {
        let bytes = files::read(&path)?;
        for (i, text) in bytes.split(|&byte| byte == b'\n').enumerate().filter(|(_, text)| !text.is_empty()) {
            let Some((garment, finished, line)) = known(text) else {
                let words = format!("{}: line {} is no whole line, skipped", path.display(), i + 1);
                output::complain(&words);
                unread += 1;
                continue;
            };
            if newest.get(&garment).is_none_or(|(at, _)| *at <= finished) {
                newest.insert(garment, (finished, line));
            }
        }
    }
    Ok((newest.into_iter().map(|(garment, (_, line))| (garment, line)).collect(), unread))
}

/// The garment of a line, when the line was written, and the line; None if it is not whole or has no outcome.
fn known(text: &[u8]) -> Option<(String, f64, Line)> {
    let line: Line = serde_json::from_slice(text).ok()?;
    line.get("outcome")?.as_str()?;
    Some((line.get("garment")?.as_str()?.to_owned(), line.get("finished")?.as_f64()?, line))
}

/// The cells of a row by the names of their columns.
type Row = BTreeMap<String, String>;

/// The row of `garment`, whose results are in `folder`, as this program finds it now.
fn row(folder: &Path, garment: &str, mut line: Line, picture: bool) -> Row {
    let own: PathBuf = folder.join(garment);
    line.insert("folder".to_owned(), own.display().to_string().into());
    if picture {
        let view = own.join(PICTURE_NAME);
        let path = if view.exists() { view.display().to_string() } else { String::new() };
        line.insert(PICTURE.to_owned(), path.into());
    }
    let mut row = Row::new();
    line.iter().for_each(|(key, value)| add(&mut row, key, value));
    row
}

/// Adds `value` to `row`: of an object each member in a column "key.member", of a list its values with semicolons.
fn add(row: &mut Row, key: &str, value: &Value) {
    match value {
        Value::Object(members) => {
            members.iter().for_each(|(name, value)| add(row, &format!("{key}.{name}"), value))
        }
        other => {
            row.insert(key.to_owned(), cell(other));
        }
    }
}

fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Array(values) => values.iter().map(cell).collect::<Vec<_>>().join("; "),
        Value::Object(members) => match (&members.get("place"), &members.get("words")) {
            (Some(Value::String(place)), Some(Value::String(words))) => format!("{place}: {words}"),
            _ => value.to_string(),
        },
        Value::Bool(_) | Value::Number(_) => value.to_string(),
    }
}

/// The table with a heading; a cell that a garment does not have is empty.
fn table(rows: &[Row]) -> Result<Vec<u8>, Failure> {
    let all: BTreeSet<&str> = rows.iter().flat_map(|row| row.keys().map(String::as_str)).collect();
    let others = all.iter().copied().filter(|name| !FIRST.contains(name));
    let columns: Vec<&str> = FIRST.into_iter().chain(others).collect();
    let mut table = csv::Writer::from_writer(Vec::new());
    let internal = |e: csv::Error| Failure::Internal(e.to_string());
    table.write_record(&columns).map_err(internal)?;
    for row in rows {
        let cells = columns.iter().map(|name| row.get(*name).map_or("", String::as_str));
        table.write_record(cells).map_err(internal)?;
    }
    table.into_inner().map_err(|e| Failure::Internal(e.to_string()))
}

/// What came of all garments.
#[derive(Debug, Default, Serialize)]
struct Summary {
    garments: usize,
    dressed: usize,
    /// Dressed with faults.
    not_dressed: usize,
    failed: usize,
    /// Fraction of garments that are dressed without a fault.
    share: f64,
    /// Sums over all garments whose processor time is known, seconds.
    processor_seconds: f64,
    /// Garments an hour that one processor core works; None where no processor time is known.
    garments_per_core_hour: Option<f64>,
    /// Lines that could not be read.
    unread_lines: usize,
}

impl Summary {
    fn new(rows: &[Row], unread_lines: usize) -> Self {
        let count = |outcome: &str| rows.iter().filter(|row| row["outcome"] == outcome).count();
        let seconds = |row: &Row| row.get("processor_seconds")?.parse::<f64>().ok();
        let known: Vec<f64> = rows.iter().filter_map(seconds).collect();
        let processor_seconds: f64 = known.iter().sum();
        let rate = known.len() as f64 * 3600.0 / processor_seconds;
        let dressed = count("dressed");
        Self {
            garments: rows.len(),
            dressed,
            not_dressed: count("not_dressed"),
            failed: count("failed"),
            share: dressed as f64 / rows.len().max(1) as f64,
            processor_seconds,
            garments_per_core_hour: rate.is_finite().then_some(rate),
            unread_lines,
        }
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { garments, dressed, not_dressed, failed, processor_seconds, .. } = self;
        let percent = self.share * 100.0;
        write!(
            f,
            "{garments} garments: {dressed} dressed ({percent:.1} %), {not_dressed} with faults, {failed} failed"
        )?;
        write!(f, "; {processor_seconds:.0} s of processor")?;
        if let Some(rate) = self.garments_per_core_hour {
            write!(f, ", {rate:.0} garments an hour and core")?;
        }
        match self.unread_lines {
            0 => Ok(()),
            unread => write!(f, "; {unread} lines were not whole"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(garment: &str, finished: f64, more: &str) -> String {
        format!("{{\"garment\": \"{garment}\", \"finished\": {finished}, {more}}}\n")
    }

    #[test]
    fn the_newest_line_of_each_garment_counts_whatever_its_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let write =
            |name: &str, text: String| std::fs::write(folder.path().join(name), text).expect("written");
        let dressed = r#""outcome": "dressed", "processor_seconds": 1.5, "seams": {"open": 0}"#;
        let failed = r#""outcome": "failed", "error": "a, \"b\"", "processor_seconds": 0.5"#;
        write(
            "lines-1-of-2.jsonl",
            line("b", 5.0, failed) + &line("a", 1.0, failed) + "{\"garment\": \"c\", ",
        );
        write("lines.jsonl", line("a", 2.0, dressed) + &line("b", 4.0, dressed));
        let (newest, unread) = newest(folder.path()).expect("read");
        let rows: Vec<Row> =
            newest.into_iter().map(|(name, line)| row(folder.path(), &name, line, true)).collect();
        let outcomes: Vec<&str> = rows.iter().map(|row| row["outcome"].as_str()).collect();
        assert_eq!((outcomes, unread), (vec!["dressed", "failed"], 1));
        let summary = Summary::new(&rows, unread);
        assert_eq!((summary.garments, summary.dressed, summary.failed, summary.share), (2, 1, 1, 0.5));
        assert_eq!(summary.garments_per_core_hour, Some(3600.0));
        let table = String::from_utf8(table(&rows).expect("a table")).expect("text");
        let mut lines = table.lines();
        let heading = "garment,folder,project,outcome,exit_code,error,seconds,processor_seconds,finished,picture,seams.open";
        assert_eq!(lines.next(), Some(heading));
        assert!(
            lines.next().is_some_and(|row| row.starts_with("a,") && row.ends_with(",1.5,2,,0")),
            "{table}"
        );
        assert!(lines.next().is_some_and(|row| row.contains(",\"a, \"\"b\"\"\",")), "{table}");
    }

    #[test]
    fn lists_and_faults_are_cells() {
        let mut row = Row::new();
        let value = serde_json::json!({"open": ["a", "b"], "faults": [{"kind": "x", "place": "seam 1", "words": "open"}]});
        add(&mut row, "of", &value);
        assert_eq!((row["of.open"].as_str(), row["of.faults"].as_str()), ("a; b", "seam 1: open"));
    }
}
