//! Start page, tour, command palette, preferences, history, messages.

use egui::accesskit::Role;
use toile::session::project_file;

use super::*;

fn menu(window: &mut Window, menu: &str, entry: &str) {
    act(window, menu);
    window.get_by_label_contains(entry).click();
    window.run_steps(4);
}

fn type_into(window: &mut Window, text: &str) {
    window.event(Event::Text(text.to_owned()));
    window.run_steps(3);
}

#[test]
fn a_command_is_found_by_a_few_letters_and_carried_out() {
    let mut window = window();
    key(&mut window, Modifiers::COMMAND, Key::P);
    assert!(window.query_by_label("Find a command").is_some());
    type_into(&mut window, "sel al");
    assert!(window.query_by_label("Command Select all").is_some());
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert!(window.query_by_label("Find a command").is_none(), "it closes");
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert!(app(&window).session().document().pattern.pieces.is_empty(), "all were selected, and deleted");
}

#[test]
fn poses_and_fabrics_are_found_like_commands() {
    let mut window = window_on(Project::default(), None);
    let choose = |window: &mut Window, text: &str| {
        key(window, Modifiers::COMMAND, Key::P);
        type_into(window, text);
        key(window, Modifiers::NONE, Key::Enter);
    };
    choose(&mut window, "sitting");
    let sitting = BodyChoice::default().in_named_pose(toile::body::NamedPose::Sitting);
    assert_eq!(Some(app(&window).session().document().body.clone()), sitting);
    choose(&mut window, "fabric silk");
    let fabrics = app(&window).session().document().fabrics.clone();
    assert!(fabrics.name(None).contains("silk"), "{fabrics:?}");
}

#[test]
fn a_command_that_cannot_be_chosen_says_why_in_the_palette() {
    let mut window = window();
    key(&mut window, Modifiers::NONE, Key::F3);
    type_into(&mut window, "rewrap");
    assert!(window.query_by_label("Rewrap: There is no cloth on the body").is_some());
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert!(window.query_by_label_contains("Rewrap: There is no cloth on the body.").is_some(), "told again");
    key(&mut window, Modifiers::NONE, Key::F3);
    type_into(&mut window, "v");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Find a command").is_none());
    assert_eq!(app(&window).session().undo_label(), None, "letters that are typed choose no tool");
}

#[test]
fn what_was_typed_in_one_piece_comes_before_its_letters_here_and_there() {
    let mut window = window();
    key(&mut window, Modifiers::NONE, Key::F3);
    type_into(&mut window, "theme");
    let chosen = window
        .query_all_by_label_contains("Command ")
        .find(|row| row.accesskit_node().toggled() == Some(egui::accesskit::Toggled::True));
    let label = chosen.and_then(|row| row.accesskit_node().label()).expect("a row is chosen");
    assert!(label != "Command Use the mannequin", "{label}");
}

#[test]
fn the_palette_is_walked_through_with_arrows() {
    let mut window = window();
    key(&mut window, Modifiers::COMMAND, Key::P);
    let chosen = |window: &Window, label: &str| {
        let toggled = window.get_by_label(label).accesskit_node().toggled();
        toggled == Some(egui::accesskit::Toggled::True)
    };
    assert!(chosen(&window, "Command New") && !chosen(&window, "Command Start page"));
    key(&mut window, Modifiers::NONE, Key::ArrowDown);
    assert!(!chosen(&window, "Command New") && chosen(&window, "Command Start page"));
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert!(window.query_by_label("Sample T-shirt").is_some(), "the start page");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Body pane").is_some());
}

#[test]
fn sides_of_the_view_cube_can_be_clicked() {
    let mut window = window();
    for (label, out) in [
        ("Orientation cube: left", glam::Vec3::X),
        ("Orientation cube: top", glam::Vec3::Y),
        ("Orientation cube: back", glam::Vec3::NEG_Z),
        ("Orientation cube: below", glam::Vec3::NEG_Y),
        ("Orientation cube: front", glam::Vec3::Z),
    ] {
        act(&mut window, label);
        assert!((app(&window).camera().towards_eye() - out).length() < 1e-5, "{label}");
    }
}

