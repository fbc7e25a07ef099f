//! Lines drawn on the dressed cloth.

use toile::cloth::FlatPiece;
use toile::geometry::ids::PieceId;
use toile::pattern::{Seam, Stretch};
use toile::session::Command;

use super::hand::{dressed_window, positions};
use super::*;

const SQUARE: PieceId = PieceId(1);
const OTHER: PieceId = PieceId(2);

/// Two halves of a square, sewn together and at rest on the ball.
fn halves() -> Window {
    let mut project = project();
    let pattern = Arc::make_mut(&mut project.document.pattern);
    pattern.pieces.clear();
    for (name, x) in [("Left", -0.2), ("Right", 0.0)] {
        let corners = [[0.0, -0.2], [0.2, -0.2], [0.2, 0.2], [0.0, 0.2]].map(|[u, v]| DVec2::new(u + x, v));
        pattern.pieces.insert(if x < 0.0 { SQUARE } else { OTHER }, Arc::new(Piece::polygon(name, &corners)));
    }
    let sides = [Stretch::edge(SQUARE, 1), Stretch::edge(OTHER, 3)];
    pattern.add_seam(Seam { sides, same_direction: false, ratio: None, zip: None });
    let mut window = window_on(project, None);
    edit(&mut window, |app, _| {
        for (piece, x) in [(SQUARE, -0.1), (OTHER, 0.1)] {
            let points = [-0.06, -0.03, 0.0, 0.03, 0.06].map(|y| DVec2::new(x, y)).to_vec();
            let mark = Command::AddClothMark { piece, side: ClothSide::Front, points };
            app.session_mut().apply_alone(mark).expect("a mark on the cloth");
            let (a, r) = (x / 0.25, 0.25_f64);
            let on_ball = |y: f64| {
                let ring = (r * r - y * y).sqrt();
                DVec3::new(ring * a.sin(), y, ring * a.cos())
            };
            let surface = Arc::clone(app.session().surface().expect("the ball"));
            let on_skin = |y: f64| surface.nearest(on_ball(y)).point;
            let points = [-0.06, -0.03, 0.0, 0.03, 0.06].map(on_skin).to_vec();
            app.session_mut().apply_alone(Command::AddBodyMark { points }).expect("a mark on the body");
        }
    });
    act(&mut window, "Wrap");
    wait(&mut window, "the cloth to rest", |app| {
        let snapshot = app.session().snapshot();
        snapshot.is_dressed() && !snapshot.working
    });
    window
}

/// Where a flat point of a piece is in the body pane.
fn on_screen(window: &Window, piece: PieceId, flat: DVec2) -> Pos2 {
    let snapshot = app(window).session().snapshot();
    let (garment, state) = snapshot.drawn().expect("cloth");
    let place = FlatPiece::new(garment, piece).inside(garment, flat).expect("on the piece");
    let point = place.point(garment, state).expect("on the body").as_vec3();
    let area = pane(window, "Body pane");
    let seen = app(window).camera().project(point, glam::Vec2::new(area.width(), area.height()));
    let pixel = seen.expect("in view").pixel;
    area.min + Vec2::new(pixel.x, pixel.y)
}

fn click(window: &mut Window, at: Pos2) {
    move_to(window, at);
    for pressed in [true, false] {
        button(window, at, PointerButton::Primary, pressed, Modifiers::NONE);
    }
    // The next click is no double click with this one.
    window.run_steps(24);
}

fn click_on(window: &mut Window, piece: PieceId, flat: [f64; 2]) {
    let at = on_screen(window, piece, DVec2::from(flat));
    click(window, at);
}

/// The points of the lines of a piece.
fn lines(window: &Window, piece: PieceId) -> Vec<Vec<DVec2>> {
    let pattern = &app(window).session().document().pattern;
    pattern.pieces[&piece].lines.iter().map(|line| line.points().collect()).collect()
}

fn assert_near(found: &[DVec2], meant: &[[f64; 2]]) {
    assert_eq!(found.len(), meant.len(), "{found:?}");
    for (found, meant) in found.iter().zip(meant) {
        assert!(found.distance(DVec2::from(*meant)) < 1e-3, "{found} instead of {meant:?}");
    }
}

#[test]
fn a_line_clicked_on_the_cloth_is_on_its_piece_and_selected() {
    let mut window = dressed_window();
    let (before, steps) = (positions(&window), app(&window).session().step_labels().count());
    key(&mut window, Modifiers::SHIFT, Key::I);
    let meant = [[-0.05, 0.02], [0.03, 0.04], [0.06, -0.03]];
    for corner in meant {
        click_on(&mut window, SQUARE, corner);
    }
    assert!(window.query_by_label("Corner 3 of the line").is_some());
    assert!(lines(&window, SQUARE).is_empty(), "it is not ended yet");
    key(&mut window, Modifiers::NONE, Key::Enter);
    let drawn = lines(&window, SQUARE);
    assert_eq!(drawn.len(), 1);
    assert_near(&drawn[0], &meant);
    assert_eq!(app(&window).session().step_labels().count(), steps + 1);
    assert_eq!(app(&window).session().undo_label(), Some("draw a line"));
    assert!(window.query_all_by_label("1 line").next().is_some(), "it is selected");
    assert!(window.query_all_by_label("Wrinkle").next().is_some(), "the side panel offers its trims");
    assert_eq!(positions(&window), before, "the cloth stays where it is");
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(lines(&window, SQUARE).is_empty());
}

