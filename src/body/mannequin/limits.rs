//! The measurements that a figure can have.

use super::childhood;
use super::measurements::Measurements;
use crate::geometry::words::{Words, decimal, words};

/// Error: a measurement that no body has.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.words())]
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

impl OutOfRange {
    /// The error in words.
    pub fn words(&self) -> Words {
        let [is, least, most] = [self.centimetres, self.lowest, self.highest].map(|cm| decimal(cm, 1));
        words!(
            "{name} is {is} cm; a mannequin can be built with {least} to {most} cm{given}",
            name = Words::listed(self.name),
            is,
            least,
            most,
            given = Words::listed(self.given)
        )
    }
}

impl Measurements {
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
