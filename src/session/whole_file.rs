//! Atomic file access: files are written whole or not at all, one or several; too large ones are not read.

use std::io::{Error, ErrorKind, Read, Result, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::{fmt, fs};

use atomic_write_file::AtomicWriteFile;

use crate::geometry::words::{Words, words};

/// Most symbolic links in a chain; a longer chain is taken to be a cycle.
const MOST_LINKS: usize = 40;

/// Lock held while temporary files are renamed to their final paths.
static PLACING: Mutex<()> = Mutex::new(());
/// Temporary files being written.
static BESIDE: Mutex<Vec<Known>> = Mutex::new(Vec::new());
/// Folders that were created, each after its parent.
static MADE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Identity of a file: its folder, and the system's numbers (device and inode on Unix).
#[derive(Clone, Debug, PartialEq, Eq)]
struct Known {
    folder: PathBuf,
    numbers: Option<[u64; 2]>,
}

/// What is said of a file that the system has no error for.
#[derive(Debug)]
struct Told(Words);

impl fmt::Display for Told {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Told {}

/// An error of a file that is told in `words`.
pub fn told(kind: ErrorKind, words: Words) -> Error {
    Error::new(kind, Told(words))
}

/// The error of a file in words; rare errors of the system are in its own.
pub fn words(error: &Error) -> Words {
    if let Some(Told(words)) = error.get_ref().and_then(|inner| inner.downcast_ref()) {
        return words.clone();
    }
    match error.kind() {
        ErrorKind::NotFound => words!("there is no such file or folder"),
        ErrorKind::PermissionDenied => words!("you have no permission to do this here"),
        ErrorKind::AlreadyExists => words!("something else has this name"),
        ErrorKind::IsADirectory => words!("this is a folder, not a file"),
        ErrorKind::NotADirectory => words!("a part of this path is a file, not a folder"),
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => words!("there is no room left on the disk"),
        ErrorKind::ReadOnlyFilesystem => words!("this disk can only be read"),
        ErrorKind::InvalidFilename => words!("this name is too long, or the system does not take it"),
        _ => Words::plain(error.to_string()),
    }
}

/// Content of the file at `path`, of at most `most` bytes; [`ErrorKind::FileTooLarge`] otherwise. Files without a known length,
/// such as devices, are read no further either.
pub fn read(path: &Path, most: u64) -> Result<Vec<u8>> {
    let too_large = |words: Words| told(ErrorKind::FileTooLarge, words);
    let file = fs::File::open(path)?;
    let size = file.metadata()?.len();
    if size > most {
        return Err(too_large(words!("it has {size} bytes, at most {most} are read", size, most)));
    }
    let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or_default());
    file.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(too_large(words!("it has more than {most} bytes, at most {most} are read", most)));
    }
    Ok(bytes)
}

/// Guard: while it lives no file is begun and none is renamed to its final path.
#[derive(Debug)]
pub struct HeldBack {
    _placing: MutexGuard<'static, ()>,
    beside: MutexGuard<'static, Vec<Known>>,
    made: MutexGuard<'static, Vec<PathBuf>>,
}

impl HeldBack {
    /// The guard, for whoever ends the program. None while files are being renamed.
    pub fn new() -> Option<Self> {
        Some(Self { _placing: tried(&PLACING)?, beside: tried(&BESIDE)?, made: tried(&MADE)? })
    }

    /// Removes temporary files, and folders created for them that are empty.
    pub fn remove_unplaced(&mut self) {
        self.beside.drain(..).for_each(|known| known.remove());
        remove_empty(&mut self.made);
    }
}

impl Known {
    /// Removes the file; does nothing where it no longer exists.
    fn remove(self) {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let same = |entry: &fs::DirEntry| entry.metadata().is_ok_and(|data| numbers(&data) == self.numbers);
        for entry in entries.filter(|entry| self.numbers.is_some() && same(entry)) {
            fs::remove_file(entry.path()).ok();
        }
    }
}

