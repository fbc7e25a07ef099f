//! Bodies in files: units, faults, imports.

use crate::program::Place;

/// The ball as OBJ text, `scale` times as large.
fn ball(scale: f64, rings: u32, sectors: u32) -> String {
    let mesh = crate::common::ball(0.75 * scale, rings, sectors);
    let mut text = String::new();
    for p in &mesh.positions {
        text += &format!("v {} {} {}\n", p.x, p.y, p.z);
    }
    for [a, b, c] in &mesh.triangles {
        text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
    }
    text
}

fn place() -> Place {
    let place = Place::with_ball();
    let project = crate::common::project();
    let marks = toile::session::marks_file::write(&project.document.marks, &project.document.pattern);
    place.write("marks.json", marks.expect("json"));
    place.write("metres.obj", ball(1.0, 24, 48));
    place.write("centimetres.obj", ball(100.0, 24, 48));
    place
}

#[test]
fn a_body_is_measured() {
    let place = Place::new();
    let table = place.ends(0, "measure sample:tshirt").out;
    assert_eq!(table, place.ends(0, "measure mannequin").out, "which the sample is made for");
    assert!(table.lines().any(|line| line.starts_with("waist") && line.contains("70.6 cm")), "{table}");
    let told: serde_json::Value =
        serde_json::from_str(&place.ends(0, "measure sample:tshirt --json").out).expect("JSON");
    let hip =
        told["readings"].as_array().expect("a list").iter().find(|r| r["name"] == "hip").expect("a hip");
    assert!((hip["metres"].as_f64().expect("a number") - 0.98).abs() < 0.01);
    place.write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    place.ends_with_words(3, "measure box.obj --unit m", "does not look like a standing human");
}

#[test]
fn the_mannequin_is_made_to_a_size_of_a_table() {
    let place = Place::new();
    place.write(
        "sizes.csv",
        "size,height,bust,waist (mm),hip\n36,168,84,660,90\n44,172,104,840,110\n60,172,190,,\n",
    );
    let measured = |size: &str, name: &str| {
        let run = format!("measure --sizes sizes.csv --body-size {size} --json");
        let told: serde_json::Value = serde_json::from_str(&place.ends(0, &run).out).expect("JSON");
        assert_eq!(told["body"], size);
        let reading =
            told["readings"].as_array().expect("a list").iter().find(|r| r["name"] == name).cloned();
        reading.expect(name)["metres"].as_f64().expect("a number")
    };
    for (size, name, metres) in
        [("36", "bust", 0.84), ("36", "waist", 0.66), ("44", "bust", 1.04), ("44", "hip", 1.1)]
    {
        let is = measured(size, name);
        assert!((is - metres).abs() < 0.01, "{size} {name}: {is}");
    }
    let dress =
        |size: &str| format!("dress sample:skirt --sizes sizes.csv --body-size {size} --edge-length 0.04");
    place.run(&format!("{} --out 36 --save 36.toile", dress("36")));
    let height =
        |name: &str| crate::repose::vertices(&place.read(name)).iter().map(|p| p.y).fold(0.0, f64::max);
    assert!((height("36/body.obj") - 1.68).abs() < 0.005);
    assert!(place.json("36/report.json")["inputs"].to_string().contains("sizes.csv"));
    // In the pose it is in.
    place.run(&format!("{} --pose t --out t", dress("36")));
    let reach =
        |name: &str| crate::repose::vertices(&place.read(name)).iter().map(|p| p.x).fold(0.0, f64::max);
    assert!(reach("t/body.obj") > reach("36/body.obj") + 0.1);
    for (code, run, words) in [
        (
            3,
            format!("{} --out x", dress("38")),
            "sizes.csv: there is no size \"38\" in it; there are 36, 44, 60",
        ),
        (
            3,
            format!("{} --out x", dress("60")),
            "sizes.csv: row 4, column 3 (bust): size 60: bust is 190.0 cm; a mannequin",
        ),
        (2, format!("{} --body mannequin --out x", dress("36")), "cannot be used with"),
        (2, "measure --sizes sizes.csv".to_owned(), "--body-size"),
        (2, "measure sample:skirt --sizes sizes.csv --body-size 36".to_owned(), "leave the file out"),
        (6, "measure --sizes nowhere.csv --body-size 36".to_owned(), "nowhere.csv"),
    ] {
        place.ends_with_words(code, &run, words);
    }
}

