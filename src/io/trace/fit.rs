//! Fits lines, arcs and cubic Béziers to the points of a polyline, since drawing programs write curves as polylines.
//!
//! Between two corners one straight line, one circular arc or one cubic is fitted where possible, else several. A curve that this
//! program wrote as points comes back as the same curve: the fit minimises true distances (Gauss-Newton on the two control
//! points, each point projected to the nearest place on the curve), so it converges to the original and not only near it.

use glam::{DMat4, DVec2, DVec4};
use kurbo::{CubicBez, ParamCurve, ParamCurveArclen, ParamCurveDeriv};

use crate::pattern::{Edge, EdgeShape};

/// Largest distance of a point from a fitted cubic, metres.
const TOLERANCE: f64 = 1e-4;
/// Largest distance of a point from a fitted line or arc, metres; numbers of a file are rounded.
const EXACT: f64 = 5e-6;
/// Largest radius of a fitted arc, metres; flatter arcs become cubics.
const LARGEST_RADIUS: f64 = 10.0;
/// Turning angle of a polyline (radians) above which a point is a corner.
const SHARPEST_CURVE: f64 = 0.5;
/// Height of the curve over the shorter of a point's two chords (metres) above which the point is a corner, even if it turns by
/// less than [`SHARPEST_CURVE`].
const FLATTEST_CORNER: f64 = 3e-4;
/// Turning angle (radians) above which a point is a corner even where the file marks it as a point of a curve.
const SHARPEST_TURN: f64 = 1.0;
/// Turning angle (radians) that a fitted curve may have in addition to that of its points.
const SLACK_TURN: f64 = 0.2;
/// Number of samples at which a fitted curve is checked.
const SAMPLES: usize = 64;
/// Number of Gauss-Newton steps after which the fit is given up if points are still further off than [`HOPELESS`].
const HOPELESS_STEPS: usize = 6;
/// Root mean square distance (metres) above which a fit is given up after [`HOPELESS_STEPS`] steps.
const HOPELESS: f64 = 5e-3;
/// Largest number of Gauss-Newton steps.
const STEPS: usize = 60;
/// Number of points above which a range is split near its middle (in its middle half), so that no file takes long.
const LONG_RANGE: usize = 64;

/// What a file states about a point of a polyline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Knot {
    /// Nothing is stated; the angle decides.
    Unknown,
    /// Two edges meet here at an angle.
    Corner,
    /// Two edges meet here smoothly.
    Smooth,
    /// A point within a curve, not the end of an edge.
    Curve,
}

/// Fits the edges of a closed line through `points`, the first of which is not repeated. `knots` has an entry for each point.
pub fn closed(points: &[DVec2], knots: &[Knot]) -> Vec<Edge> {
    let n = points.len();
    if n < 3 {
        return points.iter().map(|&start| Edge { start, ..Edge::default() }).collect();
    }
    let around = |i: usize| [points[(i + n - 1) % n], points[i], points[(i + 1) % n]];
    let mut knots: Vec<Knot> = (0..n).map(|i| settled(knots[i], around(i))).collect();
    if knots.iter().filter(|k| **k != Knot::Curve).count() < 2 {
        // A closed line needs two edges: with fewer than two corners it is also split half-way round.
        let first = knots.iter().position(|k| *k != Knot::Curve).unwrap_or(0);
        for i in [first, (first + n / 2) % n] {
            if knots[i] == Knot::Curve {
                knots[i] = Knot::Smooth;
            }
        }
    }
    let Some(first) = knots.iter().position(|k| *k != Knot::Curve) else { return Vec::new() };
    let order: Vec<usize> = (0..=n).map(|i| (first + i) % n).collect();
    let points: Vec<DVec2> = order.iter().map(|&i| points[i]).collect();
    let knots: Vec<Knot> = order.iter().map(|&i| knots[i]).collect();
    edges(&points, &knots)
}

