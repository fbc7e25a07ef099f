//! A short text on a small background beside the pointer.

use egui::{Color32, FontId, Painter, Pos2, Rect, Stroke, Vec2};

use crate::ui::look::theme::Palette;

/// Draws `words` in the colour `ink` beside a point of the screen, inside `pane`.
pub fn chip(painter: &Painter, pane: Rect, at: Pos2, words: &str, ink: Color32, palette: &Palette) {
    let text = painter.layout_no_wrap(words.to_owned(), FontId::proportional(12.0), ink);
    let size = text.size() + Vec2::new(12.0, 6.0);
    let room = pane.shrink(4.0);
    let least = room.min.to_vec2();
    let most = (room.max - size).to_vec2().max(least);
    let corner = (at + Vec2::new(14.0, 16.0)).to_vec2().clamp(least, most).to_pos2();
    let patch = Rect::from_min_size(corner, size);
    let border = Stroke::new(1.0, palette.table_grid_strong);
    painter.rect(patch, 5.0, palette.overlay, border, egui::StrokeKind::Inside);
    painter.galley(corner + Vec2::new(6.0, 3.0), text, ink);
}
