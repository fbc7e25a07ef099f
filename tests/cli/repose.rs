//! `toile repose` and `toile fit` from outside.

use glam::{DQuat, DVec3};

use crate::common::placed_project;
use crate::program::Place;

/// Vertices of an OBJ file.
pub fn vertices(text: &str) -> Vec<DVec3> {
    let numbers =
        |line: &str| -> Vec<f64> { line.split_whitespace().filter_map(|w| w.parse().ok()).collect() };
    let found = text.lines().filter_map(|line| line.strip_prefix("v ")).map(numbers);
    found.map(|n| DVec3::new(n[0], n[1], n[2])).collect()
}

/// The OBJ file with every vertex moved.
pub fn moved(text: &str, to: impl Fn(DVec3) -> DVec3) -> String {
    let mut places = vertices(text).into_iter().map(to);
    let line = |line: &str| match line.starts_with("v ").then(|| places.next()).flatten() {
        Some(p) => format!("v {} {} {}\n", p.x, p.y, p.z),
        None => format!("{line}\n"),
    };
    text.lines().map(line).collect()
}

/// The ball with its patches on it, in "dressed.toile", and the files of `toile dress` in "out".
pub fn dressed() -> Place {
    let place = Place::with_ball();
    place.run("dress ball.toile --out out --save dressed.toile");
    assert!(!place.names("out").is_empty());
    place
}

#[test]
fn cloth_goes_along_with_a_body_that_turns() {
    let place = dressed();
    let turn = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(0.3);
    let there = move |p: DVec3| turn * p + DVec3::new(0.1, 0.05, -0.2);
    place.write("posed.obj", moved(&place.read("out/body.obj"), there));
    let report =
        place.run("repose dressed.toile --body posed.obj --unit m --out posed --save posed.toile --json");
    assert!([0, 1].contains(&report.code), "{report:#?}");
    let (before, after) =
        (vertices(&place.read("out/garment.obj")), vertices(&place.read("posed/garment.obj")));
    assert_eq!(before.len(), after.len());
    let worst = before.iter().zip(&after).map(|(&p, q)| there(p).distance(*q)).fold(0.0, f64::max);
    assert!(worst < 1e-4, "{worst}");
    place.ends(0, "check posed.toile");
    // The marks on the body go along too.
    let met = |folder: &str| {
        let error = &place.json(&format!("{folder}/report.json"))["mark_error"];
        assert_ne!(error["points"], 0);
        ["mean", "max"].map(|of| error[of].as_f64().expect("metres"))
    };
    let [before, after] = ["out", "posed"].map(met);
    assert!((0..2).all(|i| (before[i] - after[i]).abs() < 1e-4), "{before:?} {after:?}");
}

#[test]
fn a_project_without_marks_is_dressed_first_as_dress_would() {
    let place = Place::new();
    place.save("tube.toile", &placed_project(0.39, 0.33));
    place.ends(0, "dress tube.toile --out out");
    let there = |p: DVec3| p + DVec3::X * 0.1;
    place.write("posed.obj", moved(&place.read("out/body.obj"), there));
    let done = place.ends(0, "repose tube.toile --body posed.obj --unit m --out posed");
    assert!(done.err.contains("not dressed yet: dressing it first"), "{done:#?}");
    let of = |folder: &str| vertices(&place.read(&format!("{folder}/garment.obj")));
    let far = of("out").into_iter().zip(of("posed")).map(|(p, q)| there(p).distance(q));
    assert!(far.fold(0.0, f64::max) < 1e-4);
}

