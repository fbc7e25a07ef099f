//! Colour maps for values.

use super::scene::Rgb;

/// Viridis (Smith and van der Walt, 2015) at nine places, sRGB: its lightness rises evenly, and colour-blind people can read it.
const VIRIDIS: [Rgb; 9] = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 81, 139],
    [44, 113, 142],
    [33, 144, 141],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];
/// A diverging colour map in sRGB: blue for negative, white for zero, orange for positive. It avoids red against green.
const DIVERGING: [Rgb; 9] = [
    [8, 64, 129],
    [33, 113, 181],
    [88, 160, 206],
    [166, 206, 228],
    [246, 246, 246],
    [253, 208, 162],
    [253, 158, 84],
    [230, 97, 13],
    [147, 52, 4],
];
/// Colour where there is no value.
pub const NO_VALUE: Rgb = [150, 150, 150];

/// A colour map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Palette {
    /// From small to large values.
    Sequential,
    /// From one side of a middle value to the other.
    Diverging,
}

impl Palette {
    /// The colour of `value` in `range`. Values outside take the colour of the nearer end; NaN is grey.
    pub fn colour(self, value: f64, range: [f64; 2]) -> Rgb {
        if !value.is_finite() {
            return NO_VALUE;
        }
        let table = match self {
            Self::Sequential => VIRIDIS,
            Self::Diverging => DIVERGING,
        };
        let span = range[1] - range[0];
        let share = if span > 0.0 { ((value - range[0]) / span).clamp(0.0, 1.0) } else { 0.5 };
        let place = share * (table.len() - 1) as f64;
        let below = (place as usize).min(table.len() - 2);
        let t = place - below as f64;
        let (a, b) = (table[below], table[below + 1]);
        [0, 1, 2].map(|k| (f64::from(a[k]) + (f64::from(b[k]) - f64::from(a[k])) * t).round() as u8)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_middle_and_what_lies_beyond() {
        let range = [-2.0, 2.0];
        assert_eq!(Palette::Diverging.colour(0.0, range), [246; 3]);
        assert_eq!(Palette::Diverging.colour(-9.0, range), DIVERGING[0]);
        assert_eq!(Palette::Sequential.colour(2.0, range), VIRIDIS[8]);
        assert_eq!(Palette::Sequential.colour(f64::NAN, range), NO_VALUE);
        assert_eq!(Palette::Diverging.colour(3.0, [3.0, 3.0]), [246; 3]);
    }

    #[test]
    fn the_sequential_one_grows_lighter_all_the_way() {
        let light = |[r, g, b]: Rgb| 0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b);
        let steps: Vec<f64> =
            (0..=40).map(|i| light(Palette::Sequential.colour(f64::from(i), [0.0, 40.0]))).collect();
        assert!(steps.windows(2).all(|w| w[0] < w[1]), "{steps:?}");
    }
}
