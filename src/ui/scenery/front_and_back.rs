//! Pictures of the dressed garment from the front and from the back, for the tech pack.

use std::sync::Arc;

use glam::{UVec2, Vec3};
use image::RgbaImage;
use image::imageops::crop_imm;

use crate::pack::Picture;
use crate::render::{Camera, Look, Projection, RenderError, Scene, View};
use crate::session::{Outfit, Session};
use crate::ui::scenery::portrait::{Extras, portrait};
use crate::ui::scenery::scene::Scenery;

/// The views, and what is written below their pictures.
const VIEWS: [(View, &str); 2] = [(View::Front, "Front"), (View::Back, "Back")];
/// Size of a picture, pixels.
const SIZE: UVec2 = UVec2::new(860, 980);

/// Pictures of a dressed garment from both sides, at one scale, that are drawn one by one.
#[derive(Debug)]
pub struct FrontAndBack {
    scene: Scene,
    cameras: [Camera; VIEWS.len()],
    /// The pictures drawn so far, in the order of `cameras`.
    images: Vec<RgbaImage>,
}

impl FrontAndBack {
    /// Plans the pictures of the garment of `session` as it is now; None where nothing is dressed.
    pub fn of(session: &Session, scenery: &mut Scenery) -> Option<Self> {
        let outfit = Outfit::of(session.snapshot(), &session.document().fabrics)?;
        let scene = portrait(scenery, session, Extras::default());
        let cameras = cameras(&scene, &outfit);
        Some(Self { scene, cameras, images: Vec::new() })
    }

    /// Number of pictures drawn, and number of all pictures.
    pub fn progress(&self) -> (usize, usize) {
        (self.images.len(), self.cameras.len())
    }

    /// Draws the next picture with `draw`, whose result has straight (not premultiplied) alpha; nothing where all are drawn.
    pub fn draw_next(
        &mut self,
        draw: impl FnOnce(&Scene, &Camera, &Look, UVec2) -> Result<RgbaImage, RenderError>,
    ) -> Result<(), RenderError> {
        let Some(camera) = self.cameras.get(self.images.len()) else { return Ok(()) };
        let look = Look { cut_out: true, ..Look::light() };
        self.images.push(draw(&self.scene, camera, &look, SIZE)?);
        Ok(())
    }

    /// The pictures drawn so far, cropped alike.
    pub fn pictures(&self) -> Vec<Picture> {
        let titles = VIEWS.iter().map(|(_, title)| *title);
        let cropped = cropped(&self.images);
        titles.zip(cropped).map(|(title, image)| Picture { title, image: Arc::new(image) }).collect()
    }
}

/// All images without the edges in which none of them shows anything.
fn cropped(images: &[RgbaImage]) -> Vec<RgbaImage> {
    let shown = || {
        let pixels = images.iter().flat_map(|image| image.enumerate_pixels());
        pixels.filter(|(.., pixel)| pixel.0[3] > 0).map(|(x, y, _)| UVec2::new(x, y))
    };
    let (Some(low), Some(high)) = (shown().reduce(UVec2::min), shown().reduce(UVec2::max)) else {
        return images.to_vec();
    };
    let size = high - low + 1;
    images.iter().map(|image| crop_imm(image, low.x, low.y, size.x, size.y).to_image()).collect()
}

/// Parallel cameras framed to the cloth. The clipping bounds include the whole body, which may be larger.
fn cameras(scene: &Scene, outfit: &Outfit) -> [Camera; 2] {
    let aspect = SIZE.x as f32 / SIZE.y as f32;
    let laid = outfit.state.positions.iter().zip(&outfit.state.mapped).filter(|(_, mapped)| **mapped);
    let cloth: Vec<Vec3> = laid.map(|(p, _)| p.as_vec3()).collect();
    let mut camera = Camera { projection: Projection::Orthographic, ..Camera::default() };
    camera.look(View::Front);
    camera.frame_points(&scene.points(), aspect);
    let bounds = camera.bounds;
    let cameras = VIEWS.map(|(view, _)| {
        let mut own = camera;
        own.look(view);
        own.frame_points(&cloth, aspect);
        Camera { bounds, ..own }
    });
    let distance = cameras.iter().map(|camera| camera.distance).fold(0.0, f32::max);
    cameras.map(|camera| Camera { distance, ..camera })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_that_show_nothing_are_cut_off_alike() {
        let mut one = RgbaImage::new(10, 8);
        let mut other = one.clone();
        one.put_pixel(2, 3, image::Rgba([9, 9, 9, 255]));
        other.put_pixel(6, 4, image::Rgba([9, 9, 9, 1]));
        let cropped = cropped(&[one, other]);
        assert!(cropped.iter().all(|image| image.dimensions() == (5, 2)));
        assert_eq!((cropped[0].get_pixel(0, 0).0[3], cropped[1].get_pixel(4, 1).0[3]), (255, 1));
        assert_eq!(super::cropped(&[RgbaImage::new(3, 2)])[0].dimensions(), (3, 2));
    }
}
