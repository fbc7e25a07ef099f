//! `toile techpack`: what a garment maker needs to know, as PDF.

use crate::cli::arguments::{InputOptions, TechPack};
use crate::cli::failure::Failure;
use crate::cli::fit::Pictures as Drawing;
use crate::cli::{input, interrupt, language, output, run};
use crate::geometry::words::words;
use crate::language::shown_in;
use crate::marker::MarkerError;
use crate::marker::nest::Effort;
use crate::pack::{Pack, Pictures, Source, Wish, write};
use crate::session::{Outfit, Session};

/// Measures, draws and writes the tech pack.
pub fn techpack(arguments: &TechPack) -> Result<(), Failure> {
    if !arguments.output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("pdf")) {
        return Err(Failure::Usage(format!("{}: the ending must be .pdf", arguments.output.display())));
    }
    let table = language::table(&arguments.language)?;
    let options = InputOptions { scale: arguments.scale, as_placed: true, ..InputOptions::default() };
    let input = input::load(&arguments.project, &options)?;
    let session = run::opened(input.project, &arguments.project)?;
    let document = session.document();
    let outfit = Outfit::of(session.snapshot(), &document.fabrics);
    interrupt::check()?;
    let effort = Effort { seconds: arguments.seconds, seed: arguments.seed };
    let wish = Wish { width: arguments.width, nap: arguments.nap, effort };
    let source = Source { name: &input.name, document, outfit: outfit.as_ref() };
    let pack = Pack::of(source, &wish).map_err(|error| match error {
        MarkerError::Number(words) => Failure::Usage(words.into()),
        error => Failure::input(&arguments.project, error),
    })?;
    interrupt::check()?;
    let pictures = pictures(arguments, &session, outfit.is_some())?;
    interrupt::check()?;
    let bytes = shown_in(table, || write(&pack, &document.pattern, &pictures))
        .map_err(|why| Failure::input(&arguments.project, why))?;
    output::write(&arguments.output, &bytes)?;
    for note in &pack.notes {
        output::complain(&format!("{}: note: {note}", arguments.project.display()));
    }
    output::say(&if arguments.json {
        serde_json::to_string_pretty(&pack).map_err(|e| Failure::Internal(e.to_string()))?
    } else {
        pack.words().join("\n")
    });
    Ok(())
}

/// The pictures, or why there are none.
fn pictures(arguments: &TechPack, session: &Session, is_dressed: bool) -> Result<Pictures, Failure> {
    if !is_dressed {
        return Ok(Pictures::LeftOut(words!("it is not dressed")));
    }
    if arguments.no_picture {
        return Ok(Pictures::LeftOut(words!("they were not wanted")));
    }
    let Drawing { artist, left_out } = Drawing::new()?;
    match artist {
        Some(mut artist) => artist.front_and_back(session).map(Pictures::Drawn),
        None => Ok(Pictures::LeftOut(left_out.unwrap_or_default())),
    }
}
