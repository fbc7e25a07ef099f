//! What the command line names: files, and what is built in.

use std::path::Path;

use crate::cli::failure::Failure;
use crate::io::FILE_BYTES;
use crate::session::whole_file;

/// Begins the name of a built-in sample.
const SAMPLE: &str = "sample:";
/// What `--body` calls the built-in figure.
pub const MANNEQUIN: &str = "mannequin";

/// Whether `path` names a built-in sample.
pub fn is_sample(path: &Path) -> bool {
    sample_name(path).is_some()
}

/// The name of a built-in sample.
pub fn sample_name(path: &Path) -> Option<&str> {
    path.to_str()?.strip_prefix(SAMPLE)
}

/// The name without folder, ending and "sample:".
pub fn name_of(path: &Path) -> String {
    match sample_name(path) {
        Some(name) => name.to_owned(),
        None => path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
    }
}

/// The bytes that `path` stands for: those of the file, or the name of what is built in.
pub fn bytes_of(path: &Path) -> Result<Vec<u8>, Failure> {
    match path.to_str() {
        Some(name) if is_sample(path) || name == MANNEQUIN => Ok(name.as_bytes().to_vec()),
        _ => read(path),
    }
}

/// All of the file at `path`.
pub fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    whole_file::read(path, FILE_BYTES).map_err(|error| match error.kind() {
        std::io::ErrorKind::FileTooLarge => Failure::Limit(format!("{}: {error}", path.display())),
        _ => Failure::file(path, error),
    })
}
