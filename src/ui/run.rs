//! Opens the window.

use std::fs::File;
use std::path::PathBuf;
use std::sync::Arc;

use anyhow::{Context, anyhow};

use crate::session::Project;
use crate::ui::app::App;
use crate::ui::{preferences, safety, thumbnails};

/// Opens the window on `project`, which came from the file `path`, or on the start page, and returns when it is closed.
/// Everything done is also written to `record`.
pub fn run(project: Option<Project>, path: Option<PathBuf>, record: Option<File>) -> anyhow::Result<()> {
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("Toile")
            .with_app_id("toile")
            .with_inner_size([1400.0, 880.0])
            .with_min_inner_size([880.0, 540.0]),
        ..Default::default()
    };
    let create: eframe::AppCreator<'_> = Box::new(move |cc| {
        if let Some(state) = &cc.wgpu_render_state {
            state.device.on_uncaptured_error(Arc::new(|e| tracing::error!("graphics: {e}")));
        }
        let is_start = project.is_none();
        let project = project.unwrap_or_default();
        let mut app = App::new(&cc.egui_ctx, project, path.clone(), cc.wgpu_render_state.clone())?;
        if let Some(path) = preferences::usual_path() {
            app.keep_preferences(&cc.egui_ctx, path);
        }
        if let Some(folder) = thumbnails::usual_folder() {
            app.keep_thumbnails(folder);
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
        Ok(Box::new(app))
    });
    eframe::run_native("Toile", options, create)
        .map_err(|e| anyhow!(words(&e)))
        .context("the window could not be opened")
}

/// What went wrong, and what to do about it where that is known.
fn words(error: &eframe::Error) -> String {
    use winit::error::EventLoopError;
    match error {
        eframe::Error::WinitEventLoop(EventLoopError::NotSupported(_)) => {
            "this system has no windows; see toile --help for what works without".to_owned()
        }
        eframe::Error::WinitEventLoop(EventLoopError::ExitFailure(code)) => {
            format!("the connection to the display broke (code {code})")
        }
        other => other.to_string(),
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        App::ui(self, ui);
    }

    fn on_exit(&mut self) {
        self.finish();
    }
}
