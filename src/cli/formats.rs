//! The formats of `io` as the command line names them.

use std::path::Path;

use crate::body::Unit;
use crate::body::import::{Imported, import};
use crate::body::unit::guess_unit;
use crate::cli::arguments::BodyFile;
use crate::cli::failure::Failure;
use crate::cli::output;
use crate::cloth::{ClothState, Garment};
use crate::geometry::mesh::TriMesh;
use crate::io::pattern_file::{self, PatternFileError};
use crate::io::pdf::{self, Paper, PdfError};
use crate::io::scale::DrawingUnit;
use crate::io::{Written, dxf, garmentcode, glb, obj, svg};
use crate::pattern::Pattern;

/// A pattern in a file of one of the known formats. Doubts about it are told.
pub fn pattern(path: &Path, bytes: &[u8], scale: Option<DrawingUnit>) -> Result<Pattern, Failure> {
    let read = pattern_file::read(bytes, scale).map_err(|error| match error {
        PatternFileError::OverLimit(words) => Failure::Limit(format!("{}: {words}", path.display())),
        PatternFileError::Scale(question) => {
            Failure::input(path, format!("{question}: say which with --scale"))
        }
        error => Failure::input(path, error),
    })?;
    for note in &read.notes {
        output::complain(&format!("{}: note: {note}", path.display()));
    }
    Ok(read.pattern)
}

/// A pattern as a file with this ending: json, dxf, svg or pdf.
pub fn pattern_bytes(ending: &str, pattern: &Pattern, name: &str, paper: Paper) -> Result<Written, PdfError> {
    match ending {
        "json" => Ok(garmentcode::write(pattern)),
        "dxf" => Ok(dxf::write(pattern)),
        "svg" => Ok(svg::write(pattern)),
        _ => pdf::write(pattern, name, paper),
    }
}

/// The body in an OBJ file, upright and checked. Without a unit the one that gives a person's height is taken, and said.
pub fn body(path: &Path, bytes: &[u8], how: BodyFile) -> Result<Imported, Failure> {
    let mut read = obj::read(bytes).map_err(|error| match error {
        obj::ObjError::OverLimit(words) => Failure::Limit(format!("{}: {words}", path.display())),
        error => Failure::input(path, error),
    })?;
    how.up.set_upright(&mut read.mesh);
    let unit = match how.unit {
        Some(unit) => unit,
        None => unit_by_height(path, &read.mesh)?,
    };
    Ok(import(read.mesh, unit))
}

fn unit_by_height(path: &Path, mesh: &TriMesh) -> Result<Unit, Failure> {
    let (lower, upper) = mesh.bounds();
    let height = upper.y - lower.y;
    let Some(unit) = guess_unit(height) else {
        let words = format!(
            "it is {height} units high, which no unit makes a body's height: give one with --unit, or --up z where it lies"
        );
        return Err(Failure::input(path, words));
    };
    if unit != Unit::Metre {
        output::complain(&format!("{}: taken to be in {unit}, by its height (see --unit)", path.display()));
    }
    Ok(unit)
}

/// A body as OBJ text.
pub fn body_obj(mesh: &TriMesh) -> Vec<u8> {
    obj::mesh("body", mesh).into_bytes()
}

/// Dressed cloth as OBJ text.
pub fn garment_obj(garment: &Garment, cloth: &ClothState, pattern: &Pattern) -> Vec<u8> {
    obj::garment(garment, cloth, pattern).into_bytes()
}

/// Dressed cloth on its body as binary glTF.
pub fn scene_glb(
    garment: &Garment,
    cloth: &ClothState,
    pattern: &Pattern,
    body: Option<&TriMesh>,
) -> Result<Vec<u8>, Failure> {
    let dressed = glb::Dressed { garment, state: cloth, pattern };
    glb::write(Some(dressed), body, &glb::Colours::default()).map_err(|e| Failure::Limit(e.to_string()))
}
