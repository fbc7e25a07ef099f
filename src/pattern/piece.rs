//! A flat piece of cloth: its closed outline, its position on the table, and its placement in space.

use glam::DVec2;
use kurbo::{ParamCurveArclen, PathSeg};
use serde::{Deserialize, Serialize};

use crate::geometry::ids::PieceId;
use crate::geometry::polygon::signed_area;
use crate::pattern::activity::Activity;
use crate::pattern::edge::{ARC_LENGTH_ACCURACY, Edge};
use crate::pattern::grading::rule::{GradeRule, RulePoint};
use crate::pattern::{SpacePose, curve};

/// Position, rotation and flip of a piece on the table (the pattern plane). It has no effect on the cloth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlanePose {
    /// Translation, metres.
    pub offset: DVec2,
    /// Rotation, counter-clockwise, radians.
    pub rotation: f64,
    /// Whether the piece is mirrored in x before it is rotated, so that its back is seen.
    pub flipped: bool,
}

impl PlanePose {
    /// Maps a point from the piece's own plane to the pattern plane.
    pub fn plane_from_piece(&self, p: DVec2) -> DVec2 {
        let p = if self.flipped { DVec2::new(-p.x, p.y) } else { p };
        DVec2::from_angle(self.rotation).rotate(p) + self.offset
    }

    /// Maps a point from the pattern plane to the piece's own plane.
    pub fn piece_from_plane(&self, p: DVec2) -> DVec2 {
        let p = DVec2::from_angle(-self.rotation).rotate(p - self.offset);
        if self.flipped { DVec2::new(-p.x, p.y) } else { p }
    }
}

/// An internal line: drawn on a piece, but not cut; for sewing along, folding, or placing a pocket.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct InternalLine {
    /// The edges in order, each starting where the one before ends; the last ends at `end`. At least one.
    pub edges: Vec<Edge>,
    /// Where the last edge ends, metres in the piece's own plane.
    pub end: DVec2,
    /// Name shown to people; may be empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// How the end moves from size to size, as [`Edge::rule`] says of the other points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end_rule: Option<GradeRule>,
}

/// A notch: a small mark on an edge that shows the sewer what to align there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Notch {
    /// The edge, as [`Piece::edge`] counts.
    pub edge: usize,
    /// Where on the edge, a fraction of its arc length, 0..=1.
    pub at: f64,
}

/// A flat piece of cloth.
///
/// Its front (outer) side is the one from which `outline` runs counter-clockwise: a clockwise outline is a piece drawn
/// from its back, as mirrored panels of GarmentCode are.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Piece {
    /// Name shown to people; need not be unique.
    pub name: String,
    /// The seam line, without allowance. Closed: the last edge ends where the first starts.
    pub outline: Vec<Edge>,
    /// Closed lines whose inside is cut out. Their edges are numbered after those of the outline and can be sewn.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holes: Vec<Vec<Edge>>,
    /// Internal lines.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<InternalLine>,
    /// Notches on the edges.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notches: Vec<Notch>,
    /// The grainline: tail and head of the arrow along the warp, metres in the piece's own plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grainline: Option<[DVec2; 2]>,
    /// Seam allowance: width of the cloth outside the outline, metres, 0..=0.2.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub allowance: f64,
    /// The cutting line, where a file gave one instead of an even `allowance`; removed when the outline changes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cut_line: Vec<Edge>,
    /// Whether the outline is kept its own mirror image in the line x = 0. It then has an even number n of edges,
    /// edge i is the image of edge n-1-i, and points 0 and n/2 are on the line.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub symmetric: bool,
    /// The twin: a piece that is kept the mirror image of this one. Its edge i of n is the image of edge n-1-i, for
    /// the outline and for each hole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub twin: Option<PieceId>,
    /// Whether the pointer can neither move nor change the piece.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub locked: bool,
    /// Whether the piece is not drawn in the pattern pane. It is sewn all the same.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub hidden: bool,
    /// The layer, 0..=[`MOST_LAYER`](crate::pattern::layers::MOST_LAYER): the piece is worn over all pieces of lower
    /// layers; layer 0 is next to the skin.
    #[serde(default, skip_serializing_if = "is_skin")]
    pub layer: u8,
    /// Greatest length of the edges of its mesh, metres, within [`MESH_SIZES`](crate::pattern::fineness::MESH_SIZES); None: that of the
    /// garment.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh_size: Option<f64>,
    /// Whether draping and relaxing move the piece.
    #[serde(default, skip_serializing_if = "Activity::is_active")]
    pub activity: Activity,
    /// Position on the table, as the pattern pane shows it.
    pub pose: PlanePose,
    /// Placement in space before sewing, if a file or a person gave one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub placement: Option<SpacePose>,
    /// A part of the body named by the source file ("arm", "leg", "body"), if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
}

