//! Reads a pattern from the bytes of an SVG file.

use glam::DVec2;
use usvg::tiny_skia_path::{PathSegment, Point, Transform};

use super::clean::{self, Clean, Root, Shape};
use super::line::Line;
use super::pieces;
use crate::geometry::words::{Words, within_quotes, words};
use crate::io::Limits;
use crate::io::pattern_file::{PatternFileError, ReadPattern};
use crate::io::scale::{DrawingUnit, ScaleQuestion};
use crate::io::trace;
use crate::io::words::readable_words;
use crate::pattern::{Edge, EdgeShape};

/// Usual size of the larger side of a garment's largest piece, metres. Units that give such a size are offered as candidates.
const LIKELY: std::ops::RangeInclusive<f64> = 0.12..=2.6;
/// Largest relative difference between the scales by width and by height.
const SAME_SCALE: f64 = 0.01;

/// Reads a pattern. `unit`, if given, is the length of a user unit and overrides what the file states.
///
/// # Errors
/// What cannot be read and why; a value over one of the [`Limits`]; or a question when the unit is not known.
pub fn read(bytes: &[u8], unit: Option<DrawingUnit>) -> Result<ReadPattern, PatternFileError> {
    let Clean { text, shapes, mut notes, root } = clean::clean(bytes)?;
    let tree = usvg::Tree::from_str(&text, &usvg::Options::default()).map_err(|e| {
        PatternFileError::Whole(readable_words(words!("no sound SVG: {why}", why = e.to_string())))
    })?;
    let mut lines = Vec::new();
    let mut paths = 0;
    let mut groups = vec![tree.root().children().iter()];
    while let Some(group) = groups.last_mut() {
        match group.next() {
            None => {
                groups.pop();
            }
            Some(usvg::Node::Group(inner)) => groups.push(inner.children().iter()),
            Some(usvg::Node::Path(path)) => {
                let shape = shapes.get(path.id()).cloned().unwrap_or_default();
                lines_of(path, paths, &shape, &mut lines)?;
                paths += 1;
            }
            Some(_) => {}
        }
    }
    let origin = root.view_box.map_or(DVec2::ZERO, |[x, y, ..]| DVec2::new(x, y));
    let metres = match unit {
        Some(unit) => unit.metres(),
        None => metres_per_unit(&root, largest(&lines))?,
    };
    let limit = Limits::default().pattern_coordinate;
    for line in &mut lines {
        line.put_in_metres(origin, metres);
        let beyond = |p: DVec2| !p.is_finite() || p.abs().max_element() > limit;
        let strays = |edge: &Edge| match edge.shape {
            EdgeShape::Quadratic { control } => beyond(control),
            EdgeShape::Cubic { controls } => controls.into_iter().any(beyond),
            EdgeShape::Line | EdgeShape::Arc { .. } => false,
        };
        if line.edges.iter().any(|e| beyond(e.start) || strays(e)) || beyond(line.end) {
            let name = line.shape.name.clone().map_or_else(|| words!("a path"), Words::plain);
            return Err(PatternFileError::bad(name, words!("it reaches beyond {most} m", most = limit)));
        }
        line.tidy();
    }
    lines.retain(|line| !line.edges.is_empty());
    let frame = root.view_box.map(|[.., w, h]| DVec2::new(w, h) * metres);
    let traced = pieces::traced(lines, root.is_ours, frame, &mut notes)?;
    if traced.is_empty() {
        let why = std::iter::once(words!("there is no closed line in it")).chain(notes);
        return Err(PatternFileError::Whole(Words::joined(why, "; ")));
    }
    let limits = Limits::default();
    if traced.len() > limits.pieces {
        let (count, most) = (traced.len(), limits.pieces);
        let words = words!("{count} pieces; {most} are allowed", count, most);
        return Err(PatternFileError::OverLimit(words));
    }
    let (pattern, more) = trace::pattern(traced);
    notes.extend(more);
    Ok(ReadPattern { pattern, notes })
}

fn lines_of(
    path: &usvg::Path,
    number: usize,
    shape: &Shape,
    lines: &mut Vec<Line>,
) -> Result<(), PatternFileError> {
    let limits = Limits::default();
    let transform = path.abs_transform();
    let at = |p: Point| placed(transform, p);
    let begin = |start: DVec2| Line {
        path: number,
        shape: shape.clone(),
        edges: Vec::new(),
        end: start,
        is_closed: false,
    };
    let mut line: Option<Line> = None;
    for segment in path.data().segments() {
        let (shape, end) = match segment {
            PathSegment::MoveTo(p) => {
                lines.extend(line.take());
                line = Some(begin(at(p)));
                continue;
            }
            PathSegment::Close => {
                if let Some(mut closed) = line.take() {
                    let start = closed.edges.first().map_or(closed.end, |e| e.start);
                    if closed.end != start {
                        closed.edges.push(Edge { start: closed.end, ..Edge::default() });
                        closed.end = start;
                    }
                    closed.is_closed = true;
                    lines.push(closed);
                    line = Some(begin(start));
                }
                continue;
            }
            PathSegment::LineTo(p) => (EdgeShape::Line, at(p)),
            PathSegment::QuadTo(c, p) => (EdgeShape::Quadratic { control: at(c) }, at(p)),
            PathSegment::CubicTo(c, d, p) => (EdgeShape::Cubic { controls: [at(c), at(d)] }, at(p)),
        };
        if let Some(line) = &mut line {
            line.edges.push(Edge { start: line.end, shape, ..Edge::default() });
            line.end = end;
        }
    }
    lines.extend(line);
    lines.retain(|line| !line.edges.is_empty());
    if lines.len() > limits.path_segments || path.data().len() > limits.path_segments {
        let words = words!("more than {most} lines and curves", most = limits.path_segments);
        return Err(PatternFileError::OverLimit(words));
    }
    Ok(())
}

