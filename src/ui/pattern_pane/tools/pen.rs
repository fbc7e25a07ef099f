//! The pens: they draw pieces, holes, internal lines and cuts point by point. A click makes a corner, a drag a curve.

use egui::{CursorIcon, Stroke};
use glam::DVec2;

use super::{PatternTool, done, in_piece, new_piece, turned_round};
use crate::geometry::ids::PieceId;
use crate::pattern::edit::PatternEdit;
use crate::pattern::{Edge, EdgeShape, InternalLine, Piece, curve};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, tr};
use crate::ui::pattern_pane::draw::Drawing;
use crate::ui::pattern_pane::input::Input;
use crate::ui::pattern_pane::snap::{Snap, Snapped};
use crate::ui::pattern_pane::table::Table;
use crate::ui::preferences::units::{Typed, degrees};
use crate::ui::selection::Item;

/// What a pen draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Makes {
    /// The outline of a new piece.
    Piece,
    /// A line on the piece it begins on.
    Line,
    /// A hole in the piece it begins on.
    Hole,
    /// A cut through the piece it begins on.
    Cut,
}

/// Largest distance of a click from the first point that closes the line, points.
const CLOSE: f64 = 9.0;

/// A pen.
#[derive(Debug)]
pub struct Pen {
    makes: Makes,
    points: Vec<PenPoint>,
    /// Whether the handle of the last point is being dragged.
    pulling: bool,
    /// Position of the next point.
    next: Option<Snapped>,
}

/// A point of the line on the table, metres.
#[derive(Clone, Copy, Debug, Default)]
struct PenPoint {
    at: DVec2,
    /// Control point of the curve that leaves a smooth point; the arriving curve has the mirrored one.
    handle: Option<DVec2>,
    /// A point on the arc to the next point, if that edge is an arc.
    through: Option<DVec2>,
}

impl Pen {
    /// A pen that draws `makes`.
    pub fn new(makes: Makes) -> Self {
        Self { makes, points: Vec::new(), pulling: false, next: None }
    }

    fn is_closed_line(&self) -> bool {
        matches!(self.makes, Makes::Piece | Makes::Hole)
    }

    fn least(&self) -> usize {
        if self.is_closed_line() { 3 } else { 2 }
    }

    /// Whether a click at `p` closes the line.
    fn closes(&self, table: &Table<'_>, p: DVec2) -> bool {
        let near = self.points.first().is_some_and(|first| first.at.distance(p) <= table.reach(CLOSE));
        near && self.is_closed_line() && self.points.len() >= 2
    }

    fn snapped(&self, table: &Table<'_>, p: DVec2, input: &Input) -> Snapped {
        let from = self.points.last().map(|last| last.at);
        // A cut must end on edges, so it snaps to them even when modifier keys are held.
        if self.makes == Makes::Cut
            && let Some(hit) = table.edge_at(p)
        {
            let by = Some(Snap::Edge(hit.edge, hit.at));
            let found = table.snapped(p, None, egui::Modifiers { shift: false, ..input.held }, |_| false);
            return if found.by.is_some_and(|by| by != Snap::Grid) {
                found
            } else {
                Snapped { place: hit.place, by }
            };
        }
        table.snapped(p, from, input.held, |_| false)
    }

    fn add(&mut self, table: &Table<'_>, at: DVec2, asks: &mut Asks) {
        if self.points.is_empty() && self.makes != Makes::Piece && self.piece(table, at).is_none() {
            asks.push(Ask::Say(tr("Begin on a piece that is not locked.").to_owned()));
            return;
        }
        if self.points.last().is_some_and(|last| last.at.distance(at) < 1e-6) {
            return;
        }
        self.points.push(PenPoint { at, ..PenPoint::default() });
    }

    /// The piece that the line is drawn on.
    fn piece(&self, table: &Table<'_>, first: DVec2) -> Option<PieceId> {
        let on_edge = table.edge_at(first).map(|hit| hit.edge.piece);
        let piece = match self.makes {
            Makes::Cut => on_edge.or_else(|| table.piece_at(first).map(|(id, _)| id)),
            _ => table.piece_at(first).map(|(id, _)| id).or(on_edge),
        };
        piece.filter(|&id| table.is_free(id))
    }

    fn edges(&self) -> Vec<Edge> {
        let n = self.points.len();
        let edge = |i: usize| {
            let (p, q) = (self.points[i], self.points[(i + 1) % n]);
            Edge { start: p.at, shape: shape_between(p, q), smooth: p.handle.is_some(), ..Edge::default() }
        };
        let count = if self.is_closed_line() { n } else { n - 1 };
        (0..count).map(edge).collect()
    }