/// Fits the edges of an open line through `points` (two or more); the last edge ends at the last point.
pub fn open(points: &[DVec2], knots: &[Knot]) -> Vec<Edge> {
    let last = points.len() - 1;
    let knots: Vec<Knot> = (0..=last)
        .map(|i| match i {
            _ if i == 0 || i == last => Knot::Corner,
            _ => settled(knots[i], [points[i - 1], points[i], points[i + 1]]),
        })
        .collect();
    edges(points, &knots)
}

/// Decides whether `b`, between `a` and `c`, is a corner where the file does not state it.
fn settled(knot: Knot, [a, b, c]: [DVec2; 3]) -> Knot {
    let turn = (b - a).angle_to(c - b).abs();
    let off_chord = a.distance(b).min(b.distance(c)) * turn / 8.0;
    match knot {
        Knot::Unknown if turn > SHARPEST_CURVE || off_chord > FLATTEST_CORNER => Knot::Corner,
        Knot::Unknown => Knot::Curve,
        Knot::Curve if turn > SHARPEST_TURN => Knot::Corner,
        told => told,
    }
}

/// Fits the edges of a line. `knots` holds no `Unknown`, and its first and last entry are ends of edges.
fn edges(points: &[DVec2], knots: &[Knot]) -> Vec<Edge> {
    let mut edges = Vec::new();
    let mut from = 0;
    for to in 1..points.len() {
        if knots[to] == Knot::Curve {
            continue;
        }
        let first = edges.len();
        run(&points[from..=to], &mut edges);
        edges[first].smooth = knots[from] == Knot::Smooth;
        from = to;
    }
    edges
}

/// Fits the edges between two ends of edges. Places where the run is split are smooth.
fn run(points: &[DVec2], edges: &mut Vec<Edge>) {
    let mut ranges = vec![(0, points.len() - 1)];
    while let Some((from, to)) = ranges.pop() {
        let part = &points[from..=to];
        match fitted(part) {
            Ok(shape) => {
                edges.push(Edge { start: part[0], shape, smooth: from > 0, ..Edge::default() });
            }
            Err(worst) => {
                let length = to - from;
                let margin = if length > LONG_RANGE { length / 4 } else { 1 };
                let at = from + worst.clamp(margin, length - margin);
                ranges.push((at, to));
                ranges.push((from, at));
            }
        }
    }
}

/// One shape that fits all of `points`, or the index of the inner point at which to split.
fn fitted(points: &[DVec2]) -> Result<EdgeShape, usize> {
    let last = points.len() - 1;
    if last == 1 || is_straight(points) {
        return Ok(EdgeShape::Line);
    }
    if let Some(arc) = arc_through(points) {
        return Ok(arc);
    }
    if last == 2 {
        return Err(1);
    }
    let mut cubic = Cubic::near(points);
    cubic.improve(points);
    match cubic.worst(points) {
        None => {
            let [c, d] = cubic.controls;
            Ok(EdgeShape::Cubic { controls: [c, d] })
        }
        Some(at) => Err(at),
    }
}

fn is_straight(points: &[DVec2]) -> bool {
    let (a, b) = (points[0], points[points.len() - 1]);
    let along = (b - a).normalize_or_zero();
    let mut reached = 0.0;
    along != DVec2::ZERO
        && points.iter().all(|&p| {
            let at = (p - a).dot(along);
            let forward = at >= reached - EXACT;
            reached = at;
            forward && (p - a).perp_dot(along).abs() <= EXACT
        })
}

/// The arc through the ends and the middle point, if all other points are on it in order.
fn arc_through(points: &[DVec2]) -> Option<EdgeShape> {
    let last = points.len() - 1;
    let (a, m, b) = (points[0], points[last / 2], points[last]);
    let centre = circle_centre(a, m, b)?;
    let radius = centre.distance(a);
    if radius > LARGEST_RADIUS || points.iter().any(|p| (p.distance(centre) - radius).abs() > EXACT) {
        return None;
    }
    let turns = points.windows(2).map(|w| (w[0] - centre).angle_to(w[1] - centre));
    let total: f64 = turns.clone().sum();
    let one_way = turns.clone().all(|turn| turn * total > 0.0);
    // Points that turn by more would be corners.
    let fine = turns.clone().all(|turn| turn.abs() < 2.0 * SHARPEST_TURN);
    (one_way && fine && total.abs() < std::f64::consts::TAU - 1e-3).then_some(EdgeShape::Arc {
        radius,
        large: total.abs() > std::f64::consts::PI,
        sweep: total > 0.0,
    })
}

