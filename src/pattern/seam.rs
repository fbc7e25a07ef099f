//! Seams: each joins two stretches of outlines.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::geometry::ids::PieceId;
use crate::pattern::{Piece, Zip};

/// Length within which an end of a part of a stretch is moved to a point of the line, metres.
const NEARLY: f64 = 2e-3;

/// An edge of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct EdgeRef {
    /// The piece.
    pub piece: PieceId,
    /// Number of the edge from 0, as [`Piece::edge`](crate::pattern::Piece::edge) counts.
    pub edge: usize,
}

/// A stretch: a run along one closed line of a piece, in the direction of the line, from a place on one edge to a
/// place on the same or a later edge. It may run past the point where the line starts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stretch {
    /// The piece.
    pub piece: PieceId,
    /// The edge on which the stretch starts.
    pub edge: usize,
    /// Where on the first edge the stretch starts, a fraction of that edge's arc length, 0..1.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub from: f64,
    /// Number of edges from the first to the last; the stretch runs at most once round the line.
    #[serde(default, skip_serializing_if = "is_none")]
    pub further: usize,
    /// Where on the last edge the stretch ends, a fraction of that edge's arc length, 0..=1.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub to: f64,
}

fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

fn is_one(x: &f64) -> bool {
    *x == 1.0
}

fn one() -> f64 {
    1.0
}

fn is_none(count: &usize) -> bool {
    *count == 0
}

impl Stretch {
    /// The whole of one edge.
    pub fn edge(piece: PieceId, edge: usize) -> Self {
        Self { piece, edge, from: 0.0, further: 0, to: 1.0 }
    }

    /// The edge on which the stretch starts.
    pub fn first_edge(&self) -> EdgeRef {
        EdgeRef { piece: self.piece, edge: self.edge }
    }

    /// The edges that the stretch covers, each with the fractions of its length at which the covered part starts and
    /// ends. None when the stretch is not on `piece` or has no length.
    pub fn parts(&self, piece: &Piece) -> Option<Vec<(usize, f64, f64)>> {
        let Self { edge, from, further, to, .. } = *self;
        let sound = (0.0..1.0).contains(&from) && (0.0..=1.0).contains(&to) && edge < piece.edge_count();
        if !sound {
            return None;
        }
        let around = piece.loop_edges(piece.loop_of(edge).0).len();
        if further > around || (further == 0 && from >= to) || (further == around && to > from) {
            return None;
        }
        let mut parts = Vec::new();
        let mut at = edge;
        for i in 0..=further {
            let range = (if i == 0 { from } else { 0.0 }, if i == further { to } else { 1.0 });
            if range.1 > range.0 {
                parts.push((at, range.0, range.1));
            }
            at = piece.next_edge(at);
        }
        Some(parts)
    }

    /// Arc length of the stretch in metres, to 1e-12. None when it is not on `piece`.
    pub fn length(&self, piece: &Piece) -> Option<f64> {
        let parts = self.parts(piece)?;
        Some(parts.into_iter().map(|(edge, from, to)| (to - from) * piece.exact_edge_length(edge)).sum())
    }

    /// Points at `fractions` (0..=1, ascending) of the stretch's arc length. None when it is not on `piece`.
    pub fn points(&self, piece: &Piece, fractions: &[f64]) -> Option<Vec<DVec2>> {
        let parts = self.parts(piece)?;
        let length = |&(edge, from, to): &(usize, f64, f64)| (to - from) * piece.edge_length(edge);
        let total: f64 = parts.iter().map(length).sum();
        let (mut points, mut before, mut left) = (Vec::with_capacity(fractions.len()), 0.0, fractions);
        for (i, part) in parts.iter().enumerate() {
            let (edge, from, to) = *part;
            let share = length(part) / total;
            let last = i + 1 == parts.len();
            let count = if last { left.len() } else { left.partition_point(|f| *f < before + share) };
            let own = |f: &f64| from + ((f - before) / share).clamp(0.0, 1.0) * (to - from);
            points.extend(piece.edge_points(edge, &left[..count].iter().map(own).collect::<Vec<f64>>()));
            (before, left) = (before + share, &left[count..]);
        }
        Some(points)
    }

