//! `toile man`: the manual pages.

use std::path::{Path, PathBuf};

use clap::{Command, CommandFactory};

use crate::cli::arguments::{Arguments, Man};
use crate::cli::failure::Failure;
use crate::cli::output;

/// Writes a page for the program and for each of its commands.
pub fn man(arguments: &Man) -> Result<(), Failure> {
    let mut program = Arguments::command();
    program.build();
    let mut files = Vec::new();
    pages(&program, &arguments.out, &mut files)?;
    output::make_folder(&arguments.out)?;
    output::write_together(&files)?;
    output::say(&format!("{} pages: {}", files.len(), arguments.out.display()));
    Ok(())
}

/// Adds the page of `command` to `files`, then those of its subcommands.
fn pages(command: &Command, folder: &Path, files: &mut Vec<(PathBuf, Vec<u8>)>) -> Result<(), Failure> {
    let source = format!("toile {}", env!("CARGO_PKG_VERSION"));
    let page = clap_mangen::Man::new(command.clone()).source(source).manual("Toile");
    let mut text = Vec::new();
    page.render(&mut text).map_err(|e| Failure::Internal(e.to_string()))?;
    files.push((folder.join(page.get_filename()), text));
    let mut inner = command.get_subcommands().filter(|inner| !inner.is_hide_set());
    inner.try_for_each(|inner| pages(inner, folder, files))
}
