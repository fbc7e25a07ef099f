//! Dressed cloth with materials and textures, read back.

use gltf::Gltf;
use image::RgbImage;
use toile::io::cloth_obj;

use crate::program::Place;

/// "dressed.toile": two patches of 0.25 x 0.3 m that lie on each other on the table.
pub fn dressed() -> Place {
    let place = Place::with_ball();
    place.ends(0, "dress ball.toile --out out --save dressed.toile");
    place
}

/// A GLB file, its buffer, and its images.
pub struct Scene {
    gltf: Gltf,
    data: Vec<u8>,
}

/// Texture coordinates of a mesh.
pub type Places = Vec<[f32; 2]>;

impl Scene {
    pub fn read(place: &Place, name: &str) -> Self {
        let bytes = std::fs::read(place.path(name)).expect("the file");
        let mut gltf = Gltf::from_slice(&bytes).expect("glTF");
        let data = gltf.blob.take().expect("a buffer");
        Self { gltf, data }
    }

    fn image(&self, image: &gltf::Image<'_>) -> RgbImage {
        let gltf::image::Source::View { view, mime_type } = image.source() else { panic!("an image inside") };
        assert_eq!(mime_type, "image/png");
        let bytes = &self.data[view.offset()..view.offset() + view.length()];
        image::load_from_memory(bytes).expect("a picture").to_rgb8()
    }

    fn images(&self) -> Vec<(String, RgbImage)> {
        self.gltf.images().map(|i| (i.name().unwrap_or_default().to_owned(), self.image(&i))).collect()
    }

    /// The first primitive (the outside) of the mesh `name`: its texture coordinates, and the base colours of its material.
    pub fn outside(&self, name: &str) -> (Places, Option<RgbImage>) {
        let mesh = self.gltf.meshes().find(|m| m.name() == Some(name)).expect("a mesh");
        let outside = mesh.primitives().next().expect("the outside");
        let reader = outside.reader(|_| Some(&self.data));
        let places = reader.read_tex_coords(0).expect("texture coordinates").into_f32().collect();
        let texture = outside.material().pbr_metallic_roughness().base_color_texture();
        (places, texture.map(|info| self.image(&info.texture().source())))
    }
}

/// The normals of an OBJ file.
pub fn normals(text: &str) -> Vec<[f32; 3]> {
    let row = |line: &str| -> Vec<f32> { line.split(' ').map(|w| w.parse().expect("a number")).collect() };
    text.lines()
        .filter_map(|line| line.strip_prefix("vn "))
        .map(|line| row(line).try_into().expect("three numbers"))
        .collect()
}

/// The least and greatest of each coordinate.
pub fn bounds(places: &[[f32; 2]]) -> [[f32; 2]; 2] {
    let by = |f: fn(f32, f32) -> f32, start: f32| [0, 1].map(|k| places.iter().map(|p| p[k]).fold(start, f));
    [by(f32::min, f32::MAX), by(f32::max, f32::MIN)]
}

pub fn is_near(found: [u8; 3], wanted: [u8; 3], most: i32) -> bool {
    found.iter().zip(wanted).all(|(a, b)| (i32::from(*a) - i32::from(b)).abs() <= most)
}

#[test]
fn a_glb_has_the_print_of_each_piece_where_the_pattern_has_it() {
    let place = dressed();
    place.ends(
        0,
        "export dressed.toile -o cloth.glb --textures 512 --colour 204080 --print stripes:50:f0e0c0",
    );
    let scene = Scene::read(&place, "cloth.glb");
    let names: Vec<String> = scene.images().into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["colour", "weave-1", "inside"], "the order in which materials name them");
    for piece in ["left", "right"] {
        let (places, image) = scene.outside(piece);
        let [low, high] = bounds(&places);
        assert!(low.iter().chain(&high).all(|c| (0.0..=1.0).contains(c)), "{low:?} {high:?}");
        let image = image.expect("base colours");
        assert_eq!(image.dimensions(), (512, 512));
        // The piece is 0.25 x 0.3 m and lies as on the table: the texture has its corners at those of the box.
        for (x, y, wanted) in [
            (0.025, 0.15, [0xf0, 0xe0, 0xc0]),
            (0.05, 0.02, [0x20, 0x40, 0x80]),
            (0.225, 0.28, [0xf0, 0xe0, 0xc0]),
            (0.1, 0.15, [0x20, 0x40, 0x80]),
        ] {
            let u = low[0] + x / 0.25 * (high[0] - low[0]);
            let v = high[1] - y / 0.3 * (high[1] - low[1]);
            let found = image.get_pixel((u * 512.0) as u32, (v * 512.0) as u32).0;
            assert!(is_near(found, wanted, 16), "{piece} at {x}, {y}: {found:?}, not {wanted:?}");
        }
    }
    // The pieces lie on each other on the table: in the texture they do not.
    let [one, other] = ["left", "right"].map(|piece| bounds(&scene.outside(piece).0));
    let apart = (0..2).any(|k| one[1][k] < other[0][k] || other[1][k] < one[0][k]);
    assert!(apart, "{one:?} {other:?}");
}