fn placed(t: Transform, p: Point) -> DVec2 {
    let [sx, ky, kx, sy, tx, ty] = [t.sx, t.ky, t.kx, t.sy, t.tx, t.ty].map(f64::from);
    let (x, y) = (f64::from(p.x), f64::from(p.y));
    DVec2::new(sx * x + kx * y + tx, ky * x + sy * y + ty)
}

/// Width and height of the largest closed line, or of everything where none is closed, in user units.
fn largest(lines: &[Line]) -> DVec2 {
    let size = |line: &Line| {
        let points = line.edges.iter().map(|e| e.start).chain([line.end]);
        let lower = points.clone().reduce(DVec2::min).unwrap_or_default();
        points.reduce(DVec2::max).unwrap_or_default() - lower
    };
    let is_closed = |line: &&Line| {
        line.is_closed || line.edges.first().is_some_and(|e| e.start.distance(line.end) < 1e-3)
    };
    let closed = lines.iter().filter(is_closed).map(size);
    let all = lines.iter().map(size);
    let larger = |a: DVec2, b: DVec2| if b.max_element() > a.max_element() { b } else { a };
    closed.reduce(larger).or_else(|| all.reduce(larger)).unwrap_or_default()
}

/// Metres per user unit by the root element's width, height and view box; a question where these do not tell it.
fn metres_per_unit(root: &Root, largest: DVec2) -> Result<f64, PatternFileError> {
    let ask = |why: Words| {
        let mut candidates = vec![DrawingUnit::Millimetre, DrawingUnit::Pixel];
        if root.is_old_inkscape {
            candidates.insert(0, DrawingUnit::OldPixel);
        }
        if root.is_illustrator {
            candidates.insert(0, DrawingUnit::Point);
        }
        for other in [DrawingUnit::OldPixel, DrawingUnit::Point, DrawingUnit::Centimetre, DrawingUnit::Inch] {
            if !candidates.contains(&other) {
                candidates.push(other);
            }
        }
        let likely = |unit: &DrawingUnit| LIKELY.contains(&(largest.max_element() * unit.metres()));
        if candidates.iter().any(likely) {
            candidates.retain(likely);
        }
        Err(PatternFileError::Scale(ScaleQuestion { why, largest, candidates }))
    };
    let [width, height] = [&root.width, &root.height].map(|text| text.as_deref().map(length));
    for (is_width, said, text) in [(true, width, &root.width), (false, height, &root.height)] {
        if let (Some(Length::Bad), Some(text)) = (said, text) {
            let shown: String = text.chars().take(30).collect();
            let given = within_quotes(&shown);
            let words = match is_width {
                true => words!("the width \"{given}\" is no size", given),
                false => words!("the height \"{given}\" is no size", given),
            };
            return Err(PatternFileError::bad(Words::plain("<svg>"), words));
        }
    }
    match (width, height, root.view_box) {
        (Some(Length::Metres(w)), Some(Length::Metres(h)), Some([_, _, box_w, box_h])) => {
            let (across, up) = (w / box_w, h / box_h);
            if (across / up - 1.0).abs() > SAME_SCALE {
                return ask(words!("its width and height give different scales"));
            }
            Ok(across)
        }
        (Some(Length::Metres(w)), None, Some([_, _, box_w, _])) => Ok(w / box_w),
        (None, Some(Length::Metres(h)), Some([.., box_h])) => Ok(h / box_h),
        (Some(Length::Metres(_)), _, None) | (_, Some(Length::Metres(_)), None) => {
            if root.is_old_inkscape {
                return ask(words!("it has no viewBox, and old Inkscape had other pixels"));
            }
            Ok(DrawingUnit::Pixel.metres())
        }
        (None, None, _) => ask(words!("it does not say its size")),
        _ => ask(words!("its size is in pixels or percent")),
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Length {
    Metres(f64),
    /// A size in pixels, in percent or without unit, which does not tell the scale.
    Relative,
    Bad,
}

fn length(text: &str) -> Length {
    let text = text.trim();
    let at = text
        .find(|c: char| c.is_ascii_alphabetic() && c != 'e' && c != 'E' || c == '%')
        .unwrap_or(text.len());
    let (number, unit) = text.split_at(at);
    let metres = match unit.trim() {
        "mm" => 1e-3,
        "cm" => 1e-2,
        "m" => 1.0,
        "in" => 25.4e-3,
        "pt" => 25.4e-3 / 72.0,
        "pc" => 25.4e-3 / 6.0,
        "Q" => 0.25e-3,
        "" | "px" | "%" => 0.0,
        _ => return Length::Bad,
    };
    match number.trim().parse::<f64>() {
        Ok(x) if x > 0.0 && x < 1e7 && metres > 0.0 => Length::Metres(x * metres),
        Ok(x) if x > 0.0 && x < 1e7 => Length::Relative,
        _ => Length::Bad,
    }
}

#[cfg(test)]
#[path = "read_tests.rs"]
mod tests;
