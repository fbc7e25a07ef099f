//! The whole window as it is seen. Three pictures are held against kept ones; with `TOILE_PICTURES=FOLDER` many more are
//! written there, to be looked at.

use egui::Theme;
use egui_kittest::wgpu::WgpuTestRenderer;
use egui_kittest::{SnapshotOptions, SnapshotResults};
use toile::body::mannequin;
use toile::session::samples::Sample;
use toile::session::{Command, Session, project_file};
use toile::sim::{Runner, Simulation};

use super::*;

/// How a window is made.
#[derive(Clone, Copy)]
struct Setting {
    size: Vec2,
    scale: f32,
    theme: Theme,
}

const PLAIN: Setting = Setting { size: Vec2::new(1280.0, 720.0), scale: 1.0, theme: Theme::Dark };

fn drawn_window(project: Project, setting: Setting) -> Option<Window> {
    let device = egui_wgpu_device()?;
    let renderer = WgpuTestRenderer::from_render_state(device.clone());
    let mut start = Some((project, device));
    let builder = Harness::builder()
        .with_size(setting.size)
        .with_pixels_per_point(setting.scale)
        .with_step_dt(1.0 / 60.0)
        .with_theme(setting.theme)
        .renderer(renderer);
    let mut window = builder.build_ui_state(
        move |ui, app: &mut Option<App>| {
            let app = app.get_or_insert_with(|| {
                let (project, device) = start.take().expect("only once");
                ui.ctx().set_theme(setting.theme);
                App::new(ui.ctx(), project, None, Some(device)).expect("a thread for the simulation")
            });
            app.ui(ui);
        },
        None,
    );
    window.run_steps(4);
    Some(window)
}

/// Nothing moves or fades any more.
fn calm(window: &mut Window) {
    std::thread::sleep(Duration::from_millis(200));
    window.run_steps(40);
}

fn dress(window: &mut Window) {
    window.get_by_label("Wrap").click();
    window.run_steps(2);
    wait(window, "the cloth to rest", |app| {
        let snapshot = app.session().snapshot();
        snapshot.is_dressed() && !snapshot.working && snapshot.verdict.is_some()
    });
    move_to(window, Pos2::new(640.0, 715.0));
    calm(window);
}

fn project_of(sample: Sample) -> Project {
    sample.project(&mannequin::default())
}

fn options() -> SnapshotOptions {
    // Another driver draws edges a little differently, and has another name in the status bar.
    SnapshotOptions::new().threshold(3.0).max_failed_pixels(4000_usize)
}

#[test]
fn the_window_looks_as_it_did() {
    let mut results = SnapshotResults::new();
    for (name, theme, dressed) in [
        ("t-shirt-flat-dark", Theme::Dark, false),
        ("t-shirt-dressed-dark", Theme::Dark, true),
        ("t-shirt-dressed-light", Theme::Light, true),
    ] {
        let Some(mut window) = drawn_window(project_of(Sample::Tshirt), Setting { theme, ..PLAIN }) else {
            return;
        };
        if dressed {
            dress(&mut window);
        }
        calm(&mut window);
        results.add(window.try_snapshot_options(name, &options()));
    }
    results.unwrap();
}

#[test]
fn a_comparison_is_written_for_whoever_wants_to_look() {
    let Some(folder) = std::env::var_os("TOILE_PICTURES").map(std::path::PathBuf::from) else { return };
    let mut session = Session::new(project_of(Sample::Tshirt), Runner::inline(Simulation::default()));
    for command in [Command::Wrap, Command::SetDraping { on: true }] {
        session.apply_alone(command).expect("done");
        while session.runner().simulation().expect("inline").tick() {}
    }
    let path = folder.join("draped.toile");
    project_file::save(&path, &session.project()).expect("saved");
    for (theme, mode) in [(Theme::Dark, "dark"), (Theme::Light, "light")] {
        let setting = Setting { theme, ..PLAIN };
        let Some(mut window) = drawn_window(project_of(Sample::Tshirt), setting) else { return };
        dress(&mut window);
        if !super::files::read_by(&mut window, "View", "Compare with…", &path) {
            return;
        }
        keep(&mut window, &folder, &format!("beside-{mode}"));
        for label in ["View", "Map", "Ease: gap to the body"] {
            window.get_by_label(label).click();
            window.run_steps(4);
        }
        keep(&mut window, &folder, &format!("beside-map-{mode}"));
        window.get_by_label("Difference").click();
        keep(&mut window, &folder, &format!("beside-difference-{mode}"));
    }
}

