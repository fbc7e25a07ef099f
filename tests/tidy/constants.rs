//! The rooms that move cloth have few tuned constants, and each says what it is for.

use std::fs;

use super::circles::without_tests;
use super::{files_below, root};

/// Rooms whose constants decide how cloth moves.
const ROOMS: [&str; 6] = ["contact", "relax", "wrap", "place", "drape", "repose"];
/// Constants that these rooms may have together. Before a new one: does another one mean the same, does it follow from others, or may
/// the task do without?
const MOST_CONSTANTS: usize = 120;
/// Numbers that stand in these constants: a table of settings is one constant, but each of its numbers is tuned.
const MOST_NUMBERS: usize = 221;

/// A constant of a source file.
#[derive(Debug, PartialEq, Eq)]
struct Constant {
    name: String,
    /// Numbers in its value.
    numbers: usize,
    /// Whether there is a comment on it.
    is_told: bool,
}

/// The constants of `text`, those of types included.
fn constants(text: &str) -> Vec<Constant> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let constant = |(at, line): (usize, &&str)| {
        let (before, after) = line.split_once("const ")?;
        let (name, _) = after.split_once(':')?;
        let is_item = before.is_empty() || (before.starts_with("pub") && before.ends_with(' '));
        let is_name = name.starts_with(|c: char| c.is_ascii_uppercase())
            && name.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_');
        if !is_item || !is_name {
            return None;
        }
        let last = lines[at..].iter().position(|line| line.ends_with(';'))?;
        let whole = lines[at..=at + last].join(" ");
        let (_, value) = whole.split_once('=')?;
        let told = lines[..at].iter().rev().find(|line| !line.starts_with("#["));
        Some(Constant {
            name: name.to_owned(),
            numbers: numbers(value),
            is_told: told.is_some_and(|line| line.starts_with("///")),
        })
    };
    lines.iter().enumerate().filter_map(constant).collect()
}

/// How many numbers are written in `value`.
fn numbers(value: &str) -> usize {
    // The exponent of 1e-3 is no number of its own.
    let value = value.replace("e-", "e");
    let words = value.split(|c: char| !c.is_alphanumeric() && c != '_' && c != '.');
    words.filter(|word| word.starts_with(|c: char| c.is_ascii_digit())).count()
}

#[test]
fn constants_are_seen() {
    let text = "/// Told.\n#[allow(x)]\npub(in crate::a) const A_1: [f64; 2] = [1e-3, 2.0 * B];\nconst fn f() {}\nimpl S {\n    const T: S =\n        \
                S { x: 0.5, y: u32::MAX };\n    let constant: u32 = 1;\n}\n";
    let constant = |name: &str, numbers, is_told| Constant { name: name.to_owned(), numbers, is_told };
    assert_eq!(constants(text), [constant("A_1", 2, true), constant("T", 1, false)]);
}

#[test]
fn constants_that_move_cloth_are_few_and_told() {
    let (mut found, mut untold) = (Vec::new(), Vec::new());
    for path in ROOMS.iter().flat_map(|room| files_below(&root().join("src").join(room), "rs")) {
        if path.ends_with("tests.rs") {
            continue;
        }
        let text = fs::read_to_string(&path).expect("a readable source file");
        let own = constants(&without_tests(&text));
        untold.extend(own.iter().filter(|c| !c.is_told).map(|c| format!("{}: {}", path.display(), c.name)));
        found.extend(own);
    }
    assert!(untold.is_empty(), "no comment says what these are for: {untold:#?}");
    let numbers: usize = found.iter().map(|c| c.numbers).sum();
    assert!(found.len() > 50, "{} constants", found.len());
    assert!(found.len() <= MOST_CONSTANTS, "{} constants, at most {MOST_CONSTANTS}", found.len());
    assert!(numbers <= MOST_NUMBERS, "{numbers} numbers in constants, at most {MOST_NUMBERS}");
}
