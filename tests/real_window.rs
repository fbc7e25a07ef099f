//! The real window in a virtual display, driven with a real pointer: from an empty table to a dressed skirt.
//!
//! Where things are on the screen is asked of a twin: the same window without a display, of the same size.

use std::path::Path;
use std::process::{Child, Command as Process, Stdio};
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Pos2, Rect, Vec2, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use glam::{DVec2, DVec3};
use toile::body::{Surface, mannequin};
use toile::cloth::build;
use toile::fit::{BodyIndex, measure, verdict};
use toile::session::samples::Sample;
use toile::session::{Document, Project, project_file};
use toile::ui::App;

const SIZE: [f32; 2] = [1400.0, 880.0];
/// What the program writes to standard error, in its home.
const ERRORS: &str = "errors";
/// Room for the skirt over the hips, metres.
const EASE: f64 = 0.03;

/// A program that ends with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

/// The window on its display.
struct Screen {
    display: String,
    /// Milliseconds a frame takes, and room.
    frame: u64,
    server: Running,
    window: Running,
}

/// Whether `program` is on this machine. Where pictures are required so are the display and the hand.
fn has(program: &str) -> bool {
    let found = Process::new(program).arg("-version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    assert!(
        found.is_ok() || std::env::var_os("TOILE_REQUIRE_ADAPTER").is_none(),
        "{program} is missing: the README names the package"
    );
    found.is_ok()
}

impl Screen {
    fn new(project: &Path, home: &Path) -> Self {
        let [width, height] = SIZE;
        let log = home.join("display");
        let server = Process::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", &format!("{width}x{height}x24"), "-nolisten", "tcp"])
            .stdout(std::fs::File::create(&log).expect("a file"))
            .stderr(Stdio::null())
            .spawn();
        let server = Running(server.expect("a virtual display"));
        let number = || std::fs::read_to_string(&log).ok().filter(|text| text.ends_with('\n'));
        wait("the display", || number().is_some());
        let display = format!(":{}", number().unwrap_or_default().trim());
        let window = Process::new(env!("CARGO_BIN_EXE_toile"))
            .arg(project)
            .env("DISPLAY", &display)
            .env_remove("WAYLAND_DISPLAY")
            .envs(
                ["XDG_CONFIG_HOME", "XDG_STATE_HOME", "XDG_DATA_HOME", "XDG_RUNTIME_DIR"].map(|k| (k, home)),
            )
            .stderr(std::fs::File::create(home.join(ERRORS)).expect("a file"))
            .spawn();
        let mut screen = Self { display, frame: 500, server, window: Running(window.expect("the program")) };
        wait("the window", || screen.hand(&["search", "--onlyvisible", "--name", "Toile"]));
        // Its first frames; the keyboard is nobody's in a display without a window manager.
        pause(3000);
        assert!(screen.hand(&["search", "--onlyvisible", "--name", "Toile", "windowfocus"]));
        pause(500);
        screen.frame = (0..3).map(|_| 100 + 2 * screen.answer(project)).max().unwrap_or_default();
        screen
    }

    /// Milliseconds from a key to what it does: processors that draw and have other things to do are slow, and a drag
    /// that begins and ends between two frames is none.
    fn answer(&self, project: &Path) -> u64 {
        let written = || std::fs::metadata(project).and_then(|file| file.modified()).ok();
        let (before, start) = (written(), Instant::now());
        assert!(self.hand(&["key", "ctrl+s"]));
        wait("a first save", || written() != before);
        start.elapsed().as_millis() as u64
    }

    /// One call of the hand; whether it did what it was told.
    fn hand(&self, args: &[&str]) -> bool {
        let mut call = Process::new("xdotool");
        call.args(args).env("DISPLAY", &self.display).stdout(Stdio::null()).stderr(Stdio::null());
        call.status().is_ok_and(|status| status.success())
    }

    fn key(&self, keys: &str) {
        assert!(self.hand(&["key", keys]), "{keys}");
        pause(self.frame);
    }

