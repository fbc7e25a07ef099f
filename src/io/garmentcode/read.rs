//! Reads a pattern from the bytes of a GarmentCode specification.
//!
//! The two dialects differ in `curvature`: the older one has only quadratic Béziers, written as a plain pair.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DQuat, DVec2, DVec3, EulerRot};

use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, decimal, within_quotes, words};
use crate::io::Limits;
use crate::io::json::{self, At, JsonError};
use crate::io::sheet;
use crate::pattern::{Edge, EdgeRef, EdgeShape, Pattern, Piece, Seam, SpacePose};

/// Shortest edge that is accepted, metres.
pub(super) const SHORTEST_EDGE: f64 = 1e-6;
/// Largest coordinate of a relative control point, in edge lengths; a larger one is a fault of the file.
pub(super) const LARGEST_CURVATURE: f64 = 100.0;
/// Largest absolute rotation angle, degrees (two turns). Larger values are not degrees and are refused.
const LARGEST_ANGLE: f64 = 720.0;

/// Why a file cannot be read as a pattern.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub enum GarmentCodeError {
    /// Not JSON, or not the JSON of a pattern.
    Json(JsonError),
    /// More than [`Limits`] allows.
    OverLimit {
        /// JSON pointer of the value that exceeds the limit.
        place: String,
        /// Which limit.
        words: Words,
    },
}

impl GarmentCodeError {
    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::Json(error) => error.words(),
            Self::OverLimit { place, words } => Words::plain(place).and(": ", words.clone()),
        }
    }
}

impl From<JsonError> for GarmentCodeError {
    fn from(error: JsonError) -> Self {
        Self::Json(error)
    }
}

/// Reads a pattern: pieces in the order of the file, outlines in the direction of the file.
///
/// Faults that a person can fix within one piece, such as an outline that crosses itself, are no error here.
pub fn read(bytes: &[u8]) -> Result<Pattern, GarmentCodeError> {
    let limits = Limits::default();
    if bytes.len() > limits.file_bytes {
        let (count, most) = (bytes.len(), limits.file_bytes);
        let words = words!("the file has {count} bytes; {most} are allowed", count, most);
        return Err(GarmentCodeError::OverLimit { place: "/".to_owned(), words });
    }
    let root = json::parse(bytes)?;
    let root = At::root(&root);
    if root.optional("properties")?.is_none() && root.optional("pattern")?.is_none() {
        let words =
            words!("this is JSON, but no GarmentCode pattern: it has neither \"pattern\" nor \"properties\"");
        return Err(root.error(words).into());
    }
    let convention = Convention::read(&root, &limits)?;
    let body = root.field("pattern")?;
    let mut pattern = Pattern::default();
    let mut ids: BTreeMap<&str, PieceId> = BTreeMap::new();
    let panels = body.field("panels")?;
    let entries = panels.entries()?;
    if entries.len() > limits.pieces {
        let (count, most) = (entries.len(), limits.pieces);
        return Err(over(&panels, words!("{count} panels; {most} are allowed", count, most)));
    }
    for (name, panel) in entries {
        if name.len() > limits.name_bytes {
            let (count, most) = (name.len(), limits.name_bytes);
            return Err(over(&panels, words!("a name of {count} bytes; {most} are allowed", count, most)));
        }
        ids.insert(name, pattern.add_piece(convention.piece(name, &panel)?));
    }
    if ids.is_empty() {
        return Err(panels.error(words!("the pattern has no panels")).into());
    }
    read_stitches(&body, &ids, &mut pattern)?;
    sheet::lay_out(&mut pattern);
    Ok(pattern)
}

fn over(at: &At<'_>, words: Words) -> GarmentCodeError {
    GarmentCodeError::OverLimit { place: at.pointer.clone(), words }
}

/// How a file writes lengths and control points.
struct Convention {
    metres_per_unit: f64,
    absolute_controls: bool,
    largest_coordinate: f64,
}

impl Convention {
    fn read(root: &At<'_>, limits: &Limits) -> Result<Self, JsonError> {
        let properties = root.field("properties")?;
        let Some(units) = properties.optional("units_in_meter")? else {
            let words = words!("\"units_in_meter\" is missing: 100 stands for centimetres");
            return Err(properties.error(words));
        };
        let units_in_metre = units.number()?;
        if !(1e-3..=1e6).contains(&units_in_metre) {
            return Err(units.error(words!("{n} units in a metre cannot be", n = units_in_metre)));
        }
        let absolute_controls = match properties.optional("curvature_coords")? {
            None => false,
            Some(at) => match at.text()? {
                "relative" => false,
                "absolute" => true,
                other => {
                    let name = within_quotes(other);
                    let words = words!("\"{name}\" is neither \"relative\" nor \"absolute\"", name);
                    return Err(at.error(words));
                }
            },
        };
        let largest_coordinate = limits.pattern_coordinate;
        Ok(Self { metres_per_unit: 1.0 / units_in_metre, absolute_controls, largest_coordinate })
    }

