//! Fuzzing campaign: counts how many damaged files a reader accepts, refuses, or fails on.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use crate::geometry::random::Random;
use crate::trust::readers::Reader;
use crate::trust::structure::{self, Form};

/// Longest CPU time for one file, seconds.
pub const SLOW: f64 = 1.0;
/// Most changes to one file.
const MOST_CHANGES: usize = 3;
/// Most characters of an error message.
const LONGEST_ANSWER: usize = 2000;

/// Results of the damaged files of one reader.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Number of files.
    pub files: u64,
    /// Files accepted: the damage does not matter.
    pub taken: u64,
    /// Files refused with an error message.
    pub refused: u64,
    /// Numbers of the files that made the reader panic, and the panic messages.
    pub panics: Vec<(u64, String)>,
    /// Numbers of the files that took longer than [`SLOW`], and their times, seconds.
    pub slow: Vec<(u64, f64)>,
    /// Numbers of the files refused with an empty, too long or unprintable message, and those messages.
    pub unclear: Vec<(u64, String)>,
    /// Longest time of a file, seconds.
    pub slowest: f64,
    /// Number of refusals by message, with its figures and quoted parts removed.
    pub words: BTreeMap<String, u64>,
}

impl Tally {
    /// Whether every file was accepted, or refused with a clear message, in time.
    pub fn is_good(&self) -> bool {
        self.panics.is_empty() && self.slow.is_empty() && self.unclear.is_empty()
    }

    /// Adds the results of `more`.
    pub fn add(&mut self, more: Self) {
        let Self { files, taken, refused, panics, slow, unclear, slowest, words } = more;
        self.files += files;
        self.taken += taken;
        self.refused += refused;
        self.panics.extend(panics);
        self.slow.extend(slow);
        self.unclear.extend(unclear);
        self.slowest = self.slowest.max(slowest);
        words.into_iter().for_each(|(words, count)| *self.words.entry(words).or_default() += count);
    }

    /// Numbers of the files on which the reader failed.
    pub fn bad(&self) -> impl Iterator<Item = u64> {
        let panics = self.panics.iter().map(|(number, _)| *number);
        panics
            .chain(self.slow.iter().map(|(number, _)| *number))
            .chain(self.unclear.iter().map(|(number, _)| *number))
    }
}

/// Damaged file number `number` of a reader: the same number gives the same bytes.
pub fn damaged(reader: &Reader, number: u64) -> Vec<u8> {
    let mut random = Random::stream(number, 29);
    let [file, other] = [(); 2].map(|()| &reader.good[random.below(reader.good.len())]);
    let mut bytes = file.clone();
    for _ in 0..=random.below(MOST_CHANGES) {
        let form = if random.chance(0.03) { Form::Bytes } else { reader.form };
        bytes = structure::change(form, bytes, other, &mut random);
    }
    bytes
}

/// Gives `reader` the damaged files of these numbers. `seconds` returns the CPU time of the process so far.
pub fn run(reader: &Reader, numbers: std::ops::Range<u64>, seconds: &dyn Fn() -> f64) -> Tally {
    let mut tally = Tally::default();
    for number in numbers {
        let bytes = damaged(reader, number);
        let (before, start) = (seconds(), Instant::now());
        let answer = catch_unwind(AssertUnwindSafe(|| (reader.read)(&bytes)));
        // Wall-clock time grows on a loaded machine, CPU time with the number of threads: the smaller one counts.
        let took = (seconds() - before).min(start.elapsed().as_secs_f64());
        tally.files += 1;
        tally.slowest = tally.slowest.max(took);
        if took > SLOW {
            tally.slow.push((number, took));
        }
        match answer {
            Ok(Ok(())) => tally.taken += 1,
            Ok(Err(words)) => {
                tally.refused += 1;
                if is_unclear(&words) {
                    tally.unclear.push((number, words.chars().take(200).collect()));
                }
                *tally.words.entry(without_figures(&words)).or_default() += 1;
            }
            Err(panic) => {
                let words = panic.downcast_ref::<String>().cloned();
                let words = words.or_else(|| panic.downcast_ref::<&str>().map(|words| (*words).to_owned()));
                tally.panics.push((number, words.unwrap_or_default()));
            }
        }
    }
    tally
}

fn is_unclear(words: &str) -> bool {
    words.trim().is_empty()
        || words.chars().count() > LONGEST_ANSWER
        || words.chars().any(|c| c.is_control() && c != '\n')
}

/// A message in which digits are replaced by a single 0 and quoted parts are removed.
fn without_figures(words: &str) -> String {
    let mut plain = String::new();
    let mut is_quoted = false;
    for c in words.chars() {
        match c {
            '"' => is_quoted = !is_quoted,
            _ if is_quoted => continue,
            _ => {}
        }
        let c = if c.is_ascii_digit() { '0' } else { c };
        if !(c == '0' && plain.ends_with('0')) {
            plain.push(c);
        }
    }
    plain.chars().take(160).collect()
}
