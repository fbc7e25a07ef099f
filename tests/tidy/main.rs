//! The house rules of `src/lib.rs`, held by reading the source.

mod circles;
mod constants;
mod texts;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Lines a function may have, outside tests.
const LONGEST_FUNCTION: usize = 80;
/// Lines a file may have.
const MOST_LINES: usize = 700;
/// Folders with neither clock nor chance nor hash maps: the same input gives the same bits.
const EXACT: [&str; 17] = [
    "geometry", "pattern", "body", "cloth", "contact", "relax", "wrap", "drag", "drape", "repose", "fit",
    "sim", "session", "io", "draft", "marker", "pack",
];

/// A source file, without its comments.
struct Source {
    /// From the root of the package: "src/sim/thread.rs".
    path: String,
    /// "sim"; empty for files in `src` itself.
    folder: String,
    code: String,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn files_below(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let Ok(entries) = fs::read_dir(folder) else { return files };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            files.extend(files_below(&path, extension));
        } else if path.extension().is_some_and(|e| e == extension) {
            files.push(path);
        }
    }
    files.sort();
    files
}

fn sources() -> Vec<Source> {
    files_below(&root().join("src"), "rs").iter().map(|path| source(path)).collect()
}

fn source(path: &Path) -> Source {
    let text = fs::read_to_string(path).expect("a readable source file");
    let path = path.strip_prefix(root()).expect("below the root").to_string_lossy().replace('\\', "/");
    let parts: Vec<&str> = path.split('/').collect();
    let folder = if parts.len() > 2 { parts[1].to_owned() } else { String::new() };
    Source { folder, code: without_comments(&text), path }
}

fn without_comments(text: &str) -> String {
    // Between quotes, "//" is part of a text.
    let is_text = |before: &str| {
        let quotes = before.replace("\\\"", "").replace("'\"'", "").matches('"').count();
        !quotes.is_multiple_of(2)
    };
    let code = |line: &str| {
        let end = line.match_indices("//").map(|(at, _)| at).find(|&at| !is_text(&line[..at]));
        line[..end.unwrap_or(line.len())].to_owned()
    };
    text.lines().map(code).collect::<Vec<_>>().join("\n")
}

/// For each folder of the map at the top of `src/lib.rs` the folders it may use.
fn map() -> BTreeMap<String, BTreeSet<String>> {
    let text = fs::read_to_string(root().join("src/lib.rs")).expect("src/lib.rs");
    let mut map: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for row in text.lines().filter_map(|line| line.strip_prefix("//! | `")) {
        let cells: Vec<&str> = row.trim_end_matches(['|', ' ']).split('|').collect();
        let [name, _, uses] = cells[..] else { panic!("a row of the map has three cells: {row}") };
        let folder = name.trim().trim_end_matches('`').to_owned();
        let allowed = allowed(uses.trim(), &map);
        map.insert(folder, allowed);
    }
    assert!(map.len() > 5, "the map is in src/lib.rs");
    map
}

/// "nothing of ours", "the above", or a list of folders, each perhaps "NAME and below".
fn allowed(words: &str, above: &BTreeMap<String, BTreeSet<String>>) -> BTreeSet<String> {
    match words {
        "nothing of ours" => return BTreeSet::new(),
        "the above" => return above.keys().cloned().collect(),
        _ => {}
    }
    let mut allowed = BTreeSet::new();
    for word in words.split(',').map(str::trim) {
        let name = word.strip_suffix(" and below").unwrap_or(word);
        if name != word {
            let below = above.get(name).unwrap_or_else(|| panic!("{name} is above in the map"));
            allowed.extend(below.iter().cloned());
        }
        allowed.insert(name.to_owned());
    }
    allowed
}

/// Folders that `code` names after `crate::`, also in groups.
fn folders_used(code: &str) -> BTreeSet<String> {
    let mut used = BTreeSet::new();
    for (i, _) in code.match_indices("crate::") {
        if code[..i].ends_with('$') {
            continue;
        }
        let rest = &code[i + "crate::".len()..];
        match rest.strip_prefix('{') {
            Some(group) => used.extend(group_heads(group)),
            None => used.extend(identifier(rest)),
        }
    }
    used
}