    fn click(&self, at: Pos2) {
        self.point(at);
        pause(self.frame);
        assert!(self.hand(&["click", "1"]));
        pause(self.frame);
    }

    fn point(&self, at: Pos2) {
        let [x, y] = [at.x, at.y].map(|v| (v.round() as i32).to_string());
        assert!(self.hand(&["mousemove", &x, &y]));
        pause(40);
    }

    /// Presses at the first place, goes through all and lets go at the last.
    fn drag(&self, places: &[Pos2]) {
        self.point(places[0]);
        pause(self.frame);
        assert!(self.hand(&["mousedown", "1"]));
        pause(self.frame);
        places[1..].iter().for_each(|&at| self.point(at));
        pause(self.frame);
        assert!(self.hand(&["mouseup", "1"]));
        pause(self.frame);
    }

    /// Saves until the file is as `done` says.
    fn saved(&self, file: &Path, what: &str, done: impl Fn(&Project) -> bool) -> Project {
        let mut last = None;
        wait(what, || {
            self.key("ctrl+s");
            last = project_file::open(file).ok();
            last.as_ref().is_some_and(&done)
        });
        last.expect("a project")
    }
}

fn pause(milliseconds: u64) {
    std::thread::sleep(Duration::from_millis(milliseconds));
}

fn wait(what: &str, mut done: impl FnMut() -> bool) {
    let start = Instant::now();
    while !done() {
        assert!(start.elapsed() < Duration::from_secs(120), "{what}: not within two minutes");
        pause(20);
    }
}

/// The same window without a display.
fn twin(project: &Project) -> Harness<'static, Option<App>> {
    let mut start = Some(project.clone());
    let builder = Harness::builder().with_size(Vec2::from(SIZE)).with_step_dt(1.0 / 60.0);
    let mut window = builder.build_ui_state(
        move |ui, app: &mut Option<App>| {
            let app = app.get_or_insert_with(|| {
                let project = start.take().expect("only once");
                App::new(ui.ctx(), project, None, None).expect("a thread for the simulation")
            });
            app.ui(ui);
        },
        None,
    );
    window.run_steps(6);
    window
}

/// Where a point of the table is on the screen.
fn on_screen(twin: &Harness<'_, Option<App>>, p: DVec2) -> Pos2 {
    twin.state().as_ref().and_then(|app| app.on_screen(p)).expect("a frame was drawn")
}

/// The straight line nearest to pairs of values, as a function.
fn line_through(pairs: &[[f64; 2]]) -> impl Fn(f64) -> f64 + use<> {
    let n = pairs.len() as f64;
    let [x, y] = [0, 1].map(|k| pairs.iter().map(|pair| pair[k]).sum::<f64>() / n);
    let slope = pairs.iter().map(|p| (p[0] - x) * (p[1] - y)).sum::<f64>()
        / pairs.iter().map(|p| (p[0] - x).powi(2)).sum::<f64>();
    move |value| y + slope * (value - x)
}

