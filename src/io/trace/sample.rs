//! Samples curves at points, for formats that have only polylines.

use glam::DVec2;
use kurbo::{ParamCurve, PathSeg};

use super::fit::Knot;
use crate::pattern::{Edge, EdgeShape, curve};

/// Largest distance between a chord and its curve, metres.
const SAGITTA: f64 = 5e-5;
/// Smallest number of chords of one curve.
const FEWEST: usize = 8;
/// Largest number of chords of one curve.
const MOST: usize = 400;

/// Points on a closed line, the first not repeated, and the kind of each.
pub fn closed(edges: &[Edge]) -> (Vec<DVec2>, Vec<Knot>) {
    let end = edges.first().map_or(DVec2::ZERO, |e| e.start);
    open(edges, end)
}

/// Points on an open line without its end, and the kind of each.
pub fn open(edges: &[Edge], end: DVec2) -> (Vec<DVec2>, Vec<Knot>) {
    let (mut points, mut knots) = (Vec::new(), Vec::new());
    for (i, edge) in edges.iter().enumerate() {
        let to = edges.get(i + 1).map_or(end, |next| next.start);
        points.push(edge.start);
        knots.push(if edge.smooth { Knot::Smooth } else { Knot::Corner });
        inside(edge, to, &mut points);
        knots.resize(points.len(), Knot::Curve);
    }
    (points, knots)
}

/// Adds points inside an edge, at even steps of the curve's own parameter.
fn inside(edge: &Edge, to: DVec2, points: &mut Vec<DVec2>) {
    let count = |n: f64| (n.ceil() as usize).clamp(FEWEST, MOST);
    let fractions = |n: usize| (1..n).map(move |i| i as f64 / n as f64);
    match edge.shape {
        EdgeShape::Line => {}
        EdgeShape::Arc { .. } => {
            let Some(arc) = curve::arc(edge.start, edge.shape, to) else { return };
            let step = 2.0 * (1.0 - SAGITTA / arc.radius).clamp(-1.0, 1.0).acos();
            points.extend(fractions(count(arc.turn.abs() / step)).map(|f| arc.at(f)));
        }
        EdgeShape::Quadratic { .. } | EdgeShape::Cubic { .. } => {
            for segment in curve::segments(edge.start, edge.shape, to) {
                let n = count((bend(segment) / 8.0 / SAGITTA).sqrt());
                points.extend(fractions(n).map(|f| {
                    let p = segment.eval(f);
                    DVec2::new(p.x, p.y)
                }));
            }
        }
    }
}

/// Upper bound of the second derivative of a segment by its parameter, metres.
fn bend(segment: PathSeg) -> f64 {
    let c = segment.to_cubic();
    let second = |a: kurbo::Point, b: kurbo::Point, c: kurbo::Point| ((a - b) + (c - b)).hypot() * 6.0;
    second(c.p0, c.p1, c.p2).max(second(c.p1, c.p2, c.p3))
}
