//! What can go wrong, and the exit code of each kind.

use std::path::{Path, PathBuf};

use crate::io::words::readable;

/// The exit code of a panic.
pub const PANIC: u8 = 70;

/// Why the program did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// It was done, and a check failed.
    #[error("{0}")]
    Check(String),
    /// Arguments that do not go together.
    #[error("{0}")]
    Usage(String),
    /// An input that cannot be used.
    #[error("{}: {words}", shown(path))]
    Input { path: PathBuf, words: String },
    /// More than the program will take on.
    #[error("{0}")]
    Limit(String),
    /// No graphics adapter, or no display.
    #[error("{0}")]
    Graphics(String),
    /// The file system said no.
    #[error("{}: {error}", shown(path))]
    File { path: PathBuf, error: std::io::Error },
    /// The simulation failed inside.
    #[error("{0}")]
    Internal(String),
    /// A signal came.
    #[error("stopped by signal {0}; no file is half written")]
    Signal(u8),
}

fn shown(path: &Path) -> String {
    readable(&path.display().to_string())
}

impl Failure {
    /// An input at `path` that cannot be used.
    pub fn input(path: &Path, words: impl std::fmt::Display) -> Self {
        Self::Input { path: path.to_owned(), words: readable(&words.to_string()) }
    }

    /// A file at `path` that could not be read or written.
    pub fn file(path: &Path, error: std::io::Error) -> Self {
        Self::File { path: path.to_owned(), error }
    }

    /// As in the README's table.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Check(_) => 1,
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
