//! Garments by the thousand: lists with options, shards, their lines, tables, and the recipes.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::program::{Ended, Place, ended};

/// A list of five: three balls with options of their own, one that is broken, one whose line is.
fn five() -> Place {
    let place = Place::with_ball();
    place.write("broken.toile", "{}");
    let lines = [
        r#"{"project": "ball.toile", "name": "plain"}"#,
        r#"{"project": "ball.toile", "name": "coarse", "edge_length": 0.08, "save": "dressed.toile"}"#,
        r#"broken.toile"#,
        r#"{"project": "ball.toile", "name": "../up"}"#,
        "# a note",
        r#"{"project": "ball.toile", "name": "plain", "max_ticks": 5000}"#,
    ];
    place.write("list.jsonl", lines.join("\n"));
    place
}

fn lines(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).expect("a JSON object a line")).collect()
}

/// The rows of a table by the names of its columns.
fn rows(place: &Place, name: &str) -> Vec<Vec<(String, String)>> {
    let mut table = csv::Reader::from_path(place.path(name)).expect("a table");
    let heading = table.headers().expect("a heading").clone();
    let row = |row: csv::StringRecord| {
        heading.iter().zip(row.iter()).map(|(name, cell)| (name.to_owned(), cell.to_owned())).collect()
    };
    table.records().map(|record| row(record.expect("a row"))).collect()
}

fn cell<'a>(row: &'a [(String, String)], name: &str) -> &'a str {
    row.iter().find(|(column, _)| column == name).map_or("", |(_, cell)| cell)
}

#[test]
fn each_line_has_its_options_and_a_broken_one_stops_no_other() {
    let place = five();
    let done = place.ends(3, "dress --list list.jsonl --out out --json --no-picture");
    let printed = lines(&done.out);
    let of = |key: &str| printed.iter().map(|line| line[key].clone()).collect::<Vec<Value>>();
    assert_eq!(of("garment"), ["plain", "coarse", "broken", "line-4", "plain-2"].map(Value::from));
    assert_eq!(of("exit_code"), [0, 0, 3, 3, 0].map(Value::from));
    assert_eq!(place.names("out"), ["coarse", "lines.jsonl", "plain", "plain-2"]);
    assert_eq!(place.names("out/plain"), ["body.obj", "garment.obj", "report.json"]);
    place.write("out/plain/view.png", "of an earlier time");
    place.ends(3, "dress --list list.jsonl --out out --no-picture");
    assert!(!place.names("out/plain").contains(&"view.png".to_owned()), "no picture of another garment");
    place.write("out/lines.jsonl", &done.out);
    assert!(place.names("out/coarse").contains(&"dressed.toile".to_owned()));
    assert_eq!(place.read("out/lines.jsonl"), done.out, "the same lines are kept");
    let triangles = of("triangles");
    assert!(triangles[1].as_u64() < triangles[0].as_u64() && triangles[0] == triangles[4], "{triangles:?}");
    assert_eq!(printed[1]["options"], serde_json::json!({"edge_length": 0.08, "save": "dressed.toile"}));
    assert!(printed[3]["error"].as_str().is_some_and(|words| words.contains("list.jsonl: line 4: ")));
    assert!(printed.iter().all(|line| line["seconds"].is_number() && line["finished"].is_number()));
    place.ends(0, "check out/coarse/dressed.toile");
}

#[test]
fn shards_share_the_work_and_are_resumed_whatever_their_number() {
    let place = five();
    let mut seen = BTreeSet::new();
    for (part, code) in [(1, 3), (2, 3)] {
        let done = place
            .ends(code, &format!("dress --list list.jsonl --shard {part}/2 --out out --json --no-picture"));
        for line in lines(&done.out) {
            assert!(seen.insert(line["garment"].as_str().expect("a name").to_owned()), "{line}");
        }
    }
    assert_eq!(seen.len(), 5, "{seen:?}");
    let names = ["coarse", "lines-1-of-2.jsonl", "lines-2-of-2.jsonl", "plain", "plain-2"];
    assert_eq!(place.names("out"), names);
    // A half-written one and one whose saved project is gone are done again, the others not.
    std::fs::remove_file(place.path("out/plain/report.json")).expect("removed");
    std::fs::remove_file(place.path("out/coarse/dressed.toile")).expect("removed");
    let again = place.ends(3, "dress --list list.jsonl --out out --json --no-picture --resume");
    let resumed: Vec<bool> = lines(&again.out).iter().map(|line| line["resumed"] == true).collect();
    assert_eq!(resumed, [false, false, false, false, true]);
    // A part without any line is nothing to do.
    assert!(place.ends(0, "dress --list list.jsonl --shard 7/7 --out none").out.is_empty());
    place.ends_with_words(2, "dress --list list.jsonl --shard 3/2 --out out", "PART/OF");
    place.ends_with_words(2, "dress ball.toile --shard 1/2 --out out", "--list");
}

