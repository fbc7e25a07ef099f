//! Recordings: JSON lines, always kept in memory, and written to a file on request.
//!
//! A header, then in order of time: each command, the tick in which the simulation applied it, and hashes at the end of every
//! gesture and whenever the cloth comes to rest, but for cloth that a graphics card has moved.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{BufWriter, Write};

use serde::{Deserialize, Serialize};

use crate::geometry::words::{Words, within_quotes, words};
use crate::io::words::{line, readable, readable_words};
use crate::session::command::Command;
use crate::session::project::Project;
use crate::session::recovery::Journal;
use crate::sim::Event;

/// Value of the `format` field of the header.
pub const FORMAT: &str = "toile-recording";
/// Format version that this program reads and writes.
pub const VERSION: u32 = 1;

/// One line of a recording.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Line {
    /// First line: the project that everything starts from.
    Header { format: String, version: u32, program: String, machine: String, project: Box<Project> },
    /// A command was given. `seq` counts commands from 1, `gesture` counts gestures with at least one command from 1.
    Command { seq: u64, gesture: u64, command: Command },
    /// The simulation applied command `seq` after `tick` ticks.
    Applied { seq: u64, tick: u64 },
    /// Hashes after `tick` ticks. With `document`: after all commands up to `seq`. Without: at rest, with `seq` the last command
    /// that the simulation applied.
    Hash {
        tick: u64,
        seq: u64,
        cloth: Hex,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        document: Option<Hex>,
    },
    /// A graphics card has moved the cloth by `tick`: it is not the same on every machine, nor are the ticks that follow.
    Card { tick: u64 },
}

/// A hash, written as 16 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hex(pub u64);

impl std::fmt::Display for Hex {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

impl Serialize for Hex {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Hex {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let text = String::deserialize(from)?;
        let digits = text.len() == 16 && text.bytes().all(|b| b.is_ascii_hexdigit());
        match u64::from_str_radix(&text, 16) {
            Ok(hash) if digits => Ok(Self(hash)),
            _ => Err(serde::de::Error::custom("a hash is 16 hexadecimal digits")),
        }
    }
}

/// Identifier of the kind of machine. On one kind, a recording always gives the same bits; between kinds they may differ in the
/// last place, because matrices are factored with the widest instructions available.
pub fn machine() -> String {
    #[cfg(target_arch = "x86_64")]
    let wide = [
        ("avx2", std::arch::is_x86_feature_detected!("avx2")),
        ("fma", std::arch::is_x86_feature_detected!("fma")),
        ("avx512f", std::arch::is_x86_feature_detected!("avx512f")),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let wide: [(&str, bool); 0] = [];
    let had = wide.iter().filter(|(_, has)| *has).map(|(name, _)| *name);
    let words = [std::env::consts::ARCH, std::env::consts::OS];
    words.into_iter().chain(had).collect::<Vec<_>>().join("-")
}

/// Writes the recording of a session as it happens.
#[derive(Debug)]
pub struct Recorder {
    lines: String,
    /// Document hashes that wait for their cloth hash, each by the number of the request that asked for it.
    awaited: VecDeque<(u64, u64)>,
    /// Id of the last gesture in the session, and its number in the recording.
    gesture: (u64, u64),
    /// Whether it has told that a graphics card has moved the cloth.
    by_card: bool,
    file: Option<BufWriter<File>>,
    file_error: Option<std::io::Error>,
    journal: Option<Journal>,
    journal_error: Option<std::io::Error>,
}

impl Recorder {
    /// A recorder that has written the header.
    pub fn new(project: &Project) -> Self {
        let mut recorder = Self {
            lines: String::new(),
            awaited: VecDeque::new(),
            gesture: (0, 0),
            by_card: false,
            file: None,
            file_error: None,
            journal: None,
            journal_error: None,
        };
        recorder.write(&Line::Header {
            format: FORMAT.to_owned(),
            version: VERSION,
            program: env!("CARGO_PKG_VERSION").to_owned(),
            machine: machine(),
            project: Box::new(project.clone()),
        });
        recorder
    }

    /// All lines so far.
    pub fn text(&self) -> String {
        self.lines.clone()
    }

    /// Writes all lines so far, and each line from now on, to `file`.
    pub fn also_to(&mut self, file: File) -> std::io::Result<()> {
        let mut file = BufWriter::new(file);
        file.write_all(self.lines.as_bytes())?;
        file.flush()?;
        self.file = Some(file);
        Ok(())
    }

    /// Also writes commands from now on to `journal`, which replaces the previous one.
    pub fn journal_to(&mut self, journal: Option<Journal>) {
        self.journal = journal;
    }

    /// The error that ended the journal, returned once.
    pub fn take_journal_error(&mut self) -> Option<std::io::Error> {
        self.journal_error.take()
    }

    /// The error that ended the file, returned once.
    pub fn take_file_error(&mut self) -> Option<std::io::Error> {
        self.file_error.take()
    }

    /// Records a command that was carried out.
    pub fn command(&mut self, seq: u64, gesture: u64, command: Command) {
        if let Some(journal) = &mut self.journal
            && let Err(error) = journal.append(gesture, &command)
        {
            self.journal_error = Some(error);
            self.journal = None;
        }
        if self.gesture.1 == 0 || self.gesture.0 != gesture {
            self.gesture = (gesture, self.gesture.1 + 1);
        }
        self.write(&Line::Command { seq, gesture: self.gesture.1, command });
    }

    /// Whether the recording is also written to a file.
    pub fn has_file(&self) -> bool {
        self.file.is_some()
    }

    /// Stores the `document` hash until the cloth hash that request `seq` asked for arrives.
    pub fn expect_hash(&mut self, seq: u64, document: u64) {
        self.awaited.push_back((seq, document));
    }

    /// Records an event of the simulation.
    pub fn event(&mut self, event: &Event) {
        match *event {
            Event::Applied { seq, tick } if seq > 0 => self.write(&Line::Applied { seq, tick }),
            Event::Hash { tick, seq, cloth, asked } => self.hash(tick, seq, cloth, asked),
            Event::Applied { .. } | Event::Failed { .. } | Event::Forgotten { .. } => {}
        }
    }

    fn hash(&mut self, tick: u64, seq: u64, cloth: Option<u64>, asked: Option<u64>) {
        let document = match (asked, self.awaited.front()) {
            (Some(asked), Some(&(awaited, document))) if asked == awaited => {
                self.awaited.pop_front();
                Some(Hex(document))
            }
            _ => None,
        };
        let Some(cloth) = cloth.map(Hex) else {
            if !std::mem::replace(&mut self.by_card, true) {
                self.write(&Line::Card { tick });
            }
            return;
        };
        self.write(&Line::Hash { tick, seq: asked.unwrap_or(seq), cloth, document });
    }

    fn write(&mut self, line: &Line) {
        // Lines have no map with keys that are not strings and no number that is not finite: they can always be written as JSON.
        let Ok(json) = serde_json::to_string(line) else { return };
        self.lines.push_str(&json);
        self.lines.push('\n');
        if let Some(file) = &mut self.file
            && let Err(error) = file
                .write_all(json.as_bytes())
                .and_then(|()| file.write_all(b"\n"))
                .and_then(|()| file.flush())
        {
            self.file_error = Some(error);
            self.file = None;
        }
    }
}

/// A recording that was read.
#[derive(Clone, Debug)]
pub struct Recording {
    /// The project that everything starts from.
    pub project: Project,
    /// The kind of machine it was made on, see [`machine`].
    pub machine: String,
    /// Commands in order: number, gesture number, command.
    pub commands: Vec<(u64, u64, Command)>,
    /// Events of the simulation, in order.
    pub told: Vec<RecordedEvent>,
    /// Whether a graphics card has moved the cloth: ticks and hashes then cannot be held against it.
    pub by_card: bool,
}

/// A recorded event of the simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecordedEvent {
    /// The simulation applied command `seq` after `tick` ticks.
    Applied { seq: u64, tick: u64 },
    /// Hashes, as in [`Line::Hash`].
    Hash { tick: u64, seq: u64, cloth: u64, document: Option<u64> },
}

/// Why a text is not a recording.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub struct RecordingError {
    /// Line number, from 1.
    pub line: usize,
    /// What is wrong.
    pub words: Words,
}

