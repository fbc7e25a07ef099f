//! Words for a person that travel as a text of the program and its values, so that they can be said in any language where they
//! are shown.
//!
//! `words!("hole {k} lies outside its outline; move it back", k)` makes them: every `{name}` is given after the text, by its name
//! alone or with a value. As a string they are English; `language::said` says them in the language of the window.

use std::borrow::Cow;
use std::fmt;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::geometry::ids::{ButtonId, GraphicId, ImageId, MarkId, PieceId, PinId, SeamId};

/// Words for a person. They read as English, and are compared and written as such; what was read from a file has no other language.
#[derive(Clone, Default)]
pub struct Words {
    english: String,
    parts: Vec<Part>,
}

/// One of several texts that follow each other.
#[derive(Clone, Debug)]
pub enum Part {
    /// A text that tables of languages have, with the values of its `{name}`s.
    Text(Cow<'static, str>, Vec<(&'static str, Value)>),
    /// The same in every language: a name, a sign between two texts, or what the system or a library says.
    Plain(String),
}

/// A value in a text.
#[derive(Clone, Debug)]
pub enum Value {
    /// The same in every language: a name or a whole number.
    Plain(String),
    /// A number as it is written in English, with a decimal point.
    Number(String),
    /// Words of their own.
    Words(Words),
}

impl Value {
    /// It in English.
    pub fn english(&self) -> &str {
        match self {
            Self::Plain(text) | Self::Number(text) => text,
            Self::Words(words) => words,
        }
    }
}

impl Words {
    /// `text` with `values` in place of its `{name}`s. `words!` makes them from a literal, which is then known to be in the tables.
    pub fn of(text: &'static str, values: Vec<(&'static str, Value)>) -> Self {
        let value = |name: &str| Some(values.iter().find(|(known, _)| *known == name)?.1.english());
        let english = filled(text, value);
        Self { english, parts: vec![Part::Text(Cow::Borrowed(text), values)] }
    }

    /// A text without values that tables of languages may have: the name of a place on the body, of a fabric.
    pub fn listed(text: impl Into<String>) -> Self {
        let text = text.into();
        Self { english: text.clone(), parts: vec![Part::Text(Cow::Owned(text), Vec::new())] }
    }

    /// What is the same in every language: a name, or what the system, a library or a file says.
    pub fn plain(text: impl Into<String>) -> Self {
        let text = text.into();
        Self { english: text.clone(), parts: vec![Part::Plain(text)] }
    }

    /// These, then `between`, then `others`.
    #[must_use]
    pub fn and(mut self, between: &str, others: Self) -> Self {
        self.english += between;
        self.english += &others.english;
        self.parts.push(Part::Plain(between.to_owned()));
        self.parts.extend(others.parts);
        self
    }

    /// All of them with `between` between two.
    pub fn joined(all: impl IntoIterator<Item = Self>, between: &str) -> Self {
        all.into_iter().reduce(|before, words| before.and(between, words)).unwrap_or_default()
    }

    /// They in English.
    pub fn as_str(&self) -> &str {
        &self.english
    }

    /// The texts that follow each other.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }
}

/// `text` with each `{name}` for which `value` knows a text replaced by it.
pub fn filled<T: AsRef<str>>(text: &str, value: impl Fn(&str) -> Option<T>) -> String {
    let mut out = String::with_capacity(text.len() + 16);
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        out.push_str(before);
        let found = after.split_once('}').and_then(|(name, after)| Some((value(name)?, after)));
        match found {
            Some((value, after)) => {
                out.push_str(value.as_ref());
                rest = after;
            }
            None => {
                out.push('{');
                rest = after;
            }
        }
    }
    out.push_str(rest);
    out
}

impl std::ops::Deref for Words {
    type Target = str;

    fn deref(&self) -> &str {
        &self.english
    }
}

impl fmt::Debug for Words {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.english, f)
    }
}

impl fmt::Display for Words {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.english)
    }
}

impl PartialEq for Words {
    fn eq(&self, other: &Self) -> bool {
        self.english == other.english
    }
}

impl Eq for Words {}

impl PartialEq<str> for Words {
    fn eq(&self, other: &str) -> bool {
        self.english == other
    }
}

impl PartialEq<&str> for Words {
    fn eq(&self, other: &&str) -> bool {
        self.english == *other
    }
}

