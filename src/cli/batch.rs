//! `toile dress` for several projects, one after the other: each gets a folder and a line of output.

use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use serde::Serialize;
use serde_json::{Map, Value};

use crate::cli::arguments::Dress;
use crate::cli::dress_one::{Done, dress_one};
use crate::cli::failure::Failure;
use crate::cli::graphics::Graphics;
use crate::cli::lines::Lines;
use crate::cli::list::{self, Entry};
use crate::cli::seconds::Begun;
use crate::cli::verdict::{Times, Verdict};
use crate::cli::{interrupt, output};

/// A garment to dress and the folder for its results.
struct Job {
    entry: Entry,
    /// Name of the folder, which no other of all garments has.
    name: String,
    folder: PathBuf,
}

/// The line of a garment: printed with --json, and added to the lines of a list.
#[derive(Debug, Serialize)]
struct Line<'a> {
    garment: &'a str,
    project: &'a Path,
    folder: &'a Path,
    /// The options that its line of the list gives.
    #[serde(skip_serializing_if = "Option::is_none")]
    options: Option<Map<String, Value>>,
    outcome: Outcome,
    /// The exit code of dressing this project alone.
    exit_code: u8,
    /// Whether the result was already there and --resume skipped the project.
    resumed: bool,
    /// When this line was written, seconds since 1970.
    finished: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
    #[serde(flatten)]
    verdict: Option<&'a Verdict>,
    /// How long it took to fail.
    #[serde(flatten)]
    times: Option<Times>,
}

#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
enum Outcome {
    Dressed,
    NotDressed,
    Failed,
}

/// Dresses all projects of the chosen part. Its failure is that of the project with the greatest exit code, of several the first;
/// where the worst is that garments are not dressed, which their lines tell, it counts them.
pub fn batch(arguments: &Dress) -> Result<(), Failure> {
    if arguments.save.is_some() || arguments.record.is_some() {
        let words = "--save and --record take one project, not several; a line of a list can save";
        return Err(Failure::Usage(words.to_owned()));
    }
    let jobs = jobs(arguments)?;
    let mut lines = None;
    if arguments.list.is_some() {
        output::make_folder(&arguments.out)?;
        lines = Some(Lines::open(&arguments.out, arguments.shard)?);
    }
    let (start, mut worst, mut not_dressed, mut failed) = (Instant::now(), None::<Failure>, 0, 0);
    let mut graphics = Graphics::default();
    for (i, job) in jobs.iter().enumerate() {
        if arguments.progress || output::is_watched() {
            let (name, so_far) = (&job.name, start.elapsed().as_secs_f64());
            output::complain(&format!("{} of {}: {name}, after {so_far:.1} s", i + 1, jobs.len()));
        }
        let begun = Begun::now();
        let done = interrupt::check().and_then(|()| dressed(job, arguments, &mut graphics));
        if let Err(signal @ Failure::Signal(_)) = done {
            output::complain(&format!("{i} of {} are done; --resume goes on from there", jobs.len()));
            return Err(signal);
        }
        if done.is_ok() && lines.is_some() {
            // The folder is this garment's own.
            output::sweep(&job.folder);
        }
        let told = Told::new(job, done, begun);
        let line = serde_json::to_string(&told.line()).map_err(|e| Failure::Internal(e.to_string()))?;
        if let Some(lines) = &mut lines {
            lines.add(&line)?;
        }
        output::say(if arguments.json { &line } else { &told.words });
        if let Some(note) = &told.note {
            output::complain(note);
        }
        match &told.failure {
            None => {}
            Some(Failure::Faults { .. }) => not_dressed += 1,
            Some(_) => failed += 1,
        }
        let code = |failure: &Option<Failure>| failure.as_ref().map_or(0, Failure::exit_code);
        if code(&told.failure) > code(&worst) {
            worst = told.failure;
        }
    }
    match worst {
        None => Ok(()),
        Some(Failure::Faults { .. }) => Err(Failure::not_dressed(not_dressed, jobs.len())),
        Some(failure) => {
            output::complain(&format!(
                "failed: {failed}, not dressed: {not_dressed}; the first of the worst:"
            ));
            Err(failure)
        }
    }
}

