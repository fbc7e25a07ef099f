//! Writes a pattern as DXF R12 in millimetres: one block for each piece, in the layers of ASTM D6673, a superset of those of
//! AAMA-292.

use std::collections::BTreeSet;

use dxf::entities::{Entity, EntityType, Insert, Line, ModelPoint, Polyline, Text, Vertex};
use dxf::enums::AcadVersion;
use dxf::tables::Layer;
use dxf::{Block, Drawing, Point};
use glam::DVec2;

use super::layer;
use super::pieces::line_layer;
use crate::geometry::words::words;
use crate::io::rul::RuleTable;
use crate::io::trace::contour::Contour;
use crate::io::trace::fit::Knot;
use crate::io::trace::{self, Traced, allowance, sample};
use crate::io::written::{self, Part};
use crate::io::{ClothSheet, Written};
use crate::pattern::{Pattern, Piece};

/// Parts of a pattern that this format can hold.
const HOLDS: [Part; 9] = [
    Part::Curves,
    Part::SmoothPoints,
    Part::Holes,
    Part::Lines,
    Part::Notches,
    Part::Grainline,
    Part::Allowance,
    Part::CutLine,
    Part::Sizes,
];
/// Millimetres in a metre.
const SCALE: f64 = 1000.0;
/// Height of the letters of texts, millimetres.
const LETTERS: f64 = 6.0;
/// Largest number of characters of a block's name in R12.
const LONGEST_NAME: usize = 31;

/// Writes the pieces at their positions in the pattern plane. Curves become polylines within 0.05 mm; this program's reader fits
/// the original curves to them again.
pub fn write(pattern: &Pattern) -> Written {
    write_on(pattern, None)
}

/// Writes the pieces like [`write`], on `cloth` if there is one: its border and words on the layer of annotations.
pub fn write_on(pattern: &Pattern, cloth: Option<&ClothSheet>) -> Written {
    let mut drawing = Drawing::new();
    drawing.header.version = AcadVersion::R12;
    drawing.header.drawing_code_page = "ANSI_1252".to_owned();
    for number in [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 14, layer::ANNOTATION] {
        drawing.add_layer(Layer { name: number.to_string(), ..Layer::default() });
    }
    let mut names = BTreeSet::new();
    let mut rules = RuleTable { sizes: pattern.sizes.clone(), ..RuleTable::default() };
    let corners: Vec<DVec2> =
        pattern.pieces.values().flat_map(|piece| trace::on_table(piece).bounds()).collect();
    let (lower, upper) = Contour::new(corners).bounds();
    drawing.header.minimum_drawing_extents = point(lower);
    drawing.header.maximum_drawing_extents = point(upper);
    for (id, piece) in &pattern.pieces {
        let name = block_name(&piece.name, &mut names);
        let size = cloth.and_then(|cloth| cloth.sizes.get(id)).map(String::as_str);
        let entities = entities(&mut drawing, piece, size, &mut rules);
        let block = Block { name: name.clone(), layer: "1".to_owned(), entities, ..Block::default() };
        drawing.add_block(block);
        drawing.add_entity(on(layer::BOUNDARY, EntityType::Insert(Insert { name, ..Insert::default() })));
    }
    let is_graded = !pattern.sizes.is_empty();
    let sample = format!("SAMPLE SIZE: {}", sample_size(&rules));
    let mut words = vec!["STYLE NAME: PATTERN", "AUTHOR: TOILE", &sample, "UNITS: METRIC"];
    words.extend(is_graded.then_some("GRADE RULE TABLE: PATTERN"));
    for (i, words) in words.iter().enumerate() {
        let at = DVec2::new(0.0, -2.0 * LETTERS * i as f64);
        drawing.add_entity(text(layer::BOUNDARY, at, words));
    }
    cloth.into_iter().for_each(|cloth| draw_cloth(&mut drawing, cloth));
    let mut bytes = Vec::new();
    let mut holds = HOLDS.to_vec();
    let mut lines = pattern.pieces.values().flat_map(|piece| &piece.lines);
    if lines.all(|line| line_layer(&line.name).is_some()) {
        holds.push(Part::LineNames);
    }
    let mut left_out = written::left_out(pattern, &holds);
    // Saving to memory fails only for what R12 cannot hold, and this drawing has nothing of that kind.
    if let Err(error) = drawing.save(&mut bytes) {
        left_out.push(words!("the drawing could not be written: {why}", why = error.to_string()));
    }
    let rules = is_graded.then(|| rules.write("PATTERN"));
    Written { bytes: without_times(&bytes), left_out, rules }
}

/// The size that the drawing is in.
fn sample_size(rules: &RuleTable) -> &str {
    if rules.sizes.is_empty() { "1" } else { rules.sizes.base_name() }
}

/// Removes the header's timestamps (`$TD…`), so that equal patterns give equal bytes.
fn without_times(bytes: &[u8]) -> Vec<u8> {
    let lines: Vec<&[u8]> = bytes.split_inclusive(|b| *b == b'\n').collect();
    let mut out = Vec::with_capacity(bytes.len());
    let mut i = 0;
    while i < lines.len() {
        let is_time =
            lines[i].trim_ascii() == b"9" && lines.get(i + 1).is_some_and(|l| l.starts_with(b"$TD"));
        if is_time {
            // A variable is four lines: 9, its name, 40, its value.
            i += 4;
        } else {
            out.extend_from_slice(lines[i]);
            i += 1;
        }
    }
    out
}

