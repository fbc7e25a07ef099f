//! Frozen pieces.

use glam::{DVec2, DVec3};
use toile::drag::{DragMode, Ray};
use toile::geometry::ids::PieceId;
use toile::pattern::activity::Activity;
use toile::pattern::edit::PatternEdit;
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
