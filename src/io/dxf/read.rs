//! DXF bytes to a pattern.

use std::collections::{BTreeMap, BTreeSet};

use dxf::entities::{Entity, EntityType, Insert};
use dxf::{Block, Drawing, Point};
use glam::{DMat2, DVec2};

use super::clean::{self, Clean};
use super::drawn::{Drawn, DrawnLine, LineShape, Placing};
use super::{layer, pieces, units};
use crate::geometry::words::{Words, words};
use crate::io::Limits;
use crate::io::pattern_file::{PatternFileError, ReadPattern};
use crate::io::rul::RuleTable;
use crate::io::scale::DrawingUnit;
use crate::io::trace;
use crate::pattern::{Edge, EdgeShape};

/// Reads a pattern. `unit`, if given, overrides the unit that the file states.
///
/// # Errors
/// What cannot be read, with its line; a value over one of the [`Limits`]; or a question when the unit is not known.
pub fn read(bytes: &[u8], unit: Option<DrawingUnit>) -> Result<ReadPattern, PatternFileError> {
    read_with_rules(bytes, unit, None)
}

/// Reads a pattern like [`read`], with the grade rules of the table that came beside it.
///
/// # Errors
/// As for [`read`].
pub fn read_with_rules(
    bytes: &[u8],
    unit: Option<DrawingUnit>,
    rules: Option<&RuleTable>,
) -> Result<ReadPattern, PatternFileError> {
    let mut clean = clean::clean(bytes)?;
    let drawing = Drawing::load_with_encoding(&mut clean.text.as_bytes(), encoding_rs::UTF_8)
        .map_err(|e| PatternFileError::Whole(words!("no sound DXF: {why}", why = e.to_string())))?;
    let mut notes = std::mem::take(&mut clean.notes);
    let blocks: Vec<&Block> = drawing.blocks().filter(|b| !b.name.starts_with(['*', '$'])).collect();
    check_nesting(&blocks)?;
    let loose = drawn("drawing", drawing.entities(), &mut notes)?;
    let mut all = Vec::new();
    for (block, insert) in blocks.iter().zip(inserts(&blocks, &drawing, &mut notes)?) {
        let mut contents = drawn(&block.name, block.entities.iter(), &mut notes)?;
        if let Some(insert) = insert {
            contents.transform(&placed(insert, &block.base_point, &mut notes));
        }
        all.push(contents);
    }
    let texts: Vec<String> =
        all.iter().chain([&loose]).flat_map(|d| d.texts.iter().map(|(_, text, _)| text.clone())).collect();
    if all.iter().all(|d| d.lines.is_empty()) {
        all = pieces::told_apart(loose)?;
    }
    let largest = pieces::largest(&all);
    if largest.max_element() <= 0.0 {
        return Err(nothing(&clean, &notes));
    }
    let unit = match unit {
        Some(unit) => unit,
        None => {
            let (unit, note) = units::unit(&clean, &texts, largest)?;
            notes.extend(note);
            unit
        }
    };
    let limits = Limits::default();
    let scale = Placing { matrix: DMat2::from_diagonal(DVec2::splat(unit.metres())), offset: DVec2::ZERO };
    for contents in &mut all {
        contents.transform(&scale);
        contents.check(limits.pattern_coordinate)?;
    }
    let traced = pieces::traced(all, rules, &mut notes);
    if traced.is_empty() {
        return Err(nothing(&clean, &notes));
    }
    if traced.len() > limits.pieces {
        let (count, most) = (traced.len(), limits.pieces);
        let words = words!("{count} pieces; {most} are allowed", count, most);
        return Err(PatternFileError::OverLimit(words));
    }
    let (mut pattern, more) = trace::pattern(traced);
    pattern.sizes = rules.map(|table| table.sizes.clone()).unwrap_or_default();
    notes.extend(more);
    Ok(ReadPattern { pattern, notes })
}

fn nothing(clean: &Clean, notes: &[Words]) -> PatternFileError {
    let words = match clean.entities {
        0 => words!("there is nothing drawn in it"),
        n => words!("there is no closed line among the {n} shapes and texts in it", n),
    };
    PatternFileError::Whole(Words::joined(std::iter::once(&words).chain(notes).cloned(), "; "))
}

