//! From a hand's trembling points to a mark.

use glam::{DVec2, DVec3};

/// A point of the plane or of space.
pub trait Place: Copy {
    /// Metres between two.
    fn away(self, other: Self) -> f64;
    /// The point at `t` of the way.
    fn between(self, other: Self, t: f64) -> Self;
}

impl Place for DVec2 {
    fn away(self, other: Self) -> f64 {
        self.distance(other)
    }
    fn between(self, other: Self, t: f64) -> Self {
        self.lerp(other, t)
    }
}

impl Place for DVec3 {
    fn away(self, other: Self) -> f64 {
        self.distance(other)
    }
    fn between(self, other: Self, t: f64) -> Self {
        self.lerp(other, t)
    }
}

/// Strokes shorter than this are dots, metres.
pub const DOT: f64 = 0.006;
/// Distance between the points of a finished stroke, metres.
pub const SPACING: f64 = 0.008;

/// Length of the polyline, metres.
pub fn length<P: Place>(points: &[P]) -> f64 {
    points.windows(2).map(|w| w[0].away(w[1])).sum()
}

/// `count` points (at least 2) at equal distances along the polyline, ends included.
pub fn resampled<P: Place>(points: &[P], count: usize) -> Vec<P> {
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else {
        return Vec::new();
    };
    let step = length(points) / (count.max(2) - 1) as f64;
    let mut out = vec![first];
    let mut walked = 0.0;
    for w in points.windows(2) {
        let side = w[0].away(w[1]);
        while out.len() + 1 < count.max(2) && side > 0.0 && step * out.len() as f64 <= walked + side {
            out.push(w[0].between(w[1], (step * out.len() as f64 - walked) / side));
        }
        walked += side;
    }
    out.resize(count.max(2) - 1, last);
    out.push(last);
    out
}

/// A stroke as it goes into the document: evenly spaced, tremble smoothed away, ends kept. A short one becomes its first point.
pub fn finished<P: Place>(points: &[P]) -> Vec<P> {
    let total = length(points);
    let Some(&first) = points.first() else { return Vec::new() };
    if total < DOT {
        return vec![first];
    }
    let count = (total / SPACING).ceil() as usize + 1;
    let mut fine = resampled(points, count * 3);
    for _ in 0..6 {
        let last = fine.clone();
        for i in 1..last.len() - 1 {
            fine[i] = last[i].between(last[i - 1].between(last[i + 1], 0.5), 0.5);
        }
    }
    resampled(&fine, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_stays_a_line_with_even_spacing() {
        let points: Vec<DVec2> = [0.0, 0.01, 0.05, 0.051, 0.2].map(|x| DVec2::new(x, 0.0)).to_vec();
        let stroke = finished(&points);
        assert_eq!(stroke.first(), points.first());
        assert_eq!(stroke.last(), points.last());
        for w in stroke.windows(2) {
            let d = w[0].distance(w[1]);
            assert!(d > 0.006 && d < SPACING * 1.2, "{d}");
            assert!(w[0].y.abs() < 1e-12);
        }
    }

    #[test]
    fn tremble_goes_and_a_click_is_a_dot() {
        let points: Vec<DVec2> =
            (0..200).map(|i| DVec2::new(f64::from(i) * 1e-3, f64::from(i % 2) * 1e-3)).collect();
        let worst = finished(&points).iter().skip(1).map(|p| (p.y - 5e-4).abs()).fold(0.0, f64::max);
        assert!(worst < 5.01e-4, "{worst}");
        assert_eq!(finished(&points[..3]).len(), 1);
        assert!(finished::<DVec3>(&[]).is_empty());
    }
}
