//! Every text of the window is in the table of every language that is built in.

use std::collections::{BTreeMap, BTreeSet};

use crate::{Source, root, sources};

/// A string literal: its text, the code before it back to the last `;`, `{` or `}`, and the code after it.
struct Literal<'a> {
    text: String,
    before: &'a str,
    after: &'a str,
}

/// The string literals of code without comments.
fn literals(code: &str) -> Vec<Literal<'_>> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(quote) = code[at..].find(['"', '\'']).map(|i| at + i) {
        if code[quote..].starts_with('\'') {
            // A character, or a lifetime.
            let rest = &code[quote + 1..];
            let end = if rest.starts_with('\\') { rest[2..].find('\'').map(|i| i + 3) } else { None };
            let plain = || {
                rest.chars()
                    .next()
                    .filter(|c| rest[c.len_utf8()..].starts_with('\''))
                    .map(|c| c.len_utf8() + 1)
            };
            at = quote + 1 + end.or_else(plain).unwrap_or(0);
            continue;
        }
        let hashes = code[..quote].chars().rev().take_while(|c| *c == '#').count();
        let is_raw = code[..quote - hashes].ends_with('r');
        let (text, end) = if is_raw {
            let close = format!("\"{}", "#".repeat(hashes));
            let end = code[quote + 1..].find(&close).map_or(code.len(), |i| quote + 1 + i);
            (code[quote + 1..end].to_owned(), (end + close.len()).min(code.len()))
        } else {
            unescaped(&code[quote + 1..])
                .map_or((String::new(), code.len()), |(text, n)| (text, quote + 1 + n))
        };
        let start = code[..quote].rfind([';', '{', '}']).map_or(0, |i| i + 1);
        found.push(Literal { text, before: &code[start..quote], after: &code[end..] });
        at = end;
    }
    found
}

/// The text of a literal whose code begins after its first quote, and the length of that code with the last quote.
fn unescaped(code: &str) -> Option<(String, usize)> {
    let mut text = String::new();
    let mut chars = code.char_indices();
    while let Some((i, c)) = chars.next() {
        match c {
            '"' => return Some((text, i + 1)),
            '\\' => match chars.next()?.1 {
                'n' => text.push('\n'),
                't' => text.push('\t'),
                '\n' => {
                    let rest = chars.as_str();
                    let kept = rest.trim_start();
                    chars = code[code.len() - kept.len()..].char_indices();
                    let (tail, n) = unescaped(chars.as_str())?;
                    return Some((text + &tail, code.len() - kept.len() + n));
                }
                'u' => {
                    let rest = chars.as_str();
                    let (digits, _) = rest.strip_prefix('{')?.split_once('}')?;
                    text.extend(u32::from_str_radix(digits, 16).ok().and_then(char::from_u32));
                    chars.nth(digits.len() + 1);
                }
                other => text.push(other),
            },
            _ => text.push(c),
        }
    }
    None
}

/// What is shown in the language of the window: its code, and that of the tech pack.
fn code_of_window() -> Vec<Source> {
    let mut sources = sources();
    sources.retain(|s| ["ui", "pack"].contains(&s.folder.as_str()));
    for source in &mut sources {
        let end = source.code.find("#[cfg(test)]\nmod").unwrap_or(source.code.len());
        source.code.truncate(end);
    }
    sources
}

/// Whether `before` ends in a call of one of the functions that translate: the literal is its text.
fn is_translated(before: &str) -> bool {
    let call = before.trim_end();
    let ends = |name: &str| {
        call.strip_suffix(name).is_some_and(|rest| !rest.ends_with(|c: char| c.is_alphanumeric() || c == '_'))
    };
    ["tr(", "translated(", "say!("].iter().any(|name| ends(name)) || is_counted(before)
}

/// Whether the literal is the second or third argument of `counted`.
fn is_counted(before: &str) -> bool {
    let Some((_, arguments)) = before.rsplit_once("counted(") else { return false };
    let mut depth = 0;
    for c in arguments.chars() {
        depth += match c {
            '(' | '[' => 1,
            ')' | ']' => -1,
            _ => 0,
        };
        if depth < 0 {
            return false;
        }
    }
    depth == 0 && arguments.trim_end().ends_with(',')
}