fn group_heads(group: &str) -> Vec<String> {
    let (mut depth, mut at_head, mut heads) = (0, true, Vec::new());
    for (i, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => at_head = true,
            _ if at_head && depth == 0 && !c.is_whitespace() => {
                heads.extend(identifier(&group[i..]));
                at_head = false;
            }
            _ => {}
        }
    }
    heads
}

fn identifier(text: &str) -> Option<String> {
    let name: String = text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    (!name.is_empty()).then_some(name)
}

/// Whether `word` stands in `code` as a word of its own.
fn has_word(code: &str, word: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(word)
        .any(|(i, _)| !code[..i].ends_with(part) && !code[i + word.len()..].starts_with(part))
}

#[test]
fn groups_and_paths_are_seen() {
    let code = "use crate::{a, b::{c, d}, e};\nlet x = crate::f::g(); $crate::h";
    let expected: BTreeSet<String> = ["a", "b", "e", "f"].map(str::to_owned).into();
    assert_eq!(folders_used(code), expected);
    assert!(has_word("let x: HashMap<", "HashMap") && !has_word("MyHashMaps", "HashMap"));
}

#[test]
fn the_map_names_every_folder_and_no_other() {
    let on_disk: BTreeSet<String> = fs::read_dir(root().join("src"))
        .expect("src")
        .flatten()
        .filter(|e| e.path().is_dir())
        .map(|e| e.file_name().to_string_lossy().into_owned())
        .collect();
    let on_map: BTreeSet<String> = map().into_keys().collect();
    assert_eq!(on_disk, on_map, "left: folders of src, right: rows of the map in src/lib.rs");
}

