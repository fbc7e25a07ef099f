//! Bodies from files, whichever format they are in: OBJ, or glTF as text or binary.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::geometry::mesh::TriMesh;
use crate::geometry::words::{Words, within_quotes, words};
use crate::io::gltf::{self, GltfError};
use crate::io::obj::{self, ObjError};
use crate::io::words::readable_words;

/// Why a file cannot be read as a body.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub enum BodyFileError {
    /// What is wrong, and where.
    File(Words),
    /// The file exceeds a limit; the text names it.
    OverLimit(Words),
}

impl BodyFileError {
    /// The error in words.
    pub fn words(&self) -> &Words {
        match self {
            Self::File(words) | Self::OverLimit(words) => words,
        }
    }
}

impl From<ObjError> for BodyFileError {
    fn from(error: ObjError) -> Self {
        let words = error.words();
        if matches!(error, ObjError::OverLimit(_)) { Self::OverLimit(words) } else { Self::File(words) }
    }
}

impl From<GltfError> for BodyFileError {
    fn from(error: GltfError) -> Self {
        let words = error.words();
        if matches!(error, GltfError::OverLimit(_)) { Self::OverLimit(words) } else { Self::File(words) }
    }
}

/// Reads the mesh of a body from `bytes` (glTF or OBJ, told by the bytes), in the file's unit and axes. `path` is the file's own
/// path; `load` reads a buffer file that a glTF file names, from the same folder, or gives the error in words.
pub fn read(
    path: &Path,
    bytes: &[u8],
    load: &dyn Fn(&Path) -> Result<Vec<u8>, String>,
) -> Result<TriMesh, BodyFileError> {
    match gltf::is_gltf(bytes) {
        true => Ok(model(path, bytes, load)?.mesh()),
        false => Ok(obj::read(bytes)?.mesh),
    }
}

/// Reads the glTF scene in `bytes`. `path` and `load` are as in [`read`].
pub fn model(
    path: &Path,
    bytes: &[u8],
    load: &dyn Fn(&Path) -> Result<Vec<u8>, String>,
) -> Result<gltf::Model, BodyFileError> {
    Ok(gltf::read(bytes, &|name| load(&beside(path, name)?).map_err(Words::plain))?)
}

/// Reads the glTF scene in `bytes` as [`model`] does, and returns with it the contents of the buffer files it names, by name.
pub fn model_with_buffers(
    path: &Path,
    bytes: &[u8],
    load: &dyn Fn(&Path) -> Result<Vec<u8>, String>,
) -> Result<(gltf::Model, BTreeMap<String, Vec<u8>>), BodyFileError> {
    let buffers = RefCell::new(BTreeMap::new());
    let kept = |name: &str| {
        let bytes = load(&beside(path, name)?).map_err(Words::plain)?;
        buffers.borrow_mut().insert(name.to_owned(), bytes.clone());
        Ok(bytes)
    };
    let model = gltf::read(bytes, &kept)?;
    Ok((model, buffers.into_inner()))
}

/// The path of the file called `name` in the folder of `path`. Names that lead out of that folder are refused, since the file
/// that names them is not trusted.
fn beside(path: &Path, name: &str) -> Result<PathBuf, Words> {
    let name = name.replace("%20", " ");
    let is_plain = |part: std::path::Component<'_>| matches!(part, std::path::Component::Normal(_));
    let is_inside =
        !name.is_empty() && !name.contains([':', '\\']) && Path::new(&name).components().all(is_plain);
    match is_inside {
        true => Ok(path.parent().unwrap_or(Path::new("")).join(name)),
        false => {
            let name = within_quotes(&name);
            Err(readable_words(words!("its buffer \"{name}\" is not a file in its folder", name)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_in_its_folder_are_opened() {
        let of = |name: &str| beside(Path::new("bodies/one.gltf"), name);
        assert_eq!(of("one%20a.bin"), Ok(PathBuf::from("bodies/one a.bin")));
        assert_eq!(of("parts/one.bin"), Ok(PathBuf::from("bodies/parts/one.bin")));
        for name in
            ["/etc/passwd", "../one.bin", "a/../../b", "http://somewhere/one.bin", "C:one", "", "..\\b"]
        {
            assert!(of(name).is_err(), "{name}");
        }
    }
}
