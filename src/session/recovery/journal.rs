//! Journal: commands written as they are given, each on a line with its own checksum.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::session::command::Command;

/// Commands after which the file is synced to disk; the operating system has each one at once.
const SYNC_EVERY: u32 = 50;
/// Largest journal that is read, bytes.
const MOST_BYTES: u64 = 1 << 30;

/// A line, as read.
#[derive(Deserialize)]
struct Entry {
    gesture: u64,
    command: Command,
}

/// A line, as written.
#[derive(Serialize)]
struct EntryRef<'a> {
    gesture: u64,
    command: &'a Command,
}

/// A journal being written.
#[derive(Debug)]
pub struct Journal {
    file: File,
    since_sync: u32,
}

impl Journal {
    /// An empty journal at `path`.
    pub(super) fn begin(path: &Path) -> io::Result<Self> {
        Ok(Self { file: File::create(path)?, since_sync: 0 })
    }

    /// Appends a command of a gesture.
    pub fn append(&mut self, gesture: u64, command: &Command) -> io::Result<()> {
        let json = serde_json::to_string(&EntryRef { gesture, command }).map_err(io::Error::other)?;
        let line = format!("{:08x} {json}\n", crc32fast::hash(json.as_bytes()));
        self.file.write_all(line.as_bytes())?;
        self.since_sync += 1;
        if self.since_sync >= SYNC_EVERY {
            self.since_sync = 0;
            self.file.sync_data()?;
        }
        Ok(())
    }
}

/// The commands in the journal at `path`, up to the first damaged line, and how many lines are lost by that. A truncated last
/// line counts as one, and so does a whole file that is too large or cannot be read.
pub(super) fn read(path: &Path) -> (Vec<(u64, Command)>, usize) {
    let is_small = std::fs::metadata(path).is_ok_and(|file| file.len() <= MOST_BYTES);
    let Some(bytes) = is_small.then(|| std::fs::read(path).ok()).flatten() else { return (Vec::new(), 1) };
    let mut lines = bytes.split(|&b| b == b'\n').filter(|line| !line.is_empty());
    let mut commands = Vec::new();
    while let Some(line) = lines.next() {
        match entry(line) {
            Some(entry) => commands.push((entry.gesture, entry.command)),
            None => return (commands, 1 + lines.count()),
        }
    }
    (commands, 0)
}

fn entry(line: &[u8]) -> Option<Entry> {
    let (sum, json) = line.split_at_checked(9)?;
    let right = format!("{:08x} ", crc32fast::hash(json));
    (sum == right.as_bytes()).then(|| serde_json::from_slice(json).ok())?
}
