//! `toile marker`: the pieces of a pattern laid out on a width of cloth.

use crate::cli::arguments::{InputOptions, Marker};
use crate::cli::failure::Failure;
use crate::cli::{input, output};
use crate::marker::nest::{Effort, Watch};
use crate::marker::{FinishedMarker, MarkerError, MarkerFormat, Order, garments};

/// Makes the marker and writes it.
pub fn marker(arguments: &Marker) -> Result<(), Failure> {
    let Some(format) = format(arguments) else {
        let words = format!("{}: the ending must be .svg, .dxf or .pdf", arguments.output.display());
        return Err(Failure::Usage(words));
    };
    let options = InputOptions { scale: arguments.scale, as_placed: true, ..InputOptions::default() };
    let input = input::load(&arguments.project, &options)?;
    let pattern = &input.project.document.pattern;
    let failure = |error: MarkerError| match error {
        MarkerError::TooMany(_) => Failure::Limit(error.to_string()),
        MarkerError::Number(words) => Failure::Usage(words.into()),
        error => Failure::input(&arguments.project, error),
    };
    let order = Order {
        garments: garments(pattern, &arguments.sizes, &arguments.quantity).map_err(failure)?,
        width: arguments.width,
        gap: arguments.gap,
        nap: arguments.nap,
        tilt: arguments.tilt.to_radians(),
        effort: Effort { seconds: arguments.seconds, seed: arguments.seed },
    };
    let made = FinishedMarker::new(&input.name, pattern, &order, &Watch::default()).map_err(failure)?;
    let bytes = made.file(format, arguments.paper).map_err(|why| Failure::input(&arguments.project, why))?;
    let report = &made.report;
    output::write(&arguments.output, &bytes)?;
    for problem in &report.problems {
        output::complain(&format!("{}: note: {problem}", arguments.project.display()));
    }
    output::say(&if arguments.json {
        serde_json::to_string_pretty(report).map_err(|e| Failure::Internal(e.to_string()))?
    } else {
        report.words().join("\n")
    });
    Ok(())
}

fn format(arguments: &Marker) -> Option<MarkerFormat> {
    MarkerFormat::of_ending(arguments.output.extension()?.to_str()?)
}
