//! Points of closed and internal lines as the tool Edit points shows and finds them: in the shown size.

use glam::DVec2;

use super::table::{NEAR_EDGE, REACH, Table};
use super::threads::to_polyline;
use crate::pattern::{Pattern, RulePoint};
use crate::ui::selection::{LineRef, Selection};

impl Table<'_> {
    /// Points of all closed lines, and of the internal lines that are selected or have a selected point: on the table, in the
    /// shown size.
    pub fn points_shown(&self) -> impl Iterator<Item = (RulePoint, DVec2)> {
        let closed = self.points().map(|(point, _)| RulePoint::from(point));
        let lines = self.laid.selection.lines_touched().into_iter();
        let inside = lines.flat_map(|line| points_of(self.pattern(), line));
        let seen =
            inside.filter(|at| self.pattern().pieces.get(&at.piece).is_some_and(|piece| !piece.hidden));
        closed.chain(seen).filter_map(|at| Some((at, self.place_shown(at)?)))
    }

    /// Where a point is on the table in the shown size.
    pub fn place_shown(&self, at: RulePoint) -> Option<DVec2> {
        let piece = self.pattern().pieces.get(&at.piece)?;
        let own = match self.size() {
            Some(size) => self.nests.point(size, at),
            None => piece.place_of(&at),
        };
        Some(piece.pose.plane_from_piece(own?))
    }

    /// The nearest shown point within reach of `p`: of equal ones that of a closed line, of the topmost piece.
    pub fn shown_point_at(&self, p: DVec2) -> Option<RulePoint> {
        let near = self.points_shown().map(|(at, q)| (at, q.distance(p)));
        let near = near.filter(|(_, d)| *d <= self.reach(REACH));
        let order = |at: &RulePoint| (at.line.is_some(), std::cmp::Reverse(*at));
        near.min_by(|a, b| a.1.total_cmp(&b.1).then(order(&a.0).cmp(&order(&b.0)))).map(|(at, _)| at)
    }

    /// An internal line as a polyline in the plane of its piece, in the shown size.
    pub fn line_shown(&self, LineRef { piece, line }: LineRef) -> Option<&[DVec2]> {
        let nested = self.size().and_then(|size| self.nests.pieces.get(size)?.get(&piece));
        let lines = match nested {
            Some(nested) => &nested.inside,
            None => &self.shapes.of(piece)?.lines,
        };
        lines.get(line).map(Vec::as_slice)
    }

    /// The internal line within reach of `p` in the shown size; of equal ones that of the topmost piece.
    pub fn shown_line_at(&self, p: DVec2) -> Option<LineRef> {
        let all = self.seen().flat_map(|(id, piece, _)| {
            let own = piece.pose.piece_from_plane(p);
            let lines = (0..piece.lines.len()).map(move |line| LineRef { piece: id, line });
            lines.filter_map(move |line| Some((line, to_polyline(own, self.line_shown(line)?))))
        });
        let near = all.filter(|(_, d)| *d <= self.reach(NEAR_EDGE));
        near.min_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0))).map(|(line, _)| line)
    }

    /// Selected points and those of selected internal lines, where they are in the shown size; those of locked pieces are left
    /// out. Of a line that ends where it starts both ends are held.
    pub fn held_points(&self, selection: &Selection) -> Vec<(RulePoint, DVec2)> {
        let lines = selection.lines.iter();
        let of_lines = lines.flat_map(|line| points_of(self.pattern(), *line));
        let mut held: Vec<RulePoint> = selection.all_points().chain(of_lines).collect();
        held.extend(held.clone().into_iter().filter_map(|at| {
            let line = self.pattern().pieces.get(&at.piece)?.lines.get(at.line?)?;
            Some(RulePoint { point: line.meeting_end(at.point)?, ..at })
        }));
        held.sort_unstable();
        held.dedup();
        let free = held.into_iter().filter(|at| self.is_free(at.piece));
        free.filter_map(|at| Some((at, self.place_shown(at)?))).collect()
    }
}

/// The points of an internal line; none where there is no such line.
pub fn points_of(pattern: &Pattern, line: LineRef) -> impl Iterator<Item = RulePoint> {
    let found = pattern.pieces.get(&line.piece).and_then(|piece| piece.lines.get(line.line));
    let count = found.map_or(0, |line| line.edges.len() + 1);
    (0..count).map(move |point| RulePoint { piece: line.piece, line: Some(line.line), point })
}
