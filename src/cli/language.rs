//! The language of pages that people read: those built in, and the tables of files beside the preferences.

use crate::cli::failure::Failure;
use crate::cli::output;
use crate::language::Table;
use crate::ui::language::choice::{FOLDER, Languages};
use crate::ui::preferences::usual_path;

/// The table of the language with `code`, such as "de"; None for English. Fails with a list of all languages where there is none.
pub fn table(code: &str) -> Result<Option<&'static Table>, Failure> {
    let mut languages = Languages::default();
    if let Some(path) = usual_path() {
        for words in languages.read(&path.with_file_name(FOLDER)) {
            output::complain(&words);
        }
    }
    languages.named(code).map_err(Failure::Usage)
}
