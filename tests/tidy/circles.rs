//! Files use each other one way: no file is reached again from what it uses.
//!
//! A file may use the one that declares it (`mod.rs` of its folder, and those above): there the types are that it adds to.

use std::collections::{BTreeMap, BTreeSet};

use super::{Source, sources};

/// A module by the names that lead to it from the crate.
type Module = Vec<String>;

/// "src/sim/world/mod.rs" → sim, world.
fn module_of(path: &str) -> Module {
    let inside = path.trim_start_matches("src/").trim_end_matches(".rs");
    let mut names: Module = inside.split('/').map(str::to_owned).collect();
    if names.last().is_some_and(|name| ["mod", "lib", "main"].contains(&name.as_str())) {
        names.pop();
    }
    names
}

/// The code that is not for tests.
pub(super) fn without_tests(code: &str) -> String {
    let mut kept = String::new();
    let mut rest = code;
    while let Some(at) = rest.find("#[cfg(test)]") {
        kept += &rest[..at];
        let after = &rest[at + "#[cfg(test)]".len()..];
        let is_declaration = after.find([';', '{']).is_some_and(|end| after[end..].starts_with(';'));
        if !is_declaration {
            return kept;
        }
        rest = &after[after.find(';').unwrap_or(0)..];
    }
    kept + rest
}

/// All paths that a path with groups stands for: `a::{b, c::D}` → a::b, a::c::D. Also where it ends.
fn paths(text: &str) -> (Vec<Module>, usize) {
    let name = text.find(|c: char| !c.is_alphanumeric() && c != '_' && c != '*').unwrap_or(text.len());
    let head = text[..name].to_owned();
    let Some(rest) = text[name..].strip_prefix("::") else { return (vec![vec![head]], name) };
    let mut end = name + 2;
    let mut tails = Vec::new();
    if let Some(group) = rest.strip_prefix('{') {
        end += 1;
        let mut at = 0;
        loop {
            at += group[at..].find(|c: char| !c.is_whitespace() && c != ',').unwrap_or(group.len() - at);
            if at >= group.len() || group[at..].starts_with('}') {
                break;
            }
            let (inner, length) = paths(&group[at..]);
            tails.extend(inner);
            at += length.max(1);
            // "as OTHER"
            if let Some(other) = group[at..].strip_prefix(" as ") {
                at += 4 + other.find([',', '}']).unwrap_or(other.len());
            }
        }
        end += at + 1;
    } else {
        let (inner, length) = paths(rest);
        tails = inner;
        end += length;
    }
    let whole = |tail: Module| std::iter::once(head.clone()).chain(tail).collect();
    (tails.into_iter().map(whole).collect(), end)
}

/// Paths in `code` that begin with one of `heads`.
fn paths_from(code: &str, heads: &[&str]) -> Vec<Module> {
    let mut found = Vec::new();
    for head in heads {
        for (at, _) in code.match_indices(&format!("{head}::")) {
            if !code[..at].ends_with(|c: char| c.is_alphanumeric() || "_:$".contains(c)) {
                found.extend(paths(&code[at..]).0);
            }
        }
    }
    found
}

struct House {
    files: BTreeMap<Module, String>,
    /// Of each module the names it hands on, and the paths they stand for.
    handed_on: BTreeMap<Module, BTreeMap<String, Module>>,
}

impl House {
    fn new(sources: &[(Module, String)]) -> Self {
        let files: BTreeMap<Module, String> = sources.iter().cloned().collect();
        let of = |code: &String| {
            let mut names = BTreeMap::new();
            for (at, _) in code.match_indices("pub use ") {
                for path in paths(&code[at + "pub use ".len()..]).0 {
                    names.extend(path.last().cloned().map(|name| (name, path)));
                }
            }
            names
        };
        let handed_on = files.iter().map(|(module, code)| (module.clone(), of(code))).collect();
        Self { files, handed_on }
    }

    /// The file in which what `path` names is written, as `from` sees it.
    fn written_in(&self, from: &[String], path: &[String], depth: usize) -> Option<Module> {
        let mut whole = match path.first()?.as_str() {
            "crate" => Module::new(),
            _ => from.to_vec(),
        };
        for name in path {
            match name.as_str() {
                "crate" | "self" => {}
                "super" => drop(whole.pop()),
                _ => whole.push(name.clone()),
            }
        }
        let known = (1..=whole.len()).rev().find(|&n| self.files.contains_key(&whole[..n]))?;
        let (module, rest) = whole.split_at(known);
        let next = rest.first().and_then(|name| self.handed_on[module].get(name)).filter(|_| depth < 8);
        next.and_then(|next| self.written_in(module, next, depth + 1)).or_else(|| Some(module.to_vec()))
    }

    /// The files that each uses, but for those that declare it.
    fn uses(&self) -> BTreeMap<&Module, BTreeSet<Module>> {
        let of = |module: &Module, code: &str| {
            let used = paths_from(code, &["crate", "super", "self"]);
            let files = used.iter().filter_map(|path| self.written_in(module, path, 0));
            // What a folder hands on it uses, too.
            let handed_on =
                self.handed_on[module].values().filter_map(|path| self.written_in(module, path, 0));
            files.chain(handed_on).filter(|file| !module.starts_with(file)).collect()
        };
        self.files.iter().map(|(module, code)| (module, of(module, code))).collect()
    }
}

/// For every file that is reached from itself: its name, and what it uses of those.
fn circles(sources: &[(Module, String)]) -> Vec<String> {
    let house = House::new(sources);
    let uses = house.uses();
    let reached = |from: &Module| {
        let (mut seen, mut left) = (BTreeSet::new(), vec![from]);
        while let Some(file) = left.pop() {
            left.extend(uses.get(file).into_iter().flatten().filter(|next| seen.insert((*next).clone())));
        }
        seen
    };
    let all: BTreeMap<&Module, BTreeSet<Module>> = uses.keys().map(|&file| (file, reached(file))).collect();
    let turning = all.iter().filter(|(file, seen)| seen.contains(**file));
    turning
        .map(|(file, _)| {
            let back = |next: &&Module| all.get(next).is_some_and(|seen| seen.contains(*file));
            let next: Vec<String> = uses[*file].iter().filter(back).map(|file| file.join("::")).collect();
            format!("{} → {}", file.join("::"), next.join(", "))
        })
        .collect()
}

#[test]
fn a_circle_of_files_is_seen() {
    let file = |path: &str, code: &str| (module_of(path), without_tests(code));
    let straight = [
        file("src/a/mod.rs", "mod b;\npub use b::{B, c::C as D};\nmod e;"),
        file("src/a/b.rs", "use super::e::E;\nuse crate::a::Above;"),
        file(
            "src/a/e.rs",
            "#[cfg(test)]\nmod tests;\nfn f() {}\n#[cfg(test)]\nmod more { use crate::a::B; }",
        ),
    ];
    assert_eq!(circles(&straight), Vec::<String>::new());
    let mut round = straight.to_vec();
    round[2].1 += "use crate::{other::F, a::{B as X}};";
    assert_eq!(circles(&round), ["a::b → a::e", "a::e → a::b"]);
}

#[test]
fn files_use_each_other_one_way() {
    let is_code = |s: &&Source| !s.path.ends_with("tests.rs");
    let files: Vec<(Module, String)> = sources()
        .iter()
        .filter(is_code)
        .map(|s| (module_of(&s.path), without_tests(&s.code)))
        .filter(|(module, _)| !module.is_empty())
        .collect();
    assert!(files.len() > 300, "{} files", files.len());
    let found = circles(&files);
    assert!(found.is_empty(), "{found:#?}");
}
