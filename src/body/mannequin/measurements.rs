//! The body measurements from which a mannequin is built.

use serde::{Deserialize, Serialize};

use super::childhood;

/// Body measurements, metres. Girths are taken with a tape, which bridges hollows. The default is the measured figure
/// of Zhong and Xu 2009, Figure 12; values that it leaves out are filled in for a figure of those proportions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Measurements {
    /// Height from floor to crown.
    pub height: f64,
    /// Girth round the fullest part of the bust.
    pub bust: f64,
    /// Girth at the natural waist.
    pub waist: f64,
    /// Girth at the abdomen, half-way between waist and hip.
    pub abdomen: f64,
    /// Girth round the fullest part of the hip.
    pub hip: f64,
    /// Half the distance between the two shoulder tips.
    pub half_across_shoulder: f64,
    /// Girth at the middle of the neck.
    pub neck: f64,
    /// Length from shoulder tip to wrist, over the elbow.
    pub arm_length: f64,
    /// Girth round the fullest part of the upper arm.
    pub upper_arm: f64,
    /// Girth at the wrist.
    pub wrist: f64,
    /// Girth of the thigh just below the crotch.
    pub upper_thigh: f64,
    /// Girth of the thigh half-way between crotch and knee.
    pub mid_thigh: f64,
    /// Girth at the knee.
    pub knee: f64,
    /// Girth round the fullest part of the calf.
    pub calf: f64,
    /// Girth at the narrowest part above the ankle bones.
    pub ankle: f64,
    /// Length from the waist down the side to the ankle bone.
    pub waist_to_ankle: f64,
}

impl Default for Measurements {
    fn default() -> Self {
        Self {
            height: 1.78,
            bust: 0.9364,
            waist: 0.7066,
            abdomen: 0.8597,
            hip: 0.9800,
            half_across_shoulder: 0.2009,
            neck: 0.335,
            arm_length: 0.600,
            upper_arm: 0.275,
            wrist: 0.158,
            upper_thigh: 0.5577,
            mid_thigh: 0.4791,
            knee: 0.3531,
            calf: 0.345,
            ankle: 0.222,
            waist_to_ankle: 1.0794,
        }
    }
}

/// Error: a measurement that no body has.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{name} is {centimetres:.1} cm; a mannequin can be built with {lowest:.1} to {highest:.1} cm{given}")]
pub struct OutOfRange {
    /// Name of the measurement.
    pub name: &'static str,
    /// The value asked for, centimetres.
    pub centimetres: f64,
    /// Smallest valid value given the other measurements, centimetres.
    pub lowest: f64,
    /// Largest valid value given the other measurements, centimetres.
    pub highest: f64,
    /// Where the limits come from: empty, or text such as " at this hip".
    pub given: &'static str,
}

impl Measurements {
    /// Every measurement with its name, in the order of the fields.
    pub fn named(&self) -> [(&'static str, f64); 16] {
        let mut own = *self;
        own.named_mut().map(|(name, value)| (name, *value))
    }

    /// Every measurement with its name, mutable, in the order of the fields.
    pub fn named_mut(&mut self) -> [(&'static str, &mut f64); 16] {
        let Self {
            height,
            bust,
            waist,
            abdomen,
            hip,
            half_across_shoulder,
            neck,
            arm_length,
            upper_arm,
            wrist,
            upper_thigh,
            mid_thigh,
            knee,
            calf,
            ankle,
            waist_to_ankle,
        } = self;
        [
            ("height", height),
            ("bust", bust),
            ("waist", waist),
            ("abdomen", abdomen),
            ("hip", hip),
            ("half across shoulder", half_across_shoulder),
            ("neck", neck),
            ("arm length", arm_length),
            ("upper arm", upper_arm),
            ("wrist", wrist),
            ("upper thigh", upper_thigh),
            ("mid-thigh", mid_thigh),
            ("knee", knee),
            ("calf", calf),
            ("ankle", ankle),
            ("waist to ankle", waist_to_ankle),
        ]
    }

    /// Checks that a figure can have these measurements: each against the default scaled to the height, below 1.40 m against
    /// the usual child of that height, and some against each other.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let usual = Self::default();
        within("height", self.height, 0.98, 2.05, "")?;
        let tall = self.height / usual.height;
        let named = self.named().into_iter().zip(usual.named()).zip(childhood::usual(self.height));
        for (((name, value), (_, usual)), child) in named.skip(1) {
            let is_length = matches!(name, "arm length" | "waist to ankle" | "half across shoulder");
            let (low, high) = if is_length { (0.90, 1.12) } else { (0.74, 1.45) };
            within(name, value, low * usual * tall * child, high * usual * tall * child, " at this height")?;
        }
        within("waist", self.waist, 0.0, 1.02 * self.abdomen, " at this abdomen")?;
        within("abdomen", self.abdomen, 0.0, 1.06 * self.hip, " at this hip")?;
        within("upper thigh", self.upper_thigh, 0.50 * self.hip, 0.64 * self.hip, " at this hip")?;
        within(
            "mid-thigh",
            self.mid_thigh,
            0.75 * self.upper_thigh,
            self.upper_thigh,
            " at this upper thigh",
        )?;
        within("knee", self.knee, 0.55 * self.mid_thigh, self.mid_thigh, " at this mid-thigh")
    }
}

fn within(
    name: &'static str,
    value: f64,
    low: f64,
    high: f64,
    given: &'static str,
) -> Result<(), OutOfRange> {
    if value >= low && value <= high {
        return Ok(());
    }
    let [centimetres, lowest, highest] = [value, low, high].map(|m| m * 100.0);
    Err(OutOfRange { name, centimetres, lowest, highest, given })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_a_body() {
        assert_eq!(Measurements::default().check(), Ok(()));
    }

    #[test]
    fn nonsense_is_named() {
        let check = |m: Measurements| m.check().expect_err("refused").to_string();
        let usual = Measurements::default();
        assert!(check(Measurements { height: 0.3, ..usual }).starts_with("height is 30.0 cm"));
        assert!(check(Measurements { hip: f64::NAN, ..usual }).starts_with("hip"));
        assert!(check(Measurements { waist: 0.95, ..usual }).contains("at this abdomen"));
        assert!(check(Measurements { upper_thigh: 0.70, ..usual }).contains("at this hip"));
    }
}
