//! Time of a picture of the body pane: 40,000 triangles of cloth on a body of 30,000, at 1280 × 800, until the device is done
//! with it; and of finding what lies under the pointer there.

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::{DVec3, UVec2, Vec2, Vec3};
use toile::body::Surface;
use toile::geometry::mesh::{TriMesh, vertex_normals};
use toile::render::{
    BODY, CLOTH_BACK, CLOTH_FRONT, Camera, Gpu, Look, Mesh, OffscreenTarget, Quality, Renderer, Scene, View,
};

const SIZE: UVec2 = UVec2::new(1280, 800);

/// A barrel 1.6 m high, `r` metres in radius, of two triangles a cell; closed where `closed`.
fn barrel(r: f64, rings: u32, sectors: u32, closed: bool) -> TriMesh {
    let mut mesh = TriMesh { positions: Vec::new(), triangles: Vec::new() };
    for i in 0..=rings {
        let h = f64::from(i) / f64::from(rings);
        let wide = r * (1.0 + 0.2 * (h * 9.0).sin());
        for j in 0..sectors {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(j) / f64::from(sectors)).sin_cos();
            mesh.positions.push(DVec3::new(wide * sin, 1.6 * h, wide * cos));
        }
    }
    let at = |i: u32, j: u32| i * sectors + j % sectors;
    for i in 0..rings {
        for j in 0..sectors {
            mesh.triangles.push([at(i, j), at(i, j + 1), at(i + 1, j + 1)]);
            mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i + 1, j)]);
        }
    }
    if closed {
        let foot = mesh.positions.len() as u32;
        mesh.positions.extend([DVec3::ZERO, DVec3::Y * 1.6]);
        for j in 0..sectors {
            mesh.triangles.push([foot, at(0, j + 1), at(0, j)]);
            mesh.triangles.push([foot + 1, at(rings, j), at(rings, j + 1)]);
        }
    }
    mesh
}

fn drawn(mesh: &TriMesh, front: [u8; 3], back: [u8; 3], cloth: f32) -> Arc<Mesh> {
    let normals = vertex_normals(&mesh.positions, &mesh.triangles);
    Arc::new(Mesh {
        positions: mesh.positions.iter().map(|p| p.as_vec3()).collect(),
        normals: normals.iter().map(|n| n.as_vec3()).collect(),
        triangles: mesh.triangles.clone(),
        front,
        back,
        cloth,
        ..Mesh::default()
    })
}

fn pictures(c: &mut Criterion) {
    let mut group = c.benchmark_group("the body pane");
    group.sample_size(20);
    let (body, cloth) = (barrel(0.2, 100, 149, true), barrel(0.21, 100, 200, false));
    println!("{} triangles of cloth, {} of the body", cloth.triangles.len(), body.triangles.len());
    let surface = Surface::new(body.clone()).expect("a body");
    let mut camera = Camera::framing(
        Vec3::new(-0.25, 0.0, -0.25),
        Vec3::new(0.25, 1.6, 0.25),
        View::ThreeQuarter,
        SIZE.x as f32 / SIZE.y as f32,
    );
    let ray = camera.ray(Vec2::new(640.0, 400.0), SIZE.as_vec2());
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    group.bench_function("the skin under the pointer", |b| {
        b.iter(|| black_box(surface.ray(black_box(origin), direction)))
    });
    let gpu = match Gpu::headless() {
        Ok(gpu) => gpu,
        Err(why) => return println!("no pictures: {why}"),
    };
    println!("drawn by {}", gpu.adapter_name);
    let mut renderer = Renderer::new(&gpu).expect("a renderer");
    let body = drawn(&body, BODY, BODY, 0.0);
    // What a processor draws while things move.
    let draft = ((SIZE.as_vec2() * 0.8).as_uvec2(), Quality::Draft);
    for (name, rings, (size, quality)) in [
        ("finished, 10,000 triangles", 50, (SIZE, Quality::Finished)),
        ("draft, 10,000 triangles", 50, draft),
        ("finished", 100, (SIZE, Quality::Finished)),
        ("draft", 100, draft),
    ] {
        let cloth = |r: f64| drawn(&barrel(r, rings, 2 * rings, false), CLOTH_FRONT, CLOTH_BACK, 1.0);
        let cloths = [0.21, 0.211].map(cloth);
        let scene =
            |i: usize| Scene { meshes: vec![Arc::clone(&body), Arc::clone(&cloths[i])], ..Scene::default() };
        let target = OffscreenTarget::new(&gpu, size, quality).expect("a target");
        let look = Look::light();
        let mut draw = |scene: &Scene, camera: &Camera| {
            renderer.draw(&gpu, scene, camera, &look, &target).expect("a picture");
            gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("it ends");
        };
        let still = scene(0);
        group.bench_function(format!("{name}: the view turns"), |b| {
            b.iter(|| {
                camera.orbit(Vec2::new(0.02, 0.0));
                draw(&still, &camera);
            });
        });
        let moving = [scene(0), scene(1)];
        let mut i = 0;
        group.bench_function(format!("{name}: the cloth moves"), |b| {
            b.iter(|| {
                i = 1 - i;
                draw(&moving[i], &camera);
            });
        });
    }
}

criterion_group!(benches, pictures);
criterion_main!(benches);