/// Refuses blocks nested too deep, which includes blocks that contain each other.
fn check_nesting(blocks: &[&Block]) -> Result<(), PatternFileError> {
    let limits = Limits::default();
    let children: BTreeMap<&str, BTreeSet<&str>> = blocks
        .iter()
        .map(|block| {
            let inside = block.entities.iter().filter_map(|e| match &e.specific {
                EntityType::Insert(insert) => Some(insert.name.as_str()),
                _ => None,
            });
            (block.name.as_str(), inside.collect())
        })
        .collect();
    // Blocks at the current depth that insert others; the depth grows by one each round.
    let mut level: BTreeSet<&str> =
        children.iter().filter(|(_, c)| !c.is_empty()).map(|(&name, _)| name).collect();
    for _ in 0..limits.block_depth {
        level = level.iter().filter_map(|name| children.get(name)).flatten().copied().collect();
        level.retain(|name| children.get(name).is_some_and(|c| !c.is_empty()));
        if level.is_empty() {
            return Ok(());
        }
    }
    let names: Vec<&str> = level.into_iter().take(3).collect();
    Err(PatternFileError::OverLimit(words!(
        "block {names}: blocks inside blocks without end, or more than {most} deep",
        names = names.join(", "),
        most = limits.block_depth
    )))
}

/// The insert that places each block, if there is one. Where several blocks share a name, the n-th block takes the n-th insert,
/// provided that there are as many inserts as blocks.
fn inserts<'a>(
    blocks: &[&Block],
    drawing: &'a Drawing,
    notes: &mut Vec<Words>,
) -> Result<Vec<Option<&'a Insert>>, PatternFileError> {
    let key = |name: &str| name.to_uppercase();
    let mut by_name: BTreeMap<String, Vec<&Insert>> = BTreeMap::new();
    let mut copies = 0u64;
    let limits = Limits::default();
    for entity in drawing.entities() {
        if let EntityType::Insert(insert) = &entity.specific {
            copies +=
                u64::from(insert.row_count.unsigned_abs()) * u64::from(insert.column_count.unsigned_abs());
            by_name.entry(key(&insert.name)).or_default().push(insert);
        }
    }
    if copies > limits.pieces as u64 {
        let most = limits.pieces;
        let words = words!("blocks are inserted {copies} times; {most} pieces are allowed", copies, most);
        return Err(PatternFileError::OverLimit(words));
    }
    let mut same: BTreeMap<String, usize> = BTreeMap::new();
    for block in blocks {
        *same.entry(key(&block.name)).or_default() += 1;
    }
    let mut met: BTreeMap<String, usize> = BTreeMap::new();
    let mut found = Vec::new();
    for block in blocks {
        let name = key(&block.name);
        let of_name = by_name.get(&name).map_or(&[][..], Vec::as_slice);
        let order = met.entry(name.clone()).or_default();
        let insert = if of_name.len() == same[&name] { of_name.get(*order).copied() } else { None };
        if same[&name] == 1 && of_name.len() > 1 {
            let (name, n) = (&block.name, of_name.len());
            notes.push(words!("{name}: placed {n} times, read once", name, n));
        }
        found.push(insert.or_else(|| (same[&name] == 1).then(|| of_name.first().copied()).flatten()));
        *order += 1;
    }
    Ok(found)
}

fn placed(insert: &Insert, base: &Point, notes: &mut Vec<Words>) -> Placing {
    let (x, mut y) = (insert.x_scale_factor, insert.y_scale_factor);
    if (x.abs() - y.abs()).abs() > 1e-9 * x.abs() || x == 0.0 {
        let name = &insert.name;
        notes.push(words!("{name}: stretched when inserted; read as it is in its block", name));
        return Placing { matrix: DMat2::IDENTITY, offset: DVec2::ZERO };
    }
    if y == 0.0 {
        y = x;
    }
    let matrix = DMat2::from_angle(insert.rotation.to_radians()) * DMat2::from_diagonal(DVec2::new(x, y));
    Placing { matrix, offset: at(&insert.location) - matrix * at(base) }
}

