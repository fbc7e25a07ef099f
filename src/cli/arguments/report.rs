//! The arguments of tables made of many reports.

use std::path::PathBuf;

use clap::{Args, Subcommand};

/// Tables of what came of many garments
#[derive(Debug, Args)]
pub struct Report {
    #[command(subcommand)]
    pub task: ReportTask,
}

/// What is made of the reports.
#[derive(Debug, Subcommand)]
pub enum ReportTask {
    Merge(Merge),
}

/// Makes one table of the lines that dress --list left in its folders, a row a garment, and prints the share that is dressed
///
/// Reads lines.jsonl and lines-PART-of-OF.jsonl. Of a garment that was dressed several times, the newest line counts. The rows are
/// in the order of folders and names, whatever the shards. Lines that a crash left half written are skipped, and told.
#[derive(Debug, Args)]
pub struct Merge {
    /// Folders that dress --list wrote to
    #[arg(required = true, value_name = "FOLDER")]
    pub folders: Vec<PathBuf>,
    /// The table to write (CSV)
    #[arg(long, value_name = "CSV")]
    pub out: PathBuf,
    /// Adds a column with the path of each garment's picture
    #[arg(long)]
    pub picture: bool,
    /// Prints the summary as JSON
    #[arg(long)]
    pub json: bool,
}
