//! Dragging and pinning dressed cloth.

use glam::{DVec2, DVec3};
use toile::drag::{DragMode, Ray};
use toile::geometry::ids::{PieceId, PinId};
use toile::relax::RelaxSettings;
use toile::session::replay::Replay;
use toile::session::{Command, Session};
use toile::wrap::Phase;

use crate::common::{cloth_hash, run, session};

const PIECE: PieceId = PieceId(1);

fn dressed() -> Session {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 2000);
    s
}

fn grab(at: DVec2) -> Command {
    Command::Grab { piece: PIECE, at, mode: DragMode::Surface }
}

/// A ray at the front of the ball.
fn to(x: f64, y: f64) -> Command {
    Command::DragTo { ray: Ray { origin: DVec3::new(x, y, 3.0), direction: DVec3::NEG_Z } }
}

/// Drags a little way and lets go.
fn drag(s: &mut Session) {
    let gesture = s.begin_gesture();
    s.apply(grab(DVec2::new(0.1, 0.2)), gesture).expect("grabbed");
    for step in 0..5 {
        s.apply(to(-0.02 * f64::from(step), 0.2), gesture).expect("dragged");
        run(s, 3);
    }
    s.apply(Command::Release, gesture).expect("let go");
    s.end_gesture(gesture);
    run(s, 2000);
}

#[test]
fn a_drag_moves_the_cloth_and_is_one_step() {
    let mut s = dressed();
    let (before, steps) = (cloth_hash(&mut s), s.step_labels().count());
    let middle = |s: &Session| s.snapshot().cloth.positions.iter().sum::<DVec3>().x;
    let was = middle(&s);
    drag(&mut s);
    assert!(middle(&s) < was - 0.005);
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    assert_eq!(s.step_labels().count(), steps + 1);
    let after = cloth_hash(&mut s);
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(cloth_hash(&mut s), before);
    s.apply_alone(Command::Redo).expect("redone");
    assert_eq!(cloth_hash(&mut s), after);
}

#[test]
fn escape_takes_a_drag_back() {
    let mut s = dressed();
    let before = cloth_hash(&mut s);
    let gesture = s.begin_gesture();
    s.apply(grab(DVec2::new(0.1, 0.2)), gesture).expect("grabbed");
    s.apply(to(-0.3, 0.2), gesture).expect("dragged");
    run(&mut s, 10);
    assert!(s.snapshot().dragged.is_some());
    assert_ne!(cloth_hash(&mut s), before);
    s.apply(Command::CancelGesture, gesture).expect("cancelled");
    s.end_gesture(gesture);
    s.update();
    assert_eq!(cloth_hash(&mut s), before);
    assert!(s.snapshot().dragged.is_none());
}

#[test]
fn a_hand_that_waits_lets_the_cloth_sleep() {
    let mut s = dressed();
    let gesture = s.begin_gesture();
    s.apply(grab(DVec2::new(0.1, 0.2)), gesture).expect("grabbed");
    assert!(run(&mut s, 3000) < 3000, "never at rest in the hand");
    s.apply(to(-0.05, 0.2), gesture).expect("dragged");
    assert!(run(&mut s, 5) > 0, "asleep in a moving hand");
}

#[test]
fn pins_stay_where_they_are() {
    let mut s = dressed();
    s.apply_alone(Command::AddPin { piece: PIECE, at: DVec2::new(0.02, 0.28) }).expect("pinned");
    s.update();
    let pinned = s.snapshot().pinned.clone();
    assert_eq!(pinned.len(), 1);
    let place = |s: &Session| s.snapshot().cloth.positions[pinned[0].expect("on the cloth") as usize];
    let was = place(&s);
    drag(&mut s);
    assert_eq!(place(&s), was, "a pin moved");
    s.apply_alone(Command::DeletePin { pin: PinId(1) }).expect("pulled out");
    assert!(run(&mut s, 2000) > 0, "cloth without its pin sleeps on");
    assert!(s.snapshot().pinned.is_empty());
}

#[test]
fn a_pin_stuck_in_while_the_cloth_grows_holds_it_once_it_lies() {
    for ticks in [0, 1, 3, 10] {
        let mut s = session();
        s.apply_alone(Command::Wrap).expect("wrapped");
        run(&mut s, ticks);
        for at in [DVec2::new(0.02, 0.02), DVec2::new(0.02, 0.28)] {
            s.apply_alone(Command::AddPin { piece: PIECE, at }).expect("pinned");
        }
        run(&mut s, 2000);
        let pins: Vec<usize> = s.snapshot().pinned.iter().flatten().map(|&v| v as usize).collect();
        assert_eq!(pins.len(), 2, "pinned after {ticks} ticks: {:?}", s.snapshot().pinned);
        let places = |s: &Session| pins.iter().map(|&v| s.snapshot().cloth.positions[v]).collect::<Vec<_>>();
        let were = places(&s);
        drag(&mut s);
        assert_eq!(places(&s), were, "pinned after {ticks} ticks");
    }
}

#[test]
fn pins_outlive_saving_and_go_with_their_cloth() {
    let mut s = dressed();
    s.apply_alone(Command::AddPin { piece: PIECE, at: DVec2::new(0.02, 0.28) }).expect("pinned");
    let project = s.project();
    let runner = toile::sim::Runner::inline(toile::sim::Simulation::default());
    let mut again = Session::new(project, runner);
    again.update();
    assert_eq!(again.snapshot().pinned, s.snapshot().pinned);
    assert_eq!(run(&mut again, 10), 0, "opened cloth lies at rest");
    s.apply_alone(Command::DeletePiece { piece: PIECE }).expect("deleted");
    assert!(s.document().pins.is_empty());
}

