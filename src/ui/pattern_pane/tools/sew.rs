//! The tool Sew: joins edges, stretches of edges, or several edges to one. The threads are shown before the click that sews.

use egui::{CursorIcon, Stroke};
use glam::DVec2;

use super::select::next;
use super::{PatternTool, done};
use crate::geometry::ids::SeamId;
use crate::pattern::edit::{PatternEdit, apply, untwisted};

use crate::pattern::{EdgeRef, Pattern, Piece, Seam, Stretch};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, signed, tr};
use crate::ui::pattern_pane::draw::Drawing;
use crate::ui::pattern_pane::draw_pieces::{BADGE, EQUAL, badge_place, has_badge};
use crate::ui::pattern_pane::input::Input;
use crate::ui::pattern_pane::table::{OnEdge, REACH, Table};
use crate::ui::selection::{Item, Selection};

/// The tool Sew.
#[derive(Debug, Default)]
pub struct Sew {
    /// Stretches of the first side, and those of the second chosen so far.
    sides: [Vec<Stretch>; 2],
    /// Whether the second side is being chosen; with several edges Enter ends the first side.
    on_second: bool,
    /// A stretch being drawn along a line: its beginning, and its present end.
    drawn: Option<[OnEdge; 2]>,
    /// The edge under the pointer.
    near: Option<EdgeRef>,
}

impl Sew {
    /// Adds a stretch to the side that is being chosen.
    fn take(&mut self, table: &Table<'_>, stretch: Stretch, more: bool, asks: &mut Asks) {
        let second = self.on_second || (!self.sides[0].is_empty() && !more);
        let side = &mut self.sides[usize::from(second)];
        match side.iter().position(|s| *s == stretch) {
            Some(i) => {
                side.remove(i);
                return;
            }
            None => side.push(stretch),
        }
        if second && !more {
            self.sew(table, asks);
        }
    }

    fn sew(&mut self, table: &Table<'_>, asks: &mut Asks) {
        let seams = seams(table.pattern(), &self.sides);
        if seams.is_empty() {
            asks.push(Ask::Say(tr("An edge cannot be sewn to itself.").to_owned()));
            self.sides[1].clear();
            return;
        }
        let sew = |seam: &Seam| PatternEdit::Sew {
            seam: with_ratio(table.pattern(), *seam, table.options.keep_equal),
        };
        // Where a seam is refused, the refusal is told and no more.
        let is_sewn = seams.iter().all(|seam| apply(table.pattern(), &sew(seam)).is_ok());
        asks.push(done(seams.iter().map(sew).collect()));
        if let Some(words) = told_difference(table, &self.sides).filter(|_| is_sewn) {
            asks.push(Ask::Say(words));
        }
        *self = Self::default();
    }

    /// The sides as they would be after a click now.
    fn to_be(&self, table: &Table<'_>) -> [Vec<Stretch>; 2] {
        let mut sides = self.sides.clone();
        let more = self.drawn.and_then(|[from, to]| between(table, from, to));
        let more = more.or_else(|| self.near.map(Stretch::from));
        if let Some(stretch) = more.filter(|s| !sides[0].contains(s) && !sides[1].contains(s)) {
            let side = usize::from(self.on_second || !sides[0].is_empty());
            sides[side].push(stretch);
        }
        sides
    }

    fn click(&mut self, table: &Table<'_>, input: &Input, p: DVec2, asks: &mut Asks) {
        if let Some(seam) = badge_at(table, p).filter(|_| self.sides[0].is_empty()) {
            asks.extend([
                Ask::Pick(Selection::of(Item::Seam(seam))),
                done(vec![PatternEdit::TurnSeam { seam }]),
            ]);
        } else if let Some(hit) = table.edge_at(p) {
            self.take(table, Stretch::from(hit.edge), input.held.shift, asks);
        } else {
            let seam = table.thread_at(p).map(Item::Seam);
            asks.push(Ask::Pick(table.laid.selection.clicked(seam, input.held.shift)));
        }
    }
}

