//! Dresses one project: wraps it by its marks, relaxes to rest, drapes, and writes the results.

use std::fs::File;
use std::path::Path;
use std::time::Instant;

use crate::cli::arguments::Dress;
use crate::cli::failure::Failure;
use crate::cli::graphics::Graphics;
use crate::cli::made_from::made_from;
use crate::cli::seconds::{Begun, Seconds};
use crate::cli::verdict::Verdict;
use crate::cli::{input, output, report, run};
use crate::pattern::Pattern;
use crate::session::{Command, Session, project_file};
use crate::sim::{Start, StartChoice, Started, Tried};

/// A dressed project whose files are written.
pub struct Done {
    pub verdict: Verdict,
    /// The text of report.json without its final line end.
    pub report: String,
    /// Whether the result was already there, made from the same inputs.
    pub resumed: bool,
    /// A line about what was tried, where no start was without a fault or only an undraped one; None as well for a result that was
    /// already there.
    pub note: Option<String>,
}

/// Dresses `project` into `folder`, and draws it with `graphics`. With --resume a result that is already there is left.
pub fn dress_one(
    project: &Path,
    folder: &Path,
    arguments: &Dress,
    graphics: &mut Graphics,
) -> Result<Done, Failure> {
    let start = Begun::now();
    let made_from = made_from(project, arguments)?;
    if arguments.resume
        && arguments.save.as_deref().is_none_or(Path::exists)
        && let Some((verdict, report)) = Verdict::stored(folder, &made_from)
    {
        return Ok(Done { verdict, report, resumed: true, note: None });
    }
    let mut seconds = Seconds::default();
    let input = input::load(project, &arguments.input)?;
    output::make_folder(&arguments.out)?;
    let mut session = run::opened(input.project, project)?;
    seconds.load = start.seconds();
    if !arguments.no_picture {
        graphics.open();
    }
    if let Some(path) = &arguments.record {
        let file = File::create(path).map_err(|e| Failure::file(path, e))?;
        session.recorder().also_to(file).map_err(|e| Failure::file(path, e))?;
    }
    run::simulation(&mut session)?.set_skips(arguments.work.no_skip);
    if let Some(kind) = arguments.card {
        session.use_card(Some(run::card(kind)?));
    }
    run::choose_cloth(&mut session, &arguments.cloth)?;
    let choice = StartChoice { only: arguments.start, draped: arguments.drape };
    dress_by(&mut session, project, choice, &mut seconds)?;
    run::to_rest(&mut session, arguments.max_ticks, &mut seconds)?;
    let started = session.snapshot().started.clone();
    let note = started.as_deref().and_then(doubt);
    let note = note.map(|words| format!("{}: note: {words}", project.display()));
    if arguments.drape && !started.is_some_and(|started| started.taken().draped) {
        run::drape(&mut session, project, arguments.max_ticks, &mut seconds)?;
    }
    if let Some(error) = session.recorder().take_file_error() {
        return Err(Failure::file(arguments.record.as_deref().unwrap_or(Path::new("recording")), error));
    }
    if let Some(path) = &arguments.save {
        path.parent().filter(|to| *to == folder).map_or(Ok(()), output::make_folder)?;
        project_file::save(path, &session.project()).map_err(|e| input::project_failure(path, e))?;
    }
    let picture = (!arguments.no_picture).then_some((&arguments.picture, graphics));
    let mut report = report::report(&mut session, &input.name, picture, seconds)?;
    (report.inputs, report.made_from) = (input.files, Some(made_from));
    report.finish(folder, start)?;
    Ok(Done { verdict: report.verdict()?, report: report.json()?, resumed: false, note })
}

/// Wraps by the marks; without any, dresses by the best start.
pub fn dress_by(
    session: &mut Session,
    project: &Path,
    choice: StartChoice,
    seconds: &mut Seconds,
) -> Result<(), Failure> {
    let document = session.document();
    let is_placed = document.pattern.pieces.values().any(|piece| piece.placement.is_some());
    let has_marks = document.marks.pairs().next().is_some() && choice.only != Some(Start::Placement);
    if !(has_marks || is_placed || choice.only.is_some() || document.pattern.pieces.is_empty()) {
        return Err(Failure::input(project, no_start(&document.pattern)));
    }
    if has_marks || document.pattern.pieces.is_empty() {
        return wrap(session, project, seconds);
    }
    begin(session, project, seconds, Command::Dress { choice })
}

/// Why a pattern without placed pieces and without marks cannot be dressed, and what to do first.
fn no_start(pattern: &Pattern) -> String {
    let (seams, first) = match pattern.seams.is_empty() {
        true => ("no seams, ", "sew its edges and place its pieces (Shift+B)"),
        false => ("", "place its pieces (Shift+B) or paint marks"),
    };
    format!(
        "it has {seams}no piece placed in space and no pair of marks: {first} in the window, then dress; \
         marks in a file are given with --marks"
    )
}

/// A warning where no start ended without a fault, or none when it was draped.
fn doubt(started: &Started) -> Option<String> {
    let faults = |tried: &Tried| match tried.faults.len() {
        1 => format!("{} has 1 fault", named(tried)),
        n => format!("{} has {n} faults", named(tried)),
    };
    let all: Vec<String> = started.tried.iter().map(faults).collect();
    let taken = named(started.taken());
    if let Some(fault) = started.draped_fault() {
        return Some(format!("{taken} is taken, not draped: when it was draped, {fault}"));
    }
    (!started.taken().faults.is_empty())
        .then(|| format!("no start is without a fault: {}; {taken} is taken", all.join(", ")))
}

/// A start as it is told to somebody who painted no marks.
fn named(tried: &Tried) -> String {
    match tried.start {
        Start::Marks => format!("the start by suggested {tried}"),
        Start::Placement => format!("the start from {tried}"),
    }
}

/// Begins the wrap; the error says why it cannot begin.
fn wrap(session: &mut Session, project: &Path, seconds: &mut Seconds) -> Result<(), Failure> {
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
    let words = format!("{}; so no cloth could be put on the body", problems.join("; "));
    Err(Failure::input(project, words))
}
