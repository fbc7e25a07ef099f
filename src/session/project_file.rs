//! Project files (`.toile`): plain JSON when small, else a zip of the same JSON with its long arrays as binary entries.
//!
//! A file on disk is always the whole old or the whole new version: the new bytes are parsed once as a check, written next to the
//! old file, then renamed over it. The previous version stays as `NAME.toile.bak`.

use std::io::{Cursor, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::{fmt, fs};

use glam::DVec3;
use serde::{Deserialize, Serialize};
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use crate::cloth::ClothState;
use crate::geometry::mesh::TriMesh;
use crate::geometry::words::{Words, within_quotes, words};
use crate::io::FILE_BYTES;
use crate::io::words::readable_words;
use crate::session::body_choice::BodyChoice;
use crate::session::project::Project;
use crate::session::whole_file;

/// Value of the `format` field of project files.
pub const FORMAT: &str = "toile-project";
/// Newest format version that this program reads, and the one it writes.
pub const VERSION: u32 = 1;
/// Most bytes of a file, and of all its entries unpacked.
const MOST_BYTES: u64 = FILE_BYTES;
/// Most entries of a zip.
const MOST_ENTRIES: usize = 64;

const JSON_ENTRY: &str = "project.json";
const BODY_POSITIONS: &str = "body-positions.f64";
const BODY_TRIANGLES: &str = "body-triangles.u32";
const CLOTH_POSITIONS: &str = "cloth-positions.f64";
const CLOTH_MAPPED: &str = "cloth-mapped.u8";

/// Why a project file could not be read or written.
#[derive(Debug)]
pub enum ProjectFileError {
    /// Error of the file system.
    File { path: PathBuf, source: std::io::Error },
    /// The contents are not a valid project.
    Contents(Words),
    /// The file is larger than this program reads.
    TooLarge(Words),
}

impl ProjectFileError {
    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::File { path, source } => {
                Words::plain(path.display().to_string()).and(": ", whole_file::words(source))
            }
            Self::Contents(words) | Self::TooLarge(words) => words.clone(),
        }
    }
}

impl fmt::Display for ProjectFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.words().fmt(f)
    }
}

impl std::error::Error for ProjectFileError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::File { source, .. } => Some(source),
            Self::Contents(_) | Self::TooLarge(_) => None,
        }
    }
}

fn contents(words: Words) -> ProjectFileError {
    ProjectFileError::Contents(readable_words(words))
}

/// The error for what a library says against the contents.
fn library(error: impl fmt::Display) -> ProjectFileError {
    contents(Words::plain(error.to_string()))
}

/// The error for contents that are no project, for the reason `why` of a library.
fn no_project(why: impl fmt::Display) -> ProjectFileError {
    contents(words!("not a project: {why}", why = why.to_string()))
}

/// The error for contents that begin like an archive and cannot be opened as one. Its directory is at the end.
fn no_archive(why: ZipError) -> ProjectFileError {
    match why {
        ZipError::InvalidArchive(_) => {
            contents(words!("not a project, or one that is cut off: the end of the file is missing"))
        }
        why => no_project(why),
    }
}

#[derive(Serialize, Deserialize)]
struct File {
    format: String,
    version: u32,
    project: Project,
}

#[derive(Deserialize)]
struct AnyFile {
    format: String,
    version: u32,
}

/// Whether `bytes` look like a file of this program rather than some other kind of file.
pub fn is_project(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK")
        || serde_json::from_slice::<AnyFile>(bytes).is_ok_and(|any| any.format.starts_with("toile-"))
}

/// Reads the file at `path`.
pub fn open(path: &Path) -> Result<Project, ProjectFileError> {
    let bytes = whole_file::read(path, MOST_BYTES).map_err(|source| match source.kind() {
        std::io::ErrorKind::FileTooLarge => ProjectFileError::TooLarge(whole_file::words(&source)),
        _ => file_error(path, source),
    })?;
    from_bytes(&bytes)
}

