//! What strain is left in a dressed garment is the cut's, not the solver's: relaxed on until it has converged, without
//! weight and friction, it is strained nearly as much. And it is said where.

use std::sync::Arc;

use toile::body::{Surface, mannequin};
use toile::cloth::build;
use toile::fit::{self, BodyIndex};
use toile::relax::GlobalStep;
use toile::session::samples::Sample;
use toile::wrap::{Dressing, Phase, coarser};

use crate::common::exact::{quantile, strains};

/// Metres: coarse, to be quick.
const EDGE: f64 = 0.03;
/// Beyond rest.
const STEPS: usize = 3000;
/// Of strain: so near to the converged minimum it has to lie.
const NEAR: f64 = 0.01;

/// Dresses the mannequin, compares with the converged minimum, and returns the tightest place.
fn check(sample: Sample) -> Option<fit::Tight> {
    let project = sample.project(&mannequin::default());
    let (pattern, marks) = (&*project.document.pattern, &*project.document.marks);
    let relax = project.document.settings.relax;
    let body = Arc::new(Surface::new(mannequin::default().mesh.clone()).expect("a body"));
    let garment = Arc::new(build(pattern, EDGE).0);
    let coarse = coarser(pattern, &garment, EDGE, body.scale());
    let (dressing, mut state, _) =
        Dressing::coarse_to_fine(&coarse, garment.clone(), body.clone(), marks, relax);
    let mut dressing = dressing.expect("marks");
    while dressing.step(&mut state) != Phase::AtRest {}
    let report = fit::measure(pattern, &garment, &state, &BodyIndex::new(&body));
    let tight = fit::tightest(&report, &garment, &state, || body.landmarks());

    let mut relaxer = dressing.relaxer().expect("at rest").clone();
    let mut converged = state.clone();
    let cap = 0.02 * body.scale();
    let step = GlobalStep { cap, contact: 0.03, hold: 0.0, slack: 0.0, unfold: true, weight: false };
    (0..STEPS).for_each(|_| {
        relaxer.global_step(&mut converged, step);
    });
    let [rest, least] = [&state, &converged].map(|state| quantile(&strains(&garment, state), 0.99));
    println!("{}: p99 {:.2} %, converged {:.2} %, {tight:?}", sample.name(), rest * 100.0, least * 100.0);
    assert!(rest < least + NEAR, "{}: p99 {rest:.4}, converged {least:.4}", sample.name());
    assert_eq!(tight.is_some(), report.strain.p99 > 0.02);
    tight
}

#[test]
fn a_tshirt_at_rest_is_near_its_converged_minimum() {
    let tight = check(Sample::Tshirt).expect("it is tight");
    assert!(tight.landmark.is_some() && !tight.piece.is_empty());
}

#[test]
fn a_skirt_at_rest_is_near_its_converged_minimum() {
    let tight = check(Sample::Skirt).expect("it is tight");
    assert!(tight.landmark.is_some_and(|name| name.contains("waist") || name.contains("hip")));
}
