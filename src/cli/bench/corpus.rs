//! Dresses generated garments as `toile dress` does and counts, by its report, those without a fault; for the others it lists the
//! reasons.

use std::collections::BTreeMap;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::time::Instant;

use serde::Serialize;

use crate::body::NamedPose;
use crate::cli::arguments::{Bench, Dress};
use crate::cli::bench::{median, say};
use crate::cli::dress_one::dress_one;
use crate::cli::failure::Failure;
use crate::cli::generate::{Forms, SIZES_FILE, write_sizes};
use crate::cli::graphics::Graphics;
use crate::cli::{interrupt, output};
use crate::draft::{Case, Kind};
use crate::io::garmentcode;

/// Size of the pictures of failures, pixels.
const PICTURE: [u32; 2] = [640, 800];
/// Largest number of reasons that are printed.
const MOST_REASONS: usize = 12;
/// Largest number of failures named with a reason.
const MOST_EXAMPLES: usize = 3;

/// The result of one garment.
#[derive(Debug, Serialize)]
struct Outcome {
    name: String,
    kind: Kind,
    body_size: &'static str,
    pose: &'static str,
    exit_code: u8,
    seconds: f64,
    /// Why the garment is not dressed; empty when it is.
    reasons: Vec<String>,
    /// The command line that dresses the garment again, in the folder that failures are kept in.
    command: String,
}

impl Outcome {
    fn is_clean(&self) -> bool {
        self.exit_code == 0
    }
}

/// The results of garments that have something in common.
#[derive(Debug, Serialize)]
struct Group {
    name: &'static str,
    garments: usize,
    clean: usize,
    /// Fraction of clean garments.
    share: f64,
    /// Median wall-clock time of a garment, seconds.
    median_seconds: f64,
    worst_seconds: f64,
}

/// A reason for failures, with its numbers left out, and how many garments it applies to.
#[derive(Debug, Serialize)]
struct Reason {
    words: String,
    garments: usize,
    examples: Vec<String>,
}

/// The results of all garments.
#[derive(Debug, Serialize)]
struct Summary {
    seed: u64,
    all: Group,
    kinds: Vec<Group>,
    sizes: Vec<Group>,
    poses: Vec<Group>,
    /// Name of the garment that took longest.
    slowest: String,
    reasons: Vec<Reason>,
    failures: Vec<Outcome>,
}

/// Dresses all chosen garments and prints the fraction without a fault.
pub fn corpus(arguments: &Bench) -> Result<(), Failure> {
    let corpus = arguments.corpus.corpus();
    let cases = corpus.cases(arguments.corpus.shard.unwrap_or_default());
    if cases.is_empty() {
        return Err(Failure::Usage("there is no garment in this shard".to_owned()));
    }
    let bench = Work::new(arguments)?;
    let (mut forms, mut outcomes, mut graphics) = (Forms::default(), Vec::new(), Graphics::default());
    for (i, case) in cases.iter().enumerate() {
        interrupt::check()?;
        let design = corpus.design(case);
        let pattern = forms.pattern(case, &design)?;
        let bytes = garmentcode::write(&pattern).bytes;
        let outcome = bench.outcome((case, design.kind), &case.name(&design), &bytes, &mut graphics)?;
        let words = match outcome.is_clean() {
            true => "clean".to_owned(),
            false => outcome.reasons.join("; "),
        };
        let line =
            format!("{} of {}: {}: {words}, {:.1} s", i + 1, cases.len(), outcome.name, outcome.seconds);
        output::complain(&line);
        outcomes.push(outcome);
    }
    bench.leave();
    say(&Summary::new(corpus.seed, outcomes), arguments.json)
}

/// The folder in which garments are dressed.
struct Work<'a> {
    arguments: &'a Bench,
    folder: PathBuf,
}

impl<'a> Work<'a> {
    fn new(arguments: &'a Bench) -> Result<Self, Failure> {
        let own = || std::env::temp_dir().join(format!("toile-corpus-{}", std::process::id()));
        let folder = arguments.out.clone().unwrap_or_else(own);
        output::make_folder(&folder)?;
        write_sizes(&folder)?;
        Ok(Self { arguments, folder })
    }

    /// Removes the folder if it is a temporary one.
    fn leave(&self) {
        if self.arguments.out.is_none() {
            // It is in the system's folder for temporary files; nothing is lost if it stays.
            std::fs::remove_dir_all(&self.folder).ok();
        }
    }

    /// Dresses one garment; its files are kept only if it fails.
    fn outcome(
        &self,
        (case, kind): (&Case, Kind),
        name: &str,
        bytes: &[u8],
        graphics: &mut Graphics,
    ) -> Result<Outcome, Failure> {
        let folder = self.folder.join(name);
        output::make_folder(&folder)?;
        let pattern = folder.join(format!("{name}.json"));
        output::write(&pattern, bytes)?;
        let mut dress = Dress::sample(&pattern, &folder);
        dress.input.sized.sizes = Some(self.folder.join(SIZES_FILE));
        dress.input.sized.body_size = Some(case.size.name.to_owned());
        dress.input.pose = (case.pose != NamedPose::A).then_some(case.pose);
        dress.picture.size = PICTURE;
        dress.work = self.arguments.work;
        dress.max_ticks = self.arguments.max_ticks.unwrap_or(dress.max_ticks);
        let command = command(name, case, self.arguments.max_ticks);
        let start = Instant::now();
        let done = catch_unwind(AssertUnwindSafe(|| dress_one(&pattern, &folder, &dress, graphics)))
            .unwrap_or_else(|_| Err(Failure::Internal("internal error, see above".to_owned())));
        let seconds = start.elapsed().as_secs_f64();
        let (exit_code, seconds, reasons) = match done {
            Ok(done) => {
                let reasons: Vec<String> = done.verdict.reasons().map(str::to_owned).collect();
                (u8::from(!reasons.is_empty()), done.verdict.seconds(), reasons)
            }
            Err(signal @ Failure::Signal(_)) => return Err(signal),
            Err(failure) => {
                let words = match &failure {
                    Failure::Input { words, .. } => words.clone(),
                    other => other.to_string(),
                };
                (failure.exit_code(), seconds, vec![words])
            }
        };
        match exit_code {
            0 => std::fs::remove_dir_all(&folder).map_err(|error| Failure::file(&folder, error))?,
            _ => output::write(&folder.join("command.txt"), format!("{command}\n").as_bytes())?,
        }
        let (body_size, pose) = (case.size.name, case.pose.name());
        Ok(Outcome { name: name.to_owned(), kind, body_size, pose, exit_code, seconds, reasons, command })
    }
}

