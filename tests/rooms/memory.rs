//! What a garment of ten thousand triangles keeps in memory.

use std::sync::Arc;

use toile::body::Surface;
use toile::cloth::build;
use toile::relax::{GlobalStep, RelaxSettings, Relaxer};

use crate::common::exact::{cylinder, rolled, tube};

/// Everything a step remembers, the faces looked at included, is below 200 bytes a triangle; the garment too, which all
/// share. Tables, factor and scratch are made from these.
#[test]
fn a_garment_keeps_less_than_two_hundred_bytes_a_triangle() {
    let width = std::f64::consts::PI * 0.154;
    let (garment, _) = build(&tube(width, 0.5), 0.0105);
    let state = rolled(&garment, width, 0.154, 0.2);
    let surface = Arc::new(Surface::new(cylinder(0.15, 1.0, 256, 4)).expect("a body"));
    let triangles = garment.triangles.len();
    assert!((9_000..12_000).contains(&triangles), "{triangles}");
    let settings = RelaxSettings::default();
    let mut relaxer = Relaxer::new(Arc::new(garment), surface, settings).expect("enough memory");
    let mut state = state;
    relaxer.set_mapped(&state.mapped);
    let step = GlobalStep { cap: 0.02, contact: 0.03, hold: 0.0, slack: 0.0, unfold: true, weight: true };
    relaxer.global_step(&mut state, step);
    relaxer.lift_faces(&state, 0.001);
    let memory = relaxer.memory();
    let each = |bytes: usize| bytes / triangles;
    println!(
        "a triangle: state {}, garment {}, tables {}, scratch {}",
        each(memory.state),
        each(memory.garment),
        each(memory.tables),
        each(memory.scratch)
    );
    assert!(each(memory.state) < 200 && each(memory.garment) < 200, "{memory:?}");
}
