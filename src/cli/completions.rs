//! `toile completions`: the completions of a shell.

use clap::CommandFactory;

use crate::cli::arguments::{Arguments, Completions};
use crate::cli::failure::Failure;
use crate::cli::output;

/// Prints the completions of the chosen shell.
pub fn completions(arguments: &Completions) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "toile", &mut script);
    let script = String::from_utf8(script).map_err(|e| Failure::Internal(e.to_string()))?;
    output::say(script.trim_end());
    Ok(())
}