/// The seam whose badge is at `p`.
fn badge_at(table: &Table<'_>, p: DVec2) -> Option<SeamId> {
    let reach = table.reach(f64::from(BADGE) + 2.0);
    let distance = |side: &Vec<DVec2>| badge_place(side).map(|q| q.distance(p));
    let near =
        table.threads.all().filter(|(_, ends)| ends.is_seen(table.pattern())).filter_map(|(id, ends)| {
            let sides = ends.on_table(table.pattern())?;
            let shown = sides.iter().filter(|side| has_badge(table, id, side));
            let least = shown.filter_map(distance).reduce(f64::min)?;
            (least <= reach).then_some((id, least))
        });
    near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(id, _)| id)
}

impl PatternTool for Sew {
    fn step(&mut self, table: &Table<'_>, input: &Input, asks: &mut Asks) {
        for side in &mut self.sides {
            side.retain(|stretch| Item::Edge(stretch.first_edge()).is_in(table.pattern()));
        }
        for &at in &input.clicks {
            self.click(table, input, table.at(at), asks);
        }
        if let Some(at) = input.pressed {
            self.drawn = place(table, table.at(at), input).map(|on| [on, on]);
        }
        if let (Some([from, to]), Some(&at)) = (&mut self.drawn, input.trail.last())
            && let Some(on) = place_on_line(table, table.at(at), *from, input)
        {
            *to = on;
        }
        if input.let_go
            && let Some([from, to]) = self.drawn.take()
            && let Some(stretch) = between(table, from, to)
        {
            self.take(table, stretch, input.held.shift, asks);
        }
        if input.enter {
            match (self.sides[0].is_empty(), self.sides[1].is_empty()) {
                (false, false) => self.sew(table, asks),
                (false, true) => match table.laid.selection.edges.first() {
                    Some(&edge) if !self.sides[0].contains(&Stretch::from(edge)) => {
                        self.take(table, Stretch::from(edge), false, asks);
                    }
                    _ => self.on_second = true,
                },
                _ => {
                    let edge = table.laid.selection.edges.first();
                    edge.into_iter().for_each(|&edge| self.take(table, Stretch::from(edge), false, asks));
                }
            }
        }
        if input.backspace && self.sides[1].pop().is_none() {
            self.sides[0].pop();
            self.on_second = false;
        }
        if input.next != 0 {
            let all: Vec<Item> = table
                .seen()
                .flat_map(|(piece, found, _)| {
                    (0..found.edge_count()).map(move |edge| Item::Edge(EdgeRef { piece, edge }))
                })
                .collect();
            let chosen = table.laid.selection.edges.first().map(|&edge| Item::Edge(edge));
            asks.extend(next(&all, chosen, input.next).map(|item| Ask::Pick(Selection::of(item))));
        }
        let at = input.hover.map(|at| table.at(at));
        self.near = at.and_then(|p| table.edge_at(p)).map(|hit| hit.edge);
    }

    fn draw(&self, drawing: &Drawing<'_>, table: &Table<'_>, input: &Input) {
        let ink = drawing.palette.accent;
        let sides = self.to_be(table);
        for stretch in sides.iter().flatten() {
            drawing.stretch(table, *stretch, ink, 4.0);
        }
        for seam in seams(table.pattern(), &sides) {
            drawing.seam_to_be(table, &seam, ink);
        }
        let at = input.hover.unwrap_or(drawing.pane.center());
        if let Some([from, to]) = self.drawn {
            for on in [from, to] {
                drawing.painter.circle_stroke(drawing.place(on.place), 5.0, Stroke::new(2.0, ink));
            }
        }
        let lengths = [0, 1].map(|k| total(table.pattern(), &sides[k]));
        if lengths[0] > 0.0 && lengths[1] > 0.0 {
            let differs = (lengths[0] / lengths[1] - 1.0).abs() > EQUAL;
            let ink = if differs { drawing.palette.warning } else { drawing.palette.weak };
            drawing.chip_in(at, &compared(table, lengths), ink);
        } else if lengths[0] > 0.0 {
            drawing.chip(at, &table.laid.unit.text(lengths[0]));
        } else if let Some(Item::Seam(id)) = table.laid.highlight
            && let Some(ends) = table.threads.of(id)
        {
            let words = compared(table, ends.lengths);
            drawing.chip(at, &if ends.is_twisted { say!("{words}   twisted", words) } else { words });
        }
    }

