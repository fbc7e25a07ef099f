//! Patterns in and out in every format.

use crate::program::Place;

const SVG: &str =
    r#"<svg xmlns="http://www.w3.org/2000/svg"><path id="front" d="M 0 0 H 500 V 600 H 0 Z"/></svg>"#;

#[test]
fn a_sample_goes_out_in_every_format_and_in_again() {
    let place = Place::new();
    for ending in ["json", "dxf", "svg", "pdf"] {
        let ended = place.run(&format!("export sample:skirt --out skirt.{ending}"));
        assert_eq!(ended.code, 0, "{ending}: {}", ended.err);
        let has_seams = ending == "json";
        let lost = ended.err.lines().any(|line| line.ends_with("seams: not in the file"));
        assert_eq!(lost, !has_seams, "{ending}: {}", ended.err);
    }
    for ending in ["json", "dxf", "svg"] {
        let found = place.run(&format!("check skirt.{ending} --json"));
        let findings: serde_json::Value = serde_json::from_str(&found.out).expect(&found.err);
        // Nothing is wrong with the pieces; only in the JSON they are sewn.
        let problems = findings["problems"].as_array().expect("a list");
        let unsewn = problems.iter().filter(|p| p["kind"] == "piece_unsewn").count();
        assert_eq!((problems.len(), unsewn > 0), (unsewn, ending != "json"), "{ending}: {}", found.out);
        assert!(findings["pieces"].as_u64() >= Some(2), "{ending}: {}", found.out);
    }
    assert!(place.path("skirt.pdf").metadata().expect("the PDF").len() > 10_000);
}

#[test]
fn the_scale_of_a_drawing_is_asked_for_and_taken() {
    let place = Place::new();
    place.write("front.svg", SVG);
    place.ends_with_words(3, "check front.svg", "its unit may be mm (the largest piece is 50.0 × 60.0 cm)");
    place.ends_with_words(3, "check front.svg", "say which with --scale");
    let ended = place.run("check front.svg --scale mm");
    assert_eq!(ended.code, 0, "{}", ended.err);
    let ended = place.run("import front.svg --scale mm -o front.toile");
    assert_eq!(ended.code, 0, "{}", ended.err);
    let ended = place.run("export front.svg --scale px -o front.dxf");
    assert_eq!(ended.code, 0, "{}", ended.err);
    place.ends_with_words(2, "check front.svg --scale ell", "is none of mm");
}

#[test]
fn other_endings_and_papers_are_usage() {
    let place = Place::new();
    place.ends_with_words(2, "export sample:skirt -o skirt.png", ".pdf, .svg, .dxf or .json");
    place.ends_with_words(2, "export sample:skirt -o skirt.pdf --paper a5", "none of a4, letter, one");
}

#[test]
fn garments_are_generated_the_same_each_time() {
    let place = Place::new();
    let of = "--count 6 --body-sizes m --kinds hooded,trousers";
    place.ends(0, &format!("generate {of} --poses a,t --out one"));
    place.ends(0, &format!("generate {of} --poses a,t --out two"));
    let names = place.names("one");
    assert_eq!(names.len(), 15, "twelve patterns, the sizes and two lists: {names:?}");
    for name in &names {
        assert_eq!(place.read(&format!("one/{name}")), place.read(&format!("two/{name}")), "{name}");
    }
    assert_eq!(place.read("one/corpus.jsonl").lines().count(), 12);
    let file = names.iter().find(|name| name.ends_with("hooded-m-t.json")).expect("a hooded top");
    assert!(place.json(&format!("one/{file}"))["pattern"]["panels"]["hood left"]["translation"].is_array());
    place.ends(0, &format!("check one/{file} --sizes one/sizes.csv --body-size m --pose t"));
    place.ends(0, &format!("generate {of} --poses t --without-placement --out bare"));
    assert!(place.json(&format!("bare/{file}"))["pattern"]["panels"]["hood left"]["translation"].is_null());
}
