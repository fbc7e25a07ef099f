//! Grade rule tables (`.rul`): the text file beside a DXF of AAMA-292 or ASTM D6673 that says how far its numbered points move
//! from size to size.
//!
//! ```text
//! ANSI/AAMA VERSION: 1.0.0
//! UNITS: METRIC
//! NUMBER OF SIZES: 3
//! SIZE LIST: S M L
//! SAMPLE SIZE: M
//! RULE: DELTA 1
//!    -5.0000,   0.0000    0.0000,   0.0000    5.0000,   0.0000
//! ```
//!
//! A pair for each size, from the sample size, in the axes of the drawing: millimetres, or inches where `UNITS` is `ENGLISH`.
//! Pairs may stand on one line or many, also on that of the rule. In the drawing a text `# 1` at a point gives it rule 1.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use glam::DVec2;

use crate::geometry::words::{Words, within_quotes, words};
use crate::io::Limits;
use crate::io::pattern_file::PatternFileError;
use crate::io::words::{self, readable_words};
use crate::pattern::{GradeRule, SizeRun};

/// Extension of the files.
pub const ENDING: &str = "rul";
/// Most rules of a table.
const MOST_RULES: usize = 10_000;
/// Millimetres in a metre.
const MILLIMETRES: f64 = 1000.0;
/// An inch, metres.
const INCH: f64 = 0.0254;
/// Most pairs on a line that is written.
const PAIRS: usize = 4;

/// A grade rule table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RuleTable {
    /// The sizes; the sample size is the base.
    pub sizes: SizeRun,
    /// The rules by number, in the axes of the drawing, metres.
    pub rules: BTreeMap<u32, GradeRule>,
}

/// The names that the table of a drawing may have, in the order in which they are looked for; none where it is no DXF.
pub fn names_beside(drawing: &Path) -> Vec<PathBuf> {
    let is_dxf = drawing.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("dxf"));
    let endings = if is_dxf { &[ENDING, "RUL"][..] } else { &[] };
    endings.iter().map(|ending| drawing.with_extension(ending)).collect()
}

/// What has been read so far.
#[derive(Default)]
struct Reading {
    unit: Option<f64>,
    count: Option<(usize, usize)>,
    names: Option<Vec<String>>,
    sample: Option<(usize, String)>,
    rules: BTreeMap<u32, (usize, Vec<DVec2>)>,
    /// The rule whose pairs are being read.
    open: Option<u32>,
}

/// Reads a table.
///
/// # Errors
/// What is wrong, with its line.
pub fn read(bytes: &[u8]) -> Result<RuleTable, PatternFileError> {
    let limit = Limits::default().file_bytes;
    if bytes.len() > limit {
        let (count, most) = (bytes.len(), limit);
        let words = words!("the rule table has {count} bytes; {most} are allowed", count, most);
        return Err(PatternFileError::OverLimit(words));
    }
    // Old files are in the code page of their country; keys and numbers are ASCII in all of them.
    let text = String::from_utf8_lossy(bytes);
    let mut reading = Reading::default();
    for (i, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let line = line.trim();
        if line.eq_ignore_ascii_case("END") {
            break;
        }
        reading.take(line, i + 1).map_err(|words| bad(i + 1, words))?;
        if reading.rules.len() > MOST_RULES {
            return Err(PatternFileError::OverLimit(words!(
                "more than {most} grade rules",
                most = MOST_RULES
            )));
        }
    }
    reading.finish()
}

fn bad(line: usize, words: Words) -> PatternFileError {
    PatternFileError::bad(words::line(line), readable_words(words))
}

impl Reading {
    fn take(&mut self, line: &str, number: usize) -> Result<(), Words> {
        let Some((key, value)) = line.split_once(':') else {
            return match self.open {
                Some(rule) => self.pairs(rule, line),
                // Lines before the rules that are not known, such as "version ANSI/AAMA-292-B", say nothing about sizes.
                None => Ok(()),
            };
        };
        let value = value.trim();
        match key.trim().to_ascii_uppercase().as_str() {
            "UNITS" => {
                self.unit = Some(match value.to_ascii_uppercase().as_str() {
                    "METRIC" => 1.0 / MILLIMETRES,
                    "ENGLISH" => INCH,
                    _ => {
                        let given = within_quotes(value);
                        return Err(words!("the units are \"{given}\", not METRIC or ENGLISH", given));
                    }
                });
            }
            "NUMBER OF SIZES" => {
                let wrong = || words!("\"{given}\" is no number of sizes", given = within_quotes(value));
                self.count = Some((number, value.parse().map_err(|_| wrong())?));
            }
            "SIZE LIST" => self.names = Some(value.split_whitespace().map(str::to_owned).collect()),
            "SAMPLE SIZE" => self.sample = Some((number, value.to_owned())),
            "RULE" => return self.begin(value, number),
            _ => {}
        }
        self.open = None;
        Ok(())
    }

