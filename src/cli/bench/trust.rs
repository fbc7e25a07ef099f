//! `toile bench trust`: gives damaged files to every reader and counts the results.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use crate::cli::arguments::Bench;
use crate::cli::bench::say;
use crate::cli::failure::Failure;
use crate::cli::simulate::scene;
use crate::cli::simulate::times::cpu_seconds;
use crate::cli::{interrupt, output};
use crate::session::recording::Recording;
use crate::session::recovery::{About, Keeper, left};
use crate::session::{Command, Session};
use crate::sim::{Runner, Simulation};
use crate::trust::commands::is_costly;
use crate::trust::{self, Form, Reader, SLOW, Tally, damaged, good};
use crate::ui::preferences::Preferences;

/// Default number of files for each reader.
const USUAL: u64 = 1000;
/// Number of files between two checks for a signal.
const AT_ONCE: u64 = 50;

/// The results of one reader.
#[derive(Serialize)]
struct Row {
    reader: &'static str,
    files: u64,
    taken: u64,
    refused: u64,
    /// Numbers of the files that made the reader panic, with the panic messages.
    panics: Vec<(u64, String)>,
    /// Numbers of the files that took longer than a second of processor time, with the seconds.
    slow: Vec<(u64, f64)>,
    /// Numbers of the files that were refused without a readable message, with the messages.
    unclear: Vec<(u64, String)>,
    /// The longest processor time of a file, seconds.
    slowest: f64,
    /// Peak memory of the program during this reader, MiB; None where the system does not tell.
    #[serde(skip_serializing_if = "Option::is_none")]
    memory: Option<u64>,
    /// How often each refusal came; numbers in the messages are left out.
    words: BTreeMap<String, u64>,
}

impl std::fmt::Display for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { reader, files, taken, refused, panics, slow, unclear, slowest, memory, words } = self;
        let [panics, slow, unclear] = [panics.len(), slow.len(), unclear.len()];
        write!(
            f,
            "{reader:<15} {files:>8} damaged files: {taken} taken, {refused} refused for {} reasons, {panics} panics, \
             {slow} slower than {SLOW} s, {unclear} unclear; slowest {:.0} ms",
            words.len(),
            slowest * 1e3
        )?;
        memory.map_or(Ok(()), |memory| write!(f, ", memory {memory} MiB"))
    }
}

/// Gives every reader its damaged files and prints the results. It is an error if a reader could not handle a file.
pub fn trust(arguments: &Bench) -> Result<(), Failure> {
    let folder = std::env::temp_dir().join(format!("toile-trust-{}", std::process::id()));
    output::make_folder(&folder)?;
    let tried = try_all(arguments, &folder);
    std::fs::remove_dir_all(&folder).map_err(|error| Failure::file(&folder, error))?;
    tried
}

fn try_all(arguments: &Bench, folder: &Path) -> Result<(), Failure> {
    let (mut readers, options) = (trust::readers(), &arguments.trust);
    readers.extend([journal(folder), falling(folder)?, preferences()]);
    if let Some(name) = options.readers.iter().find(|name| readers.iter().all(|r| r.name != **name)) {
        let names: Vec<&str> = readers.iter().map(|r| r.name).collect();
        return Err(Failure::Usage(format!("there is no reader {name:?}; there are {}", names.join(", "))));
    }
    let (first, count) = (options.first.unwrap_or(1), options.mutations.unwrap_or(USUAL));
    let mut bad = 0;
    for reader in
        readers.iter().filter(|r| options.readers.is_empty() || options.readers.iter().any(|n| n == r.name))
    {
        memory::begin();
        let tally = tried(reader, first..first.saturating_add(count))?;
        bad += usize::from(!tally.is_good());
        if let Some(kept) = &arguments.out {
            keep(reader, &tally, kept)?;
        }
        let Tally { files, taken, refused, panics, slow, unclear, slowest, words } = tally;
        let memory = memory::most();
        say(
            &Row {
                reader: reader.name,
                files,
                taken,
                refused,
                panics,
                slow,
                unclear,
                slowest,
                memory,
                words,
            },
            arguments.json,
        )?;
    }
    match bad {
        0 => Ok(()),
        _ => Err(Failure::Check(format!("{bad} readers met files that were too much for them"))),
    }
}

