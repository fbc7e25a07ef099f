//! Bodies from files, whichever format they are in: OBJ, or glTF as text or binary.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::geometry::mesh::TriMesh;
use crate::io::gltf::{self, GltfError};
use crate::io::obj::{self, ObjError};
use crate::io::words::readable;

/// Why a file is no body.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BodyFileError {
    /// What is wrong, and where.
    #[error("{0}")]
    File(String),
    /// More than is read.
    #[error("{0}")]
    OverLimit(String),
}

impl From<ObjError> for BodyFileError {
    fn from(error: ObjError) -> Self {
        let words = error.to_string();
        if matches!(error, ObjError::OverLimit(_)) { Self::OverLimit(words) } else { Self::File(words) }
    }
}

impl From<GltfError> for BodyFileError {
    fn from(error: GltfError) -> Self {
        let words = error.to_string();
        if matches!(error, GltfError::OverLimit(_)) { Self::OverLimit(words) } else { Self::File(words) }
    }
}

/// The body in `bytes`, read from `path`, in the file's unit and as it stands there. `load` reads a file that this one names,
/// in its folder; the error is in words.
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

/// The glTF scene in `bytes`, read from `path`.
pub fn model(
    path: &Path,
    bytes: &[u8],
    load: &dyn Fn(&Path) -> Result<Vec<u8>, String>,
) -> Result<gltf::Model, BodyFileError> {
    Ok(gltf::read(bytes, &|name| load(&beside(path, name)?))?)
}

/// The same with the files that it names, which are in its folder.
pub fn model_with_buffers(
    path: &Path,
    bytes: &[u8],
    load: &dyn Fn(&Path) -> Result<Vec<u8>, String>,
) -> Result<(gltf::Model, BTreeMap<String, Vec<u8>>), BodyFileError> {
    let buffers = RefCell::new(BTreeMap::new());
    let kept = |name: &str| {
        let bytes = load(&beside(path, name)?)?;
        buffers.borrow_mut().insert(name.to_owned(), bytes.clone());
        Ok(bytes)
    };
    let model = gltf::read(bytes, &kept)?;
    Ok((model, buffers.into_inner()))
}

/// The file called `name` in the folder of `path`: nothing outside of it is opened for a file from elsewhere.
fn beside(path: &Path, name: &str) -> Result<PathBuf, String> {
    let name = name.replace("%20", " ");
    let is_plain = |part: std::path::Component<'_>| matches!(part, std::path::Component::Normal(_));
    let is_inside =
        !name.is_empty() && !name.contains([':', '\\']) && Path::new(&name).components().all(is_plain);
    match is_inside {
        true => Ok(path.parent().unwrap_or(Path::new("")).join(name)),
        false => Err(readable(&format!("its buffer {name:?} is not a file in its folder"))),
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