/// What a run leaves, without times: the reports, the bytes of the meshes, and what each garment's newest line says.
#[cfg(unix)]
fn left(place: &Place) -> Vec<(String, String)> {
    let timeless = |mut value: Value| {
        for name in ["seconds", "processor_seconds", "finished", "resumed"] {
            value.as_object_mut().expect("an object").remove(name);
        }
        value.to_string()
    };
    let mut all: Vec<(String, String)> = Vec::new();
    for garment in place.names("out").iter().filter(|name| !name.contains('.')) {
        for name in place.names(&format!("out/{garment}")) {
            let path = format!("out/{garment}/{name}");
            let text = if name == "report.json" { timeless(place.json(&path)) } else { place.read(&path) };
            all.push((path, text));
        }
    }
    let newest: std::collections::BTreeMap<String, Value> = lines(&place.read("out/lines.jsonl"))
        .into_iter()
        .map(|line| (line["garment"].as_str().expect("a name").to_owned(), line))
        .collect();
    all.extend(newest.into_iter().map(|(name, line)| (name, timeless(line))));
    all
}

#[cfg(unix)]
#[test]
fn killed_again_and_again_a_list_is_resumed_to_the_same_end() {
    let balls = || {
        let place = Place::with_ball();
        let line = |n: u32| {
            format!("{{\"project\": \"ball.toile\", \"name\": \"{n}\", \"max_ticks\": {}}}", 5000 + n)
        };
        place.write("list.jsonl", (0..6).map(line).collect::<Vec<_>>().join("\n"));
        place
    };
    let arguments = "dress --list list.jsonl --out out --no-picture --threads 1 --resume";
    let whole = balls();
    let begun = std::time::Instant::now();
    whole.ends(0, arguments);
    let one_garment = begun.elapsed() / 6;
    let killed = balls();
    for i in 0..9 {
        let mut child =
            killed.command(arguments).stdout(std::process::Stdio::null()).spawn().expect("started");
        std::thread::sleep(one_garment * (3 + 2 * i) / 8);
        child.kill().expect("killed: SIGKILL cannot be answered");
        child.wait().expect("gone");
    }
    killed.ends(0, arguments);
    let (found, expected) = (left(&killed), left(&whole));
    let names = |all: &[(String, String)]| all.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&found), names(&expected));
    for ((name, one), (_, other)) in found.iter().zip(&expected) {
        assert!(one == other, "{name} differs");
    }
    assert!(killed.ends(0, arguments).out.lines().all(|line| line.ends_with(" (done before)")));
}

