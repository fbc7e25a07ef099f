//! Drawing outlines: open paths that are closed, or mirrored at the middle line of the body.

use glam::DVec2;
use kurbo::ParamCurveArclen;
use kurbo::common::solve_itp;

use crate::pattern::{Edge, EdgeShape, Piece, curve};

/// An open path, with the cloth on its left.
#[derive(Clone, Debug)]
pub struct Path {
    edges: Vec<Edge>,
    at: DVec2,
}

impl Path {
    /// Starts at `start`, metres.
    pub fn from(start: DVec2) -> Self {
        Self { edges: Vec::new(), at: start }
    }

    /// A straight edge called `label`.
    pub fn line(self, label: &str, to: DVec2) -> Self {
        self.edge(label, EdgeShape::Line, to)
    }

    /// A cubic edge called `label`.
    pub fn curve(self, label: &str, first: DVec2, second: DVec2, to: DVec2) -> Self {
        self.edge(label, EdgeShape::Cubic { controls: [first, second] }, to)
    }

    /// An arc of `radius` metres called `label`, no more than half a circle, counter-clockwise where `sweep`.
    pub fn arc(self, label: &str, radius: f64, sweep: bool, to: DVec2) -> Self {
        self.edge(label, EdgeShape::Arc { radius, large: false, sweep }, to)
    }

    /// A straight line called `label` with a dart: centred `at` metres along the line, `width` wide, `depth` deep into the cloth.
    /// After the dart is sewn the line is shorter than the distance to `to` by `width`.
    pub fn darted(self, label: &str, to: DVec2, dart: Dart) -> Self {
        let Dart { at, width, depth } = dart;
        let along = (to - self.at).normalize_or_zero();
        let middle = self.at + along * at;
        let [first, second] = [middle - along * (width / 2.0), middle + along * (width / 2.0)];
        let leg = format!("dart {label}");
        let tip = middle + along.perp() * depth;
        self.line(label, first).line(&leg, tip).line(&leg, second).line(label, to)
    }

    /// End point, metres.
    pub fn end(&self) -> DVec2 {
        self.at
    }

    fn edge(mut self, label: &str, shape: EdgeShape, to: DVec2) -> Self {
        self.edges.push(Edge { start: self.at, shape, label: Some(label.to_owned()), ..Edge::default() });
        self.at = to;
        self
    }

    /// Closes the path into a piece, if needed by a straight edge called `last` back to the start.
    pub fn closed(mut self, name: &str, last: &str) -> Piece {
        let start = self.edges.first().map_or(self.at, |edge| edge.start);
        if self.at.distance(start) > 1e-9 {
            self = self.line(last, start);
        }
        Piece { name: name.to_owned(), outline: self.edges, ..Piece::default() }
    }

    /// A piece of this half, which is at the left of the body and has its ends on x = 0, and its mirror image. "left" or "right"
    /// is appended to labels.
    pub fn whole(self, name: &str) -> Piece {
        let (left, end) = (self.edges, self.at);
        let mut both = left.clone();
        // Close the half along the middle, mirror it, and remove the middle edge again.
        let mut closed = left;
        closed.push(Edge { start: end, ..Edge::default() });
        let mut right = curve::mirrored(&closed);
        right.remove(0);
        // The mirror image starts where the left half ends: at the upper end of the middle.
        both.iter_mut().for_each(|edge| edge.label = suffixed(edge, "left"));
        right.iter_mut().for_each(|edge| edge.label = suffixed(edge, "right"));
        both.extend(right);
        Piece { name: name.to_owned(), outline: both, ..Piece::default() }
    }

    /// A piece of this left half alone, closed by an edge called `closing`; "left" is appended to labels.
    pub fn half(self, name: &str, closing: &str) -> Piece {
        let mut piece = self.closed(name, closing);
        piece.outline.iter_mut().for_each(|edge| edge.label = suffixed(edge, "left"));
        piece
    }
}

/// A dart on a straight line; metres.
#[derive(Clone, Copy, Debug)]
pub struct Dart {
    /// Distance from the start of the line to the dart's centre.
    pub at: f64,
    /// Distance between its legs on the line.
    pub width: f64,
    /// Distance from the line to its tip.
    pub depth: f64,
}

fn suffixed(edge: &Edge, side: &str) -> Option<String> {
    edge.label.as_ref().map(|label| format!("{label} {side}"))
}

/// A piece of the left side mirrored to the right: "left" becomes "right" in its name and labels.
pub fn to_the_right(piece: &Piece) -> Piece {
    let mut outline = curve::mirrored(&piece.outline);
    for edge in &mut outline {
        edge.label = edge.label.as_ref().map(|label| label.replace("left", "right"));
    }
    Piece { name: piece.name.replace("left", "right"), outline, ..piece.clone() }
}

/// Accuracy of lengths and of solved equations, metres.
const ACCURACY: f64 = 1e-9;

/// Length of the cubic from `a` to `b`, metres, to 1e-9.
pub fn cubic_length(a: DVec2, controls: [DVec2; 2], b: DVec2) -> f64 {
    let segments = curve::segments(a, EdgeShape::Cubic { controls }, b);
    segments.iter().map(|segment| segment.arclen(ACCURACY)).sum()
}

/// Zero of the monotonic function `f` between `low` and `high`, to 1e-9; where there is none, the end at which `f` is nearer to
/// it.
pub fn solved(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (at_low, at_high) = (f(low), f(high));
    if at_low * at_high >= 0.0 {
        return if at_low.abs() < at_high.abs() { low } else { high };
    }
    let sign = at_high.signum();
    // Kurbo's ITP method: at most two steps more than bisection, usually far fewer.
    let slope = 0.2 / (high - low);
    solve_itp(|x| sign * f(x), low, high, ACCURACY, 1, slope, sign * at_low, sign * at_high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_piece_is_its_own_mirror_image() {
        let half = Path::from(DVec2::new(0.0, 0.0))
            .darted("waist", DVec2::new(0.3, 0.0), Dart { at: 0.15, width: 0.02, depth: 0.1 })
            .line("side", DVec2::new(0.25, 0.4))
            .curve("neck", DVec2::new(0.2, 0.3), DVec2::new(0.1, 0.3), DVec2::new(0.0, 0.3));
        let whole = half.clone().whole("front");
        assert_eq!(whole.outline.len(), 12);
        let one = half.half("front left", "centre");
        assert!((whole.signed_area() - 2.0 * one.signed_area()).abs() < 1e-9 && one.signed_area() > 0.0);
        let right = to_the_right(&one);
        assert!((right.signed_area() - one.signed_area()).abs() < 1e-9);
        assert_eq!(right.name, "front right");
        let lengths: f64 = (0..6).map(|i| whole.exact_edge_length(i) - whole.exact_edge_length(11 - i)).sum();
        assert!(lengths.abs() < 1e-12);
    }

    #[test]
    fn roots_are_found() {
        assert!((solved(0.0, 4.0, |x| x * x - 2.0) - 2.0_f64.sqrt()).abs() < 1e-9);
        assert!((solved(0.0, 4.0, |x| 2.0 - x) - 2.0).abs() < 1e-9);
        assert_eq!([solved(0.0, 1.0, |x| x + 1.0), solved(0.0, 1.0, |x| x - 2.0)], [0.0, 1.0]);
    }
}