#[test]
fn the_weave_is_a_tile_with_coordinates_of_its_own() {
    let place = dressed();
    place.ends(0, "export dressed.toile -o cloth.glb --textures 64 --fabric denim-11oz");
    let scene = Scene::read(&place, "cloth.glb");
    let mesh = scene.gltf.meshes().find(|m| m.name() == Some("left")).expect("a mesh");
    let outside = mesh.primitives().next().expect("the outside");
    let normal = outside.material().normal_texture().expect("a normal map");
    assert_eq!(normal.tex_coord(), 1);
    let reader = outside.reader(|_| Some(&scene.data));
    let places: Places = reader.read_tex_coords(1).expect("a second set").into_f32().collect();
    let [low, high] = bounds(&places);
    // Twill repeats after four threads of 0.6 mm.
    assert!((high[0] - low[0] - 0.25 / 0.0024).abs() < 0.1, "{low:?} {high:?}");
    let tile = scene.image(&normal.texture().source());
    let blue = tile.pixels().filter(|p| p[2] > 128).count();
    assert!(blue == tile.pixels().len(), "all point out of the cloth");
    assert!(outside.material().pbr_metallic_roughness().roughness_factor() < 0.9);
}

#[test]
fn textures_may_be_left_out_or_one_for_each_piece() {
    let place = dressed();
    place.ends(0, "export dressed.toile -o plain.glb --textures 0 --colour 204080");
    let plain = Scene::read(&place, "plain.glb");
    assert!(plain.images().is_empty() && plain.outside("left").1.is_none());
    place.ends(0, "export dressed.toile -o pieces.glb --textures 64 --atlas pieces");
    let pieces = Scene::read(&place, "pieces.glb");
    let colours = pieces.images().into_iter().filter(|(name, _)| name.starts_with("colour")).count();
    assert_eq!(colours, 2);
    let [low, high] = bounds(&pieces.outside("right").0);
    assert!((high[1] - low[1]) > 0.98, "it fills its texture: {low:?} {high:?}");
    place.ends_with_words(2, "export dressed.toile -o x.glb --textures 7", "from 16 to 8192");
    place.ends_with_words(
        2,
        "export dressed.toile -o x.glb --atlas tight",
        "none of pattern, packed, pieces",
    );
    for options in ["--textures 64", "--fabric denim-11oz"] {
        place.ends_with_words(
            2,
            &format!("export dressed.toile -o flat.svg {options}"),
            "are of dressed cloth",
        );
    }
}

#[test]
fn an_obj_has_its_materials_and_their_images_beside_it() {
    let place = dressed();
    place.ends(0, "export dressed.toile -o cloth.obj --fabric denim-11oz");
    assert_eq!(place.names(""), ["ball.toile", "cloth.mtl", "cloth.obj", "dressed.toile", "out"]);
    let text = place.read("cloth.mtl");
    assert!(
        text.contains("newmtl denim-11oz\n") && text.contains("Pr 0.750\n") && !text.contains("map_Kd"),
        "{text}"
    );
    let in_metres_text = place.read("cloth.obj");
    let in_metres = cloth_obj::read(in_metres_text.as_bytes()).expect("cloth");
    assert!(in_metres_text.contains("mtllib cloth.mtl\n"));
    place.ends(0, "export dressed.toile -o cloth.obj --fabric Denim-11oz --textures 128");
    let text = place.read("cloth.mtl");
    for line in
        ["map_Kd cloth-colour.png\n", "norm cloth-normal.png\n", "map_Bump -bm 1.0 cloth-normal.png\n"]
    {
        assert!(text.contains(line), "{text}");
    }
    for name in ["cloth-colour.png", "cloth-normal.png"] {
        let image = image::open(place.path(name)).expect("a picture");
        assert_eq!((image.width(), image.height()), (128, 128));
    }
    let in_texture = cloth_obj::read(place.read("cloth.obj").as_bytes()).expect("cloth");
    assert_eq!(in_texture.mesh, in_metres.mesh);
    assert_eq!(normals(&place.read("cloth.obj")), normals(&in_metres_text));
    let rest = in_texture.rest.expect("texture coordinates");
    assert!(rest.iter().flatten().all(|p| p.min_element() >= 0.0 && p.max_element() <= 1.0));
    assert!(rest.iter().flatten().map(|p| p.x).fold(0.0, f64::max) > 0.9, "the atlas is filled");
}

#[test]
fn an_obj_without_textures_tells_that_prints_are_not_in_it() {
    let place = dressed();
    let told = |options: &str| {
        let done = place.ends(0, &format!("export dressed.toile -o cloth.obj {options}"));
        done.err.lines().filter(|line| line.contains("prints, images and graphics are not in it")).count()
    };
    let printed = "--print stripes:20:a82a30";
    assert_eq!(told(printed), 1);
    for options in
        ["--colour a82a30".to_owned(), format!("{printed} --textures 64"), format!("{printed} --textures 0")]
    {
        assert_eq!(told(&options), 0, "{options}");
    }
}

#[test]
fn an_obj_has_the_normals_of_a_glb() {
    let place = dressed();
    place.ends(0, "export dressed.toile -o cloth.obj --no-trims");
    place.ends(0, "export dressed.toile -o cloth.glb --textures 0 --no-trims");
    let scene = Scene::read(&place, "cloth.glb");
    let of_piece = |name: &str| -> Vec<[f32; 3]> {
        let mesh = scene.gltf.meshes().find(|m| m.name() == Some(name)).expect("a mesh");
        let outside = mesh.primitives().next().expect("the outside");
        outside.reader(|_| Some(&scene.data)).read_normals().expect("normals").collect()
    };
    let (wanted, found) = (["left", "right"].map(of_piece).concat(), normals(&place.read("cloth.obj")));
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(&wanted) {
        assert!((0..3).all(|k| (found[k] - wanted[k]).abs() < 1e-6), "{found:?}, not {wanted:?}");
    }
}
