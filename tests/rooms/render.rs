//! The renderer against known pictures. Without a graphics adapter the picture tests say so and pass.

use std::sync::Arc;
use std::time::Duration;

use glam::{UVec2, Vec2, Vec3};
use image::RgbaImage;
use toile::cloth::{Fabric, FabricLook, Weave};
use toile::render::{
    BODY, CLOTH_BACK, CLOTH_FRONT, Camera, Fineness, Ground, ImageLight, Label, Light, Look, MEAN_LIGHT,
    Mesh, Polyline, RenderError, Scene, Studio, Textile, View, framed,
};
use toile::ui::scenery::fabric_looks::textile;

const SIZE: UVec2 = UVec2::new(320, 240);

pub(crate) fn studio() -> Option<Studio> {
    match Studio::new() {
        Ok(studio) => Some(studio),
        Err(RenderError::NoAdapter(why)) => {
            println!("skipped: no graphics adapter ({why})");
            None
        }
        Err(other) => panic!("{other}"),
    }
}

/// A sphere of radius `r`; its front is outside.
fn sphere(r: f32, front: [u8; 3], back: [u8; 3]) -> Mesh {
    let (rings, sides) = (48u32, 96u32);
    let mut mesh = Mesh { front, back, ..Default::default() };
    for i in 0..=rings {
        let a = std::f32::consts::PI * i as f32 / rings as f32;
        for j in 0..sides {
            let b = std::f32::consts::TAU * j as f32 / sides as f32;
            mesh.positions.push(Vec3::new(a.sin() * b.sin(), a.cos(), a.sin() * b.cos()) * r);
        }
    }
    for i in 0..rings {
        for j in 0..sides {
            let at = |i: u32, j: u32| i * sides + j % sides;
            let (p, q, s, t) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            mesh.triangles.push([p, q, s]);
            mesh.triangles.push([p, s, t]);
        }
    }
    mesh
}

fn pixel(image: &image::RgbaImage, x: u32, y: u32) -> [i32; 3] {
    let p = image.get_pixel(x, y).0;
    [p[0], p[1], p[2]].map(i32::from)
}

#[test]
fn a_sphere_is_green_in_the_middle_and_background_at_the_corner() {
    let Some(mut studio) = studio() else { return };
    let scene = Scene { meshes: vec![Arc::new(sphere(0.5, CLOTH_FRONT, CLOTH_BACK))], ..Default::default() };
    let look = Look::light();
    let image = studio.picture(&scene, View::Front, &look, SIZE).expect("a picture");
    let [r, g, b] = pixel(&image, 160, 120);
    assert!(g > r + 20 && g > b + 20, "{r} {g} {b}");
    for (x, y, want) in [(0, 0, look.sky), (319, 239, look.horizon)] {
        let got = pixel(&image, x, y);
        for k in 0..3 {
            assert!((got[k] - i32::from(want[k])).abs() <= 2, "{got:?} {want:?}");
        }
    }
    // The sphere touches neither edge, and fills most of the height.
    assert!(pixel(&image, 160, 1)[1] > 220);
    let [_, g, b] = pixel(&image, 160, 48);
    assert!(g > b + 10, "the sphere should reach up here");
}

#[test]
fn the_back_of_cloth_shows_its_own_colour() {
    let Some(mut studio) = studio() else { return };
    let mut inside_out = sphere(0.5, CLOTH_FRONT, CLOTH_BACK);
    inside_out.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    let scene = Scene { meshes: vec![Arc::new(inside_out)], ..Default::default() };
    let image = studio.picture(&scene, View::Left, &Look::dark(), SIZE).expect("a picture");
    let [r, g, b] = pixel(&image, 160, 120);
    // Paler than the front, whose red and blue are 50 below its green.
    assert!(r > 160 && (5..25).contains(&(g - r)) && (5..30).contains(&(g - b)), "{r} {g} {b}");
}

