//! Garments made by others, sewn from where their files place them and draped, with no setting of their own.

use std::sync::Arc;

use toile::body::{Unit, import};
use toile::fit::{BodyIndex, Report, measure};
use toile::io::{garmentcode, obj};
use toile::session::body::Body;
use toile::session::placing::brought;
use toile::session::{BodyChoice, Command, Document, Project, Session, Settings};
use toile::sim::{Runner, Simulation};
use toile::wrap::Phase;

/// Metres.
const EDGE_LENGTH: f64 = 0.02;

fn sewn(pattern: &str, edge_length: f64) -> Option<Report> {
    let pattern = format!("garmentcode/{pattern}_specification.json");
    sewn_on("garmentcode/mean_all.obj", &pattern, edge_length)
}

/// Of the pattern in this file, on the body in that one.
fn sewn_on(body: &str, pattern: &str, edge_length: f64) -> Option<Report> {
    let bytes = crate::bytes(&format!("bodies/{body}"))?;
    let body = import(obj::read(&bytes).expect("an OBJ").mesh, Unit::Metre);
    let pattern = garmentcode::read(&crate::bytes(&format!("patterns/{pattern}"))?).expect("GarmentCode");
    let mut document = Document {
        pattern: Arc::new(pattern),
        body: BodyChoice::Imported { name: "mean".to_owned(), mesh: Arc::new(body.mesh) },
        settings: Settings { edge_length, ..Settings::default() },
        ..Document::default()
    };
    let body = Body::new(&document.body).expect("a body that cloth can lie on");
    let moved = brought(&document.pattern, &document, &body);
    moved.carry_out(Arc::make_mut(&mut document.pattern));
    let project = Project { document, dressed: None };
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Sew).expect("placed");
    while s.runner().simulation().expect("inline").tick() {}
    s.update();
    let snapshot = s.snapshot();
    assert_eq!(snapshot.phase, Some(Phase::AtRest));
    let (garment, cloth) = snapshot.drawn().expect("a garment");
    let (source, body) =
        (snapshot.source.as_ref().expect("a source"), snapshot.body.as_ref().expect("a body"));
    Some(measure(&source.pattern, garment, cloth, &BodyIndex::new(body)))
}

/// Sewn, nothing in the body, the body through all its openings. Stretch only: where cloth is gathered its edges along the seam
/// are as much shorter as it is gathered.
fn check(pattern: &str, openings: usize, p99: f64, crossings: usize) {
    check_of((pattern, EDGE_LENGTH), openings, p99, crossings);
}

/// The same with edges so long, metres.
fn check_of((pattern, edge_length): (&str, f64), openings: usize, p99: f64, crossings: usize) {
    let Some(report) = sewn(pattern, edge_length) else { return };
    println!("{pattern}: p99 {:.4}, {} self crossings", report.strain.p99, report.self_crossings);
    assert_eq!((report.pieces_in_space, report.unmapped_vertices), (1, 0), "{pattern}");
    assert_eq!(report.openings.iter().filter(|o| o.body_through).count(), openings, "{pattern}");
    assert_eq!(report.penetration.vertices + report.penetration.faces, 0, "{pattern}");
    assert_eq!(report.edges_through_body + report.body_edges_through_garment, 0, "{pattern}");
    assert!(report.self_crossings <= crossings, "{pattern}: {} self crossings", report.self_crossings);
    assert!(report.strain.stretch_p99 <= p99, "{pattern}: p99 stretch {}", report.strain.stretch_p99);
}

#[test]
fn the_gathered_skirt_is_sewn_and_draped() {
    check("skirt2_mean_all", 2, 0.04, 0);
}

/// Legs that are wide for their body begin in each other: their flat pieces overlap where they are placed.
#[test]
fn trousers_are_sewn_and_their_legs_come_apart() {
    check("pants_mean_all", 3, 0.07, 0);
}

#[test]
fn the_tee_is_sewn_round_armpits_in_which_skin_meets_skin() {
    check("tee_mean_all", 4, 0.07, 0);
}

/// Straps that were placed lower than the shoulders, and armholes wide enough for the arms to slip out of.
#[test]
fn a_sleeveless_dress_hangs_from_the_shoulders() {
    check("rand_1003", 4, 0.02, 0);
}

#[test]
fn a_hood_is_sewn_with_its_bodice_on_the_shoulders() {
    check("hoody_mean", 4, 0.03, 0);
}

#[test]
fn a_jumpsuit_has_arms_and_legs_in_its_sleeves_and_legs() {
    check("js_mean_all", 5, 0.08, 0);
}

/// A fold in an armpit was drawn past shut: it is laid smooth.
#[test]
fn a_shirt_does_not_run_through_itself() {
    check("shirt_mean", 4, 0.07, 0);
}

/// Its sleeves slide along the arms while they are sewn, until both sides of a seam lie below: the seam still closes above.
#[test]
fn a_jumpsuit_of_larger_triangles_has_its_arms_in_its_sleeves() {
    check_of(("js_mean_all", 0.025), 5, 0.10, 0);
}

/// Placed for arms half down, and for a body whose file counts from elsewhere.
#[test]
fn pieces_placed_for_another_body_are_sewn_round_this_one() {
    let cases = [
        ("garmentcode/mean_all_tpose.obj", "garmentcode/shirt_mean_specification.json", 4, 0.03),
        ("makehuman/mh_male_rest.obj", "garmentcode/shirt_mean_specification.json", 4, 0.07),
        ("makehuman/mh_female_tpose.obj", "garment-pattern-generator/pants_straight_sides.json", 3, 0.045),
        ("makehuman/mh_female_tpose.obj", "garment-pattern-generator/skirt_4_panels.json", 2, 0.02),
    ];
    for (body, pattern, openings, p99) in cases {
        let Some(report) = sewn_on(body, pattern, EDGE_LENGTH) else { return };
        println!("{pattern} on {body}: p99 {:.4}, {} crossings", report.strain.p99, report.self_crossings);
        assert_eq!((report.pieces_in_space, report.unmapped_vertices), (1, 0), "{pattern}");
        assert_eq!(report.openings.iter().filter(|o| o.body_through).count(), openings, "{pattern}");
        assert_eq!(report.self_crossings, 0, "{pattern} on {body}");
        assert_eq!((report.penetration.vertices, report.edges_through_body), (0, 0), "{pattern} on {body}");
        assert!(report.strain.p99 < p99, "{pattern} on {body}: {}", report.strain.p99);
    }
}
