//! What commands do, and that refused ones leave no trace.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::geometry::ids::{MarkId, PieceId, SeamId};
use toile::pattern::edit::{PatternEdit, PointRef};
use toile::pattern::{EdgeRef, Piece, PlanePose, Seam};
use toile::relax::RelaxSettings;
use toile::session::{BodyChoice, Command, Session, Settings};
use toile::wrap::{ClothSide, Marks};

use crate::common::{cloth_hash, run, session};

fn refused(session: &mut Session, command: Command, word: &str) {
    let (document, hash, text) = (session.document().clone(), session.document_hash(), session.recording());
    let why = session.apply_alone(command).expect_err("refused").to_string();
    assert!(why.contains(word), "{why:?} should speak of {word:?}");
    assert_eq!(session.document(), &document);
    assert_eq!(session.document_hash(), hash);
    assert_eq!(session.recording(), text, "a refused command is not recorded");
    assert!(session.undo_label().is_none());
}

#[test]
fn refused_commands_leave_no_trace() {
    let s = &mut session();
    let (piece, none) = (PieceId(1), PieceId(99));
    let edge = |piece, edge| EdgeRef { piece, edge };
    let relax = RelaxSettings { stretch: f64::NAN, ..RelaxSettings::default() };
    let pose = PlanePose { rotation: f64::INFINITY, ..PlanePose::default() };
    let stroke =
        |points: &[DVec2]| Command::AddClothMark { piece, side: ClothSide::Front, points: points.to_vec() };
    refused(s, stroke(&[]), "at least one point");
    refused(s, stroke(&[DVec2::new(f64::NAN, 0.0)]), "origin");
    refused(
        s,
        Command::AddClothMark { piece: none, side: ClothSide::Front, points: vec![DVec2::ZERO] },
        "no piece 99",
    );
    refused(s, Command::AddBodyMark { points: vec![DVec3::splat(1e9)] }, "origin");
    refused(s, Command::DeleteMark { mark: MarkId(7) }, "no mark 7");
    refused(s, Command::DeletePair { number: 2 }, "number 2");
    refused(s, Command::MoveMark { mark: MarkId(1), to: 2 }, "from 1 to 1");
    refused(s, Command::RenameMark { mark: MarkId(7), name: "x".to_owned() }, "no mark 7");
    refused(s, Command::RenameMark { mark: MarkId(1), name: "a\u{7}".to_owned() }, "control");
    let mut nobody = Marks::default();
    nobody.names.insert(MarkId(3), "x".to_owned());
    refused(s, Command::SetMarks { marks: Arc::new(nobody) }, "not there");
    refused(s, Command::RenamePiece { piece, name: " ".to_owned() }, "visible");
    refused(s, Command::RenamePiece { piece, name: "a\u{7}".to_owned() }, "control");
    refused(s, Command::SetPiecePose { piece, pose }, "finite");
    refused(s, Command::DeletePiece { piece: none }, "no piece 99");
    let outline = Piece::polygon("triangle", &[DVec2::ZERO, DVec2::X, DVec2::Y]).outline;
    refused(s, Command::SetOutline { piece, outline }, "sewn by its 4 edges");
    let seam = Seam::of_edges([edge(piece, 0), edge(piece, 0)], false);
    refused(s, Command::AddSeam { seam }, "itself");
    let seam = Seam::of_edges([edge(piece, 1), edge(piece, 0)], false);
    refused(s, Command::AddSeam { seam }, "sewn already");
    let seam = Seam::of_edges([edge(piece, 9), edge(piece, 0)], false);
    refused(s, Command::AddSeam { seam }, "no edge 10");
    refused(s, Command::ReverseSeam { seam: SeamId(50) }, "no seam 50");
    refused(
        s,
        Command::SetSettings { settings: Settings { edge_length: 1.0, ..Settings::default() } },
        "mesh size",
    );
    refused(s, Command::SetSettings { settings: Settings { relax, ..Settings::default() } }, "stretch");
    let body = s.document().body.clone();
    refused(s, Command::SetBody { body, animations: None }, "already");
    let body = BodyChoice::Imported { name: "nothing".to_owned(), mesh: Arc::default() };
    refused(s, Command::SetBody { body, animations: None }, "nothing");
    refused(s, Command::Undo, "nothing to undo");
    refused(s, Command::Redo, "nothing to redo");
    refused(s, Command::CancelWrap, "no wrap");
    refused(s, Command::CancelGesture, "changed nothing");
}

#[test]
fn deleting_a_piece_takes_its_seams_and_pairs() {
    let mut s = session();
    s.apply_alone(Command::DeletePiece { piece: PieceId(1) }).expect("deleted");
    assert_eq!(s.undo_label(), Some("delete left"));
    let document = s.document();
    assert_eq!((document.pattern.pieces.len(), document.pattern.seams.len()), (1, 0));
    assert_eq!((document.marks.cloth.len(), document.marks.body.len()), (0, 0));
}