impl PartialEq<String> for Words {
    fn eq(&self, other: &String) -> bool {
        self.english == *other
    }
}

impl std::borrow::Borrow<str> for Words {
    fn borrow(&self) -> &str {
        &self.english
    }
}

impl From<Words> for String {
    fn from(words: Words) -> Self {
        words.english
    }
}

impl Serialize for Words {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.english)
    }
}

impl<'de> Deserialize<'de> for Words {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer).map(Self::plain)
    }
}

/// What can stand in a text.
pub trait AsValue {
    /// It as a value.
    fn as_value(&self) -> Value;
}

impl<T: AsValue + ?Sized> AsValue for &T {
    fn as_value(&self) -> Value {
        (**self).as_value()
    }
}

impl AsValue for Value {
    fn as_value(&self) -> Value {
        self.clone()
    }
}

impl AsValue for Words {
    fn as_value(&self) -> Value {
        Value::Words(self.clone())
    }
}

macro_rules! plain_values {
    ($($kind:ty),*) => {
        $(impl AsValue for $kind {
            fn as_value(&self) -> Value {
                Value::Plain(self.to_string())
            }
        })*
    };
}
plain_values!(str, String, usize, u8, u32, u64, i32, i64);

impl AsValue for f64 {
    fn as_value(&self) -> Value {
        Value::Number(self.to_string())
    }
}

macro_rules! ids {
    ($($id:ty, $text:literal);*) => {
        $(impl AsValue for $id {
            fn as_value(&self) -> Value {
                Value::Words(words!($text, n = self.0))
            }
        }

        impl From<$id> for Words {
            fn from(id: $id) -> Self {
                words!($text, n = id.0)
            }
        })*
    };
}

/// `value` with `digits` digits after the decimal sign.
pub fn decimal(value: f64, digits: usize) -> Value {
    Value::Number(format!("{value:.digits$}"))
}

/// `name` as it stands between quotes: a quote, a line end and the like in it are escaped.
pub fn within_quotes(name: &str) -> Value {
    let quoted = format!("{name:?}");
    Value::Plain(quoted[1..quoted.len() - 1].to_owned())
}

/// Words of a text and its values: `words!("{name} has no edge {n}", name = piece.name, n = edge + 1)`. Every `{name}` is given
/// after the text, by its name alone or with a value; see [`AsValue`], [`decimal`] and [`within_quotes`].
macro_rules! words {
    ($english:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        $crate::geometry::words::Words::of(
            $english,
            vec![$((stringify!($name), $crate::geometry::words::words!(@value $name $($value)?))),*],
        )
    };
    (@value $name:ident) => {
        $crate::geometry::words::AsValue::as_value(&$name)
    };
    (@value $name:ident $value:expr) => {
        $crate::geometry::words::AsValue::as_value(&$value)
    };
}
pub(crate) use words;

ids!(
    PieceId, "piece {n}";
    SeamId, "seam {n}";
    ButtonId, "button {n}";
    MarkId, "mark {n}";
    ImageId, "image {n}";
    GraphicId, "graphic {n}";
    PinId, "pin {n}"
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_english_as_a_string_and_keep_their_parts() {
        let (name, n) = ("v{n}", 2);
        let words = words!("{name} has no edge {n}", name, n)
            .and("; ", words!("it is {cm} cm long", cm = decimal(1.25, 1)));
        assert_eq!(words, "v{n} has no edge 2; it is 1.2 cm long");
        assert_eq!(words.parts().len(), 3);
        assert_eq!(words.to_string(), words.as_str());
        assert_eq!(words!("there is no {what}", what = SeamId(3)), "there is no seam 3");
        assert_eq!(words!("\"{name}\" is empty", name = within_quotes("a\"b")), "\"a\\\"b\" is empty");
        assert_eq!(
            Words::joined([Words::listed("a"), Words::plain("b"), Words::listed("c")], ", "),
            "a, b, c"
        );
    }

    #[test]
    fn words_are_written_as_their_english() {
        let words = words!("line {n}", n = 3);
        let text = serde_json::to_string(&words).expect("JSON");
        assert_eq!(text, "\"line 3\"");
        assert_eq!(serde_json::from_str::<Words>(&text).expect("words"), words);
    }
}
