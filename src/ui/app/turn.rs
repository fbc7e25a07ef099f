//! Renders a turntable, or a picture that is drawn finer than its pixels: one tile per frame, so that it can be stopped.

use std::path::{Path, PathBuf};

use egui::{Align2, Area, Frame, Id, Order};

use crate::render::Camera;
use crate::ui::app::App;
use crate::ui::app::picture_page::{PictureOptions, PlannedPicture};
use crate::ui::files;
use crate::ui::language::{say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::scenery::portrait::numbered;

/// Pictures being rendered: a turntable, or a single one.
#[derive(Debug)]
pub struct Turn {
    path: PathBuf,
    options: PictureOptions,
    first: Camera,
    done: u32,
    /// The picture that is being drawn.
    present: Option<PlannedPicture>,
}

impl Turn {
    /// The camera of the next picture.
    fn camera(&self) -> Camera {
        let part = std::f32::consts::TAU * self.done as f32 / self.options.count as f32;
        let turn = glam::Quat::from_rotation_y(part);
        let middle = self.first.bounds.0;
        let pivot = middle + turn * (self.first.pivot - middle);
        Camera { rotation: turn * self.first.rotation, pivot, ..self.first }
    }

    /// The file of picture `i`.
    fn file(&self, i: u32) -> PathBuf {
        match self.options.count {
            1 => self.path.clone(),
            count => numbered(&self.path, i, count),
        }
    }

    /// Part of the work that is done, 0..=1.
    fn share(&self) -> f32 {
        let (tile, tiles) = self.present.as_ref().map_or((0, 1), |picture| picture.drawing.progress());
        (self.done as f32 + tile as f32 / tiles.max(1) as f32) / self.options.count as f32
    }
}

impl App {
    /// Begins the pictures of a turntable by the options chosen last, into files numbered after `path`; or the single one at
    /// `path`.
    pub(in crate::ui) fn begin_pictures(&mut self, path: &Path) {
        let options = self.picture_options;
        let first = self.camera_of_picture(&options);
        self.shell.turn = Some(Turn { path: path.to_owned(), options, first, done: 0, present: None });
    }

    /// Renders the next tile of the pictures and draws the progress.
    pub(in crate::ui) fn go_on_turning(&mut self, ctx: &egui::Context, palette: &Palette, above: f32) {
        let Some(mut turn) = self.shell.turn.take() else { return };
        if let Err(words) = self.draw_tile(&mut turn) {
            return self.messages.error(words);
        }
        let (done, count) = (turn.done, turn.options.count);
        if done == count {
            let last = turn.file(count - 1);
            let path = last.display();
            return match count {
                1 => self.wrote(&last),
                _ => self.messages.tell(say!("Written: {count} pictures, the last {path}", count, path)),
            };
        }
        let words = match count {
            1 => tr("The picture is being drawn").to_owned(),
            _ => say!("Picture {done} of {count}", done, count),
        };
        if progress_bar_ui(ctx, palette, above, &words, turn.share()) {
            return self.messages.tell(match count {
                1 => tr("The picture was stopped: nothing is written").to_owned(),
                _ => say!("Stopped after {done} of {count} pictures", done, count),
            });
        }
        self.shell.turn = Some(turn);
        ctx.request_repaint();
    }

    /// Renders a tile; after the last one of a picture that is written. The error is a message.
    fn draw_tile(&mut self, turn: &mut Turn) -> Result<(), String> {
        let mut picture = match turn.present.take() {
            Some(picture) => picture,
            None => self.plan_picture(&turn.options, &turn.camera())?,
        };
        self.draw_more(&mut picture)?;
        if picture.drawing.is_done() {
            files::write(&turn.file(turn.done), &picture.developed()?)?;
            turn.done += 1;
        } else {
            turn.present = Some(picture);
        }
        Ok(())
    }
}

/// Draws the progress, `done` of `count` pictures, at the bottom of the window, `above` its edge; true when the user stops it.
pub fn progress_ui(ctx: &egui::Context, palette: &Palette, above: f32, done: usize, count: usize) -> bool {
    progress_bar_ui(
        ctx,
        palette,
        above,
        &say!("Picture {done} of {count}", done, count),
        done as f32 / count as f32,
    )
}

/// Draws `words` and a bar, of which `share` (0..=1) is full, at the bottom of the window; true when the user stops it.
pub fn progress_bar_ui(ctx: &egui::Context, palette: &Palette, above: f32, words: &str, share: f32) -> bool {
    let area = Area::new(Id::unique("pictures")).order(Order::Foreground);
    let shown = area.anchor(Align2::CENTER_BOTTOM, [0.0, -above - 14.0]).show(ctx, |ui| {
        let row = |ui: &mut egui::Ui| {
            ui.label(words);
            let bar = egui::ProgressBar::new(share).fill(palette.accent);
            ui.add(bar.desired_width(160.0).desired_height(8.0));
            ui.button(tr("Stop")).clicked()
        };
        Frame::popup(ui.style()).show(ui, |ui| ui.horizontal(row).inner).inner
    });
    shown.inner
}