fn circle_centre(a: DVec2, b: DVec2, c: DVec2) -> Option<DVec2> {
    let (u, v) = (b - a, c - a);
    let twice_area = 2.0 * u.perp_dot(v);
    let centre = a + (u.length_squared() * -v.perp() + v.length_squared() * u.perp()) / twice_area;
    (centre.is_finite() && twice_area != 0.0).then_some(centre)
}

/// A cubic Bézier with fixed ends, and the parameter of each point on it.
struct Cubic {
    ends: [DVec2; 2],
    controls: [DVec2; 2],
    /// A parameter in 0..=1 for each point, ends included.
    at: Vec<f64>,
}

impl Cubic {
    /// The least-squares cubic for chord-length parameters.
    fn near(points: &[DVec2]) -> Self {
        let ends = [points[0], points[points.len() - 1]];
        let mut at = vec![0.0];
        for w in points.windows(2) {
            at.push(at[at.len() - 1] + w[0].distance(w[1]));
        }
        let total = at[at.len() - 1];
        at.iter_mut().for_each(|t| *t /= total);
        let mut cubic =
            Self { ends, controls: [ends[0].lerp(ends[1], 1.0 / 3.0), ends[0].lerp(ends[1], 2.0 / 3.0)], at };
        cubic.settle_controls(points);
        cubic
    }

    /// Solves for the control points by linear least squares with fixed parameters.
    fn settle_controls(&mut self, points: &[DVec2]) {
        let (mut cc, mut cd, mut dd) = (0.0, 0.0, 0.0);
        let (mut rc, mut rd) = (DVec2::ZERO, DVec2::ZERO);
        for (&p, &t) in points.iter().zip(&self.at) {
            let [a, c, d, b] = weights(t);
            let rest = p - self.ends[0] * a - self.ends[1] * b;
            cc += c * c;
            cd += c * d;
            dd += d * d;
            rc += rest * c;
            rd += rest * d;
        }
        let determinant = cc * dd - cd * cd;
        if determinant > 1e-12 {
            self.controls = [(rc * dd - rd * cd) / determinant, (rd * cc - rc * cd) / determinant];
        }
    }

    fn curve(&self) -> CubicBez {
        let [a, c, d, b] = [self.ends[0], self.controls[0], self.controls[1], self.ends[1]]
            .map(|p| kurbo::Point::new(p.x, p.y));
        CubicBez::new(a, c, d, b)
    }

    /// Moves each parameter to the nearest place on the curve, by Newton steps from its current value.
    fn project(&mut self, points: &[DVec2]) {
        let curve = self.curve();
        let (first, second) = (curve.deriv(), curve.deriv().deriv());
        let last = points.len() - 1;
        for (&p, t) in points.iter().zip(&mut self.at).skip(1).take(last - 1) {
            for _ in 0..4 {
                let off = vector(curve.eval(*t)) - p;
                let (tangent, bend) = (vector(first.eval(*t)), vector(second.eval(*t)));
                let slope = tangent.length_squared() + off.dot(bend);
                if slope <= 0.0 {
                    break;
                }
                *t = (*t - off.dot(tangent) / slope).clamp(0.0, 1.0);
            }
        }
    }

    /// Sum of squared distances between the points and their places on the curve, m².
    fn cost(&self, points: &[DVec2]) -> f64 {
        let curve = self.curve();
        points.iter().zip(&self.at).map(|(&p, &t)| p.distance_squared(vector(curve.eval(t)))).sum()
    }

