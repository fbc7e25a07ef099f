//! The fit report as one page: what a designer needs to know about a dressed garment. No egui here: the command line writes it
//! too.

mod drawing;
mod facts;
mod html;
mod legend;
mod pictures;
mod tables;
pub(in crate::ui) mod words;

use crate::geometry::words::Words;
use crate::render::{Camera, Look, RenderError, Scene};
use crate::session::Session;
use crate::ui::fit_page::facts::Facts;
use crate::ui::fit_page::pictures::{Picture, Shot};
use crate::ui::scenery::scene::Scenery;
use glam::UVec2;

/// A report in the making: its contents are measured at once, its pictures are drawn one by one.
#[derive(Debug)]
pub struct FitPage {
    facts: Facts,
    shots: Vec<Shot>,
    /// The pictures drawn so far, in the order of `shots`.
    pictures: Vec<Picture>,
    scenery: Scenery,
    left_out: Option<Words>,
}

impl FitPage {
    /// Begins the report on the dressed garment of `session`, called `name`; None while there is none.
    pub fn of(session: &Session, name: &str) -> Option<Self> {
        let facts = Facts::of(session, name)?;
        let shots = pictures::shots(&facts);
        Some(Self { facts, shots, pictures: Vec::new(), scenery: Scenery::default(), left_out: None })
    }

    /// Number of pictures drawn, and number of all pictures.
    pub fn progress(&self) -> (usize, usize) {
        (self.pictures.len(), self.shots.len())
    }

    /// Draws the next picture with `draw`, whose result has straight (not premultiplied) alpha.
    pub fn draw_next(
        &mut self,
        draw: impl FnOnce(&Scene, &Camera, &Look, UVec2) -> Result<image::RgbaImage, RenderError>,
    ) -> Result<(), RenderError> {
        let Some(shot) = self.shots.get(self.pictures.len()) else { return Ok(()) };
        let picture = shot.picture(&mut self.scenery, &self.facts.outfit, draw)?;
        self.pictures.push(picture);
        Ok(())
    }

    /// Leaves all pictures out; the page states `why` in its own language.
    pub fn leave_pictures_out(&mut self, why: Words) {
        self.pictures.clear();
        self.left_out = Some(why);
    }

    /// The self-contained HTML page, in the language that is shown.
    pub fn html(&self) -> String {
        html::page(&self.facts, &self.pictures, self.left_out.as_ref())
    }
}
