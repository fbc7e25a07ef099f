//! When the graphics device is lost, the window is opened anew with everything that was in it.

use std::sync::{Arc, Mutex, PoisonError};

use egui::ViewportCommand;
use glam::UVec2;

use crate::ui::app::App;
use crate::ui::app::picture_page::PictureOptions;

/// Wakes whichever window there is.
#[derive(Clone, Debug)]
pub struct Wakeup(Arc<Mutex<egui::Context>>);

impl Wakeup {
    /// For the window of `ctx`.
    pub fn new(ctx: &egui::Context) -> Self {
        Self(Arc::new(Mutex::new(ctx.clone())))
    }

    /// The window looks at what is new.
    pub fn wake(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).request_repaint();
    }

    fn set(&self, ctx: &egui::Context) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = ctx.clone();
    }
}

impl App {
    /// Whether the window closes only to be opened again by [`Self::move_into`].
    pub fn is_moving(&self) -> bool {
        self.moving
    }

    /// Closes the window once the device that draws is gone.
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

    /// Lives on in another window, with its device; without `graphics` the body pane stays empty. Document, history and
    /// cloth are what they were.
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
        self.messages.error("The graphics device was lost and is there again. Nothing of your work is lost.");
    }

    /// The body as it is seen now, as PNG of `size` pixels. The error is in words.
    pub fn picture_of_body(&mut self, size: UVec2) -> Result<Vec<u8>, String> {
        let options = PictureOptions { size, ..PictureOptions::default() };
        let camera = self.camera_of_picture(&options);
        self.photograph(&options, &camera)
    }
}
