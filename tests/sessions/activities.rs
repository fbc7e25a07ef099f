//! Frozen and deactivated pieces.

use glam::{DVec2, DVec3};
use toile::drag::{DragMode, Ray};
use toile::fit::{BodyIndex, measure};
use toile::geometry::ids::PieceId;
use toile::pattern::activity::Activity;
use toile::pattern::edit::{PatternEdit, PointRef};
use toile::relax::RelaxSettings;
use toile::session::project_file::{from_bytes, to_bytes};
use toile::session::{Command, Session, Settings};
use toile::sim::{Runner, Simulation};

use crate::common::{cloth_hash, project, run, session};
use crate::scenario;

const LEFT: PieceId = PieceId(1);
const RIGHT: PieceId = PieceId(2);

fn set(s: &mut Session, activity: Activity) {
    let edits = vec![PatternEdit::SetActivity { pieces: vec![LEFT], activity }];
    s.apply_alone(Command::EditPattern { edits, anew: false }).expect("set");
}

/// The two patches at rest on the front of the ball, where they would fall off.
fn dressed() -> Session {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3000);
    s
}

fn drape(s: &mut Session) {
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(s, 1300);
    assert!(s.snapshot().drape.is_some_and(|drape| !drape.runs), "it rests");
}

/// Where the vertices of a piece are, those of its seams among them.
fn places(s: &Session, piece: PieceId) -> Vec<DVec3> {
    let snapshot = s.snapshot();
    let garment = snapshot.garment.as_ref().expect("dressed");
    let of = garment.corners.iter().filter(|corner| corner.piece == piece);
    of.map(|corner| snapshot.cloth.positions[corner.vertex as usize]).collect()
}

fn lowest(s: &Session) -> f64 {
    s.snapshot().cloth.positions.iter().map(|p| p.y).fold(f64::MAX, f64::min)
}

#[test]
fn a_frozen_piece_stays_bit_for_bit_and_the_other_hangs_from_it() {
    let mut s = dressed();
    let (before, lay) = (places(&s, LEFT), cloth_hash(&mut s));
    set(&mut s, Activity::Frozen);
    assert_eq!(s.undo_label(), Some("freeze left"));
    drape(&mut s);
    assert_eq!(places(&s, LEFT), before, "every vertex, the seam's too");
    let drop = places(&s, RIGHT).iter().map(|p| p.y).fold(f64::MAX, f64::min);
    assert!((-0.4..0.1).contains(&drop), "it hangs at {drop}");
    // Relaxing leaves it alone as well.
    let relax = RelaxSettings { gravity: 0.01, ..RelaxSettings::default() };
    s.apply_alone(Command::Undo).expect("undone");
    s.apply_alone(Command::SetSettings { settings: Settings { relax, ..s.document().settings } })
        .expect("set");
    run(&mut s, 300);
    assert_eq!(places(&s, LEFT), before);
    assert_ne!(cloth_hash(&mut s), lay, "the other has sunk");
    s.apply_alone(Command::Undo).expect("undone");
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(cloth_hash(&mut s), lay);
    assert!(s.document().pattern.activities().is_empty());
}

#[test]
fn let_go_it_falls_again() {
    let mut s = dressed();
    set(&mut s, Activity::Frozen);
    drape(&mut s);
    let hung = lowest(&s);
    set(&mut s, Activity::Active);
    run(&mut s, 600);
    assert!(lowest(&s) < hung - 0.2, "{} is not below {hung}", lowest(&s));
}

#[test]
fn no_hand_moves_frozen_cloth() {
    let mut s = dressed();
    set(&mut s, Activity::Frozen);
    let before = places(&s, LEFT);
    for piece in [LEFT, RIGHT] {
        let at = DVec2::new(0.1, 0.1);
        s.apply_alone(Command::Grab { piece, at, mode: DragMode::Surface }).expect("taken");
        let ray = Ray { origin: DVec3::new(0.3, 0.1, 3.0), direction: DVec3::NEG_Z };
        s.apply_alone(Command::DragTo { ray }).expect("pulled");
        run(&mut s, 30);
        s.apply_alone(Command::Release).expect("let go");
        run(&mut s, 300);
        assert_eq!(places(&s, LEFT), before, "{piece} in the hand");
    }
}

#[test]
fn a_wrap_lays_frozen_pieces_as_others() {
    let mut s = session();
    set(&mut s, Activity::Frozen);
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3000);
    assert_eq!(places(&s, LEFT), places(&dressed(), LEFT));
    let before = places(&s, LEFT);
    drape(&mut s);
    assert_eq!(places(&s, LEFT), before);
}