fn tried(reader: &Reader, numbers: std::ops::Range<u64>) -> Result<Tally, Failure> {
    let seconds = || cpu_seconds().unwrap_or(f64::INFINITY);
    let mut all = Tally::default();
    let mut next = numbers.start;
    while next < numbers.end {
        interrupt::check()?;
        let end = next.saturating_add(AT_ONCE).min(numbers.end);
        all.add(trust::run(reader, next..end, &seconds));
        next = end;
    }
    Ok(all)
}

/// Writes the files that `reader` could not handle into `folder`.
fn keep(reader: &Reader, tally: &Tally, folder: &Path) -> Result<(), Failure> {
    for number in tally.bad() {
        output::make_folder(folder)?;
        let name = format!("{}-{number}", reader.name.replace(' ', "-"));
        output::write(&folder.join(name), &damaged(reader, number))?;
    }
    Ok(())
}

/// A reader of recovery journals, as a window that crashed leaves them in `folder`.
fn journal(folder: &Path) -> Reader {
    let root = folder.to_owned();
    Reader::new("journal", Form::Journal, vec![cut_off()], move |bytes| recovered(&root, bytes))
}

/// The journal of a short session that was cut off.
fn cut_off() -> Vec<u8> {
    let recording = Recording::parse(&good::session().recording()).expect("a recording");
    let line = |(_, gesture, command): &(u64, u64, Command)| {
        let json = serde_json::to_string(&serde_json::json!({"gesture": gesture, "command": command}));
        let json = json.expect("a command");
        format!("{:08x} {json}\n", crc32fast::hash(json.as_bytes()))
    };
    recording.commands.iter().map(line).collect::<String>().into_bytes()
}

/// Recovers the journal found behind a copy in `root`, as a window does.
fn recovered(root: &Path, journal: &[u8]) -> Result<(), String> {
    let told = |e: std::io::Error| e.to_string();
    if left(root).is_empty() {
        let mut keeper = Keeper::begin(root).map_err(told)?;
        let (_, copying) = keeper.copy(&About { unsaved: true, ..About::default() }).map_err(told)?;
        copying.write(&good::project()).map_err(|e| e.to_string())?;
    }
    let work = left(root).pop().ok_or("the work is not offered")?;
    std::fs::write(work.written().with_file_name("1.journal"), journal).map_err(told)?;
    let found = work.read().map_err(|e| e.to_string())?;
    let mut session = Session::new(found.project, Runner::inline(Simulation::default()));
    let mut gestures = (0, session.begin_gesture());
    for (gesture, command) in found.commands {
        if gestures.0 != gesture {
            session.end_gesture(gestures.1);
            gestures = (gesture, session.begin_gesture());
        }
        if !is_costly(&command) {
            session.apply(command, gestures.1).map_err(|why| why.to_string())?;
            trust::go_on(&mut session);
        }
    }
    match found.lost {
        0 => Ok(()),
        lost => Err(format!("{lost} lines of the journal are lost")),
    }
}

/// A reader of scenes for `toile simulate`; the files that the scenes name are written to `folder`.
fn falling(folder: &Path) -> Result<Reader, Failure> {
    let place = folder.join("scene.json");
    output::write(&folder.join("cloth.obj"), &good::cloths()[0])?;
    output::write(&folder.join("body.obj"), &good::objs()[0])?;
    let good = vec![good::SCENE.as_bytes().to_vec()];
    Ok(Reader::new("scene", Form::Json, good, move |bytes| {
        std::fs::write(&place, bytes).map_err(|e| e.to_string())?;
        scene::load(&place).map(drop).map_err(|e| e.to_string())
    }))
}

/// A reader of the user's preferences. Preferences that are not understood are ignored when the program reads them.
fn preferences() -> Reader {
    let good = serde_json::to_vec(&Preferences::default()).unwrap_or_default();
    Reader::new("preferences", Form::Json, vec![good], |bytes| {
        let text = std::str::from_utf8(bytes).map_err(|e| e.to_string())?;
        let preferences = Preferences::understood(text).ok_or("they cannot be understood")?;
        assert!(preferences.scale.factor().is_finite());
        preferences.keymap.bound();
        Ok(())
    })
}

/// Peak memory of the program, as Linux counts it.
mod memory {
    /// Resets the peak.
    pub fn begin() {
        // Where the system does not allow the reset, the peak counts from the start of the program.
        std::fs::write("/proc/self/clear_refs", "5").ok();
    }

    /// Peak memory since [`begin`], MiB; None on other systems.
    pub fn most() -> Option<u64> {
        let status = std::fs::read_to_string("/proc/self/status").ok()?;
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
        Some(line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()? / 1024)
    }
}
