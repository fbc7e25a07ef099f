//! Makes pieces of blocks: decides by its layer what each line of a block means.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;

use super::drawn::{Drawn, DrawnLine, LineShape};
use super::layer;
use crate::geometry::words::{Words, words};
use crate::io::Limits;
use crate::io::pattern_file::PatternFileError;
use crate::io::rul::RuleTable;
use crate::io::trace::Traced;
use crate::io::trace::contour::Contour;
use crate::io::trace::fit::{self, Knot};
use crate::pattern::piece::flattened_loop;
use crate::pattern::{Edge, InternalLine};

/// Largest distance between two line ends that are joined, metres.
const MEETING: f64 = 1e-4;
/// Largest distance (in x and in y, metres) between a corner or curve mark and the point of a line that it marks.
const SAME_POINT: f64 = 2e-5;
/// Largest distance between a point and the text that numbers its grade rule, metres.
const AT_POINT: f64 = 1e-3;
/// Largest number of open parts from which outlines are joined; a block with more keeps them open, as joining takes quadratic
/// time.
const MOST_PARTS: usize = 2000;
/// Flattening tolerance of curves where shapes are compared, metres.
const CHORDS: f64 = 5e-4;
/// The name given to internal lines on the layer of mirror lines.
const FOLD: &str = "fold";
/// Prefix of the names given to internal lines on other layers; the layer number follows.
const OTHER: &str = "layer ";

/// Width and height of the largest piece of the drawing, in the drawing's units.
pub fn largest(all: &[Drawn]) -> DVec2 {
    let sizes = all.iter().filter_map(|drawn| {
        let closed =
            |l: &&DrawnLine| l.layer == Some(layer::BOUNDARY) || l.layer == Some(layer::SEAM) || l.is_closed;
        let points = |lines: Vec<&DrawnLine>| lines.iter().flat_map(|l| l.shape.points()).collect::<Vec<_>>();
        let mut of_piece = points(drawn.lines.iter().filter(closed).collect());
        if of_piece.is_empty() {
            of_piece = points(drawn.lines.iter().collect());
        }
        let (lower, upper) = Contour::new(of_piece).bounds();
        (upper - lower).is_finite().then_some(upper - lower)
    });
    sizes.fold(DVec2::ZERO, |a, b| if b.max_element() > a.max_element() { b } else { a })
}

/// Splits a drawing without blocks into pieces: each closed line that is inside no other becomes one, with everything inside it.
/// Where closed lines are on the boundary layer, only those are taken for outlines.
pub fn told_apart(loose: Drawn) -> Result<Vec<Drawn>, PatternFileError> {
    let closed = |l: &DrawnLine| l.is_closed && l.shape.points().len() > 1;
    let on_boundary = |l: &DrawnLine| closed(l) && l.layer == Some(layer::BOUNDARY);
    let has_layers = loose.lines.iter().any(on_boundary);
    let mut outer: Vec<(Contour, DrawnLine)> = Vec::new();
    let mut rest = Vec::new();
    for line in loose.lines {
        if if has_layers { on_boundary(&line) } else { closed(&line) } {
            outer.push((Contour::coarse(line.shape.points()), line));
        } else {
            rest.push(line);
        }
    }
    let limits = Limits::default();
    if outer.len() > limits.contours {
        let (count, most) = (outer.len(), limits.contours);
        let words = words!("{count} closed lines; {most} are allowed", count, most);
        return Err(PatternFileError::OverLimit(words));
    }
    outer.sort_by(|a, b| b.0.signed_area().abs().total_cmp(&a.0.signed_area().abs()));
    let mut pieces: Vec<(Contour, Drawn)> = Vec::new();
    for (contour, line) in outer {
        match pieces.iter_mut().find(|(around, _)| around.surrounds(&contour)) {
            Some((_, piece)) => piece.lines.push(line),
            None => {
                let name = format!("{} {}", loose.name, pieces.len() + 1);
                pieces.push((contour, Drawn { name, lines: vec![line], ..Drawn::default() }));
            }
        }
    }
    let around = |pieces: &mut [(Contour, Drawn)], p: DVec2| {
        pieces.iter_mut().position(|(contour, _)| contour.is_near(p, 1e-6))
    };
    for line in rest {
        let first = line.shape.points().first().copied().unwrap_or_default();
        if let Some(i) = around(&mut pieces, first) {
            pieces[i].1.lines.push(line);
        }
    }
    for point in loose.points {
        if let Some(i) = around(&mut pieces, point.1) {
            pieces[i].1.points.push(point);
        }
    }
    for text in loose.texts {
        if let Some(i) = around(&mut pieces, text.2) {
            pieces[i].1.texts.push(text);
        }
    }
    Ok(pieces.into_iter().map(|(_, drawn)| drawn).collect())
}

