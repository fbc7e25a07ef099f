//! Sizes and grade rules: commands, undo, recordings, project files.

use glam::DVec2;
use toile::geometry::ids::PieceId;
use toile::pattern::edit::{LinePoint, PatternEdit};
use toile::pattern::grading::{READY_SIZES, graded};
use toile::pattern::{Edge, GradeRule, InternalLine, Pattern, RulePoint, SizeRun};
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::{Command, Project, Session, project_file};

use crate::common::session;

fn edit(edit: PatternEdit) -> Command {
    Command::EditPattern { edits: vec![edit], anew: false }
}

fn sizes() -> Command {
    edit(PatternEdit::SetSizes { sizes: READY_SIZES[0].run() })
}

fn rule(step: f64) -> GradeRule {
    GradeRule::even(DVec2::new(step, 0.0), 6, 2)
}

fn set(rule: Option<GradeRule>) -> Command {
    let at = RulePoint { piece: PieceId(1), line: None, point: 1 };
    edit(PatternEdit::SetRules { rules: vec![(at, rule)] })
}

fn with_rules() -> Session {
    let mut s = session();
    for command in [sizes(), set(Some(rule(0.01)))] {
        s.apply_alone(command).expect("accepted");
    }
    s
}

fn pattern(s: &Session) -> Pattern {
    Pattern::clone(&s.document().pattern)
}

#[test]
fn rules_are_set_cleared_and_undone() {
    let mut s = with_rules();
    assert_eq!(s.undo_label(), Some("set a rule"));
    let large = graded(&pattern(&s), "L").expect("a size");
    let moved =
        large.pattern.pieces[&PieceId(1)].edge(1).start - pattern(&s).pieces[&PieceId(1)].edge(1).start;
    assert!(moved.distance(DVec2::new(0.01, 0.0)) < 1e-12);
    s.apply_alone(set(None)).expect("cleared");
    assert_eq!(s.undo_label(), Some("clear a rule"));
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(pattern(&s).pieces[&PieceId(1)].edge(1).rule, Some(rule(0.01)));
    s.apply_alone(edit(PatternEdit::SetSizes { sizes: SizeRun::default() })).expect("removed");
    assert_eq!(pattern(&s).pieces[&PieceId(1)].edge(1).rule, None);
    for _ in 0..3 {
        s.apply_alone(Command::Undo).expect("undone");
    }
    assert_eq!(pattern(&s), pattern(&session()));
}

#[test]
fn rules_without_sizes_are_refused_and_leave_no_trace() {
    let mut s = session();
    let before = s.document().clone();
    assert!(s.apply_alone(set(Some(rule(0.01)))).expect_err("no sizes").0.contains("no sizes"));
    assert_eq!(*s.document(), before);
    s.apply_alone(sizes()).expect("sizes");
    let far = GradeRule::even(DVec2::new(9.0, 0.0), 6, 2);
    assert!(s.apply_alone(set(Some(far))).expect_err("too far").0.contains("metres"));
    let faulty = SizeRun { names: vec!["S".to_owned(), "S".to_owned()], base: 0 };
    let why = s.apply_alone(edit(PatternEdit::SetSizes { sizes: faulty })).expect_err("twice").0;
    assert!(why.contains("two sizes S"), "{why}");
}

#[test]
fn a_recording_with_rules_replays_to_the_same_hashes() {
    let mut s = with_rules();
    s.apply_alone(edit(PatternEdit::SetSizes { sizes: READY_SIZES[1].run() })).expect("another run");
    let mut replay = Replay::new(Recording::parse(&s.recording()).expect("a recording"));
    replay.run().expect("the same document");
    assert!(replay.hashes_compared() >= 3);
}

#[test]
fn rules_do_not_cut_the_cloth_anew() {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("a wrap");
    let before = s.last_seq();
    s.apply_alone(sizes()).expect("sizes");
    s.apply_alone(set(Some(rule(0.01)))).expect("a rule");
    // The simulation has been asked for nothing since.
    s.update();
    assert!(s.is_caught_up() || s.snapshot().seq >= before);
}

