//! Which language the window is shown in: the system's, a built-in one, or one of a file beside the preferences.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::geometry::words::{Words, words};
use crate::language::Table;

/// Folder of the tables beside the preferences.
pub const FOLDER: &str = "languages";
/// Code of the language of the texts in the code.
const ENGLISH: &str = "en";
/// Largest size of a table's file, bytes.
const MOST_BYTES: u64 = 4 << 20;

/// The user's choice: the code of a language; None for that of the system.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Language(pub Option<String>);

/// The languages that can be chosen.
#[derive(Debug)]
pub struct Languages {
    /// Locale of the system: "de_DE.UTF-8".
    system: String,
    /// Tables of files, by their codes.
    own: Vec<&'static Table>,
}

impl Default for Languages {
    fn default() -> Self {
        Self { system: ENGLISH.to_owned(), own: Vec::new() }
    }
}

impl Languages {
    /// Takes the locale of the system.
    pub fn take_system(&mut self, locale: String) {
        self.system = locale;
    }

    /// Reads the tables in `folder`, if it is there; returns what is to be told about files that are none. The tables are kept for as
    /// long as the program runs.
    pub fn read(&mut self, folder: &Path) -> Vec<Words> {
        let mut told = Vec::new();
        let Ok(files) = std::fs::read_dir(folder) else { return told };
        let mut paths: Vec<_> = files.flatten().map(|file| file.path()).collect();
        paths.retain(|path| path.extension().is_some_and(|e| e == "json"));
        paths.sort();
        self.own.clear();
        for path in paths {
            match table(&path) {
                Ok(table) => self.own.push(Box::leak(Box::new(table))),
                Err(why) => told.push(Words::plain(path.display().to_string()).and(": ", why)),
            }
        }
        told
    }

    /// Code and name of each language, English first.
    pub fn all(&self) -> Vec<(&str, &str)> {
        let mut all = vec![(ENGLISH, "English")];
        for table in self.tables() {
            if all.iter().all(|(code, _)| *code != table.code) {
                all.push((&table.code, &table.name));
            }
        }
        all
    }

    /// The table of `language`; None for English and for what there is no table of.
    pub fn table(&self, language: &Language) -> Option<&'static Table> {
        let code = language.0.as_deref().unwrap_or(&self.system);
        let exact = self.tables().find(|table| table.code.eq_ignore_ascii_case(code));
        exact.or_else(|| self.tables().find(|table| short(&table.code) == short(code)))
    }

    /// The table of the language with `code`; None for English. The error lists the languages there are.
    pub fn named(&self, code: &str) -> Result<Option<&'static Table>, String> {
        match self.table(&Language(Some(code.to_owned()))) {
            None if short(code) != ENGLISH => {
                let all: Vec<&str> = self.all().into_iter().map(|(code, _)| code).collect();
                Err(format!("there is no language {code:?}; there are {}", all.join(", ")))
            }
            table => Ok(table),
        }
    }

    /// The tables; a file comes before a built-in one of the same code.
    fn tables(&self) -> impl Iterator<Item = &'static Table> {
        self.own.iter().copied().chain(Table::german())
    }
}

/// The language of a locale without its country: "de" of "de_AT.UTF-8".
fn short(code: &str) -> String {
    code.split(['_', '-', '.', '@']).next().unwrap_or_default().to_lowercase()
}

fn table(path: &Path) -> Result<Table, Words> {
    let unread = |e: std::io::Error| Words::plain(e.to_string());
    let size = std::fs::metadata(path).map_err(unread)?.len();
    if size > MOST_BYTES {
        let most = MOST_BYTES >> 20;
        return Err(words!("the file has more than the {most} MiB that a table of texts may have", most));
    }
    Table::read(&std::fs::read(path).map_err(unread)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(languages: &Languages, code: &str) -> Option<String> {
        languages.table(&Language(Some(code.to_owned()))).map(|table| table.name.clone())
    }

    #[test]
    fn other_threads_keep_their_own_language() {
        let mut languages = Languages::default();
        languages.take_system("de_AT".to_owned());
        crate::language::show(languages.table(&Language::default()));
        assert_eq!(crate::language::tr("Undo"), "Rückgängig");
        let elsewhere = std::thread::spawn(|| crate::language::tr("Undo") == "Undo").join();
        assert!(matches!(elsewhere, Ok(true)));
        crate::language::show(None);
    }

    #[test]
    fn the_system_is_followed_and_files_come_first() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut languages = Languages::default();
        assert_eq!(languages.read(&folder.path().join("none")), Vec::<Words>::new());
        assert!(languages.table(&Language::default()).is_none(), "English");
        for locale in ["de", "de_DE.UTF-8", "de-AT", "DE@euro"] {
            languages.take_system(locale.to_owned());
            assert_eq!(
                languages.table(&Language::default()).map(|t| t.name.as_str()),
                Some("Deutsch"),
                "{locale}"
            );
        }
        assert_eq!((chosen(&languages, "en"), chosen(&languages, "C.UTF-8")), (None, None));
        let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("written");
        write("fr.json", r#"{"code": "fr", "name": "Français", "texts": {"Undo": "Annuler"}}"#);
        write("mine.json", r#"{"code": "de", "name": "Mein Deutsch", "texts": {}}"#);
        write("broken.json", "{");
        write("notes.txt", "no table");
        let words = languages.read(folder.path());
        assert!(
            words.len() == 1 && words[0].contains("broken.json: it is no table of texts: EOF"),
            "{words:?}"
        );
        assert_eq!(languages.all(), [("en", "English"), ("fr", "Français"), ("de", "Mein Deutsch")]);
        assert_eq!(chosen(&languages, "fr_CA").as_deref(), Some("Français"));
        let named = |code| languages.named(code).map(|table| table.map(|table| table.code.as_str()));
        assert_eq!([named("en"), named("de_AT"), named("FR")], [Ok(None), Ok(Some("de")), Ok(Some("fr"))]);
        assert_eq!(named("xx"), Err("there is no language \"xx\"; there are en, fr, de".to_owned()));
    }
}
