//! The bar over the body pane while another garment is shown beside: what the present garment shows, and a button to end the
//! comparison.

use egui::accesskit::Role;
use egui::{Button, Frame, Margin, Rect, RichText, Spinner, Stroke, WidgetInfo, vec2};

use super::{Comparison, Opening};
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, tr};
use crate::ui::look::theme::Palette;

/// Size of the bar, points.
const SIZE: egui::Vec2 = vec2(390.0, 34.0);

/// Draws the bar of `beside` in the upper left corner of `pane`. The other garment is drawn on the left or on the right.
pub fn beside_ui(
    ui: &mut egui::Ui,
    pane: Rect,
    (beside, on_the_left): (&Comparison, bool),
    palette: &Palette,
    asks: &mut Asks,
) {
    framed_ui(ui, pane, palette, |ui| bar_ui(ui, beside, on_the_left, asks));
}

/// Draws the bar while `opening` is in progress.
pub fn opening_ui(ui: &mut egui::Ui, pane: Rect, opening: &Opening, palette: &Palette, asks: &mut Asks) {
    framed_ui(ui, pane, palette, |ui| {
        ui.add(Spinner::new().size(14.0));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            close_ui(ui, asks);
            let words = RichText::new(say!("opening {name}…", name = opening.name)).size(12.5);
            ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                ui.add(egui::Label::new(words).truncate());
            });
        });
    });
}

fn framed_ui(ui: &mut egui::Ui, pane: Rect, palette: &Palette, contents: impl FnOnce(&mut egui::Ui)) {
    let area = Rect::from_min_size(pane.min + vec2(10.0, 10.0), SIZE.min(pane.size()));
    ui.scope_builder(egui::UiBuilder::new().max_rect(area), |ui| {
        let frame = Frame::new().fill(palette.overlay).inner_margin(Margin::symmetric(9, 5)).corner_radius(6);
        frame.stroke(Stroke::new(1.0, palette.table_grid_strong)).show(ui, |ui| {
            ui.horizontal(contents);
        });
    });
}

fn bar_ui(ui: &mut egui::Ui, beside: &Comparison, on_the_left: bool, asks: &mut Asks) {
    for (text, difference, tip) in [
        ("Both maps", false, "Both in the colours of the map"),
        ("Difference", true, "This garment in the colours of what it has more than the one beside"),
    ] {
        let is_chosen = beside.difference == difference;
        let button = ui.add(Button::selectable(is_chosen, tr(text))).on_hover_text(tr(tip));
        if button.clicked() && !is_chosen {
            asks.push(Ask::Act(Action::ToggleDifference));
        }
    }
    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
        close_ui(ui, asks);
        let side = if on_the_left { tr("To the right") } else { tr("To the left") };
        let change = ui.button(side).on_hover_text(tr(Action::ChangeSides.row().tip));
        if change.clicked() {
            asks.push(Ask::Act(Action::ChangeSides));
        }
        let words = match beside.unlike() {
            Some(why) => RichText::new(why).color(ui.visuals().warn_fg_color),
            None => RichText::new(say!("beside: {name}", name = beside.name)),
        };
        ui.add(egui::Label::new(words.size(12.5)).truncate());
    });
}

fn close_ui(ui: &mut egui::Ui, asks: &mut Asks) {
    let close = ui.add(Button::new("×").small().frame(false)).on_hover_text(tr("No comparison"));
    close.widget_info(|| WidgetInfo::labeled(Role::Button, true, tr("Close the comparison")));
    if close.clicked() {
        asks.push(Ask::Act(Action::CloseComparison));
    }
}
