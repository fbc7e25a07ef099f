//! Curves between two points of a plane: lengths, points by arc length, splitting, reversing, mirroring.

use glam::DVec2;
use kurbo::{CubicBez, Line, ParamCurve, ParamCurveArclen, ParamCurveNearest, PathSeg, Point, QuadBez};

use crate::pattern::edge::{ARC_LENGTH_ACCURACY, Edge, EdgeShape};
use crate::pattern::grading::rule::GradeRule;

/// Accuracy of [`exact_length`], metres.
const FINEST_LENGTH: f64 = 1e-12;

/// The curve from `a` to `b` as segments, head to tail: one, or for an arc a few cubics.
pub fn segments(a: DVec2, shape: EdgeShape, b: DVec2) -> Vec<PathSeg> {
    match shape {
        EdgeShape::Line => vec![Line::new(point(a), point(b)).into()],
        EdgeShape::Quadratic { control } => vec![QuadBez::new(point(a), point(control), point(b)).into()],
        EdgeShape::Cubic { controls: [c, d] } => {
            vec![CubicBez::new(point(a), point(c), point(d), point(b)).into()]
        }
        EdgeShape::Arc { radius, large, sweep } => arc_segments(a, b, radius, large, sweep),
    }
}

/// Arc length of the curve in metres, to 1e-12.
pub fn exact_length(a: DVec2, shape: EdgeShape, b: DVec2) -> f64 {
    match shape {
        EdgeShape::Line => a.distance(b),
        EdgeShape::Arc { .. } => arc(a, shape, b).map_or(a.distance(b), |arc| arc.radius * arc.turn.abs()),
        _ => segments(a, shape, b).iter().map(|s| s.arclen(FINEST_LENGTH)).sum(),
    }
}

/// Points at `fractions` (0..=1, ascending) of the curve's arc length. Fractions 0 and 1 give exactly `a` and `b`.
pub fn points(a: DVec2, shape: EdgeShape, b: DVec2, fractions: &[f64]) -> Vec<DVec2> {
    let segments = segments(a, shape, b);
    let lengths: Vec<f64> = segments.iter().map(|s| s.arclen(ARC_LENGTH_ACCURACY)).collect();
    let total: f64 = lengths.iter().sum();
    let at = |f: f64| {
        if f <= 0.0 {
            return a;
        }
        if f >= 1.0 {
            return b;
        }
        let mut rest = f * total;
        for (segment, &length) in segments.iter().zip(&lengths) {
            if rest <= length {
                let p = segment.eval(segment.inv_arclen(rest, ARC_LENGTH_ACCURACY));
                return DVec2::new(p.x, p.y);
            }
            rest -= length;
        }
        b
    };
    fractions.iter().map(|&f| at(f)).collect()
}