/// Writes `project` to `path`; the previous version stays as `PATH.bak`. A write-protected file is refused.
pub fn save(path: &Path, project: &Project) -> Result<(), ProjectFileError> {
    whole_file::refuse_protected(path).map_err(|source| file_error(path, source))?;
    save_over(path, project)
}

/// Writes `project` like [`save`], but also over a write-protected file.
pub fn save_over(path: &Path, project: &Project) -> Result<(), ProjectFileError> {
    let bytes = to_bytes(project)?;
    if from_bytes(&bytes)? != *project {
        return Err(contents(words!("the project did not survive being written: nothing was saved")));
    }
    with_backup(path, &bytes).map_err(|source| file_error(path, source))
}

fn file_error(path: &Path, source: std::io::Error) -> ProjectFileError {
    ProjectFileError::File { path: path.to_owned(), source }
}

fn with_backup(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let old = match fs::read(path) {
        Ok(old) => old,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return whole_file::replace(path, bytes);
        }
        Err(error) => return Err(error),
    };
    let mut backup = path.as_os_str().to_owned();
    backup.push(".bak");
    whole_file::replace_in_turn(&[(Path::new(&backup), &old), (path, bytes)])
}

/// The project in `bytes`.
pub fn from_bytes(bytes: &[u8]) -> Result<Project, ProjectFileError> {
    let project = if bytes.starts_with(b"PK") { from_zip(bytes)? } else { from_json(bytes)? };
    match project.problem() {
        Some(words) => Err(contents(words)),
        None => Ok(project),
    }
}

/// The content of a project file with `project`.
pub fn to_bytes(project: &Project) -> Result<Vec<u8>, ProjectFileError> {
    let document = &project.document;
    let has_images = !document.artwork.images.is_empty();
    let small = project.dressed.is_none() && document.body == BodyChoice::default() && !has_images;
    if small { to_json(project) } else { to_zip(project) }
}

fn from_json(bytes: &[u8]) -> Result<Project, ProjectFileError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.trim_ascii().is_empty() {
        return Err(contents(words!("the file is empty")));
    }
    let any: AnyFile = serde_json::from_slice(bytes).map_err(no_project)?;
    if any.format != FORMAT {
        return Err(contents(words!(
            "this is a \"{format}\", not a project",
            format = within_quotes(&any.format)
        )));
    }
    if any.version > VERSION {
        return Err(contents(words!(
            "project version {version}, made by a newer program: this one reads up to version {newest}",
            version = any.version,
            newest = VERSION
        )));
    }
    if any.version == 0 {
        return Err(contents(words!("there is no project version 0")));
    }
    let file: File = serde_json::from_slice(bytes).map_err(no_project)?;
    Ok(file.project)
}