#[test]
fn figures_look_from_every_side_and_turn_perspective_off() {
    let mut window = window();
    let to_body = pane(&window, "Body pane").center();
    move_to(&mut window, to_body);
    for (modifiers, figure, out) in [
        (Modifiers::NONE, Key::Num3, glam::Vec3::NEG_X),
        (Modifiers::COMMAND, Key::Num3, glam::Vec3::X),
        (Modifiers::COMMAND, Key::Num1, glam::Vec3::NEG_Z),
        (Modifiers::COMMAND, Key::Num7, glam::Vec3::NEG_Y),
        (Modifiers::NONE, Key::Num7, glam::Vec3::Y),
        (Modifiers::NONE, Key::Num1, glam::Vec3::Z),
    ] {
        key(&mut window, modifiers, figure);
        assert!((app(&window).camera().towards_eye() - out).length() < 1e-5, "{figure:?}");
    }
    key(&mut window, Modifiers::NONE, Key::Num5);
    assert_eq!(app(&window).camera().projection, toile::render::Projection::Orthographic);
}

#[test]
fn what_is_selected_or_everything_is_brought_into_the_body_pane() {
    let mut window = window();
    paint_both(&mut window);
    let to_body = pane(&window, "Body pane").center();
    move_to(&mut window, to_body);
    key(&mut window, Modifiers::NONE, Key::Home);
    let whole = app(&window).camera().distance;
    window.get_by_label("body: select mark 1 on the body").click();
    window.run_steps(3);
    let to_body = pane(&window, "Body pane").center();
    move_to(&mut window, to_body);
    key(&mut window, Modifiers::NONE, Key::F);
    let near = app(&window).camera().distance;
    assert!(near < 0.9 * whole, "{near} {whole}");
    key(&mut window, Modifiers::NONE, Key::Home);
    let again = app(&window).camera().distance;
    // The side panel tells of the selected mark now, and takes a little of the pane's width for that.
    assert!((again / whole - 1.0).abs() < 0.02, "{again} {whole} {near}");
    key(&mut window, Modifiers::NONE, Key::Period);
    assert!(
        (app(&window).camera().distance / near - 1.0).abs() < 1e-3,
        "the key of the number block does the same"
    );
}

/// A window on its start page, with a list of files in `folder`.
fn start_window(folder: &std::path::Path) -> Window {
    let mut window = window_on(Project::default(), None);
    edit(&mut window, |app, ctx| {
        app.keep_preferences(ctx, folder.join("preferences.json"));
        app.begin_at_start_page();
    });
    window
}

#[test]
fn the_start_page_opens_samples_and_what_was_open_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("my shirt ü.toile");
    project_file::save(&path, &project()).expect("saved");
    let mut first = window_on(project(), None);
    edit(&mut first, |app, ctx| {
        app.keep_preferences(ctx, folder.path().join("preferences.json"));
        app.save_as(ctx, &path).expect("saved");
        app.save_as(ctx, &folder.path().join("gone.toile")).expect("saved");
    });
    std::fs::remove_file(folder.path().join("gone.toile")).expect("removed");
    let mut window = start_window(folder.path());
    for label in
        ["Tour: dressed in five steps", "New: an empty table", "Open…", "Sample T-shirt", "Sample Scarf"]
    {
        assert!(window.query_by_label(label).is_some(), "{label}");
    }
    let gone = window.get_by_label_contains("Open gone in");
    assert!(gone.accesskit_node().is_disabled(), "a file that is not there cannot be opened");
    key(&mut window, Modifiers::NONE, Key::Num1);
    assert!(window.query_by_label("Sample T-shirt").is_some(), "nor by its number");
    key(&mut window, Modifiers::NONE, Key::Num2);
    assert!(window.query_by_label("Sample T-shirt").is_none());
    assert_eq!(app(&window).session().document(), &project().document);
    menu(&mut window, "File", "Start page");
    window.get_by_label_contains("Open my shirt ü in");
    act(&mut window, "Clear");
    assert!(window.query_by_label_contains("Open my shirt").is_none());
    act(&mut window, "Sample Scarf");
    assert_eq!(app(&window).session().document().pattern.pieces.len(), 1);
    assert!(window.query_by_label("Pattern pane").is_some());
}

