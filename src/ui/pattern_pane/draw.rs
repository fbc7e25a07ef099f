//! Draws the table (the pattern plane on the screen): grid, marks, and what tools need.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Vec2};
use glam::DVec2;

use super::snap::{Snap, Snapped};
use super::table::Guide;
use super::view::TableView;
use crate::geometry::ids::MarkId;
use crate::pattern::Pattern;
use crate::render::mark_colour;
use crate::ui::language::tr;
use crate::ui::look::chip::chip;
use crate::ui::look::theme::{Palette, colour};
use crate::ui::preferences::units::LengthUnit;
use crate::wrap::Marks;

/// The painter of the pane, with what drawing needs.
pub struct Drawing<'a> {
    /// Painter, clipped to the pane.
    pub painter: Painter,
    /// Area of the pane on the screen.
    pub pane: Rect,
    /// The part of the table that is visible.
    pub view: &'a TableView,
    /// Colours.
    pub palette: &'a Palette,
}

/// Where the number of a mark is, from the mark's first point, points.
const NUMBER_AT: Vec2 = Vec2::new(-11.0, -11.0);
/// Height of the position of the pointer, with the space below it, at the lower edge of the pane, points.
pub const PLACE_HEIGHT: f32 = 22.0;
/// Opacity of proposed marks.
const GHOST: f32 = 0.6;

/// The look of a mark.
#[derive(Clone, Copy, Debug, Default)]
pub struct MarkLook {
    /// Whether the mark has a partner; without one its number is hollow.
    pub paired: bool,
    /// Whether the mark is under the pointer.
    pub near: bool,
    /// Whether the mark is selected.
    pub selected: bool,
    /// Whether the mark is only proposed.
    pub ghost: bool,
}

