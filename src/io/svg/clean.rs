//! Reduces SVG text to shapes with their transforms and references before `usvg` resolves it.
//!
//! Nesting depth, number of elements and the expansion of `<use>` are bounded before anything recursive reads the text. Styles,
//! scripts, images, clips, filters, markers and texts are left out: only the paths make a pattern.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use usvg::roxmltree::{Document, Node, ParsingOptions};

use crate::geometry::words::{Words, within_quotes, words};
use crate::io::Limits;
use crate::io::pattern_file::PatternFileError;
use crate::io::words::{line, readable_words};

const KEPT: [&str; 14] = [
    "svg", "g", "a", "switch", "symbol", "defs", "use", "path", "rect", "circle", "ellipse", "line",
    "polyline", "polygon",
];
const SHAPES: [&str; 7] = ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon"];
const ATTRIBUTES: [&str; 18] = [
    "transform",
    "d",
    "points",
    "x",
    "y",
    "x1",
    "y1",
    "x2",
    "y2",
    "cx",
    "cy",
    "r",
    "rx",
    "ry",
    "width",
    "height",
    "viewBox",
    "preserveAspectRatio",
];
/// Largest number of notes about single shapes.
const MOST_NOTES: usize = 8;

/// The name and the `data-` attributes of a shape.
#[derive(Clone, Debug, Default)]
pub struct Shape {
    /// The shape's own name, else that of the nearest named group around it.
    pub name: Option<String>,
    /// The `data-` attributes, which only this program's files have.
    pub data: BTreeMap<String, String>,
}

/// A drawing reduced to shapes.
#[derive(Debug, Default)]
pub struct Clean {
    /// The reduced SVG, whose user unit is a pixel.
    pub text: String,
    /// Names and attributes of the shapes, by their ids in `text`.
    pub shapes: BTreeMap<String, Shape>,
    /// Faults that the reader could skip.
    pub notes: Vec<Words>,
    /// Size and view box of the root element as they are written.
    pub root: Root,
}

/// What the root element states about the drawing's size and origin.
#[derive(Clone, Debug, Default)]
pub struct Root {
    pub width: Option<String>,
    pub height: Option<String>,
    /// The view box: x, y, width, height, in user units.
    pub view_box: Option<[f64; 4]>,
    /// Whether this program wrote the file.
    pub is_ours: bool,
    /// Whether Inkscape before version 0.92 wrote the file; its pixels were 1/90 inch.
    pub is_old_inkscape: bool,
    /// Whether Illustrator wrote the file; its pixels are points.
    pub is_illustrator: bool,
}

/// Largest absolute number in the data of a path, user units.
const FARTHEST: f64 = 1e15;

/// Checks and reduces a file.
pub fn clean(bytes: &[u8]) -> Result<Clean, PatternFileError> {
    if bytes.starts_with(b"\x1f\x8b") {
        return Err(PatternFileError::Whole(words!("this is a compressed SVG (.svgz); unpack it first")));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes).map_err(|e| {
        PatternFileError::Whole(words!("byte {n}: the file is not UTF-8 text", n = e.valid_up_to()))
    })?;
    let limits = Limits::default();
    check_depth(text, &limits)?;
    let options = ParsingOptions {
        allow_dtd: true,
        nodes_limit: u32::try_from(limits.svg_nodes * 4).unwrap_or(u32::MAX),
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options).map_err(|e| {
        PatternFileError::Whole(readable_words(words!("no sound XML: {why}", why = e.to_string())))
    })?;
    let root = document.root_element();
    is_svg(root)?;
    check_paths(root)?;
    let names = numbers(root);
    check_uses(root, &names, &limits)?;
    let mut clean = Clean { root: root_of(root, text)?, ..Clean::default() };
    clean.write(root, &names);
    Ok(clean)
}

/// Refuses a root that is no SVG. Patterns and measurements of Valentina and of Seamly2D, which came of it, are told by theirs.
fn is_svg(root: Node<'_, '_>) -> Result<(), PatternFileError> {
    match root.tag_name().name() {
        "svg" => Ok(()),
        "pattern" | "vit" | "vst" | "smis" | "smms" => Err(PatternFileError::Whole(words!(
            "this is a file of Valentina or Seamly2D, which is not read: export the pattern there as DXF or SVG"
        ))),
        name => Err(PatternFileError::bad(line(1), words!("its root is <{name}>, not <svg>", name))),
    }
}

