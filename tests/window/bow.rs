//! Bows: asked for at the selected place, added in one step, taken back in one.

use super::*;

fn pieces(window: &Window) -> usize {
    app(window).session().document().pattern.pieces.len()
}

fn ask(window: &mut Window) {
    edit(window, |app, ctx| app.act(ctx, toile::ui::actions::Action::AddBow));
}

#[test]
fn a_bow_is_tacked_to_the_selected_mark_and_taken_back() {
    let mut window = window();
    let before = pieces(&window);
    let at = pane(&window, "Pattern pane").center();
    drag(&mut window, &[at], PointerButton::Primary);
    drag(&mut window, &[at], PointerButton::Primary);
    assert!(window.query_by_label("Selected: mark 1 on the cloth").is_some());
    let mark = app(&window).session().document().marks.cloth[0].points[0];
    // In so low a window the entry of the menu is scrolled out of sight.
    ask(&mut window);
    act(&mut window, "Cancel");
    assert_eq!(pieces(&window), before);
    ask(&mut window);
    let field = window.get_by_label("Width of the ribbon").rect().center();
    assert!(field.is_finite());
    key(&mut window, Modifiers::NONE, Key::Enter);
    let pattern = Arc::clone(&app(&window).session().document().pattern);
    assert_eq!((pattern.pieces.len(), pattern.seams.len()), (before + 5, 7));
    // Only pieces in view have a node.
    window.run_steps(2);
    for piece in pattern.pieces.values() {
        let label = format!("Piece {}", piece.name);
        assert!(window.query_all_by_label(&label).next().is_some(), "{label} is out of view");
    }
    let places: Vec<DVec2> = pattern.buttons.values().map(|tack| tack.button.at).collect();
    let middle = places.iter().sum::<DVec2>() / places.len() as f64;
    assert!(middle.distance(mark) < 1e-9, "{places:?} round {mark}");
    assert_eq!(app(&window).session().step_labels().count(), 2);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(pieces(&window), before);
}