impl RecordingError {
    /// The error in words.
    pub fn words(&self) -> Words {
        line(self.line).and(": ", self.words.clone())
    }
}

impl Recording {
    /// Reads JSON lines. A last line that was cut off (a crash while writing) is an error like any other.
    pub fn parse(text: &str) -> Result<Self, RecordingError> {
        let mut lines = text.lines().enumerate().filter(|(_, l)| !l.trim().is_empty());
        let Some((i, first)) = lines.next() else {
            return Err(RecordingError { line: 1, words: words!("the recording is empty") });
        };
        let (project, machine) = header(first).map_err(|words| RecordingError { line: i + 1, words })?;
        let mut recording = Self { project, machine, commands: Vec::new(), told: Vec::new(), by_card: false };
        for (i, line) in lines {
            recording.take(line).map_err(|words| RecordingError { line: i + 1, words })?;
        }
        Ok(recording)
    }

    fn take(&mut self, line: &str) -> Result<(), Words> {
        match serde_json::from_str(line).map_err(json_words)? {
            Line::Header { .. } => return Err(words!("a second header")),
            Line::Command { seq, gesture, command } => self.commands.push((seq, gesture, command)),
            Line::Card { .. } => self.by_card = true,
            Line::Applied { seq, tick } => self.told.push(RecordedEvent::Applied { seq, tick }),
            Line::Hash { tick, seq, cloth, document } => {
                self.told.push(RecordedEvent::Hash {
                    tick,
                    seq,
                    cloth: cloth.0,
                    document: document.map(|h| h.0),
                });
            }
        }
        Ok(())
    }
}

/// The part of a header that tells whether the rest can be read.
#[derive(Deserialize)]
struct AnyHeader {
    header: AnyVersion,
}

#[derive(Deserialize)]
struct AnyVersion {
    format: String,
    version: u32,
}

fn header(line: &str) -> Result<(Project, String), Words> {
    let any: AnyHeader = serde_json::from_str(line)
        .map_err(|e| words!("this is not the header of a recording: {why}", why = json_words(e)))?;
    if any.header.format != FORMAT {
        let format = within_quotes(&any.header.format);
        return Err(readable_words(words!("this is a \"{format}\", not a recording", format)));
    }
    if any.header.version != VERSION {
        let version = any.header.version;
        return Err(words!(
            "recording version {version}: this program reads version {own}",
            version,
            own = VERSION
        ));
    }
    match serde_json::from_str(line).map_err(json_words)? {
        Line::Header { project, machine, .. } => Ok((*project, machine)),
        _ => Err(words!("the first line must be the header")),
    }
}

/// Words for a JSON error. Each line is JSON of its own, so the caller adds the line number.
#[expect(clippy::needless_pass_by_value, reason = "for map_err")]
fn json_words(error: serde_json::Error) -> Words {
    Words::plain(readable(&error.to_string().replace(" at line 1 column ", " at column ")))
}
