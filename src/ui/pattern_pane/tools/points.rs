//! The tool Edit points: moves points, edges, internal lines and handles of curves; double-clicks insert points and smooth corners.

use std::collections::BTreeSet;

use egui::{CursorIcon, Pos2, Rect, Stroke};
use glam::DVec2;

use super::walk::Walk;
use super::{PatternTool, done, dragged, grade};
use crate::geometry::ids::PieceId;
use crate::pattern::edit::{LinePoint, PatternEdit, PointRef};
use crate::pattern::{EdgeRef, EdgeShape, RulePoint, curve};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, tr};
use crate::ui::pattern_pane::draw::Drawing;
use crate::ui::pattern_pane::input::Input;
use crate::ui::pattern_pane::snap::Snapped;
use crate::ui::pattern_pane::table::{OnEdge, REACH, Table};
use crate::ui::preferences::units::{Typed, degrees};
use crate::ui::selection::{Item, LineRef, Selection};

/// The tool Edit points.
#[derive(Debug, Default)]
pub struct Points {
    drag: Option<Drag>,
    walk: Walk,
}

#[derive(Debug)]
enum Drag {
    /// Selects the points in a box.
    Box { from: DVec2, to: DVec2, add: bool },
    /// Moves points: their old positions on the table, and the point where they are held.
    Move { held: DVec2, points: Vec<(RulePoint, DVec2)>, by: DVec2, snapped: Option<Snapped> },
    /// Moves points of a size other than the base: their old positions on the table, and the point where they are held.
    Grade { size: usize, held: DVec2, points: Vec<(RulePoint, DVec2)>, by: DVec2 },
    /// Bends an edge through the pointer; `shape` is its old shape.
    Bend { edge: EdgeRef, ends: [DVec2; 2], shape: EdgeShape, at: f64, held: DVec2 },
    /// Moves a handle of a curve.
    Handle { edge: EdgeRef, shape: EdgeShape, which: usize, to: DVec2 },
}

/// A handle of a curve: its edge, index of the control point, position of the handle and of its end point on the table.
type CurveHandle = (EdgeRef, usize, DVec2, DVec2);

impl Points {
    fn press(&mut self, table: &Table<'_>, input: &Input, at: Pos2, asks: &mut Asks) {
        let p = table.at(at);
        if let Some(size) = table.size() {
            self.press_in(table, size, input, p, asks);
            return;
        }
        if let Some((edge, which, to, _)) = handle_at(table, p).filter(|h| table.is_free(h.0.piece)) {
            let shape = table.pattern().pieces[&edge.piece].edge(edge.edge).shape;
            self.drag = Some(Drag::Handle { edge, shape, which, to });
            return;
        }
        let free = |piece: PieceId, asks: &mut Asks| {
            let is_free = table.is_free(piece);
            if !is_free {
                asks.push(Ask::Say(tr("This piece is locked.").to_owned()));
            }
            is_free
        };
        if let Some(point) = table.shown_point_at(p) {
            if free(point.piece, asks) {
                let selection = self.taken(table, point.into(), input, asks);
                self.take(table, &selection, table.place_shown(point).unwrap_or(p));
            }
        } else if let Some(hit) = table.edge_at(p) {
            if free(hit.edge.piece, asks) {
                self.press_edge(table, input, hit, asks);
            }
        } else if let Some(line) = table.shown_line_at(p) {
            if free(line.piece, asks) {
                let selection = self.taken(table, Item::Line(line), input, asks);
                self.take(table, &selection, p);
            }
        } else {
            self.drag = Some(Drag::Box { from: p, to: p, add: input.held.shift });
        }
    }

