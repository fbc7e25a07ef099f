//! `toile bench`: how fast and how accurate the program is on this machine.

mod accuracy;
mod against;
mod corpus;
mod drape;
mod plot;
mod poses;
mod row;
mod scenes;
mod sheets;
mod speed;
mod ticks;
mod torso;
mod trust;
mod tube;

use serde::Serialize;

use crate::cli::arguments::{Bench, BenchKind, CorpusOptions, TrustOptions};
use crate::cli::bench::against::Against;
use crate::cli::bench::row::Row;
use crate::cli::failure::Failure;
use crate::cli::output;

/// Runs the chosen benchmarks and prints a row for each scene as it is done.
pub fn bench(arguments: &Bench) -> Result<(), Failure> {
    let without_plot =
        [BenchKind::Speed, BenchKind::Corpus, BenchKind::Ticks, BenchKind::Card, BenchKind::Trust];
    let has_plot = arguments.what.is_none_or(|what| !without_plot.contains(&what));
    if arguments.plot.is_some() && !has_plot {
        return Err(Failure::Usage("--plot draws what accuracy and drape measure".to_owned()));
    }
    let without_rows = [BenchKind::Corpus, BenchKind::Trust];
    if arguments.against.is_some() && arguments.what.is_some_and(|what| without_rows.contains(&what)) {
        return Err(Failure::Usage(
            "--against compares what speed, accuracy, drape and ticks measure".to_owned(),
        ));
    }
    if arguments.what != Some(BenchKind::Trust) && arguments.trust != TrustOptions::default() {
        return Err(Failure::Usage("--mutations, --first and --readers go with bench trust".to_owned()));
    }
    if arguments.what == Some(BenchKind::Corpus) {
        return corpus::corpus(arguments);
    }
    let keeps = arguments.what != Some(BenchKind::Trust) && arguments.out.is_some();
    let of_corpus = keeps || arguments.max_ticks.is_some();
    if of_corpus || arguments.corpus != CorpusOptions::default() {
        let words = "--count, --seed, --shard, --body-sizes, --poses, --kinds, --max-ticks and --out go with bench \
                     corpus, --out with bench trust, too";
        return Err(Failure::Usage(words.to_owned()));
    }
    if arguments.what == Some(BenchKind::Trust) {
        return trust::trust(arguments);
    }
    let mut teller = Teller::new(arguments)?;
    measure(arguments, &mut teller)?;
    teller.finish()
}

/// Runs the scenes asked for, of garments.
fn measure(arguments: &Bench, teller: &mut Teller) -> Result<(), Failure> {
    let asked = |kind| arguments.what.is_none_or(|what| what == kind);
    let runs = usize::from(arguments.runs);
    match arguments.what {
        Some(BenchKind::Drape) => return drape_scenes(arguments, runs, teller),
        Some(BenchKind::Card) => {
            return drape::on_card(size_of(arguments), runs, arguments.work.no_skip, |row| teller.say(&row));
        }
        Some(BenchKind::Ticks) => {
            let triangles = arguments.triangles.map_or(TICKS_TRIANGLES, |n| n as usize);
            return ticks::ticks(triangles, runs, arguments.work.no_skip, |row| teller.say(row));
        }
        _ => {}
    }
    if asked(BenchKind::Speed) {
        speed::speed(size_of(arguments), runs, arguments.work.no_skip, |row| teller.say(row))?;
    }
    if asked(BenchKind::Accuracy) {
        let curves = accuracy::accuracy(runs, |row| teller.say(row))?;
        if let Some(path) = &arguments.plot {
            output::write(path, accuracy::plotted(&curves).as_bytes())?;
        }
    }
    Ok(())
}

/// Prints rows, and holds them against an earlier run.
struct Teller {
    json: bool,
    against: Option<Against>,
}

impl Teller {
    fn new(arguments: &Bench) -> Result<Self, Failure> {
        let against = arguments.against.as_deref().map(Against::read).transpose()?;
        Ok(Self { json: arguments.json, against })
    }

    fn say<R: Serialize + std::fmt::Display>(&mut self, row: &R) -> Result<(), Failure> {
        say(row, self.json)?;
        let Some(against) = &mut self.against else { return Ok(()) };
        against.hold(row)?.iter().for_each(|line| output::complain(&format!("      {line}")));
        Ok(())
    }

    fn finish(self) -> Result<(), Failure> {
        self.against.map_or(Ok(()), Against::finish)
    }
}

fn size_of(arguments: &Bench) -> usize {
    arguments.triangles.map_or(TRIANGLES, |n| n as usize)
}

/// Default number of triangles of a garment.
const TRIANGLES: usize = 10_000;
/// Default number of triangles of a garment for the benchmark of ticks.
const TICKS_TRIANGLES: usize = 20_000;
/// Smallest number of triangles of cloth.
const COARSEST: usize = 200;

/// Physics scenes at three sizes: a tenth, once and four times as many triangles as chosen.
fn drape_scenes(arguments: &Bench, runs: usize, teller: &mut Teller) -> Result<(), Failure> {
    let size = size_of(arguments);
    let sizes = [(size / 10).max(COARSEST), size, size * 4];
    let mut rows: Vec<Row> = Vec::new();
    let mut tell = |row: Row| {
        teller.say(&row)?;
        rows.push(row);
        Ok(())
    };
    sheets::sheets(sizes, runs, &mut tell)?;
    torso::torso(sizes, runs, &mut tell)?;
    match &arguments.plot {
        Some(path) => output::write(path, costs(&rows).as_bytes()),
        None => Ok(()),
    }
}

/// Plots the cost of each scene (the first check of its rows) against its number of triangles.
fn costs(rows: &[Row]) -> String {
    let point = |row: &Row| plot::Point {
        across: row.triangles as f64,
        up: row.checks.first().map_or(f64::NAN, |check| check.value),
        label: format!("{}", row.triangles),
    };
    let curve = |rows: &[Row]| plot::Curve { name: rows[1].scene, points: rows.iter().map(point).collect() };
    plot::svg(&plot::Plot {
        across: ("triangles", |power| format!("{}", 10f64.powi(power))),
        up: ("processor seconds: of a second of a sheet, of sewing a dress", plot::seconds),
        curves: rows.chunks_exact(3).map(curve).collect(),
    })
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

/// The median; of an even number of values the upper of the middle two.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The hash that all runs share; an error if they differ, since the program must be deterministic.
fn one_hash(scene: &str, hashes: &[u64]) -> Result<String, Failure> {
    match hashes {
        [first, rest @ ..] if rest.iter().all(|h| h == first) => Ok(format!("{first:016x}")),
        _ => Err(Failure::Check(format!("{scene}: runs ended in different states"))),
    }
}
