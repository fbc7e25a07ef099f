//! Signals at any moment of every subcommand, against what a whole run leaves.

#![cfg(unix)]

use std::collections::BTreeMap;
use std::fmt::Write;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use glam::DVec3;

use crate::common::chance::Chance;
use crate::program::{Ended, Place, ended};

/// Seed of the moments at which signals come.
const SEED: u64 = 28;
/// A run is cut into so many stretches; in each of them, in a run of its own, a signal comes.
const STRETCHES: u64 = 4;
/// So long a program that is told to end may go on, seconds: 0.5 is promised on a machine that has nothing else to do.
const MOST: f64 = 3.0;
/// What goes on for longer does not stop.
const HANGS: Duration = Duration::from_secs(60);
/// So long a program may take to start, seconds: a signal before ends it as the system does.
const STARTING: f64 = 0.3;

/// What is stopped, as it is typed, "IN" for the folder of inputs, and whether its files take their places one by one, not a
/// folder at a time.
const DRESSING: &[(&str, bool)] = &[
    ("dress sample:skirt --edge-length 0.03 --drape --out out", false),
    ("dress sample:tshirt --edge-length 0.016 --suggest-marks --out new/out --save shirt.toile", true),
    ("dress --list IN/list.txt --out out --edge-length 0.02", false),
    ("replay IN/dress.jsonl --out out", false),
];

const REPOSING: &[(&str, bool)] = &[
    ("repose IN/dressed.toile --pose walking --pose sitting --size 400x250 --out out", false),
    ("repose IN/dressed.toile --sequence --body IN/frames --textures 0 --unit m --out out", true),
    ("simulate IN/scene.json --out out", false),
];

const READING: &[(&str, bool)] = &[
    ("fit IN/dressed.toile --map all --size 400x250 --out out", false),
    ("fit IN/dressed.toile --page fit.html", false),
    ("compare IN/dressed.toile IN/dressed.toile --map all --size 400x250 --out out", false),
    ("render IN/dressed.toile -o picture.png --size 1200x1200", false),
    ("render IN/dressed.toile -o turn.png --turntable 4", true),
];

const FILES: &[(&str, bool)] = &[
    ("check sample:tshirt --edge-length 0.004", false),
    ("measure IN/o/body.obj", false),
    ("import IN/o/body.obj IN/shirt.json -o project.toile", false),
    ("export IN/dressed.toile -o cloth.glb", false),
    ("export IN/dressed.toile -o cloth.usdz", false),
    ("techpack IN/dressed.toile -o pack.pdf --seconds 1", false),
    ("marker sample:trousers --width 1.5 --quantity 4 --seconds 1 -o marker.svg", false),
    ("generate --count 12 --seed 3 --out out", true),
    ("report merge IN/lists --out table.csv", false),
    ("completions zsh", false),
    ("man --out pages", true),
    ("bench accuracy --runs 1", false),
    ("bench drape --runs 1 --triangles 200", false),
];

/// Files of a size take their places together, a size after the other.
const GRADED: &[(&str, bool)] =
    &[("sizes IN/graded.toile --sizes IN/bodies.csv --edge-length 0.03 --out out", true)];

/// Inputs of the runs: a skirt that lies on its body and one that is not dressed, a body, a motion, a falling cloth.
fn inputs() -> &'static Place {
    static INPUTS: OnceLock<Place> = OnceLock::new();
    INPUTS.get_or_init(|| {
        let place = Place::new();
        place.ends(
            0,
            "dress sample:skirt --edge-length 0.012 --out o --save dressed.toile --record dress.jsonl",
        );
        let body = place.read("o/body.obj");
        let moved = |i: usize| crate::repose::moved(&body, move |p| p + DVec3::X * (0.02 * i as f64));
        std::fs::create_dir(place.path("frames")).expect("made");
        for i in 0..4 {
            place.write(&format!("frames/{i}.obj"), moved(i));
        }
        place.ends(0, "export sample:tshirt -o shirt.json");
        place.write("list.txt", "sample:scarf\nsample:skirt\n");
        std::fs::create_dir(place.path("lists")).expect("made");
        let line =
            r#"{"garment": "a", "folder": "a", "outcome": "dressed", "exit_code": 0, "finished": 1.0}"#;
        place.write("lists/lines.jsonl", format!("{line}\n"));
        crate::sizes::write_inputs(&place, "graded.toile", "bodies.csv");
        place.write("cloth.obj", sheet(60));
        place.write(
            "scene.json",
            r#"{"cloth": "cloth.obj", "seconds": 0.6, "self_collision": true, "collider": "o/body.obj"}"#,
        );
        place
    })
}

