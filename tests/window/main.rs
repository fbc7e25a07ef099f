//! The window without a window: pointer, keys and menus against the session.

use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use glam::{DQuat, DVec2, DVec3};
use toile::body::Surface;
use toile::geometry::mesh::TriMesh;
use toile::pattern::{Piece, SpacePose};
use toile::session::{BodyChoice, Document, Project};
use toile::ui::App;
use toile::wrap::ClothSide;

use common::limb;

mod all_sizes;
mod animations;
mod bow;
mod cloth_line;
#[path = "../common/mod.rs"]
mod common;
mod demos;
mod depth_of_field;
mod draping;
mod dressing;
mod environment;
mod files;
mod hand;
mod language;
mod lists;
mod maps;
mod marker;
mod mouse;
mod pattern_pane;
mod pictures;
mod proposed;
mod safety;
mod shell;
mod standing;
mod tight;
mod watched;

type Window = Harness<'static, Option<App>>;

/// A square of cloth, 40 cm wide, and a ball of 25 cm radius.
fn project() -> Project {
    let mut document = Document::default();
    let corners = [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]].map(DVec2::from);
    Arc::make_mut(&mut document.pattern).add_piece(Piece::polygon("Square", &corners));
    document.body = BodyChoice::Imported { name: "ball".to_owned(), mesh: Arc::new(ball(0.25)) };
    Project { document, dressed: None }
}