/// The command line that dresses a kept garment again, from the folder that failures are kept in.
fn command(name: &str, case: &Case, max_ticks: Option<u64>) -> String {
    let pose = match case.pose {
        NamedPose::A => String::new(),
        other => format!(" --pose {}", other.name()),
    };
    let ticks = max_ticks.map(|ticks| format!(" --max-ticks {ticks}")).unwrap_or_default();
    let size = case.size.name;
    format!(
        "toile dress {name}/{name}.json --sizes {SIZES_FILE} --body-size {size}{pose}{ticks} --out {name}"
    )
}

impl Summary {
    fn new(seed: u64, outcomes: Vec<Outcome>) -> Self {
        let all = Group::new("all", &outcomes, |_| true);
        let kinds = groups(Kind::ALL.map(Kind::name), &outcomes, |o| o.kind.name());
        let sizes = groups(crate::draft::SIZES.map(|size| size.name), &outcomes, |o| o.body_size);
        let poses = groups(["a", "t"], &outcomes, |o| o.pose);
        let slowest = outcomes.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds));
        let slowest = slowest.map(|o| o.name.clone()).unwrap_or_default();
        let reasons = reasons(&outcomes);
        let failures = outcomes.into_iter().filter(|o| !o.is_clean()).collect();
        Self { seed, all, kinds, sizes, poses, slowest, reasons, failures }
    }
}

impl Group {
    fn new(name: &'static str, outcomes: &[Outcome], is_one: impl Fn(&Outcome) -> bool) -> Self {
        let own: Vec<&Outcome> = outcomes.iter().filter(|o| is_one(o)).collect();
        let clean = own.iter().filter(|o| o.is_clean()).count();
        let seconds: Vec<f64> = own.iter().map(|o| o.seconds).collect();
        Self {
            name,
            garments: own.len(),
            clean,
            share: clean as f64 / own.len().max(1) as f64,
            worst_seconds: seconds.iter().copied().fold(0.0, f64::max),
            median_seconds: median(seconds),
        }
    }
}

/// The results grouped by `names`, without empty groups.
fn groups<const N: usize>(
    names: [&'static str; N],
    outcomes: &[Outcome],
    name_of: impl Fn(&Outcome) -> &'static str,
) -> Vec<Group> {
    let all = names.into_iter().map(|name| Group::new(name, outcomes, |o| name_of(o) == name));
    all.filter(|group| group.garments > 0).collect()
}

/// The reasons without their numbers, the most frequent first.
fn reasons(outcomes: &[Outcome]) -> Vec<Reason> {
    let mut found: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for outcome in outcomes {
        for words in &outcome.reasons {
            let names = found.entry(without_figures(words)).or_default();
            if names.last() != Some(&outcome.name.as_str()) {
                names.push(&outcome.name);
            }
        }
    }
    let reason = |(words, names): (String, Vec<&str>)| Reason {
        words,
        garments: names.len(),
        examples: names.into_iter().take(MOST_EXAMPLES).map(str::to_owned).collect(),
    };
    let mut all: Vec<Reason> = found.into_iter().map(reason).collect();
    all.sort_by_key(|reason| std::cmp::Reverse(reason.garments));
    all
}

/// `words` up to its list of names, with numbers replaced by "N".
fn without_figures(words: &str) -> String {
    let mut plain = String::new();
    let mut in_number = false;
    for c in words.split(" are open: ").next().unwrap_or_default().chars() {
        let is_figure = c.is_ascii_digit() || in_number && (c == '.' || c == ',');
        if is_figure && !in_number {
            plain.push('N');
        } else if !is_figure {
            plain.push(c);
        }
        in_number = is_figure;
    }
    plain
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<16} garments  clean   share   median    worst", "")?;
        let parts = [&self.kinds, &self.sizes, &self.poses];
        for group in parts.into_iter().flatten().chain([&self.all]) {
            let Group { name, garments, clean, share, median_seconds, worst_seconds } = group;
            let percent = share * 100.0;
            writeln!(
                f,
                "{name:<16} {garments:>8} {clean:>6} {percent:>6.1}% {median_seconds:>6.1} s {worst_seconds:>6.1} s"
            )?;
        }
        write!(f, "slowest: {}", self.slowest)?;
        for Reason { words, garments, examples } in self.reasons.iter().take(MOST_REASONS) {
            write!(f, "\n{garments:>4}: {words} ({})", examples.join(", "))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_are_counted_without_their_figures() {
        let one = "12 vertices and 3 triangles of the cloth are inside the body, up to 2.5 mm";
        let plain = "N vertices and N triangles of the cloth are inside the body, up to N mm";
        assert_eq!(without_figures(one), plain);
        assert_eq!(without_figures("2 of 9 seams are open: side of front"), "N of N seams");
    }
}
