//! Random sequences of commands: undo of everything is the start, redo of everything is the end, document and cloth.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use toile::geometry::ids::{MarkId, PieceId, SeamId};
use toile::pattern::{Piece, PlanePose};
use toile::relax::RelaxSettings;
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::{Command, Document, GestureId, Notice, Session, Settings};
use toile::sim::{Runner, Simulation};
use toile::wrap::ClothSide;

use crate::common::{line_on_ball, project, run, session};

#[derive(Clone, Debug)]
enum Act {
    Do(Command),
    /// The same pointer drag sends several.
    Drag(Vec<Command>),
    DragAndEsc(Vec<Command>),
    Run(usize),
}

fn command() -> impl Strategy<Value = Command> {
    let piece = (1..4u32).prop_map(PieceId);
    let number = -0.3..0.3f64;
    prop_oneof![
        1 => (piece.clone(), number.clone()).prop_map(|(piece, x)| Command::AddClothMark {
            piece,
            side: ClothSide::Front,
            points: vec![DVec2::new(0.05, 0.1), DVec2::new(0.2, x.abs())],
        }),
        1 => number.clone().prop_map(|y| Command::AddBodyMark { points: line_on_ball(0.75, y, 0.07) }),
        1 => (1..6u32).prop_map(|id| Command::DeleteMark { mark: MarkId(id) }),
        1 => (1..6u32, 1..3usize).prop_map(|(id, to)| Command::MoveMark { mark: MarkId(id), to }),
        1 => (1..6u32, "[a-z]{0,3}").prop_map(|(id, name)| Command::RenameMark { mark: MarkId(id), name }),
        1 => Just(Command::ClearMarks),
        1 => number.clone().prop_map(|x| Command::AddPiece {
            piece: Arc::new(Piece::polygon("new", &[DVec2::ZERO, DVec2::new(0.2, x), DVec2::new(0.0, 0.2)])),
        }),
        1 => piece.clone().prop_map(|piece| Command::DeletePiece { piece }),
        1 => (piece.clone(), "[a-z]{0,3}").prop_map(|(piece, name)| Command::RenamePiece { piece, name }),
        1 => (piece, number).prop_map(|(piece, rotation)| Command::SetPiecePose {
            piece,
            pose: PlanePose { rotation, ..PlanePose::default() },
        }),
        1 => (2..5u32).prop_map(|id| Command::DeleteSeam { seam: SeamId(id) }),
        1 => (2..5u32).prop_map(|id| Command::ReverseSeam { seam: SeamId(id) }),
        1 => (0.0..1.1f64).prop_map(|flatten| Command::SetSettings {
            settings: Settings {
                edge_length: 0.06,
                relax: RelaxSettings { flatten, ..RelaxSettings::default() },
                ..Settings::default()
            },
        }),
        3 => Just(Command::Wrap),
        1 => Just(Command::CancelWrap),
        1 => Just(Command::Unwrap),
        1 => any::<bool>().prop_map(|on| Command::SetRelaxing { on }),
        2 => Just(Command::Undo),
        2 => Just(Command::Redo),
    ]
}

fn act() -> impl Strategy<Value = Act> {
    prop_oneof![
        6 => command().prop_map(Act::Do),
        1 => prop::collection::vec(command(), 1..4).prop_map(Act::Drag),
        1 => prop::collection::vec(command(), 1..4).prop_map(Act::DragAndEsc),
        3 => (1..6usize).prop_map(Act::Run),
    ]
}

fn perform(session: &mut Session, act: Act) {
    match act {
        // A refusal is as good as a success here: it must leave no trace.
        Act::Do(command) => drop(session.apply_alone(command)),
        Act::Drag(commands) => drag(session, commands, false),
        Act::DragAndEsc(commands) => drag(session, commands, true),
        Act::Run(ticks) => drop(run(session, ticks)),
    }
}

fn drag(session: &mut Session, commands: Vec<Command>, esc: bool) {
    let history_free = commands.iter().all(|c| {
        !matches!(c, Command::Undo | Command::Redo | Command::CancelWrap | Command::SetRelaxing { .. })
    });
    let before = state(session);
    let gesture = session.begin_gesture();
    for command in commands {
        session.apply(command, gesture).ok();
    }
    if esc {
        let changed = session.apply(Command::CancelGesture, gesture).is_ok();
        if history_free {
            assert!(
                state(session) == before,
                "Esc takes the whole drag back (it had changed something: {changed})"
            );
        }
    }
    session.end_gesture(gesture);
}

/// Document and cloth, without the pause: pausing is not a step.
fn state(session: &mut Session) -> (Document, Vec<u64>, Vec<bool>) {
    session.update();
    let cloth = &session.snapshot().cloth;
    let bits = |p: &DVec3| p.to_array().map(f64::to_bits);
    let places = cloth.positions.iter().zip(&cloth.mapped).filter(|(_, m)| **m).flat_map(|(p, _)| bits(p));
    (session.document().clone(), places.collect(), cloth.mapped.clone())
}

