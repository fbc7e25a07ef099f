//! The command line: one file per subcommand, with nothing but arguments, calls and printing.

mod arguments;
mod art_options;
mod batch;
mod bench;
mod check;
mod cloth_options;
mod compare;
mod completions;
mod display;
mod dress;
mod dress_one;
mod export;
mod failure;
mod files;
mod fit;
mod formats;
mod generate;
mod graphics;
mod help;
mod import;
mod input;
mod interrupt;
mod language;
mod lines;
mod list;
mod made_from;
mod man;
mod marker;
mod measure;
mod merge;
mod open;
mod output;
mod picture;
mod quiet;
mod render;
mod replay;
mod report;
mod repose;
mod run;
mod seconds;
mod sequence;
mod simulate;
mod size_report;
mod sizes;
mod techpack;
mod texture_options;
mod verdict;

use std::ffi::OsStr;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};
use tracing_subscriber::EnvFilter;

use crate::cli::arguments::{Arguments, Report, ReportTask, Task};
use crate::cli::failure::{Failure, PANIC};
use crate::session::samples::Sample;
use crate::session::whole_file;

/// Runs the program. It never panics; failures are printed on standard error, and the exit code gives their kind.
pub fn main() -> ExitCode {
    listen_to_traces();
    std::panic::set_hook(Box::new(|panic| {
        if !display::is_lost(panic) {
            output::complain(&panic_words(panic));
        }
    }));
    let code = catch_unwind(AssertUnwindSafe(run)).unwrap_or(PANIC);
    ExitCode::from(code)
}

fn run() -> u8 {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return show_usage(&error),
    };
    if let Some(words) =
        arguments.project.as_deref().filter(|path| is_word(path)).and_then(|p| misspelt(p.as_os_str()))
    {
        output::complain(&words);
        return Failure::Usage(words).exit_code();
    }
    match carry_out(arguments) {
        Ok(()) => 0,
        Err(failure) => {
            interrupt::tell(&failure);
            whole_file::remove_empty_folders();
            failure.exit_code()
        }
    }
}

fn carry_out(arguments: Arguments) -> Result<(), Failure> {
    quiet::begin_anew();
    interrupt::listen();
    run::start_threads()?;
    match arguments.task {
        None => open::open(arguments.project.as_deref(), arguments.record.as_deref()),
        Some(Task::Dress(dress)) => run::on_threads(dress.threads, || dress::dress(&dress)),
        Some(Task::Replay(replay)) => run::on_threads(replay.threads, || replay::replay(&replay)),
        Some(Task::Repose(repose)) => run::on_threads(repose.threads, || {
            if repose.sequence || repose.motion.is_some() {
                sequence::sequence(&repose)
            } else {
                repose::repose(&repose)
            }
        }),
        Some(Task::Sizes(sizes)) => run::on_threads(sizes.threads, || sizes::sizes(&sizes)),
        Some(Task::Marker(marker)) => run::on_threads(marker.threads, || marker::marker(&marker)),
        Some(Task::TechPack(pack)) => run::on_threads(pack.threads, || techpack::techpack(&pack)),
        Some(Task::Fit(fit)) => run::on_threads(fit.threads, || fit::fit(&fit)),
        Some(Task::Compare(compare)) => run::on_threads(compare.threads, || compare::compare(&compare)),
        Some(Task::Render(render)) => render::render(&render),
        Some(Task::Import(import)) => import::import(&import),
        Some(Task::Export(export)) => export::export(&export),
        Some(Task::Check(check)) => check::check(&check),
        Some(Task::Measure(measure)) => measure::measure(&measure),
        Some(Task::Generate(generate)) => generate::generate(&generate),
        Some(Task::Simulate(simulate)) => run::on_threads(simulate.threads, || simulate::simulate(&simulate)),
        Some(Task::Report(Report { task: ReportTask::Merge(merge) })) => merge::merge(&merge),
        Some(Task::Help(topic)) => help::help(&topic),
        Some(Task::Completions(completions)) => completions::completions(&completions),
        Some(Task::Man(man)) => man::man(&man),
        Some(Task::Bench(bench)) => run::on_threads(bench.threads, || bench::bench(&bench)),
    }
}

/// Sends errors of libraries to standard error (but not those of graphics drivers that are tried in vain); RUST_LOG shows more.
fn listen_to_traces() {
    let quiet = EnvFilter::new("error,wgpu_hal=off");
    let filter = EnvFilter::try_from_default_env().unwrap_or(quiet);
    let begun = tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(std::io::stderr)
        .log_internal_errors(false)
        .try_init();
    debug_assert!(begun.is_ok(), "nothing else listens");
}

/// Prints help, version or usage errors. Help and version go to standard output and are no failure.
fn show_usage(error: &clap::Error) -> u8 {
    let first = std::env::args_os().nth(1);
    match first.filter(|_| error.kind() == ErrorKind::ArgumentConflict).and_then(|first| misspelt(&first)) {
        Some(words) => output::complain(&words),
        // If the output is closed there is nothing left to do.
        None => error.print().unwrap_or_default(),
    }
    u8::try_from(error.exit_code()).unwrap_or(2)
}

/// Whether `path` could as well be a command: it has neither folder nor ending, and is no `sample:NAME`.
fn is_word(path: &Path) -> bool {
    path.to_str().is_some_and(|text| !text.contains(['/', '\\', '.', ':']))
}

/// What to say of a first word that clap took for a project, where it is neither a command nor a file.
fn misspelt(first: &OsStr) -> Option<String> {
    let word = first.to_str().filter(|word| !word.starts_with('-') && !Path::new(word).exists())?;
    let arguments = Arguments::command();
    let commands: Vec<&str> = arguments.get_subcommands().map(clap::Command::get_name).collect();
    if commands.contains(&word) {
        return None;
    }
    let meant = Sample::named(word)
        .map(|sample| format!("sample:{}", sample.file_stem()))
        .or_else(|| nearest(word, &commands));
    let asked = meant.map(|name| format!("; did you mean {name}?")).unwrap_or_default();
    Some(format!("error: {word} is neither a command nor a file{asked}\n\ncommands: {}", commands.join(", ")))
}

/// The one of `names` that is spelt most like `word`; None where none is much like it.
fn nearest(word: &str, names: &[&str]) -> Option<String> {
    let likeness = |name: &&&str| strsim::jaro_winkler(word, name);
    let nearest = names.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    (likeness(&nearest) > 0.8).then(|| (*nearest).to_owned())
}

fn panic_words(panic: &std::panic::PanicHookInfo) -> String {
    let place = panic.location().map(|l| format!(" at {}:{}", l.file(), l.line())).unwrap_or_default();
    let words = panic.payload_as_str().unwrap_or("no words");
    format!("toile: internal error{place}: {words}\nThis is a fault of the program, not of your file.")
}
