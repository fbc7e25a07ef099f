//! `toile dress`: one project, or several.

use std::path::Path;

use crate::cli::arguments::Dress;
use crate::cli::dress_one::{Done, dress_one};
use crate::cli::failure::Failure;
use crate::cli::graphics::Graphics;
use crate::cli::verdict::Verdict;
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
            // What was saved shows the faults as it is opened.
            let (open, first): (&Path, &str) = match &arguments.save {
                Some(saved) => (saved, ""),
                None => (project, "after Dress or Wrap, "),
            };
            let advice = format!(
                "{}: what to do: open it (toile {}); {first}Problems in the side panel shows the faults; {}",
                project.display(),
                open.display(),
                remedy(&verdict)
            );
            let then = note.into_iter().chain([advice]).collect();
            Err(Failure::Faults { faults, then })
        }
        Some(failure) => Err(failure),
        None => {
            note.iter().for_each(|words| output::complain(words));
            Ok(())
        }
    }
}

/// What may help a garment that is not dressed.
fn remedy(verdict: &Verdict) -> &'static str {
    match (verdict.is_too_small(), verdict.has_marks()) {
        (true, _) => {
            "no marks help cloth that is too small: cut it larger, or name a smaller body (--body, --sizes)"
        }
        (false, true) => "paint the marks near them anew",
        (false, false) => "paint marks there or place the pieces otherwise (Shift+B)",
    }
}
