use super::*;
use crate::geometry::ids::PieceId;
use crate::pattern::edit::{PatternEdit, apply};
use crate::pattern::grading::READY_SIZES;
use crate::pattern::{EdgeRef, InternalLine};

fn square() -> Pattern {
    let corners = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.4), (0.0, 0.4)].map(DVec2::from);
    let mut pattern = Pattern { sizes: READY_SIZES[0].run(), ..Pattern::default() };
    let mut piece = Piece::polygon("front", &corners);
    let edges = vec![crate::pattern::Edge { start: DVec2::splat(0.1), ..Default::default() }];
    piece.lines.push(InternalLine { edges, end: DVec2::splat(0.3), ..InternalLine::default() });
    pattern.add_piece(piece);
    pattern
}

fn at(point: usize) -> RulePoint {
    RulePoint { piece: PieceId(1), line: None, point }
}

fn rule(x: f64) -> GradeRule {
    GradeRule::even(DVec2::new(x, 0.0), 6, 2)
}

fn done(pattern: &Pattern, edit: PatternEdit) -> Pattern {
    apply(pattern, &edit).expect("an edit").pattern
}

fn set(pattern: &Pattern, rules: &[(RulePoint, Option<GradeRule>)]) -> Pattern {
    done(pattern, PatternEdit::SetRules { rules: rules.to_vec() })
}

fn rule_of(pattern: &Pattern, piece: u32, point: usize) -> Option<&GradeRule> {
    pattern.pieces[&PieceId(piece)].edge(point).rule.as_ref()
}

#[test]
fn rules_are_set_and_removed_on_outlines_and_lines() {
    let inside = [0, 1].map(|point| RulePoint { line: Some(0), ..at(point) });
    let new = set(
        &square(),
        &[(at(1), Some(rule(0.01))), (inside[0], Some(rule(0.02))), (inside[1], Some(rule(0.03)))],
    );
    assert_eq!(rule_of(&new, 1, 1), Some(&rule(0.01)));
    let line = &new.pieces[&PieceId(1)].lines[0];
    assert_eq!((line.edges[0].rule.as_ref(), line.end_rule.as_ref()), (Some(&rule(0.02)), Some(&rule(0.03))));
    let back = set(&new, &[at(1), inside[0], inside[1]].map(|at| (at, None)));
    assert_eq!(back, square());
}

#[test]
fn rules_that_fit_no_size_or_point_are_refused() {
    let words = |pattern: &Pattern, at: RulePoint, rule: GradeRule| {
        apply(pattern, &PatternEdit::SetRules { rules: vec![(at, Some(rule))] }).expect_err("refused")
    };
    assert!(
        words(&Pattern { sizes: SizeRun::default(), ..square() }, at(0), rule(0.01)).contains("no sizes")
    );
    assert!(words(&square(), at(0), GradeRule::default()).contains("0 displacements"));
    assert!(words(&square(), at(4), rule(0.01)).contains("front has no point 5"));
    assert!(words(&square(), RulePoint { line: Some(0), ..at(2) }, rule(0.01)).contains("no point 3"));
    assert!(words(&square(), at(0), GradeRule::even(DVec2::X, 6, 1)).contains("metres"));
}

#[test]
fn twins_and_symmetric_halves_follow() {
    let twins = done(&square(), PatternEdit::AddTwin { piece: PieceId(1), offset: DVec2::X });
    let new = set(&twins, &[(at(1), Some(rule(0.01)))]);
    assert_eq!(rule_of(&new, 2, 3), Some(&rule(-0.01)));
    let half = done(&square(), PatternEdit::Unfold { edge: EdgeRef { piece: PieceId(1), edge: 3 } });
    let n = half.pieces[&PieceId(1)].outline.len();
    for point in [1, n - 1] {
        let new = set(&half, &[(at(point), Some(rule(0.01)))]);
        assert_eq!(rule_of(&new, 1, n - point), Some(&rule(-0.01)), "{point}");
        assert_eq!(rule_of(&new, 1, point), Some(&rule(0.01)));
    }
    let axis = set(&half, &[(at(0), Some(GradeRule::even(DVec2::splat(0.01), 6, 2)))]);
    assert_eq!(rule_of(&axis, 1, 0), Some(&GradeRule::even(DVec2::new(0.0, 0.01), 6, 2)), "the axis stays");
}

