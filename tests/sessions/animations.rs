//! The body goes through the animations of its file, and the dressed cloth goes along.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::sync::Arc;

use glam::DVec3;
use toile::body::{Unit, UpAxis};
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::{AnimatedFile, Animations, Command, Moment, Session, project_file};
use toile::sim::{Runner, Simulation};

use crate::common::{ball, cloth_hash, limb, run};

fn file() -> AnimatedFile {
    let (up, unit, buffers) = (UpAxis::Y, Unit::Metre, BTreeMap::new());
    AnimatedFile { name: "limb".to_owned(), bytes: limb::glb(), buffers, up, unit }
}

fn animations() -> Arc<Animations> {
    Arc::new(Animations::new(file()).expect("animations").0)
}

fn dressed() -> Session {
    let mut s = Session::new(limb::project(), Runner::inline(Simulation::default()));
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 2000);
    s
}

fn to(seconds: f64) -> Option<Moment> {
    Some(Moment { animation: 0, seconds })
}

fn cloth(s: &mut Session) -> Vec<DVec3> {
    run(s, 1);
    s.update();
    s.snapshot().cloth.positions.clone()
}

#[test]
fn cloth_follows_is_stored_undone_and_replayed() {
    let mut s = dressed();
    let (before, lay) = (cloth_hash(&mut s), cloth(&mut s));
    assert!(s.apply_alone(Command::Animate { at: to(0.5), draft: false }).is_err(), "nothing to go through");
    s.apply_alone(Command::TakeAnimations { animations: animations() }).expect("taken");
    assert_eq!(cloth_hash(&mut s), before, "it stays where it is");
    let gesture = s.begin_gesture();
    for (seconds, draft) in [(0.1, true), (0.9, true), (0.5, false)] {
        s.apply(Command::Animate { at: to(seconds), draft }, gesture).expect("on the way");
    }
    s.end_gesture(gesture);
    for (p, q) in lay.iter().zip(cloth(&mut s)) {
        assert!(q.distance(limb::bent(*p, FRAC_PI_4)) < 1e-6, "{p} {q}");
    }
    assert_eq!((s.document().moment, s.undo_label()), (to(0.5), Some("change the pose")));
    let kept = project_file::to_bytes(&s.project()).expect("bytes");
    let opened = project_file::from_bytes(&kept).expect("read back");
    assert!(opened == s.project());
    let mut again = Session::new(opened, Runner::inline(Simulation::default()));
    again.apply_alone(Command::Animate { at: to(1.0), draft: false }).expect("goes on from the file");
    for (p, q) in lay.iter().zip(cloth(&mut again)) {
        assert!(q.distance(limb::bent(*p, FRAC_PI_2)) < 1e-6, "{p} {q}");
    }
    s.apply_alone(Command::Animate { at: None, draft: false }).expect("at rest");
    assert_eq!(s.document().moment, None);
    for _ in 0..3 {
        s.apply_alone(Command::Undo).expect("undone");
    }
    run(&mut s, 1);
    assert!(cloth_hash(&mut s) == before && s.document().animations.is_none());
    let recording = Recording::parse(&s.recording()).expect("a recording");
    Replay::new(recording).run().expect("the same hashes");
}

#[test]
fn moments_that_are_not_there_and_other_bodies_are_refused() {
    let mut s = dressed();
    s.apply_alone(Command::TakeAnimations { animations: animations() }).expect("taken");
    let mut refused = |at: Moment, words: &str| {
        let why = s.apply_alone(Command::Animate { at: Some(at), draft: false }).expect_err(words);
        assert!(why.0.contains(words), "{why}");
    };
    refused(Moment { animation: 2, seconds: 0.0 }, "limb has no animation 3");
    for seconds in [-0.1, 1.1, f64::NAN, f64::INFINITY] {
        refused(Moment { animation: 0, seconds }, "animation 1 lasts from 0 to 1 s");
    }
    let mut other = crate::common::session();
    let why = other.apply_alone(Command::TakeAnimations { animations: animations() }).expect_err("a ball");
    assert!(why.0.contains("limb is not ball in another pose"), "{why}");
    let body =
        toile::session::BodyChoice::Imported { name: "small".to_owned(), mesh: ball(0.3, 9, 9).into() };
    let why =
        other.apply_alone(Command::SetBody { body, animations: Some(animations()) }).expect_err("a ball");
    assert!(why.0.contains("limb is not small"), "{why}");
}

#[test]
fn files_without_animations_or_damaged_are_refused() {
    let (text, data) = limb::skinned(Some("limb.bin"));
    let beside = AnimatedFile { bytes: text.clone().into_bytes(), ..file() };
    assert!(Animations::new(beside.clone()).expect_err("no buffer").contains("\"limb.bin\" was not kept"));
    let beside = AnimatedFile { buffers: BTreeMap::from([("limb.bin".to_owned(), data)]), ..beside };
    let (whole, _) = Animations::new(beside.clone()).expect("with its buffer");
    let stored = serde_json::to_value(&whole).expect("json");
    assert!(serde_json::from_value::<Animations>(stored).expect("read back") == whole);
    let still = text.replace("\"animations\"", "\"animationz\"").into_bytes();
    assert!(Animations::new(AnimatedFile { bytes: still, ..beside }).is_err());
    let stored = serde_json::to_value(&*animations()).expect("json");
    assert!(serde_json::from_value::<Animations>(stored.clone()).expect("read back") == *animations());
    for text in ["!", "AAAA"] {
        let mut damaged = stored.clone();
        damaged["file"] = text.into();
        let why = serde_json::from_value::<Animations>(damaged).expect_err("no file").to_string();
        assert!(why.contains("limb"), "{why}");
    }
}
