//! Depth of field of the body pane: switched on and off, its aperture chosen in a bar over the pane, and kept in the preferences.

use crate::render::{Lens, Projection};
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::app::App;
use crate::ui::body_pane::Graphics;
use crate::ui::language::fields::slider;
use crate::ui::language::tr;
use crate::ui::preferences::depth_of_field::FNumber;

impl App {
    /// The f-number of the depth of field; None while everything is sharp.
    pub fn f_number(&self) -> Option<f32> {
        self.shell.sight.lens.map(|lens| lens.f_number)
    }

    /// Takes the lens of the body pane from the preferences, if the adapter can draw what it blurs.
    pub(in crate::ui) fn focus_lens(&mut self) {
        let blurs = self.scene_pane.graphics.as_ref().is_none_or(Graphics::blurs);
        self.shell.sight.lens = self.preferences.depth_of_field.lens().filter(|_| blurs);
        self.shell.sets_aperture &= self.shell.sight.lens.is_some();
    }

    /// Switches depth of field on, with the bar of its aperture, or off.
    pub(in crate::ui) fn toggle_depth_of_field(&mut self, ctx: &egui::Context) {
        self.prefer(ctx, |p| p.depth_of_field.is_on = !p.depth_of_field.is_on);
        self.show_aperture(self.shell.sight.lens.is_some());
    }

    /// Opens or closes the bar of the aperture. The bar of the environment map has the same place.
    pub(in crate::ui) fn show_aperture(&mut self, is_shown: bool) {
        self.shell.sets_aperture = is_shown;
        self.shell.environment.is_rotated &= !is_shown;
    }

    /// Draws the bar of the aperture, at the lower edge of the body pane, if it is open and the projection has a focus.
    pub(in crate::ui) fn aperture_ui(&mut self, ctx: &egui::Context, asks: &mut Asks) {
        if !self.shell.sets_aperture || self.scene_pane.camera.projection == Projection::Orthographic {
            return;
        }
        let mut f_number = self.preferences.depth_of_field.f_number.limited();
        let shown = self.bar_ui(ctx, "aperture", |ui| slider_ui(ui, &mut f_number));
        let Some((slider, closes)) = shown else { return };
        let chosen = FNumber((f_number * 10.0).round() / 10.0);
        if slider.dragged() && chosen != self.preferences.depth_of_field.f_number {
            // It is kept when the slider is released.
            self.preferences.depth_of_field.f_number = chosen;
            self.focus_lens();
            ctx.request_repaint();
        } else if slider.drag_stopped() || slider.changed() {
            self.prefer(ctx, |p| p.depth_of_field.f_number = chosen);
            ctx.request_repaint();
        }
        if closes {
            asks.push(Ask::Act(Action::SetAperture));
        }
    }
}

fn slider_ui(ui: &mut egui::Ui, f_number: &mut f32) -> egui::Response {
    let label = ui.label(tr("Aperture"));
    let slider = slider(f_number, Lens::F_NUMBERS).logarithmic(true).max_decimals(1).prefix("f/");
    ui.add(slider).labelled_by(label.id)
}
