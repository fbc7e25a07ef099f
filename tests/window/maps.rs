//! Maps over the cloth: chosen, read, ranged, told in figures, burnt into pictures; and free when none is shown.

use egui::accesskit::Role;
use toile::session::samples::Sample;
use toile::session::{Dressed, project_file};

use super::files::read_by;
use super::hand::dressed_window;
use super::lists::{is_at, type_letters};
use super::*;

fn choose(window: &mut Window, entry: &str) {
    for label in ["View", "Map", entry] {
        window.get_by_label(label).click();
        window.run_steps(4);
    }
}

fn has(window: &Window, words: &str) -> bool {
    window.query_by_label_contains(words).is_some()
}

#[test]
fn a_map_is_worked_out_once_and_none_costs_nothing() {
    let mut window = dressed_window();
    window.run_steps(10);
    assert_eq!(app(&window).maps(), 0, "no map is shown");
    choose(&mut window, "Ease: gap to the body");
    assert_eq!(app(&window).maps(), 1);
    window.run_steps(30);
    assert_eq!(app(&window).maps(), 1, "the cloth lies still");
    choose(&mut window, "Warp strain: along the grain");
    assert_eq!(app(&window).maps(), 2);
    // Cloth that changes is read anew as long as the map is shown.
    key(&mut window, Modifiers::COMMAND, Key::Z);
    wait(&mut window, "the undo", |app| !app.session().snapshot().is_dressed());
    key(&mut window, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    wait(&mut window, "the redo", |app| app.session().snapshot().is_dressed());
    window.run_steps(2);
    let read = app(&window).maps();
    assert!(read > 2, "the cloth came back");
    window.get_by_label("Close the map").click();
    window.run_steps(3);
    assert!(!has(&window, "Legend"));
    key(&mut window, Modifiers::COMMAND, Key::Z);
    wait(&mut window, "the undo", |app| !app.session().snapshot().is_dressed());
    assert_eq!(app(&window).maps(), read, "nothing is read off when nothing is shown");
}

#[test]
fn a_map_is_found_by_a_few_letters_and_waits_for_cloth() {
    let mut window = window();
    window.get_by_label("View").click();
    window.run_steps(4);
    window.get_by_label("Map").click();
    window.run_steps(4);
    assert!(window.get_by_label("Shear").accesskit_node().is_disabled(), "there is no cloth");
    let mut window = dressed_window();
    key(&mut window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text("map shear".to_owned()));
    window.run_steps(3);
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert!(has(&window, "Legend: Shear"));
    for (button, entry) in [("Map: Shear", "Mean curvature"), ("Map: Curvature", "No map")] {
        window.get_by_label(button).click();
        window.run_steps(4);
        window.get_by_label(entry).click();
        window.run_steps(4);
    }
    assert!(!has(&window, "Legend") && window.query_by_label("Map: No map").is_some());
}

#[test]
fn the_value_under_the_pointer_is_told_in_both_panes() {
    let mut window = dressed_window();
    choose(&mut window, "Ease: gap to the body");
    let body = pane(&window, "Body pane").center();
    move_to(&mut window, body);
    window.run_steps(2);
    let told = window.get_by_label_contains(" mm, Square");
    let words = told.accesskit_node().value().expect("what the label says");
    let ease: f64 = words.split(' ').next().and_then(|v| v.parse().ok()).expect("a number");
    let skin = Surface::new(ball(0.25)).expect("a ball");
    let cloth = &app(&window).session().snapshot().cloth.positions;
    let from_middle = |p: &&DVec3| p.distance(DVec3::Z * 0.25);
    let under = cloth.iter().min_by(|p, q| from_middle(p).total_cmp(&from_middle(q))).expect("cloth");
    let there = skin.nearest(*under).distance * 1000.0;
    assert!((ease - there).abs() < 3.0, "{ease} mm told, {there} mm beside it");
    let off = pane(&window, "Body pane").left_top() + Vec2::splat(6.0);
    move_to(&mut window, off);
    window.run_steps(2);
    assert!(!has(&window, " mm, Square"), "beside the cloth");
}

#[test]
fn the_range_is_set_by_hand_and_comes_back() {
    let mut window = dressed_window();
    choose(&mut window, "Ease: gap to the body");
    let legend = |window: &Window| {
        window.get_by_label_contains("Legend:").accesskit_node().label().expect("a label").clone()
    };
    let automatic = legend(&window);
    window.get_by_label("Automatic range").click();
    window.run_steps(3);
    assert_eq!(legend(&window), automatic, "what it was is where one begins");
    let field = window.get_by_label("Range to");
    field.click();
    window.run_steps(3);
    key(&mut window, Modifiers::COMMAND, Key::A);
    window.event(Event::Text("60".to_owned()));
    key(&mut window, Modifiers::NONE, Key::Enter);
    window.run_steps(3);
    assert!(legend(&window).contains("to 60.00 mm"), "{}", legend(&window));
    assert_eq!(app(&window).maps(), 1, "another range is no other map");
    window.get_by_label("Automatic range").click();
    window.run_steps(3);
    assert_eq!(legend(&window), automatic);
}

/// The dressed project of `window` with all cloth moved.
fn moved(window: &Window, to: impl Fn(DVec3) -> DVec3) -> Project {
    let session = app(window).session();
    let snapshot = session.snapshot();
    let mut cloth = snapshot.cloth.as_ref().clone();
    cloth.positions.iter_mut().for_each(|p| *p = to(*p));
    let source = snapshot.source.clone().expect("cloth");
    let dressed = Some(Dressed { source, cloth: Arc::new(cloth), moved: toile::fit::Moved::Wrapped });
    Project { document: session.document().clone(), dressed }
}

/// Waits while another project is opened beside the window.
fn opened(window: &mut Window) {
    let start = std::time::Instant::now();
    while has(window, "opening ") {
        assert!(start.elapsed().as_secs() < 20, "it takes too long");
        std::thread::sleep(std::time::Duration::from_millis(5));
        window.run_steps(1);
    }
    window.run_steps(2);
}

#[test]
fn another_garment_is_shown_beside_and_the_difference_of_their_maps() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = dressed_window();
    let path = folder.path().join("wide.toile");
    project_file::save(&path, &moved(&window, |p| p * 1.02)).expect("saved");
    if !read_by(&mut window, "View", "Compare with…", &path) {
        return;
    }
    opened(&mut window);
    assert!(has(&window, "beside: wide"));
    window.get_by_label("To the left").click();
    window.run_steps(4);
    assert!(has(&window, "To the right"), "it stands on the left");
    window.get_by_label("To the right").click();
    window.run_steps(4);
    choose(&mut window, "Ease: gap to the body");
    assert!(has(&window, "Legend: Ease: gap"));
    window.get_by_label("Difference").click();
    window.run_steps(4);
    // All cloth is further away by 2 % of what it is from the middle of the ball.
    let cloth = &app(&window).session().snapshot().cloth.positions;
    let most = cloth.iter().map(|p| p.length() * 0.02 * 1000.0).fold(0.0, f64::max);
    let legend = window.get_by_label_contains("Legend:").accesskit_node().label().expect("a label");
    let words = legend.strip_prefix("Legend: Difference of ease, ").expect("a difference");
    let range: Vec<f64> = words.split(' ').filter_map(|word| word.parse().ok()).collect();
    let is_so = range[0] == -range[1] && (0.9 * most..most + 0.05).contains(&range[1]);
    assert!(is_so && words.ends_with("mm"), "{legend}, at most {most}");
    let body = pane(&window, "Body pane").center();
    let on_cloth = (0..40).map(|i| body - Vec2::X * 5.0 * i as f32).find(|&at| {
        move_to(&mut window, at);
        window.run_steps(2);
        has(&window, " mm, Square")
    });
    assert!(on_cloth.is_some(), "the cloth is on the left of the middle");
    let told = window.get_by_label_contains(" mm, Square").accesskit_node().value().expect("what it says");
    let value: f64 = told.split(' ').next().and_then(|v| v.parse().ok()).expect("a number");
    assert!((-most - 0.05..-4.9).contains(&value), "{told}");
    // What is taken off is compared with nothing, what is put on again is.
    key(&mut window, Modifiers::COMMAND, Key::Z);
    wait(&mut window, "the undo", |app| !app.session().snapshot().is_dressed());
    window.run_steps(2);
    assert!(!has(&window, "beside: wide"));
    key(&mut window, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    wait(&mut window, "the redo", |app| app.session().snapshot().is_dressed());
    window.run_steps(2);
    assert!(has(&window, "beside: wide") && has(&window, "Legend: Difference of ease"));
    window.get_by_label("Close the comparison").click();
    window.run_steps(4);
    assert!(!has(&window, "beside: wide") && has(&window, "Legend: Ease: gap"));
}

#[test]
fn what_cannot_be_compared_is_refused_with_its_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = dressed_window();
    let mut other = moved(&window, |p| p);
    let dressed = other.dressed.as_mut().expect("cloth");
    let pattern = Arc::make_mut(&mut Arc::make_mut(&mut dressed.source).pattern);
    pattern.pieces.values_mut().for_each(|piece| Arc::make_mut(piece).name = "Round".to_owned());
    for (name, project, words) in [
        ("round.toile", other, "it has not the pieces of this pattern: the second has no piece"),
        ("bare.toile", project(), "there is no cloth on its body"),
    ] {
        let path = folder.path().join(name);
        project_file::save(&path, &project).expect("saved");
        if !read_by(&mut window, "View", "Compare with…", &path) {
            return;
        }
        opened(&mut window);
        assert!(has(&window, &format!("{name}: {words}")), "{name}");
        assert!(!has(&window, "beside:"));
    }
}

