//! Words of other rooms in the language that is shown.

use crate::geometry::words::{Part, Value, Words, filled};
use crate::language::{localised, shown, tr};

/// `words` in the language that is shown. A text that the table lacks stays English, with its values in that language.
pub fn said(words: &Words) -> String {
    if shown().is_none() {
        return words.as_str().to_owned();
    }
    words.parts().iter().map(part).collect()
}

fn part(part: &Part) -> String {
    let (text, values) = match part {
        Part::Plain(text) => return text.clone(),
        Part::Text(text, values) => (tr(text), values),
    };
    filled(text, |name| Some(value(&values.iter().find(|(known, _)| *known == name)?.1)))
}

fn value(value: &Value) -> String {
    match value {
        Value::Plain(text) => text.clone(),
        Value::Number(number) => localised(number),
        Value::Words(words) => said(words),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::ids::SeamId;
    use crate::geometry::words::{decimal, words};
    use crate::language::{Table, shown_in};

    #[test]
    fn words_are_said_in_the_language_that_is_shown() {
        let there = words!("there is no {what}", what = SeamId(3));
        let lengths = words!("open by {mm} mm", mm = decimal(2.5, 1));
        let words =
            there.and(": ", Words::plain("v1.5")).and("; ", lengths).and("; ", Words::listed("waist"));
        assert_eq!(said(&words), "there is no seam 3: v1.5; open by 2.5 mm; waist");
        let german = shown_in(Table::german(), || said(&words));
        assert_eq!(german, "Naht 3 gibt es nicht: v1.5; 2,5 mm offen; Taille");
    }

    #[test]
    fn a_text_that_the_table_lacks_has_its_values_in_the_language() {
        let words = Words::of("{cm} cm of something new", vec![("cm", decimal(2.5, 1))]);
        assert_eq!(shown_in(Table::german(), || said(&words)), "2,5 cm of something new");
    }
}