#[test]
fn a_double_click_ends_the_line_and_backspace_takes_a_corner_back() {
    let mut window = dressed_window();
    key(&mut window, Modifiers::SHIFT, Key::I);
    for corner in [[-0.05, 0.0], [0.0, 0.05]] {
        click_on(&mut window, SQUARE, corner);
    }
    key(&mut window, Modifiers::NONE, Key::Backspace);
    assert!(window.query_by_label("Corner 1 of the line").is_some());
    assert!(window.query_by_label("Corner 2 of the line").is_none());
    let at = on_screen(&window, SQUARE, DVec2::new(0.05, 0.0));
    move_to(&mut window, at);
    for pressed in [true, false, true, false] {
        button(&mut window, at, PointerButton::Primary, pressed, Modifiers::NONE);
    }
    window.run_steps(3);
    let drawn = lines(&window, SQUARE);
    assert_eq!(drawn.len(), 1);
    assert_near(&drawn[0], &[[-0.05, 0.0], [0.05, 0.0]]);
}

#[test]
fn escape_gives_the_line_up_and_enter_draws_none_of_one_corner() {
    let mut window = dressed_window();
    let steps = app(&window).session().step_labels().count();
    key(&mut window, Modifiers::SHIFT, Key::I);
    click_on(&mut window, SQUARE, [-0.05, 0.0]);
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert!(window.query_by_label("It needs 2 points at least.").is_some());
    assert!(window.query_by_label("Corner 1 of the line").is_some(), "it goes on");
    click_on(&mut window, SQUARE, [0.05, 0.0]);
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Corner 1 of the line").is_none());
    assert!(lines(&window, SQUARE).is_empty());
    assert_eq!(app(&window).session().step_labels().count(), steps);
}

#[test]
fn corners_near_an_edge_are_on_it_and_shift_keeps_the_line_straight() {
    let mut window = dressed_window();
    key(&mut window, Modifiers::SHIFT, Key::I);
    click_on(&mut window, SQUARE, [0.05, 0.198]);
    // From there along the grain, though the pointer is beside it.
    let at = on_screen(&window, SQUARE, DVec2::new(0.06, 0.05));
    move_to(&mut window, at);
    window.event(Event::ModifiersChanged(Modifiers::SHIFT));
    for pressed in [true, false] {
        button(&mut window, at, PointerButton::Primary, pressed, Modifiers::SHIFT);
    }
    window.event(Event::ModifiersChanged(Modifiers::NONE));
    window.run_steps(3);
    key(&mut window, Modifiers::NONE, Key::Enter);
    let drawn = lines(&window, SQUARE);
    let [from, to] = drawn[0][..] else { panic!("{drawn:?}") };
    assert!((from.y - 0.2).abs() < 1e-9, "{from}");
    assert!((to.x - from.x).abs() < 1e-9 && (to.y - 0.05).abs() < 1e-3, "{from} {to}");
}

#[test]
fn a_line_ends_at_the_seams_of_its_piece_and_is_not_lost_there() {
    let mut window = halves();
    key(&mut window, Modifiers::SHIFT, Key::I);
    click_on(&mut window, SQUARE, [-0.1, 0.05]);
    click_on(&mut window, OTHER, [0.1, 0.05]);
    let words = "The line is on Left and ends at its seams: this is Right.";
    assert!(window.query_all_by_label(words).next().is_some(), "it is refused in words");
    assert!(window.query_by_label("Corner 1 of the line").is_some(), "the line is still there");
    assert!(window.query_by_label("Corner 2 of the line").is_none());
    click_on(&mut window, SQUARE, [-0.1, -0.05]);
    key(&mut window, Modifiers::NONE, Key::Enter);
    let drawn = lines(&window, SQUARE);
    assert_eq!(drawn.len(), 1);
    assert_near(&drawn[0], &[[-0.1, 0.05], [-0.1, -0.05]]);
    assert!(lines(&window, OTHER).is_empty());
    // The next one may be on the other piece. A click at its last corner ends it.
    for corner in [[0.1, 0.05], [0.1, -0.05], [0.1, -0.05]] {
        click_on(&mut window, OTHER, corner);
    }
    assert_near(&lines(&window, OTHER)[0], &[[0.1, 0.05], [0.1, -0.05]]);
}

#[test]
fn a_line_is_drawn_on_the_cloth_by_keys_alone() {
    let mut window = dressed_window();
    key(&mut window, Modifiers::SHIFT, Key::I);
    for _ in 0..4 {
        if !window.get_by_label("Body pane").accesskit_node().is_focused() {
            key(&mut window, Modifiers::NONE, Key::F6);
        }
    }
    let arrows = |window: &mut Window, arrow: Key, times: usize| {
        (0..times).for_each(|_| key(window, Modifiers::NONE, arrow));
    };
    // The first arrow shows the cross.
    arrows(&mut window, Key::ArrowLeft, 5);
    key(&mut window, Modifiers::NONE, Key::Space);
    arrows(&mut window, Key::ArrowRight, 8);
    key(&mut window, Modifiers::NONE, Key::Space);
    key(&mut window, Modifiers::NONE, Key::Enter);
    let drawn = lines(&window, SQUARE);
    let [from, to] = drawn[0][..] else { panic!("{drawn:?}") };
    assert!(to.x - from.x > 0.02 && (to.y - from.y).abs() < 0.01, "{from} {to}");
}

#[test]
fn without_dressed_cloth_there_is_nothing_to_draw_on() {
    let mut window = window();
    key(&mut window, Modifiers::SHIFT, Key::I);
    act(&mut window, "Garment");
    let mut entries = window.get_all_by_label_contains("Line on the cloth");
    assert!(entries.any(|entry| entry.accesskit_node().is_disabled()), "and the key's message says why");
}
