//! Makes the pieces of a pattern out of the lines of a drawing.

pub mod allowance;
pub mod contour;
pub mod fit;
mod outer;
pub mod sample;

use std::sync::Arc;

use glam::DVec2;
use kurbo::{ParamCurve, ParamCurveArclen, ParamCurveNearest};

use crate::geometry::words::{Words, words};
use crate::io::sheet;
use crate::pattern::piece::flattened_loop;
use crate::pattern::{Edge, GradeRule, InternalLine, Notch, Pattern, Piece, PlanePose, curve};
use contour::Contour;

/// Flattening tolerance of outlines where shapes are compared, metres.
const CHORDS: f64 = 2e-4;
/// Largest distance of a notch from the nearest edge, metres; notches further off are left out.
const NOTCH_REACH: f64 = 0.06;
/// Accuracy of nearest points and arc lengths on curves, metres.
const FINE: f64 = 1e-10;
/// Largest number of pairs of pieces with overlapping bounding boxes that are tested; a drawing with more is laid out anew.
const MOST_CLOSE: usize = 300;
/// Largest number of notches of one piece.
const MOST_NOTCHES: usize = 1000;
/// The widest seam allowance a piece may have, metres.
const WIDEST_ALLOWANCE: f64 = 0.2;

/// A piece as drawn, seen from its front, in the pattern plane, metres.
#[derive(Clone, Debug, Default)]
pub struct Traced {
    /// Name of the piece.
    pub name: String,
    /// The seam line.
    pub outline: Vec<Edge>,
    /// The cut line; empty where the file has none.
    pub cut_line: Vec<Edge>,
    /// Closed lines that are cut out of the piece.
    pub holes: Vec<Vec<Edge>>,
    /// Internal lines.
    pub lines: Vec<InternalLine>,
    /// Positions of notches, on or near edges.
    pub notches: Vec<DVec2>,
    /// The grainline from tail to head.
    pub grainline: Option<[DVec2; 2]>,
}

impl Traced {
    /// Lower and upper corner of the bounding box of the outline (or cut line), internal lines and grainline, metres.
    pub fn bounds(&self) -> [DVec2; 2] {
        let line = if self.cut_line.is_empty() { &self.outline } else { &self.cut_line };
        let mut points = flattened_loop(line, CHORDS);
        points.extend(self.lines.iter().flat_map(|l| l.flattened(CHORDS)));
        points.extend(self.grainline.iter().flatten());
        let (lower, upper) = Contour::new(points).bounds();
        [lower, upper]
    }
}

/// A piece at its position in the pattern plane, seen from its front, for writing to a drawing. Metres.
pub fn on_table(piece: &Piece) -> Traced {
    let pose = &piece.pose;
    let outline_area = piece.signed_area() * if pose.flipped { -1.0 } else { 1.0 };
    // A piece that shows its back is mirrored about its centre, to show its front.
    let centre = pose.plane_from_piece(Contour::new(piece.flattened(CHORDS)).middle());
    let turns_over = outline_area < 0.0;
    let place = |p: DVec2| {
        let q = pose.plane_from_piece(p);
        if turns_over { DVec2::new(2.0 * centre.x - q.x, q.y) } else { q }
    };
    let turns = pose.flipped != turns_over;
    let turned = |rule: &GradeRule| rule.mapped(|by| place(by) - place(DVec2::ZERO));
    let placed = |edges: &[Edge]| -> Vec<Edge> {
        let placed = |e: &Edge| Edge {
            start: place(e.start),
            shape: e.shape.mapped(turns, place),
            rule: e.rule.as_ref().map(turned),
            ..e.clone()
        };
        edges.iter().map(placed).collect()
    };
    Traced {
        name: piece.name.clone(),
        outline: placed(&piece.outline),
        cut_line: placed(&allowance::cut_line(piece)),
        holes: piece.holes.iter().map(|hole| placed(hole)).collect(),
        lines: piece
            .lines
            .iter()
            .map(|l| InternalLine {
                edges: placed(&l.edges),
                end: place(l.end),
                name: l.name.clone(),
                end_rule: l.end_rule.as_ref().map(turned),
            })
            .collect(),
        notches: piece.notches.iter().map(|n| place(piece.edge_points(n.edge, &[n.at])[0])).collect(),
        grainline: piece.grainline.map(|ends| ends.map(place)),
    }
}

/// A pattern of these pieces, and notes about what was left out. Pieces keep their positions unless two overlap; then all are
/// laid out anew.
pub fn pattern(traced: Vec<Traced>) -> (Pattern, Vec<Words>) {
    let mut pattern = Pattern::default();
    let mut notes = Vec::new();
    for piece in traced {
        let name = piece.name.clone();
        let (piece, lost) = piece_of(piece);
        if lost > 0 {
            notes.push(words!("{name}: {n} notches are on no edge; they were left out", name, n = lost));
        }
        pattern.add_piece(piece);
    }
    if lie_apart(&pattern) {
        centre(&mut pattern)
    } else {
        sheet::lay_out(&mut pattern)
    }
    (pattern, notes)
}

