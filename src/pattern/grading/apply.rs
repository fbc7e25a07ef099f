//! A pattern in another size of its run.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec2;

use crate::geometry::ids::PieceId;
use crate::geometry::polygon::{first_crossing, sides, signed_area};
use crate::geometry::words::{Words, words};
use crate::pattern::edit::grading::{put, rules_of, tangents_at};
use crate::pattern::grading::field::Field;
use crate::pattern::grading::rule::GradeRule;
use crate::pattern::{Edge, InternalLine, Pattern, Piece, Problem, ProblemKind, curve};

/// Largest angle by which a line may turn at a point without rule that follows its neighbours, radians: 10 degrees. At a
/// sharper one it stays.
const CORNER: f64 = std::f64::consts::PI / 18.0;
/// Length below which an edge has vanished, metres.
const SHORTEST: f64 = 1e-3;
/// Largest distance of chords from the outline when it is looked at for crossings, metres.
const TOLERANCE: f64 = 5e-4;

/// A pattern in another size.
#[derive(Clone, Debug)]
pub struct Graded {
    /// The pattern: same ids, same seams; pieces without rules are the very same.
    pub pattern: Pattern,
    /// How places inside the pieces moved; pieces that are not named did not.
    pub moved: BTreeMap<PieceId, Field>,
    /// Outlines that cross themselves and edges that vanish in this size, in words with piece, point and size.
    pub problems: Vec<Problem>,
}

/// `pattern` in the size called `size`. In the base size it is the pattern itself, to the bit.
///
/// The result has the same run, drawn in that size: its rules are relative to it.
///
/// A point with a rule moves by it. A point of the outline without one stays at a corner; where the line runs on it moves
/// between its neighbours, by the share of arc length. Points of holes and internal lines without a rule move with the cloth
/// round them. Curves turn and scale with their chords, and smooth points stay smooth, as where points are moved by hand.
/// Grainlines keep their direction.
///
/// # Errors
/// The pattern has no such size, in words.
pub fn graded(pattern: &Pattern, size: &str) -> Result<Graded, Words> {
    let number = pattern.sizes.number(size)?;
    let mut new = pattern.clone();
    let mut moved = BTreeMap::new();
    for (&id, piece) in &pattern.pieces {
        let by = displacements(piece, number);
        let is_still = by.iter().flatten().all(|by| *by == DVec2::ZERO);
        if (is_still && piece.lines.iter().all(|line| is_still_line(line, number)))
            || number == pattern.sizes.base
        {
            continue;
        }
        let (own, field) = graded_piece(piece, &by, number);
        new.pieces.insert(id, Arc::new(own));
        moved.insert(id, field);
    }
    new.sizes.base = number;
    let problems = moved.keys().flat_map(|id| problems(&pattern.pieces[id], &new.pieces[id], size)).collect();
    Ok(Graded { pattern: new, moved, problems })
}

fn is_still_line(line: &InternalLine, size: usize) -> bool {
    let rules = line.edges.iter().map(|edge| &edge.rule).chain([&line.end_rule]);
    rules.flatten().all(|rule| rule.at(size) == DVec2::ZERO)
}

/// The displacement of each point of the closed lines of `piece` in size number `size`: of the outline by rule or from
/// its neighbours; of holes by rule, None where they move with the cloth.
fn displacements(piece: &Piece, size: usize) -> Vec<Option<DVec2>> {
    let count = piece.outline.len();
    let given: Vec<Option<DVec2>> = (0..count)
        .map(|i| match &piece.outline[i].rule {
            Some(rule) => Some(rule.at(size)),
            None if piece.outline[i].smooth || runs_on(piece, i) => None,
            None => Some(DVec2::ZERO),
        })
        .collect();
    let of_outline = between_given(piece, &given).into_iter().map(Some);
    let of_holes = piece.holes.iter().flatten().map(|edge| edge.rule.as_ref().map(|rule| rule.at(size)));
    of_outline.chain(of_holes).collect()
}

/// Fills what is not given by the share of arc length between the neighbours that are.
fn between_given(piece: &Piece, given: &[Option<DVec2>]) -> Vec<DVec2> {
    let n = given.len();
    let Some(first) = given.iter().position(Option::is_some) else { return vec![DVec2::ZERO; n] };
    let mut all = vec![DVec2::ZERO; n];
    let mut from = first;
    loop {
        let further = (1..=n).find(|k| given[(from + k) % n].is_some()).unwrap_or(n);
        let (start, end) = (given[from].unwrap_or_default(), given[(from + further) % n].unwrap_or_default());
        let lengths: Vec<f64> = (0..further).map(|k| piece.edge_length((from + k) % n)).collect();
        let total: f64 = lengths.iter().sum();
        let mut before = 0.0;
        for (k, length) in lengths.iter().enumerate() {
            let share = if total > 0.0 { before / total } else { 0.0 };
            // A lerp of equal ends may miss them in the last place.
            all[(from + k) % n] = if k == 0 || start == end { start } else { start.lerp(end, share) };
            before += length;
        }
        from = (from + further) % n;
        if from == first {
            return all;
        }
    }
}

