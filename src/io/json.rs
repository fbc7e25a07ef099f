//! JSON read strictly, with the position of every value as a JSON pointer (RFC 6901).
//!
//! Stricter than `serde_json::Value`: a key that occurs twice is an error, and objects keep the order of the file. More lenient
//! in two points: a byte-order mark and `//` and `/* */` comments are skipped. It is a `Deserialize` for serde_json's parser, not
//! a parser of its own: no library keeps the order, refuses doubled keys and gives pointers at once.

use std::fmt;

use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};

use crate::geometry::words::{Words, within_quotes, words};
use crate::io::words::{readable, readable_words};

/// A JSON value.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// `null`
    Null,
    /// `true`, `false`
    Bool(bool),
    /// A finite number.
    Number(f64),
    /// A string.
    Text(String),
    /// An array.
    List(Vec<Node>),
    /// An object, in the order of the file, every key once.
    Map(Vec<(String, Node)>),
}

/// What is wrong with a JSON text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub enum JsonError {
    /// The text is no JSON.
    Syntax {
        /// Line number, from 1.
        line: usize,
        /// Column in bytes, from 1.
        column: usize,
        /// The reason.
        words: Words,
    },
    /// The text is JSON, but not of the expected shape.
    Content {
        /// JSON pointer of the value; `/` for the whole text.
        pointer: String,
        /// The reason.
        words: Words,
    },
}

impl JsonError {
    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::Syntax { line, column, words } => {
                words!("line {line}, column {column}", line, column).and(": ", words.clone())
            }
            Self::Content { pointer, words } => Words::plain(pointer).and(": ", words.clone()),
        }
    }
}

/// Parses a whole JSON text in UTF-8.
pub fn parse(bytes: &[u8]) -> Result<Node, JsonError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes).map_err(|e| {
        let (line, column) = line_and_column(bytes, e.valid_up_to());
        JsonError::Syntax { line, column, words: words!("the file is not UTF-8 text") }
    })?;
    if text.trim().is_empty() {
        return Err(JsonError::Syntax { line: 1, column: 1, words: words!("the file is empty") });
    }
    serde_json::from_str(&without_comments(text)).map_err(|e| JsonError::Syntax {
        line: e.line(),
        column: e.column(),
        words: in_words(&e),
    })
}

fn in_words(error: &serde_json::Error) -> Words {
    let full = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    let words = full.strip_suffix(&place).unwrap_or(&full);
    if error.is_eof() {
        return words!("the file ends too early: it is truncated");
    }
    match words {
        "expected value" => words!("expected a value (NaN and Infinity are no JSON numbers)"),
        "trailing characters" => words!("there is text after the end of the JSON"),
        "unexpected end of hex escape" => words!("half a surrogate pair in a text"),
        "recursion limit exceeded" => words!("nested too deeply"),
        "number out of range" => words!("number out of range"),
        words => match doubled(words) {
            Some(key) => readable_words(words!("the key \"{key}\" occurs twice", key)),
            None => Words::plain(readable(words)),
        },
    }
}

/// The key that occurs twice, as it stands between quotes, if that is what `words` say: the parser carries errors as text only.
fn doubled(words: &str) -> Option<&str> {
    words.strip_prefix("the key \"")?.strip_suffix("\" occurs twice")
}

fn line_and_column(bytes: &[u8], at: usize) -> (usize, usize) {
    let before = &bytes[..at];
    let line_start = before.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
    (before.iter().filter(|&&b| b == b'\n').count() + 1, at - line_start + 1)
}

/// `text` with its comments replaced by spaces, so that line and column numbers stay.
fn without_comments(text: &str) -> String {
    #[derive(PartialEq)]
    enum In {
        Code,
        Text,
        Line,
        Block,
    }
    let mut state = In::Code;
    let mut out = String::with_capacity(text.len());
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        match state {
            In::Code if c == '"' => state = In::Text,
            In::Code if c == '/' && chars.peek() == Some(&'/') => state = In::Line,
            In::Code if c == '/' && chars.peek() == Some(&'*') => {
                chars.next();
                out.push_str("  ");
                state = In::Block;
                continue;
            }
            In::Text if c == '"' => state = In::Code,
            In::Text if c == '\\' => {
                out.push(c);
                out.extend(chars.next());
                continue;
            }
            In::Line if c == '\n' => state = In::Code,
            In::Block if c == '*' && chars.peek() == Some(&'/') => {
                chars.next();
                out.push_str("  ");
                state = In::Code;
                continue;
            }
            _ => {}
        }
        let commented = matches!(state, In::Line | In::Block);
        out.push(if commented && c != '\n' { ' ' } else { c });
    }
    out
}

