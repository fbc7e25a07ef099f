//! Completes a partial set of measurements: those not given follow from the others.

use super::Measurements;
use super::childhood;

/// Measurements of the upper body that follow the bust.
const OF_BUST: [&str; 3] = ["neck", "upper arm", "wrist"];
/// Measurements of the legs that follow the hip.
const OF_HIP: [&str; 5] = ["upper thigh", "mid-thigh", "knee", "calf", "ankle"];

impl Measurements {
    /// The measurements completed from those that `given` knows, by the names of [`Measurements::named`], in metres. The others
    /// are in proportion as on the default figure, or, below 1.40 m, as on the usual child of the height: lengths and trunk
    /// girths to the height, girths of neck and arms to the bust, of legs to the hip; the abdomen is between waist and hip.
    /// The result may be out of range: see [`Measurements::check`].
    pub fn completed(given: impl Fn(&str) -> Option<f64>) -> Self {
        let usual = Self::default();
        let tall = given("height").map_or(1.0, |height| height / usual.height);
        let factors = childhood::usual(given("height").unwrap_or(usual.height));
        let names = usual.named().map(|(name, _)| name);
        let child = |name: &str| names.iter().position(|own| *own == name).map_or(1.0, |i| factors[i]);
        let great = |name: &str, usual: f64| given(name).unwrap_or(usual * tall * child(name));
        let [bust, waist, hip] = [("bust", usual.bust), ("waist", usual.waist), ("hip", usual.hip)]
            .map(|(name, x)| great(name, x));
        let share = (usual.abdomen - usual.waist) / (usual.hip - usual.waist);
        let following = |name: &str, value: f64| match name {
            "bust" => bust,
            "waist" => waist,
            "hip" => hip,
            "abdomen" => waist + share * (hip - waist),
            _ if OF_BUST.contains(&name) => value * (child(name) / child("bust")) * bust / usual.bust,
            _ if OF_HIP.contains(&name) => value * (child(name) / child("hip")) * hip / usual.hip,
            _ => value * tall * child(name),
        };
        let mut figure = usual;
        for (name, value) in figure.named_mut() {
            *value = given(name).unwrap_or_else(|| following(name, *value));
        }
        figure
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn completed(given: &[(&str, f64)]) -> Measurements {
        Measurements::completed(|name| {
            given.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
        })
    }

    #[test]
    fn nothing_given_is_the_default_and_all_given_is_taken() {
        let usual = Measurements::default();
        for (one, other) in completed(&[]).named().into_iter().zip(usual.named()) {
            assert!((one.1 - other.1).abs() < 1e-15, "{one:?} {other:?}");
        }
        let all = Measurements { height: 1.7, waist: 0.68, knee: 0.36, ..usual };
        assert_eq!(completed(&all.named()), all);
    }

    #[test]
    fn what_is_left_out_follows() {
        let usual = Measurements::default();
        let small = completed(&[("height", usual.height * 0.9)]);
        assert!((small.hip - usual.hip * 0.9).abs() < 1e-12 && small.check().is_ok(), "{small:?}");
        let full = completed(&[("bust", 1.1), ("waist", 0.88), ("hip", 1.14)]);
        assert!(full.abdomen > full.waist && full.abdomen < full.hip && full.height == usual.height);
        assert!((full.upper_arm / full.bust - usual.upper_arm / usual.bust).abs() < 1e-12);
        assert!((full.knee / full.hip - usual.knee / usual.hip).abs() < 1e-12 && full.check().is_ok());
    }
}
