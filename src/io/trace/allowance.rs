//! Seam allowances: the cut line at an even offset outside an outline, and where notches meet it.

use glam::DVec2;
use kurbo::{ParamCurve, ParamCurveDeriv, ParamCurveNearest};

use super::contour::Contour;
use super::fit;
use super::outer::outer;
use crate::pattern::piece::flattened_loop;
use crate::pattern::{AllowanceCorner, Edge, Piece, Side, curve};

/// Flattening tolerance of the outline that is offset, metres.
const CHORDS: f64 = 5e-5;
/// Mitre limit: a corner whose mitre would be longer than this many allowance widths is cut off.
const MITRE: f64 = 3.0;
/// Sine of the least angle at which the allowance has a corner that can be shaped.
const LEAST_TURN: f64 = 0.05;
/// Distance within which two points of an offset line are the same, metres.
const SAME: f64 = 1e-8;
/// Largest number of points of a flattened outline; of a finer one only every n-th point is used.
const MOST_POINTS: usize = 10_000;
/// Largest distance (metres) from a notch to a cut line that is taken to be its own.
const LONGEST_NOTCH: f64 = 0.05;

/// The cut line of `piece`: its own, else its outline offset by its allowance, else empty. In the piece's plane, metres.
pub fn cut_line(piece: &Piece) -> Vec<Edge> {
    if !piece.cut_line.is_empty() || piece.allowance <= 0.0 {
        return piece.cut_line.clone();
    }
    let moved = offset(&outline(piece, CHORDS), piece.allowance, CHORDS);
    let points: Vec<DVec2> = moved.iter().map(|point| point.at).collect();
    let knot = |point: &Moved| if point.is_corner { fit::Knot::Corner } else { fit::Knot::Unknown };
    fit::closed(&points, &moved.iter().map(knot).collect::<Vec<_>>())
}