fn tried<T>(lock: &'static Mutex<T>) -> Option<MutexGuard<'static, T>> {
    match lock.try_lock() {
        Ok(held) => Some(held),
        Err(TryLockError::Poisoned(held)) => Some(held.into_inner()),
        Err(TryLockError::WouldBlock) => None,
    }
}

fn held<T>(lock: &'static Mutex<T>) -> MutexGuard<'static, T> {
    lock.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(unix)]
fn numbers(data: &fs::Metadata) -> Option<[u64; 2]> {
    use std::os::unix::fs::MetadataExt;
    Some([data.dev(), data.ino()])
}

#[cfg(not(unix))]
fn numbers(_: &fs::Metadata) -> Option<[u64; 2]> {
    None
}

/// A temporary file, on the disk of its final path; removed when dropped.
struct Unplaced {
    file: Option<AtomicWriteFile>,
    known: Known,
}

impl Unplaced {
    /// Writes `bytes` to a temporary file for `path`.
    fn new(path: &Path, bytes: &[u8]) -> Result<Self> {
        let path = followed(path)?;
        let mut unplaced = Self::begun(&path)?;
        if let Some(file) = &mut unplaced.file {
            file.write_all(bytes)?;
            // Also done by commit, which leaves its temporary file behind when it fails.
            file.as_file().sync_all()?;
        }
        Ok(unplaced)
    }

    fn begun(path: &Path) -> Result<Self> {
        let mut beside = held(&BESIDE);
        let file = AtomicWriteFile::open(path)?;
        let numbers = file.as_file().metadata().ok().and_then(|data| numbers(&data));
        let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
        let known = Known { folder: folder.to_owned(), numbers };
        beside.push(known.clone());
        Ok(Self { file: Some(file), known })
    }

    fn place(mut self) -> Result<()> {
        self.file.take().map_or(Ok(()), AtomicWriteFile::commit)
    }
}

impl Drop for Unplaced {
    fn drop(&mut self) {
        let mut beside = held(&BESIDE);
        drop(self.file.take());
        if let Some(at) = beside.iter().position(|known| *known == self.known) {
            beside.swap_remove(at);
        }
    }
}

/// Creates `folder` and its parents, and remembers which did not exist.
pub fn make_folder(folder: &Path) -> Result<()> {
    let mut made = held(&MADE);
    let above: Vec<&Path> = folder.ancestors().take_while(|path| !path.exists()).collect();
    fs::create_dir_all(folder)?;
    made.extend(above.iter().rev().map(|path| path.to_path_buf()));
    Ok(())
}

/// Removes created folders in which no file was written.
pub fn remove_empty_folders() {
    remove_empty(&mut held(&MADE));
}

/// Removes those of the folders that are empty.
fn remove_empty(made: &mut Vec<PathBuf>) {
    while let Some(folder) = made.pop() {
        fs::remove_dir(folder).ok();
    }
}

/// Writes `bytes` to `path` atomically: all of them, or what was there stays. Where `path` is a symbolic link, its target is
/// written. A write-protected file is refused.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    refuse_protected(path)?;
    replace(path, bytes)
}

/// Writes like [`write()`], but also over a write-protected file, which stays protected.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<()> {
    replace_in_turn(&[(path, bytes)])
}

/// Writes several files like [`replace`]: all are written first, then renamed in this order.
pub fn replace_in_turn(files: &[(&Path, &[u8])]) -> Result<()> {
    let written: Vec<Unplaced> =
        files.iter().map(|(path, bytes)| Unplaced::new(path, bytes)).collect::<Result<_>>()?;
    let _placing = held(&PLACING);
    written.into_iter().try_for_each(Unplaced::place)
}

/// Writes all of `files`, paths with their contents, then renames them right after each other in this order: a program that is
/// ended by a signal has written all of them or none. Should the machine fail meanwhile, the last one is missing; where it
/// exists, the others are those written with it. Write-protected files are refused before any is renamed. The error comes with
/// its path.
pub fn write_together(files: &[(PathBuf, Vec<u8>)]) -> std::result::Result<(), (PathBuf, Error)> {
    let mut written = Vec::new();
    for (path, bytes) in files {
        let file = refuse_protected(path).and_then(|()| Unplaced::new(path, bytes));
        written.push((path, file.map_err(|error| (path.clone(), error))?));
    }
    let _placing = held(&PLACING);
    if let [.., (last, _)] = files {
        match fs::remove_file(last) {
            Err(error) if error.kind() != ErrorKind::NotFound => return Err((last.clone(), error)),
            _ => {}
        }
    }
    written.into_iter().try_for_each(|(path, file)| file.place().map_err(|error| (path.clone(), error)))
}

/// Removes temporary files for files of `folder`, in which nobody else writes: those of a run that was killed while it wrote. What
/// cannot be removed is left.
pub fn sweep(folder: &Path) {
    let all = || fs::read_dir(folder).into_iter().flatten().flatten();
    let names: Vec<String> =
        all().filter_map(|file| Some(format!(".{}.", file.file_name().to_str()?))).collect();
    let is_left = |name: &str| {
        names.iter().any(|start| {
            let end = name.strip_prefix(start.as_str());
            end.is_some_and(|end| end.len() == 6 && end.chars().all(|c| c.is_ascii_alphanumeric()))
        })
    };
    for file in all() {
        if file.file_name().to_str().is_some_and(is_left) {
            fs::remove_file(file.path()).ok();
        }
    }
}

/// Whether `path` is a write-protected file; permission of the folder to replace it does not count.
pub fn is_protected(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|file| file.is_file() && file.permissions().readonly())
}

/// An error if `path` is a write-protected file.
pub fn refuse_protected(path: &Path) -> Result<()> {
    match is_protected(path) {
        true => Err(told(ErrorKind::PermissionDenied, words!("it is write-protected"))),
        false => Ok(()),
    }
}