    fn is_busy(&self) -> bool {
        !self.sides[0].is_empty() || self.drawn.is_some()
    }

    fn is_dragging(&self) -> bool {
        self.drawn.is_some()
    }

    fn takes_numbers(&self) -> bool {
        false
    }

    fn give_up(&mut self, _asks: &mut Asks) {
        *self = Self::default();
    }

    fn under(&self, table: &Table<'_>, p: DVec2) -> Option<Item> {
        let badge = badge_at(table, p).filter(|_| self.sides[0].is_empty()).map(Item::Seam);
        let edge = || table.edge_at(p).map(|hit| Item::Edge(hit.edge));
        badge.or_else(edge).or_else(|| table.thread_at(p).map(Item::Seam))
    }

    fn cursor(&self, table: &Table<'_>, at: DVec2) -> CursorIcon {
        if self.under(table, at).is_some() { CursorIcon::PointingHand } else { CursorIcon::Default }
    }

    fn hint(&self, _table: &Table<'_>) -> String {
        match (self.sides[0].len(), self.on_second) {
            (0, _) => {
                tr("Click an edge, then the one it is sewn to · Drag along edges: a stretch · Click a round sign: turn a seam round · Shift: several edges")
            }
            (_, false) => {
                tr("Click the edge it is sewn to · Shift+click: more edges on this side · Enter: several on the other · Esc: give up")
            }
            (_, true) => tr("Shift+click the edges of the other side · Enter: sew · Esc: give up"),
        }
        .to_owned()
    }
}

/// The lengths of both sides and their difference, in words.
pub fn compared(table: &Table<'_>, [a, b]: [f64; 2]) -> String {
    let unit = table.laid.unit;
    let percent = (a / b.max(1e-9) - 1.0) * 100.0;
    let more = signed((a - b) * 1000.0, 1);
    say!(
        "{first} on {second}   {more} mm ({percent} %)",
        first = unit.number(a),
        second = unit.text(b),
        more,
        percent = signed(percent, 1)
    )
}

fn told_difference(table: &Table<'_>, sides: &[Vec<Stretch>; 2]) -> Option<String> {
    let [a, b] = [0, 1].map(|k| total(table.pattern(), &sides[k]));
    let differs = (a / b.max(1e-9) - 1.0).abs() > EQUAL;
    differs.then(|| {
        say!(
            "Sewn with a gather: {lengths}. Select the seam and press \"{button}\" to even it out.",
            lengths = compared(table, [a, b]),
            button = tr("Make equal")
        )
    })
}

fn total(pattern: &Pattern, side: &[Stretch]) -> f64 {
    side.iter().filter_map(|s| s.length(pattern.pieces.get(&s.piece)?)).sum()
}

/// Sets the ratio of lengths that the seam keeps: 1 if the lengths are nearly equal, else their present ratio; None without
/// `keep`.
fn with_ratio(pattern: &Pattern, seam: Seam, keep: bool) -> Seam {
    let [a, b] = seam.sides.map(|side| total(pattern, &[side]));
    let ratio = if (a / b.max(1e-9) - 1.0).abs() > EQUAL { a / b.max(1e-9) } else { 1.0 };
    Seam { ratio: keep.then_some(ratio), ..seam }
}

/// The place on an edge at `p`; it snaps to the edge's ends, middle and notches.
fn place(table: &Table<'_>, p: DVec2, input: &Input) -> Option<OnEdge> {
    table.edge_at(p).map(|on| drawn_on(table, on, input))
}

