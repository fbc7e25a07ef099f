//! Rows of stitches on flat pieces: topstitching, the seams of hems, elastic, and the teeth of zips.

use std::sync::Arc;

use glam::DVec2;

use crate::geometry::ids::PieceId;
use crate::geometry::polygon::signed_area;
use crate::pattern::piece::flattened_loop;
use crate::pattern::trims::{Hem, Topstitch};
use crate::pattern::{Edge, Pattern, Piece, Stretch, Trims, Zip, curve};

/// Tolerance to which curves are flattened, metres.
const TOLERANCE: f64 = 2e-4;
/// Longest side of a row, metres: cloth bends between its points.
const LONGEST: f64 = 5e-3;
/// Width of the zigzag by which elastic is sewn on, and the length of one stitch of it, metres.
const ZIGZAG: [f64; 2] = [0.006, 0.004];
/// Distance of the teeth of a zip from the edge, metres.
const TEETH: f64 = 0.002;
/// Colour of the thread of elastic and hems, sRGB.
pub const PLAIN: [u8; 3] = [246, 243, 232];
/// Length of the stitches of a hem, metres.
const HEM_STITCH: f64 = 0.004;

/// What a row is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Thread {
    /// Stitches of this length, metres, with short gaps between them.
    Stitches { length: f64, colour: [u8; 3] },
    /// An unbroken thread.
    Line { colour: [u8; 3] },
    /// Teeth of a zip.
    Teeth { colour: [u8; 3] },
}

/// A row of stitches.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The piece.
    pub piece: PieceId,
    /// The row as a polyline in the piece's own plane, metres.
    pub points: Vec<DVec2>,
    /// What it is.
    pub thread: Thread,
}

/// A run of edges with the same trims.
struct Run {
    points: Vec<DVec2>,
    closed: bool,
    /// 1 where the cloth is on the left, -1 where it is on the right.
    side: f64,
    trims: Trims,
}

/// All rows of `pattern`, piece by piece.
pub fn rows(pattern: &Pattern) -> Vec<Row> {
    let mut rows = Vec::new();
    for (&id, piece) in pattern.pieces.iter().filter(|(_, piece)| !piece.activity.is_deactivated()) {
        for run in runs(piece) {
            let lines = worked(&run).into_iter();
            rows.extend(lines.map(|(points, thread)| Row { piece: id, points: finer(&points), thread }));
        }
    }
    for seam in pattern.seams.values() {
        let Some(zip) = seam.zip else { continue };
        for side in seam.sides {
            if let Some(points) = pattern.pieces.get(&side.piece).and_then(|piece| teeth(piece, &side)) {
                let thread = Thread::Teeth { colour: zip.colour };
                rows.push(Row { piece: side.piece, points: finer(&points), thread });
            }
        }
    }
    rows
}

/// Doubled cloth along a hem: pairs of a point of the edge and one of where the hem ends.
pub fn hems(pattern: &Pattern) -> Vec<(PieceId, Vec<[DVec2; 2]>)> {
    let mut hems = Vec::new();
    for (&id, piece) in pattern.pieces.iter().filter(|(_, piece)| !piece.activity.is_deactivated()) {
        for run in runs(piece) {
            if let Some(hem) = run.trims.hem {
                let edge = finer(&run.points);
                let inner = moved(&edge, run.closed, hem.width * run.side);
                hems.push((id, edge.into_iter().zip(inner).map(|(a, b)| [a, b]).collect()));
            }
        }
    }
    hems
}

/// Whether stitches, zips and buttons of two patterns are in the same places and look alike.
pub fn is_trimmed_alike(one: &Pattern, other: &Pattern) -> bool {
    let zips = |pattern: &Pattern| -> Vec<([Stretch; 2], Zip)> {
        pattern.seams.values().filter_map(|seam| Some((seam.sides, seam.zip?))).collect()
    };
    let is_trimmed = |piece: &Piece| {
        let edges = piece.loops().flatten().chain(piece.lines.iter().flat_map(|line| &line.edges));
        edges.into_iter().any(|edge| !edge.trims.is_none())
    };
    let is_alike = |a: &Piece, b: &Piece| a.outline == b.outline && a.holes == b.holes && a.lines == b.lines;
    one.buttons == other.buttons
        && zips(one) == zips(other)
        && one.pieces.len() == other.pieces.len()
        && one.pieces.iter().zip(&other.pieces).all(|((i, a), (j, b))| {
            i == j && (Arc::ptr_eq(a, b) || is_alike(a, b) || !(is_trimmed(a) || is_trimmed(b)))
        })
}

