//! Depth of field of pictures.

use crate::program::{Place, adapter_required, ended};

#[test]
fn a_lens_blurs_what_is_out_of_focus() {
    let place = Place::with_ball();
    let plain = place.draws("render ball.toile -o plain.png --size 120x120");
    if plain.code == 5 && !adapter_required() {
        println!("no graphics adapter: pictures not tested");
        return;
    }
    assert_eq!(plain.code, 0, "{plain:#?}");
    let draw = |options: &str| {
        let done = place.draws(&format!("render ball.toile {options} -o out.png --size 120x120"));
        assert_eq!(done.code, 0, "{options}: {}", done.err);
        std::fs::read(place.path("out.png")).expect("a picture")
    };
    let sharp = std::fs::read(place.path("plain.png")).expect("a picture");
    assert!(draw("") == sharp);
    assert!(draw("--f-number 22") == sharp, "stopped down, no circle of confusion is as wide as a pixel");
    let [near, nearer] = ["0.3", "0.1"].map(|focus| draw(&format!("--f-number 1.4 --focus {focus}")));
    assert!(near != sharp && nearer != sharp);
    assert!(draw("--f-number 1.4 --focus 0.3") == near, "the same again");
    assert!(draw("--f-number 1.4 --focus 0.3 --transparent --supersample 2") != near);
}

#[test]
fn no_other_lens_is_accepted() {
    let place = Place::with_ball();
    let refused = |options: &str, words: &str| {
        place.ends_with_words(2, &format!("render ball.toile {options} -o out.png"), words);
    };
    for number in ["1.3", "23", "0", "wide", "NaN"] {
        refused(&format!("--f-number {number}"), "is not an f-number from 1.4 to 22");
    }
    for focus in ["0", "2000", "far", "inf"] {
        refused(&format!("--f-number 4 --focus {focus}"), "is not a distance in metres from 0.01 to 1000");
    }
    refused("--focus 2", "--f-number <NUMBER>");
    assert_eq!(place.names(""), ["ball.toile"]);
}

#[test]
fn opengl_draws_all_but_depth_of_field_and_says_so() {
    let place = Place::with_ball();
    let draw = |options: &str| {
        let task = format!("render ball.toile {options} -o opengl.png --size 120x120");
        ended(place.command(&task).env("WGPU_BACKEND", "gl").output().expect("the program starts"))
    };
    let plain = draw("");
    if plain.code == 5 && plain.err.contains("no graphics adapter was found") {
        println!("no OpenGL: its pictures not tested");
        return;
    }
    assert_eq!(plain.code, 0, "{plain:#?}");
    assert!(!plain.err.contains("graphics:"), "{}", plain.err);
    let picture = image::open(place.path("opengl.png")).expect("a picture").to_rgb8();
    let [middle, corner] = [(60, 60), (2, 2)].map(|(x, y)| picture.get_pixel(x, y));
    assert!(middle != corner, "a ball before the background: {middle:?}");
    let blurred = draw("--f-number 1.4");
    assert_eq!(blurred.code, 5, "{blurred:#?}");
    assert!(blurred.err.contains("draws by OpenGL, which cannot draw depth of field"), "{}", blurred.err);
}