#[test]
fn cloth_is_draped_in_each_pose_where_that_is_asked_for() {
    let place = Place::new();
    place.ends(0, "dress sample:gathered-skirt --edge-length 0.04 --save skirt.toile --no-picture --out out");
    place.ends(0, "repose skirt.toile --pose sitting --pose walking --out stiff");
    place.ends(0, "repose skirt.toile --pose sitting --pose walking --drape --out fallen");
    for pose in ["00-sitting", "01-walking"] {
        let [stiff, fallen] =
            ["stiff", "fallen"].map(|folder| vertices(&place.read(&format!("{folder}/{pose}/garment.obj"))));
        let moved = stiff.iter().zip(&fallen).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(stiff.len() == fallen.len() && moved > 0.02, "{pose}: it moved by {moved} m");
        assert!(place.json(&format!("stiff/{pose}/report.json"))["drape"].is_null());
        let report = place.json(&format!("fallen/{pose}/report.json"));
        assert!(!report["drape"].is_null() && report["at_rest"] == true, "{report}");
    }
    place.ends_with_words(
        2,
        "repose skirt.toile --sequence --drape --body x --out out",
        "cannot be used with",
    );
}

#[test]
fn cloth_that_was_draped_may_fold_after_it_was_saved_too() {
    let place = Place::new();
    place.ends(0, "dress sample:tshirt --edge-length 0.03 --drape --save draped.toile --out out");
    let folds = |folder: &str| {
        let report = place.json(&format!("{folder}/report.json"));
        assert_eq!(report["faults"], serde_json::json!([]), "{folder}");
        report["flipped_faces"].as_u64().expect("a number")
    };
    assert_ne!(folds("out"), 0, "this test needs folds");
    let contact = &place.json("out/report.json")["counters"]["contact"];
    for counter in [
        "detections",
        "searches",
        "neighbours",
        "pairs",
        "planes",
        "truncated_vertices",
        "smallest_distance_nm",
    ] {
        assert!(contact[counter].as_u64().is_some_and(|count| count > 0), "{counter}: {contact}");
    }
    place.ends(0, "repose draped.toile --pose a --save again.toile --out same");
    place.ends(0, "repose again.toile --pose a --out again");
    assert_eq!([folds("same"), folds("again")], [folds("out"); 2]);
    place.ends(0, "fit again.toile --page fit.html");
    assert!(!place.read("fit.html").contains("wrong side out"));
}

#[test]
fn cloth_that_was_carried_may_fold_after_it_was_saved_too() {
    let place = Place::new();
    place.ends(0, "dress sample:tshirt --save worn.toile --out out");
    place.ends(0, "repose worn.toile --pose arms-up --save posed.toile --out up");
    let folds = place.json("up/report.json")["faces_in_folds"].as_u64();
    assert!(folds.is_some_and(|count| count > 0), "this test needs folds: {folds:?}");
    place.ends(0, "fit posed.toile --page fit.html");
    assert!(!place.read("fit.html").contains("wrong side out"));
}

#[test]
fn a_body_of_other_triangles_and_two_saves_are_refused_in_words() {
    let place = dressed();
    let other = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    place.write("other.obj", other);
    let refused = place.ends(3, "repose dressed.toile --body other.obj --unit m --out posed");
    assert!(refused.err.contains("other.obj"), "{refused:#?}");
    place.ends(2, "repose dressed.toile --body a.obj --body b.obj --out posed --save one.toile");
    place.ends(6, "repose dressed.toile --body nowhere.obj --out posed");
    let refused = place.ends(2, "repose dressed.toile --out posed");
    let ways = ["--body", "--pose", "--joint", "--joints", "--motion"];
    assert!(ways.iter().all(|way| refused.err.contains(way)), "{refused:#?}");
    place.write("notes.toile", "buy thread\n");
    let refused = place.ends(3, "repose notes.toile --pose a --out posed");
    assert!(!refused.err.contains("OBJ"), "{refused:#?}");
}