/// Refuses too many elements and too deep nesting, without recursion.
fn check_depth(text: &str, limits: &Limits) -> Result<(), PatternFileError> {
    let (mut depth, mut count, mut rest) = (0_usize, 0_usize, text);
    while let Some(at) = rest.find('<') {
        let tag = &rest[at..];
        let skip = |end: &str| tag.find(end).map_or(tag.len(), |i| i + end.len());
        let length = if tag.starts_with("<!--") {
            skip("-->")
        } else if tag.starts_with("<![CDATA[") {
            skip("]]>")
        } else if tag.starts_with("<?") {
            skip("?>")
        } else if tag.starts_with("<!ENTITY") {
            let length = tag_length(tag);
            if tag[1..length].contains('<') {
                return Err(PatternFileError::Whole(words!("entities that hold elements are not read")));
            }
            length
        } else if tag.starts_with("<!") {
            // A DOCTYPE: the declarations inside its brackets are read one by one, like elements.
            tag.find(['[', '>']).map_or(tag.len(), |i| i + 1)
        } else if tag.starts_with("</") {
            depth = depth.saturating_sub(1);
            skip(">")
        } else {
            let length = tag_length(tag);
            count += 1;
            if !tag[..length].ends_with("/>") {
                depth += 1;
            }
            length
        };
        if depth > limits.svg_depth {
            let words = words!("elements are nested more than {most} deep", most = limits.svg_depth);
            return Err(PatternFileError::OverLimit(words));
        }
        if count > limits.svg_nodes {
            let words = words!("more than {most} elements", most = limits.svg_nodes);
            return Err(PatternFileError::OverLimit(words));
        }
        rest = &tag[length..];
    }
    Ok(())
}

/// Length of a tag up to its ">" in bytes; a ">" within a quoted attribute does not end it.
fn tag_length(tag: &str) -> usize {
    let mut quote = None;
    for (i, c) in tag.bytes().enumerate() {
        match (quote, c) {
            (None, b'"' | b'\'') => quote = Some(c),
            (None, b'>') => return i + 1,
            (Some(q), c) if q == c => quote = None,
            _ => {}
        }
    }
    tag.len()
}

fn elements<'a>(node: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(|n| n.is_element() && KEPT.contains(&n.tag_name().name()))
}

/// The first element with each id.
fn numbers<'a>(root: Node<'a, 'a>) -> BTreeMap<&'a str, Node<'a, 'a>> {
    let mut found = BTreeMap::new();
    for node in root.descendants().filter(Node::is_element) {
        if let Some(id) = node.attribute("id") {
            found.entry(id).or_insert(node);
        }
    }
    found
}

fn target<'a>(node: Node<'a, 'a>, names: &BTreeMap<&str, Node<'a, 'a>>) -> Option<Node<'a, 'a>> {
    if node.tag_name().name() != "use" {
        return None;
    }
    let href = node.attributes().find(|a| a.name() == "href")?.value();
    names.get(href.strip_prefix('#')?).copied()
}

/// Refuses `<use>` references that expand to too many elements, nest too deep or form a cycle.
fn check_uses<'a>(
    root: Node<'a, 'a>,
    names: &BTreeMap<&str, Node<'a, 'a>>,
    limits: &Limits,
) -> Result<(), PatternFileError> {
    let number = |node: &Node<'_, '_>| node.id().get_usize();
    let mut done: BTreeMap<usize, (u64, usize)> = BTreeMap::new();
    let mut open: BTreeSet<usize> = BTreeSet::new();
    let mut stack = vec![root];
    while let Some(&node) = stack.last() {
        let id = number(&node);
        let below: Vec<Node<'a, 'a>> = elements(node).chain(target(node, names)).collect();
        if open.insert(id) {
            for child in &below {
                if open.contains(&number(child)) && !done.contains_key(&number(child)) {
                    let words = words!("a <use> refers to what it is in; the drawing would be without end");
                    return Err(PatternFileError::bad(Words::plain(place(*child)), words));
                }
            }
            stack.extend(below.into_iter().filter(|n| !done.contains_key(&number(n))));
            continue;
        }
        stack.pop();
        if done.contains_key(&id) {
            continue;
        }
        let (mut count, mut depth) = (1_u64, 0);
        for child in below {
            let (of_child, deep) = done.get(&number(&child)).copied().unwrap_or((1, 0));
            count = count.saturating_add(of_child);
            depth = depth.max(deep);
        }
        if count > limits.svg_nodes as u64 || depth > limits.svg_depth {
            let words = words!(
                "{place}: with all references it has more than {most} elements, or more than {depth} inside each other",
                place = place(node),
                most = limits.svg_nodes,
                depth = limits.svg_depth
            );
            return Err(PatternFileError::OverLimit(words));
        }
        done.insert(id, (count, depth + 1));
    }
    Ok(())
}

