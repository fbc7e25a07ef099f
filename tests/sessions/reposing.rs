//! The body takes another pose, and the dressed cloth goes along.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use toile::body::{NamedPose, mannequin};
use toile::contact::Intersections;
use toile::fit::Moved;
use toile::session::project_file;
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::samples::Sample;
use toile::session::{BodyChoice, Command, Session};
use toile::sim::{Runner, Simulation};
use toile::wrap::Phase;

use crate::common::{ball, cloth_hash, run, session};

fn turned() -> Command {
    let turn = DQuat::from_rotation_y(0.4);
    let mut mesh = ball(0.75, 24, 48);
    mesh.positions.iter_mut().for_each(|p| *p = turn * *p + DVec3::X * 0.1);
    let body = BodyChoice::Imported { name: "turned".to_owned(), mesh: Arc::new(mesh) };
    Command::Repose { body, settle: false, draft: false }
}

fn dressed() -> Session {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 2000);
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    s
}

#[test]
fn a_pose_is_undone_done_again_and_replayed_with_body_cloth_and_marks() {
    let mut s = dressed();
    let (document, before) = (s.document().clone(), cloth_hash(&mut s));
    s.apply_alone(turned()).expect("posed");
    run(&mut s, 200);
    let (posed, there) = (s.document().clone(), cloth_hash(&mut s));
    assert!(there != before && posed.body != document.body && posed.marks != document.marks);
    s.apply_alone(Command::Undo).expect("undone");
    run(&mut s, 1);
    assert!(*s.document() == document, "the document comes back");
    assert_eq!(cloth_hash(&mut s), before, "and the cloth, bit for bit");
    s.apply_alone(Command::Redo).expect("done again");
    run(&mut s, 200);
    assert!(*s.document() == posed);
    let recording = Recording::parse(&s.recording()).expect("a recording");
    Replay::new(recording).run().expect("the same hashes");
}

#[test]
fn on_the_way_to_a_pose_it_can_be_undone_changed_and_worked_on() {
    let mut s = dressed();
    let before = cloth_hash(&mut s);
    s.apply_alone(turned()).expect("posed");
    run(&mut s, 200);
    let there = cloth_hash(&mut s);
    s.update();
    assert!(s.snapshot().is_carried);
    let lying = Arc::clone(&s.snapshot().cloth);
    s.apply_alone(Command::Undo).expect("undone");

    let posing = |s: &mut Session| s.runner().simulation().expect("inline").is_posing();
    s.apply_alone(turned()).expect("posed");
    assert!(posing(&mut s), "it is done in ticks");
    s.update();
    let snapshot = s.snapshot().clone();
    assert!(snapshot.is_posing && s.can_undo_pose());
    let (shown, body) = (snapshot.body.as_ref().expect("a body"), s.surface().expect("a body"));
    assert!(shown.mesh == body.mesh, "what is shown and saved belongs together");
    let apart = snapshot.cloth.positions.iter().zip(&lying.positions).map(|(p, q)| p.distance(*q));
    let apart = apart.fold(0.0, f64::max);
    assert!(apart < 1e-6, "a body that turns as a whole takes the cloth along: {apart} m");
    let kept = project_file::to_bytes(&s.project()).expect("bytes");
    assert!(project_file::from_bytes(&kept).expect("read back").dressed.is_some());
    s.apply_alone(Command::Undo).expect("undone");
    run(&mut s, 1);
    assert!(!posing(&mut s) && !s.can_undo_pose() && cloth_hash(&mut s) == before);

    let Command::Repose { body, .. } = turned() else { panic!("a pose") };
    let BodyChoice::Imported { name, mesh } = body else { panic!("a mesh") };
    let mut farther = mesh.as_ref().clone();
    farther.positions.iter_mut().for_each(|p| p.y += 0.3);
    let farther = BodyChoice::Imported { name, mesh: Arc::new(farther) };
    s.apply_alone(Command::Repose { body: farther, settle: false, draft: false }).expect("posed");
    s.apply_alone(turned()).expect("elsewhere meanwhile");
    run(&mut s, 200);
    assert_eq!(cloth_hash(&mut s), there, "as if it had never been on its way to the other");

    s.apply_alone(Command::Undo).expect("undone");
    s.apply_alone(Command::Undo).expect("undone");
    s.apply_alone(turned()).expect("posed");
    s.apply_alone(Command::SetDraping { on: false }).expect("it is not");
    assert!(!posing(&mut s), "what is asked meanwhile is asked of the cloth that has come there");
    run(&mut s, 200);
    assert_eq!(cloth_hash(&mut s), there);
    let recording = Recording::parse(&s.recording()).expect("a recording");
    Replay::new(recording).run().expect("the same hashes");
}