    fn begin(&mut self, value: &str, number: usize) -> Result<(), Words> {
        let mut words = value.splitn(2, char::is_whitespace);
        let kind = words.next().unwrap_or_default();
        if !kind.eq_ignore_ascii_case("DELTA") {
            let kind = within_quotes(kind);
            return Err(words!("a rule of the kind \"{kind}\": only DELTA is known", kind));
        }
        let rest = words.next().unwrap_or_default().trim_start();
        let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        let wrong = || words!("\"{given}\" names no rule by its number", given = within_quotes(value));
        let rule: u32 = rest[..end].parse().map_err(|_| wrong())?;
        if self.rules.insert(rule, (number, Vec::new())).is_some() {
            return Err(words!("rule {n} is there twice", n = rule));
        }
        self.open = Some(rule);
        self.pairs(rule, &rest[end..])
    }

    /// Takes the pairs "x, y" of a line.
    fn pairs(&mut self, rule: u32, line: &str) -> Result<(), Words> {
        let of = |words: Words| words!("rule {n}", n = rule).and(": ", words);
        // Blanks beside a comma belong to its pair; others are between pairs.
        let mut numbers: Vec<f64> = Vec::new();
        let mut commas = 0;
        for word in line.replace(',', " , ").split_whitespace() {
            match word {
                "," => {
                    commas += 1;
                    if numbers.len() != 2 * commas - 1 {
                        return Err(of(words!("a comma is not inside a pair of numbers")));
                    }
                }
                _ => {
                    let given = || within_quotes(word);
                    let wrong = || of(words!("\"{value}\" is no number", value = given()));
                    let value: f64 = word.parse().map_err(|_| wrong())?;
                    if !value.is_finite() {
                        return Err(of(words!("\"{value}\" is no finite number", value = given())));
                    }
                    numbers.push(value);
                }
            }
        }
        if numbers.len() != 2 * commas {
            return Err(of(words!("a number without a partner")));
        }
        let (_, pairs) = self.rules.entry(rule).or_default();
        pairs.extend(numbers.chunks_exact(2).map(|pair| DVec2::new(pair[0], pair[1])));
        Ok(())
    }

    fn finish(self) -> Result<RuleTable, PatternFileError> {
        let whole = PatternFileError::Whole;
        let no_names = || whole(words!("this is no grade rule table: it has no SIZE LIST"));
        let names = self.names.ok_or_else(no_names)?;
        let no_sample = || whole(words!("the rule table names no SAMPLE SIZE"));
        let (line, sample) = self.sample.ok_or_else(no_sample)?;
        if let Some((line, count)) = self.count.filter(|(_, count)| *count != names.len()) {
            let listed = names.len();
            return Err(bad(
                line,
                words!("{count} sizes are announced, but {listed} are listed", count, listed),
            ));
        }
        let Some(sizes) = SizeRun::new(names.iter().map(String::as_str), &sample) else {
            let name = within_quotes(&sample);
            return Err(bad(line, words!("the sample size \"{name}\" is not among the sizes listed", name)));
        };
        if let Some(words) = sizes.problem() {
            return Err(whole(readable_words(words)));
        }
        let unit = self.unit.ok_or_else(|| whole(words!("the rule table names no UNITS")))?;
        let mut rules = BTreeMap::new();
        for (number, (line, pairs)) in self.rules {
            let rule = GradeRule(pairs).mapped(|by| by * unit).from_size(sizes.base);
            if let Some(words) = rule.problem(sizes.len(), sizes.base) {
                return Err(bad(line, words!("rule {n}", n = number).and(": ", words)));
            }
            rules.insert(number, rule);
        }
        Ok(RuleTable { sizes, rules })
    }
}

impl RuleTable {
    /// The number of `rule`, which is added where it is not there yet.
    pub fn number(&mut self, rule: &GradeRule) -> u32 {
        let known = self.rules.iter().find(|(_, known)| *known == rule).map(|(number, _)| *number);
        known.unwrap_or_else(|| {
            let number = self.rules.keys().next_back().map_or(1, |last| last + 1);
            self.rules.insert(number, rule.clone());
            number
        })
    }

