//! Files and what would be lost.

use std::path::Path;

use super::*;

/// Chooses `entry` of the file menu and types the path of the file. False where the desktop has a dialog of its own.
fn read_file(window: &mut Window, entry: &str, path: &Path) -> bool {
    window.get_by_label("File").click();
    window.run_steps(3);
    window.get_by_label_contains(entry).click();
    window.run_steps(3);
    if window.query_by_label("Read").is_none() {
        println!("skipped: this desktop may have a dialog of its own");
        return false;
    }
    window.get_by_role(egui::accesskit::Role::TextInput).focus();
    window.run_steps(2);
    window.get_by_role(egui::accesskit::Role::TextInput).type_text(&path.display().to_string());
    window.run_steps(2);
    window.get_by_label("Read").click();
    window.run_steps(3);
    true
}

#[test]
fn a_body_in_centimetres_is_asked_about() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("ball.obj");
    std::fs::write(&path, toile::io::obj::mesh("ball", &ball(85.0))).expect("a file");
    let mut window = window();
    if !read_file(&mut window, "Import body…", &path) {
        return;
    }
    assert!(window.query_by_label("cm: the body is 1.70 m tall").is_some());
    window.get_by_label("Take it").click();
    window.run_steps(3);
    let (lower, upper) = app(&window).session().surface().expect("a body").bounds();
    assert!(((upper - lower).y - 1.7).abs() < 1e-6);
    assert!(app(&window).session().undo_label().is_some());
}

#[test]
fn a_body_that_lies_is_set_upright_and_the_answer_is_proposed_next_time() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("long.obj");
    let mut mesh = ball(850.0);
    for p in &mut mesh.positions {
        (p.x, p.y) = (p.x * 0.3, p.y * 0.3);
    }
    std::fs::write(&path, toile::io::obj::mesh("long", &mesh)).expect("a file");
    let mut window = window();
    if !read_file(&mut window, "Import body…", &path) {
        return;
    }
    // Guessed from its sides; told as tall as it would then stand.
    assert!(window.query_by_label("mm: the body is 1.70 m tall").is_some());
    window.get_by_label("y up").click();
    window.run_steps(2);
    assert!(window.query_by_label("mm: the body is 0.51 m tall").is_some());
    window.get_by_label("z up").click();
    window.run_steps(2);
    window.get_by_label("Take it").click();
    window.run_steps(3);
    let size = |window: &Window| {
        let (lower, upper) = app(window).session().surface().expect("a body").bounds();
        upper - lower
    };
    assert!((size(&window).y - 1.7).abs() < 1e-6 && size(&window).z < 0.6);
    assert!(read_file(&mut window, "Import body…", &path));
    let is_on = |window: &Window, label: &str| {
        let node = window.get_by_label(label).accesskit_node().toggled();
        node == Some(egui::accesskit::Toggled::True)
    };
    assert!(is_on(&window, "z up") && is_on(&window, "mm: the body is 1.70 m tall"));
}

#[test]
fn a_drawing_without_a_size_is_asked_about() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("front.svg");
    let svg =
        r#"<svg xmlns="http://www.w3.org/2000/svg"><path id="front" d="M 0 0 H 500 V 600 H 0 Z"/></svg>"#;
    std::fs::write(&path, svg).expect("a file");
    let mut window = window();
    if !read_file(&mut window, "Import pattern…", &path) {
        return;
    }
    assert!(window.query_by_label("millimetres: the largest piece is 50.0 × 60.0 cm").is_some());
    window.get_by_label("Take it").click();
    window.run_steps(3);
    let pattern = &app(&window).session().document().pattern;
    let area: f64 = pattern.pieces.values().map(|p| p.signed_area()).sum();
    assert!((area - 0.3).abs() < 1e-6, "{area}");
}

#[test]
fn closing_with_changes_asks_first() {
    let mut window = window();
    let close = |window: &mut Window| {
        let root = window.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default();
        root.events.push(egui::ViewportEvent::Close);
        window.run_steps(1);
        let root = window.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default();
        root.events.clear();
        window.run_steps(2);
    };
    close(&mut window);
    assert!(window.query_by_label("Don't save").is_none(), "nothing is unsaved yet");
    let at = pane(&window, "Pattern pane").center();
    drag(&mut window, &[at], PointerButton::Primary);
    close(&mut window);
    window.get_by_label("Cancel").click();
    window.run_steps(3);
    assert!(window.query_by_label("Don't save").is_none());
    assert_eq!(counts(&window), [1, 0]);
}

