//! The pattern edited while the garment is dressed.

use std::sync::Arc;

use glam::DVec2;
use toile::geometry::ids::{PieceId, SeamId};
use toile::pattern::edit::{PatternEdit, PointRef};
use toile::pattern::{Edge, EdgeRef, InternalLine, Seam};
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::{Command, Session};
use toile::wrap::Phase;

use crate::common::{cloth_hash, run, session};

const LEFT: PieceId = PieceId(1);
const RIGHT: PieceId = PieceId(2);

fn dressed() -> Session {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 2000);
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    s
}

fn edit(edits: Vec<PatternEdit>) -> Command {
    Command::EditPattern { edits, anew: false }
}

fn corner(piece: PieceId, point: usize, x: f64, y: f64) -> PatternEdit {
    PatternEdit::MovePoints { points: vec![(PointRef { piece, point }, DVec2::new(x, y))] }
}

/// Mean edge strain, and how many vertices lie.
fn strain(s: &Session) -> (f64, usize) {
    let snapshot = s.snapshot();
    let (garment, cloth) = (snapshot.garment.as_ref().expect("a garment"), &snapshot.cloth);
    let mut sum = (0.0, 0);
    for (t, rest) in garment.triangles.iter().zip(&garment.rest) {
        for k in 0..3 {
            let l = (k + 1) % 3;
            let long = cloth.positions[t[k] as usize].distance(cloth.positions[t[l] as usize]);
            sum = (sum.0 + (long / rest[k].distance(rest[l]) - 1.0).abs(), sum.1 + 1);
        }
    }
    (sum.0 / f64::from(sum.1), cloth.mapped.iter().filter(|&&m| m).count())
}

#[test]
fn the_cloth_follows_a_moved_point_and_undo_brings_both_back() {
    let mut s = dressed();
    let (pattern, cloth) = (Arc::clone(&s.document().pattern), cloth_hash(&mut s));
    s.apply_alone(edit(vec![corner(RIGHT, 1, 0.35, -0.05)])).expect("edited");
    s.update();
    let snapshot = Arc::clone(s.snapshot());
    let garment = snapshot.garment.as_ref().expect("a garment");
    let far =
        garment.corners.iter().find(|c| c.piece == RIGHT && c.uv.distance(DVec2::new(0.35, -0.05)) < 1e-6);
    assert!(snapshot.cloth.mapped[far.expect("the moved corner").vertex as usize], "it lies at once");
    run(&mut s, 3000);
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    let (strain, lying) = strain(&s);
    assert!(strain < 0.02 && lying == garment.vertex_count, "{strain}");
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(s.document().pattern, pattern);
    assert_eq!(cloth_hash(&mut s), cloth);
    s.apply_alone(Command::Redo).expect("done again");
    run(&mut s, 3000);
    assert_eq!(s.document().pattern.pieces[&RIGHT].edge(1).start, DVec2::new(0.35, -0.05));
}

#[test]
fn a_drag_of_a_point_begins_each_time_from_the_pattern_before_it() {
    let mut s = dressed();
    let seam = *s.document().pattern.seams.keys().next().expect("a seam");
    s.apply_alone(edit(vec![PatternEdit::SetRatio { seam, ratio: Some(1.0) }])).expect("held");
    run(&mut s, 3000);
    let (before, cloth) = (Arc::clone(&s.document().pattern), cloth_hash(&mut s));
    let gesture = s.begin_gesture();
    for k in 1..=20 {
        let edits = vec![corner(RIGHT, 0, 0.0, -0.004 * f64::from(k))];
        s.apply(Command::EditPattern { edits, anew: true }, gesture).expect("dragged");
        run(&mut s, 2);
    }
    let far = Arc::clone(&s.document().pattern);
    assert!(far.pieces[&LEFT].edge(1).start.distance(before.pieces[&LEFT].edge(1).start) > 0.01);
    // Back where it began, nothing has crept.
    let edits = vec![corner(RIGHT, 0, 0.0, 0.0)];
    s.apply(Command::EditPattern { edits, anew: true }, gesture).expect("dragged back");
    assert_eq!(s.document().pattern, before);
    s.apply(Command::CancelGesture, gesture).expect("cancelled");
    assert_eq!((Arc::clone(&s.document().pattern), cloth_hash(&mut s)), (before, cloth));
    assert_eq!(s.undo_label(), Some(format!("change the gather of {seam}").as_str()));
}

#[test]
fn a_scaled_piece_takes_its_marks_pins_and_cloth_along() {
    let mut s = dressed();
    s.apply_alone(Command::AddPin { piece: LEFT, at: DVec2::new(0.1, 0.1) }).expect("pinned");
    let gesture = s.begin_gesture();
    for factor in [1.05, 1.2, 1.1] {
        let edits =
            vec![PatternEdit::Scale { pieces: vec![LEFT], about: DVec2::ZERO, factor: DVec2::splat(factor) }];
        s.apply(Command::EditPattern { edits, anew: true }, gesture).expect("scaled");
    }
    s.end_gesture(gesture);
    s.update();
    assert!(s.document().marks.cloth[0].points[0].distance(DVec2::new(0.055, 0.22)) < 1e-12);
    assert!(s.document().pins[0].place.at.distance(DVec2::new(0.11, 0.11)) < 1e-12);
    assert!(s.snapshot().pinned[0].is_some());
    // Scaled from where it lay, the cloth is pressed together by as much at first, all over.
    let (strain_now, lying) = strain(&s);
    assert!(strain_now < 0.12 && lying == s.snapshot().garment.as_ref().expect("a garment").vertex_count);
    run(&mut s, 4000);
    assert!(strain(&s).0 < 0.02, "{:?}", strain(&s));
}