    /// Damped Gauss-Newton steps until the control points no longer move.
    fn improve(&mut self, points: &[DVec2]) {
        self.project(points);
        let mut cost = self.cost(points);
        let mut damping = 1e-6;
        for taken in 0..STEPS {
            // The points are still too far off, so the run must be split.
            if taken >= HOPELESS_STEPS && cost > points.len() as f64 * HOPELESS * HOPELESS {
                return;
            }
            let Some(step) = self.step(points, damping) else { return };
            let before = (self.controls, self.at.clone());
            self.controls = [
                self.controls[0] + step.truncate().truncate(),
                self.controls[1] + DVec2::new(step.z, step.w),
            ];
            self.project(points);
            let new = self.cost(points);
            if new <= cost {
                cost = new;
                damping = (damping * 0.1_f64).max(1e-14);
                if step.length() < 1e-12 {
                    return;
                }
            } else {
                (self.controls, self.at) = before;
                damping *= 10.0;
                if damping > 1e6 {
                    return;
                }
            }
        }
    }

    /// The Gauss-Newton step of both control points (x, y, x, y): it cancels the distances along the normals to first order.
    fn step(&self, points: &[DVec2], damping: f64) -> Option<DVec4> {
        let curve = self.curve();
        let derivative = curve.deriv();
        let (mut matrix, mut right) = (DMat4::ZERO, DVec4::ZERO);
        for (&p, &t) in points.iter().zip(&self.at) {
            let normal = vector(derivative.eval(t)).perp().normalize_or_zero();
            let off = (p - vector(curve.eval(t))).dot(normal);
            let [_, c, d, _] = weights(t);
            let row = DVec4::new(c * normal.x, c * normal.y, d * normal.x, d * normal.y);
            matrix += DMat4::from_cols(row * row.x, row * row.y, row * row.z, row * row.w);
            right += row * off;
        }
        let scale = damping * points.len() as f64 + 1e-15;
        let step = (matrix + DMat4::from_diagonal(DVec4::splat(scale))).inverse() * right;
        step.is_finite().then_some(step)
    }

    /// The inner point at which to split because the curve is too far off there, if there is one. Between points the curve may
    /// leave the chord by as much as a curve does that turns like the polyline.
    fn worst(&self, points: &[DVec2]) -> Option<usize> {
        let curve = self.curve();
        let last = points.len() - 1;
        let (mut worst, mut most) = (None, 1.0);
        let mut look = |at: usize, excess: f64| {
            if excess > most || excess.is_nan() {
                (worst, most) = (Some(at), excess);
            }
        };
        for (i, (p, &t)) in points.iter().zip(&self.at).enumerate().take(last).skip(1) {
            look(i, p.distance(vector(curve.eval(t))) / TOLERANCE);
        }
        for i in 0..last {
            let (a, b) = (points[i], points[i + 1]);
            let middle = vector(curve.eval((self.at[i] + self.at[i + 1]) / 2.0));
            let chord = (b - a).normalize_or_zero();
            let off = (middle - a).perp_dot(chord).abs();
            let turn = |k: usize| match k {
                0 => 0.0,
                _ if k == last => 0.0,
                _ => (points[k] - points[k - 1]).angle_to(points[k + 1] - points[k]).abs(),
            };
            let may = TOLERANCE + a.distance(b) * turn(i).max(turn(i + 1)) / 4.0;
            let inside = if i + 1 < last { i + 1 } else { i };
            look(inside.max(1), off / may);
        }
        if worst.is_none() {
            return self.hook(points);
        }
        worst
    }

