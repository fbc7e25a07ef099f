//! Standing pieces round the body before they are sewn.

use toile::geometry::ids::PieceId;
use toile::session::samples::Sample;

use super::*;

/// The mannequin, and a panel that stands nowhere.
fn with_mannequin() -> Window {
    let mut document = Document::default();
    let corners = [[-0.2, -0.25], [0.2, -0.25], [0.2, 0.25], [-0.2, 0.25]].map(DVec2::from);
    Arc::make_mut(&mut document.pattern).add_piece(Piece::polygon("Panel", &corners));
    window_on(Project { document, dressed: None }, None)
}

fn choose(window: &mut Window, entry: &str) {
    window.get_by_label("Garment").click();
    window.run_steps(3);
    window.get_by_label(entry).click();
    window.run_steps(4);
}

fn placement(window: &Window, piece: u32) -> Option<SpacePose> {
    app(window).session().document().pattern.pieces[&PieceId(piece)].placement
}

fn stand(window: &mut Window, point: &str) {
    window.get_by_label(&format!("Arrangement point: {point}")).click();
    window.run_steps(4);
}

fn select(window: &mut Window) {
    let middle = pane(window, "Pattern pane").center();
    move_to(window, middle);
    button(window, middle, PointerButton::Primary, true, Modifiers::NONE);
    button(window, middle, PointerButton::Primary, false, Modifiers::NONE);
    window.run_steps(3);
}

#[test]
fn a_piece_is_stood_at_a_dot_rolled_and_taken_away() {
    let mut window = with_mannequin();
    assert!(
        window.query_by_label("Arrangement point: waist, front").is_none(),
        "only while pieces are placed"
    );
    key(&mut window, Modifiers::SHIFT, Key::B);
    stand(&mut window, "waist, front");
    assert_eq!(placement(&window, 1), None, "nothing is selected");
    select(&mut window);
    stand(&mut window, "waist, front");
    let flat = placement(&window, 1).expect("it stands");
    assert!(flat.roll.is_none() && flat.translation.z > 0.1);
    assert!((flat.rotation * DVec3::Z).distance(DVec3::Z) < 0.05, "its outer side looks ahead");
    assert_eq!(app(&window).session().undo_label(), Some("place Panel"));
    choose(&mut window, "Roll");
    assert!(placement(&window, 1).expect("it stands").roll.is_some());
    choose(&mut window, "Remove placement");
    assert_eq!(placement(&window, 1), None);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(placement(&window, 1), Some(flat));
    stand(&mut window, "left shin, front");
    let round = placement(&window, 1).expect("it stands");
    assert!(round.roll.is_some() && round.translation.x > 0.0, "wide pieces go round a limb");
}

#[test]
fn a_click_on_the_body_beside_a_dot_means_it() {
    let mut window = with_mannequin();
    key(&mut window, Modifiers::SHIFT, Key::B);
    let at = window.get_by_label("Arrangement point: waist, front").rect().center() + Vec2::new(12.0, 0.0);
    let click = |window: &mut Window, at: Pos2| {
        move_to(window, at);
        button(window, at, PointerButton::Primary, true, Modifiers::NONE);
        button(window, at, PointerButton::Primary, false, Modifiers::NONE);
        window.run_steps(3);
    };
    click(&mut window, at);
    assert_eq!(placement(&window, 1), None, "nothing is selected");
    select(&mut window);
    stand(&mut window, "waist, front");
    let stood = placement(&window, 1);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(placement(&window, 1), None);
    click(&mut window, at);
    assert_eq!((placement(&window, 1), stood.is_some()), (stood, true));
    assert_eq!(app(&window).session().undo_label(), Some("place Panel"));
}

#[test]
fn a_standing_piece_is_dragged_and_esc_puts_it_back() {
    let mut window = with_mannequin();
    key(&mut window, Modifiers::SHIFT, Key::B);
    select(&mut window);
    stand(&mut window, "waist, front");
    let before = placement(&window, 1).expect("it stands");
    let steps = app(&window).session().step_labels().count();
    // Beside its handles.
    let at = window.get_by_label("Arrangement point: waist, front").rect().center() + Vec2::new(18.0, 30.0);
    let path = [at, at + Vec2::new(20.0, 0.0), at + Vec2::new(60.0, 0.0)];
    press_along(&mut window, &path, PointerButton::Primary);
    window.run_steps(2);
    let dragged = placement(&window, 1).expect("it stands");
    assert!(dragged.translation.x > before.translation.x + 0.03, "{dragged:?}");
    assert!((dragged.translation - before.translation).y.abs() < 1e-3);
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(placement(&window, 1), Some(before));
    button(&mut window, path[2], PointerButton::Primary, false, Modifiers::NONE);
    window.run_steps(2);
    assert_eq!(app(&window).session().step_labels().count(), steps);
    drag(&mut window, &path, PointerButton::Primary);
    assert!(placement(&window, 1).expect("it stands").translation.x > before.translation.x + 0.03);
    assert_eq!(app(&window).session().step_labels().count(), steps + 1, "a drag is one step");
}

#[test]
fn pieces_for_another_body_are_brought_to_this_one() {
    let mut project = Sample::Tshirt.project(&toile::body::mannequin::default());
    for piece in Arc::make_mut(&mut project.document.pattern).pieces.values_mut() {
        let piece = Arc::make_mut(piece);
        piece.placement = piece.placement.map(|pose| pose.moved(DQuat::IDENTITY, DVec3::ZERO, -DVec3::Y));
    }
    let mut window = window_on(project, None);
    let tops = |window: &Window| {
        let pattern = Arc::clone(&app(window).session().document().pattern);
        let tops = pattern.pieces.values().filter_map(|p| p.placement).map(|pose| pose.translation.y);
        tops.fold(f64::MIN, f64::max)
    };
    let before = tops(&window);
    choose(&mut window, "Arrange pieces on the body");
    assert!(tops(&window) > before + 0.8);
    assert!(window.query_by_label_contains("Raised by").is_some(), "it is told");
    choose(&mut window, "Arrange pieces on the body");
    assert!(window.query_by_label_contains("stand where they belong").is_some());
}
