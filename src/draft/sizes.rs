//! The six body sizes that the corpus is drafted for.

use crate::body::Measurements;

/// A body size of the mannequin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodySize {
    /// Name on the command line: "xs" to "xxl".
    pub name: &'static str,
    /// Height, bust, waist and hip, metres; all other measurements are in proportion.
    given: [f64; 4],
}

/// Names of the measurements that a size gives, in the order of [`BodySize::given`].
const GIVEN: [&str; 4] = ["height", "bust", "waist", "hip"];

/// All sizes, from the smallest to the largest.
pub const SIZES: [BodySize; 6] = [
    BodySize { name: "xs", given: [1.58, 0.80, 0.62, 0.87] },
    BodySize { name: "s", given: [1.64, 0.86, 0.67, 0.92] },
    BodySize { name: "m", given: [1.68, 0.92, 0.72, 0.98] },
    BodySize { name: "l", given: [1.72, 1.00, 0.80, 1.05] },
    BodySize { name: "xl", given: [1.74, 1.08, 0.89, 1.12] },
    BodySize { name: "xxl", given: [1.76, 1.16, 0.98, 1.20] },
];

impl BodySize {
    /// All measurements of the size.
    pub fn measurements(&self) -> Measurements {
        let given = GIVEN.iter().zip(self.given);
        Measurements::completed(|name| given.clone().find(|(known, _)| **known == name).map(|(_, x)| x))
    }

    /// Index in [`SIZES`].
    pub fn number(&self) -> usize {
        SIZES.iter().position(|size| size.name == self.name).unwrap_or(0)
    }
}

impl std::str::FromStr for BodySize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let names = SIZES.map(|size| size.name).join(", ");
        let found = SIZES.into_iter().find(|size| size.name.eq_ignore_ascii_case(text.trim()));
        found.ok_or_else(|| format!("there is no size {text:?}; there are {names}"))
    }
}

/// The sizes as a table that `--sizes` can read: CSV, centimetres.
pub fn table() -> String {
    let mut text = format!("size,{}\n", GIVEN.join(","));
    for BodySize { name, given } in SIZES {
        let cells: Vec<String> = given.iter().map(|metres| format!("{:.1}", metres * 100.0)).collect();
        text += &format!("{name},{}\n", cells.join(","));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_are_within_the_mannequins_range() {
        for size in SIZES {
            assert_eq!(size.measurements().check(), Ok(()), "{}", size.name);
            assert_eq!(size.name.parse(), Ok(size));
            assert_eq!(SIZES[size.number()], size);
        }
        assert!("xxxl".parse::<BodySize>().is_err());
    }
}
