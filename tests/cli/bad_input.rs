//! Bad files: an exit code and words in under a second, never a panic.

use std::time::{Duration, Instant};

use crate::program::Place;

fn refused(name: &str, bytes: &[u8], words: &str) {
    let place = Place::new();
    place.write(name, bytes);
    for task in ["check", "dress --out out"] {
        let start = Instant::now();
        place.ends_with_words(3, &format!("{task} {name}"), words);
        assert!(start.elapsed() < Duration::from_secs(5), "{name} took {:?}", start.elapsed());
    }
    assert!(place.names("out").is_empty());
}

#[test]
fn empty_and_foreign_files_are_refused() {
    refused("empty.toile", b"", "");
    refused("octopus.obj", b"<html><body>Not found</body></html>", "octopus.obj");
    refused("binary.obj", &[0, 159, 146, 150, 0, 1, 2, 3], "binary.obj");
    refused("list.json", b"[1, 2, 3]", "list.json");
    refused("recording.toile", br#"{"format": "toile-recording", "version": 1}"#, "toile-recording");
    refused("future.toile", br#"{"format": "toile-project", "version": 7, "project": 0}"#, "newer program");
    refused("zip.toile", b"PK\x03\x04 and then nothing", "the end of the file is missing");
    refused("picture.json", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "this is a binary file, no pattern");
    refused("nothing.json", b"{}", "no GarmentCode pattern");
    refused("shirt.val", b"<?xml version=\"1.0\"?><pattern><version>0.8</version></pattern>", "DXF or SVG");
}

#[test]
fn faulty_patterns_are_refused() {
    let panel = |vertices: &str, edge: &str| {
        format!(
            r#"{{"pattern": {{"panels": {{"p": {{"vertices": {vertices}, "edges": [
                {{"endpoints": [0, 1]}}, {{"endpoints": {edge}}}, {{"endpoints": [2, 0]}}],
                "translation": [0, 0, 0], "rotation": [0, 0, 0]}}}}, "stitches": []}},
                "properties": {{"units_in_meter": 100}}}}"#
        )
    };
    let square = "[[0, 0], [10, 0], [0, 10]]";
    refused("index.json", panel(square, "[1, 9]").as_bytes(), "index.json");
    refused("huge.json", panel("[[0, 0], [1e999, 0], [0, 10]]", "[1, 2]").as_bytes(), "huge.json");
    refused("nan.json", panel("[[0, 0], [NaN, 0], [0, 10]]", "[1, 2]").as_bytes(), "nan.json");
    let cut = panel(square, "[1, 2]");
    refused("cut.json", &cut.as_bytes()[..cut.len() / 2], "cut.json");
}

#[test]
fn unknown_samples_name_the_known() {
    let place = Place::new();
    place.ends_with_words(3, "dress sample:tuxedo --out out", "tshirt");
    place.ends_with_words(6, "dress nowhere.toile --out out", "nowhere.toile");
}
