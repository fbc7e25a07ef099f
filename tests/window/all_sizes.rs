//! The dialog in which every size of a pattern is dressed.

use glam::DVec2;
use toile::pattern::{GradeRule, SizeRun};
use toile::session::samples::Sample;

use super::*;

/// The skirt in three sizes, 4 % wider from one to the next, coarse.
fn graded_window() -> Window {
    let mut project = Sample::Skirt.project(&toile::body::mannequin::default());
    let pattern = Arc::make_mut(&mut project.document.pattern);
    pattern.sizes = SizeRun::new(["S", "M", "L"], "M").expect("a run");
    for piece in pattern.pieces.values_mut() {
        for edge in &mut Arc::make_mut(piece).outline {
            edge.rule = Some(GradeRule::even(DVec2::new(edge.start.x * 0.04, 0.0), 3, 1));
        }
    }
    project.document.settings.edge_length = 0.06;
    window_on(project, None)
}

fn open(window: &mut Window) {
    from_menu(window, "Garment", "Dress all sizes…");
}

/// Waits for `label`, for at most 30 seconds.
fn wait_for(window: &mut Window, label: &str) {
    let start = Instant::now();
    while window.query_by_label_contains(label).is_none() {
        assert!(start.elapsed() < Duration::from_secs(30), "no {label}");
        std::thread::sleep(Duration::from_millis(5));
        window.run_steps(1);
    }
}

#[test]
fn all_sizes_are_dressed_beside_the_garment_and_compared() {
    let mut window = graded_window();
    open(&mut window);
    wait_for(&mut window, "Dressing S");
    wait_for(&mut window, "of 3 sizes are dressed");
    window.run_steps(4);
    for size in ["S", "M", "L"] {
        assert!(window.query_by_label(size).is_some(), "{size} has a column");
    }
    let row = window.get_by_label("Ease at hip, cm").rect();
    let in_row = window.get_all_by_role(egui::accesskit::Role::Label).filter_map(|node| {
        let place = node.rect();
        let is_beside = (place.center().y - row.center().y).abs() < 4.0 && place.left() > row.right();
        let value = node.accesskit_node().value().filter(|_| is_beside)?.parse::<f64>();
        Some((place.left(), value.ok()?))
    });
    let mut cells: Vec<(f32, f64)> = in_row.collect();
    cells.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ease: Vec<f64> = cells.into_iter().map(|(_, ease)| ease).collect();
    assert!(ease.len() == 3 && ease[0] < ease[1] && ease[1] < ease[2], "{ease:?}");
    let snapshot = app(&window).session().snapshot();
    assert!(!snapshot.is_dressed(), "the garment itself is as it was");
    assert_eq!(app(&window).session().undo_label(), None);
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("All sizes on this body").is_none());
}

#[test]
fn it_can_be_stopped_and_needs_sizes() {
    let mut window = graded_window();
    open(&mut window);
    wait_for(&mut window, "Dressing S");
    window.get_by_label("Stop").click();
    window.run_steps(4);
    assert!(window.query_by_label_contains("of 0 sizes are dressed").is_some());
    let mut plain = window_on(Sample::Skirt.project(&toile::body::mannequin::default()), None);
    open(&mut plain);
    assert!(plain.query_by_label("All sizes on this body").is_none(), "there are no sizes");
}