#[test]
fn what_cannot_be_dragged_is_refused_or_left_alone() {
    let mut s = session();
    let before = cloth_hash(&mut s);
    s.apply_alone(grab(DVec2::new(0.1, 0.2))).expect("nothing there to take");
    s.apply_alone(to(0.0, 0.0)).expect("nothing in the hand");
    s.apply_alone(Command::Release).expect("nothing to let go");
    assert_eq!(cloth_hash(&mut s), before);
    let nowhere = Ray { origin: DVec3::NAN, direction: DVec3::X };
    s.apply_alone(Command::DragTo { ray: nowhere }).expect_err("no place");
    s.apply_alone(Command::AddPin { piece: PieceId(77), at: DVec2::ZERO }).expect_err("no piece");
    s.apply_alone(Command::DeletePin { pin: PinId(1) }).expect_err("no pin");
    s.apply_alone(Command::ClearPins).expect_err("no pins");
}

#[test]
fn a_recorded_drag_replays() {
    let mut s = dressed();
    s.apply_alone(Command::AddPin { piece: PIECE, at: DVec2::new(0.02, 0.28) }).expect("pinned");
    drag(&mut s);
    s.apply_alone(Command::Undo).expect("undone");
    let recording = toile::session::recording::Recording::parse(&s.recording()).expect("a recording");
    Replay::new(recording).run().expect("the same hashes");
}

#[test]
fn each_control_of_relaxation_works_on_dressed_cloth_and_is_taken_back() {
    type Turn = fn(&mut RelaxSettings);
    let controls: [(&str, Turn); 5] = [
        ("stretch", |r| r.stretch = 0.5),
        ("flatten", |r| r.flatten = 0.9),
        ("gravity", |r| r.gravity = 0.03),
        ("friction", |r| r.friction = 0.0),
        ("offset", |r| r.offset = 0.012),
    ];
    for (name, turn) in controls {
        let mut s = dressed();
        let before = cloth_hash(&mut s);
        let mut settings = s.document().settings;
        turn(&mut settings.relax);
        s.apply_alone(Command::SetSettings { settings }).expect(name);
        assert!(run(&mut s, 3000) > 0, "{name}: the cloth sleeps on");
        assert_eq!(s.snapshot().phase, Some(Phase::AtRest), "{name}");
        assert_ne!(cloth_hash(&mut s), before, "{name} changes nothing");
        s.apply_alone(Command::Undo).expect("undone");
        assert_eq!(cloth_hash(&mut s), before, "{name}");
        let recording = toile::session::recording::Recording::parse(&s.recording()).expect("a recording");
        Replay::new(recording).run().expect("the same hashes");
    }
}

#[test]
fn locked_pins_stay_and_the_others_go_elsewhere_or_out() {
    let mut s = dressed();
    for x in [0.02, 0.1, 0.2] {
        s.apply_alone(Command::AddPin { piece: PIECE, at: DVec2::new(x, 0.28) }).expect("pinned");
    }
    let ids = |s: &Session| s.document().pins.iter().map(|pin| pin.id.0).collect::<Vec<_>>();
    let refused = |s: &mut Session, command: Command| {
        let before = s.document().clone();
        let why = s.apply_alone(command).expect_err("refused");
        assert_eq!(*s.document(), before);
        why.0
    };
    s.apply_alone(Command::LockPins { pins: vec![PinId(2)], locked: true }).expect("locked");
    assert!(refused(&mut s, Command::DeletePin { pin: PinId(2) }).contains("pin 2 is locked"));
    let both = vec![PinId(1), PinId(2)];
    assert!(refused(&mut s, Command::DeletePins { pins: both }).contains("locked"));
    let at = DVec2::new(0.15, 0.1);
    assert!(refused(&mut s, Command::MovePin { pin: PinId(2), piece: PIECE, at }).contains("locked"));
    assert!(
        refused(&mut s, Command::LockPins { pins: vec![PinId(9)], locked: true }).contains("there is no")
    );

    s.apply_alone(Command::MovePin { pin: PinId(1), piece: PIECE, at }).expect("moved");
    assert_eq!(s.document().pins[0].place.at, at);
    run(&mut s, 2000);
    let vertex = s.snapshot().pinned[0].expect("on the cloth") as usize;
    let place = s.snapshot().cloth.positions[vertex];
    run(&mut s, 200);
    assert_eq!(s.snapshot().cloth.positions[vertex], place, "it holds where it is now");

    s.apply_alone(Command::ClearPins).expect("the others");
    assert_eq!(ids(&s), [2]);
    assert!(refused(&mut s, Command::ClearPins).contains("all pins are locked"));
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(ids(&s), [1, 2, 3]);
    s.apply_alone(Command::LockPins { pins: vec![PinId(2)], locked: false }).expect("unlocked");
    s.apply_alone(Command::DeletePins { pins: vec![PinId(1), PinId(2)] }).expect("pulled out");
    assert_eq!(ids(&s), [3]);
    assert_eq!(s.undo_label(), Some("pull 2 pins out"));
}