/// A level stroke round the front of the hips as seen by the twin's camera, from left to right, and how long it and the
/// one behind it are on the skin, metres.
fn round_the_hips(twin: &Harness<'_, Option<App>>, body: &Surface, y: f64) -> (Vec<Pos2>, [f64; 2]) {
    let pane: Rect = twin.get_by_label("Body pane").rect();
    let size = glam::Vec2::new(pane.width(), pane.height());
    let camera = twin.state().as_ref().expect("the app").camera();
    let level = camera.project(DVec3::new(0.0, y, 0.0).as_vec3(), size).expect("in sight").pixel.y;
    let hits = |x: f32| {
        let ray = camera.ray(glam::Vec2::new(x, level), size);
        let (origin, way) = (ray.origin.as_dvec3(), ray.direction.as_dvec3().normalize());
        let near = body.ray(origin, way)?.point;
        let far = body.ray(origin + way * 20.0, -way)?.point;
        Some((x, near, far))
    };
    // Trunk only: hands hang beside it.
    let middle = camera.project(DVec3::new(0.0, y, 0.0).as_vec3(), size).expect("in sight").pixel.x;
    let right: Vec<_> = (0..).map_while(|i| hits(middle + i as f32)).collect();
    let leap = right.windows(2).position(|w| w[0].1.distance(w[1].1) > 0.02).unwrap_or(right.len());
    let count = leap * 4 / 5;
    let across = |i: i64| hits(middle + i as f32).expect("skin");
    let row: Vec<_> = (-(count as i64)..=count as i64).map(across).collect();
    let far = |pick: fn(&(f32, DVec3, DVec3)) -> DVec3| {
        row.windows(2).map(|w| pick(&w[0]).distance(pick(&w[1]))).sum::<f64>()
    };
    let lengths = [far(|hit| hit.1), far(|hit| hit.2)];
    let places = row.iter().step_by(8).map(|hit| pos2(pane.left() + hit.0, pane.top() + level)).collect();
    (places, lengths)
}

#[test]
fn a_skirt_is_drawn_sewn_marked_and_dressed_with_the_pointer() {
    if !has("Xvfb") || !has("xdotool") {
        return;
    }
    let home = tempfile::tempdir().expect("a folder");
    let file = home.path().join("skirt.toile");
    let empty = Project { document: Document::default(), dressed: None };
    project_file::save(&file, &empty).expect("saved");
    let figure = mannequin::default();
    let body = Surface::new(figure.mesh.clone()).expect("a body");
    let hips = figure.tapes.iter().find(|tape| tape.name == "hip").expect("a tape").origin.y;
    let round = figure.measurements.hip;
    let (width, height) = ((round + EASE) / 2.0, 0.4);
    let screen = Screen::new(&file, home.path());

    // Front and back, side by side, further apart than corners draw each other on.
    let shown = twin(&empty);
    let choose = |tool: &str| screen.click(shown.get_by_label(tool).rect().center());
    let at = |p: DVec2| on_screen(&shown, p);
    let mut drawn_from = Vec::new();
    for left in [-0.03 - width, 0.03] {
        choose("Rectangle");
        let ends = [DVec2::new(left, 0.2), DVec2::new(left + width, 0.2 - height)];
        screen.drag(&[at(ends[0]), at(ends[0].midpoint(ends[1])), at(ends[1])]);
        drawn_from.push(ends.map(at));
    }
    let drawn = screen.saved(&file, "two pieces", |p| p.document.pattern.pieces.len() == 2);
    // The side seams: the right edge of each to the left edge of the other.
    let pieces: Vec<_> = drawn.document.pattern.pieces.values().cloned().collect();
    let boxes = pieces.iter().map(|piece| {
        let corners: Vec<DVec2> =
            piece.outline.iter().map(|e| piece.pose.plane_from_piece(e.start)).collect();
        corners.iter().fold([corners[0]; 2], |[a, b], &p| [a.min(p), b.max(p)])
    });
    let boxes: Vec<[DVec2; 2]> = boxes.collect();
    // What was drawn tells where the table lies on this screen: the twin's panes may be some points wider.
    let corners = boxes.iter().zip(&drawn_from);
    let [xs, ys]: [Vec<[f64; 2]>; 2] = corners
        .flat_map(|(&[lower, upper], &[first, last])| {
            [
                ([lower.x, first.x.into()], [upper.y, first.y.into()]),
                ([upper.x, last.x.into()], [lower.y, last.y.into()]),
            ]
        })
        .fold([Vec::new(), Vec::new()], |[mut xs, mut ys], (x, y)| {
            xs.push(x);
            ys.push(y);
            [xs, ys]
        });
    let (across, up) = (line_through(&xs), line_through(&ys));
    let at = |p: DVec2| pos2(across(p.x) as f32, up(p.y) as f32);
    let side = |i: usize, right: bool, lift: f64| {
        let [lower, upper] = boxes[i];
        DVec2::new(if right { upper.x } else { lower.x }, (lower.y + upper.y) / 2.0 + lift)
    };
    choose("Sew");
    for [from, to] in
        [[side(0, true, 0.05), side(1, false, 0.05)], [side(1, true, 0.05), side(0, false, 0.05)]]
    {
        screen.click(at(from));
        screen.click(at(to));
    }
    screen.saved(&file, "two seams", |p| p.document.pattern.seams.len() == 2);

    // A stroke along the top of each, as long as the one round the hips; the one behind runs the other way.
    let (strokes, lengths) = round_the_hips(&shown, &body, hips);
    choose("Mark");
    for (i, length) in lengths.into_iter().enumerate() {
        let [lower, upper] = boxes[i];
        let middle = DVec2::new((lower.x + upper.x) / 2.0, upper.y - 0.03);
        let half = DVec2::X * (length / 2.0) * if i == 0 { 1.0 } else { -1.0 };
        let line: Vec<Pos2> = (0..=12).map(|k| at(middle - half + half * (f64::from(k) / 6.0))).collect();
        screen.drag(&line);
    }
    choose("Laser");
    screen.drag(&strokes);
    screen.saved(&file, "two pairs of marks", |p| {
        p.document.marks.cloth.len() == 2 && p.document.marks.body.len() == 2
    });

    screen.click(shown.get_by_label("Wrap").rect().center());
    let index = BodyIndex::new(&body);
    let fits = |p: &Project| {
        let Some(dressed) = &p.dressed else { return false };
        let (garment, problems) = build(&p.document.pattern, p.document.settings.edge_length);
        if !problems.is_empty() || garment.vertex_count != dressed.cloth.positions.len() {
            return false;
        }
        let report = measure(&p.document.pattern, &Arc::new(garment), &dressed.cloth, &index);
        verdict(&report).is_empty() && report.strain.p99 < 0.05 && report.openings.len() == 2
    };
    screen.saved(&file, "a dressed skirt", fits);
}

