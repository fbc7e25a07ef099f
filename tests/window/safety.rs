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

/// As when its display is lost.
#[test]
fn a_window_that_ends_without_consent_leaves_unsaved_work() {
    let root = tempfile::tempdir().expect("a folder");
    for (renamed, offered) in [(false, false), (true, true)] {
        let mut window = safe_window(root.path());
        if renamed {
            rename(&mut window, "precious");
        }
        window.state_mut().as_mut().expect("the app").end();
        drop(window);
        let next = safe_window(root.path());
        assert_eq!(next.query_by_label("Restore").is_some(), offered);
    }
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

/// Set for a copy of a test that may write no more than a few hundred bytes: where it saves.
const FULL: &str = "TOILE_TEST_FULL_DISK";

#[test]
fn a_disk_that_is_full_leaves_the_file_and_the_document() {
    if let Some(path) = std::env::var_os(FULL) {
        return on_a_full_disk(Path::new(&path));
    }
    if !cfg!(unix) {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.toile");
    project_file::save(&path, &project()).expect("saved");
    let before = std::fs::read(&path).expect("the file");
    // As on a full disk, writing stops with an error in the middle of the file.
    let script = "trap '' XFSZ; ulimit -f 1; exec \"$0\" --exact safety::a_disk_that_is_full_leaves_the_file_and_the_document";
    let mut process = std::process::Command::new("sh");
    process.arg("-c").arg(script).arg(std::env::current_exe().expect("this test")).env(FULL, &path);
    let output = process.output().expect("started");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    assert_eq!(std::fs::read(&path).expect("the file"), before);
    let left: Vec<_> = std::fs::read_dir(folder.path()).expect("the folder").flatten().collect();
    assert_eq!(left.len(), 1, "nothing half written is left: {left:?}");
}

fn on_a_full_disk(path: &Path) {
    let mut window = window();
    rename(&mut window, "mine");
    let ctx = window.ctx.clone();
    let words = window.state_mut().as_mut().expect("the app").save_as(&ctx, path).expect_err("no room");
    assert!(words.contains("mine.toile could not be saved"), "{words}");
    assert!(app(&window).session().is_modified());
    assert_eq!(name(&window), "mine");
}

#[test]
fn a_file_in_a_folder_that_is_gone_is_not_taken_for_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.toile");
    let mut window = window();
    let save = |window: &mut Window| {
        let ctx = window.ctx.clone();
        window.state_mut().as_mut().expect("the app").save_as(&ctx, &path)
    };
    save(&mut window).expect("saved");
    rename(&mut window, "mine");
    folder.close().expect("removed");
    save(&mut window).expect_err("there is no such folder");
    assert!(app(&window).session().is_modified());
}

#[test]
fn a_save_that_cannot_be_asks_where_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.toile");
    let mut window = window();
    let ctx = window.ctx.clone();
    window.state_mut().as_mut().expect("the app").save_as(&ctx, &path).expect("saved");
    rename(&mut window, "mine");
    folder.close().expect("removed");
    key(&mut window, Modifiers::COMMAND, Key::S);
    window.run_steps(3);
    window.get_by_label_contains("mine.toile could not be saved");
    assert!(window.query_by_label("Replace it anyway").is_none());
    window.get_by_label("Save as…").click();
    window.run_steps(3);
    assert!(window.query_by_label_contains("could not be saved").is_none());
    assert!(app(&window).session().is_modified());
}

#[test]
fn a_file_that_is_write_protected_is_replaced_only_when_that_is_meant() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.toile");
    let mut window = window();
    let ctx = window.ctx.clone();
    window.state_mut().as_mut().expect("the app").save_as(&ctx, &path).expect("saved");
    let before = std::fs::read(&path).expect("the file");
    rename(&mut window, "mine");
    let mut permissions = std::fs::metadata(&path).expect("the file").permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&path, permissions).expect("protected");
    key(&mut window, Modifiers::COMMAND, Key::S);
    window.run_steps(3);
    window.get_by_label_contains("it is write-protected");
    window.get_by_label("Cancel").click();
    window.run_steps(3);
    assert_eq!(std::fs::read(&path).expect("the file"), before);
    assert!(app(&window).session().is_modified());
    key(&mut window, Modifiers::COMMAND, Key::S);
    window.run_steps(3);
    window.get_by_label("Replace it anyway").click();
    window.run_steps(3);
    assert!(!app(&window).session().is_modified());
    assert_ne!(std::fs::read(&path).expect("the file"), before);
    assert!(std::fs::metadata(&path).expect("the file").permissions().readonly(), "it stays so");
}

#[test]
fn a_lost_graphics_device_takes_nothing_with_it() {
    let Some(device) = egui_wgpu_device() else { return };
    let mut window = window_on(project(), Some(device.clone()));
    paint_both(&mut window);
    rename(&mut window, "precious");
    let picture = |window: &mut Window| {
        key(window, Modifiers::NONE, Key::Num1);
        window.run_steps(3);
        let app = window.state_mut().as_mut().expect("the app");
        let bytes = app.picture_of_body(glam::UVec2::new(320, 200)).expect("a picture");
        image::load_from_memory(&bytes).expect("a PNG").to_rgb8()
    };
    let (before, document) = (picture(&mut window), app(&window).session().document().clone());
    device.device.destroy();
    // The next picture finds out.
    key(&mut window, Modifiers::NONE, Key::Num3);
    window.run_steps(3);
    assert!(app(&window).is_moving(), "the window closes");
    let commands =
        |window: &Window| window.output().viewport_output[&egui::ViewportId::ROOT].commands.clone();
    assert!(!commands(&window).contains(&egui::ViewportCommand::CancelClose));

    let again = egui_wgpu_device().expect("a second device");
    let ctx = window.ctx.clone();
    window.state_mut().as_mut().expect("the app").move_into(&ctx, Some(again));
    window.run_steps(3);
    assert!(!app(&window).is_moving());
    assert_eq!(app(&window).session().document(), &document);
    assert_eq!(app(&window).session().undo_label(), Some("rename Square to precious"));
    let after = picture(&mut window);
    let far = |(a, b): (&u8, &u8)| a.abs_diff(*b) > 2;
    let other = after.iter().zip(before.iter()).filter(|pair| far(*pair)).count();
    assert_eq!(other, 0, "the same picture by another device");
    assert!(window.query_by_label_contains("Nothing of your work is lost").is_some());
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(name(&window), "Square");
}