/// Refuses paths with numbers far beyond any coordinate: an arc over such a distance would be split into too many curves.
fn check_paths(root: Node<'_, '_>) -> Result<(), PatternFileError> {
    for node in root.descendants() {
        let Some(data) = node.attribute("d") else { continue };
        if let Some(number) = numbers_of(data).find(|number| number.abs() > FARTHEST) {
            let words =
                words!("a coordinate of its path is out of range: {number}", number = format!("{number:e}"));
            return Err(PatternFileError::bad(called(node), words));
        }
    }
    Ok(())
}

/// What a path is called in a message.
fn called(node: Node<'_, '_>) -> Words {
    let name = own_name(node).or_else(|| node.attribute("id").map(short));
    name.map_or_else(|| words!("a path"), Words::plain)
}

/// The numbers in the data of a path, also where no separator stands between them: "1-2.5.5e3" are three.
fn numbers_of(data: &str) -> impl Iterator<Item = f64> {
    let mut rest = data;
    std::iter::from_fn(move || {
        loop {
            rest = &rest[rest.find(|c: char| c.is_ascii_digit() || c == '.')?..];
            let bytes = rest.as_bytes();
            let digits = |from: usize| from + bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
            let mut end = digits(0);
            if bytes.get(end) == Some(&b'.') {
                end = digits(end + 1);
            }
            if let Some(b'e' | b'E') = bytes.get(end) {
                let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
                let exponent = digits(end + 1 + sign);
                if exponent > end + 1 + sign {
                    end = exponent;
                }
            }
            let (number, after) = rest.split_at(end);
            rest = after;
            if let Ok(number) = number.parse() {
                return Some(number);
            }
        }
    })
}

fn place(node: Node<'_, '_>) -> String {
    match node.attribute("id") {
        Some(id) => format!("<{}> {:?}", node.tag_name().name(), short(id)),
        None => format!("<{}>", node.tag_name().name()),
    }
}

fn short(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(60).collect()
}

fn root_of(root: Node<'_, '_>, text: &str) -> Result<Root, PatternFileError> {
    let view_box = match root.attribute("viewBox") {
        None => None,
        Some(words) => {
            let numbers: Vec<f64> = words
                .split(|c: char| c == ',' || c.is_whitespace())
                .filter(|w| !w.is_empty())
                .filter_map(|w| w.parse().ok())
                .collect();
            match numbers[..] {
                [x, y, w, h] if w > 0.0 && h > 0.0 && [x, y, w, h].iter().all(|n| n.abs() < 1e7) => {
                    Some([x, y, w, h])
                }
                _ => {
                    let words =
                        words!("the viewBox \"{given}\" is no box", given = within_quotes(&short(words)));
                    return Err(PatternFileError::bad(Words::plain("<svg>"), words));
                }
            }
        }
    };
    let inkscape = root
        .attributes()
        .find(|a| a.name() == "version" && a.namespace().is_some_and(|n| n.contains("inkscape")));
    let version: Option<f64> = inkscape.and_then(|a| a.value().get(..4)?.parse().ok());
    Ok(Root {
        width: root.attribute("width").map(str::to_owned),
        height: root.attribute("height").map(str::to_owned),
        view_box,
        is_ours: root.attribute(super::OURS).is_some(),
        is_old_inkscape: version.is_some_and(|v| v < 0.92),
        is_illustrator: text.contains("Adobe Illustrator"),
    })
}

impl Clean {
    /// Writes all elements that are kept, without recursion.
    fn write(&mut self, root: Node<'_, '_>, names: &BTreeMap<&str, Node<'_, '_>>) {
        self.text
            .push_str("<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:x=\"http://www.w3.org/1999/xlink\" ");
        self.text.push_str("fill=\"none\" stroke=\"#000\" ");
        let [x, y, w, h] = self.root.view_box.unwrap_or([0.0, 0.0, 1000.0, 1000.0]);
        // Writing to a String cannot fail.
        let _ = write!(self.text, "width=\"{w}\" height=\"{h}\" viewBox=\"{x} {y} {w} {h}\">");
        enum Step<'a> {
            Open(Node<'a, 'a>),
            Close(&'a str),
        }
        let mut steps: Vec<Step<'_>> = elements(root).map(Step::Open).collect();
        steps.reverse();
        while let Some(step) = steps.pop() {
            match step {
                Step::Close(name) => {
                    let _ = write!(self.text, "</{name}>");
                }
                Step::Open(node) => {
                    if is_hidden(node) {
                        continue;
                    }
                    let name = match node.tag_name().name() {
                        "a" | "switch" => "g",
                        name => name,
                    };
                    self.open(node, name, names);
                    steps.push(Step::Close(name));
                    let first = steps.len();
                    steps.extend(elements(node).map(Step::Open));
                    steps[first..].reverse();
                }
            }
        }
        self.text.push_str("</svg>");
    }