/// A square 1 m wide of `n` × `n` cells, lying above everything.
fn sheet(n: usize) -> String {
    let mut text = String::new();
    for j in 0..=n {
        for i in 0..=n {
            let [x, z] = [i, j].map(|k| k as f64 / n as f64 - 0.5);
            writeln!(text, "v {x} 1.9 {z}").expect("a string");
        }
    }
    for j in 0..n {
        for i in 0..n {
            let at = |di: usize, dj: usize| (j + dj) * (n + 1) + i + di + 1;
            writeln!(text, "f {} {} {}", at(0, 0), at(1, 1), at(1, 0)).expect("a string");
            writeln!(text, "f {} {} {}", at(0, 0), at(0, 1), at(1, 1)).expect("a string");
        }
    }
    text
}

/// Processor time of a running process, seconds; None where the system does not tell.
fn worked(child: &Child) -> Option<f64> {
    let stat = std::fs::read_to_string(format!("/proc/{}/stat", child.id())).ok()?;
    // The 14th and 15th field, in hundredths; the second, a name in brackets, may have spaces.
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let hundredths = |i: usize| fields.get(i)?.parse::<f64>().ok();
    Some((hundredths(11)? + hundredths(12)?) / 100.0)
}

/// Names of all files and of empty folders under `folder`, with what is in them.
fn found(folder: &Path, name: &str, into: &mut BTreeMap<String, Vec<u8>>) {
    let entries = std::fs::read_dir(folder).expect("a folder").flatten();
    let entries: Vec<_> = entries.map(|e| (e.path(), e.file_name().to_string_lossy().into_owned())).collect();
    if entries.is_empty() && !name.is_empty() {
        into.insert(name.to_owned(), Vec::new());
    }
    for (path, own) in entries {
        match path.is_dir() {
            true => found(&path, &format!("{name}{own}/"), into),
            false => _ = into.insert(format!("{name}{own}"), std::fs::read(&path).expect("a file")),
        }
    }
}

/// A subcommand as it is typed, "IN" for the folder of inputs.
struct Case {
    words: &'static str,
    /// Files take their places one by one, not a folder at a time.
    streams: bool,
}

impl Case {
    /// Its run in an empty folder, with graphics where there are any.
    fn begun(&self, place: &Place) -> Child {
        let input = inputs().path("").display().to_string();
        let mut command = place.command(&self.words.replace("IN/", &input));
        command.env_remove("WGPU_BACKEND").stdout(Stdio::null()).stderr(Stdio::piped());
        command.spawn().expect("started")
    }

