//! Tables of body sizes: the six that the corpus is drafted for, and those of children.

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

/// The sizes of grown figures, from the smallest to the largest.
pub const SIZES: [BodySize; 6] = [
    BodySize { name: "xs", given: [1.58, 0.80, 0.62, 0.87] },
    BodySize { name: "s", given: [1.64, 0.86, 0.67, 0.92] },
    BodySize { name: "m", given: [1.68, 0.92, 0.72, 0.98] },
    BodySize { name: "l", given: [1.72, 1.00, 0.80, 1.05] },
    BodySize { name: "xl", given: [1.74, 1.08, 0.89, 1.12] },
    BodySize { name: "xxl", given: [1.76, 1.16, 0.98, 1.20] },
];

/// The sizes of children, which are called by the height in centimetres (EN 13402-2), with the girths usual in the trade.
pub const CHILDREN: [BodySize; 12] = [
    BodySize { name: "98", given: [0.98, 0.55, 0.525, 0.57] },
    BodySize { name: "104", given: [1.04, 0.56, 0.535, 0.59] },
    BodySize { name: "110", given: [1.10, 0.58, 0.55, 0.61] },
    BodySize { name: "116", given: [1.16, 0.60, 0.56, 0.635] },
    BodySize { name: "122", given: [1.22, 0.62, 0.575, 0.66] },
    BodySize { name: "128", given: [1.28, 0.64, 0.59, 0.69] },
    BodySize { name: "134", given: [1.34, 0.67, 0.61, 0.72] },
    BodySize { name: "140", given: [1.40, 0.70, 0.63, 0.75] },
    BodySize { name: "146", given: [1.46, 0.73, 0.65, 0.78] },
    BodySize { name: "152", given: [1.52, 0.76, 0.67, 0.82] },
    BodySize { name: "158", given: [1.58, 0.80, 0.69, 0.855] },
    BodySize { name: "164", given: [1.64, 0.84, 0.71, 0.89] },
];

/// A table of sizes that is built in.
#[derive(Clone, Copy, Debug)]
pub struct SizeTable {
    /// Name on the command line.
    pub name: &'static str,
    /// Title for people.
    pub title: &'static str,
    /// Its sizes, from the smallest to the largest.
    pub sizes: &'static [BodySize],
}

/// The sizes of grown figures.
pub const ADULTS: SizeTable = SizeTable { name: "adults", title: "Adults, XS to XXL", sizes: &SIZES };

/// The tables that are built in.
pub const SIZE_TABLES: [SizeTable; 2] =
    [ADULTS, SizeTable { name: "children", title: "Children, 98 to 164 cm", sizes: &CHILDREN }];

impl SizeTable {
    /// The table as `--sizes` reads it: CSV, centimetres.
    pub fn csv(&self) -> String {
        let mut text = format!("size,{}\n", GIVEN.join(","));
        for BodySize { name, given } in self.sizes {
            let cells: Vec<String> = given.iter().map(|metres| format!("{:.1}", metres * 100.0)).collect();
            text += &format!("{name},{}\n", cells.join(","));
        }
        text
    }
}

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

    #[test]
    fn children_are_within_it_too() {
        for size in CHILDREN {
            let measurements = size.measurements();
            assert_eq!(measurements.check(), Ok(()), "{}", size.name);
            assert_eq!(format!("{:.0}", measurements.height * 100.0), size.name);
        }
        for pair in CHILDREN.windows(2) {
            let [small, large] = [pair[0], pair[1]].map(|size| size.measurements());
            assert!(small.arm_length < large.arm_length && small.waist_to_ankle < large.waist_to_ankle);
        }
        assert!(SIZE_TABLES[1].csv().contains("\n116,116.0,60.0,56.0,63.5\n"));
    }
}