    fn open(&mut self, node: Node<'_, '_>, name: &str, names: &BTreeMap<&str, Node<'_, '_>>) {
        let id = id_of(node);
        let _ = write!(self.text, "<{name} id=\"{id}\"");
        for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
            if ATTRIBUTES.contains(&attribute.name()) {
                let _ = write!(self.text, " {}=\"{}\"", attribute.name(), escaped(attribute.value()));
            }
        }
        if let Some(target) = target(node, names) {
            let _ = write!(self.text, " x:href=\"#{}\"", id_of(target));
        }
        self.text.push('>');
        if SHAPES.contains(&name) {
            self.check_path(node);
            self.shapes.insert(id, shape(node));
        }
    }

    fn check_path(&mut self, node: Node<'_, '_>) {
        let Some(data) = node.attribute("d") else { return };
        if let Err(error) = kurbo::BezPath::from_svg(data)
            && self.notes.len() < MOST_NOTES
        {
            let (name, error) = (called(node), error.to_string());
            self.notes.push(words!(
                "{name}: its data has a fault ({error}); it was read up to there",
                name,
                error
            ));
        }
    }
}

fn id_of(node: Node<'_, '_>) -> String {
    format!("e{}", node.id().get_usize())
}

fn is_hidden(node: Node<'_, '_>) -> bool {
    let by_style = |style: &str| {
        style.split(';').any(|rule| {
            rule.split_once(':').is_some_and(|(key, value)| key.trim() == "display" && value.trim() == "none")
        })
    };
    node.attribute("display") == Some("none") || node.attribute("style").is_some_and(by_style)
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

fn shape(node: Node<'_, '_>) -> Shape {
    let data = node
        .attributes()
        .filter(|a| a.name().starts_with("data-"))
        .map(|a| (a.name().to_owned(), a.value().to_owned()))
        .collect();
    let name = node
        .ancestors()
        .filter(Node::is_element)
        .find_map(|n| if n.parent_element().is_some() { own_name(n) } else { None });
    Shape { name, data }
}

/// The name that a person gave an element: its label, its title, or its id unless a program made it.
fn own_name(node: Node<'_, '_>) -> Option<String> {
    let label = node.attributes().find(|a| a.name() == "label" && a.namespace().is_some()).map(|a| a.value());
    let title = || node.children().find(|n| n.tag_name().name() == "title").and_then(|n| n.text());
    let name = label.or_else(title).or_else(|| node.attribute("id").filter(|id| is_chosen(id)))?;
    // FreeSewing's ids, such as "fs-stack-brian.back-part-brian.back".
    let name = name.rsplit_once("-part-").map_or(name, |(_, part)| part);
    let limit = Limits::default().name_bytes;
    let name: String = name.trim().chars().filter(|c| !c.is_control()).take(limit / 4).collect();
    (!name.is_empty() && !name.starts_with("fs-")).then_some(name)
}

/// Whether an id was chosen by a person, unlike those that programs make, such as "path12-3" or "fs-1".
fn is_chosen(id: &str) -> bool {
    let letters: String = id.chars().take_while(|c| c.is_alphabetic()).collect();
    let automatic = [
        "path", "g", "rect", "svg", "layer", "use", "polygon", "circle", "ellipse", "fs", "polyline", "line",
    ];
    let rest = &id[letters.len()..];
    let numbered = rest.chars().all(|c| c.is_ascii_digit() || c == '-' || c == '_');
    !(numbered && (automatic.contains(&letters.to_lowercase().as_str()) || letters.is_empty()))
}

#[cfg(test)]
mod tests {
    #[test]
    fn numbers_of_paths_are_found_however_they_are_parted() {
        let found = |data: &str| super::numbers_of(data).collect::<Vec<f64>>();
        assert_eq!(found("M1-2.5.5e3,4E-1 1e+2z"), [1.0, 2.5, 500.0, 0.4, 100.0]);
        assert_eq!(found("M 20 1e30 . A 5e x"), [20.0, 1e30, 5.0]);
        assert_eq!(found("Mäé"), [0.0; 0]);
    }
}
