//! A loft: a smooth tube through sections along a straight axis; used for trunk with leg, arm, foot and head.
//!
//! A section is a superellipse with a separate half-width on each side, so that front and back, inside and outside
//! may differ. Values between the given sections come from natural cubic splines: curvature is continuous.

use super::spline::Spline;

/// Spacing of the table of interpolated sections, metres.
const STEP: f64 = 0.002;

/// Largest slope of the tube's side; steeper ones are clamped to it.
const STEEPEST: f64 = 6.0;

/// One section of a loft. Lengths are in metres in the loft's own frame.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Position along the axis.
    pub at: f64,
    /// Position of the section's centre across the axis (u, v).
    pub centre: [f64; 2],
    /// Half-widths towards -u and +u.
    pub u: [f64; 2],
    /// Half-widths towards -v and +v.
    pub v: [f64; 2],
    /// Exponent of the superellipse: 2 an ellipse, more a rounded box.
    pub exponent: f64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Row {
    centre: [f64; 2],
    u: [f64; 2],
    v: [f64; 2],
    exponent: f64,
}

/// A tube through sections, closed by half an ellipsoid at each end.
#[derive(Clone, Debug)]
pub struct Loft {
    rows: Vec<Row>,
    from: f64,
    to: f64,
    caps: [f64; 2],
}

impl Loft {
    /// The tube through `sections` (ascending `at`, at least two), with caps that extend `caps` metres beyond the
    /// first and the last.
    pub fn new(sections: &[Section], caps: [f64; 2]) -> Self {
        let spline = |pick: &dyn Fn(&Section) -> f64| Spline::new(sections.iter().map(|s| (s.at, pick(s))));
        let pair = |pick: &dyn Fn(&Section) -> [f64; 2]| [spline(&|s| pick(s)[0]), spline(&|s| pick(s)[1])];
        let (centre, u, v) = (pair(&|s| s.centre), pair(&|s| s.u), pair(&|s| s.v));
        let exponent = spline(&|s| s.exponent);
        let (from, to) = (sections[0].at, sections[sections.len() - 1].at);
        let count = ((to - from) / STEP).ceil() as usize + 1;
        let rows = (0..count)
            .map(|i| {
                let at = (from + i as f64 * STEP).min(to);
                let both = |s: &[Spline; 2]| [s[0].value(at), s[1].value(at)];
                Row { centre: both(&centre), u: both(&u), v: both(&v), exponent: exponent.value(at) }
            })
            .collect();
        Self { rows, from, to, caps }
    }

    /// The interpolated section at `at`, its derivative along the axis, and how far `at` is beyond the tube's end as
    /// a fraction of the cap's length there.
    fn row(&self, at: f64) -> (Row, Row, f64) {
        let clamped = at.clamp(self.from, self.to);
        let x = (clamped - self.from) / STEP;
        let i = (x as usize).min(self.rows.len() - 2);
        let (a, b) = (&self.rows[i], &self.rows[i + 1]);
        let t = (x - i as f64).min(1.0);
        let cap = self.caps[usize::from(at > self.to)];
        (a.mixed(b, 1.0 - t, t), a.mixed(b, -1.0 / STEP, 1.0 / STEP), (at - clamped).abs() / cap)
    }

    /// Centre (u, v) of the section at `at`.
    pub fn centre(&self, at: f64) -> [f64; 2] {
        self.row(at).0.centre
    }

    /// First-order approximation of the signed distance from `(at, u, v)` to the tube, metres, negative inside: exact
    /// on the surface, with unit slope there.
    pub fn distance(&self, at: f64, u: f64, v: f64) -> f64 {
        let (row, slope, beyond) = self.row(at);
        let cap = self.caps[usize::from(at > self.to)];
        let n = row.exponent;
        let [first, second] = [
            Term::new(u - row.centre[0], row.u, slope.u, slope.centre[0]),
            Term::new(v - row.centre[1], row.v, slope.v, slope.centre[1]),
        ];
        // g = (sum of ratio^n)^(1/n) is 1 on the skin; the distance is (g - 1) / |grad g|.
        let powers = [first.ratio, second.ratio, beyond].map(|r| if r > 0.0 { r.powf(n) } else { 0.0 });
        let sum: f64 = powers.iter().sum();
        if sum < 1e-12 {
            return -1.0 / first.across.max(second.across);
        }
        let g = sum.powf(1.0 / n);
        let weight = |power: f64, ratio: f64| if ratio > 0.0 { power / ratio * g / sum } else { 0.0 };
        let [w0, w1] = [weight(powers[0], first.ratio), weight(powers[1], second.ratio)];
        let along =
            if beyond > 0.0 { weight(powers[2], beyond) / cap } else { w0 * first.along + w1 * second.along };
        let flat = (w0 * first.across).hypot(w1 * second.across);
        (g - 1.0)
            / flat.hypot(if beyond > 0.0 { along } else { along.clamp(-STEEPEST * flat, STEEPEST * flat) })
    }
}

impl Row {
    fn mixed(&self, other: &Self, a: f64, b: f64) -> Self {
        let pair = |x: [f64; 2], y: [f64; 2]| [x[0] * a + y[0] * b, x[1] * a + y[1] * b];
        Self {
            centre: pair(self.centre, other.centre),
            u: pair(self.u, other.u),
            v: pair(self.v, other.v),
            exponent: self.exponent * a + other.exponent * b,
        }
    }
}

/// One direction across a section: offset divided by half-width, and its derivatives across and along the tube.
struct Term {
    ratio: f64,
    across: f64,
    along: f64,
}

impl Term {
    fn new(offset: f64, half_widths: [f64; 2], slopes: [f64; 2], centre_slope: f64) -> Self {
        let side = usize::from(offset >= 0.0);
        let sign = if side == 1 { 1.0 } else { -1.0 };
        let half_width = half_widths[side];
        let ratio = offset.abs() / half_width;
        // Far outside, a steep side would make the first-order distance collapse: limit the ratio.
        let along = -(sign * centre_slope + ratio.min(1.25) * slopes[side]) / half_width;
        Self { ratio, across: 1.0 / half_width, along }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cylinder() -> Loft {
        let section = |at| Section { at, centre: [0.0; 2], u: [0.1; 2], v: [0.1; 2], exponent: 2.0 };
        Loft::new(&[section(0.0), section(0.5), section(1.0)], [0.1; 2])
    }

    #[test]
    fn a_cylinder_has_exact_distances() {
        let loft = cylinder();
        assert!((loft.distance(0.4, 0.3, 0.0) - 0.2).abs() < 1e-9);
        assert!((loft.distance(0.4, 0.0, -0.06) + 0.04).abs() < 1e-9);
        // The cap is half a ball.
        assert!((loft.distance(1.3, 0.4, 0.0) - 0.4).abs() < 1e-9);
        assert!(loft.distance(1.09, 0.0, 0.0) < 0.0 && loft.distance(1.11, 0.0, 0.0) > 0.0);
    }

    #[test]
    fn slope_is_one_on_a_cone() {
        let section = |at: f64| {
            let r = 0.1 + 0.5 * at;
            Section { at, centre: [0.0; 2], u: [r; 2], v: [r; 2], exponent: 2.0 }
        };
        let loft = Loft::new(&[section(0.0), section(1.0)], [0.1; 2]);
        let (r, out) = (0.35, 0.001);
        // Along the cone's normal the distance grows by as much as the point moves.
        let n = 1.0 / (1.0f64 + 0.25).sqrt();
        let d = loft.distance(0.5 - 0.5 * n * out, r + n * out, 0.0);
        assert!((d - out).abs() < 1e-5, "{d}");
    }
}
