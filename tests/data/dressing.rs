//! Garments and a body made by others, dressed with the marks proposed from their placement.

use std::sync::Arc;

use toile::body::{Surface, Unit, import};
use toile::cloth::build;
use toile::fit::{BodyIndex, Report, measure, verdict};
use toile::io::{garmentcode, obj};
use toile::relax::RelaxSettings;
use toile::wrap::{Dressing, Phase, coarser, suggested};

/// Metres.
const EDGE: f64 = 0.02;

/// What the patterns of GarmentCode were drafted and placed for.
const MEAN: &str = "bodies/garmentcode/mean_all.obj";
const MEAN_TPOSE: &str = "bodies/garmentcode/mean_all_tpose.obj";
const FEMALE: &str = "bodies/makehuman/mh_female_rest.obj";
const MALE: &str = "bodies/makehuman/mh_male_rest.obj";

fn dressed(pattern: &str, body: &str) -> Option<Report> {
    let bytes = crate::bytes(body)?;
    let body = import(obj::read(&bytes).expect("an OBJ").mesh, Unit::Metre);
    assert!(body.problems.is_empty(), "{:?}", body.problems);
    let surface = Arc::new(Surface::new(body.mesh).expect("triangles"));
    let bytes = crate::bytes(&format!("patterns/garmentcode/{pattern}"))?;
    let pattern = garmentcode::read(&bytes).expect("GarmentCode");
    let settings = RelaxSettings::default();
    let marks = suggested(&pattern, &surface, settings.offset * surface.scale());
    let (garment, _) = build(&pattern, EDGE);
    let garment = Arc::new(garment);
    let coarser = coarser(&pattern, &garment, EDGE, surface.scale());
    let (dressing, mut state, problems) =
        Dressing::coarse_to_fine(&coarser, garment.clone(), surface.clone(), &marks, settings);
    assert!(problems.is_empty(), "{problems:?}");
    let mut dressing = dressing.expect("a dressing");
    while dressing.step(&mut state) != Phase::AtRest {}
    Some(measure(&pattern, &garment, &state, &BodyIndex::new(&surface)))
}

fn check(pattern: &str, openings: usize, p99: f64) {
    check_on(MEAN, pattern, openings, p99);
}

fn check_on(body: &str, pattern: &str, openings: usize, p99: f64) {
    let pattern = &format!("{pattern}_specification.json");
    let Some(report) = dressed(pattern, body) else { return };
    println!(
        "{pattern} on {body}: p99 strain {:.4}, {} self crossings",
        report.strain.p99, report.self_crossings
    );
    assert_eq!(verdict(&report), [], "{pattern}");
    assert_eq!(report.pieces_in_space, 1);
    assert_eq!(report.openings.iter().filter(|o| o.body_through).count(), openings, "{pattern}");
    assert_eq!(report.penetration.vertices + report.penetration.faces, 0, "{pattern}");
    assert_eq!(report.edges_through_body + report.body_edges_through_garment, 0, "{pattern}");
    assert_eq!(report.flipped_faces, 0, "{pattern}");
    assert!(report.strain.p99 <= p99, "{pattern}: p99 strain {}", report.strain.p99);
}

#[test]
fn the_tee_is_dressed() {
    check("tee_mean_all", 4, 0.10);
}

#[test]
fn short_trousers_are_dressed() {
    check("pants_mean_all", 3, 0.10);
}

#[test]
fn a_circle_skirt_is_dressed() {
    check("circle_skirt_mean_all", 2, 0.10);
}

#[test]
fn a_shirt_of_an_earlier_dialect_is_dressed() {
    check("shirt_mean", 4, 0.10);
}

#[test]
fn a_hood_is_dressed() {
    check("hoody_mean", 4, 0.10);
}

/// Its hips are those of the body without the cloth: it is tight by design.
#[test]
fn a_tight_dress_stays_where_it_was_put() {
    check("dress_pencil", 4, 0.20);
}

#[test]
fn a_dress_whose_skirt_is_a_circle_is_dressed() {
    check("dress_fitted_circle_mean_all", 4, 0.10);
}

#[test]
fn deep_folds_on_other_bodies_do_not_cross() {
    for body in [FEMALE, MALE, MEAN_TPOSE] {
        check_on(body, "circle_skirt_mean_all", 2, 0.10);
        check_on(body, "dress_fitted_circle_mean_all", 4, 0.10);
    }
}

/// Its trunk is half as wide again as the body's, and gathered into the skirt.
#[test]
fn side_seams_of_a_loose_dress_close_under_the_arms() {
    check("rand_1003", 4, 0.20);
}

#[test]
fn garments_for_another_body_hang_from_the_shoulders() {
    check_on(FEMALE, "tee_mean_all", 4, 0.10);
    check_on(MALE, "shirt_mean", 4, 0.10);
}

#[test]
fn waistbands_for_another_body_rest_where_they_fit() {
    check_on(FEMALE, "pants_mean_all", 3, 0.10);
    check_on(MALE, "skirt2_mean_all", 2, 0.20);
}

/// Its sleeves are long, and leave arms held otherwise than their own unless they are led along them.
#[test]
fn long_sleeves_grow_along_another_bodys_arms() {
    check_on(MALE, "js_mean_all", 5, 0.10);
}

/// Its sleeves do not find the arms as the first plan grows them.
#[test]
fn a_jumpsuit_is_dressed_at_another_try() {
    check("js_mean_all", 5, 0.15);
}
