//! Markers: what lies on them, what they take, and what is refused.

use glam::DVec2;
use toile::io::svg;
use toile::marker::nest::check::distance;
use toile::pattern::{Pattern, Piece};

use crate::program::Place;

/// What was printed with --json.
fn report(out: &str) -> serde_json::Value {
    serde_json::from_str(out).expect("a report")
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The pieces of a marker written as SVG.
fn pieces_in(place: &Place, name: &str) -> Pattern {
    svg::read(place.read(name).as_bytes(), None).expect("an SVG of ours").pattern
}

/// The cutting line of a piece where it lies.
fn on_cloth(piece: &Piece) -> Vec<DVec2> {
    toile::io::cutting_line(piece, 1e-4).into_iter().map(|p| piece.pose.plane_from_piece(p)).collect()
}

/// All pieces lie apart by the gap and on the cloth, their grain along it; with a nap all the same way.
fn holds(pattern: &Pattern, [length, width]: [f64; 2], gap: f64, is_one_way: bool) {
    let outlines: Vec<Vec<DVec2>> = pattern.pieces.values().map(|piece| on_cloth(piece)).collect();
    let lower = outlines.iter().flatten().copied().reduce(DVec2::min).expect("a point");
    let upper = outlines.iter().flatten().copied().reduce(DVec2::max).expect("a point");
    assert!((upper - lower).cmple(DVec2::new(length, width) + 1e-5).all(), "{lower} {upper}");
    for (i, outline) in outlines.iter().enumerate() {
        for other in &outlines[..i] {
            let apart = distance(outline, other);
            // Chords are up to 0.1 mm from the curves.
            assert!(apart >= gap - 2.2e-4, "{apart} m apart");
        }
    }
    for piece in pattern.pieces.values() {
        let [tail, head] = piece.grainline.expect("a grainline").map(|p| piece.pose.plane_from_piece(p));
        let way = (head - tail).normalize();
        assert!(way.y.abs() < 1e-6 && (!is_one_way || way.x > 0.0), "{}: {way}", piece.name);
    }
}

#[test]
fn samples_are_laid_out_apart_and_better_than_their_boxes() {
    let place = Place::new();
    for (sample, pieces) in [("tshirt", 4), ("skirt", 4), ("trousers", 6), ("dress", 4)] {
        for options in ["", "--nap"] {
            let run = format!(
                "marker sample:{sample} --width 1.5 --quantity 2 --seconds 0.2 --json -o m.svg {options}"
            );
            let report = report(&place.ends(0, run.trim()).out);
            let [length, plain] = ["length", "plain_length"].map(|name| number(&report[name]));
            assert!(length <= plain + 1e-9 && length <= plain * 0.99, "{sample}: {length} for {plain}");
            let cloth = number(&report["area"]) / (length * 1.5) * 100.0;
            assert!((cloth - number(&report["yield_percent"])).abs() < 1e-6);
            assert!((number(&report["length_per_garment"]) - length / 2.0).abs() < 1e-12);
            let pattern = pieces_in(&place, "m.svg");
            assert_eq!(
                (pattern.pieces.len(), report["places"].as_array().map(Vec::len)),
                (2 * pieces, Some(2 * pieces))
            );
            holds(&pattern, [length, 1.5], 0.003, options == "--nap");
        }
    }
}

#[test]
fn sizes_and_quantities_are_cut_with_their_names() {
    let place = crate::sizes::place();
    let one = place.ends(0, "marker skirt.toile --width 1.5 --sizes S,L --seconds 0.2 --json -o m.svg").out;
    let rows = report(&one)["pieces"].as_array().expect("a piece list").clone();
    assert_eq!(rows.len(), 8);
    let area = |size: &str| -> f64 {
        rows.iter().filter(|row| row["size"] == size).map(|row| number(&row["area"])).sum()
    };
    assert!(area("L") > area("S") * 1.05, "the larger size has more cloth");
    let names: Vec<String> =
        pieces_in(&place, "m.svg").pieces.values().map(|piece| piece.name.clone()).collect();
    assert!(names.iter().any(|name| name.ends_with(" S")) && names.iter().any(|name| name.ends_with(" L")));
    let several = "marker skirt.toile --width 1.5 --quantity S=2 --quantity L=1 --seconds 0.2 -o m.svg";
    let words = place.ends(0, several).out;
    assert!(words.contains("12 pieces, garments: 2 × S, 1 × L;"), "{words}");
    assert_eq!(pieces_in(&place, "m.svg").pieces.len(), 12);
}

#[test]
fn the_same_order_gives_the_same_bits_in_every_format() {
    let place = Place::new();
    for (ending, seconds) in [("svg", 0.3), ("dxf", 0.03), ("pdf", 0.03)] {
        let run = |threads: usize, seed: u64| {
            let words = format!(
                "marker sample:trousers --width 1.4 --seconds {seconds} --seed {seed} --threads {threads} -o m.{ending}"
            );
            place.ends(0, &words);
            std::fs::read(place.path(&format!("m.{ending}"))).expect("a file")
        };
        assert!(run(1, 7) == run(3, 7), "{ending}");
    }
    let dxf = place.read("m.dxf");
    assert_eq!(dxf.matches("PIECE NAME:").count(), 6);
    place.ends(0, "import m.dxf -o again.toile");
    // Longer than a PDF page may be: several pages and an overview.
    place.ends(0, "marker sample:trousers --width 0.6 --quantity 3 --seconds 0 -o long.pdf");
    let pdf = lopdf::Document::load(place.path("long.pdf")).expect("a PDF");
    assert!(pdf.get_pages().len() > 2, "{} pages", pdf.get_pages().len());
}

#[test]
fn allowances_are_laid_out_too() {
    let place = Place::new();
    let mut pattern = Pattern::default();
    for name in ["left", "right"] {
        let corners = [(0.0, 0.0), (0.3, 0.0), (0.3, 0.5), (0.0, 0.5)].map(DVec2::from);
        pattern.add_piece(Piece { allowance: 0.01, ..Piece::polygon(name, &corners) });
    }
    place.write("two.svg", svg::write(&pattern).bytes);
    // The grain of both is along the cloth: 0.52 m, and across it twice 0.32 and the gap; round corners are laid out by chords
    // that are 0.2 mm outside.
    let run = |width: &str| {
        let words = format!("marker two.svg --width {width} --gap 0.005 --seconds 0.1 --json -o m.svg");
        number(&report(&place.ends(0, &words).out)["length"])
    };
    assert!((run("0.647") - 0.52).abs() < 1e-3, "{}", run("0.647"));
    assert!((run("0.6") - 1.045).abs() < 1e-3, "{}", run("0.6"));
    place.ends_with_words(
        3,
        "marker two.svg --width 0.3 -o m.svg",
        "\"left\" needs cloth of 32.0 cm, and this is 30.0 cm wide",
    );
}

#[test]
fn what_cannot_be_laid_out_is_told() {
    let place = crate::sizes::place();
    for (code, run, words) in [
        (2, "marker sample:skirt --width 0 -o m.svg", "is no width of cloth"),
        (2, "marker sample:skirt --width -1 -o m.svg", ""),
        (2, "marker sample:skirt --width 1.5 -o m.png", "must be .svg, .dxf or .pdf"),
        (2, "marker sample:skirt --width 1.5 --gap 3 -o m.svg", "a gap of 3 m"),
        (
            2,
            "marker sample:skirt --width 1.5 --quantity many -o m.svg",
            "is no quantity: it is written SIZE=N",
        ),
        (2, "marker skirt.toile --width 1.5 --sizes S --quantity 2 -o m.svg", "cannot be used with"),
        (3, "marker sample:skirt --width 0.1 -o m.svg", "needs cloth of"),
        (3, "marker sample:skirt --width 1.5 --sizes S -o m.svg", "the pattern has no sizes"),
        (3, "marker skirt.toile --width 1.5 --sizes S,XXL -o m.svg", "no size \"XXL\": it has S, M, L"),
        (3, "marker skirt.toile --width 1.5 --quantity M=0 -o m.svg", "no garment is asked for"),
        (4, "marker skirt.toile --width 1.5 --quantity M=101 -o m.svg", "404 pieces would be cut"),
        (
            4,
            "marker skirt.toile --width 1.5 --quantity M=18446744073709551615 -o m.svg",
            "pieces would be cut",
        ),
    ] {
        place.ends_with_words(code, run, words);
    }
    assert!(!place.path("m.svg").exists());
}
