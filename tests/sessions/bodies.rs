//! Marks last when the body is changed.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use toile::body::mannequin::{Measurements, mannequin};
use toile::body::{Mannequin, Surface};
use toile::geometry::ids::MarkId;
use toile::geometry::mesh::TriMesh;
use toile::session::samples::Sample;
use toile::session::{BodyChoice, Command, Document, Project, Session};
use toile::sim::{Runner, Simulation};

use crate::common::{ball, line_on_ball, session};

fn imported(mesh: TriMesh) -> BodyChoice {
    BodyChoice::Imported { name: "another".to_owned(), mesh: Arc::new(mesh) }
}

fn opened(project: Project) -> Session {
    Session::new(project, Runner::inline(Simulation::default()))
}

fn set(s: &mut Session, body: BodyChoice) {
    s.apply_alone(Command::SetBody { body, animations: None }).expect("set");
}

fn tall() -> Arc<Mannequin> {
    let usual = Measurements::default();
    let tall = Measurements { height: 1.86, bust: 1.0, waist: 0.79, abdomen: 0.93, hip: 1.05, ..usual };
    mannequin(&tall).expect("a figure")
}

/// Where the strokes of `document` on the body are lost, or how far they are from those of `other` at most.
fn apart(document: &Document, other: &Document) -> f64 {
    let (a, b) = (&document.marks.body, &other.marks.body);
    assert_eq!((a.len(), document.marks.cloth.len()), (b.len(), other.marks.cloth.len()));
    let ends = a.iter().zip(b).flat_map(|(a, b)| {
        let middle = |p: &[DVec3]| p[p.len() / 2];
        [a.points[0].distance(b.points[0]), middle(&a.points).distance(middle(&b.points))]
    });
    ends.fold(0.0, f64::max)
}

#[test]
fn on_the_same_body_moved_marks_follow_their_triangles() {
    let mut s = session();
    let moved = |p: DVec3| DQuat::from_rotation_y(0.4) * p * 1.3 + DVec3::X;
    let mut mesh = ball(0.75, 24, 48);
    let surface = Surface::new(mesh.clone()).expect("a ball");
    let before: Vec<DVec3> =
        s.document().marks.body[0].points.iter().map(|&p| surface.nearest(p).point).collect();
    mesh.positions.iter_mut().for_each(|p| *p = moved(*p));
    set(&mut s, imported(mesh));
    assert_eq!(s.problems(), []);
    for (p, q) in before.iter().zip(&s.document().marks.body[0].points) {
        assert!((moved(*p) - *q).length() < 1e-6, "{p} {q}");
    }
}

#[test]
fn another_figure_takes_the_marks_over_by_landmarks() {
    let (usual, tall) = (toile::body::mannequin::default(), tall());
    for sample in Sample::MARKED {
        let mut s = opened(sample.project(&usual));
        set(&mut s, BodyChoice::Mannequin(tall.measurements));
        assert_eq!(s.problems(), [], "{}", sample.name());
        let drafted = sample.project(&tall).document;
        let apart = apart(s.document(), &drafted);
        println!("{}: {:.1} cm", sample.name(), apart * 100.0);
        // The scarf is drafted to a length of its own, not to the figure's.
        assert!(apart < if sample == Sample::Scarf { 0.08 } else { 0.03 }, "{}: {apart}", sample.name());
        let skin = s.surface().expect("a figure").clone();
        let marks = &s.document().marks;
        let points = marks.body.iter().flat_map(|m| &m.points);
        assert!(points.into_iter().all(|&p| skin.nearest(p).distance.abs() < 1e-6));
        set(&mut s, BodyChoice::default());
        let apart = self::apart(s.document(), &sample.project(&usual).document);
        assert!(apart < 0.015, "{} and back: {apart}", sample.name());
    }
}

#[test]
fn an_imported_figure_takes_the_marks_over_by_landmarks_found_on_both() {
    let (usual, tall) = (toile::body::mannequin::default(), tall());
    let mut s = opened(Sample::Tshirt.project(&usual));
    set(&mut s, imported(tall.mesh.clone()));
    assert_eq!(s.problems(), []);
    let by_found = s.document().clone();
    s.apply_alone(Command::Undo).expect("undone");
    set(&mut s, BodyChoice::Mannequin(tall.measurements));
    let apart = apart(s.document(), &by_found);
    assert!(apart < 0.03, "{apart}");
}

#[test]
fn a_mark_knows_the_landmark_it_passes() {
    let figure = toile::body::mannequin::default();
    let mut s = opened(Sample::Tshirt.project(&figure));
    let id = s.document().last_mark + 1;
    let waist = figure.landmarks.get("waist_front").expect("a waist");
    s.apply_alone(Command::AddBodyMark { points: vec![waist] }).expect("painted");
    assert_eq!(s.document().marks.landmark(MarkId(id)), Some("waist_front"));
}

#[test]
fn what_is_lost_leaves_the_other_pairs_pairs() {
    // On a figure, with one mark that hangs in the air beside it.
    let figure = toile::body::mannequin::default();
    let mut s = opened(Sample::Tshirt.project(&figure));
    let first = s.document().marks.body[0].id;
    let lost = s.document().marks.cloth[0].id;
    let pairs = s.document().marks.cloth.len();
    s.apply_alone(Command::DeleteMark { mark: first }).expect("deleted");
    s.apply_alone(Command::AddBodyMark { points: vec![DVec3::new(3.0, 1.0, 0.0)] }).expect("painted");
    let air = s.document().last_mark;
    s.apply_alone(Command::MoveMark { mark: MarkId(air), to: 1 }).expect("moved");
    s.apply_alone(Command::RenameMark { mark: MarkId(air), name: "air".to_owned() }).expect("named");
    let partners: Vec<_> = s.document().marks.pairs().map(|(c, b)| (c.id, b.id)).skip(1).collect();
    set(&mut s, BodyChoice::Mannequin(tall().measurements));
    let marks = &s.document().marks;
    assert_eq!(s.problems()[0].place, "mark 1 (air)");
    assert_eq!(marks.pairs().map(|(c, b)| (c.id, b.id)).collect::<Vec<_>>(), partners);
    assert_eq!((marks.cloth.len(), marks.cloth.last().map(|m| m.id)), (pairs, Some(lost)));
    assert!(marks.names.is_empty() && !marks.ties.contains_key(&MarkId(air)));
    let before = s.document().clone();
    s.apply_alone(Command::Undo).expect("undone");
    assert!(s.problems().is_empty());
    s.apply_alone(Command::Redo).expect("redone");
    assert_eq!((s.document(), s.problems().len()), (&before, 1));
    s.apply_alone(Command::AddBodyMark { points: line_on_ball(0.75, 0.1, 0.1) }).expect("painted");
    assert!(s.problems().is_empty(), "told until the marks are changed");
}
