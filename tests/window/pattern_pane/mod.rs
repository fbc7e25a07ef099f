//! The pattern pane without a window: pieces are drawn, edited and sewn by pointer and by keys.

use std::sync::Arc;
use std::time::Duration;

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use glam::DVec2;
use toile::pattern::{Pattern, Piece, Seam, Stretch};
use toile::session::{Document, Project};

use crate::{Window, app, key, move_to, wait};

mod details;
mod graphics;
mod keyboard;
mod sizes;

/// The window on an empty table, 1 m seen from side to side.
fn window() -> Window {
    window_on(Pattern::default())
}

fn window_on(pattern: Pattern) -> Window {
    let document = Document { pattern: Arc::new(pattern), ..Document::default() };
    crate::window_on(Project { document, dressed: None }, None)
}

/// Two squares, 20 cm wide, 30 cm apart.
fn squares() -> Pattern {
    let mut pattern = Pattern::default();
    for (name, x) in [("A", 0.0), ("B", 0.3)] {
        let corners = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.0, 0.2]].map(|[u, v]| DVec2::new(u + x, v));
        pattern.add_piece(Piece::polygon(name, &corners));
    }
    pattern
}

/// The squares, their near edges sewn so that they are twisted.
fn twisted() -> Pattern {
    let mut pattern = squares();
    let [a, b] = [0, 1].map(|i| *pattern.pieces.keys().nth(i).expect("a square"));
    for (edges, same_direction) in [([0, 0], false), ([2, 2], false), ([1, 3], true)] {
        let sides = [Stretch::edge(a, edges[0]), Stretch::edge(b, edges[1])];
        pattern.add_seam(Seam { sides, same_direction, ratio: None, zip: None });
    }
    pattern
}

fn pattern(window: &Window) -> Pattern {
    Pattern::clone(&app(window).session().document().pattern)
}

fn steps(window: &Window) -> Vec<String> {
    app(window).session().step_labels().map(|label| label.to_string()).collect()
}

fn piece<'a>(pattern: &'a Pattern, name: &str) -> &'a Piece {
    &pattern.pieces[&pattern.piece_named(name).expect("a piece of that name")]
}

/// Lower and upper corner on the table.
fn bounds(piece: &Piece) -> [DVec2; 2] {
    let points = piece.flattened(1e-4).into_iter().map(|p| piece.pose.plane_from_piece(p));
    points.map(|p| [p, p]).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]).expect("points")
}

/// From the middle of the pane.
fn at(window: &Window, x: f32, y: f32) -> Pos2 {
    window.get_by_label("Pattern pane").rect().center() + Vec2::new(x, y)
}

/// Where the item of this name is shown; it may be announced as selected, too.
fn place(window: &Window, label: &str) -> Pos2 {
    let is_item = |node: &egui_kittest::Node<'_>| {
        node.accesskit_node().label().is_none_or(|label| !label.ends_with("(selected)"))
    };
    let mut items = window.get_all_by_label_contains(label).filter(is_item);
    items.next().expect("an item of this name").rect().center()
}

fn button(window: &mut Window, at: Pos2, pressed: bool, modifiers: Modifiers) {
    crate::button(window, at, PointerButton::Primary, pressed, modifiers);
}

fn click_with(window: &mut Window, at: Pos2, modifiers: Modifiers) {
    move_to(window, at);
    window.event(Event::ModifiersChanged(modifiers));
    button(window, at, true, modifiers);
    button(window, at, false, modifiers);
    window.event(Event::ModifiersChanged(Modifiers::NONE));
    // Two clicks in one place are not one double click.
    std::thread::sleep(Duration::from_millis(2));
    window.run_steps(24);
}

fn click(window: &mut Window, at: Pos2) {
    click_with(window, at, Modifiers::NONE);
}

fn press_along(window: &mut Window, from: Pos2, to: Pos2) {
    move_to(window, from);
    button(window, from, true, Modifiers::NONE);
    for i in 1..=8 {
        move_to(window, from.lerp(to, i as f32 / 8.0));
    }
}

fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    press_along(window, from, to);
    button(window, to, false, Modifiers::NONE);
    window.run_steps(3);
}

fn press(window: &mut Window, k: Key) {
    key(window, Modifiers::NONE, k);
}

/// Types into whatever has the keyboard.
fn type_text(window: &mut Window, text: &str) {
    for letter in text.chars() {
        window.event(Event::Text(letter.to_string()));
        window.run_steps(2);
    }
}

