//! `toile compare` from outside.

use crate::program::{Place, adapter_required};

/// The ball dressed at two edge lengths, in "coarse.toile" and "fine.toile".
fn two() -> Place {
    let place = Place::with_ball();
    for (edge, name) in [("0.06", "coarse"), ("0.03", "fine")] {
        place.run(&format!("dress ball.toile --edge-length {edge} --out {name} --save {name}.toile"));
    }
    place
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn a_garment_does_not_differ_from_itself() {
    let place = two();
    place.ends(0, "compare coarse.toile coarse.toile --map all --out same");
    let figures = place.json("same/compare.json");
    let maps = figures["maps"].as_array().expect("maps");
    assert_eq!(maps.len(), 9);
    for map in maps {
        for change in map["pieces"].as_array().expect("pieces").iter().chain([&map["all"]]) {
            assert!(number(&change["max"]) < 1e-6, "{map}");
        }
    }
    assert_eq!(figures["area"][0], figures["area"][1]);
    assert!(number(&figures["area"][0]) > 0.1);
}

#[test]
fn other_meshes_are_matched_by_place() {
    let place = two();
    let told = place.ends(0, "compare coarse.toile fine.toile --map ease --map strain --out out").out;
    assert!(told.contains("Ease: gap to the body: mean "), "{told}");
    let figures = place.json("out/compare.json");
    let [coarse, fine] = [0, 1].map(|k| number(&figures["triangles"][k]));
    assert!(fine > 3.0 * coarse, "{coarse} {fine}");
    let ease = figures["maps"]
        .as_array()
        .and_then(|maps| maps.iter().find(|map| map["map"] == "ease"))
        .expect("ease");
    let [first, second, mean] = ["first", "second", "mean"].map(|name| number(&ease["all"][name]));
    assert!((second - first - mean).abs() < 1e-9, "{ease}");
    // Both lie on the same ball: the gap is the same but for the sag of the coarse edges.
    assert!(first > 1.0 && mean.abs() < 0.5 * first, "{ease}");
    let rows = place.read("out/ease.csv");
    assert_eq!(
        rows.lines().next(),
        Some("piece,u_m,v_m,vertex,first_ease_mm,second_ease_mm,difference_ease_mm")
    );
    for row in rows.lines().skip(1) {
        let cells: Vec<f64> = row.split(',').skip(4).map(|cell| cell.parse().expect("a number")).collect();
        assert!((cells[1] - cells[0] - cells[2]).abs() < 2e-6, "{row}");
    }
    let pieces = place.read("out/pieces.csv");
    assert_eq!(pieces.lines().filter(|row| row.starts_with("ease,mm,")).count(), 3, "{pieces}");
    assert_eq!(pieces.lines().filter(|row| row.starts_with("area,m2,")).count(), 2, "{pieces}");
    assert_eq!(
        place.names("out"),
        [
            "area.csv",
            "compare.json",
            "ease.csv",
            "girths.csv",
            "pieces.csv",
            "shear.csv",
            "warp.csv",
            "weft.csv"
        ]
    );
}

#[test]
fn other_pieces_are_refused_by_name() {
    let place = two();
    place.run("dress sample:scarf --out out --save scarf.toile");
    place.ends_with_words(
        3,
        "compare fine.toile scarf.toile --map ease --out no",
        "the second has no piece \"left\", \"right\"",
    );
    place.ends_with_words(3, "compare fine.toile ball.toile --map ease --out no", "dress it first");
    assert!(place.names("no").is_empty());
}

#[test]
fn three_pictures_stand_side_by_side() {
    let place = two();
    let arguments = "compare coarse.toile fine.toile --map ease --out out --size 200x160";
    let run = place.draws(arguments);
    assert_eq!(run.code, 0, "{run:?}");
    if place.json("out/compare.json")["pictures_left_out"].is_string() && !adapter_required() {
        println!("no graphics adapter: pictures not tested");
        return;
    }
    let picture = image::open(place.path("out/ease.png")).expect("a picture");
    assert_eq!([picture.width(), picture.height()], [600, 160]);
}
