//! Makes the fit report: one picture per frame, so that it can be stopped.

use std::path::{Path, PathBuf};

use crate::pack::no_adapter;
use crate::ui::app::App;
use crate::ui::app::turn::progress_ui;
use crate::ui::files;
use crate::ui::fit_page::FitPage;
use crate::ui::language::pictures::no_picture;
use crate::ui::language::tr;
use crate::ui::look::theme::Palette;

/// A fit report in the making.
#[derive(Debug)]
pub struct Reporting {
    path: PathBuf,
    page: FitPage,
}

impl App {
    /// Begins the fit report of the dressed garment; it is written to `path`.
    pub(in crate::ui) fn begin_fit_page(&mut self, path: &Path) {
        let name = self.path.as_deref().map_or_else(|| tr("untitled").to_owned(), files::stem);
        match FitPage::of(&self.session, &name) {
            Some(page) => self.shell.reporting = Some(Reporting { path: path.to_owned(), page }),
            None => self.messages.error(tr("There is no cloth on the body")),
        }
    }

    /// Draws the next picture of the report and the progress; after the last picture the page is written.
    pub(in crate::ui) fn go_on_reporting(&mut self, ctx: &egui::Context, palette: &Palette, above: f32) {
        let Some(mut report) = self.shell.reporting.take() else { return };
        match &mut self.scene_pane.graphics {
            Some(graphics) => {
                let drawn = report
                    .page
                    .draw_next(|scene, camera, look, size| graphics.photograph(scene, camera, look, size));
                if let Err(why) = drawn {
                    return self.messages.error(no_picture(&why));
                }
            }
            None => report.page.leave_pictures_out(no_adapter()),
        }
        let (done, count) = report.page.progress();
        if done == count || self.scene_pane.graphics.is_none() {
            return match files::write(&report.path, report.page.html().as_bytes()) {
                Ok(()) => self.wrote(&report.path),
                Err(words) => self.messages.error(words),
            };
        }
        if progress_ui(ctx, palette, above, done, count) {
            return self.messages.tell(tr("The fit report was stopped: nothing is written"));
        }
        self.shell.reporting = Some(report);
        ctx.request_repaint();
    }
}