#[test]
fn cloth_four_millimetres_off_the_skin_never_lets_it_through() {
    let Some(mut studio) = studio() else { return };
    let skin = sphere(0.9, [255, 0, 0], [255, 0, 0]);
    let cloth = sphere(0.904, [0, 255, 0], [0, 255, 0]);
    let scene = Scene { meshes: vec![Arc::new(skin), Arc::new(cloth)], ..Default::default() };
    let mut camera = Camera::framing(Vec3::splat(-0.9), Vec3::splat(0.9), View::ThreeQuarter, 4.0 / 3.0);
    for (projection, zoom) in [
        (toile::render::Projection::Perspective, 1.0),
        (toile::render::Projection::Perspective, 8.0),
        (toile::render::Projection::Orthographic, 0.1),
    ] {
        camera.projection = projection;
        camera.zoom(zoom, camera.pivot);
        let image = studio.draw(&scene, &camera, &Look::light(), SIZE).expect("a picture");
        let red = image.pixels().filter(|p| i32::from(p[0]) > i32::from(p[1]) + 40).count();
        assert_eq!(red, 0, "{projection:?}");
        let green = image.pixels().filter(|p| i32::from(p[1]) > i32::from(p[0]) + 40).count();
        assert!(green > 200, "{green}");
    }
}

#[test]
fn lines_lie_on_the_surface_and_hide_behind_it() {
    let Some(mut studio) = studio() else { return };
    let blue = |z: f32| Polyline {
        points: vec![Vec3::new(-0.1, 0.0, z), Vec3::new(0.1, 0.0, z)],
        colour: [0, 0, 255, 255],
        width: 5.0,
        halo: [255, 255, 255, 255],
        halo_width: 2.0,
        lift: 0.02,
        ..Default::default()
    };
    let count = |studio: &mut Studio, lines, view| {
        let scene = Scene { meshes: vec![Arc::new(sphere(0.5, BODY, BODY))], lines, ..Default::default() };
        let image = studio.picture(&scene, view, &Look::light(), SIZE).expect("a picture");
        image.pixels().filter(|p| p[2] > 200 && p[0] < 60).count()
    };
    let seen = count(&mut studio, vec![blue(0.495)], View::Front);
    assert!((100..600).contains(&seen), "{seen}");
    assert_eq!(count(&mut studio, vec![blue(0.495)], View::Back), 0);
}

#[test]
fn a_number_is_drawn_beside_its_anchor() {
    let Some(mut studio) = studio() else { return };
    let label = Label {
        anchor: Vec3::new(0.0, 0.0, 0.5),
        offset: Vec2::new(0.0, 20.0),
        text: "8".to_owned(),
        height: 16.0,
        colour: [0, 0, 255, 255],
        halo: [255, 255, 255, 255],
        lift: 0.05,
    };
    let scene = Scene {
        meshes: vec![Arc::new(sphere(0.5, BODY, BODY))],
        labels: vec![label],
        ground: Some(Ground { height: -0.5, centre: Vec2::ZERO, radius: 2.0 }),
        ..Default::default()
    };
    let image = studio.picture(&scene, View::Front, &Look::light(), SIZE).expect("a picture");
    let (mut count, mut low, mut high) = (0, u32::MAX, 0);
    for (_, y, _) in image.enumerate_pixels().filter(|(_, _, p)| p[2] > 180 && p[0] < 70) {
        (count, low, high) = (count + 1, low.min(y), high.max(y));
    }
    assert!(count > 200, "{count}");
    assert!(low >= 84 && high <= 116, "{low}..{high}");
    // White strokes of the digit on the badge.
    let white = (90..110).filter(|&y| image.get_pixel(160, y)[0] > 230).count();
    assert!((3..12).contains(&white), "{white}");
}

/// A square of cloth with sides of `side` metres that faces the eye.
fn swatch(look: &FabricLook, side: f32) -> Mesh {
    let flat = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y].map(|p| (p - 0.5) * side);
    let triangles = vec![[0u32, 1, 2], [0, 2, 3]];
    Mesh {
        positions: flat.map(|p| p.extend(0.0)).to_vec(),
        flat: triangles.iter().map(|t| t.map(|v| flat[v as usize])).collect(),
        triangles,
        front: look.colour.unwrap_or(CLOTH_FRONT),
        back: CLOTH_BACK,
        cloth: 1.0,
        textile: textile(look),
        ..Mesh::default()
    }
}

