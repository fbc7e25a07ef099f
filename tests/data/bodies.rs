//! Bodies made by others.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::{DVec2, DVec3};
use toile::body::readings::readings;
use toile::body::{Imported, Surface, Unit, guess_unit, import, landmarks};
use toile::io::obj;
use toile::session::body::surface_of;
use toile::session::{BodyChoice, Command, Document, Project, Session};
use toile::sim::{Runner, Simulation};

fn bytes(name: &str) -> Option<Vec<u8>> {
    crate::bytes(&format!("bodies/{name}"))
}

fn body(name: &str) -> Option<Imported> {
    let read = obj::read(&bytes(name)?).unwrap_or_else(|e| panic!("{name}: {e}"));
    Some(import(read.mesh, Unit::Metre))
}

/// Vertices, triangles, height and volume of a body that is closed, manifold and outward as it comes.
fn check(name: &str, vertices: usize, triangles: usize, height: f64, volume: f64) {
    let Some(body) = body(name) else { return };
    let report = &body.report;
    assert!(body.is_usable(), "{name}: {:?}", body.problems);
    assert_eq!((report.vertices, report.triangles, report.components), (vertices, triangles, 1), "{name}");
    assert_eq!((report.turned_triangles, report.inverted, report.welded_vertices), (0, false, 0), "{name}");
    assert!((report.size.y - height).abs() < 6e-4, "{name}: {} m", report.size.y);
    assert!((report.volume / volume - 1.0).abs() < 1e-3, "{name}: {} cubic metres", report.volume);
}

#[test]
fn closed_bodies_are_taken_as_they_are() {
    check("makehuman/mh_base_rest.obj", 13380, 26756, 1.666, 0.0549);
    check("makehuman/mh_female_rest.obj", 13380, 26756, 1.605, 0.04956);
    check("makehuman/mh_male_rest.obj", 13380, 26756, 1.748, 0.06528);
    check("makehuman/mh_female_tpose.obj", 13380, 26756, 1.608, 0.05006);
    check("makehuman/mh_female_walk4.obj", 13380, 26756, 1.506, 0.0478);
    check("garmentcode/mean_all.obj", 23752, 47500, 1.72, 0.07296);
    check("garmentcode/mean_all_tpose.obj", 23752, 47500, 1.72, 0.07399);
    check("nonhuman/spot_low_resolution.obj", 829, 1654, 1.756, 0.6797);
    check("nonhuman/spot.obj", 11533, 23062, 1.748, 0.688);
    check("nonhuman/koala_low_resolution.obj", 3560, 7116, 5.339, 56.11);
    check("nonhuman/octopus_surface.obj", 881, 1758, 10.325, 46.15);
}

/// Heights over the height of the body, to within 3 %.
#[test]
fn landmarks_are_found_on_humans() {
    let humans = [
        ("makehuman/mh_base_rest.obj", 0.47),
        ("makehuman/mh_female_rest.obj", 0.465),
        ("makehuman/mh_male_rest.obj", 0.48),
        ("makehuman/mh_female_tpose.obj", 0.465),
        ("garmentcode/mean_all.obj", 0.455),
        ("garmentcode/mean_all_tpose.obj", 0.455),
    ];
    for (name, crotch) in humans {
        let Some(body) = body(name) else { return };
        let found = landmarks::found(&body.mesh).unwrap_or_else(|| panic!("{name}"));
        let share = |l: &str| (found.get(l).expect(l).y - body.report.lowest) / body.report.size.y;
        let heights = ["crotch", "waist_front", "throat_front", "crown"].map(share);
        println!(
            "{name}: {heights:.3?} shoulder {:.3} hip {:.3}",
            share("shoulder_left"),
            share("hip_front")
        );
        for (height, wanted) in heights.into_iter().zip([crotch, 0.65, 0.86, 1.0]) {
            assert!((height - wanted).abs() < 0.03, "{name}: {heights:?}");
        }
        assert!((0.78..0.85).contains(&share("shoulder_right")), "{name}");
        let [left, right] = ["hand_left", "hand_right"].map(|l| found.get(l).expect(l).x);
        assert!(left > 0.35 && (left + right).abs() < 0.01, "{name}: {left} {right}");
        let arms_hang = !name.contains("tpose");
        assert_eq!(found.get("forearm_left_front").is_some(), arms_hang, "{name}");
    }
}

/// What the body's own list of measures says, where it means the same, in centimetres.
#[test]
fn a_body_reads_as_its_makers_say() {
    let Some(body) = body("garmentcode/mean_all.obj") else { return };
    let found = readings(&body.mesh, None).expect("a human");
    for (name, told) in [
        ("height", 171.99),
        ("bust", 99.84),
        ("underbust", 86.25),
        ("waist", 84.33),
        ("hip", 103.48),
        ("thigh", 60.20),
        ("wrist", 16.59),
        // Height less the head's.
        ("nape height", 145.66),
        ("back neck to waist", 36.89),
        ("shoulder width", 36.46),
        ("arm length", 53.97),
    ] {
        let read = found.iter().find(|r| r.name == name).expect(name).metres * 100.0;
        assert!((read - told).abs() < 1.0, "{name}: told {told} cm, read {read:.2} cm");
    }
}

