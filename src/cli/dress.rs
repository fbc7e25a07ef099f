//! `toile dress`: one project, or several.

use crate::cli::arguments::Dress;
use crate::cli::dress_one::{Done, dress_one};
use crate::cli::failure::Failure;
use crate::cli::{batch, output};

/// Dresses one project, or several as a batch.
pub fn dress(arguments: &Dress) -> Result<(), Failure> {
    let ([project], None) = (&arguments.projects[..], &arguments.list) else {
        return batch::batch(arguments);
    };
    let Done { verdict, report, resumed } = dress_one(project, &arguments.out, arguments)?;
    output::say(&match (arguments.json, resumed) {
        (true, _) => report,
        (false, false) => verdict.summary(),
        (false, true) => format!("{} (done before)", verdict.summary()),
    });
    verdict.failure().map_or(Ok(()), Err)
}