    /// Stops the run `after` so many seconds; gives how long it went on, in seconds of the clock or, on a busy machine, of the
    /// processor.
    fn stopped(
        &self,
        (signal, code): (&str, i32),
        after: f64,
        reference: (i32, &BTreeMap<String, Vec<u8>>),
    ) -> Option<f64> {
        let place = Place::new();
        let mut child = self.begun(&place);
        std::thread::sleep(Duration::from_secs_f64(after));
        let pid = child.id().to_string();
        Command::new("kill").args([format!("-{signal}"), pid]).stderr(Stdio::null()).status().expect("sent");
        let (since, worked) = (Instant::now(), worked(&child));
        let mut at = worked;
        while child.try_wait().expect("a child").is_none() && since.elapsed() < HANGS {
            at = self::worked(&child).or(at);
            std::thread::sleep(Duration::from_millis(5));
        }
        let waited = since.elapsed().as_secs_f64();
        let went_on = at.zip(worked).map_or(waited, |(end, start)| waited.min(end - start));
        child.kill().expect("it is there or was");
        let output = child.wait_with_output().expect("ended");
        let by_system = output.status.signal().is_some_and(|number| number + 128 == code);
        let Ended { code: got, err, .. } = ended(output);
        let place_of = format!("toile {} with SIG{signal} after {after:.3} s: {got}, {err}", self.words);
        let mut files = BTreeMap::new();
        found(&place.path(""), "", &mut files);
        let (usual, expected) = reference;
        if got == usual {
            assert!(files.keys().eq(expected.keys()), "{place_of} {:?}", files.keys());
            return None;
        }
        assert!(got == code || (by_system && after < STARTING), "{place_of}");
        assert!(by_system || err.matches("stopped by signal").count() == 1, "{place_of}");
        assert!(went_on < MOST, "{place_of}: it went on for {went_on:.2} s");
        for (name, bytes) in &files {
            let whole = expected.get(name).unwrap_or_else(|| panic!("{place_of}: {name} is left"));
            let is_json = |text: &[u8]| serde_json::from_slice::<serde_json::Value>(text).is_ok();
            let is_sound = match Path::new(name).extension().and_then(|ending| ending.to_str()) {
                Some("json") => is_json(bytes),
                // A line each for what is done.
                Some("jsonl") => {
                    bytes.split_inclusive(|b| *b == b'\n').all(|line| line.ends_with(b"\n") && is_json(line))
                }
                _ => bytes == whole,
            };
            assert!(is_sound, "{place_of}: {name} is not what it should be");
        }
        let folder = |name: &str| name.rsplit_once('/').map(|(folder, _)| folder.to_owned());
        let with = |files: &BTreeMap<String, Vec<u8>>, name: &str| {
            files.keys().filter(|other| folder(other) == folder(name)).count()
        };
        let halves =
            files.keys().filter(|name| folder(name).is_some() && with(&files, name) < with(expected, name));
        let halves: Vec<&String> = halves.collect();
        assert!(self.streams || halves.is_empty(), "{place_of}: half a folder, {halves:?}");
        Some(went_on)
    }
}

/// Runs each through, and then stops it in each stretch.
fn stop(cases: &[(&'static str, bool)]) {
    inputs();
    let (mut chance, mut all) = (Chance(SEED), Vec::new());
    for &(words, streams) in cases {
        let (case, place, start) = (Case { words, streams }, Place::new(), Instant::now());
        let Ended { code, err, .. } = ended(case.begun(&place).wait_with_output().expect("ended"));
        let whole = start.elapsed().as_secs_f64();
        if code == 5 {
            assert!(!crate::program::adapter_required(), "toile {words}: {err}");
            continue;
        }
        assert!([0, 1].contains(&code), "toile {words}: {code}, {err}");
        let mut files = BTreeMap::new();
        found(&place.path(""), "", &mut files);
        let mut went_on = Vec::new();
        for stretch in 0..STRETCHES {
            let after = whole * (stretch as f64 + chance.between(0.0, 1.0)) / STRETCHES as f64;
            let signal = if chance.below(2) == 0 { ("INT", 130) } else { ("TERM", 143) };
            went_on.extend(case.stopped(signal, after, (code, &files)));
        }
        println!("toile {words}: {whole:.2} s; stopped, it went on for {went_on:.3?} s");
        all.extend(went_on);
    }
    all.sort_by(f64::total_cmp);
    if let Some(most) = all.last() {
        println!("{} stopped: median {:.3} s, at most {most:.3} s", all.len(), all[all.len() / 2]);
    }
}

#[test]
fn dressing_stops_at_any_moment_and_leaves_nothing_half_done() {
    stop(DRESSING);
}

#[test]
fn reposing_stops_at_any_moment_and_leaves_nothing_half_done() {
    stop(REPOSING);
}

#[test]
fn reading_and_drawing_stop_at_any_moment_and_leave_nothing_half_done() {
    stop(READING);
}

#[test]
fn files_and_benches_stop_at_any_moment_and_leave_nothing_half_done() {
    stop(FILES);
}

#[test]
fn sizes_stop_at_any_moment_and_leave_nothing_half_done() {
    stop(GRADED);
}

/// One that is new is not forgotten here.
#[test]
fn every_subcommand_is_stopped() {
    let help = Place::new().ends(0, "--help").out;
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let names =
        commands.take_while(|line| !line.is_empty()).filter_map(|line| line.split_whitespace().next());
    let cases = [DRESSING, REPOSING, READING, FILES, GRADED].concat();
    let is_stopped = |name: &&str| cases.iter().any(|(words, _)| words.split(' ').next() == Some(name));
    let missing: Vec<&str> = names.filter(|name| *name != "help" && !is_stopped(name)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}
