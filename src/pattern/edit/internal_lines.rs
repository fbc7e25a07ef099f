//! Edits of the points of internal lines.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, words};
use crate::pattern::edit::pieces::change;
use crate::pattern::edit::{Change, LinePoint, PointRef, SHORTEST_EDGE, find, lines, points};
use crate::pattern::{Edge, EdgeRef, InternalLine, Pattern, Piece};

pub(super) fn move_points(pattern: &mut Pattern, moves: &[(LinePoint, DVec2)]) -> Result<Change, Words> {
    if moves.is_empty() {
        return Err(words!("no point was named"));
    }
    let mut of_line: BTreeMap<(PieceId, usize), BTreeMap<usize, DVec2>> = BTreeMap::new();
    for (at, to) in moves {
        line_of(pattern, *at)?;
        of_line.entry((at.piece, at.line)).or_default().insert(at.point, *to);
    }
    for ((id, line), moved) in of_line {
        let piece = find(pattern, id)?;
        let (old, new) = (&piece.lines[line], put(&piece.lines[line], &moved));
        // Lines of files may have points that fall together already.
        if chords(&new).zip(chords(old)).any(|(new, old)| !(new >= SHORTEST_EDGE || old < SHORTEST_EDGE)) {
            return Err(words!(
                "two points of line {n} of {name} would fall together",
                n = line + 1,
                name = piece.name
            ));
        }
        change(pattern, id, |piece| piece.lines[line] = new);
    }
    Ok(Change::new(match moves.len() {
        1 => words!("move a point"),
        n => words!("move {n} points", n),
    }))
}

pub(super) fn insert(pattern: &mut Pattern, edge: LinePoint, at: f64) -> Result<Change, Words> {
    let line = line_of(pattern, edge)?;
    if edge.point == line.edges.len() {
        return Err(words!("no edge starts at the end of a line"));
    }
    if !(at > 0.0 && at < 1.0) {
        return Err(words!("a point on an edge lies between its ends"));
    }
    let mut closed = Closed::new(line);
    let on = EdgeRef { piece: closed.id, edge: edge.point };
    lines::insert_points(&mut closed.pattern, on, &[at]);
    let new = closed.opened(line);
    change(pattern, edge.piece, |piece| piece.lines[edge.line] = new);
    Ok(Change::new(words!("add a point")))
}

pub(super) fn delete(pattern: &mut Pattern, at: LinePoint) -> Result<Change, Words> {
    let line = line_of(pattern, at)?;
    let last = line.edges.len();
    if last < 2 {
        return Err(words!("a line needs two points at least: take the line away"));
    }
    let mut new = line.clone();
    if at.point == 0 {
        new.edges.remove(0);
    } else if at.point < last {
        let mut closed = Closed::new(line);
        points::join(&mut closed.pattern, EdgeRef { piece: closed.id, edge: at.point });
        new = closed.opened(line);
    } else if let Some(edge) = new.edges.pop() {
        (new.end, new.end_rule) = (edge.start, edge.rule);
    }
    change(pattern, at.piece, |piece| piece.lines[at.line] = new);
    Ok(Change::new(words!("take a point away")))
}

pub(super) fn set_smooth(pattern: &mut Pattern, at: LinePoint, smooth: bool) -> Result<Change, Words> {
    let line = line_of(pattern, at)?;
    if at.point == 0 || at.point == line.edges.len() {
        return Err(words!("at its ends a line is neither smooth nor has it a corner"));
    }
    let mut closed = Closed::new(line);
    let point = PointRef { piece: closed.id, point: at.point };
    let done = points::set_smooth(&mut closed.pattern, point, smooth)?;
    let new = closed.opened(line);
    change(pattern, at.piece, |piece| piece.lines[at.line] = new);
    Ok(done)
}