    /// A press in a size other than the base, whose points can be moved.
    fn press_in(&mut self, table: &Table<'_>, size: usize, input: &Input, p: DVec2, asks: &mut Asks) {
        let point = table.shown_point_at(p).map(|point| (point.piece, point.into()));
        let line = || table.shown_line_at(p).map(|line| (line.piece, Item::Line(line)));
        let Some((piece, item)) = point.or_else(line) else {
            self.drag = Some(Drag::Box { from: p, to: p, add: input.held.shift });
            return;
        };
        if !table.is_free(piece) {
            asks.push(Ask::Say(tr("This piece is locked.").to_owned()));
            return;
        }
        let selection = self.taken(table, item, input, asks);
        let points = table.held_points(&selection);
        self.drag = Some(Drag::Grade { size, held: p, points, by: DVec2::ZERO });
    }

    fn press_edge(&mut self, table: &Table<'_>, input: &Input, hit: OnEdge, asks: &mut Asks) {
        let piece = &table.pattern().pieces[&hit.edge.piece];
        let (shape, (a, b)) = (piece.edge(hit.edge.edge).shape, piece.edge_ends(hit.edge.edge));
        if shape != EdgeShape::Line || input.held.alt {
            // With Shift the edge becomes an arc through the pointer.
            let arc = EdgeShape::Arc { radius: a.distance(b), large: false, sweep: true };
            let shape = if input.held.shift { arc } else { shape };
            let held = piece.pose.piece_from_plane(hit.place);
            self.drag = Some(Drag::Bend { edge: hit.edge, ends: [a, b], shape, at: hit.at, held });
            return;
        }
        let selection = self.taken(table, Item::Edge(hit.edge), input, asks);
        self.take(table, &selection, hit.place);
    }

    /// Begins to move the points of `selection`, held at a place on the table.
    fn take(&mut self, table: &Table<'_>, selection: &Selection, held: DVec2) {
        let points = held_points(table, selection);
        self.drag = Some(Drag::Move { held, points, by: DVec2::ZERO, snapped: None });
    }

    /// The items that a drag of `item` moves: all selected ones if it is one of them, else it alone.
    fn taken(&self, table: &Table<'_>, item: Item, input: &Input, asks: &mut Asks) -> Selection {
        let selection = table.laid.selection;
        if selection.has(item) {
            return selection.clone();
        }
        let selection = selection.clicked(Some(item), input.held.shift);
        asks.push(Ask::Pick(selection.clone()));
        selection
    }

    fn follow(&mut self, table: &Table<'_>, input: &Input, at: Pos2, asks: &mut Asks) {
        let p = table.at(at);
        match &mut self.drag {
            Some(Drag::Box { to, .. }) => *to = p,
            Some(Drag::Move { held, points, by, snapped }) => {
                let moving: BTreeSet<RulePoint> = points.iter().map(|(point, _)| *point).collect();
                let found = table.snapped(p, Some(*held), input.held, |point| moving.contains(&point.into()));
                (*by, *snapped) = (found.place - *held, found.by.map(|_| found));
                asks.extend(moved(table, points, *by).map(dragged));
            }
            Some(Drag::Grade { size, held, points, by }) => {
                *by = p - *held;
                let edit = grade::moved(table, *size, points, *by, input.held.shift);
                asks.extend(edit.map(|edit| dragged(vec![edit])));
            }
            Some(Drag::Bend { edge, ends, shape, at, held }) => {
                let Some(piece) = table.pattern().pieces.get(&edge.piece) else { return };
                let to = piece.pose.piece_from_plane(p);
                let shape = bent(*ends, *shape, *at, *held, to);
                asks.push(dragged(vec![PatternEdit::SetEdge { edge: *edge, shape }]));
            }
            Some(Drag::Handle { edge, shape, which, to }) => {
                let found = table.snapped(p, None, input.held, |point| point.piece == edge.piece);
                *to = found.place;
                let edit = handle_set(table, *edge, *shape, *which, *to);
                asks.extend(edit.map(|edit| dragged(vec![edit])));
            }
            None => {}
        }
    }

