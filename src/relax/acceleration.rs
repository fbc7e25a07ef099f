//! Acceleration of consecutive global steps in the same contacts: over-relaxation and Chebyshev weights.

/// Acceleration of one global step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acceleration {
    /// Over-relaxation: factor on the solved move, above 0.
    pub along: f64,
    /// Momentum: fraction (0..1) of the previous step's move that is added.
    pub on: f64,
    /// Whether the step flattens folds.
    pub flattens: bool,
}

impl Acceleration {
    /// The solved move, without acceleration; it flattens folds.
    pub const PLAIN: Self = Self { along: 1.0, on: 0.0, flattens: true };

    /// `N` steps that are over-relaxed by `along`; the last one flattens folds.
    pub const fn longer<const N: usize>(along: f64) -> [Self; N] {
        let mut paces = [Self { along, on: 0.0, flattens: false }; N];
        paces[N - 1].flattens = true;
        paces
    }

    /// `N` steps with the weights of Chebyshev's semi-iteration (Golub and Varga 1961; Wang 2015, "A Chebyshev Semi-Iterative
    /// Approach for Accelerating Projective and Position-Based Dynamics"). Of error components that one plain step reduces by
    /// a fraction between `slowest` (0..1) and 1, together they leave the least that `N` steps can; components reduced by up
    /// to 1 + `slowest` do not grow. The last but one step flattens folds: the last one removes the strain of that.
    pub const fn chebyshev<const N: usize>(slowest: f64) -> [Self; N] {
        let along = 2.0 / (1.0 + slowest);
        let left = (1.0 - slowest) / (1.0 + slowest);
        let mut paces = [Self { along, on: 0.0, flattens: false }; N];
        let (mut k, mut times) = (1, 1.0);
        while k < N {
            times = if k == 1 { 2.0 / (2.0 - left * left) } else { 4.0 / (4.0 - left * left * times) };
            paces[k] = Self { along: along * times, on: times - 1.0, flattens: false };
            k += 1;
        }
        paces[N.saturating_sub(2)].flattens = true;
        paces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What `paces` leave of an error of which a plain step takes away the share `taken`.
    fn left(paces: &[Acceleration], taken: f64) -> f64 {
        let (mut error, mut before) = (1.0, 1.0);
        for pace in paces {
            let next = error - pace.along * taken * error + pace.on * (error - before);
            (before, error) = (error, next);
        }
        error
    }

    #[test]
    fn three_steps_of_chebyshev_leave_what_the_best_polynomial_leaves() {
        let paces = Acceleration::chebyshev::<3>(0.2);
        // 1 / T3((1 + a) / (1 - a)).
        let best = 1.0 / (4.0 * 1.5f64.powi(3) - 3.0 * 1.5);
        let most =
            (0..=1000).map(|i| left(&paces, 0.2 + 0.8 * f64::from(i) / 1000.0).abs()).fold(0.0, f64::max);
        assert!((most - best).abs() < 1e-12, "{most} {best}");
        assert!((left(&paces, 1.2).abs() - 1.0).abs() < 1e-12 && left(&paces, 1.25).abs() > 1.0);
        assert!(left(&Acceleration::longer::<3>(1.7), 0.2).abs() > 2.0 * best);
    }

    #[test]
    fn folds_are_flattened_at_the_end() {
        assert_eq!(Acceleration::chebyshev::<4>(0.2).map(|pace| pace.flattens), [false, false, true, false]);
        assert_eq!(Acceleration::longer::<2>(1.5).map(|pace| pace.flattens), [false, true]);
        assert_eq!(Acceleration::chebyshev::<1>(0.0), [Acceleration { along: 2.0, on: 0.0, flattens: true }]);
    }
}
