//! The tool that draws internal lines of pieces on the dressed cloth, point by point.

use egui::accesskit::Role;
use egui::{CursorIcon, EventFilter, Key, Modifiers, Pos2, Rect, Response, Sense, WidgetInfo};
use glam::DVec2;

use super::hand::cloth_at;
use super::outlines::on_cloth;
use super::{ScenePane, Seen};
use crate::cloth::FlatPiece;
use crate::geometry::ids::PieceId;
use crate::pattern::edit::{PatternEdit, nearest_on_edge};
use crate::pattern::{Edge, InternalLine, Pattern, Piece};
use crate::session::Command;
use crate::sim::ClothPlace;
use crate::ui::actions::Tool;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, tr};
use crate::ui::look::chip::chip;
use crate::ui::pattern_pane::snap::on_eighth;
use crate::ui::pointer::mouse::{Mouse, held};
use crate::ui::preferences::units::degrees;

/// Snapping distances, points of the screen: to points, to edges.
const PULL: [f64; 2] = [10.0, 7.0];
/// Shortest distance between two points of a line, metres; nearer ones are clicked by accident.
const SHORTEST: f64 = 1e-3;
/// Largest distance between the two clicks of a double click, points of the screen.
const SAME: f32 = 8.0;
/// Least number of points of a line.
const LEAST: usize = 2;
/// Least number of points that a line has before it can end where it starts.
const LEAST_ROUND: usize = 3;

/// The line being drawn.
#[derive(Debug, Default)]
pub(super) struct ClothLine {
    /// The piece that the line is on; None before the first point.
    piece: Option<PieceId>,
    /// Its points in the piece's own plane, metres.
    points: Vec<DVec2>,
    /// Where the last point was clicked on the screen.
    clicked: Option<Pos2>,
    /// The pointer, or the keyboard's cursor, and the point that a click there would add.
    next: Option<(Pos2, Result<ClothPlace, Refusal>)>,
}

/// Why there can be no point of the line at a place of the screen.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Refusal {
    /// No cloth is seen there.
    NoCloth,
    /// The piece is locked.
    Locked,
    /// The cloth there belongs to the piece `other`, the line to the piece `on`.
    OtherPiece { on: String, other: String },
    /// The straight line would leave its piece.
    OffPiece,
}

impl Refusal {
    fn words(&self) -> String {
        match self {
            Self::NoCloth => tr("There is no cloth there.").to_owned(),
            Self::Locked => tr("This piece is locked.").to_owned(),
            Self::OtherPiece { on, other } => {
                say!("The line is on {on} and ends at its seams: this is {other}.", on, other)
            }
            Self::OffPiece => tr("The line would leave its piece.").to_owned(),
        }
    }
}

impl ClothLine {
    /// The point that a click would add; None where it would add none.
    fn next(&self) -> Option<ClothPlace> {
        self.next.as_ref().and_then(|(_, place)| place.as_ref().ok().copied())
    }

    /// Why a click would add no point, where cloth is seen.
    fn refusal(&self) -> Option<&Refusal> {
        let refusal = self.next.as_ref().and_then(|(_, place)| place.as_ref().err());
        refusal.filter(|why| **why != Refusal::NoCloth)
    }
}

impl ScenePane {
    /// Whether a line is being drawn on the cloth.
    pub fn is_drawing_line(&self) -> bool {
        !self.line.points.is_empty()
    }

    /// Forgets the line being drawn.
    pub fn give_up_line(&mut self) {
        self.line = ClothLine::default();
    }

    /// The hint for the status bar while a line is drawn: why no point can be at the pointer, or what can be done next. None
    /// while none is drawn.
    pub fn hint_of_line(&self, mouse: Mouse) -> Option<String> {
        if let Some(refusal) = self.line.refusal() {
            return Some(refusal.words());
        }
        let words = || {
            say!(
                "Click: the next corner · Double-click or Enter: done · Backspace: one back · Shift: 45° · Esc: give up · {view}",
                view = mouse.view_hint()
            )
        };
        self.is_drawing_line().then(words)
    }