#[test]
fn lines_become_one_table_and_a_summary() {
    let place = five();
    for part in [1, 2] {
        place.ends(3, &format!("dress --list list.jsonl --shard {part}/2 --out out --no-picture"));
    }
    let told = place.ends(0, "report merge out --out table.csv").out;
    assert!(told.starts_with("5 garments: 3 dressed (60.0 %), 0 with faults, 2 failed; "), "{told}");
    let table = rows(&place, "table.csv");
    let garments: Vec<&str> = table.iter().map(|row| cell(row, "garment")).collect();
    assert_eq!(garments, ["broken", "coarse", "line-4", "plain", "plain-2"]);
    assert_eq!(cell(&table[1], "options.edge_length"), "0.08");
    assert_eq!((cell(&table[1], "outcome"), cell(&table[0], "outcome")), ("dressed", "failed"));
    assert_eq!(cell(&table[3], "folder"), Path::new("out").join("plain").display().to_string());
    let report = place.json("out/plain/report.json");
    assert_eq!(cell(&table[3], "strain.p99"), report["strain"]["p99"].to_string());
    assert_eq!(cell(&table[3], "processor_seconds"), report["seconds"]["processor"].to_string());
    // Done again in another number of shards, from another folder: the newest line counts.
    std::fs::copy(place.path("ball.toile"), place.path("broken.toile")).expect("copied");
    place.ends(3, "dress --list list.jsonl --out out --no-picture --resume");
    std::fs::write(place.path("out/plain/view.png"), b"a picture").expect("written");
    let told = place.ends(0, "report merge ./out --out table.csv --picture --json").out;
    let summary: Value = serde_json::from_str(&told).expect("JSON");
    assert_eq!(
        (&summary["dressed"], &summary["failed"], &summary["share"]),
        (&4.into(), &1.into(), &0.8.into())
    );
    assert!(summary["garments_per_core_hour"].as_f64().is_some_and(|rate| rate > 1.0) || cfg!(not(unix)));
    let table = rows(&place, "table.csv");
    assert!(cell(&table[3], "picture").ends_with("view.png") && cell(&table[1], "picture").is_empty());
    place.ends_with_words(3, "report merge . --out table.csv", "lines*.jsonl");
    place.ends_with_words(6, "report merge none --out table.csv", "none");
}

#[test]
fn generated_garments_come_with_their_list() {
    let place = Place::new();
    place.ends(0, "generate --count 2 --kinds straight-skirt --body-sizes m --out corpus");
    let list = lines(&place.read("corpus/list.jsonl"));
    assert_eq!(list.len(), 4);
    assert!(list.iter().any(|line| line["pose"] == "t") && list.iter().any(|line| line["pose"].is_null()));
    let done = place
        .run("dress --list corpus/list.jsonl --shard 2/4 --out out --json --edge-length 0.05 --no-picture");
    let told = lines(&done.out);
    assert!(done.code <= 1 && told.len() == 1, "{done:#?}");
    assert_eq!(told[0]["options"]["body_size"], "m");
    assert!(told[0]["triangles"].as_u64().is_some_and(|count| count > 100), "{}", told[0]);
}

/// Runs a program of the recipes; None, with words, where it is not on this machine.
fn recipe(place: &Place, program: &str, arguments: &[&str]) -> Option<Ended> {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(place.path(""));
    command.env("TOILE", env!("CARGO_BIN_EXE_toile")).env("WGPU_BACKEND", "dx12").env("PARTS", "2");
    match command.output() {
        Ok(output) => Some(ended(output)),
        Err(_) => {
            println!("{program} is not here: its recipe is not tested");
            None
        }
    }
}

fn recipe_path(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/recipes").join(name).display().to_string()
}

#[test]
fn the_recipe_for_all_cores_dresses_a_list_and_makes_its_table() {
    let place = five();
    let script = recipe_path("xargs.sh");
    let Some(done) = recipe(&place, "sh", &[&script, "list.jsonl", "out", "--no-picture"]) else { return };
    assert_eq!(done.code, 0, "{done:#?}");
    assert!(done.out.contains("5 garments: 3 dressed"), "{done:#?}");
    assert_eq!(rows(&place, "out/table.csv").len(), 5);
}

#[test]
fn the_recipe_for_make_dresses_what_is_new() {
    let place = Place::with_ball();
    std::fs::create_dir(place.path("patterns")).expect("made");
    for name in ["a", "b", "c"] {
        std::fs::copy(place.path("ball.toile"), place.path(&format!("patterns/{name}.json")))
            .expect("copied");
    }
    place.write("patterns/c.json", "{}");
    let arguments = ["-f", &recipe_path("dress.mk"), "-k", "OPTIONS=--no-picture"];
    let Some(first) = recipe(&place, "make", &arguments) else { return };
    assert_eq!(first.code, 2, "c cannot be dressed: {first:#?}");
    assert_eq!(place.names("out"), ["a", "b"], "{first:#?}");
    std::fs::copy(place.path("ball.toile"), place.path("patterns/c.json")).expect("copied");
    let second = recipe(&place, "make", &arguments).expect("it was here");
    assert!(
        second.code == 0 && second.out.contains("c.json") && !second.out.contains("a.json"),
        "{second:#?}"
    );
}
