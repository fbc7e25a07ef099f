//! The bar over the table with the options of the chosen tool.

use super::kept::Options;
use egui::{Frame, Rect, RichText, UiBuilder, vec2};

use super::table::Table;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::{Action, Tool};
use crate::ui::language::keys::shortcut_text;
use crate::ui::language::{counted, tr};
use crate::ui::panels::fields::length_field;

/// Draws the bar and returns its area; nothing for tools without options.
pub fn options_ui(
    ui: &mut egui::Ui,
    table: &Table<'_>,
    options: &mut Options,
    asks: &mut Asks,
) -> Option<Rect> {
    let twisted = table.threads.twisted().count();
    let wanted = match table.laid.tool {
        Tool::Cut | Tool::Dart => true,
        Tool::Sew => true,
        _ => twisted > 0,
    };
    if !wanted {
        return None;
    }
    let area = Rect::from_min_size(table.pane.min + vec2(8.0, 6.0), vec2(table.pane.width() - 16.0, 30.0));
    let palette = table.laid.palette;
    let shown = ui.scope_builder(
        UiBuilder::new().max_rect(area).layout(egui::Layout::left_to_right(egui::Align::Center)),
        |ui| {
            Frame::new()
                .fill(palette.overlay)
                .corner_radius(6)
                .inner_margin(egui::Margin::symmetric(8, 2))
                .show(ui, |ui| {
                    let weak = |text: &str| RichText::new(text).color(palette.weak).size(12.5);
                    match table.laid.tool {
                        Tool::Cut => {
                            let tip = tr("The two sides of the cut become a seam");
                            let text = tr("Sew it together again");
                            ui.checkbox(&mut options.sew_cut, text).on_hover_text(tip);
                        }
                        Tool::Dart => {
                            let unit = table.laid.unit;
                            for (label, value) in
                                [("Width", &mut options.dart_width), ("Depth", &mut options.dart_depth)]
                            {
                                let name = ui.label(weak(tr(label)));
                                let new = length_field(ui, ("dart", label), &name, *value, unit);
                                *value = new.map_or(*value, |new| new.clamp(0.001, 1.0));
                            }
                        }
                        Tool::Sew => {
                            let tip = tr("Editing one sewn edge changes the other, too");
                            let text = tr("Keep lengths equal");
                            ui.checkbox(&mut options.keep_equal, text).on_hover_text(tip);
                        }
                        _ => {}
                    }
                    if twisted > 0 {
                        let words = counted(twisted, "1 twisted seam", "{n} twisted seams");
                        ui.label(RichText::new(words).color(palette.error).size(12.5));
                        let entry = Action::Untwist.row();
                        let keys = entry.keys.first().map(|k| shortcut_text(ui.ctx(), k)).unwrap_or_default();
                        if ui
                            .small_button(tr(entry.text))
                            .on_hover_text(format!("{}  ({keys})", tr(entry.tip)))
                            .clicked()
                        {
                            asks.push(Ask::Act(Action::Untwist));
                        }
                    }
                })
                .response
                .rect
        },
    );
    Some(shown.inner)
}