    /// A click with the tool, or Space at the keyboard's cursor: adds a point. At the last point, or with `double` as the second
    /// click of a double click, it ends the line: where drawing is slow, the second click comes too late to be one of a double click.
    pub(super) fn click_line(
        &mut self,
        seen: &Seen<'_>,
        pane: Rect,
        at: Pos2,
        (held, double): (Modifiers, bool),
        asks: &mut Asks,
    ) {
        let again = double && self.line.clicked.is_some_and(|first| first.distance(at) <= SAME);
        let mut adds = false;
        if !again {
            match self.line_place(seen, pane, at, held) {
                Ok(place) => adds = self.add_to_line(place, at),
                Err(why) => return asks.push(Ask::Say(why.words())),
            }
        }
        // Of a double click within one slow frame only one click is told.
        if double || !adds {
            self.finish_line(asks);
        }
    }

    /// Adds a point, unless it is at the last one.
    fn add_to_line(&mut self, ClothPlace { piece, at: own }: ClothPlace, at: Pos2) -> bool {
        let line = &mut self.line;
        let adds = line.points.last().is_none_or(|last| last.distance(own) >= SHORTEST);
        if adds {
            line.piece = Some(piece);
            line.points.push(own);
        }
        line.clicked = Some(at);
        adds
    }

    fn finish_line(&mut self, asks: &mut Asks) {
        let Some(piece) = self.line.piece else { return };
        let [starts @ .., end] = &self.line.points[..] else { return };
        if starts.len() + 1 < LEAST {
            return asks.push(Ask::Say(say!("It needs {least} points at least.", least = LEAST)));
        }
        let edges = starts.iter().map(|&start| Edge { start, ..Edge::default() }).collect();
        let line = InternalLine { edges, end: *end, ..InternalLine::default() };
        let edits = vec![PatternEdit::AddLine { piece, line }];
        asks.push(Ask::Do(Command::EditPattern { edits, anew: false }));
        self.give_up_line();
    }

    /// Handles the keys of a line being drawn, while the pane has the focus, or nothing has it and the pointer is over the pane.
    pub(super) fn listen_for_line(
        &mut self,
        ui: &egui::Ui,
        seen: &Seen<'_>,
        response: &Response,
        asks: &mut Asks,
    ) {
        let nothing_else = ui.ctx().memory(|m| m.focused()).is_none();
        let hears = response.has_focus() || (nothing_else && self.hovered);
        if seen.tool != Tool::ClothLine || !self.is_drawing_line() || !hears {
            return;
        }
        if response.has_focus() {
            let filter = EventFilter { escape: true, ..EventFilter::default() };
            ui.ctx().memory_mut(|m| m.set_focus_lock_filter(response.id, filter));
        }
        let pressed = |key| ui.input_mut(|i| i.consume_key(Modifiers::NONE, key));
        if pressed(Key::Enter) {
            self.finish_line(asks);
        } else if pressed(Key::Escape) {
            self.give_up_line();
        } else if pressed(Key::Backspace) {
            self.line.points.pop();
            self.line.clicked = None;
            if self.line.points.is_empty() {
                self.give_up_line();
            }
        }
    }

    /// Determines what a click at the pointer would do. A line whose tool, piece or cloth is gone is given up.
    pub(super) fn aim_line(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect, response: &Response) {
        let pieces = &seen.document.pattern.pieces;
        let is_gone = self.line.piece.is_some_and(|id| !pieces.contains_key(&id));
        if seen.tool != Tool::ClothLine || seen.cloth.is_none() || is_gone {
            return self.give_up_line();
        }
        let pointer = response.hover_pos().filter(|_| self.drag.is_none());
        let at = self.cross(pane).or(pointer);
        self.line.next = at.map(|at| (at, self.line_place(seen, pane, at, held(ui))));
    }