#[test]
fn a_file_opened_before_is_opened_from_the_menu_after_a_question() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("recent work.toile");
    let mut window = window();
    edit(&mut window, |app, ctx| {
        app.keep_preferences(ctx, folder.path().join("preferences.json"));
        app.save_as(ctx, &path).expect("saved");
    });
    let saved = app(&window).session().document().clone();
    let at = pane(&window, "Pattern pane").center();
    drag(&mut window, &[at], PointerButton::Primary);
    act(&mut window, "File");
    window.get_by_label_contains("Open recent").click();
    window.run_steps(4);
    window.get_by_label("Open again: recent work").click();
    window.run_steps(4);
    act(&mut window, "Don't save");
    assert_eq!(app(&window).session().document(), &saved);
}

#[test]
fn the_tour_goes_from_an_empty_table_to_a_dressed_body_and_begins_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = start_window(folder.path());
    act(&mut window, "Tour: dressed in five steps");
    window.get_by_label_contains("Flat pieces");
    act(&mut window, "Take the T-shirt's pieces");
    assert!(app(&window).session().document().pattern.pieces.len() >= 4);
    assert_eq!(counts(&window), [0, 0], "marks are the person's");
    act(&mut window, "Next");
    act(&mut window, "Skip this step");
    act(&mut window, "Back");
    window.get_by_label_contains("A mark on the cloth");
    act(&mut window, "Leave the tour");
    assert!(window.query_by_label("Leave the tour").is_none());
    menu(&mut window, "Help", "Tour");
    act(&mut window, "Don't save");
    assert!(window.query_by_label_contains("Flat pieces").is_some());
    for _ in 0..3 {
        act(&mut window, "Skip this step");
    }
    // On another pattern than the T-shirt's there is nothing to be painted; the step only waits.
    window.get_by_label("Paint all the marks");
    assert!(window.query_by_label("This step is done").is_none());
}

#[test]
fn preferences_change_at_once_are_kept_and_reset() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("preferences.json");
    let mut window = window();
    edit(&mut window, |app, ctx| app.keep_preferences(ctx, path.clone()));
    key(&mut window, Modifiers::COMMAND, Key::Comma);
    act(&mut window, "Inches");
    act(&mut window, "Light");
    assert_eq!(window.ctx.theme(), egui::Theme::Light);
    let panel = |window: &Window| window.ctx.style_of(egui::Theme::Dark).visuals.panel_fill;
    let dark = panel(&window);
    act(&mut window, "High contrast");
    assert_eq!((window.ctx.theme(), panel(&window)), (egui::Theme::Dark, egui::Color32::BLACK));
    assert!(std::fs::read_to_string(&path).expect("kept").contains("high_contrast"));
    act(&mut window, "Light");
    assert_eq!((window.ctx.theme(), panel(&window)), (egui::Theme::Light, dark));
    act(&mut window, "Size of everything: 100 %");
    act(&mut window, "150 %");
    assert!((window.ctx.zoom_factor() - 1.5).abs() < 1e-6);
    let kept = std::fs::read_to_string(&path).expect("kept");
    for word in ["inch", "light", "150"] {
        assert!(kept.contains(word), "{word} in {kept}");
    }
    act(&mut window, "Reset this page");
    assert!((window.ctx.zoom_factor() - 1.0).abs() < 1e-6);
    // The page finds its place at the other size.
    window.run_steps(3);
    act(&mut window, "Done");
    assert!(window.query_by_label("Reset this page").is_none());
}

#[test]
fn a_key_is_given_to_another_action_after_a_warning() {
    let mut window = window();
    key(&mut window, Modifiers::COMMAND, Key::Comma);
    act(&mut window, "Keys");
    window.get_by_label("Find an action").focus();
    window.run_steps(2);
    type_into(&mut window, "wireframe");
    window.get_by_label_contains("Key of Wireframe").click();
    window.run_steps(3);
    key(&mut window, Modifiers::NONE, Key::L);
    assert!(window.query_by_label_contains("is the key of Laser already").is_some());
    act(&mut window, "Use it for Wireframe");
    assert!(window.query_by_label("Key of Wireframe: L").is_some());
    act(&mut window, "Done");
    key(&mut window, Modifiers::NONE, Key::L);
    let on = |window: &Window| {
        window.get_by_label("Wireframe").accesskit_node().toggled() == Some(egui::accesskit::Toggled::True)
    };
    assert!(on(&window));
    key(&mut window, Modifiers::NONE, Key::L);
    assert!(!on(&window), "the new key");
    assert!(window.get_by_label("Laser").accesskit_node().toggled() != Some(egui::accesskit::Toggled::True));
}