impl<'de> Deserialize<'de> for Node {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NodeVisitor)
    }
}

struct NodeVisitor;

impl<'de> Visitor<'de> for NodeVisitor {
    type Value = Node;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Node, E> {
        Ok(Node::Null)
    }

    fn visit_bool<E>(self, v: bool) -> Result<Node, E> {
        Ok(Node::Bool(v))
    }

    fn visit_i64<E>(self, v: i64) -> Result<Node, E> {
        Ok(Node::Number(v as f64))
    }

    fn visit_u64<E>(self, v: u64) -> Result<Node, E> {
        Ok(Node::Number(v as f64))
    }

    fn visit_f64<E: de::Error>(self, v: f64) -> Result<Node, E> {
        if v.is_finite() { Ok(Node::Number(v)) } else { Err(E::custom("number out of range")) }
    }

    fn visit_str<E>(self, v: &str) -> Result<Node, E> {
        Ok(Node::Text(v.to_owned()))
    }

    fn visit_string<E>(self, v: String) -> Result<Node, E> {
        Ok(Node::Text(v))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Node, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = seq.next_element()? {
            items.push(item);
        }
        Ok(Node::List(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Node, A::Error> {
        let mut entries: Vec<(String, Node)> = Vec::new();
        let mut seen = std::collections::BTreeSet::new();
        while let Some(key) = map.next_key::<String>()? {
            if !seen.insert(key.clone()) {
                return Err(de::Error::custom(format!("the key {key:?} occurs twice")));
            }
            entries.push((key, map.next_value()?));
        }
        Ok(Node::Map(entries))
    }
}

/// A JSON value and its JSON pointer, for readers that report errors with their position.
#[derive(Clone, Debug)]
pub struct At<'a> {
    /// The value.
    pub node: &'a Node,
    /// JSON pointer of the value; empty for the whole text.
    pub pointer: String,
}

impl<'a> At<'a> {
    /// The whole text.
    pub fn root(node: &'a Node) -> Self {
        Self { node, pointer: String::new() }
    }

    /// An error at this value.
    pub fn error(&self, words: Words) -> JsonError {
        let pointer = if self.pointer.is_empty() { "/".to_owned() } else { self.pointer.clone() };
        JsonError::Content { pointer: readable(&pointer), words: readable_words(words) }
    }

    fn wrong(&self, expected: &Words) -> JsonError {
        let found = match self.node {
            Node::Null => words!("null"),
            Node::Bool(_) => words!("true or false"),
            Node::Number(_) => words!("a number"),
            Node::Text(_) => words!("a text"),
            Node::List(_) => words!("a list"),
            Node::Map(_) => words!("an object"),
        };
        self.error(words!("expected {expected}, found {found}", expected, found))
    }

    fn below(&self, key: &str, node: &'a Node) -> At<'a> {
        let key = key.replace('~', "~0").replace('/', "~1");
        At { node, pointer: format!("{}/{key}", self.pointer) }
    }

    /// The entries of an object, in the order of the file.
    pub fn entries(&self) -> Result<Vec<(&'a str, At<'a>)>, JsonError> {
        let Node::Map(entries) = self.node else {
            return Err(self.wrong(&words!("an object")));
        };
        Ok(entries.iter().map(|(k, n)| (k.as_str(), self.below(k, n))).collect())
    }

    /// The field `key` of an object; None if it is missing or null.
    pub fn optional(&self, key: &str) -> Result<Option<At<'a>>, JsonError> {
        let Node::Map(entries) = self.node else {
            return Err(self.wrong(&words!("an object")));
        };
        let found = entries.iter().find(|(k, n)| k == key && *n != Node::Null);
        Ok(found.map(|(k, n)| self.below(k, n)))
    }

    /// The field `key` of an object; an error if it is missing or null.
    pub fn field(&self, key: &str) -> Result<At<'a>, JsonError> {
        let missing = || self.error(words!("\"{key}\" is missing", key = within_quotes(key)));
        self.optional(key)?.ok_or_else(missing)
    }

    /// The items of a list.
    pub fn items(&self) -> Result<Vec<At<'a>>, JsonError> {
        let Node::List(items) = self.node else {
            return Err(self.wrong(&words!("a list")));
        };
        Ok(items.iter().enumerate().map(|(i, n)| self.below(&i.to_string(), n)).collect())
    }