#[test]
fn the_project_file_keeps_rules_and_refuses_bad_ones() {
    let kept = with_rules().project();
    let read =
        |project: &Project| project_file::from_bytes(&project_file::to_bytes(project).expect("written"));
    assert_eq!(read(&kept).expect("read"), kept);
    let faulty = |change: &dyn Fn(&mut Pattern)| {
        let mut project = kept.clone();
        change(std::sync::Arc::make_mut(&mut project.document.pattern));
        read(&project).expect_err("refused").to_string()
    };
    let why = faulty(&|pattern| {
        let piece = std::sync::Arc::make_mut(pattern.pieces.get_mut(&PieceId(1)).expect("a piece"));
        piece.outline[1].rule = Some(GradeRule(vec![DVec2::ZERO]));
    });
    assert!(why.contains("point 2: a rule has 1 displacements, but there are 6 sizes"), "{why}");
    assert!(faulty(&|pattern| pattern.sizes.base = 9).contains("base of 6 sizes"));
    // Files without sizes, as older programs wrote them, have no word of them.
    let plain = project_file::to_bytes(&session().project()).expect("written");
    assert!(!String::from_utf8_lossy(&plain).contains("sizes"));
}

/// A session with a line inside the first piece, whose end was moved and has a rule.
fn with_line() -> Session {
    let mut s = with_rules();
    let edges = vec![Edge { start: DVec2::new(0.05, 0.05), ..Edge::default() }];
    let line = InternalLine { edges, end: DVec2::new(0.2, 0.05), ..InternalLine::default() };
    let end = LinePoint { piece: PieceId(1), line: 0, point: 1 };
    for command in [
        edit(PatternEdit::AddLine { piece: PieceId(1), line }),
        edit(PatternEdit::MoveLinePoints { points: vec![(end, DVec2::new(0.2, 0.1))] }),
        edit(PatternEdit::SetRules { rules: vec![(end.into(), Some(rule(0.03)))] }),
    ] {
        s.apply_alone(command).expect("accepted");
    }
    s
}

#[test]
fn points_of_lines_are_moved_graded_undone_and_recorded() {
    let mut s = with_line();
    let line = |s: &Session| pattern(s).pieces[&PieceId(1)].lines[0].clone();
    assert_eq!((line(&s).end, line(&s).end_rule), (DVec2::new(0.2, 0.1), Some(rule(0.03))));
    let large = graded(&pattern(&s), "L").expect("a size").pattern;
    assert!(large.pieces[&PieceId(1)].lines[0].end.distance(DVec2::new(0.23, 0.1)) < 1e-12);
    let mut replay = Replay::new(Recording::parse(&s.recording()).expect("a recording"));
    replay.run().expect("the same document");
    assert_eq!(replay.session().document(), s.document());
    let project = s.project();
    let bytes = project_file::to_bytes(&project).expect("written");
    assert_eq!(project_file::from_bytes(&bytes).expect("read"), project);
    for (label, end) in [("set a rule", [0.2, 0.1]), ("move a point", [0.2, 0.05])] {
        assert_eq!(s.undo_label(), Some(label));
        s.apply_alone(Command::Undo).expect("undone");
        assert_eq!((line(&s).end, line(&s).end_rule), (DVec2::from(end), None));
    }
    let inner = LinePoint { piece: PieceId(1), line: 0, point: 1 };
    let before = line(&s);
    for made in [
        PatternEdit::InsertLinePoint { edge: LinePoint { point: 0, ..inner }, at: 0.5 },
        PatternEdit::SetLineSmooth { point: inner, smooth: true },
    ] {
        s.apply_alone(edit(made)).expect("accepted");
    }
    assert!(line(&s).edges[1].smooth);
    let mut replay = Replay::new(Recording::parse(&s.recording()).expect("a recording"));
    replay.run().expect("the same document");
    assert_eq!(replay.session().document(), s.document());
    for label in ["make a point smooth", "add a point"] {
        assert_eq!(s.undo_label(), Some(label));
        s.apply_alone(Command::Undo).expect("undone");
    }
    assert_eq!(line(&s), before);
    let far = LinePoint { piece: PieceId(1), line: 0, point: 0 };
    let moved = PatternEdit::MoveLinePoints { points: vec![(far, DVec2::new(f64::NAN, 0.0))] };
    assert!(s.apply_alone(edit(moved)).expect_err("no place").0.contains("a place is not within"));
}
