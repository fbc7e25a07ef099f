//! Texts from files and libraries, made fit for people to read.

use crate::geometry::words::{Words, words};

/// Number of characters kept at the beginning (where the position usually is) and at the end of a text that is too long.
const KEPT: usize = 300;

/// `words` without characters that could mislead a reader: control characters and those that change the writing direction are
/// escaped, and the middle of a long text is left out.
pub fn readable(words: &str) -> String {
    let shown = |c: char| match c {
        '\n' => c.to_string(),
        _ if c.is_control() || is_turning(c) => c.escape_unicode().to_string(),
        _ => c.to_string(),
    };
    let count = words.chars().count();
    if count <= 2 * KEPT {
        return words.chars().map(shown).collect();
    }
    let first: String = words.chars().take(KEPT).map(shown).collect();
    let last: String = words.chars().skip(count - KEPT).map(shown).collect();
    format!("{first} [and {} more characters] {last}", count - 2 * KEPT)
}

/// `words` where they are [`readable`] as they stand; else what is readable of them, in English.
pub fn readable_words(words: Words) -> Words {
    let shown = readable(&words);
    if words == shown { words } else { Words::plain(shown) }
}

/// A line of a file, by its number from 1.
pub fn line(number: usize) -> Words {
    words!("line {number}", number)
}

/// Whether `c` changes the writing direction: embeddings, overrides and isolates of Unicode Standard Annex 9.
fn is_turning(c: char) -> bool {
    matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Endings of file names in words: ".svg, .dxf or .json".
pub fn any_of<'e>(endings: impl IntoIterator<Item = &'e str>) -> Words {
    let mut all: Vec<String> = endings.into_iter().map(|ending| format!(".{ending}")).collect();
    let last = all.pop().unwrap_or_default();
    if all.is_empty() { Words::plain(last) } else { words!("{all} or {last}", all = all.join(", "), last) }
}

/// A CSV field in quotes (RFC 4180); quotes in it are doubled.
pub fn quoted(words: &str) -> String {
    format!("\"{}\"", words.replace('"', "\"\""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stay_as_they_are_unless_they_cannot_be_read() {
        assert_eq!(readable("Ärmel \"\u{4e2d}\"\n2"), "Ärmel \"\u{4e2d}\"\n2");
        assert_eq!(readable("a\u{202e}b\u{7}\r"), "a\\u{202e}b\\u{7}\\u{d}");
        let long = readable(&format!("line 3: {}", "x".repeat(100_000)));
        assert!(long.starts_with("line 3: xx") && long.chars().count() < 700, "{long}");
        assert_eq!(readable_words(line(3)).parts().len(), line(3).parts().len());
        assert_eq!(readable_words(Words::plain("a\u{7}")), "a\\u{7}");
    }
}