/// The piece with its origin at the centre of its bounding box, and the number of notches that were left out.
fn piece_of(traced: Traced) -> (Piece, usize) {
    let Traced { name, outline, cut_line, holes, lines, notches, grainline } = traced;
    let outline = counter_clockwise(outline);
    let cut_line = counter_clockwise(cut_line);
    let middle = Contour::new(flattened_loop(&outline, CHORDS)).middle();
    let allowance = allowance_between(&outline, &cut_line);
    let mut piece = Piece {
        name,
        outline: moved(outline, middle),
        holes: holes.into_iter().map(|hole| moved(hole, middle)).collect(),
        lines: lines
            .into_iter()
            .map(|l| InternalLine { edges: moved(l.edges.clone(), middle), end: l.end - middle, ..l })
            .collect(),
        grainline: grainline.map(|ends| ends.map(|p| p - middle)),
        allowance,
        cut_line: moved(cut_line, middle),
        pose: PlanePose { offset: middle, ..PlanePose::default() },
        ..Piece::default()
    };
    let found: Vec<Notch> =
        notches.iter().take(MOST_NOTCHES).filter_map(|&p| notch(&piece, p - middle)).collect();
    let lost = notches.len() - found.len();
    piece.notches = found;
    (piece, lost)
}

fn counter_clockwise(edges: Vec<Edge>) -> Vec<Edge> {
    let area = Contour::new(flattened_loop(&edges, CHORDS)).signed_area();
    if area < 0.0 { curve::reversed(&edges) } else { edges }
}

fn moved(edges: Vec<Edge>, origin: DVec2) -> Vec<Edge> {
    let moved = |e: Edge| Edge { start: e.start - origin, shape: e.shape.mapped(false, |p| p - origin), ..e };
    edges.into_iter().map(moved).collect()
}

/// The median distance between an outline and its cut line, rounded to half a millimetre, metres.
fn allowance_between(outline: &[Edge], cut_line: &[Edge]) -> f64 {
    if cut_line.is_empty() {
        return 0.0;
    }
    let [inner, outer] = [outline, cut_line].map(|edges| Contour::coarse(flattened_loop(edges, CHORDS)));
    let mut distances: Vec<f64> = inner.spread().into_iter().map(|p| outer.distance(p)).collect();
    distances.sort_by(f64::total_cmp);
    let usual = distances.get(distances.len() / 2).copied().unwrap_or(0.0);
    ((usual * 2e3).round() / 2e3).min(WIDEST_ALLOWANCE)
}

/// The notch on the edge point nearest to `p`; None if that is further off than [`NOTCH_REACH`].
fn notch(piece: &Piece, p: DVec2) -> Option<Notch> {
    let (notch, distance) =
        (0..piece.edge_count()).map(|edge| nearest_on(piece, edge, p)).min_by(|a, b| a.1.total_cmp(&b.1))?;
    (distance <= NOTCH_REACH).then_some(notch)
}

fn nearest_on(piece: &Piece, edge: usize, p: DVec2) -> (Notch, f64) {
    let segments = piece.edge_segments(edge);
    let lengths: Vec<f64> = segments.iter().map(|s| s.arclen(FINE)).collect();
    let total: f64 = lengths.iter().sum();
    let (mut before, mut best) = (0.0, (0.0, f64::INFINITY));
    for (segment, length) in segments.iter().zip(lengths) {
        let near = segment.nearest(kurbo::Point::new(p.x, p.y), FINE);
        if near.distance_sq < best.1 {
            best = (before + segment.subsegment(0.0..near.t).arclen(FINE), near.distance_sq);
        }
        before += length;
    }
    let at = if total > 0.0 { (best.0 / total).clamp(0.0, 1.0) } else { 0.0 };
    (Notch { edge, at }, best.1.sqrt())
}

/// Whether no two pieces overlap at their positions in the drawing.
fn lie_apart(pattern: &Pattern) -> bool {
    let shapes: Vec<Contour> = pattern
        .pieces
        .values()
        .map(|p| Contour::coarse(p.flattened(1e-3).into_iter().map(|q| p.pose.plane_from_piece(q)).collect()))
        .collect();
    let pairs = shapes.iter().enumerate().flat_map(|(i, a)| shapes[..i].iter().map(move |b| (a, b)));
    let close: Vec<(&Contour, &Contour)> =
        pairs.filter(|(a, b)| a.boxes_overlap(b)).take(MOST_CLOSE + 1).collect();
    close.len() <= MOST_CLOSE && close.into_iter().all(|(a, b)| !a.overlaps(b))
}

fn centre(pattern: &mut Pattern) {
    let points = pattern
        .pieces
        .values()
        .flat_map(|p| p.flattened(1e-3).into_iter().map(|q| p.pose.plane_from_piece(q)).collect::<Vec<_>>());
    let middle = Contour::new(points.collect()).middle();
    for piece in pattern.pieces.values_mut() {
        Arc::make_mut(piece).pose.offset -= middle;
    }
}
