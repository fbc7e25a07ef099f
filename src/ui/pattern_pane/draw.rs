//! Draws the table: grid, pieces, threads, marks.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Vec2, pos2};
use glam::DVec2;

use super::shapes::{PieceShape, Shapes};
use super::threads::Threads;
use super::view::TableView;
use crate::geometry::ids::{MarkId, PieceId, SeamId};
use crate::pattern::{Pattern, Piece};
use crate::render::mark_colour;
use crate::ui::theme::{Palette, colour};
use crate::wrap::Marks;

/// What is drawn on, and how.
pub struct Drawing<'a> {
    /// Clipped to the pane.
    pub painter: Painter,
    /// The pane.
    pub pane: Rect,
    /// Which part of the table is seen.
    pub view: &'a TableView,
    /// Colours.
    pub palette: &'a Palette,
}

/// Opacity of proposed marks.
const GHOST: f32 = 0.6;

/// How a mark is drawn.
#[derive(Clone, Copy, Debug, Default)]
pub struct MarkLook {
    /// One without a partner has a hollow number.
    pub paired: bool,
    /// It is under the pointer.
    pub near: bool,
    /// It is the chosen one.
    pub selected: bool,
    /// It is proposed only.
    pub ghost: bool,
}

/// Whether the front of `piece` is seen.
pub fn front_is_seen(piece: &Piece, shape: &PieceShape) -> bool {
    shape.drawn_from_front != piece.pose.flipped
}