#[test]
fn a_rectangle_is_dragged_and_undone() {
    let mut window = window();
    press(&mut window, Key::R);
    let (from, to) = (at(&window, -100.0, 80.0), at(&window, 60.0, -40.0));
    drag(&mut window, from, to);
    let drawn = pattern(&window);
    assert_eq!(drawn.pieces.len(), 1);
    let [lower, upper] = bounds(piece(&drawn, "Piece 1"));
    assert!(upper.x - lower.x > 0.1 && upper.y - lower.y > 0.1, "{lower} {upper}");
    assert!(((lower.x / 0.01).round() * 0.01 - lower.x).abs() < 1e-9, "on the grid: {lower}");
    assert_eq!(steps(&window).len(), 1);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(pattern(&window).pieces.is_empty());
}

#[test]
fn sizes_are_typed_with_units_and_arithmetic() {
    let mut window = window();
    press(&mut window, Key::R);
    let from = at(&window, -50.0, 50.0);
    click(&mut window, from);
    type_text(&mut window, "12.5cm+1/2in, 2*10");
    assert!(pattern(&window).pieces.is_empty(), "not before Enter");
    press(&mut window, Key::Enter);
    let drawn = pattern(&window);
    let [lower, upper] = bounds(piece(&drawn, "Piece 1"));
    assert!((upper - lower - DVec2::new(0.1377, 0.2)).length() < 1e-9, "{}", upper - lower);
}

#[test]
fn the_pen_draws_corners_and_curves_and_takes_points_back() {
    let mut window = window();
    press(&mut window, Key::B);
    for (x, y) in [(-100.0, 60.0), (40.0, 60.0), (80.0, 80.0)] {
        let at = at(&window, x, y);
        click(&mut window, at);
    }
    press(&mut window, Key::Backspace);
    let (from, to) = (at(&window, 40.0, -60.0), at(&window, 0.0, -100.0));
    drag(&mut window, from, to);
    let first = at(&window, -100.0, 60.0);
    click(&mut window, first);
    let drawn = pattern(&window);
    let outline = &piece(&drawn, "Piece 1").outline;
    assert_eq!(outline.len(), 3);
    assert_eq!(outline.iter().filter(|edge| edge.smooth).count(), 1);
    press(&mut window, Key::B);
    let there = at(&window, 100.0, 100.0);
    click(&mut window, there);
    press(&mut window, Key::Escape);
    press(&mut window, Key::Enter);
    assert_eq!(pattern(&window).pieces.len(), 1, "Esc gives up");
}

#[test]
fn pieces_are_moved_scaled_and_turned_by_numbers() {
    let mut window = window_on(squares());
    press(&mut window, Key::V);
    let middle = place(&window, "Piece A");
    click(&mut window, middle);
    for (label, text) in [("Width", "25"), ("x", "3 1/2 in"), ("Angle", "90")] {
        let field = window.get_by_role_and_label(egui::accesskit::Role::TextInput, label);
        field.focus();
        window.run_steps(2);
        key(&mut window, Modifiers::COMMAND, Key::A);
        type_text(&mut window, text);
        press(&mut window, Key::Enter);
    }
    let drawn = pattern(&window);
    let [lower, upper] = bounds(piece(&drawn, "A"));
    assert!((upper - lower - DVec2::new(0.2, 0.25)).length() < 1e-9, "{}", upper - lower);
    // Turned about its middle.
    assert!(((lower + upper).x / 2.0 - (0.0889 + 0.125)).abs() < 1e-9, "{lower} {upper}");
    assert_eq!(steps(&window).len(), 3);
}

#[test]
fn a_drag_is_one_step_and_escape_puts_it_back() {
    let mut window = window_on(squares());
    press(&mut window, Key::V);
    let from = place(&window, "Piece A");
    press_along(&mut window, from, from + Vec2::new(30.0, 60.0));
    assert!(bounds(piece(&pattern(&window), "A"))[0].y < -0.01, "it follows the hand");
    press(&mut window, Key::Escape);
    button(&mut window, from, false, Modifiers::NONE);
    assert_eq!(pattern(&window), squares());
    drag(&mut window, from, from + Vec2::new(30.0, 60.0));
    assert_eq!(steps(&window).len(), 1);
}

