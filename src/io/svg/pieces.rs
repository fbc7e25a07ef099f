//! Makes pieces of the lines of an SVG drawing.

use std::collections::BTreeMap;

use glam::DVec2;

use super::line::Line;
use super::{EDGES, KIND, NAME, PIECE, SMOOTH};
use crate::geometry::words::{Words, words};
use crate::io::Limits;
use crate::io::pattern_file::PatternFileError;
use crate::io::trace::Traced;
use crate::io::trace::contour::Contour;
use crate::io::trace::fit::{self, Knot};
use crate::pattern::piece::flattened_loop;
use crate::pattern::{Edge, EdgeShape, InternalLine, curve};

/// Flattening tolerance of curves where shapes are compared, metres.
const CHORDS: f64 = 5e-4;
/// Smallest bounding box (longer side, metres) of a piece; a smaller closed line outside of all others is a mark and is left out.
const SMALLEST_PIECE: f64 = 0.01;
/// Smallest number of consecutive straight edges to which a curve is fitted.
const FEWEST_CHORDS: usize = 5;
/// Largest angle between the tangents of two edges that join smoothly, radians.
const SMOOTH_ANGLE: f64 = 2e-3;
/// Tolerance for reading a cubic as an arc: relative for the length of its arms, and in radians for their direction.
const SAME_ARM: f64 = 2e-4;
/// Smallest angle of an arc (radians) that is recognised in a cubic; flatter arcs look like other curves.
const LEAST_TURN: f64 = 0.03;
/// Largest distance (metres) outside of a piece at which an open line still belongs to it.
const ON_EDGE: f64 = 1e-3;

/// The pieces drawn with `lines`. `frame` is the size of the drawing in metres: a rectangle of that size is the page's frame.
pub fn traced(
    lines: Vec<Line>,
    is_ours: bool,
    frame: Option<DVec2>,
    notes: &mut Vec<Words>,
) -> Result<Vec<Traced>, PatternFileError> {
    let (ours, others): (Vec<Line>, Vec<Line>) =
        lines.into_iter().partition(|l| is_ours && l.shape.data.contains_key(PIECE));
    let mut all = told(ours);
    all.extend(guessed(others, frame, notes)?);
    Ok(all)
}

/// The pieces of lines that state their piece and kind (files of this program).
fn told(lines: Vec<Line>) -> Vec<Traced> {
    let mut pieces: BTreeMap<(u32, String), Traced> = BTreeMap::new();
    for line in lines {
        let data = |key: &str| line.shape.data.get(key).cloned().unwrap_or_default();
        let (kind, number, name) = (data(KIND), data(PIECE), data(NAME));
        let piece = pieces.entry((number.parse().unwrap_or(u32::MAX), number)).or_default();
        let edges = as_written(&line);
        match kind.as_str() {
            "seam" => {
                piece.outline = edges;
                piece.name = name;
            }
            "cut" => piece.cut_line = edges,
            "hole" => piece.holes.push(edges),
            "notch" => piece.notches.push(edges[0].start),
            "grain" => piece.grainline = Some([edges[0].start, line.end]),
            _ => piece.lines.push(InternalLine { edges, end: line.end, name, ..InternalLine::default() }),
        }
    }
    pieces.into_values().filter(|piece| piece.outline.len() > 1).collect()
}

/// The edges of a line that this program wrote: one for each command of the path, with split arcs joined again.
fn as_written(line: &Line) -> Vec<Edge> {
    let mut edges = with_arcs(&line.edges, line.end);
    let number = |key: &str| line.shape.data.get(key);
    let is_whole = number(EDGES).and_then(|n| n.parse().ok()) == Some(edges.len());
    if is_whole {
        let smooth = number(SMOOTH).map_or("", String::as_str);
        for i in smooth.split_whitespace().filter_map(|n| n.parse::<usize>().ok()) {
            if let Some(edge) = edges.get_mut(i) {
                edge.smooth = true;
            }
        }
    } else {
        mark_smooth(&mut edges, line.end, line.is_closed);
    }
    edges
}

struct Outer {
    line: Line,
    contour: Contour,
    inside: Vec<(Line, Contour)>,
    open: Vec<Line>,
}

