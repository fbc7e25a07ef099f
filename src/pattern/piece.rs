//! A flat piece of cloth: a closed outline, where it lies in the pattern plane, and where it was placed in space.

use glam::{DQuat, DVec2, DVec3};
use kurbo::{CubicBez, Line, ParamCurve, ParamCurveArclen, PathSeg, Point, QuadBez};
use serde::{Deserialize, Serialize};

/// Arc lengths are computed to this accuracy (metres).
pub const ARC_LENGTH_ACCURACY: f64 = 1e-7;

/// The shape of one outline edge between its end points. Control points are absolute, in the piece's own plane, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EdgeShape {
    /// Straight.
    Line,
    /// Circular arc: `radius` > 0 metres, SVG flags in y-up coordinates (`sweep` true travels counter-clockwise).
    Arc { radius: f64, large: bool, sweep: bool },
    /// Quadratic Bézier.
    Quadratic { control: DVec2 },
    /// Cubic Bézier.
    Cubic { controls: [DVec2; 2] },
}

/// One edge of an outline: from its own start point to the start point of the next edge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Edge {
    /// Where the edge starts, metres in the piece's own plane.
    pub start: DVec2,
    /// What lies between start and end.
    pub shape: EdgeShape,
    /// A name from the source file ("left_collar"), if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
}

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

/// A rigid placement in space: `world = rotation * (x, y, 0) + translation`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpacePose {
    /// Metres.
    pub translation: DVec3,
    /// Unit quaternion.
    pub rotation: DQuat,
}

/// A flat piece of cloth.
///
/// Its front (outer) side is the one from which `outline` runs counter-clockwise: a clockwise outline is a piece drawn
/// from its back, as mirrored panels of GarmentCode are.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Piece {
    /// Shown to people; need not be unique.
    pub name: String,
    /// Closed: the last edge ends where the first starts.
    pub outline: Vec<Edge>,
    /// Where it lies in the pattern pane.
    pub pose: PlanePose,
    /// Where the source file put it round the body, if it did.
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
            outline: points
                .iter()
                .map(|&start| Edge { start, shape: EdgeShape::Line, label: None })
                .collect(),
            pose: PlanePose::default(),
            placement: None,
            label: None,
        }
    }

    /// Start and end of edge `i`. Panics when there is no such edge.
    pub fn edge_ends(&self, i: usize) -> (DVec2, DVec2) {
        (self.outline[i].start, self.outline[(i + 1) % self.outline.len()].start)
    }

    /// Edge `i` as curve segments, head to tail: one, or for an arc a few cubics. Panics when there is no such edge.
    pub fn edge_segments(&self, i: usize) -> Vec<PathSeg> {
        let (a, b) = self.edge_ends(i);
        match self.outline[i].shape {
            EdgeShape::Line => vec![Line::new(point(a), point(b)).into()],
            EdgeShape::Quadratic { control } => {
                vec![QuadBez::new(point(a), point(control), point(b)).into()]
            }
            EdgeShape::Cubic { controls: [c, d] } => {
                vec![CubicBez::new(point(a), point(c), point(d), point(b)).into()]
            }
            EdgeShape::Arc { radius, large, sweep } => arc_segments(a, b, radius, large, sweep),
        }
    }

    /// Arc length of edge `i` in metres, to [`ARC_LENGTH_ACCURACY`].
    pub fn edge_length(&self, i: usize) -> f64 {
        self.edge_segments(i).iter().map(|s| s.arclen(ARC_LENGTH_ACCURACY)).sum()
    }

    /// Points on edge `i` at `fractions` (0..=1, ascending) of its arc length. Ends are met exactly.
    pub fn edge_points(&self, i: usize, fractions: &[f64]) -> Vec<DVec2> {
        let (a, b) = self.edge_ends(i);
        let segments = self.edge_segments(i);
        let lengths: Vec<f64> = segments.iter().map(|s| s.arclen(ARC_LENGTH_ACCURACY)).collect();
        let total: f64 = lengths.iter().sum();
        fractions
            .iter()
            .map(|&f| {
                if f <= 0.0 {
                    return a;
                }
                if f >= 1.0 {
                    return b;
                }
                let mut rest = f * total;
                for (segment, &length) in segments.iter().zip(&lengths) {
                    if rest <= length {
                        let t = segment.inv_arclen(rest, ARC_LENGTH_ACCURACY);
                        let p = segment.eval(t);
                        return DVec2::new(p.x, p.y);
                    }
                    rest -= length;
                }
                b
            })
            .collect()
    }

    /// The outline as a closed polyline whose chords stay within `tolerance` metres of it; the last point is not the first.
    pub fn flattened(&self, tolerance: f64) -> Vec<DVec2> {
        let mut points = Vec::new();
        for i in 0..self.outline.len() {
            let (a, _) = self.edge_ends(i);
            points.push(a);
            for segment in self.edge_segments(i) {
                let start = segment.start();
                let path = kurbo::BezPath::from_path_segments(std::iter::once(segment));
                kurbo::flatten(path, tolerance, |element| {
                    if let kurbo::PathEl::LineTo(p) = element
                        && p != start
                    {
                        points.push(DVec2::new(p.x, p.y));
                    }
                });
            }
            // The end of an edge is the start of the next.
            points.pop();
        }
        points
    }

    /// Signed area of the outline flattened to 0.1 mm, square metres; positive when it runs counter-clockwise.
    pub fn signed_area(&self) -> f64 {
        let p = self.flattened(1e-4);
        (0..p.len()).map(|i| p[i].perp_dot(p[(i + 1) % p.len()]) / 2.0).sum()
    }
}

fn point(p: DVec2) -> Point {
    Point::new(p.x, p.y)
}

fn arc_segments(a: DVec2, b: DVec2, radius: f64, large: bool, sweep: bool) -> Vec<PathSeg> {
    let arc = kurbo::SvgArc {
        from: point(a),
        to: point(b),
        radii: kurbo::Vec2::new(radius, radius),
        x_rotation: 0.0,
        large_arc: large,
        sweep,
    };
    match kurbo::Arc::from_svg_arc(&arc) {
        Some(arc) => {
            let mut segments: Vec<PathSeg> = Vec::new();
            let mut from = point(a);
            arc.to_cubic_beziers(1e-8, |c, d, to| {
                segments.push(CubicBez::new(from, c, d, to).into());
                from = to;
            });
            if let Some(PathSeg::Cubic(last)) = segments.last_mut() {
                last.p3 = point(b);
            }
            segments
        }
        None => vec![Line::new(point(a), point(b)).into()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
