use glam::{DAffine2, DVec2};

use super::*;
use crate::io::atlas::Atlas;
use crate::io::dressed::tests::{trimmed_squares, two_squares};
use crate::io::materials::{ClothTextures, TextureImage, Textures};

/// A colour, the inner side, and a weave.
fn textured() -> Colours {
    let images = ["colour", "inside", "weave-1"];
    let images = images.map(|name| TextureImage { name: name.to_owned(), png: Arc::new(name.into()) });
    let textures =
        Textures { images: images.to_vec(), atlas: Atlas::default(), weave_from_piece: Default::default() };
    Colours { textures: Some(Arc::new(textures)), ..Colours::default() }
}

fn denim() -> ClothMaterial {
    ClothMaterial {
        name: "denim 11 oz".to_owned(),
        sides: [[0.25, 0.5, 0.75], [0.0; 3]],
        roughness: 0.75,
        opacity: 1.0,
        textures: Some(ClothTextures { sides: [0, 1], normal: None, weave: Some(2) }),
    }
}

/// A square of two triangles.
fn square() -> PieceArrays {
    let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    PieceArrays {
        positions: corners.map(|p| p.extend(0.25)).to_vec(),
        normals: vec![DVec3::Z; 4],
        uv: corners.map(|p| p * 0.5).to_vec(),
        weave: corners.map(|p| DAffine2::from_scale(DVec2::splat(400.0)).transform_point2(p)).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}

fn scene(colours: &Colours) -> UsdScene {
    let image_path = |name: &str| format!("shirt-{name}.png");
    let mut builder = Builder::new(colours, &image_path);
    builder.piece("front left", &square(), &denim(), &[]);
    builder.finish(&[]).expect("a scene")
}

#[test]
fn two_triangles_with_textures_are_written_so() {
    let colours = textured();
    let scene = scene(&colours);
    let text = scene.text();
    assert_eq!(text, include_str!("two_triangles.usda"), "{text}");
    let names: Vec<&str> = scene.images().iter().map(|(path, _)| path.as_str()).collect();
    assert_eq!(names.len(), 2, "the inner side is not seen: {names:?}");
    assert!(
        scene.images().iter().any(|(path, png)| path == "shirt-colour.png" && png.as_slice() == b"colour")
    );
}

#[test]
fn a_package_begins_with_its_scene() {
    let scene = scene(&textured());
    let package = scene.package().expect("a package");
    assert_eq!(package, scene.package().expect("a package"), "without the time of day");
    let mut zip = zip::ZipArchive::new(std::io::Cursor::new(package)).expect("a zip");
    let name = |i| zip.by_index(i).expect("a file").name().expect("a name").to_string();
    let names: Vec<String> = (0..3).map(name).collect();
    assert_eq!(names, [IN_PACKAGE, "shirt-colour.png", "shirt-weave-1.png"]);
}

#[test]
fn pieces_of_one_name_and_the_body_are_told_apart() {
    let (pattern, mut garment, state) = two_squares();
    for (_, name) in &mut garment.pieces {
        *name = "body".to_owned();
    }
    let body = TriMesh { positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y], triangles: vec![[0, 1, 2]] };
    let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &[] };
    let scene = UsdScene::new(dressed, Some(&body), &Colours::default(), str::to_owned).expect("a scene");
    let text = scene.text();
    for name in ["body", "body_2", "body_3"] {
        assert!(text.contains(&format!("def Mesh \"{name}\" (")), "{text}");
    }
    assert_eq!(text.matches("displayName = \"body\"").count(), 2, "{text}");
    assert_eq!(text.matches("def Material").count(), 2, "cloth and skin: {text}");
    assert!(scene.images().is_empty());
}

#[test]
fn cloth_not_yet_on_the_body_is_left_out() {
    let (pattern, garment, mut state) = two_squares();
    state.mapped.fill(false);
    state.positions.fill(DVec3::NAN);
    let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &[] };
    let written = UsdScene::new(dressed, None, &Colours::default(), str::to_owned);
    assert!(matches!(written, Err(UsdError::Empty)));
}