/// The names given after the text of `say!`, from the code after it.
fn given(after: &str) -> BTreeSet<String> {
    let (mut depth, mut parts) = (0, vec![String::new()]);
    for c in after.chars() {
        depth += match c {
            '(' | '[' | '{' => 1,
            ')' | ']' | '}' => -1,
            _ => 0,
        };
        match c {
            _ if depth < 0 => break,
            ',' if depth == 0 => parts.push(String::new()),
            _ => parts.last_mut().expect("there is one").push(c),
        }
    }
    let name = |part: &String| part.split('=').next().unwrap_or_default().trim().to_owned();
    parts.iter().map(name).filter(|name| !name.is_empty()).collect()
}

fn names(text: &str) -> BTreeSet<String> {
    text.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0.to_owned())).collect()
}

fn german() -> BTreeMap<String, String> {
    let text = std::fs::read_to_string(root().join("assets/languages/de.json")).expect("read");
    let table: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    serde_json::from_value(table["texts"].clone()).expect("a table of texts")
}

#[test]
fn literals_and_their_calls_are_seen() {
    let code = "tr(\"a \\\n    b\"); say!(\"{x} \\\"q\\\"\", x = f(1, 2), y); counted(a(1), \"1 p\", \"{n} p\"); let c = '\"'; r#\"r\"#; fn f<'a>(x: &'a str) { g(\"\\u{e9}\") }";
    let found = literals(code);
    let texts: Vec<&str> = found.iter().map(|l| l.text.as_str()).collect();
    assert_eq!(texts, ["a b", "{x} \"q\"", "1 p", "{n} p", "r", "é"]);
    let translated: Vec<bool> = found.iter().map(|l| is_translated(l.before)).collect();
    assert_eq!(translated, [true, true, true, true, false, false]);
    assert_eq!(given(found[1].after), ["x", "y"].map(str::to_owned).into());
}

/// Sentences that stay English: titles in tables that are copied as text.
const ENGLISH: [&str; 1] = ["Difference of {}"];

/// Whether `text` reads like a sentence, or the beginning of one, that somebody sees.
fn is_sentence(text: &str) -> bool {
    let mut words = text.split(' ');
    let begins = |word: &str, is: fn(&char) -> bool| word.chars().next().as_ref().is_some_and(is);
    let first = words.next().is_some_and(|word| {
        word.len() > 1
            && begins(word, char::is_ascii_uppercase)
            && word[1..].chars().all(|c| c.is_ascii_lowercase())
    });
    first && words.next().is_some_and(|word| begins(word, char::is_ascii_lowercase))
}

