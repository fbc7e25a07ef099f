//! The body takes another pose, and the dressed cloth goes along.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::{BodyChoice, Command, Session};
use toile::wrap::Phase;

use crate::common::{ball, cloth_hash, run, session};

fn turned() -> Command {
    let turn = DQuat::from_rotation_y(0.4);
    let mut mesh = ball(0.75, 24, 48);
    mesh.positions.iter_mut().for_each(|p| *p = turn * *p + DVec3::X * 0.1);
    let body = BodyChoice::Imported { name: "turned".to_owned(), mesh: Arc::new(mesh) };
    Command::Repose { body, settle: false }
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
fn a_body_of_other_triangles_is_no_pose() {
    let mut s = dressed();
    let before = s.document().clone();
    let other = BodyChoice::Imported { name: "other".to_owned(), mesh: Arc::new(ball(0.75, 12, 24)) };
    assert!(s.apply_alone(Command::Repose { body: other, settle: false }).is_err());
    assert!(*s.document() == before);
}
