//! Depth of field against the circles of confusion of a thin lens. Without a graphics adapter the tests say so and pass.

use std::sync::Arc;

use glam::{Quat, UVec2, Vec3};
use image::RgbaImage;
use toile::render::{
    Camera, Fineness, Gpu, Lens, Look, Mesh, OffscreenTarget, Projection, Quality, RenderError, Renderer,
    Scene, Studio, Textile, View, framed, linear,
};

use crate::render::{are_alike, fine, full_scene, studio};

const SIZE: UVec2 = UVec2::new(640, 480);
/// Width over which the light of a blurred edge rises from a tenth to nine tenths, in radii of the disc that blurs it: of a disc
/// cut at x the share 1/2 + (x √(1 - x²) + asin x) / π lies before the cut.
const EDGE: f64 = 1.374;

/// A camera one metre before the origin.
fn camera() -> Camera {
    Camera {
        pivot: Vec3::ZERO,
        rotation: Quat::IDENTITY,
        distance: 1.0,
        bounds: (Vec3::ZERO, 2.0),
        ..Camera::default()
    }
}

/// Even light without shadows.
fn even() -> Look {
    Look { key: 0.0, shadow: 0.0, occlusion: 0.0, ..Look::light() }
}

fn through(lens: Lens, look: Look) -> Look {
    Look { lens: Some(lens), ..look }
}

/// A wide open lens, focused at the pivot.
const OPEN: Lens = Lens { f_number: 1.4, focus: None };