/// A dress whose skirt folds under the thighs.
#[test]
fn cloth_that_comes_to_run_through_itself_in_a_pose_is_draped_there() {
    let mut project = Sample::Dress.project(&mannequin::default());
    project.document.settings.edge_length = 0.03;
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3000);
    let (body, before) = (s.document().body.clone(), cloth_hash(&mut s));
    let sitting = body.in_named_pose(NamedPose::Sitting).expect("the mannequin");
    s.apply_alone(Command::Repose { body: sitting, settle: false, draft: false }).expect("posed");
    run(&mut s, 20_000);
    let snapshot = s.snapshot();
    assert!(
        !snapshot.working && snapshot.drape.is_none() && snapshot.moved == Moved::Draped,
        "{:?}",
        snapshot.drape
    );
    let outcome = snapshot.reposed.expect("a change of pose");
    assert!(!snapshot.is_carried, "it was draped there");
    assert!(outcome.crossings > 0, "it would not have needed draping: {outcome:?}");
    let garment = snapshot.garment.as_ref().expect("a dress");
    assert_eq!(Intersections::new(garment, &snapshot.cloth).places.len(), 0);
    s.apply_alone(Command::Repose { body, settle: false, draft: false }).expect("posed");
    run(&mut s, 20_000);
    assert_eq!(cloth_hash(&mut s), before, "it comes back to where it lay");
    let recording = Recording::parse(&s.recording()).expect("a recording");
    Replay::new(recording).run().expect("the same hashes");
}

#[test]
fn a_body_of_other_triangles_is_no_pose() {
    let mut s = dressed();
    let before = s.document().clone();
    let other = BodyChoice::Imported { name: "other".to_owned(), mesh: Arc::new(ball(0.75, 12, 24)) };
    assert!(s.apply_alone(Command::Repose { body: other, settle: false, draft: false }).is_err());
    assert!(*s.document() == before);
}

#[test]
fn a_way_to_a_pose_is_stored_undone_and_replayed() {
    let mut s = dressed();
    let before = (s.document().clone(), cloth_hash(&mut s));
    assert!(s.apply_alone(Command::PoseTowards { share: 0.5, draft: false }).is_err(), "to nowhere");
    let Command::Repose { body, .. } = turned() else { panic!("a pose") };
    s.apply_alone(Command::AimPose { body: body.clone() }).expect("chosen");
    assert!(s.document().body == before.0.body, "it stays where it is");
    assert!(s.apply_alone(Command::PoseTowards { share: 1.5, draft: false }).is_err());
    let gesture = s.begin_gesture();
    for (share, draft) in [(0.3, true), (0.6, true), (0.5, false)] {
        s.apply(Command::PoseTowards { share, draft }, gesture).expect("on the way");
    }
    s.end_gesture(gesture);
    run(&mut s, 200);
    let half = cloth_hash(&mut s);
    let p = s.surface().expect("a body").mesh.positions[7];
    let expected = DQuat::from_rotation_y(0.2) * ball(0.75, 24, 48).positions[7] + DVec3::X * 0.05;
    // Rebuilt from the turns of its triangles.
    assert!(half != before.1 && p.distance(expected) < 1e-3, "{p} {expected}");
    let kept = project_file::to_bytes(&s.project()).expect("bytes");
    assert!(project_file::from_bytes(&kept).expect("read back") == s.project());
    s.apply_alone(Command::PoseTowards { share: 1.0, draft: false }).expect("there");
    assert!(s.document().body == body);
    for _ in 0..2 {
        s.apply_alone(Command::Undo).expect("undone");
    }
    run(&mut s, 1);
    assert_eq!(cloth_hash(&mut s), before.1);
    s.apply_alone(Command::Undo).expect("undone");
    assert!(*s.document() == before.0);
    let recording = Recording::parse(&s.recording()).expect("a recording");
    Replay::new(recording).run().expect("the same hashes");
}

#[test]
fn a_pose_of_the_mannequin_is_stored_undone_and_replayed() {
    carried_and_back(|body| body.in_named_pose(NamedPose::Running).expect("the mannequin"));
}

#[test]
fn joints_turned_by_hand_are_stored_undone_and_replayed() {
    carried_and_back(|body| {
        let angles = ["left_shoulder.abduction=70", "right_elbow=90", "chest.twist=15"];
        let angles = angles.map(|text| text.parse().expect("an angle"));
        let anatomy = body.anatomy().expect("the mannequin");
        let pose = anatomy.with(&body.pose().expect("a pose"), &angles).expect("within the ranges");
        body.posed(pose).expect("the mannequin")
    });
}

fn carried_and_back(pose: impl Fn(&BodyChoice) -> BodyChoice) {
    let figure = mannequin::default();
    let mut project = Sample::Scarf.project(&figure);
    project.document.settings.edge_length = 0.05;
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3000);
    let before = cloth_hash(&mut s);
    let body = pose(&s.document().body);
    let draft = s.document().body.in_named_pose(NamedPose::T).expect("the mannequin");
    let gesture = s.begin_gesture();
    s.apply(Command::Repose { body: draft, settle: false, draft: true }, gesture).expect("a draft");
    s.apply(Command::Repose { body: body.clone(), settle: false, draft: false }, gesture).expect("posed");
    s.end_gesture(gesture);
    run(&mut s, 10);
    let there = cloth_hash(&mut s);
    assert!(there != before && s.document().body == body);
    assert!(s.surface().expect("a body").nearest(s.snapshot().cloth.positions[0]).distance > 0.0);
    let stored = serde_json::to_string(&s.document().body).expect("JSON");
    assert_eq!(serde_json::from_str::<BodyChoice>(&stored).expect("read back"), body);
    s.apply_alone(Command::Undo).expect("one step");
    run(&mut s, 1);
    assert_eq!(cloth_hash(&mut s), before);
    s.apply_alone(Command::Redo).expect("again");
    run(&mut s, 10);
    assert_eq!(cloth_hash(&mut s), there);
    let recording = Recording::parse(&s.recording()).expect("a recording");
    Replay::new(recording).run().expect("the same hashes");
}
