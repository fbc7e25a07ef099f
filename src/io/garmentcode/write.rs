//! Writes a pattern as the bytes of a GarmentCode specification, in centimetres.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::{DVec2, EulerRot};
use serde::ser::{Serialize, Serializer};
use serde_json::{Value, json};

use super::read::LARGEST_CURVATURE;
use crate::geometry::ids::{PieceId, SeamId};
use crate::geometry::words::{Words, within_quotes, words};
use crate::io::Written;
use crate::io::written::{self, Part};
use crate::pattern::{
    CutPattern, Edge, EdgeSeam, EdgeShape, Pattern, Piece, Seam, SpacePose, Stretch, curve,
};

const UNITS_IN_METRE: f64 = 100.0;
/// Parts of a pattern that this format can hold.
const HOLDS: [Part; 5] = [Part::Curves, Part::EdgeNames, Part::Placement, Part::PlaceOnBody, Part::Seams];
/// Smallest number of edges of a panel in the format.
const FEWEST_EDGES: usize = 3;

/// Writes panels in the order of the pieces, with outlines in their own direction. A stitch joins two whole edges, so edges are
/// split where a seam along part of them ends.
pub fn write(pattern: &Pattern) -> Written {
    let mut left_out = written::left_out(pattern, &HOLDS);
    let (cut, problems) = CutPattern::new(&with_enough_edges(pattern));
    left_out.extend(
        problems
            .into_iter()
            .map(|p| words!("{names}: not in the file: {what}", names = p.place, what = p.words)),
    );
    let names = unique_names(pattern, &mut left_out);
    let (seams, of_holes): (Vec<_>, Vec<_>) = cut
        .seams
        .iter()
        .partition(|(_, seam)| seam.sides.iter().all(|s| is_on_outline(&cut, s.piece, s.edge)));
    let of_holes: BTreeSet<SeamId> = of_holes.into_iter().map(|(id, _)| id).collect();
    let of_holes: Vec<SeamId> = of_holes.into_iter().collect();
    left_out.extend(written::seams_left_out(&of_holes, words!("it runs along a hole, and holes are not")));
    let is_relative = cut.pieces.values().all(|piece| has_near_controls(&piece.outline));
    let panels: Vec<(&str, Value)> =
        cut.pieces.iter().map(|(id, piece)| (names[id].as_str(), panel(piece, is_relative))).collect();
    let file = File {
        panels: &panels,
        stitches: seams.into_iter().map(|(_, seam)| stitch(&seam, &names)).collect(),
        coordinates: if is_relative { "relative" } else { "absolute" },
    };
    let mut bytes = serde_json::to_vec_pretty(&file).unwrap_or_default();
    bytes.push(b'\n');
    Written { bytes, left_out, rules: None }
}

/// The JSON of the file, which keeps the order of panels; `serde_json::Value` would not.
struct File<'a> {
    panels: &'a [(&'a str, Value)],
    stitches: Vec<Value>,
    coordinates: &'static str,
}

struct Panels<'a>(&'a [(&'a str, Value)]);

impl Serialize for Panels<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, panel)| (name, panel)))
    }
}

impl Serialize for File<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(serde::Serialize)]
        struct Specification<'a> {
            pattern: Body<'a>,
            parameters: Value,
            parameter_order: [Value; 0],
            properties: Value,
        }
        #[derive(serde::Serialize)]
        struct Body<'a> {
            panels: Panels<'a>,
            stitches: &'a [Value],
            panel_order: Vec<&'a str>,
        }
        let specification = Specification {
            pattern: Body {
                panels: Panels(self.panels),
                stitches: &self.stitches,
                panel_order: self.panels.iter().map(|(name, _)| *name).collect(),
            },
            parameters: json!({}),
            parameter_order: [],
            properties: json!({
                "curvature_coords": self.coordinates,
                "normalize_panel_translation": false,
                "normalized_edge_loops": true,
                "units_in_meter": UNITS_IN_METRE,
            }),
        };
        specification.serialize(serializer)
    }
}

fn is_on_outline(cut: &CutPattern, piece: PieceId, edge: usize) -> bool {
    edge < cut.pieces[&piece].outline.len()
}

/// A different name for each panel, since stitches refer to panels by name. Changed names are noted in `left_out`.
fn unique_names(pattern: &Pattern, left_out: &mut Vec<Words>) -> BTreeMap<PieceId, String> {
    let mut names = BTreeMap::new();
    let mut taken = BTreeSet::new();
    for (&id, piece) in &pattern.pieces {
        let plain = if piece.name.is_empty() { "piece" } else { &piece.name };
        let candidates = std::iter::once(plain.to_owned()).chain((2..).map(|n| format!("{plain}_{n}")));
        for name in candidates {
            if taken.insert(name.clone()) {
                if name != piece.name {
                    left_out.push(words!(
                        "{piece} ({id}): it is called \"{name}\" in the file",
                        piece = piece.name,
                        id,
                        name = within_quotes(&name)
                    ));
                }
                names.insert(id, name);
                break;
            }
        }
    }
    names
}