    fn finish(&mut self, table: &Table<'_>, asks: &mut Asks) {
        match self.drag.take() {
            Some(Drag::Box { from, to, add }) => {
                let (lower, upper) = (from.min(to), from.max(to));
                let inside = |p: DVec2| p.cmpge(lower).all() && p.cmple(upper).all();
                let mut selection = if add { table.laid.selection.clone() } else { Selection::default() };
                for (point, _) in table.points_shown().filter(|(_, p)| inside(*p)) {
                    match point {
                        RulePoint { piece, line: None, point } => {
                            selection.points.insert(PointRef { piece, point });
                        }
                        RulePoint { piece, line: Some(line), point } => {
                            selection.line_points.insert(LinePoint { piece, line, point });
                        }
                    }
                }
                asks.push(Ask::Pick(selection));
            }
            Some(_) => asks.push(Ask::EndDrag),
            None => {}
        }
    }

    fn double_click(&self, table: &Table<'_>, p: DVec2, asks: &mut Asks) {
        let Some(item) = self.under(table, p) else { return };
        let edit = match item {
            Item::Point(point) if table.is_free(point.piece) => {
                let Some(edit) = smooth_or_corner(table, point.into()) else { return };
                edit
            }
            Item::LinePoint(point) if table.is_free(point.piece) => {
                let Some(edit) = smooth_or_corner(table, point.into()) else { return };
                edit
            }
            Item::Edge(edge) if table.is_free(edge.piece) => {
                let Some(hit) = table.edge_at(p) else { return };
                let at = hit.at.clamp(0.01, 0.99);
                PatternEdit::InsertPoint { edge, at: nice_fraction(at, table.reach(REACH), table, edge) }
            }
            Item::Line(LineRef { piece, line }) if table.is_free(piece) => {
                let found = &table.pattern().pieces[&piece];
                let Some((point, at, _)) = found.lines[line].nearest(found.pose.piece_from_plane(p)) else {
                    return;
                };
                let edge = LinePoint { piece, line, point };
                PatternEdit::InsertLinePoint { edge, at: at.clamp(0.01, 0.99) }
            }
            _ => return,
        };
        asks.push(done(vec![edit]));
    }
}

/// `at`, or the middle of the edge if that is near.
fn nice_fraction(at: f64, reach: f64, table: &Table<'_>, edge: EdgeRef) -> f64 {
    let length = table.piece(edge.piece).map_or(1.0, |(_, shape)| shape.lengths[edge.edge]);
    if (at - 0.5).abs() * length <= reach { 0.5 } else { at }
}

impl PatternTool for Points {
    fn step(&mut self, table: &Table<'_>, input: &Input, asks: &mut Asks) {
        for &at in &input.clicks {
            let p = table.at(at);
            if table.size().is_some() || handle_at(table, p).is_none() {
                let item = self.under(table, p);
                asks.push(Ask::Pick(table.laid.selection.clicked(item, input.held.shift)));
            }
        }
        if input.double
            && table.size().is_none()
            && let Some(at) = input.hover
        {
            self.double_click(table, table.at(at), asks);
        }
        if let Some(at) = input.pressed {
            self.press(table, input, at, asks);
        }
        if let Some(&at) = input.trail.last() {
            self.follow(table, input, at, asks);
        }
        if input.let_go {
            self.finish(table, asks);
        }
        if input.nudge != DVec2::ZERO && self.drag.is_none() {
            let selection = table.laid.selection;
            let edits = match table.size() {
                Some(size) => {
                    let edit = grade::moved(table, size, &table.held_points(selection), input.nudge, false);
                    edit.map(|edit| vec![edit])
                }
                None => moved(table, &held_points(table, selection), input.nudge),
            };
            asks.extend(edits.map(done));
        }
        self.walk.step(table, input, asks);
    }

