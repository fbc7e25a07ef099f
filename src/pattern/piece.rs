//! A flat piece of cloth: a closed outline, where it lies in the pattern plane, and where it was placed in space.

use glam::DVec2;
use kurbo::{ParamCurveArclen, PathSeg};
use serde::{Deserialize, Serialize};

use crate::geometry::ids::PieceId;
use crate::geometry::polygon::signed_area;
use crate::pattern::activity::Activity;
use crate::pattern::edge::{ARC_LENGTH_ACCURACY, Edge};
use crate::pattern::{SpacePose, curve};

/// Position, rotation and flip of a piece in the pattern plane. Where it lies on the table; it means nothing to the cloth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlanePose {
    /// Metres.
    pub offset: DVec2,
    /// Counter-clockwise, radians.
    pub rotation: f64,
    /// Mirrored in x before rotating: its back is seen.
    pub flipped: bool,
}

impl PlanePose {
    /// From the piece's own plane to the pattern plane.
    pub fn plane_from_piece(&self, p: DVec2) -> DVec2 {
        let p = if self.flipped { DVec2::new(-p.x, p.y) } else { p };
        DVec2::from_angle(self.rotation).rotate(p) + self.offset
    }

    /// From the pattern plane to the piece's own plane.
    pub fn piece_from_plane(&self, p: DVec2) -> DVec2 {
        let p = DVec2::from_angle(-self.rotation).rotate(p - self.offset);
        if self.flipped { DVec2::new(-p.x, p.y) } else { p }
    }
}

/// A line drawn on a piece that is not cut: to sew along, to fold, to place a pocket.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InternalLine {
    /// Head to tail; the last edge ends at `end`. At least one.
    pub edges: Vec<Edge>,
    /// Where the last edge ends, metres in the piece's own plane.
    pub end: DVec2,
    /// Shown to people; may be empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
}

/// A small mark on an edge that tells the sewer what meets there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Notch {
    /// The edge, as [`Piece::edge`] counts.
    pub edge: usize,
    /// Where on it, a fraction of its arc length, 0..=1.
    pub at: f64,
}

/// A flat piece of cloth.
///
/// Its front (outer) side is the one from which `outline` runs counter-clockwise: a clockwise outline is a piece drawn
/// from its back, as mirrored panels of GarmentCode are.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Piece {
    /// Shown to people; need not be unique.
    pub name: String,
    /// The line it is sewn on, without allowance. Closed: the last edge ends where the first starts.
    pub outline: Vec<Edge>,
    /// Closed lines whose inside is cut out. Their edges count on behind those of the outline and can be sewn.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holes: Vec<Vec<Edge>>,
    /// Lines drawn inside.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<InternalLine>,
    /// Marks on the edges.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notches: Vec<Notch>,
    /// From tail to head of the arrow along the warp, metres in the piece's own plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grainline: Option<[DVec2; 2]>,
    /// Cloth left outside the outline when it is cut out, metres, 0..=0.2.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub allowance: f64,
    /// The line it is cut on where a file gave one, instead of `allowance` all round; gone when the outline changes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cut_line: Vec<Edge>,
    /// The outline is its own mirror image in the line x = 0 and stays so: it has an even number n of edges, edge i is
    /// the image of edge n-1-i, and points 0 and n/2 lie on the line.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub symmetric: bool,
    /// The piece that is and stays the mirror image of this one: its edge i of n is the image of edge n-1-i, hole by hole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub twin: Option<PieceId>,
    /// Not to be moved or changed by the pointer.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub locked: bool,
    /// Not drawn in the pattern pane. It is sewn all the same.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub hidden: bool,
    /// Worn over all pieces of a lower layer, 0..=[`MOST_LAYER`](crate::pattern::layers::MOST_LAYER); layer 0 lies next to the skin.
    #[serde(default, skip_serializing_if = "is_skin")]
    pub layer: u8,
    /// Whether draping and relaxing move it.
    #[serde(default, skip_serializing_if = "Activity::is_active")]
    pub activity: Activity,
    /// Where it lies in the pattern pane.
    pub pose: PlanePose,
    /// Where it stands round the body before it is sewn, if it was placed by a file or by hand.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub placement: Option<SpacePose>,
    /// A part of the body named by the source file ("arm", "leg", "body"), if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
}

impl Piece {
    /// A piece of straight edges through `points`.
    pub fn polygon(name: &str, points: &[DVec2]) -> Self {
        Self {
            name: name.to_owned(),
            outline: points.iter().map(|&start| Edge { start, ..Edge::default() }).collect(),
            ..Self::default()
        }
    }

    /// The closed lines it is cut along: the outline, then the holes.
    pub fn loops(&self) -> impl Iterator<Item = &Vec<Edge>> {
        std::iter::once(&self.outline).chain(&self.holes)
    }

    /// Edges of all closed lines.
    pub fn edge_count(&self) -> usize {
        self.loops().map(Vec::len).sum()
    }

    /// Which closed line edge `i` is of (0: the outline), and the number of that line's first edge. Panics when there is
    /// no such edge.
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

    /// The edges of closed line `k`, to change them. Panics when there is no such line.
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

    /// Edge `i` as curve segments, head to tail: one, or for an arc a few cubics. Panics when there is no such edge.
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

    /// Points on edge `i` at `fractions` (0..=1, ascending) of its arc length. Ends are met exactly.
    pub fn edge_points(&self, i: usize, fractions: &[f64]) -> Vec<DVec2> {
        let (a, b) = self.edge_ends(i);
        curve::points(a, self.edge(i).shape, b, fractions)
    }

    /// The outline as a closed polyline whose chords stay within `tolerance` metres of it; the last point is not the first.
    pub fn flattened(&self, tolerance: f64) -> Vec<DVec2> {
        flattened_loop(&self.outline, tolerance)
    }

    /// Signed area of the outline flattened to 0.1 mm, square metres; positive when it runs counter-clockwise. Holes
    /// count as cloth.
    pub fn signed_area(&self) -> f64 {
        signed_area(&self.flattened(1e-4))
    }
}

/// A closed line as a closed polyline whose chords stay within `tolerance` metres of it; the last point is not the first.
pub fn flattened_loop(edges: &[Edge], tolerance: f64) -> Vec<DVec2> {
    let mut points = Vec::new();
    for (i, edge) in edges.iter().enumerate() {
        let end = edges[(i + 1) % edges.len()].start;
        curve::flatten(edge.start, edge.shape, end, tolerance, &mut points);
    }
    points
}

impl InternalLine {
    /// As a polyline whose chords stay within `tolerance` metres of it.
    pub fn flattened(&self, tolerance: f64) -> Vec<DVec2> {
        let mut points = Vec::new();
        for (i, edge) in self.edges.iter().enumerate() {
            let end = self.edges.get(i + 1).map_or(self.end, |next| next.start);
            curve::flatten(edge.start, edge.shape, end, tolerance, &mut points);
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
