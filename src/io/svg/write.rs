//! Writes a pattern as SVG in millimetres.

use std::fmt::Write;

use glam::DVec2;

use super::{EDGES, KIND, NAME, OURS, PIECE, SMOOTH};
use crate::io::trace::contour::Contour;
use crate::io::trace::{self, Traced, allowance};
use crate::io::written::{self, Part};
use crate::io::{ClothSheet, Written};
use crate::pattern::{Edge, EdgeShape, Pattern};

/// Parts of a pattern that this format can hold.
const HOLDS: [Part; 9] = [
    Part::Curves,
    Part::SmoothPoints,
    Part::Holes,
    Part::Lines,
    Part::LineNames,
    Part::Notches,
    Part::Grainline,
    Part::Allowance,
    Part::CutLine,
];
/// Millimetres in a metre.
const SCALE: f64 = 1000.0;
/// Blank margin around the pieces, millimetres.
const MARGIN: f64 = 10.0;
/// Height of the letters of names, millimetres.
const LETTERS: f64 = 8.0;
/// Height of a line of words below the cloth of a marker, millimetres.
const LINE: f64 = 24.0;
/// Length of a notch drawn into the piece, millimetres.
const NOTCH: f64 = 4.0;
/// Length of the sides of a grainline's arrow head, millimetres.
const ARROW: f64 = 5.0;

/// Kinds of lines: name in the attributes, name of the layer, and style.
const LAYERS: [(&str, &str, &str); 6] = [
    ("cut", "Cut lines", "stroke=\"#000000\" stroke-width=\"0.6\""),
    ("seam", "Seam lines", "stroke=\"#1f5fbf\" stroke-width=\"0.4\""),
    ("hole", "Cut-outs", "stroke=\"#000000\" stroke-width=\"0.6\""),
    ("line", "Internal lines", "stroke=\"#777777\" stroke-width=\"0.4\" stroke-dasharray=\"4 2\""),
    ("notch", "Notches", "stroke=\"#000000\" stroke-width=\"0.6\""),
    ("grain", "Grainlines", "stroke=\"#777777\" stroke-width=\"0.4\""),
];

/// Writes the pieces at their positions in the pattern plane.
pub fn write(pattern: &Pattern) -> Written {
    write_on(pattern, None)
}

/// Writes the pieces at their positions in the pattern plane, on `cloth` if there is one.
pub fn write_on(pattern: &Pattern, cloth: Option<&ClothSheet>) -> Written {
    let pieces: Vec<Traced> = pattern.pieces.values().map(|piece| trace::on_table(piece)).collect();
    let corners = pieces.iter().flat_map(Traced::bounds).chain(cloth.into_iter().flat_map(extent));
    let (lower, upper) = Contour::new(corners.collect()).bounds();
    let size = (upper - lower) * SCALE + DVec2::splat(2.0 * MARGIN);
    let sheet = Sheet { corner: DVec2::new(lower.x * SCALE - MARGIN, upper.y * SCALE + MARGIN) };
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" \
         xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" {OURS}=\"1\" \
         width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\" fill=\"none\" stroke-linejoin=\"round\">",
        w = number(size.x),
        h = number(size.y),
    );
    for (kind, label, style) in LAYERS {
        let paths: String =
            pieces.iter().enumerate().map(|(i, piece)| sheet.of_kind(kind, i, piece)).collect();
        if !paths.is_empty() {
            layer(&mut text, label, style, &paths);
        }
    }
    let names: String = pieces.iter().map(|piece| sheet.name(piece)).collect();
    let style =
        format!("fill=\"#333333\" font-family=\"sans-serif\" font-size=\"{LETTERS}\" text-anchor=\"middle\"");
    layer(&mut text, "Names", &style, &names);
    if let Some(cloth) = cloth {
        layer(&mut text, "Cloth", "stroke=\"#999999\" stroke-width=\"1\"", &sheet.cloth(cloth));
    }
    text.push_str("</svg>\n");
    Written { bytes: text.into_bytes(), left_out: written::left_out(pattern, &HOLDS), rules: None }
}

fn layer(text: &mut String, label: &str, style: &str, contents: &str) {
    let _ =
        write!(text, "<g inkscape:groupmode=\"layer\" inkscape:label=\"{label}\" {style}>\n{contents}</g>\n");
}

/// Lower and upper corner of what is drawn of `cloth`: its border, and its words below it.
fn extent(cloth: &ClothSheet) -> [DVec2; 2] {
    [DVec2::new(0.0, -(cloth.words.len() as f64 + 0.5) * LINE / SCALE), cloth.size]
}

/// The mapping from the pattern plane to the page: `corner` is the page's upper left corner in the plane, millimetres.
struct Sheet {
    corner: DVec2,
}

impl Sheet {
    fn at(&self, p: DVec2) -> DVec2 {
        DVec2::new(p.x * SCALE - self.corner.x, self.corner.y - p.y * SCALE)
    }

