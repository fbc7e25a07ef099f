//! The kinds of failures of the program, and the exit code of each.

use std::path::{Path, PathBuf};

use crate::io::words::readable;
use crate::session::whole_file;

/// Exit code after a panic.
pub const PANIC: u8 = 70;

/// Why the program did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The work was done, and a check of its result failed.
    #[error("{0}")]
    Check(String),
    /// A garment is not dressed: its faults, each with its place; then what was tried and what to do, which are told after them.
    #[error("{}", faults.join("; "))]
    Faults { faults: Vec<String>, then: Vec<String> },
    /// The arguments contradict each other.
    #[error("{0}")]
    Usage(String),
    /// An input cannot be used.
    #[error("{}: {words}", shown(path))]
    Input { path: PathBuf, words: String },
    /// The work exceeds a limit of the program.
    #[error("{0}")]
    Limit(String),
    /// There is no graphics adapter, or no display, or it was lost.
    #[error("{0}")]
    Graphics(String),
    /// A file could not be read or written.
    #[error("{}: {}", shown(path), whole_file::words(error))]
    File { path: PathBuf, error: std::io::Error },
    /// Internal error of the simulation.
    #[error("{0}")]
    Internal(String),
    /// A signal stopped the program.
    #[error("stopped by signal {0}; no file is half written")]
    Signal(u8),
}

fn shown(path: &Path) -> String {
    readable(&path.display().to_string())
}

impl Failure {
    /// The failure of an input at `path` that cannot be used.
    pub fn input(path: &Path, words: impl std::fmt::Display) -> Self {
        Self::Input { path: path.to_owned(), words: readable(&words.to_string()) }
    }

    /// The failure of a file at `path` that could not be read or written.
    pub fn file(path: &Path, error: std::io::Error) -> Self {
        Self::File { path: path.to_owned(), error }
    }

    /// The failure of several garments, of which `count` of `all` are not dressed.
    pub fn not_dressed(count: usize, all: usize) -> Self {
        let are = if count == 1 { "is" } else { "are" };
        Self::Check(format!("{count} of {all} {are} not dressed"))
    }

    /// The exit code, as in the README's table.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Check(_) | Self::Faults { .. } => 1,
            Self::Usage(_) => 2,
            Self::Input { .. } => 3,
            Self::Limit(_) => 4,
            Self::Graphics(_) => 5,
            Self::File { .. } => 6,
            Self::Internal(_) => PANIC,
            Self::Signal(number) => 128 + number,
        }
    }
}