    /// The items of a list of exactly `N` items.
    pub fn array<const N: usize>(&self) -> Result<[At<'a>; N], JsonError> {
        let items = self.items()?;
        let count = items.len();
        let wrong = || words!("expected a list of {length}, found {count}", length = N, count);
        items.try_into().map_err(|_| self.error(wrong()))
    }

    /// A list of exactly `N` numbers.
    pub fn numbers<const N: usize>(&self) -> Result<[f64; N], JsonError> {
        let items = self.array::<N>()?;
        let mut numbers = [0.0; N];
        for (number, item) in numbers.iter_mut().zip(&items) {
            *number = item.number()?;
        }
        Ok(numbers)
    }

    /// A finite number.
    pub fn number(&self) -> Result<f64, JsonError> {
        match self.node {
            Node::Number(x) => Ok(*x),
            _ => Err(self.wrong(&words!("a number"))),
        }
    }

    /// A whole number below `count`.
    pub fn index(&self, count: usize) -> Result<usize, JsonError> {
        let x = self.number()?;
        if x.fract() != 0.0 || x < 0.0 || x >= count as f64 {
            return Err(match count {
                0 => self.error(words!("index {x} is out of range: there is nothing to point to", x)),
                _ => self.error(words!("index {x} is out of range 0..={last}", x, last = count - 1)),
            });
        }
        Ok(x as usize)
    }

    /// A truth value, written as 0, 1, false or true.
    pub fn flag(&self) -> Result<bool, JsonError> {
        match self.node {
            Node::Bool(b) => Ok(*b),
            Node::Number(x) if *x == 0.0 || *x == 1.0 => Ok(*x == 1.0),
            _ => Err(self.wrong(&words!("0 or 1"))),
        }
    }

    /// A text.
    pub fn text(&self) -> Result<&'a str, JsonError> {
        match self.node {
            Node::Text(s) => Ok(s),
            _ => Err(self.wrong(&words!("a text"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: &str) {
        let error = parse(text.as_bytes()).expect_err(text).to_string();
        assert!(error.contains(expected), "{text}: {error}");
    }

    #[test]
    fn faults_are_named() {
        check("", "empty");
        check("{\"a\": 1", "truncated");
        check("{\"a\": NaN}", "line 1, column 7: expected a value (NaN");
        check("{\"a\": 1e999}", "out of range");
        check("{\"a\": 1,\n\"a\": 2}", "\"a\" occurs twice");
        check("{} {}", "after the end");
        check(&"[".repeat(100_000), "nested too deeply");
        check("{\"a\": \"\\ud800\"}", "half a surrogate pair");
    }

    #[test]
    fn comments_and_a_byte_order_mark_are_skipped() {
        let text = "\u{feff}// one \"quote\n{\"a\": /* two */ \"http://x\"} // three";
        let node = parse(text.as_bytes()).expect("JSON");
        assert_eq!(node, Node::Map(vec![("a".to_owned(), Node::Text("http://x".to_owned()))]));
    }

    #[test]
    fn places_are_pointers() {
        let node = parse(b"{\"a/b\": [1, {\"c\": true}]}").expect("JSON");
        let at = At::root(&node).field("a/b").and_then(|a| a.array::<2>()).expect("two items");
        let error = at[1].field("c").and_then(|c| c.number()).expect_err("no number");
        assert_eq!(error.to_string(), "/a~1b/1/c: expected a number, found true or false");
    }
}
