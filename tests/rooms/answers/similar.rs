//! A wrap is the same at any size and at any place.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::body::Surface;
use toile::relax::RelaxSettings;

use super::shapes::{Cut, wrapped};
use crate::common::exact::cylinder;

const EDGE: f64 = 0.03;
const RADIUS: f64 = 0.15;

/// Places of a tube 3 % too tight for a cylinder, all `k` times as large and shifted by `by`; with `gravity` times the
/// default weight, since the strain that weight gives a metre of cloth grows with the length.
fn places(k: f64, by: DVec3) -> Vec<DVec3> {
    let plain = Surface::new(cylinder(RADIUS, 1.0, 96, 20)).expect("a body");
    let mut cut = Cut::tube(0.97 * RADIUS, 0.4, 0.3, &plain);
    let mut mesh = plain.mesh.clone();
    let place = |p: &mut DVec3| *p = *p * k + by;
    mesh.positions.iter_mut().for_each(place);
    cut.marks.body.iter_mut().flat_map(|m| &mut m.points).for_each(place);
    let scale = |p: &mut DVec2| *p *= k;
    cut.marks.cloth.iter_mut().flat_map(|m| &mut m.points).for_each(scale);
    for piece in cut.pattern.pieces.values_mut() {
        Arc::make_mut(piece).outline.iter_mut().for_each(|edge| scale(&mut edge.start));
    }
    let body = Arc::new(Surface::new(mesh).expect("a body"));
    let plain = RelaxSettings::default();
    let settings = RelaxSettings { gravity: plain.gravity / k, ..plain };
    wrapped(&cut.pattern, &cut.marks, &body, settings, EDGE * k).1.positions
}

fn apart(k: f64, by: DVec3) -> f64 {
    let one = places(1.0, DVec3::ZERO);
    let other = places(k, by);
    assert_eq!(one.len(), other.len());
    let apart = one.iter().zip(&other).map(|(a, b)| a.distance((*b - by) / k)).fold(0.0, f64::max) / EDGE;
    println!("{k} times, by {by}: {apart:.2e} l");
    apart
}

#[test]
fn size_does_not_matter() {
    for k in [1e-3, 0.37, 4.0, 1e3] {
        let apart = apart(k, DVec3::ZERO);
        assert!(apart < 1e-4, "{k}: {apart} l");
    }
}

#[test]
fn place_does_not_matter() {
    for by in [DVec3::new(0.3, -7.1, 2.9), DVec3::new(1e4, -1e4, 1e4)] {
        let apart = apart(1.0, by);
        assert!(apart < 1e-4, "{by}: {apart} l");
    }
}
