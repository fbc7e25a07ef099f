//! Draws the outlines and internal lines of all sizes.

use egui::{Align2, FontId, Pos2, Rect, Shape, Stroke, Vec2};
use glam::DVec2;

use super::draw::Drawing;
use super::nests::size_colour;
use super::table::Table;

impl Table<'_> {
    /// The size whose points are moved in place of those of the base.
    pub fn size(&self) -> Option<usize> {
        self.laid.sizes.of(self.pattern())
    }
}

impl Drawing<'_> {
    /// Draws the outlines and internal lines of all sizes, that of the shown one bolder, and a key to their colours.
    pub fn nests(&self, table: &Table<'_>) {
        let pattern = table.pattern();
        let (view, shown) = (table.laid.sizes, table.size());
        let count = pattern.sizes.len();
        let is_drawn = |size: usize| view.nested || shown == Some(size);
        for (size, pieces) in table.nests.pieces.iter().enumerate().filter(|(size, _)| is_drawn(*size)) {
            let width = if shown == Some(size) { 2.2 } else { 1.0 };
            let stroke = Stroke::new(width, size_colour(self.palette, size, count));
            for (id, nested) in pieces {
                let Some((piece, shape)) = table.piece(*id).filter(|(piece, _)| !piece.hidden) else {
                    continue;
                };
                if !self.is_in_view(piece, shape) {
                    continue;
                }
                let placed = |line: &Vec<DVec2>| -> Vec<Pos2> {
                    line.iter().map(|&p| self.place(piece.pose.plane_from_piece(p))).collect()
                };
                for line in &nested.lines {
                    self.painter.add(Shape::closed_line(placed(line), stroke));
                }
                for line in &nested.inside {
                    self.painter.add(Shape::line(placed(line), Stroke::new(width * 0.7, stroke.color)));
                }
            }
        }
        if count > 0 && (view.nested || shown.is_some()) {
            self.size_key(table);
        }
    }

    /// The names of the sizes in their colours, in the lower right corner.
    fn size_key(&self, table: &Table<'_>) {
        let sizes = &table.pattern().sizes;
        let shown = table.size().unwrap_or(sizes.base);
        let mut right = self.pane.right_bottom() + Vec2::new(-10.0, -8.0);
        for (size, name) in sizes.names.iter().enumerate().rev() {
            let is_base = size == sizes.base;
            let ink =
                if is_base { self.palette.front[1] } else { size_colour(self.palette, size, sizes.len()) };
            let strength = if size == shown { 13.5 } else { 11.5 };
            let text = self.painter.layout_no_wrap(name.clone(), FontId::proportional(strength), ink);
            let patch = Align2::RIGHT_BOTTOM.anchor_size(right, text.size());
            if patch.left() < self.pane.left() + 90.0 {
                break;
            }
            self.painter.rect_filled(patch.expand2(Vec2::new(4.0, 1.0)), 3.0, self.palette.overlay);
            if size == shown {
                let under = [patch.left_bottom(), patch.right_bottom()];
                self.painter.line_segment(under, Stroke::new(2.0, ink));
            }
            self.painter.galley(patch.min, text, ink);
            right.x = Rect::left(&patch) - 12.0;
        }
    }
}
