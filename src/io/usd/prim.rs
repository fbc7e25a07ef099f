//! USD scene description as text: prims with their attributes, connections and relationships, and values.

use std::fmt::Write as _;

/// A prim: a thing in the scene, such as a mesh or a shader.
#[derive(Clone, Debug)]
pub(super) struct Prim {
    kind: &'static str,
    name: String,
    metadata: Vec<String>,
    properties: Vec<String>,
    /// The prims in it.
    pub children: Vec<Prim>,
}

impl Prim {
    /// A prim of a schema, "Mesh" for example. `name` is an ASCII identifier.
    pub fn new(kind: &'static str, name: &str) -> Self {
        let (metadata, properties, children) = Default::default();
        Self { kind, name: name.to_owned(), metadata, properties, children }
    }

    /// Adds a line of metadata.
    pub fn metadata(&mut self, key: &str, value: &str) {
        self.metadata.push(format!("{key} = {value}"));
    }

    /// Adds an attribute, given by its type and name: "float inputs:opacity".
    pub fn attribute(&mut self, attribute: &str, value: &str) {
        self.properties.push(format!("{attribute} = {value}"));
    }

    /// Adds an attribute with a value for each vertex.
    pub fn of_vertices(&mut self, attribute: &str, value: &str) {
        self.properties.push(format!("{attribute} = {value} (interpolation = \"vertex\")"));
    }

    /// Adds an attribute without a value: an output.
    pub fn output(&mut self, attribute: &str) {
        self.properties.push(attribute.to_owned());
    }

    /// Gives an attribute a value at each time code from 0.
    pub fn samples(&mut self, attribute: &str, values: impl Iterator<Item = String>) {
        let mut line = format!("{attribute}.timeSamples = {{");
        for (i, value) in values.enumerate() {
            let _ = write!(line, "{i}: {value}, ");
        }
        self.properties.push(line + "}");
    }

    /// Adds an attribute that takes its value from `source`, "/garment/shader.outputs:rgb" for example.
    pub fn connect(&mut self, attribute: &str, source: &str) {
        self.properties.push(format!("{attribute}.connect = <{source}>"));
    }

    /// Adds a relationship to the prim at `target`.
    pub fn relate(&mut self, name: &str, target: &str) {
        self.properties.push(format!("rel {name} = <{target}>"));
    }

    fn write(&self, depth: usize, text: &mut String) {
        let indent = "    ".repeat(depth);
        let Self { kind, name, metadata, properties, children } = self;
        let _ = write!(text, "{indent}def {kind} \"{name}\"");
        if !metadata.is_empty() {
            text.push_str(" (\n");
            metadata.iter().for_each(|line| write_line(text, &indent, line));
            let _ = write!(text, "{indent})");
        }
        let _ = writeln!(text, "\n{indent}{{");
        properties.iter().for_each(|line| write_line(text, &indent, line));
        for (i, child) in children.iter().enumerate() {
            if i > 0 || !properties.is_empty() {
                text.push('\n');
            }
            child.write(depth + 1, text);
        }
        let _ = writeln!(text, "{indent}}}");
    }
}

/// Writes a line below what is indented by `indent`.
fn write_line(text: &mut String, indent: &str, line: &str) {
    text.push_str(indent);
    text.push_str("    ");
    text.push_str(line);
    text.push('\n');
}

/// A layer whose default prim is `root`, in metres with y up. `metadata` are further lines for it.
pub(super) fn layer(metadata: &[String], root: &Prim) -> String {
    let mut text = String::from("#usda 1.0\n(\n");
    let own = [
        format!("defaultPrim = {}", quoted(&root.name)),
        "doc = \"Toile\"".to_owned(),
        "metersPerUnit = 1".to_owned(),
        "upAxis = \"Y\"".to_owned(),
    ];
    own.iter().chain(metadata).for_each(|line| write_line(&mut text, "", line));
    text.push_str(")\n\n");
    root.write(0, &mut text);
    text
}

/// A string or a token.
pub(super) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            '\n' => quoted.push_str("\\n"),
            '\t' => quoted.push_str("\\t"),
            c if c.is_control() => {}
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

/// The path of a file beside the scene.
pub(super) fn asset(path: &str) -> String {
    match path.contains('@') {
        true => format!("@@@./{}@@@", path.replace("@@@", "\\@@@")),
        false => format!("@./{path}@"),
    }
}

/// A vector: "(1, 0.5, 0)". A number that is not finite is written as 0.
pub(super) fn tuple<const N: usize>(numbers: [f32; N]) -> String {
    let mut text = String::new();
    write_tuple(&mut text, numbers);
    text
}

/// An array of vectors.
pub(super) fn tuples<const N: usize>(all: impl Iterator<Item = [f32; N]>) -> String {
    let mut text = String::from("[");
    for (i, numbers) in all.enumerate() {
        text.push_str(if i > 0 { ", " } else { "" });
        write_tuple(&mut text, numbers);
    }
    text + "]"
}

fn write_tuple<const N: usize>(text: &mut String, numbers: [f32; N]) {
    for (i, number) in numbers.into_iter().enumerate() {
        text.push_str(if i > 0 { ", " } else { "(" });
        // Adding 0 makes a positive zero of a negative one.
        let _ = write!(text, "{}", if number.is_finite() { number + 0.0 } else { 0.0 });
    }
    text.push(')');
}

/// An array of whole numbers.
pub(super) fn integers(all: impl Iterator<Item = u32>) -> String {
    let mut text = String::from("[");
    for (i, number) in all.enumerate() {
        let _ = write!(text, "{}{number}", if i > 0 { ", " } else { "" });
    }
    text + "]"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_end_where_they_end() {
        assert_eq!(quoted("a \"b\" \\ c\n\u{7}é"), r#""a \"b\" \\ c\né""#);
        assert_eq!(asset("a b.png"), "@./a b.png@");
        assert_eq!(asset("a@b.png"), "@@@./a@b.png@@@");
        assert_eq!(asset("a@@@b.png"), "@@@./a\\@@@b.png@@@");
    }

    #[test]
    fn numbers_keep_their_last_digit() {
        assert_eq!(tuple([0.1, -0.0, 1.0]), "(0.1, 0, 1)");
        assert_eq!(tuple([1.5e-8, f32::NAN]), "(0.000000015, 0)");
        assert_eq!(
            tuples([[0.5_f32, 2.0], [16_777_216.0, -3.25]].into_iter()),
            "[(0.5, 2), (16777216, -3.25)]"
        );
        assert_eq!(tuples(std::iter::empty::<[f32; 3]>()), "[]");
        assert_eq!(integers([3, 3].into_iter()), "[3, 3]");
    }
}