/// In an idle window Xlib ends the program by itself; in one that is drawn all the time winit panics.
#[test]
fn a_display_that_goes_away_is_told_and_the_work_is_kept() {
    if !["Xvfb", "xdotool"].into_iter().all(has) {
        return;
    }
    for draws in [false, true] {
        let home = tempfile::tempdir().expect("a folder");
        let project = home.path().join("skirt.toile");
        let skirt = Sample::Skirt.project(&mannequin::default());
        project_file::save(&project, &skirt).expect("saved");
        let mut screen = Screen::new(&project, home.path());
        // A wrap changes the project, and is drawn while it lasts.
        screen.key("Return");
        let sessions = home.path().join("toile/sessions");
        wait("the wrap in the journal", || {
            journal_of(&sessions).is_some_and(|text| text.contains("\"wrap\""))
        });
        pause(if draws { 300 } else { 8_000 });
        screen.server.0.kill().expect("ended");
        wait("the end", || screen.window.0.try_wait().is_ok_and(|code| code.is_some()));
        let code = screen.window.0.wait().expect("it has ended").code();
        let errors = std::fs::read_to_string(home.path().join(ERRORS)).expect("a file");
        assert!(errors.contains("toile: the connection to the display was lost; "), "{errors}");
        assert!(errors.contains("is kept, and offered") && !errors.contains("internal error"), "{errors}");
        assert_eq!(code, Some(5), "{errors}");
        assert!(journal_of(&sessions).is_some(), "the work is kept");
    }
}

/// The journal of the only session that is kept in `folder`.
fn journal_of(folder: &Path) -> Option<String> {
    let session = std::fs::read_dir(folder).ok()?.flatten().find(|entry| entry.path().is_dir())?.path();
    let files = std::fs::read_dir(session).ok()?.flatten().map(|entry| entry.path());
    let journals = files.filter(|path| path.extension().is_some_and(|ending| ending == "journal"));
    journals.filter_map(|path| std::fs::read_to_string(path).ok()).last()
}
