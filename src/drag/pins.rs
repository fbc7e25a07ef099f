//! Pushpins: the fraction of a drag that reaches a vertex (paper A, Figure 9).

/// Fraction (0..=1) of the hand's motion left at a vertex `to_hand` metres from the hand and `to_pin` from a pin, where hand
/// and pin are `apart` metres from each other, all along the cloth. It is 1 straight behind the hand, seen from the pin, and
/// 0 at the pin and behind it; its level lines are hyperbolas with hand and pin as foci. A pinned hand moves nothing.
pub fn share(to_hand: f64, to_pin: f64, apart: f64) -> f64 {
    if apart <= 0.0 {
        return 0.0;
    }
    if apart.is_infinite() || to_pin.is_infinite() {
        return 1.0; // On another piece of cloth.
    }
    ((apart - to_hand + to_pin) / (2.0 * apart)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// B16: on a line with the hand at 0 and the pin at 1 the paper's three cases and what lies between.
    #[test]
    fn the_share_falls_from_the_hand_to_the_pin() {
        let on_line = |x: f64| share(x.abs(), (x - 1.0).abs(), 1.0);
        for (x, exact) in [(-2.0, 1.0), (0.0, 1.0), (0.25, 0.75), (0.5, 0.5), (1.0, 0.0), (3.0, 0.0)] {
            assert!((on_line(x) - exact).abs() < 1e-15, "at {x}: {}", on_line(x));
        }
    }

    /// Beside the line, in the plane, against the closed form.
    #[test]
    fn level_lines_are_hyperbolas() {
        for (x, y) in [(0.3f64, 0.4f64), (-0.2, 0.9), (1.4, -0.3)] {
            let (a, b) = (x.hypot(y), (x - 1.0).hypot(y));
            let exact = (1.0 - a + b) / 2.0;
            assert!((share(a, b, 1.0) - exact.clamp(0.0, 1.0)).abs() < 1e-15);
        }
    }

    #[test]
    fn a_pinned_hand_moves_nothing() {
        assert_eq!(share(0.3, 0.3, 0.0), 0.0);
    }

    #[test]
    fn a_pin_on_other_cloth_holds_nothing() {
        assert_eq!(share(0.3, f64::INFINITY, f64::INFINITY), 1.0);
    }
}