    /// The point that a click at a place of the screen would add to the line. Shift lets the line run in eighths of a turn, as
    /// its piece lies on the table; Alt and Ctrl switch snapping off.
    fn line_place(
        &self,
        seen: &Seen<'_>,
        pane: Rect,
        at: Pos2,
        held: Modifiers,
    ) -> Result<ClothPlace, Refusal> {
        let (garment, _) = seen.cloth.ok_or(Refusal::NoCloth)?;
        let hit = cloth_at(seen, self.ray(pane, at)).ok_or(Refusal::NoCloth)?;
        let (id, own) = (hit.place.piece, hit.place.at);
        let pieces = &seen.document.pattern.pieces;
        let piece = pieces.get(&id).ok_or(Refusal::NoCloth)?;
        if let Some(on) = self.line.piece.filter(|on| *on != id) {
            let on = pieces.get(&on).map(|on| on.name.clone()).unwrap_or_default();
            return Err(Refusal::OtherPiece { on, other: piece.name.clone() });
        }
        if piece.locked {
            return Err(Refusal::Locked);
        }
        let points = &self.line.points;
        if let Some(&last) = points.last().filter(|_| held.shift) {
            let own = straight(piece, last, own);
            let is_on = FlatPiece::new(garment, id).inside(garment, own).is_some();
            return if is_on { Ok(ClothPlace { piece: id, at: own }) } else { Err(Refusal::OffPiece) };
        }
        let snaps = seen.snapping && !held.alt && !held.command;
        let metres = self.metres_per_point(hit.point, pane).filter(|_| snaps).unwrap_or(0.0);
        let first = points.first().copied().filter(|_| points.len() >= LEAST_ROUND);
        Ok(ClothPlace { piece: id, at: snapped(piece, first, own, PULL.map(|pull| pull * metres)) })
    }

    /// The cursor over the pane with this tool.
    pub(super) fn line_cursor(&self) -> CursorIcon {
        match (self.line.next(), self.line.refusal()) {
            (Some(_), _) => CursorIcon::Crosshair,
            (None, Some(_)) => CursorIcon::NotAllowed,
            (None, None) => CursorIcon::Default,
        }
    }

    /// The line being drawn up to the pointer, and its points as lines of one point, each in its piece's own plane.
    pub(super) fn line_shown(&self, pattern: &Pattern) -> Vec<(PieceId, Vec<DVec2>)> {
        let Some(id) = self.line.piece.filter(|_| self.is_drawing_line()) else { return Vec::new() };
        let Some(piece) = pattern.pieces.get(&id) else { return Vec::new() };
        let mut points = self.line.points.clone();
        points.extend(self.line.next().map(|next| next.at));
        let dots = points.iter().map(|&p| (id, vec![p]));
        let whole = (points.len() > 1).then(|| (id, on_cloth(piece, &points)));
        whole.into_iter().chain(dots).collect()
    }

    /// Writes beside the pointer how long the line's next side is, or why no point can be there, and publishes the points to
    /// screen readers and tests.
    pub(super) fn line_ui(&self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect) {
        let Some((garment, state)) = seen.cloth else { return };
        if let Some((at, _)) = &self.line.next {
            let words = self.line.refusal().map(Refusal::words).or_else(|| self.side_words(seen));
            if let Some(words) = words {
                chip(&ui.painter_at(pane), pane, *at, &words, seen.palette.weak, seen.palette);
            }
        }
        let Some(id) = self.line.piece else { return };
        let flat = FlatPiece::new(garment, id);
        for (p, number) in self.line.points.iter().zip(1..) {
            let point = flat.nearest(garment, *p).and_then(|place| place.point(garment, state));
            let Some(at) = point.and_then(|point| self.place_of(point, pane)) else { continue };
            let rect = Rect::from_center_size(at, egui::Vec2::splat(12.0));
            let node = ui.interact(rect, ui.scope_id().with(("point of the line", number)), Sense::hover());
            let words = say!("Corner {number} of the line", number);
            node.widget_info(|| WidgetInfo::labeled(Role::Label, true, &words));
        }
    }

