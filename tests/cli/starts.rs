//! How dress puts a pattern without marks on.

use crate::common::{placed_project, project};
use crate::program::Place;

/// Texts of a JSON array.
fn texts(value: &serde_json::Value) -> Vec<String> {
    let all = value.as_array().expect("an array").iter();
    all.map(|text| text.as_str().expect("a text").to_owned()).collect()
}

fn faults(report: &serde_json::Value) -> Vec<String> {
    let all = report["faults"].as_array().expect("faults").iter();
    let text = |value: &serde_json::Value| value.as_str().expect("a text").to_owned();
    all.map(|fault| format!("{}: {}", text(&fault["where"]), text(&fault["words"]))).collect()
}

#[test]
fn the_best_start_is_taken_and_told() {
    let place = Place::new();
    place.save("tube.toile", &placed_project(0.39, 0.33));
    for (option, taken, words) in
        [("", "marks", "by suggested marks"), (" --start placement", "placement", "sewn from placement")]
    {
        let done = place.ends(0, &format!("dress tube.toile --out out{option}"));
        assert!(done.out.starts_with("tube: dressed, ") && done.out.contains(words), "{done:#?}");
        let report = place.json("out/report.json");
        let start = &report["start"];
        assert_eq!((&start["taken"], &start["draped"]), (&taken.into(), &true.into()), "{start:#}");
        let last = start["tried"].as_array().and_then(|tried| tried.last()).expect("tried");
        assert_eq!((&last["start"], texts(&last["faults"])), (&taken.into(), faults(&report)));
        assert!(last["seconds"].as_f64().is_some_and(|s| s > 0.0) && last["ticks"].as_u64() > Some(1));
    }
}

#[test]
fn where_no_start_is_clean_the_exit_code_and_the_report_say_so() {
    let place = Place::new();
    place.save("narrow.toile", &placed_project(0.15, 0.15));
    let done = place.ends(1, "dress narrow.toile --out out --json");
    assert!(done.err.contains("no start is without a fault: the start by suggested marks has "), "{done:#?}");
    let report = place.json("out/report.json");
    let tried = report["start"]["tried"].as_array().expect("tried");
    let all: Vec<Vec<String>> = tried.iter().map(|tried| texts(&tried["faults"])).collect();
    assert!(all.iter().all(|faults| !faults.is_empty()) && all.contains(&faults(&report)), "{all:#?}");
    let told: Vec<&str> = done.err.lines().filter_map(|line| line.strip_prefix("toile: ")).collect();
    assert_eq!(told, faults(&report), "a line for each fault, once");
    let [cause, tried, advice] = ["toile: ", "narrow.toile: note: no start", "narrow.toile: what to do: "]
        .map(|words| done.err.lines().position(|line| line.starts_with(words)));
    assert!(cause.is_some() && cause < tried && tried < advice, "{done:#?}");
    let plain = place.ends(1, "dress narrow.toile --out out");
    assert!(plain.out.starts_with("narrow: not dressed, ") && plain.out.lines().count() == 1, "{plain:#?}");
    assert!(faults(&report).iter().all(|words| !plain.out.contains(words)), "told once: {plain:#?}");
    std::fs::copy(place.path("narrow.toile"), place.path("again.toile")).expect("copied");
    let both = place.ends(1, "dress narrow.toile again.toile --out both");
    assert_eq!(both.err.lines().filter(|line| line.starts_with("toile: ")).count(), 1, "{both:#?}");
    assert!(both.err.ends_with("toile: 2 of 2 are not dressed\n"), "{both:#?}");
    assert!(both.out.lines().all(|line| line.contains(": not dressed: ")), "{both:#?}");
}

#[test]
fn what_is_too_small_is_not_to_be_marked_otherwise() {
    let place = Place::new();
    let done = place.ends(
        1,
        "dress sample:skirt --sizes sizes:adults --body-size xxl --no-picture --save big.toile --out out",
    );
    let advice = done.err.lines().find(|line| line.contains(": what to do: ")).expect("an advice");
    for words in ["sample:skirt: ", "open it (toile big.toile); Problems", "cut it larger"] {
        assert!(advice.contains(words), "{advice}");
    }
}

#[test]
fn a_start_that_cannot_be_begun_is_told() {
    let place = Place::with_ball();
    place.ends_with_words(3, "dress ball.toile --out out --start placement", "no piece is placed");
    place.ends_with_words(2, "dress ball.toile --out out --start pins", "marks or placement");
    place.ends_with_words(2, "dress ball.toile --out out --start marks --suggest-marks", "cannot be used");
    place.ends(0, "dress ball.toile --out out --start marks");
    assert!(place.json("out/report.json").get("start").is_none(), "it has marks of its own");
    let mut unmarked = project();
    unmarked.document.marks = Default::default();
    place.save("unmarked.toile", &unmarked);
    place.ends_with_words(3, "dress unmarked.toile --out out --start marks", "no piece is placed");
}