/// The piece of each block, in metres. A block without a closed line gives a note instead.
pub fn traced(all: Vec<Drawn>, rules: Option<&RuleTable>, notes: &mut Vec<Words>) -> Vec<Traced> {
    let mut names: BTreeMap<String, usize> = BTreeMap::new();
    let mut traced = Vec::new();
    for drawn in all {
        if drawn.lines.is_empty() {
            continue;
        }
        let mut name = drawn.piece_name();
        let count = names.entry(name.clone()).or_default();
        *count += 1;
        if *count > 1 {
            name = format!("{name} {count}");
        }
        match piece(&drawn, name.clone(), notes) {
            Some(mut piece) => {
                if let Some(rules) = rules {
                    notes.extend(piece.take_rules(&drawn, rules));
                }
                traced.push(piece);
            }
            None => notes.push(words!("{name}: it has no closed line and was left out", name)),
        }
    }
    traced
}

impl Drawn {
    /// The name of the piece: that of the text "PIECE NAME:", else a text on the layer of annotations, else the name of the
    /// block.
    fn piece_name(&self) -> String {
        let keyed = self.texts.iter().find_map(|(_, text, _)| {
            let (key, value) = text.split_once(':')?;
            (key.trim().eq_ignore_ascii_case("PIECE NAME") && !value.trim().is_empty())
                .then(|| value.trim().to_owned())
        });
        let annotation = || {
            let mut texts = self.texts.iter().filter(|t| t.0 == Some(layer::ANNOTATION));
            texts.find(|t| !t.1.is_empty()).map(|t| t.1.clone())
        };
        keyed.or_else(annotation).unwrap_or_else(|| self.name.clone())
    }
}

/// A closed line with its shape and its area.
struct Loop {
    edges: Vec<Edge>,
    contour: Contour,
}

fn piece(drawn: &Drawn, name: String, notes: &mut Vec<Words>) -> Option<Traced> {
    let knots = Knots::of(drawn);
    let mut loops: BTreeMap<Option<u32>, Vec<Loop>> = BTreeMap::new();
    let mut open: Vec<(Option<u32>, Vec<Edge>, DVec2)> = Vec::new();
    for line in chained(&drawn.lines) {
        if line.is_closed {
            let edges = knots.closed(&line.shape);
            if edges.len() < 2 {
                notes.push(words!("{name}: a closed line of fewer than three points was left out", name));
                continue;
            }
            let contour = Contour::coarse(flattened_loop(&edges, CHORDS));
            loops.entry(line.layer).or_default().push(Loop { edges, contour });
        } else if let Some((edges, end)) = knots.open(&line.shape) {
            open.push((line.layer, edges, end));
        }
    }
    for of_layer in loops.values_mut() {
        of_layer.sort_by(|a, b| b.contour.signed_area().abs().total_cmp(&a.contour.signed_area().abs()));
    }
    let boundary = first_of(&mut loops, &[layer::BOUNDARY, layer::SEAM, layer::INTERNAL])
        .or_else(|| loops.values_mut().find(|l| !l.is_empty()).map(|l| l.remove(0)))?;
    if boundary.contour.signed_area() == 0.0 {
        notes.push(words!("{name}: its outline surrounds nothing", name));
    }
    let seam = [layer::SEAM, layer::INTERNAL].into_iter().find_map(|l| {
        let of_layer = loops.get_mut(&Some(l))?;
        let is_seam = |line: &Loop| l == layer::SEAM || line.contour.is_seam_line_in(&boundary.contour);
        let at = of_layer.iter().position(is_seam)?;
        Some(of_layer.remove(at))
    });
    let (outline, cut_line) = match seam {
        Some(seam) => (seam.edges, boundary.edges),
        None => (boundary.edges, Vec::new()),
    };
    let mut traced = Traced { name, outline, cut_line, ..Traced::default() };
    for (of, all) in loops {
        for line in all {
            let is_hole = of == Some(layer::CUT_OUT) || of == Some(layer::BOUNDARY);
            if is_hole && boundary.contour.surrounds(&line.contour) {
                traced.holes.push(line.edges);
            } else {
                let end = line.edges[0].start;
                traced.lines.push(InternalLine {
                    edges: line.edges,
                    end,
                    name: line_name(of),
                    ..InternalLine::default()
                });
            }
        }
    }
    traced.take_open(open, notes);
    let is_notch = |l: Option<u32>| l.is_some_and(|l| l == layer::NOTCH || layer::NOTCHES.contains(&l));
    traced.notches.extend(drawn.points.iter().filter(|p| is_notch(p.0)).map(|p| p.1));
    Some(traced)
}

