//! `toile simulate` from outside.

use crate::program::Place;

/// A square of 4 × 4 cells, 0.2 m wide, lying at y = 1, with its flat shape.
fn square(shape: bool) -> String {
    use std::fmt::Write;
    let mut text = String::new();
    for j in 0..5 {
        for i in 0..5 {
            let (x, z) = (f64::from(i) * 0.05, f64::from(j) * 0.05);
            writeln!(text, "v {x} 1 {z}\nvt {x} {z}").expect("a string");
        }
    }
    for j in 0..4 {
        for i in 0..4 {
            let corner = |di: u32, dj: u32| {
                let v = (j + dj) * 5 + i + di + 1;
                if shape { format!("{v}/{v}") } else { v.to_string() }
            };
            writeln!(text, "f {} {} {}", corner(0, 0), corner(1, 0), corner(1, 1)).expect("a string");
            writeln!(text, "f {} {} {}", corner(0, 0), corner(1, 1), corner(0, 1)).expect("a string");
        }
    }
    text
}

/// A box 2 m wide with its upper side at `height`.
fn floor(height: f64) -> String {
    let mut text = String::new();
    for y in [height, height - 1.0] {
        for (x, z) in [(-1, -1), (1, -1), (1, 1), (-1, 1)] {
            text += &format!("v {x} {y} {z}\n");
        }
    }
    text + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
}

fn positions(place: &Place, frame: usize) -> Vec<f32> {
    let bytes = std::fs::read(place.path("out/positions.f32")).expect("positions");
    assert_eq!(bytes.len() % (25 * 12), 0);
    let all: Vec<f32> = bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    all[frame * 75..(frame + 1) * 75].to_vec()
}

#[test]
fn cloth_falls_free_and_the_report_says_how() {
    let place = Place::new();
    place.write("cloth.obj", square(true));
    place.write("scene.json", r#"{"cloth": "cloth.obj", "seconds": 0.5, "fps": 60, "fabric": "cotton"}"#);
    place.ends_with_words(0, "simulate scene.json --out out", "");
    let report = place.json("out/simulate.json");
    assert_eq!((&report["frames"], &report["vertices"]), (&31.into(), &25.into()));
    assert_eq!(report["wall_s"].as_array().map(Vec::len), Some(30));
    let fallen = 1.0 - f64::from(positions(&place, 30)[1]);
    assert!((fallen - 9.81 * 0.125).abs() < 1e-6, "{fallen}");
}

#[test]
fn pins_hold_and_a_floor_carries_whatever_the_solver() {
    for solver in ["implicit", "small_steps"] {
        let place = Place::new();
        place.write("cloth.obj", square(false));
        place.write("floor.obj", floor(0.9));
        let scene = format!(
            r#"{{"cloth": "cloth.obj", "pins": [0], "collider": "floor.obj", "seconds": 0.6, "thickness_m": 0.002,
                 "self_collision": true, "solver": "{solver}"}}"#
        );
        place.write("scene.json", scene);
        place.ends_with_words(0, "simulate scene.json --out out", "");
        assert_eq!(positions(&place, 0)[..3], positions(&place, 36)[..3], "{solver}: the pin");
        let lowest = positions(&place, 36).chunks_exact(3).map(|p| p[1]).fold(f32::MAX, f32::min);
        assert!((lowest - 0.902).abs() < 1e-3, "{solver}: {lowest}");
    }
}

#[test]
fn a_membrane_of_springs_is_chosen_by_name() {
    let place = Place::new();
    place.write("cloth.obj", square(true));
    let lowest = |membrane: &str, solver: &str| {
        let scene = format!(
            r#"{{"cloth": "cloth.obj", "pins": [0, 4], "seconds": 0.5, "solver": "{solver}", "membrane": "{membrane}"}}"#
        );
        place.write("scene.json", scene);
        place.ends_with_words(0, "simulate scene.json --out out", "");
        let told = place.json("out/simulate.json")["membrane"].clone();
        (told, positions(&place, 30).chunks_exact(3).map(|p| p[1]).fold(f32::MAX, f32::min))
    };
    let [(first, triangles), (second, springs)] = ["triangles", "springs"].map(|m| lowest(m, "implicit"));
    assert_eq!((first, second), ("triangles".into(), "springs".into()));
    assert!(triangles != springs && (triangles - springs).abs() < 0.02, "{triangles} and {springs}");
    assert_eq!(lowest("triangles", "small_steps").0, "springs", "what they have");
}

