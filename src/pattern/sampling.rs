//! Sampling of edges: how many points each gets, so that both sides of a seam have the same number.

use std::collections::BTreeMap;

use crate::geometry::ids::{PieceId, SeamId};
use crate::geometry::words::{decimal, words};
use crate::pattern::fineness::edge_length_of;
use crate::pattern::{CutPattern, EdgeRef, EdgeSeam, Problem, ProblemKind};

/// Fraction by which the lengths of a seam's sides may differ before the seam is reported.
const UNEQUAL: f64 = 0.02;
/// Length below which an edge is reported to have none, metres.
const SHORTEST_EDGE: f64 = 1e-5;

/// The number of intervals of each edge, and the seams that can be sewn.
pub struct Sampling {
    /// For each piece the length of the edges of its mesh, about, metres.
    pub edge_lengths: BTreeMap<PieceId, f64>,
    /// For each piece and edge the number of intervals, at least 1.
    pub intervals: BTreeMap<PieceId, Vec<usize>>,
    /// Seams whose two edges exist and are in no other seam, in the order of their ids.
    pub seams: Vec<(SeamId, EdgeSeam)>,
}

/// Chooses intervals of about `edge_length` metres, or less where a piece needs a finer mesh. Both sides of a seam get the number of
/// the one that needs more.
pub fn sampling(pattern: &CutPattern, edge_length: f64, problems: &mut Vec<Problem>) -> Sampling {
    let lengths: BTreeMap<PieceId, Vec<f64>> = pattern
        .pieces
        .iter()
        .map(|(&id, piece)| (id, (0..piece.edge_count()).map(|i| piece.edge_length(i)).collect()))
        .collect();
    report_short_edges(pattern, &lengths, problems);
    let edge_lengths: BTreeMap<PieceId, f64> =
        pattern.pieces.iter().map(|(&id, piece)| (id, edge_length_of(piece, edge_length))).collect();
    let mut intervals: BTreeMap<PieceId, Vec<usize>> = BTreeMap::new();
    for (&id, of_piece) in &lengths {
        let count = |length: &f64| ((length / edge_lengths[&id]).round() as usize).max(1);
        intervals.insert(id, of_piece.iter().map(count).collect());
    }
    let seams = sound_seams(pattern, &lengths, problems);
    for (_, seam) in &seams {
        let most = seam.sides.map(|s| intervals[&s.piece][s.edge]).into_iter().max().unwrap_or(1);
        for side in seam.sides {
            if let Some(of_piece) = intervals.get_mut(&side.piece) {
                of_piece[side.edge] = most;
            }
        }
    }
    report_unsewn(pattern, &seams, problems);
    Sampling { edge_lengths, intervals, seams }
}

fn report_short_edges(
    pattern: &CutPattern,
    lengths: &BTreeMap<PieceId, Vec<f64>>,
    problems: &mut Vec<Problem>,
) {
    for (id, of_piece) in lengths {
        for (edge, &length) in of_piece.iter().enumerate() {
            if length < SHORTEST_EDGE || !length.is_finite() {
                problems.push(Problem {
                    kind: ProblemKind::ZeroLength,
                    place: pattern.place(EdgeRef { piece: *id, edge }),
                    words: words!("this edge has no length; delete one of its end points"),
                });
            }
        }
    }
}

fn sound_seams(
    pattern: &CutPattern,
    lengths: &BTreeMap<PieceId, Vec<f64>>,
    problems: &mut Vec<Problem>,
) -> Vec<(SeamId, EdgeSeam)> {
    let mut taken = std::collections::BTreeSet::new();
    let mut sound = Vec::new();
    for &(id, seam) in &pattern.seams {
        if let Some(missing) =
            seam.sides.iter().find(|s| lengths.get(&s.piece).is_none_or(|l| s.edge >= l.len()))
        {
            problems.push(Problem {
                kind: ProblemKind::SeamToNothing,
                place: id.into(),
                words: words!(
                    "it sews {place}, which is not there; delete or redraw the seam",
                    place = pattern.place(*missing)
                ),
            });
            continue;
        }
        if let Some(&twice) = seam.sides.iter().find(|s| taken.contains(*s)) {
            problems.push(Problem {
                kind: ProblemKind::EdgeSewnTwice,
                place: pattern.place(twice),
                words: words!("{id} sews this edge a second time and was left out", id),
            });
            continue;
        }
        taken.extend(seam.sides);
        let [a, b] = seam.sides.map(|s| lengths[&s.piece][s.edge]);
        let (short, long) = (a.min(b), a.max(b));
        if long > short * (1.0 + UNEQUAL) {
            let is_kept = |ratio: &f64| (a / b / ratio - 1.0).abs() <= UNEQUAL;
            problems.push(Problem {
                kind: match pattern.ratios.get(&id).is_some_and(is_kept) {
                    true => ProblemKind::Gather,
                    false => ProblemKind::UnequalSeam,
                },
                place: words!(
                    "{id}: {a} and {b}",
                    id,
                    a = pattern.place(seam.sides[0]),
                    b = pattern.place(seam.sides[1])
                ),
                words: words!(
                    "its sides are {a} and {b} cm long; the longer is gathered {ratio}:1",
                    a = decimal(a * 100.0, 1),
                    b = decimal(b * 100.0, 1),
                    ratio = decimal(long / short, 2)
                ),
            });
        }
        sound.push((id, seam));
    }
    sound
}

fn report_unsewn(pattern: &CutPattern, seams: &[(SeamId, EdgeSeam)], problems: &mut Vec<Problem>) {
    if pattern.pieces.len() < 2 {
        return;
    }
    for (id, piece) in &pattern.pieces {
        if !seams.iter().any(|(_, s)| s.sides.iter().any(|side| side.piece == *id)) {
            problems.push(Problem {
                kind: ProblemKind::PieceUnsewn,
                place: words!("{name} ({id})", name = piece.name, id),
                words: words!("no seam holds this piece"),
            });
        }
    }
}
