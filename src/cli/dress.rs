//! `toile dress`: one project, or several.

use std::path::Path;

use crate::cli::arguments::Dress;
use crate::cli::dress_one::{Done, dress_one};
use crate::cli::failure::Failure;
use crate::cli::graphics::Graphics;
use crate::cli::{batch, output};

/// Dresses one project, or several as a batch.
pub fn dress(arguments: &Dress) -> Result<(), Failure> {
    let ([project], None) = (&arguments.projects[..], &arguments.list) else {
        return batch::batch(arguments);
    };
    let Done { verdict, report, resumed, note } =
        dress_one(project, &arguments.out, arguments, &mut Graphics::default())?;
    output::say(&match (arguments.json, resumed) {
        (true, _) => report,
        (false, false) => verdict.summary(),
        (false, true) => format!("{} (done before)", verdict.summary()),
    });
    match verdict.failure() {
        Some(Failure::Faults { faults, .. }) => {
            let then = note.into_iter().chain([advice(project, verdict.has_marks())]).collect();
            Err(Failure::Faults { faults, then })
        }
        Some(failure) => Err(failure),
        None => {
            note.iter().for_each(|words| output::complain(words));
            Ok(())
        }
    }
}

/// What to do about a garment that is not dressed.
fn advice(project: &Path, has_marks: bool) -> String {
    let project = project.display();
    let change = match has_marks {
        true => "paint the marks near them anew",
        false => "paint marks there or place the pieces otherwise (Shift+B)",
    };
    format!(
        "{project}: what to do: open it (toile {project}); after Dress or Wrap, Problems in the side panel shows the faults; {change}"
    )
}
