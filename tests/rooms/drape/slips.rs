//! B5: a strip that hangs from a clamp and is pushed onto the ground sticks there and slips.
//!
//! The clamp holds it upright at its upper end; its tip stands right below on ground that holds it by friction alone and turns
//! freely. Pushed down by ε of its length it bows, and the ground pulls its tip sideways by T where it presses with N: it slips
//! as soon as T is more than µN. The elastica gives T/N; it starts to bow at N L²/B = 20.1907.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::body::Surface;
use toile::cloth::Fabric;
use toile::drape::solver::settle::SettleSettings;
use toile::drape::{Collider, Drape, Method, Scene, State};
use toile::geometry::mesh::TriMesh;

use super::meshes::{Flat, Kind, flat, near, scene, settled};
use super::moves::settings;

const LENGTH: f64 = 0.2;
const WIDTH: f64 = 0.02;
const BENDING: f64 = 1e-4;

struct Pushed {
    strip: Flat,
    scene: Scene,
    x: Vec<DVec3>,
}

impl Pushed {
    /// At rest with its tip held where it stands.
    fn by(share: f64, cells: u32) -> Self {
        // The clamp holds a slope by its last cell; what bends first are the vertices at its end, for half a cell: it ends midway.
        let cell = LENGTH / (f64::from(cells) - 0.5);
        let mut strip = flat(Kind::Diagonal, DVec2::new(LENGTH + 1.5 * cell, WIDTH), [cells + 1, 4]);
        strip.points.iter_mut().for_each(|p| p.x -= 1.5 * cell);
        let held = strip.picked(|p| p.x < 0.51 * cell || p.x > LENGTH - 1e-9);
        let mut scene = scene(&strip, &Fabric::isotropic(2e4, 0.0, BENDING, 0.2), held);
        scene.gravity = DVec3::ZERO;
        // From the clamp at y = 0 down: bowed as far as the length that is left over asks, as a first guess.
        let bow = LENGTH * (share * 0.35).sqrt();
        let start = |p: DVec2| {
            let s = (p.x / LENGTH).max(0.0);
            let aside = bow * (1.0 - (2.0 * std::f64::consts::PI * s.powf(1.2)).cos()) / 2.0;
            DVec3::new(aside, -p.x + share * LENGTH * s, p.y)
        };
        let force = BENDING * WIDTH / (LENGTH * LENGTH);
        let settings = SettleSettings { scale: force, most_iterations: 600, ..SettleSettings::default() };
        let x = settled(&scene, &[], &settings, strip.placed(start));
        Self { strip, scene, x }
    }

    fn is_tip(p: DVec2) -> bool {
        p.x > LENGTH - 1e-9
    }

    /// What the ground takes up, N: sideways and down.
    fn tip_force(&self) -> DVec2 {
        let mut gradient = vec![DVec3::ZERO; self.x.len()];
        self.scene.elastic.add_gradient(&self.x, &mut gradient);
        let tip = self.strip.points.iter().zip(&gradient).filter(|(p, _)| Self::is_tip(**p));
        let sum: DVec3 = tip.map(|(_, g)| *g).sum();
        DVec2::new(sum.x, sum.y)
    }

    /// How far the tip goes in a second when only friction holds it, metres.
    fn slides(mut self, friction: f64) -> f64 {
        let mut settings = settings(Method::Implicit);
        settings.friction = friction;
        settings.thickness = 1e-3;
        settings.accuracy = 1e-8;
        let ground = self.x.iter().map(|x| x.y).fold(0.0, f64::min) - settings.thickness;
        self.scene.collider = Some(plate(ground));
        self.scene.pinned = self.strip.picked(|p| p.x < 0.51 * LENGTH / 39.5);
        self.scene.damping = 20.0;
        let tips = self.strip.picked(Self::is_tip);
        let place = |drape: &Drape| {
            let tip = drape.state().positions.iter().zip(&tips).filter(|(_, tip)| **tip);
            tip.map(|(x, _)| x.x).sum::<f64>() / 5.0
        };
        let mut drape = Drape::new(self.scene, State::at_rest(self.x), settings, 1e-3).expect("room");
        // The ground gives way a little until it presses back.
        (0..50).for_each(|_| drape.step(1e-3).expect("a step"));
        let before = place(&drape);
        (0..100).for_each(|_| drape.step(1e-3).expect("a step"));
        (place(&drape) - before).abs()
    }
}

/// A box with its upper side at `height`.
fn plate(height: f64) -> Collider {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let at = |y: f64| corners.map(|(x, z)| DVec3::new(x, y, z));
    let positions = [at(height), at(height - 0.1)].concat();
    let mut triangles = vec![[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]];
    for k in 0..4u32 {
        let n = (k + 1) % 4;
        triangles.extend([[k, n, k + 4], [n, n + 4, k + 4]]);
    }
    Collider::still(Arc::new(Surface::new(TriMesh { positions, triangles }).expect("a plate")))
}

#[test]
fn b5_the_pull_over_the_push_is_the_elasticas() {
    let rows = [(0.01, 0.044854), (0.05, 0.103545), (0.1, 0.152793), (0.2, 0.237774), (0.3, 0.326491)];
    for (share, exact) in rows {
        let force = Pushed::by(share, 40).tip_force();
        near(&format!("T/N pushed by {share}"), (force.x / force.y).abs(), exact, 0.03);
    }
}

#[test]
fn b5_its_tip_slips_when_it_pulls_more_than_friction() {
    let (below, above) =
        (Pushed::by(0.1, 40).slides(0.152793 * 1.03), Pushed::by(0.1, 40).slides(0.152793 * 0.97));
    assert!(below < 1e-6 && above > 1e-5, "{below} m with more friction than T/N, {above} m with less");
}
