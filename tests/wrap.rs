//! Wrapping against exact answers.

mod common;

use std::sync::Arc;

use common::{cylinder, lowest, quantile, strains, tube, tube_marks};
use toile::body::Surface;
use toile::cloth::{ClothState, Garment, build};
use toile::pattern::Pattern;
use toile::relax::RelaxSettings;
use toile::wrap::{Dressing, Marks, Phase};

const RADIUS: f64 = 0.15;
const OFFSET: f64 = 0.004;

fn settings(surface: &Surface) -> RelaxSettings {
    RelaxSettings { offset: OFFSET / surface.scale(), ..RelaxSettings::default() }
}

fn dressed(pattern: &Pattern, marks: &Marks, edge: f64) -> (Arc<Garment>, Arc<Surface>, ClothState, usize) {
    let (garment, problems) = build(pattern, edge);
    assert!(problems.is_empty(), "{problems:?}");
    let surface = Arc::new(Surface::new(cylinder(RADIUS, 1.0, 128, 60)).expect("a body"));
    let garment = Arc::new(garment);
    let (dressing, mut state, problems) =
        Dressing::new(garment.clone(), surface.clone(), marks, settings(&surface));
    assert!(problems.is_empty(), "{problems:?}");
    let mut dressing = dressing.expect("a dressing");
    let mut ticks = 0;
    while dressing.step(&mut state) != Phase::AtRest {
        ticks += 1;
        assert!(ticks < 1000);
    }
    (garment, surface, state, ticks)
}

#[test]
fn a_tube_that_fits_wraps_a_cylinder_without_strain() {
    // As long round as the offset surface: B11.
    let width = std::f64::consts::PI * (RADIUS + OFFSET);
    let pattern = tube(width, 0.5);
    let marks = tube_marks(&pattern, width, 0.5, RADIUS, 0.25);
    let (garment, surface, state, ticks) = dressed(&pattern, &marks, 0.02);
    let strains = strains(&garment, &state);
    println!("ticks {ticks} p99 {} max {}", quantile(&strains, 0.99), quantile(&strains, 1.0));
    assert!(state.mapped.iter().all(|&m| m));
    assert!(quantile(&strains, 0.99) < 0.005, "p99 strain {}", quantile(&strains, 0.99));
    assert!(lowest(&surface, &state) > 0.5 * OFFSET, "lowest {}", lowest(&surface, &state));
}

#[test]
fn a_loose_tube_closes_round_a_cylinder() {
    let width = 1.2 * std::f64::consts::PI * RADIUS;
    let pattern = tube(width, 0.4);
    let marks = tube_marks(&pattern, width, 0.4, RADIUS, 0.3);
    let (garment, surface, state, ticks) = dressed(&pattern, &marks, 0.02);
    let strains = strains(&garment, &state);
    println!("ticks {ticks} p99 {} max {}", quantile(&strains, 0.99), quantile(&strains, 1.0));
    assert!(quantile(&strains, 0.99) < 0.02);
    assert!(lowest(&surface, &state) > 0.0);
}
