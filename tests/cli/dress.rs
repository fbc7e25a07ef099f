//! dress, render and export.

use crate::program::{Place, adapter_required};

#[test]
fn a_project_is_dressed_without_an_adapter() {
    let place = Place::with_ball();
    let done = place.ends(0, "dress ball.toile --out out --save dressed.toile");
    assert!(done.out.starts_with("ball: dressed, "), "{done:#?}");
    assert!(done.err.contains("view.png left out"), "{done:#?}");
    assert_eq!(place.names("out"), ["body.obj", "garment.obj", "report.json"]);
    assert_eq!(place.names(""), ["ball.toile", "dressed.toile", "out"]);
    let report = place.json("out/report.json");
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(report["inputs"][0], "ball.toile");
    assert_eq!(report["unmapped_vertices"], 0);
    assert_eq!(report["faults"].as_array().map(Vec::len), Some(0));
    assert!(report["strain"]["p99"].as_f64().is_some_and(|s| s < 0.25));
    assert_eq!(report["at_rest"], true);
    assert!(report["marks"][0]["stretch"].as_f64().is_some_and(|s| s.abs() < 0.05));
    assert!(report["ticks"].as_u64().is_some_and(|t| t > 1 && report["counters"]["ticks"] == t));
    assert!(report["state_hash"].as_str().is_some_and(|h| h.len() == 16));
    assert!(report["seconds"]["total"].as_f64().is_some_and(|s| s > 0.0 && s < 60.0));
    assert!(report["pictures_left_out"].as_str().is_some_and(|w| w.contains("adapter")));
    let garment = place.read("out/garment.obj");
    assert_eq!(garment.lines().filter(|l| l.starts_with("o ")).collect::<Vec<_>>(), ["o left", "o right"]);
    let faces = garment.lines().filter(|l| l.starts_with("f ")).count();
    assert_eq!(report["triangles"], faces as u64);
    // The saved project is dressed: it can be exported and checked again.
    place.ends(0, "export dressed.toile -o cloth.obj");
    let without_materials = |text: &str| {
        let kept =
            text.lines().filter(|l| !["mtllib", "usemtl"].contains(&l.split(' ').next().unwrap_or_default()));
        kept.map(|l| format!("{l}\n")).collect::<String>()
    };
    assert_eq!(without_materials(&place.read("cloth.obj")), garment);
    place.ends(0, "export dressed.toile -o cloth.GLB");
    assert!(std::fs::read(place.path("cloth.GLB")).expect("read").starts_with(b"glTF"));
    place.ends_with_words(3, "export ball.toile -o cloth2.obj", "no dressed cloth");
    place.ends_with_words(5, "render dressed.toile -o view.png", "adapter");
    place.ends(0, "check dressed.toile");
}

#[test]
fn the_report_is_printed_and_the_same_on_any_number_of_threads() {
    let place = Place::with_ball();
    let hash = |threads: u32| {
        let done = place.ends(0, &format!("dress ball.toile --json --out out --threads {threads}"));
        let report: serde_json::Value =
            serde_json::from_str(&done.out).expect("nothing else on standard output");
        assert_eq!(report, place.json("out/report.json"));
        (report["state_hash"].clone(), place.read("out/garment.obj"))
    };
    let one = hash(1);
    assert!(one == hash(2) && one == hash(8));
}

#[test]
fn what_cannot_be_dressed_is_told_and_writes_nothing() {
    let place = Place::new();
    let mut project = crate::common::project();
    project.document.marks = Default::default();
    place.save("unmarked.toile", &project);
    place.ends_with_words(3, "dress unmarked.toile --out out", "no pair of marks");
    place.ends_with_words(3, "dress unmarked.toile --out out", "place its pieces (Shift+B)");
    std::sync::Arc::make_mut(&mut project.document.pattern).seams.clear();
    place.save("unsewn.toile", &project);
    place.ends_with_words(3, "dress unsewn.toile --out out", "sew its edges and place its pieces");
    place.save("ball.toile", &crate::common::project());
    place.ends_with_words(4, "dress ball.toile --out out --max-ticks 2", "after 2 ticks");
    assert!(place.names("out").is_empty());
    place.write("file", "");
    place.ends_with_words(6, "dress ball.toile --out file/out", "file");
    for length in ["7", "-1", "wide"] {
        let typed = format!("dress ball.toile --out out --edge-length {length}");
        place.ends_with_words(2, &typed, "0.002 to 0.2 metres");
    }
}

#[test]
fn marks_come_from_a_file() {
    let place = Place::new();
    let project = crate::common::project();
    let marks = toile::session::marks_file::write(&project.document.marks, &project.document.pattern);
    place.write("marks.json", marks.expect("json"));
    let mut unmarked = project;
    unmarked.document.marks = Default::default();
    place.save("unmarked.toile", &unmarked);
    place.save("marked.toile", &crate::common::project());
    place.ends(0, "dress unmarked.toile --marks marks.json --out out");
    place.ends(0, "dress marked.toile --out out2");
    assert_eq!(place.read("out/garment.obj"), place.read("out2/garment.obj"));
}

