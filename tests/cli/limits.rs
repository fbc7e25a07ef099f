//! What is more than the program will take on is told with its number, before the work: exit code 4.

use std::fmt::Write;
use std::time::{Duration, Instant};

use crate::program::Place;

/// Refused at once, on a loaded machine too.
fn refused(place: &Place, arguments: &str, words: &str) {
    let start = Instant::now();
    place.ends_with_words(4, arguments, words);
    assert!(start.elapsed() < Duration::from_secs(20), "{arguments} took {:?}", start.elapsed());
}

#[test]
fn cloth_too_fine_for_its_size_is_not_cut() {
    let place = Place::new();
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="20m" height="20m" viewBox="0 0 20 20">
        <path id="front" d="M 0 0 H 10 V 10 H 0 Z"/></svg>"#;
    place.write("tent.svg", svg);
    let words = "tent.svg: 100.0 m² of cloth would be about 57736721 triangles, at most 4000000 are cut";
    for task in ["dress --out out", "render -o tent.png"] {
        refused(&place, &format!("{task} tent.svg --edge-length 0.002"), words);
    }
    assert_eq!(place.names(""), ["tent.svg"]);
}

#[test]
fn more_frames_than_can_be_kept_are_not_begun() {
    let place = Place::new();
    let mut cloth = String::new();
    for i in 0..5000 {
        writeln!(cloth, "v {} 1 0\nv {} 1 0\nv {} 1 1", i, f64::from(i) + 0.5, i).expect("a string");
        writeln!(cloth, "f {} {} {}", 3 * i + 1, 3 * i + 2, 3 * i + 3).expect("a string");
    }
    place.write("cloth.obj", cloth);
    place.write("scene.json", r#"{"cloth": "cloth.obj", "seconds": 1000, "fps": 60}"#);
    let words = "60000 frames of 15000 vertices are 10800180000 bytes, at most 4294967296 are written";
    refused(&place, "simulate scene.json --out out", words);
    assert_eq!(place.names(""), ["cloth.obj", "scene.json"]);
}

#[test]
#[cfg(unix)]
fn what_has_no_end_is_not_read() {
    let place = Place::new();
    for task in ["check /dev/zero", "replay /dev/zero --out out", "measure /dev/zero"] {
        refused(&place, task, "/dev/zero: it has more than 536870912 bytes");
    }
}
