//! `toile dress` for several projects, one after the other: each gets a folder and a line of output.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;

use crate::cli::arguments::Dress;
use crate::cli::dress_one::{Done, dress_one};
use crate::cli::failure::Failure;
use crate::cli::verdict::Verdict;
use crate::cli::{files, interrupt, output};

/// A project to dress and the folder for its results.
struct Job {
    project: PathBuf,
    folder: PathBuf,
}

/// The line printed with --json for a project.
#[derive(Debug, Serialize)]
struct Line<'a> {
    project: &'a Path,
    folder: &'a Path,
    outcome: Outcome,
    /// The exit code of dressing this project alone.
    exit_code: u8,
    /// Whether the result was already there and --resume skipped the project.
    resumed: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
    #[serde(flatten)]
    verdict: Option<&'a Verdict>,
}

#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
enum Outcome {
    Dressed,
    NotDressed,
    Failed,
}

/// Dresses all projects. Its failure is that of the project with the greatest exit code, of several the first.
pub fn batch(arguments: &Dress) -> Result<(), Failure> {
    if arguments.save.is_some() || arguments.record.is_some() {
        return Err(Failure::Usage("--save and --record take one project, not several".to_owned()));
    }
    let jobs = jobs(arguments)?;
    let (start, mut worst) = (Instant::now(), None::<Failure>);
    for (i, job) in jobs.iter().enumerate() {
        if arguments.progress || output::is_watched() {
            let (name, so_far) = (files::name_of(&job.project), start.elapsed().as_secs_f64());
            output::complain(&format!("{} of {}: {name}, after {so_far:.1} s", i + 1, jobs.len()));
        }
        let done = interrupt::check().and_then(|()| dressed(job, arguments));
        if let Err(signal @ Failure::Signal(_)) = done {
            output::complain(&format!("{i} of {} are done; --resume goes on from there", jobs.len()));
            return Err(signal);
        }
        let failure = tell(job, done, arguments.json)?;
        let code = |failure: &Option<Failure>| failure.as_ref().map_or(0, Failure::exit_code);
        if code(&failure) > code(&worst) {
            worst = failure;
        }
    }
    worst.map_or(Ok(()), Err)
}

/// Dresses one project. A panic counts as its failure, so that the projects after it are still dressed.
fn dressed(job: &Job, arguments: &Dress) -> Result<Done, Failure> {
    let words = || Failure::Internal("internal error, see above".to_owned());
    let done = catch_unwind(AssertUnwindSafe(|| dress_one(&job.project, &job.folder, arguments)));
    done.unwrap_or_else(|_| Err(words()))
}

/// Prints the line of one project and returns its failure, if it failed.
fn tell(job: &Job, done: Result<Done, Failure>, json: bool) -> Result<Option<Failure>, Failure> {
    let Job { project, folder } = job;
    let (verdict, resumed, failure) = match done {
        Ok(Done { verdict, resumed, .. }) => {
            let failure = verdict.failed_check().map(Failure::Check);
            (Some(verdict), resumed, failure)
        }
        Err(failure) => (None, false, Some(failure)),
    };
    let words = match (&verdict, &failure) {
        (_, failure) if json => {
            let outcome = match (&verdict, failure) {
                (Some(_), None) => Outcome::Dressed,
                (Some(_), Some(_)) => Outcome::NotDressed,
                (None, _) => Outcome::Failed,
            };
            let line = Line {
                project,
                folder,
                outcome,
                exit_code: failure.as_ref().map_or(0, Failure::exit_code),
                resumed,
                error: failure.as_ref().map(Failure::to_string),
                verdict: verdict.as_ref(),
            };
            serde_json::to_string(&line).map_err(|e| Failure::Internal(e.to_string()))?
        }
        (Some(verdict), _) if resumed => format!("{verdict} (done before)"),
        (Some(verdict), _) => verdict.to_string(),
        (None, failure) => {
            let words = failure.as_ref().map(Failure::to_string).unwrap_or_default();
            format!("{}: failed: {words}", project.display())
        }
    };
    output::say(&words);
    Ok(failure)
}

/// The projects named on the command line, then those of the list, each with a folder of its name; equal names get a number.
fn jobs(arguments: &Dress) -> Result<Vec<Job>, Failure> {
    let mut projects = arguments.projects.clone();
    if let Some(path) = &arguments.list {
        projects.extend(listed(path)?);
    }
    let mut names: Vec<String> = Vec::new();
    for project in &projects {
        let stem = files::name_of(project);
        let taken = |name: &String| names.contains(name);
        let numbered = (2..).map(|i| format!("{stem}-{i}"));
        let name = std::iter::once(stem.clone()).chain(numbered).find(|n| !taken(n)).unwrap_or(stem);
        names.push(name);
    }
    let folders = names.iter().map(|name| arguments.out.join(name));
    Ok(projects.into_iter().zip(folders).map(|(project, folder)| Job { project, folder }).collect())
}

/// The projects that the list file at `path` names.
fn listed(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    let text = String::from_utf8(files::read(path)?).map_err(|e| {
        Failure::input(path, format!("not a list: no UTF-8 at byte {}", e.utf8_error().valid_up_to()))
    })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let lines = text.trim_start_matches('\u{feff}').lines().map(str::trim);
    let named = lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
    let place = |line: &str| match files::is_sample(Path::new(line)) {
        true => PathBuf::from(line),
        false => folder.join(line),
    };
    let projects: Vec<PathBuf> = named.map(place).collect();
    match projects.is_empty() {
        true => Err(Failure::input(path, "this list names no project")),
        false => Ok(projects),
    }
}
