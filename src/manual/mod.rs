//! The manual: what the program does, topic by topic, for the window and the command line.
//!
//! The texts in `assets/manual` use a small part of Markdown: `#` and `##` begin headings, `-` and numbers list items, `|` table
//! rows, four spaces a command line; `*Menu › Entry* (Keys)` names menu entries.

/// A topic of the manual.
#[derive(Clone, Copy, Debug)]
pub struct Topic {
    /// Name on the command line: `toile help NAME`.
    pub name: &'static str,
    /// The whole text; its first line is the title.
    pub text: &'static str,
}

macro_rules! topics {
    ($($name:literal),*) => {
        /// All topics, in the order in which they are read.
        pub const TOPICS: &[Topic] =
            &[$(Topic { name: $name, text: include_str!(concat!("../../assets/manual/", $name, ".md")) }),*];

        /// The same in German, block by block.
        pub const GERMAN: &[Topic] =
            &[$(Topic { name: $name, text: include_str!(concat!("../../assets/manual/de/", $name, ".md")) }),*];
    };
}

topics!(
    "start", "pattern", "grading", "cutting", "marks", "dressing", "draping", "bodies", "fitting", "looking",
    "files", "batch", "many", "install"
);

/// All topics in the language with this code; in English where there is no manual in it.
pub fn topics_in(code: &str) -> &'static [Topic] {
    if code.starts_with("de") { GERMAN } else { TOPICS }
}

/// A block of a topic's text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Block {
    /// Heading: its level, from 1, and its text.
    Heading(usize, String),
    /// Paragraph.
    Words(String),
    /// List item: its bullet or number, and its text.
    Item(String, String),
    /// Table rows, the header first.
    Table(Vec<Vec<String>>),
    /// Command line.
    Command(String),
}

impl Topic {
    /// The topic called `name`, in small or capital letters.
    pub fn named(name: &str) -> Option<&'static Self> {
        TOPICS.iter().find(|topic| topic.name.eq_ignore_ascii_case(name))
    }

    /// The title: the text of the first heading.
    pub fn title(&self) -> &'static str {
        self.text.lines().next().unwrap_or_default().trim_start_matches("# ")
    }

    /// The text parsed into blocks.
    pub fn blocks(&self) -> Vec<Block> {
        let mut blocks = Vec::new();
        for line in self.text.lines() {
            let numbered = line.split_once(". ").filter(|(number, _)| number.parse::<u32>().is_ok());
            if let Some(words) = line.strip_prefix("## ") {
                blocks.push(Block::Heading(2, words.to_owned()));
            } else if let Some(words) = line.strip_prefix("# ") {
                blocks.push(Block::Heading(1, words.to_owned()));
            } else if let Some(words) = line.strip_prefix("    ") {
                blocks.push(Block::Command(words.to_owned()));
            } else if let Some(words) = line.strip_prefix("- ") {
                blocks.push(Block::Item("•".to_owned(), words.to_owned()));
            } else if let Some((number, words)) = numbered {
                blocks.push(Block::Item(format!("{number}."), words.to_owned()));
            } else if let Some(row) = line.strip_prefix("| ") {
                let cells: Vec<String> =
                    row.trim_end_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect();
                let is_rule = cells.iter().all(|cell| cell == "---");
                match blocks.last_mut() {
                    _ if is_rule => {}
                    Some(Block::Table(rows)) => rows.push(cells),
                    _ => blocks.push(Block::Table(vec![cells])),
                }
            } else if !line.is_empty() {
                blocks.push(Block::Words(line.to_owned()));
            }
        }
        blocks
    }
}

/// `words` without the markup of menu entries and command lines.
pub fn plain(words: &str) -> String {
    words.replace(['*', '`'], "")
}

/// Splits text into parts; the flag tells whether a part is marked up as a menu entry or as something to type.
pub fn parts(words: &str) -> impl Iterator<Item = (bool, &str)> {
    words.split(['*', '`']).enumerate().map(|(i, part)| (i % 2 == 1, part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_topic_has_a_title_and_no_sign_is_left_open() {
        for topic in TOPICS.iter().chain(GERMAN) {
            assert!(!topic.title().is_empty() && topic.text.starts_with("# "), "{}", topic.name);
            for line in topic.text.lines() {
                assert_eq!(line.matches(['*', '`']).count() % 2, 0, "{}: {line}", topic.name);
                let is_drawn = |c: char| c.is_ascii() || "…›é°äöüÄÖÜß–„“×".contains(c);
                assert!(
                    line.chars().all(is_drawn),
                    "{}: the window's letters lack a sign: {line}",
                    topic.name
                );
            }
        }
        assert_eq!(Topic::named("marks").map(|topic| topic.name), Some("marks"));
    }

    #[test]
    fn the_german_manual_has_the_same_blocks() {
        let kind = |block: &Block| match block {
            Block::Heading(level, _) => format!("heading {level}"),
            Block::Words(_) => "words".to_owned(),
            Block::Item(sign, _) => format!("item {sign}"),
            Block::Table(rows) => format!("table {:?}", rows.iter().map(Vec::len).collect::<Vec<_>>()),
            Block::Command(words) => format!("command {}", words.split("  ").next().unwrap_or_default()),
        };
        for (english, german) in TOPICS.iter().zip(topics_in("de_DE")) {
            let kinds = |topic: &Topic| topic.blocks().iter().map(kind).collect::<Vec<_>>();
            assert_eq!(kinds(english), kinds(german), "{}", english.name);
        }
    }

    #[test]
    fn lines_are_what_they_begin_with() {
        let text = "# A\n\nwords\n- b\n2. c\n| x | y |\n| --- | --- |\n| 1 | |\n    toile\n## B";
        let words = |list: &[&str]| list.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>();
        let expected = [
            Block::Heading(1, "A".to_owned()),
            Block::Words("words".to_owned()),
            Block::Item("•".to_owned(), "b".to_owned()),
            Block::Item("2.".to_owned(), "c".to_owned()),
            Block::Table(vec![words(&["x", "y"]), words(&["1", ""])]),
            Block::Command("toile".to_owned()),
            Block::Heading(2, "B".to_owned()),
        ];
        assert_eq!(Topic { name: "t", text }.blocks(), expected);
        assert_eq!(
            parts("see *Drape* now").collect::<Vec<_>>(),
            [(false, "see "), (true, "Drape"), (false, " now")]
        );
    }
}
