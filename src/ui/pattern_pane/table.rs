//! The table as tools see it: what lies where, and what the pointer is near to.

use egui::{Pos2, Rect};
use glam::DVec2;

use super::shapes::{PieceShape, Shapes};
use super::threads::{Threads, to_polyline};
use super::view::TableView;
use super::{Laid, Options};
use crate::geometry::ids::{MarkId, PieceId, SeamId};
use crate::pattern::edit::PointRef;
use crate::pattern::{EdgeRef, Pattern, Piece};
use crate::ui::selection::LineRef;

/// How near to a mark or a point a click counts, points on the screen.
pub const REACH: f64 = 10.0;
/// The same for edges and seams.
pub const NEAR_EDGE: f64 = 7.0;

/// A line laid on the table to draw along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Guide {
    /// Runs up at this x.
    Upright(f64),
    /// Runs across at this y.
    Level(f64),
}

/// Everything on the table in this frame. Places are on the table, metres, unless they are said to be elsewhere.
#[derive(Clone, Copy)]
pub struct Table<'a> {
    /// What is shown.
    pub laid: &'a Laid<'a>,
    /// Its outlines.
    pub shapes: &'a Shapes,
    /// Its seams.
    pub threads: &'a Threads,
    /// Lines to draw along.
    pub guides: &'a [Guide],
    /// Which part is seen.
    pub view: TableView,
    /// Where on the screen.
    pub pane: Rect,
    /// How tools work.
    pub options: Options,
}

/// A place on an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnEdge {
    /// The edge.
    pub edge: EdgeRef,
    /// A fraction of its arc length.
    pub at: f64,
    /// On the table.
    pub place: DVec2,
    /// From what was asked for, metres.
    pub distance: f64,
}

