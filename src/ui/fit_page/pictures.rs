//! The pictures of the fit report.

use std::sync::Arc;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::{UVec2, Vec3};

use crate::fit::MapKind;
use crate::render::{Camera, Look, Projection, RenderError, Rgb, Scene, View, png};
use crate::session::Outfit;
use crate::ui::fit_page::facts::Facts;
use crate::ui::scenery::map_colours::colours;
use crate::ui::scenery::portrait::worn_scene;
use crate::ui::scenery::scene::Scenery;

/// The views of the garment, in the order of a walk round it, with the width of their pictures in pixels; front and back are
/// wider, as arms are spread sideways. The page's columns have the same proportions.
const SIDES: [(View, &str, u32); 4] = [
    (View::Front, "Front", 640),
    (View::Right, "Right", 300),
    (View::Back, "Back", 640),
    (View::Left, "Left", 300),
];
/// Height of the views, pixels.
const HEIGHT: u32 = 760;
/// Size of a picture of a map, pixels.
const MAP: UVec2 = UVec2::new(600, 600);

/// A picture to be drawn.
#[derive(Debug)]
pub struct Shot {
    /// The map that it shows; None: the garment in its own colours.
    kind: Option<MapKind>,
    colours: Option<Arc<Vec<Rgb>>>,
    view: View,
    side: &'static str,
    /// Size, pixels.
    size: UVec2,
}

/// A drawn picture.
#[derive(Debug)]
pub struct Picture {
    /// The map that it shows; None: the garment in its own colours.
    pub kind: Option<MapKind>,
    /// Name of the view, such as "Front".
    pub side: &'static str,
    /// Size, pixels.
    pub size: UVec2,
    /// The picture as a data URI, for an HTML image.
    pub source: String,
}

/// All pictures of the report, in its order.
pub fn shots(facts: &Facts) -> Vec<Shot> {
    let views = SIDES.map(|(view, side, width)| {
        let size = UVec2::new(width, HEIGHT);
        Shot { kind: None, colours: None, view, side, size }
    });
    let maps = facts.maps.iter().filter(|map| map.map.stats().count > 0).flat_map(|map| {
        let colours = Arc::new(colours(map.map.kind, &map.map.vertices, map.range));
        [0, 2].map(|side| {
            let (view, side, _) = SIDES[side];
            Shot { kind: Some(map.map.kind), colours: Some(Arc::clone(&colours)), view, side, size: MAP }
        })
    });
    views.into_iter().chain(maps).collect()
}

impl Shot {
    /// Draws the picture with `draw`, without a background.
    pub fn picture(
        &self,
        scenery: &mut Scenery,
        outfit: &Outfit,
        draw: impl FnOnce(&Scene, &Camera, &Look, UVec2) -> Result<image::RgbaImage, RenderError>,
    ) -> Result<Picture, RenderError> {
        let scene = worn_scene(scenery, outfit, self.colours.as_ref());
        let look = Look { cut_out: true, ..Look::light() };
        let png = png(&draw(&scene, &self.camera(&scene, outfit), &look, self.size)?)?;
        let source = format!("data:image/png;base64,{}", STANDARD.encode(png));
        Ok(Picture { kind: self.kind, side: self.side, size: self.size, source })
    }

    /// A parallel camera, so that sizes can be compared. Views of the figure have one scale; maps are framed to the cloth.
    fn camera(&self, scene: &Scene, outfit: &Outfit) -> Camera {
        let mut camera = Camera { projection: Projection::Orthographic, ..Camera::default() };
        let aspect = |size: UVec2| size.x as f32 / size.y as f32;
        let points = scene.points();
        camera.look(View::Front);
        camera.frame_points(&points, aspect(UVec2::new(SIDES[0].2, HEIGHT)));
        let (scale, bounds) = (camera.distance, camera.bounds);
        camera.look(self.view);
        if self.colours.is_none() {
            camera.frame_points(&points, aspect(self.size));
            return Camera { distance: camera.distance.max(scale), ..camera };
        }
        let laid = outfit.state.positions.iter().zip(&outfit.state.mapped).filter(|(_, mapped)| **mapped);
        camera.frame_points(&laid.map(|(p, _)| p.as_vec3()).collect::<Vec<Vec3>>(), aspect(self.size));
        // The clipping bounds include the whole body, which is larger than the framed cloth.
        Camera { bounds, ..camera }
    }
}