#[test]
fn the_unit_is_given_or_told_by_the_height() {
    let place = place();
    let dress = "dress ball.toile --marks marks.json --out";
    place.ends(0, &format!("{dress} a --body metres.obj"));
    let told = place.ends(0, &format!("{dress} b --body centimetres.obj"));
    assert!(told.err.contains("taken to be in cm"), "{told:#?}");
    let given = place.ends(0, &format!("{dress} c --body centimetres.obj --unit cm"));
    assert!(!given.err.contains("taken to be"), "{given:#?}");
    let strain = |folder: &str| place.json(&format!("{folder}/report.json"))["mark_error"]["max"].as_f64();
    assert!(strain("a").is_some_and(|a| strain("b").is_some_and(|b| (a - b).abs() < 1e-6)));
    place.write("speck.obj", ball(1e-5, 6, 8));
    place.ends_with_words(3, "check speck.obj", "--unit");
    place.ends_with_words(2, &format!("{dress} d --body metres.obj --unit furlong"), "furlong");
    place.ends_with_words(2, &format!("{dress} d --body metres.obj --up x"), "no axis that points up");
}

#[test]
fn another_body_takes_marks_over_or_tells_which_it_cannot() {
    let place = place();
    place.ends(0, "dress ball.toile --body metres.obj --out out");
    place.write("coarse.obj", ball(1.0, 12, 24));
    place.ends_with_words(
        3,
        "dress ball.toile --body coarse.obj --out out",
        "mark 1: it could not be carried",
    );
    place.ends_with_words(3, "dress ball.toile --body coarse.obj --out out", "no pair of marks");
    place.ends_with_words(3, "dress metres.obj --out out", "this is a body");
}

#[test]
fn open_bodies_are_refused_in_words() {
    let place = place();
    let open: String =
        ball(1.0, 24, 48).lines().filter(|l| *l != "f 1 2 3").map(|l| format!("{l}\n")).collect();
    place.write("open.obj", open);
    let found = place.ends(1, "check open.obj");
    assert!(found.out.contains("open"), "{found:#?}");
    place.ends_with_words(3, "dress ball.toile --marks marks.json --body open.obj --out out", "open");
    place.ends_with_words(3, "import open.obj -o p.toile", "open");
    place.ends(0, "check metres.obj");
}

#[test]
fn pattern_body_and_marks_become_a_project() {
    let place = place();
    place.write(
        "tee.json",
        r#"{"pattern": {"panels": {"left": {"vertices": [[0, 0], [25, 0], [25, 30], [0, 30]], "edges": [
            {"endpoints": [0, 1]}, {"endpoints": [1, 2]}, {"endpoints": [2, 3]}, {"endpoints": [3, 0]}],
            "translation": [0, 0, 90], "rotation": [0, 0, 0]}}, "stitches": []},
            "properties": {"units_in_meter": 100, "curvature_coords": "relative"}}"#,
    );
    let done = place.ends(0, "import tee.json metres.obj --marks marks.json -o p.toile");
    assert!(done.out.contains("1 pieces, 0 seams, 1 pairs of marks, body: metres"), "{done:#?}");
    place.ends(0, "dress p.toile --edge-length 0.06 --out out");
    place.ends_with_words(3, "import p.toile -o q.toile", "a project already");
    place.ends_with_words(
        2,
        "import metres.obj centimetres.obj -o q.toile",
        "at most one pattern and one body",
    );
    let found = place.ends(0, "check p.toile --json");
    let found: serde_json::Value = serde_json::from_str(&found.out).expect("JSON");
    assert_eq!((found["pieces"].as_u64(), found["seams"].as_u64()), (Some(1), Some(0)));
    assert!(found["triangles"].as_u64().is_some_and(|n| n > 100), "{found}");
    let pair = &found["marks"][0];
    assert!(pair["number"] == 1 && pair["cloth"].as_f64().is_some_and(|l| l > 0.05), "{found}");
    let found = place.ends(0, "check p.toile");
    assert!(found.out.contains("mark 1: ") && found.out.contains("cm on the body"), "{found:#?}");
    let lost = place.ends(1, "check p.toile --body mannequin");
    assert!(lost.err.contains("mark 1: it could not be carried to mannequin"), "{lost:#?}");
}

#[test]
fn tables_of_sizes_are_built_in() {
    let place = Place::new();
    place.ends(0, "export sizes:children -o children.csv");
    let table = place.read("children.csv");
    assert!(table.starts_with("size,height,bust,waist,hip\n98,98.0,"), "{table}");
    assert_eq!(table.lines().count(), 13, "a header and twelve sizes");
    // The table and the file are the same bodies, with a child's measurements.
    let measured = |sizes: &str| {
        let run = format!("measure --sizes {sizes} --body-size 116 --json");
        let told: serde_json::Value = serde_json::from_str(&place.ends(0, &run).out).expect("JSON");
        told["readings"].clone()
    };
    let readings = measured("sizes:children");
    assert_eq!(readings, measured("children.csv"));
    let waist = readings.as_array().expect("a list").iter().find(|r| r["name"] == "waist").expect("a waist");
    assert!((waist["metres"].as_f64().expect("a number") - 0.56).abs() < 0.01, "{waist}");
    place.ends_with_words(2, "export sizes:children -o children.dxf", "the ending must be .csv");
    place.ends_with_words(
        3,
        "export sizes:teens -o x.csv",
        "no such table of sizes; there are adults, children",
    );
}