#[test]
fn animals_have_no_landmarks() {
    for name in ["spot.obj", "koala_low_resolution.obj", "octopus_surface.obj"] {
        let Some(body) = body(&format!("nonhuman/{name}")) else { return };
        assert!(landmarks::found(&body.mesh).is_none(), "{name}");
    }
}

#[test]
fn an_open_scan_is_refused_in_words() {
    let Some(body) = body("nonhuman/demosthenes-low-res.obj") else { return };
    assert_eq!(body.report.open_edges, 67);
    assert!(body.problems[0].words.contains("the body is open: 67 edges"), "{:?}", body.problems);
}

#[test]
fn tetrahedra_are_no_body() {
    let Some(bytes) = bytes("nonhuman/octopus_original_tet.obj") else { return };
    let start = Instant::now();
    let error = obj::read(&bytes).expect_err("no faces").to_string();
    assert!(error.contains("977 vertices but no faces") && error.contains("\"t\""), "{error}");
    assert!(start.elapsed() < Duration::from_secs(1));
}

#[test]
fn an_original_with_helpers_is_told_apart() {
    let Some(body) = body("makehuman/original/base.obj") else { return };
    assert!(body.report.components > 1);
    assert_eq!(guess_unit(body.report.size.y), Some(Unit::Decimetre));
    assert!(body.notes.iter().any(|n| n.contains("--unit dm")), "{:?}", body.notes);
}

#[test]
fn guesses_of_units_are_right_or_missing() {
    let height = |name| body(name).map(|b| b.report.size.y);
    let Some(human) = height("garmentcode/mean_all.obj") else { return };
    assert_eq!(guess_unit(human), Some(Unit::Metre));
    assert_eq!(guess_unit(human * 100.0), Some(Unit::Centimetre));
    assert_eq!(guess_unit(human / 0.0254), Some(Unit::Inch));
}

/// Place along an arm (0 at the shoulder, 1 at the hand) and way out of it: up as it is spread, and to the front.
fn on_arm(body: &Surface, side: &str) -> impl Fn(DVec3) -> (f64, DVec2) {
    let found = landmarks::found(&body.mesh).expect("a human");
    let [shoulder, hand] = ["shoulder", "hand"].map(|l| found.get(&format!("{l}_{side}")).expect("an arm"));
    let along = (hand - shoulder).normalize();
    let front = (DVec3::Z - along * along.z).normalize();
    let up = DVec3::Y - along * along.y;
    let surface = body;
    move |p| {
        let normal = surface.nearest(p).normal;
        let share = (p - shoulder).dot(along) / shoulder.distance(hand);
        (share, DVec2::new(normal.dot(up.normalize()), normal.dot(front)).normalize())
    }
}

/// Dressing projects between poses: what is painted along the arms of one body finds the arms of the other.
#[test]
fn marks_on_arms_are_carried_between_spread_and_half_spread_arms() {
    let names = ["garmentcode/mean_all.obj", "makehuman/mh_female_tpose.obj", "makehuman/mh_female_rest.obj"];
    let bodies: Vec<_> = names.into_iter().filter_map(body).map(|b| Arc::new(b.mesh)).collect();
    let choice = |i: usize| BodyChoice::Imported { name: names[i].to_owned(), mesh: Arc::clone(&bodies[i]) };
    if bodies.is_empty() {
        return;
    }
    for (from, to) in [(0, 1), (1, 0), (1, 2), (2, 1), (0, 2)] {
        let document = Document { body: choice(from), ..Document::default() };
        let runner = Runner::inline(Simulation::default());
        let mut session = Session::new(Project { document, dressed: None }, runner);
        let surface = surface_of(&choice(from)).expect("a body");
        let found = landmarks::found(&surface.mesh).expect("a human");
        let mut painted = Vec::new();
        for side in ["left", "right"] {
            let [shoulder, hand] =
                ["shoulder", "hand"].map(|l| found.get(&format!("{l}_{side}")).expect("an arm"));
            for way in [DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z] {
                let line = (0..=10).map(|k| shoulder.lerp(hand, 0.4 + 0.03 * f64::from(k)) + way * 0.08);
                let points: Vec<DVec3> = line.map(|p| surface.nearest(p).point).collect();
                painted.push((side, points.clone()));
                session.apply_alone(Command::AddBodyMark { points }).expect("painted");
            }
        }
        session.apply_alone(Command::SetBody { body: choice(to), animations: None }).expect("taken");
        assert_eq!(session.problems(), [], "{} to {}", names[from], names[to]);
        let there = surface_of(&choice(to)).expect("a body");
        for ((side, before), mark) in painted.iter().zip(&session.document().marks.body) {
            let [was, is] = [(&surface, before), (&there, &mark.points)].map(|(body, points)| {
                let place = on_arm(body, side);
                [points[0], points[points.len() - 1]].map(place)
            });
            for ((was, out), (is, now_out)) in was.into_iter().zip(is) {
                assert!((was - is).abs() < 0.12, "{} to {}: {was} {is}", names[from], names[to]);
                assert!(out.dot(now_out) > 0.5, "{} to {}: {out:?} {now_out:?}", names[from], names[to]);
            }
        }
    }
}