    /// Length of the side from the last point to the pointer, on the flat cloth, and its angle on the table.
    fn side_words(&self, seen: &Seen<'_>) -> Option<String> {
        let (last, next) = (*self.line.points.last()?, self.line.next()?);
        let pose = seen.document.pattern.pieces.get(&next.piece)?.pose;
        let along = pose.plane_from_piece(next.at) - pose.plane_from_piece(last);
        let turn = degrees(along.to_angle());
        Some(format!("{}  {turn}°", seen.unit.text(along.length())))
    }
}

/// `p` moved so that the line from `last` to it runs in eighths of a turn as the piece lies on the table; both in the piece's own
/// plane.
fn straight(piece: &Piece, last: DVec2, p: DVec2) -> DVec2 {
    let [from, to] = [last, p].map(|p| piece.pose.plane_from_piece(p));
    piece.pose.piece_from_plane(on_eighth(from, to))
}

/// `p` moved to the nearest point of the piece's border, or `first`, within `reach[0]` metres; else to the nearest edge within
/// `reach[1]`; else `p`.
fn snapped(piece: &Piece, first: Option<DVec2>, p: DVec2, reach: [f64; 2]) -> DVec2 {
    let points = (0..piece.edge_count()).map(|i| piece.edge(i).start).chain(first);
    let nearest = points.map(|q| (q, q.distance(p))).min_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((point, _)) = nearest.filter(|(_, away)| *away <= reach[0]) {
        return point;
    }
    let edges = (0..piece.edge_count()).map(|i| (i, nearest_on_edge(piece, i, p)));
    let nearest = edges.min_by(|a, b| a.1.1.total_cmp(&b.1.1)).filter(|(_, (_, away))| *away <= reach[1]);
    nearest.map_or(p, |(i, (at, _))| piece.edge_points(i, &[at])[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::PlanePose;

    fn square() -> Piece {
        let corners = [[0.0, 0.0], [0.4, 0.0], [0.4, 0.4], [0.0, 0.4]].map(DVec2::from);
        Piece::polygon("square", &corners)
    }

    #[test]
    fn places_near_the_border_or_the_first_point_are_drawn_there() {
        let (piece, first) = (square(), Some(DVec2::new(0.2, 0.2)));
        let to = |x: f64, y: f64| snapped(&piece, first, DVec2::new(x, y), [0.01, 0.007]);
        assert_eq!(to(0.006, 0.395), DVec2::new(0.0, 0.4), "a corner, before the edges beside it");
        assert!(to(0.3, 0.005).distance(DVec2::new(0.3, 0.0)) < 1e-6, "an edge");
        assert_eq!(to(0.3, 0.009), DVec2::new(0.3, 0.009), "too far from it");
        assert_eq!(to(0.206, 0.2), DVec2::new(0.2, 0.2), "where the line starts");
        let alone = snapped(&piece, None, DVec2::new(0.206, 0.2), [0.01, 0.007]);
        assert_eq!(alone, DVec2::new(0.206, 0.2));
    }

    #[test]
    fn straight_lines_are_so_on_the_table() {
        let pose = PlanePose { offset: DVec2::ONE, rotation: 0.3, flipped: true };
        let piece = Piece { pose, ..square() };
        let (last, p) = (DVec2::new(0.1, 0.1), DVec2::new(0.3, 0.15));
        let [from, to] = [last, straight(&piece, last, p)].map(|p| pose.plane_from_piece(p));
        let turns = (to - from).to_angle() / std::f64::consts::FRAC_PI_4;
        assert!((turns - turns.round()).abs() < 1e-9, "{turns}");
        assert!((to - from).length() > 0.15, "{from} {to}");
    }
}