impl<'a> Table<'a> {
    /// The pattern.
    pub fn pattern(&self) -> &'a Pattern {
        &self.laid.document.pattern
    }

    /// Where a point of the table is on the screen.
    pub fn screen(&self, p: DVec2) -> Pos2 {
        self.view.screen_from_table(self.pane, p)
    }

    /// The point of the table under a point of the screen.
    pub fn at(&self, p: Pos2) -> DVec2 {
        self.view.table_from_screen(self.pane, p)
    }

    /// Points on the screen as metres of the pattern.
    pub fn reach(&self, points: f64) -> f64 {
        points / self.view.scale
    }

    /// A piece and its outline.
    pub fn piece(&self, id: PieceId) -> Option<(&'a Piece, &'a PieceShape)> {
        Some((self.pattern().pieces.get(&id)?, self.shapes.of(id)?))
    }

    /// Pieces that are drawn.
    pub fn seen(&self) -> impl Iterator<Item = (PieceId, &'a Piece, &'a PieceShape)> {
        let shapes = self.shapes;
        let seen = self.pattern().pieces.iter().filter(|(_, piece)| !piece.hidden);
        seen.filter_map(move |(&id, piece)| Some((id, &**piece, shapes.of(id)?)))
    }

    /// Whether the pointer may change a piece.
    pub fn is_free(&self, id: PieceId) -> bool {
        self.pattern().pieces.get(&id).is_some_and(|piece| !piece.locked && !piece.hidden)
    }

    /// The topmost piece there, and the point in its own plane.
    pub fn piece_at(&self, p: DVec2) -> Option<(PieceId, DVec2)> {
        self.shapes.at(self.pattern(), p)
    }

    /// Where a point of a piece is.
    pub fn point(&self, point: PointRef) -> Option<DVec2> {
        let piece = self.pattern().pieces.get(&point.piece)?;
        let known = point.point < piece.edge_count();
        known.then(|| piece.pose.plane_from_piece(piece.edge(point.point).start))
    }

    /// An edge from its start to its end.
    pub fn edge(&self, edge: EdgeRef) -> Option<Vec<DVec2>> {
        let (piece, shape) = self.piece(edge.piece)?;
        Some(shape.edges.get(edge.edge)?.iter().map(|&p| piece.pose.plane_from_piece(p)).collect())
    }

    /// All points that are drawn.
    pub fn points(&self) -> impl Iterator<Item = (PointRef, DVec2)> {
        self.seen().flat_map(|(id, piece, _)| {
            let starts = piece.loops().flatten().map(|edge| piece.pose.plane_from_piece(edge.start));
            starts.enumerate().map(move |(point, p)| (PointRef { piece: id, point }, p))
        })
    }

    /// The nearest point within reach; of several the topmost piece's.
    pub fn point_at(&self, p: DVec2) -> Option<PointRef> {
        let near = self.points().map(|(point, q)| (point, q.distance(p)));
        let near = near.filter(|(_, d)| *d <= self.reach(REACH));
        near.min_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0))).map(|(point, _)| point)
    }

    /// The nearest place on an edge within `points` on the screen; of several the topmost piece's.
    pub fn edge_near(&self, p: DVec2, points: f64) -> Option<OnEdge> {
        let reach = self.reach(points);
        let mut best: Option<OnEdge> = None;
        for (id, piece, shape) in self.seen() {
            let own = piece.pose.piece_from_plane(p);
            let [lower, upper] = shape.bounds;
            if own.cmplt(lower - reach).any() || own.cmpgt(upper + reach).any() {
                continue;
            }
            for (i, line) in shape.edges.iter().enumerate() {
                let (distance, at, place) = on_line(own, line);
                if distance <= reach && best.is_none_or(|b| distance <= b.distance + 1e-9) {
                    let edge = EdgeRef { piece: id, edge: i };
                    best = Some(OnEdge { edge, at, place: piece.pose.plane_from_piece(place), distance });
                }
            }
        }
        best
    }

    /// The nearest place on an edge a click is near enough to.
    pub fn edge_at(&self, p: DVec2) -> Option<OnEdge> {
        self.edge_near(p, NEAR_EDGE)
    }

    /// The line drawn inside a piece a click is near enough to; of several the topmost piece's.
    pub fn line_at(&self, p: DVec2) -> Option<LineRef> {
        let all = self.seen().flat_map(|(piece, found, shape)| {
            let own = found.pose.piece_from_plane(p);
            let far = move |line: &Vec<DVec2>| to_polyline(own, line);
            shape.lines.iter().enumerate().map(move |(line, points)| (LineRef { piece, line }, far(points)))
        });
        let near = all.filter(|(_, d)| *d <= self.reach(NEAR_EDGE));
        near.min_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0))).map(|(line, _)| line)
    }

    /// The seam with a thread there.
    pub fn thread_at(&self, p: DVec2) -> Option<SeamId> {
        self.threads.thread_near(self.pattern(), p, self.reach(NEAR_EDGE * 0.7))
    }

    /// The mark within reach.
    pub fn mark_at(&self, p: DVec2) -> Option<MarkId> {
        let distance = |mark: &crate::wrap::ClothMark| {
            let piece = self.pattern().pieces.get(&mark.piece).filter(|piece| !piece.hidden)?;
            let points: Vec<DVec2> = mark.points.iter().map(|&p| piece.pose.plane_from_piece(p)).collect();
            Some((mark.id, to_polyline(p, &points)))
        };
        let all = self.laid.document.marks.cloth.iter().filter_map(distance);
        let near = all.filter(|(_, d)| *d <= self.reach(REACH));
        near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(id, _)| id)
    }

    /// The box round pieces: lower and upper corner.
    pub fn bounds(&self, pieces: impl Iterator<Item = PieceId>) -> Option<[DVec2; 2]> {
        let outlines = pieces
            .filter_map(|id| self.piece(id))
            .flat_map(|(piece, shape)| shape.outline.iter().map(move |&p| piece.pose.plane_from_piece(p)));
        outlines.map(|p| [p, p]).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
    }
}

/// The distance of `p` from a polyline, where on it the nearest place is (a fraction of its length), and that place.
pub fn on_line(p: DVec2, line: &[DVec2]) -> (f64, f64, DVec2) {
    let total: f64 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    let mut best = (f64::INFINITY, 0.0, p);
    let mut walked = 0.0;
    for w in line.windows(2) {
        let side = w[1] - w[0];
        let t = ((p - w[0]).dot(side) / side.length_squared().max(1e-18)).clamp(0.0, 1.0);
        let place = w[0] + side * t;
        let distance = p.distance(place);
        if distance < best.0 {
            best = (distance, (walked + side.length() * t) / total.max(1e-12), place);
        }
        walked += side.length();
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_place_on_a_line_is_told_by_its_length() {
        let line = [[0.0, 0.0], [1.0, 0.0], [1.0, 3.0]].map(DVec2::from);
        let (distance, at, place) = on_line(DVec2::new(1.5, 1.0), &line);
        assert_eq!((distance, at, place), (0.5, 0.5, DVec2::new(1.0, 1.0)));
        assert_eq!(on_line(DVec2::new(-2.0, 0.0), &line).1, 0.0);
    }
}
