//! The table as tools see it: positions of all items, and the items near the pointer.

use egui::{Pos2, Rect};
use glam::DVec2;

use super::nests::Nests;
use super::pictures::Pictures;
use super::shapes::{PieceShape, Shapes};
use super::threads::{Threads, to_polyline};
use super::view::TableView;
use super::{Laid, Options};
use crate::geometry::ids::{MarkId, PieceId, SeamId};
use crate::pattern::edit::PointRef;
use crate::pattern::stitches::Row;
use crate::pattern::{EdgeRef, Pattern, Piece};

/// Largest distance of a click from a mark or a point, points.
pub const REACH: f64 = 10.0;
/// Largest distance of a click from an edge or seam, points.
pub const NEAR_EDGE: f64 = 7.0;
/// Largest distance from a sewn edge at which a click selects the seam, not the piece, points.
const NEAR_SEWN: f64 = 4.0;

/// A guide: a line on the table to draw along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Guide {
    /// A vertical line at this x, metres.
    Upright(f64),
    /// A horizontal line at this y, metres.
    Level(f64),
}

/// Everything on the table in this frame. Positions are on the table, in metres, unless stated otherwise.
#[derive(Clone, Copy)]
pub struct Table<'a> {
    /// The state of the pane.
    pub laid: &'a Laid<'a>,
    /// Shapes of the pieces.
    pub shapes: &'a Shapes,
    /// Threads of the seams.
    pub threads: &'a Threads,
    /// Rows of stitches.
    pub rows: &'a [Row],
    /// Pictures on pieces.
    pub pictures: &'a Pictures,
    /// The pattern in all its sizes.
    pub nests: &'a Nests,
    /// The guides.
    pub guides: &'a [Guide],
    /// The part of the table that is visible.
    pub view: TableView,
    /// Area of the pane on the screen.
    pub pane: Rect,
    /// Options of the tools.
    pub options: Options,
}

/// A place on an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnEdge {
    /// The edge.
    pub edge: EdgeRef,
    /// Position as a fraction of the edge's arc length.
    pub at: f64,
    /// Position on the table.
    pub place: DVec2,
    /// Distance from the point asked for, metres.
    pub distance: f64,
}

impl<'a> Table<'a> {
    /// The pattern.
    pub fn pattern(&self) -> &'a Pattern {
        &self.laid.document.pattern
    }

    /// Position on the screen of a point of the table.
    pub fn screen(&self, p: DVec2) -> Pos2 {
        self.view.screen_from_table(self.pane, p)
    }

    /// The point of the table under a point of the screen.
    pub fn at(&self, p: Pos2) -> DVec2 {
        self.view.table_from_screen(self.pane, p)
    }

    /// A length in screen points, converted to metres on the table.
    pub fn reach(&self, points: f64) -> f64 {
        points / self.view.scale
    }

    /// A piece and its shape.
    pub fn piece(&self, id: PieceId) -> Option<(&'a Piece, &'a PieceShape)> {
        Some((self.pattern().pieces.get(&id)?, self.shapes.of(id)?))
    }

    /// Pieces that are drawn: all but hidden ones.
    pub fn seen(&self) -> impl Iterator<Item = (PieceId, &'a Piece, &'a PieceShape)> {
        let shapes = self.shapes;
        let seen = self.pattern().pieces.iter().filter(|(_, piece)| !piece.hidden);
        seen.filter_map(move |(&id, piece)| Some((id, &**piece, shapes.of(id)?)))
    }

    /// Whether a piece may be changed: it is neither locked nor hidden.
    pub fn is_free(&self, id: PieceId) -> bool {
        self.pattern().pieces.get(&id).is_some_and(|piece| !piece.locked && !piece.hidden)
    }

    /// The topmost piece at a point, and the point in its own plane.
    pub fn piece_at(&self, p: DVec2) -> Option<(PieceId, DVec2)> {
        self.shapes.at(self.pattern(), p)
    }

    /// The polyline of an edge, from its start to its end.
    pub fn edge(&self, edge: EdgeRef) -> Option<Vec<DVec2>> {
        let (piece, shape) = self.piece(edge.piece)?;
        Some(shape.edges.get(edge.edge)?.iter().map(|&p| piece.pose.plane_from_piece(p)).collect())
    }

    /// All points of pieces that are drawn.
    pub fn points(&self) -> impl Iterator<Item = (PointRef, DVec2)> {
        self.seen().flat_map(|(id, piece, _)| {
            let starts = piece.loops().flatten().map(|edge| piece.pose.plane_from_piece(edge.start));
            starts.enumerate().map(move |(point, p)| (PointRef { piece: id, point }, p))
        })
    }

    /// The nearest place on an edge within this many points on the screen; of equal ones that of the topmost piece.
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

    /// The nearest place on an edge, within reach of a click at `p`.
    pub fn edge_at(&self, p: DVec2) -> Option<OnEdge> {
        self.edge_near(p, NEAR_EDGE)
    }

    /// The seam with a thread at `p`.
    pub fn thread_at(&self, p: DVec2) -> Option<SeamId> {
        self.threads.thread_near(self.pattern(), p, self.reach(NEAR_EDGE * 0.7))
    }

    /// The seam with a sewn edge at `p`: nearer to it than where a click selects the piece.
    pub fn sewn_edge_at(&self, p: DVec2) -> Option<SeamId> {
        let size = |(_, shape): (_, &PieceShape)| (shape.bounds[1] - shape.bounds[0]).min_element();
        let piece = self.piece_at(p).and_then(|(id, _)| self.piece(id)).map_or(f64::INFINITY, size);
        self.threads.side_near(self.pattern(), p, self.reach(NEAR_SEWN).min(piece / 10.0))
    }

    /// The mark within reach of `p`.
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

    /// Bounding box of pieces: lower and upper corner.
    pub fn bounds(&self, pieces: impl Iterator<Item = PieceId>) -> Option<[DVec2; 2]> {
        let outlines = pieces
            .filter_map(|id| self.piece(id))
            .flat_map(|(piece, shape)| shape.outline.iter().map(move |&p| piece.pose.plane_from_piece(p)));
        outlines.map(|p| [p, p]).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
    }
}

/// The nearest point to `p` on a polyline: its distance, its position as a fraction of the length, and the point.
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