/// The shapes and texts of a block.
fn drawn<'a>(
    name: &str,
    entities: impl Iterator<Item = &'a Entity>,
    notes: &mut Vec<Words>,
) -> Result<Drawn, PatternFileError> {
    let mut drawn = Drawn { name: readable(name), ..Drawn::default() };
    let mut nested = 0;
    for entity in entities {
        let layer = layer_number(&entity.common.layer);
        if layer.is_some_and(|l| layer::COPIES.contains(&l)) {
            continue;
        }
        let mut line = |shape, is_closed| drawn.lines.push(DrawnLine { layer, shape, is_closed });
        match &entity.specific {
            EntityType::Line(l) => line(LineShape::Points(vec![at(&l.p1), at(&l.p2)]), false),
            EntityType::Polyline(poly) => {
                let vertices = poly.vertices().map(|v| (at(&v.location), v.bulge));
                line(shape(vertices.collect(), poly.is_closed()), poly.is_closed());
            }
            EntityType::LwPolyline(poly) => {
                let vertices = poly.vertices.iter().map(|v| (DVec2::new(v.x, v.y), v.bulge));
                line(shape(vertices.collect(), poly.is_closed()), poly.is_closed());
            }
            EntityType::Arc(arc) => {
                let [from, to] = [arc.start_angle, arc.end_angle].map(f64::to_radians);
                let turn = (to - from).rem_euclid(std::f64::consts::TAU);
                let on = |angle: f64| at(&arc.center) + DVec2::from_angle(angle) * arc.radius;
                let shape =
                    EdgeShape::Arc { radius: arc.radius, large: turn > std::f64::consts::PI, sweep: true };
                line(
                    LineShape::Edges(vec![Edge { start: on(from), shape, ..Edge::default() }], on(to)),
                    false,
                );
            }
            EntityType::Circle(circle) => {
                let half = |side: f64| Edge {
                    start: at(&circle.center) + DVec2::X * circle.radius * side,
                    shape: EdgeShape::Arc { radius: circle.radius, large: false, sweep: true },
                    smooth: true,
                    ..Edge::default()
                };
                let edges = vec![half(1.0), half(-1.0)];
                let end = edges[0].start;
                line(LineShape::Edges(edges, end), true);
            }
            EntityType::ModelPoint(point) => drawn.points.push((layer, at(&point.location))),
            EntityType::Text(text) => drawn.texts.push((layer, readable(&text.value), at(&text.location))),
            EntityType::MText(text) => {
                let whole = text.extended_text.concat() + &text.text;
                drawn.texts.push((layer, readable(&whole), at(&text.insertion_point)));
            }
            EntityType::Insert(_) => nested += 1,
            _ => {}
        }
    }
    if nested > 0 && !drawn.lines.is_empty() {
        notes.push(words!("{name}: {n} blocks inside it were left out", name, n = nested));
    }
    let limits = Limits::default();
    let segments: usize = drawn.lines.iter().map(|l| l.shape.points().len()).sum();
    if segments > limits.path_segments {
        let (count, most) = (segments, limits.path_segments);
        let words = words!("block {name}: {count} points; {most} are allowed", name, count, most);
        return Err(PatternFileError::OverLimit(words));
    }
    Ok(drawn)
}

fn at(p: &Point) -> DVec2 {
    DVec2::new(p.x, p.y)
}

/// The geometry of vertices given as point and bulge: a polyline when all bulges are 0, else lines and arcs. The bulge is the
/// tangent of a quarter of the arc's angle, positive when counter-clockwise.
fn shape(vertices: Vec<(DVec2, f64)>, is_closed: bool) -> LineShape {
    if vertices.iter().all(|(_, bulge)| *bulge == 0.0) {
        return LineShape::Points(vertices.into_iter().map(|(p, _)| p).collect());
    }
    let n = vertices.len();
    let end = vertices[if is_closed { 0 } else { n - 1 }].0;
    let count = if is_closed { n } else { n - 1 };
    let edges = (0..count).map(|i| {
        let ((start, bulge), (to, _)) = (vertices[i], vertices[(i + 1) % n]);
        let radius = start.distance(to) * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
        let shape = match bulge {
            0.0 => EdgeShape::Line,
            _ => EdgeShape::Arc { radius, large: bulge.abs() > 1.0, sweep: bulge > 0.0 },
        };
        Edge { start, shape, ..Edge::default() }
    });
    LineShape::Edges(edges.collect(), end)
}

/// The first number in a layer's name: "1", "01", "L1" and "LAYER_1" are layer 1.
fn layer_number(name: &str) -> Option<u32> {
    let digits = name.trim_start_matches(|c: char| !c.is_ascii_digit());
    digits.parse().ok()
}

/// `text` without control characters, cut to the longest name that [`Limits`] allows.
fn readable(text: &str) -> String {
    let limit = Limits::default().name_bytes;
    let mut short = String::new();
    for c in unescaped(text.trim()).chars().filter(|c| !c.is_control()) {
        if short.len() + c.len_utf8() > limit {
            break;
        }
        short.push(c);
    }
    short
}

/// `text` with the letters decoded that R12 writes as `\U+00E9`.
fn unescaped(text: &str) -> String {
    let mut parts = text.split("\\U+");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let letter = part.get(..4).and_then(|hex| char::from_u32(u32::from_str_radix(hex, 16).ok()?));
        match letter {
            Some(letter) => {
                out.push(letter);
                out.push_str(&part[4..]);
            }
            None => {
                out.push_str("\\U+");
                out.push_str(part);
            }
        }
    }
    out
}

#[cfg(test)]
#[path = "read_tests.rs"]
mod tests;