/// The line that a point is on. Err where there is no such line or point.
fn line_of(pattern: &Pattern, at: LinePoint) -> Result<&InternalLine, Words> {
    let piece = find(pattern, at.piece)?;
    let number = at.line.saturating_add(1);
    let line = piece
        .lines
        .get(at.line)
        .ok_or_else(|| words!("{name} has no line {n}", name = piece.name, n = number))?;
    if line.point(at.point).is_none() {
        let point = at.point.saturating_add(1);
        return Err(words!("line {n} of {name} has no point {point}", n = number, name = piece.name, point));
    }
    Ok(line)
}

/// Distances between the ends of the edges of a line, metres.
fn chords(line: &InternalLine) -> impl Iterator<Item = f64> {
    line.points().zip(line.points().skip(1)).map(|(a, b)| a.distance(b))
}

/// The line with the points `moved` at their new places. Curves rotate and scale with their chords, and smooth points beside
/// the moved ones stay smooth.
fn put(line: &InternalLine, moved: &BTreeMap<usize, DVec2>) -> InternalLine {
    let mut closed = Closed::new(line);
    let places: Vec<DVec2> =
        line.points().enumerate().map(|(i, p)| moved.get(&i).copied().unwrap_or(p)).collect();
    change(&mut closed.pattern, closed.id, |piece| {
        points::put_all(piece, &places);
        for &i in moved.keys() {
            points::smooth_around(piece, i);
        }
    });
    closed.opened(line)
}

/// An internal line as the outline of a piece, with an edge from its end back to its start and corners there: so it is changed
/// like any closed line.
struct Closed {
    pattern: Pattern,
    id: PieceId,
}

impl Closed {
    fn new(line: &InternalLine) -> Self {
        let closing = Edge { start: line.end, rule: line.end_rule.clone(), ..Edge::default() };
        let outline = line.edges.iter().cloned().chain([closing]).collect();
        let mut piece = Piece { outline, ..Piece::default() };
        piece.outline[0].smooth = false;
        let mut pattern = Pattern::default();
        let id = pattern.add_piece(piece);
        Self { pattern, id }
    }

