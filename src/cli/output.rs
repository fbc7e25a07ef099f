//! Printing and writing. A closed output does not end the program; a file is written whole or not at all.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};

use crate::cli::failure::Failure;
use crate::session::whole_file;

/// Prints a line on standard output. A closed output is no failure.
pub fn say(words: &str) {
    let mut out = std::io::stdout().lock();
    out.write_all(words.as_bytes()).and_then(|()| out.write_all(b"\n")).and_then(|()| out.flush()).ok();
}

/// Prints a line on standard error.
pub fn complain(words: &str) {
    let mut err = std::io::stderr().lock();
    err.write_all(words.as_bytes()).and_then(|()| err.write_all(b"\n")).ok();
}

/// Whether standard error is a terminal.
pub fn is_watched() -> bool {
    std::io::stderr().is_terminal()
}

/// Overwrites the last line of standard error with a progress message, on a terminal only.
pub fn progress(words: &str) {
    if is_watched() {
        let mut err = std::io::stderr().lock();
        write!(err, "\r\x1b[K{words}").and_then(|()| err.flush()).ok();
    }
}

/// Removes the file at `path`; no error if it does not exist.
pub fn take_away(path: &Path) -> Result<(), Failure> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(Failure::file(path, error)),
        _ => Ok(()),
    }
}

/// Writes `bytes` to `path` atomically: on failure the old file remains.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    whole_file::write(path, bytes).map_err(|error| Failure::file(path, error))
}

/// Writes all of `files`, in this order, or none: a signal ends the program before all of them or after.
pub fn write_together(files: &[(PathBuf, Vec<u8>)]) -> Result<(), Failure> {
    whole_file::write_together(files).map_err(|(path, error)| Failure::file(&path, error))
}

/// Removes from `folder`, in which nobody else writes, what a killed run has left.
pub fn sweep(folder: &Path) {
    whole_file::sweep(folder);
}

/// Makes `folder` and its parents. If a signal comes while they are empty, they are removed again.
pub fn make_folder(folder: &Path) -> Result<(), Failure> {
    whole_file::make_folder(folder).map_err(|error| Failure::file(folder, error))
}