/// The final target of symbolic links, whether it exists or not.
fn followed(path: &Path) -> Result<PathBuf> {
    let mut at = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&at) {
            Ok(to) => at = at.parent().unwrap_or(Path::new("")).join(to),
            Err(_) => return Ok(at),
        }
    }
    Err(told(ErrorKind::Other, words!("its links go round in a circle")))
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    #[test]
    fn a_link_stays_and_what_it_leads_to_is_written() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("far")).expect("a folder");
        symlink("far/there", at("link")).expect("a link");
        symlink(at("link"), at("longer")).expect("a link");
        for bytes in [b"first".as_slice(), b"second"] {
            write(&at("longer"), bytes).expect("written");
            assert_eq!(fs::read(at("far/there")).expect("a file"), bytes);
        }
        for link in ["link", "longer"] {
            assert!(fs::symlink_metadata(at(link)).expect("a link").is_symlink());
        }
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 3, "nothing else is left");
    }

    #[test]
    fn errors_of_the_system_are_told_in_words() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("file"), b"x").expect("written");
        let told = |tried: Result<Vec<u8>>| words(&tried.expect_err("an error")).to_string();
        assert_eq!(told(fs::read(at("none"))), "there is no such file or folder");
        assert_eq!(told(fs::read(folder.path())), "this is a folder, not a file");
        assert_eq!(told(fs::read(at("file/x"))), "a part of this path is a file, not a folder");
        let long = "n".repeat(999);
        assert!(told(fs::read(at(&long))).starts_with("this name is too long"));
        let made = fs::create_dir(at("file")).map(|()| Vec::new());
        assert_eq!(told(made), "something else has this name");
    }

    #[test]
    fn what_a_killed_run_left_is_swept_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        let left = [".body.obj.Pvvjmb", ".report.json.0aB3c9"];
        let kept = [".body.obj.Pvvjm", ".body.obj.Pv_jmb", ".other.obj.Pvvjmb", "body.obj", "report.json"];
        left.iter().chain(&kept).for_each(|name| fs::write(at(name), b"x").expect("written"));
        sweep(folder.path());
        assert!(left.iter().all(|name| !at(name).exists()));
        assert!(kept.iter().all(|name| at(name).exists()));
    }

    #[test]
    fn what_has_no_end_is_not_read_to_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("file");
        fs::write(&path, b"12345").expect("written");
        assert_eq!(read(&path, 5).expect("read"), b"12345");
        for (path, words) in [(&*path, "it has 5 bytes, at most 4"), (Path::new("/dev/zero"), "more than 4")]
        {
            let why = read(path, 4).expect_err("too large");
            assert!(why.kind() == ErrorKind::FileTooLarge && why.to_string().contains(words), "{why}");
        }
        assert!(read(folder.path(), 4).is_err(), "a folder");
    }

    #[test]
    fn several_are_written_or_none() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        let all = [(at("a"), b"1".to_vec()), (at("b"), b"2".to_vec())];
        write_together(&all).expect("written");
        assert_eq!(fs::read(at("b")).expect("a file"), b"2");
        let lost = [(at("a"), b"3".to_vec()), (at("none/b"), b"4".to_vec())];
        let (path, _) = write_together(&lost).expect_err("there is no such folder");
        assert_eq!(path, at("none/b"));
        assert_eq!(fs::read(at("a")).expect("a file"), b"1", "the first stays as it was");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2, "nothing else is left");
    }

    #[test]
    fn what_is_not_in_its_place_is_removed_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("old"), b"old").expect("written");
        fs::write(at(".old.abcdef"), b"of another program").expect("written");
        let file = Unplaced::new(&at("old"), b"new").expect("written");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 3);
        file.known.clone().remove();
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2);
        drop(file);
        assert_eq!(fs::read(at("old")).expect("a file"), b"old");
    }

    #[test]
    fn folders_that_stayed_empty_are_removed_and_no_others() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("old")).expect("made");
        for name in ["old", "old/new", "full/a", "empty/a/b"] {
            make_folder(&at(name)).expect("made");
        }
        fs::write(at("full/a/file"), b"").expect("written");
        remove_empty_folders();
        let there = ["old", "old/new", "full/a/file", "empty"].map(|name| at(name).exists());
        assert_eq!(there, [true, false, true, false]);
    }

    #[test]
    fn links_in_a_circle_are_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        symlink("b", at("a")).expect("a link");
        symlink("a", at("b")).expect("a link");
        assert!(write(&at("a"), b"lost").expect_err("refused").to_string().contains("circle"));
    }

    #[test]
    fn a_protected_file_is_replaced_only_when_that_is_meant() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("kept");
        write(&path, b"first").expect("written");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).expect("protected");
        let why = write(&path, b"second").expect_err("refused");
        assert_eq!(why.kind(), ErrorKind::PermissionDenied);
        assert_eq!(fs::read(&path).expect("a file"), b"first");
        replace(&path, b"second").expect("written");
        assert_eq!(fs::read(&path).expect("a file"), b"second");
        assert!(is_protected(&path), "it stays so");
    }
}
