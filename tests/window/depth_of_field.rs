//! Depth of field of the body pane.

use egui::accesskit::Role;

use super::environment::{from_theme, keep_preferences, kept, open_theme};
use super::*;

#[test]
fn depth_of_field_is_chosen_with_its_aperture_and_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let preferences = folder.path().join("preferences.json");
    let mut window = window();
    keep_preferences(&mut window, &preferences);
    assert_eq!(app(&window).f_number(), None, "off at first");
    from_theme(&mut window, "Depth of field");
    assert_eq!(app(&window).f_number(), Some(2.8));
    assert_eq!(kept(&preferences)["depth_of_field"]["is_on"], true);
    assert!(!app(&window).session().is_modified(), "the document has no lens");

    // From the middle of the slider to its right end.
    let rail = window.get_by_role_and_label(Role::Slider, "Aperture").rect();
    let path: Vec<Pos2> = (0..8).map(|i| rail.center() + Vec2::new(20.0 * i as f32, 0.0)).collect();
    drag(&mut window, &path, PointerButton::Primary);
    window.run_steps(4);
    assert_eq!(app(&window).f_number(), Some(22.0));
    assert_eq!(kept(&preferences)["depth_of_field"]["f_number"], 22.0);
    act(&mut window, "Done");
    assert!(window.query_by_role_and_label(Role::Slider, "Aperture").is_none());
    from_theme(&mut window, "Set aperture");
    window.get_by_role_and_label(Role::Slider, "Aperture");

    let mut next = super::window();
    keep_preferences(&mut next, &preferences);
    assert_eq!(app(&next).f_number(), Some(22.0));
    assert!(next.query_by_role_and_label(Role::Slider, "Aperture").is_none(), "the bar is not kept open");
    from_theme(&mut next, "Set aperture");
    from_theme(&mut next, "Depth of field");
    assert_eq!(app(&next).f_number(), None);
    assert!(next.query_by_role_and_label(Role::Slider, "Aperture").is_none());
    let off = serde_json::json!({ "is_on": false, "f_number": 22.0 });
    assert_eq!(kept(&preferences)["depth_of_field"], off);
}

#[test]
fn a_parallel_projection_has_no_depth_of_field() {
    use toile::ui::actions::Action;
    let mut window = window();
    from_theme(&mut window, "Depth of field");
    window.get_by_role_and_label(Role::Slider, "Aperture");
    edit(&mut window, |app, ctx| app.act(ctx, Action::ToggleParallel));
    assert!(window.query_by_role_and_label(Role::Slider, "Aperture").is_none(), "its bar is closed");
    open_theme(&mut window);
    for entry in ["Depth of field", "Set aperture"] {
        assert!(window.get_by_label(entry).accesskit_node().is_disabled(), "{entry}");
    }
    window.get_by_label("Depth of field").hover();
    window.run_steps(60);
    assert!(window.query_by_label_contains("In parallel projection everything is sharp").is_some());
    key(&mut window, Modifiers::NONE, Key::Escape);
    edit(&mut window, |app, ctx| app.act(ctx, Action::ToggleParallel));
    assert_eq!(app(&window).f_number(), Some(2.8), "it is as it was");
    window.get_by_role_and_label(Role::Slider, "Aperture");
}

#[test]
fn the_pane_is_drawn_again_with_a_lens() {
    let Some(device) = egui_wgpu_device() else { return };
    let mut window = window_on(project(), Some(device));
    window.run_steps(20);
    let drawn = app(&window).pictures();
    from_theme(&mut window, "Depth of field");
    assert!(app(&window).pictures() > drawn);
    let bytes = window.state_mut().as_mut().expect("the app").picture_of_body(glam::UVec2::new(320, 200));
    assert!(image::load_from_memory(&bytes.expect("a picture")).is_ok());
}
