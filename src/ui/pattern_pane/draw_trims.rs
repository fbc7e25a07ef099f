//! Draws what is worked on pieces: fold lines, topstitching, hems, elastic, piping, wrinkles, zips and buttons.

use std::sync::Arc;

use egui::{FontId, Pos2, Rect, Shape, Stroke, Vec2};
use glam::DVec2;

use super::draw::Drawing;
use super::labels::{Labels, along};
use super::table::Table;
use crate::pattern::stitches::{Row, Thread, is_trimmed_alike, rows};
use crate::pattern::{Button, Fold, Pattern, Piping, PlanePose, Trims, Wrinkle};
use crate::ui::look::theme::colour;

/// Half size of the cross that is drawn for a tack, points.
const TACK: f32 = 3.5;

/// The rows of stitches of a pattern, kept until it changes.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    of: Option<Arc<Pattern>>,
    /// The rows, piece by piece.
    pub all: Vec<Row>,
}

impl Rows {
    /// Makes the rows anew where the pattern has changed.
    pub fn update(&mut self, pattern: &Arc<Pattern>) {
        if !self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, pattern)) {
            let is_alike = self.of.as_ref().is_some_and(|of| is_trimmed_alike(of, pattern));
            if !is_alike {
                self.all = rows(pattern);
            }
            self.of = Some(Arc::clone(pattern));
        }
    }
}

