//! The list of recent files, kept between runs.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::ui::files;

/// Largest number of files in the list.
const MOST: usize = 10;
/// Largest size of the list's file, bytes.
const MOST_BYTES: u64 = 1 << 20;

/// A recent file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecentFile {
    /// Path of the file.
    pub path: PathBuf,
    /// Whether the file existed when this was last checked.
    pub is_there: bool,
}

impl RecentFile {
    /// Name and folder of the file, for people.
    pub fn name(&self) -> (String, String) {
        let folder = self.path.parent().map(|f| f.display().to_string()).unwrap_or_default();
        (files::stem(&self.path), folder)
    }
}

/// The list of recent files.
#[derive(Debug, Default)]
pub struct Recent {
    files: Arc<Vec<RecentFile>>,
    /// The file in which the list is kept.
    kept: Option<PathBuf>,
}

impl Recent {
    /// Reads the list from `path`, where it is kept from now on. A list that cannot be read is treated as empty.
    pub fn read(path: PathBuf) -> Self {
        let is_small = std::fs::metadata(&path).is_ok_and(|file| file.is_file() && file.len() <= MOST_BYTES);
        let text = if is_small { std::fs::read_to_string(&path).ok() } else { None };
        let paths: Vec<PathBuf> = text.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
        let files = paths.into_iter().take(MOST).map(|path| RecentFile { path, is_there: false }).collect();
        let mut recent = Self { files: Arc::new(files), kept: Some(path) };
        recent.look();
        recent
    }

    /// The files, newest first.
    pub fn files(&self) -> &Arc<Vec<RecentFile>> {
        &self.files
    }

    /// Checks which of the files still exist.
    pub fn look(&mut self) {
        let is_there: Vec<bool> = self.files.iter().map(|f| f.path.is_file()).collect();
        if self.files.iter().zip(&is_there).any(|(f, there)| f.is_there != *there) {
            for (file, there) in Arc::make_mut(&mut self.files).iter_mut().zip(is_there) {
                file.is_there = there;
            }
        }
    }

    /// Moves `path` to the top of the list and saves it. The error is a message.
    pub fn add(&mut self, path: &Path) -> Result<(), String> {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        let files = Arc::make_mut(&mut self.files);
        files.retain(|f| f.path != path);
        files.insert(0, RecentFile { path, is_there: true });
        files.truncate(MOST);
        self.write()
    }

    /// Empties the list and saves it. The error is a message.
    pub fn clear(&mut self) -> Result<(), String> {
        self.files = Arc::default();
        self.write()
    }

    fn write(&self) -> Result<(), String> {
        let Some(kept) = &self.kept else { return Ok(()) };
        // Names that are not Unicode cannot be saved and are left out.
        let paths: Vec<&str> = self.files.iter().filter_map(|f| f.path.to_str()).collect();
        let text = serde_json::to_string_pretty(&paths).map_err(|e| e.to_string())?;
        if let Some(folder) = kept.parent() {
            std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        }
        files::write(kept, text.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_ten_are_kept_in_order_and_missing_ones_are_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let kept = folder.path().join("deep/recent.json");
        let file = |i: usize| folder.path().join(format!("a shirt {i} – ü.toile"));
        let mut recent = Recent::read(kept.clone());
        for i in 0..12 {
            std::fs::write(file(i), "").expect("a file");
            recent.add(&file(i)).expect("kept");
        }
        recent.add(&file(5)).expect("kept");
        let names = |recent: &Recent| recent.files().iter().map(|f| f.path.clone()).collect::<Vec<_>>();
        let expected: Vec<PathBuf> = [5, 11, 10, 9, 8, 7, 6, 4, 3, 2].map(file).to_vec();
        assert_eq!(names(&recent), expected);
        std::fs::remove_file(file(10)).expect("removed");
        let again = Recent::read(kept.clone());
        assert_eq!(names(&again), expected);
        let there: Vec<bool> = again.files().iter().map(|f| f.is_there).collect();
        assert_eq!(there.iter().filter(|t| !**t).count(), 1);
        assert!(!there[2]);
        recent.clear().expect("cleared");
        assert!(Recent::read(kept.clone()).files().is_empty());
        for broken in ["", "[1, 2]", "\u{0}"] {
            std::fs::write(&kept, broken).expect("written");
            assert!(Recent::read(kept.clone()).files().is_empty(), "{broken:?}");
        }
    }
}