impl Piece {
    /// A piece with straight edges through `points`.
    pub fn polygon(name: &str, points: &[DVec2]) -> Self {
        Self {
            name: name.to_owned(),
            outline: points.iter().map(|&start| Edge { start, ..Edge::default() }).collect(),
            ..Self::default()
        }
    }

    /// Unit vector along the warp, in the piece's own plane: along the grainline, or y without one.
    pub fn grain(&self) -> DVec2 {
        self.grainline.and_then(|[tail, head]| (head - tail).try_normalize()).unwrap_or(DVec2::Y)
    }

    /// The closed lines along which the piece is cut: the outline, then the holes.
    pub fn loops(&self) -> impl Iterator<Item = &Vec<Edge>> {
        std::iter::once(&self.outline).chain(&self.holes)
    }

    /// Number of edges of all closed lines.
    pub fn edge_count(&self) -> usize {
        self.loops().map(Vec::len).sum()
    }

    /// The closed line that edge `i` belongs to (0: the outline), and the number of that line's first edge. Panics
    /// when there is no such edge.
    pub fn loop_of(&self, i: usize) -> (usize, usize) {
        let mut first = 0;
        for (k, edges) in self.loops().enumerate() {
            if i < first + edges.len() {
                return (k, first);
            }
            first += edges.len();
        }
        panic!("{} has {first} edges, none numbered {i}", self.name)
    }

    /// The edges of closed line `k` (0: the outline). Panics when there is no such line.
    pub fn loop_edges(&self, k: usize) -> &Vec<Edge> {
        if k == 0 { &self.outline } else { &self.holes[k - 1] }
    }

    /// The edges of closed line `k` (0: the outline), mutable. Panics when there is no such line.
    pub fn loop_edges_mut(&mut self, k: usize) -> &mut Vec<Edge> {
        if k == 0 { &mut self.outline } else { &mut self.holes[k - 1] }
    }

    /// Edge `i`: those of the outline come first, then those of the holes in order. Panics when there is no such edge.
    pub fn edge(&self, i: usize) -> &Edge {
        let (k, first) = self.loop_of(i);
        &self.loop_edges(k)[i - first]
    }

    /// The edge that follows edge `i` on its closed line. Panics when there is no such edge.
    pub fn next_edge(&self, i: usize) -> usize {
        let (k, first) = self.loop_of(i);
        first + (i - first + 1) % self.loop_edges(k).len()
    }

    /// Start and end of edge `i`. Panics when there is no such edge.
    pub fn edge_ends(&self, i: usize) -> (DVec2, DVec2) {
        (self.edge(i).start, self.edge(self.next_edge(i)).start)
    }

    /// Edge `i` as curve segments, each starting where the one before ends: one, or for an arc a few cubics. Panics
    /// when there is no such edge.
    pub fn edge_segments(&self, i: usize) -> Vec<PathSeg> {
        let (a, b) = self.edge_ends(i);
        curve::segments(a, self.edge(i).shape, b)
    }

    /// Arc length of edge `i` in metres, to [`ARC_LENGTH_ACCURACY`].
    pub fn edge_length(&self, i: usize) -> f64 {
        self.edge_segments(i).iter().map(|s| s.arclen(ARC_LENGTH_ACCURACY)).sum()
    }

    /// Arc length of edge `i` in metres, to 1e-12: slower than [`Piece::edge_length`].
    pub fn exact_edge_length(&self, i: usize) -> f64 {
        let (a, b) = self.edge_ends(i);
        curve::exact_length(a, self.edge(i).shape, b)
    }

    /// Points on edge `i` at `fractions` (0..=1, ascending) of its arc length. Fractions 0 and 1 give exactly its ends.
    pub fn edge_points(&self, i: usize, fractions: &[f64]) -> Vec<DVec2> {
        let (a, b) = self.edge_ends(i);
        curve::points(a, self.edge(i).shape, b, fractions)
    }

    /// Where a point of a closed or an internal line is, in the piece's own plane. None where there is no such point.
    pub fn place_of(&self, at: &RulePoint) -> Option<DVec2> {
        match at.line {
            None => (at.point < self.edge_count()).then(|| self.edge(at.point).start),
            Some(line) => self.lines.get(line)?.point(at.point),
        }
    }

    /// The grade rule of a point of a closed or an internal line, where it has one.
    pub fn rule_of(&self, at: &RulePoint) -> Option<&GradeRule> {
        match at.line {
            None if at.point < self.edge_count() => self.edge(at.point).rule.as_ref(),
            None => None,
            Some(line) => self.lines.get(line)?.rule(at.point),
        }
    }

