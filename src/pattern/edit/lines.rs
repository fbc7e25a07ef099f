//! Replacing closed lines of a piece, with notches and seams moved on to the new edges.

use std::sync::Arc;

use crate::geometry::ids::{PieceId, SeamId};
use crate::pattern::{
    AllowanceCorner, Edge, EdgeRef, GradeRule, Notch, Pattern, Piece, Seam, Stretch, curve,
};

/// Difference of fractions of an edge up to which two places count as one.
const SAME: f64 = 1e-9;

/// A part of an old edge and the part of a new edge that replaces it, as fractions of arc lengths.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// Start and end on the old edge.
    pub old: [f64; 2],
    /// Number of the new edge on its closed line.
    pub edge: usize,
    /// Start and end on the new edge.
    pub new: [f64; 2],
}

impl Part {
    /// The part by which a whole old edge becomes a whole new edge.
    pub fn whole(edge: usize) -> Self {
        Self { old: [0.0, 1.0], edge, new: [0.0, 1.0] }
    }
}

/// For each old edge of a closed line its parts in order; stretches in no part are removed.
pub(super) type LineMap = Vec<Vec<Part>>;

/// Replaces closed line `k` of a piece. Notches and seams on removed stretches are removed too.
pub(super) fn replace(pattern: &mut Pattern, id: PieceId, k: usize, edges: Vec<Edge>, map: &LineMap) {
    let Some(old) = pattern.pieces.get(&id).cloned() else { return };
    let mut new = Piece::clone(&old);
    *new.loop_edges_mut(k) = edges;
    new.cut_line.clear();
    let first = |piece: &Piece, k: usize| -> usize { piece.loops().take(k).map(Vec::len).sum() };
    let place = |edge: usize, at: f64, at_end: bool| -> Option<(usize, f64)> {
        let (of, start) = old.loop_of(edge);
        let base = first(&new, of);
        if of != k {
            return Some((base + edge - start, at));
        }
        let holds = |p: &&Part| {
            if at_end {
                at > p.old[0] + SAME || p.old[0] == 0.0
            } else {
                at < p.old[1] - SAME || p.old[1] == 1.0
            }
        };
        let parts = || map[edge - start].iter().filter(|p| at >= p.old[0] - SAME && at <= p.old[1] + SAME);
        let part = parts().find(holds)?;
        let share = ((at - part.old[0]) / (part.old[1] - part.old[0])).clamp(0.0, 1.0);
        Some((base + part.edge, part.new[0] + share * (part.new[1] - part.new[0])))
    };
    let notch = |n: &Notch| place(n.edge, n.at, false).map(|(edge, at)| Notch { edge, at });
    let notches = old.notches.iter().filter_map(notch).collect();
    let stretch = |s: &Stretch| {
        let last = (0..s.further).fold(s.edge, |e, _| old.next_edge(e));
        stretch_between(&new, id, place(s.edge, s.from, false)?, place(last, s.to, true)?, s.further > 0)
    };
    let moved: Vec<(SeamId, Option<Seam>)> = pattern
        .seams
        .iter()
        .filter(|(_, seam)| seam.sides.iter().any(|side| side.piece == id))
        .map(|(&seam_id, seam)| {
            let side = |s: &Stretch| if s.piece == id { stretch(s) } else { Some(*s) };
            let sides = side(&seam.sides[0]).zip(side(&seam.sides[1]));
            (seam_id, sides.map(|(a, b)| Seam { sides: [a, b], ..*seam }))
        })
        .collect();
    for (seam_id, seam) in moved {
        match seam {
            Some(seam) => pattern.seams.insert(seam_id, seam),
            None => pattern.seams.remove(&seam_id),
        };
    }
    new.notches = notches;
    pattern.pieces.insert(id, Arc::new(new));
}

/// The stretch from one place to another along the line. Where the two are equal it runs all the way round if `round` is set.
pub(super) fn stretch_between(
    piece: &Piece,
    id: PieceId,
    (mut edge, mut from): (usize, f64),
    (mut last, mut to): (usize, f64),
    round: bool,
) -> Option<Stretch> {
    if from >= 1.0 - SAME {
        (edge, from) = (piece.next_edge(edge), 0.0);
    }
    if to <= SAME {
        (last, to) = (previous(piece, last), 1.0);
    }
    if from <= SAME {
        from = 0.0;
    }
    if to >= 1.0 - SAME {
        to = 1.0;
    }
    let around = piece.loop_edges(piece.loop_of(edge).0).len();
    let (mut further, mut at) = (0, edge);
    while at != last || (further == 0 && to <= from + SAME && round) {
        at = piece.next_edge(at);
        further += 1;
        if further > around {
            return None;
        }
    }
    let stretch = Stretch { piece: id, edge, from, further, to };
    stretch.parts(piece).map(|_| stretch)
}

/// The edge before edge `i` on its closed line.
pub(super) fn previous(piece: &Piece, i: usize) -> usize {
    let (k, first) = piece.loop_of(i);
    let n = piece.loop_edges(k).len();
    first + (i - first + n - 1) % n
}