#[test]
fn a_fold_line_turns_the_cloth_up() {
    let place = Place::new();
    place.write("cloth.obj", square(true));
    for solver in ["implicit", "small_steps"] {
        // Damped, so that it no longer swings about the angle.
        let scene = format!(
            r#"{{"cloth": "cloth.obj", "gravity": [0, 0, 0], "seconds": 3, "solver": "{solver}",
                 "fabric": {{"name": "slow", "stretch": {{"warp": 1500, "weft": 1500, "shear": 75, "poisson": 0.2}},
                    "bending": {{"warp": 4e-5, "bias": 4e-5, "weft": 4e-5, "poisson": 0}}, "density_kg_per_m2": 0.15,
                    "thickness_m": 0.0003, "friction": 0.3, "damping_per_s": 6, "source": "this test"}},
                 "folds": [{{"vertices": [2, 7, 12, 17, 22], "angle_degrees": -60}}]}}"#
        );
        place.write("scene.json", scene);
        place.ends_with_words(0, "simulate scene.json --out out", "");
        let x = positions(&place, 180);
        let at = |v: usize| glam::Vec3::from_slice(&x[3 * v..]);
        // The front of this cloth is its lower side.
        let (one, other) = (at(0) - at(2), at(4) - at(2));
        let angle = 180.0 - one.angle_between(other).to_degrees();
        assert!((angle - 60.0).abs() < 0.05, "{solver}: {angle}");
        assert!(one.y + other.y > 0.0, "{solver}: to the back, which is up");
    }
}

#[test]
fn a_rising_floor_lifts_the_cloth() {
    let place = Place::new();
    place.write("cloth.obj", square(true));
    let names: Vec<String> = (0..=30).map(|i| format!("floor{i}.obj")).collect();
    for (i, name) in names.iter().enumerate() {
        place.write(name, floor(0.99 + 0.01 * i as f64));
    }
    let list = serde_json::to_string(&names).expect("JSON");
    place.write(
        "scene.json",
        format!(r#"{{"cloth": "cloth.obj", "collider": {list}, "seconds": 0.5, "thickness_m": 0.002}}"#),
    );
    place.ends_with_words(0, "simulate scene.json --out out", "");
    let lowest = positions(&place, 30).chunks_exact(3).map(|p| p[1]).fold(f32::MAX, f32::min);
    assert!(lowest > 1.2915, "{lowest}");
}

#[test]
fn bad_scenes_are_told() {
    let place = Place::new();
    place.write("cloth.obj", square(true));
    place.write("half.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2 3\n");
    for (scene, words) in [
        (r#"{"cloth": "cloth.obj"}"#, "seconds"),
        (r#"{"cloth": "cloth.obj", "seconds": -1}"#, "seconds is -1"),
        (r#"{"cloth": "cloth.obj", "seconds": 1, "fbs": 60}"#, "fbs"),
        (r#"{"cloth": "cloth.obj", "seconds": 1, "pins": [25]}"#, "pin 25: the cloth has vertices 0 to 24"),
        (r#"{"cloth": "cloth.obj", "seconds": 1, "fabric": "tweed"}"#, "there are denim"),
        (r#"{"cloth": "cloth.obj", "seconds": 1, "density_kg_per_m2": 0}"#, "density_kg_per_m2 is 0"),
        (r#"{"cloth": "cloth.obj", "seconds": 1, "seams": [[0, 1]]}"#, "seams"),
        (
            r#"{"cloth": "cloth.obj", "seconds": 1, "folds": [{"vertices": [0, 2], "angle_degrees": 9}]}"#,
            "fold 0: no edge of the cloth joins the vertices 0 and 2",
        ),
        (
            r#"{"cloth": "cloth.obj", "seconds": 1, "folds": [{"vertices": [0, 1], "angle_degrees": 200}]}"#,
            "-180 to 180 degrees",
        ),
        (r#"{"cloth": "half.obj", "seconds": 1}"#, "half.obj: line 5"),
    ] {
        place.write("scene.json", scene);
        place.ends_with_words(3, "simulate scene.json --out out", words);
        assert!(place.names("out").is_empty(), "{scene}");
    }
    place.write("scene.json", r#"{"cloth": "none.obj", "seconds": 1}"#);
    place.ends_with_words(6, "simulate scene.json --out out", "none.obj");
}
