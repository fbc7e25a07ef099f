//! Counting: how many damaged files were taken, refused, or too much for a reader.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use crate::draft::Random;
use crate::trust::readers::Reader;
use crate::trust::structure::{self, Form};

/// No file may take longer, seconds of the processor.
pub const SLOW: f64 = 1.0;
/// Changes to one file.
const MOST_CHANGES: usize = 3;
/// Characters that an answer may have: more cannot be read in a line.
const LONGEST_ANSWER: usize = 2000;

/// What became of the damaged files of one reader.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// How many there were.
    pub files: u64,
    /// Those that were taken: damaged where it does not matter.
    pub taken: u64,
    /// Those that were refused in words.
    pub refused: u64,
    /// Numbers of those that made the reader panic, and why.
    pub panics: Vec<(u64, String)>,
    /// Numbers of those that took longer than [`SLOW`], and how long.
    pub slow: Vec<(u64, f64)>,
    /// Numbers of those that were refused without words or with more than can be read.
    pub unclear: Vec<(u64, String)>,
    /// The longest time of one, seconds.
    pub slowest: f64,
    /// How often each refusal came, without its figures.
    pub words: BTreeMap<String, u64>,
}

impl Tally {
    /// Whether every file was taken or refused in words, in time.
    pub fn is_good(&self) -> bool {
        self.panics.is_empty() && self.slow.is_empty() && self.unclear.is_empty()
    }

    /// Counts those of `more`, too.
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

    /// Numbers of the files that were too much.
    pub fn bad(&self) -> impl Iterator<Item = u64> {
        let panics = self.panics.iter().map(|(number, _)| *number);
        panics
            .chain(self.slow.iter().map(|(number, _)| *number))
            .chain(self.unclear.iter().map(|(number, _)| *number))
    }
}

/// The damaged file `number` of a reader: the same number gives the same bytes.
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

/// Gives `reader` the damaged files of these numbers. `seconds` tells the time that the processor has worked.
pub fn run(reader: &Reader, numbers: std::ops::Range<u64>, seconds: &dyn Fn() -> f64) -> Tally {
    let mut tally = Tally::default();
    for number in numbers {
        let bytes = damaged(reader, number);
        let (before, start) = (seconds(), Instant::now());
        let answer = catch_unwind(AssertUnwindSafe(|| (reader.read)(&bytes)));
        // A loaded machine makes the clock on the wall run on, several threads that of the processor.
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

/// Digits become one, what is quoted goes.
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