#[test]
fn a_click_in_the_history_goes_there_and_back() {
    let mut window = window();
    for x in [-60.0, 0.0, 60.0] {
        let at = pane(&window, "Pattern pane").center() + Vec2::new(x, 0.0);
        drag(&mut window, &[at], PointerButton::Primary);
    }
    menu(&mut window, "View", "History");
    let steps = |window: &Window| window.get_all_by_label_contains("Step ").count();
    assert_eq!(steps(&window), 4);
    act(&mut window, "Step As it was opened");
    assert_eq!(counts(&window), [0, 0]);
    assert_eq!(steps(&window), 4, "what was undone is still there");
    window.get_by_label_contains("Step 2").click();
    window.run_steps(4);
    assert_eq!(counts(&window), [2, 0]);
}

#[test]
fn what_was_told_is_read_again_and_copied() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window();
    edit(&mut window, |app, ctx| app.save_as(ctx, &folder.path().join("a.toile")).expect("saved"));
    menu(&mut window, "View", "Messages");
    assert!(window.query_all_by_label_contains("Written:").count() >= 2, "over the panes, and in the list");
    window.get_by_label("Copy all").click();
    let mut copied = String::new();
    for _ in 0..4 {
        window.run_steps(1);
        for command in &window.output().platform_output.commands {
            if let egui::OutputCommand::CopyText(text) = command {
                copied.clone_from(text);
            }
        }
    }
    assert!(copied.contains("Written:"), "{copied:?}");
}

#[test]
fn files_held_over_the_window_are_told_what_becomes_of_them() {
    let mut window = window();
    let hold = |window: &mut Window, name: Option<&str>| {
        let files = name.map(|name| egui::HoveredFile { path: Some(name.into()), ..Default::default() });
        window.input_mut().hovered_files = files.into_iter().collect();
        window.run_steps(2);
    };
    for (name, left, right) in [
        ("a/front.dxf", "Lay the pieces of front.dxf on the table", "Nothing changes here"),
        ("a/anna.obj", "Nothing changes here", "anna.obj becomes the body"),
        ("a/shirt.toile", "Open the project shirt.toile", "with its body and cloth"),
        ("a/photo.jpg", "Take the image photo.jpg into the project", "Nothing changes here"),
        ("a/garden.hdr", "Nothing changes here", "garden.hdr lights the scene"),
        (
            "a/photo.gif",
            "photo.gif: not a project",
            "nor a body (.obj, .glb, .gltf), image (.png, .jpg) or environment map (.hdr)",
        ),
    ] {
        hold(&mut window, Some(name));
        window.get_by_label_contains(&format!("pattern pane: {left}"));
        window.get_by_label_contains(&format!("body pane: {right}"));
    }
    hold(&mut window, None);
    assert!(window.query_by_label_contains("pattern pane: ").is_none());
}

#[test]
fn losing_the_pointer_or_the_window_ends_every_drag_in_the_body_pane() {
    for lost in [Event::PointerGone, Event::WindowFocused(false)] {
        for with in [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle] {
            let mut window = window();
            let path = line(pane(&window, "Body pane"), Vec2::new(60.0, 0.0));
            press_along(&mut window, &path, with);
            window.event(lost.clone());
            window.run_steps(2);
            let camera = app(&window).camera();
            for &at in &path {
                move_to(&mut window, at);
            }
            assert_eq!(app(&window).camera(), camera, "{with:?} {lost:?}");
            assert!(counts(&window)[1] <= 1);
        }
    }
}

/// Long reasons made the rows wider than the palette, and shortened the names.
#[test]
fn a_reason_gives_way_to_the_name_of_its_command() {
    let mut window = window();
    edit(&mut window, |app, _| app.follow_language("de".to_owned()));
    key(&mut window, Modifiers::NONE, Key::F3);
    type_into(&mut window, "Schleife");
    let [field, row] = ["Befehl suchen", "Schleife…"].map(|label| window.get_by_label_contains(label).rect());
    assert!(row.left() >= field.left() - 8.0 && row.right() <= field.right() + 8.0, "{row} beside {field}");
}