/// The nearest place on the closed line that contains `from`.
fn place_on_line(table: &Table<'_>, p: DVec2, from: OnEdge, input: &Input) -> Option<OnEdge> {
    let (piece, shape) = table.piece(from.edge.piece)?;
    let (line, first) = piece.loop_of(from.edge.edge);
    let own = piece.pose.piece_from_plane(p);
    let places = (first..first + piece.loop_edges(line).len()).map(|edge| {
        let (distance, at, place) = super::super::table::on_line(own, &shape.edges[edge]);
        OnEdge {
            edge: EdgeRef { edge, ..from.edge },
            at,
            place: piece.pose.plane_from_piece(place),
            distance,
        }
    });
    let nearest = places.min_by(|a, b| a.distance.total_cmp(&b.distance))?;
    Some(drawn_on(table, nearest, input))
}

fn drawn_on(table: &Table<'_>, mut on: OnEdge, input: &Input) -> OnEdge {
    let Some((piece, shape)) = table.piece(on.edge.piece) else { return on };
    if table.laid.snapping && !input.held.alt && !input.held.command {
        let length = shape.lengths[on.edge.edge];
        let notches = piece.notches.iter().filter(|n| n.edge == on.edge.edge).map(|n| n.at);
        let near = [0.0, 0.5, 1.0].into_iter().chain(notches);
        let near = near.filter(|f| (f - on.at).abs() * length <= table.reach(REACH));
        on.at = near.min_by(|a, b| (a - on.at).abs().total_cmp(&(b - on.at).abs())).unwrap_or(on.at);
    }
    on.place = piece.pose.plane_from_piece(piece.edge_points(on.edge.edge, &[on.at])[0]);
    on
}

/// The shorter of the two stretches between two places on a closed line, in the line's direction.
fn between(table: &Table<'_>, from: OnEdge, to: OnEdge) -> Option<Stretch> {
    let (piece, shape) = table.piece(from.edge.piece)?;
    let one = stretch(piece, from, to)?;
    let other = stretch(piece, to, from)?;
    let length = |s: &Stretch| s.length(piece).unwrap_or(f64::INFINITY);
    let shorter = if length(&one) <= length(&other) { one } else { other };
    (length(&shorter) > 1e-3 && !shape.edges.is_empty()).then_some(shorter)
}

/// The stretch from one place to another in the line's direction.
fn stretch(piece: &Piece, from: OnEdge, to: OnEdge) -> Option<Stretch> {
    let (line, first) = piece.loop_of(from.edge.edge);
    let count = piece.loop_edges(line).len();
    let (mut edge, mut start) = (from.edge.edge - first, from.at);
    if start >= 1.0 - 1e-9 {
        (edge, start) = ((edge + 1) % count, 0.0);
    }
    let (mut last, mut end) = (to.edge.edge - first, to.at);
    if end <= 1e-9 {
        (last, end) = ((last + count - 1) % count, 1.0);
    }
    let mut further = (last + count - edge) % count;
    if further == 0 && end <= start {
        further = count;
    }
    Some(Stretch { piece: from.edge.piece, edge: edge + first, from: start, further, to: end })
}

/// A stretch with its length and the direction in which it is sewn.
#[derive(Clone, Copy, Debug)]
struct Run {
    stretch: Stretch,
    length: f64,
    /// Whether it is sewn in the line's own direction.
    forward: bool,
}