#[test]
fn marks_keep_their_ids_when_renumbered() {
    let mut s = session();
    let body_mark = |x| Command::AddBodyMark { points: vec![DVec3::new(x, 0.0, 0.7)] };
    s.apply_alone(body_mark(0.1)).expect("painted");
    s.apply_alone(body_mark(0.2)).expect("painted");
    s.apply_alone(Command::MoveMark { mark: MarkId(4), to: 1 }).expect("moved");
    let ids: Vec<u32> = s.document().marks.body.iter().map(|m| m.id.0).collect();
    assert_eq!(ids, [4, 2, 3]);
    s.apply_alone(Command::DeleteMark { mark: MarkId(4) }).expect("deleted");
    s.apply_alone(body_mark(0.3)).expect("painted");
    assert_eq!(s.document().marks.body.last().map(|m| m.id), Some(MarkId(5)), "ids are never used twice");
}

#[test]
fn a_name_goes_with_its_mark() {
    let mut s = session();
    let rename = |name: &str| Command::RenameMark { mark: MarkId(2), name: name.to_owned() };
    s.apply_alone(rename("waist")).expect("named");
    assert_eq!(
        (s.document().marks.name(MarkId(2)), s.undo_label()),
        ("waist", Some("name mark 1 on the body waist"))
    );
    s.apply_alone(rename("")).expect("unnamed");
    assert_eq!(s.document().marks.name(MarkId(2)), "");
    s.apply_alone(Command::Undo).expect("undone");
    s.apply_alone(Command::DeleteMark { mark: MarkId(2) }).expect("deleted");
    assert!(s.document().marks.names.is_empty());
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(s.document().marks.name(MarkId(2)), "waist");
}

#[test]
fn another_body_takes_cloth_and_strokes_off() {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3);
    assert!(s.snapshot().is_dressed());
    let mesh = Arc::new(crate::common::ball(0.5, 8, 12));
    s.apply_alone(Command::SetBody {
        body: BodyChoice::Imported { name: "small".to_owned(), mesh },
        animations: None,
    })
    .expect("set");
    s.update();
    assert!(!s.snapshot().is_dressed() && s.document().marks.body.is_empty());
    assert!(
        s.problems()[0].place == "mark 1" && s.problems()[0].words.contains("small"),
        "{:?}",
        s.problems()
    );
    assert!(s.surface().is_some_and(|surface| surface.bounds().1.x < 0.6));
    s.apply_alone(Command::Undo).expect("undone");
    s.update();
    assert!(s.snapshot().is_dressed() && s.document().marks.body.len() == 1 && s.problems().is_empty());
    assert!(s.surface().is_some_and(|surface| surface.bounds().1.x > 0.7));
}

#[test]
fn cancelling_a_wrap_brings_back_what_was_on_the_body() {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 500);
    let dressed = cloth_hash(&mut s);
    s.apply_alone(Command::Wrap).expect("wrapped again");
    run(&mut s, 2);
    assert_ne!(cloth_hash(&mut s), dressed);
    s.apply_alone(Command::CancelWrap).expect("cancelled");
    assert_eq!(cloth_hash(&mut s), dressed);
    assert_eq!(s.step_labels().count(), 1, "the cancelled wrap leaves no step");
    // With a stroke painted meanwhile, cancelling is a step of its own and the stroke stays.
    s.apply_alone(Command::Wrap).expect("wrapped again");
    run(&mut s, 2);
    s.apply_alone(Command::AddBodyMark { points: vec![DVec3::Z] }).expect("painted");
    s.apply_alone(Command::CancelWrap).expect("cancelled");
    assert_eq!(cloth_hash(&mut s), dressed);
    assert_eq!((s.undo_label(), s.document().marks.body.len()), (Some("cancel wrap"), 2));
}

#[test]
fn changed_settings_wake_cloth_at_rest() {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 2000);
    assert_eq!(run(&mut s, 1), 0, "at rest");
    let relax = RelaxSettings { offset: 0.02, ..RelaxSettings::default() };
    let settings = Settings { relax, ..s.document().settings };
    s.apply_alone(Command::SetSettings { settings }).expect("set");
    assert_eq!(run(&mut s, 1), 1, "awake");
}

/// Numbers of edges, points, lines and holes from elsewhere may be the largest that there are.
#[test]
fn the_largest_numbers_are_refused_in_words() {
    let mut s = session();
    let (piece, last) = (PieceId(1), usize::MAX);
    let edge = EdgeRef { piece, edge: last };
    let edits = [
        PatternEdit::MovePoints { points: vec![(PointRef { piece, point: last }, DVec2::ZERO)] },
        PatternEdit::InsertPoint { edge, at: 0.5 },
        PatternEdit::AddNotch { edge, at: 0.5 },
        PatternEdit::DeleteNotch { piece, notch: last },
        PatternEdit::DeleteLine { piece, line: last },
        PatternEdit::DeleteHole { piece, hole: last },
        PatternEdit::Sew { seam: Seam::of_edges([edge, edge], false) },
    ];
    for edit in edits {
        let command = Command::EditPattern { edits: vec![edit], anew: false };
        let why = s.apply_alone(command.clone()).expect_err("refused").to_string();
        assert!(why.contains("left has no "), "{command:?}: {why}");
    }
}
