//! Size runs: the sizes of a pattern in order, one of which it is drawn in.

use serde::{Deserialize, Serialize};

use crate::geometry::names;
use crate::geometry::words::{Words, within_quotes, words};

/// Most sizes of a run.
pub const MOST_SIZES: usize = 40;
/// Most characters of a size's name.
const LONGEST_NAME: usize = 40;

/// The sizes of a pattern, from small to large. Empty: the pattern is not graded.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SizeRun {
    /// Their names, each once.
    pub names: Vec<String>,
    /// Number of the base size, in which the pattern is drawn, from 0.
    pub base: usize,
}

impl SizeRun {
    /// A run of these sizes with `base` as its base size. None where `base` is not among them.
    pub fn new<'a>(names: impl IntoIterator<Item = &'a str>, base: &str) -> Option<Self> {
        let names: Vec<String> = names.into_iter().map(str::to_owned).collect();
        let base = names.iter().position(|name| name == base)?;
        Some(Self { names, base })
    }

    /// Whether there are no sizes.
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// Number of sizes.
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// Name of the base size; empty where there are no sizes.
    pub fn base_name(&self) -> &str {
        self.names.get(self.base).map_or("", String::as_str)
    }

    /// The number of the size called `name`, from 0; case counts only between names that differ by it alone.
    ///
    /// # Errors
    /// There is no such size, in words that list those there are.
    pub fn number(&self, name: &str) -> Result<usize, Words> {
        let found = names::found(self.names.iter().map(String::as_str), name);
        found.ok_or_else(|| match self.is_empty() {
            true => words!("the pattern has no sizes: choose a size run first"),
            false => {
                words!(
                    "the pattern has no size \"{name}\": it has {names}",
                    name = within_quotes(name.trim()),
                    names = self.names.join(", ")
                )
            }
        })
    }

    /// What is wrong with the run, in words.
    pub fn problem(&self) -> Option<Words> {
        let Self { names, base } = self;
        if names.is_empty() {
            return (*base != 0).then(|| words!("there are no sizes, but a base size"));
        }
        if names.len() > MOST_SIZES {
            return Some(words!(
                "a pattern may have {most} sizes, this has {count}",
                most = MOST_SIZES,
                count = names.len()
            ));
        }
        if *base >= names.len() {
            return Some(words!(
                "size {n} is to be the base of {count} sizes",
                n = base.saturating_add(1),
                count = names.len()
            ));
        }
        names.iter().enumerate().find_map(|(i, name)| {
            let is_name = !name.is_empty()
                && name.trim() == name
                && name.chars().count() <= LONGEST_NAME
                && !name.chars().any(|c| c.is_control() || c == ',');
            if !is_name {
                return Some(words!(
                    "size {n} is called \"{name}\": a name has 1 to {most} characters, none of them a comma",
                    n = i + 1,
                    name = within_quotes(name),
                    most = LONGEST_NAME
                ));
            }
            names[..i].contains(name).then(|| words!("there are two sizes {name}", name))
        })
    }
}

/// A size run that is offered.
#[derive(Clone, Copy, Debug)]
pub struct ReadySizes {
    /// Title for people.
    pub title: &'static str,
    /// Names of its sizes.
    pub names: &'static [&'static str],
    /// Its base size.
    pub base: &'static str,
}

impl ReadySizes {
    /// It as a run.
    pub fn run(&self) -> SizeRun {
        SizeRun::new(self.names.iter().copied(), self.base).unwrap_or_default()
    }
}

/// The size runs that are offered.
pub const READY_SIZES: [ReadySizes; 7] = [
    ReadySizes { title: "XS to XXL", names: &["XS", "S", "M", "L", "XL", "XXL"], base: "M" },
    ReadySizes {
        title: "Women, EU 34 to 46",
        names: &["34", "36", "38", "40", "42", "44", "46"],
        base: "38",
    },
    ReadySizes { title: "Men, EU 44 to 56", names: &["44", "46", "48", "50", "52", "54", "56"], base: "50" },
    ReadySizes { title: "Women, US 0 to 14", names: &["0", "2", "4", "6", "8", "10", "12", "14"], base: "6" },
    ReadySizes { title: "Women, UK 6 to 18", names: &["6", "8", "10", "12", "14", "16", "18"], base: "10" },
    ReadySizes {
        title: "Children, 98 to 164 cm",
        names: &["98", "104", "110", "116", "122", "128", "134", "140", "146", "152", "158", "164"],
        base: "116",
    },
    ReadySizes {
        title: "Babies, 50 to 92 cm",
        names: &["50", "56", "62", "68", "74", "80", "86", "92"],
        base: "68",
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ready_runs_are_sound_and_have_their_bases() {
        for ready in READY_SIZES {
            let run = ready.run();
            assert_eq!((run.problem(), run.len()), (None, ready.names.len()), "{}", ready.title);
            assert_eq!(run.base_name(), ready.base);
        }
        assert_eq!(SizeRun::default().problem(), None);
        assert!(SizeRun::new(["S", "M"], "L").is_none());
    }

    #[test]
    fn sizes_are_found_by_name() {
        let run = READY_SIZES[0].run();
        assert_eq!((run.number(" L"), run.number("xxl")), (Ok(3), Ok(5)));
        let why = run.number("38").expect_err("not there");
        assert_eq!(why, "the pattern has no size \"38\": it has XS, S, M, L, XL, XXL");
        assert!(SizeRun::default().number("M").expect_err("none").contains("no sizes"));
    }

    #[test]
    fn faulty_runs_are_told() {
        let run = |names: &[&str], base: usize| SizeRun {
            names: names.iter().map(|name| (*name).to_owned()).collect(),
            base,
        };
        for (run, words) in [
            (run(&["S", "S"], 0), "two sizes S"),
            (run(&["S", " M"], 0), "size 2 is called \" M\""),
            (run(&["S,M"], 0), "comma"),
            (run(&[""], 0), "characters"),
            (run(&["S"], 1), "size 2 is to be the base of 1"),
            (run(&[], 2), "no sizes"),
        ] {
            assert!(run.problem().is_some_and(|told| told.contains(words)), "{run:?}: {:?}", run.problem());
        }
        let many: Vec<String> = (0..=MOST_SIZES).map(|i| i.to_string()).collect();
        assert!(SizeRun { names: many, base: 0 }.problem().is_some_and(|told| told.contains("40 sizes")));
    }
}
