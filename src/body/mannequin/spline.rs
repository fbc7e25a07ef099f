//! Natural cubic splines through knots.

/// Natural cubic spline (second derivative zero at both ends) through `(x, y)` knots with ascending `x`.
#[derive(Clone, Debug)]
pub struct Spline {
    x: Vec<f64>,
    y: Vec<f64>,
    bend: Vec<f64>,
}

impl Spline {
    /// The spline through at least two knots. Panics on fewer: tables are written in code.
    pub fn new(knots: impl Iterator<Item = (f64, f64)>) -> Self {
        let (x, y): (Vec<f64>, Vec<f64>) = knots.unzip();
        let n = x.len();
        assert!(n >= 2, "a spline needs two knots");
        // Thomas algorithm for the second derivatives.
        let mut bend = vec![0.0; n];
        let mut upper = vec![0.0; n];
        for i in 1..n - 1 {
            let (h0, h1) = (x[i] - x[i - 1], x[i + 1] - x[i]);
            let rhs = 6.0 * ((y[i + 1] - y[i]) / h1 - (y[i] - y[i - 1]) / h0);
            let pivot = 2.0 * (h0 + h1) - h0 * upper[i - 1];
            upper[i] = h1 / pivot;
            bend[i] = (rhs - h0 * bend[i - 1]) / pivot;
        }
        for i in (1..n - 1).rev() {
            bend[i] -= upper[i] * bend[i + 1];
        }
        Self { x, y, bend }
    }

    /// The value at `at`; constant beyond the ends.
    pub fn value(&self, at: f64) -> f64 {
        let n = self.x.len();
        let at = at.clamp(self.x[0], self.x[n - 1]);
        let i = self.x.partition_point(|&x| x <= at).clamp(1, n - 1) - 1;
        let h = self.x[i + 1] - self.x[i];
        let (a, b) = ((self.x[i + 1] - at) / h, (at - self.x[i]) / h);
        let cubic = (a * a * a - a) * self.bend[i] + (b * b * b - b) * self.bend[i + 1];
        a * self.y[i] + b * self.y[i + 1] + cubic * h * h / 6.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meets_its_knots_and_follows_a_line() {
        let knots = [(0.0, 1.0), (0.3, 2.0), (1.0, -1.0), (1.5, 0.0)];
        let spline = Spline::new(knots.into_iter());
        for (x, y) in knots {
            assert!((spline.value(x) - y).abs() < 1e-12);
        }
        let line = Spline::new([(0.0, 0.0), (1.0, 2.0), (4.0, 8.0)].into_iter());
        assert!((line.value(2.7) - 5.4).abs() < 1e-12);
        assert_eq!(line.value(9.0), 8.0);
    }
}