#[test]
fn a_point_is_dragged_inserted_and_deleted() {
    let mut window = window_on(squares());
    press(&mut window, Key::A);
    let corner = place(&window, "A, point 1");
    drag(&mut window, corner, corner + Vec2::new(-20.0, 20.0));
    let moved = pattern(&window);
    assert!(piece(&moved, "A").outline[0].start.x < -0.01);
    assert_eq!(piece(&moved, "A").outline[2].start, DVec2::new(0.2, 0.2), "the others stay");
    let edge = place(&window, "A, edge 2");
    for _ in 0..2 {
        button(&mut window, edge, true, Modifiers::NONE);
        button(&mut window, edge, false, Modifiers::NONE);
    }
    window.run_steps(3);
    assert_eq!(piece(&pattern(&window), "A").outline.len(), 5);
    let point = place(&window, "A, point 3");
    std::thread::sleep(Duration::from_millis(2));
    window.run_steps(30);
    click(&mut window, point);
    press(&mut window, Key::Delete);
    assert_eq!(piece(&pattern(&window), "A").outline.len(), 4);
}

#[test]
fn two_edges_are_sewn_untwisted_and_turned_round_by_a_click() {
    let mut window = window_on(squares());
    press(&mut window, Key::S);
    for label in ["A, edge 2", "B, edge 4"] {
        let edge = place(&window, label);
        click(&mut window, edge);
    }
    let sewn = pattern(&window);
    let seam = *sewn.seams.values().next().expect("a seam");
    assert_eq!((seam.same_direction, seam.ratio), (false, Some(1.0)));
    assert!(window.query_by_label_contains("Difference 0.0 mm").is_some(), "the new seam is selected");
    let badge = place(&window, "Seam: A edge 2 – B edge 4");
    click(&mut window, badge);
    assert!(pattern(&window).seams.values().next().expect("a seam").same_direction);
}

#[test]
fn one_edge_is_sewn_to_several() {
    let mut window = window_on(squares());
    press(&mut window, Key::S);
    let [first, second] = ["A, edge 2", "A, edge 3"].map(|label| place(&window, label));
    click_with(&mut window, first, Modifiers::SHIFT);
    click_with(&mut window, second, Modifiers::SHIFT);
    let other = place(&window, "B, edge 4");
    click(&mut window, other);
    let sewn = pattern(&window);
    let mut halves: Vec<(f64, f64)> = sewn.seams.values().map(|s| (s.sides[1].from, s.sides[1].to)).collect();
    halves.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(halves, [(0.0, 0.5), (0.5, 1.0)]);
    assert_eq!(steps(&window).len(), 1);
}

#[test]
fn twisted_seams_are_told_and_mended_by_one_key() {
    let mut window = window_on(twisted());
    assert!(window.query_by_label_contains(", twisted").is_some());
    let at = at(&window, 0.0, 100.0);
    move_to(&mut window, at);
    press(&mut window, Key::U);
    assert!(window.query_by_label_contains(", twisted").is_none());
    assert!(pattern(&window).seams.values().all(|seam| !seam.same_direction));
}

#[test]
fn a_box_selects_what_it_touches_and_delete_takes_it_away() {
    let mut window = window_on(squares());
    press(&mut window, Key::V);
    let (from, to) = (place(&window, "Piece A") + Vec2::new(-88.0, -88.0), place(&window, "Piece A"));
    drag(&mut window, from, to);
    press(&mut window, Key::Delete);
    assert_eq!(pattern(&window).pieces.values().map(|p| p.name.clone()).collect::<Vec<_>>(), ["B"]);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    key(&mut window, Modifiers::COMMAND, Key::A);
    press(&mut window, Key::Delete);
    assert!(pattern(&window).pieces.is_empty());
}

#[test]
fn locked_pieces_stay_and_hidden_ones_are_not_there() {
    let mut window = window_on(squares());
    press(&mut window, Key::V);
    window.get_by_label("Lock A").click();
    window.run_steps(3);
    assert_eq!(steps(&window), ["lock A"]);
    let from = place(&window, "Piece A");
    drag(&mut window, from, from + Vec2::new(40.0, 40.0));
    assert_eq!(piece(&pattern(&window), "A").pose, Default::default());
    window.get_by_label("Show B").click();
    window.run_steps(3);
    assert!(window.query_by_label("Piece B").is_none());
    assert!(window.query_by_label("Select B").is_some(), "it is in the list");
}

#[test]
fn rows_of_lists_are_told_in_full_where_they_are_cut_off() {
    let long = "a piece whose name is far too long for the list of pieces ".repeat(3) + "of a garment";
    let mut pattern = squares();
    let corners = [[0.0, 0.3], [0.2, 0.3], [0.2, 0.5]].map(DVec2::from);
    pattern.add_piece(Piece::polygon(&long, &corners));
    let mut window = window_on(pattern);
    let mut tips = |row: &str, whole: &str| {
        window.get_by_label(row).scroll_to_me();
        window.run_steps(40);
        let before = window.query_all_by_label(whole).count();
        window.get_by_label(row).hover();
        window.run_steps(40);
        window.query_all_by_label(whole).count() - before
    };
    assert_eq!(tips("Select B", "B"), 0, "it can be read in its row");
    assert_eq!(tips(&format!("Select {long}"), &long), 1);
}

