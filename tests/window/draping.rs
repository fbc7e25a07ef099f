//! Draping dressed cloth in the window.

use toile::pattern::activity::Activity;
use toile::session::Motif;

use super::hand::{dressed_window, positions};
use super::*;

fn drape(window: &Window) -> Option<toile::sim::DrapeState> {
    app(window).session().snapshot().drape
}

#[test]
fn the_status_bar_says_what_can_be_done_with_dressed_cloth() {
    let mut window = window();
    let corner = Pos2::new(2.0, 718.0);
    move_to(&mut window, corner);
    assert!(window.query_by_label_contains("then press Wrap").is_some());
    let mut window = super::hand::dressed(window);
    move_to(&mut window, corner);
    window.run_steps(3);
    assert!(window.query_by_label_contains("then press Wrap").is_none());
    assert!(
        window
            .query_by_label_contains(
                "D: drag the cloth · P: pin it · Space: drape it · View › Map: read its fit"
            )
            .is_some()
    );
    key(&mut window, Modifiers::NONE, Key::V);
    let middle = pane(&window, "Body pane").center();
    move_to(&mut window, middle);
    window.run_steps(2);
    assert!(window.query_by_label_contains("D: drag the cloth · P: pin it · Space: drape it").is_some());
}

#[test]
fn the_button_drapes_and_space_pauses() {
    let mut window = dressed_window();
    let (before, steps) = (positions(&window), app(&window).session().step_labels().count());
    window.get_by_label("Drape").click();
    window.run_steps(2);
    let moves = |app: &App| app.session().snapshot().drape.is_some_and(|d| d.ticks > 0 && !d.waits);
    wait(&mut window, "the drape", moves);
    assert!(window.query_by_label_contains("out of balance").is_some());
    key(&mut window, Modifiers::NONE, Key::Space);
    wait(&mut window, "the pause", |app| app.session().snapshot().drape.is_some_and(|d| !d.on));
    window.run_steps(2);
    assert!(window.query_by_label("Draping paused").is_some());
    assert!(positions(&window) != before, "the cloth did not move");
    assert_eq!(app(&window).session().step_labels().count(), steps + 1);
    window.get_by_label("Drape one step").click();
    window.run_steps(2);
    assert_eq!(app(&window).session().undo_label(), Some("drape a step"));
    for _ in 0..2 {
        key(&mut window, Modifiers::COMMAND, Key::Z);
    }
    wait(&mut window, "the undo", |app| app.session().snapshot().cloth.positions == before);
    assert!(drape(&window).is_none());
}

#[test]
fn escape_pauses_draping_and_space_without_cloth_says_why_nothing_moves() {
    let mut window = window();
    key(&mut window, Modifiers::NONE, Key::Space);
    window.run_steps(2);
    assert!(window.query_by_label_contains("Drape: There is no cloth on the body").is_some());
    let mut window = super::hand::dressed(window);
    key(&mut window, Modifiers::NONE, Key::Space);
    wait(&mut window, "the drape", |app| app.session().snapshot().drape.is_some_and(|d| d.runs && !d.waits));
    key(&mut window, Modifiers::NONE, Key::Escape);
    wait(&mut window, "the pause", |app| app.session().snapshot().drape.is_some_and(|d| !d.on));
    window.run_steps(2);
    assert!(window.query_by_label_contains("Draping is paused: the cloth stays as it is").is_some());
    assert_eq!(app(&window).session().undo_label(), Some("drape"));
}

#[test]
fn cloth_is_grabbed_while_it_drapes() {
    let mut window = dressed_window();
    key(&mut window, Modifiers::NONE, Key::Space);
    wait(&mut window, "the drape", |app| app.session().snapshot().drape.is_some_and(|d| !d.waits));
    key(&mut window, Modifiers::NONE, Key::D);
    let area = pane(&window, "Body pane");
    press_along(&mut window, &line(area, Vec2::new(30.0, 0.0)), PointerButton::Primary);
    wait(&mut window, "the grab", |app| app.session().snapshot().dragged.is_some());
    assert!(drape(&window).is_some_and(|d| d.runs), "physics goes on");
    let shares = app(&window).session().snapshot().dragged.clone().expect("grabbed");
    assert!(shares.iter().all(|share| *share == 1.0), "all may follow: nothing is shown as out of reach");
    key(&mut window, Modifiers::NONE, Key::Escape);
    wait(&mut window, "letting go", |app| app.session().snapshot().dragged.is_none());
}