#[test]
fn a_map_is_told_in_figures_piece_by_piece() {
    let mut window = dressed_window();
    choose(&mut window, "Change of area");
    choose(&mut window, "Table of the map");
    for words in ["Change of area, %", "All", "Square", "Median", "Copy all"] {
        assert!(window.query_all_by_label(words).next().is_some(), "{words}");
    }
    choose(&mut window, "No map");
    assert!(has(&window, "No map is shown"));
}

#[test]
fn the_mannequin_is_posed_from_the_side_panel() {
    let mut window = window_on(Project::default(), None);
    window.get_by_label("Pose").click();
    window.run_steps(8);
    let body = |window: &Window| app(window).session().document().body.clone();
    window.get_by_label("Pose Sitting").click();
    window.run_steps(4);
    let sitting = BodyChoice::default().in_named_pose(toile::body::NamedPose::Sitting);
    assert_eq!(Some(body(&window)), sitting);
    assert_eq!(app(&window).session().undo_label(), Some("change the pose"));
    assert!(has(&window, "On the way to Sitting"));
    window.get_by_label("Pose A: arms half up").click();
    window.run_steps(4);
    assert_eq!(body(&window), BodyChoice::default());
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(Some(body(&window)), sitting);
}

#[test]
fn joints_are_turned_by_a_slider_reset_and_mirrored() {
    let mut window = window_on(Project::default(), None);
    window.get_by_label("Pose").click();
    window.run_steps(8);
    let pose = |window: &Window| app(window).session().document().body.pose().expect("the mannequin");
    let slider = |window: &Window| window.get_by_role_and_label(Role::Slider, "Left elbow: Flexion").rect();
    window.get_by_role_and_label(Role::Slider, "Left elbow: Flexion").scroll_to_me();
    window.run_steps(8);
    // The knob stands at 0°, at the left end of the rail.
    let rail = slider(&window);
    let from = Pos2::new(rail.left() + 6.0, rail.center().y);
    let path: Vec<Pos2> = (0..8).map(|i| from + Vec2::new(8.0 * i as f32, 0.0)).collect();
    drag(&mut window, &path, PointerButton::Primary);
    window.run_steps(4);
    let bent = pose(&window);
    let turn = bent.turn("elbow_left").to_axis_angle().1.to_degrees();
    assert!((20.0..=150.0).contains(&turn), "{turn}");
    assert_eq!(bent.turns.len(), 1, "only the elbow");
    assert_eq!(app(&window).session().step_labels().collect::<Vec<_>>(), ["change the pose"], "one step");
    window.get_by_label("Mirror left to right").click();
    window.run_steps(4);
    assert_eq!(pose(&window).turns.len(), 2);
    window.get_by_label("Reset joint").click();
    window.run_steps(4);
    assert_eq!(pose(&window).turns.keys().collect::<Vec<_>>(), ["elbow_right"]);
    for _ in 0..2 {
        key(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(pose(&window), bent, "bit for bit");
    // Beyond the end of the rail it is as far as the joint goes.
    let far: Vec<Pos2> = (0..8).map(|i| path[7] + Vec2::new(60.0 * i as f32, 0.0)).collect();
    drag(&mut window, &far, PointerButton::Primary);
    let turn = pose(&window).turn("elbow_left").to_axis_angle().1.to_degrees();
    assert!((turn - 150.0).abs() < 1e-6, "{turn}");
}

#[test]
fn the_side_panel_tells_what_the_tape_reads() {
    let mut window = window_on(Project::default(), None);
    window.get_by_label("Measures of the body").click();
    for _ in 0..600 {
        window.run_steps(2);
        if window.query_by_label("underbust").is_some() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    assert!(window.query_by_label("waist").is_some());
    assert!(window.query_by_label("70.6 cm").is_some(), "the mannequin's waist");
}

#[test]
fn the_side_panel_tells_how_much_wider_the_garment_is() {
    let skirt = Sample::Skirt.project(&toile::body::mannequin::default());
    let mut window = window_on(skirt, None);
    // So that there is room for all of them.
    for section in ["Marks", "Problems", "Fabric", "Measures of the body"] {
        window.get_by_label(section).click();
        window.run_steps(20);
    }
    assert!(!has(&window, "Ease"), "there is no cloth");
    window.get_by_label("Wrap").click();
    window.run_steps(2);
    wait(&mut window, "the cloth to rest", |app| {
        let snapshot = app.session().snapshot();
        snapshot.is_dressed() && !snapshot.working
    });
    for _ in 0..600 {
        window.run_steps(2);
        if window.query_all_by_label_contains("+").count() > 2 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    assert!(window.query_by_label("Ease").is_some());
    // The skirt goes round waist and hip, and the tape at the height of the waist reads the same again.
    let eases: Vec<String> = window
        .query_all_by_label_contains(" cm")
        .filter_map(|node| node.accesskit_node().value())
        .filter(|label| label.starts_with('+'))
        .collect();
    assert_eq!(eases.len(), 3, "{eases:?}");
    assert_eq!(eases[0], eases[2], "{eases:?}");
}

#[test]
fn the_legend_leaves_the_buttons_of_a_narrow_pane_free() {
    let mut window = dressed_window();
    choose(&mut window, "Warp strain: along the grain");
    for size in [Vec2::new(1280.0, 720.0), Vec2::new(1000.0, 700.0)] {
        window.set_size(size);
        window.run_steps(4);
        let legend = window.get_by_label_contains("Legend: ").rect();
        let table = window.get_by_label("Table").rect();
        let body = pane(&window, "Body pane");
        assert!(body.contains_rect(legend) && body.contains_rect(table), "{legend} {table} in {body}");
        for name in ["Wireframe", "See through the body", "X-ray", "Show all"] {
            let button = window.get_by_label(name).rect();
            assert!(!legend.union(table).expand(4.0).intersects(button), "{name} at {button}, {size}");
        }
    }
}

/// A window with the list of the map button open.
fn window_with_list() -> Window {
    let mut window = dressed_window();
    window.get_by_label("Map: No map").click();
    window.run_steps(4);
    assert!(has(&window, "Pressure on the skin"));
    window
}

#[test]
fn keys_of_an_action_close_an_open_list() {
    let mut window = window_with_list();
    key(&mut window, Modifiers::COMMAND, Key::Z);
    window.run_steps(4);
    assert!(!has(&window, "Pressure on the skin"));
}

#[test]
fn a_map_chosen_with_enter_closes_the_list() {
    let mut window = window_with_list();
    window.get_by_label("Shear").focus();
    window.run_steps(2);
    key(&mut window, Modifiers::NONE, Key::Enter);
    window.run_steps(4);
    assert!(has(&window, "Map: Shear"));
    assert!(!has(&window, "Pressure on the skin"), "the list");
}

#[test]
fn keys_lead_through_the_list_from_the_present_map() {
    let mut window = dressed_window();
    choose(&mut window, "Change of area");
    window.get_by_label("Map: Area").click();
    window.run_steps(4);
    is_at(&window, "Change of area");
    for (pressed, label) in [
        (Key::ArrowDown, "Ease: gap to the body"),
        (Key::ArrowUp, "Change of area"),
        (Key::ArrowUp, "Shear"),
        (Key::End, "Pressure on the skin"),
        (Key::ArrowDown, "Pressure on the skin"),
        (Key::Home, "No map"),
        (Key::ArrowUp, "No map"),
    ] {
        key(&mut window, Modifiers::NONE, pressed);
        is_at(&window, label);
    }
    for (typed, label) in [("s", "Shear"), ("t", "Strain along seams"), ("m", "Mean curvature")] {
        type_letters(&mut window, typed);
        is_at(&window, label);
    }
    key(&mut window, Modifiers::NONE, Key::Enter);
    window.run_steps(4);
    assert!(has(&window, "Map: Curvature") && !has(&window, "Pressure on the skin"));
    // Opened again it begins at what was chosen.
    window.get_by_label("Map: Curvature").click();
    window.run_steps(4);
    key(&mut window, Modifiers::NONE, Key::ArrowDown);
    is_at(&window, "Strain along seams");
}