    /// It as an internal line again; `before` is what it was made of.
    fn opened(self, before: &InternalLine) -> InternalLine {
        let mut new = before.clone();
        if let Some(piece) = self.pattern.pieces.get(&self.id)
            && let Some((closing, edges)) = piece.outline.split_last()
        {
            (new.end, new.edges) = (closing.start, edges.to_vec());
        }
        if let (Some(first), Some(was)) = (new.edges.first_mut(), before.edges.first()) {
            first.smooth = was.smooth;
        }
        new
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::edit::{PatternEdit, apply};
    use crate::pattern::{EdgeShape, GradeRule};

    const A: PieceId = PieceId(1);

    fn v(x: f64, y: f64) -> DVec2 {
        DVec2::new(x, y)
    }

    /// A square with a line of two edges inside.
    fn square(second: EdgeShape, smooth: bool) -> Pattern {
        let corners = [v(0.0, 0.0), v(0.4, 0.0), v(0.4, 0.4), v(0.0, 0.4)];
        let mut piece = Piece::polygon("front", &corners);
        let edges = vec![
            Edge { start: v(0.1, 0.1), ..Edge::default() },
            Edge { start: v(0.2, 0.1), shape: second, smooth, ..Edge::default() },
        ];
        piece.lines.push(InternalLine { edges, end: v(0.3, 0.2), ..InternalLine::default() });
        let mut pattern = Pattern::default();
        pattern.add_piece(piece);
        pattern
    }

    fn moved(pattern: &Pattern, moves: &[(usize, DVec2)]) -> Result<Pattern, Words> {
        let at = |point| LinePoint { piece: A, line: 0, point };
        let points = moves.iter().map(|&(point, to)| (at(point), to)).collect();
        apply(pattern, &PatternEdit::MoveLinePoints { points }).map(|edited| edited.pattern)
    }

    #[test]
    fn points_move_alone_and_the_outline_stays() {
        let before = square(EdgeShape::Line, false);
        let after = moved(&before, &[(0, v(0.05, 0.1)), (2, v(0.3, 0.3))]).expect("moved");
        let line = &after.pieces[&A].lines[0];
        assert_eq!(line.points().collect::<Vec<_>>(), [v(0.05, 0.1), v(0.2, 0.1), v(0.3, 0.3)]);
        assert_eq!(after.pieces[&A].outline, before.pieces[&A].outline);
        assert_eq!(moved(&after, &[(0, v(0.1, 0.1)), (2, v(0.3, 0.2))]).expect("back"), before);
    }

    #[test]
    fn curves_follow_their_chords_and_smooth_points_stay_smooth() {
        let bend = EdgeShape::Cubic { controls: [v(0.24, 0.1), v(0.3, 0.14)] };
        let after = moved(&square(bend, false), &[(1, v(0.2, 0.1)), (2, v(0.4, 0.3))]).expect("moved");
        let EdgeShape::Cubic { controls: [first, _] } = after.pieces[&A].lines[0].edges[1].shape else {
            panic!("a curve")
        };
        assert!(first.distance(v(0.28, 0.1)) < 1e-12, "twice as long: {first}");
        let after = moved(&square(bend, true), &[(0, v(0.1, 0.2))]).expect("moved");
        let EdgeShape::Cubic { controls: [first, _] } = after.pieces[&A].lines[0].edges[1].shape else {
            panic!("a curve")
        };
        let [arriving, leaving] = [v(0.2, 0.1) - v(0.1, 0.2), first - v(0.2, 0.1)];
        assert!(arriving.angle_to(leaving).abs() < 1e-9, "{first}");
    }

    #[test]
    fn what_is_not_there_or_falls_together_is_refused() {
        let pattern = square(EdgeShape::Line, false);
        let words = |moves: &[(usize, DVec2)]| moved(&pattern, moves).expect_err("refused");
        assert!(words(&[]).contains("no point was named"));
        assert!(words(&[(3, v(0.0, 0.0))]).contains("line 1 of front has no point 4"));
        assert!(words(&[(1, v(0.1, 0.1))]).contains("two points of line 1 of front"));
        let at = LinePoint { piece: A, line: 2, point: 0 };
        let edit = PatternEdit::MoveLinePoints { points: vec![(at, DVec2::ZERO)] };
        assert!(apply(&pattern, &edit).expect_err("no line").contains("front has no line 3"));
    }

    #[test]
    fn a_point_is_put_on_a_line_and_taken_away_again() {
        let mut pattern = square(EdgeShape::Quadratic { control: v(0.3, 0.1) }, true);
        let line = &mut std::sync::Arc::make_mut(pattern.pieces.get_mut(&A).expect("the piece")).lines[0];
        line.end_rule = Some(GradeRule(vec![v(0.0, 0.0), v(0.02, 0.0)]));
        let at = |point| LinePoint { piece: A, line: 0, point };
        let done = |pattern: &Pattern, edit: PatternEdit| apply(pattern, &edit).map(|edited| edited.pattern);
        let more = done(&pattern, PatternEdit::InsertLinePoint { edge: at(1), at: 0.5 }).expect("a point");
        let line = &more.pieces[&A].lines[0];
        assert_eq!((line.edges.len(), line.end), (3, v(0.3, 0.2)));
        assert_eq!(line.rule(2), Some(&GradeRule(vec![v(0.0, 0.0), v(0.01, 0.0)])), "half of the end's");
        let length = |line: &InternalLine| {
            line.flattened(1e-6).windows(2).map(|side| side[0].distance(side[1])).sum::<f64>()
        };
        assert!((length(line) - length(&pattern.pieces[&A].lines[0])).abs() < 1e-6, "it keeps its shape");
        let less = done(&more, PatternEdit::DeleteLinePoint { point: at(2) }).expect("one point less");
        assert!((length(&less.pieces[&A].lines[0]) - length(line)).abs() < 1e-6);
        for (point, ends) in [(0, [v(0.2, 0.1), v(0.3, 0.2)]), (2, [v(0.1, 0.1), v(0.2, 0.1)])] {
            let less = done(&pattern, PatternEdit::DeleteLinePoint { point: at(point) }).expect("an end");
            assert_eq!(less.pieces[&A].lines[0].points().collect::<Vec<_>>(), ends);
            let none = done(&less, PatternEdit::DeleteLinePoint { point: at(0) });
            assert!(none.expect_err("refused").contains("two points at least"));
        }
        let words =
            |edge, at| done(&pattern, PatternEdit::InsertLinePoint { edge, at }).expect_err("refused");
        assert!(words(at(2), 0.5).contains("no edge starts at the end"));
        assert!(words(at(0), 1.0).contains("between its ends"));
    }

    #[test]
    fn a_point_is_made_smooth_and_a_corner_again() {
        let before = square(EdgeShape::Line, false);
        let set = |pattern: &Pattern, point, smooth| {
            let point = LinePoint { piece: A, line: 0, point };
            apply(pattern, &PatternEdit::SetLineSmooth { point, smooth })
        };
        let smooth = set(&before, 1, true).expect("smooth");
        assert_eq!(smooth.label, "make a point smooth");
        let line = |pattern: &Pattern| pattern.pieces[&A].lines[0].clone();
        let kink = |pattern: &Pattern| {
            let line = line(pattern);
            let [EdgeShape::Cubic { controls: [_, c] }, EdgeShape::Cubic { controls: [d, _] }] =
                [0, 1].map(|i| line.edges[i].shape)
            else {
                panic!("curves")
            };
            let at = line.edges[1].start;
            // Not `angle_to`, whose arc cosine loses half the digits of small angles.
            let [arriving, leaving] = [at - c, d - at];
            arriving.perp_dot(leaving).atan2(arriving.dot(leaving)).abs()
        };
        assert!(line(&smooth.pattern).edges[1].smooth && kink(&smooth.pattern) < 1e-9);
        assert!(line(&smooth.pattern).points().eq(line(&before).points()), "its points stay");
        assert_eq!(smooth.pattern.pieces[&A].outline, before.pieces[&A].outline);
        let after = moved(&smooth.pattern, &[(1, v(0.2, 0.15))]).expect("moved");
        assert!(kink(&after) < 1e-9, "it stays smooth");
        let corner = set(&smooth.pattern, 1, false).expect("a corner");
        assert_eq!(corner.label, "make a corner");
        assert!(!line(&corner.pattern).edges[1].smooth);
        for (point, words) in [(0, "at its ends"), (2, "at its ends"), (3, "has no point 4")] {
            assert!(set(&before, point, true).expect_err("refused").contains(words));
        }
        let twins = apply(&before, &PatternEdit::AddTwin { piece: A, offset: v(1.0, 0.0) });
        let smooth = set(&twins.expect("a twin").pattern, 1, true).expect("smooth").pattern;
        let [own, image] = [A, PieceId(2)].map(|id| smooth.pieces[&id].lines[0].edges[1].clone());
        assert!(own.smooth && image.smooth);
        let EdgeShape::Cubic { controls: [first, _] } = own.shape else { panic!("a curve") };
        let mirrored = v(-first.x, first.y);
        assert!(matches!(image.shape, EdgeShape::Cubic { controls: [c, _] } if c == mirrored));
    }

    #[test]
    fn the_twin_follows() {
        let pattern = square(EdgeShape::Line, false);
        let twins = apply(&pattern, &PatternEdit::AddTwin { piece: A, offset: v(1.0, 0.0) });
        let after = moved(&twins.expect("a twin").pattern, &[(2, v(0.3, 0.3))]).expect("moved");
        assert_eq!(after.pieces[&PieceId(2)].lines[0].end, v(-0.3, 0.3));
    }
}
