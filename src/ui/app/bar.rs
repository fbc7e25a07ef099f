//! A bar over the body pane with one slider.

use egui::{Align2, Area, Frame, Id, Order, Response, Ui};

use crate::ui::app::App;
use crate::ui::language::tr;

/// Distance of the bar from the lower edge of the pane and from the buttons there, points.
const BELOW: f32 = 12.0;

impl App {
    /// Draws a bar at the lower edge of the body pane: what `add` draws, which gives its slider, and a button. Returns the slider,
    /// and whether the bar is to be closed; None where there is no pane.
    pub(in crate::ui) fn bar_ui(
        &self,
        ctx: &egui::Context,
        id: &str,
        add: impl FnOnce(&mut Ui) -> Response,
    ) -> Option<(Response, bool)> {
        let pane = self.scene_pane.area.filter(|_| self.shell.start.is_none())?;
        let bottom =
            self.scene_pane.buttons.map_or(pane.bottom(), |buttons| buttons.top().min(pane.bottom()));
        let area = Area::new(Id::unique(id)).order(Order::Middle);
        let area = area.pivot(Align2::CENTER_BOTTOM).fixed_pos(egui::pos2(pane.center().x, bottom - BELOW));
        let whole = |ui: &mut Ui| (add(ui), ui.button(tr("Done")).clicked());
        let shown = area.show(ctx, |ui| Frame::popup(ui.style()).show(ui, |ui| ui.horizontal(whole)));
        Some(shown.inner.inner.inner)
    }
}