/// A block name for R12: capital letters, digits, "_" and "-", different from all in `taken`.
fn block_name(name: &str, taken: &mut BTreeSet<String>) -> String {
    let plain: String = name
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() || c == '-' { c.to_ascii_uppercase() } else { '_' })
        .take(LONGEST_NAME - 5)
        .collect();
    let plain = if plain.is_empty() { "PIECE".to_owned() } else { plain };
    let mut unique = plain.clone();
    let mut number = 2;
    while !taken.insert(unique.clone()) {
        unique = format!("{plain}_{number}");
        number += 1;
    }
    unique
}

fn draw_cloth(drawing: &mut Drawing, cloth: &ClothSheet) {
    let corners = cloth.corners();
    for (i, &from) in corners.iter().enumerate() {
        let line = Line { p1: point(from), p2: point(corners[(i + 1) % corners.len()]), ..Line::default() };
        drawing.add_entity(on(layer::ANNOTATION, EntityType::Line(line)));
    }
    for (i, words) in cloth.words.iter().enumerate() {
        // Below the words that tell about the whole file.
        let at = DVec2::new(0.0, -2.0 * LETTERS * (i + 6) as f64);
        drawing.add_entity(text(layer::ANNOTATION, at, words));
    }
}

/// The entities of a piece, which is in `size` if that is given.
fn entities(drawing: &mut Drawing, piece: &Piece, size: Option<&str>, rules: &mut RuleTable) -> Vec<Entity> {
    let Traced { name, outline, cut_line, holes, lines, notches, grainline } = trace::on_table(piece);
    let mut sheet = Sheet { drawing, entities: Vec::new() };
    let cut = if cut_line.is_empty() { &outline } else { &cut_line };
    sheet.closed(layer::BOUNDARY, cut);
    if !cut_line.is_empty() {
        sheet.closed(layer::SEAM, &outline);
    }
    for hole in &holes {
        sheet.closed(layer::CUT_OUT, hole);
    }
    for line in &lines {
        let (mut points, mut knots) = sample::open(&line.edges, line.end);
        points.push(line.end);
        knots.push(Knot::Corner);
        sheet.polyline(line_layer(&line.name).unwrap_or(layer::INTERNAL), &points, &knots, false);
    }
    for at in notches {
        sheet.notch(allowance::notch_tip(&outline, &cut_line, at));
    }
    if let Some([tail, head]) = grainline {
        let line = Line { p1: point(tail), p2: point(head), ..Line::default() };
        sheet.entities.push(on(layer::GRAIN, EntityType::Line(line)));
    }
    let closed = outline.iter().chain(holes.iter().flatten()).map(|edge| (edge.start, &edge.rule));
    let open = lines.iter().flat_map(|line| {
        let edges = line.edges.iter().map(|edge| (edge.start, &edge.rule));
        edges.chain([(line.end, &line.end_rule)])
    });
    for (at, rule) in closed.chain(open) {
        if let Some(rule) = rule {
            let number = format!("# {}", rules.number(rule));
            sheet.entities.push(text(layer::CORNER, at * SCALE, &number));
        }
    }
    let middle = Contour::new(outline.iter().map(|e| e.start).collect()).middle();
    let size = format!("SIZE: {}", size.unwrap_or(sample_size(rules)));
    let words = [format!("PIECE NAME: {name}"), size, "QUANTITY: 1".to_owned()];
    for (i, words) in words.iter().enumerate() {
        let at = middle * SCALE - DVec2::Y * (2.0 * LETTERS * i as f64);
        sheet.entities.push(text(layer::BOUNDARY, at, words));
    }
    sheet.entities
}

struct Sheet<'d> {
    drawing: &'d mut Drawing,
    entities: Vec<Entity>,
}

impl Sheet<'_> {
    fn closed(&mut self, number: u32, edges: &[crate::pattern::Edge]) {
        let (points, knots) = sample::closed(edges);
        self.polyline(number, &points, &knots, true);
    }

    fn polyline(&mut self, number: u32, points: &[DVec2], knots: &[Knot], is_closed: bool) {
        let mut line = Polyline { contains_vertices: true, ..Polyline::default() };
        line.set_is_closed(is_closed);
        for &p in points {
            line.add_vertex(self.drawing, Vertex { location: point(p), ..Vertex::default() });
        }
        self.entities.push(on(number, EntityType::Polyline(line)));
        for (&p, knot) in points.iter().zip(knots) {
            let layers: &[u32] = match knot {
                Knot::Corner | Knot::Unknown => &[layer::CORNER],
                Knot::Curve => &[layer::CURVE],
                Knot::Smooth => &[layer::CORNER, layer::CURVE],
            };
            let mark = EntityType::ModelPoint(ModelPoint { location: point(p), ..ModelPoint::default() });
            self.entities.extend(layers.iter().map(|&l| on(l, mark.clone())));
        }
    }

    fn notch(&mut self, [at, inward]: [DVec2; 2]) {
        let angle = inward.to_angle().to_degrees().rem_euclid(360.0);
        let mark = ModelPoint { location: point(at), angle, ..ModelPoint::default() };
        self.entities.push(on(layer::NOTCH, EntityType::ModelPoint(mark)));
    }
}

fn on(number: u32, shape: EntityType) -> Entity {
    let mut entity = Entity::new(shape);
    entity.common.layer = number.to_string();
    entity
}

fn point(p: DVec2) -> Point {
    Point::new(p.x * SCALE, p.y * SCALE, 0.0)
}

/// A text entity on layer `number`; `at` is in millimetres.
fn text(number: u32, at: DVec2, words: &str) -> Entity {
    let text = Text {
        location: Point::new(at.x, at.y, 0.0),
        text_height: LETTERS,
        value: words.to_owned(),
        ..Text::default()
    };
    on(number, EntityType::Text(text))
}
