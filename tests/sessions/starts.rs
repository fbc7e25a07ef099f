//! Dressing by the best start.

use std::sync::Arc;

use toile::fit::Moved;
use toile::geometry::ids::PieceId;
use toile::pattern::Fold;
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::{Command, Project, Session};
use toile::sim::{Runner, Simulation, Start, StartChoice, Started};
use toile::wrap::Phase;

use crate::common::{cloth_hash, placed_project, run, tube_project};

const ANY: StartChoice = StartChoice { only: None, draped: false };

fn session(project: Project) -> Session {
    Session::new(project, Runner::inline(Simulation::default()))
}

/// Dressed; what came of the starts.
fn dressed(s: &mut Session, choice: StartChoice) -> Arc<Started> {
    s.apply_alone(Command::Dress { choice }).expect("begun");
    s.update();
    assert!(s.snapshot().trying.is_some() && s.snapshot().started.is_none());
    run(s, 6000);
    let snapshot = s.snapshot();
    assert_eq!((snapshot.phase, snapshot.trying), (Some(Phase::AtRest), None));
    snapshot.started.clone().expect("starts were tried")
}

fn faults(s: &mut Session) -> Vec<String> {
    s.runner().simulation().expect("inline").judge();
    s.update();
    let verdict = s.snapshot().verdict.clone().expect("judged");
    verdict.iter().map(|fault| format!("{}: {}", fault.problem.place, fault.problem.words)).collect()
}

#[test]
fn the_first_start_without_a_fault_is_taken() {
    for (only, start) in [(None, Start::Marks), (Some(Start::Placement), Start::Placement)] {
        let mut s = session(placed_project(0.39, 0.33));
        let started = dressed(&mut s, StartChoice { only, draped: true });
        assert_eq!((started.taken().start, started.taken().draped), (start, true), "{started:?}");
        assert_eq!(started.taken().faults, faults(&mut s));
        assert_eq!(started.taken, started.tried.len() - 1, "no other is tried after it");
        assert_eq!(s.snapshot().moved, Moved::Draped);
        assert_eq!(s.document().marks.pairs().count(), 0, "suggested marks are not the document's");
        let suggested = s.snapshot().source.as_ref().expect("dressed").marks.pairs().count();
        assert_eq!(suggested > 0, start == Start::Marks);
    }
}

#[test]
fn what_turns_over_at_a_seam_is_first_sewn_from_its_placement() {
    // The start that is tried first, where an edge of the front is folded by so many degrees.
    let first = |edge: usize, degrees: f64, is_marked: bool| {
        let mut project = placed_project(0.39, 0.33);
        if is_marked {
            project.document.take_marks(Arc::clone(&crate::common::project().document.marks));
        }
        let pattern = Arc::make_mut(&mut project.document.pattern);
        let front = Arc::make_mut(pattern.pieces.get_mut(&PieceId(1)).expect("a piece"));
        front.outline[edge].trims.fold = Some(Fold::pressed(degrees.to_radians()));
        let mut s = session(project);
        s.apply_alone(Command::Dress { choice: ANY }).expect("begun");
        s.update();
        s.snapshot().trying.expect("a start").start
    };
    let (seam, hem) = (1, 0);
    assert_eq!([first(seam, 170.0, false), first(seam, -170.0, false)], [Start::Placement; 2]);
    assert_eq!(first(seam, 90.0, false), Start::Marks, "it only stands off");
    assert_eq!(first(hem, 170.0, false), Start::Marks, "nothing is sewn there");
    assert_eq!(first(seam, 170.0, true), Start::Marks, "marks of the garment's own go before");
}

#[test]
fn a_run_is_one_step_and_replays_to_the_same_bits() {
    let mut s = session(placed_project(0.39, 0.33));
    dressed(&mut s, ANY);
    let hash = cloth_hash(&mut s);
    assert_eq!(s.undo_label(), Some("dress"));
    let recording = s.recording();
    let mut replay = Replay::new(Recording::parse(&recording).expect("a recording"));
    replay.run().expect("the same bits");
    assert_eq!(cloth_hash(replay.session()), hash);
    s.apply_alone(Command::Undo).expect("undone");
    s.update();
    assert!(!s.snapshot().is_dressed() && s.snapshot().started.is_none());
    s.apply_alone(Command::Redo).expect("redone");
    assert_eq!(cloth_hash(&mut s), hash);
    s.update();
    assert!(s.snapshot().started.is_some());
}

/// Narrower than what it goes round, wherever it is put: no start is without a fault, and no draping mends the first.
#[test]
fn of_faulty_starts_the_one_with_the_fewest_faults_is_taken() {
    let mut s = session(placed_project(0.15, 0.15));
    let started = dressed(&mut s, ANY);
    let counts: Vec<usize> = started.tried.iter().map(|tried| tried.faults.len()).collect();
    let starts: Vec<(Start, bool)> = started.tried.iter().map(|tried| (tried.start, tried.draped)).collect();
    assert_eq!(starts, [(Start::Marks, false), (Start::Placement, true)], "{started:?}");
    assert!(counts.iter().all(|&count| count >= started.taken().faults.len() && count > 0), "{counts:?}");
    assert_eq!(started.taken().faults, faults(&mut s));
}

/// They cannot be put on by suggested marks, so there is nothing to hurry for.
#[test]
fn layers_are_sewn_until_all_of_them_lie() {
    let mut project = placed_project(0.39, 0.33);
    for k in 1..3 {
        let wider = placed_project(0.39 + 0.02 * f64::from(k), 0.33 + 0.02 * f64::from(k));
        Arc::make_mut(&mut project.document.pattern)
            .wear_over(&wider.document.pattern, &format!("layer {k}"))
            .expect("layers");
    }
    let mut s = session(project);
    let started = dressed(&mut s, ANY);
    let taken = started.taken();
    assert_eq!((taken.start, &taken.faults), (Start::Placement, &Vec::new()));
    assert!(faults(&mut s).is_empty());
}

#[test]
fn a_run_can_be_cancelled_and_changed_while_it_lasts() {
    let mut s = session(placed_project(0.39, 0.33));
    s.apply_alone(Command::Dress { choice: ANY }).expect("begun");
    run(&mut s, 3);
    assert!(s.can_cancel_wrap());
    s.apply_alone(Command::CancelWrap).expect("cancelled");
    s.update();
    assert!(!s.snapshot().is_dressed() && s.snapshot().trying.is_none() && s.undo_label().is_none());
    s.apply_alone(Command::Dress { choice: ANY }).expect("begun");
    run(&mut s, 3);
    s.apply_alone(Command::SetFabric { piece: None, fabric: Some("wool".to_owned()) }).expect("set");
    s.apply_alone(Command::SetRelaxing { on: false }).expect("paused");
    run(&mut s, 20);
    assert!(!s.snapshot().working && s.snapshot().trying.is_some(), "held still");
    s.apply_alone(Command::SetRelaxing { on: true }).expect("goes on");
    run(&mut s, 6000);
    assert!(s.snapshot().started.is_some());
}

#[test]
fn what_cannot_be_begun_is_told() {
    let mut s = session(tube_project());
    let why = s.apply_alone(Command::Dress { choice: ANY }).expect_err("not placed").0;
    assert!(why.contains("placed"), "{why}");
}
