//! Textures baked on the processor against what the shader draws.

use std::sync::Arc;

use glam::{Mat2, UVec2, Vec2, Vec3};
use image::{RgbImage, RgbaImage};
use toile::render::bake::{Chart, Side, base_colour};
use toile::render::{Look, Mesh, RenderError, Scene, Studio, Textile, View, linear};

const SIDE: u32 = 256;

/// A square of 0.2 m that faces the viewer, its texture coordinates the pattern in metres.
fn square(front: [u8; 3], textile: Textile) -> Mesh {
    let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y].map(|p| p * 0.2);
    Mesh {
        positions: corners.map(|p| p.extend(0.0)).to_vec(),
        normals: vec![Vec3::Z; 4],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        front,
        back: front,
        cloth: 1.0,
        flat: vec![[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]],
        textile,
        ..Mesh::default()
    }
}

fn baked(front: [u8; 3], textile: Textile) -> RgbImage {
    let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    let chart = Chart {
        triangles: vec![[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]],
        flat_from_uv: (Mat2::from_diagonal(Vec2::splat(0.2)), Vec2::ZERO),
        sides: [front; 2],
        textile,
        decals: Arc::default(),
    };
    base_colour(&[chart], Side::Outside, SIDE)
}

/// Linear colour of the picture at a place of the square, 0..1 from its lower left corner; it fills the height but a border.
fn seen(picture: &RgbaImage, at: Vec2, filled: f32) -> Vec3 {
    let middle = Vec2::splat(SIDE as f32 / 2.0);
    let pixel = middle + (at - 0.5) * Vec2::new(1.0, -1.0) * filled;
    let p = picture.get_pixel(pixel.x as u32, pixel.y as u32).0;
    linear([p[0], p[1], p[2]])
}

/// Width of the square in the picture, pixels: columns in the middle row that are not background.
fn filled(picture: &RgbaImage) -> f32 {
    let row = SIDE / 2;
    (0..SIDE).filter(|&x| picture.get_pixel(x, row).0[3] > 128).count() as f32
}

#[test]
fn a_baked_print_has_the_colours_of_the_drawn_one() {
    let mut studio = match Studio::new() {
        Ok(studio) => studio,
        Err(RenderError::NoAdapter(why)) => return println!("skipped: no graphics adapter ({why})"),
        Err(other) => panic!("{other}"),
    };
    let look = Look { cut_out: true, occlusion: 0.0, shadow: 0.0, ..Look::light() };
    let grey = [160; 3];
    let plain = Textile { sheen: 0.0, ..Textile::default() };
    let mut draw = |front, textile| {
        let scene = Scene { meshes: vec![Arc::new(square(front, textile))], ..Scene::default() };
        studio.picture(&scene, View::Front, &look, UVec2::splat(SIDE)).expect("a picture")
    };
    let light = draw(grey, plain);
    let width = filled(&light);
    assert!(width > 150.0, "{width}");
    let mut worst = 0.0_f32;
    for print in 1..=4 {
        let textile =
            Textile { print, repeat: 0.05, ink: [220, 90, 30], weave: 2, second: Some([180; 3]), ..plain };
        let own = [40, 70, 120];
        let (drawn, texture) = (draw(own, textile), baked(own, textile));
        for k in 0..400 {
            // Places away from the edges of the print, where a pixel and a texel do not average over the same.
            let at = Vec2::new((k % 20) as f32 + 0.5, (k / 20) as f32 + 0.5) / 20.0 * 0.96 + 0.02;
            let texel = |p: Vec2| texture.get_pixel((p.x * 256.0) as u32, ((1.0 - p.y) * 256.0) as u32).0;
            let around = [Vec2::X, -Vec2::X, Vec2::Y, -Vec2::Y]
                .map(|d| texel((at + d * 0.012).clamp(Vec2::ZERO, Vec2::splat(0.999))));
            if around.iter().any(|other| *other != texel(at)) {
                continue;
            }
            let albedo = seen(&drawn, at, width) / seen(&light, at, width) * linear(grey);
            worst = worst.max((albedo - linear(texel(at))).abs().max_element());
        }
    }
    assert!(worst > 0.0 && worst < 0.02, "{worst} of linear light");
}