    /// The part of the stretch between two shares `from` < `to` of its arc length, 0..=1. None when the stretch is not on `piece` or
    /// the part has no length. An end within [`NEARLY`] of a point of the line is moved there.
    pub fn part(&self, piece: &Piece, [from, to]: [f64; 2]) -> Option<Self> {
        let parts = self.parts(piece)?;
        let lengths: Vec<f64> = parts.iter().map(|&(edge, a, b)| (b - a) * piece.edge_length(edge)).collect();
        let total: f64 = lengths.iter().sum();
        let place = |share: f64, at_end: bool| {
            let mut left = share * total;
            for (i, (&(edge, a, b), &length)) in parts.iter().zip(&lengths).enumerate() {
                let is_last = i + 1 == parts.len();
                let within = if at_end { left <= length + NEARLY } else { left < length - NEARLY };
                if within || is_last {
                    let at = a + (left / length).clamp(0.0, 1.0) * (b - a);
                    let near = NEARLY / piece.edge_length(edge);
                    let at = [a, b].into_iter().find(|end| (end - at).abs() < near).unwrap_or(at);
                    return (i, edge, at);
                }
                left -= length;
            }
            (0, parts[0].0, parts[0].1)
        };
        let ((i, edge, from), (j, _, to)) = (place(from, false), place(to, true));
        let part = Self { piece: self.piece, edge, from, further: j.checked_sub(i)?, to };
        part.parts(piece).map(|_| part)
    }

    /// The edge, where the stretch is the whole of one edge.
    pub fn whole_edge(&self) -> Option<EdgeRef> {
        let whole = self.from == 0.0 && self.further == 0 && self.to == 1.0;
        whole.then_some(EdgeRef { piece: self.piece, edge: self.edge })
    }
}

impl From<EdgeRef> for Stretch {
    fn from(edge: EdgeRef) -> Self {
        Self::edge(edge.piece, edge.edge)
    }
}

/// A seam: two stretches sewn together along their whole length, points paired by fraction of arc length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seam {
    /// The two sides.
    pub sides: [Stretch; 2],
    /// Direction of pairing. False: the start of one side meets the end of the other (front joins front). True: start
    /// meets start.
    pub same_direction: bool,
    /// Length of the first side divided by that of the second, which editing keeps; other than 1 it is a gather.
    /// None: either side may change its length alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ratio: Option<f64>,
    /// The zip along the seam, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub zip: Option<Zip>,
}

impl Seam {
    /// The part of the seam that is sewn: of a zip what is closed. None where all of it is open; `piece` finds a piece.
    pub fn closed<'p>(&self, piece: impl Fn(PieceId) -> Option<&'p Piece>) -> Option<Self> {
        let Some(zip) = self.zip else { return Some(*self) };
        let [from, to] = zip.closed()?;
        if [from, to] == [0.0, 1.0] {
            return Some(*self);
        }
        let other = if self.same_direction { [from, to] } else { [1.0 - to, 1.0 - from] };
        let part = |k: usize, span: [f64; 2]| self.sides[k].part(piece(self.sides[k].piece)?, span);
        Some(Self { sides: [part(0, [from, to])?, part(1, other)?], ..*self })
    }

    /// A seam between two whole edges, without a ratio.
    pub fn of_edges(sides: [EdgeRef; 2], same_direction: bool) -> Self {
        Self { sides: sides.map(Stretch::from), same_direction, ratio: None, zip: None }
    }
}

/// One whole edge sewn to one whole edge: what a [`Seam`] becomes when edges are cut for sewing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeSeam {
    /// The two sides.
    pub sides: [EdgeRef; 2],
    /// Direction of pairing, as in [`Seam::same_direction`].
    pub same_direction: bool,
}