/// The untwisted seams that join two sides: one to one if both have equally many stretches. Otherwise each side is cut where the
/// other has an end, in proportion to the lengths.
pub fn seams(pattern: &Pattern, sides: &[Vec<Stretch>; 2]) -> Vec<Seam> {
    let Some(reference) = sides[0].first() else { return Vec::new() };
    // A stretch of the first side is sewn in its line's direction, one of the second side against it; on pieces drawn from their
    // back it is the other way round.
    let faces = |stretch: &Stretch| !untwisted(pattern, &[*reference, *stretch]);
    let [a, b] = [0, 1].map(|k| runs(pattern, &sides[k], |stretch| faces(stretch) == (k == 0)));
    let (Some(a), Some(b)) = (a, b) else { return Vec::new() };
    if a.is_empty() || b.is_empty() || a.iter().any(|x| b.iter().any(|y| x.stretch == y.stretch)) {
        return Vec::new();
    }
    let seam = |x: &Run, x_part: [f64; 2], y: &Run, y_part: [f64; 2]| {
        let sides = [part(pattern, x, x_part)?, part(pattern, y, y_part)?];
        Some(Seam { sides, same_direction: x.forward == y.forward, ratio: None, zip: None })
    };
    const WHOLE: [f64; 2] = [0.0, 1.0];
    if a.len() == b.len() {
        return a.iter().zip(&b).filter_map(|(x, y)| seam(x, WHOLE, y, WHOLE)).collect();
    }
    let (ends_a, ends_b) = (ends(&a), ends(&b));
    let mut cuts: Vec<f64> = ends_a.iter().chain(&ends_b).copied().collect();
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|x, y| (*x - *y).abs() < 1e-6);
    let piece_of = |ends: &[f64], from: f64, to: f64| {
        let i = ends.iter().rposition(|&e| e <= from + 1e-9)?.min(ends.len() - 2);
        let (start, length) = (ends[i], ends[i + 1] - ends[i]);
        let share = |x: f64| ((x - start) / length).clamp(0.0, 1.0);
        Some((i, [share(from), share(to)]))
    };
    let join = |w: &[f64]| {
        let (i, part_a) = piece_of(&ends_a, w[0], w[1])?;
        let (j, part_b) = piece_of(&ends_b, w[0], w[1])?;
        seam(&a[i], part_a, &b[j], part_b)
    };
    cuts.windows(2).filter_map(join).collect()
}

/// Fractions of a side's length at which its runs begin and end.
fn ends(runs: &[Run]) -> Vec<f64> {
    let total: f64 = runs.iter().map(|run| run.length).sum();
    let mut ends = vec![0.0];
    for run in runs {
        ends.push(ends[ends.len() - 1] + run.length / total);
    }
    ends
}

