//! A body from a glTF file is led through its animations.

use egui::accesskit::Role;

use super::*;
use crate::files::read_by;

fn window_on_limb() -> Option<(tempfile::TempDir, Window)> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("limb.glb");
    std::fs::write(&path, limb::glb()).expect("a file");
    let window = window_that_took("Pose from a file…", &path)?;
    Some((folder, window))
}

/// With cloth on the limb, after the file was chosen by this entry of the menu.
fn window_that_took(entry: &str, path: &std::path::Path) -> Option<Window> {
    let mut window = window_on(limb::project(), None);
    window.get_by_label("Wrap").click();
    wait(&mut window, "the cloth to rest", |app| {
        let snapshot = app.session().snapshot();
        snapshot.is_dressed() && !snapshot.working
    });
    if !read_by(&mut window, "File", entry, path) {
        return None;
    }
    assert_eq!(app(&window).session().undo_label(), Some("take animations"));
    window.get_by_label("Pose").click();
    window.run_steps(8);
    window.get_by_label("Rest pose").scroll_to_me();
    window.run_steps(8);
    Some(window)
}

/// How far the upper end of the body has turned, radians.
fn turned(app: &App) -> f64 {
    let here = limb::limb();
    let top = (0..here.positions.len()).find(|&v| here.positions[v].y > 0.999).expect("a top");
    let there = app.session().surface().expect("a body").mesh.positions[top];
    (0..=900)
        .map(|i| f64::from(i) / 900.0 * std::f64::consts::FRAC_PI_2)
        .min_by(|a, b| {
            let off = |angle: f64| limb::bent(here.positions[top], angle).distance(there);
            off(*a).total_cmp(&off(*b))
        })
        .expect("an angle")
}

#[test]
fn the_slider_leads_body_and_cloth_through_the_animation() {
    let Some((_folder, mut window)) = window_on_limb() else { return };
    let rail = window.get_by_role_and_label(Role::Slider, "Time of the animation").rect();
    let from = Pos2::new(rail.left() + 6.0, rail.center().y);
    let path: Vec<Pos2> = (0..8).map(|i| from + Vec2::new(7.0 * i as f32, 0.0)).collect();
    drag(&mut window, &path, PointerButton::Primary);
    window.run_steps(4);
    assert!((0.2..1.4).contains(&turned(app(&window))), "{}", turned(app(&window)));
    let far: Vec<Pos2> = (0..8).map(|i| path[7] + Vec2::new(60.0 * i as f32, 0.0)).collect();
    drag(&mut window, &far, PointerButton::Primary);
    window.run_steps(4);
    assert!((turned(app(&window)) - std::f64::consts::FRAC_PI_2).abs() < 1e-3, "{}", turned(app(&window)));
    wait(&mut window, "the cloth", |app| app.session().is_caught_up());
    let cloth = &app(&window).session().snapshot().cloth;
    assert!(cloth.positions.iter().all(|p| p.x < -0.1), "beside the bend");
    window.get_by_label("Rest pose").click();
    window.run_steps(4);
    assert!(turned(app(&window)) < 1e-3);
    for _ in 0..3 {
        key(&mut window, Modifiers::COMMAND, Key::Z);
    }
    let document = app(&window).session().document();
    assert!(document.moment.is_none() && document.animations.is_some(), "one step each");
}

#[test]
fn numbered_files_of_the_body_are_an_animation_of_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |picture: u32| folder.path().join(format!("bend_{picture:02}.obj"));
    for picture in 0..=8 {
        let mut mesh = limb::limb();
        let angle = 0.1 * f64::from(picture);
        mesh.positions.iter_mut().for_each(|p| *p = limb::bent(*p, angle));
        std::fs::write(path(picture), toile::io::obj::mesh("limb", &mesh)).expect("a file");
    }
    let Some(mut window) = window_that_took("Sequence of OBJ files…", &path(3)) else { return };
    assert!(window.query_by_label("bend").is_some(), "called after the files");
    let rail = window.get_by_role_and_label(Role::Slider, "Time of the animation").rect();
    let from = Pos2::new(rail.left() + 6.0, rail.center().y);
    let path: Vec<Pos2> = (0..12).map(|i| from + Vec2::new(40.0 * i as f32, 0.0)).collect();
    drag(&mut window, &path, PointerButton::Primary);
    window.run_steps(4);
    assert!((turned(app(&window)) - 0.8).abs() < 2e-3, "{}", turned(app(&window)));
    wait(&mut window, "the cloth", |app| app.session().is_caught_up());
    assert!(app(&window).session().snapshot().is_dressed());
}