#[test]
fn twins_follow_each_other_until_they_are_unlinked() {
    let mut window = window_on(squares());
    press(&mut window, Key::V);
    let middle = place(&window, "Piece A");
    click(&mut window, middle);
    key(&mut window, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::D);
    let drawn = pattern(&window);
    assert_eq!(drawn.pieces.len(), 3);
    assert_eq!(drawn.pieces.values().filter(|p| p.twin.is_some()).count(), 2);
    window.get_by_label("Unlink").click();
    window.run_steps(3);
    assert!(pattern(&window).pieces.values().all(|p| p.twin.is_none()));
}

#[test]
fn darts_notches_lines_and_cuts_are_made_by_their_tools() {
    let mut window = window_on(squares());
    press(&mut window, Key::J);
    let top = place(&window, "A, edge 3");
    click(&mut window, top);
    assert_eq!(piece(&pattern(&window), "A").notches.len(), 1);
    press(&mut window, Key::G);
    let middle = place(&window, "Piece A");
    click(&mut window, middle + Vec2::new(20.0, 30.0));
    assert!(piece(&pattern(&window), "A").grainline.is_some());
    press(&mut window, Key::I);
    for by in [Vec2::new(-20.0, 0.0), Vec2::new(10.0, 12.0)] {
        click(&mut window, middle + by);
    }
    press(&mut window, Key::Enter);
    assert_eq!(piece(&pattern(&window), "A").lines.len(), 1);
    press(&mut window, Key::T);
    let bottom = place(&window, "A, edge 1");
    drag(&mut window, bottom, bottom - Vec2::new(0.0, 30.0));
    let darted = pattern(&window);
    assert!(piece(&darted, "A").outline.len() > 4 && darted.seams.len() == 1, "its legs are sewn");
    press(&mut window, Key::C);
    for label in ["B, edge 4", "B, edge 2"] {
        let end = place(&window, label);
        click(&mut window, end);
    }
    press(&mut window, Key::Enter);
    let cut = pattern(&window);
    assert_eq!((cut.pieces.len(), cut.seams.len()), (3, 2));
}

#[test]
fn every_tool_says_what_the_mouse_does() {
    let mut window = window_on(squares());
    let over = at(&window, 0.0, 120.0);
    move_to(&mut window, over);
    let tools = [
        "Move",
        "Edit points",
        "Pen",
        "Rectangle",
        "Ellipse",
        "Sew",
        "Line",
        "Hole",
        "Cut",
        "Dart",
        "Notch",
        "Grainline",
    ];
    let mut hints: Vec<String> = Vec::new();
    for tool in tools {
        window.get_by_label(tool).click();
        window.run_steps(3);
        move_to(&mut window, over);
        window.run_steps(1);
        let hint = window.get_by_label_contains("F: show all");
        hints.extend(hint.accesskit_node().value().or(hint.accesskit_node().label()));
    }
    assert_eq!(hints.len(), tools.len());
    hints.sort();
    hints.dedup();
    assert_eq!(hints.len(), tools.len(), "each its own");
}

/// Marks both pieces and the body, and wraps.
fn mark_and_wrap(window: &mut Window) {
    press(window, Key::K);
    for name in ["Piece Piece 1", "Piece Piece 2"] {
        let middle = place(window, name);
        drag(window, middle - Vec2::new(0.0, 20.0), middle + Vec2::new(0.0, 20.0));
    }
    let body = window.get_by_label("Body pane").rect().center();
    for x in [-8.0, 22.0] {
        drag(window, body + Vec2::new(x, -60.0), body + Vec2::new(x, -20.0));
    }
    window.get_by_label("Wrap").click();
    window.run_steps(2);
    wait(window, "the wrap", |app| app.session().snapshot().is_dressed());
}

#[test]
fn two_rectangles_are_drawn_sewn_marked_and_wrapped() {
    let mut window = window();
    press(&mut window, Key::R);
    for x in [-120.0, 20.0] {
        let (from, to) = (at(&window, x, 60.0), at(&window, x + 90.0, -60.0));
        drag(&mut window, from, to);
        press(&mut window, Key::R);
    }
    press(&mut window, Key::S);
    for label in ["Piece 1, edge 2", "Piece 2, edge 4"] {
        let edge = place(&window, label);
        click(&mut window, edge);
    }
    assert_eq!(pattern(&window).seams.len(), 1);
    mark_and_wrap(&mut window);
}
