//! B17: a strip over a drum with a weight at each end.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::body::Surface;
use toile::cloth::Fabric;
use toile::drape::{Collider, Drape, Method, State};
use toile::geometry::mesh::TriMesh;

use super::meshes::{Kind, flat, scene};
use super::moves::settings;

const RADIUS: f64 = 0.1;

/// A closed drum along z.
fn drum(facets: u32) -> Collider {
    let mut positions = vec![DVec3::new(0.0, 0.0, -0.1), DVec3::new(0.0, 0.0, 0.1)];
    for k in 0..facets {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(facets)).sin_cos();
        positions.extend([-0.1, 0.1].map(|z| DVec3::new(cos * RADIUS, sin * RADIUS, z)));
    }
    let at = |k: u32, side: u32| 2 + 2 * (k % facets) + side;
    let mut triangles = Vec::new();
    for k in 0..facets {
        triangles.extend([[0, at(k + 1, 0), at(k, 0)], [1, at(k, 1), at(k + 1, 1)]]);
        triangles.extend([[at(k, 0), at(k + 1, 0), at(k + 1, 1)], [at(k, 0), at(k + 1, 1), at(k, 1)]]);
    }
    let mesh = TriMesh { positions, triangles };
    assert!(mesh.volume() > 0.0);
    Collider::still(Arc::new(Surface::new(mesh).expect("a drum")))
}

/// How far the heavier end sinks in the second half of a second, metres.
fn sinks(friction: f64, ratio: f64) -> f64 {
    let mut settings = settings(Method::Implicit);
    settings.friction = friction;
    settings.thickness = 1e-3;
    let radius = RADIUS + settings.thickness;
    let (over, hangs) = (PI * radius, 0.03);
    let length = over + 2.0 * hangs;
    let strip = flat(Kind::Diagonal, DVec2::new(0.02, length), [1, 60]);
    let mut scene = scene(&strip, &Fabric::isotropic(2e4, 0.0, 0.0, 0.01), vec![false; strip.points.len()]);
    scene.damping = 5.0;
    for (p, mass) in strip.points.iter().zip(&mut scene.mass) {
        if p.y < 1e-9 {
            *mass = 0.01;
        } else if p.y > length - 1e-9 {
            *mass = 0.01 * ratio;
        }
    }
    scene.collider = Some(drum(180));
    let x = strip.placed(|p| {
        let s = p.y - hangs;
        match s {
            s if s < 0.0 => DVec3::new(-radius, s, p.x),
            s if s > over => DVec3::new(radius, over - s, p.x),
            s => DVec3::new(-radius * (s / radius).cos(), radius * (s / radius).sin(), p.x),
        }
    });
    let heavy = x.len() - 1;
    let h = 1.0 / 60.0;
    let mut drape = Drape::new(scene, State::at_rest(x), settings, h).expect("room");
    (0..30).for_each(|_| drape.step(h).expect("a step"));
    let before = drape.state().positions[heavy].y;
    (0..30).for_each(|_| drape.step(h).expect("a step"));
    before - drape.state().positions[heavy].y
}

#[test]
fn b17_a_capstan_holds_up_to_its_ratio_and_no_more() {
    for (friction, exact) in [(0.3, 2.566332), (0.5, 4.810477)] {
        let (below, above) = (sinks(friction, exact * 0.98), sinks(friction, exact * 1.02));
        assert!(below < 1e-5 && above > 1e-4, "µ = {friction}: {below} m below the ratio, {above} m above");
    }
}