/// Splits the edges of panels with fewer than [`FEWEST_EDGES`] edges into thirds, and the seams along them too.
fn with_enough_edges(pattern: &Pattern) -> Pattern {
    let mut pattern = pattern.clone();
    let few: BTreeSet<PieceId> = pattern
        .pieces
        .iter()
        .filter(|(_, piece)| (1..FEWEST_EDGES).contains(&piece.outline.len()))
        .map(|(&id, _)| id)
        .collect();
    if few.is_empty() {
        return pattern;
    }
    let sewn: Vec<(SeamId, Seam)> = pattern
        .seams
        .iter()
        .filter(|(_, s)| s.sides.iter().all(|side| side.whole_edge().is_some()))
        .filter(|(_, s)| s.sides.iter().any(|side| few.contains(&side.piece)))
        .map(|(&id, &seam)| (id, seam))
        .collect();
    for (id, seam) in sewn {
        pattern.seams.remove(&id);
        let n = FEWEST_EDGES;
        for i in 0..n {
            let j = if seam.same_direction { i } else { n - 1 - i };
            let sides = [third(seam.sides[0], i), third(seam.sides[1], j)];
            pattern.add_seam(Seam { sides, ..seam });
        }
    }
    let has_seam = |id: PieceId| pattern.seams.values().any(|s| s.sides.iter().any(|side| side.piece == id));
    let bare: Vec<PieceId> = few.into_iter().filter(|&id| !has_seam(id)).collect();
    for id in bare {
        if let Some(piece) = pattern.pieces.get_mut(&id) {
            let piece = Arc::make_mut(piece);
            piece.outline = piece_in_thirds(piece);
        }
    }
    pattern
}

fn third(side: Stretch, i: usize) -> Stretch {
    let n = FEWEST_EDGES as f64;
    let to = if i + 1 == FEWEST_EDGES { 1.0 } else { (i + 1) as f64 / n };
    Stretch { from: i as f64 / n, to, ..side }
}

fn piece_in_thirds(piece: &Piece) -> Vec<Edge> {
    let n = FEWEST_EDGES as f64;
    let cuts: Vec<f64> = (1..FEWEST_EDGES).map(|i| i as f64 / n).collect();
    (0..piece.outline.len())
        .flat_map(|i| {
            let edge = &piece.outline[i];
            let (start, end) = piece.edge_ends(i);
            let parts = curve::split(start, edge.shape, end, &cuts);
            parts.into_iter().map(|(start, shape)| Edge { start, shape, ..edge.clone() })
        })
        .collect()
}

/// The edges of a closed line, each with its end point.
fn ends(edges: &[Edge]) -> impl Iterator<Item = (&Edge, DVec2)> {
    edges.iter().enumerate().map(|(i, edge)| (edge, edges[(i + 1) % edges.len()].start))
}

fn has_near_controls(edges: &[Edge]) -> bool {
    ends(edges).all(|(edge, end)| {
        let near = |c: DVec2| relative(edge.start, end, c).abs().max_element() <= LARGEST_CURVATURE;
        match edge.shape {
            EdgeShape::Quadratic { control } => near(control),
            EdgeShape::Cubic { controls } => controls.into_iter().all(near),
            EdgeShape::Line | EdgeShape::Arc { .. } => true,
        }
    })
}

/// A control point in its edge's frame: x along the edge, y to its left, both in edge lengths.
fn relative(start: DVec2, end: DVec2, control: DVec2) -> DVec2 {
    let along = end - start;
    let from_start = control - start;
    DVec2::new(along.dot(from_start), along.perp_dot(from_start)) / along.length_squared()
}

fn panel(piece: &Piece, is_relative: bool) -> Value {
    let count = piece.outline.len();
    let vertices: Vec<[f64; 2]> = piece.outline.iter().map(|e| in_units(e.start)).collect();
    let edges: Vec<Value> = ends(&piece.outline)
        .enumerate()
        .map(|(i, (edge, end))| {
            let mut value = json!({ "endpoints": [i, (i + 1) % count] });
            if let Some(curvature) = curvature(edge, end, is_relative) {
                value["curvature"] = curvature;
            }
            if let Some(label) = &edge.label {
                value["label"] = json!(label);
            }
            value
        })
        .collect();
    let mut panel = json!({ "vertices": vertices, "edges": edges });
    if let Some(label) = &piece.label {
        panel["label"] = json!(label);
    }
    if let Some(SpacePose { translation, rotation, .. }) = piece.placement {
        let (c, b, a) = rotation.normalize().to_euler(EulerRot::ZYX);
        panel["translation"] = json!((translation * UNITS_IN_METRE).to_array());
        panel["rotation"] = json!([a, b, c].map(f64::to_degrees));
    }
    panel
}

fn in_units(p: DVec2) -> [f64; 2] {
    (p * UNITS_IN_METRE).to_array()
}

fn curvature(edge: &Edge, end: DVec2, is_relative: bool) -> Option<Value> {
    let control = |c: DVec2| {
        if is_relative { relative(edge.start, end, c).to_array() } else { in_units(c) }
    };
    match edge.shape {
        EdgeShape::Line => None,
        EdgeShape::Quadratic { control: c } => Some(json!({ "type": "quadratic", "params": [control(c)] })),
        EdgeShape::Cubic { controls } => Some(json!({ "type": "cubic", "params": controls.map(control) })),
        EdgeShape::Arc { radius, large, sweep } => {
            let params = json!([radius * UNITS_IN_METRE, u8::from(large), u8::from(sweep)]);
            Some(json!({ "type": "circle", "params": params }))
        }
    }
}

fn stitch(seam: &EdgeSeam, names: &BTreeMap<PieceId, String>) -> Value {
    let [a, b] = seam.sides.map(|side| json!({ "panel": names[&side.piece], "edge": side.edge }));
    if seam.same_direction { json!([a, b, "right_wrong"]) } else { json!([a, b]) }
}

#[cfg(test)]
#[path = "write_tests.rs"]
mod tests;
