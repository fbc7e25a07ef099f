//! How children are proportioned: their usual measurements, and what of the figure differs from a grown one's.
//!
//! After Snyder et al. 1977, "Anthropometry of Infants, Children, and Youths to Age 18 for Product Safety Design"
//! (UM-HSRI-77-17), rounded, with girths of trade size tables in the order of EN 13402-3. They are given for two heights;
//! other heights are on the straight line through both. From 1.40 m on nothing differs: a figure is then the default one,
//! stretched. Between 1.24 m and that height the differences fade smoothly, so that at 1.28 m 84 % of them are left.

use super::measurements::Measurements;
use super::proportions::level;

/// Height from which a figure has grown proportions, metres.
const GROWN: f64 = 1.40;
/// Range of heights below `GROWN` in which children's proportions set in, metres.
const SETS_IN: f64 = 0.16;

/// The usual child of 104 cm, about four years old.
const YOUNGER: Measurements = Measurements {
    height: 1.04,
    bust: 0.56,
    waist: 0.535,
    abdomen: 0.566,
    hip: 0.59,
    half_across_shoulder: 0.118,
    neck: 0.256,
    arm_length: 0.352,
    upper_arm: 0.170,
    wrist: 0.115,
    upper_thigh: 0.335,
    mid_thigh: 0.292,
    knee: 0.235,
    calf: 0.220,
    ankle: 0.155,
    waist_to_ankle: 0.565,
};

/// The usual child of 128 cm, about eight years old.
const OLDER: Measurements = Measurements {
    height: 1.28,
    bust: 0.64,
    waist: 0.59,
    abdomen: 0.646,
    hip: 0.69,
    half_across_shoulder: 0.145,
    neck: 0.284,
    arm_length: 0.443,
    upper_arm: 0.193,
    wrist: 0.130,
    upper_thigh: 0.392,
    mid_thigh: 0.338,
    knee: 0.273,
    calf: 0.253,
    ankle: 0.177,
    waist_to_ankle: 0.716,
};

/// Share of the height that the head takes from chin to crown, at the two heights of the table.
const HEAD_SHARES: [f64; 2] = [0.190, 0.165];

/// What of a figure is a child's. Everything is neutral on grown figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Childhood {
    /// How far a child's proportions have set in: 0 on a grown figure, 1 on a small child.
    share: f64,
    /// Factor on the size of the head.
    pub head: f64,
    /// Factor on the size of the hands.
    pub hand: f64,
    /// Factor on the size of the feet.
    pub foot: f64,
}

impl Childhood {
    /// The proportions of a figure `height` metres tall.
    pub fn of(height: f64) -> Self {
        let share = share(height);
        let grown = (level::CROWN - level::CHIN) / level::CROWN;
        let head = along(height, HEAD_SHARES) / grown;
        let own = Self { share, head: 1.0, hand: 1.0, foot: 1.0 };
        Self { head: own.mixed(1.0, head), hand: own.mixed(1.0, 1.04), foot: own.mixed(1.0, 1.05), ..own }
    }

    /// `grown` on a grown figure, `small` on a small child, between them in between.
    pub fn mixed(&self, grown: f64, small: f64) -> f64 {
        // Not a bit of a grown figure may depend on `small`.
        if self.share == 0.0 { grown } else { grown + (small - grown) * self.share }
    }
}

/// Factor of each usual measurement, in the order of [`Measurements::named`], on the default scaled to `height` metres.
pub fn usual(height: f64) -> [f64; 16] {
    let share = share(height);
    if share == 0.0 {
        return [1.0; 16];
    }
    let default = Measurements::default();
    let relative = |m: &Measurements| {
        let tall = m.height / default.height;
        let named = m.named().into_iter().zip(default.named());
        named.map(|((_, own), (_, grown))| own / (grown * tall)).collect::<Vec<f64>>()
    };
    let [younger, older] = [YOUNGER, OLDER].each_ref().map(relative);
    std::array::from_fn(|i| 1.0 + (along(height, [younger[i], older[i]]) - 1.0) * share)
}

/// The value at `height` of the straight line through `values` at the two heights of the table.
fn along(height: f64, values: [f64; 2]) -> f64 {
    let t = (height - YOUNGER.height) / (OLDER.height - YOUNGER.height);
    values[0] + (values[1] - values[0]) * t
}

fn share(height: f64) -> f64 {
    let t = ((GROWN - height) / SETS_IN).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grown_figures_are_as_they_were() {
        for height in [1.40, 1.41, 1.78, 2.05] {
            assert_eq!(usual(height), [1.0; 16]);
            let child = Childhood::of(height);
            assert_eq!(
                [child.head, child.hand, child.foot, child.mixed(0.3, f64::NAN)],
                [1.0, 1.0, 1.0, 0.3]
            );
        }
    }

    #[test]
    fn children_grow_up_smoothly() {
        let (below, above) = (usual(1.39), usual(1.41));
        assert!(below.iter().zip(above).all(|(a, b)| (a - b).abs() < 0.004), "{below:?}");
        let heads: Vec<f64> = (98..=140).map(|cm| Childhood::of(f64::from(cm) / 100.0).head).collect();
        assert!(heads.windows(2).all(|w| w[0] >= w[1] && w[0] - w[1] < 0.035), "{heads:?}");
        assert!((heads[0] - 1.558).abs() < 0.01, "{}", heads[0]);
    }

    #[test]
    fn the_younger_child_is_usual_and_the_older_one_nearly() {
        let default = Measurements::default();
        let close = |child: Measurements, within: f64| {
            let tall = child.height / default.height;
            let named = child.named().into_iter().zip(default.named()).zip(usual(child.height));
            for (((name, own), (_, grown)), factor) in named {
                assert!((grown * tall * factor / own - 1.0).abs() <= within, "{name}: {factor}");
            }
        };
        close(YOUNGER, 1e-12);
        close(OLDER, 0.03);
    }
}
