//! Renders a turntable: one picture per frame, so that it can be stopped.

use std::path::{Path, PathBuf};

use egui::{Align2, Area, Frame, Id, Order};

use crate::render::Camera;
use crate::ui::app::App;
use crate::ui::app::picture_page::PictureOptions;
use crate::ui::files;
use crate::ui::language::{say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::scenery::portrait::numbered;

/// A turntable being rendered.
#[derive(Debug)]
pub struct Turn {
    path: PathBuf,
    options: PictureOptions,
    first: Camera,
    done: u32,
}

impl App {
    /// Begins a turntable by the options chosen last, into files numbered after `path`.
    pub(in crate::ui) fn begin_turn(&mut self, path: &Path) {
        let options = self.picture_options;
        let first = self.camera_of_picture(&options);
        self.shell.turn = Some(Turn { path: path.to_owned(), options, first, done: 0 });
    }

    /// Renders the next picture of the turntable and draws the progress.
    pub(in crate::ui) fn go_on_turning(&mut self, ctx: &egui::Context, palette: &Palette, above: f32) {
        let Some(mut turn) = self.shell.turn.take() else { return };
        let count = turn.options.count;
        let part = std::f32::consts::TAU * turn.done as f32 / count as f32;
        let rotation = glam::Quat::from_rotation_y(part) * turn.first.rotation;
        let middle = turn.first.bounds.0;
        let pivot = middle + glam::Quat::from_rotation_y(part) * (turn.first.pivot - middle);
        let camera = Camera { rotation, pivot, ..turn.first };
        let path = numbered(&turn.path, turn.done, count);
        let written = self.photograph(&turn.options, &camera).and_then(|bytes| files::write(&path, &bytes));
        if let Err(words) = written {
            return self.messages.error(words);
        }
        turn.done += 1;
        if turn.done == count {
            let path = path.display();
            return self.messages.tell(say!("Written: {count} pictures, the last {path}", count, path));
        }
        if progress_ui(ctx, palette, above, turn.done as usize, count as usize) {
            let done = turn.done;
            return self.messages.tell(say!("Stopped after {done} of {count} pictures", done, count));
        }
        self.shell.turn = Some(turn);
        ctx.request_repaint();
    }
}

/// Draws the progress, `done` of `count` pictures, at the bottom of the window, `above` its edge; true when the user stops it.
pub fn progress_ui(ctx: &egui::Context, palette: &Palette, above: f32, done: usize, count: usize) -> bool {
    let area = Area::new(Id::unique("pictures")).order(Order::Foreground);
    let shown = area.anchor(Align2::CENTER_BOTTOM, [0.0, -above - 14.0]).show(ctx, |ui| {
        let row = |ui: &mut egui::Ui| {
            ui.label(say!("Picture {done} of {count}", done, count));
            let bar = egui::ProgressBar::new(done as f32 / count as f32).fill(palette.accent);
            ui.add(bar.desired_width(160.0).desired_height(8.0));
            ui.button(tr("Stop")).clicked()
        };
        Frame::popup(ui.style()).show(ui, |ui| ui.horizontal(row).inner).inner
    });
    shown.inner
}
