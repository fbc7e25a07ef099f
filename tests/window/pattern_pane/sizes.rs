//! Sizes in the window: the panel's numbers, and points moved in a size other than the base.

use toile::pattern::grading::READY_SIZES;
use toile::pattern::{GradeRule, SizeRun};

use super::*;

fn graded() -> Pattern {
    Pattern { sizes: READY_SIZES[0].run(), ..squares() }
}

/// Opens the section; with a tool of the pattern it is among the first.
fn open(window: &mut Window) {
    press(window, Key::A);
    window.get_by_label("Sizes of the pattern").click();
    // The section opens, and lists, in some frames.
    window.run_steps(24);
}

fn click_label(window: &mut Window, label: &str) {
    // Not by pointer: the panel may have to be scrolled to it.
    window.get_by_label(label).click_accesskit();
    window.run_steps(8);
}

fn rule(window: &Window, point: usize) -> Option<GradeRule> {
    piece(&pattern(window), "A").edge(point).rule.clone()
}

/// Where a point is drawn; the side panel names selected ones, too.
fn drawn(window: &Window, label: &str) -> Pos2 {
    let pane = window.get_by_label("Pattern pane").rect();
    let all = window.get_all_by_label(label).map(|node| node.rect().center());
    all.into_iter().find(|at| pane.contains(*at)).expect("a point on the table")
}

/// Selects a point of A with the tool Edit points.
fn select(window: &mut Window, label: &str) {
    press(window, Key::A);
    let point = drawn(window, label);
    click(window, point);
}

#[test]
fn a_run_is_chosen_from_those_offered() {
    let mut window = window_on(squares());
    open(&mut window);
    click_label(&mut window, "Choose sizes…");
    click_label(&mut window, "Women, EU 34 to 46");
    assert_eq!(pattern(&window).sizes, READY_SIZES[1].run());
    assert_eq!(steps(&window), ["set the sizes"]);
}

#[test]
fn a_rule_is_copied_mirrored_and_cleared() {
    let mut start = graded();
    let id = start.piece_named("A").expect("a square");
    let piece = Arc::make_mut(start.pieces.get_mut(&id).expect("the square"));
    let of = |x: f64| GradeRule::even(DVec2::new(x, 0.005), 6, 2);
    piece.outline[1].rule = Some(of(0.01));
    let mut window = window_on(start);
    open(&mut window);
    select(&mut window, "A, point 2");
    click_label(&mut window, "Copy rule");
    let point = drawn(&window, "A, point 1");
    click(&mut window, point);
    click_label(&mut window, "Mirrored across");
    assert_eq!(rule(&window, 0), Some(of(-0.01)));
    click_label(&mut window, "Clear rule");
    assert_eq!((rule(&window, 0), rule(&window, 1)), (None, Some(of(0.01))));
}

#[test]
fn the_base_is_changed_and_all_sizes_removed() {
    let mut window = window_on(graded());
    open(&mut window);
    click_label(&mut window, "Base M");
    click_label(&mut window, "S is the base");
    assert_eq!(pattern(&window).sizes.base_name(), "S");
    click_label(&mut window, "Remove sizes");
    assert_eq!(pattern(&window).sizes, SizeRun::default());
    assert_eq!(steps(&window), ["set the sizes", "remove the sizes"]);
}

#[test]
fn a_point_dragged_in_a_size_moves_in_that_size_alone_and_with_shift_in_all() {
    let mut window = window_on(graded());
    open(&mut window);
    select(&mut window, "A, point 2");
    click_label(&mut window, "Show size XL");
    let point = drawn(&window, "A, point 2");
    drag(&mut window, point, point + Vec2::new(20.0, 0.0));
    let own = rule(&window, 1).expect("a rule");
    assert!(own.at(4).x > 0.005 && own.at(4).y.abs() < 1e-9, "{own:?}");
    assert!((0..6).all(|size| size == 4 || own.at(size) == DVec2::ZERO), "{own:?}");
    assert_eq!(piece(&pattern(&window), "A").edge(1).start, piece(&graded(), "A").edge(1).start);
    assert_eq!(steps(&window), ["set a rule"]);
    let point = drawn(&window, "A, point 3");
    window.event(Event::ModifiersChanged(Modifiers::SHIFT));
    move_to(&mut window, point);
    button(&mut window, point, true, Modifiers::SHIFT);
    move_to(&mut window, point + Vec2::new(12.0, 0.0));
    button(&mut window, point + Vec2::new(12.0, 0.0), false, Modifiers::SHIFT);
    window.event(Event::ModifiersChanged(Modifiers::NONE));
    window.run_steps(3);
    let even = rule(&window, 2).expect("a rule");
    assert!((even.at(4).x - 2.0 * even.at(3).x).abs() < 1e-9 && even.at(1).x < -0.001, "{even:?}");
}
