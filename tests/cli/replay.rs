//! Recordings: made by dress, replayed, altered, damaged.

use crate::program::Place;

fn recorded() -> Place {
    let place = Place::with_ball();
    place.ends(0, "dress ball.toile --out out --record r.jsonl");
    place
}

#[test]
fn a_recording_replays_to_the_same_files() {
    let place = recorded();
    let done = place.ends(0, "replay r.jsonl --out again --json --threads 2");
    let outcome: serde_json::Value = serde_json::from_str(&done.out).expect("JSON");
    assert!(outcome["hashes_compared"].as_u64().is_some_and(|n| n >= 3), "{outcome}");
    assert_eq!(outcome["state_hash"], place.json("out/report.json")["state_hash"]);
    assert_eq!(place.read("again/garment.obj"), place.read("out/garment.obj"));
    assert!(place.ends(0, "replay r.jsonl").out.contains("hashes the same"));
}

#[test]
fn one_number_changed_is_a_divergence() {
    let place = recorded();
    let text = place.read("r.jsonl");
    // The friction in the header, a hash, the tick in which the wrap took effect.
    let hash = text.rfind("\"cloth\":\"").expect("a hash") + "\"cloth\":\"".len();
    let digit = if text.as_bytes()[hash] == b'0' { "1" } else { "0" };
    let mut other_hash = text.clone();
    other_hash.replace_range(hash..=hash, digit);
    let changed = [
        text.replacen("\"friction\":0.", "\"friction\":1.", 1),
        text.replacen("{\"applied\":{\"seq\":1,\"tick\":0}}", "{\"applied\":{\"seq\":1,\"tick\":1}}", 1),
        other_hash,
    ];
    for changed in changed {
        assert_ne!(changed, text);
        place.write("changed.jsonl", changed);
        place.ends_with_words(1, "replay changed.jsonl --out never", "diverged at tick ");
        place.ends_with_words(1, "replay changed.jsonl", ", after command ");
    }
    assert!(place.names("never").is_empty());
}

#[test]
fn damaged_recordings_name_the_line() {
    let place = recorded();
    let text = place.read("r.jsonl");
    let damaged = |text: &str, words: &str| {
        place.write("damaged.jsonl", text);
        place.ends_with_words(3, "replay damaged.jsonl", words);
    };
    damaged("", "line 1: the recording is empty");
    damaged(&text[..text.len() - 20], &format!("line {}: ", text.lines().count()));
    damaged(&text.replacen("\"wrap\"", "\"warp\"", 1), "line 3: unknown variant `warp`");
    damaged(&text.replacen("\"version\":1", "\"version\":2", 1), "version 2");
    damaged("o octopus\nv 0 0 0\n", "line 1: this is not the header of a recording");
    let header = text.lines().next().expect("a header");
    place.write("short.jsonl", header);
    place.ends_with_words(1, "replay short.jsonl", "holds no hash");
    place.write("binary.jsonl", [0xff, 0xfe, 0x00]);
    place.ends_with_words(3, "replay binary.jsonl", "UTF-8");
    place.ends_with_words(6, "replay nowhere.jsonl", "nowhere.jsonl");
}

#[test]
fn demos_are_replayed_by_name() {
    let place = Place::with_ball();
    place.ends_with_words(3, "replay demo:nothing", "wrapping, dragging");
    let text = toile::session::demos::Demo::Scarf.recording();
    let recording = toile::session::recording::Recording::parse(text).expect("a recording");
    if recording.machine == toile::session::recording::machine() {
        assert!(place.ends(0, "replay demo:scarf").out.contains("hashes the same"));
    }
}
