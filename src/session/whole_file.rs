//! Files that are written whole or not at all.

use std::fs;
use std::io::{Error, ErrorKind, Result, Write};
use std::path::{Path, PathBuf};

use atomic_write_file::AtomicWriteFile;

/// A chain of links that is longer goes round in a circle.
const MOST_LINKS: usize = 40;

/// Writes the whole of `bytes` to `path`, or leaves what was there. Where `path` is a link it stays one, and what it leads to is
/// written. A file that is write-protected is refused.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    if is_protected(path) {
        return Err(Error::new(ErrorKind::PermissionDenied, "it is write-protected"));
    }
    replace(path, bytes)
}

/// The same for a file that may be write-protected, and stays so.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<()> {
    let mut file = AtomicWriteFile::open(followed(path)?)?;
    file.write_all(bytes)?;
    // Also done by commit, which leaves its temporary file behind when it fails.
    file.as_file().sync_all()?;
    file.commit()
}

/// Whether there is a file that nobody is meant to change: a folder's permission to replace it does not count.
pub fn is_protected(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|file| file.is_file() && file.permissions().readonly())
}

/// Where links lead to, there or not.
fn followed(path: &Path) -> Result<PathBuf> {
    let mut at = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&at) {
            Ok(to) => at = at.parent().unwrap_or(Path::new("")).join(to),
            Err(_) => return Ok(at),
        }
    }
    Err(Error::other("its links go round in a circle"))
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