/// The allowance's edge of a piece without a cut line of its own, as a closed polyline about `tolerance` metres from it; in the
/// piece's plane.
pub fn allowance_line(piece: &Piece, tolerance: f64) -> Vec<DVec2> {
    offset(&outline(piece, tolerance), piece.allowance, tolerance).into_iter().map(|point| point.at).collect()
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

/// A point of an outline.
#[derive(Clone, Copy, Debug)]
struct Point {
    at: DVec2,
    /// The shape of the allowance, where two edges meet here.
    corner: Option<AllowanceCorner>,
}

/// A point of the edge of an allowance.
#[derive(Clone, Copy, Debug)]
struct Moved {
    at: DVec2,
    /// Whether it is certainly a corner; else the angle there decides.
    is_corner: bool,
}

/// The outline of `piece` as a closed polyline whose chords stay within `tolerance` metres of it.
fn outline(piece: &Piece, tolerance: f64) -> Vec<Point> {
    let mut all: Vec<Point> = Vec::new();
    let mut chords = Vec::new();
    for (i, edge) in piece.outline.iter().enumerate() {
        chords.clear();
        let end = piece.outline[(i + 1) % piece.outline.len()].start;
        curve::flatten(edge.start, edge.shape, end, tolerance, &mut chords);
        let corner = |k: usize| (k == 0).then_some(edge.corner);
        all.extend(chords.iter().enumerate().map(|(k, &at)| Point { at, corner: corner(k) }));
    }
    let step = all.len() / MOST_POINTS + 1;
    let is_kept = |(k, point): (usize, Point)| (k % step == 0 || point.corner.is_some()).then_some(point);
    all.into_iter().enumerate().filter_map(is_kept).collect()
}

/// A point of an outline with the directions (unit vectors) that its offset follows from.
#[derive(Clone, Copy, Debug)]
struct Bend {
    at: DVec2,
    /// Along the chord before it and the one after it.
    along: [DVec2; 2],
    /// Out of the piece, at right angles to those.
    out: [DVec2; 2],
}

impl Bend {
    /// The bend at point `i` of a closed polyline; `side` is 1 where the outside is left of it, else -1.
    fn at(points: &[Point], i: usize, side: f64) -> Self {
        let n = points.len();
        let [a, b, c] = [points[(i + n - 1) % n], points[i], points[(i + 1) % n]].map(|point| point.at);
        let along = [b - a, c - b].map(|chord| chord.normalize_or_zero());
        Self { at: b, along, out: along.map(|way| way.perp() * side) }
    }

    /// The bend of the same outline run through the other way.
    fn reversed(self) -> Self {
        let [[a, b], [c, d]] = [self.along, self.out];
        Self { at: self.at, along: [-b, -a], out: [d, c] }
    }

    /// Sine of the angle by which the outline turns inwards, so that its allowance has a corner.
    fn turn(&self) -> f64 {
        self.along[0].dot(self.out[1])
    }

    fn mitre(&self, width: f64) -> Vec<DVec2> {
        let sum = self.out[0] + self.out[1];
        let scale = sum.length_squared() / 2.0;
        if scale > 2.0 / (MITRE * MITRE) {
            return vec![self.at + sum / scale * width];
        }
        // A corner sharper than the mitre limit is cut off.
        let tip = self.at + (self.along[0] - self.along[1]).normalize_or_zero() * width;
        vec![self.at + self.out[0] * width, tip, self.at + self.out[1] * width]
    }

    /// The allowance before the corner ends at right angles to the outline.
    fn square(&self, width: f64) -> Vec<DVec2> {
        let [before, after] = self.out;
        let end = self.at + before * width;
        // Where the offset of the outline after the corner meets the line at right angles.
        let far = 1.0 / before.dot(after);
        let further = if (0.0..=MITRE).contains(&far) { before * far } else { after };
        vec![end, self.at + further * width]
    }

    /// The allowance after the corner, a hem, is the mirror image of the piece beside the outline before it. `beside` are the
    /// offset points of that outline, from the corner on backwards. Gives the corner's points and how many of `beside` lie beyond
    /// the hem; None where the mirror image goes too far.
    fn turned_up(&self, width: f64, beside: &[DVec2]) -> Option<(Vec<DVec2>, usize)> {
        let out = self.out[1];
        let depth = |p: DVec2| (self.at - p).dot(out);
        let end = self.at + self.out[0] * width;
        let chain: Vec<DVec2> =
            [end + self.along[0] * (MITRE * width), end].into_iter().chain(beside.iter().copied()).collect();
        let crossing = |from: usize, goal: f64| {
            let k =
                (from..chain.len() - 1).find(|&k| depth(chain[k]) <= goal && depth(chain[k + 1]) >= goal)?;
            let [low, high] = [depth(chain[k]), depth(chain[k + 1])];
            let share = if high > low { (goal - low) / (high - low) } else { 0.0 };
            Some((k, chain[k].lerp(chain[k + 1], share)))
        };
        let (first, at_hem) = crossing(0, 0.0)?;
        let (last, at_width) = crossing(first, width)?;
        if at_hem.distance(self.at) > MITRE * width {
            return None;
        }
        let between = chain[first + 1..=last].iter().copied();
        let mirrored = |p: DVec2| p + out * (2.0 * depth(p));
        let points = std::iter::once(at_hem).chain(between).chain([at_width]).map(mirrored).collect();
        Some((points, first.saturating_sub(1)))
    }
}

/// The closed polyline `points` offset outward by `width`, its corners shaped as each point says. `chords` is how far the points'
/// chords are from the true outline. Where allowances run into each other, as beside a dart, the outer line of both is taken.
fn offset(points: &[Point], width: f64, chords: f64) -> Vec<Moved> {
    let line = Contour::new(points.iter().map(|point| point.at).collect());
    let side = -line.signed_area().signum();
    let bends: Vec<Bend> = (0..points.len()).map(|i| Bend::at(points, i, side)).collect();
    let plain = |at: DVec2| Moved { at, is_corner: false };
    let mut moved: Vec<Vec<Moved>> =
        bends.iter().map(|bend| bend.mitre(width).into_iter().map(plain).collect()).collect();
    for i in 0..points.len() {
        if let Some(shape) = points[i].corner.filter(|_| bends[i].turn() > LEAST_TURN) {
            shape_corner(points, &bends, &mut moved, (i, shape), width);
        }
    }
    let apart = width * (1.0 - 1e-3) - 2.0 * chords;
    let is_clear = |point: &Moved| line.distance(point.at) >= apart && !line.contains(point.at);
    if moved.iter().flatten().all(is_clear) {
        return moved.concat();
    }
    let own = points.iter().map(|point| point.at).collect();
    without_overlaps(&bends, &moved, own, width)
}

/// The outer boundary of a piece with its allowance, where parts of the offset line run over each other. `outline` is the line
/// that was offset to `moved`.
fn without_overlaps(bends: &[Bend], moved: &[Vec<Moved>], outline: Vec<DVec2>, width: f64) -> Vec<Moved> {
    let mut line = Vec::new();
    for (bend, own) in bends.iter().zip(moved) {
        // Where the outline turns inwards the offset of each side ends beside the corner: what then runs backwards has the
        // winding of no cloth, whatever the lengths of the sides.
        if bend.turn() < 0.0 && !own.is_empty() {
            line.extend([bend.at + bend.out[0] * width, bend.at, bend.at + bend.out[1] * width]);
        } else {
            line.extend(own.iter().map(|point| point.at));
        }
    }
    let known: Vec<&Moved> = moved.iter().flatten().collect();
    let told = |at: DVec2| {
        let same = known.iter().find(|point| point.at.distance_squared(at) < SAME * SAME);
        // What is new is where two offset lines meet.
        Moved { at, is_corner: same.is_none_or(|point| point.is_corner) }
    };
    outer([line, outline]).into_iter().map(told).collect()
}

/// Gives corner `i` its shape. What lies beyond a hem that is turned up there goes.
fn shape_corner(
    points: &[Point],
    bends: &[Bend],
    moved: &mut [Vec<Moved>],
    (i, shape): (usize, AllowanceCorner),
    width: f64,
) {
    let (AllowanceCorner::Square(side) | AllowanceCorner::TurnedUp(side)) = shape else { return };
    let n = points.len();
    // Each shape is worked out for one of the two edges; for the other one the outline is run through backwards.
    let is_backwards = match shape {
        AllowanceCorner::Square(_) => side == Side::After,
        _ => side == Side::Before,
    };
    let bend = if is_backwards { bends[i].reversed() } else { bends[i] };
    let step = |k: usize| if is_backwards { (i + k) % n } else { (i + n - k) % n };
    let mut corner = if matches!(shape, AllowanceCorner::Square(_)) {
        bend.square(width)
    } else {
        let until = (1..n).find(|&k| points[step(k)].corner.is_some()).unwrap_or(1);
        let nearest = |k: usize| {
            let own = moved[step(k)].iter().map(|point| point.at);
            own.min_by(|a, b| a.distance_squared(bend.at).total_cmp(&b.distance_squared(bend.at)))
        };
        let beside: Vec<DVec2> = (1..=until).filter_map(nearest).collect();
        let Some((corner, beyond)) = bend.turned_up(width, &beside) else { return };
        (1..=beyond.min(until - 1)).for_each(|k| moved[step(k)].clear());
        corner
    };
    if is_backwards {
        corner.reverse();
    }
    let last = corner.len() - 1;
    let told = |(k, at): (usize, DVec2)| Moved {
        at,
        // Between its ends a mirror image is as curved as what it is the image of.
        is_corner: matches!(shape, AllowanceCorner::Square(_)) || k == 0 || k == last,
    };
    moved[i] = corner.into_iter().enumerate().map(told).collect();
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

    /// A skirt panel: its hem (edge 0) is wider than its waist, the sides lean by the same angle.
    fn panel() -> Piece {
        let corners = [[-0.2, 0.0], [0.2, 0.0], [0.1, 0.3], [-0.1, 0.3]].map(DVec2::from);
        let mut piece = Piece::polygon("panel", &corners);
        piece.allowance = 0.03;
        piece
    }

    /// The corners of the cut line, all edges of which are straight, in order from the lowest and then leftmost.
    fn corners(piece: &Piece) -> Vec<DVec2> {
        let line = cut_line(piece);
        assert!(line.iter().all(|edge| edge.shape == EdgeShape::Line), "{line:?}");
        let points: Vec<DVec2> = line.iter().map(|edge| edge.start).collect();
        let key = |p: &DVec2| ((p.y * 1e6).round() as i64, (p.x * 1e6).round() as i64);
        let first = (0..points.len()).min_by_key(|&i| key(&points[i])).unwrap_or(0);
        (0..points.len()).map(|k| points[(first + k) % points.len()]).collect()
    }

    fn near(found: &[DVec2], wanted: &[DVec2]) {
        assert_eq!(found.len(), wanted.len(), "{found:?} {wanted:?}");
        for (a, b) in found.iter().zip(wanted) {
            assert!(a.distance(*b) < 1e-9, "{found:?} {wanted:?}");
        }
    }

    #[test]
    fn a_hem_that_is_turned_up_follows_the_sides() {
        let mut piece = panel();
        // Both ends of the hem: it is after corner 0 and before corner 1.
        piece.outline[0].corner = AllowanceCorner::TurnedUp(Side::After);
        piece.outline[1].corner = AllowanceCorner::TurnedUp(Side::Before);
        let found = corners(&piece);
        // Half the hem's width at height y: the side's, and its allowance measured along the hem.
        let slope = 0.1 / 0.3;
        let half = |y: f64| 0.2 - slope * y + 0.03 * (1.0_f64 + slope * slope).sqrt();
        let bottom = half(0.03);
        let wanted =
            [(-bottom, -0.03), (bottom, -0.03), (half(0.0), 0.0), (half(0.33), 0.33), (-half(0.33), 0.33)]
                .map(DVec2::from);
        near(&found[..5], &wanted);
        near(&found[5..], &[DVec2::new(-half(0.0), 0.0)]);
        // Turned up at the hem it lies on the cloth, edge on edge.
        for p in &found[..2] {
            let up = DVec2::new(p.x, -p.y);
            assert!((up.x.abs() - half(up.y)).abs() < 1e-9, "{up}");
        }
    }

    #[test]
    fn a_turned_up_hem_is_the_mirror_image_of_curved_sides() {
        let mut piece = panel();
        piece.outline[1].shape = EdgeShape::Quadratic { control: DVec2::new(0.12, 0.12) };
        piece.outline[1].corner = AllowanceCorner::TurnedUp(Side::Before);
        let points = flattened_loop(&cut_line(&piece), 1e-5);
        let line = Contour::new(points.clone());
        let mut checked = 0;
        for (k, a) in points.iter().enumerate() {
            let b = points[(k + 1) % points.len()];
            for p in (0..8).map(|part| a.lerp(b, f64::from(part) / 8.0)) {
                if p.x > 0.0 && (-0.0299..-1e-4).contains(&p.y) {
                    assert!(line.distance(DVec2::new(p.x, -p.y)) < 3e-4, "{p}");
                    checked += 1;
                }
            }
        }
        assert!(checked >= 7, "{checked} points of the hem's end");
    }

    #[test]
    fn a_square_corner_ends_at_right_angles_to_the_seam() {
        // The sides lean by 45 degrees.
        let points = [[-0.3, 0.0], [0.3, 0.0], [0.2, 0.1], [-0.2, 0.1]].map(DVec2::from);
        let mut piece = Piece::polygon("yoke", &points);
        piece.allowance = 0.03;
        let mitred = corners(&piece);
        assert_eq!(mitred.len(), 4);
        let (at, side) = (points[2], DVec2::splat(0.5_f64.sqrt()));
        let with = |piece: &mut Piece, i: usize, shape: AllowanceCorner, own: [DVec2; 2]| {
            piece.outline[i].corner = shape;
            let mut wanted = mitred.clone();
            wanted.splice(i..=i, own);
            near(&corners(piece), &wanted);
            piece.outline[i].corner = AllowanceCorner::Mitre;
        };
        // The side's allowance ends at right angles to it; that of the upper edge runs on to there.
        let own = [at + side * 0.03, at + DVec2::splat(0.03)];
        with(&mut piece, 2, AllowanceCorner::Square(Side::Before), own);
        let own = [at + DVec2::Y * (0.03 * 2.0_f64.sqrt()), at + DVec2::Y * 0.03];
        with(&mut piece, 2, AllowanceCorner::Square(Side::After), own);
        // At a sharp corner neither can run on: both end at right angles.
        for of in [Side::Before, Side::After] {
            let own = [points[1] - DVec2::Y * 0.03, points[1] + side * 0.03];
            with(&mut piece, 1, AllowanceCorner::Square(of), own);
        }
    }

    /// A skirt panel whose upper edge is at y = 0.3, with a dart of 2 cm and 9 cm in its middle.
    fn darted(width: f64) -> Piece {
        let corners =
            [[-0.2, 0.0], [0.2, 0.0], [0.2, 0.3], [0.01, 0.3], [0.0, 0.21], [-0.01, 0.3], [-0.2, 0.3]];
        let mut piece = Piece::polygon("panel", &corners.map(DVec2::from));
        piece.allowance = width;
        piece
    }

    #[test]
    fn the_allowance_runs_over_a_dart_that_is_narrower_than_it() {
        for width in [0.012, 0.02, 0.03, 0.05] {
            for is_reversed in [false, true] {
                let mut piece = darted(width);
                if is_reversed {
                    piece.outline = curve::reversed(&piece.outline);
                }
                let [x, top, bottom] = [0.2 + width, 0.3 + width, -width];
                let found = corners(&piece);
                let wanted = [[-x, bottom], [x, bottom], [x, top], [-x, top]].map(DVec2::from);
                let line = Contour::new(found.clone());
                assert!(
                    (line.signed_area().abs() - 2.0 * x * (top - bottom)).abs() < 1e-9,
                    "{width} {found:?}"
                );
                assert!(wanted.iter().all(|p| line.distance(*p) < 1e-9), "{width} {found:?}");
                assert_eq!(found.len(), 4, "{width} {found:?}");
            }
        }
    }

    #[test]
    fn beside_a_dart_that_is_wider_than_both_allowances_the_line_goes_into_it() {
        let mut piece = darted(0.004);
        piece.outline[4].start = DVec2::new(0.0, 0.1);
        let found = corners(&piece);
        let lowest = found.iter().filter(|p| p.y > 0.01).map(|p| p.y).fold(1.0, f64::min);
        // Where the offsets of both sides meet: above the tip by the allowance over the sine of half the dart's angle.
        let wanted = 0.1 + 0.004 * 0.01_f64.hypot(0.2) / 0.01;
        assert!((lowest - wanted).abs() < 1e-9, "{lowest} {wanted}");
    }

    #[test]
    fn a_corner_that_turns_inwards_stays_mitred() {
        let points =
            [[0.0, 0.0], [0.2, 0.0], [0.2, 0.1], [0.1, 0.1], [0.1, 0.2], [0.0, 0.2]].map(DVec2::from);
        let mut piece = Piece::polygon("l", &points);
        piece.allowance = 0.01;
        let plain = cut_line(&piece);
        for shape in AllowanceCorner::ALL {
            piece.outline[3].corner = shape;
            assert_eq!(cut_line(&piece), plain, "{shape:?}");
        }
    }

    #[test]
    fn shapes_do_not_depend_on_the_way_the_outline_runs() {
        for shape in AllowanceCorner::ALL {
            let mut piece = panel();
            piece.outline[1].corner = shape;
            let mut backwards = piece.clone();
            backwards.outline = curve::reversed(&piece.outline);
            let [one, other] = [&piece, &backwards].map(|piece| Contour::new(allowance_line(piece, 1e-4)));
            assert!((one.signed_area() + other.signed_area()).abs() < 1e-9, "{shape:?}");
            assert!(allowance_line(&backwards, 1e-4).iter().all(|&p| one.distance(p) < 1e-9), "{shape:?}");
        }
    }
}
