//! Smooths the points of a hand-drawn stroke to a mark.

use glam::{DVec2, DVec3};

/// A point of the plane or of space, metres.
pub trait Place: Copy {
    /// Distance between two points, metres.
    fn away(self, other: Self) -> f64;
    /// Linear interpolation between two points at `t`, 0..=1.
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

/// Length below which a stroke counts as a dot, metres.
pub const DOT: f64 = 0.006;
/// Distance between the points of a finished stroke, metres.
pub const SPACING: f64 = 0.008;
/// Number of smoothing passes with the weights (1, 2, 1) / 4, at an eighth of [`SPACING`]: waves up to half a centimetre long
/// disappear, and corners are rounded within the same length.
const PASSES: usize = 24;

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

/// The stroke as it is stored: smoothed and evenly spaced, with its ends kept. A stroke shorter than [`DOT`] becomes its first
/// point.
pub fn finished<P: Place>(points: &[P]) -> Vec<P> {
    let total = length(points);
    let Some(&first) = points.first() else { return Vec::new() };
    if total < DOT {
        return vec![first];
    }
    let mut fine = resampled(points, count(8.0 * total));
    for _ in 0..PASSES {
        let last = fine.clone();
        for i in 1..last.len() - 1 {
            fine[i] = last[i].between(last[i - 1].between(last[i + 1], 0.5), 0.5);
        }
    }
    // A trembling line is longer than the smoothed one, so the number of points is computed again.
    resampled(&fine, count(length(&fine)))
}

/// Number of points of a stroke of `length` metres.
fn count(length: f64) -> usize {
    (length / SPACING).ceil() as usize + 1
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

    /// Up and down by `height` every `step`, 20 cm long.
    fn trembling(step: f64, height: f64) -> Vec<DVec2> {
        let count = (0.2 / step) as i32;
        (0..=count).map(|i| DVec2::new(f64::from(i) * step, f64::from(i % 2) * height)).collect()
    }

    #[test]
    fn tremble_goes_and_the_ends_stay() {
        let points = trembling(1e-3, 1e-3);
        let stroke = finished(&points);
        assert_eq!((stroke.first(), stroke.last()), (points.first(), points.last()));
        let inner = &stroke[2..stroke.len() - 2];
        let worst = inner.iter().map(|p| (p.y - 5e-4).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-4, "{worst}");
        assert!(stroke.len() <= 27, "no more points than on a straight line");
    }

    #[test]
    fn a_curve_keeps_its_shape() {
        let circle: Vec<DVec2> = (0..=60).map(|i| DVec2::from_angle(f64::from(i) * 0.1) * 0.05).collect();
        for p in finished(&circle) {
            assert!((p.length() - 0.05).abs() < 4e-4, "{}", p.length());
        }
    }

    #[test]
    fn a_click_is_a_dot() {
        assert_eq!(finished(&trembling(1e-3, 1e-3)[..3]).len(), 1);
        assert!(finished::<DVec3>(&[]).is_empty());
    }
}