/// Puts points on an edge, at ascending fractions inside 0..1 of its arc length. The edge's first part keeps its number.
pub(super) fn insert_points(pattern: &mut Pattern, edge: EdgeRef, fractions: &[f64]) {
    let Some(piece) = pattern.pieces.get(&edge.piece) else { return };
    let (k, first) = piece.loop_of(edge.edge);
    let old = piece.loop_edges(k);
    let at = edge.edge - first;
    let (a, b) = piece.edge_ends(edge.edge);
    let parts = curve::split(a, old[at].shape, b, fractions);
    let count = parts.len();
    let mut edges = old.clone();
    let new = parts.into_iter().enumerate().map(|(i, (start, shape))| {
        // A point inserted on a curve is smooth.
        let curved = !matches!(shape, crate::pattern::EdgeShape::Line);
        let smooth = if i == 0 { old[at].smooth } else { curved };
        let place = if i == 0 { 0.0 } else { fractions[i - 1] };
        let rule = if i == 0 {
            old[at].rule.clone()
        } else {
            GradeRule::between(old[at].rule.as_ref(), old[(at + 1) % old.len()].rule.as_ref(), place)
        };
        let corner = if i == 0 { old[at].corner } else { AllowanceCorner::default() };
        Edge { start, shape, smooth, corner, rule, ..old[at].clone() }
    });
    edges.splice(at..=at, new);
    let mut bounds = vec![0.0];
    bounds.extend(fractions);
    bounds.push(1.0);
    let map = (0..old.len())
        .map(|i| match i {
            _ if i < at => vec![Part::whole(i)],
            _ if i > at => vec![Part::whole(i + count - 1)],
            _ => (0..count)
                .map(|p| Part { old: [bounds[p], bounds[p + 1]], edge: at + p, new: [0.0, 1.0] })
                .collect(),
        })
        .collect();
    replace(pattern, edge.piece, k, edges, &map);
}

/// The part of a stretch between two fractions of its arc length.
pub(super) fn part_of(piece: &Piece, stretch: &Stretch, from: f64, to: f64) -> Option<Stretch> {
    let parts = stretch.parts(piece)?;
    let length = |&(edge, a, b): &(usize, f64, f64)| (b - a) * piece.exact_edge_length(edge);
    let total: f64 = parts.iter().map(length).sum();
    let place = |f: f64, at_end: bool| {
        let mut left = f * total;
        for (i, part) in parts.iter().enumerate() {
            let own = length(part);
            let within = if at_end { left <= own * (1.0 + SAME) } else { left < own * (1.0 - SAME) };
            if within || i + 1 == parts.len() {
                return (part.0, part.1 + (left / own).clamp(0.0, 1.0) * (part.2 - part.1));
            }
            left -= own;
        }
        (parts[0].0, parts[0].1)
    };
    stretch_between(piece, stretch.piece, place(from, false), place(to, true), to - from > 0.5)
}

/// Splits every seam that runs over the start of an edge there into two seams.
pub(super) fn split_seams_at(pattern: &mut Pattern, point: EdgeRef) {
    let seams: Vec<SeamId> = pattern.seams.keys().copied().collect();
    for id in seams {
        for k in 0..2 {
            let seam = pattern.seams[&id];
            let Some(f) = fraction_at(pattern, &seam.sides[k], point) else { continue };
            if let Some([before, behind]) = halves(pattern, &seam, k, f, f) {
                pattern.seams.insert(id, before);
                pattern.add_seam(behind);
            }
        }
    }
}

/// The start of an edge as a fraction of the length of a stretch. None unless it is inside the stretch.
pub(super) fn fraction_at(pattern: &Pattern, stretch: &Stretch, point: EdgeRef) -> Option<f64> {
    if stretch.piece != point.piece {
        return None;
    }
    let piece = pattern.pieces.get(&stretch.piece)?;
    let parts = stretch.parts(piece)?;
    let length = |&(edge, a, b): &(usize, f64, f64)| (b - a) * piece.exact_edge_length(edge);
    let at = parts.iter().skip(1).position(|part| part.0 == point.edge && part.1 == 0.0)? + 1;
    let total: f64 = parts.iter().map(length).sum();
    Some(parts[..at].iter().map(length).sum::<f64>() / total)
}

/// Splits a seam in two: side `k` up to fraction `until` and from fraction `on`; the other side is split in
/// proportion to the lengths of these two.
pub(super) fn halves(pattern: &Pattern, seam: &Seam, k: usize, until: f64, on: f64) -> Option<[Seam; 2]> {
    let (own, other) = (seam.sides[k], seam.sides[1 - k]);
    let (own_piece, other_piece) = (pattern.pieces.get(&own.piece)?, pattern.pieces.get(&other.piece)?);
    let share = until / (until + 1.0 - on);
    let own_parts = [part_of(own_piece, &own, 0.0, until)?, part_of(own_piece, &own, on, 1.0)?];
    let cut = if seam.same_direction { share } else { 1.0 - share };
    let low = part_of(other_piece, &other, 0.0, cut)?;
    let high = part_of(other_piece, &other, cut, 1.0)?;
    let other_parts = if seam.same_direction { [low, high] } else { [high, low] };
    Some([0, 1].map(|i| {
        let sides = if k == 0 { [own_parts[i], other_parts[i]] } else { [other_parts[i], own_parts[i]] };
        Seam { sides, ..*seam }
    }))
}
