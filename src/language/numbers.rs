//! Numbers as people read and type them in the language that is shown.

use crate::language::shown;

/// The decimal sign of the language: a point or a comma.
pub fn decimal_sign() -> char {
    shown().map_or('.', |table| table.decimal_sign)
}

/// `value` with `digits` digits after the decimal sign.
pub fn number(value: f64, digits: usize) -> String {
    localised(&format!("{value:.digits$}"))
}

/// `value` with at most `digits` digits after the decimal sign, of which zeros at the end are left out; a value rounded to zero has
/// no sign.
pub fn short(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let text = if digits > 0 { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { localised(text) }
}

/// `value` with its sign and `digits` digits; a value rounded to zero has no sign.
pub fn signed(value: f64, digits: usize) -> String {
    let text = format!("{value:+.digits$}");
    let is_nothing = text[1..].chars().all(|c| c == '0' || c == '.');
    localised(if is_nothing { &text[1..] } else { &text })
}

/// A number that is written with a decimal point, with the decimal sign of the language instead.
pub fn localised(number: &str) -> String {
    match decimal_sign() {
        '.' => number.to_owned(),
        sign => number.replacen('.', sign.encode_utf8(&mut [0; 4]), 1),
    }
}

/// Units that stay on the line of their number.
const UNITS: [&str; 14] = ["%", "mm", "cm", "dm", "m", "in", "mm²", "cm²", "dm²", "m²", "s", "ms", "N", "°"];

/// `text` with no-break spaces between numbers and units, for texts that are drawn in lines of any width.
pub fn unbroken(text: &str) -> String {
    let mut unbroken = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once(' ') {
        let ends = |c: char| c.is_whitespace() || ",;:.()".contains(c);
        let word = after.split(ends).next().unwrap_or_default();
        let is_value = before.ends_with(|c: char| c.is_ascii_digit()) && UNITS.contains(&word);
        unbroken.push_str(before);
        unbroken.push(if is_value { '\u{a0}' } else { ' ' });
        rest = after;
    }
    unbroken.push_str(rest);
    unbroken
}

/// Parses a number with a decimal point or a decimal comma, whatever the language; spaces are left out. None if it is no finite
/// number, which one with two such signs is not.
pub fn parsed(text: &str) -> Option<f64> {
    let plain = |c: char| match c {
        ',' => '.',
        '\u{2212}' => '-',
        c => c,
    };
    let text: String = text.chars().filter(|c| !c.is_whitespace()).map(plain).collect();
    text.parse().ok().filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Table, shown_in};

    #[test]
    fn the_decimal_sign_is_that_of_the_language() {
        let all =
            || [number(12.25, 1), number(-3.0, 0), signed(0.26, 1), signed(-0.04, 1), localised("0.125")];
        assert_eq!(all(), ["12.2", "-3", "+0.3", "0.0", "0.125"]);
        assert_eq!(shown_in(Table::german(), all), ["12,2", "-3", "+0,3", "0,0", "0,125"]);
        assert_eq!(decimal_sign(), '.', "shown for that long only");
    }

    #[test]
    fn zeros_at_the_end_are_left_out() {
        let all = || [short(12.5, 3), short(100.0, 0), short(100.0, 2), short(-0.001, 2), short(0.125, 3)];
        assert_eq!(all(), ["12.5", "100", "100", "0", "0.125"]);
        assert_eq!(shown_in(Table::german(), all), ["12,5", "100", "100", "0", "0,125"]);
    }

    #[test]
    fn numbers_stay_on_the_line_of_their_units() {
        let check = |text: &str, told: &str| {
            assert_eq!(unbroken(&text.replace('_', " ")), told.replace('_', "\u{a0}"))
        };
        check("Tight: front near waist, +3.6_%", "Tight: front near waist, +3.6_%");
        check("1 (+3,4_%), 12_mm. Then 3 mmm and 2 pieces", "1 (+3,4_%), 12_mm. Then 3 mmm and 2 pieces");
        check(" 5  %", " 5  %");
        check("", "");
    }

    #[test]
    fn both_signs_are_read_in_every_language() {
        for table in [None, Table::german()] {
            shown_in(table, || {
                for text in ["12.5", "12,5", " 12,5 ", "+12.50", "1 2,5"] {
                    assert_eq!(parsed(text), Some(12.5), "{text}");
                }
                assert_eq!([parsed("\u{2212}3"), parsed("4,")], [Some(-3.0), Some(4.0)]);
                for text in ["", "1.234,5", "1,2,3", "inf", "NaN", "five"] {
                    assert_eq!(parsed(text), None, "{text}");
                }
            });
        }
    }
}
