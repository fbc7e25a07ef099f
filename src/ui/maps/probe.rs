//! Shows the value of the map beside the pointer.

use egui::{FontId, Pos2, Rect, Stroke, Vec2};

use super::ShownMap;
use crate::ui::language::tr;
use crate::ui::look::theme::Palette;

/// Writes the value of `map` at `at` beside the pointer, inside `pane`. Returns the text: "12.3 mm, Front".
pub fn probe_ui(
    ui: &egui::Ui,
    pane: Rect,
    at: Pos2,
    map: &ShownMap,
    value: Option<f64>,
    piece: &str,
    palette: &Palette,
) -> String {
    let value = value.map_or(tr("no value").to_owned(), |value| map.words(value));
    let words = if piece.is_empty() { value } else { format!("{value}, {piece}") };
    let painter = ui.painter_at(pane);
    let ink = ui.visuals().text_color();
    let text = painter.layout_no_wrap(words.clone(), FontId::proportional(12.5), ink);
    let size = text.size() + Vec2::new(12.0, 6.0);
    let room = Rect::from_min_max(pane.min, (pane.max - size).max(pane.min));
    let corner = room.clamp(at + Vec2::new(14.0, -size.y - 8.0));
    let patch = Rect::from_min_size(corner, size);
    let line = Stroke::new(1.0, palette.table_grid_strong);
    painter.rect(patch, 5.0, palette.overlay, line, egui::StrokeKind::Inside);
    painter.galley(corner + Vec2::new(6.0, 3.0), text, ink);
    words
}