#[test]
fn a_project_is_saved_by_a_typed_path_where_the_desktop_has_no_dialog() {
    if std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some() {
        println!("skipped: this desktop may have a dialog of its own");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("saved");
    let mut window = window();
    let at = pane(&window, "Pattern pane").center();
    drag(&mut window, &[at], PointerButton::Primary);
    key(&mut window, Modifiers::COMMAND, Key::S);
    let field = window.get_by_role(egui::accesskit::Role::TextInput);
    field.focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.run_steps(1);
    window.get_by_role(egui::accesskit::Role::TextInput).type_text(&path.display().to_string());
    window.run_steps(2);
    window.get_by_label("Write").click();
    window.run_steps(3);
    let saved = toile::session::project_file::open(&path.with_extension("toile")).expect("a project");
    assert_eq!(&saved.document, app(&window).session().document());
    assert!(!app(&window).session().is_modified());
}

#[test]
fn a_copy_a_next_version_and_the_way_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("shirt.toile");
    let mut window = window();
    let ctx = window.ctx.clone();
    let names = || {
        let mut names: Vec<String> = std::fs::read_dir(folder.path())
            .expect("a folder")
            .map(|file| file.expect("a file").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    };
    let rename = |window: &mut Window, name: &str| {
        let piece = *app(window).session().document().pattern.pieces.keys().next().expect("a piece");
        let command = toile::session::Command::RenamePiece { piece, name: name.to_owned() };
        window.state_mut().as_mut().expect("the app").session_mut().apply_alone(command).expect("renamed");
        window.run_steps(2);
    };
    let is = |window: &Window, name: &str| {
        app(window).session().document().pattern.pieces.values().any(|piece| piece.name == name)
    };
    window.state_mut().as_mut().expect("the app").save_as(&ctx, &path).expect("saved");
    window.run_steps(2);
    rename(&mut window, "second");
    key(&mut window, Modifiers::COMMAND.plus(Modifiers::ALT), Key::S);
    window.run_steps(2);
    assert_eq!(names(), ["shirt-2.toile", "shirt.toile"]);
    assert!(!app(&window).session().is_modified());
    key(&mut window, Modifiers::COMMAND.plus(Modifiers::ALT), Key::S);
    assert_eq!(names(), ["shirt-2.toile", "shirt-3.toile", "shirt.toile"]);

    rename(&mut window, "third");
    window.get_by_label("File").click();
    window.run_steps(3);
    window.get_by_label_contains("Revert…").click();
    window.run_steps(3);
    window.get_by_label("Cancel").click();
    window.run_steps(3);
    assert!(is(&window, "third"));
    window.get_by_label("File").click();
    window.run_steps(3);
    window.get_by_label_contains("Revert…").click();
    window.run_steps(3);
    window.get_by_label("Go back").click();
    window.run_steps(3);
    assert!(is(&window, "second") && !app(&window).session().is_modified());
}

#[test]
fn the_fit_report_is_written_where_it_is_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fit.html");
    let mut window = super::hand::dressed_window();
    window.get_by_label("File").click();
    window.run_steps(3);
    window.get_by_label_contains("Fit report…").click();
    window.run_steps(3);
    if window.query_by_label("Write").is_none() {
        println!("skipped: this desktop may have a dialog of its own");
        return;
    }
    window.get_by_role(egui::accesskit::Role::TextInput).focus();
    window.run_steps(2);
    key(&mut window, Modifiers::COMMAND, Key::A);
    window.get_by_role(egui::accesskit::Role::TextInput).type_text(&path.display().to_string());
    window.run_steps(2);
    window.get_by_label("Write").click();
    // A picture a frame, where there is an adapter.
    window.run_steps(30);
    let page = std::fs::read_to_string(&path).expect("the page");
    assert!(page.contains("Garment and body") && page.ends_with("</html>"));
    assert!(window.query_by_label_contains("Written: ").is_some());
}
