//! Without a pointer.

use super::*;

#[test]
fn two_rectangles_are_drawn_and_sewn_by_keys_alone() {
    let mut window = window();
    press(&mut window, Key::R);
    press(&mut window, Key::F6);
    for (corner, size) in [("-30,0", "20,30"), ("5,0", "20,30")] {
        for text in [corner, size] {
            type_text(&mut window, text);
            press(&mut window, Key::Enter);
        }
    }
    let drawn = pattern(&window);
    assert_eq!(drawn.pieces.len(), 2);
    let [lower, upper] = bounds(piece(&drawn, "Piece 2"));
    assert!(
        (lower - DVec2::new(0.05, 0.0)).length() < 1e-9 && (upper - DVec2::new(0.25, 0.3)).length() < 1e-9
    );
    press(&mut window, Key::S);
    // The second edge of the first piece, and the fourth of the second.
    press(&mut window, Key::Escape);
    press(&mut window, Key::Tab);
    press(&mut window, Key::Tab);
    press(&mut window, Key::Enter);
    for _ in 0..6 {
        press(&mut window, Key::Tab);
    }
    press(&mut window, Key::Enter);
    let sewn = pattern(&window);
    let seam = sewn.seams.values().next().expect("a seam");
    assert_eq!(seam.sides.map(|side| side.edge), [1, 3]);
}

#[test]
fn arrows_move_a_cursor_that_space_draws_with() {
    let mut window = window();
    press(&mut window, Key::B);
    press(&mut window, Key::F6);
    for (arrow, times) in
        [(Key::ArrowRight, 1), (Key::ArrowRight, 10), (Key::ArrowUp, 5), (Key::ArrowLeft, 4)]
    {
        for _ in 0..times {
            press(&mut window, arrow);
        }
        press(&mut window, Key::Space);
    }
    press(&mut window, Key::Enter);
    let drawn = pattern(&window);
    let [lower, upper] = bounds(piece(&drawn, "Piece 1"));
    assert!((upper - lower - DVec2::new(0.1, 0.05)).length() < 1e-9, "{}", upper - lower);
    assert_eq!(piece(&drawn, "Piece 1").outline.len(), 4);
}

#[test]
fn arrows_nudge_what_tab_selects() {
    let mut window = window_on(squares());
    press(&mut window, Key::V);
    press(&mut window, Key::F6);
    press(&mut window, Key::Tab);
    press(&mut window, Key::ArrowLeft);
    key(&mut window, Modifiers::SHIFT, Key::ArrowDown);
    let offset = piece(&pattern(&window), "A").pose.offset;
    assert!((offset - DVec2::new(-0.001, -0.01)).length() < 1e-12, "{offset}");
    assert_eq!(piece(&pattern(&window), "B").pose.offset, DVec2::ZERO);
}

#[test]
fn points_are_typed_absolute_and_relative() {
    let mut window = window();
    press(&mut window, Key::B);
    press(&mut window, Key::F6);
    for text in ["0,0", "@20,0", "20,10", "10<180"] {
        type_text(&mut window, text);
        press(&mut window, Key::Enter);
    }
    press(&mut window, Key::Enter);
    let drawn = pattern(&window);
    let piece = piece(&drawn, "Piece 1");
    assert_eq!(piece.outline.len(), 4);
    assert!((piece.signed_area() - 0.015).abs() < 1e-9, "{}", piece.signed_area());
}

#[test]
fn what_is_no_number_is_told_and_stays_to_be_mended() {
    let mut window = window();
    press(&mut window, Key::B);
    press(&mut window, Key::F6);
    type_text(&mut window, "1,abc");
    press(&mut window, Key::Enter);
    assert!(window.query_by_label_contains("is not understood").is_some());
    press(&mut window, Key::Escape);
    assert!(window.query_by_label_contains("is not understood").is_none());
}
