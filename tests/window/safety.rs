//! Work that outlives the window.

use std::path::Path;

use egui_kittest::kittest::Queryable;
use toile::session::{Command, project_file};

use super::*;

fn safe_window(root: &Path) -> Window {
    let mut window = window();
    window.state_mut().as_mut().expect("the app").keep_safe(root);
    window.run_steps(2);
    window
}

fn rename(window: &mut Window, name: &str) {
    let piece = *app(window).session().document().pattern.pieces.keys().next().expect("a piece");
    let command = Command::RenamePiece { piece, name: name.to_owned() };
    window.state_mut().as_mut().expect("the app").session_mut().apply_alone(command).expect("renamed");
    window.run_steps(2);
}

fn name(window: &Window) -> String {
    app(window).session().document().pattern.pieces.values().next().expect("a piece").name.clone()
}

#[test]
fn work_of_a_window_that_crashed_is_offered_and_restored() {
    let root = tempfile::tempdir().expect("a folder");
    let mut first = safe_window(root.path());
    rename(&mut first, "precious");
    let other = safe_window(root.path());
    assert!(other.query_by_label("Restore").is_none(), "the first still lives");
    drop((first, other)); // No goodbye: as if they had crashed.
    let mut next = safe_window(root.path());
    // Of the second there is nothing to offer.
    next.get_by_label("Restore").click();
    next.run_steps(4);
    assert_eq!(name(&next), "precious");
    assert!(app(&next).session().is_modified(), "it is in no file yet");
    next.state_mut().as_mut().expect("the app").finish();
    drop(next);
    // What was restored is not offered again.
    let last = safe_window(root.path());
    assert!(last.query_by_label("Restore").is_none());
}

#[test]
fn a_window_that_was_closed_leaves_nothing() {
    let root = tempfile::tempdir().expect("a folder");
    let mut window = safe_window(root.path());
    rename(&mut window, "gone");
    window.state_mut().as_mut().expect("the app").finish();
    drop(window);
    let next = safe_window(root.path());
    assert!(next.query_by_label("Restore").is_none());
}

#[test]
fn a_file_that_somebody_else_changed_is_not_written_over() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.toile");
    let mut window = window();
    let save = |window: &mut Window| {
        let path = path.clone();
        let ctx = window.ctx.clone();
        window.state_mut().as_mut().expect("the app").save_as(&ctx, &path).expect("saved");
        window.run_steps(3);
    };
    save(&mut window);
    rename(&mut window, "mine");
    let mut theirs = super::project();
    theirs.document.settings.edge_length = 0.031;
    project_file::save(&path, &theirs).expect("they save");
    save(&mut window);
    window.get_by_label("The file has changed");
    assert_eq!(project_file::open(&path).expect("whole"), theirs);
    window.get_by_label("Save over it").click();
    window.run_steps(4);
    let now = project_file::open(&path).expect("whole");
    assert_eq!(now.document.pattern.pieces.values().next().expect("a piece").name, "mine");
    assert!(!app(&window).session().is_modified());
}
