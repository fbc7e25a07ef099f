//! Numbers and names as they are written on the pages.

use crate::io::words::readable;
use crate::session::Print;

/// Most characters of a name; the middle of a longer one is left out.
const LONGEST_NAME: usize = 120;
/// The entry where there is no value.
pub const NONE: &str = "–";

/// A length in centimetres, to a millimetre.
pub fn cm(metres: f64) -> String {
    minus(format!("{:.1}", metres * 100.0))
}

/// A length in centimetres with its sign, to a millimetre.
pub fn signed_cm(metres: f64) -> String {
    minus(format!("{:+.1}", metres * 100.0))
}

/// With a minus sign in place of the hyphen, and none before zero.
fn minus(number: String) -> String {
    if number.trim_start_matches(['-', '+']).chars().all(|c| c == '0' || c == '.') {
        return number.trim_start_matches(['-', '+']).to_owned();
    }
    number.replace('-', "−")
}

/// "1 piece", "2 pieces".
pub fn count(n: usize, one: &str) -> String {
    format!("{n} {one}{}", if n == 1 { "" } else { "s" })
}

/// A sentence in one line, without characters that could mislead a reader.
pub fn line(words: &str) -> String {
    readable(words).replace('\n', " ").trim().to_owned()
}

/// A name in one line, without characters that could mislead a reader, and not too long.
pub fn name(words: &str) -> String {
    let plain = line(words);
    if plain.is_empty() {
        return "(no name)".to_owned();
    }
    let count = plain.chars().count();
    if count <= LONGEST_NAME {
        return plain;
    }
    let half = LONGEST_NAME / 2;
    let start: String = plain.chars().take(half).collect();
    let end: String = plain.chars().skip(count - half).collect();
    format!("{start}…{end}")
}

/// A colour as it is written in drawing programs: "#1f5fbf".
pub fn colour([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A print with its repeat and colour.
pub fn print(print: Print) -> String {
    format!("{} every {:.1} cm, {}", print.motif.name(), print.repeat_m * 100.0, colour(print.colour))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_names_are_written_for_people() {
        assert_eq!([cm(-0.1234), cm(-0.0001), signed_cm(0.02)], ["−12.3", "0.0", "+2.0"]);
        assert_eq!(
            [signed_cm(-0.0001), count(1, "piece"), count(0, "piece")],
            ["0.0", "1 piece", "0 pieces"]
        );
        assert_eq!(name(" a\nb "), "a b");
        assert_eq!(name("a\u{202e}b"), "a\\u{202e}b");
        assert_eq!(name(""), "(no name)");
        assert_eq!(name(&"å".repeat(1000)).chars().count(), LONGEST_NAME + 1);
    }
}
