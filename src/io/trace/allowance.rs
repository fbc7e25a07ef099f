//! Seam allowances: the cut line at an even offset outside an outline, and where notches meet it.

use glam::DVec2;
use kurbo::{ParamCurve, ParamCurveDeriv, ParamCurveNearest};

use super::contour::Contour;
use super::fit;
use crate::pattern::piece::flattened_loop;
use crate::pattern::{Edge, Piece, curve};

/// Flattening tolerance of the outline that is offset, metres.
const CHORDS: f64 = 5e-5;
/// Mitre limit: a corner whose mitre would be longer than this many allowance widths is cut off.
const MITRE: f64 = 3.0;
/// Largest number of points of a flattened outline; of a finer one only every n-th point is used.
const MOST_POINTS: usize = 10_000;
/// Largest distance (metres) from a notch to a cut line that is taken to be its own.
const LONGEST_NOTCH: f64 = 0.05;

/// The cut line of `piece`: its own, else its outline offset by its allowance, else empty. In the piece's plane, metres.
pub fn cut_line(piece: &Piece) -> Vec<Edge> {
    if !piece.cut_line.is_empty() || piece.allowance <= 0.0 {
        return piece.cut_line.clone();
    }
    let outline = flattened_loop(&piece.outline, CHORDS);
    let step = outline.len() / MOST_POINTS + 1;
    let outline: Vec<DVec2> = outline.into_iter().step_by(step).collect();
    let points = offset(&outline, piece.allowance);
    fit::closed(&points, &vec![fit::Knot::Unknown; points.len()])
}

/// The line along which `piece` is cut, allowance included, as a closed polyline whose chords stay within `tolerance` metres of it;
/// in the piece's plane.
pub fn cutting_line(piece: &Piece, tolerance: f64) -> Vec<DVec2> {
    let line = cut_line(piece);
    flattened_loop(if line.is_empty() { &piece.outline } else { &line }, tolerance)
}

/// The tip of a notch at `at` on the outline, and the direction into the piece. The tip is the point of the cut line straight
/// outside, else `at` itself.
pub fn notch_tip(outline: &[Edge], cut_line: &[Edge], at: DVec2) -> [DVec2; 2] {
    let outward = outward(outline, at);
    let tip = if cut_line.is_empty() {
        None
    } else {
        Contour::new(flattened_loop(cut_line, CHORDS)).hit(at, outward)
    };
    [tip.filter(|tip| tip.distance(at) <= LONGEST_NOTCH).unwrap_or(at), -outward]
}

/// The outward normal of a closed line at its point nearest to `p`.
fn outward(outline: &[Edge], p: DVec2) -> DVec2 {
    let ends = (0..outline.len()).map(|i| (&outline[i], outline[(i + 1) % outline.len()].start));
    let segments = ends.flat_map(|(edge, end)| curve::segments(edge.start, edge.shape, end));
    let nearest = segments
        .map(|segment| (segment.nearest(kurbo::Point::new(p.x, p.y), 1e-9), segment))
        .min_by(|a, b| a.0.distance_sq.total_cmp(&b.0.distance_sq));
    let along = nearest.map_or(DVec2::X, |(near, segment)| {
        let tangent = segment.to_cubic().deriv().eval(near.t);
        DVec2::new(tangent.x, tangent.y).normalize_or(DVec2::X)
    });
    let area = Contour::new(flattened_loop(outline, CHORDS)).signed_area();
    -along.perp() * area.signum()
}

/// The closed polyline `points` offset outward by `width`, with mitred corners. Points that come nearer to the line than `width`
/// are dropped, which removes most loops.
fn offset(points: &[DVec2], width: f64) -> Vec<DVec2> {
    let line = Contour::new(points.to_vec());
    let side = -line.signed_area().signum();
    let n = points.len();
    let mut moved = Vec::with_capacity(n);
    for i in 0..n {
        let (a, b, c) = (points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
        let [before, after] = [b - a, c - b].map(|chord| chord.normalize_or_zero().perp() * side);
        let along = before + after;
        let scale = along.length_squared() / 2.0;
        if scale > 2.0 / (MITRE * MITRE) {
            moved.push(b + along / scale * width);
        } else {
            // A corner sharper than the mitre limit is cut off.
            let out = (b - a).normalize_or_zero() - (c - b).normalize_or_zero();
            let tip = b + out.normalize_or_zero() * width;
            moved.extend([b + before * width, tip, b + after * width]);
        }
    }
    let apart = width * (1.0 - 1e-3) - 2.0 * CHORDS;
    moved.retain(|&p| line.distance(p) >= apart);
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::EdgeShape;

    #[test]
    fn a_square_grows_by_its_allowance() {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|p| p * 0.2);
        for order in [[0, 1, 2, 3], [3, 2, 1, 0]] {
            let mut piece = Piece::polygon("square", &order.map(|i| corners[i]));
            assert!(cut_line(&piece).is_empty());
            piece.allowance = 0.01;
            let line = Contour::new(flattened_loop(&cut_line(&piece), 1e-4));
            assert_eq!(cut_line(&piece).len(), 4);
            assert!((line.signed_area().abs() - 0.22 * 0.22).abs() < 1e-9);
        }
    }

    /// An armhole narrower than the allowance is wide has no room for it.
    #[test]
    fn the_line_never_comes_nearer_than_the_allowance() {
        let mut piece = Piece::polygon(
            "c",
            &[(0.0, 0.0), (0.2, 0.0), (0.2, 0.05), (0.2, 0.07), (0.2, 0.2), (0.0, 0.2)]
                .map(|(x, y)| DVec2::new(x, y)),
        );
        piece.outline[2].shape =
            EdgeShape::Cubic { controls: [DVec2::new(0.1, 0.04), DVec2::new(0.1, 0.08)] };
        piece.allowance = 0.015;
        let outline = Contour::new(piece.flattened(1e-5));
        for p in flattened_loop(&cut_line(&piece), 1e-4) {
            let distance = outline.distance(p);
            assert!(distance > 0.0145 && !outline.contains(p), "{p}: {distance}");
        }
    }
}
