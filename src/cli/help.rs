//! `toile help`: prints the manual.

use clap::CommandFactory;

use crate::cli::arguments::{Arguments, Help};
use crate::cli::failure::Failure;
use crate::cli::output;
use crate::manual::{Block, TOPICS, Topic, plain};
use crate::ui::actions::Action;
use crate::ui::actions::keymap::written;
use crate::ui::actions::rows::all;

/// Width of lines, characters.
const WIDTH: usize = 100;
/// The topic that lists the menu entries and keys of the window.
const KEYS: &str = "keys";

/// Prints a topic or the options of a command; without a name, the list of topics.
pub fn help(arguments: &Help) -> Result<(), Failure> {
    let Some(name) = &arguments.topic else {
        output::say(&list());
        return Ok(());
    };
    if let Some(topic) = Topic::named(name) {
        output::say(&text(topic));
        return Ok(());
    }
    if name == KEYS {
        output::say(&keys());
        return Ok(());
    }
    let mut command = Arguments::command();
    let Some(command) = command.find_subcommand_mut(name) else {
        let names: Vec<&str> = TOPICS.iter().map(|topic| topic.name).collect();
        return Err(Failure::Usage(format!(
            "there is no topic {name:?}; there are {}, {KEYS}, and the commands that --help lists",
            names.join(", ")
        )));
    };
    output::say(command.render_long_help().to_string().trim_end());
    Ok(())
}

fn list() -> String {
    let topics = TOPICS.iter().map(|topic| (topic.name, topic.title()));
    let topics = topics.chain([(KEYS, "Everything that can be chosen in the window, with its keys")]);
    let rows: String = topics.map(|(name, title)| format!("  {name:<10} {title}\n")).collect();
    format!(
        "Topics:\n{rows}\ntoile help TOPIC tells about one, toile help COMMAND or toile COMMAND --help about the options of a command."
    )
}

/// All menu entries of the window with their keys, menu by menu.
fn keys() -> String {
    let mut rows: Vec<_> = all().map(Action::row).collect();
    rows.sort_by_key(|row| row.menu);
    let mut text = String::new();
    for (i, row) in rows.iter().enumerate() {
        if i == 0 || rows[i - 1].menu != row.menu {
            text += &format!("{}{}\n", if i == 0 { "" } else { "\n" }, row.menu);
        }
        let keys: Vec<String> = row.keys.iter().map(|keys| written(*keys)).collect();
        let name =
            if keys.is_empty() { row.text.to_owned() } else { format!("{} ({})", row.text, keys.join(", ")) };
        text += &format!("  {}", wrapped(&format!("{name}: {}", row.tip), 6));
    }
    text.trim_end().to_owned()
}

fn text(topic: &Topic) -> String {
    let (mut text, mut was_command) = (String::new(), false);
    for block in topic.blocks() {
        let is_command = matches!(block, Block::Command(_));
        if !(text.is_empty() || (is_command && was_command)) {
            text.push('\n');
        }
        was_command = is_command;
        match block {
            Block::Heading(depth, words) => {
                let line = if depth == 1 { "=" } else { "-" };
                text += &format!("{words}\n{}\n", line.repeat(words.chars().count()));
            }
            Block::Words(words) => text += &wrapped(&plain(&words), 0),
            Block::Item(sign, words) => {
                text += &wrapped(&format!("{sign} {}", plain(&words)), sign.chars().count() + 1)
            }
            Block::Command(words) => text += &format!("    {words}\n"),
            Block::Table(rows) => text += &table(&rows),
        }
    }
    text.trim_end().to_owned()
}

/// `words` broken into lines; all but the first are indented by `inset` columns.
fn wrapped(words: &str, inset: usize) -> String {
    let (mut lines, mut column) = (String::new(), 0);
    for word in words.split(' ') {
        let length = word.chars().count();
        if column > 0 && column + 1 + length > WIDTH {
            lines += &format!("\n{}", " ".repeat(inset));
            column = inset;
        } else if column > 0 {
            lines.push(' ');
            column += 1;
        }
        lines += word;
        column += length;
    }
    lines + "\n"
}

/// A table with aligned first column; the other cells follow it.
fn table(rows: &[Vec<String>]) -> String {
    let first = rows.iter().map(|row| row[0].chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for (i, row) in rows.iter().enumerate() {
        let rest = row[1..].iter().enumerate().filter(|(_, cell)| !cell.is_empty());
        let rest: Vec<String> = match (i, row.len()) {
            (0, _) | (_, 2) => rest.map(|(_, cell)| plain(cell)).collect(),
            _ => rest.map(|(k, cell)| format!("{}: {}", rows[0][k + 1], plain(cell))).collect(),
        };
        if i > 0 {
            text += &wrapped(&format!("{:<first$}  {}", plain(&row[0]), rest.join("; ")), first + 2);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    /// Command lines of the manual and of the README.
    fn command_lines() -> Vec<String> {
        let in_manual = TOPICS.iter().flat_map(|topic| topic.blocks());
        let in_manual = in_manual.filter_map(|block| match block {
            Block::Command(line) => Some(line),
            _ => None,
        });
        let in_readme = include_str!("../../README.md")
            .lines()
            .filter(|line| line.starts_with("toile "))
            .map(str::to_owned);
        in_manual.chain(in_readme).collect()
    }

    #[test]
    fn every_command_line_of_the_manual_can_be_typed() {
        let lines = command_lines();
        assert!(lines.len() > 30, "{} lines", lines.len());
        for line in lines {
            // Of what pipes into the program, its own words, with a number where others put one.
            let own = line.find("toile ").map_or(line.as_str(), |at| &line[at..]).replace("{}", "1");
            let words = own.split(" #").next().unwrap_or_default().split_whitespace();
            if let Err(error) = Arguments::try_parse_from(words) {
                panic!("{line}: {error}");
            }
        }
    }

    #[test]
    fn options_in_the_words_of_the_manual_are_there() {
        let known = |option: &str| {
            let mut command = Arguments::command();
            command.build();
            let tasks = command.get_subcommands().flat_map(|task| task.get_subcommands().chain([task]));
            let all = tasks.flat_map(|task| task.get_arguments());
            all.filter_map(clap::Arg::get_long).any(|long| long == option)
        };
        for topic in TOPICS {
            for (at, _) in topic.text.match_indices("`--") {
                let option: String =
                    topic.text[at + 3..].chars().take_while(|c| c.is_alphanumeric() || *c == '-').collect();
                assert!(known(&option), "{}: --{option}", topic.name);
            }
        }
    }

    #[test]
    fn each_topic_is_a_page_of_short_lines() {
        for topic in TOPICS {
            let page = text(topic);
            assert!(
                page.lines().all(|line| line.starts_with("    ") || line.chars().count() <= WIDTH),
                "{page}"
            );
            let is_typed = |line: &&str| line.starts_with("    ");
            assert!(!page.contains(['*', '`']), "{page}");
            assert!(!page.lines().filter(|line| !is_typed(line)).any(|line| line.contains('|')), "{page}");
        }
    }
}
