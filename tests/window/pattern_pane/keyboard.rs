//! Without a pointer.

use toile::pattern::{Edge, InternalLine};

use super::*;

#[test]
fn two_rectangles_are_drawn_sewn_marked_and_wrapped_by_keys_alone() {
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
    // A stroke down the middle of each piece, from corner to corner; the table's middle is where its axes cross.
    let go = |window: &mut Window, keys: &[(Modifiers, Key)]| {
        keys.iter().for_each(|&(held, arrow)| key(window, held, arrow));
    };
    let [left, right, up, down] =
        [Key::ArrowLeft, Key::ArrowRight, Key::ArrowUp, Key::ArrowDown].map(|key| (Modifiers::SHIFT, key));
    press(&mut window, Key::K);
    let fine_right = [(Modifiers::NONE, Key::ArrowRight); 5];
    for way in [vec![left, left, up, up], [vec![right; 3], fine_right.to_vec(), vec![up]].concat()] {
        go(&mut window, &way);
        press(&mut window, Key::Space);
        go(&mut window, &[down]);
        press(&mut window, Key::Space);
        press(&mut window, Key::Enter);
    }
    let painted = app(&window).session().document().marks.clone();
    let ends: Vec<[DVec2; 2]> = painted
        .cloth
        .iter()
        .map(|mark| {
            let pose = pattern(&window).pieces[&mark.piece].pose;
            [mark.points[0], mark.points[mark.points.len() - 1]].map(|p| pose.plane_from_piece(p))
        })
        .collect();
    let meant = [[-0.2, 0.2, -0.2, 0.1], [0.15, 0.2, 0.15, 0.1]];
    assert_eq!(ends.len(), 2);
    for (ends, [a, b, c, d]) in ends.iter().zip(meant) {
        assert!(ends[0].distance(DVec2::new(a, b)) < 1e-6 && ends[1].distance(DVec2::new(c, d)) < 1e-6);
    }
    // And two down the body, past its middle.
    press(&mut window, Key::F6);
    let arrows = |window: &mut Window, key: Key, times: usize| (0..times).for_each(|_| press(window, key));
    // The first arrow shows the cross.
    arrows(&mut window, Key::ArrowUp, 8);
    for (sideways, times) in [(Key::ArrowLeft, 1), (Key::ArrowRight, 4)] {
        arrows(&mut window, sideways, times);
        press(&mut window, Key::Space);
        arrows(&mut window, Key::ArrowDown, 5);
        press(&mut window, Key::Space);
        press(&mut window, Key::Enter);
        arrows(&mut window, Key::ArrowUp, 5);
    }
    assert_eq!(app(&window).session().document().marks.body.len(), 2);
    press(&mut window, Key::Enter);
    wait(&mut window, "the wrap", |app| app.session().snapshot().is_dressed());
}

#[test]
fn escape_gives_a_stroke_by_keys_up_and_backspace_takes_a_corner_back() {
    let mut window = window_on(squares());
    press(&mut window, Key::K);
    press(&mut window, Key::F6);
    // From the middle between the squares into one.
    key(&mut window, Modifiers::SHIFT, Key::ArrowLeft);
    let painted = |window: &Window| app(window).session().document().marks.cloth.clone();
    let corner = |window: &mut Window| {
        press(window, Key::ArrowLeft);
        press(window, Key::Space);
    };
    (0..2).for_each(|_| corner(&mut window));
    press(&mut window, Key::Escape);
    press(&mut window, Key::Enter);
    assert!(painted(&window).is_empty());
    (0..3).for_each(|_| corner(&mut window));
    press(&mut window, Key::Backspace);
    press(&mut window, Key::Enter);
    let marks = painted(&window);
    let points = &marks[0].points;
    assert!((points[0].distance(points[points.len() - 1]) - 0.01).abs() < 1e-6, "a step of the cursor");
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

/// Whether the pane says to screen readers that `item` was selected.
fn is_told(window: &Window, item: &str) -> bool {
    window.query_by_label(&format!("{item} (selected)")).is_some()
}

#[test]
fn points_edges_lines_and_seams_are_selected_by_keys_alone() {
    let mut drawn = twisted();
    let a = drawn.piece_named("A").expect("a square");
    let edge = Edge { start: DVec2::new(0.05, 0.1), ..Edge::default() };
    let line = InternalLine { edges: vec![edge], end: DVec2::new(0.15, 0.1), ..InternalLine::default() };
    Arc::make_mut(drawn.pieces.get_mut(&a).expect("a square")).lines.push(line);
    let mut window = window_on(drawn);
    press(&mut window, Key::A);
    press(&mut window, Key::F6);
    assert!(window.query_by_label_contains("Tab: next point").is_some(), "the keys are told");
    press(&mut window, Key::Tab);
    assert!(is_told(&window, "A, point 1"));
    press(&mut window, Key::Tab);
    for item in ["A, edge 2: 20 cm", "A, line 1", "Seam: A edge 1 – B edge 1", "A, point 1"] {
        press(&mut window, Key::PageDown);
        assert!(is_told(&window, item), "{item}");
    }
    press(&mut window, Key::PageUp);
    press(&mut window, Key::Tab);
    press(&mut window, Key::Tab);
    assert!(is_told(&window, "Seam: A edge 2 – B edge 4, twisted"));
    press(&mut window, Key::PageUp);
    press(&mut window, Key::PageUp);
    assert!(is_told(&window, "A, edge 1: 20 cm"));
    press(&mut window, Key::Space);
    press(&mut window, Key::Tab);
    press(&mut window, Key::Tab);
    let is_selected = |window: &Window, label: &str| {
        window.get_by_label(label).accesskit_node().toggled() == Some(egui::accesskit::Toggled::True)
    };
    for (edge, selected) in [(1, true), (2, false), (3, true), (4, false)] {
        let label = format!("A, edge {edge}: 20 cm");
        assert_eq!(is_selected(&window, &label), selected, "{label}");
    }
    press(&mut window, Key::ArrowRight);
    assert_eq!(steps(&window).len(), 1, "both edges are moved in one step");
    let moved = pattern(&window);
    let corners = piece(&moved, "A").outline.iter().map(|edge| edge.start.x);
    assert!(corners.zip([0.0, 0.2, 0.2, 0.0]).all(|(x, before)| (x - before - 0.001).abs() < 1e-9));
}
