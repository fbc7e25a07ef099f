//! Shows a demo in the window, and returns to the document.

use std::sync::Arc;

use crate::render::View;
use crate::session::demos::Demo;
use crate::ui::app::App;
use crate::ui::app::player::{Player, Stage};

impl App {
    /// Shows `demo` from its beginning; the document stays unchanged meanwhile.
    pub(in crate::ui) fn begin_demo(&mut self, demo: Demo) {
        self.end_drag();
        match Player::new(demo) {
            Ok(player) => {
                let (camera, table) = match self.demo.take() {
                    Some((_, camera, table)) => (camera, table),
                    None => (self.scene_pane.camera, self.pattern_pane.view),
                };
                self.demo = Some((player, camera, table));
                self.ghosts = None;
                self.selected = None;
                self.show_cloth = true;
                self.pattern_pane.fit = true;
                self.scene_pane.frame = Some(Some(View::Front));
            }
            Err(words) => self.messages.error(words),
        }
    }

    /// Returns to the document with the views as they were before the demo.
    pub(in crate::ui) fn stop_demo(&mut self) {
        if let Some((_, camera, table)) = self.demo.take() {
            self.scene_pane.camera = camera;
            self.scene_pane.keep_view(self.session.surface().map(Arc::clone));
            self.pattern_pane.view = table;
        }
    }

    /// Advances the demo by the time of a frame.
    pub(in crate::ui) fn play_demo(&mut self, ctx: &egui::Context) {
        let Some((player, ..)) = &mut self.demo else { return };
        let (Some(table), Some(scene)) = (self.pattern_pane.area, self.scene_pane.area) else { return };
        let seconds = f64::from(ctx.input(|i| i.unstable_dt));
        let mut stage =
            Stage { table: (table, self.pattern_pane.view), scene, camera: &mut self.scene_pane.camera };
        let pieces = |player: &Player| player.session().document().pattern.pieces.len();
        let before = pieces(player);
        if let Err(words) = player.advance(seconds, &mut stage) {
            self.messages.error(words);
            return self.stop_demo();
        }
        // A walk may begin with an empty table.
        self.pattern_pane.fit |= pieces(player) != before;
        if !player.has_ended() {
            ctx.request_repaint();
        }
    }
}
