//! A table of texts: what each English text is in one other language.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use serde::Deserialize;

use crate::geometry::words::{Words, within_quotes, words};

/// The texts of one language.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// Code of the language as in a locale: "de", "pt_BR".
    pub code: String,
    /// Its own name for itself: "Deutsch".
    pub name: String,
    /// Sign between the whole part of a number and its decimals: a point or a comma.
    #[serde(default = "point")]
    pub decimal_sign: char,
    /// The text for each English text. `{name}` stands for a value in both.
    texts: BTreeMap<String, String>,
}

fn point() -> char {
    '.'
}

impl Table {
    /// The German table, which is built in.
    pub fn german() -> Option<&'static Self> {
        static GERMAN: OnceLock<Option<Table>> = OnceLock::new();
        let bytes = include_bytes!("../../assets/languages/de.json");
        GERMAN.get_or_init(|| Self::read(bytes).ok()).as_ref()
    }

    /// Reads a table of JSON.
    ///
    /// # Errors
    /// In words, without the name of the file: no JSON of this form, no code, no name, another decimal sign, or a text whose values
    /// are not those of its English one.
    pub fn read(bytes: &[u8]) -> Result<Self, Words> {
        let no_table = |e: serde_json::Error| words!("it is no table of texts: {why}", why = e.to_string());
        let table: Self = serde_json::from_slice(bytes).map_err(no_table)?;
        let is_code = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if table.code.is_empty() || !table.code.chars().all(is_code) {
            return Err(words!(
                "\"code\" is \"{code}\", which is no code of a language such as \"de\"",
                code = within_quotes(&table.code)
            ));
        }
        if table.name.trim().is_empty() {
            return Err(words!("\"name\" is empty"));
        }
        if !['.', ','].contains(&table.decimal_sign) {
            return Err(words!(
                "\"decimal_sign\" is \"{sign}\"; it must be \".\" or \",\"",
                sign = within_quotes(&table.decimal_sign.to_string())
            ));
        }
        let differs = table.texts.iter().find(|(english, text)| names(english) != names(text));
        match differs {
            Some((english, text)) => Err(words!(
                "the values in braces of \"{text}\" are not those of \"{english}\"",
                text = within_quotes(text),
                english = within_quotes(english)
            )),
            None => Ok(table),
        }
    }

    /// The text for `english`; None where there is none or it is empty.
    pub fn text(&self, english: &str) -> Option<&str> {
        self.texts.get(english).map(String::as_str).filter(|text| !text.is_empty())
    }
}

/// The names of the values in a text, sorted, each once.
fn names(text: &str) -> Vec<&str> {
    let inside = text.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0));
    let mut names: Vec<&str> = inside.collect();
    names.sort_unstable();
    names.dedup();
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    fn why(text: &str) -> Words {
        Table::read(text.as_bytes()).expect_err("no table")
    }

    #[test]
    fn tables_that_could_mislead_are_refused() {
        let whole =
            r#"{"code": "de", "name": "Deutsch", "texts": {"{a} of {b}": "{b}, davon {a}", "Undo": ""}}"#;
        let table = Table::read(whole.as_bytes()).expect("a table");
        assert_eq!((table.text("{a} of {b}"), table.text("Undo")), (Some("{b}, davon {a}"), None));
        assert_eq!(table.decimal_sign, '.', "a table need not say it");
        assert_eq!(Table::german().expect("it is built in").decimal_sign, ',');
        for wrong in ["-", ".,", ""] {
            let text = format!(r#"{{"code": "de", "name": "D", "decimal_sign": "{wrong}", "texts": {{}}}}"#);
            assert!(Table::read(text.as_bytes()).is_err(), "{wrong:?}");
        }
        assert!(
            why(r#"{"code": "de", "name": "D", "decimal_sign": "x", "texts": {}}"#).contains("decimal_sign")
        );
        assert!(why(r#"{"code": "de", "name": "D", "texts": {"{a} of": "{b}"}}"#).contains("in braces"));
        assert!(why(r#"{"code": "../de", "name": "D", "texts": {}}"#).contains("no code"));
        assert!(why(r#"{"code": "de", "name": " ", "texts": {}}"#).contains("empty"));
        assert!(why(r#"{"code": "de", "name": "D"}"#).contains("texts"));
        assert!(why(r#"{"code": "de""#).contains("EOF"));
    }
}
