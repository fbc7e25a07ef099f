//! The manual: what the program does, topic by topic, in the window and on the command line.
//!
//! The texts are in `assets/manual`, in a few signs of Markdown: `#` and `##` begin headings, `-` and numbers rows of a list,
//! `|` rows of a table, four spaces command lines; `*Menu › Entry* (Keys)` names what can be chosen.

/// A topic.
#[derive(Clone, Copy, Debug)]
pub struct Topic {
    /// What it is asked for by: `toile help NAME`.
    pub name: &'static str,
    /// All of it, the title first.
    pub text: &'static str,
}

macro_rules! topics {
    ($($name:literal),*) => {
        /// In the order in which they are read.
        pub const TOPICS: &[Topic] =
            &[$(Topic { name: $name, text: include_str!(concat!("../../assets/manual/", $name, ".md")) }),*];
    };
}

topics!("start", "pattern", "marks", "dressing", "draping", "bodies", "fitting", "looking", "files", "batch");

/// What a line of a topic is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Block {
    /// How deep it is, from 1, and its words.
    Heading(usize, String),
    /// Words that run on.
    Words(String),
    /// The sign before a row of a list, and its words.
    Item(String, String),
    /// The rows of a table, the heads first.
    Table(Vec<Vec<String>>),
    /// A command line.
    Command(String),
}

impl Topic {
    /// The topic called `name`.
    pub fn named(name: &str) -> Option<&'static Self> {
        TOPICS.iter().find(|topic| topic.name == name)
    }

    /// Its first heading.
    pub fn title(&self) -> &'static str {
        self.text.lines().next().unwrap_or_default().trim_start_matches("# ")
    }

    /// Its lines, each as what it is.
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

/// `words` without the signs round what can be chosen and what is typed.
pub fn plain(words: &str) -> String {
    words.replace(['*', '`'], "")
}

/// Words and whether they name something that can be chosen or typed.
pub fn parts(words: &str) -> impl Iterator<Item = (bool, &str)> {
    words.split(['*', '`']).enumerate().map(|(i, part)| (i % 2 == 1, part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_topic_has_a_title_and_no_sign_is_left_open() {
        for topic in TOPICS {
            assert!(!topic.title().is_empty() && topic.text.starts_with("# "), "{}", topic.name);
            for line in topic.text.lines() {
                assert_eq!(line.matches(['*', '`']).count() % 2, 0, "{}: {line}", topic.name);
                let is_drawn = |c: char| c.is_ascii() || "…›é°".contains(c);
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
