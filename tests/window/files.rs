//! Files and what would be lost.

use std::path::Path;

use super::*;

/// Chooses `entry` of the file menu and types the path of the file. False where the desktop has a dialog of its own.
fn read_file(window: &mut Window, entry: &str, path: &Path) -> bool {
    read_by(window, "File", entry, path)
}

/// The same by any menu.
pub fn read_by(window: &mut Window, menu: &str, entry: &str, path: &Path) -> bool {
    super::hand::choose(window, menu, entry);
    if super::hand::has_file_dialogs() {
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
fn the_field_of_a_path_is_named_apart_from_the_kind_of_file() {
    let mut window = super::hand::dressed_window();
    super::hand::choose(&mut window, "File", "Save as…");
    if super::hand::has_file_dialogs() {
        return;
    }
    let field = window.query_by_role_and_label(egui::accesskit::Role::TextInput, "Path of the file");
    assert!(field.is_some());
    assert!(window.query_by_label("Toile project (.toile)").is_some());
}

#[test]
fn a_path_that_is_typed_replaces_the_suggested_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = super::hand::dressed_window();
    for (name, is_written) in [("nowhere/mine.toile", false), ("mine.toile", true)] {
        super::hand::choose(&mut window, "File", "Save as…");
        if super::hand::has_file_dialogs() {
            return;
        }
        let path = folder.path().join(name);
        window.event(Event::Text(path.display().to_string()));
        window.run_steps(2);
        act(&mut window, "Write");
        if is_written {
            wait(&mut window, "the project to be written", |_| path.is_file());
        } else {
            super::environment::wait_for_words(&mut window, "Your work is kept here.");
            assert!(window.query_by_label_contains("is as it was").is_none(), "it never was");
            act(&mut window, "Cancel");
        }
    }
}

#[test]
fn enter_takes_the_path_and_a_file_that_is_there_is_asked_about() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.toile");
    std::fs::write(&path, "mine").expect("a file");
    let mut window = super::hand::dressed_window();
    for answer in ["Cancel", "Replace it"] {
        super::hand::choose(&mut window, "File", "Save as…");
        if super::hand::has_file_dialogs() {
            return;
        }
        window.get_by_role(egui::accesskit::Role::TextInput).focus();
        window.run_steps(2);
        // A name is proposed.
        window.key_press_modifiers(Modifiers::COMMAND, Key::A);
        window.run_steps(1);
        window.get_by_role(egui::accesskit::Role::TextInput).type_text(&path.display().to_string());
        window.run_steps(2);
        key(&mut window, Modifiers::NONE, Key::Enter);
        window.run_steps(3);
        assert!(window.query_by_label("Replace the file?").is_some(), "before {answer}");
        assert_eq!(std::fs::read_to_string(&path).expect("text"), "mine");
        window.get_by_label(answer).click();
        window.run_steps(6);
    }
    wait(&mut window, "the project to be written", |_| {
        std::fs::read(&path).is_ok_and(|bytes| bytes != b"mine")
    });
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
fn the_body_is_led_to_its_pose_in_a_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("turned.obj");
    let mut mesh = ball(0.25);
    let turn = glam::DQuat::from_rotation_y(1.0);
    // In centimetres: the sides of its triangles tell.
    mesh.positions.iter_mut().for_each(|p| *p = turn * *p * 100.0);
    std::fs::write(&path, toile::io::obj::mesh("turned", &mesh)).expect("a file");
    let mut window = window();
    let body = |window: &Window| app(window).session().document().body.clone();
    let before = body(&window);
    if !read_file(&mut window, "Pose from a file…", &path) {
        return;
    }
    assert_eq!(app(&window).session().undo_label(), Some("choose a pose"));
    window.get_by_label("Pose").click();
    window.run_steps(8);
    let label = "On the way to the pose of the file";
    window.get_by_role_and_label(egui::accesskit::Role::Slider, label).scroll_to_me();
    window.run_steps(8);
    let rail = window.get_by_role_and_label(egui::accesskit::Role::Slider, label).rect();
    let from = Pos2::new(rail.left() + 6.0, rail.center().y);
    let path: Vec<Pos2> = (0..8).map(|i| from + Vec2::new(7.0 * i as f32, 0.0)).collect();
    drag(&mut window, &path, PointerButton::Primary);
    window.run_steps(4);
    let angle = |window: &Window| {
        let there = app(window).session().surface().expect("a body").mesh.positions[30];
        let here = ball(0.25).positions[30];
        DVec2::new(here.x, here.z).angle_to(DVec2::new(there.x, there.z)).abs()
    };
    assert!((0.1..0.9).contains(&angle(&window)), "{}", angle(&window));
    let far: Vec<Pos2> = (0..8).map(|i| path[7] + Vec2::new(60.0 * i as f32, 0.0)).collect();
    drag(&mut window, &far, PointerButton::Primary);
    window.run_steps(4);
    assert!((angle(&window) - 1.0).abs() < 1e-6, "{}", angle(&window));
    for _ in 0..2 {
        key(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(body(&window), before);
    // Another body is no pose of this one.
    let other = folder.path().join("other.obj");
    std::fs::write(&other, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        .expect("it");
    assert!(read_file(&mut window, "Pose from a file…", &other));
    assert!(window.query_by_label_contains("is not ball in another pose").is_some());
}

/// A hip and a left upper leg that swings forth.
const SWING: &str = "HIERARCHY
ROOT Hips
{
  OFFSET 0 90 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT LeftUpLeg
  {
    OFFSET 9 -5 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 -40 0
    }
  }
}
MOTION
Frames: 41
Frame Time: 0.05
";

#[test]
fn the_mannequin_is_led_through_a_motion() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("swing.bvh");
    let rows: String = (0..41).map(|i| format!("0 90 0 0 0 0 0 -{i} 0\n")).collect();
    std::fs::write(&path, format!("{SWING}{rows}")).expect("a file");
    let mut window = window_on(Project::default(), None);
    if !read_file(&mut window, "Pose from a file…", &path) {
        return;
    }
    assert!(window.query_by_label_contains("that nothing moves: spine").is_some());
    window.get_by_label("Pose").click();
    window.run_steps(8);
    window.get_by_role_and_label(egui::accesskit::Role::Slider, "Frame of the motion").scroll_to_me();
    window.run_steps(8);
    let rail = window.get_by_role_and_label(egui::accesskit::Role::Slider, "Frame of the motion").rect();
    let path: Vec<Pos2> =
        (0..8).map(|i| Pos2::new(rail.left() + 6.0 + 80.0 * i as f32, rail.center().y)).collect();
    drag(&mut window, &path, PointerButton::Primary);
    window.run_steps(4);
    let pose = app(&window).session().document().body.pose().expect("the mannequin");
    let (axis, angle) = pose.turn("hip_left").to_axis_angle();
    assert!((angle.to_degrees() - 40.0).abs() < 1e-6 && axis.x < -0.99, "{axis} {angle}");
    let bytes = "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 zero 0\n";
    let odd = folder.path().join("odd.bvh");
    std::fs::write(&odd, bytes).expect("a file");
    assert!(read_file(&mut window, "Pose from a file…", &odd));
    assert!(window.query_by_label_contains("line 4: \"zero\" is no number").is_some());
}

#[test]
fn the_mannequin_is_built_to_a_size_of_a_table() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("women.csv");
    std::fs::write(&path, "size,height,bust,waist,hip\n36,168,84,66,90\n60,172,190,,\n").expect("a file");
    let mut window = window_on(Project::default(), None);
    if !read_file(&mut window, "Sizes from a table…", &path) {
        return;
    }
    assert!(window.query_by_label_contains("listed in Measures of the body").is_some());
    window.get_by_label("Measures of the body").click();
    window.run_steps(8);
    let choose = |window: &mut Window, size: &str| {
        window.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Size").scroll_to_me();
        window.run_steps(8);
        window.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Size").click();
        window.run_steps(4);
        window.get_by_label(size).click();
        window.run_steps(8);
    };
    choose(&mut window, "60");
    assert_eq!(app(&window).session().undo_label(), None, "no mannequin has this size");
    window.key_press(egui::Key::Escape);
    window.run_steps(4);
    choose(&mut window, "36");
    let measurements = app(&window).session().document().body.measurements().expect("the mannequin");
    assert_eq!((measurements.height, measurements.hip), (1.68, 0.9));
    assert_eq!(app(&window).session().undo_label(), Some("change the size"));
    std::fs::write(&path, "size,bust\n36,wide\n").expect("a file");
    assert!(read_file(&mut window, "Sizes from a table…", &path));
    assert!(window.query_by_label_contains("row 2, column 2 (bust): \"wide\" is no length").is_some());
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
    if super::hand::has_file_dialogs() {
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

/// Chooses `entry` of the file menu and types the path of the file to be written. False where the desktop has a dialog of its own.
fn write_file(window: &mut Window, entry: &str, path: &Path) -> bool {
    super::hand::choose(window, "File", entry);
    write_asked(window, path)
}

/// Types the path of the file to be written into the dialog that asks for it. False where the desktop has a dialog of its own.
pub fn write_asked(window: &mut Window, path: &Path) -> bool {
    write_by(window, "Write", path)
}

/// As [`write_asked`], where the button that writes is called `button`.
pub fn write_by(window: &mut Window, button: &str, path: &Path) -> bool {
    if super::hand::has_file_dialogs() {
        return false;
    }
    window.get_by_role(egui::accesskit::Role::TextInput).focus();
    window.run_steps(2);
    key(window, Modifiers::COMMAND, Key::A);
    window.get_by_role(egui::accesskit::Role::TextInput).type_text(&path.display().to_string());
    window.run_steps(2);
    window.get_by_label(button).click();
    true
}

#[test]
fn a_fine_picture_is_drawn_tile_by_tile_and_can_be_stopped() {
    let Some(device) = egui_wgpu_device() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_on(project(), Some(device));
    let begin = |window: &mut Window, times: u32, name: &str| {
        key(window, Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
        window.run_steps(3);
        window.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Smoothness").click();
        window.run_steps(3);
        window.get_by_label(&format!("{times} × {times} samples for each pixel")).click();
        window.run_steps(3);
        window.get_by_label("Choose a file…").click();
        window.run_steps(3);
        write_asked(window, &folder.path().join(name))
    };
    if !begin(&mut window, 4, "fine.png") {
        return;
    }
    let path = folder.path().join("fine.png");
    let shows_progress = |window: &mut Window| {
        (0..10).any(|_| {
            window.run_steps(1);
            window.query_by_label("The picture is being drawn").is_some()
        })
    };
    assert!(shows_progress(&mut window) && !path.exists());
    let since = std::time::Instant::now();
    while !path.exists() && since.elapsed().as_secs() < 120 {
        window.run_steps(1);
    }
    window.run_steps(2);
    let picture = image::open(&path).expect("a PNG");
    assert!(picture.width() > 300 && window.query_by_label_contains("Written: ").is_some());
    assert!(begin(&mut window, 8, "stopped.png") && shows_progress(&mut window));
    window.get_by_label("Stop").click();
    window.run_steps(3);
    assert!(window.query_by_label("The picture was stopped: nothing is written").is_some());
    assert!(!folder.path().join("stopped.png").exists());
}

#[test]
fn the_fit_report_is_written_where_it_is_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fit.html");
    let mut window = super::hand::dressed_window();
    if !write_file(&mut window, "Fit report…", &path) {
        return;
    }
    // A picture a frame, where there is an adapter.
    window.run_steps(30);
    let page = std::fs::read_to_string(&path).expect("the page");
    assert!(page.contains("Garment and body") && page.ends_with("</html>"));
    assert!(window.query_by_label_contains("Written: ").is_some());
}

#[test]
fn a_garment_as_obj_has_its_materials_beside_it_and_replaces_nothing_unasked() {
    let folder = tempfile::tempdir().expect("a folder");
    let there = |name: &str| folder.path().join(name);
    let (path, materials) = (there("cloth.obj"), there("cloth.mtl"));
    std::fs::write(&materials, "of another").expect("a file");
    let mut window = super::hand::dressed_window();
    if !write_file(&mut window, "Export…", &path) {
        return;
    }
    window.run_steps(3);
    assert!(window.query_by_label_contains("would be replaced: cloth.mtl").is_some());
    window.get_by_label("Cancel").click();
    window.run_steps(3);
    assert!(!path.exists(), "all of it or nothing");
    assert_eq!(std::fs::read_to_string(&materials).expect("the file"), "of another");
    assert!(write_file(&mut window, "Export…", &path));
    window.run_steps(3);
    window.get_by_label("Replace them").click();
    window.run_steps(3);
    let text = std::fs::read_to_string(&path).expect("the cloth");
    assert!(text.contains("mtllib cloth.mtl\n") && text.contains("o Square\nusemtl "));
    let text = std::fs::read_to_string(&materials).expect("the materials");
    assert!(text.contains("map_Kd cloth-colour.png\n") && text.contains("norm cloth-normal.png\n"), "{text}");
    for name in ["cloth-colour.png", "cloth-normal.png"] {
        assert_eq!(image::image_dimensions(there(name)).expect("a picture"), (2048, 2048), "{name}");
    }
    assert!(window.query_by_label_contains("Written: ").is_some());
    // Beside another name nothing is in the way.
    assert!(write_file(&mut window, "Export…", &there("other.obj")));
    window.run_steps(3);
    assert!(there("other.mtl").exists() && window.query_by_label("Replace them").is_none());
}

/// Chooses File › Tech pack… in German, to be written to `path`. False where the desktop has a dialog of its own.
fn begin_tech_pack(window: &mut Window, path: &Path) -> bool {
    super::hand::choose(window, "File", "Tech pack…");
    window.get_by_label("In which language is the tech pack to be?");
    act(window, "Deutsch");
    act(window, "Choose a file…");
    let writes = write_asked(window, path);
    let is_making = |window: &Window| window.query_by_label("The tech pack is being made").is_some();
    for _ in 0..6 {
        if !is_making(window) {
            window.run_steps(1);
        }
    }
    writes
}

#[test]
fn the_tech_pack_is_made_behind_the_window() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("pack.pdf");
    let mut window = super::hand::dressed_window();
    if !begin_tech_pack(&mut window, &path) {
        return;
    }
    assert!(window.query_by_label("The tech pack is being made").is_some(), "the progress is shown");
    let since = std::time::Instant::now();
    while !path.exists() && since.elapsed().as_secs() < 120 {
        window.run_steps(1);
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    window.run_steps(2);
    let pdf = lopdf::Document::load(&path).expect("a PDF");
    let words = pdf.extract_text(&[1]).expect("words");
    assert!(words.contains("Produktionsblatt") && !words.contains("Tech pack"), "{words}");
    assert!(words.contains("unbenannt") && !words.contains("untitled"), "{words}");
    assert!(window.query_by_label_contains("Written: ").is_some());
    assert!(window.query_by_label("The tech pack is being made").is_none());
}

#[test]
fn a_tech_pack_that_is_stopped_writes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("pack.pdf");
    let mut window = super::hand::dressed_window();
    if !begin_tech_pack(&mut window, &path) {
        return;
    }
    window.get_by_label("Stop").click_accesskit();
    window.run_steps(2);
    assert!(window.query_by_label_contains("The tech pack was stopped: nothing is written").is_some());
    std::thread::sleep(Duration::from_millis(500));
    window.run_steps(4);
    assert!(!path.exists() && window.query_by_label("The tech pack is being made").is_none());
}
