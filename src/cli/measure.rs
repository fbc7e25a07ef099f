//! `toile measure`: body measurements.

use std::path::Path;

use serde::Serialize;

use crate::body::mannequin::{self, Mannequin};
use crate::body::readings::{Reading, readings};
use crate::cli::arguments::Measure;
use crate::cli::failure::Failure;
use crate::cli::files::MANNEQUIN;
use crate::cli::input::{self, Content};
use crate::cli::{files, output};
use crate::session::body::{readings_of, surface_of};

#[derive(Serialize)]
struct Told {
    body: String,
    readings: Vec<Reading>,
}

/// Prints the measurements of a body, in centimetres, or as JSON in metres.
pub fn measure(arguments: &Measure) -> Result<(), Failure> {
    let of_mannequin = |figure: &Mannequin| readings(&figure.mesh, Some(&figure.landmarks));
    let (path, found) = match (&arguments.file, input::sized(&arguments.sized)?) {
        (Some(path), None) if path == Path::new(MANNEQUIN) => (&**path, of_mannequin(&mannequin::default())),
        (Some(path), None) => (&**path, of_file(path, arguments)?),
        (Some(path), Some(_)) => {
            let words = "a file and --sizes: the size is measured on the mannequin, leave the file out";
            return Err(Failure::Usage(format!("{}: {words}", path.display())));
        }
        (None, Some((table, measurements))) => {
            let figure = mannequin::mannequin(&measurements).map_err(|error| Failure::input(table, error))?;
            (table, of_mannequin(&figure))
        }
        (None, None) => return Err(Failure::Usage("name a body, or a size".to_owned())),
    };
    let no_human = "it does not look like a standing human: nothing can be measured on it";
    let readings = found.ok_or_else(|| Failure::input(path, no_human))?;
    if arguments.json {
        let name = arguments.sized.body_size.clone().unwrap_or_else(|| files::name_of(path));
        let told = Told { body: name, readings };
        let text = serde_json::to_string_pretty(&told).map_err(|e| Failure::Internal(e.to_string()))?;
        output::say(&text);
        return Ok(());
    }
    for Reading { name, metres, height, .. } in readings {
        let at = height.map_or(String::new(), |height| format!("   at {:.1} cm", height * 100.0));
        output::say(&format!("{name:<14}{:>8.1} cm{at}", metres * 100.0));
    }
    Ok(())
}

/// The measurements of the body in the file at `path`; None if it is not a standing human.
fn of_file(path: &Path, arguments: &Measure) -> Result<Option<Vec<Reading>>, Failure> {
    Ok(match input::content(path, arguments.body_file, None)? {
        Content::Body(body) if body.is_usable() => readings(&body.mesh, None),
        Content::Body(body) => {
            let words: Vec<&str> = body.problems.iter().map(|p| p.words.as_str()).collect();
            return Err(Failure::input(path, words.join("; ")));
        }
        Content::Project(project) => {
            let surface = surface_of(&project.document.body).map_err(|why| Failure::input(path, why))?;
            readings_of(&project.document.body, &surface.mesh)
        }
        Content::Pattern(_) => return Err(Failure::input(path, "this is a pattern: it has no body")),
    })
}