/// Sentences in tables of constants are translated where they are drawn; one that is not in the table was forgotten.
#[test]
fn every_sentence_in_the_code_of_the_window_is_in_german() {
    let german = german();
    let mut wrong = Vec::new();
    for source in code_of_window().iter() {
        let texts = literals(&source.code).into_iter().map(|literal| literal.text);
        let lacks = |text: &String| {
            is_sentence(text) && !german.contains_key(text) && !ENGLISH.contains(&text.as_str())
        };
        wrong.extend(texts.filter(lacks).map(|text| format!("{}: {text:?}", source.path)));
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn every_text_of_the_window_is_in_german() {
    let german = german();
    let mut wrong = Vec::new();
    for source in code_of_window() {
        for literal in literals(&source.code).iter().filter(|l| is_translated(l.before)) {
            let text = &literal.text;
            if german.get(text).is_none_or(String::is_empty) {
                wrong.push(format!("{}: not in German: {text:?}", source.path));
            }
            if literal.before.trim_end().ends_with("say!(") && names(text) != given(literal.after) {
                wrong.push(format!("{}: other values than those given: {text:?}", source.path));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The code of all rooms without their tests.
fn code_of_rooms() -> Vec<Source> {
    let mut sources = sources();
    sources.retain(|s| !s.path.ends_with("tests.rs") && !s.path.ends_with("reasons.rs"));
    for source in &mut sources {
        let end = source.code.find("#[cfg(test)]\nmod tests {").unwrap_or(source.code.len());
        source.code.truncate(end);
    }
    sources
}

/// Reasons, problems and steps come from rooms that know no language, as a text and its values.
#[test]
fn every_text_of_words_is_in_german() {
    let german = german();
    let (mut wrong, mut count) = (Vec::new(), 0);
    for source in code_of_rooms() {
        for literal in literals(&source.code).iter().filter(|l| l.before.trim_end().ends_with("words!(")) {
            let text = &literal.text;
            count += 1;
            if german.get(text).is_none_or(String::is_empty) {
                wrong.push(format!("{}: not in German: {text:?}", source.path));
            }
            if names(text) != given(literal.after) {
                wrong.push(format!("{}: other values than those given: {text:?}", source.path));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(count > 300, "{count} texts");
}

/// Numbers are shown and typed with the decimal sign of the language, through the helpers of `language`.
#[test]
fn no_number_of_the_window_has_a_decimal_point_of_its_own() {
    // Drawings in SVG; a table that is copied as text.
    let plain = ["src/ui/fit_page/drawing.rs", "src/ui/fit_page/legend.rs", "src/ui/maps/table.rs"];
    let mut wrong = Vec::new();
    for source in
        code_of_window().iter().filter(|s| s.folder == "ui" && !s.path.starts_with("src/ui/language"))
    {
        wrong.extend(
            ["DragValue::new", "Slider::new"]
                .iter()
                .filter(|call| source.code.contains(**call))
                .map(|call| format!("{}: {call}", source.path)),
        );
        if !plain.contains(&source.path.as_str()) {
            let texts = literals(&source.code).into_iter().map(|literal| literal.text);
            wrong.extend(
                texts.filter(|text| has_decimals(text)).map(|text| format!("{}: {text:?}", source.path)),
            );
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Whether `text` is a format with decimals: "{:.1}", "{x:+.digits$}".
fn has_decimals(text: &str) -> bool {
    let formats = text.split('{').skip(1).filter_map(|rest| rest.split_once('}')?.0.split_once(':'));
    formats.map(|(_, format)| format).any(|format| {
        format.split_once('.').is_some_and(|(_, digits)| !digits.is_empty() && !digits.starts_with('0'))
    })
}

#[test]
fn formats_with_decimals_are_seen() {
    assert_eq!(["{:.1}", "{x:+.2} %", "{v:.digits$}", "{:.*}"].map(has_decimals), [true; 4]);
    assert_eq!(["{x:.0}", "{x}. {y}", "{x:?}", "{:02x}", "a:.5"].map(has_decimals), [false; 5]);
}

/// Whether `text` is put together from literals or read from a file: places on the body are named word by word, joints by side,
/// fabrics in a file, and maps also in small letters.
fn is_put_together(
    text: &str,
    literals: &BTreeSet<String>,
    words_of_places: &BTreeSet<String>,
    fabrics: &str,
) -> bool {
    let is_joint = || {
        let joint = text.strip_prefix("Left ").or_else(|| text.strip_prefix("Right "));
        joint.is_some_and(|joint| literals.contains(joint))
    };
    text.split(' ').all(|word| words_of_places.contains(word))
        || is_joint()
        || fabrics.contains(&format!("\"name\": \"{text}\""))
        || literals.iter().any(|literal| literal.to_lowercase() == text)
}

#[test]
fn no_table_has_texts_that_the_program_lacks() {
    let all = |may: fn(&Source) -> bool| -> BTreeSet<String> {
        let sources = sources();
        let code = sources.iter().filter(|s| may(s));
        code.flat_map(|s| literals(&s.code).into_iter().map(|l| l.text).collect::<Vec<_>>()).collect()
    };
    let known = all(|_| true);
    let places = all(|s| ["body", "place"].contains(&s.folder.as_str()));
    let words = places.iter().flat_map(|text| text.split([' ', '_'])).map(str::to_owned).collect();
    let fabrics = std::fs::read_to_string(root().join("assets/fabrics/presets.json")).expect("read");
    let is_known = |text: &String| known.contains(text) || is_put_together(text, &known, &words, &fabrics);
    let unknown: Vec<String> = german().into_keys().filter(|text| !is_known(text)).collect();
    assert!(unknown.is_empty(), "{unknown:#?}");
}
