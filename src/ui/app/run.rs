//! Opens the window and runs it.

use std::cell::RefCell;
use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::Instant;

use anyhow::anyhow;

use crate::session::Project;
use crate::ui::app::App;
use crate::ui::app::safety;
use crate::ui::app::tries::{PLAIN, STARTED, Starts, prefer_processor};
use crate::ui::language::tr;
use crate::ui::preferences;

/// The picture in the window's frame and in lists of windows, where the desktop does not take it from the installed files.
const ICON: &[u8] = include_bytes!("../../../assets/install/icons/toile-256.png");
/// Number of losses of the graphics device after which the window is not reopened again.
const MOST_LOSSES: usize = 5;

/// Opens the window on `project`, which came from the file `path`, or on the start page; returns when it is closed. The recording
/// is also written to `record`. A window that loses its graphics device is reopened.
pub fn run(project: Option<Project>, path: Option<PathBuf>, record: Option<File>) -> anyhow::Result<()> {
    let kept: Kept = Rc::default();
    let mut first = Some((project, path, record));
    let root = safety::usual_root();
    let starts = root.as_deref().and_then(Path::parent).map(Starts::begin);
    let is_plain = starts.as_ref().is_some_and(Starts::is_plain);
    let starting: Starting = Rc::new(RefCell::new(starts.map(|starts| (starts, Instant::now()))));
    for _ in 0..=MOST_LOSSES {
        let mut options = eframe::NativeOptions { viewport: viewport(), ..Default::default() };
        if is_plain {
            prefer_processor(&mut options);
        }
        let starting = Rc::clone(&starting);
        let (shared, first) = (Rc::clone(&kept), first.take());
        let create: eframe::AppCreator<'_> = Box::new(move |cc| {
            let mut app = shared.borrow_mut();
            match (first, app.as_mut()) {
                (Some((project, path, record)), _) => {
                    *app = Some(opened(cc, project, path, record, is_plain)?)
                }
                (None, Some(app)) => app.move_into(&cc.egui_ctx, cc.wgpu_render_state.clone()),
                (None, None) => {}
            }
            drop(app);
            Ok(Box::new(Window { app: shared, starting }))
        });
        // egui itself may panic when it draws with a lost device.
        let ended = catch_unwind(AssertUnwindSafe(|| eframe::run_native("Toile", options, create)));
        match ended {
            Ok(ended) => {
                ended.map_err(|e| failure(&e))?;
            }
            Err(_) if kept.try_borrow().is_ok_and(|app| app.as_ref().is_some_and(App::is_moving)) => {}
            Err(panic) => resume_unwind(panic),
        }
        if !kept.borrow().as_ref().is_some_and(App::is_moving) {
            return Ok(());
        }
    }
    Err(anyhow!(
        "the graphics device was lost again and again; the work is offered when Toile is started next"
    ))
}

/// The window as the desktop sees it. Its id is the name of the installed desktop file.
fn viewport() -> egui::ViewportBuilder {
    let viewport = egui::ViewportBuilder::default()
        .with_title("Toile")
        .with_app_id("toile")
        .with_inner_size([1400.0, 880.0])
        .with_min_inner_size([880.0, 540.0]);
    match eframe::icon_data::from_png_bytes(ICON) {
        Ok(icon) => viewport.with_icon(icon),
        Err(_) => viewport,
    }
}

fn opened(
    cc: &eframe::CreationContext<'_>,
    project: Option<Project>,
    path: Option<PathBuf>,
    record: Option<File>,
    is_plain: bool,
) -> std::io::Result<App> {
    let is_start = project.is_none();
    let project = project.unwrap_or_default();
    let mut app = App::new(&cc.egui_ctx, project, path.clone(), cc.wgpu_render_state.clone())?;
    app.follow_language(sys_locale::get_locale().unwrap_or_default());
    if is_plain {
        app.warn(tr(PLAIN));
    } else {
        if let Some(path) = preferences::usual_path() {
            app.keep_preferences(&cc.egui_ctx, path);
        }
        app.make_thumbnails();
    }
    if let Some(path) = &path {
        app.remember(path);
    }
    if is_start {
        app.begin_at_start_page();
    }
    if let Some(root) = safety::usual_root() {
        app.keep_safe(&root);
    }
    if let Some(file) = record {
        app.record_to(file)?;
    }
    Ok(app)
}

/// The app, which survives when its window is reopened.
type Kept = Rc<RefCell<Option<App>>>;

/// The start being counted, until it has succeeded, and when it began.
type Starting = Rc<RefCell<Option<(Starts, Instant)>>>;

struct Window {
    app: Kept,
    starting: Starting,
}

impl Window {
    /// Tells the counter that the window is open, or with `closes` that it closes normally.
    fn tell_start(&self, ctx: &egui::Context, closes: bool) {
        let mut starting = self.starting.borrow_mut();
        let Some(waits) = starting.as_ref().map(|(_, begun)| STARTED.saturating_sub(begun.elapsed())) else {
            return;
        };
        if waits.is_zero() || closes {
            if let Some((starts, _)) = starting.take() {
                starts.well();
            }
        } else {
            ctx.request_repaint_after(waits);
        }
    }
}

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.tell_start(ui.ctx(), false);
        if let Some(app) = self.app.borrow_mut().as_mut() {
            app.ui(ui);
        }
    }

    fn on_exit(&mut self) {
        self.tell_start(&egui::Context::default(), true);
        if let Some(app) = self.app.borrow_mut().as_mut()
            && !app.is_moving()
        {
            app.end();
        }
    }
}

/// The error as a message, with advice where there is any.
fn failure(error: &eframe::Error) -> anyhow::Error {
    use winit::error::EventLoopError;
    let why = match error {
        eframe::Error::WinitEventLoop(EventLoopError::ExitFailure(_)) => return anyhow!(display_lost()),
        eframe::Error::WinitEventLoop(EventLoopError::NotSupported(_)) => {
            "this system has no windows; see toile --help for what works without".to_owned()
        }
        // Its own words name a file of winit's code.
        eframe::Error::WinitEventLoop(EventLoopError::Os(_)) => {
            "the display does not answer; see toile --help for what works without one".to_owned()
        }
        other => other.to_string(),
    };
    anyhow!("the window could not be opened: {why}")
}

/// What to say when the connection to the display is lost.
pub fn display_lost() -> String {
    let work = match safety::is_kept() {
        true => "work that was not saved is kept, and offered when Toile is started next",
        false => "work that was not saved could not be kept",
    };
    format!("the connection to the display was lost; {work}")
}

/// Whether a panic with these words, in this file of code, tells that the connection to the display is broken.
pub fn is_loss_of_display(file: &str, words: &str) -> bool {
    file.contains("winit-") && ["IoError", "ConnectionError", "BrokenPipe"].iter().any(|w| words.contains(w))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_panics_about_the_connection_are_no_fault_of_the_program() {
        let file = "/registry/winit-0.30.13/src/platform_impl/linux/x11/window.rs";
        let words = "called `Result::unwrap()` on an `Err` value: Connection(IoError(Custom))";
        assert!(is_loss_of_display(file, words));
        assert!(
            !is_loss_of_display(file, "index out of bounds")
                && !is_loss_of_display("src/ui/app/mod.rs", words)
        );
    }
}