fn first_of(loops: &mut BTreeMap<Option<u32>, Vec<Loop>>, layers: &[u32]) -> Option<Loop> {
    layers
        .iter()
        .find_map(|l| loops.get_mut(&Some(*l)).filter(|all| !all.is_empty()).map(|all| all.remove(0)))
}

/// The name of an internal line read from layer `of`: empty for the layer of internal lines or an unknown layer.
fn line_name(of: Option<u32>) -> String {
    match of {
        Some(layer::MIRROR) => FOLD.to_owned(),
        Some(layer::INTERNAL) | None => String::new(),
        Some(other) => format!("{OTHER}{other}"),
    }
}

/// The layer to write an internal line called `name` on; None where DXF cannot keep the name.
pub fn line_layer(name: &str) -> Option<u32> {
    match name {
        "" => Some(layer::INTERNAL),
        FOLD => Some(layer::MIRROR),
        other => {
            let number = other.strip_prefix(OTHER)?.parse().ok()?;
            layer::OTHERS.contains(&number).then_some(number)
        }
    }
}

impl Traced {
    /// Gives the points at texts such as "# 7" the rule of that number. Returns a note on those that found no point or rule.
    fn take_rules(&mut self, drawn: &Drawn, table: &RuleTable) -> Option<Words> {
        let number = |text: &str| text.trim().strip_prefix('#')?.trim().parse::<u32>().ok();
        let labels = drawn.texts.iter().filter_map(|(_, text, at)| Some((number(text)?, *at)));
        let (mut lost, mut unknown) = (0_usize, 0_usize);
        for (number, at) in labels {
            let Some(rule) = table.rules.get(&number) else {
                unknown += 1;
                continue;
            };
            let Self { outline, holes, lines, .. } = self;
            let closed = outline.iter_mut().chain(holes.iter_mut().flatten());
            let closed = closed.map(|edge| (edge.start, &mut edge.rule));
            let open = lines.iter_mut().flat_map(|line| {
                let end = [(line.end, &mut line.end_rule)];
                line.edges.iter_mut().map(|edge| (edge.start, &mut edge.rule)).chain(end)
            });
            let near = closed.chain(open).map(|(p, slot)| (p.distance(at), slot));
            match near.filter(|(d, _)| *d <= AT_POINT).min_by(|a, b| a.0.total_cmp(&b.0)) {
                Some((_, slot)) => *slot = Some(rule.clone()),
                None => lost += 1,
            }
        }
        let mut told = Vec::new();
        if lost > 0 {
            told.push(words!(
                "{n} grade rules are at no end of an edge; these points follow those beside them",
                n = lost
            ));
        }
        if unknown > 0 {
            told.push(words!("{n} grade rules are not in the table", n = unknown));
        }
        (!told.is_empty()).then(|| Words::plain(&self.name).and(": ", Words::joined(told, "; ")))
    }

