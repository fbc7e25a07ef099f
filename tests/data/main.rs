//! Bodies, drawings and patterns made by others, read from the folder that `TOILE_DATA` names; without it these tests pass
//! with a line.

mod bodies;
mod creatures;
mod drawings;
mod dressing;
mod patterns;
mod sewing;

use std::path::PathBuf;

/// The folder. None, and a line, where none is named.
fn data() -> Option<PathBuf> {
    let folder = std::env::var_os("TOILE_DATA").map(PathBuf::from);
    if folder.is_none() {
        println!("TOILE_DATA is not set: left out");
    }
    folder
}

/// What the file at `path` below the folder holds.
fn bytes(path: &str) -> Option<Vec<u8>> {
    let path = data()?.join(path);
    Some(std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())))
}
