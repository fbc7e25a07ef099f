//! Dressing by the best start in the window.

use toile::session::samples::Sample;

use super::hand::positions;
use super::*;

/// The skirt and the mannequin, without marks, coarse.
fn skirt_window() -> Window {
    let mut project = Sample::Skirt.project(&toile::body::mannequin::default());
    project.document.take_marks(Arc::default());
    project.document.settings.edge_length = 0.06;
    window_on(project, None)
}

fn begin(window: &mut Window) {
    assert!(window.query_by_label("Wrap").is_none(), "nothing can be wrapped yet");
    window.get_by_label("Dress").click();
    window.run_steps(2);
}

#[test]
fn dress_takes_a_start_and_its_marks_can_be_kept() {
    let mut window = skirt_window();
    begin(&mut window);
    assert!(window.query_by_label("Cancel").is_some());
    wait(&mut window, "the garment", |app| app.session().snapshot().started.is_some());
    window.run_steps(3);
    assert!(window.query_by_label_contains("Dressed by suggested marks").is_some(), "it is told");
    let dressed = positions(&window);
    let proposed = app(&window).session().snapshot().source.as_ref().map(|source| source.marks.cloth.len());
    assert_eq!(counts(&window), [0, 0]);
    assert!(window.query_by_label("Proposed mark 1 on the cloth").is_some());
    window.get_by_label("Accept").click();
    window.run_steps(3);
    assert_eq!(Some(counts(&window)[0]), proposed);
    assert!(window.query_by_label("Wrap").is_some(), "now it can be wrapped");
    assert_eq!(positions(&window), dressed, "the cloth stays");
    for label in ["suggest marks", "dress"] {
        assert_ne!(app(&window).session().undo_label(), None, "{label}");
        key(&mut window, Modifiers::COMMAND, Key::Z);
    }
    wait(&mut window, "the undo", |app| !app.session().snapshot().is_dressed());
    window.run_steps(2);
    assert_eq!((counts(&window), app(&window).session().undo_label()), ([0, 0], None));
    assert!(window.query_by_label("Accept").is_none(), "proposed marks go with the cloth");
}

#[test]
fn esc_cancels_the_whole_run() {
    let mut window = skirt_window();
    begin(&mut window);
    wait(&mut window, "a start", |app| app.session().snapshot().trying.is_some());
    window.run_steps(2);
    assert!(window.query_by_label_contains("By marks: ").is_some(), "it is told how far it has come");
    key(&mut window, Modifiers::NONE, Key::Escape);
    wait(&mut window, "the bare body", |app| {
        let snapshot = app.session().snapshot();
        !snapshot.is_dressed() && snapshot.trying.is_none()
    });
    assert_eq!(app(&window).session().undo_label(), None);
}

/// Narrower than what it goes round, so that all starts are tried.
#[test]
fn the_progress_rises_from_start_to_start() {
    let mut window = window_on(common::placed_project(0.15, 0.15), None);
    begin(&mut window);
    let start = Instant::now();
    let (mut last, mut words) = (0, String::new());
    while app(&window).session().snapshot().started.is_none() {
        assert!(start.elapsed().as_secs() < 60, "it takes too long");
        std::thread::sleep(Duration::from_millis(2));
        window.run_steps(1);
        let told = |part: &str| window.query_by_label_contains(part).and_then(|l| l.accesskit_node().value());
        let Some(now) = told("By marks: ").or_else(|| told("From placement: ")) else { continue };
        let before = now.split(" %").next().unwrap_or_default();
        let percent: u32 = before.rsplit(' ').next().and_then(|n| n.parse().ok()).expect("a number");
        assert!(percent >= last, "{words:?}, then {now:?}");
        (last, words) = (percent, now);
    }
    assert!(last > 0 && words.contains("From placement: "), "the last was {words:?}");
}

#[test]
fn the_key_of_dress_says_what_is_missing() {
    let mut window = window();
    key(&mut window, Modifiers::COMMAND, Key::Enter);
    assert!(
        window.query_by_label_contains("Dress: There are neither seams nor marks").is_some(),
        "it is told"
    );
    assert_eq!(app(&window).session().undo_label(), None, "nothing is done");
    assert!(!app(&window).session().snapshot().working);
    key(&mut window, Modifiers::NONE, Key::D);
    assert!(window.query_by_label_contains("There is no cloth on the body.").is_some(), "so do letters");
}