#[test]
fn colours_prints_and_colourways_are_chosen_in_the_side_panel() {
    let mut window = dressed_window();
    let dye = |window: &Window| app(window).session().document().dyes.all;
    window.get_by_label("Colour and print of All pieces").click();
    window.run_steps(3);
    window.get_by_label("Own colour").click();
    window.run_steps(3);
    assert!(dye(&window).colour.is_some());
    let garment = pane(&window, "Body pane");
    for dye in ["#faf8f4", "#a82a30"] {
        let swatch = window.get_by_label(dye).rect();
        let middle = garment.shrink2(Vec2::new(garment.width() / 4.0, 0.0));
        assert!(swatch.left() > middle.right(), "{dye} at {swatch} covers the middle of {garment}");
    }
    window.get_by_label("#a82a30").click();
    window.run_steps(3);
    assert_eq!(dye(&window).colour, Some([168, 42, 48]));
    assert_eq!(app(&window).session().undo_label(), Some("change the colour"));
    window.get_by_label("Print").click();
    window.run_steps(3);
    window.get_by_label("checks").click();
    window.run_steps(3);
    assert_eq!(dye(&window).print.map(|print| print.motif), Some(Motif::Checks));
    key(&mut window, Modifiers::NONE, Key::Escape);
    window.run_steps(3);
    window.get_by_label("Keep colourway…").click();
    window.run_steps(3);
    let field = window.get_by_role(egui::accesskit::Role::TextInput);
    assert!(field.accesskit_node().is_focused(), "it is typed into at once");
    field.type_text("picnic");
    window.run_steps(3);
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert!(window.query_by_label("Keep").is_none(), "Enter keeps it and closes");
    let document = app(&window).session().document();
    assert_eq!(document.colourways.iter().map(|c| c.name.as_str()).collect::<Vec<_>>(), ["picnic"]);
    assert_eq!(document.colourways[0].dyes, document.dyes);
}

#[test]
fn fabrics_are_chosen_from_lists() {
    let mut window = window();
    let fabrics = |window: &Window| app(window).session().document().fabrics.clone();
    window.get_by_label("All pieces").click();
    window.run_steps(3);
    window.get_by_label("woven-heavy").click();
    window.run_steps(3);
    assert_eq!(fabrics(&window).name(None), "woven-heavy");
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(fabrics(&window).name(None), "cotton");
}

#[test]
fn a_piece_is_frozen_by_a_key_and_let_go_in_the_panel() {
    let mut window = dressed_window();
    let activity = |window: &Window| {
        let pattern = &app(window).session().document().pattern;
        pattern.pieces.values().next().expect("the square").activity
    };
    let body_pane = pane(&window, "Body pane");
    key(&mut window, Modifiers::NONE, Key::V);
    key(&mut window, Modifiers::COMMAND, Key::A);
    assert_eq!(pane(&window, "Body pane"), body_pane, "what the panel tells of a piece finds room in it");
    key(&mut window, Modifiers::COMMAND, Key::K);
    assert_eq!(activity(&window), Activity::Frozen);
    assert_eq!(app(&window).session().undo_label(), Some("freeze Square"));
    let before = positions(&window);
    key(&mut window, Modifiers::NONE, Key::Space);
    let rests = |app: &App| app.session().snapshot().drape.is_some_and(|d| !d.waits && !d.runs);
    wait(&mut window, "the drape", rests);
    assert_eq!(positions(&window), before, "it stays");
    window.get_by_label("Active").click();
    window.run_steps(3);
    assert_eq!(activity(&window), Activity::Active);
    wait(&mut window, "the fall", |app| app.session().snapshot().cloth.positions != before);
}

#[test]
fn a_piece_is_deactivated_by_a_key_and_told_in_the_list() {
    let mut window = dressed_window();
    key(&mut window, Modifiers::NONE, Key::V);
    key(&mut window, Modifiers::COMMAND, Key::A);
    for (activity, label) in
        [(Activity::Deactivated, "deactivate Square"), (Activity::Active, "activate Square")]
    {
        key(&mut window, Modifiers::COMMAND, Key::J);
        let pattern = app(&window).session().document().pattern.clone();
        assert!(pattern.pieces.values().all(|piece| piece.activity == activity));
        assert_eq!(app(&window).session().undo_label(), Some(label));
    }
}