#[test]
fn cloth_is_drawn_in_the_fabric_colour_and_print_that_are_asked_for() {
    let place = Place::with_ball();
    place.ends(0, "dress ball.toile --out out --save dressed.toile");
    let plain = place.draws("render dressed.toile -o plain.png --size 120x120");
    if plain.code == 5 && !adapter_required() {
        println!("no graphics adapter: pictures not tested");
        return;
    }
    let options = ["", "--fabric denim-11oz", "--colour ff0000", "--colour ff0000 --print checks:60:ffffff"];
    let pictures = options.map(|options| {
        let done = place.draws(&format!("render dressed.toile {options} -o out.png --size 120x120"));
        assert_eq!(done.code, 0, "{options}: {}", done.err);
        std::fs::read(place.path("out.png")).expect("a picture")
    });
    for (i, picture) in pictures.iter().enumerate() {
        assert!(!pictures[..i].contains(picture), "{:?} changes nothing", options[i]);
    }
    let form = place.draws("render dressed.toile --body-look form -o form.png --size 120x120");
    assert_eq!(form.code, 0, "{}", form.err);
    assert!(!pictures.contains(&std::fs::read(place.path("form.png")).expect("a picture")), "linen");
    place.draws("render dressed.toile --supersample 2 -o fine.png --size 120x120");
    let fine = std::fs::read(place.path("fine.png")).expect("a picture");
    let picture = image::load_from_memory(&fine).expect("a picture");
    assert_eq!((picture.width(), picture.height()), (120, 120));
    assert!(!pictures.contains(&fine), "smoother");
    let fails = |options: &str, words: &str| {
        place.ends_with_words(2, &format!("render dressed.toile {options} -o out.png"), words);
    };
    fails("--colourway red", "red");
    fails("--fabric rubber", "rubber");
    fails("--colour red", "hexadecimal");
    fails("--print checks:0:ffffff", "repeats");
    fails("--print plaid:20:ffffff", "plaid");
    fails("--supersample 9", "9");
    fails("--body-look clay", "skin, form");
}

#[test]
fn an_environment_map_lights_pictures_and_is_rotated() {
    let place = Place::with_ball();
    place.ends(0, "dress ball.toile --out out --save dressed.toile");
    let plain = place.draws("render dressed.toile -o out.png --size 120x120");
    if plain.code == 5 && !adapter_required() {
        println!("no graphics adapter: pictures not tested");
        return;
    }
    let image = |name: &str, width: u32| {
        let garden =
            image::RgbImage::from_fn(width, 16, |x, y| image::Rgb([8 * x as u8, 200 - 9 * y as u8, 40]));
        garden.save(place.path(name)).expect("written");
    };
    image("garden.png", 32);
    image("square.png", 16);
    let garden = "--environment garden.png";
    let options = [
        String::new(),
        garden.to_owned(),
        format!("{garden} --environment-rotation 90"),
        format!("{garden} --environment-rotation 202.5"),
    ];
    let pictures = options.each_ref().map(|options| {
        let done = place.draws(&format!("render dressed.toile {options} -o out.png --size 120x120"));
        assert_eq!(done.code, 0, "{options}: {}", done.err);
        std::fs::read(place.path("out.png")).expect("a picture")
    });
    for (i, picture) in pictures.iter().enumerate() {
        assert!(!pictures[..i].contains(picture), "{:?} changes nothing", options[i]);
    }
    let refused = |code, options: &str, words: &str| {
        place.ends_with_words(code, &format!("render dressed.toile {options} -o out.png"), words);
    };
    refused(
        3,
        "--environment square.png",
        "square.png: it has 16 by 16 pixels; an image of all directions is twice as wide",
    );
    refused(3, "--environment dressed.toile", "neither PNG, JPEG nor Radiance HDR");
    refused(6, "--environment nowhere.hdr", "nowhere.hdr");
    refused(2, &format!("{garden} --environment-rotation 361"), "0 to 360");
    refused(2, "--environment-rotation 90", "--environment <IMAGE>");
}

#[test]
fn pictures_are_drawn_where_there_is_an_adapter() {
    let place = Place::with_ball();
    let first = place.draws("render ball.toile -o view.png --size 200x100");
    if first.code == 5 && !adapter_required() {
        println!("no graphics adapter: pictures not tested");
        return;
    }
    assert_eq!(first.code, 0, "{first:#?}");
    let size = |name: &str| {
        let bytes = std::fs::read(place.path(name)).expect("read");
        let picture = image::load_from_memory(&bytes).expect("a picture");
        (picture.width(), picture.height())
    };
    assert_eq!(size("view.png"), (200, 100));
    let done = place.draws("render ball.toile -o turn.png --size 64x64 --turntable 3 --view -20,10");
    assert_eq!(done.code, 0, "{done:#?}");
    assert_eq!(place.names(""), ["ball.toile", "turn-00.png", "turn-01.png", "turn-02.png", "view.png"]);
    let done = place.draws("dress ball.toile --out out --size 64x64");
    assert_eq!((done.code, size("out/view.png")), (0, (64, 64)), "{done:#?}");
    assert!(place.json("out/report.json").get("pictures_left_out").is_none());
}