/// The pieces of other files' lines, told by which line is inside which.
fn guessed(
    lines: Vec<Line>,
    frame: Option<DVec2>,
    notes: &mut Vec<Words>,
) -> Result<Vec<Traced>, PatternFileError> {
    let (closed, open): (Vec<Line>, Vec<Line>) = lines.into_iter().partition(|l| l.is_closed);
    let limits = Limits::default();
    if closed.len().max(open.len() / 4) > limits.contours {
        let words = words!(
            "{closed} closed and {open} open lines; {most} closed ones are allowed",
            closed = closed.len(),
            open = open.len(),
            most = limits.contours
        );
        return Err(PatternFileError::OverLimit(words));
    }
    let mut closed: Vec<(Line, Contour)> = closed
        .into_iter()
        .map(|line| {
            let contour = Contour::coarse(flattened_loop(&line.edges, CHORDS));
            (line, contour)
        })
        .collect();
    let size = |c: &Contour| c.bounds().1 - c.bounds().0;
    let is_frame = |c: &Contour| {
        frame.is_some_and(|f| (size(c) - f).abs().max_element() < 0.01 * f.max_element())
            && (c.signed_area().abs() / size(c).element_product() - 1.0).abs() < 1e-3
    };
    let before = closed.len();
    if before > 1 {
        closed.retain(|(_, contour)| !is_frame(contour));
    }
    if closed.len() < before {
        notes.push(words!("the frame of the page was left out"));
    }
    closed.sort_by(|a, b| b.1.signed_area().abs().total_cmp(&a.1.signed_area().abs()));
    let mut outer: Vec<Outer> = Vec::new();
    let mut signs = 0_usize;
    for (line, contour) in closed {
        if let Some(around) = outer.iter_mut().find(|o| o.contour.surrounds(&contour)) {
            around.inside.push((line, contour));
        } else if size(&contour).max_element() < SMALLEST_PIECE {
            signs += 1;
        } else {
            outer.push(Outer { line, contour, inside: Vec::new(), open: Vec::new() });
        }
    }
    for line in open {
        let first = line.edges[0].start;
        match outer.iter_mut().find(|o| o.contour.is_near(first, ON_EDGE)) {
            Some(around) => around.open.push(line),
            None => signs += 1,
        }
    }
    if signs > 0 {
        notes.push(words!("{n} small or open lines outside of all pieces were left out", n = signs));
    }
    // Pieces in the order of the file.
    outer.sort_by_key(|o| o.line.path);
    let mut names: BTreeMap<String, usize> = BTreeMap::new();
    Ok(outer
        .into_iter()
        .enumerate()
        .map(|(i, outer)| {
            let name = outer.line.shape.name.clone().unwrap_or_else(|| format!("piece {}", i + 1));
            let count = names.entry(name.clone()).or_default();
            *count += 1;
            let name = if *count > 1 { format!("{name} {count}") } else { name };
            outer.piece(name)
        })
        .collect())
}

impl Outer {
    fn piece(mut self, name: String) -> Traced {
        let seam = self.inside.iter().position(|(_, contour)| contour.is_seam_line_in(&self.contour));
        let seam = seam.map(|at| self.inside.remove(at).0);
        let paths = [Some(self.line.path), seam.as_ref().map(|s| s.path)];
        let (outline, cut_line) = match seam {
            Some(seam) => (fitted(&seam), fitted(&self.line)),
            None => (fitted(&self.line), Vec::new()),
        };
        let mut traced = Traced { name, outline, cut_line, ..Traced::default() };
        for (line, _) in self.inside {
            let edges = fitted(&line);
            if paths.contains(&Some(line.path)) {
                traced.holes.push(edges);
            } else {
                let name = line.shape.name.clone().unwrap_or_default();
                traced.lines.push(InternalLine {
                    end: edges[0].start,
                    edges,
                    name,
                    ..InternalLine::default()
                });
            }
        }
        for line in self.open {
            let name = line.shape.name.clone().unwrap_or_default();
            traced.lines.push(InternalLine {
                edges: fitted(&line),
                end: line.end,
                name,
                ..InternalLine::default()
            });
        }
        traced
    }
}

/// The edges of a line, with curves fitted to runs of short chords and arcs in place of circular curves.
fn fitted(line: &Line) -> Vec<Edge> {
    let edges = with_arcs(&line.edges, line.end);
    let is_line = |e: &Edge| e.shape == EdgeShape::Line;
    if line.is_closed && edges.len() > FEWEST_CHORDS && edges.iter().all(is_line) {
        let points: Vec<DVec2> = edges.iter().map(|e| e.start).collect();
        return fit::closed(&points, &vec![Knot::Unknown; points.len()]);
    }
    let mut out: Vec<Edge> = Vec::new();
    let mut i = 0;
    while i < edges.len() {
        let count = edges[i..].iter().take_while(|e| is_line(e)).count();
        if count < FEWEST_CHORDS {
            let next = i + count.max(1);
            out.extend_from_slice(&edges[i..next]);
            i = next;
            continue;
        }
        let end = edges.get(i + count).map_or(line.end, |e| e.start);
        let points: Vec<DVec2> = edges[i..i + count].iter().map(|e| e.start).chain([end]).collect();
        out.extend(fit::open(&points, &vec![Knot::Unknown; points.len()]));
        i += count;
    }
    mark_smooth(&mut out, line.end, line.is_closed);
    out
}

