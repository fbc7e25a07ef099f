//! The Marker window: a marker is made behind it, shown, saved, stopped, and refused in words.

use std::path::Path;

use toile::io::pdf::Paper;
use toile::marker::nest::Watch;
use toile::marker::{FinishedMarker, MarkerFormat, Order};
use toile::pattern::SizeRun;
use toile::session::samples::Sample;

use super::*;

fn trousers() -> Project {
    Sample::Trousers.project(&toile::body::mannequin::default())
}

fn open(window: &mut Window) {
    from_menu(window, "File", "Marker…");
}

fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(4);
}

/// Types `text` into the field or number called `label`.
pub fn enter(window: &mut Window, role: egui::accesskit::Role, label: &str, text: &str) {
    window.get_by_role_and_label(role, label).click();
    window.run_steps(4);
    key(window, Modifiers::COMMAND, Key::A);
    window.get_by_role_and_label(role, label).type_text(text);
    window.run_steps(2);
    key(window, Modifiers::NONE, Key::Enter);
}

fn type_width(window: &mut Window, text: &str) {
    enter(window, egui::accesskit::Role::TextInput, "Width of the cloth", text);
}

/// Waits for a node that contains `label`, for at most 30 seconds.
pub fn wait_for(window: &mut Window, label: &str) {
    let start = Instant::now();
    while window.query_by_label_contains(label).is_none() {
        assert!(start.elapsed() < Duration::from_secs(30), "no {label}");
        std::thread::sleep(Duration::from_millis(5));
        window.run_steps(1);
    }
}

/// Saves by the button `label` to `path`. False where the desktop has a dialog of its own.
fn save(window: &mut Window, label: &str, path: &Path) -> bool {
    click(window, label);
    if super::hand::has_file_dialogs() {
        return false;
    }
    let role = egui::accesskit::Role::TextInput;
    let is_path = |node: &egui_kittest::Node<'_>| {
        node.accesskit_node().value().is_some_and(|text| text.starts_with("marker."))
    };
    window.get_all_by_role(role).find(is_path).expect("the path").focus();
    window.run_steps(2);
    key(window, Modifiers::COMMAND, Key::A);
    window.get_all_by_role(role).find(is_path).expect("the path").type_text(&path.display().to_string());
    window.run_steps(2);
    click(window, "Write");
    true
}

#[test]
fn the_files_are_those_of_the_same_order_without_a_window() {
    let folder = tempfile::tempdir().expect("a folder");
    let project = trousers();
    let pattern = Arc::clone(&project.document.pattern);
    let mut window = window_on(project, None);
    open(&mut window);
    assert!(window.get_by_label("Save as PDF…").accesskit_node().is_disabled(), "there is no marker yet");
    enter(&mut window, egui::accesskit::Role::SpinButton, "Search", "0.2");
    enter(&mut window, egui::accesskit::Role::SpinButton, "Garments", "2");
    type_width(&mut window, "1.4 m");
    click(&mut window, "Nap: all pieces point one way");
    click(&mut window, "Make the marker");
    wait_for(&mut window, "Make it again");
    let mut order = Order { garments: vec![(String::new(), 2)], width: 1.4, nap: true, ..Order::default() };
    order.effort.seconds = 0.2;
    let made = FinishedMarker::new("untitled", &pattern, &order, &Watch::default()).expect("a marker");
    let centimetres = (made.report.length * 1e4).round() / 100.0;
    assert!(window.query_by_label_contains(&format!("Marker: 12 pieces on {centimetres} cm")).is_some());
    assert!(window.query_by_label(&format!("{:.1} %", made.report.yield_percent)).is_some());
    for (label, format) in
        [("SVG", MarkerFormat::Svg), ("DXF", MarkerFormat::Dxf), ("PDF", MarkerFormat::Pdf)]
    {
        let path = folder.path().join(format!("m.{}", format.ending()));
        if !save(&mut window, &format!("Save as {label}…"), &path) {
            return;
        }
        let written = std::fs::read(&path).expect("a file");
        assert_eq!(written, made.file(format, Paper::default()).expect("a file"), "{label}");
    }
    click(&mut window, "Nap: all pieces point one way");
    assert!(window.query_by_label_contains("The options have changed").is_some());
    assert_eq!(app(&window).session().undo_label(), None, "the project is as it was");
}

#[test]
fn each_size_has_its_own_count() {
    let mut project = trousers();
    Arc::make_mut(&mut project.document.pattern).sizes = SizeRun::new(["S", "M", "L"], "M").expect("a run");
    let mut window = window_on(project, None);
    open(&mut window);
    enter(&mut window, egui::accesskit::Role::SpinButton, "Search", "0");
    enter(&mut window, egui::accesskit::Role::SpinButton, "Garments in size S", "2");
    click(&mut window, "Make the marker");
    wait_for(&mut window, "Marker: 18 pieces on");
    click(&mut window, "Close");
    assert!(window.query_by_label("Make it again").is_none());
    open(&mut window);
    let count = window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Garments in size S");
    let count = count.accesskit_node().value();
    assert_eq!(count.as_deref(), Some("2"), "the options are kept");
}

#[test]
fn it_is_stopped_by_cancel_and_by_closing() {
    let mut window = window_on(trousers(), None);
    open(&mut window);
    enter(&mut window, egui::accesskit::Role::SpinButton, "Search", "600");
    enter(&mut window, egui::accesskit::Role::SpinButton, "Garments", "20");
    click(&mut window, "Make the marker");
    assert!(
        window.query_by_label("Laying the pieces out…").is_some()
            || window.query_by_label("Cancel").is_some()
    );
    click(&mut window, "Cancel");
    assert!(window.query_by_label("Make the marker").is_some(), "it can be begun again");
    click(&mut window, "Make the marker");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Cancel").is_none() && window.query_by_label("Make the marker").is_none());
}

#[test]
fn what_cannot_be_laid_out_is_told_in_words() {
    let mut window = window_on(trousers(), None);
    open(&mut window);
    type_width(&mut window, "10");
    click(&mut window, "Make the marker");
    wait_for(&mut window, "There is no marker: ");
    assert!(window.query_by_label_contains("needs cloth of").is_some());
    assert!(window.query_by_label_contains("and this is 10 cm wide").is_some());
    // A table without pieces has nothing to lay out: the menu says so.
    let mut empty = window_on(Project::default(), None);
    empty.get_by_label("File").click();
    empty.run_steps(4);
    assert!(empty.get_by_label("Marker…").accesskit_node().is_disabled());
}
