//! `toile render`: draws a project as it is.

use std::path::PathBuf;

use crate::cli::arguments::{PictureOptions, Render};
use crate::cli::failure::Failure;
use crate::cli::picture::{Artist, environment};
use crate::cli::{input, interrupt, output, run};
use crate::render::View;
use crate::ui::scenery::portrait::{numbered, turned};

/// Draws one picture, or those of a full turn.
pub fn render(arguments: &Render) -> Result<(), Failure> {
    let rotation = arguments.environment_rotation.unwrap_or_default().to_radians();
    let environment = arguments.environment.as_deref().map(environment).transpose()?;
    let environment = environment.map(|light| light.turned(rotation));
    let input = input::load(&arguments.project, &arguments.input)?;
    let mut session = run::opened(input.project, &arguments.project)?;
    run::choose_cloth(&mut session, &arguments.cloth)?;
    let mut artist = Artist::new()?.lit_by(environment);
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
    let picture = |i: u32| (numbered(&arguments.output, i, count), turned(arguments.picture.view, i, count));
    (0..count).map(picture).collect()
}