    fn finish(&mut self, table: &Table<'_>, asks: &mut Asks) {
        let curved = self.points.iter().any(|p| p.handle.is_some() || p.through.is_some());
        let Some(first) = self.points.first().copied() else { return };
        if self.points.len() < self.least() && !(curved && self.points.len() == 2) {
            let least = self.least();
            asks.push(Ask::Say(say!("It needs {least} points at least.", least)));
            return;
        }
        let edges = self.edges();
        let end = self.points[self.points.len() - 1].at;
        if self.makes == Makes::Piece {
            let piece = new_piece(table.pattern(), &edges);
            asks.push(done(vec![PatternEdit::AddPiece { piece: piece.into() }]));
            self.points.clear();
            return;
        }
        // A line that begins on an edge shared by two pieces belongs to the piece that contains most of it.
        let Some(piece) = self.piece_of_line(table, &edges).or_else(|| self.piece(table, first.at)) else {
            return;
        };
        let pose = table.pattern().pieces[&piece].pose;
        let edges = in_piece(&edges, &pose);
        let line = |edges| InternalLine { edges, end: pose.piece_from_plane(end), ..InternalLine::default() };
        asks.push(done(vec![match self.makes {
            Makes::Piece | Makes::Line => PatternEdit::AddLine { piece, line: line(edges) },
            Makes::Hole => PatternEdit::AddHole { piece, edges: round_hole(table, piece, edges) },
            Makes::Cut => PatternEdit::Cut { piece, line: line(edges), sew: table.options.sew_cut },
        }]));
        self.points.clear();
    }

    fn piece_of_line(&self, table: &Table<'_>, edges: &[Edge]) -> Option<PieceId> {
        let last = self.points.last()?.at;
        let ends = edges.iter().skip(1).map(|e| e.start).chain([last]);
        let middles = edges.iter().zip(ends).map(|(edge, end)| edge.start.midpoint(end));
        let mut hits = middles.filter_map(|p| table.piece_at(p)).map(|(id, _)| id);
        hits.find(|&id| table.is_free(id))
    }
}

/// Holes run in the opposite direction to the outline, so that cloth is on the same side of all lines and seams on them are not
/// twisted.
fn round_hole(table: &Table<'_>, piece: PieceId, edges: Vec<Edge>) -> Vec<Edge> {
    let runs_left = |piece: &Piece| piece.signed_area() >= 0.0;
    let hole = Piece { outline: edges, ..Piece::default() };
    let same = runs_left(&hole) == runs_left(&table.pattern().pieces[&piece]);
    if same { turned_round(&hole.outline) } else { hole.outline }
}

fn shape_between(p: PenPoint, q: PenPoint) -> EdgeShape {
    if let Some(through) = p.through {
        return curve::arc_through(p.at, through, q.at);
    }
    if p.handle.is_none() && q.handle.is_none() {
        return EdgeShape::Line;
    }
    let third = (q.at - p.at) / 3.0;
    let leaves = p.handle.unwrap_or(p.at + third);
    let comes = q.handle.map_or(q.at - third, |handle| 2.0 * q.at - handle);
    EdgeShape::Cubic { controls: [leaves, comes] }
}

impl PatternTool for Pen {
    fn step(&mut self, table: &Table<'_>, input: &Input, asks: &mut Asks) {
        for &at in &input.clicks {
            let p = table.at(at);
            if input.held.command
                && let Some(last) = self.points.last_mut()
            {
                last.through = Some(p);
            } else if self.closes(table, p) {
                self.finish(table, asks);
            } else {
                let place = self.snapped(table, p, input).place;
                self.add(table, place, asks);
            }
        }
        if input.double && !self.is_closed_line() {
            self.finish(table, asks);
        }
        if let Some(at) = input.pressed {
            let p = table.at(at);
            // A drag that begins at the first point closes the line with a curve.
            if self.closes(table, p) {
                self.finish(table, asks);
            } else {
                let place = self.snapped(table, p, input).place;
                self.add(table, place, asks);
                self.pulling = !self.points.is_empty();
            }
        }
        if let (true, Some(&at), Some(last)) = (self.pulling, input.trail.last(), self.points.last_mut()) {
            let from = Some(last.at);
            last.handle = Some(table.snapped(table.at(at), from, input.held, |_| false).place);
        }
        if input.let_go && self.pulling {
            self.pulling = false;
        }
        if input.backspace {
            // Removes the arc first, then the point that it starts from.
            let arc = self.points.last_mut().and_then(|last| last.through.take());
            if arc.is_none() {
                self.points.pop();
            }
        }
        if input.enter && !self.points.is_empty() {
            self.finish(table, asks);
        }
        self.next = input.hover.filter(|_| !self.pulling).map(|at| self.snapped(table, table.at(at), input));
    }

