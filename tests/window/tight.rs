//! Tight places of a garment at rest: told in the panel, shown by a click.

use toile::sim::ClothPlace;

use super::hand::dressed;
use super::*;

/// The first place told of a window with cloth at rest: on so small a ball a square of cloth does not lie smoothly.
fn told() -> (Window, ClothPlace) {
    let mut project = project();
    project.document.body = BodyChoice::Imported { name: "ball".to_owned(), mesh: Arc::new(ball(0.15)) };
    let mut window = dressed(window_on(project, None));
    wait(&mut window, "the look", |app| app.session().snapshot().verdict.is_some());
    window.run_steps(2);
    let tight = app(&window).session().snapshot().tight.clone();
    let place = ClothPlace { piece: tight[0].piece, at: tight[0].flat };
    (window, place)
}

fn click_the_row(window: &mut Window) {
    let tight = app(window).session().snapshot().tight.clone();
    let words = tight[0].tight.to_string();
    window.get_by_label_contains(&words).click();
    window.run_steps(3);
}

#[test]
fn a_click_on_a_tight_place_selects_its_piece_and_turns_the_view_to_it() {
    let (mut window, place) = told();
    assert_eq!(app(&window).spot(), None);
    let before = app(&window).camera();
    click_the_row(&mut window);
    assert_eq!(app(&window).spot(), Some(place));
    assert!(app(&window).camera() != before, "the view came nearer");
    assert!(window.query_by_label("1 piece").is_some(), "its piece is selected");
    let camera = app(&window).camera();
    let tight = app(&window).session().snapshot().tight.clone();
    let pane = pane(&window, "Body pane");
    let size = glam::Vec2::new(pane.width(), pane.height());
    let seen = camera.project(DVec3::from_array(tight[0].tight.at).as_vec3(), size).expect("before the eye");
    assert!(seen.pixel.distance(size / 2.0) < 0.25 * size.y, "{:?} of {size:?}", seen.pixel);
}

#[test]
fn the_ring_goes_with_the_selection_and_when_the_cloth_moves() {
    let (mut window, place) = told();
    click_the_row(&mut window);
    key(&mut window, Modifiers::NONE, Key::V);
    assert_eq!(app(&window).spot(), Some(place));
    key(&mut window, Modifiers::COMMAND, Key::A);
    assert_eq!(app(&window).spot(), None, "something else was selected");
    click_the_row(&mut window);
    key(&mut window, Modifiers::NONE, Key::Space);
    wait(&mut window, "the drape", |app| app.session().snapshot().drape.is_some_and(|d| !d.waits));
    assert_eq!(app(&window).spot(), None, "the cloth lies elsewhere");
    assert!(window.query_by_label_contains("Tight: ").is_none());
}