/// Dresses one project. A panic counts as its failure, so that the projects after it are still dressed.
fn dressed(job: &Job, arguments: &Dress, graphics: &mut Graphics) -> Result<Done, Failure> {
    let own = job.entry.arguments(arguments, &job.folder)?;
    let words = || Failure::Internal("internal error, see above".to_owned());
    let done = catch_unwind(AssertUnwindSafe(|| dress_one(&job.entry.project, &job.folder, &own, graphics)));
    done.unwrap_or_else(|_| Err(words()))
}

/// What came of one project.
struct Told<'a> {
    job: &'a Job,
    verdict: Option<Verdict>,
    resumed: bool,
    failure: Option<Failure>,
    times: Times,
    /// A summary for people.
    words: String,
    /// What was tried, told after it.
    note: Option<String>,
}

impl<'a> Told<'a> {
    fn new(job: &'a Job, done: Result<Done, Failure>, begun: Begun) -> Self {
        let times = Times { seconds: begun.seconds(), processor_seconds: begun.processor_seconds() };
        match done {
            Ok(Done { verdict, resumed, note, .. }) => {
                let failure = verdict.failure();
                let before = if resumed { " (done before)" } else { "" };
                // The folder's name, where it is not the garment's.
                let folder = if verdict.name == job.name { String::new() } else { format!("{}: ", job.name) };
                let words = format!("{folder}{verdict}{before}");
                Self { job, verdict: Some(verdict), resumed, failure, times, words, note }
            }
            Err(failure) => {
                let words = format!("{}: failed: {failure}", job.entry.project.display());
                let failure = Some(failure);
                Self { job, verdict: None, resumed: false, failure, times, words, note: None }
            }
        }
    }

    fn line(&self) -> Line<'_> {
        let outcome = match (&self.verdict, &self.failure) {
            (Some(_), None) => Outcome::Dressed,
            (Some(_), Some(_)) => Outcome::NotDressed,
            (None, _) => Outcome::Failed,
        };
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        Line {
            garment: &self.job.name,
            project: &self.job.entry.project,
            folder: &self.job.folder,
            options: self.job.entry.options(),
            outcome,
            exit_code: self.failure.as_ref().map_or(0, Failure::exit_code),
            resumed: self.resumed,
            finished: now.as_secs_f64(),
            error: self.failure.as_ref().map(Failure::to_string),
            verdict: self.verdict.as_ref(),
            times: self.verdict.is_none().then_some(self.times),
        }
    }
}

/// The chosen part of the projects named on the command line and then those of the list, each with a folder of its name; equal
/// names get a number.
fn jobs(arguments: &Dress) -> Result<Vec<Job>, Failure> {
    let mut entries: Vec<Entry> = arguments.projects.iter().map(|project| Entry::named(project)).collect();
    if let Some(path) = &arguments.list {
        entries.extend(list::entries(path)?);
    }
    let mut names = Names::default();
    let named = entries.into_iter().map(|entry| (names.unlike(&entry.name), entry));
    let job = |(name, entry): (String, Entry)| Job { folder: arguments.out.join(&name), entry, name };
    let shard = arguments.shard.unwrap_or_default();
    Ok(named.map(job).enumerate().filter(|(i, _)| shard.has(*i)).map(|(_, job)| job).collect())
}

/// The names that folders have.
#[derive(Default)]
struct Names {
    taken: BTreeSet<String>,
    /// The last number that was given to each name.
    numbers: BTreeMap<String, usize>,
}

impl Names {
    /// `name`, or the first of name-2, name-3, … that is not taken; taken from now on.
    fn unlike(&mut self, name: &str) -> String {
        let mut unlike = name.to_owned();
        while !self.taken.insert(unlike.clone()) {
            let number = self.numbers.entry(name.to_owned()).or_insert(1);
            *number += 1;
            unlike = format!("{name}-{number}");
        }
        unlike
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_names_get_numbers_and_none_comes_twice() {
        let mut names = Names::default();
        let given = ["a", "a-2", "a", "b", "a", "a-2"].map(|name| names.unlike(name));
        assert_eq!(given, ["a", "a-2", "a-3", "b", "a-4", "a-2-2"]);
    }
}