    /// The inner point at which to split because the curve turns much more than its points or is much longer than the polyline,
    /// such as in a loop between two points.
    fn hook(&self, points: &[DVec2]) -> Option<usize> {
        let curve = self.curve();
        let last = points.len() - 1;
        let turn = |a: DVec2, b: DVec2, c: DVec2| (b - a).angle_to(c - b).abs();
        let turns: Vec<f64> = points.windows(3).map(|w| turn(w[0], w[1], w[2])).collect();
        let ends = turns.first().unwrap_or(&0.0) + turns.last().unwrap_or(&0.0);
        let may = 1.1 * turns.iter().sum::<f64>() + ends + SLACK_TURN;
        let samples: Vec<DVec2> =
            (0..=SAMPLES).map(|i| vector(curve.eval(i as f64 / SAMPLES as f64))).collect();
        let turns: Vec<f64> = samples.windows(3).map(|w| turn(w[0], w[1], w[2])).collect();
        let straight: f64 = points.windows(2).map(|w| w[0].distance(w[1])).sum();
        let sound = turns.iter().sum::<f64>() <= may && curve.arclen(TOLERANCE) < 1.1 * straight;
        if sound {
            return None;
        }
        let sharpest = (0..turns.len()).max_by(|&i, &j| turns[i].total_cmp(&turns[j])).unwrap_or(0);
        let t = (sharpest + 1) as f64 / SAMPLES as f64;
        Some(self.at.partition_point(|at| *at < t).clamp(1, last - 1))
    }
}

/// The four cubic Bernstein polynomials at `t`.
fn weights(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

fn vector(p: kurbo::Point) -> DVec2 {
    DVec2::new(p.x, p.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::trace::sample;

    fn p(x: f64, y: f64) -> DVec2 {
        DVec2::new(x, y)
    }

    /// Sampled and fitted, a line of every shape is itself.
    #[test]
    fn samples_of_an_outline_give_the_outline() {
        let shapes = [
            EdgeShape::Cubic { controls: [p(0.1, -0.08), p(0.22, 0.09)] },
            EdgeShape::Line,
            EdgeShape::Quadratic { control: p(0.2, 0.5) },
            EdgeShape::Arc { radius: 0.2, large: false, sweep: true },
            EdgeShape::Arc { radius: 0.08, large: true, sweep: true },
        ];
        let starts = [p(0.0, 0.0), p(0.3, 0.0), p(0.3, 0.4), p(0.1, 0.45), p(0.0, 0.3)];
        let mut edges: Vec<Edge> = shapes
            .into_iter()
            .zip(starts)
            .map(|(shape, start)| Edge { shape, start, ..Edge::default() })
            .collect();
        edges[3].smooth = true;
        let (points, knots) = sample::closed(&edges);
        let again = closed(&points, &knots);
        assert_eq!(again.len(), edges.len(), "{again:?}");
        for i in 0..edges.len() {
            let ends = |e: &[Edge]| (e[i].start, e[(i + 1) % e.len()].start);
            let ((a, b), (c, d)) = (ends(&edges), ends(&again));
            for f in [0.1, 0.5, 0.8] {
                let at = |a, s, b| crate::pattern::curve::points(a, s, b, &[f])[0];
                let off = at(a, edges[i].shape, b).distance(at(c, again[i].shape, d));
                // Places are found by arc length, which is to 1e-7.
                assert!(off < 1e-6, "edge {i}: {off} {:?}", again[i]);
            }
            assert_eq!(edges[i].smooth, again[i].smooth);
        }
    }

    #[test]
    fn a_polygon_stays_a_polygon() {
        let points = [p(0.0, 0.0), p(0.3, 0.02), p(0.6, 0.0), p(0.6, 0.5), p(0.0, 0.5)];
        let edges = closed(&points, &[Knot::Unknown; 5]);
        assert_eq!(edges.len(), 5);
        assert!(edges.iter().all(|e| e.shape == EdgeShape::Line && !e.smooth));
    }

    /// A neck drawn with chords of 5 mm between two straight lines.
    #[test]
    fn chords_without_names_become_curves() {
        let mut points = vec![p(0.0, 0.0), p(0.5, 0.0), p(0.5, 0.6)];
        points.extend((0..=30).map(|i| {
            let x = f64::from(i) / 30.0;
            p(0.4 - 0.3 * x, 0.62 - 0.1 * (x * std::f64::consts::PI).sin())
        }));
        points.push(p(0.0, 0.6));
        let edges = closed(&points, &vec![Knot::Unknown; points.len()]);
        assert!((6..=9).contains(&edges.len()), "{}", edges.len());
    }
}
