//! Closed polylines: area, containment and distance.

use glam::DVec2;

use crate::geometry::polygon;

/// Largest median distance between a cut line and its seam line, metres.
const USUAL_ALLOWANCE: f64 = 0.03;
/// Largest distance of any point of a cut line from its seam line, metres; corners and hems are wider than usual.
const MOST_ALLOWANCE: f64 = 0.12;
/// Smallest area of a seam line, as a fraction of the area of its cut line.
const LEAST_SHARE: f64 = 0.25;
/// Approximate number of points at which two lines are compared.
const SPREAD: usize = 200;
/// Approximate largest number of points of a coarse line.
const MOST_POINTS: usize = 2000;

/// A closed polyline; the last point is not the first.
#[derive(Clone, Debug)]
pub struct Contour {
    points: Vec<DVec2>,
    lower: DVec2,
    upper: DVec2,
}

impl Contour {
    /// The closed polyline through `points`.
    pub fn new(points: Vec<DVec2>) -> Self {
        let lower = points.iter().copied().reduce(DVec2::min).unwrap_or_default();
        let upper = points.iter().copied().reduce(DVec2::max).unwrap_or_default();
        Self { points, lower, upper }
    }

    /// The closed polyline through `points`, reduced to every n-th where there are more than `MOST_POINTS`: accurate enough to
    /// tell which line is inside which.
    pub fn coarse(points: Vec<DVec2>) -> Self {
        let step = points.len() / MOST_POINTS + 1;
        Self::new(if step > 1 { points.into_iter().step_by(step).collect() } else { points })
    }

    /// Whether `p` is inside, or within `reach` of the line.
    pub fn is_near(&self, p: DVec2, reach: f64) -> bool {
        let beyond = p.cmplt(self.lower - reach) | p.cmpgt(self.upper + reach);
        !beyond.any() && (self.contains(p) || self.distance(p) <= reach)
    }

    /// Whether the bounding boxes of two lines overlap by more than a millimetre.
    pub fn boxes_overlap(&self, other: &Self) -> bool {
        let apart = self.lower.cmpge(other.upper - 1e-3) | self.upper.cmple(other.lower + 1e-3);
        !apart.any()
    }

    /// Lower and upper corner of the bounding box.
    pub fn bounds(&self) -> (DVec2, DVec2) {
        (self.lower, self.upper)
    }

    /// Centre of the bounding box.
    pub fn middle(&self) -> DVec2 {
        (self.lower + self.upper) / 2.0
    }

    /// Area enclosed; positive when the line runs counter-clockwise.
    pub fn signed_area(&self) -> f64 {
        self.sides().map(|(a, b)| (a - self.lower).perp_dot(b - self.lower) / 2.0).sum()
    }

    fn sides(&self) -> impl Iterator<Item = (DVec2, DVec2)> {
        let n = self.points.len();
        (0..n).map(move |i| (self.points[i], self.points[(i + 1) % n]))
    }

    /// Whether `p` is inside, by the even-odd rule.
    pub fn contains(&self, p: DVec2) -> bool {
        if (p.cmplt(self.lower) | p.cmpgt(self.upper)).any() {
            return false;
        }
        polygon::contains(&self.points, p)
    }

    /// Whether all of `other` is inside, tested at its points only.
    pub fn surrounds(&self, other: &Self) -> bool {
        self.lower.cmple(other.lower).all()
            && self.upper.cmpge(other.upper).all()
            && other.spread().into_iter().all(|p| self.contains(p))
    }

    /// Whether two lines overlap: a point of one is more than 1 mm inside the other, or their centres coincide.
    pub fn overlaps(&self, other: &Self) -> bool {
        let deep = |inner: &Self, outer: &Self| {
            inner.spread().into_iter().any(|p| outer.contains(p) && outer.distance(p) > 1e-3)
        };
        self.boxes_overlap(other)
            && (deep(self, other) || deep(other, self) || self.middle().distance(other.middle()) < 1e-3)
    }

    /// Distance from `p` to the nearest point of the line, metres.
    pub fn distance(&self, p: DVec2) -> f64 {
        let to_side = |(a, b): (DVec2, DVec2)| {
            let along = b - a;
            let t = ((p - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            p.distance_squared(a + along * t)
        };
        self.sides().map(to_side).fold(f64::INFINITY, f64::min).sqrt()
    }

    /// The first intersection of a ray with the line. `way` is the ray's direction.
    pub fn hit(&self, from: DVec2, way: DVec2) -> Option<DVec2> {
        let meets = |(a, b): (DVec2, DVec2)| {
            let along = b - a;
            let across = way.perp_dot(along);
            let (t, s) = ((a - from).perp_dot(along) / across, (a - from).perp_dot(way) / across);
            (t >= 0.0 && (0.0..=1.0).contains(&s)).then_some(t)
        };
        self.sides().filter_map(meets).min_by(f64::total_cmp).map(|t| from + way * t)
    }

    /// The points of the line, or, where there are more than `SPREAD`, an evenly picked part of them.
    pub fn spread(&self) -> Vec<DVec2> {
        self.points.iter().step_by(self.points.len() / SPREAD + 1).copied().collect()
    }

    /// Whether this is the seam line of a piece with the cut line `cut_line`: inside it, and near it all round.
    pub fn is_seam_line_in(&self, cut_line: &Self) -> bool {
        let share = self.signed_area().abs() / cut_line.signed_area().abs();
        if !(LEAST_SHARE..1.0).contains(&share) || !cut_line.surrounds(self) {
            return false;
        }
        // Darts of a seam line may reach far into the piece, so only the cut line's points must all be near.
        let outer: Vec<f64> = cut_line.spread().into_iter().map(|p| self.distance(p)).collect();
        let farthest = outer.iter().copied().fold(0.0, f64::max);
        let mut all: Vec<f64> =
            self.spread().into_iter().map(|p| cut_line.distance(p)).chain(outer).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2] <= USUAL_ALLOWANCE && farthest <= MOST_ALLOWANCE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Contour {
        let at = DVec2::new(x, y);
        Contour::new(vec![at, at + DVec2::X * width, at + DVec2::new(width, height), at + DVec2::Y * height])
    }

    #[test]
    fn seam_lines_are_told_from_holes() {
        let cut = rectangle(0.0, 0.0, 0.4, 0.6);
        assert!(rectangle(0.01, 0.01, 0.38, 0.58).is_seam_line_in(&cut));
        assert!(rectangle(0.01, 0.04, 0.38, 0.55).is_seam_line_in(&cut), "a hem is wider");
        assert!(!rectangle(0.1, 0.1, 0.2, 0.4).is_seam_line_in(&cut), "a hole");
        assert!(!rectangle(0.3, 0.3, 0.3, 0.2).is_seam_line_in(&cut), "not inside");
    }

    #[test]
    fn pieces_on_each_other_overlap() {
        let a = rectangle(0.0, 0.0, 0.4, 0.4);
        assert!(a.overlaps(&rectangle(0.1, 0.1, 0.1, 0.1)) && a.overlaps(&a));
        assert!(!a.overlaps(&rectangle(0.4, 0.0, 0.4, 0.4)) && !a.overlaps(&rectangle(0.5, 0.5, 0.1, 0.1)));
    }
}
