//! Work that outlives a crash.
//!
//! Each session keeps a folder of its own: copies of the project, made now and then, and behind each copy a journal of the
//! commands given since. While the session lives it holds the folder's lock; a folder whose lock is free was left by a
//! crash, and its work is offered. Nothing is removed that could not be read.

mod journal;

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::session::command::Command;
use crate::session::project::Project;
use crate::session::project_file::{self, ProjectFileError};
pub use journal::Journal;

const LOCK: &str = "lock";
const ABOUT: &str = "about.json";
const PREFIX: &str = "session-";
/// Folders looked through.
const MOST_SESSIONS: usize = 1000;

/// What a person should see of work that was left.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct About {
    /// Of the project.
    pub name: String,
    /// The project's own file, if it has one.
    #[serde(default)]
    pub path: Option<PathBuf>,
    /// Whether the copy holds what no file of the person's does.
    #[serde(default)]
    pub unsaved: bool,
}

/// Keeps the work of one session safe.
#[derive(Debug)]
pub struct Keeper {
    folder: PathBuf,
    /// Free again when the process ends, however it ends.
    _lock: File,
    /// Of the newest copy.
    number: u64,
}

impl Keeper {
    /// Begins a folder of its own under `root`.
    pub fn begin(root: &Path) -> io::Result<Self> {
        fs::create_dir_all(root)?;
        for number in 1..MOST_SESSIONS {
            let folder = root.join(format!("{PREFIX}{}-{number}", std::process::id()));
            match fs::create_dir(&folder) {
                Ok(()) => {
                    let lock = File::create(folder.join(LOCK))?;
                    lock.try_lock().map_err(|e| match e {
                        TryLockError::Error(e) => e,
                        TryLockError::WouldBlock => io::Error::other("the folder is in use"),
                    })?;
                    return Ok(Self { folder, _lock: lock, number: 0 });
                }
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
                Err(e) => return Err(e),
            }
        }
        Err(io::Error::other("too many sessions were left in this folder"))
    }

    /// Begins a copy: the journal takes the commands from here on, and the copy is written by whoever has the time. Until
    /// it is, the copy before and all journals since tell the same.
    pub fn copy(&mut self, about: &About) -> io::Result<(Journal, Copying)> {
        let number = self.number + 1;
        let journal = Journal::begin(&journal_path(&self.folder, number))?;
        self.number = number;
        Ok((journal, Copying { folder: self.folder.clone(), number, about: about.clone() }))
    }

    /// The work is safe elsewhere, or not wanted: nothing is left behind.
    pub fn finish(self) -> io::Result<()> {
        fs::remove_dir_all(&self.folder)
    }
}

/// A copy to be written, on any thread; one after the other.
#[derive(Debug)]
pub struct Copying {
    folder: PathBuf,
    number: u64,
    about: About,
}

impl Copying {
    /// Writes the copy. The one before and its journal stay until the next.
    pub fn write(self, project: &Project) -> Result<(), ProjectFileError> {
        let Self { folder, number, about } = self;
        let path = copy_path(&folder, number);
        project_file::save(&path, project)?;
        let text = serde_json::to_vec_pretty(&about).unwrap_or_default();
        fs::write(folder.join(ABOUT), text).map_err(|source| ProjectFileError::File { path, source })?;
        for old in 1..number.saturating_sub(1) {
            fs::remove_file(copy_path(&folder, old)).ok();
            fs::remove_file(journal_path(&folder, old)).ok();
        }
        Ok(())
    }
}

/// Work that a session left behind.
#[derive(Debug)]
pub struct Left {
    folder: PathBuf,
    lock: File,
    /// What it is.
    pub about: About,
}

/// Work found again.
#[derive(Debug)]
pub struct Found {
    /// The newest copy that could be read.
    pub project: Project,
    /// What was done after it, each command with the number of its gesture.
    pub commands: Vec<(u64, Command)>,
    /// Lines of the journal that were damaged or came after one that was.
    pub lost: usize,
}

/// The work left under `root` by sessions that did not end well, the newest first. Live sessions are passed over.
pub fn left(root: &Path) -> Vec<Left> {
    let Ok(entries) = fs::read_dir(root) else { return Vec::new() };
    let mut folders: Vec<_> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.file_name().is_some_and(|n| n.to_string_lossy().starts_with(PREFIX)))
        .take(MOST_SESSIONS)
        .collect();
    // Only for the order in which they are shown: which copy is newer, numbers tell.
    folders.sort_by_cached_key(|path| fs::metadata(path.join(ABOUT)).and_then(|m| m.modified()).ok());
    folders.into_iter().rev().filter_map(Left::open).collect()
}

impl Left {
    fn open(folder: PathBuf) -> Option<Self> {
        let lock = File::options().write(true).open(folder.join(LOCK)).ok()?;
        lock.try_lock().ok()?;
        let about = fs::read(folder.join(ABOUT)).ok().and_then(|text| serde_json::from_slice(&text).ok());
        let about: About = about.unwrap_or(About { unsaved: true, ..About::default() });
        let is_empty = |number| fs::metadata(journal_path(&folder, number)).map_or(true, |j| j.len() == 0);
        let nothing_since = |newest| is_empty(newest) && is_empty(newest + 1);
        if newest(&folder).is_none_or(|newest| !about.unsaved && nothing_since(newest)) {
            // It died before its first copy, or with all work saved: there is nothing to lose.
            fs::remove_dir_all(&folder).ok();
            return None;
        }
        Some(Self { about, folder, lock })
    }

    /// Reads it: the newest copy, or the one before where the newest is damaged, and all journals since.
    pub fn read(&self) -> Result<Found, ProjectFileError> {
        let newest = newest(&self.folder).unwrap_or(1);
        let mut number = newest;
        let project = match project_file::open(&copy_path(&self.folder, newest)) {
            Ok(project) => project,
            Err(error) => {
                number = newest.saturating_sub(1);
                project_file::open(&copy_path(&self.folder, number)).map_err(|_| error)?
            }
        };
        let (mut commands, mut lost) = (Vec::new(), 0);
        while journal_path(&self.folder, number).exists() {
            let (more, more_lost) = journal::read(&journal_path(&self.folder, number));
            // Behind a gap nothing can be done again.
            if lost == 0 {
                commands.extend(more);
                lost = more_lost;
            } else {
                lost += more.len() + more_lost;
            }
            number += 1;
        }
        Ok(Found { project, commands, lost })
    }

    /// A file that was written with the newest copy: its time tells when that was, as far as the clock was right.
    pub fn written(&self) -> PathBuf {
        self.folder.join(ABOUT)
    }

    /// The newest copy; what was done after it is in journals. None: there is none that was written whole.
    pub fn copy(&self) -> Option<PathBuf> {
        Some(copy_path(&self.folder, newest(&self.folder)?))
    }

    /// Removes it: it was taken over, or is not wanted.
    pub fn forget(self) -> io::Result<()> {
        let Self { folder, lock, .. } = self;
        drop(lock);
        fs::remove_dir_all(folder)
    }
}

/// The number of the newest copy in a folder.
fn newest(folder: &Path) -> Option<u64> {
    let entries = fs::read_dir(folder).ok()?;
    let number = |path: PathBuf| path.file_name()?.to_str()?.strip_suffix(".toile")?.parse::<u64>().ok();
    entries.filter_map(|entry| number(entry.ok()?.path())).max()
}

fn copy_path(folder: &Path, number: u64) -> PathBuf {
    folder.join(format!("{number}.toile"))
}

fn journal_path(folder: &Path, number: u64) -> PathBuf {
    folder.join(format!("{number}.journal"))
}