#[test]
fn a_drag_leads_the_mannequin_through_files_in_one_go() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |picture: u32| folder.path().join(format!("{picture}.obj"));
    for picture in 0..3 {
        let mut mesh = toile::body::mannequin::default().mesh.clone();
        mesh.positions.iter_mut().for_each(|p| p.z += 0.02 * f64::from(picture) * p.y * p.y);
        std::fs::write(path(picture), toile::io::obj::mesh("body", &mesh)).expect("a file");
    }
    let figure = toile::body::mannequin::default();
    let mut window = window_on(toile::session::samples::Sample::Scarf.project(&figure), None);
    if !read_by(&mut window, "File", "Sequence of OBJ files…", &path(0)) {
        return;
    }
    assert_eq!(app(&window).session().undo_label(), Some("take animations"));
    window.get_by_label("Pose").scroll_to_me();
    window.run_steps(8);
    window.get_by_label("Pose").click();
    window.run_steps(8);
    window.get_by_label("Rest pose").scroll_to_me();
    window.run_steps(8);
    let rail = window.get_by_role_and_label(Role::Slider, "Time of the animation").rect();
    let from = Pos2::new(rail.left() + 6.0, rail.center().y);
    let way: Vec<Pos2> = (0..12).map(|i| from + Vec2::new(40.0 * i as f32, 0.0)).collect();
    drag(&mut window, &way, PointerButton::Primary);
    window.run_steps(4);
    let document = app(&window).session().document();
    let moment = document.moment.expect("in the animation");
    assert!((moment.seconds - 2.0 / 30.0).abs() < 1e-6, "{moment:?}");
    assert!(document.body.measurements().is_none());
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(app(&window).session().document().body.measurements().is_some(), "in one step");
}

#[test]
fn it_plays_until_it_is_stopped_and_ends_with_care() {
    let Some((_folder, mut window)) = window_on_limb() else { return };
    window.get_by_label("Play").click();
    window.run_steps(2);
    wait(&mut window, "the bend", |app| turned(app) > 0.5);
    let recorded = |window: &mut Window| window.state_mut().as_mut().expect("the app").recording();
    window.get_by_label("Stop").click();
    window.run_steps(4);
    let there = turned(app(&window));
    window.run_steps(8);
    assert_eq!(turned(app(&window)), there, "it stands still");
    let text = recorded(&mut window);
    let last = text.lines().rfind(|line| line.contains("animate")).expect("a command");
    assert!(!last.contains("draft"), "{last}");
    assert_eq!(app(&window).session().undo_label(), Some("change the pose"));
    // Undo while it plays ends the play.
    window.get_by_label("Play").click();
    window.run_steps(6);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    window.run_steps(4);
    assert!(window.query_by_label("Play").is_some());
}

#[test]
fn another_animation_of_the_list_begins_at_its_beginning() {
    let Some((_folder, mut window)) = window_on_limb() else { return };
    window.get_by_role_and_label(Role::ComboBox, "Animation").click();
    window.run_steps(4);
    window.get_by_label("snap").click();
    window.run_steps(4);
    let moment = app(&window).session().document().moment.expect("in it");
    assert_eq!((moment.animation, moment.seconds), (1, 0.0));
    assert!(turned(app(&window)) < 1e-3, "it snaps at its end");
}

#[test]
fn a_body_is_imported_with_its_animations_in_one_step() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("limb.glb");
    std::fs::write(&path, limb::glb()).expect("a file");
    let mut window = window();
    if !read_by(&mut window, "File", "Import body…", &path) {
        return;
    }
    if window.query_by_label("Take it").is_some() {
        window.get_by_label("Take it").click();
        window.run_steps(3);
    }
    let session = app(&window).session();
    assert_eq!(session.step_labels().collect::<Vec<_>>(), ["change the body"]);
    let animations = session.document().animations.as_ref().expect("animations");
    assert_eq!(animations.names().collect::<Vec<_>>(), ["bend", "snap"]);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(app(&window).session().document().animations.is_none());
}
