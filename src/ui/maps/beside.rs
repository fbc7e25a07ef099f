//! The bar over the body pane while another garment is shown beside: what the present one shows, and an end to it.

use egui::accesskit::Role;
use egui::{Button, Frame, Margin, Rect, RichText, Stroke, WidgetInfo, vec2};

use super::Comparison;
use crate::ui::actions::Action;
use crate::ui::asks::{Ask, Asks};
use crate::ui::theme::Palette;

/// Its size, points.
const SIZE: egui::Vec2 = vec2(330.0, 34.0);

/// Draws the bar of `beside` in the upper left corner of `pane`.
pub fn beside_ui(ui: &mut egui::Ui, pane: Rect, beside: &Comparison, palette: &Palette, asks: &mut Asks) {
    let area = Rect::from_min_size(pane.min + vec2(10.0, 10.0), SIZE.min(pane.size()));
    ui.scope_builder(egui::UiBuilder::new().max_rect(area), |ui| {
        let frame = Frame::new().fill(palette.overlay).inner_margin(Margin::symmetric(9, 5)).corner_radius(6);
        frame.stroke(Stroke::new(1.0, palette.table_grid_strong)).show(ui, |ui| {
            ui.horizontal(|ui| bar_ui(ui, beside, asks));
        });
    });
}

fn bar_ui(ui: &mut egui::Ui, beside: &Comparison, asks: &mut Asks) {
    for (text, difference, tip) in [
        ("Both maps", false, "Both in the colours of the map"),
        ("Difference", true, "This garment in the colours of what it has more than the one beside"),
    ] {
        let is_chosen = beside.difference == difference;
        let button = ui.add(Button::selectable(is_chosen, text)).on_hover_text(tip);
        if button.clicked() && !is_chosen {
            asks.push(Ask::Act(Action::ToggleDifference));
        }
    }
    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
        let close = ui.add(Button::new("×").small().frame(false)).on_hover_text("No comparison");
        close.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Close the comparison"));
        if close.clicked() {
            asks.push(Ask::Act(Action::CloseComparison));
        }
        let words = match beside.unlike() {
            Some(why) => RichText::new(why).color(ui.visuals().warn_fg_color),
            None => RichText::new(format!("beside: {}", beside.name)),
        };
        ui.add(egui::Label::new(words.size(12.5)).truncate());
    });
}