    fn draw(&self, drawing: &Drawing<'_>, table: &Table<'_>, input: &Input) {
        let stroke = Stroke::new(1.2, drawing.palette.accent.gamma_multiply(0.8));
        let handles = if table.size().is_none() { curve_handles(table) } else { Vec::new() };
        for (_, _, p, end) in handles {
            drawing.painter.line_segment([drawing.place(p), drawing.place(end)], stroke);
            drawing.knob(p, true, false);
        }
        for (point, p) in table.points_shown() {
            if drawing.pane.contains(drawing.place(p)) {
                let is_selected = table.laid.selection.has(point.into());
                let is_smooth = table.pattern().pieces[&point.piece].is_smooth_at(&point);
                drawing.knob(p, is_smooth == Some(true), is_selected);
            }
        }
        let at = input.hover.unwrap_or(drawing.pane.center());
        match &self.drag {
            Some(Drag::Box { from, to, .. }) => {
                let area = Rect::from_two_pos(drawing.place(*from), drawing.place(*to));
                let ink = drawing.palette.accent;
                let kind = egui::StrokeKind::Inside;
                drawing.painter.rect(area, 0.0, ink.gamma_multiply(0.12), Stroke::new(1.0, ink), kind);
            }
            Some(Drag::Move { by, snapped, points, .. }) => {
                if let Some(snapped) = snapped {
                    drawing.snapped(snapped);
                }
                drawing.chip(at, &readout(table, points, *by));
            }
            Some(Drag::Grade { size, points, by, .. }) => {
                drawing.chip(at, &grade::readout(table, *size, points, *by));
            }
            Some(Drag::Bend { edge, .. } | Drag::Handle { edge, .. }) => {
                if let Some((_, shape)) = table.piece(edge.piece) {
                    drawing.chip(at, &table.laid.unit.text(shape.lengths[edge.edge]));
                }
            }
            None => {}
        }
    }

    fn is_busy(&self) -> bool {
        self.drag.is_some()
    }

    fn is_dragging(&self) -> bool {
        self.drag.is_some()
    }

    fn takes_numbers(&self) -> bool {
        matches!(self.drag, Some(Drag::Move { .. }))
    }

    fn typed(&mut self, table: &Table<'_>, typed: Typed, asks: &mut Asks) -> Result<(), String> {
        let Some(Drag::Move { points, by, .. }) = &self.drag else {
            return Err(tr("drag a point, then type").to_owned());
        };
        let by = match (typed, &points[..]) {
            (Typed::Length(far), _) => by.normalize_or(DVec2::X) * far,
            (Typed::By(by), _) => by,
            (Typed::At(p), [(_, from)]) => p - *from,
            (Typed::At(by), _) => by,
        };
        asks.extend(moved(table, points, by).map(dragged));
        asks.push(Ask::EndDrag);
        self.drag = None;
        Ok(())
    }

    fn give_up(&mut self, asks: &mut Asks) {
        if !matches!(self.drag.take(), None | Some(Drag::Box { .. })) {
            asks.push(Ask::CancelDrag);
        }
    }

    fn under(&self, table: &Table<'_>, p: DVec2) -> Option<Item> {
        let point = table.shown_point_at(p).map(Item::from);
        // In a size other than the base edges cannot be moved.
        let edge = || table.edge_at(p).filter(|_| table.size().is_none()).map(|hit| Item::Edge(hit.edge));
        let line = || table.shown_line_at(p).map(Item::Line);
        point.or_else(edge).or_else(line).or_else(|| table.piece_at(p).map(|(piece, _)| Item::Piece(piece)))
    }

    fn cursor(&self, table: &Table<'_>, at: DVec2) -> CursorIcon {
        match self.under(table, at) {
            _ if self.drag.is_some() => CursorIcon::Grabbing,
            Some(Item::Point(_) | Item::Edge(_) | Item::Line(_) | Item::LinePoint(_)) => {
                CursorIcon::PointingHand
            }
            _ if table.size().is_none() && handle_at(table, at).is_some() => CursorIcon::PointingHand,
            _ => CursorIcon::Default,
        }
    }

    fn selected_by_keys(&self, table: &Table<'_>) -> Option<Item> {
        self.walk.shown(table.laid.selection)
    }