/// The stretches of a side in sewing order, each with the direction that `forward` gives. Stretches of one line are ordered along
/// it; others keep the order in which they were chosen.
fn runs(pattern: &Pattern, side: &[Stretch], forward: impl Fn(&Stretch) -> bool) -> Option<Vec<Run>> {
    let run = |&stretch: &Stretch| {
        let piece = pattern.pieces.get(&stretch.piece)?;
        let length = stretch.length(piece)?;
        Some(Run { stretch, length, forward: forward(&stretch) })
    };
    let mut runs: Vec<Run> = side.iter().map(run).collect::<Option<_>>()?;
    let Some(first) = runs.first().copied() else { return Some(runs) };
    let piece = pattern.pieces.get(&first.stretch.piece)?;
    let line_of = |s: &Stretch| piece.loop_of(s.edge);
    let same_line = |run: &Run| {
        run.stretch.piece == first.stretch.piece && line_of(&run.stretch) == line_of(&first.stretch)
    };
    if runs.len() > 1 && runs.iter().all(same_line) {
        runs.sort_by(|x, y| {
            (x.stretch.edge, x.stretch.from)
                .partial_cmp(&(y.stretch.edge, y.stretch.from))
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        let (line, start) = line_of(&first.stretch);
        let count = piece.loop_edges(line).len();
        let follows = |x: &Run, y: &Run| {
            let end = (x.stretch.edge - start + x.stretch.further + usize::from(x.stretch.to >= 1.0)) % count;
            end == y.stretch.edge - start
        };
        // If consecutive stretches run across the line's first edge, the side begins at the gap instead.
        let n = runs.len();
        let gap = (0..n).find(|&i| !follows(&runs[(i + n - 1) % n], &runs[i]));
        runs.rotate_left(gap.unwrap_or(0));
        if !first.forward {
            runs.reverse();
        }
    }
    Some(runs)
}

/// The part of a run between two fractions of its length.
fn part(pattern: &Pattern, run: &Run, [from, to]: [f64; 2]) -> Option<Stretch> {
    if from <= 1e-9 && to >= 1.0 - 1e-9 {
        return Some(run.stretch);
    }
    let [from, to] = if run.forward { [from, to] } else { [1.0 - to, 1.0 - from] };
    let piece = pattern.pieces.get(&run.stretch.piece)?;
    let place = |share: f64| {
        let mut left = share * run.length;
        let parts = run.stretch.parts(piece)?;
        let last = parts.len() - 1;
        for (i, &(edge, a, b)) in parts.iter().enumerate() {
            let length = (b - a) * piece.exact_edge_length(edge);
            if left <= length + 1e-9 || i == last {
                let at = (a + (b - a) * (left / length).clamp(0.0, 1.0)).clamp(0.0, 1.0);
                let edge = EdgeRef { piece: run.stretch.piece, edge };
                return Some(OnEdge { edge, at, place: DVec2::ZERO, distance: 0.0 });
            }
            left -= length;
        }
        None
    };
    stretch(piece, place(from)?, place(to)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::ids::PieceId;

    /// Two squares, 1 m and 2 m wide.
    fn squares() -> (Pattern, [PieceId; 2]) {
        let mut pattern = Pattern::default();
        let square = |s: f64| [[0.0, 0.0], [s, 0.0], [s, s], [0.0, s]].map(DVec2::from);
        let ids = [1.0, 2.0].map(|s| pattern.add_piece(Piece::polygon("p", &square(s))));
        (pattern, ids)
    }

    #[test]
    fn a_new_seam_is_not_twisted() {
        let (mut pattern, [a, b]) = squares();
        let found = seams(&pattern, &[vec![Stretch::edge(a, 0)], vec![Stretch::edge(b, 1)]]);
        assert_eq!(found.len(), 1);
        assert!(!found[0].same_direction);
        assert!(seams(&pattern, &[vec![Stretch::edge(a, 0)], vec![Stretch::edge(a, 0)]]).is_empty());
        // Now the second is drawn from its back, as its first seam says.
        pattern.add_seam(Seam { same_direction: true, ..found[0] });
        let found = seams(&pattern, &[vec![Stretch::edge(a, 2)], vec![Stretch::edge(b, 3)]]);
        assert!(found[0].same_direction);
    }

    #[test]
    fn several_edges_share_one_by_their_lengths() {
        let (pattern, [a, b]) = squares();
        // In any order: edges 3 and 0 run on, so the side begins with 3.
        let first = vec![Stretch::edge(a, 0), Stretch::edge(a, 3)];
        let found = seams(&pattern, &[first, vec![Stretch::edge(b, 0)]]);
        assert_eq!(found.iter().map(|s| s.sides[0].edge).collect::<Vec<_>>(), [3, 0]);
        // The second is sewn along from its end.
        let halves: Vec<(f64, f64)> = found.iter().map(|s| (s.sides[1].from, s.sides[1].to)).collect();
        assert_eq!(halves, [(0.5, 1.0), (0.0, 0.5)]);
        assert!(found.iter().all(|s| !s.same_direction));
    }

    #[test]
    fn stretches_run_over_corners_and_the_shorter_way() {
        let (pattern, [a, _]) = squares();
        let piece = &pattern.pieces[&a];
        let on = |edge: usize, at: f64| OnEdge {
            edge: EdgeRef { piece: a, edge },
            at,
            place: DVec2::ZERO,
            distance: 0.0,
        };
        let over = stretch(piece, on(3, 0.5), on(0, 0.5)).expect("a stretch");
        assert_eq!((over.edge, over.further), (3, 1));
        assert!((over.length(piece).expect("a length") - 1.0).abs() < 1e-9);
        let whole = stretch(piece, on(1, 0.0), on(1, 1.0)).expect("a stretch");
        assert_eq!(whole, Stretch::edge(a, 1));
        let on_corner = stretch(piece, on(0, 1.0), on(2, 0.0)).expect("a stretch");
        assert_eq!(on_corner, Stretch::edge(a, 1));
    }
}
