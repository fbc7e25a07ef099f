//! The formats of `io` as the command line names them.

use std::path::Path;

use crate::cli::arguments::Unit;
use crate::cli::failure::Failure;
use crate::geometry::mesh::TriMesh;
use crate::io::garmentcode;
use crate::pattern::{Pattern, Problem};

/// A body read from a file.
pub struct ImportedBody {
    /// Metres.
    pub mesh: TriMesh,
    /// What is wrong with it.
    pub problems: Vec<Problem>,
}

/// A pattern in a file of one of the known formats.
pub fn pattern(path: &Path, bytes: &[u8]) -> Result<Pattern, Failure> {
    garmentcode::read(bytes).map_err(|e| Failure::input(path, e))
}