/// Mean and standard deviation of the brightness in the middle of a picture of `mesh`, which is saved as `name` in the folder
/// TOILE_PICTURES.
fn brightness(studio: &mut Studio, mesh: Mesh, name: Option<&str>) -> (f64, f64) {
    let scene = Scene { meshes: vec![Arc::new(mesh)], ..Default::default() };
    let image = studio.picture(&scene, View::Front, &Look::light(), SIZE).expect("a picture");
    if let (Some(folder), Some(name)) = (std::env::var_os("TOILE_PICTURES"), name) {
        image.save(std::path::Path::new(&folder).join(format!("{name}.png"))).expect("saved");
    }
    let place = |i: u32| (120 + i % 80, 80 + i / 80);
    let values: Vec<f64> = (0..80 * 80).map(place).map(|(x, y)| f64::from(pixel(&image, x, y)[1])).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    (mean, (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt())
}

#[test]
fn every_fabric_shows_its_weave_from_near_and_no_pattern_of_pixels_from_afar() {
    let Some(mut studio) = studio() else { return };
    for fabric in Fabric::presets() {
        let (name, look) = (&fabric.name, &fabric.look);
        assert!(look.weave != Weave::Smooth, "{name}");
        let (near, rough) = brightness(&mut studio, swatch(look, 12.0 * look.pitch_m as f32), Some(name));
        assert!(rough > 2.0, "{name}: {rough} from near");
        let (far, smooth) = brightness(&mut studio, swatch(look, 600.0 * look.pitch_m as f32), None);
        let open = if look.is_open() { 20.0 } else { 3.0 };
        assert!(smooth < open, "{name}: {smooth} from afar");
        // What threads and gaps are together is what is seen from afar.
        assert!((near - far).abs() < 26.0, "{name}: {near} from near, {far} from afar");
    }
}

#[test]
fn what_lies_behind_is_seen_through_open_cloth_only() {
    let Some(mut studio) = studio() else { return };
    let mut over_black = |name: &str| {
        let look = Fabric::preset(name).expect("a preset").look;
        let cloth = swatch(&look, 0.3);
        let mut wall = Mesh { front: [0; 3], textile: Textile::default(), flat: Vec::new(), ..cloth.clone() };
        wall.positions.iter_mut().for_each(|p| p.z = -0.1);
        let alone = brightness(&mut studio, cloth.clone(), None).0;
        let scene = Scene { meshes: vec![Arc::new(wall), Arc::new(cloth)], ..Default::default() };
        let image = studio.picture(&scene, View::Front, &Look::light(), SIZE).expect("a picture");
        let middle: i32 = (0..400).map(|i| pixel(&image, 150 + i % 20, 110 + i / 20)[1]).sum();
        alone - f64::from(middle) / 400.0
    };
    assert!(over_black("tulle") > 60.0 && over_black("chiffon") > 40.0);
    assert!(over_black("linen").abs() < 6.0);
}

#[test]
fn the_same_scene_gives_the_same_pixels() {
    let Some(mut studio) = studio() else { return };
    let scene = || Scene {
        meshes: vec![Arc::new(sphere(0.5, CLOTH_FRONT, CLOTH_BACK))],
        ground: Some(Ground { height: -0.5, centre: Vec2::ZERO, radius: 2.0 }),
        ..Default::default()
    };
    let mut draw = || studio.picture(&scene(), View::ThreeQuarter, &Look::dark(), SIZE).expect("a picture");
    assert!(draw() == draw());
}

#[test]
fn a_picture_that_is_too_large_is_refused_in_words() {
    let Some(mut studio) = studio() else { return };
    let error = studio
        .picture(&Scene::default(), View::Front, &Look::light(), UVec2::new(1_000_000, 10))
        .expect_err("too large");
    assert!(error.to_string().contains("1000000 x 10 pixels"), "{error}");
}

#[test]
fn an_adapter_that_does_not_answer_is_not_waited_for_without_end() {
    let Some(mut studio) = studio() else { return };
    let scene = Scene { meshes: vec![Arc::new(sphere(0.5, CLOTH_FRONT, CLOTH_BACK))], ..Default::default() };
    studio.set_patience(Duration::ZERO);
    let picture = studio.picture(&scene, View::Front, &Look::light(), UVec2::new(2000, 1500));
    assert!(matches!(picture, Err(RenderError::Timeout(_))), "it was ready at once");
    studio.set_patience(Duration::from_secs(60));
    studio.picture(&scene, View::Front, &Look::light(), SIZE).expect("the next one comes");
}

#[test]
fn a_picture_that_is_cut_out_is_transparent_beside_and_opaque_on_things() {
    let Some(mut studio) = studio() else { return };
    let ground = Some(Ground { height: -0.5, centre: Vec2::ZERO, radius: 2.0 });
    let meshes = vec![Arc::new(sphere(0.5, CLOTH_FRONT, CLOTH_BACK))];
    let scene = Scene { meshes, ground, ..Default::default() };
    let draw = |studio: &mut Studio, cut_out| {
        studio.picture(&scene, View::Front, &Look { cut_out, ..Look::light() }, SIZE).expect("a picture")
    };
    let [whole, cut] = [false, true].map(|cut_out| draw(&mut studio, cut_out));
    assert!(whole.pixels().all(|p| p[3] == 255));
    assert_eq!(cut.get_pixel(0, 0).0, [0; 4]);
    assert_eq!(cut.get_pixel(160, 235).0[3], 0, "no floor");
    assert_eq!(pixel(&cut, 160, 120), pixel(&whole, 160, 120));
    // At its rim the colour is the sphere's own, only thinner.
    let straight = toile::render::straightened(cut.clone());
    let rim = straight.pixels().filter(|p| (40..200).contains(&p[3]));
    let green = rim.filter(|p| p[1] >= p[0] && p[1] > p[2]).count();
    let thin = straight.pixels().filter(|p| (40..200).contains(&p[3])).count();
    assert!(thin > 50 && green * 10 > thin * 9, "{green} of {thin}");
}

#[test]
fn cloth_shows_its_triangles_and_a_body_what_is_behind_it() {
    let Some(mut studio) = studio() else { return };
    let mut cloth = sphere(0.3, [0, 255, 0], [0, 255, 0]);
    cloth.cloth = 1.0;
    let scene = Scene {
        meshes: vec![Arc::new(cloth), Arc::new(sphere(0.5, [255, 0, 0], [255, 0, 0]))],
        ..Default::default()
    };
    let middle = |studio: &mut Studio, look: Look| {
        let image = studio.picture(&scene, View::Front, &look, SIZE).expect("a picture");
        pixel(&image, 160, 120)
    };
    let [_, g, _] = middle(&mut studio, Look::light());
    assert!(g < 60, "the cloth is inside the body: {g}");
    let [r, g, _] = middle(&mut studio, Look { sheer: true, ..Look::light() });
    assert!(r > 60 && g > 60, "{r} {g}");
    let outside = Scene { meshes: vec![Arc::clone(&scene.meshes[0])], ..Default::default() };
    let mean = |studio: &mut Studio, wire| {
        let look = Look { wire, ..Look::light() };
        let image = studio.picture(&outside, View::Front, &look, SIZE).expect("a picture");
        image.pixels().map(|p| u64::from(p[1])).sum::<u64>() / u64::from(SIZE.x * SIZE.y)
    };
    let (plain, wired) = (mean(&mut studio, false), mean(&mut studio, true));
    assert!(wired + 3 < plain, "dark lines over it: {plain} {wired}");
}

#[test]
fn with_x_ray_lines_show_faintly_through_what_hides_them() {
    let Some(mut studio) = studio() else { return };
    let line = Polyline {
        points: vec![Vec3::new(-0.1, 0.0, -0.5), Vec3::new(0.1, 0.0, -0.5)],
        colour: [0, 0, 255, 255],
        width: 6.0,
        ..Default::default()
    };
    let meshes = vec![Arc::new(sphere(0.5, BODY, BODY))];
    let scene = Scene { meshes, lines: vec![line], ..Default::default() };
    let blue = |studio: &mut Studio, xray| {
        let look = Look { xray, ..Look::light() };
        let image = studio.picture(&scene, View::Front, &look, SIZE).expect("a picture");
        let [r, _, b] = pixel(&image, 160, 120);
        b - r
    };
    assert!(blue(&mut studio, false) < 10);
    assert!(blue(&mut studio, true) > 40);
}

#[test]
fn evening_is_redder_and_daylight_has_a_blue_sky() {
    let Some(mut studio) = studio() else { return };
    let grey = || Arc::new(sphere(0.5, [160; 3], [160; 3]));
    let mut draw = |light| {
        let scene = Scene { meshes: vec![grey()], ..Default::default() };
        studio.picture(&scene, View::Front, &Look { light, ..Look::light() }, SIZE).expect("a picture")
    };
    let [plain, day, evening] = Light::ALL.map(&mut draw);
    let warmth = |image: &image::RgbaImage| {
        let [r, _, b] = pixel(image, 140, 100);
        r - b
    };
    assert!(warmth(&evening) > warmth(&plain) + 20, "{} {}", warmth(&evening), warmth(&plain));
    let [r, _, b] = pixel(&day, 2, 2);
    assert!(b > r + 40, "{r} {b}");
    assert_eq!("evening".parse(), Ok(Light::Evening));
    assert!("noon".parse::<Light>().is_err_and(|words| words.contains("studio, daylight, evening")));
}

/// Everything that a picture can hold: cloth with a weave, cloth that lets light through, a body, lines, a number, a floor.
pub(crate) fn full_scene() -> Scene {
    let woven =
        FabricLook { weave: Weave::Twill, pitch_m: 0.01, relief: 0.5, slubs: 0.2, ..FabricLook::default() };
    let net = Fabric::preset("chiffon").expect("a preset").look;
    let placed = |look: &FabricLook, by: Vec3| {
        let mut mesh = swatch(look, 0.5);
        mesh.positions.iter_mut().for_each(|p| *p += by);
        Arc::new(mesh)
    };
    let line = Polyline {
        points: vec![Vec3::new(-0.6, -0.3, 0.52), Vec3::new(0.6, 0.4, 0.52)],
        colour: [0, 0, 255, 255],
        width: 3.0,
        halo: [255, 255, 255, 255],
        halo_width: 1.5,
        lift: 0.01,
        ..Polyline::default()
    };
    let label = Label {
        anchor: Vec3::new(0.0, 0.0, 0.5),
        offset: Vec2::new(-11.0, 11.0),
        text: "28".to_owned(),
        height: 9.5,
        colour: [200, 50, 52, 255],
        halo: [255; 4],
        lift: 0.05,
    };
    Scene {
        meshes: vec![
            Arc::new(sphere(0.5, BODY, BODY)),
            placed(&woven, Vec3::new(-0.55, 0.1, 0.2)),
            placed(&net, Vec3::new(0.4, 0.1, 0.6)),
        ],
        lines: vec![line],
        labels: vec![label],
        ground: Some(Ground { height: -0.5, centre: Vec2::ZERO, radius: 2.0 }),
    }
}

/// A picture of `scene`, and the number of its tiles.
pub(crate) fn fine(
    studio: &mut Studio,
    scene: &Scene,
    camera: Camera,
    look: &Look,
    (size, fineness): (UVec2, Fineness),
) -> (image::RgbaImage, usize) {
    let mut picture = studio.fine(scene.clone(), camera, look, size, fineness).expect("a plan");
    let tiles = picture.progress().1;
    while !picture.is_done() {
        studio.go_on(&mut picture).expect("a tile");
    }
    (picture.finish(), tiles)
}

/// Asserts that a picture drawn tile by tile is that drawn in one piece.
pub fn are_alike(name: &str, whole: &RgbaImage, tiled: &RgbaImage) {
    let apart: Vec<u8> = whole.iter().zip(tiled.iter()).map(|(a, b)| a.abs_diff(*b)).collect();
    // A place at the very border of a texel's shadow may fall on its other side, as positions are interpolated from another corner:
    // that changes one of six readings, in one of the samples of a pixel.
    let at_shadows = apart.iter().filter(|d| **d > 1).count();
    assert!(at_shadows * 100_000 <= apart.len(), "{name}: {at_shadows} of {}", apart.len());
    assert!(apart.iter().all(|d| *d <= 2), "{name}: {:?} of 255", apart.iter().max());
}

#[test]
fn a_picture_in_tiles_is_the_picture_in_one_piece() {
    let Some(mut studio) = studio() else { return };
    let scene = full_scene();
    let wide = framed(&scene, View::ThreeQuarter, SIZE);
    let parallel = Camera { projection: toile::render::Projection::Orthographic, ..wide };
    let mut near = wide;
    near.zoom(0.3, near.pivot);
    let plain = Look::light();
    let odd = UVec2::new(157, 101);
    for (name, camera, look, size, times) in [
        ("opaque", wide, plain, SIZE, 2),
        ("parallel", parallel, Look { wire: true, ..plain }, SIZE, 2),
        ("near", near, Look { xray: true, sheer: true, ..plain }, SIZE, 2),
        ("transparent", wide, Look { cut_out: true, pixels_per_point: 1.5, ..plain }, SIZE, 2),
        ("evening", wide, Look { light: Light::Evening, ..plain }, odd, 3),
    ] {
        let (whole, one) = fine(&mut studio, &scene, camera, &look, (size, Fineness { times, tile: 1024 }));
        let (tiled, many) = fine(&mut studio, &scene, camera, &look, (size, Fineness { times, tile: 128 }));
        assert!(one == 1 && many > 10, "{name}: {one} and {many} tiles");
        assert_eq!(whole.dimensions(), (size.x, size.y));
        are_alike(name, &whole, &tiled);
        assert_eq!(whole.pixels().any(|p| p[3] < 255), look.cut_out, "{name}");
    }
}

#[test]
fn edges_that_were_drawn_in_one_width_are_drawn_anew_in_another() {
    let (Some(mut used), Some(mut fresh)) = (studio(), studio()) else { return };
    let scene = full_scene();
    let camera = framed(&scene, View::Front, SIZE);
    let look = Look { wire: true, ..Look::light() };
    let drawn = |studio: &mut Studio, times| {
        fine(studio, &scene, camera, &look, (SIZE, Fineness { times, tile: 128 })).0
    };
    let twice = drawn(&mut used, 2);
    let [once, again] = [1, 2].map(|times| drawn(&mut used, times));
    assert!(again == twice && once == drawn(&mut fresh, 1), "as by a renderer that has drawn nothing yet");
    assert!(drawn(&mut used, 3) == drawn(&mut fresh, 3));
}

#[test]
fn a_finer_picture_shows_the_same_in_the_same_widths() {
    let Some(mut studio) = studio() else { return };
    let mut scene = full_scene();
    (scene.lines[0].points[1].x, scene.lines[0].width) = (0.1, 12.0);
    let camera = framed(&scene, View::Front, SIZE);
    let look = Look::light();
    let plain = studio.draw(&scene, &camera, &look, SIZE).expect("a picture");
    let (once, _) = fine(&mut studio, &scene, camera, &look, (SIZE, Fineness::new(1)));
    assert!(once == plain, "a sample for each pixel is the picture itself");
    let blue = |image: &image::RgbaImage| {
        let bluer = image.pixels().map(|p| (i32::from(p[2]) - i32::from(p[0]) - 60).max(0));
        f64::from(bluer.sum::<i32>())
    };
    for times in [2, Fineness::MOST_TIMES] {
        let (finer, _) = fine(&mut studio, &scene, camera, &look, (SIZE, Fineness::new(times)));
        let share = blue(&finer) / blue(&plain);
        assert!((0.9..1.1).contains(&share), "the line is {share} times as wide at {times}");
        let apart: f64 = plain.iter().zip(finer.iter()).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
        let apart = apart / plain.len() as f64;
        assert!(apart < 4.0, "{apart} of 255 apart at {times}");
    }
}

#[test]
fn a_picture_larger_than_the_textures_is_drawn_in_tiles() {
    let Some(mut studio) = studio() else { return };
    // Eight times as wide it is more than adapters hold in one texture.
    let (scene, size) = (full_scene(), UVec2::new(4200, 8));
    let camera = framed(&scene, View::Front, size);
    let (picture, tiles) = fine(&mut studio, &scene, camera, &Look::light(), (size, Fineness::new(8)));
    assert_eq!((picture.dimensions(), tiles > 1), ((4200, 8), true));
    assert!(picture.pixels().all(|p| p[3] == 255), "no tile is missing");
}

#[test]
fn an_image_lights_from_where_it_is_bright() {
    let Some(mut studio) = studio() else { return };
    // Red on the right of one who stands in it with the back to -z, that is, on the left of one who looks at the front.
    let image = image::Rgb32FImage::from_fn(64, 32, |x, _| {
        image::Rgb(if x >= 32 { [90.0, 20.0, 20.0] } else { [20.0, 20.0, 90.0] })
    });
    let environment = ImageLight::of_image(&image, MEAN_LIGHT);
    assert!(environment.is_some());
    let look = Look { environment, key: 0.0, ..Look::light() };
    let scene = Scene { meshes: vec![Arc::new(sphere(0.5, [160; 3], [160; 3]))], ..Default::default() };
    let warmth = |image: &image::RgbaImage, x: u32| {
        let [r, _, b] = pixel(image, x, 120);
        r - b
    };
    let front = studio.picture(&scene, View::Front, &look, SIZE).expect("a picture");
    assert!(warmth(&front, 90) > 30 && warmth(&front, 230) < -30);
    assert!(warmth(&front, 160).abs() < 12, "both from the middle");
    // It stays where it is when the eye goes round, while the studio's light goes with the eye.
    let back = studio.picture(&scene, View::Back, &look, SIZE).expect("a picture");
    assert!(warmth(&back, 90) < -30 && warmth(&back, 230) > 30);
    let plain = Look { key: 0.0, ..Look::light() };
    let [front, back] =
        [View::Front, View::Back].map(|view| studio.picture(&scene, view, &plain, SIZE).expect("a picture"));
    let apart: f64 = front.iter().zip(back.iter()).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
    assert!(apart / (front.len() as f64) < 0.5, "{apart}");
}

#[test]
fn the_sun_of_an_image_is_the_lamp_and_turns_with_the_image() {
    let Some(mut studio) = studio() else { return };
    // Low on the right of one who stands in it with the back to -z, that is, on the left of one who looks at the front.
    let image = image::Rgb32FImage::from_fn(256, 128, |x, y| {
        let is_sun = (190..193).contains(&x) && (52..55).contains(&y);
        image::Rgb([if is_sun { 5000.0 } else { 1.0 }; 3])
    });
    let light = ImageLight::of_image(&image, MEAN_LIGHT).expect("light");
    // Cloth without gloss: skin and threads mirror the lamp even where it has no strength.
    let mut ball = sphere(0.5, [160; 3], [160; 3]);
    ball.cloth = 1.0;
    ball.textile = Textile { gloss: 0.0, sheen: 0.0, ..Textile::default() };
    let scene = Scene { meshes: vec![Arc::new(ball)], ..Default::default() };
    let mut sides = |view: View, degrees: f32, key: f32| {
        let environment = Some(light.turned(degrees.to_radians()));
        let look = Look { environment, key, ..Look::light() };
        let picture = studio.picture(&scene, view, &look, SIZE).expect("a picture");
        [90, 230].map(|x| pixel(&picture, x, 120)[1])
    };
    let key = Look::light().key;
    let [left, right] = sides(View::Front, 0.0, key);
    assert!(left > right + 20, "from the left: {left}, {right}");
    // It stays where it is when the eye goes round, and goes round with the image.
    for (view, degrees) in [(View::Back, 0.0), (View::Front, 180.0)] {
        let [left, right] = sides(view, degrees, key);
        assert!(right > left + 20, "{view:?}, {degrees}: {left}, {right}");
    }
    let [left, right] = sides(View::Front, 0.0, 0.0);
    assert!((left - right).abs() < 4, "without the lamp the light is even: {left}, {right}");
}

#[test]
fn the_light_of_an_image_is_rotated_about_the_vertical_axis() {
    let Some(mut studio) = studio() else { return };
    // Red towards -x, blue towards +x, and brighter above.
    let image = image::Rgb32FImage::from_fn(64, 32, |x, y| {
        let light = if y < 16 { 2.0 } else { 1.0 };
        image::Rgb(if x >= 32 { [90.0, 20.0, 20.0] } else { [20.0, 20.0, 90.0] }.map(|c| c * light))
    });
    let light = ImageLight::of_image(&image, MEAN_LIGHT).expect("light");
    let scene = Scene { meshes: vec![Arc::new(sphere(0.5, [160; 3], [160; 3]))], ..Default::default() };
    let mut drawn = |view: View, degrees: f32| {
        let environment = Some(light.turned(degrees.to_radians()));
        let look = Look { environment, key: 0.0, ..Look::light() };
        studio.picture(&scene, view, &look, SIZE).expect("a picture")
    };
    let warmth = |image: &image::RgbaImage| {
        let [r, _, b] = pixel(image, 160, 120);
        r - b
    };
    let front = [0.0, 90.0, 180.0, 270.0].map(|degrees| warmth(&drawn(View::Front, degrees)));
    assert!(front[0].abs() < 12 && front[2].abs() < 12, "both from the sides: {front:?}");
    assert!(front[1] > 30 && front[3] < -30, "what came from -x comes from +z, then from -z: {front:?}");
    // Light that goes round by a quarter looks as to an eye that goes round the other way.
    for (seen_from, degrees) in [(View::Right, 90.0), (View::Back, 180.0), (View::Left, 270.0)] {
        let [moved, still] = [drawn(View::Front, degrees), drawn(seen_from, 0.0)];
        let apart: f64 = moved.iter().zip(still.iter()).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
        assert!(apart / (moved.len() as f64) < 0.5, "{seen_from:?}: {apart}");
        assert!(moved != drawn(View::Front, 0.0), "{degrees}");
    }
}

#[test]
fn polished_cloth_reflects_what_is_around_it() {
    let Some(mut studio) = studio() else { return };
    let look = Look { key: 0.0, occlusion: 0.0, ..Look::light() };
    let mut draw = |gloss: f32, roughness: f32| {
        let mut cloth = sphere(0.5, [40; 3], [40; 3]);
        cloth.cloth = 1.0;
        cloth.textile = Textile { gloss, roughness, sheen: 0.0, ..Textile::default() };
        let scene = Scene { meshes: vec![Arc::new(cloth)], ..Default::default() };
        studio.picture(&scene, View::Front, &look, SIZE).expect("a picture")
    };
    let [matt, rough, polished] = [(0.0, 0.5), (1.0, 0.6), (1.0, 0.1)].map(|(g, r)| draw(g, r));
    let brighter = |image: &image::RgbaImage| {
        let rises = image.pixels().zip(matt.pixels()).map(|(a, b)| i32::from(a[1]) - i32::from(b[1]));
        rises.collect::<Vec<i32>>()
    };
    let [soft, hard] = [&rough, &polished].map(brighter);
    assert!(soft.iter().chain(&hard).all(|rise| *rise >= -2), "a reflection only adds light");
    // The edge of a softbox is sharp in polished cloth: the steepest rise from pixel to pixel inside the sphere.
    let steepest = |rises: &[i32]| {
        let inside = |x: usize, y: usize| (x as i32 - 160).pow(2) + (y as i32 - 120).pow(2) < 75 * 75;
        let steps = (0..240).flat_map(|y| (1..320).map(move |x| (x, y))).filter(|&(x, y)| inside(x, y));
        steps.map(|(x, y)| (rises[y * 320 + x] - rises[y * 320 + x - 1]).abs()).max().unwrap_or(0)
    };
    assert!(steepest(&hard) > 2 * steepest(&soft), "{} and {}", steepest(&hard), steepest(&soft));
}