/// The rows along a run.
fn worked(run: &Run) -> Vec<(Vec<DVec2>, Thread)> {
    let mut lines = Vec::new();
    let inside = |by: f64| moved(&run.points, run.closed, by * run.side);
    if let Some(Topstitch { distance, length, rows, spacing, colour }) = run.trims.topstitch {
        for k in 0..rows {
            let at = distance + f64::from(k) * spacing;
            lines.push((inside(at), Thread::Stitches { length, colour }));
        }
    }
    if let Some(Hem { width, colour }) = run.trims.hem {
        let colour = colour.unwrap_or(PLAIN);
        lines.push((inside(width), Thread::Stitches { length: HEM_STITCH, colour }));
    }
    if run.trims.elastic.is_some() {
        lines.push((zigzag(&inside(ZIGZAG[0] * 0.7)), Thread::Line { colour: PLAIN }));
    }
    lines
}

/// The runs of a piece: its closed lines, then its internal lines.
fn runs(piece: &Piece) -> Vec<Run> {
    let mut runs = Vec::new();
    for (k, edges) in piece.loops().enumerate() {
        let turns_left = signed_area(&flattened_loop(edges, TOLERANCE * 10.0)) >= 0.0;
        let side = if turns_left == (k == 0) { 1.0 } else { -1.0 };
        let ends: Vec<DVec2> = (0..edges.len()).map(|i| edges[(i + 1) % edges.len()].start).collect();
        runs.extend(joined(edges, &ends, true, side));
    }
    for line in &piece.lines {
        let mut ends: Vec<DVec2> = line.edges.iter().skip(1).map(|edge| edge.start).collect();
        ends.push(line.end);
        runs.extend(joined(&line.edges, &ends, false, 1.0));
    }
    runs
}

/// Joins neighbouring edges with the same trims, not none, into runs.
fn joined(edges: &[Edge], ends: &[DVec2], closed: bool, side: f64) -> Vec<Run> {
    let n = edges.len();
    let is_alike = |i: usize| edges[i].trims == edges[(i + n - 1) % n].trims;
    let first = (0..n).find(|&i| !is_alike(i) || (!closed && i == 0));
    let mut runs: Vec<Run> = Vec::new();
    for i in (0..n).map(|i| (first.unwrap_or(0) + i) % n) {
        let trims = edges[i].trims;
        let goes_on = (closed || i != 0) && Some(i) != first && is_alike(i);
        if let Some(run) = runs.last_mut().filter(|_| goes_on) {
            run.points.pop();
            curve::flatten(edges[i].start, edges[i].shape, ends[i], TOLERANCE, &mut run.points);
            run.points.push(ends[i]);
        } else {
            let mut points = Vec::new();
            curve::flatten(edges[i].start, edges[i].shape, ends[i], TOLERANCE, &mut points);
            points.push(ends[i]);
            runs.push(Run { points, closed: closed && first.is_none(), side, trims });
        }
    }
    runs.retain(|run| !run.trims.is_none());
    runs
}

/// The line `by` metres to the left of `points`, with mitred corners; the last point of a closed line is its first.
fn moved(points: &[DVec2], closed: bool, by: f64) -> Vec<DVec2> {
    let n = points.len();
    if n < 2 || by == 0.0 {
        return points.to_vec();
    }
    let normal = |i: usize| (points[i + 1] - points[i]).normalize_or_zero().perp();
    let at = |i: usize| {
        let before = if i > 0 {
            normal(i - 1)
        } else if closed {
            normal(n - 2)
        } else {
            normal(0)
        };
        let after = if i + 1 < n {
            normal(i)
        } else if closed {
            normal(0)
        } else {
            normal(n - 2)
        };
        let middle = (before + after) / 2.0;
        // Very sharp corners are cut off.
        points[i] + middle / middle.length_squared().max(0.2) * by
    };
    (0..n).map(at).collect()
}