    fn draw(&self, drawing: &Drawing<'_>, table: &Table<'_>, input: &Input) {
        let ink = drawing.palette.accent;
        let at = input.hover.unwrap_or(drawing.pane.center());
        for w in self.points.windows(2) {
            drawing.polyline(&flat(w[0], w[1]), Stroke::new(2.0, ink));
        }
        for point in &self.points {
            if let Some(handle) = point.handle {
                let ends = [2.0 * point.at - handle, handle].map(|p| drawing.place(p));
                drawing.painter.line_segment(ends, Stroke::new(1.0, ink.gamma_multiply(0.7)));
                ends.iter().for_each(|&end| {
                    drawing.painter.circle_filled(end, 3.0, ink);
                });
            }
            drawing.knob(point.at, point.handle.is_some(), false);
        }
        let Some(next) = &self.next else { return };
        let closes = self.closes(table, next.place);
        if let Some(last) = self.points.last() {
            let end =
                if closes { self.points[0] } else { PenPoint { at: next.place, ..PenPoint::default() } };
            let line = flat(*last, end);
            if let Some(through) = last.through {
                drawing.painter.circle_filled(drawing.place(through), 3.0, ink);
            }
            drawing.polyline(&line, Stroke::new(1.4, ink.gamma_multiply(0.7)));
            let length: f64 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
            let turn = degrees((end.at - last.at).to_angle());
            let words = format!("{}  {turn}°", table.laid.unit.text(length));
            drawing.chip(at, &if closes { say!("{words}   close", words) } else { words });
        }
        if closes {
            drawing.painter.circle_stroke(drawing.place(self.points[0].at), 8.0, Stroke::new(2.0, ink));
        } else {
            drawing.snapped(next);
        }
    }

    fn is_busy(&self) -> bool {
        !self.points.is_empty()
    }

    fn is_dragging(&self) -> bool {
        self.pulling
    }

    fn give_up(&mut self, _asks: &mut Asks) {
        self.points.clear();
        self.pulling = false;
    }

    fn takes_numbers(&self) -> bool {
        true
    }

    fn typed(&mut self, table: &Table<'_>, typed: Typed, asks: &mut Asks) -> Result<(), String> {
        let last = self.points.last().map(|point| point.at);
        let at = match (typed, last) {
            (Typed::At(p), _) => p,
            (Typed::By(by), Some(last)) => last + by,
            (Typed::Length(far), Some(last)) => {
                let toward = self.next.map_or(DVec2::X, |next| next.place - last);
                last + toward.normalize_or(DVec2::X) * far
            }
            (_, None) => return Err(tr("the first point needs both: 30,40").to_owned()),
        };
        if self.points.len() >= self.least() && self.is_closed_line() && self.points[0].at.distance(at) < 1e-6
        {
            self.finish(table, asks);
        } else {
            self.add(table, at, asks);
        }
        Ok(())
    }

    fn draws(&self) -> bool {
        true
    }

    fn under(&self, table: &Table<'_>, p: DVec2) -> Option<Item> {
        match self.makes {
            Makes::Piece => None,
            Makes::Cut => table.edge_at(p).map(|hit| Item::Edge(hit.edge)),
            Makes::Line | Makes::Hole => table.piece_at(p).map(|(id, _)| Item::Piece(id)),
        }
    }

    fn cursor(&self, _table: &Table<'_>, _at: DVec2) -> CursorIcon {
        CursorIcon::Crosshair
    }

    fn hint(&self, _table: &Table<'_>) -> String {
        match (self.points.is_empty(), self.makes) {
            (true, Makes::Piece) => {
                tr("Draw a piece · Click: a corner · Drag: a curve · Type a place: 30,40")
            }
            (true, Makes::Line) => {
                tr("Draw a line on a piece · Click: a corner · Drag: a curve · Type a place: 30,40")
            }
            (true, Makes::Hole) => {
                tr("Draw a hole in a piece · Click: a corner · Drag: a curve · Type a place: 30,40")
            }
            (true, Makes::Cut) => {
                tr("Draw a cut from edge to edge · Click: a corner · Drag: a curve · Type a place: 30,40")
            }
            (false, Makes::Piece | Makes::Hole) => tr(
                "Click the first point or Enter: close · Ctrl+click: an arc through here · Backspace: one back · Type 12, @10,0 or 10<45 · Shift: 45° · Esc: give up",
            ),
            (false, Makes::Line | Makes::Cut) => tr(
                "Double-click or Enter: done · Ctrl+click: an arc through here · Backspace: one back · Type 12, @10,0 or 10<45 · Shift: 45° · Esc: give up",
            ),
        }
        .to_owned()
    }
}

fn flat(p: PenPoint, q: PenPoint) -> Vec<DVec2> {
    let mut points = Vec::new();
    curve::flatten(p.at, shape_between(p, q), q.at, 5e-4, &mut points);
    points.push(q.at);
    points
}
