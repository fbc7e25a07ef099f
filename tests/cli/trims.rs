//! Buttons, piping and stitches in exported cloth, still and moving.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use gltf::Gltf;
use toile::pattern::{Button, PiecePoint, Piping, Topstitch};

use crate::program::Place;
use crate::repose::vertices;

/// The names of the trims of [`trimmed`], in the order of files.
pub const NAMES: [&str; 5] = ["Piping", "Button", "Button thread", "Buttonhole", "Stitches"];

/// "dressed.toile": two patches on a ball; the first, "left", has piping, a row of stitches and an unfastened button.
pub fn trimmed() -> Place {
    let place = Place::new();
    let mut project = crate::common::project();
    let pattern = Arc::make_mut(&mut project.document.pattern);
    let id = *pattern.pieces.keys().next().expect("a piece");
    let piece = Arc::make_mut(pattern.pieces.get_mut(&id).expect("the piece"));
    piece.outline[0].trims.piping = Some(Piping::USUAL);
    piece.outline[3].trims.topstitch = Some(Topstitch::default());
    let at = |x: f64| PiecePoint { piece: id, at: DVec2::new(x, 0.15) };
    let (diameter, colour) = (Button::SHIRT, Button::PEARL);
    pattern.add_button(Button {
        button: at(0.08),
        hole: at(0.17),
        diameter,
        colour,
        open: true,
        tack: false,
    });
    place.save("ball.toile", &project);
    place.run("dress ball.toile --out out --save dressed.toile");
    assert!(place.names("").contains(&"dressed.toile".to_owned()));
    place
}

/// Names of the meshes of a GLB, each with the box round its first primitive.
fn meshes(place: &Place, name: &str) -> Vec<(String, [DVec3; 2])> {
    let gltf = Gltf::open(place.path(name)).expect("glTF");
    let boxed = |mesh: gltf::Mesh<'_>| {
        let first = mesh.primitives().next().expect("a primitive");
        let bounds = first.bounding_box();
        let corner = |at: [f32; 3]| DVec3::from_array(at.map(f64::from));
        (mesh.name().unwrap_or_default().to_owned(), [corner(bounds.min), corner(bounds.max)])
    };
    gltf.meshes().map(boxed).collect()
}

#[test]
fn a_glb_has_the_trims_on_the_cloth_unless_they_are_not_wanted() {
    let place = trimmed();
    place.ends(0, "export dressed.toile -o cloth.glb --textures 16");
    let all = meshes(&place, "cloth.glb");
    let names: Vec<&str> = all.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, [&["left", "right"][..], &NAMES, &["body"]].concat());
    let [low, high] = all[0].1;
    let near = 0.005;
    for (name, [least, most]) in &all[2..7] {
        assert!(
            least.cmpge(low - near).all() && most.cmple(high + near).all(),
            "{name} is on the cloth: {least} to {most} within {low} to {high}"
        );
    }
    let size = |i: usize| (all[i].1[1] - all[i].1[0]).length();
    assert!((0.2..0.27).contains(&size(2)), "piping along 0.25 m: {}", size(2));
    assert!((0.009..0.018).contains(&size(3)), "a button of 11 mm: {}", size(3));
    assert!((0.25..0.32).contains(&size(6)), "stitches along 0.3 m: {}", size(6));
    place.ends(0, "export dressed.toile -o plain.glb --textures 16 --no-trims");
    let plain: Vec<String> = meshes(&place, "plain.glb").into_iter().map(|(name, _)| name).collect();
    assert_eq!(plain, ["left", "right", "body"]);
    place.ends_with_words(2, "export dressed.toile -o flat.svg --no-trims", "are of dressed cloth");
    let still = "repose dressed.toile --body out/body.obj --no-trims --out x";
    place.ends_with_words(2, still, "--sequence or --motion");
}

#[test]
fn an_obj_has_the_trims_with_their_materials_after_the_cloth() {
    let place = trimmed();
    place.ends(0, "export dressed.toile -o cloth.obj");
    let (text, materials) = (place.read("cloth.obj"), place.read("cloth.mtl"));
    for name in NAMES.map(|name| name.replace(' ', "_")) {
        assert!(text.contains(&format!("\no {name}\nusemtl {name}\n")), "{name}");
        assert!(materials.contains(&format!("\nnewmtl {name}\n")), "{name}: {materials}");
    }
    place.ends(0, "export dressed.toile -o cloth.obj --no-trims");
    let plain = place.read("cloth.obj");
    assert!(
        text.starts_with(&plain) && !plain.contains("Piping") && !place.read("cloth.mtl").contains("Piping")
    );
    assert!(vertices(&text).len() > vertices(&plain).len() + 500);
}

#[test]
fn trims_and_textures_go_along_with_moving_cloth() {
    let place = trimmed();
    std::fs::create_dir(place.path("frames")).expect("a folder");
    for i in 0..3 {
        let there = |p: DVec3| p + DVec3::Y * (0.05 * f64::from(i));
        place.write(&format!("frames/ball{i}.obj"), crate::repose::moved(&place.read("out/body.obj"), there));
    }
    let run = "repose dressed.toile --sequence --body frames --unit m --usd --out posed";
    let ended = place.run(&format!("{run} --textures 32"));
    assert!([0, 1].contains(&ended.code), "{ended:#?}");
    let gltf = Gltf::open(place.path("posed/sequence.glb")).expect("glTF");
    let names: Vec<&str> = gltf.meshes().filter_map(|mesh| mesh.name()).collect();
    assert_eq!(names, [&["left", "right"][..], &NAMES, &["body"]].concat());
    let images: Vec<&str> = gltf.images().filter_map(|image| image.name()).collect();
    assert!(images.contains(&"colour") && images.contains(&"inside"), "{images:?}");
    for mesh in gltf.meshes() {
        let first = mesh.primitives().next().expect("a primitive");
        assert_eq!(first.morph_targets().count(), 2, "{:?}", mesh.name());
        let has_colours = first.material().pbr_metallic_roughness().base_color_texture().is_some();
        assert_eq!(has_colours, ["left", "right"].map(Some).contains(&mesh.name()), "{:?}", mesh.name());
    }
    let files = crate::usd::unpacked(&place, "posed/sequence.usdz");
    assert!(files.contains_key("textures/colour.png"), "{:?}", files.keys());
    let text = String::from_utf8_lossy(&files["garment.usda"]);
    assert_eq!(text.matches("points.timeSamples").count(), 2 + NAMES.len() + 1);
    place.run(&format!("{run} --textures 0 --no-trims"));
    let plain = Gltf::open(place.path("posed/sequence.glb")).expect("glTF");
    assert_eq!((plain.meshes().len(), plain.images().len()), (3, 0));
}