    /// The table as a file, in millimetres. Blanks in names of sizes become "_", since blanks are between names.
    pub fn write(&self, title: &str) -> Vec<u8> {
        let Self { sizes, rules } = self;
        let plain = |name: &str| name.replace(char::is_whitespace, "_");
        let names: Vec<String> = sizes.names.iter().map(|name| plain(name)).collect();
        let mut lines = vec![
            "ANSI/AAMA VERSION: 1.0.0".to_owned(),
            "AUTHOR: TOILE".to_owned(),
            "UNITS: METRIC".to_owned(),
            format!("GRADE RULE TABLE: {}", plain(title)),
            format!("NUMBER OF SIZES: {}", names.len()),
            format!("SIZE LIST: {}", names.join(" ")),
            format!("SAMPLE SIZE: {}", plain(sizes.base_name())),
        ];
        for (number, rule) in rules {
            lines.push(format!("RULE: DELTA {number}"));
            for pairs in rule.0.chunks(PAIRS) {
                let mut line = String::new();
                for by in pairs {
                    let by = *by * MILLIMETRES;
                    // Writing to a string cannot fail.
                    write!(line, "{:>11.4},{:>10.4}", by.x, by.y).unwrap_or_default();
                }
                lines.push(line);
            }
        }
        lines.push("END".to_owned());
        (lines.join("\r\n") + "\r\n").into_bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "ANSI/AAMA VERSION: 1.0.0
AUTHOR: a program
UNITS: METRIC
GRADE RULE TABLE: SHIRT
NUMBER OF SIZES:  5
SIZE LIST: XS S M L XL
SAMPLE SIZE: M
RULE: DELTA 1  -10.00, 0.00  -5.00, 0.00  0.00, 0.00  5.00, 0.00  10.00, 0.00
RULE: DELTA  12
    -10.00,     2.00     -5.00,     1.00      0.00,     0.00      5.00,    -1.00
     10.00,    -2.50
END
what stands here is not read
";

    fn why(text: &str) -> String {
        read(text.as_bytes()).expect_err("refused").to_string()
    }

    #[test]
    fn pairs_are_read_on_one_line_or_many() {
        for text in [TABLE.to_owned(), TABLE.replace('\n', "\r\n"), format!("\u{feff}{TABLE}")] {
            let table = read(text.as_bytes()).expect("a table");
            assert_eq!((table.sizes.names.join(" "), table.sizes.base), ("XS S M L XL".to_owned(), 2));
            assert_eq!(table.rules.keys().collect::<Vec<_>>(), [&1, &12]);
            assert!(table.rules[&1].at(4).distance(DVec2::new(0.01, 0.0)) < 1e-15);
            assert!(table.rules[&12].at(4).distance(DVec2::new(0.01, -0.0025)) < 1e-15);
        }
        let inches = read(TABLE.replace("METRIC", "ENGLISH").replace("10.00", "1.00").as_bytes());
        assert!((inches.expect("a table").rules[&1].at(4).x - 0.0254).abs() < 1e-15);
    }

    #[test]
    fn what_is_written_is_read_again() {
        let table = read(TABLE.as_bytes()).expect("a table");
        let again = read(&table.write("my shirt")).expect("read again");
        assert_eq!(again.sizes, table.sizes);
        for (number, rule) in &table.rules {
            for (by, read) in rule.0.iter().zip(&again.rules[number].0) {
                assert!(by.distance(*read) < 1e-9);
            }
        }
    }

    #[test]
    fn equal_rules_share_a_number() {
        let mut table = RuleTable::default();
        let rule = |x: f64| GradeRule(vec![DVec2::new(x, 0.0)]);
        assert_eq!([0.01, 0.02, 0.01].map(|x| table.number(&rule(x))), [1, 2, 1]);
    }

    #[test]
    fn every_fault_names_its_line() {
        let with = |from: &str, to: &str| why(&TABLE.replace(from, to));
        assert!(with("METRIC", "FURLONG").starts_with("line 3: the units are \"FURLONG\""));
        assert!(
            with("SIZES:  5", "SIZES:  6").starts_with("line 5: 6 sizes are announced, but 5 are listed")
        );
        assert!(with("SIZES:  5", "SIZES: many").starts_with("line 5: \"many\" is no number"));
        assert!(with("SAMPLE SIZE: M", "SAMPLE SIZE: 38").starts_with("line 7: the sample size \"38\""));
        assert!(
            with("  10.00, 0.00\nRULE", "\nRULE").starts_with("line 8: rule 1: a rule has 4 displacements")
        );
        assert!(with("5.00,    -1.00", "5.00,    one").starts_with("line 10: rule 12: \"one\" is no number"));
        assert!(with("10.00,    -2.50", "10.00").starts_with("line 11: rule 12: a number without a partner"));
        assert!(with("10.00,    -2.50", "10.00,,3").starts_with("line 11: rule 12: a comma"));
        assert!(with("DELTA  12", "DELTA  1").starts_with("line 9: rule 1 is there twice"));
        assert!(with("DELTA  12", "OFFSET 12").starts_with("line 9: a rule of the kind \"OFFSET\""));
        assert!(with("DELTA  12", "DELTA twelve").starts_with("line 9: "));
        assert!(with("10.00,    -2.50", "10000.00,  0").starts_with("line 9: rule 12: a rule moves"));
        assert!(with("XS S M L XL", "S S M L XL").contains("two sizes S"));
        assert!(with("UNITS: METRIC\n", "").contains("no UNITS"));
        assert!(why("").contains("no SIZE LIST"));
    }

    #[test]
    fn no_damage_makes_it_panic() {
        for at in 0..TABLE.len() {
            let _ = read(&TABLE.as_bytes()[..at]);
            for byte in [b',', b':', b'\n', b'9', 0xff] {
                let mut bytes = TABLE.as_bytes().to_vec();
                bytes[at] = byte;
                let _ = read(&bytes);
            }
        }
    }
}
