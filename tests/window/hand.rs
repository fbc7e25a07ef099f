//! Dragging and pinning dressed cloth with the mouse.

use super::*;

/// A window with cloth at rest on the body.
pub fn dressed_window() -> Window {
    let mut window = window();
    paint_both(&mut window);
    window.get_by_label("Wrap").click();
    window.run_steps(2);
    let at_rest = |app: &App| {
        let snapshot = app.session().snapshot();
        snapshot.is_dressed() && !snapshot.working
    };
    wait(&mut window, "the cloth to rest", at_rest);
    window
}

pub fn positions(window: &Window) -> Vec<DVec3> {
    app(window).session().snapshot().cloth.positions.clone()
}

#[test]
fn either_button_drags_cloth_with_the_drag_tool() {
    for with in [PointerButton::Primary, PointerButton::Secondary] {
        let mut window = dressed_window();
        let (before, steps) = (positions(&window), app(&window).session().step_labels().count());
        key(&mut window, Modifiers::NONE, Key::D);
        let area = pane(&window, "Body pane");
        drag(&mut window, &line(area, Vec2::new(40.0, 0.0)), with);
        wait(&mut window, "the cloth to settle", |app| {
            let snapshot = app.session().snapshot();
            snapshot.seq >= app.session().last_seq() && snapshot.dragged.is_none() && !snapshot.working
        });
        assert_eq!(app(&window).session().step_labels().count(), steps + 1);
        assert_eq!(app(&window).session().undo_label(), Some("drag the cloth"));
        assert!(positions(&window) != before, "the cloth did not move");
        key(&mut window, Modifiers::COMMAND, Key::Z);
        wait(&mut window, "the undo", |app| app.session().snapshot().cloth.positions == before);
    }
}

#[test]
fn escape_puts_dragged_cloth_back() {
    let mut window = dressed_window();
    let before = positions(&window);
    key(&mut window, Modifiers::NONE, Key::D);
    let area = pane(&window, "Body pane");
    press_along(&mut window, &line(area, Vec2::new(40.0, 0.0)), PointerButton::Primary);
    wait(&mut window, "the drag", |app| app.session().snapshot().dragged.is_some());
    key(&mut window, Modifiers::NONE, Key::Escape);
    wait(&mut window, "the cloth back", |app| {
        let snapshot = app.session().snapshot();
        snapshot.dragged.is_none() && snapshot.cloth.positions == before
    });
}

#[test]
fn a_click_pins_and_a_click_on_the_pin_pulls_it_out() {
    let mut window = dressed_window();
    key(&mut window, Modifiers::NONE, Key::P);
    let middle = pane(&window, "Body pane").center();
    let pins = |window: &Window| app(window).session().document().pins.len();
    drag(&mut window, &[middle], PointerButton::Primary);
    assert_eq!(pins(&window), 1);
    wait(&mut window, "the pin", |app| app.session().snapshot().pinned.len() == 1);
    drag(&mut window, &[middle], PointerButton::Primary);
    assert_eq!(pins(&window), 0);
    let area = pane(&window, "Body pane");
    drag(&mut window, &line(area, Vec2::new(60.0, 0.0)), PointerButton::Primary);
    assert!(pins(&window) > 2, "a row of {}", pins(&window));
    assert_eq!(app(&window).session().undo_label(), Some("pin"));
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(pins(&window), 0, "a row is one step");
}

/// A press and a release at each of `places`, all in one frame.
fn clicks_in_one_frame(window: &mut Window, places: &[Pos2]) {
    for &pos in places {
        window.event(Event::PointerMoved(pos));
        for pressed in [true, false] {
            let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
            window.event(Event::PointerButton { pos, button, pressed, modifiers });
        }
    }
    window.run_steps(3);
}

#[test]
fn two_clicks_in_one_slow_frame_leave_two_pins() {
    let mut window = dressed_window();
    key(&mut window, Modifiers::NONE, Key::P);
    let middle = pane(&window, "Body pane").center();
    clicks_in_one_frame(&mut window, &[middle - Vec2::X * 30.0, middle + Vec2::X * 30.0]);
    assert_eq!(app(&window).session().document().pins.len(), 2);
}

#[test]
fn pins_of_before_a_wrap_are_not_taken_for_the_new_ones() {
    let mut window = dressed_window();
    key(&mut window, Modifiers::NONE, Key::P);
    let middle = pane(&window, "Body pane").center();
    let [left, right] = [-30.0, 30.0].map(|x| middle + Vec2::X * x);
    drag(&mut window, &[left], PointerButton::Primary);
    wait(&mut window, "the pin", |app| app.session().snapshot().pinned.len() == 1);
    drag(&mut window, &[right], PointerButton::Primary);
    // Whether or not the simulation has told of it yet, this is the second pin and not the first.
    drag(&mut window, &[right], PointerButton::Primary);
    let pins = &app(&window).session().document().pins;
    assert_eq!(pins.iter().map(|pin| pin.id.0).collect::<Vec<_>>(), [1]);
}

#[test]
fn what_a_pin_holds_back_is_shown_before_the_drag() {
    let mut window = dressed_window();
    let middle = pane(&window, "Body pane").center();
    key(&mut window, Modifiers::NONE, Key::D);
    move_to(&mut window, middle);
    assert!(app(&window).reach().is_none(), "nothing holds it back");
    key(&mut window, Modifiers::NONE, Key::P);
    drag(&mut window, &[middle - Vec2::X * 30.0], PointerButton::Primary);
    wait(&mut window, "the pin", |app| app.session().snapshot().pinned.len() == 1);
    key(&mut window, Modifiers::NONE, Key::D);
    move_to(&mut window, middle + Vec2::X * 30.0);
    let shares = app(&window).reach().expect("pins hold").to_vec();
    let pin = app(&window).session().snapshot().pinned[0].expect("on the cloth") as usize;
    assert_eq!(shares[pin], 0.0);
    assert!(shares.iter().any(|&share| share > 0.9));
}