#[test]
fn cutting_stitching_and_taking_away_work_while_dressed() {
    let mut s = dressed();
    let edges = vec![Edge { start: DVec2::new(0.1, 0.0), ..Edge::default() }];
    let line = InternalLine { edges, end: DVec2::new(0.1, 0.3), ..InternalLine::default() };
    s.apply_alone(edit(vec![PatternEdit::Cut { piece: RIGHT, line, sew: true }])).expect("cut");
    run(&mut s, 3000);
    assert_eq!(s.document().pattern.pieces.len(), 3);
    let (strained, lying) = strain(&s);
    assert!(strained < 0.02 && lying == s.snapshot().garment.as_ref().expect("a garment").vertex_count);
    // Unpicked, the outer part is a piece of its own; it lies where it lay.
    let sewn = *s.document().pattern.seams.keys().last().expect("the new seam");
    s.apply_alone(edit(vec![PatternEdit::Unpick { seams: vec![sewn] }])).expect("unpicked");
    run(&mut s, 3000);
    assert!(s.snapshot().cloth.mapped.iter().all(|&m| m));
    let seam = Seam { ratio: Some(1.0), ..seam_of(&s, sewn) };
    s.apply_alone(edit(vec![PatternEdit::Sew { seam }])).expect("sewn again");
    run(&mut s, 3000);
    assert!(strain(&s).0 < 0.02);
    let outer = *s.document().pattern.pieces.keys().last().expect("a piece");
    s.apply_alone(edit(vec![PatternEdit::DeletePieces { pieces: vec![outer] }])).expect("taken away");
    run(&mut s, 3000);
    assert!(s.snapshot().cloth.mapped.iter().all(|&m| m));
    assert_eq!(s.snapshot().garment.as_ref().expect("a garment").pieces.len(), 2);
}

/// The seam that was unpicked last.
fn seam_of(s: &Session, _id: SeamId) -> Seam {
    let pieces: Vec<PieceId> = s.document().pattern.pieces.keys().copied().collect();
    let (inner, outer) = (&s.document().pattern.pieces[&pieces[1]], pieces[2]);
    let at = |piece: &toile::pattern::Piece| {
        (0..piece.edge_count()).find(|&i| {
            let (a, b) = piece.edge_ends(i);
            (a.x - 0.1).abs() < 1e-9 && (b.x - 0.1).abs() < 1e-9
        })
    };
    let one = EdgeRef { piece: pieces[1], edge: at(inner).expect("the cut") };
    let other = EdgeRef { piece: outer, edge: at(&s.document().pattern.pieces[&outer]).expect("the cut") };
    Seam::of_edges([one, other], false)
}

#[test]
fn a_new_piece_is_named_until_it_is_wrapped() {
    let mut s = dressed();
    let mut piece = toile::pattern::Piece::clone(&s.document().pattern.pieces[&RIGHT]);
    piece.name = "more".to_owned();
    s.apply_alone(edit(vec![PatternEdit::AddPiece { piece: Arc::new(piece) }])).expect("added");
    let new = *s.document().pattern.pieces.keys().last().expect("a piece");
    let sides = [EdgeRef { piece: RIGHT, edge: 1 }, EdgeRef { piece: new, edge: 3 }];
    s.apply_alone(edit(vec![PatternEdit::Sew { seam: Seam::of_edges(sides, false) }])).expect("sewn");
    s.update();
    assert!(s.snapshot().problems.iter().any(|p| p.place.contains("more") && p.words.contains("wrap again")));
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 4000);
    assert!(s.snapshot().cloth.mapped.iter().all(|&m| m));
    assert!(s.snapshot().problems.iter().all(|p| !p.words.contains("wrap again")));
}

#[test]
fn edits_of_dressed_cloth_replay_to_the_same_bits() {
    let mut s = dressed();
    s.apply_alone(edit(vec![corner(RIGHT, 1, 0.3, 0.0)])).expect("edited");
    run(&mut s, 5);
    let gesture = s.begin_gesture();
    for x in [0.31, 0.33] {
        let edits = vec![corner(RIGHT, 2, x, 0.3)];
        s.apply(Command::EditPattern { edits, anew: true }, gesture).expect("dragged");
        run(&mut s, 3);
    }
    s.end_gesture(gesture);
    run(&mut s, 3000);
    s.apply_alone(Command::Undo).expect("undone");
    run(&mut s, 3000);
    let recording = Recording::parse(&s.recording()).expect("a recording");
    Replay::new(recording).run().expect("the same hashes");
}