impl Drawing<'_> {
    /// Draws the background with a grid that becomes finer as the view zooms in.
    pub fn table(&self, unit: LengthUnit) {
        self.painter.rect_filled(self.pane, 0.0, self.palette.table);
        let (lower, upper) = self.view.seen(self.pane);
        let steps = unit.steps().iter().copied().filter(|step| step * self.view.scale >= 11.0);
        for (step, ink) in steps.zip([self.palette.table_grid, self.palette.table_grid_strong]) {
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

    /// Draws guides.
    pub fn guides<'g>(&self, guides: impl Iterator<Item = &'g Guide>) {
        let stroke = Stroke::new(1.0, self.palette.guide);
        for guide in guides {
            match *guide {
                Guide::Upright(x) => {
                    self.painter.vline(self.place(DVec2::new(x, 0.0)).x, self.pane.y_range(), stroke)
                }
                Guide::Level(y) => {
                    self.painter.hline(self.pane.x_range(), self.place(DVec2::new(0.0, y)).y, stroke)
                }
            };
        }
    }

    /// Draws a point that can be dragged.
    pub fn knob(&self, p: DVec2, is_round: bool, is_chosen: bool) {
        let at = self.place(p);
        let (paper, ink) = (self.palette.knob, self.palette.accent);
        let paper = if is_chosen { ink } else { paper };
        if is_round {
            self.painter.circle(at, 4.0, paper, Stroke::new(1.4, ink));
        } else {
            let square = Rect::from_center_size(at, Vec2::splat(7.0));
            self.painter.rect(square, 1.0, paper, Stroke::new(1.4, ink), egui::StrokeKind::Middle);
        }
    }

    /// Draws a text on a small background, beside a point of the screen.
    pub fn chip(&self, at: Pos2, words: &str) {
        self.chip_in(at, words, self.palette.weak);
    }

    /// Draws a text in the colour `ink` on a small background, beside a point of the screen.
    pub fn chip_in(&self, at: Pos2, words: &str, ink: Color32) {
        chip(&self.painter, self.pane, at, words, ink, self.palette);
    }

    /// Draws the place that the pointer snapped to, and the name of what it snapped to.
    pub fn snapped(&self, snapped: &Snapped) {
        let at = self.place(snapped.place);
        let Some(by) = snapped.by else { return };
        let ink = Stroke::new(1.6, self.palette.guide);
        match by {
            Snap::Grid | Snap::Guide => {
                self.painter.line_segment([at - Vec2::X * 5.0, at + Vec2::X * 5.0], ink);
                self.painter.line_segment([at - Vec2::Y * 5.0, at + Vec2::Y * 5.0], ink);
            }
            Snap::Angle => {
                self.painter.circle_stroke(at, 4.0, ink);
            }
            Snap::Point | Snap::Middle | Snap::Edge(..) => {
                let square = Rect::from_center_size(at, Vec2::splat(11.0));
                self.painter.rect_stroke(square, 0.0, ink, egui::StrokeKind::Middle);
                let font = FontId::proportional(11.0);
                let place = at + Vec2::new(-9.0, -9.0);
                self.painter.text(place, Align2::RIGHT_BOTTOM, tr(by.name()), font, self.palette.guide);
            }
        }
    }

    /// Writes the position of the pointer in the lower left corner.
    pub fn place_told(&self, p: DVec2, unit: LengthUnit) {
        let words = unit.point(p);
        let at = self.pane.left_bottom() + Vec2::new(10.0, -8.0);
        let font = FontId::proportional(11.5);
        self.painter.text(at, Align2::LEFT_BOTTOM, words, font, self.palette.weak);
    }

    /// Draws the keyboard's cursor.
    pub fn cross(&self, p: DVec2) {
        let at = self.place(p);
        for way in [Vec2::X, Vec2::Y] {
            let (far, near) = (way * 14.0, way * 4.0);
            let stroke = Stroke::new(2.0, self.palette.accent);
            self.painter.line_segment([at - far, at - near], stroke);
            self.painter.line_segment([at + near, at + far], stroke);
        }
    }

    /// Draws a dashed line.
    pub fn dashed(&self, points: &[DVec2], stroke: Stroke) {
        let placed: Vec<Pos2> = points.iter().map(|&p| self.place(p)).collect();
        self.painter.extend(Shape::dashed_line(&placed, stroke, 6.0, 4.0));
    }

    /// Draws all marks with their numbers; `near` is under the pointer.
    pub fn marks(&self, pattern: &Pattern, marks: &Marks, near: Option<MarkId>, selected: Option<MarkId>) {
        for (i, mark) in marks.cloth.iter().enumerate() {
            if let Some(piece) = pattern.pieces.get(&mark.piece).filter(|piece| !piece.hidden) {
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

    /// The places of the numbers of marks on the screen.
    pub fn numbers(&self, pattern: &Pattern, marks: &Marks) -> Vec<Rect> {
        let numbers = marks.cloth.iter().filter_map(|mark| {
            let piece = pattern.pieces.get(&mark.piece).filter(|piece| !piece.hidden)?;
            let at = self.place(piece.pose.plane_from_piece(*mark.points.first()?)) + NUMBER_AT;
            Some(Rect::from_center_size(at, Vec2::splat(20.0)))
        });
        numbers.collect()
    }

    /// Draws proposed marks with the numbers they would have.
    pub fn ghosts(&self, pattern: &Pattern, marks: &Marks) {
        for (mark, number) in marks.cloth.iter().zip(1..) {
            let Some(piece) = pattern.pieces.get(&mark.piece) else { continue };
            let points: Vec<DVec2> = mark.points.iter().map(|&p| piece.pose.plane_from_piece(p)).collect();
            self.mark(&points, number, MarkLook { ghost: true, ..MarkLook::default() });
        }
    }

    /// Draws a mark with `points` on the table.
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
            self.number(self.place(first) + NUMBER_AT, number, ink, look);
        }
    }

    fn number(&self, at: Pos2, number: usize, ink: Color32, look: MarkLook) {
        let text = number.to_string();
        let radius = if text.len() > 1 { 10.5 } else { 8.5 };
        let halo = if look.ghost { self.palette.halo.gamma_multiply(GHOST) } else { self.palette.halo };
        let [paper, letters] = match (look.ghost, look.paired) {
            (true, _) => [halo, ink],
            (false, true) => self.palette.label(ink, Color32::WHITE),
            (false, false) => self.palette.label(halo, ink),
        };
        self.painter.circle_filled(at, radius + 1.6, halo);
        self.painter.circle(at, radius, paper, Stroke::new(1.6, ink));
        if look.selected {
            self.painter.circle_stroke(at, radius + 3.2, Stroke::new(2.0, self.palette.accent));
        }
        self.painter.text(at, Align2::CENTER_CENTER, text, FontId::proportional(12.0), letters);
    }

    /// Draws a polyline with round ends.
    pub fn polyline(&self, points: &[DVec2], stroke: Stroke) {
        let placed: Vec<Pos2> = points.iter().map(|&p| self.place(p)).collect();
        // egui does not draw round ends.
        for end in [placed.first(), placed.last()].into_iter().flatten() {
            self.painter.circle_filled(*end, stroke.width / 2.0, stroke.color);
        }
        self.painter.add(Shape::line(placed, stroke));
    }

    /// Position on the screen of a point of the table.
    pub fn place(&self, p: DVec2) -> Pos2 {
        self.view.screen_from_table(self.pane, p)
    }
}