impl Drawing<'_> {
    /// Draws the trims of all visible pieces.
    pub fn trims(&self, table: &Table<'_>, labels: &mut Labels) {
        for (_, piece, shape) in table.seen().filter(|(_, piece, shape)| self.is_in_view(piece, shape)) {
            for (i, points) in shape.edges.iter().enumerate() {
                self.worked(&piece.pose, points, piece.edge(i).trims, labels);
            }
            for (line, points) in piece.lines.iter().zip(&shape.lines) {
                let trims = line.edges.first().map(|edge| edge.trims).unwrap_or_default();
                if let Some(wrinkle) = trims.wrinkle {
                    self.wrinkle(&piece.pose, points, wrinkle);
                }
                self.worked(&piece.pose, points, trims, labels);
            }
        }
        for row in table.rows {
            if let Some(piece) = table.pattern().pieces.get(&row.piece).filter(|piece| !piece.hidden) {
                self.row(&piece.pose, row);
            }
        }
        for button in table.pattern().buttons.values() {
            self.button(table, button);
        }
    }

    /// Draws a row of stitches; from afar as a line.
    fn row(&self, pose: &PlanePose, row: &Row) {
        let points: Vec<Pos2> = row.points.iter().map(|&p| self.place(pose.plane_from_piece(p))).collect();
        if !Rect::from_points(&points).intersects(self.pane) {
            return;
        }
        let (ink, length, width) = match row.thread {
            Thread::Stitches { length, colour } => (colour, length, 1.4),
            Thread::Line { colour } => (colour, 0.0, 1.2),
            Thread::Teeth { colour } => (colour, 0.003, 3.0),
        };
        let ink = colour(ink);
        // Thread in the colour of the cloth would not be seen.
        self.painter.add(Shape::line(
            points.clone(),
            Stroke::new(width + 1.0, self.palette.halo.gamma_multiply(0.4)),
        ));
        let long = (length * self.view.scale) as f32;
        match long > 4.0 {
            true => self.painter.extend(Shape::dashed_line(
                &points,
                Stroke::new(width, ink),
                long * 0.65,
                long * 0.35,
            )),
            false => {
                self.painter.add(Shape::line(points, Stroke::new(width, ink)));
            }
        }
    }

    /// Draws a button with its holes, its buttonhole, and a thread between them while it is fastened.
    fn button(&self, table: &Table<'_>, button: &Button) {
        let [Some(at), Some(hole)] = [button.button, button.hole].map(|point| {
            let piece = table.pattern().pieces.get(&point.piece).filter(|piece| !piece.hidden)?;
            Some((self.place(piece.pose.plane_from_piece(point.at)), piece.pose))
        }) else {
            return;
        };
        let radius = ((button.diameter / 2.0 * self.view.scale) as f32).max(3.0);
        if !button.open {
            let thread = Stroke::new(1.0, self.palette.guide.gamma_multiply(0.7));
            self.painter.line_segment([at.0, hole.0], thread);
        }
        if button.tack {
            [at.0, hole.0].into_iter().for_each(|at| self.tack(at));
            return;
        }
        let half = (DVec2::X * (button.diameter / 2.0 + 0.0015)).max(DVec2::X * 0.003);
        let slit = [-half, half].map(|by| self.place(hole.1.plane_from_piece(button.hole.at + by)));
        self.painter.line_segment(slit, Stroke::new(2.4, self.palette.guide));
        let rim = if button.open { self.palette.weak } else { self.palette.guide };
        self.painter.circle(at.0, radius, colour(button.colour), Stroke::new(1.4, rim));
        if radius > 5.0 {
            for side in
                [Vec2::new(1.0, 1.0), Vec2::new(-1.0, 1.0), Vec2::new(1.0, -1.0), Vec2::new(-1.0, -1.0)]
            {
                self.painter.circle_filled(at.0 + side * (radius * 0.28), radius * 0.12, rim);
            }
        }
    }

    /// Draws a tack at `at`: a cross of two stitches.
    fn tack(&self, at: Pos2) {
        for way in [Vec2::splat(TACK), Vec2::new(TACK, -TACK)] {
            self.painter.line_segment([at - way, at + way], Stroke::new(1.6, self.palette.guide));
        }
    }

    fn worked(&self, pose: &PlanePose, points: &[DVec2], trims: Trims, labels: &mut Labels) {
        let points: Vec<DVec2> = points.iter().map(|&p| pose.plane_from_piece(p)).collect();
        if let Some(piping) = trims.piping {
            self.piping(&points, piping);
        }
        if let Some(fold) = trims.fold {
            self.fold(&points, fold, labels);
        }
    }

    /// Draws a wrinkle: a band as wide as it is, denser towards its middle; valleys are paler than ridges.
    fn wrinkle(&self, pose: &PlanePose, points: &[DVec2], wrinkle: Wrinkle) {
        let points: Vec<Pos2> = points.iter().map(|&p| self.place(pose.plane_from_piece(p))).collect();
        let ink = if wrinkle.height < 0.0 { self.palette.weak } else { self.palette.guide };
        let width = (wrinkle.width * self.view.scale) as f32;
        for share in [1.0, 0.75, 0.5, 0.25] {
            self.painter
                .add(Shape::line(points.clone(), Stroke::new(width * share, ink.gamma_multiply(0.12))));
        }
    }

    /// Draws piping: a line in its colour, as thick as the cord is; from afar 2.5 points.
    fn piping(&self, points: &[DVec2], piping: Piping) {
        let points: Vec<Pos2> = points.iter().map(|&p| self.place(p)).collect();
        let width = ((2.0 * piping.radius * self.view.scale) as f32).max(2.5);
        // A cord in the colour of the cloth would not be seen.
        let halo = Stroke::new(width + 1.5, self.palette.halo.gamma_multiply(0.6));
        self.painter.add(Shape::line(points.clone(), halo));
        self.painter.add(Shape::line(points, Stroke::new(width, colour(piping.colour))));
    }

    /// Draws a fold line: dashed, and its angle beside it where it covers no other text.
    fn fold(&self, points: &[DVec2], fold: Fold, labels: &mut Labels) {
        let ink = self.palette.guide;
        self.dashed(points, Stroke::new(2.2, ink));
        let points: Vec<Pos2> = points.iter().map(|&p| self.place(p)).collect();
        let long: f32 = points.windows(2).map(|w| w[0].distance(w[1])).sum();
        if long <= 60.0 {
            return;
        }
        let words = format!("{:+.0}°", fold.angle.to_degrees());
        let text = self.painter.layout_no_wrap(words, FontId::proportional(11.0), ink);
        let beside = |share: f32, side: f32| {
            let (at, way) = along(&points, share)?;
            Some(Rect::from_center_size(at + way.rot90() * (9.0 * side), text.size()))
        };
        let places = [(0.5, 1.0), (0.5, -1.0), (0.3, 1.0), (0.7, 1.0), (0.3, -1.0), (0.7, -1.0)];
        let places: Vec<Rect> = places.into_iter().filter_map(|(share, side)| beside(share, side)).collect();
        if let Some(place) = labels.take(&places) {
            self.painter.galley(place.min, text, ink);
        }
    }
}
