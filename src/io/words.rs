//! Texts from files and libraries, made fit for people to read.

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

/// Whether `c` changes the writing direction: embeddings, overrides and isolates of Unicode Standard Annex 9.
fn is_turning(c: char) -> bool {
    matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Endings of file names in words: ".svg, .dxf or .json".
pub fn any_of<'e>(endings: impl IntoIterator<Item = &'e str>) -> String {
    let mut all: Vec<String> = endings.into_iter().map(|ending| format!(".{ending}")).collect();
    let last = all.pop().unwrap_or_default();
    if all.is_empty() { last } else { format!("{} or {last}", all.join(", ")) }
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
    }
}