#[test]
fn folders_use_only_what_the_map_allows() {
    let map = map();
    let mut wrong = Vec::new();
    for source in sources().iter().filter(|s| !s.folder.is_empty()) {
        let Some(allowed) = map.get(&source.folder) else { continue };
        for used in folders_used(&source.code) {
            if map.contains_key(&used) && used != source.folder && !allowed.contains(&used) {
                wrong.push(format!("{} uses crate::{used}", source.path));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The chains of the drawing at the top of `src/lib.rs`: what stands left of an arrow uses what stands right of it.
#[test]
fn the_arrows_of_the_map_say_what_its_table_says() {
    let map = map();
    let text = fs::read_to_string(root().join("src/lib.rs")).expect("src/lib.rs");
    let drawing = text.split("```text").nth(1).and_then(|rest| rest.split("```").next()).expect("a drawing");
    let names = |part: &str| -> Vec<String> {
        let words = part.split(|c: char| !c.is_ascii_lowercase());
        words.filter(|word| map.contains_key(*word)).map(str::to_owned).collect()
    };
    let mut arrows = 0;
    for line in drawing.lines() {
        let parts: Vec<Vec<String>> = line.split('→').map(names).collect();
        for pair in parts.windows(2).filter(|pair| !pair[0].is_empty()) {
            for used in &pair[1] {
                arrows += 1;
                let is_used = pair[0].iter().any(|user| map[user].contains(used));
                let goes_back = pair[0].iter().any(|user| map[used].contains(user));
                assert!(is_used && !goes_back, "{} → {used}", pair[0].join(", "));
            }
        }
    }
    assert!(arrows > 10, "{arrows} arrows");
}

/// Every place of one of `words` in a file that `may` have it not.
fn found_outside(words: &[&str], may: impl Fn(&Source) -> bool) -> Vec<String> {
    let sources = sources();
    let outside = sources.iter().filter(|s| !may(s));
    outside
        .flat_map(|s| words.iter().filter(|w| has_word(&s.code, w)).map(|w| format!("{}: {w}", s.path)))
        .collect()
}

fn none_outside(words: &[&str], may: impl Fn(&Source) -> bool) {
    let found = found_outside(words, may);
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn egui_stays_in_ui_and_wgpu_in_ui_render_and_card() {
    none_outside(&["egui", "eframe", "egui_wgpu", "egui_tiles", "winit", "rfd"], |s| s.folder == "ui");
    none_outside(&["wgpu"], |s| ["ui", "render", "card"].contains(&s.folder.as_str()));
}

#[test]
fn nothing_exact_reads_a_clock_or_a_hash_map() {
    let exact = |s: &Source| EXACT.contains(&s.folder.as_str());
    none_outside(&["HashMap", "HashSet", "RandomState"], |s| !exact(s));
    none_outside(&["Instant", "SystemTime"], |s| !exact(s) || s.path == "src/sim/thread.rs");
}

#[test]
fn threads_live_in_sim_thread_and_where_signals_are_awaited() {
    let words = ["thread::spawn", "thread::Builder", "thread::scope"];
    let may = ["src/sim/thread.rs", "src/cli/interrupt.rs"];
    let outside: Vec<String> = sources()
        .iter()
        .filter(|s| !may.contains(&s.path.as_str()) && s.folder != "ui")
        .flat_map(|s| words.iter().filter(|w| s.code.contains(**w)).map(|w| format!("{}: {w}", s.path)))
        .collect();
    assert!(outside.is_empty(), "{outside:#?}");
}

#[test]
fn files_are_opened_at_the_rims_only() {
    let may = |s: &Source| {
        ["io", "cli", "ui", ""].contains(&s.folder.as_str())
            || ["src/session/project_file.rs", "src/session/recording.rs", "src/session/whole_file.rs"]
                .contains(&s.path.as_str())
            || s.path.starts_with("src/session/recovery/")
    };
    let opens = |s: &&Source| {
        let code = s.code.split("#[cfg(test)]").next().unwrap_or_default();
        code.contains("std::fs") || code.contains("std::{fs")
    };
    let outside: Vec<String> =
        sources().iter().filter(opens).filter(|s| !may(s)).map(|s| s.path.clone()).collect();
    assert!(outside.is_empty(), "{outside:#?}");
}

#[test]
fn printing_never_panics() {
    let macros = ["println!", "print!", "eprintln!", "eprint!", "dbg!"];
    let code = |s: &Source| s.code.split("#[cfg(test)]").next().unwrap_or_default().to_owned();
    let found: Vec<String> = sources()
        .iter()
        .filter(|s| !s.path.ends_with("tests.rs"))
        .flat_map(|s| macros.iter().filter(|m| code(s).contains(**m)).map(|m| format!("{}: {m}", s.path)))
        .collect();
    assert!(found.is_empty(), "these panic when their output is closed; see cli/output.rs: {found:#?}");
}

#[test]
fn anyhow_is_for_the_program_not_the_library() {
    none_outside(&["anyhow"], |s| ["", "cli", "ui"].contains(&s.folder.as_str()));
}

#[test]
fn nothing_is_unsafe() {
    none_outside(&["unsafe"], |_| false);
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("Cargo.toml");
    assert!(manifest.contains("unsafe_code = \"forbid\""));
}

#[test]
fn files_are_short_and_say_what_they_hold() {
    let mut wrong = Vec::new();
    for folder in ["src", "tests", "benches"] {
        for path in files_below(&root().join(folder), "rs") {
            let text = fs::read_to_string(&path).expect("a readable source file");
            let lines = text.lines().count();
            if lines > MOST_LINES {
                wrong.push(format!("{} has {lines} lines, at most {MOST_LINES}", path.display()));
            }
            let part_of_another = path.to_string_lossy().ends_with("tests.rs");
            if !text.starts_with("//!") && !part_of_another {
                wrong.push(format!(
                    "{} does not begin with a line `//!` that says what it holds",
                    path.display()
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The functions of `code` that are longer than [`LONGEST_FUNCTION`], with their lines.
fn long_functions(code: &str) -> Vec<(String, usize)> {
    let lines: Vec<&str> = code.lines().collect();
    let name = |line: &str| {
        let (before, after) = line.split_once("fn ")?;
        let is_head = before.split_whitespace().all(|word| {
            word.starts_with("pub")
                || word.ends_with("crate::ui)")
                || ["const", "async", "in"].contains(&word)
        });
        is_head.then(|| identifier(after)).flatten()
    };
    let mut long = Vec::new();
    for (first, line) in lines.iter().enumerate() {
        let Some(name) = name(line) else { continue };
        let inset = &line[..line.len() - line.trim_start().len()];
        let end = format!("{inset}}}");
        let length = lines[first..].iter().position(|line| *line == end).map_or(1, |last| last + 1);
        if length > LONGEST_FUNCTION {
            long.push((name, length));
        }
    }
    long
}

#[test]
fn functions_are_cut_by_meaning_before_they_are_long() {
    let body = "    x;\n".repeat(LONGEST_FUNCTION);
    assert_eq!(
        long_functions(&format!("pub(super) fn f() {{\n{body}}}\n")),
        [("f".to_owned(), LONGEST_FUNCTION + 2)]
    );
    assert_eq!(long_functions("fn f() {}\nfn g() {\n}\n"), []);
    let wrong: Vec<String> = sources()
        .iter()
        .filter(|s| !s.path.ends_with("tests.rs"))
        .flat_map(|s| {
            let code = s.code.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
            long_functions(code)
                .into_iter()
                .map(|(name, lines)| format!("{}: {name} has {lines} lines", s.path))
        })
        .collect();
    assert!(wrong.is_empty(), "at most {LONGEST_FUNCTION}: {wrong:#?}");
}

/// Names under the headings of `Cargo.toml` that end in "dependencies]".
fn dependencies() -> Vec<String> {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("Cargo.toml");
    let mut inside = false;
    let mut names = Vec::new();
    for line in manifest.lines() {
        if line.starts_with('[') {
            inside = line.ends_with("dependencies]");
        } else if inside && let Some((name, _)) = line.split_once('=') {
            names.push(name.trim().to_owned());
        }
    }
    names
}

#[test]
fn every_dependency_is_used() {
    let mut code = String::new();
    for folder in ["src", "tests", "benches"] {
        for path in files_below(&root().join(folder), "rs") {
            // Not this file: it names some.
            if !path.ends_with("tests/tidy") {
                code += &source(&path).code;
            }
        }
    }
    let names = dependencies();
    assert!(names.len() > 10, "{names:?}");
    let unused: Vec<&String> = names.iter().filter(|n| !has_word(&code, &n.replace('-', "_"))).collect();
    assert!(unused.is_empty(), "{unused:?}");
}

#[test]
fn the_code_is_formatted() {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo).args(["fmt", "--check"]).current_dir(root()).output();
    match output {
        Ok(output) if String::from_utf8_lossy(&output.stderr).contains("not installed") => {
            println!("rustfmt is not installed: formatting not checked");
        }
        Ok(output) => assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout)),
        Err(error) => println!("cargo fmt cannot run ({error}): formatting not checked"),
    }
}

/// A table of promises is worth what its tests are.
#[test]
fn every_test_that_a_promise_names_is_there() {
    let table = fs::read_to_string(root().join("src/trust/promises.rs")).expect("the table");
    let rows = table.lines().filter(|line| line.starts_with("//! | "));
    let named: BTreeSet<&str> = rows.flat_map(|row| row.split('`').skip(1).step_by(2)).collect();
    assert!(named.len() > 50, "{} tests are named", named.len());
    let paths = ["src", "tests"].map(|folder| files_below(&root().join(folder), "rs"));
    let code: Vec<String> =
        paths.concat().iter().map(|path| fs::read_to_string(path).expect("source")).collect();
    let is_there = |name: &&str| code.iter().any(|text| text.contains(&format!("fn {name}(")));
    let missing: Vec<&str> = named.into_iter().filter(|name| !is_there(name)).collect();
    assert!(missing.is_empty(), "{missing:#?}");
}

/// A thread that panicked leaves its locks poisoned: what waits for them must not panic, too.
#[test]
fn no_lock_is_expected_to_be_whole() {
    let is_wrong = |code: &str| {
        let flat: String = code.split_whitespace().collect();
        ["lock().unwrap()", "lock().expect(", "read().unwrap()", "write().unwrap()", "into_inner().unwrap()"]
            .iter()
            .any(|call| flat.contains(call))
    };
    let wrong: Vec<String> = sources().into_iter().filter(|s| is_wrong(&s.code)).map(|s| s.path).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}
