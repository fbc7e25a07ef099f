//! Colours and light of a picture.

use super::image_light::ImageLight;
use super::lens::Lens;
use super::light::Light;
use super::scene::Rgb;
use super::{Camera, Scene};

/// Colours, light and display options of a picture. Colours are sRGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Background at the top.
    pub sky: Rgb,
    /// Background at the bottom.
    pub horizon: Rgb,
    /// Colour of the floor.
    pub ground: Rgb,
    /// Surroundings; all but the studio have a background and a floor of their own.
    pub light: Light,
    /// Light out of an image: from everywhere in place of that of `light`, and where the image has a sun, that as the lamp.
    pub environment: Option<ImageLight>,
    /// The lens whose depth of field blurs what is out of focus; None: all is sharp. Drafts are always sharp.
    pub lens: Option<Lens>,
    /// Strength of the grid lines on the floor, 0..=1.
    pub grid: f32,
    /// Ambient light, 0..=1.
    pub ambient: f32,
    /// Light of the lamp, which is above and left of the eye unless it is the sun of `environment`, 0..=1.
    pub key: f32,
    /// Darkness of the lamp's shadows, 0..=1.
    pub shadow: f32,
    /// Strength of ambient occlusion, 0..=1; 0 skips its passes.
    pub occlusion: f32,
    /// Physical pixels per logical pixel (egui point).
    pub pixels_per_point: f32,
    /// Drawn pixels along each side of a pixel of the picture that is made of them, at least 1: what is a pixel wide is drawn so
    /// wide. [`FinePicture`](super::FinePicture) sets it.
    pub drawn_per_pixel: f32,
    /// Whether the edges of the cloth's triangles are drawn over it (wireframe).
    pub wire: bool,
    /// Whether everything but cloth is half transparent.
    pub sheer: bool,
    /// Whether lines and labels show faintly through what hides them.
    pub xray: bool,
    /// Whether background and floor are left out, so that the picture is transparent there.
    pub cut_out: bool,
}

/// Front of the cloth: the soft green of paper A's figures.
pub const CLOTH_FRONT: Rgb = [138, 186, 134];
/// Back of the cloth: a pale green, which no skin has.
pub const CLOTH_BACK: Rgb = [196, 213, 194];
/// Fronts of cloth on layers 1, 2, 3 and 4: lake, straw, heather, slate. Further layers repeat them.
const OVER: [Rgb; 4] = [[128, 166, 200], [218, 190, 128], [182, 152, 192], [150, 158, 166]];
/// The body: warm plaster.
pub const BODY: Rgb = [222, 201, 184];

impl Look {
    /// The same with its lens, if it has one, focused on what the middle of a picture of `scene` from `camera` shows; see
    /// [`Lens::focused`].
    pub fn focused(self, camera: &Camera, scene: &Scene) -> Self {
        Self { lens: self.lens.map(|lens| lens.focused(camera, scene)), ..self }
    }

    /// Colours for a light background.
    pub fn light() -> Self {
        Self {
            sky: [226, 231, 237],
            horizon: [247, 248, 249],
            ground: [226, 228, 232],
            light: Light::Studio,
            environment: None,
            lens: None,
            grid: 0.5,
            ambient: 0.48,
            key: 0.84,
            shadow: 0.48,
            occlusion: 0.85,
            pixels_per_point: 1.0,
            drawn_per_pixel: 1.0,
            wire: false,
            sheer: false,
            xray: false,
            cut_out: false,
        }
    }

    /// Colours for a dark background.
    pub fn dark() -> Self {
        Self { sky: [31, 34, 39], horizon: [52, 56, 62], ground: [62, 66, 72], grid: 0.45, ..Self::light() }
    }

    /// Colours for a black background.
    pub fn high_contrast() -> Self {
        Self { sky: [0, 0, 0], horizon: [14, 14, 14], ground: [40, 40, 40], grid: 0.9, ..Self::light() }
    }
}

impl Default for Look {
    fn default() -> Self {
        Self::light()
    }
}

/// Front colour of cloth on `layer`; layer 0 is next to the skin.
pub fn cloth_front(layer: u8) -> Rgb {
    match usize::from(layer) {
        0 => CLOTH_FRONT,
        layer => OVER[(layer - 1) % OVER.len()],
    }
}

/// Colours of numbered marks, different in dark and light mode and for most colour-blind people; beyond ten they repeat and only
/// the numbers differ.
const MARKS: [Rgb; 10] = [
    [200, 50, 52],
    [31, 98, 190],
    [226, 130, 20],
    [121, 60, 168],
    [0, 132, 137],
    [176, 38, 120],
    [110, 84, 38],
    [70, 76, 86],
    [84, 114, 16],
    [60, 70, 200],
];

/// Colour of the mark `number` (from 1), on the cloth and on the body.
pub fn mark_colour(number: usize) -> Rgb {
    MARKS[number.saturating_sub(1) % MARKS.len()]
}
