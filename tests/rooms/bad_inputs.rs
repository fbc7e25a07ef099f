//! Every file in `tests/bad` is answered in words that name the fault, within a second. What to expect is in the
//! `expected.json` of each folder; "problem: " stands for a body that can be read but not dressed, "note: " for one that
//! was put right.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use toile::body::{Unit, import};
use toile::io::{garmentcode, obj, pattern_formats};

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad").join(name)
}

/// `answer` reads a file and tells what was wrong; None when nothing was.
fn check(format: &str, answer: impl Fn(&[u8]) -> Option<String>) {
    let folder = folder(format);
    let text = std::fs::read_to_string(folder.join("expected.json")).expect("expected.json");
    let expected: BTreeMap<String, String> = serde_json::from_str(&text).expect("names and words");
    let files = std::fs::read_dir(&folder).expect("the folder").count() - 1;
    assert_eq!(files, expected.len(), "every file in {format} has its line");
    for (name, words) in expected {
        let bytes = std::fs::read(folder.join(&name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        let start = Instant::now();
        let found = answer(&bytes).unwrap_or_else(|| panic!("{format}/{name} was accepted"));
        assert!(start.elapsed() < Duration::from_secs(1), "{format}/{name} took {:?}", start.elapsed());
        assert!(found.contains(&words), "{format}/{name}: expected {words:?}, got {found:?}");
    }
}

#[test]
fn patterns() {
    check("garmentcode", |bytes| garmentcode::read(bytes).err().map(|e| e.to_string()));
}

/// Errors as they are; of files that can be read the notes, and what keeps their pieces from being sewn.
fn drawing(bytes: &[u8]) -> Option<String> {
    match pattern_formats::read(bytes, None) {
        Err(error) => Some(error.to_string()),
        Ok(read) => {
            let (_, problems) = toile::cloth::build(&read.pattern, 0.05);
            let problems = problems.iter().map(|p| format!("problem: {}: {}", p.place, p.words));
            let told: Vec<String> = read.notes.iter().map(|n| format!("note: {n}")).chain(problems).collect();
            (!told.is_empty()).then(|| told.join("\n"))
        }
    }
}

#[test]
fn svg_drawings() {
    check("svg", drawing);
}

#[test]
fn dxf_drawings() {
    // An empty file has no format, so the reader of this one is asked.
    check("dxf", |bytes| match toile::io::dxf::read(bytes, None) {
        Err(error) => Some(error.to_string()),
        Ok(_) => drawing(bytes),
    });
}

/// A hundred thousand groups in each other are too large for a file here.
#[test]
fn the_deepest_drawing_is_refused_at_once() {
    let deep = format!("<svg xmlns=\"http://www.w3.org/2000/svg\">{}", "<g>".repeat(100_000));
    let start = Instant::now();
    let error = pattern_formats::read(deep.as_bytes(), None).expect_err("too deep").to_string();
    assert!(
        error.contains("nested more than 200 deep") && start.elapsed() < Duration::from_secs(1),
        "{error}"
    );
}

/// Twenty thousand points at random: no curve runs through them, and none is looked for long.
#[test]
fn a_polyline_without_sense_takes_no_time() {
    let mut seed = 1u64;
    let mut next = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 40) as f64 / f64::from(1 << 24) * 600.0
    };
    let points: String = (0..20_000).map(|_| format!("{},{} ", next(), next())).collect();
    let svg = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="600mm" height="600mm" viewBox="0 0 600 600">
        <polygon points="{points}"/></svg>"#
    );
    let start = Instant::now();
    let read = pattern_formats::read(svg.as_bytes(), None).expect("a piece, if a bad one");
    assert!(start.elapsed() < Duration::from_secs(2), "{:?}", start.elapsed());
    assert_eq!(read.pattern.pieces.len(), 1);
}

#[test]
fn bodies() {
    check("obj", |bytes| match obj::read(bytes) {
        Err(error) => Some(error.to_string()),
        Ok(read) => {
            let body = import(read.mesh, Unit::Metre);
            let problems = body.problems.iter().map(|p| format!("problem: {}", p.words));
            let told: Vec<String> = problems.chain(body.notes.iter().map(|n| format!("note: {n}"))).collect();
            (!told.is_empty()).then(|| told.join("\n"))
        }
    });
}

/// A fault in one piece stops only that piece.
#[test]
fn a_self_crossing_panel_is_named_and_the_other_sewn() {
    let bytes = std::fs::read(folder("").join("self_crossing_panel.json")).expect("the file");
    let pattern = garmentcode::read(&bytes).expect("it can be read");
    let (garment, problems) = toile::cloth::build(&pattern, 0.03);
    let named = problems.iter().any(|p| {
        p.kind == toile::pattern::ProblemKind::SelfCrossing
            && p.place.contains("front")
            && !p.words.is_empty()
    });
    assert!(named, "{problems:?}");
    assert_eq!(garment.pieces.len(), 1);
}

/// Whatever a file is cut to or changed into, it is answered.
#[test]
fn mangled_files_never_panic() {
    let obj_text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1/1 3/2 2/3\nf -4 2 4\nf 1 \\\n4 3\nf 2 3 4 1\n";
    let json = std::fs::read(folder("").join("self_crossing_panel.json")).expect("the file");
    let mut seed = 7u64;
    let mut next = |below: usize| {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) as usize % below
    };
    let of = |name: &str| std::fs::read(folder("").join(name)).expect("the file");
    let drawings = [of("svg/41_self_crossing.svg"), of("dxf/52_other_shapes.dxf"), of("dxf/48_count.dxf")];
    let originals = [obj_text.as_bytes(), &json].into_iter().chain(drawings.iter().map(Vec::as_slice));
    for original in originals {
        for _ in 0..3000 {
            let mut bytes = original.to_vec();
            for _ in 0..=next(3) {
                let at = next(bytes.len());
                match next(3) {
                    0 => bytes[at] = b"0123456789-.e/ \n\\[]{}\",v"[next(23)],
                    1 => bytes.truncate(at + 1),
                    _ => bytes.insert(at, b"09-e/ \n\xff"[next(8)]),
                }
            }
            if let Ok(read) = obj::read(&bytes) {
                let _ = import(read.mesh, Unit::Metre);
            }
            let _ = garmentcode::read(&bytes);
            let _ = pattern_formats::read(&bytes, None);
        }
    }
}
