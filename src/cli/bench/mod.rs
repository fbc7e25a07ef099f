//! `toile bench`: how fast and how accurate the program is on this machine.

mod accuracy;
mod drape;
mod plot;
mod poses;
mod row;
mod scenes;
mod speed;
mod tube;

use serde::Serialize;

use crate::cli::arguments::{Bench, BenchKind};
use crate::cli::failure::Failure;
use crate::cli::output;

/// Runs every scene asked for and prints a row for each as it is done.
pub fn bench(arguments: &Bench) -> Result<(), Failure> {
    let asked = |kind| arguments.what.is_none_or(|what| what == kind);
    if arguments.plot.is_some() && !asked(BenchKind::Accuracy) {
        return Err(Failure::Usage("--plot draws what accuracy measures".to_owned()));
    }
    let runs = usize::from(arguments.runs);
    if asked(BenchKind::Speed) {
        speed::speed(arguments.triangles as usize, runs, arguments.work.no_skip, |row| {
            say(row, arguments.json)
        })?;
    }
    if asked(BenchKind::Accuracy) {
        let curves = accuracy::accuracy(runs, |row| say(row, arguments.json))?;
        if let Some(path) = &arguments.plot {
            output::write(path, plot::svg(&curves).as_bytes())?;
        }
    }
    Ok(())
}

fn say<R: Serialize + std::fmt::Display>(row: &R, json: bool) -> Result<(), Failure> {
    let words = if json {
        serde_json::to_string(row).map_err(|e| Failure::Internal(e.to_string()))?
    } else {
        row.to_string()
    };
    output::say(&words);
    Ok(())
}

/// The middle one; the upper of two.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The same for every run, or the program is not deterministic.
fn one_hash(scene: &str, hashes: &[u64]) -> Result<String, Failure> {
    match hashes {
        [first, rest @ ..] if rest.iter().all(|h| h == first) => Ok(format!("{first:016x}")),
        _ => Err(Failure::Check(format!("{scene}: runs ended in different states"))),
    }
}
