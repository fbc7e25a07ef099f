//! The file of lines beside the folders of a list: a JSON object for each garment that was dressed or failed.

use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::cli::failure::Failure;
use crate::draft::Shard;

/// How the names of all such files begin and end.
const STEM: &str = "lines";
const ENDING: &str = ".jsonl";

/// A file of lines that grows.
#[derive(Debug)]
pub struct Lines {
    path: PathBuf,
    file: File,
}

impl Lines {
    /// Opens the file of `shard` in `folder`, which exists. A line that a crash left half written is ended.
    pub fn open(folder: &Path, shard: Option<Shard>) -> Result<Self, Failure> {
        let shard = shard.map(|shard| format!("-{}", shard.name())).unwrap_or_default();
        let path = folder.join(format!("{STEM}{shard}{ENDING}"));
        let open = || {
            let mut file = OpenOptions::new().create(true).read(true).append(true).open(&path)?;
            if file.seek(SeekFrom::End(0))? > 0 {
                let mut last = [0];
                file.seek(SeekFrom::End(-1))?;
                file.read_exact(&mut last)?;
                if last != *b"\n" {
                    file.write_all(b"\n")?;
                }
            }
            Ok(file)
        };
        match open() {
            Ok(file) => Ok(Self { path, file }),
            Err(error) => Err(Failure::file(&path, error)),
        }
    }

    /// Adds a line; it is on the disk when this returns.
    pub fn add(&mut self, line: &str) -> Result<(), Failure> {
        let text = format!("{line}\n");
        let added = self.file.write_all(text.as_bytes()).and_then(|()| self.file.sync_data());
        added.map_err(|error| Failure::file(&self.path, error))
    }
}

/// The files of lines in `folder`, in the order of their names.
pub fn files_in(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let entries = std::fs::read_dir(folder).map_err(|error| Failure::file(folder, error))?;
    let is_one = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let middle = name.strip_prefix(STEM).and_then(|rest| rest.strip_suffix(ENDING));
        middle.is_some_and(|middle| middle.is_empty() || middle.starts_with('-'))
    };
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).filter(is_one).collect();
    files.sort();
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_half_written_line_is_ended_before_the_next() {
        let folder = tempfile::tempdir().expect("a folder");
        let shard = Some("2/8".parse().expect("a shard"));
        Lines::open(folder.path(), shard).expect("opened").add("{}").expect("added");
        let files = files_in(folder.path()).expect("read");
        assert_eq!(files, [folder.path().join("lines-2-of-8.jsonl")]);
        std::fs::write(&files[0], "{}\n{\"half").expect("written");
        Lines::open(folder.path(), shard).expect("opened").add("[]").expect("added");
        assert_eq!(std::fs::read_to_string(&files[0]).expect("read"), "{}\n{\"half\n[]\n");
        Lines::open(folder.path(), None).expect("opened");
        std::fs::write(folder.path().join("linesman.jsonl"), "").expect("written");
        assert_eq!(files_in(folder.path()).expect("read").len(), 2, "no other file");
    }
}