#[test]
fn the_palette_opens_over_the_start_page_and_escape_closes_it_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = start_window(folder.path());
    let is_there = |window: &Window, label: &str| window.query_by_label(label).is_some();
    key(&mut window, Modifiers::COMMAND, Key::P);
    assert!(is_there(&window, "Find a command") && is_there(&window, "Tour: dressed in five steps"));
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!is_there(&window, "Find a command") && is_there(&window, "Tour: dressed in five steps"));
    key(&mut window, Modifiers::NONE, Key::F3);
    type_into(&mut window, "scarf");
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert!(!is_there(&window, "Tour: dressed in five steps"));
    assert!(!app(&window).session().document().pattern.pieces.is_empty(), "the sample is open");
}

#[test]
fn nothing_is_drawn_on_a_start_page_that_is_left_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = start_window(folder.path());
    window.run_steps(30);
    let root = &window.output().viewport_output[&egui::ViewportId::ROOT];
    assert!(root.repaint_delay > Duration::from_secs(3600), "asks for a frame in {:?}", root.repaint_delay);
}

#[test]
fn a_picture_of_any_size_is_written_with_nothing_behind_it() {
    let Some(device) = egui_wgpu_device() else { return };
    if super::hand::has_file_dialogs() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_on(project(), Some(device));
    key(&mut window, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::P);
    act(&mut window, "none: transparent, without floor");
    act(&mut window, "Choose a file…");
    window.get_by_role(egui::accesskit::Role::TextInput).focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.run_steps(1);
    let path = folder.path().join("ball.png");
    window.get_by_role(egui::accesskit::Role::TextInput).type_text(&path.display().to_string());
    window.run_steps(2);
    act(&mut window, "Write");
    let picture = image::open(&path).expect("a picture").to_rgba8();
    let pane = pane(&window, "Body pane");
    assert_eq!(picture.width(), pane.width().round() as u32);
    let alpha = |x: u32, y: u32| picture.get_pixel(x, y)[3];
    assert_eq!(alpha(0, 0), 0, "nothing behind it");
    assert_eq!(alpha(picture.width() / 2, picture.height() / 2), 255, "the ball");
}

#[test]
fn f6_goes_through_panes_and_bars_and_round_and_with_shift_back() {
    let mut window = window();
    let focused = |window: &Window| {
        let id = window.ctx.memory(|m| m.focused());
        let labels = ["Pattern pane", "Body pane", "Marks", "Mark", "Move", "File"];
        let known = labels.into_iter().find(|label| {
            window.query_all_by_label(label).any(|node| node.accesskit_node().is_focused()) && id.is_some()
        });
        known.or(id.map(|_| "something"))
    };
    let mut seen = Vec::new();
    for _ in 0..6 {
        key(&mut window, Modifiers::NONE, Key::F6);
        seen.push(focused(&window).unwrap_or("nothing"));
    }
    // After the toolbar the strip of tools, the small buttons of the body pane and the menus.
    assert_eq!(seen, ["Pattern pane", "Body pane", "Marks", "Mark", "Move", "something"]);
    for _ in 0..2 {
        key(&mut window, Modifiers::NONE, Key::F6);
        seen.push(focused(&window).unwrap_or("nothing"));
    }
    assert_eq!(seen[6..], ["File", "Pattern pane"]);
    seen.clear();
    for _ in 0..7 {
        key(&mut window, Modifiers::SHIFT, Key::F6);
        seen.push(focused(&window).unwrap_or("nothing"));
    }
    assert_eq!(seen, ["File", "something", "Move", "Mark", "Marks", "Body pane", "Pattern pane"]);
    // From anywhere in a bar it goes on to the next one.
    (0..3).for_each(|_| key(&mut window, Modifiers::NONE, Key::F6));
    assert_eq!(focused(&window), Some("Mark"));
    key(&mut window, Modifiers::NONE, Key::Tab);
    assert_eq!(focused(&window), Some("something"));
    key(&mut window, Modifiers::NONE, Key::F6);
    assert_eq!(focused(&window), Some("Move"));
}