/// Replaces circular cubics by arcs, and joins consecutive parts of one arc to an arc of at most half a circle.
fn with_arcs(edges: &[Edge], end: DVec2) -> Vec<Edge> {
    let mut out: Vec<(Edge, DVec2)> = Vec::new();
    for (i, edge) in edges.iter().enumerate() {
        let to = edges.get(i + 1).map_or(end, |e| e.start);
        let shape = match edge.shape {
            EdgeShape::Cubic { controls } => as_arc(edge.start, controls, to).unwrap_or(edge.shape),
            other => other,
        };
        if let Some((last, until)) = out.last_mut()
            && let Some(joined) = one_arc((last.start, last.shape, *until), (shape, to))
        {
            last.shape = joined;
            *until = to;
            continue;
        }
        out.push((Edge { shape, ..edge.clone() }, to));
    }
    out.into_iter().map(|(edge, _)| edge).collect()
}

/// The arc that a cubic approximates, if it has the standard form of such a cubic: arms along the circle's tangents with the
/// length 4/3 · tan(angle/4) · radius. Such a cubic deviates from the arc, so the arc is taken as what was meant.
fn as_arc(from: DVec2, [c, d]: [DVec2; 2], to: DVec2) -> Option<EdgeShape> {
    let (leaves, arrives) = (c - from, to - d);
    let turn = leaves.angle_to(arrives);
    let radius = from.distance(to) / (2.0 * (turn.abs() / 2.0).sin());
    let arm = 4.0 / 3.0 * (turn.abs() / 4.0).tan() * radius;
    let near = |length: f64| (length / arm - 1.0).abs() < SAME_ARM;
    let sound = (LEAST_TURN..2.0).contains(&turn.abs()) && near(leaves.length()) && near(arrives.length());
    let halves = (leaves.angle_to(to - from) - turn / 2.0).abs() < SAME_ARM;
    (sound && halves).then_some(EdgeShape::Arc { radius, large: false, sweep: turn > 0.0 })
}

/// The arc that two consecutive arcs of one circle form together, if it is at most half a circle.
fn one_arc((from, a, via): (DVec2, EdgeShape, DVec2), (b, to): (EdgeShape, DVec2)) -> Option<EdgeShape> {
    let (one, other) = (curve::arc(from, a, via)?, curve::arc(via, b, to)?);
    let turn = one.turn + other.turn;
    let radius = (one.radius + other.radius) / 2.0;
    let same = one.centre.distance(other.centre) < 1e-3 * radius && one.turn * other.turn > 0.0;
    // The circle through the three points is more accurate than the radii of the parts.
    let (u, v, w) = (via - from, to - via, to - from);
    let through = u.length() * v.length() * w.length() / (2.0 * u.perp_dot(v)).abs();
    let radius = if (through / radius - 1.0).abs() < 1e-3 { through } else { radius };
    (same && turn.abs() < std::f64::consts::PI + 1e-4).then_some(EdgeShape::Arc {
        radius,
        large: turn.abs() > std::f64::consts::PI,
        sweep: turn > 0.0,
    })
}

/// Marks the edges at whose start the line runs on smoothly. Joints of two straight edges are not marked.
fn mark_smooth(edges: &mut [Edge], end: DVec2, is_closed: bool) {
    let n = edges.len();
    let ends: Vec<DVec2> = edges.iter().skip(1).map(|e| e.start).chain([end]).collect();
    let tangent = |edges: &[Edge], i: usize, at: f64| {
        let [a, b] = if at == 0.0 { [0.0, 1e-3] } else { [1.0 - 1e-3, 1.0] };
        let p = curve::points(edges[i].start, edges[i].shape, ends[i], &[a, b]);
        p[1] - p[0]
    };
    for i in 0..n {
        let before = if i > 0 { i - 1 } else { n - 1 };
        let is_end = i == 0 && !is_closed;
        let straight = edges[i].shape == EdgeShape::Line && edges[before].shape == EdgeShape::Line;
        if !is_end && !straight && n > 1 {
            let turn = tangent(edges, before, 1.0).angle_to(tangent(edges, i, 0.0));
            edges[i].smooth |= turn.abs() < SMOOTH_ANGLE;
        }
    }
}