fn to_json(project: &Project) -> Result<Vec<u8>, ProjectFileError> {
    let file = File { format: FORMAT.to_owned(), version: VERSION, project: project.clone() };
    let mut bytes = serde_json::to_vec_pretty(&file).map_err(library)?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// Writes the arrays as little-endian binary entries, and empty in the JSON.
fn to_zip(project: &Project) -> Result<Vec<u8>, ProjectFileError> {
    let mut bare = project.clone();
    let mut entries: Vec<(&str, Vec<u8>)> = Vec::new();
    if let BodyChoice::Imported { mesh, .. } = &mut bare.document.body {
        entries.push((BODY_POSITIONS, point_bytes(&mesh.positions)));
        entries
            .push((BODY_TRIANGLES, mesh.triangles.iter().flatten().flat_map(|v| v.to_le_bytes()).collect()));
        *mesh = Arc::default();
    }
    if let Some(dressed) = &mut bare.dressed {
        entries.push((CLOTH_POSITIONS, point_bytes(&dressed.cloth.positions)));
        entries.push((CLOTH_MAPPED, dressed.cloth.mapped.iter().map(|&m| u8::from(m)).collect()));
        dressed.cloth = Arc::default();
    }
    entries.insert(0, (JSON_ENTRY, to_json(&bare)?));
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    // The same project gives the same bytes: entries carry no time.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(zip::DateTime::default());
    for (name, bytes) in &entries {
        zip.start_file(*name, options).map_err(library)?;
        zip.write_all(bytes).map_err(library)?;
    }
    Ok(zip.finish().map_err(library)?.into_inner())
}

fn from_zip(bytes: &[u8]) -> Result<Project, ProjectFileError> {
    let mut zip = ZipArchive::new(Cursor::new(bytes)).map_err(no_archive)?;
    if zip.len() > MOST_ENTRIES {
        return Err(ProjectFileError::TooLarge(words!("the file has {n} entries", n = zip.len())));
    }
    let mut left = MOST_BYTES;
    let json = entry(&mut zip, JSON_ENTRY, &mut left)?;
    let mut project = from_json(&json)?;
    if let BodyChoice::Imported { mesh, .. } = &mut project.document.body {
        let positions = points(&entry(&mut zip, BODY_POSITIONS, &mut left)?)?;
        let triangles = triangles(&entry(&mut zip, BODY_TRIANGLES, &mut left)?, positions.len())?;
        *mesh = Arc::new(TriMesh { positions, triangles });
    }
    if let Some(dressed) = &mut project.dressed {
        let positions = points(&entry(&mut zip, CLOTH_POSITIONS, &mut left)?)?;
        let mapped = entry(&mut zip, CLOTH_MAPPED, &mut left)?.iter().map(|&b| b != 0).collect();
        dressed.cloth = Arc::new(ClothState { positions, mapped });
    }
    Ok(project)
}

fn damaged(why: &Words) -> ProjectFileError {
    contents(words!("the project is damaged: {why}", why))
}

/// Content of an entry; never more than `left` bytes, whatever size the entry claims.
fn entry(
    zip: &mut ZipArchive<Cursor<&[u8]>>,
    name: &str,
    left: &mut u64,
) -> Result<Vec<u8>, ProjectFileError> {
    let file = zip.by_name(name).map_err(|e| no_project(format!("{name}: {e}")))?;
    let mut bytes = Vec::new();
    file.take(*left + 1)
        .read_to_end(&mut bytes)
        .map_err(|e| damaged(&Words::plain(format!("{name}: {e}"))))?;
    match left.checked_sub(bytes.len() as u64) {
        Some(rest) => *left = rest,
        None => {
            let words = words!("the project unpacks to over {most} bytes", most = MOST_BYTES);
            return Err(ProjectFileError::TooLarge(words));
        }
    }
    Ok(bytes)
}

fn point_bytes(points: &[DVec3]) -> Vec<u8> {
    points.iter().flat_map(|p| p.to_array()).flat_map(f64::to_le_bytes).collect()
}

fn points(bytes: &[u8]) -> Result<Vec<DVec3>, ProjectFileError> {
    let (points, rest) = bytes.as_chunks::<24>();
    if !rest.is_empty() {
        return Err(damaged(&words!("an array of points ends in the middle of one")));
    }
    let number = |b: &[u8]| f64::from_le_bytes(b.try_into().unwrap_or_default());
    Ok(points.iter().map(|p| DVec3::new(number(&p[..8]), number(&p[8..16]), number(&p[16..]))).collect())
}

fn triangles(bytes: &[u8], vertex_count: usize) -> Result<Vec<[u32; 3]>, ProjectFileError> {
    let (triangles, rest) = bytes.as_chunks::<12>();
    let number = |b: &[u8]| u32::from_le_bytes(b.try_into().unwrap_or_default());
    let triangles: Vec<[u32; 3]> =
        triangles.iter().map(|t| [number(&t[..4]), number(&t[4..8]), number(&t[8..])]).collect();
    if !rest.is_empty() || triangles.iter().flatten().any(|&v| v as usize >= vertex_count) {
        return Err(damaged(&words!("a triangle of the body names a vertex that is not there")));
    }
    Ok(triangles)
}
