//! Frames of a sequence from body files, given one by one, as a folder, or as a pattern with a star.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::body::{Surface, import};
use crate::cli::arguments::BodyFile;
use crate::cli::failure::Failure;
use crate::cli::{files, formats};

/// The body files, one for each frame.
pub struct Files {
    /// Paths in the order of the frames.
    pub paths: Vec<PathBuf>,
    /// How they are read; the unit is that of the first file.
    how: BodyFile,
}

impl Files {
    /// Collects the files that `named` means. A folder stands for all OBJ files in it, and "walk*.obj" for those with such a
    /// name, both ordered by the numbers in their names.
    pub fn new(named: &[PathBuf], how: BodyFile) -> Result<Self, Failure> {
        let mut paths = Vec::new();
        for path in named {
            let pattern =
                path.file_name().and_then(|name| name.to_str()).and_then(|name| name.split_once('*'));
            match pattern {
                _ if path.is_dir() => paths.extend(inside(path, ("", ".obj"))?),
                Some(pattern) if !path.exists() => {
                    let folder = path.parent().filter(|p| !p.as_os_str().is_empty());
                    paths.extend(inside(folder.unwrap_or(Path::new(".")), pattern)?);
                }
                _ => paths.push(path.clone()),
            }
        }
        Ok(Self { paths, how })
    }

    /// Reads the body of frame `i`. It must have the triangles of `dressed`.
    pub fn body(&mut self, i: usize, dressed: &Surface) -> Result<Arc<Surface>, Failure> {
        let path = &self.paths[i];
        let bytes = files::read(path)?;
        let mut mesh = formats::body_mesh(path, &bytes, self.how)?;
        let unit = formats::body_unit(path, &bytes, &mesh, self.how)?;
        // The unit of the first file holds for all: guessed from each height, it would change when the person sits down.
        self.how.unit = Some(unit);
        if mesh.triangles == dressed.mesh.triangles {
            mesh.positions.iter_mut().for_each(|p| *p *= unit.metres());
        } else {
            mesh = import(mesh, unit).mesh;
        }
        formats::same_triangles(path, &mesh, &dressed.mesh)?;
        let words = "a vertex of it is no place";
        dressed.reposed(mesh.positions).map(Arc::new).ok_or_else(|| Failure::input(path, words))
    }
}

/// Files in `folder` whose names begin with `begins` and end with `ends`.
fn inside(folder: &Path, (begins, ends): (&str, &str)) -> Result<Vec<PathBuf>, Failure> {
    let entries = fs::read_dir(folder).map_err(|error| Failure::file(folder, error))?;
    let fits = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        name.len() >= begins.len() + ends.len()
            && name.starts_with(begins)
            && name.to_lowercase().ends_with(ends)
    };
    let mut found: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).filter(fits).collect();
    found.sort_by_cached_key(|path| in_order(&path.to_string_lossy()));
    match found.is_empty() {
        true => Err(Failure::input(folder, format!("there is no file {begins}*{ends} in it"))),
        false => Ok(found),
    }
}

/// A sort key that compares numbers in names by value: "walk2" comes before "walk10".
fn in_order(name: &str) -> Vec<(u128, String)> {
    let mut parts = vec![(0_u128, String::new())];
    for c in name.chars() {
        let Some(last) = parts.last_mut() else { break };
        match c.to_digit(10) {
            Some(digit) if last.1.is_empty() => {
                last.0 = last.0.saturating_mul(10).saturating_add(u128::from(digit));
            }
            Some(digit) => parts.push((u128::from(digit), String::new())),
            None => last.1.push(c),
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_count_as_numbers() {
        let mut names = ["walk10.obj", "walk9.obj", "walk010b.obj", "walk2.obj", "run11.obj"];
        names.sort_by_cached_key(|name| in_order(name));
        assert_eq!(names, ["run11.obj", "walk2.obj", "walk9.obj", "walk10.obj", "walk010b.obj"]);
    }
}
