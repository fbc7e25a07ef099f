//! Pictures of the dressed garment from the front and from the back, for the tech pack.

use std::sync::Arc;

use glam::{UVec2, Vec3};
use image::RgbaImage;

use crate::pack::Picture;
use crate::render::{Camera, Look, Projection, RenderError, Scene, View};
use crate::session::{Outfit, Session};
use crate::ui::scenery::portrait::{Extras, portrait};
use crate::ui::scenery::scene::Scenery;

/// The views, and what is written below their pictures.
const VIEWS: [(View, &str); 2] = [(View::Front, "Front"), (View::Back, "Back")];
/// Size of a picture, pixels.
const SIZE: UVec2 = UVec2::new(860, 980);

/// The garment of `session` on its body from both sides, at one scale; `draw` gives straight alpha. None where nothing is dressed.
pub fn front_and_back(
    session: &Session,
    scenery: &mut Scenery,
    mut draw: impl FnMut(&Scene, &Camera, &Look, UVec2) -> Result<RgbaImage, RenderError>,
) -> Option<Result<Vec<Picture>, RenderError>> {
    let outfit = Outfit::of(session.snapshot(), &session.document().fabrics)?;
    let scene = portrait(scenery, session, Extras::default());
    let look = Look { cut_out: true, ..Look::light() };
    let cameras = cameras(&scene, &outfit);
    let pictures = VIEWS.iter().zip(cameras).map(|(&(_, title), camera)| {
        draw(&scene, &camera, &look, SIZE).map(|image| Picture { title, image: Arc::new(image) })
    });
    Some(pictures.collect())
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
