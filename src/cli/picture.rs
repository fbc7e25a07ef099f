//! Pictures without a window.

use glam::UVec2;

use crate::cli::arguments::PictureOptions;
use crate::cli::failure::Failure;
use crate::render::{Look, RenderError, Studio, png};
use crate::session::Session;
use crate::ui::scene::{Scenery, Shown};

/// Draws sessions; opens the graphics adapter once.
pub struct Artist {
    studio: Studio,
    scenery: Scenery,
}

impl Artist {
    /// Opens the best graphics adapter there is.
    pub fn new() -> Result<Self, Failure> {
        Ok(Self { studio: Studio::new().map_err(failure)?, scenery: Scenery::default() })
    }

    /// The body, the cloth and, where there is no cloth yet, the marks of `session` as a PNG.
    pub fn png(&mut self, session: &Session, options: &PictureOptions) -> Result<Vec<u8>, Failure> {
        let snapshot = session.snapshot();
        let dressed = snapshot.is_dressed();
        let shown = Shown {
            body: snapshot.body.as_ref().filter(|_| dressed).or(session.surface()),
            cloth: snapshot.drawn().filter(|_| dressed),
            marks: (!dressed).then_some(&session.document().marks),
            pinned: &snapshot.pinned,
            ..Shown::default()
        };
        let scene = self.scenery.scene(&shown);
        let size = UVec2::from_array(options.size);
        let picture = self.studio.picture(&scene, options.view, &Look::light(), size).map_err(failure)?;
        png(&picture).map_err(failure)
    }
}

fn failure(error: RenderError) -> Failure {
    let words = error.to_string();
    match error {
        RenderError::TooLarge { .. } => Failure::Limit(words),
        RenderError::UnknownView(_) => Failure::Usage(words),
        RenderError::Encode(_) => Failure::Internal(words),
        RenderError::NoAdapter(_)
        | RenderError::NoDevice { .. }
        | RenderError::Timeout(_)
        | RenderError::Device(_) => Failure::Graphics(words),
    }
}
