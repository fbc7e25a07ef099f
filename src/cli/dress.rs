//! `toile dress`: wrap by the marks, relax to rest, drape, write what came out.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::cli::arguments::Dress;
use crate::cli::failure::Failure;
use crate::cli::report::{Report, Seconds};
use crate::cli::{input, output, report, run};
use crate::session::{Command, Session, project_file};

/// Dresses every project named. With several each gets a folder and a line; the first failure gives the exit code.
pub fn dress(arguments: &Dress) -> Result<(), Failure> {
    if let [project] = &arguments.projects[..] {
        let report = dress_one(project, &arguments.out, arguments)?;
        output::say(&if arguments.json { report.json()? } else { report.verdict() });
        return report.failed_check().map_or(Ok(()), |words| Err(Failure::Check(words)));
    }
    if arguments.save.is_some() || arguments.record.is_some() {
        return Err(Failure::Usage("--save and --record take one project, not several".to_owned()));
    }
    let mut first_failure = None;
    for (project, folder) in arguments.projects.iter().zip(folders(arguments)) {
        let failure = match dress_one(project, &folder, arguments) {
            Err(signal @ Failure::Signal(_)) => return Err(signal),
            Err(failure) => {
                output::say(&format!("{}: failed: {failure}", project.display()));
                Some(failure)
            }
            Ok(report) => {
                output::say(&if arguments.json { report.json_line()? } else { report.verdict() });
                report.failed_check().map(Failure::Check)
            }
        };
        first_failure = first_failure.or(failure);
    }
    first_failure.map_or(Ok(()), Err)
}

/// A folder for each project, named like it; equal names get a number.
fn folders(arguments: &Dress) -> Vec<PathBuf> {
    let mut names: Vec<String> = Vec::new();
    for project in &arguments.projects {
        let stem = input::name_of(project);
        let taken = |name: &String| names.contains(name);
        let numbered = (2..).map(|i| format!("{stem}-{i}"));
        let name = std::iter::once(stem.clone()).chain(numbered).find(|n| !taken(n)).unwrap_or(stem);
        names.push(name);
    }
    names.iter().map(|name| arguments.out.join(name)).collect()
}

fn dress_one(project: &Path, folder: &Path, arguments: &Dress) -> Result<Report, Failure> {
    let start = Instant::now();
    let mut seconds = Seconds::default();
    let input = input::load(project, &arguments.input)?;
    output::make_folder(folder)?;
    let mut session = run::opened(input.project, project)?;
    seconds.load = start.elapsed().as_secs_f64();
    if let Some(path) = &arguments.record {
        let file = File::create(path).map_err(|e| Failure::file(path, e))?;
        session.recorder().also_to(file).map_err(|e| Failure::file(path, e))?;
    }
    run::simulation(&mut session)?.set_skips(arguments.work.no_skip);
    if let Some(fabric) = &arguments.fabric {
        let command = Command::SetFabric { piece: None, fabric: Some(fabric.clone()) };
        session.apply_alone(command).map_err(|why| Failure::Usage(why.0))?;
    }
    dress_by(&mut session, project, &mut seconds)?;
    run::to_rest(&mut session, arguments.max_ticks, &mut seconds)?;
    if arguments.drape {
        run::drape(&mut session, project, arguments.max_ticks, &mut seconds)?;
    }
    if let Some(error) = session.recorder().take_file_error() {
        return Err(Failure::file(arguments.record.as_deref().unwrap_or(Path::new("recording")), error));
    }
    if let Some(path) = &arguments.save {
        project_file::save(path, &session.project()).map_err(|e| input::project_failure(path, e))?;
    }
    let mut report = report::write(&mut session, &input.name, folder, &arguments.picture, seconds)?;
    report.inputs = input.files;
    report.finish(folder, start)?;
    Ok(report)
}

/// By its marks; without any, from where its pieces are placed.
fn dress_by(session: &mut Session, project: &Path, seconds: &mut Seconds) -> Result<(), Failure> {
    let document = session.document();
    let placed = document.pattern.pieces.values().any(|piece| piece.placement.is_some());
    match document.marks.pairs().next().is_none() && placed {
        true => begin(session, project, seconds, Command::Sew),
        false => wrap(session, project, seconds),
    }
}

/// Begins the wrap; says what stands in its way.
pub fn wrap(session: &mut Session, project: &Path, seconds: &mut Seconds) -> Result<(), Failure> {
    begin(session, project, seconds, Command::Wrap)
}

fn begin(
    session: &mut Session,
    project: &Path,
    seconds: &mut Seconds,
    command: Command,
) -> Result<(), Failure> {
    let start = Instant::now();
    session.apply_alone(command).map_err(|why| Failure::input(project, why))?;
    session.update();
    seconds.build = start.elapsed().as_secs_f64();
    let problems: Vec<String> = session
        .snapshot()
        .problems
        .iter()
        .filter(|p| !p.kind.is_note())
        .map(|p| format!("{}: {}", p.place, p.words))
        .collect();
    let snapshot = session.snapshot();
    if snapshot.is_dressed() || snapshot.working {
        problems.iter().for_each(|words| output::complain(&format!("{}: {words}", project.display())));
        return Ok(());
    }
    let words = format!("no cloth could be put on the body: {}", problems.join("; "));
    Err(Failure::input(project, words))
}
