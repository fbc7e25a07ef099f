//! Cloth and bodies of every size that there is: dolls and statues, one triangle and half a million, beside the origin and a
//! kilometre away. Wrapped, dragged, draped and measured, everything is finite and lies on the body.
//!
//! Draping is left out on dolls and with the finest triangles: where fabric is as thick as an edge is long, small steps hold it
//! apart everywhere, slowly, and throw it off a body of half a metre.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::drag::{DragMode, Ray};
use toile::fit::{BodyIndex, measure};
use toile::geometry::ids::PieceId;
use toile::pattern::{Pattern, Piece};
use toile::session::{BodyChoice, Command, Project, Session};
use toile::sim::{Runner, Simulation};

use crate::common::{self, ball, run};

/// The two patches on their ball, all of it `size` times as large and `away` from where it was, metres.
fn scaled(size: f64, edge_length: f64, away: DVec3) -> Project {
    let mut project = common::project();
    let document = &mut project.document;
    let BodyChoice::Imported { mesh, .. } = &mut document.body else { panic!("a ball") };
    for p in &mut Arc::make_mut(mesh).positions {
        *p = *p * size + away;
    }
    for piece in Arc::make_mut(&mut document.pattern).pieces.values_mut() {
        Arc::make_mut(piece).outline.iter_mut().for_each(|edge| edge.start *= size);
    }
    let marks = Arc::make_mut(&mut document.marks);
    marks.cloth.iter_mut().flat_map(|mark| &mut mark.points).for_each(|p| *p *= size);
    marks.body.iter_mut().flat_map(|mark| &mut mark.points).for_each(|p| *p = *p * size + away);
    document.settings.edge_length = edge_length;
    project
}

fn farthest(session: &Session, about: DVec3, reach: f64, when: &str) {
    let far = session.snapshot().cloth.positions.iter().map(|p| p.distance(about)).fold(0.0, f64::max);
    assert!(far <= reach, "{when}, a vertex is {far} m away");
}

/// Wraps, drags and, with `drapes`, drapes; where the cloth lies after the wrap. What is not finite or farther than `reach` from `about` fails.
fn worked(project: Project, about: DVec3, reach: f64, drapes: bool) -> Vec<DVec3> {
    let mut session = Session::new(project, Runner::inline(Simulation::default()));
    session.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut session, 2000);
    let wrapped = session.snapshot().clone();
    assert!(wrapped.is_dressed() && !wrapped.working, "{:?}", wrapped.problems);
    farthest(&session, about, reach, "wrapped");
    let piece = *session.document().pattern.pieces.keys().next().expect("a piece");
    let gesture = session.begin_gesture();
    let (garment, cloth) = wrapped.drawn().expect("cloth");
    let at = garment.corners.iter().find(|corner| corner.piece == piece).expect("a corner");
    let from = cloth.positions[at.vertex as usize];
    let grab = Command::Grab { piece, at: at.uv, mode: DragMode::Surface };
    session.apply(grab, gesture).expect("taken in the hand");
    let out = (from - about).normalize_or_zero();
    let ray = Ray { origin: from + out * reach + DVec3::Y * (0.05 * reach), direction: -out };
    session.apply(Command::DragTo { ray }, gesture).expect("dragged");
    run(&mut session, 20);
    session.apply(Command::Release, gesture).expect("let go");
    session.end_gesture(gesture);
    run(&mut session, 200);
    farthest(&session, about, reach, "let go");
    if drapes {
        session.apply_alone(Command::StepDraping { ticks: 20 }).expect("draped");
        run(&mut session, 40);
        farthest(&session, about, reach, "draped");
    }
    let snapshot = session.snapshot();
    let (garment, cloth) = snapshot.drawn().expect("cloth");
    let body = BodyIndex::new(snapshot.body.as_ref().expect("a body"));
    let report = measure(&session.document().pattern, garment, cloth, &body);
    assert!(report.strain.max.is_finite() && report.not_finite_vertices == 0, "{:?}", report.strain);
    wrapped.cloth.positions.clone()
}

#[test]
fn dolls_and_statues_are_dressed() {
    // The ball is 1.5 m large: 1 cm to 10 m.
    for (height, edge) in [(0.01, 0.002), (0.1, 0.004), (0.5, 0.02), (1.5, 0.06), (5.0, 0.2), (10.0, 0.2)] {
        let size = height / 1.5;
        println!("{height} m");
        worked(scaled(size, edge, DVec3::ZERO), DVec3::ZERO, 2.0 * height, height == 1.5);
    }
}

#[test]
fn the_finest_and_the_coarsest_triangles_are_wrapped() {
    worked(scaled(0.08, 0.002, DVec3::ZERO), DVec3::ZERO, 0.24, false);
    worked(scaled(1.0, 0.2, DVec3::ZERO), DVec3::ZERO, 3.0, true);
}

#[test]
fn a_kilometre_away_cloth_lies_as_it_does_here() {
    let away = DVec3::new(1000.0, 0.0, -1000.0);
    let here = worked(scaled(1.0, 0.06, DVec3::ZERO), DVec3::ZERO, 3.0, true);
    let there = worked(scaled(1.0, 0.06, away), away, 3.0, true);
    let off = here.iter().zip(&there).map(|(h, t)| h.distance(*t - away)).fold(0.0, f64::max);
    println!("at most {off:e} m off");
    assert!(here.len() == there.len() && off < 1e-3, "{off} m");
}

#[test]
fn cloth_of_one_two_and_three_triangles_is_dressed() {
    for corners in [3, 4, 5] {
        let about = |i: i32| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(corners);
            DVec2::new(0.125, 0.15) + DVec2::from_angle(angle) * 0.09
        };
        let points: Vec<DVec2> = (0..corners).map(about).collect();
        let mut project = common::project();
        let mut pattern = Pattern::default();
        let piece = pattern.add_piece(Piece::polygon("patch", &points));
        project.document.pattern = Arc::new(pattern);
        let marks = Arc::make_mut(&mut project.document.marks);
        marks.cloth.retain(|mark| mark.piece == PieceId(1));
        marks.cloth.iter_mut().for_each(|mark| mark.piece = piece);
        marks
            .cloth
            .iter_mut()
            .for_each(|mark| mark.points = vec![DVec2::new(0.1, 0.15), DVec2::new(0.15, 0.15)]);
        marks.body.truncate(marks.cloth.len());
        project.document.settings.edge_length = 0.2;
        let positions = worked(project, DVec3::ZERO, 2.0, true);
        assert_eq!(positions.len() as i32, corners, "{} triangles", corners - 2);
    }
}

#[test]
fn a_body_of_half_a_million_triangles_is_dressed() {
    let mut project = common::project();
    let mesh = ball(0.75, 501, 500);
    assert_eq!(mesh.triangles.len(), 500_000);
    project.document.body = BodyChoice::Imported { name: "ball".to_owned(), mesh: Arc::new(mesh) };
    worked(project, DVec3::ZERO, 3.0, true);
}