#[test]
fn a_project_keeps_what_is_frozen_and_old_ones_have_nothing() {
    let text = serde_json::to_string(&project().document).expect("json");
    assert!(!text.contains("activity"), "a project without frozen pieces is written as before");
    let mut s = dressed();
    set(&mut s, Activity::Frozen);
    let before = places(&s, LEFT);
    let saved = from_bytes(&to_bytes(&s.project()).expect("bytes")).expect("a project");
    let mut again = Session::new(saved, Runner::inline(Simulation::default()));
    again.update();
    drape(&mut again);
    assert_eq!(places(&again, LEFT), before, "opened again");
}

/// Where the vertices are that are of the left piece alone.
fn left_alone(s: &Session) -> Vec<DVec3> {
    let snapshot = s.snapshot();
    let garment = snapshot.garment.as_ref().expect("dressed");
    let shared: Vec<u32> = garment.corners.iter().filter(|c| c.piece == RIGHT).map(|c| c.vertex).collect();
    let own = garment.corners.iter().filter(|c| c.piece == LEFT && !shared.contains(&c.vertex));
    own.map(|c| snapshot.cloth.positions[c.vertex as usize]).collect()
}

#[test]
fn a_deactivated_piece_stays_and_holds_nothing() {
    let mut s = dressed();
    let (before, lay, low) = (left_alone(&s), cloth_hash(&mut s), lowest(&s));
    set(&mut s, Activity::Deactivated);
    assert_eq!(s.undo_label(), Some("deactivate left"));
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 90);
    assert_eq!(left_alone(&s), before);
    assert!(lowest(&s) < low - 0.3, "nothing holds the other: {} under {low}", lowest(&s));
    let snapshot = s.snapshot();
    let (counts, _) = snapshot.drawn().expect("cloth");
    assert!(counts.triangle_pieces.iter().all(|piece| *piece == RIGHT), "neither drawn nor measured");
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(left_alone(&s), before);
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(cloth_hash(&mut s), lay);
    s.update();
    assert!(s.snapshot().drawn().is_some_and(|(all, _)| all.triangle_pieces.contains(&LEFT)));
}

#[test]
fn what_is_deactivated_is_no_fault_and_comes_back_to_its_seams() {
    let mut s = dressed();
    set(&mut s, Activity::Deactivated);
    s.apply_alone(Command::StepDraping { ticks: 20 }).expect("draped");
    // To begin takes a tick, too.
    run(&mut s, 21);
    assert!(s.runner().simulation().expect("inline").judge());
    s.update();
    let faults = s.snapshot().verdict.clone().expect("looked at");
    assert!(faults.iter().all(|fault| !fault.problem.words.contains("torn")), "{faults:?}");
    set(&mut s, Activity::Active);
    s.apply_alone(Command::StepDraping { ticks: 60 }).expect("draped");
    run(&mut s, 61);
    let snapshot = s.snapshot();
    let (garment, cloth) = snapshot.drawn().expect("cloth");
    let source = snapshot.source.as_ref().expect("a pattern");
    let report =
        measure(&source.pattern, garment, cloth, &BodyIndex::new(snapshot.body.as_ref().expect("a body")));
    assert!(report.strain.max < 0.5, "strain {}", report.strain.max);
    assert_eq!((report.pieces.len(), report.not_finite_vertices), (2, 0));
}

#[test]
fn where_all_is_deactivated_nothing_drapes() {
    let mut s = dressed();
    let lay = s.snapshot().cloth.positions.clone();
    let edits = vec![PatternEdit::SetActivity { pieces: vec![LEFT, RIGHT], activity: Activity::Deactivated }];
    s.apply_alone(Command::EditPattern { edits, anew: false }).expect("set");
    s.apply_alone(Command::SetDraping { on: true }).expect("asked");
    run(&mut s, 10);
    assert_eq!(s.snapshot().cloth.positions, lay);
    let told = s.snapshot().problems.iter().any(|problem| problem.words.contains("cannot be draped"));
    assert!(told, "{:?}", s.snapshot().problems);
}

/// An edit of the other piece cuts the cloth anew: what stays, stays where the same places lay.
#[test]
fn an_edit_of_another_piece_leaves_it() {
    for activity in [Activity::Frozen, Activity::Deactivated] {
        let mut s = dressed();
        set(&mut s, activity);
        let before = left_alone(&s);
        let point = PointRef { piece: RIGHT, point: 1 };
        let edits = vec![PatternEdit::MovePoints { points: vec![(point, DVec2::new(0.27, 0.0))] }];
        s.apply_alone(Command::EditPattern { edits, anew: false }).expect("edited");
        run(&mut s, 300);
        let after = left_alone(&s);
        assert_eq!(after.len(), before.len());
        let moved = after.iter().zip(&before).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
        assert!(moved < 1e-9, "{activity:?}: {moved}");
    }
}

#[test]
fn draping_beside_frozen_cloth_has_the_same_bits_on_any_number_of_threads() {
    let hash = |workers: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build().expect("workers");
        pool.install(|| {
            let mut s = session();
            scenario::frozen(&mut s);
            cloth_hash(&mut s)
        })
    };
    assert_eq!(hash(1), hash(4));
}
