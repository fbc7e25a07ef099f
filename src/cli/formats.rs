//! Reads and writes the formats of `io` for the command line, with its failures and messages.

use std::path::Path;
use std::sync::Arc;

use crate::body::Unit;
use crate::body::import::{Imported, import};
use crate::body::unit::guess_unit;
use crate::cli::arguments::BodyFile;
use crate::cli::failure::Failure;
use crate::cli::{files, output};
use crate::cloth::{ClothState, Garment};
use crate::geometry::mesh::TriMesh;
use crate::io::body_file::{self, BodyFileError};
use crate::io::dressed::{Dressed, Frame};
use crate::io::glb::animated::write_animated;
use crate::io::materials::Colours;
use crate::io::pattern_file::PatternFileError;
use crate::io::pattern_formats;
use crate::io::scale::DrawingUnit;
use crate::io::usd::UsdScene;
use crate::io::{gltf, obj};
use crate::pattern::Pattern;
use crate::session::{AnimatedFile, Animations};
use crate::ui::scenery::worn::packed_image;

/// Reads a pattern file of one of the known formats. Notes about it are printed.
pub fn pattern(path: &Path, bytes: &[u8], scale: Option<DrawingUnit>) -> Result<Pattern, Failure> {
    let rules = files::rules_beside(path)?;
    let read = pattern_formats::read_with_rules(bytes, scale, rules.as_deref());
    let read = read.map_err(|error| match error {
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

/// Reads a body file (OBJ, glTF), makes it upright and checks it. Without a given unit the one that gives a person's height is
/// taken, and printed.
pub fn body(path: &Path, bytes: &[u8], how: BodyFile) -> Result<Imported, Failure> {
    let mesh = body_mesh(path, bytes, how)?;
    let unit = body_unit(path, bytes, &mesh, how)?;
    Ok(import(mesh, unit))
}

/// Reads the mesh of a body file, upright but in the file's own unit.
pub fn body_mesh(path: &Path, bytes: &[u8], how: BodyFile) -> Result<TriMesh, Failure> {
    let mut mesh = body_file::read(path, bytes, &neighbour).map_err(|error| body_failure(path, error))?;
    how.up.unwrap_or_default().set_upright(&mut mesh);
    Ok(mesh)
}

/// Reads a glTF scene.
pub fn model(path: &Path, bytes: &[u8]) -> Result<gltf::Model, Failure> {
    body_file::model(path, bytes, &neighbour).map_err(|error| body_failure(path, error))
}

/// Reads the animations of a body file, with the same unit and axis as [`body`]; None where there are none.
pub fn animations(path: &Path, bytes: &[u8], how: BodyFile) -> Result<Option<Arc<Animations>>, Failure> {
    if !gltf::is_gltf(bytes) {
        return Ok(None);
    }
    let read = body_file::model_with_buffers(path, bytes, &neighbour);
    let (model, buffers) = read.map_err(|error| body_failure(path, error))?;
    if model.animations().next().is_none() {
        return Ok(None);
    }
    let (mut mesh, up) = (model.mesh(), how.up.unwrap_or_default());
    up.set_upright(&mut mesh);
    let unit = known_unit(path, bytes, &mesh, how)?;
    let file = AnimatedFile { name: files::name_of(path), bytes: bytes.to_vec(), buffers, up, unit };
    let (animations, _) = Animations::new(file).map_err(|words| Failure::input(path, words))?;
    Ok(Some(Arc::new(animations)))
}

/// The unit of a body that [`body_mesh`] read. It is printed if it is guessed from the height and is not the metre.
pub fn body_unit(path: &Path, bytes: &[u8], mesh: &TriMesh, how: BodyFile) -> Result<Unit, Failure> {
    let unit = known_unit(path, bytes, mesh, how)?;
    if how.unit.is_none() && unit != Unit::Metre {
        output::complain(&format!("{}: taken to be in {unit}, by its height (see --unit)", path.display()));
    }
    Ok(unit)
}

fn known_unit(path: &Path, bytes: &[u8], mesh: &TriMesh, how: BodyFile) -> Result<Unit, Failure> {
    let (lower, upper) = mesh.bounds();
    match how.unit {
        Some(unit) => Ok(unit),
        // glTF is in metres by the format, unless the height then is not a person's and another unit makes it so.
        None if gltf::is_gltf(bytes) && guess_unit(upper.y - lower.y).is_none() => Ok(Unit::Metre),
        None => unit_by_height(path, mesh),
    }
}

/// Checks that `body` has the triangles of the dressed one; the error names `path` and the difference.
pub fn same_triangles(path: &Path, body: &TriMesh, dressed: &TriMesh) -> Result<(), Failure> {
    let counts = |mesh: &TriMesh| [mesh.positions.len(), mesh.triangles.len()];
    let words = match (counts(body), counts(dressed)) {
        (is, was) if is == was && body.triangles == dressed.triangles => return Ok(()),
        (is, was) if is == was => {
            "its triangles join other vertices than those of the dressed body".to_owned()
        }
        ([v, t], [was_v, was_t]) => {
            format!("it has {v} vertices and {t} triangles, the dressed body {was_v} and {was_t}")
        }
    };
    Err(Failure::input(path, words))
}

fn neighbour(path: &Path) -> Result<Vec<u8>, String> {
    files::read(path).map_err(|failure| failure.to_string())
}

fn body_failure(path: &Path, error: BodyFileError) -> Failure {
    match error {
        BodyFileError::OverLimit(words) => Failure::Limit(format!("{}: {words}", path.display())),
        error => Failure::input(path, error),
    }
}

/// The unit that gives `mesh` the height of a person.
fn unit_by_height(path: &Path, mesh: &TriMesh) -> Result<Unit, Failure> {
    let (lower, upper) = mesh.bounds();
    let height = upper.y - lower.y;
    guess_unit(height).ok_or_else(|| {
        let words = format!(
            "it is {height} units high, which no unit makes a body's height: give one with --unit, or --up z where it lies"
        );
        Failure::input(path, words)
    })
}

/// A body mesh as OBJ text.
pub fn body_obj(mesh: &TriMesh) -> Vec<u8> {
    obj::mesh("body", mesh).into_bytes()
}

/// Dressed cloth as OBJ text.
pub fn garment_obj(garment: &Garment, cloth: &ClothState, pattern: &Pattern) -> Vec<u8> {
    obj::garment(garment, cloth, pattern).into_bytes()
}

/// Dressed cloth with its trims and its body as animated binary glTF.
pub fn sequence_glb(
    dressed: Dressed<'_>,
    body: &TriMesh,
    frames: &[Frame],
    fps: f64,
    colours: &Colours,
) -> Result<Vec<u8>, Failure> {
    write_animated(dressed, body, frames, fps, colours).map_err(|e| Failure::Limit(e.to_string()))
}

/// Dressed cloth and its body as USD with a time sample for each frame, in one file.
pub fn sequence_usdz(
    dressed: Dressed<'_>,
    body: &TriMesh,
    frames: &[Frame],
    fps: f64,
    colours: &Colours,
) -> Result<Vec<u8>, Failure> {
    let scene = UsdScene::moving(dressed, body, frames, fps, colours, packed_image);
    scene.and_then(|scene| scene.package()).map_err(|e| Failure::Limit(e.to_string()))
}