/// Whether the outline runs on at point `i`: it does not turn there by more than [`CORNER`].
fn runs_on(piece: &Piece, i: usize) -> bool {
    let [arriving, leaving] = tangents_at(piece, i);
    arriving.angle_to(leaving).abs() <= CORNER
}

fn graded_piece(piece: &Piece, by: &[Option<DVec2>], size: usize) -> (Piece, Field) {
    // The holes follow once the outline tells how.
    let with_holes_at = |hole: &dyn Fn(DVec2) -> DVec2| -> Vec<DVec2> {
        let starts = (0..piece.edge_count()).map(|i| piece.edge(i).start);
        starts.zip(by).map(|(p, by)| by.map_or_else(|| hole(p), |by| p + by)).collect()
    };
    let mut new = put(piece, &with_holes_at(&|p| p));
    let field = Field::between(piece, &new);
    if !piece.holes.is_empty() {
        new = put(piece, &with_holes_at(&|p| field.moved(p)));
    }
    new.lines = piece.lines.iter().map(|line| graded_line(line, &field, size)).collect();
    rules_of(&mut new).for_each(|rule| *rule = rule.from_size(size));
    new.grainline = piece.grainline.map(|[tail, head]| {
        let by = field.at((tail + head) / 2.0);
        [tail + by, head + by]
    });
    new.cut_line = graded_closed(&piece.cut_line, &field);
    (new, field)
}

fn graded_line(line: &InternalLine, field: &Field, size: usize) -> InternalLine {
    let mut new = line.clone();
    let to = |p: DVec2, rule: &Option<GradeRule>| match rule {
        Some(rule) => p + rule.at(size),
        None => field.moved(p),
    };
    new.end = to(line.end, &line.end_rule);
    let starts: Vec<DVec2> = line.edges.iter().map(|edge| to(edge.start, &edge.rule)).collect();
    for (i, edge) in new.edges.iter_mut().enumerate() {
        let old = [edge.start, line.edge_end(i)];
        let ends = [starts[i], starts.get(i + 1).copied().unwrap_or(new.end)];
        (edge.start, edge.shape) = (ends[0], edge.shape.carried(old, ends));
    }
    new
}

fn graded_closed(edges: &[Edge], field: &Field) -> Vec<Edge> {
    let n = edges.len();
    let starts: Vec<DVec2> = edges.iter().map(|edge| field.moved(edge.start)).collect();
    let end = |i: usize| [edges[(i + 1) % n].start, starts[(i + 1) % n]];
    edges
        .iter()
        .enumerate()
        .map(|(i, edge)| {
            let [old, new] = end(i);
            let shape = edge.shape.carried([edge.start, old], [starts[i], new]);
            Edge { start: starts[i], shape, ..edge.clone() }
        })
        .collect()
}

/// What grading made of `piece` that cannot be cut, in words.
fn problems(piece: &Piece, graded: &Piece, size: &str) -> Vec<Problem> {
    let at =
        |point: usize| words!("{piece}, point {n}, size {size}", piece = piece.name, n = point + 1, size);
    let mut problems: Vec<Problem> = (0..graded.edge_count())
        .filter(|&i| graded.edge_length(i) < SHORTEST && piece.edge_length(i) >= SHORTEST)
        .map(|i| Problem {
            kind: ProblemKind::ZeroLength,
            place: at(i),
            words: words!(
                "the edge to point {n} vanishes: change the rules of its ends",
                n = piece.next_edge(i) + 1
            ),
        })
        .collect();
    if let Some((i, j)) = crossing(graded)
        && crossing(piece).is_none()
    {
        problems.push(Problem {
            kind: ProblemKind::SelfCrossing,
            place: at(i),
            words: words!(
                "the outline crosses itself: the edge from point {one} meets that from point {other}",
                one = i + 1,
                other = j + 1
            ),
        });
    }
    let area = |piece: &Piece| signed_area(&piece.flattened(TOLERANCE));
    if problems.is_empty() && area(piece) * area(graded) <= 0.0 {
        problems.push(Problem {
            kind: ProblemKind::SelfCrossing,
            place: at(0),
            words: words!("the piece is turned inside out: its rules move points past each other"),
        });
    }
    problems
}

/// Two edges of the outline that cross.
fn crossing(piece: &Piece) -> Option<(usize, usize)> {
    let (mut points, mut of) = (Vec::new(), Vec::new());
    for (i, edge) in piece.outline.iter().enumerate() {
        curve::flatten(edge.start, edge.shape, piece.edge_ends(i).1, TOLERANCE, &mut points);
        of.resize(points.len(), i);
    }
    let (lines, n) = (sides(&points).collect::<Vec<_>>(), points.len());
    let crossing = first_crossing(&lines, |i, j| (i + 1) % n == j || (j + 1) % n == i);
    crossing.map(|(i, j)| (of[i], of[j]))
}

#[cfg(test)]
#[path = "apply_tests.rs"]
mod tests;