fn until_refused(session: &mut Session, command: &Command) {
    while session.apply(command.clone(), GestureId(1_000_000)).is_ok() {}
    session.end_gesture(GestureId(1_000_000));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn undo_all_is_the_start_and_redo_all_is_the_end(acts in prop::collection::vec(act(), 1..25)) {
        let mut session = session();
        let start = state(&mut session);
        for act in acts {
            perform(&mut session, act);
            prop_assert_eq!(session.project().problem(), None);
            prop_assert!(session.is_modified() || *session.document() == start.0, "what is not modified is as it was");
        }
        until_refused(&mut session, &Command::Redo);
        let end = state(&mut session);
        until_refused(&mut session, &Command::Undo);
        prop_assert!(state(&mut session) == start, "undo all");
        until_refused(&mut session, &Command::Redo);
        prop_assert!(state(&mut session) == end, "redo all");
    }
}

#[test]
fn a_drag_is_one_step() {
    let mut s = session();
    let pose = |x: f64| PlanePose { offset: DVec2::new(x, 0.0), ..PlanePose::default() };
    let gesture = s.begin_gesture();
    for i in 1..=10 {
        s.apply(Command::SetPiecePose { piece: PieceId(1), pose: pose(f64::from(i)) }, gesture)
            .expect("moved");
    }
    s.end_gesture(gesture);
    assert_eq!(s.step_labels().collect::<Vec<_>>(), ["move left"]);
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(s.document().pattern.pieces[&PieceId(1)].pose, PlanePose::default());
    assert_eq!((s.undo_label(), s.redo_label()), (None, Some("move left")));
    s.apply_alone(Command::Redo).expect("redone");
    assert_eq!(s.document().pattern.pieces[&PieceId(1)].pose, pose(10.0));
}

#[test]
fn what_was_undone_to_where_it_was_saved_is_not_modified() {
    let mut s = session();
    let rename = |name: &str| Command::RenamePiece { piece: PieceId(1), name: name.to_owned() };
    let is_modified_after = |s: &mut Session, command: Command| {
        s.apply_alone(command).expect("done");
        s.is_modified()
    };
    assert!(is_modified_after(&mut s, rename("one")));
    s.mark_saved();
    assert!(is_modified_after(&mut s, rename("two")));
    assert!(!is_modified_after(&mut s, Command::Undo));
    assert!(is_modified_after(&mut s, Command::Undo));
    assert!(!is_modified_after(&mut s, Command::Redo));
    // Another step of the same name is another state.
    s.apply_alone(Command::Undo).expect("undone");
    assert!(is_modified_after(&mut s, rename("one")));
    s.mark_saved();
    assert!(is_modified_after(&mut s, Command::Wrap));
    assert!(!is_modified_after(&mut s, Command::CancelWrap));
    // Pausing is no step; the cloth that moved meanwhile does not come back with a name.
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3);
    s.mark_saved();
    s.apply_alone(rename("three")).expect("renamed");
    s.apply_alone(Command::SetRelaxing { on: false }).expect("paused");
    assert!(is_modified_after(&mut s, Command::Undo));
}

#[test]
fn esc_gives_redo_back() {
    let mut s = session();
    s.apply_alone(Command::ClearMarks).expect("cleared");
    s.apply_alone(Command::Undo).expect("undone");
    let gesture = s.begin_gesture();
    s.apply(Command::DeletePiece { piece: PieceId(1) }, gesture).expect("deleted");
    assert_eq!(s.redo_label(), None);
    s.apply(Command::CancelGesture, gesture).expect("cancelled");
    assert_eq!((s.redo_label(), s.document().pattern.pieces.len()), (Some("clear all marks"), 2));
}

#[test]
fn with_little_memory_old_steps_are_forgotten_and_a_recording_knows() {
    let runner = Runner::inline(Simulation::with_memory(200_000));
    let mut s = Session::new(project(), runner);
    for _ in 0..12 {
        s.apply_alone(Command::Wrap).expect("wrapped");
        run(&mut s, 2);
    }
    let steps = s.step_labels().count();
    assert!((1..12).contains(&steps), "{steps}");
    // An undo keeps a state, too, and may push out the oldest: the session hears of it before the next.
    while s.apply_alone(Command::Undo).is_ok() {
        let failed = s.update().into_iter().any(|n| matches!(n, Notice::Failed { .. }));
        assert!(!failed, "an undo that was offered failed");
    }
    let text = s.recording();
    assert!(text.contains("forget_history"));
    let mut replay = Replay::new(Recording::parse(&text).expect("a recording"));
    replay.run().expect("the same bits");
    assert_eq!(replay.session().redo_label(), s.redo_label());
}