/// An upright rectangle from `left` to `right` at `z`, higher than the picture.
fn sheet(left: f32, right: f32, z: f32, grey: u8) -> Arc<Mesh> {
    let corner = |x: f32, y: f32| Vec3::new(x, y, z);
    Arc::new(Mesh {
        positions: vec![corner(left, -3.0), corner(right, -3.0), corner(right, 3.0), corner(left, 3.0)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        front: [grey; 3],
        back: [grey; 3],
        // Matt, so that its light is the same from everywhere.
        cloth: 1.0,
        textile: Textile { sheen: 0.0, ..Textile::default() },
        ..Mesh::default()
    })
}

/// Stripes in the plane in focus on the left; behind them, 2 m from the eye, dark up to x = 0.2 m and light beyond.
fn stripes_and_edge() -> Scene {
    let mut meshes = vec![sheet(-3.0, 0.2, -1.0, 60), sheet(0.2, 3.0, -1.0, 230)];
    let stripe = |i: u8| {
        let left = -0.3 + 0.03 * f32::from(i);
        sheet(left, left + 0.03, 0.0, if i.is_multiple_of(2) { 240 } else { 20 })
    };
    meshes.extend((0..9).map(stripe));
    Scene { meshes, ..Scene::default() }
}

/// Linear light from column to column, the mean of some rows.
fn profile(picture: &RgbaImage) -> Vec<f64> {
    let rows = picture.height() / 2 - 40..picture.height() / 2 + 40;
    let light = |x: u32, y: u32| f64::from(linear([picture.get_pixel(x, y)[1]; 3]).x);
    (0..picture.width()).map(|x| rows.clone().map(|y| light(x, y)).sum::<f64>() / 80.0).collect()
}

/// Width (pixels) over which `values` rise or fall from a tenth to nine tenths of the way from the first to the last.
fn edge_width(values: &[f64]) -> f64 {
    let (first, last) = (values[0], values[values.len() - 1]);
    let share: Vec<f64> = values.iter().map(|v| (v - first) / (last - first)).collect();
    let crossing = |level: f64| {
        let i = share.iter().position(|s| *s >= level).expect("an edge");
        i as f64 - (share[i] - level) / (share[i] - share[i - 1])
    };
    crossing(0.9) - crossing(0.1)
}

fn draw(studio: &mut Studio, scene: &Scene, look: &Look) -> RgbaImage {
    studio.draw(scene, &camera(), look, SIZE).expect("a picture")
}

#[test]
fn what_is_in_focus_keeps_its_bytes_and_a_far_edge_is_as_wide_as_computed() {
    let Some(mut studio) = studio() else { return };
    let scene = stripes_and_edge();
    let sharp = draw(&mut studio, &scene, &even());
    let blurred = draw(&mut studio, &scene, &through(OPEN, even()));
    // The stripes begin at x = -0.3 m, 290 pixels left of the middle, and end at x = -0.03 m, 29 pixels left of it.
    let stripes = |picture: &RgbaImage| -> Vec<_> {
        let (columns, rows) = (32..288, 0..SIZE.y);
        rows.flat_map(|y| columns.clone().map(move |x| (x, y)))
            .map(|(x, y)| *picture.get_pixel(x, y))
            .collect()
    };
    assert!(stripes(&sharp) == stripes(&blurred), "sharp, with nothing of the blur behind");
    let [before, after] = [&sharp, &blurred].map(profile);
    for x in 294..330 {
        assert!((before[x] - after[x]).abs() < 0.01, "the stripes give nothing to what is behind, at {x}");
    }
    // The edge is at x = 0.2 m in 2 m, 96 pixels right of the middle.
    let edge = 360..480;
    // Two steps, as the edge cuts a pixel: eight tenths of each.
    assert!(edge_width(&before[edge.clone()]) < 1.61);
    let radius = f64::from(OPEN.defocus(&camera(), SIZE).expect("a lens").radius(2.0));
    assert!((6.0..16.0).contains(&radius), "{radius}");
    let width = edge_width(&after[edge]);
    assert!((width / (EDGE * radius) - 1.0).abs() < 0.06, "{width} pixels for a radius of {radius}");
}

#[test]
fn what_is_near_and_blurred_covers_what_is_sharp_behind_it() {
    let Some(mut studio) = studio() else { return };
    // Dark in half the distance, before light in focus.
    let scene =
        Scene { meshes: vec![sheet(-3.0, 3.0, 0.0, 230), sheet(-3.0, 0.0, 0.4, 60)], ..Scene::default() };
    let defocus = OPEN.defocus(&camera(), SIZE).expect("a lens");
    let radius = f64::from(defocus.radius(0.6));
    assert!((6.0..16.0).contains(&radius), "{radius}");
    let blurred = profile(&draw(&mut studio, &scene, &through(OPEN, even())));
    let width = edge_width(&blurred[270..370]);
    assert!((width / (EDGE * radius) - 1.0).abs() < 0.08, "{width} pixels for a radius of {radius}");
    let focused = Lens { focus: Some(0.6), ..OPEN };
    let other = profile(&draw(&mut studio, &scene, &through(focused, even())));
    assert!(edge_width(&other[270..370]) < 1.5, "focused at the near one, its edge is sharp");
}

#[test]
fn without_a_lens_nothing_changes() {
    let Some(mut studio) = studio() else { return };
    let scene = full_scene();
    let camera = framed(&scene, View::ThreeQuarter, SIZE);
    let look = Look::light();
    let near = Lens { focus: Some(0.4 * camera.distance), ..OPEN };
    let mut drawn =
        |camera: &Camera, look: &Look| studio.draw(&scene, camera, look, SIZE).expect("a picture");
    let plain = drawn(&camera, &look);
    assert!(drawn(&camera, &through(near, look)) != plain);
    assert!(drawn(&camera, &look) == plain, "the next picture without a lens is sharp again");
    let parallel = Camera { projection: Projection::Orthographic, ..camera };
    let flat = drawn(&parallel, &look);
    assert!(drawn(&parallel, &through(near, look)) == flat, "a parallel projection has no lens");
}

#[test]
fn drafts_are_sharp() {
    let gpu = match Gpu::headless() {
        Ok(gpu) => gpu,
        Err(RenderError::NoAdapter(why)) => return println!("skipped: no graphics adapter ({why})"),
        Err(other) => panic!("{other}"),
    };
    let mut renderer = Renderer::new(&gpu).expect("a renderer");
    let scene = stripes_and_edge();
    let target = OffscreenTarget::new(&gpu, SIZE, Quality::Draft).expect("a target");
    let [sharp, also] = [even(), through(OPEN, even())].map(|look| {
        renderer.draw(&gpu, &scene, &camera(), &look, &target).expect("drawn");
        target.read(&gpu).expect("a picture")
    });
    assert!(sharp == also);
}

#[test]
fn a_blurred_picture_in_tiles_is_the_picture_in_one_piece() {
    let Some(mut studio) = studio() else { return };
    let (scene, size) = (full_scene(), UVec2::new(320, 240));
    let mut camera = framed(&scene, View::ThreeQuarter, size);
    camera.zoom(0.5, camera.pivot);
    let near = Lens { focus: Some(0.5 * camera.distance), ..OPEN };
    for (name, look) in [
        ("at the pivot", through(OPEN, Look::light())),
        ("near", through(near, Look::light())),
        ("transparent", through(near, Look { cut_out: true, ..Look::light() })),
    ] {
        let mut drawn = |tile| fine(&mut studio, &scene, camera, &look, (size, Fineness { times: 2, tile }));
        let ((whole, one), (tiled, many)) = (drawn(1024), drawn(128));
        assert!(one == 1 && many > 10, "{name}: {one} and {many} tiles");
        are_alike(name, &whole, &tiled);
        assert_eq!(whole.pixels().any(|p| p[3] < 255), look.cut_out, "{name}");
    }
}

#[test]
fn a_transparent_border_blurs_without_a_dark_fringe() {
    let Some(mut studio) = studio() else { return };
    let scene = Scene { meshes: vec![sheet(-3.0, 0.2, -1.0, 200)], ..Scene::default() };
    let look = through(OPEN, Look { cut_out: true, ..even() });
    for times in [1, 2] {
        let (picture, _) = fine(&mut studio, &scene, camera(), &look, (SIZE, Fineness::new(times)));
        let plain = i32::from(picture.get_pixel(100, 240)[1]);
        for pixel in picture.pixels().filter(|p| p[3] >= 64) {
            assert!((i32::from(pixel[1]) - plain).abs() <= 6, "{pixel:?} beside {plain}");
        }
        let alpha = |x: u32| (200..280).map(|y| f64::from(picture.get_pixel(x, y)[3])).sum::<f64>();
        let radius = f64::from(OPEN.defocus(&camera(), SIZE).expect("a lens").radius(2.0));
        let width = edge_width(&(360..480).map(alpha).collect::<Vec<f64>>());
        assert!((width / (EDGE * radius) - 1.0).abs() < 0.06, "{width} pixels for a radius of {radius}");
    }
}
