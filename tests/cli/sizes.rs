//! Sizes of a graded pattern: one of them taken, all of them dressed, and rules beside a DXF.

use std::sync::Arc;

use glam::DVec2;
use toile::body::mannequin::{Measurements, mannequin};
use toile::pattern::{Edge, GradeRule, InternalLine, SizeRun};
use toile::session::samples::Sample;
use toile::session::{Project, project_file};

use crate::program::Place;

/// The skirt in three sizes, 4 % wider from one to the next.
fn skirt() -> Project {
    let mut project = Sample::Skirt.project(&mannequin(&Measurements::default()).expect("the usual figure"));
    let pattern = Arc::make_mut(&mut project.document.pattern);
    pattern.sizes = SizeRun::new(["S", "M", "L"], "M").expect("a run");
    for piece in pattern.pieces.values_mut() {
        for edge in &mut Arc::make_mut(piece).outline {
            edge.rule = Some(GradeRule::even(DVec2::new(edge.start.x * 0.04, 0.0), 3, 1));
        }
    }
    project
}

/// Writes the graded skirt and a table of a body for each of its sizes.
pub(crate) fn write_inputs(place: &Place, project: &str, table: &str) {
    let bytes = project_file::to_bytes(&skirt()).expect("a project");
    std::fs::write(place.path(project), bytes).expect("written");
    place.write(table, "size,waist,hip\nS,68,94\nM,70.6,98\nL,74,102\n");
}

/// A folder with that skirt and a table of bodies.
pub fn place() -> Place {
    let place = Place::new();
    write_inputs(&place, "skirt.toile", "bodies.csv");
    place
}

#[test]
fn every_size_is_dressed_on_its_body_and_told_in_one_table() {
    let place = place();
    let ended = place.run("sizes skirt.toile --sizes bodies.csv --edge-length 0.05 --no-picture --out out");
    assert!([0, 1].contains(&ended.code), "{}", ended.err);
    let lines: Vec<&str> = ended.out.lines().collect();
    assert!(lines.len() == 4 && lines[3].contains("of 3 sizes"), "{}", ended.out);
    let csv = place.read("out/sizes.csv");
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let hip = rows[0].iter().position(|title| *title == "hip_pattern_cm").expect("a hip");
    let girth = |row: usize| rows[row][hip].parse::<f64>().expect("a girth");
    assert!(girth(1) < girth(2) && girth(2) < girth(3), "{csv}");
    assert!(girth(3) / girth(2) > 1.02, "{csv}");
    for size in ["S", "M", "L"] {
        assert!(place.path(&format!("out/{size}/dressed.toile")).exists());
    }
    let report = place.json("out/sizes.json");
    assert!(report["best"].is_null() && report["base"] == "M");
}

#[test]
fn on_one_body_the_best_size_is_told() {
    let place = place();
    let ended =
        place.run("sizes skirt.toile --only M --only L --edge-length 0.05 --no-picture --json --out out");
    let report: serde_json::Value = serde_json::from_str(&ended.out).expect(&ended.err);
    assert!(["M", "L"].contains(&report["best"].as_str().expect("a best size")), "{}", ended.out);
    assert_eq!(report["sizes"].as_array().map(Vec::len), Some(2));
}

#[test]
fn what_has_no_size_is_refused_before_anything_is_dressed() {
    let place = place();
    place.write("small.csv", "size,waist\nS,68\n");
    for (code, run, words) in [
        (3, "sizes sample:skirt --out out", "has no sizes"),
        (3, "sizes skirt.toile --only XXL --out out", "no size \"XXL\": it has S, M, L"),
        (3, "sizes skirt.toile --sizes small.csv --out out", "there is no size \"M\" in it"),
        (2, "sizes skirt.toile --sizes small.csv --body mannequin --out out", "cannot be used with"),
        (3, "export skirt.toile --grade 46 -o a.svg", "no size \"46\""),
    ] {
        place.ends_with_words(code, run, words);
    }
    assert!(!place.path("out").exists());
}

#[test]
fn a_dxf_goes_out_with_its_rules_and_in_again() {
    let place = place();
    place.ends(0, "export skirt.toile -o skirt.dxf");
    let rules = place.read("skirt.rul");
    assert!(rules.contains("SIZE LIST: S M L") && rules.contains("SAMPLE SIZE: M"), "{rules}");
    place.ends(0, "export skirt.toile --grade L -o large.svg");
    place.ends(0, "import skirt.dxf -o again.toile");
    let read = |name: &str| {
        let bytes = std::fs::read(place.path(name)).expect("a file");
        project_file::from_bytes(&bytes).expect("a project").document.pattern
    };
    let (was, is) = (read("skirt.toile"), read("again.toile"));
    assert_eq!(was.sizes, is.sizes);
    let [was, is] = [was, is].map(|pattern| {
        let large = toile::pattern::grading::graded(&pattern, "L").expect("a size").pattern;
        large.pieces.values().map(|piece| piece.signed_area().abs()).sum::<f64>()
    });
    assert!((was / is - 1.0).abs() < 1e-4, "{was} {is}");
    place.write("skirt.rul", rules.replace("UNITS: METRIC", "UNITS: ELLS"));
    place.ends_with_words(3, "import skirt.dxf -o no.toile", "the rule table beside it: line 3: the units");
}

/// The end of a line inside has a rule of its own, which goes out with the DXF and comes in again.
#[test]
fn rules_of_points_inside_go_out_and_in_again() {
    let place = place();
    let read = |name: &str| {
        let bytes = std::fs::read(place.path(name)).expect("a file");
        project_file::from_bytes(&bytes).expect("a project")
    };
    let mut project = read("skirt.toile");
    let pattern = Arc::make_mut(&mut project.document.pattern);
    let first = Arc::make_mut(pattern.pieces.values_mut().next().expect("a piece"));
    let middle = first.outline.iter().map(|edge| edge.start).sum::<DVec2>() / first.outline.len() as f64;
    let edges = vec![Edge { start: middle, ..Edge::default() }];
    let end_rule = Some(GradeRule::even(DVec2::new(0.0, 0.015), 3, 1));
    let line = InternalLine { edges, end: middle + DVec2::Y * 0.1, end_rule, ..InternalLine::default() };
    first.lines.push(line);
    std::fs::write(place.path("lined.toile"), project_file::to_bytes(&project).expect("bytes"))
        .expect("written");
    place.ends(0, "export lined.toile -o lined.dxf");
    place.ends(0, "import lined.dxf -o again.toile");
    let length = |name: &str, size: &str| {
        let pattern = &read(name).document.pattern;
        let graded = toile::pattern::grading::graded(pattern, size).expect("a size").pattern;
        let lines = graded.pieces.values().flat_map(|piece| piece.lines.clone());
        lines.map(|line| line.edges[0].start.distance(line.end)).sum::<f64>()
    };
    for size in ["S", "M", "L"] {
        let [was, is] = ["lined.toile", "again.toile"].map(|name| length(name, size));
        assert!((was - is).abs() < 1e-5, "{size}: {was} {is}");
    }
    assert!(length("again.toile", "L") > length("again.toile", "M") + 0.01, "it grows with the size");
}
