//! What lies over the picture: small buttons, and what screen readers are told.

use egui::accesskit::Role;
use egui::{Pos2, Rect, Sense, WidgetInfo};

use super::size_of;
use crate::render::Camera;
use crate::ui::actions::{Action, VIEWS};
use crate::ui::asks::{Ask, Asks};
use crate::ui::theme::Palette;
use crate::wrap::Marks;

/// Small buttons over the lower right corner, where they hide only floor.
pub(super) fn view_buttons(ui: &mut egui::Ui, pane: Rect, palette: &Palette, asks: &mut Asks) {
    let area = Rect::from_min_max(
        Pos2::new(pane.left() + 8.0, pane.bottom() - 34.0),
        Pos2::new(pane.right() - 8.0, pane.bottom() - 8.0),
    );
    let layout = egui::Layout::right_to_left(egui::Align::Center);
    ui.scope_builder(egui::UiBuilder::new().max_rect(area).layout(layout), |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let all = std::iter::once(Action::FrameAll).chain(VIEWS[..5].iter().rev().map(|&v| Action::Look(v)));
        for action in all {
            let entry = action.entry();
            let button =
                egui::Button::new(egui::RichText::new(entry.text).size(12.5)).fill(palette.overlay).small();
            if ui.add(button).on_hover_text(entry.tip).clicked() {
                asks.push(Ask::Act(action));
            }
        }
    });
}

/// Tells screen readers and tests where each mark is.
pub(super) fn publish_marks(ui: &egui::Ui, marks: &Marks, what: &str, pane: Rect, camera: &Camera) {
    for (i, mark) in marks.body.iter().enumerate() {
        let place = mark.points.first().and_then(|p| camera.project(p.as_vec3(), size_of(pane)));
        if let Some(place) = place {
            let at = pane.min + egui::vec2(place.pixel.x, place.pixel.y);
            let rect = Rect::from_center_size(at, egui::vec2(12.0, 12.0));
            let node = ui.interact(rect, ui.scope_id().with((what, "on the body", i)), Sense::hover());
            node.widget_info(|| {
                WidgetInfo::labeled(Role::Label, true, format!("{what} {} on the body", i + 1))
            });
        }
    }
}
