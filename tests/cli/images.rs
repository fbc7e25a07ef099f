//! Images on cloth by the command line: drawn, dressed, exported.

use image::{Rgba, RgbaImage};

use crate::program::{Place, adapter_required};
use crate::textures::{Scene, bounds, dressed, is_near};

const RED: [u8; 3] = [220, 20, 30];
const BLUE: [u8; 3] = [20, 40, 210];

/// "logo.png": 40 x 20 pixels, its left half red, its right half blue, the upper half transparent.
fn logo(place: &Place) {
    let picture = RgbaImage::from_fn(40, 20, |x, y| {
        let [r, g, b] = if x < 20 { RED } else { BLUE };
        Rgba([r, g, b, if y < 10 { 0 } else { 255 }])
    });
    picture.save(place.path("logo.png")).expect("written");
}

/// The colour of the texture of `piece`, which is 0.25 x 0.3 m, at a place of it.
fn colour(scene: &Scene, piece: &str, [x, y]: [f32; 2]) -> [u8; 3] {
    let (places, image) = scene.outside(piece);
    let [low, high] = bounds(&places);
    let image = image.expect("base colours");
    let side = image.width() as f32;
    let u = low[0] + x / 0.25 * (high[0] - low[0]);
    let v = high[1] - y / 0.3 * (high[1] - low[1]);
    image.get_pixel((u * side) as u32, (v * side) as u32).0
}

#[test]
fn a_graphic_is_exported_where_it_was_placed() {
    let place = dressed();
    logo(&place);
    place.ends(0, "export dressed.toile -o cloth.glb --textures 512 --colour f0f0f0 --graphic logo.png:left:0.1,0.2:0.1:90");
    let scene = Scene::read(&place, "cloth.glb");
    // Turned by a quarter to the left: the lower half of the image is on the right, its left half below.
    for (at, wanted) in
        [([0.11, 0.18], RED), ([0.11, 0.22], BLUE), ([0.09, 0.2], [0xf0; 3]), ([0.2, 0.2], [0xf0; 3])]
    {
        let found = colour(&scene, "left", at);
        assert!(is_near(found, wanted, 16), "{at:?}: {found:?}, not {wanted:?}");
    }
    assert!(is_near(colour(&scene, "right", [0.11, 0.18]), [0xf0; 3], 16), "only on its own piece");
}

#[test]
fn an_image_is_repeated_all_over_the_cloth() {
    let place = dressed();
    logo(&place);
    place.ends(0, "export dressed.toile -o cloth.glb --textures 512 --colour f0f0f0 --image logo.png:100");
    let scene = Scene::read(&place, "cloth.glb");
    // A repeat is 0.1 x 0.05 m with its middle at the origin.
    for repeat in [0.0, 0.1] {
        for (x, wanted) in [(0.02, BLUE), (0.08, RED)] {
            for piece in ["left", "right"] {
                let found = colour(&scene, piece, [x + repeat, 0.05 - 0.012]);
                assert!(is_near(found, wanted, 16), "{piece} {x} {repeat}: {found:?}, not {wanted:?}");
            }
        }
    }
}

#[test]
fn a_dressed_project_keeps_its_graphic_and_bad_ones_are_told() {
    let place = dressed();
    logo(&place);
    place.ends(0, "dress ball.toile --graphic logo.png:right:0.1,0.2:0.1 --out two --save printed.toile");
    place.ends(0, "export printed.toile -o cloth.glb --textures 256");
    let found = colour(&Scene::read(&place, "cloth.glb"), "right", [0.08, 0.19]);
    assert!(is_near(found, RED, 24), "{found:?}");
    place.write("words.png", "no picture");
    for (options, code, words) in [
        ("--graphic words.png:left:0,0:0.1", 3, "neither PNG nor JPEG"),
        ("--graphic none.png:left:0,0:0.1", 6, "none.png"),
        ("--graphic logo.png:sleeve:0,0:0.1", 2, "there are left, right"),
        ("--graphic logo.png:left:0,0:80", 2, "80 m wide"),
        ("--graphic logo.png:left:0,9:0.1", 2, "would lie beside \"left\""),
        ("--image logo.png", 2, "FILE:WIDTH_MM"),
    ] {
        place.ends_with_words(code, &format!("export dressed.toile -o x.glb {options}"), words);
    }
}

#[test]
fn images_are_drawn() {
    let place = dressed();
    logo(&place);
    let drawn = |name: &str, options: &str| {
        let done =
            place.draws(&format!("render dressed.toile -o {name}.png --size 400x400 --view front {options}"));
        if done.code == 5 && !adapter_required() {
            println!("skipped: no graphics adapter");
            return None;
        }
        assert_eq!(done.code, 0, "{done:#?}");
        Some(image::open(place.path(&format!("{name}.png"))).expect("a picture").to_rgb8())
    };
    let Some(plain) = drawn("plain", "--colour f0f0f0") else { return };
    let art = drawn("art", "--colour f0f0f0 --graphic logo.png:left:0.125,0.15:0.2").expect("an adapter");
    let coloured = |image: &image::RgbImage, k: usize| {
        image.pixels().filter(|p| (0..3).all(|j| j == k || i32::from(p[k]) > i32::from(p[j]) + 60)).count()
    };
    assert_eq!([coloured(&plain, 0), coloured(&plain, 2)], [0, 0]);
    let [red, blue] = [coloured(&art, 0), coloured(&art, 2)];
    assert!(red > 50 && blue > 50 && red.abs_diff(blue) < red / 2, "{red} {blue}");
}
