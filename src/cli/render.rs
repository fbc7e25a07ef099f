//! `toile render`: a picture of a project as it is.

use std::path::{Path, PathBuf};

use crate::cli::arguments::{PictureOptions, Render};
use crate::cli::failure::Failure;
use crate::cli::picture::Artist;
use crate::cli::{input, interrupt, output, run};
use crate::render::View;

/// One picture, or a full turn of them.
pub fn render(arguments: &Render) -> Result<(), Failure> {
    let input = input::load(&arguments.project, &arguments.input)?;
    let session = run::opened(input.project, &arguments.project)?;
    let mut artist = Artist::new()?;
    for (path, view) in pictures(arguments) {
        interrupt::check()?;
        let png = artist.png(&session, &PictureOptions { view, ..arguments.picture })?;
        output::write(&path, &png)?;
    }
    Ok(())
}

fn pictures(arguments: &Render) -> Vec<(PathBuf, View)> {
    let Some(count) = arguments.turntable else {
        return vec![(arguments.output.clone(), arguments.picture.view)];
    };
    let (yaw, pitch) = arguments.picture.view.angles();
    let digits = (count - 1).to_string().len().max(2);
    let picture = |i: u32| {
        let turned = yaw.to_degrees() + 360.0 * i as f32 / count as f32;
        let view = View::Angles { yaw: turned, pitch: pitch.to_degrees() };
        (numbered(&arguments.output, i, digits), view)
    };
    (0..count).map(picture).collect()
}

/// "a/b.png" becomes "a/b-07.png".
fn numbered(path: &Path, i: u32, digits: usize) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{i:0digits$}"));
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}
