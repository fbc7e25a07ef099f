//! The formats of `io` as the command line names them.

use std::path::Path;

use crate::cli::arguments::Unit;
use crate::cli::failure::Failure;
use crate::cloth::{ClothState, Garment};
use crate::geometry::mesh::TriMesh;
use crate::io::{garmentcode, obj};
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

/// The body in an OBJ file.
pub fn body(path: &Path, bytes: &[u8], unit: Option<Unit>) -> Result<ImportedBody, Failure> {
    let read = obj::read(bytes).map_err(|error| match error {
        obj::ObjError::OverLimit(words) => Failure::Limit(format!("{}: {words}", path.display())),
        error => Failure::input(path, error),
    })?;
    let _ = unit;
    Ok(ImportedBody { mesh: read.mesh, problems: Vec::new() })
}

/// A body as OBJ text.
pub fn body_obj(mesh: &TriMesh) -> Vec<u8> {
    obj::mesh("body", mesh).into_bytes()
}

/// Dressed cloth as OBJ text.
pub fn garment_obj(garment: &Garment, cloth: &ClothState, pattern: &Pattern) -> Vec<u8> {
    obj::garment(garment, cloth, pattern).into_bytes()
}