    fn take_open(&mut self, open: Vec<(Option<u32>, Vec<Edge>, DVec2)>, notes: &mut Vec<Words>) {
        for (of, edges, end) in open {
            match of {
                Some(layer::GRAIN) if self.grainline.is_none() => {
                    self.grainline = Some([edges[0].start, end])
                }
                Some(layer::GRAIN) => {}
                // A slit notch is a line with one end on the outline; that end is the notch.
                Some(l) if l == layer::NOTCH || layer::NOTCHES.contains(&l) => {
                    let outline = Contour::coarse(flattened_loop(&self.outline, CHORDS));
                    let start = edges[0].start;
                    let nearer = if outline.distance(start) <= outline.distance(end) { start } else { end };
                    self.notches.push(nearer);
                }
                _ => {
                    if of == Some(layer::BOUNDARY) || of == Some(layer::CUT_OUT) {
                        notes.push(words!(
                            "{name}: a line to cut along is not closed; taken as an internal line",
                            name = self.name
                        ));
                    }
                    self.lines.push(InternalLine {
                        edges,
                        end,
                        name: line_name(of),
                        ..InternalLine::default()
                    });
                }
            }
        }
    }
}

/// Joins open outline and cut-out lines of one layer whose ends meet, and closes lines whose two ends meet.
fn chained(lines: &[DrawnLine]) -> Vec<DrawnLine> {
    let joins = |l: &DrawnLine| {
        !l.is_closed && matches!(l.layer, Some(layer::BOUNDARY | layer::SEAM | layer::CUT_OUT))
    };
    let mut done: Vec<DrawnLine> = lines.iter().filter(|l| !joins(l)).cloned().collect();
    let mut open: Vec<DrawnLine> = lines.iter().filter(|l| joins(l)).cloned().collect();
    // An outline has no more parts than this; joining more would only take long.
    let mut tries = if open.len() > MOST_PARTS { 0 } else { 2 * open.len() };
    while let Some(mut line) = open.pop() {
        loop {
            let (start, end) = line.shape.ends();
            if line.shape.points().len() > 1 && start.distance(end) < MEETING {
                line.shape.close();
                line.is_closed = true;
                break;
            }
            if tries == 0 {
                break;
            }
            tries -= 1;
            let meets = |other: &DrawnLine| {
                let (a, b) = other.shape.ends();
                other.layer == line.layer && (a.distance(end) < MEETING || b.distance(end) < MEETING)
            };
            let Some(next) = open.iter().position(meets) else { break };
            let mut next = open.swap_remove(next).shape;
            if next.ends().0.distance(end) >= MEETING {
                next = next.reversed();
            }
            line.shape = line.shape.joined(next);
        }
        done.push(line);
    }
    for line in &mut done {
        let (start, end) = line.shape.ends();
        if line.is_closed {
            line.shape.close();
        } else if line.layer != Some(layer::GRAIN)
            && line.shape.points().len() > 2
            && start.distance(end) < MEETING
        {
            line.shape.close();
            line.is_closed = true;
        }
    }
    done
}

impl LineShape {
    fn ends(&self) -> (DVec2, DVec2) {
        match self {
            Self::Points(p) => {
                (p.first().copied().unwrap_or_default(), p.last().copied().unwrap_or_default())
            }
            Self::Edges(edges, end) => (edges.first().map_or(*end, |e| e.start), *end),
        }
    }

    /// Removes the end point (or last edge) that repeats the first point of a closed line.
    fn close(&mut self) {
        match self {
            Self::Points(points) => {
                while points.len() > 1 && points[0].distance(points[points.len() - 1]) < MEETING {
                    points.pop();
                }
            }
            Self::Edges(edges, end) => {
                if let Some(first) = edges.first() {
                    *end = first.start;
                }
                // A last edge that starts at the first point only closes the line, which is closed already.
                if edges.len() > 1 && edges[edges.len() - 1].start.distance(*end) < MEETING {
                    edges.pop();
                }
            }
        }
    }

    fn edges(self) -> (Vec<Edge>, DVec2) {
        match self {
            Self::Edges(edges, end) => (edges, end),
            Self::Points(points) => {
                let end = points.last().copied().unwrap_or_default();
                let count = points.len().saturating_sub(1);
                let edge = |start| Edge { start, ..Edge::default() };
                (points.into_iter().take(count).map(edge).collect(), end)
            }
        }
    }