#[test]
fn a_new_run_keeps_what_rules_say_of_sizes_of_the_same_name() {
    let new = set(&square(), &[(at(1), Some(rule(0.01)))]);
    let in_run = |names: &[&str], base: &str| {
        let sizes = SizeRun::new(names.iter().copied(), base).expect("a run");
        let new = done(&new, PatternEdit::SetSizes { sizes });
        let steps = rule_of(&new, 1, 1).expect("a rule").0.clone();
        steps.into_iter().map(|by| (by.x * 1e6).round() / 1e3).collect::<Vec<f64>>()
    };
    assert_eq!(in_run(&["S", "M", "L"], "M"), [-10.0, 0.0, 10.0]);
    assert_eq!(in_run(&["S", "M", "L"], "S"), [0.0, 10.0, 20.0], "what is drawn is now S");
    assert_eq!(in_run(&["M", "XL", "XXL", "3XL", "4XL"], "M"), [0.0, 20.0, 30.0, 40.0, 50.0]);
    assert_eq!(in_run(&["S", "S/M", "M"], "M"), [-10.0, -5.0, 0.0]);
    assert_eq!(in_run(&["36", "38", "40"], "38"), [-10.0, 0.0, 10.0], "no name stays: by distance");
    let none = done(&new, PatternEdit::SetSizes { sizes: SizeRun::default() });
    assert!(none.sizes.is_empty() && rule_of(&none, 1, 1).is_none());
    let faulty = SizeRun { names: vec!["S".to_owned(); 2], base: 0 };
    assert!(apply(&new, &PatternEdit::SetSizes { sizes: faulty }).is_err());
}

#[test]
fn a_point_put_on_an_edge_has_the_rule_of_its_place() {
    let new = set(&square(), &[(at(1), Some(rule(0.01)))]);
    let edge = EdgeRef { piece: PieceId(1), edge: 0 };
    let split = done(&new, PatternEdit::InsertPoint { edge, at: 0.25 });
    assert_eq!(rule_of(&split, 1, 1), Some(&rule(0.0025)));
    assert_eq!(rule_of(&split, 1, 2), Some(&rule(0.01)));
    let back = done(
        &split,
        PatternEdit::DeletePoint { point: crate::pattern::edit::PointRef { piece: PieceId(1), point: 1 } },
    );
    assert_eq!(back.pieces, new.pieces);
    let cut = InternalLine {
        edges: vec![crate::pattern::Edge { start: DVec2::new(0.2, 0.0), ..Default::default() }],
        end: DVec2::new(0.2, 0.4),
        ..InternalLine::default()
    };
    let cut = done(&new, PatternEdit::Cut { piece: PieceId(1), line: cut, sew: true });
    for (id, piece) in &cut.pieces {
        let mouth = piece.outline.iter().find(|e| e.start == DVec2::new(0.2, 0.0)).expect("the cut's end");
        assert_eq!(mouth.rule, Some(rule(0.005)), "{id}");
    }
}

#[test]
fn a_garment_worn_over_takes_the_sizes_of_the_first() {
    let over = set(&square(), &[(at(1), Some(rule(0.01)))]);
    let mut numbers = Pattern { sizes: READY_SIZES[1].run(), ..Pattern::default() };
    numbers.wear_over(&over, "coat").expect("worn");
    let steps = &rule_of(&numbers, 1, 1).expect("a rule").0;
    assert_eq!((steps.len(), steps[2], steps[3].x), (7, DVec2::ZERO, 0.01));
    let mut none = Pattern::default();
    none.wear_over(&over, "coat").expect("worn");
    assert_eq!((&none.sizes, rule_of(&none, 1, 1)), (&over.sizes, Some(&rule(0.01))));
}
