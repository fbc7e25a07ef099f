//! The language of the window and of the pages that people read. Their texts are English in the code; a table gives each in another
//! language.
//!
//! | a text | is written |
//! | --- | --- |
//! | as it is | `tr("Undo")` |
//! | with values in it | `say!("{count} of {total} pieces", count, total = all.len())` |
//! | of one or of many | `counted(n, "1 piece", "{n} pieces")` |
//! | in a table of constants | `tr(row.text)` where it is drawn |
//! | from another room: an error, a problem, a step | `words!("{name} has no edge {n}", name, n)` there, `said(&words)` where it is drawn |
//! | a number | `number(12.5, 1)`, which has the decimal sign of the language |
//!
//! Tables are files like `assets/languages/de.json`. A text that a table lacks is shown in English. What programs read stays English,
//! with a decimal point: files, recordings, and what the command line prints.

mod numbers;
mod said;
mod table;

use std::cell::Cell;
use std::fmt::Display;

use crate::geometry::words;

pub use numbers::{decimal_sign, localised, number, parsed, short, signed, unbroken};
pub use said::said;
pub use table::Table;

thread_local! {
    /// The table of the texts on this thread; None for English.
    static SHOWN: Cell<Option<&'static Table>> = const { Cell::new(None) };
}

/// Shows the texts of `table` on this thread from now on; None shows English.
pub fn show(table: Option<&'static Table>) {
    SHOWN.set(table);
}

/// The table that is shown on this thread; None for English.
pub fn shown() -> Option<&'static Table> {
    SHOWN.get()
}

/// What `work` returns while the texts of `table` are shown on this thread.
pub fn shown_in<T>(table: Option<&'static Table>, work: impl FnOnce() -> T) -> T {
    let before = SHOWN.replace(table);
    let result = work();
    SHOWN.set(before);
    result
}

/// Code of the language that is shown on this thread: "en", "de".
pub fn code() -> &'static str {
    shown().map_or("en", |table| &table.code)
}

/// `english` in the language of the window, where its table has it.
pub fn tr(english: &str) -> &str {
    translated(english).unwrap_or(english)
}

/// `english` in the language of the window; None if that is English or the table lacks it.
pub fn translated(english: &str) -> Option<&'static str> {
    SHOWN.get()?.text(english)
}

/// `one` where `n` is 1, else `many` with `n` in place of `{n}`.
pub fn counted(n: usize, one: &str, many: &str) -> String {
    if n == 1 { tr(one).to_owned() } else { filled(tr(many), &[("n", &n)]) }
}

/// `template` with each `{name}` replaced by the value of that name.
pub fn filled(template: &str, values: &[(&str, &dyn Display)]) -> String {
    let value = |name: &str| Some(values.iter().find(|(known, _)| *known == name)?.1.to_string());
    words::filled(template, value)
}

/// A text with values in the language of the window: `say!("{count} of {total} pieces", count, total = 7)`. Every `{name}` is
/// given after the text, by its name alone or with a value; values are written beforehand where they need a format.
macro_rules! say {
    ($english:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        match $crate::language::translated($english) {
            None => format!($english $(, $name = say!(@value $name $($value)?))*),
            Some(text) => $crate::language::filled(
                text,
                &[$((stringify!($name), &say!(@value $name $($value)?) as &dyn std::fmt::Display)),*],
            ),
        }
    };
    (@value $name:ident) => { $name };
    (@value $name:ident $value:expr) => { $value };
}
pub(crate) use say;

#[cfg(test)]
mod tests {
    use super::*;

    fn german(texts: &str) -> &'static Table {
        let text = format!("{{\"code\": \"xx\", \"name\": \"Test\", \"texts\": {texts}}}");
        Box::leak(Box::new(Table::read(text.as_bytes()).expect("a table")))
    }

    #[test]
    fn what_the_table_has_is_shown_and_the_rest_is_english() {
        assert_eq!((tr("Undo"), say!("{n} pins", n = 3)), ("Undo", "3 pins".to_owned()));
        show(Some(german(r#"{"Undo": "Zurück", "{n} pins": "Nadeln: {n} {", "1 pin": "eine"}"#)));
        assert_eq!((tr("Undo"), tr("Redo")), ("Zurück", "Redo"));
        let n = 3;
        assert_eq!(say!("{n} pins", n), "Nadeln: 3 {");
        assert_eq!(say!("{a} and {b}", a = 1, b = "{a}"), "1 and {a}", "values are not filled in again");
        assert_eq!(counted(1, "1 pin", "{n} pins"), "eine");
        assert_eq!(counted(2, "1 pin", "{n} pins"), "Nadeln: 2 {");
        show(None);
        assert_eq!(tr("Undo"), "Undo");
    }
}
