//! Dressed cloth and menus for the tests; dragging and pinning dressed cloth with the mouse.

use super::*;

/// A window with cloth at rest on the body.
pub fn dressed_window() -> Window {
    dressed(window())
}

/// `window` with its cloth at rest on its body.
pub fn dressed(mut window: Window) -> Window {
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

/// Whether the desktop may have file dialogs of its own, which no test can answer; it is then told that the test is skipped.
pub fn has_file_dialogs() -> bool {
    let has = std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some();
    if has {
        println!("skipped: this desktop may have a dialog of its own");
    }
    has
}

/// Chooses the entry of `menu` whose label contains `entry`; a menu higher than the window is scrolled to it.
pub fn choose(window: &mut Window, menu: &str, entry: &str) {
    act(window, menu);
    window.get_by_label_contains(entry).scroll_to_me();
    window.run_steps(3);
    window.get_by_label_contains(entry).click();
    window.run_steps(4);
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

#[test]
fn an_edge_under_the_pointer_is_told_and_shown_in_both_panes() {
    let mut window = dressed_window();
    let area = pane(&window, "Body pane");
    let told = |window: &Window| window.query_by_label_contains("Square, edge 2: 40 cm ·").is_some();
    let shown = |window: &Window| app(window).highlight();
    move_to(&mut window, area.left_top() + Vec2::splat(40.0));
    window.run_steps(2);
    assert_eq!(shown(&window), None);
    assert!(!told(&window));
    // From the middle of the cloth to the right: it ends at the second edge of the square.
    let mut x = 0.0;
    while !told(&window) && x < area.width() / 2.0 {
        x += 2.0;
        move_to(&mut window, area.center() + Vec2::X * x);
        window.run_steps(1);
    }
    let edge = shown(&window).expect("an edge of the cloth");
    assert!(told(&window), "{edge:?} is told");
    // The same edge on the table, and its line on the cloth.
    key(&mut window, Modifiers::NONE, Key::A);
    let table = pane(&window, "Pattern pane");
    move_to(&mut window, table.center());
    window.run_steps(2);
    assert_ne!(shown(&window), Some(edge));
    let mut x = 0.0;
    while shown(&window) != Some(edge) && x < table.width() / 2.0 {
        x += 2.0;
        move_to(&mut window, table.center() + Vec2::X * x);
        window.run_steps(1);
    }
    assert_eq!(shown(&window), Some(edge));
}

#[test]
fn pins_are_selected_locked_moved_and_pulled_out_together() {
    let mut window = dressed_window();
    key(&mut window, Modifiers::NONE, Key::P);
    let middle = pane(&window, "Body pane").center();
    for x in [-60.0, 0.0, 60.0] {
        drag(&mut window, &[middle + Vec2::X * x], PointerButton::Primary);
    }
    let ids = |window: &Window| -> Vec<u32> {
        app(window).session().document().pins.iter().map(|pin| pin.id.0).collect()
    };
    assert_eq!(ids(&window), [1, 2, 3]);
    wait(&mut window, "the pins", |app| app.session().snapshot().pinned.iter().flatten().count() == 3);
    window.run_steps(3);
    for pin in 1..=3 {
        let label = format!("Pin {pin}");
        let node = window.get_by_label(&label).rect().center();
        assert!(node.distance(middle + Vec2::X * [-60.0, 0.0, 60.0][pin - 1]) < 14.0, "{label} at {node}");
    }

    // From the list, and by Shift and a click on a pin.
    window.get_by_label("Select Pin 1").click();
    window.run_steps(3);
    let at = window.get_by_label("Pin 3").rect().center();
    move_to(&mut window, at);
    window.event(Event::ModifiersChanged(Modifiers::SHIFT));
    button(&mut window, at, PointerButton::Primary, true, Modifiers::SHIFT);
    button(&mut window, at, PointerButton::Primary, false, Modifiers::SHIFT);
    window.event(Event::ModifiersChanged(Modifiers::NONE));
    window.run_steps(3);
    key(&mut window, Modifiers::COMMAND, Key::L);
    let locked = |window: &Window| -> Vec<bool> {
        app(window).session().document().pins.iter().map(|pin| pin.locked).collect()
    };
    assert_eq!(locked(&window), [true, false, true]);
    window.get_by_label("Pin 3, locked");
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(ids(&window).len(), 3, "locked ones stay");
    key(&mut window, Modifiers::COMMAND, Key::L);
    assert_eq!(locked(&window), [false; 3]);
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(ids(&window), [2]);

    // By hand to another place of the cloth, in one step.
    let from = window.get_by_label("Pin 2").rect().center();
    let before = app(&window).session().document().pins[0].place.at;
    drag(&mut window, &[from, from + Vec2::Y * 12.0, from + Vec2::Y * 30.0], PointerButton::Primary);
    assert_eq!(ids(&window), [2]);
    let after = app(&window).session().document().pins[0].place.at;
    assert!(after.y < before.y - 0.005, "from {before} to {after}");
    assert_eq!(app(&window).session().undo_label(), Some("move a pin"));
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(app(&window).session().document().pins[0].place.at, before);
}

#[test]
fn bones_are_drawn_through_the_body_and_taken_away() {
    let mut window = window();
    let choose = |window: &mut Window, entry: &str| {
        choose(window, "Garment", "Bones");
        window.get_by_label(entry).click();
        window.run_steps(4);
    };
    choose(&mut window, "Draw bones");
    let bones = |window: &Window| app(window).session().document().bones.clone();
    let middle = pane(&window, "Body pane").center();
    let path = line(pane(&window, "Body pane"), Vec2::new(50.0, 0.0));
    drag(&mut window, &path, PointerButton::Primary);
    let drawn = bones(&window).expect("a bone");
    let [a, b] = drawn[0];
    assert!(a.z.abs() < 0.03 && b.z.abs() < 0.03, "it lies in the middle of the ball: {a}, {b}");
    assert!((b.x - a.x).abs() > 0.03);
    move_to(&mut window, middle + Vec2::X * 25.0);
    window.event(Event::ModifiersChanged(Modifiers::COMMAND));
    button(&mut window, middle + Vec2::X * 25.0, PointerButton::Primary, true, Modifiers::COMMAND);
    button(&mut window, middle + Vec2::X * 25.0, PointerButton::Primary, false, Modifiers::COMMAND);
    window.run_steps(2);
    assert_eq!(bones(&window).map(|bones| bones.len()), Some(0));
    choose(&mut window, "The body's own bones");
    assert_eq!(bones(&window), None);
}
