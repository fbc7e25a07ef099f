//! Widgets over the picture: small buttons, and nodes for screen readers.

use egui::accesskit::Role;
use egui::{Pos2, Rect, Sense, WidgetInfo};

use super::{Seen, size_of};
use crate::render::{Camera, Look};
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, tr};
use crate::wrap::Marks;

/// Space between two small buttons, points.
const SPACING: f32 = 4.0;

/// Draws the small buttons for display options and framing in the lower right corner, where they hide only floor: beside each
/// other, or above each other where the pane is narrower than their row in the last frame. Returns their area.
pub(super) fn view_buttons(ui: &mut egui::Ui, pane: Rect, seen: &Seen<'_>, asks: &mut Asks) -> Rect {
    let id = egui::Id::unique("width of the view buttons");
    let known: f32 = ui.data(|d| d.get_temp(id)).unwrap_or_default();
    let is_row = known <= pane.width() - 16.0;
    let (height, layout) = match is_row {
        true => (34.0, egui::Layout::right_to_left(egui::Align::Center)),
        false => (pane.height(), egui::Layout::bottom_up(egui::Align::Max)),
    };
    let area = Rect::from_min_max(
        Pos2::new(pane.left() + 8.0, pane.bottom() - height),
        Pos2::new(pane.right() - 8.0, pane.bottom() - 8.0),
    );
    let mut taken = Rect::NOTHING;
    let mut width = -SPACING;
    ui.scope_builder(egui::UiBuilder::new().max_rect(area).layout(layout), |ui| {
        ui.spacing_mut().item_spacing = egui::Vec2::splat(SPACING);
        let Look { wire, sheer, xray, .. } = seen.look;
        for (action, on) in [
            (Action::FrameAll, false),
            (Action::ToggleXray, xray),
            (Action::ToggleSheer, sheer),
            (Action::ToggleWire, wire),
        ] {
            let entry = action.row();
            let text = egui::RichText::new(tr(entry.text)).size(12.5);
            let button = egui::Button::new(text).wrap_mode(egui::TextWrapMode::Extend).selected(on).small();
            let button = if on { button } else { button.fill(seen.palette.overlay) };
            let button = ui.add(button).on_hover_text(tr(entry.tip));
            taken |= button.rect;
            width += SPACING + button.rect.width();
            if button.clicked() {
                asks.push(Ask::Act(action));
            }
        }
    });
    if (width - known).abs() > 0.1 {
        ui.data_mut(|d| d.insert_temp(id, width));
        ui.ctx().request_repaint();
    }
    taken
}

/// Publishes the position of each mark to screen readers and tests.
pub(super) fn publish_marks(ui: &egui::Ui, marks: &Marks, proposed: bool, pane: Rect, camera: &Camera) {
    for (i, mark) in marks.body.iter().enumerate() {
        let place = mark.points.first().and_then(|p| camera.project(p.as_vec3(), size_of(pane)));
        if let Some(place) = place {
            let at = pane.min + egui::vec2(place.pixel.x, place.pixel.y);
            let rect = Rect::from_center_size(at, egui::vec2(12.0, 12.0));
            let node =
                ui.interact(rect, ui.scope_id().with(("mark on the body", proposed, i)), Sense::hover());
            let words = || match proposed {
                true => say!("Proposed mark {number} on the body", number = i + 1),
                false => say!("Mark {number} on the body", number = i + 1),
            };
            node.widget_info(|| WidgetInfo::labeled(Role::Label, true, words()));
        }
    }
}