fn ball(radius: f64) -> TriMesh {
    let (rings, sides) = (24, 48);
    let mut mesh = TriMesh { positions: vec![DVec3::Y * radius, -DVec3::Y * radius], triangles: Vec::new() };
    for i in 1..rings {
        let a = std::f64::consts::PI * f64::from(i) / f64::from(rings);
        for j in 0..sides {
            let b = std::f64::consts::TAU * f64::from(j) / f64::from(sides);
            mesh.positions.push(DVec3::new(a.sin() * b.sin(), a.cos(), a.sin() * b.cos()) * radius);
        }
    }
    let at = |i: i32, j: i32| (2 + (i - 1) * sides + j.rem_euclid(sides)) as u32;
    for j in 0..sides {
        mesh.triangles.push([0, at(1, j), at(1, j + 1)]);
        mesh.triangles.push([1, at(rings - 1, j + 1), at(rings - 1, j)]);
        for i in 1..rings - 1 {
            mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh
}

fn window_on(project: Project, device: Option<egui_wgpu::RenderState>) -> Window {
    let mut start = Some((project, device));
    let mut window =
        Harness::builder().with_size(Vec2::new(1280.0, 720.0)).with_step_dt(1.0 / 60.0).build_ui_state(
            move |ui, app: &mut Option<App>| {
                let app = app.get_or_insert_with(|| {
                    let (project, device) = start.take().expect("only once");
                    App::new(ui.ctx(), project, None, device).expect("a thread for the simulation")
                });
                app.ui(ui);
            },
            None,
        );
    window.run_steps(4);
    window
}

fn window() -> Window {
    window_on(project(), None)
}

fn app(window: &Window) -> &App {
    window.state().as_ref().expect("the app")
}

fn counts(window: &Window) -> [usize; 2] {
    let marks = &app(window).session().document().marks;
    [marks.cloth.len(), marks.body.len()]
}

fn pane(window: &Window, label: &str) -> Rect {
    window.get_by_label(label).rect()
}

fn button(window: &mut Window, at: Pos2, button: PointerButton, pressed: bool, modifiers: Modifiers) {
    window.event(Event::PointerButton { pos: at, button, pressed, modifiers });
    window.run_steps(1);
}

fn move_to(window: &mut Window, at: Pos2) {
    window.event(Event::PointerMoved(at));
    window.run_steps(1);
}

/// Presses, goes along `path` and does not let go.
fn press_along(window: &mut Window, path: &[Pos2], with: PointerButton) {
    move_to(window, path[0]);
    button(window, path[0], with, true, Modifiers::NONE);
    for &at in &path[1..] {
        move_to(window, at);
    }
}

fn drag(window: &mut Window, path: &[Pos2], with: PointerButton) {
    press_along(window, path, with);
    button(window, path[path.len() - 1], with, false, Modifiers::NONE);
    window.run_steps(2);
}

/// A line of 11 points about the middle of a pane.
fn line(pane: Rect, half: Vec2) -> Vec<Pos2> {
    (0..=10).map(|i| pane.center() + half * (i as f32 / 5.0 - 1.0)).collect()
}

fn key(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(3);
}

fn paint_both(window: &mut Window) {
    for label in ["Pattern pane", "Body pane"] {
        let path = line(pane(window, label), Vec2::new(60.0, 0.0));
        drag(window, &path, PointerButton::Primary);
    }
}

/// Runs frames until `done`, for at most 20 seconds.
fn wait(window: &mut Window, what: &str, done: impl Fn(&App) -> bool) {
    let start = Instant::now();
    while !done(app(window)) {
        assert!(start.elapsed() < Duration::from_secs(20), "{what} took too long");
        std::thread::sleep(Duration::from_millis(5));
        window.run_steps(1);
    }
}

/// Clicks what has this label.
fn act(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(4);
}

/// Changes the app by hand.
fn edit(window: &mut Window, change: impl FnOnce(&mut App, &egui::Context)) {
    let ctx = window.ctx.clone();
    change(window.state_mut().as_mut().expect("the app"), &ctx);
    window.run_steps(3);
}

fn from_menu(window: &mut Window, menu: &str, entry: &str) {
    act(window, menu);
    act(window, entry);
}

#[test]
fn every_menu_opens() {
    let mut window = window();
    for (menu, entry) in [
        ("File", "Import pattern…"),
        ("Edit", "Clear all marks"),
        ("Garment", "Undress"),
        ("View", "Parallel projection"),
        ("Help", "Keys and mouse"),
    ] {
        window.get_by_label(menu).click();
        window.run_steps(4);
        assert!(window.query_by_label_contains(entry).is_some(), "{menu} lacks {entry}");
        key(&mut window, Modifiers::NONE, Key::Escape);
    }
}

/// On a screen of 1366 × 768 the file menu was higher than the window: it lay over its own button, and its end was cut off.
#[test]
fn every_menu_lies_below_its_button_in_a_low_window() {
    let mut window = window();
    for size in [Vec2::new(1366.0, 720.0), Vec2::new(1024.0, 500.0)] {
        window.set_size(size);
        window.run_steps(3);
        for (menu, entry) in
            [("File", "Save as…"), ("Pattern", "Tools"), ("Garment", "Undress"), ("View", "Theme")]
        {
            let at = window.get_by_label(menu).rect();
            drag(&mut window, &[at.center()], PointerButton::Primary);
            window.run_steps(20);
            let found = window.query_by_label_contains(entry).map(|found| found.rect());
            assert!(found.is_some_and(|found| found.top() >= at.bottom()), "{menu} at {size}: {found:?}");
            key(&mut window, Modifiers::NONE, Key::Escape);
        }
    }
}

#[test]
fn wrap_waits_for_a_pair_of_marks() {
    let mut window = window();
    assert!(window.get_by_label("Wrap").accesskit_node().is_disabled());
    let path = line(pane(&window, "Pattern pane"), Vec2::new(60.0, 0.0));
    drag(&mut window, &path, PointerButton::Primary);
    assert!(window.get_by_label("Wrap").accesskit_node().is_disabled());
    assert!(window.query_by_label_contains("Mark 1 has no partner on the body yet").is_some());
    let path = line(pane(&window, "Body pane"), Vec2::new(60.0, 0.0));
    drag(&mut window, &path, PointerButton::Primary);
    assert!(!window.get_by_label("Wrap").accesskit_node().is_disabled());
    assert!(window.query_by_label_contains("no partner").is_none());
}

#[test]
fn a_stroke_on_the_pattern_is_a_mark_and_one_step() {
    let mut window = window();
    let path = line(pane(&window, "Pattern pane"), Vec2::new(60.0, 20.0));
    drag(&mut window, &path, PointerButton::Primary);
    assert_eq!(counts(&window), [1, 0]);
    assert!(window.query_by_label("Mark 1 on the cloth").is_some());
    let mark = app(&window).session().document().marks.cloth[0].clone();
    let (first, last) = (mark.points[0], mark.points[mark.points.len() - 1]);
    assert!(first.x < 0.0 && last.x > 0.0 && first.y > last.y, "{first} {last}");
    assert!((first + last).length() < 1e-3, "the middle of the pane is the middle of the square");
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(counts(&window), [0, 0]);
    key(&mut window, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    assert_eq!(counts(&window), [1, 0]);
    assert_eq!(app(&window).session().document().marks.cloth[0], mark);
}

#[test]
fn escape_gives_a_stroke_up() {
    let mut window = window();
    for label in ["Pattern pane", "Body pane"] {
        let path = line(pane(&window, label), Vec2::new(60.0, 0.0));
        press_along(&mut window, &path, PointerButton::Primary);
        key(&mut window, Modifiers::NONE, Key::Escape);
        move_to(&mut window, path[3]);
        button(&mut window, path[3], PointerButton::Primary, false, Modifiers::NONE);
        window.run_steps(2);
        assert_eq!(counts(&window), [0, 0], "{label}");
    }
    assert_eq!(app(&window).session().undo_label(), None);
}

#[test]
fn a_stroke_on_the_body_lies_on_its_skin() {
    let mut window = window();
    let path = line(pane(&window, "Body pane"), Vec2::new(80.0, 30.0));
    drag(&mut window, &path, PointerButton::Primary);
    assert_eq!(counts(&window), [0, 1]);
    assert!(window.query_by_label("Mark 1 on the body").is_some());
    let skin = Surface::new(ball(0.25)).expect("a ball");
    let points = &app(&window).session().document().marks.body[0].points;
    assert!(points.len() > 5);
    let steps: Vec<f64> = points.windows(2).map(|w| w[0].distance(w[1])).collect();
    assert!(steps.iter().all(|s| (0.006..0.009).contains(s)), "evenly spaced: {steps:?}");
    assert!(points.iter().all(|&p| skin.nearest(p).distance.abs() < 1e-6 && p.z > 0.0));
}

#[test]
fn a_fast_stroke_on_the_body_is_followed_all_the_way() {
    let mut window = window();
    let middle = pane(&window, "Body pane").center();
    let half = Vec2::new(90.0, 20.0);
    drag(&mut window, &[middle - half, middle + half], PointerButton::Primary);
    let slow = line(pane(&window, "Body pane"), half);
    drag(&mut window, &slow, PointerButton::Primary);
    let marks = &app(&window).session().document().marks;
    let length = |i: usize| marks.body[i].points.windows(2).map(|w| w[0].distance(w[1])).sum::<f64>();
    assert!((length(0) / length(1) - 1.0).abs() < 0.05, "{} {}", length(0), length(1));
}

#[test]
fn the_laser_marks_both_sides_of_the_body_in_one_step() {
    let mut window = window();
    key(&mut window, Modifiers::NONE, Key::L);
    let path = line(pane(&window, "Body pane"), Vec2::new(60.0, 10.0));
    drag(&mut window, &path, PointerButton::Primary);
    let body = app(&window).session().document().marks.body.clone();
    assert_eq!(body.len(), 2);
    assert!(body[0].points.iter().all(|p| p.z > 0.0) && body[1].points.iter().all(|p| p.z < 0.0));
    let skin = Surface::new(ball(0.25)).expect("a ball");
    assert!(body[1].points.iter().all(|&p| skin.nearest(p).distance.abs() < 1e-6));
    assert_eq!(app(&window).session().step_labels().count(), 1);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(counts(&window), [0, 0]);
    drag(&mut window, &path[5..6], PointerButton::Primary);
    assert_eq!(counts(&window), [0, 2], "a click makes two dots");
    key(&mut window, Modifiers::NONE, Key::L);
    drag(&mut window, &path, PointerButton::Primary);
    assert_eq!(counts(&window), [0, 3], "without the laser only the near side");
}

/// The square and below it a wider one, turned over.
fn two_layers() -> Project {
    let mut project = project();
    let pattern = Arc::make_mut(&mut project.document.pattern);
    let (id, top) = pattern.pieces.pop_first().expect("the square");
    let corners = [[-0.3, -0.2], [0.3, -0.2], [0.3, 0.2], [-0.3, 0.2]].map(DVec2::from);
    let mut under = Piece::polygon("Under", &corners);
    under.pose.flipped = true;
    pattern.pieces.insert(id, Arc::new(under));
    pattern.add_piece(Piece::clone(&top));
    project
}

#[test]
fn the_laser_marks_every_piece_that_lies_there() {
    let mut window = window_on(two_layers(), None);
    key(&mut window, Modifiers::NONE, Key::L);
    let path = line(pane(&window, "Pattern pane"), Vec2::new(30.0, 10.0));
    drag(&mut window, &path, PointerButton::Primary);
    let document = app(&window).session().document();
    let marks = &document.marks.cloth;
    let on = |i: usize| document.pattern.pieces[&marks[i].piece].name.as_str();
    assert_eq!((marks.len(), on(0), on(1)), (2, "Square", "Under"));
    for (a, b) in marks[0].points.iter().zip(&marks[1].points) {
        assert!((*a - DVec2::new(-b.x, b.y)).length() < 1e-9, "{a} {b}");
    }
    assert!(marks.iter().all(|m| m.side == ClothSide::Front), "outer sides, however they lie");
    assert_eq!(app(&window).session().step_labels().count(), 1);
}

/// Labels of the two strokes of the first pair in the list.
const FIRST: [&str; 2] = ["Square: select mark 1 on the cloth", "body: select mark 1 on the body"];

#[test]
fn a_mark_is_selected_in_a_pane_or_in_the_list_and_deleted() {
    let mut window = window();
    paint_both(&mut window);
    for label in ["Pattern pane", "Body pane"] {
        assert!(window.query_by_label_contains("Selected:").is_none());
        let at = pane(&window, label).center();
        drag(&mut window, &[at], PointerButton::Primary);
        assert_eq!(counts(&window), [1, 1], "a click on a mark paints none");
        assert!(window.query_by_label_contains("Selected: mark 1 on the").is_some(), "{label}");
        key(&mut window, Modifiers::NONE, Key::Escape);
    }
    window.get_by_label(FIRST[1]).click();
    window.run_steps(3);
    assert!(window.query_by_label("Selected: mark 1 on the body").is_some());
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(counts(&window), [1, 0]);
    assert!(window.query_by_label_contains("Selected:").is_none());
}

#[test]
fn the_selected_mark_is_moved_in_the_order_and_named() {
    let mut window = window();
    for x in [-60.0, 60.0] {
        let at = pane(&window, "Pattern pane").center() + Vec2::new(x, 0.0);
        drag(&mut window, &[at], PointerButton::Primary);
    }
    let ids = |w: &Window| app(w).session().document().marks.cloth.iter().map(|m| m.id.0).collect::<Vec<_>>();
    window.get_by_label(FIRST[0]).click();
    window.run_steps(3);
    key(&mut window, Modifiers::COMMAND, Key::ArrowDown);
    assert_eq!(ids(&window), [2, 1]);
    assert!(window.query_by_label("Selected: mark 2 on the cloth").is_some(), "the selection goes with it");
    window.get_by_label("Move mark up").click();
    window.run_steps(3);
    assert_eq!(ids(&window), [1, 2]);
    assert!(window.get_by_label("Move mark up").accesskit_node().is_disabled());
    window.get_by_role_and_label(egui::accesskit::Role::TextInput, "Name").focus();
    window.run_steps(2);
    window.get_by_role_and_label(egui::accesskit::Role::TextInput, "Name").type_text("hem");
    window.run_steps(2);
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(app(&window).session().document().marks.names.values().collect::<Vec<_>>(), ["hem"]);
    assert!(window.query_by_label("hem: select mark 1 on the cloth").is_some());
    assert!(!app(&window).session().snapshot().is_dressed(), "Enter in a name does not wrap");
}

#[test]
fn the_list_tells_the_stretch_of_each_pair() {
    let mut window = window();
    paint_both(&mut window);
    let found = window.query_by_label_contains("Stretch of pair 1: ").is_some();
    assert!(found, "before any wrap");
}

#[test]
fn a_click_makes_a_dot_and_control_click_takes_it_away() {
    let mut window = window();
    for label in ["Pattern pane", "Body pane"] {
        let at = pane(&window, label).center();
        drag(&mut window, &[at], PointerButton::Primary);
    }
    assert_eq!(counts(&window), [1, 1]);
    let marks = &app(&window).session().document().marks;
    assert_eq!([marks.cloth[0].points.len(), marks.body[0].points.len()], [1, 1]);
    for label in ["Pattern pane", "Body pane"] {
        let at = pane(&window, label).center();
        move_to(&mut window, at);
        window.event(Event::ModifiersChanged(Modifiers::COMMAND));
        button(&mut window, at, PointerButton::Primary, true, Modifiers::COMMAND);
        button(&mut window, at, PointerButton::Primary, false, Modifiers::COMMAND);
        window.event(Event::ModifiersChanged(Modifiers::NONE));
        window.run_steps(2);
    }
    assert_eq!(counts(&window), [0, 0]);
}

#[test]
fn a_piece_is_moved_in_one_step_and_turned_over() {
    let mut window = window();
    key(&mut window, Modifiers::NONE, Key::V);
    let area = pane(&window, "Pattern pane");
    let path: Vec<Pos2> = (0..8).map(|i| area.center() + Vec2::new(9.0 * i as f32, 0.0)).collect();
    drag(&mut window, &path, PointerButton::Primary);
    let pose = |w: &Window| app(w).session().document().pattern.pieces.values().next().expect("a piece").pose;
    let moved = pose(&window);
    assert!(moved.offset.x > 0.01 && moved.offset.y.abs() < 1e-9, "{moved:?}");
    assert_eq!(app(&window).session().step_labels().count(), 1);
    let at = path[7];
    for _ in 0..2 {
        button(&mut window, at, PointerButton::Primary, true, Modifiers::NONE);
        button(&mut window, at, PointerButton::Primary, false, Modifiers::NONE);
    }
    window.run_steps(2);
    assert!(pose(&window).flipped);
    assert!((pose(&window).offset - moved.offset).length() < 1e-9, "it turns about its own middle");
    key(&mut window, Modifiers::COMMAND, Key::Z);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(pose(&window).offset, DVec2::ZERO);
}

#[test]
fn the_view_turns_and_zooms_without_touching_the_document() {
    let mut window = window();
    let area = pane(&window, "Body pane");
    drag(&mut window, &line(area, Vec2::new(50.0, 10.0)), PointerButton::Secondary);
    drag(&mut window, &line(area, Vec2::new(50.0, 10.0)), PointerButton::Middle);
    let area = pane(&window, "Pattern pane");
    drag(&mut window, &line(area, Vec2::new(50.0, 10.0)), PointerButton::Middle);
    key(&mut window, Modifiers::NONE, Key::Num7);
    assert_eq!(counts(&window), [0, 0]);
    assert!(!app(&window).session().is_modified());
}

#[test]
fn wrap_grows_cloth_round_the_body_and_undo_takes_it_off() {
    let mut window = window();
    paint_both(&mut window);
    assert_eq!(counts(&window), [1, 1]);
    window.get_by_label("Wrap").click();
    window.run_steps(2);
    wait(&mut window, "the wrap", |app| app.session().snapshot().is_dressed());
    key(&mut window, Modifiers::COMMAND, Key::Z);
    wait(&mut window, "the undo", |app| !app.session().snapshot().is_dressed());
    assert_eq!(counts(&window), [1, 1]);
}

#[test]
fn two_clicks_and_wrap_dress_the_ball_by_a_point() {
    // Without weight: nothing else would keep the square from gliding off the ball.
    let mut project = project();
    project.document.settings.relax.gravity = 0.0;
    let mut window = window_on(project, None);
    for label in ["Pattern pane", "Body pane"] {
        let at = pane(&window, label).center();
        drag(&mut window, &[at], PointerButton::Primary);
    }
    assert!(window.query_by_label("point").is_some(), "a point has no stretch");
    window.get_by_label("Wrap").click();
    window.run_steps(2);
    wait(&mut window, "the wrap", |app| {
        let snapshot = app.session().snapshot();
        snapshot.is_dressed() && !snapshot.working
    });
    let snapshot = Arc::clone(app(&window).session().snapshot());
    assert!(snapshot.cloth.mapped.iter().all(|&m| m), "all of the square lies on the ball");
    // Its middle lies at the point, and the pattern's up is the body's.
    let garment = snapshot.garment.as_ref().expect("a garment");
    let at = |uv: DVec2| {
        let nearest = garment.corners.iter().min_by(|a, b| a.uv.distance(uv).total_cmp(&b.uv.distance(uv)));
        snapshot.cloth.positions[nearest.expect("a corner").vertex as usize]
    };
    let point = app(&window).session().document().marks.body[0].points[0];
    assert!(at(DVec2::ZERO).distance(point) < 0.03, "{}", at(DVec2::ZERO));
    assert!(at(DVec2::new(0.0, 0.15)).y > point.y + 0.08 && at(DVec2::new(0.15, 0.0)).x > point.x + 0.08);
}

#[test]
fn nothing_is_drawn_while_nothing_changes() {
    let device = egui_wgpu_device();
    let with_pictures = device.is_some();
    let mut window = window_on(project(), device);
    paint_both(&mut window);
    move_to(&mut window, Pos2::new(640.0, 700.0));
    // What is still to be finished: tooltips, fading, the picture after the last stroke.
    let start = Instant::now();
    while start.elapsed() < Duration::from_millis(1500) {
        std::thread::sleep(Duration::from_millis(50));
        window.run_steps(1);
    }
    let root = &window.output().viewport_output[&egui::ViewportId::ROOT];
    assert!(root.repaint_delay > Duration::from_secs(3600), "asks for a frame in {:?}", root.repaint_delay);
    let pictures = app(&window).pictures();
    assert_eq!(pictures > 0, with_pictures);
    window.run_steps(10);
    assert_eq!(app(&window).pictures(), pictures);
}

fn egui_wgpu_device() -> Option<egui_wgpu::RenderState> {
    if let Err(why) = toile::render::Gpu::headless() {
        println!("only frames are counted: {why}");
        return None;
    }
    let setup = egui_kittest::wgpu::default_wgpu_setup();
    Some(egui_kittest::wgpu::create_render_state(setup, Default::default()))
}

#[test]
fn a_wrap_is_cancelled_by_escape() {
    let mut window = window();
    paint_both(&mut window);
    let before = app(&window).session().document().clone();
    window.get_by_label("Wrap").click();
    window.run_steps(1);
    key(&mut window, Modifiers::NONE, Key::Escape);
    wait(&mut window, "the cancelling", |app| {
        let snapshot = app.session().snapshot();
        !snapshot.is_dressed() && !snapshot.working
    });
    assert_eq!(app(&window).session().document(), &before);
    assert!(app(&window).session().undo_label().is_none_or(|label| label != "wrap"));
}

#[test]
fn what_was_done_in_the_window_replays_to_the_same_hashes() {
    let mut window = window();
    paint_both(&mut window);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    key(&mut window, Modifiers::COMMAND, Key::Y);
    window.get_by_label("Wrap").click();
    window.run_steps(2);
    wait(&mut window, "the wrap", |app| app.session().snapshot().is_dressed());
    key(&mut window, Modifiers::SHIFT, Key::Space);
    wait(&mut window, "the pause", |app| !app.session().snapshot().working);
    let text = window.state_mut().as_mut().expect("the app").recording();
    let recording = toile::session::recording::Recording::parse(&text).expect("a recording");
    let mut replay = toile::session::replay::Replay::new(recording);
    replay.run().expect("the same hashes");
    assert!(replay.hashes_compared() > 3);
}

#[test]
fn the_wheel_zooms_to_the_pointer() {
    let mut window = window();
    let area = pane(&window, "Pattern pane");
    for x in [-60.0, 60.0] {
        drag(&mut window, &[area.center() + Vec2::new(x, 10.0)], PointerButton::Primary);
    }
    let place = |w: &Window, label: &str| w.get_by_label(label).rect().center();
    let [at, other] = ["Mark 1 on the cloth", "Mark 2 on the cloth"].map(|label| place(&window, label));
    move_to(&mut window, at);
    let steps = app(&window).session().step_labels().count();
    window.event(Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: Vec2::new(0.0, 3.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    window.run_steps(40);
    assert!(
        (place(&window, "Mark 1 on the cloth") - at).length() < 1.0,
        "what is under the pointer stays there"
    );
    let grown = (place(&window, "Mark 2 on the cloth") - at).length() / (other - at).length();
    assert!(grown > 1.2, "{grown}");
    assert_eq!(app(&window).session().step_labels().count(), steps);
}

#[test]
fn an_empty_table_offers_a_sample() {
    let document = Document { body: project().document.body, ..Document::default() };
    let mut window = window_on(Project { document, dressed: None }, None);
    assert!(window.query_by_label("Open the T-shirt").is_some());
    assert!(window.get_by_label("Wrap").accesskit_node().is_disabled());
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert!(!app(&window).session().is_modified());
}

#[test]
fn losing_the_pointer_or_the_window_ends_a_stroke() {
    let mut window = window();
    let path = line(pane(&window, "Pattern pane"), Vec2::new(60.0, 0.0));
    press_along(&mut window, &path, PointerButton::Primary);
    window.event(Event::PointerGone);
    window.run_steps(2);
    assert_eq!(counts(&window), [1, 0]);
    move_to(&mut window, path[2]);
    window.run_steps(2);
    assert_eq!(counts(&window), [1, 0], "no second stroke begins by itself");
}

#[test]
fn what_was_done_is_shown_without_waiting_for_the_next_event() {
    let mut window = window();
    let at = pane(&window, "Pattern pane").center();
    move_to(&mut window, at);
    button(&mut window, at, PointerButton::Primary, true, Modifiers::NONE);
    button(&mut window, at, PointerButton::Primary, false, Modifiers::NONE);
    let root = &window.output().viewport_output[&egui::ViewportId::ROOT];
    assert_eq!(root.repaint_delay, Duration::ZERO);
}

#[test]
fn letters_choose_tools_even_after_a_slider_was_used() {
    let mut window = window();
    let slider = window.get_by_role_and_label(egui::accesskit::Role::Slider, "Triangle size").rect();
    drag(&mut window, &line(slider, Vec2::new(10.0, 0.0)), PointerButton::Primary);
    assert_eq!(app(&window).session().step_labels().count(), 1, "one drag is one step");
    let chosen = |w: &Window, label: &str| {
        w.get_by_label(label).accesskit_node().toggled() == Some(egui::accesskit::Toggled::True)
    };
    for (letter, label) in [(Key::V, "Move"), (Key::X, "Erase"), (Key::K, "Mark")] {
        key(&mut window, Modifiers::NONE, letter);
        assert!(chosen(&window, label), "{label}");
    }
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(app(&window).session().document().settings, Document::default().settings);
}