#[test]
fn the_mannequin_takes_poses_by_name_and_bodies_from_files_do_not() {
    let place = dressed();
    place.ends_with_words(3, "repose dressed.toile --pose t --out posed", "--pose");
    place.ends_with_words(2, "repose dressed.toile --pose flying --out posed", "kung-fu");
    place.ends_with_words(2, "repose dressed.toile --out posed", "--body");
    let report = place.run("dress sample:scarf --edge-length 0.05 --save scarf.toile --out scarf");
    assert!([0, 1].contains(&report.code), "{report:#?}");
    let report = place.run("repose scarf.toile --pose t --pose walking --out posed");
    assert!([0, 1].contains(&report.code), "{report:#?}");
    let height = |name: &str| {
        let body = vertices(&place.read(name));
        body.iter().filter(|p| p.x.abs() > 0.5).map(|p| p.y).fold(f64::NEG_INFINITY, f64::max)
    };
    assert!(height("posed/00-t/body.obj") > 1.3, "the arms are up");
    assert!(vertices(&place.read("posed/01-walking/body.obj")).iter().all(|p| p.x.abs() < 0.45));
}

#[test]
fn joints_are_turned_by_hand_within_their_ranges() {
    let place = dressed();
    place.ends_with_words(3, "repose dressed.toile --joint left_elbow=60 --out posed", "only the mannequin");
    place.ends_with_words(2, "repose dressed.toile --joint left_elbow=160 --out posed", "0° to 150°");
    place.ends_with_words(2, "repose dressed.toile --joint tail=10 --out posed", "left_elbow");
    place.ends_with_words(2, "repose dressed.toile --joint head=1 --pose t --pose a --out posed", "--pose");
    place.write("far.json", r#"{"left_knee": 200}"#);
    place.ends_with_words(3, "repose dressed.toile --joints far.json --out posed", "far.json: /left_knee");
    let report = place.run("dress sample:scarf --edge-length 0.05 --save scarf.toile --out scarf");
    assert!([0, 1].contains(&report.code), "{report:#?}");
    place.write("kick.json", r#"{"right_hip": {"flexion": 80}}"#);
    let report =
        place.run("repose scarf.toile --pose standing --joint left_elbow=90 --joints kick.json --out posed");
    assert!([0, 1].contains(&report.code), "{report:#?}");
    let body = |name: &str| vertices(&place.read(&format!("posed/{name}/body.obj")));
    let (kick, bent) = (body("00-kick"), body("01-joints"));
    let farthest = |body: &[DVec3], sign: f64, low: f64, high: f64| {
        let there = body.iter().filter(|p| p.x * sign > 0.0 && (low..high).contains(&p.y));
        there.map(|p| p.z).fold(f64::NEG_INFINITY, f64::max)
    };
    assert!(farthest(&kick, -1.0, 0.7, 1.5) > 0.5, "the right leg is up in front");
    assert!(farthest(&bent, 1.0, 0.8, 1.2) > 0.3, "the left forearm is in front");
    assert!(farthest(&bent, -1.0, 0.8, 1.2) < 0.25, "the right one is not");
}

#[test]
fn maps_are_written_as_figures() {
    let place = dressed();
    place.ends(0, "fit dressed.toile --map strain --map ease --map curvature --out maps");
    let figures = place.json("maps/fit.json");
    let maps = figures["maps"].as_array().expect("maps");
    let names: Vec<&str> = maps.iter().filter_map(|map| map["map"].as_str()).collect();
    for name in ["warp", "weft", "shear", "area", "ease", "curvature"] {
        assert!(names.contains(&name), "{names:?}");
    }
    // Vertices on the seam stand in it once for each piece.
    let text = place.read("maps/ease.csv");
    let vertices: std::collections::BTreeSet<&str> =
        text.lines().skip(1).filter_map(|row| row.split(',').nth(3)).collect();
    assert_eq!(vertices.len() as u64, figures["vertices"].as_u64().expect("a count"));
    let ease = maps.iter().find(|map| map["map"] == "ease").expect("ease");
    assert!(ease["mean"].as_f64().expect("a mean") > 0.0, "{ease}");
}

#[test]
fn a_project_without_cloth_has_no_maps() {
    let place = Place::with_ball();
    place.ends_with_words(3, "fit ball.toile --map ease --out maps", "dress it first");
    place.ends_with_words(2, "fit ball.toile --map warmth --out maps", "warmth");
}