    fn length(&self, at: &At<'_>) -> Result<f64, JsonError> {
        let metres = at.number()? * self.metres_per_unit;
        if metres.abs() > self.largest_coordinate {
            let most = self.largest_coordinate;
            return Err(at.error(words!("{metres} m is beyond {most} m", metres, most)));
        }
        Ok(metres)
    }

    fn point(&self, at: &At<'_>) -> Result<DVec2, JsonError> {
        let [x, y] = at.array()?;
        Ok(DVec2::new(self.length(&x)?, self.length(&y)?))
    }

    fn piece(&self, name: &str, panel: &At<'_>) -> Result<Piece, JsonError> {
        let vertices =
            panel.field("vertices")?.items()?.iter().map(|v| self.point(v)).collect::<Result<Vec<_>, _>>()?;
        Ok(Piece {
            name: name.to_owned(),
            outline: self.outline(panel, &vertices)?,
            placement: self.placement(panel)?,
            label: label(panel)?,
            ..Piece::default()
        })
    }

    fn outline(&self, panel: &At<'_>, vertices: &[DVec2]) -> Result<Vec<Edge>, JsonError> {
        let list = panel.field("edges")?;
        let edges = list.items()?;
        if edges.len() < 3 {
            let words = words!("a panel needs at least 3 edges, this one has {n}", n = edges.len());
            return Err(list.error(words));
        }
        let ends = edges.iter().map(|e| endpoints(e, vertices.len())).collect::<Result<Vec<_>, _>>()?;
        for (i, edge) in edges.iter().enumerate() {
            let (end, next) = (ends[i][1], ends[(i + 1) % edges.len()][0]);
            if end != next {
                return Err(edge.error(words!(
                    "the edge ends at vertex {end}, but the next one starts at vertex {next}: the outline is not closed",
                    end,
                    next
                )));
            }
        }
        edges.iter().zip(&ends).map(|(edge, ends)| self.edge(edge, ends.map(|v| vertices[v]))).collect()
    }

    fn edge(&self, edge: &At<'_>, [start, end]: [DVec2; 2]) -> Result<Edge, JsonError> {
        if start.distance(end) < SHORTEST_EDGE {
            return Err(edge.error(words!("the edge has no length: both ends lie in one place")));
        }
        let shape = match edge.optional("curvature")? {
            None => EdgeShape::Line,
            Some(at) => self.shape(&at, start, end)?,
        };
        Ok(Edge { start, shape, label: label(edge)?, ..Edge::default() })
    }

    fn shape(&self, curvature: &At<'_>, start: DVec2, end: DVec2) -> Result<EdgeShape, JsonError> {
        if let json::Node::List(_) = curvature.node {
            return Ok(EdgeShape::Quadratic { control: self.control(curvature, start, end)? });
        }
        let kind = curvature.field("type")?;
        let params = curvature.field("params")?;
        match kind.text()? {
            "quadratic" => {
                let [control] = params.array()?;
                Ok(EdgeShape::Quadratic { control: self.control(&control, start, end)? })
            }
            "cubic" => {
                let [c, d] = params.array()?;
                Ok(EdgeShape::Cubic {
                    controls: [self.control(&c, start, end)?, self.control(&d, start, end)?],
                })
            }
            "circle" => self.arc(&params, start.distance(end)),
            other => {
                let name = within_quotes(other);
                let words = words!("\"{name}\" is none of \"quadratic\", \"cubic\", \"circle\"", name);
                Err(kind.error(words))
            }
        }
    }

    /// The absolute position of a control point. A relative one is given in the edge's frame: x along the edge, y to its left,
    /// both in edge lengths.
    fn control(&self, at: &At<'_>, start: DVec2, end: DVec2) -> Result<DVec2, JsonError> {
        if self.absolute_controls {
            return self.point(at);
        }
        let [u, v] = at.numbers()?;
        if u.abs().max(v.abs()) > LARGEST_CURVATURE {
            return Err(at.error(words!("a relative control point this far from its edge cannot be")));
        }
        let along = end - start;
        let control = start + along * u + along.perp() * v;
        if control.abs().max_element() > self.largest_coordinate {
            let most = self.largest_coordinate;
            return Err(at.error(words!("the control point is beyond {most} m", most)));
        }
        Ok(control)
    }

