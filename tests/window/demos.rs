//! Demos in the window: shown instead of the document, which comes back as it was.

use toile::session::demos::Demo;

use super::*;

fn open(window: &mut Window, demo: Demo) {
    window.get_by_label("Help").click();
    window.run_steps(4);
    window.get_by_label_contains(if demo.is_walk() { "Walks" } else { "Demos" }).click();
    window.run_steps(4);
    window.get_by_label(demo.name()).click();
    window.run_steps(4);
}

#[test]
fn a_demo_plays_by_itself_and_escape_brings_the_document_back() {
    let mut window = window();
    let path = line(pane(&window, "Pattern pane"), Vec2::new(60.0, 0.0));
    drag(&mut window, &path, PointerButton::Primary);
    let (document, steps) =
        (app(&window).session().document().clone(), app(&window).session().step_labels().count());
    open(&mut window, Demo::Scarf);
    assert!(window.query_by_label_contains("Figure 5").is_some());
    assert_eq!(app(&window).shown().document().marks.cloth.len(), 0, "the hand comes first");
    wait(&mut window, "the mark", |app| app.shown().document().marks.body.len() == 1);
    wait(&mut window, "the wrap", |app| app.shown().snapshot().is_dressed());
    // Nothing but the view can be changed meanwhile.
    let path = line(pane(&window, "Pattern pane"), Vec2::new(60.0, 0.0));
    drag(&mut window, &path, PointerButton::Primary);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(*app(&window).session().document() == document);
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label_contains("Figure 5").is_none());
    assert!(*app(&window).shown().document() == document);
    assert_eq!(app(&window).session().step_labels().count(), steps);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(app(&window).session().document().marks.cloth.len(), 0, "undo works as before");
}

#[test]
fn a_demo_that_is_over_stays_to_be_looked_at() {
    let mut window = window();
    open(&mut window, Demo::Scarf);
    wait(&mut window, "the end", |app| {
        let shown = app.shown().snapshot();
        shown.is_dressed() && !shown.working
    });
    window.run_steps(3);
    window.get_by_label("Back to your work").click();
    window.run_steps(3);
    assert!(!app(&window).shown().snapshot().is_dressed());
}

#[test]
fn a_walk_that_begins_with_an_empty_table_shows_its_pieces() {
    let mut window = window();
    open(&mut window, Demo::Drafting);
    assert!(app(&window).shown().document().pattern.pieces.is_empty());
    wait(&mut window, "two pieces", |app| app.shown().document().pattern.pieces.len() == 2);
    window.run_steps(3);
    let area = pane(&window, "Pattern pane");
    for piece in app(&window).shown().document().pattern.pieces.values() {
        for edge in &piece.outline {
            let at = app(&window).on_screen(piece.pose.plane_from_piece(edge.start)).expect("drawn");
            assert!(area.contains(at), "{}: {at} is outside of {area}", piece.name);
        }
    }
}

#[test]
fn the_walk_to_blender_ends_with_an_export_of_what_it_made() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("skirt.glb");
    let mut window = window();
    open(&mut window, Demo::Export);
    wait(&mut window, "the fabric", |app| !app.shown().document().fabrics.is_usual());
    wait(&mut window, "the marks", |app| app.shown().document().marks.pairs().count() == 2);
    wait(&mut window, "the wrap", |app| app.shown().snapshot().is_dressed());
    let start = Instant::now();
    while window.query_by_label("Again").is_none() {
        assert!(start.elapsed() < Duration::from_secs(60), "the end took too long");
        window.run_steps(1);
    }
    assert!(window.query_by_label_contains("File › Import › glTF 2.0").is_some());
    window.get_by_label("Export…").click();
    window.run_steps(3);
    if !files::write_asked(&mut window, &path) {
        return;
    }
    window.run_steps(3);
    let bytes = std::fs::read(&path).expect("the file");
    let text = String::from_utf8_lossy(&bytes);
    assert!(bytes.starts_with(b"glTF") && text.contains("skirt front"), "the skirt, not the document");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!app(&window).shown().snapshot().is_dressed(), "back to the document");
}

#[test]
fn a_marker_asked_for_in_a_walk_is_of_the_pieces_that_are_shown() {
    let mut window = window();
    open(&mut window, Demo::Cutting);
    let pieces = |app: &App| [app.session(), app.shown()].map(|s| s.document().pattern.pieces.len());
    let [own, shown] = pieces(app(&window));
    assert!(own != shown && shown == 4, "{own} and {shown}");
    from_menu(&mut window, "File", "Marker…");
    marker::enter(&mut window, egui::accesskit::Role::SpinButton, "Search", "0");
    window.get_by_label("Make the marker").click();
    window.run_steps(4);
    marker::wait_for(&mut window, "Marker: 4 pieces on");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Make it again").is_none());
    assert_eq!(pieces(app(&window)), [own, shown], "the walk goes on");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(pieces(app(&window)), [own, own]);
}
