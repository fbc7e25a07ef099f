//! Choosing a colour: a button in that colour, and the palette that it opens.

use egui::{Popup, PopupCloseBehavior, RectAlign, Ui};

use crate::render::Rgb;
use crate::session::Command;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::fields::drag_value;
use crate::ui::language::tr;

/// Size of the button that shows a colour, points.
pub const SWATCH: egui::Vec2 = egui::vec2(18.0, 18.0);
/// Dyes of the palette, sRGB: neutrals, then warm and cold hues from pale to deep.
const DYES: [[u8; 3]; 32] = [
    [250, 248, 244],
    [226, 220, 208],
    [190, 186, 178],
    [150, 148, 146],
    [104, 104, 106],
    [66, 66, 70],
    [36, 36, 40],
    [16, 16, 18],
    [240, 214, 206],
    [226, 160, 148],
    [206, 92, 84],
    [168, 42, 48],
    [120, 26, 38],
    [238, 200, 148],
    [222, 150, 70],
    [150, 84, 40],
    [244, 230, 160],
    [224, 190, 70],
    [176, 148, 48],
    [110, 100, 50],
    [206, 222, 190],
    [138, 186, 134],
    [74, 130, 84],
    [34, 76, 54],
    [196, 220, 232],
    [116, 170, 204],
    [47, 104, 160],
    [40, 54, 92],
    [214, 198, 224],
    [160, 128, 178],
    [104, 66, 120],
    [58, 34, 62],
];

/// A button in `colour` that opens the palette; a chosen colour becomes a `command`, a drag over the colours one step.
pub fn colour_menu(ui: &mut Ui, name: &str, colour: Rgb, asks: &mut Asks, command: impl Fn(Rgb) -> Command) {
    let [r, g, b] = colour;
    let button = egui::Button::new("").min_size(SWATCH).fill(egui::Color32::from_rgb(r, g, b));
    let response = panel_menu(ui, button, |ui| {
        let mut new = colour;
        colour_ui(ui, name, &mut new);
        if new != colour {
            asks.push(Ask::Drag(command(new)));
        }
        if ui.input(|input| input.pointer.any_released() || input.key_pressed(egui::Key::Enter)) {
            asks.push(Ask::EndDrag);
        }
    });
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
    response.on_hover_text(name);
}

/// A palette of dyes, and the colour as six hexadecimal digits.
pub fn colour_ui(ui: &mut Ui, what: &str, colour: &mut [u8; 3]) {
    let opaque = |[r, g, b]: [u8; 3]| egui::Color32::from_rgb(r, g, b);
    egui::Grid::new(("palette", what)).min_col_width(SWATCH.x).spacing(egui::vec2(3.0, 3.0)).show(ui, |ui| {
        for row in DYES.chunks(8) {
            for &dye in row {
                let line = if dye == *colour { ui.visuals().strong_text_color() } else { opaque(dye) };
                let button = egui::Button::new("").fill(opaque(dye)).stroke(egui::Stroke::new(2.0, line));
                let name = hex(dye);
                let response = ui.add(button.min_size(SWATCH));
                response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
                if response.on_hover_text(&name).clicked() {
                    *colour = dye;
                }
            }
            ui.end_row();
        }
    });
    let [r, g, b] = *colour;
    let mut number = u32::from_be_bytes([0, r, g, b]);
    let value = drag_value(&mut number).hexadecimal(6, false, false).range(0..=0xff_ffffu32).prefix("#");
    if ui.add(value).on_hover_text(tr("Red, green and blue, two digits each")).changed() {
        let [_, r, g, b] = number.to_be_bytes();
        *colour = [r, g, b];
    }
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A button that opens a menu which a click inside does not close. The menu covers the panel that the button is in, and reaches no
/// farther over the panes beside it than its contents are wider than the panel, so that these show what is changed.
pub fn panel_menu(ui: &mut Ui, button: egui::Button<'_>, contents: impl FnOnce(&mut Ui)) -> egui::Response {
    let response = ui.add(button);
    let panel = ui.clip_rect().x_range();
    Popup::menu(&response)
        .anchor(egui::Rect::from_x_y_ranges(panel, response.rect.y_range()))
        .align(RectAlign::BOTTOM_START)
        .align_alternatives(&[RectAlign::TOP_START])
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .show(|ui| {
            let frame = egui::Frame::popup(ui.style()).total_margin().sum().x;
            ui.set_width((panel.span() - frame).max(0.0));
            contents(ui);
        });
    response
}