    fn arc(&self, params: &At<'_>, chord: f64) -> Result<EdgeShape, JsonError> {
        let [radius, large, right] = params.array()?;
        let metres = self.length(&radius)?;
        if metres < chord / 2.0 * (1.0 - 1e-4) {
            return Err(radius.error(words!(
                "an arc of radius {metres} m cannot span its ends, which are {chord} m apart",
                metres = decimal(metres, 6),
                chord = decimal(chord, 6)
            )));
        }
        // The radius of a half circle may be rounded to slightly less than half the chord.
        Ok(EdgeShape::Arc { radius: metres.max(chord / 2.0), large: large.flag()?, sweep: right.flag()? })
    }

    fn placement(&self, panel: &At<'_>) -> Result<Option<SpacePose>, JsonError> {
        let Some(translation) = panel.optional("translation")? else {
            return Ok(None);
        };
        let [x, y, z] = translation.array()?;
        let translation = DVec3::new(self.length(&x)?, self.length(&y)?, self.length(&z)?);
        let rotation = match panel.optional("rotation")? {
            None => DQuat::IDENTITY,
            Some(at) => {
                let angles: [f64; 3] = at.numbers()?;
                if angles.iter().any(|a| a.abs() > LARGEST_ANGLE) {
                    return Err(at.error(words!("rotations are in degrees, no more than two turns")));
                }
                let [a, b, c] = angles.map(f64::to_radians);
                // R = Rz · Ry · Rx: the rotation about x is applied first.
                DQuat::from_euler(EulerRot::ZYX, c, b, a)
            }
        };
        Ok(Some(SpacePose::flat(translation, rotation)))
    }
}

fn label(at: &At<'_>) -> Result<Option<String>, JsonError> {
    match at.optional("label")? {
        None => Ok(None),
        Some(label) => Ok(Some(label.text()?.to_owned()).filter(|l| !l.is_empty())),
    }
}

fn endpoints(edge: &At<'_>, vertex_count: usize) -> Result<[usize; 2], JsonError> {
    let [i, j] = edge.field("endpoints")?.array()?;
    Ok([i.index(vertex_count)?, j.index(vertex_count)?])
}

fn read_stitches(
    body: &At<'_>,
    ids: &BTreeMap<&str, PieceId>,
    pattern: &mut Pattern,
) -> Result<(), JsonError> {
    let Some(stitches) = body.optional("stitches")? else {
        return Ok(());
    };
    let mut sewn = BTreeSet::new();
    for stitch in stitches.items()? {
        let items = stitch.items()?;
        let (a, b, same_direction) = match items.as_slice() {
            [a, b] => (a, b, false),
            [a, b, how] => (a, b, right_wrong(how)?),
            _ => {
                let words = words!("a stitch joins 2 edges, this one lists {n}", n = items.len());
                return Err(stitch.error(words));
            }
        };
        let sides = [edge_ref(a, ids, pattern)?, edge_ref(b, ids, pattern)?];
        for (side, at) in sides.iter().zip([a, b]) {
            if !sewn.insert(*side) {
                return Err(at.error(words!("this edge is sewn twice")));
            }
        }
        pattern.add_seam(Seam::of_edges(sides, same_direction));
    }
    Ok(())
}

/// Whether a stitch sews the right side of one edge to the wrong side of the other, as for a lapel; the edges then run the same
/// way, start to start.
fn right_wrong(how: &At<'_>) -> Result<bool, JsonError> {
    match how.text()? {
        "right_wrong" => Ok(true),
        other => {
            let name = within_quotes(other);
            Err(how.error(words!("\"{name}\" is no way to stitch; only \"right_wrong\" is known", name)))
        }
    }
}

fn edge_ref(side: &At<'_>, ids: &BTreeMap<&str, PieceId>, pattern: &Pattern) -> Result<EdgeRef, JsonError> {
    let panel = side.field("panel")?;
    let name = panel.text()?;
    let Some(&piece) = ids.get(name) else {
        return Err(panel.error(words!("there is no panel \"{name}\"", name = within_quotes(name))));
    };
    let edge = side.field("edge")?.index(pattern.pieces[&piece].outline.len())?;
    Ok(EdgeRef { piece, edge })
}

#[cfg(test)]
#[path = "read_tests.rs"]
mod tests;