    fn point(&self, p: DVec2) -> String {
        let p = self.at(p);
        format!("{} {}", number(p.x), number(p.y))
    }

    fn of_kind(&self, kind: &str, i: usize, piece: &Traced) -> String {
        let named = |name: &str, data: &str, edges: &[Edge]| {
            let smooth: Vec<String> =
                (0..edges.len()).filter(|&i| edges[i].smooth).map(|i| i.to_string()).collect();
            format!(
                "<path {KIND}=\"{kind}\" {PIECE}=\"{i}\" {NAME}=\"{}\" {EDGES}=\"{}\" {SMOOTH}=\"{}\" d=\"{data}\"/>\n",
                escaped(name),
                edges.len(),
                smooth.join(" "),
            )
        };
        let closed = |edges: &[Edge]| {
            if edges.is_empty() { String::new() } else { named(&piece.name, &self.loop_data(edges), edges) }
        };
        let line = |a: DVec2, b: DVec2| {
            let edge = Edge { start: a, ..Edge::default() };
            named(&piece.name, &format!("M {} L {}", self.point(a), self.point(b)), &[edge])
        };
        match kind {
            "cut" => closed(&piece.cut_line),
            "seam" => closed(&piece.outline),
            "hole" => piece.holes.iter().map(|hole| closed(hole)).collect(),
            "line" => {
                piece.lines.iter().map(|l| named(&l.name, &self.data(&l.edges, l.end), &l.edges)).collect()
            }
            "notch" => piece
                .notches
                .iter()
                .map(|&at| {
                    let [_, inward] = allowance::notch_tip(&piece.outline, &piece.cut_line, at);
                    line(at, at + inward * NOTCH / SCALE)
                })
                .collect(),
            _ => piece.grainline.map(|[a, b]| line(a, b) + &self.arrow(a, b)).unwrap_or_default(),
        }
    }

    /// The arrow head of a grainline; it has no attributes, so it is not read back.
    fn arrow(&self, tail: DVec2, head: DVec2) -> String {
        let back = (tail - head).normalize_or_zero() * ARROW / SCALE;
        let sides = [0.4, -0.4].map(|turn: f64| self.point(head + DVec2::from_angle(turn).rotate(back)));
        format!("<path d=\"M {} L {} L {}\"/>\n", sides[0], self.point(head), sides[1])
    }

    /// The border of the cloth, as four lines so that it is not read as a piece, and the words below it.
    fn cloth(&self, cloth: &ClothSheet) -> String {
        let corners = cloth.corners().map(|p| self.point(p));
        let mut text = String::new();
        for (i, from) in corners.iter().enumerate() {
            let _ = writeln!(text, "<path d=\"M {from} L {}\"/>", corners[(i + 1) % corners.len()]);
        }
        for (i, words) in cloth.words.iter().enumerate() {
            let at = self.at(DVec2::ZERO) + DVec2::Y * LINE * (i as f64 + 1.0);
            let _ = writeln!(
                text,
                "<text x=\"{}\" y=\"{}\" stroke=\"none\" fill=\"#333333\" font-family=\"sans-serif\" font-size=\"{}\">{}</text>",
                number(at.x),
                number(at.y),
                LINE * 0.75,
                escaped(words)
            );
        }
        text
    }

    fn loop_data(&self, edges: &[Edge]) -> String {
        self.data(edges, edges[0].start) + " Z"
    }

    fn data(&self, edges: &[Edge], end: DVec2) -> String {
        let mut data = String::new();
        for (i, edge) in edges.iter().enumerate() {
            let to = self.point(edges.get(i + 1).map_or(end, |e| e.start));
            if i == 0 {
                let _ = write!(data, "M {}", self.point(edge.start));
            }
            let _ = match edge.shape {
                EdgeShape::Line => write!(data, " L {to}"),
                EdgeShape::Quadratic { control } => write!(data, " Q {} {to}", self.point(control)),
                EdgeShape::Cubic { controls: [c, d] } => {
                    write!(data, " C {} {} {to}", self.point(c), self.point(d))
                }
                EdgeShape::Arc { radius, large, sweep } => {
                    let r = number(radius * SCALE);
                    // The y axis points down here, which mirrors the plane, so the sweep is reversed.
                    write!(data, " A {r} {r} 0 {} {} {to}", u8::from(large), u8::from(!sweep))
                }
            };
        }
        data
    }

    fn name(&self, piece: &Traced) -> String {
        let middle = Contour::new(piece.outline.iter().map(|e| e.start).collect()).middle();
        let at = self.at(middle);
        format!("<text x=\"{}\" y=\"{}\">{}</text>\n", number(at.x), number(at.y), escaped(&piece.name))
    }
}

/// A number rounded to four decimals, without trailing zeros.
fn number(x: f64) -> String {
    let text = format!("{x:.5}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn escaped(text: &str) -> String {
    let plain: String = text.chars().filter(|c| !c.is_control()).collect();
    plain.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