    fn hint_by_keys(&self) -> Option<&'static str> {
        Some(tr(
            "Tab: next point · Page down: edges, lines, seams · Space: keep it, to select more · Arrows: move · F6: on to the side panel, with what is sewn on there",
        ))
    }

    fn hint(&self, table: &Table<'_>) -> String {
        match &self.drag {
            Some(Drag::Grade { .. }) => tr("Shift: the same step in every size · Esc: back"),
            _ if table.size().is_some() => tr("Drag a point: it moves in this size alone, with Shift in all by the same step · Choose the base size to change the pattern itself"),
            Some(Drag::Move { .. }) => {
                tr("Type a place (30,40), a way (@10,0) or how far (5) · Shift: straight or slanting · Alt: do not snap · Esc: back")
            }
            Some(_) => tr("Alt: do not snap · Esc: back"),
            None => {
                tr("Drag a point, an edge or a line; click a line to see its points · Alt+drag an edge: bend it, with Shift to an arc · Double-click an edge or a line: insert a point; a point: corner or smooth · Delete: take it away")
            }
        }
        .to_owned()
    }
}

/// The edit that makes a corner smooth, or a smooth point a corner; None at the ends of an internal line.
fn smooth_or_corner(table: &Table<'_>, at: RulePoint) -> Option<PatternEdit> {
    let smooth = table.pattern().pieces.get(&at.piece)?.is_smooth_at(&at)?;
    Some(PatternEdit::smooth_at(at, !smooth))
}

/// Selected points, those of selected internal lines and the ends of selected edges, with their positions on the table; those of
/// locked pieces are left out.
fn held_points(table: &Table<'_>, selection: &Selection) -> Vec<(RulePoint, DVec2)> {
    let mut selection = selection.clone();
    for &EdgeRef { piece, edge } in &selection.edges {
        if let Some(found) = table.pattern().pieces.get(&piece).filter(|p| edge < p.edge_count()) {
            selection.points.extend([edge, found.next_edge(edge)].map(|point| PointRef { piece, point }));
        }
    }
    table.held_points(&selection)
}

/// The edits that move points of closed and internal lines by `by` on the table; None where there is no point.
fn moved(table: &Table<'_>, points: &[(RulePoint, DVec2)], by: DVec2) -> Option<Vec<PatternEdit>> {
    let (mut closed, mut inside) = (Vec::new(), Vec::new());
    for &(RulePoint { piece, line, point }, p) in points {
        let to = table.pattern().pieces.get(&piece)?.pose.piece_from_plane(p + by);
        match line {
            None => closed.push((PointRef { piece, point }, to)),
            Some(line) => inside.push((LinePoint { piece, line, point }, to)),
        }
    }
    let mut edits = Vec::new();
    if !closed.is_empty() {
        edits.push(PatternEdit::MovePoints { points: closed });
    }
    if !inside.is_empty() {
        edits.push(PatternEdit::MoveLinePoints { points: inside });
    }
    (!edits.is_empty()).then_some(edits)
}

/// A readout: the position of a single point, or the length and direction of an edge whose two points are moved.
fn readout(table: &Table<'_>, points: &[(RulePoint, DVec2)], by: DVec2) -> String {
    let unit = table.laid.unit;
    match points {
        [(point, p)] => {
            let at = *p + by;
            let mut words = unit.point(at);
            if let Some((piece, shape)) = table.piece(point.piece).filter(|_| point.line.is_none()) {
                let (line, first) = piece.loop_of(point.point);
                let count = piece.loop_edges(line).len();
                let before = first + (point.point - first + count - 1) % count;
                words = say!(
                    "{place}   edges {before} and {after}",
                    place = words,
                    before = unit.number(shape.lengths[before]),
                    after = unit.text(shape.lengths[point.point])
                );
            }
            words
        }
        _ => format!("{}  {}°", unit.text(by.length()), degrees(by.to_angle())),
    }
}