#[test]
fn esc_leads_from_bars_back_to_the_pane_and_closes_those_over_it() {
    let mut window = window();
    let is_focused = |window: &Window, label: &str| {
        window.query_all_by_label(label).any(|node| node.accesskit_node().is_focused())
    };
    let go = |window: &mut Window, held: Modifiers, times: usize| {
        (0..times).for_each(|_| key(window, held, Key::F6));
    };
    go(&mut window, Modifiers::NONE, 4);
    assert!(is_focused(&window, "Mark"), "the first of the toolbar");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(is_focused(&window, "Body pane"), "the pane that had it last");
    go(&mut window, Modifiers::SHIFT, 5);
    assert!(is_focused(&window, "Mark"), "past the pattern pane");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(is_focused(&window, "Pattern pane"));
    super::environment::from_theme(&mut window, "Depth of field");
    for _ in 0..12 {
        if !is_focused(&window, "Aperture") {
            go(&mut window, Modifiers::NONE, 1);
        }
    }
    assert!(is_focused(&window, "Aperture"), "the bar over the body pane is in the round");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Aperture").is_none(), "it is closed");
    assert!(is_focused(&window, "Body pane"));
}

#[test]
fn lines_join_the_pairs_of_marks_until_they_are_hidden() {
    let mut window = window();
    paint_both(&mut window);
    let lines = |window: &mut Window| {
        window.run_steps(2);
        let shapes = &window.output().shapes;
        let is_curve = |shape: &egui::Shape| matches!(shape, egui::Shape::CubicBezier(_));
        shapes.iter().filter(|clipped| is_curve(&clipped.shape)).count()
    };
    // There are other curves, the pieces' own.
    let with = lines(&mut window);
    menu(&mut window, "View", "Pair lines");
    assert_eq!(lines(&mut window) + 1, with);
    menu(&mut window, "View", "Pair lines");
    assert_eq!(lines(&mut window), with);
}

#[test]
fn panes_are_swapped_and_one_takes_the_whole_window() {
    let mut window = window();
    let whole = pane(&window, "Pattern pane").union(pane(&window, "Body pane"));
    assert!(pane(&window, "Pattern pane").right() <= pane(&window, "Body pane").left());
    key(&mut window, Modifiers::NONE, Key::F10);
    assert!(window.query_by_label("Pattern pane").is_none());
    assert!(pane(&window, "Body pane").width() >= whole.width());
    key(&mut window, Modifiers::NONE, Key::F9);
    assert!(window.query_by_label("Body pane").is_none());
    // Keys of the pane that is not there go nowhere.
    key(&mut window, Modifiers::NONE, Key::F6);
    key(&mut window, Modifiers::NONE, Key::F6);
    assert!(window.query_by_label("Body pane").is_none());
    key(&mut window, Modifiers::NONE, Key::F9);
    assert!(window.query_by_label("Body pane").is_some(), "chosen again, both come back");
    window.get_by_label("View").click();
    window.run_steps(3);
    window.get_by_label_contains("Panes").click();
    window.run_steps(3);
    window.get_by_label_contains("Body on the left").click();
    window.run_steps(4);
    assert!(pane(&window, "Body pane").right() <= pane(&window, "Pattern pane").left());
    // The body is still painted on where it now is.
    paint_both(&mut window);
    assert_eq!(counts(&window), [1, 1]);
}

#[test]
fn a_window_of_any_size_and_shape_is_drawn() {
    let mut window = window_on(project(), egui_wgpu_device());
    paint_both(&mut window);
    let sizes =
        [[1.0, 1.0], [1280.0, 1.0], [1.0, 900.0], [16384.0, 1.0], [90.0, 60.0], [300.0, 200.0], [0.0, 0.0]];
    for _ in 0..4 {
        for [width, height] in sizes {
            window.set_size(Vec2::new(width, height));
            window.run_steps(2);
        }
        window.set_size(Vec2::new(1280.0, 720.0));
        window.run_steps(2);
    }
    assert!(pane(&window, "Pattern pane").width() > 200.0 && pane(&window, "Body pane").width() > 200.0);
    // Everything is where it was.
    paint_both(&mut window);
    assert_eq!(counts(&window), [2, 2]);
}

