//! The arguments of what an installation needs.

use std::path::PathBuf;

use clap::Args;
use clap_complete::Shell;

/// Prints the completions of a shell: commands, options and their values
///
/// bash: toile completions bash > ~/.local/share/bash-completion/completions/toile; zsh: into a file _toile of a folder of
/// $fpath; fish: > ~/.config/fish/completions/toile.fish.
#[derive(Debug, Args)]
pub struct Completions {
    /// The shell
    pub shell: Shell,
}

/// Writes the manual pages: toile.1, and a page for each command
#[derive(Debug, Args)]
pub struct Man {
    /// The folder to write to
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}