#[test]
fn every_frame_has_its_time() {
    let (pattern, garment, state) = two_squares();
    let body = TriMesh { positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y], triangles: vec![[0, 1, 2]] };
    let frame = |i: usize| {
        let moved = |points: &[DVec3]| points.iter().map(|p| *p + DVec3::Y * i as f64).collect();
        Frame { cloth: moved(&state.positions), body: moved(&body.positions) }
    };
    let frames: Vec<Frame> = (0..3).map(frame).collect();
    let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &[] };
    let scene =
        UsdScene::moving(dressed, &body, &frames, 25.0, &Colours::default(), str::to_owned).expect("a scene");
    let text = scene.text();
    for words in ["startTimeCode = 0\n", "endTimeCode = 2\n", "timeCodesPerSecond = 25\n", "upAxis = \"Y\"\n"]
    {
        assert!(text.contains(words), "{words} in {text}");
    }
    assert_eq!(text.matches("points.timeSamples").count(), 3, "{text}");
    let last = "2: [(0, 2, 0), (1, 2, 0), (0, 3, 0)], }\n";
    assert!(text.contains(last), "{text}");
    let nothing = UsdScene::moving(dressed, &body, &[], 25.0, &Colours::default(), str::to_owned);
    assert!(matches!(nothing, Err(UsdError::Empty)));
}

#[test]
fn trims_are_meshes_with_materials_of_their_own_that_move() {
    let (pattern, garment, state, trims) = trimmed_squares();
    let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &trims };
    let still = UsdScene::new(dressed, None, &Colours::default(), str::to_owned).expect("a scene");
    for name in ["Piping", "Button", "Button_thread", "Buttonhole", "Stitches"] {
        assert!(still.text().contains(&format!("def Mesh \"{name}\" (")), "{name}: {}", still.text());
        assert!(still.text().contains(&format!("def Material \"{name}\"")), "{name}: {}", still.text());
    }
    assert_eq!(still.text().matches("def Mesh").count(), 2 + trims.len());
    let frame = |i: usize| Frame {
        cloth: state.positions.iter().map(|p| *p + DVec3::Y * i as f64).collect(),
        body: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
    };
    let frames: Vec<Frame> = (0..2).map(frame).collect();
    let body = TriMesh { positions: frames[0].body.clone(), triangles: vec![[0, 1, 2]] };
    let image_path = |name: &str| format!("textures/{name}.png");
    let moving = UsdScene::moving(dressed, &body, &frames, 25.0, &textured(), image_path).expect("a scene");
    assert_eq!(moving.text().matches("points.timeSamples").count(), 2 + trims.len() + 1);
    let without = UsdScene::new(Dressed { trims: &[], ..dressed }, None, &Colours::default(), str::to_owned);
    assert_eq!(without.expect("a scene").text().matches("def Mesh").count(), 2);
}

#[test]
fn moving_cloth_keeps_its_textures() {
    let (pattern, garment, state) = two_squares();
    let body = TriMesh { positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y], triangles: vec![[0, 1, 2]] };
    let frame = || Frame { cloth: state.positions.clone(), body: body.positions.clone() };
    let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &[] };
    let colours = Colours { pieces: pattern.pieces.keys().map(|&id| (id, denim())).collect(), ..textured() };
    let image_path = |name: &str| format!("textures/{name}.png");
    let frames = [frame(), frame()];
    let scene = UsdScene::moving(dressed, &body, &frames, 25.0, &colours, image_path).expect("a scene");
    let names: Vec<&str> = scene.images().iter().map(|(path, _)| path.as_str()).collect();
    assert_eq!(names, ["textures/colour.png", "textures/weave-1.png"]);
    assert_eq!(scene.text().matches("@./textures/colour.png@").count(), 1, "one material for both");
}
