//! Edits of the points of internal lines.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::geometry::ids::PieceId;
use crate::pattern::edit::pieces::change;
use crate::pattern::edit::{Change, LinePoint, SHORTEST_EDGE, find, points};
use crate::pattern::{Edge, InternalLine, Pattern, Piece};

pub(super) fn move_points(pattern: &mut Pattern, moves: &[(LinePoint, DVec2)]) -> Result<Change, String> {
    if moves.is_empty() {
        return Err("no point was named".to_owned());
    }
    let mut of_line: BTreeMap<(PieceId, usize), BTreeMap<usize, DVec2>> = BTreeMap::new();
    for (at, to) in moves {
        let piece = find(pattern, at.piece)?;
        let number = at.line.saturating_add(1);
        let line = piece.lines.get(at.line).ok_or_else(|| format!("{} has no line {number}", piece.name))?;
        if line.point(at.point).is_none() {
            let point = at.point.saturating_add(1);
            return Err(format!("line {number} of {} has no point {point}", piece.name));
        }
        of_line.entry((at.piece, at.line)).or_default().insert(at.point, *to);
    }
    for ((id, line), moved) in of_line {
        let piece = find(pattern, id)?;
        let (old, new) = (&piece.lines[line], put(&piece.lines[line], &moved));
        // Lines of files may have points that fall together already.
        if chords(&new).zip(chords(old)).any(|(new, old)| !(new >= SHORTEST_EDGE || old < SHORTEST_EDGE)) {
            return Err(format!("two points of line {} of {} would fall together", line + 1, piece.name));
        }
        change(pattern, id, |piece| piece.lines[line] = new);
    }
    Ok(Change::new(match moves.len() {
        1 => "move a point".to_owned(),
        n => format!("move {n} points"),
    }))
}

/// Distances between the ends of the edges of a line, metres.
fn chords(line: &InternalLine) -> impl Iterator<Item = f64> {
    line.points().zip(line.points().skip(1)).map(|(a, b)| a.distance(b))
}

/// The line with the points `moved` at their new places. Curves rotate and scale with their chords, and smooth points beside
/// the moved ones stay smooth.
fn put(line: &InternalLine, moved: &BTreeMap<usize, DVec2>) -> InternalLine {
    // As a closed line with an edge from the end back to the start, and corners there, it moves like any other.
    let closing = Edge { start: line.end, ..Edge::default() };
    let outline = line.edges.iter().cloned().chain([closing]).collect();
    let mut closed = Piece { outline, ..Piece::default() };
    closed.outline[0].smooth = false;
    let places: Vec<DVec2> =
        line.points().enumerate().map(|(i, p)| moved.get(&i).copied().unwrap_or(p)).collect();
    points::put_all(&mut closed, &places);
    for &i in moved.keys() {
        points::smooth_around(&mut closed, i);
    }
    let mut new = line.clone();
    for (edge, put) in new.edges.iter_mut().zip(&closed.outline) {
        (edge.start, edge.shape) = (put.start, put.shape);
    }
    new.end = places.last().copied().unwrap_or(line.end);
    new
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::EdgeShape;
    use crate::pattern::edit::{PatternEdit, apply};

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

    fn moved(pattern: &Pattern, moves: &[(usize, DVec2)]) -> Result<Pattern, String> {
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
    fn the_twin_follows() {
        let pattern = square(EdgeShape::Line, false);
        let twins = apply(&pattern, &PatternEdit::AddTwin { piece: A, offset: v(1.0, 0.0) });
        let after = moved(&twins.expect("a twin").pattern, &[(2, v(0.3, 0.3))]).expect("moved");
        assert_eq!(after.pieces[&PieceId(2)].lines[0].end, v(-0.3, 0.3));
    }
}