/// Handles of curves at selected points and edges, or of the piece under the pointer when nothing is selected.
fn curve_handles(table: &Table<'_>) -> Vec<CurveHandle> {
    let selection = table.laid.selection;
    let mut pieces = selection.pieces_touched();
    if let (
        true,
        Some(Item::Piece(piece) | Item::Edge(EdgeRef { piece, .. }) | Item::Point(PointRef { piece, .. })),
    ) = (pieces.is_empty(), table.laid.highlight)
    {
        pieces.insert(piece);
    }
    let mut all = Vec::new();
    for id in pieces {
        let Some(piece) = table.pattern().pieces.get(&id).filter(|piece| !piece.hidden) else { continue };
        for i in 0..piece.edge_count() {
            let place = |p: DVec2| piece.pose.plane_from_piece(p);
            let (a, b) = piece.edge_ends(i);
            let edge = EdgeRef { piece: id, edge: i };
            match piece.edge(i).shape {
                EdgeShape::Line | EdgeShape::Arc { .. } => {}
                EdgeShape::Quadratic { control } => all.push((edge, 0, place(control), place(a))),
                EdgeShape::Cubic { controls: [c, d] } => {
                    all.extend([(edge, 0, place(c), place(a)), (edge, 1, place(d), place(b))]);
                }
            }
        }
    }
    all
}

fn handle_at(table: &Table<'_>, p: DVec2) -> Option<CurveHandle> {
    let near = curve_handles(table).into_iter().filter(|h| h.2.distance(p) <= table.reach(REACH * 0.8));
    let points = table.shown_point_at(p);
    // Where a handle coincides with a point, the point is picked.
    let near = near.filter(|h| {
        points.is_none_or(|point| table.place_shown(point).is_none_or(|q| q.distance(p) > h.2.distance(p)))
    });
    near.min_by(|a, b| a.2.distance(p).total_cmp(&b.2.distance(p)))
}

fn handle_set(
    table: &Table<'_>,
    edge: EdgeRef,
    shape: EdgeShape,
    which: usize,
    to: DVec2,
) -> Option<PatternEdit> {
    let to = table.pattern().pieces.get(&edge.piece)?.pose.piece_from_plane(to);
    let shape = match shape {
        EdgeShape::Quadratic { .. } => EdgeShape::Quadratic { control: to },
        EdgeShape::Cubic { mut controls } => {
            controls[which] = to;
            EdgeShape::Cubic { controls }
        }
        other => other,
    };
    Some(PatternEdit::SetEdge { edge, shape })
}

/// The curve from `a` to `b` bent so that the point `held`, at the fraction `at` of it, moves to `to`. All in the piece's own
/// plane.
fn bent([a, b]: [DVec2; 2], shape: EdgeShape, at: f64, held: DVec2, to: DVec2) -> EdgeShape {
    let t = at.clamp(0.15, 0.85);
    let by = to - held;
    match shape {
        EdgeShape::Line => EdgeShape::Quadratic { control: (a + b) / 2.0 + by / (2.0 * t * (1.0 - t)) },
        EdgeShape::Quadratic { control } => {
            EdgeShape::Quadratic { control: control + by / (2.0 * t * (1.0 - t)) }
        }
        EdgeShape::Cubic { controls } => {
            EdgeShape::Cubic { controls: controls.map(|c| c + by / (3.0 * t * (1.0 - t))) }
        }
        EdgeShape::Arc { .. } => curve::arc_through(a, to, b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bent_edge_goes_through_the_pointer() {
        let (a, b) = (DVec2::ZERO, DVec2::new(2.0, 0.0));
        for shape in [
            EdgeShape::Line,
            EdgeShape::Quadratic { control: DVec2::new(1.0, 0.5) },
            EdgeShape::Cubic { controls: [DVec2::new(0.5, 0.5), DVec2::new(1.5, 0.5)] },
            EdgeShape::Arc { radius: 1.5, large: false, sweep: true },
        ] {
            let held = curve::points(a, shape, b, &[0.5])[0];
            for to in [DVec2::new(1.0, 0.7), DVec2::new(1.0, -0.6), DVec2::new(1.0, 1.8)] {
                let new = bent([a, b], shape, 0.5, held, to);
                let p = curve::points(a, new, b, &[0.5])[0];
                assert!((p - to).length() < 1e-6, "{shape:?} to {to}: {p}");
            }
        }
        assert_eq!(curve::arc_through(a, DVec2::new(1.0, 0.0), b), EdgeShape::Line);
    }
}
