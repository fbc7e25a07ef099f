//! What the buttons do, by preference.

use toile::session::samples::Sample;
use toile::session::{Command, Session};
use toile::sim::{Runner, Simulation};

use super::hand::{dressed_window, positions};
use super::*;

fn prefer(window: &mut Window, name: &str) {
    window.get_by_label("View").click();
    window.run_steps(4);
    // The last entries of a menu that is higher than the window must be scrolled to.
    window.get_by_label_contains("Mouse").scroll_to_me();
    window.run_steps(30);
    window.get_by_label_contains("Mouse").click();
    window.run_steps(4);
    window.get_by_label(name).click();
    window.run_steps(4);
}

/// The label of the newest step after a short drag over the middle of the body pane.
fn step_of_drag(window: &mut Window, with: PointerButton) -> String {
    let path = line(pane(window, "Body pane"), Vec2::new(40.0, 0.0));
    drag(window, &path, with);
    app(window).session().undo_label().unwrap_or_default().to_owned()
}

#[test]
fn as_in_the_paper_the_right_button_drags_cloth_with_any_tool() {
    let mut window = dressed_window();
    let before = positions(&window);
    assert_eq!(step_of_drag(&mut window, PointerButton::Secondary), "drag the cloth");
    wait(&mut window, "the drag", |app| app.session().snapshot().cloth.positions != before);
}

#[test]
fn as_in_the_paper_a_click_on_cloth_pins_it_while_marks_are_painted() {
    let mut window = dressed_window();
    let middle = pane(&window, "Body pane").center();
    let marks = counts(&window);
    drag(&mut window, &[middle - Vec2::Y * 30.0], PointerButton::Primary);
    assert_eq!(app(&window).session().document().pins.len(), 1);
    assert_eq!(counts(&window), marks);
}

#[test]
fn by_other_habits_the_buttons_turn_the_view() {
    let mut window = dressed_window();
    let cases = [
        ("Like CLO: right turns", PointerButton::Secondary),
        ("Like Blender: middle turns", PointerButton::Middle),
        ("Like CLO: right turns", PointerButton::Middle),
    ];
    for (name, with) in cases {
        prefer(&mut window, name);
        let camera = app(&window).camera();
        assert_eq!(step_of_drag(&mut window, with), "wrap", "{name}");
        assert!(app(&window).camera() != camera, "{name}");
    }
}

#[test]
fn a_preference_is_kept_for_the_next_time() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("preferences.json");
    let mut window = window();
    let ctx = window.ctx.clone();
    window.state_mut().as_mut().expect("the app").keep_preferences(&ctx, path.clone());
    prefer(&mut window, "Like Maya: Alt moves the view");
    assert!(std::fs::read_to_string(path).expect("kept").contains("maya"));
}

#[test]
fn a_click_on_a_problem_shows_the_marks_concerned() {
    let mut project = Sample::Tshirt.project(&toile::body::mannequin::default());
    let sleeve = project.document.pattern.piece_named("sleeve left").expect("a sleeve");
    let marks = Arc::make_mut(&mut project.document.marks);
    let number = marks.cloth.iter().position(|m| m.piece == sleeve).expect("its mark");
    let (id, other) = (marks.body[number].id, marks.body[0].clone());
    marks.body[number].points = other.points.iter().map(|p| *p + DVec3::X * 0.05).collect();
    marks.ties.clear();
    let mut session = Session::new(project, Runner::inline(Simulation::default()));
    session.apply_alone(Command::Wrap).expect("wrapped");
    while session.runner().simulation().expect("inline").tick() {}
    let mut window = window_on(session.project(), None);
    wait(&mut window, "the verdict", |app| app.session().snapshot().verdict.is_some());
    window.run_steps(3);
    let camera = app(&window).camera();
    let verdict = app(&window).session().snapshot().verdict.clone().expect("a verdict");
    let fault = verdict.iter().find(|f| f.marks.first().is_some_and(|m| m.number == number + 1));
    let fault = fault.unwrap_or_else(|| panic!("{verdict:#?}"));
    window.get_by_label_contains(&fault.problem.words).scroll_to_me();
    window.run_steps(5);
    window.get_by_label_contains(&fault.problem.words).click();
    window.run_steps(3);
    assert!(app(&window).camera() != camera, "the view goes there");
    let place = app(&window).session().document().marks.place(id).expect("the mark").to_string();
    assert!(window.query_by_label_contains(&format!("Selected: {place}")).is_some());
}
