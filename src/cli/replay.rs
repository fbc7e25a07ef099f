//! `toile replay`: runs a recording and compares its hashes.

use std::path::Path;

use serde::Serialize;

use crate::cli::arguments;
use crate::cli::failure::Failure;
use crate::cli::graphics::Graphics;
use crate::cli::report;
use crate::cli::seconds::{Begun, Seconds};
use crate::cli::{files, input, interrupt, output, run};
use crate::session::demos::Demo;
use crate::session::project_file;
use crate::session::recording::{Hex, Recording};
use crate::session::replay::{Divergence, Replay};

/// Prefix of the names of built-in demos.
const DEMO: &str = "demo:";

#[derive(Serialize)]
struct Outcome {
    commands: usize,
    ticks: u64,
    hashes_compared: u64,
    state_hash: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    diverged: Option<Diverged>,
}

#[derive(Serialize)]
struct Diverged {
    tick: u64,
    command: u64,
    words: String,
}

/// Runs the recording to its end or to the first difference.
pub fn replay(arguments: &arguments::Replay) -> Result<(), Failure> {
    let start = Begun::now();
    let path = &arguments.recording;
    let text = text_of(path)?;
    let recording = Recording::parse(&text).map_err(|e| Failure::input(path, e))?;
    if let Some(words) = recording.project.problem() {
        return Err(Failure::input(path, words));
    }
    let commands = recording.commands.len();
    let mut replay = Replay::new(recording);
    run::simulation(replay.session())?.set_skips(arguments.work.no_skip);
    let diverged = run_through(&mut replay)?;
    let outcome = Outcome {
        commands,
        ticks: replay.ticks(),
        hashes_compared: replay.hashes_compared(),
        state_hash: Hex(report::state_hash(replay.session())?).to_string(),
        diverged: diverged.as_ref().map(|d| Diverged {
            tick: d.tick,
            command: d.seq,
            words: d.words.to_string(),
        }),
    };
    tell(&outcome, arguments.json)?;
    if let Some(divergence) = diverged {
        return Err(Failure::Check(divergence.to_string()));
    }
    if outcome.hashes_compared == 0 {
        return Err(Failure::Check("the recording holds no hash: nothing was compared".to_owned()));
    }
    if let Some(path) = &arguments.save {
        let project = replay.session().project();
        project_file::save(path, &project).map_err(|e| input::project_failure(path, e))?;
    }
    if let Some(folder) = &arguments.out {
        let seconds = Seconds { replay: Some(start.seconds()), ..Seconds::default() };
        let name = files::name_of(path);
        let mut graphics = Graphics::default();
        let picture = Some((&arguments.picture, &mut graphics));
        let mut report = report::report(replay.session(), &name, picture, seconds)?;
        report.inputs = vec![path.display().to_string()];
        report.finish(folder, start)?;
    }
    Ok(())
}

/// The text of a recording file, or of a built-in demo.
fn text_of(path: &Path) -> Result<String, Failure> {
    let Some(name) = path.to_str().and_then(|path| path.strip_prefix(DEMO)) else {
        return String::from_utf8(files::read(path)?)
            .map_err(|_| Failure::input(path, "not a recording: not UTF-8 text"));
    };
    let Some(demo) = Demo::ALL.into_iter().find(|demo| demo.file_stem() == name) else {
        let names = Demo::ALL.map(Demo::file_stem).join(", ");
        return Err(Failure::input(path, format!("there is no demo of this name; there are {names}")));
    };
    Ok(demo.recording().to_owned())
}

fn run_through(replay: &mut Replay) -> Result<Option<Divergence>, Failure> {
    loop {
        interrupt::check()?;
        match replay.step() {
            Ok(true) => {}
            Ok(false) => return Ok(None),
            Err(divergence) => return Ok(Some(divergence)),
        }
    }
}

fn tell(outcome: &Outcome, json: bool) -> Result<(), Failure> {
    if json {
        let text = serde_json::to_string_pretty(outcome).map_err(|e| Failure::Internal(e.to_string()))?;
        output::say(&text);
    } else if outcome.diverged.is_none() {
        let Outcome { commands, ticks, hashes_compared, state_hash, .. } = outcome;
        output::say(&format!(
            "{commands} commands, {ticks} ticks, {hashes_compared} hashes the same, state {state_hash}"
        ));
    }
    Ok(())
}
