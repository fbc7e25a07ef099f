//! Files and built-in samples named on the command line.

use std::io::{Error, ErrorKind};
use std::path::Path;

use crate::cli::failure::Failure;
use crate::draft::SIZE_TABLES;
use crate::geometry::names;
use crate::geometry::words::words;
use crate::io::{FILE_BYTES, rul};
use crate::session::samples::Sample;
use crate::session::whole_file;

/// Prefix of the names of built-in samples.
const SAMPLE: &str = "sample:";
/// Prefix of the names of built-in tables of sizes.
const SIZES: &str = "sizes:";
/// The name of the built-in figure for `--body`.
pub const MANNEQUIN: &str = "mannequin";

/// Whether `path` names a built-in sample.
pub fn is_sample(path: &Path) -> bool {
    sample_name(path).is_some()
}

/// The name of the built-in sample that `path` names, without the prefix; None for a file.
pub fn sample_name(path: &Path) -> Option<&str> {
    path.to_str()?.strip_prefix(SAMPLE)
}

/// The name of the built-in table of sizes that `path` names, without the prefix; None for a file.
pub fn table_name(path: &Path) -> Option<&str> {
    path.to_str()?.strip_prefix(SIZES)
}

/// The table of sizes that `path` names, CSV: a file, or one that is built in.
pub fn table_of_sizes(path: &Path) -> Result<Vec<u8>, Failure> {
    let Some(name) = table_name(path) else { return read(path) };
    let found =
        names::found(SIZE_TABLES.iter().map(|table| table.name), name).and_then(|i| SIZE_TABLES.get(i));
    found.map(|table| table.csv().into_bytes()).ok_or_else(|| {
        let names = SIZE_TABLES.map(|table| table.name).join(", ");
        Failure::input(path, format!("there is no such table of sizes; there are {names}"))
    })
}

/// The name without folder, extension and "sample:".
pub fn name_of(path: &Path) -> String {
    match sample_name(path) {
        Some(name) => name.to_owned(),
        None => path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
    }
}

/// The bytes that identify what `path` names: the contents of a file or table, or the name of a sample or the mannequin.
pub fn bytes_of(path: &Path) -> Result<Vec<u8>, Failure> {
    match path.to_str() {
        Some(name) if is_sample(path) || name == MANNEQUIN => Ok(name.as_bytes().to_vec()),
        _ => table_of_sizes(path),
    }
}

/// The grade rule table beside a DXF, if there is one.
pub fn rules_beside(path: &Path) -> Result<Option<Vec<u8>>, Failure> {
    let mut names = rul::names_beside(path).into_iter();
    names.find(|name| name.is_file()).map(|name| read(&name)).transpose()
}

/// Reads the whole file at `path`. Where there is none, but a sample of that name, the failure says so.
pub fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    whole_file::read(path, FILE_BYTES).map_err(|error| match error.kind() {
        ErrorKind::FileTooLarge => Failure::Limit(format!("{}: {error}", path.display())),
        ErrorKind::NotFound => Failure::file(path, meant(path).unwrap_or(error)),
        _ => Failure::file(path, error),
    })
}

/// The error of a file that is not there and is called like a sample.
fn meant(path: &Path) -> Option<Error> {
    let sample = Sample::named(path.to_str()?)?.file_stem();
    let words = words!("there is no such file or folder; the sample of this name is sample:{sample}", sample);
    Some(whole_file::told(ErrorKind::NotFound, words))
}
