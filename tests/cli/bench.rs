//! bench.

use serde_json::Value;

use crate::program::Place;

fn rows(out: &str) -> Vec<Value> {
    out.lines().map(|line| serde_json::from_str(line).expect("a JSON object a line")).collect()
}

#[test]
fn speed_has_a_row_for_every_scene() {
    let place = Place::new();
    let rows = rows(&place.ends(0, "bench speed --runs 2 --triangles 300 --threads 2 --json").out);
    assert_eq!(rows.len(), 10, "{rows:#?}");
    for row in &rows {
        assert!(row["scene"].as_str().is_some_and(|s| !s.is_empty()));
        assert!(row["triangles"].as_u64().is_some_and(|t| t > 150), "{row}");
        assert!(row["seconds"].as_f64().is_some_and(|s| s >= 0.0));
        assert!(row["threads"].as_u64().is_some_and(|t| t == 1 || t == 2));
        assert!(row["hash"].as_str().is_some_and(|h| h.len() == 16));
        for check in row["checks"].as_array().expect("checks") {
            assert!(["value", "solid", "goal"].iter().all(|n| check[n].is_number()), "{check}");
            assert!(["goal", "solid", "neither"].iter().any(|m| check["met"] == *m), "{check}");
        }
    }
    // What does not hang on the machine: cloth at rest takes no step, dragged cloth stays out of the body.
    assert_eq!(rows[5]["checks"][0]["value"], 0.0);
    assert!(rows[6]["scene"].as_str().is_some_and(|s| s.contains("drape")));
    assert_eq!(rows[3]["checks"][1]["value"], 0.0, "{}", rows[3]);
    assert!(rows[0]["counters"]["solves"].as_u64().is_some_and(|s| s > 0));
    assert!(place.names("").is_empty());
}

#[test]
fn accuracy_is_printed_drawn_and_held_against_an_earlier_run() {
    let place = Place::new();
    let done = place.ends(0, "bench accuracy --runs 1 --plot error.svg --json");
    let mut rows = rows(&done.out);
    assert_eq!(rows.len(), 10, "{rows:#?}");
    for row in &rows {
        assert!(row["excess_p99"].as_f64().is_some_and(|e| (0.0..0.01).contains(&e)), "{row}");
        assert!(row["seconds"].as_f64().is_some_and(|s| s > 0.0));
    }
    let svg = place.read("error.svg");
    assert!(svg.starts_with("<svg") && svg.contains("</svg>") && !svg.contains("NaN"));
    assert_eq!(svg.matches("<circle").count(), 10);
    // An earlier run that was much slower, and more accurate once.
    rows.iter_mut().for_each(|row| row["seconds"] = 1e3.into());
    rows[0]["excess_p99"] = (rows[0]["excess_p99"].as_f64().expect("a number") / 2.0).into();
    let earlier: String = rows.iter().map(|row| format!("{row}\n")).collect();
    place.write("earlier.json", earlier.as_bytes());
    let done = place.ends(1, "bench accuracy --runs 1 --against earlier.json");
    assert!(done.err.contains("figures held against earlier.json"), "{}", done.err);
    let losses = done.err.lines().filter(|line| line.ends_with("LOSS"));
    assert_eq!(losses.count(), 1, "{}", done.err);
    place.write("torn.json", b"{\"scene\":\"a\"}\nnothing\n");
    place.ends_with_words(3, "bench accuracy --against torn.json", "line 2");
    place.ends_with_words(6, "bench accuracy --against none.json", "none.json");
    place.ends_with_words(2, "bench corpus --against torn.json", "--against");
}

#[test]
fn physics_has_a_row_for_every_scene_and_size() {
    let place = Place::new();
    let done = place.ends(0, "bench drape --runs 1 --triangles 200 --plot cost.svg --json");
    let rows = rows(&done.out);
    assert_eq!(rows.len(), 9, "{rows:#?}");
    for row in &rows {
        assert!(row["checks"][0]["value"].as_f64().is_some_and(|s| s > 0.0 && s < 60.0), "{row}");
        let strain = row["checks"].as_array().and_then(|c| c.iter().find(|c| c["what"] == "p99 strain"));
        assert!(strain.is_none_or(|s| s["value"].as_f64().is_some_and(|s| s < 0.02)), "{row}");
    }
    // What does not hang on the machine: it falls as it should, and stays out of the ball and of itself.
    for row in &rows[3..6] {
        assert!(row["checks"][2]["value"].as_f64().is_some_and(|off| off < 1e-6), "{row}");
        assert_eq!(row["checks"][3]["met"], "goal", "{row}");
        assert_eq!(row["checks"][4]["value"], 0.0, "{row}");
    }
    let svg = place.read("cost.svg");
    assert!(svg.starts_with("<svg") && svg.contains("</svg>") && !svg.contains("NaN"));
    assert_eq!(svg.matches("<circle").count(), 9);
}

#[test]
fn the_corpus_is_dressed_and_judged() {
    let place = Place::new();
    let kinds = "--kinds straight-skirt,one-shoulder --count 2 --body-sizes s --poses a";
    let done = place.ends(0, &format!("bench corpus {kinds} --json --out kept"));
    let [summary] = &rows(&done.out)[..] else { panic!("one object: {}", done.out) };
    assert_eq!(summary["all"]["garments"], 2, "{summary}");
    assert_eq!(summary["all"]["clean"], 2, "{summary}");
    assert_eq!(summary["kinds"].as_array().map(Vec::len), Some(2), "{summary}");
    assert_eq!(place.names("kept"), ["sizes.csv"], "what is clean is not kept");
    // The half of them.
    let done = place.ends(0, &format!("bench corpus {kinds} --shard 1/2"));
    assert!(done.out.contains("straight-skirt") && !done.out.contains("one-shoulder"), "{}", done.out);
}

#[test]
fn ticks_has_a_row_for_every_garment_and_a_check_for_every_stage() {
    let place = Place::new();
    let rows = rows(&place.ends(0, "bench ticks --runs 1 --triangles 200 --json").out);
    assert_eq!(rows.len(), 4, "{rows:#?}");
    let stages: Vec<&str> = rows
        .iter()
        .flat_map(|row| row["checks"].as_array().expect("checks"))
        .map(|check| check["what"].as_str().expect("a stage"))
        .collect();
    for stage in ["building it", "growing", "settling", "re-posing it", "dragging", "draping", "sewing"] {
        assert!(stages.contains(&stage), "{stage}: {stages:?}");
    }
    place.ends_with_words(2, "bench ticks --plot a.svg", "--plot");
}

#[test]
fn wrong_arguments_are_told() {
    let place = Place::new();
    place.ends_with_words(2, "bench length", "speed");
    place.ends_with_words(2, "bench speed --plot a.svg", "--plot");
    place.ends_with_words(2, "bench --runs 0", "0");
    place.ends_with_words(2, "bench --triangles 7", "7");
    place.ends_with_words(2, "bench speed --count 3", "bench corpus");
    place.ends_with_words(2, "bench corpus --shard 3/2", "3/2");
    place.ends_with_words(2, "bench corpus --body-sizes huge", "huge");
    place.ends_with_words(2, "bench corpus --poses sitting", "sitting");
    place.ends_with_words(2, "bench corpus --plot a.svg", "--plot");
    place.ends_with_words(2, "generate", "--out");
}