    fn reversed(self) -> Self {
        match self {
            Self::Points(points) => Self::Points(points.into_iter().rev().collect()),
            Self::Edges(edges, end) => {
                let first = edges.first().map_or(end, |e| e.start);
                let starts = edges.iter().skip(1).map(|e| e.start).chain([end]);
                let mut turned: Vec<Edge> = edges
                    .iter()
                    .zip(starts)
                    .map(|(e, start)| Edge { start, shape: e.shape.reversed(), ..e.clone() })
                    .collect();
                turned.reverse();
                Self::Edges(turned, first)
            }
        }
    }

    fn joined(self, next: Self) -> Self {
        match (self, next) {
            (Self::Points(mut a), Self::Points(b)) => {
                a.extend(b.into_iter().skip(1));
                Self::Points(a)
            }
            (a, b) => {
                let ((mut edges, _), (more, end)) = (a.edges(), b.edges());
                edges.extend(more);
                Self::Edges(edges, end)
            }
        }
    }
}

/// Marked corners and curve points of a block, hashed to grid cells of side [`SAME_POINT`].
struct Knots {
    corners: BTreeSet<[i64; 2]>,
    curves: BTreeSet<[i64; 2]>,
}

impl Knots {
    fn of(drawn: &Drawn) -> Self {
        let on = |l: u32| -> BTreeSet<[i64; 2]> {
            drawn.points.iter().filter(|p| p.0 == Some(l)).map(|p| square(p.1)).collect()
        };
        Self { corners: on(layer::CORNER), curves: on(layer::CURVE) }
    }

    fn knots(&self, points: &[DVec2]) -> Vec<Knot> {
        let told: Vec<(bool, bool)> =
            points.iter().map(|&p| (has_near(&self.corners, p), has_near(&self.curves, p))).collect();
        let knot = |&told: &(bool, bool)| match told {
            (true, true) => Knot::Smooth,
            (true, false) => Knot::Corner,
            (false, true) => Knot::Curve,
            (false, false) => Knot::Unknown,
        };
        told.iter().map(knot).collect()
    }

    fn closed(&self, shape: &LineShape) -> Vec<Edge> {
        match shape {
            LineShape::Edges(edges, _) => without_short(edges.clone(), edges.first().map(|e| e.start)),
            LineShape::Points(points) => {
                let mut points = points.clone();
                points.dedup_by(|b, a| a.distance(*b) < 1e-7);
                if points.len() < 3 { Vec::new() } else { fit::closed(&points, &self.knots(&points)) }
            }
        }
    }

    fn open(&self, shape: &LineShape) -> Option<(Vec<Edge>, DVec2)> {
        let (edges, end) = match shape {
            LineShape::Edges(edges, end) => (without_short(edges.clone(), Some(*end)), *end),
            LineShape::Points(points) => {
                let mut points = points.clone();
                points.dedup_by(|b, a| a.distance(*b) < 1e-7);
                let end = points.last().copied()?;
                if points.len() < 2 {
                    return None;
                }
                (fit::open(&points, &self.knots(&points)), end)
            }
        };
        (!edges.is_empty()).then_some((edges, end))
    }
}

/// `edges` without those of no length. `end` is where the last one ends.
fn without_short(mut edges: Vec<Edge>, end: Option<DVec2>) -> Vec<Edge> {
    let ends: Vec<Option<DVec2>> = edges.iter().skip(1).map(|e| Some(e.start)).chain([end]).collect();
    let mut ends = ends.into_iter();
    edges.retain(|e| ends.next().flatten().is_some_and(|end| end.distance(e.start) > 1e-7));
    edges
}

fn square(p: DVec2) -> [i64; 2] {
    // Fits 64 bits: coordinates are within 100 m.
    [(p.x / SAME_POINT).floor() as i64, (p.y / SAME_POINT).floor() as i64]
}

fn has_near(squares: &BTreeSet<[i64; 2]>, p: DVec2) -> bool {
    let [x, y] = square(p);
    !squares.is_empty() && (-1..=1).any(|i| (-1..=1).any(|j| squares.contains(&[x + i, y + j])))
}