impl Drawing<'_> {
    /// Background with a grid of ten centimetres.
    pub fn table(&self) {
        self.painter.rect_filled(self.pane, 0.0, self.palette.table);
        for (step, ink) in [(0.1, self.palette.table_grid), (0.5, self.palette.table_grid_strong)] {
            if self.view.scale * step < 14.0 {
                continue;
            }
            let (lower, upper) = self.view.seen(self.pane);
            for i in (lower.x / step).ceil() as i64..=(upper.x / step).floor() as i64 {
                let x = self.place(DVec2::new(i as f64 * step, 0.0)).x;
                self.painter.vline(x, self.pane.y_range(), Stroke::new(1.0, ink));
            }
            for i in (lower.y / step).ceil() as i64..=(upper.y / step).floor() as i64 {
                let y = self.place(DVec2::new(0.0, i as f64 * step)).y;
                self.painter.hline(self.pane.x_range(), y, Stroke::new(1.0, ink));
            }
        }
    }

    /// All pieces; `lifted` is under the pointer.
    pub fn pieces(&self, pattern: &Pattern, shapes: &Shapes, lifted: Option<PieceId>) {
        for (&id, piece) in &pattern.pieces {
            if let Some(shape) = shapes.of(id) {
                self.piece(piece, shape, lifted == Some(id));
            }
        }
    }

    fn piece(&self, piece: &Piece, shape: &PieceShape, lifted: bool) {
        let place = |p: DVec2| self.place(piece.pose.plane_from_piece(p));
        let front = front_is_seen(piece, shape);
        let [fill, line] = if front { self.palette.front } else { self.palette.back };
        let mut mesh = egui::Mesh::default();
        for t in &shape.fill {
            let base = mesh.vertices.len() as u32;
            t.iter().for_each(|&p| mesh.colored_vertex(place(p), fill));
            mesh.add_triangle(base, base + 1, base + 2);
            mesh.add_triangle(base, base + 2, base + 3);
        }
        self.painter.add(Shape::mesh(mesh));
        for closed in std::iter::once(&shape.outline).chain(&shape.holes) {
            let points: Vec<Pos2> = closed.iter().map(|&p| place(p)).collect();
            self.painter.add(Shape::closed_line(points, Stroke::new(if lifted { 2.4 } else { 1.5 }, line)));
        }
    }

    /// Names of the pieces, on a patch of the piece's own colour so that marks do not run through them.
    pub fn names(&self, pattern: &Pattern, shapes: &Shapes) {
        let size = (self.view.scale * 0.028).clamp(10.5, 15.0) as f32;
        for (&id, piece) in &pattern.pieces {
            let Some(shape) = shapes.of(id) else { continue };
            let front = front_is_seen(piece, shape);
            let fill = if front { self.palette.front[0] } else { self.palette.back[0] };
            let name = if front { piece.name.clone() } else { format!("{} (back)", piece.name) };
            let ink = self.palette.piece_text;
            let text = self.painter.layout_no_wrap(name, FontId::proportional(size), ink);
            let middle = self.place(piece.pose.plane_from_piece(shape.middle));
            let at = Rect::from_center_size(middle, text.size());
            self.painter.rect_filled(at.expand2(Vec2::new(5.0, 1.5)), 5.0, fill.gamma_multiply(0.88));
            self.painter.galley(at.min, text, ink);
        }
    }

    /// Threads between sewn edges; those of `near` stand out.
    pub fn seams(&self, pattern: &Pattern, threads: &Threads, near: Option<SeamId>) {
        for (id, ends) in threads.all() {
            let Some([from, to]) = ends.on_table(pattern) else { continue };
            let chosen = near == Some(id);
            let ink = if chosen { self.palette.accent } else { self.palette.thread.gamma_multiply(0.38) };
            for (&p, &q) in from.iter().zip(&to) {
                self.painter.line_segment([self.place(p), self.place(q)], Stroke::new(1.0, ink));
            }
            if chosen {
                for points in [from, to] {
                    self.polyline(&points, Stroke::new(3.0, self.palette.accent));
                }
            }
        }
    }

    /// All marks with their numbers; `near` is under the pointer.
    pub fn marks(&self, pattern: &Pattern, marks: &Marks, near: Option<MarkId>, selected: Option<MarkId>) {
        for (i, mark) in marks.cloth.iter().enumerate() {
            if let Some(piece) = pattern.pieces.get(&mark.piece) {
                let points: Vec<DVec2> =
                    mark.points.iter().map(|&p| piece.pose.plane_from_piece(p)).collect();
                let look = MarkLook {
                    paired: i < marks.body.len(),
                    near: near == Some(mark.id),
                    selected: selected == Some(mark.id),
                    ghost: false,
                };
                self.mark(&points, i + 1, look);
            }
        }
    }

    /// Proposed marks with the numbers they would have.
    pub fn ghosts(&self, pattern: &Pattern, marks: &Marks) {
        for (mark, number) in marks.cloth.iter().zip(1..) {
            let Some(piece) = pattern.pieces.get(&mark.piece) else { continue };
            let points: Vec<DVec2> = mark.points.iter().map(|&p| piece.pose.plane_from_piece(p)).collect();
            self.mark(&points, number, MarkLook { ghost: true, ..MarkLook::default() });
        }
    }

    /// One mark, points on the table.
    pub fn mark(&self, points: &[DVec2], number: usize, look: MarkLook) {
        let fade = if look.ghost { GHOST } else { 1.0 };
        let [ink, halo] = [colour(mark_colour(number)), self.palette.halo].map(|c| c.gamma_multiply(fade));
        let width = match look {
            MarkLook { ghost: true, .. } => 1.6,
            MarkLook { near, selected, .. } if near || selected => 5.0,
            _ => 3.0,
        };
        if let [only] = points {
            let at = self.place(*only);
            self.painter.circle_filled(at, width + 2.4, halo);
            self.painter.circle_filled(at, width + 0.6, ink);
        } else {
            self.polyline(points, Stroke::new(width + 3.6, halo));
            self.polyline(points, Stroke::new(width, ink));
        }
        if let Some(&first) = points.first() {
            self.number(self.place(first) + Vec2::new(-11.0, -11.0), number, ink, look);
        }
    }

    fn number(&self, at: Pos2, number: usize, ink: Color32, look: MarkLook) {
        let text = number.to_string();
        let radius = if text.len() > 1 { 10.5 } else { 8.5 };
        let halo = if look.ghost { self.palette.halo.gamma_multiply(GHOST) } else { self.palette.halo };
        let (paper, letters) = if look.paired { (ink, Color32::WHITE) } else { (halo, ink) };
        self.painter.circle_filled(at, radius + 1.6, halo);
        self.painter.circle(at, radius, paper, Stroke::new(1.6, ink));
        if look.selected {
            self.painter.circle_stroke(at, radius + 3.2, Stroke::new(2.0, self.palette.accent));
        }
        self.painter.text(at, Align2::CENTER_CENTER, text, FontId::proportional(12.0), letters);
    }

    fn polyline(&self, points: &[DVec2], stroke: Stroke) {
        let placed: Vec<Pos2> = points.iter().map(|&p| self.place(p)).collect();
        // Round ends, as egui draws none.
        for end in [placed.first(), placed.last()].into_iter().flatten() {
            self.painter.circle_filled(*end, stroke.width / 2.0, stroke.color);
        }
        self.painter.add(Shape::line(placed, stroke));
    }

    fn place(&self, p: DVec2) -> Pos2 {
        self.view.screen_from_table(self.pane, p)
    }

    /// A scale bar of a round length in the lower left corner.
    pub fn scale_bar(&self) {
        let steps = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0];
        let Some(&length) = steps.iter().find(|&&l| l * self.view.scale >= 46.0) else { return };
        let width = (length * self.view.scale) as f32;
        let left = pos2(self.pane.left() + 14.0, self.pane.bottom() - 14.0);
        let stroke = Stroke::new(1.5, self.palette.weak);
        self.painter.line_segment([left, left + Vec2::new(width, 0.0)], stroke);
        for x in [0.0, width] {
            let end = left + Vec2::new(x, 0.0);
            self.painter.line_segment([end - Vec2::new(0.0, 3.5), end + Vec2::new(0.0, 3.5)], stroke);
        }
        let words = if length < 1.0 { format!("{:.0} cm", length * 100.0) } else { format!("{length:.0} m") };
        let at = left + Vec2::new(width / 2.0, -4.0);
        self.painter.text(at, Align2::CENTER_BOTTOM, words, FontId::proportional(11.0), self.palette.weak);
    }
}
