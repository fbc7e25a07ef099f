//! Pictures without a window.

use std::path::Path;
use std::sync::Arc;

use glam::UVec2;
use image::RgbaImage;

use crate::cli::arguments::PictureOptions;
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::cli::interrupt;
use crate::pack::Picture;
use crate::render::{
    Fineness, ImageLight, Legend, Lens, Look, RenderError, Rgb, Studio, View, framed, png, straightened,
};
use crate::session::{Outfit, Session};
use crate::ui::fit_page::FitPage;
use crate::ui::scenery::environment::light_of;
use crate::ui::scenery::front_and_back::FrontAndBack;
use crate::ui::scenery::portrait::{Extras, portrait, worn_scene};
use crate::ui::scenery::scene::Scenery;

/// Draws sessions and maps; opens the graphics adapter once.
pub struct Artist {
    studio: Studio,
    scenery: Scenery,
    /// Light from all sides; None: that of the options.
    environment: Option<ImageLight>,
    /// The lens that blurs what is out of focus.
    lens: Option<Lens>,
}

impl Artist {
    /// Opens the best graphics adapter available.
    pub fn new() -> Result<Self, Failure> {
        let studio = Studio::new().map_err(failure)?;
        Ok(Self { studio, scenery: Scenery::default(), environment: None, lens: None })
    }

    /// The same with this light from all sides in [`Artist::png`].
    pub fn lit_by(self, environment: Option<ImageLight>) -> Self {
        Self { environment, ..self }
    }

    /// The same with this lens in [`Artist::png`]; without a focus of its own it is focused by the middle of each picture.
    pub fn through(self, lens: Option<Lens>) -> Self {
        Self { lens, ..self }
    }

    /// Draws the cloth of `outfit` on its body, with a colour for each vertex and `legend`.
    pub fn coloured(
        &mut self,
        outfit: &Outfit,
        colours: &[Rgb],
        legend: &Legend,
        view: View,
        size: [u32; 2],
    ) -> Result<RgbaImage, Failure> {
        let scene = worn_scene(&mut self.scenery, outfit, Some(&Arc::new(colours.to_vec())));
        let size = UVec2::from_array(size);
        let mut picture = self.studio.picture(&scene, view, &Look::light(), size).map_err(failure)?;
        legend.burn(&mut picture);
        Ok(picture)
    }

    /// Draws all pictures of `page`.
    pub fn page(&mut self, page: &mut FitPage) -> Result<(), Failure> {
        while page.progress().0 < page.progress().1 {
            interrupt::check()?;
            page.draw_next(|scene, camera, look, size| {
                self.studio.draw(scene, camera, look, size).map(straightened)
            })
            .map_err(failure)?;
        }
        Ok(())
    }

    /// Draws the dressed garment of `session` from the front and from the back; nothing where there is none.
    pub fn front_and_back(&mut self, session: &Session) -> Result<Vec<Picture>, Failure> {
        let Some(mut drawing) = FrontAndBack::of(session, &mut self.scenery) else { return Ok(Vec::new()) };
        while drawing.progress().0 < drawing.progress().1 {
            interrupt::check()?;
            drawing
                .draw_next(|scene, camera, look, size| {
                    self.studio.draw(scene, camera, look, size).map(straightened)
                })
                .map_err(failure)?;
        }
        Ok(drawing.pictures())
    }

    /// Draws the body, the cloth and, where there is no cloth yet, the marks of `session`, as PNG.
    pub fn png(&mut self, session: &Session, options: &PictureOptions) -> Result<Vec<u8>, Failure> {
        let extras = Extras {
            pins: true,
            body_look: options.body_look,
            plain_seams: options.plain_seams,
            ..Extras::default()
        };
        let scene = portrait(&mut self.scenery, session, extras);
        let size = UVec2::from_array(options.size);
        let look = Look {
            cut_out: options.transparent,
            light: options.light,
            environment: self.environment,
            lens: self.lens,
            ..Look::light()
        };
        let camera = framed(&scene, options.view, size);
        let look = look.focused(&camera, &scene);
        let fineness = Fineness::new(options.supersample);
        let mut picture = self.studio.fine(scene, camera, &look, size, fineness).map_err(failure)?;
        while !picture.is_done() {
            interrupt::check()?;
            self.studio.go_on(&mut picture).map_err(failure)?;
        }
        png(&picture.finish()).map_err(failure)
    }
}

/// Light from all sides out of the image at `path`, as bright as the studio's.
pub fn environment(path: &Path) -> Result<ImageLight, Failure> {
    light_of(&files::read(path)?).map_err(|words| Failure::input(path, words))
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
        | RenderError::NoDepthOfField(_)
        | RenderError::Device(_) => Failure::Graphics(words),
    }
}
