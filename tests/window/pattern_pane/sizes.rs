//! Sizes in the window: the panel's numbers, and points moved in a size other than the base.

use toile::pattern::grading::READY_SIZES;
use toile::pattern::{Edge, GradeRule, InternalLine, SizeRun};

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

/// The graded squares with a line inside the first, 10 cm long.
fn with_line() -> Pattern {
    let mut start = graded();
    let id = start.piece_named("A").expect("a square");
    let piece = Arc::make_mut(start.pieces.get_mut(&id).expect("the square"));
    let edges = vec![Edge { start: DVec2::new(0.05, 0.05), ..Edge::default() }];
    piece.lines.push(InternalLine { edges, end: DVec2::new(0.15, 0.05), ..InternalLine::default() });
    piece.outline[1].rule = Some(GradeRule::even(DVec2::new(0.01, 0.005), 6, 2));
    start
}

fn line(window: &Window) -> InternalLine {
    piece(&pattern(window), "A").lines[0].clone()
}

/// Selects the line, then its end.
fn select_end(window: &mut Window) {
    select(window, "A, line 1");
    let end = drawn(window, "A, line 1, point 2");
    click(window, end);
}

#[test]
fn a_point_of_a_line_gets_its_rule_in_the_panel() {
    let mut window = window_on(with_line());
    open(&mut window);
    select(&mut window, "A, point 2");
    click_label(&mut window, "Copy rule");
    select_end(&mut window);
    assert!(window.query_by_label("Rule of A, line 1, point 2").is_some());
    let of = |x: f64, y: f64| GradeRule::even(DVec2::new(x, y), 6, 2);
    for (label, rule) in [
        ("Paste rule", Some(of(0.01, 0.005))),
        ("Mirrored across", Some(of(-0.01, 0.005))),
        ("Mirrored along", Some(of(0.01, -0.005))),
        ("Clear rule", None),
    ] {
        click_label(&mut window, label);
        assert_eq!((line(&window).end_rule, &line(&window).edges[0].rule), (rule, &None), "{label}");
    }
    let role = egui::accesskit::Role::TextInput;
    window.get_all_by_role_and_label(role, "Each step").nth(1).expect("a field along the grain").focus();
    window.run_steps(2);
    key(&mut window, Modifiers::COMMAND, Key::A);
    type_text(&mut window, "0.4 cm");
    press(&mut window, Key::Enter);
    let rule = line(&window).end_rule.expect("a rule");
    assert!((0..6).all(|size| (rule.at(size).y - of(0.0, 0.004).at(size).y).abs() < 1e-9), "{rule:?}");
    assert_eq!(steps(&window).len(), 5);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(line(&window).end_rule, None);
}

#[test]
fn a_point_of_a_line_dragged_in_a_size_moves_in_that_size_alone() {
    let mut window = window_on(with_line());
    open(&mut window);
    select(&mut window, "A, line 1");
    click_label(&mut window, "Show size XL");
    let end = drawn(&window, "A, line 1, point 2");
    drag(&mut window, end, end + Vec2::new(0.0, -20.0));
    let own = line(&window).end_rule.expect("a rule");
    // The end followed the cloth round it in the other sizes, and does so still.
    assert!(own.at(4).y > 0.01 && own.at(2) == DVec2::ZERO && own.at(3).y < 0.01, "{own:?}");
    assert_eq!((line(&window).end, &line(&window).edges[0].rule), (DVec2::new(0.15, 0.05), &None));
    assert_eq!(steps(&window), ["set a rule"]);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(pattern(&window), with_line());
}

#[test]
fn points_of_a_line_and_the_line_are_dragged_in_the_base_size() {
    let mut window = window_on(with_line());
    select_end(&mut window);
    let end = drawn(&window, "A, line 1, point 2");
    drag(&mut window, end, end + Vec2::new(0.0, -20.0));
    let moved = line(&window);
    assert!(moved.end.y > 0.06 && moved.edges[0].start == DVec2::new(0.05, 0.05), "{moved:?}");
    assert_eq!(steps(&window), ["move a point"]);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(pattern(&window), with_line());
    let middle = drawn(&window, "A, line 1");
    drag(&mut window, middle, middle + Vec2::new(0.0, -20.0));
    let moved = line(&window);
    let [start, end] = [moved.edges[0].start, moved.end];
    assert!(start.y > 0.06 && (end - start).distance(DVec2::new(0.1, 0.0)) < 1e-9, "{moved:?}");
    assert_eq!(piece(&pattern(&window), "A").outline, piece(&with_line(), "A").outline);
    assert_eq!(steps(&window), ["move 2 points"]);
}

/// Clicks twice in one place, and waits until another click is not the third.
fn double_click(window: &mut Window, at: Pos2) {
    move_to(window, at);
    for _ in 0..2 {
        button(window, at, true, Modifiers::NONE);
        button(window, at, false, Modifiers::NONE);
    }
    window.run_steps(3);
    std::thread::sleep(Duration::from_millis(2));
    window.run_steps(30);
}

#[test]
fn a_double_click_on_a_point_of_a_line_makes_it_smooth_and_a_corner_again() {
    let mut start = with_line();
    let id = start.piece_named("A").expect("a square");
    let bent = &mut Arc::make_mut(start.pieces.get_mut(&id).expect("the square")).lines[0];
    bent.edges.push(Edge { start: DVec2::new(0.1, 0.07), ..Edge::default() });
    let mut window = window_on(start);
    select(&mut window, "A, line 1");
    let point = drawn(&window, "A, line 1, point 2");
    double_click(&mut window, point);
    assert!(line(&window).edges[1].smooth);
    double_click(&mut window, point);
    assert!(!line(&window).edges[1].smooth);
    // An end is neither.
    let end = drawn(&window, "A, line 1, point 3");
    double_click(&mut window, end);
    assert_eq!(steps(&window), ["make a point smooth", "make a corner"]);
}

#[test]
fn a_line_gets_a_point_by_a_double_click_and_loses_it_again() {
    let mut window = window_on(with_line());
    press(&mut window, Key::A);
    let middle = drawn(&window, "A, line 1");
    double_click(&mut window, middle);
    assert_eq!(line(&window).edges.len(), 2);
    let point = drawn(&window, "A, line 1, point 2");
    click(&mut window, point);
    press(&mut window, Key::Delete);
    assert_eq!(pattern(&window), with_line());
    assert_eq!(steps(&window), ["add a point", "take a point away"]);
}
