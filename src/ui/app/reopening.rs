//! Reopens the window with all its contents when the graphics device is lost.

use std::sync::{Arc, Mutex, PoisonError};

use egui::ViewportCommand;
use glam::UVec2;

use crate::ui::app::App;
use crate::ui::app::picture_page::PictureOptions;
use crate::ui::language::tr;

/// Wakes the current window, also after it was reopened.
#[derive(Clone, Debug)]
pub struct Wakeup(Arc<Mutex<egui::Context>>);

impl Wakeup {
    /// Wakes the window of `ctx`.
    pub fn new(ctx: &egui::Context) -> Self {
        Self(Arc::new(Mutex::new(ctx.clone())))
    }

    /// Requests a repaint, so that the window notices new results.
    pub fn wake(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).request_repaint();
    }

    fn set(&self, ctx: &egui::Context) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = ctx.clone();
    }
}

impl App {
    /// Whether the window closes only to be reopened by [`Self::move_into`].
    pub fn is_moving(&self) -> bool {
        self.moving
    }

    /// Closes the window if the graphics device is lost.
    pub(in crate::ui) fn tend_graphics(&mut self, ctx: &egui::Context) {
        let graphics = self.scene_pane.graphics.as_ref();
        let Some(why) = graphics.and_then(|graphics| graphics.lost()).filter(|_| !self.moving) else {
            return;
        };
        tracing::error!("the graphics device was lost: {why}");
        self.stop_demo();
        (self.moving, self.may_close) = (true, true);
        ctx.send_viewport_cmd(ViewportCommand::Close);
    }

    /// Moves the app into another window with its device; without `graphics` the body pane stays empty. Document, history and
    /// cloth are unchanged.
    pub fn move_into(&mut self, ctx: &egui::Context, graphics: Option<egui_wgpu::RenderState>) {
        Self::set_up(ctx);
        self.wakeup.set(ctx);
        self.scene_pane = std::mem::take(&mut self.scene_pane).drawn_by(graphics);
        self.shell.thumbnails.begin_anew();
        (self.shell.turn, self.shell.reporting) = (None, None);
        self.native = None;
        self.end_drag();
        self.live_by_preferences(ctx);
        self.forget_title();
        (self.moving, self.may_close) = (false, false);
        let words = tr("The graphics device was lost and is there again. Nothing of your work is lost.");
        self.messages.error(words);
    }

    /// The present view of the body as a PNG of `size` pixels. The error is a message.
    pub fn picture_of_body(&mut self, size: UVec2) -> Result<Vec<u8>, String> {
        let options = PictureOptions { size, ..PictureOptions::default() };
        let camera = self.camera_of_picture(&options);
        self.photograph(&options, &camera)
    }
}