/// The polyline with sides of at most [`LONGEST`].
fn finer(points: &[DVec2]) -> Vec<DVec2> {
    let mut fine: Vec<DVec2> = points.first().copied().into_iter().collect();
    for w in points.windows(2) {
        let count = (w[0].distance(w[1]) / LONGEST).ceil().max(1.0) as usize;
        fine.extend((1..=count).map(|i| w[0].lerp(w[1], i as f64 / count as f64)));
    }
    fine
}

/// A zigzag about a polyline.
fn zigzag(points: &[DVec2]) -> Vec<DVec2> {
    let [width, stitch] = ZIGZAG;
    let (mut all, mut walked, mut side) = (Vec::new(), 0.0, width / 2.0);
    for w in points.windows(2) {
        let (long, way) = (w[0].distance(w[1]), (w[1] - w[0]).normalize_or_zero());
        while walked <= long {
            all.push(w[0] + way * walked + way.perp() * side);
            (walked, side) = (walked + stitch, -side);
        }
        walked -= long;
    }
    all
}

/// The teeth along one side of a zip.
fn teeth(piece: &Piece, side: &Stretch) -> Option<Vec<DVec2>> {
    let count = (side.length(piece)? / LONGEST).ceil().max(1.0) as usize;
    let shares: Vec<f64> = (0..=count).map(|i| i as f64 / count as f64).collect();
    let points = side.points(piece, &shares)?;
    let (k, _) = piece.loop_of(side.edge);
    let turns_left = signed_area(&flattened_loop(piece.loop_edges(k), TOLERANCE * 10.0)) >= 0.0;
    let inside = if turns_left == (k == 0) { TEETH } else { -TEETH };
    Some(moved(&points, false, inside))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Pattern;

    fn square(trims: [Option<Topstitch>; 4]) -> Pattern {
        let corners = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)].map(DVec2::from);
        let mut piece = Piece::polygon("square", &corners);
        for (edge, topstitch) in piece.outline.iter_mut().zip(trims) {
            edge.trims.topstitch = topstitch;
        }
        let mut pattern = Pattern::default();
        pattern.add_piece(piece);
        pattern
    }

    fn long(row: &Row) -> f64 {
        row.points.windows(2).map(|w| w[0].distance(w[1])).sum()
    }

    #[test]
    fn rows_keep_their_distance_inside_and_go_round_corners() {
        let stitch = Topstitch { distance: 0.01, rows: 2, spacing: 0.005, ..Topstitch::default() };
        let rows = rows(&square([Some(stitch); 4]));
        assert_eq!(rows.len(), 2);
        assert!((long(&rows[0]) - 0.32).abs() < 1e-9 && (long(&rows[1]) - 0.28).abs() < 1e-9);
        let edge = |p: DVec2| p.x.min(p.y).min(0.1 - p.x).min(0.1 - p.y);
        assert!(rows[0].points.iter().all(|&p| (edge(p) - 0.01).abs() < 1e-9));
        assert!(rows[0].points.windows(2).all(|w| w[0].distance(w[1]) <= LONGEST + 1e-9));
    }

    #[test]
    fn a_run_ends_where_its_trims_do() {
        let stitch = Some(Topstitch { distance: 0.005, ..Topstitch::default() });
        // The last and the first edge are one run.
        let rows = rows(&square([stitch, None, None, stitch]));
        assert_eq!(rows.len(), 1);
        let (from, to) = (rows[0].points[0], rows[0].points[rows[0].points.len() - 1]);
        assert!(from.distance(DVec2::new(0.005, 0.1)) < 1e-9, "{from}");
        assert!(to.distance(DVec2::new(0.1, 0.005)) < 1e-9, "{to}");
    }
}