    /// Whether a closed or an internal line is smooth at a point. None at the ends of an internal line, where it is neither smooth
    /// nor has a corner, and where there is no such point.
    pub fn is_smooth_at(&self, at: &RulePoint) -> Option<bool> {
        match at.line {
            None => (at.point < self.edge_count()).then(|| self.edge(at.point).smooth),
            Some(line) => {
                self.lines.get(line)?.edges.get(at.point).filter(|_| at.point > 0).map(|edge| edge.smooth)
            }
        }
    }

    /// The outline as a closed polyline whose chords stay within `tolerance` metres of it; the first point is not repeated.
    pub fn flattened(&self, tolerance: f64) -> Vec<DVec2> {
        flattened_loop(&self.outline, tolerance)
    }

    /// Signed area inside the outline flattened to 0.1 mm, square metres; positive when it runs counter-clockwise.
    /// Holes are not subtracted.
    pub fn signed_area(&self) -> f64 {
        signed_area(&self.flattened(1e-4))
    }
}

/// A closed line as a closed polyline whose chords stay within `tolerance` metres of it; the first point is not repeated.
pub fn flattened_loop(edges: &[Edge], tolerance: f64) -> Vec<DVec2> {
    let mut points = Vec::new();
    for (i, edge) in edges.iter().enumerate() {
        let end = edges[(i + 1) % edges.len()].start;
        curve::flatten(edge.start, edge.shape, end, tolerance, &mut points);
    }
    points
}

impl InternalLine {
    /// The points in order, one more than edges: where each edge starts, then the end.
    pub fn points(&self) -> impl Iterator<Item = DVec2> {
        self.edges.iter().map(|edge| edge.start).chain([self.end])
    }

    /// Point `i`: where edge `i` starts; on a line of n edges point n is its end. None where there is no such point.
    pub fn point(&self, i: usize) -> Option<DVec2> {
        self.points().nth(i)
    }

    /// Where edge `i` ends: where the next one starts, or at the end of the line.
    pub fn edge_end(&self, i: usize) -> DVec2 {
        self.edges.get(i + 1).map_or(self.end, |next| next.start)
    }

    /// The place of the line that is nearest to `p`: its edge, the fraction of the edge's arc length, and the distance, metres.
    pub fn nearest(&self, p: DVec2) -> Option<(usize, f64, f64)> {
        let ends = self.points().zip(self.points().skip(1));
        let near = self.edges.iter().zip(ends).enumerate().map(|(i, (edge, (a, b)))| {
            let (at, distance) = curve::nearest(&curve::segments(a, edge.shape, b), p);
            (i, at, distance)
        });
        near.min_by(|one, other| one.2.total_cmp(&other.2))
    }

    /// The grade rule of point `i`, where it has one.
    pub fn rule(&self, i: usize) -> Option<&GradeRule> {
        match self.edges.get(i) {
            Some(edge) => edge.rule.as_ref(),
            None => self.end_rule.as_ref().filter(|_| i == self.edges.len()),
        }
    }

    /// The other end, for an end of a line that ends where it starts.
    pub fn meeting_end(&self, i: usize) -> Option<usize> {
        let last = self.edges.len();
        let meets = self.point(0) == Some(self.end) && (i == 0 || i == last);
        meets.then_some(last - i)
    }

    /// Whether edges of the mesh must follow the line.
    pub fn needs_mesh(&self) -> bool {
        self.edges.iter().any(|edge| edge.trims.needs_mesh())
    }

    /// The line as a polyline whose chords stay within `tolerance` metres of it.
    pub fn flattened(&self, tolerance: f64) -> Vec<DVec2> {
        let mut points = Vec::new();
        for (i, edge) in self.edges.iter().enumerate() {
            curve::flatten(edge.start, edge.shape, self.edge_end(i), tolerance, &mut points);
        }
        points.push(self.end);
        points
    }
}

fn is_skin(layer: &u8) -> bool {
    *layer == 0
}

fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::EdgeShape;

    #[test]
    fn a_half_circle_is_pi_r_long() {
        let mut piece = Piece::polygon("d", &[DVec2::new(1.0, 0.0), DVec2::new(-1.0, 0.0)]);
        piece.outline[0].shape = EdgeShape::Arc { radius: 1.0, large: false, sweep: true };
        assert!((piece.edge_length(0) - std::f64::consts::PI).abs() < 1e-6);
        let top = piece.edge_points(0, &[0.5])[0];
        assert!((top - DVec2::new(0.0, 1.0)).length() < 1e-6, "{top}");
        assert!((piece.signed_area() - std::f64::consts::PI / 2.0).abs() < 1e-3);
    }

    #[test]
    fn a_pose_and_its_inverse_cancel() {
        let pose = PlanePose { offset: DVec2::new(1.0, 2.0), rotation: 0.7, flipped: true };
        let p = DVec2::new(0.3, -0.2);
        assert!((pose.piece_from_plane(pose.plane_from_piece(p)) - p).length() < 1e-12);
    }
}