/// Writes a picture of `window` into the folder that is asked for.
fn keep(window: &mut Window, folder: &std::path::Path, name: &str) {
    calm(window);
    let picture = window.render().expect("a picture");
    picture.save(folder.join(format!("{name}.png"))).expect("written");
}

#[test]
fn suggested_marks_are_written_for_whoever_wants_to_look() {
    let Some(folder) = std::env::var_os("TOILE_PICTURES").map(std::path::PathBuf::from) else { return };
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut project = project_of(Sample::Dress);
    project.document.take_marks(Arc::default());
    let Some(mut window) = drawn_window(project, PLAIN) else { return };
    keep(&mut window, &folder, "dress-is-next");
    key(&mut window, Modifiers::COMMAND, Key::Enter);
    wait(&mut window, "a start", |app| app.session().snapshot().trying.is_some_and(|now| now.draped));
    window.run_steps(3);
    window.render().expect("a picture").save(folder.join("dress-tries.png")).expect("written");
    wait(&mut window, "the garment", |app| app.session().snapshot().started.is_some());
    keep(&mut window, &folder, "dress-ghosts");
}

#[test]
fn pictures_are_written_for_whoever_wants_to_look() {
    let Some(folder) = std::env::var_os("TOILE_PICTURES").map(std::path::PathBuf::from) else { return };
    std::fs::create_dir_all(&folder).expect("a folder");
    let large = Setting { scale: 2.0, ..PLAIN };
    for sample in Sample::MARKED {
        for (theme, mode) in [(Theme::Dark, "dark"), (Theme::Light, "light")] {
            let name = sample.file_stem();
            let Some(mut window) = drawn_window(project_of(sample), Setting { theme, ..PLAIN }) else {
                return;
            };
            keep(&mut window, &folder, &format!("{name}-flat-{mode}"));
            dress(&mut window);
            keep(&mut window, &folder, &format!("{name}-front-{mode}"));
            key(&mut window, Modifiers::NONE, Key::Num2);
            keep(&mut window, &folder, &format!("{name}-three-quarter-{mode}"));
        }
    }
    let Some(mut window) = drawn_window(project_of(Sample::Tshirt), large) else { return };
    dress(&mut window);
    keep(&mut window, &folder, "large");
    let tools = ["Mark", "Erase", "Move", "Points", "Pen", "Sew", "Cut", "Dart", "Grain", "Pin", "Drag"];
    let Some(mut window) = drawn_window(project_of(Sample::Tshirt), PLAIN) else { return };
    dress(&mut window);
    for tool in tools {
        let Some(button) = window.query_all_by_label(tool).next() else { continue };
        button.click();
        window.run_steps(3);
        let at = pane(&window, "Pattern pane").center() + Vec2::new(30.0, -60.0);
        move_to(&mut window, at);
        keep(&mut window, &folder, &format!("tool-{}", tool.to_lowercase()));
    }
    key(&mut window, Modifiers::NONE, Key::P);
    let middle = pane(&window, "Body pane").center() - Vec2::Y * 60.0;
    for x in [-20.0, 10.0, 40.0] {
        drag(&mut window, &[middle + Vec2::X * x], PointerButton::Primary);
    }
    wait(&mut window, "the pins", |app| app.session().snapshot().pinned.iter().flatten().count() == 3);
    window.get_by_label("Lock Pin 1").click();
    window.run_steps(3);
    window.get_by_label("Select Pin 2").click();
    keep(&mut window, &folder, "pins");
    key(&mut window, Modifiers::NONE, Key::V);
    let area = pane(&window, "Body pane");
    for y in 0..80 {
        move_to(&mut window, area.center() + Vec2::new(0.0, -60.0 + 2.0 * y as f32));
        if app(&window).highlight().is_some() {
            break;
        }
    }
    keep(&mut window, &folder, "edge-under-the-pointer");
    key(&mut window, Modifiers::COMMAND, Key::Comma);
    keep(&mut window, &folder, "preferences");
}
