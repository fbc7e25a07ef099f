//! generate, and bench corpus.

use serde_json::Value;

use crate::program::Place;

#[test]
fn patterns_are_written_placed_and_not_and_are_the_same_again() {
    let place = Place::new();
    let options = "--count 3 --seed 5 --body-sizes s,xl --poses t";
    place.ends(0, &format!("generate {options} --out a"));
    place.ends(0, &format!("generate {options} --out b"));
    place.ends(0, &format!("generate {options} --out c --without-placement"));
    let names = place.names("a");
    assert_eq!(names.len(), 6 + 2, "{names:?}");
    for name in &names {
        assert_eq!(place.read(&format!("a/{name}")), place.read(&format!("b/{name}")), "{name}");
    }
    let patterns: Vec<&String> = names.iter().filter(|name| name.ends_with(".json")).collect();
    for name in &patterns {
        assert!(place.read(&format!("a/{name}")).contains("translation"));
        assert!(!place.read(&format!("c/{name}")).contains("translation"));
    }
    place.ends(0, &format!("check a/{}", patterns[0]));
    assert_eq!(place.read("a/corpus.jsonl").lines().count(), 6);
    let one = place.ends(0, &format!("generate {options} --shard 1/2 --out d")).out;
    assert!(one.starts_with("3 patterns"), "{one}");
}

#[test]
fn two_garments_are_dressed_and_counted() {
    let place = Place::new();
    let done = place.ends(
        0,
        "bench corpus --count 2 --kinds vest,one-shoulder --body-sizes m --poses a --out kept --json",
    );
    let summary: Value = serde_json::from_str(&done.out).expect("JSON");
    assert_eq!(summary["all"]["garments"], 2, "{summary:#}");
    assert_eq!(summary["all"]["clean"], 2, "{summary:#}");
    assert_eq!(summary["kinds"].as_array().map(Vec::len), Some(2));
    assert_eq!(place.names("kept"), ["sizes.csv"], "only failures are kept");
}

#[test]
fn what_no_corpus_has_is_wrong_usage() {
    let place = Place::new();
    for wrong in
        ["--shard 3/2", "--poses sitting", "--kinds tuxedo", "--body-sizes xxxl", "--count 0", "--seed x"]
    {
        place.ends(2, &format!("generate --out a {wrong}"));
        place.ends(2, &format!("bench corpus {wrong}"));
    }
    place.ends(2, "bench corpus --count 1 --body-sizes m --poses a --shard 9/9");
    place.ends(2, "bench speed --count 1");
    place.ends(2, "bench corpus --plot a.svg");
    assert!(place.names("").is_empty());
}
