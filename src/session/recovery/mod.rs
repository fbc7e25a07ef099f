//! Recovery of work after a crash.
//!
//! Each session has a folder: copies of the project, made now and then, and for each copy a journal of the commands given since.
//! A live session holds the folder's lock. A folder whose lock is free was left by a crash, and its work is offered to the user.
//! Nothing that could not be read is removed.

mod journal;

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::geometry::words::words;
use crate::session::command::Command;
use crate::session::project::Project;
use crate::session::project_file::{self, ProjectFileError};
use crate::session::whole_file;
pub use journal::Journal;

const LOCK: &str = "lock";
const ABOUT: &str = "about.json";
const PREFIX: &str = "session-";
/// Most folders looked through.
const MOST_SESSIONS: usize = 1000;

/// Description of left work for the user.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct About {
    /// Name of the project.
    pub name: String,
    /// The project's own file, if it has one.
    #[serde(default)]
    pub path: Option<PathBuf>,
    /// Whether the copy contains work that is in no file of the user's.
    #[serde(default)]
    pub unsaved: bool,
}

/// Keeps recovery copies of one session.
#[derive(Debug)]
pub struct Keeper {
    folder: PathBuf,
    /// Lock of the folder, released when the process ends, however it ends.
    _lock: File,
    /// Number of the newest copy.
    number: u64,
}

impl Keeper {
    /// Creates a folder for this session under `root`.
    pub fn begin(root: &Path) -> io::Result<Self> {
        fs::create_dir_all(root)?;
        for number in 1..MOST_SESSIONS {
            let folder = root.join(format!("{PREFIX}{}-{number}", std::process::id()));
            match fs::create_dir(&folder) {
                Ok(()) => {
                    let lock = File::create(folder.join(LOCK))?;
                    lock.try_lock().map_err(|e| match e {
                        TryLockError::Error(e) => e,
                        TryLockError::WouldBlock => {
                            whole_file::told(io::ErrorKind::Other, words!("the folder is in use"))
                        }
                    })?;
                    return Ok(Self { folder, _lock: lock, number: 0 });
                }
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
                Err(e) => return Err(e),
            }
        }
        let words = words!("too many sessions were left in this folder");
        Err(whole_file::told(io::ErrorKind::Other, words))
    }

    /// Begins a copy: the journal takes the commands from here on, and the copy can be written on any thread. Until it is
    /// written, the previous copy and all journals since contain the same work.
    pub fn copy(&mut self, about: &About) -> io::Result<(Journal, Copying)> {
        let number = self.number + 1;
        let journal = Journal::begin(&journal_path(&self.folder, number))?;
        self.number = number;
        Ok((journal, Copying { folder: self.folder.clone(), number, about: about.clone() }))
    }

    /// Removes the folder: the work is safe elsewhere, or not wanted.
    pub fn finish(self) -> io::Result<()> {
        fs::remove_dir_all(&self.folder)
    }
}

/// A copy still to be written, on any thread; one after the other.
#[derive(Debug)]
pub struct Copying {
    folder: PathBuf,
    number: u64,
    about: About,
}

impl Copying {
    /// Writes the copy. The previous one and its journal stay until the next.
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

/// Work left by another session.
#[derive(Debug)]
pub struct Left {
    folder: PathBuf,
    lock: File,
    /// Description of the work.
    pub about: About,
}

/// Recovered work.
#[derive(Debug)]
pub struct Found {
    /// The newest copy that could be read.
    pub project: Project,
    /// Commands given after the copy, each with the number of its gesture.
    pub commands: Vec<(u64, Command)>,
    /// Lines of journals that were lost: damaged, or after a damaged one.
    pub lost: usize,
}

/// The work left under `root` by sessions that crashed, the newest first. Live sessions are skipped.
pub fn left(root: &Path) -> Vec<Left> {
    let Ok(entries) = fs::read_dir(root) else { return Vec::new() };
    let mut folders: Vec<_> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.file_name().is_some_and(|n| n.to_string_lossy().starts_with(PREFIX)))
        .take(MOST_SESSIONS)
        .collect();
    // The time decides only the order in which they are shown; which copy is newer follows from their numbers.
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
            // The session ended before its first copy, or with all work saved: there is nothing to lose.
            fs::remove_dir_all(&folder).ok();
            return None;
        }
        Some(Self { about, folder, lock })
    }

    /// Reads the newest copy, or the one before where the newest is damaged, and all journals since.
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
            // Commands after a gap cannot be carried out.
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

    /// A file written with the newest copy; its modification time tells when.
    pub fn written(&self) -> PathBuf {
        self.folder.join(ABOUT)
    }

    /// The newest copy; commands given after it are in journals. None: no copy was completed.
    pub fn copy(&self) -> Option<PathBuf> {
        Some(copy_path(&self.folder, newest(&self.folder)?))
    }

    /// Removes the work: it was recovered, or is not wanted.
    pub fn forget(self) -> io::Result<()> {
        let Self { folder, lock, .. } = self;
        drop(lock);
        fs::remove_dir_all(folder)
    }
}

/// Number of the newest copy in a folder.
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