/// Appends to `points` a polyline along the curve, from `a` on and without `b`, whose chords stay within `tolerance`
/// metres of the curve.
pub fn flatten(a: DVec2, shape: EdgeShape, b: DVec2, tolerance: f64, points: &mut Vec<DVec2>) {
    points.push(a);
    for segment in segments(a, shape, b) {
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
    points.pop();
}

/// Splits the curve at `fractions` (inside 0..1, ascending) of its arc length. Returns the start and the shape of
/// each part; the first starts at `a`, the last ends at `b`.
pub fn split(a: DVec2, shape: EdgeShape, b: DVec2, fractions: &[f64]) -> Vec<(DVec2, EdgeShape)> {
    match shape {
        EdgeShape::Line => {
            let starts = std::iter::once(a).chain(fractions.iter().map(|&f| a.lerp(b, f)));
            starts.map(|p| (p, EdgeShape::Line)).collect()
        }
        EdgeShape::Arc { radius, sweep, .. } => {
            let Some(arc) = arc(a, shape, b) else {
                return split(a, EdgeShape::Line, b, fractions);
            };
            let mut parts = vec![(a, 0.0)];
            parts.extend(fractions.iter().map(|&f| (arc.at(f), f)));
            (0..parts.len())
                .map(|i| {
                    let until = parts.get(i + 1).map_or(1.0, |p| p.1);
                    let large = (until - parts[i].1) * arc.turn.abs() > std::f64::consts::PI;
                    (parts[i].0, EdgeShape::Arc { radius, large, sweep })
                })
                .collect()
        }
        EdgeShape::Quadratic { .. } | EdgeShape::Cubic { .. } => {
            let whole = segments(a, shape, b)[0];
            let length = whole.arclen(FINEST_LENGTH);
            let at = |f: f64| whole.inv_arclen(f * length, FINEST_LENGTH);
            let starts: Vec<f64> = std::iter::once(0.0).chain(fractions.iter().map(|&f| at(f))).collect();
            (0..starts.len())
                .map(|i| {
                    let part = whole.subsegment(starts[i]..starts.get(i + 1).copied().unwrap_or(1.0));
                    let start = if i == 0 { a } else { vector(part.start()) };
                    (start, shape_of(part))
                })
                .collect()
        }
    }
}

/// The point of a curve nearest to `p`: its fraction of the arc length, and its distance in metres.
pub fn nearest(segments: &[PathSeg], p: DVec2) -> (f64, f64) {
    let (mut best, mut before) = ((0.0, f64::INFINITY), 0.0);
    for segment in segments {
        let near = segment.nearest(point(p), 1e-9);
        if near.distance_sq < best.1 {
            best = (before + segment.subsegment(0.0..near.t).arclen(1e-10), near.distance_sq);
        }
        before += segment.arclen(1e-10);
    }
    ((best.0 / before.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0), best.1.sqrt())
}

fn shape_of(segment: PathSeg) -> EdgeShape {
    match segment {
        PathSeg::Line(_) => EdgeShape::Line,
        PathSeg::Quad(q) => EdgeShape::Quadratic { control: vector(q.p1) },
        PathSeg::Cubic(c) => EdgeShape::Cubic { controls: [vector(c.p1), vector(c.p2)] },
    }
}

impl EdgeShape {
    /// The same curve from its end to its start.
    pub fn reversed(self) -> Self {
        match self {
            Self::Line | Self::Quadratic { .. } => self,
            Self::Arc { radius, large, sweep } => Self::Arc { radius, large, sweep: !sweep },
            Self::Cubic { controls: [c, d] } => Self::Cubic { controls: [d, c] },
        }
    }

    /// The curve with every control point moved by `map`; `turns` says that the map is a reflection. Arcs come out
    /// right only where the map keeps lengths; see [`EdgeShape::carried`] for other maps.
    pub fn mapped(self, turns: bool, map: impl Fn(DVec2) -> DVec2) -> Self {
        match self {
            Self::Line => self,
            Self::Arc { radius, large, sweep } => Self::Arc { radius, large, sweep: sweep != turns },
            Self::Quadratic { control } => Self::Quadratic { control: map(control) },
            Self::Cubic { controls } => Self::Cubic { controls: controls.map(map) },
        }
    }

    /// The curve when its ends move from `a`, `b` to `c`, `d`: rotated and scaled with its chord.
    pub fn carried(self, [a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> Self {
        let (old, new) = (b - a, d - c);
        if old.length_squared() == 0.0 || (a == c && b == d) {
            return self;
        }
        // The complex number new / old rotates and scales.
        let factor = DVec2::new(new.dot(old), old.perp_dot(new)) / old.length_squared();
        match self {
            Self::Arc { radius, large, sweep } => {
                Self::Arc { radius: radius * factor.length(), large, sweep }
            }
            _ => self.mapped(false, |p| c + factor.rotate(p - a)),
        }
    }
}

/// The arc from `a` to `b` through `p`; a straight line when the three are collinear.
pub fn arc_through(a: DVec2, p: DVec2, b: DVec2) -> EdgeShape {
    let (u, v) = (p - a, b - a);
    let turn = u.perp_dot(v);
    if turn.abs() < 1e-6 * v.length_squared() {
        return EdgeShape::Line;
    }
    // The centre relative to `a`: at the same distance from all three points.
    let (uu, vv) = (u.length_squared(), v.length_squared());
    let centre = DVec2::new(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / (2.0 * turn);
    // The centre is on the same side of the chord as `p`: more than half a circle.
    let large = v.perp_dot(centre) * v.perp_dot(u) > 0.0;
    EdgeShape::Arc { radius: centre.length(), large, sweep: turn > 0.0 }
}

/// A closed line in the opposite direction; edge i of n becomes edge n-1-i.
pub fn reversed(edges: &[Edge]) -> Vec<Edge> {
    let n = edges.len();
    (0..n)
        .map(|i| {
            let edge = &edges[n - 1 - i];
            let next = &edges[(n - i) % n];
            Edge {
                start: next.start,
                shape: edge.shape.reversed(),
                smooth: next.smooth,
                corner: next.corner.reversed(),
                label: edge.label.clone(),
                rule: next.rule.clone(),
                trims: edge.trims,
            }
        })
        .collect()
}

/// The mirror image of a closed line in the line x = 0, in the opposite direction, so that its front stays the near side.
pub fn mirrored(edges: &[Edge]) -> Vec<Edge> {
    let mut new = reversed(edges);
    for edge in &mut new {
        edge.start = mirror(edge.start);
        edge.shape = edge.shape.mapped(true, mirror);
        edge.rule = edge.rule.as_ref().map(GradeRule::mirrored);
    }
    new
}

/// The mirror image of a point in the line x = 0.
pub fn mirror(p: DVec2) -> DVec2 {
    // Zero stays zero, not minus zero.
    DVec2::new(0.0 - p.x, p.y)
}

/// A circular arc given by its centre.
#[derive(Clone, Copy, Debug)]
pub struct ArcByCentre {
    /// The centre, metres.
    pub centre: DVec2,
    /// The radius, metres. Half the chord where the radius in the file was less.
    pub radius: f64,
    /// Angle of the start as seen from the centre, radians.
    pub start: f64,
    /// Angle from start to end, radians, positive counter-clockwise.
    pub turn: f64,
}

impl ArcByCentre {
    /// The point at a fraction (0..=1) of the arc.
    pub fn at(&self, fraction: f64) -> DVec2 {
        self.centre + DVec2::from_angle(self.start + fraction * self.turn) * self.radius
    }
}

/// The arc between `a` and `b` by its centre. None where `shape` is no arc or `a` and `b` are equal.
pub fn arc(a: DVec2, shape: EdgeShape, b: DVec2) -> Option<ArcByCentre> {
    let EdgeShape::Arc { radius, large, sweep } = shape else { return None };
    let chord = b - a;
    let length = chord.length();
    if length == 0.0 || !radius.is_finite() || radius <= 0.0 {
        return None;
    }
    let radius = radius.max(length / 2.0);
    let height = (radius * radius - length * length / 4.0).max(0.0).sqrt();
    let left = chord.perp() / length;
    let centre = (a + b) / 2.0 + left * if sweep != large { height } else { -height };
    let (from, to) = ((a - centre).to_angle(), (b - centre).to_angle());
    let around = std::f64::consts::TAU;
    let turn = if sweep { (to - from).rem_euclid(around) } else { -(from - to).rem_euclid(around) };
    Some(ArcByCentre { centre, radius, start: from, turn })
}

fn point(p: DVec2) -> Point {
    Point::new(p.x, p.y)
}

fn vector(p: Point) -> DVec2 {
    DVec2::new(p.x, p.y)
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
    use crate::pattern::AllowanceCorner;

    const A: DVec2 = DVec2::new(0.3, 0.1);
    const B: DVec2 = DVec2::new(-0.2, 0.4);

    fn shapes() -> Vec<EdgeShape> {
        let (c, d) = (DVec2::new(0.5, 0.5), DVec2::new(-0.4, 0.1));
        let mut all =
            vec![EdgeShape::Line, EdgeShape::Quadratic { control: c }, EdgeShape::Cubic { controls: [c, d] }];
        for (large, sweep) in [(false, false), (false, true), (true, false), (true, true)] {
            all.push(EdgeShape::Arc { radius: 0.4, large, sweep });
        }
        all
    }

    #[test]
    fn parts_of_a_curve_lie_on_it_and_are_as_long_as_asked() {
        for shape in shapes() {
            let whole = exact_length(A, shape, B);
            let parts = split(A, shape, B, &[0.2, 0.7]);
            let ends = [parts[1].0, parts[2].0, B];
            for ((&(start, part), end), share) in parts.iter().zip(ends).zip([0.2, 0.5, 0.3]) {
                let length = exact_length(start, part, end);
                assert!((length - share * whole).abs() < 1e-10, "{shape:?}: {length} of {whole}");
                let middle = points(start, part, end, &[0.5])[0];
                let near =
                    points(A, shape, B, &(0..=4000).map(|i| f64::from(i) / 4000.0).collect::<Vec<_>>())
                        .into_iter()
                        .map(|p| p.distance(middle))
                        .fold(f64::INFINITY, f64::min);
                assert!(near < 3e-4, "{shape:?} strays by {near}");
            }
        }
    }

    #[test]
    fn a_carried_curve_is_longer_as_its_chord_is() {
        let (c, d) = (DVec2::new(1.0, 1.0), DVec2::new(1.5, -0.7));
        for shape in shapes() {
            let carried = shape.carried([A, B], [c, d]);
            let ratio = exact_length(c, carried, d) / exact_length(A, shape, B);
            assert!((ratio - c.distance(d) / A.distance(B)).abs() < 1e-10, "{shape:?}");
        }
    }

    #[test]
    fn a_mirror_image_mirrored_is_the_line_itself() {
        let edges: Vec<Edge> = [(A, 1), (B, 2), (DVec2::ZERO, 3)]
            .map(|(start, i)| Edge {
                start,
                shape: shapes()[i],
                smooth: i == 2,
                corner: AllowanceCorner::ALL[i + 1],
                label: Some(i.to_string()),
                rule: (i == 1).then(|| GradeRule(vec![DVec2::new(0.01, 0.02), DVec2::ZERO])),
                ..Edge::default()
            })
            .to_vec();
        let image = mirrored(&edges);
        assert_eq!(mirrored(&image), edges);
        let middle = |edges: &[Edge], i: usize| {
            points(edges[i].start, edges[i].shape, edges[(i + 1) % 3].start, &[0.5])[0]
        };
        for i in 0..3 {
            assert!(middle(&image, 2 - i).distance(mirror(middle(&edges, i))) < 1e-7);
        }
    }
}