/// On a screen of 1366 × 768 with text at 200 % the right end of the toolbar lay over its main button.
#[test]
fn buttons_of_a_narrow_window_lie_beside_or_above_each_other() {
    let mut window = window();
    let toolbar = |window: &Window, within: Rect| {
        let [top, bottom] = [window.get_by_label("File").rect().bottom(), pane(window, "Pattern pane").top()];
        let is_there = |rect: &Rect| rect.top() >= top && rect.bottom() <= bottom;
        let buttons = window.get_all_by_role(Role::Button).map(|node| node.rect()).filter(is_there);
        let mut found: Vec<Rect> = buttons.collect();
        assert_eq!(found.len(), 12, "at {within}");
        found.push(window.get_by_label("Map: No map").rect());
        found
    };
    for (width, height) in [(1366.0, 768.0), (911.0, 512.0), (683.0, 384.0), (640.0, 500.0)] {
        window.set_size(Vec2::new(width, height));
        window.run_steps(6);
        let within = Rect::from_min_size(Pos2::ZERO, Vec2::new(width, height));
        let tools = toolbar(&window, within);
        for name in ["Wrap", "Drape", "Undo", "Side panel"] {
            assert!(tools.contains(&window.get_by_label(name).rect()), "{name} at {within}");
        }
        are_apart(&tools, within);
        let body = pane(&window, "Body pane");
        let names = ["Wireframe", "See through the body", "X-ray", "Show all"];
        are_apart(&names.map(|name| window.get_by_label(name).rect()), body);
    }
    window.set_size(Vec2::new(1366.0, 768.0));
    window.run_steps(6);
    let tools = toolbar(&window, Rect::EVERYTHING);
    assert!(
        tools.iter().all(|rect| (rect.center().y - tools[0].center().y).abs() < 1.0),
        "one row: {tools:?}"
    );
}

/// German words are longer: there were two rows.
#[test]
fn the_toolbar_takes_one_row_in_a_window_of_1024_points() {
    for (language, maps, widest, names) in [
        (
            "en",
            "Map: No map",
            "Weft strain: across the grain",
            ["Undo", "Redo", "Show the cloth", "Side panel"],
        ),
        (
            "de",
            "Karte: Keine Karte",
            "Schussdehnung: quer zum Fadenlauf",
            ["Rückgängig", "Wiederholen", "Stoff zeigen", "Seitenleiste"],
        ),
    ] {
        let mut window = super::hand::dressed_window();
        edit(&mut window, |app, _| app.follow_language(language.to_owned()));
        window.set_size(Vec2::new(1024.0, 768.0));
        window.run_steps(6);
        let assert_one_row = |window: &Window| {
            let title = maps.split(' ').next().expect("a word");
            let is_chooser = |label: Option<String>| label.is_some_and(|label| label.starts_with(title));
            let mut lists = window.query_all_by_role(Role::ComboBox);
            let chooser = lists.find(|list| is_chooser(list.accesskit_node().label())).expect("it").rect();
            let is_beside = |rect: &Rect| (rect.center().y - chooser.center().y).abs() < 1.0;
            let buttons = window.get_all_by_role(Role::Button).map(|node| node.rect()).filter(is_beside);
            let mut row: Vec<Rect> = buttons.collect();
            assert_eq!(row.len(), 12, "{language}: {row:?} beside {chooser}");
            row.push(chooser);
            are_apart(&row, Rect::from_min_size(Pos2::ZERO, Vec2::new(1024.0, 768.0)));
            for name in names {
                assert!(row.contains(&window.get_by_role_and_label(Role::Button, name).rect()), "{name}");
            }
        };
        assert_one_row(&window);
        act(&mut window, maps);
        act(&mut window, widest);
        window.run_steps(4);
        assert_one_row(&window);
    }
}

/// Asserts that no two of `rects` overlap and that all lie in `within`.
fn are_apart(rects: &[Rect], within: Rect) {
    for (i, rect) in rects.iter().enumerate() {
        assert!(within.contains_rect(*rect), "{rect} in {within}");
        for other in &rects[..i] {
            assert!(!rect.shrink(0.5).intersects(*other), "{rect} and {other} at {within}");
        }
    }
}
