//! Colours and light of a picture.

use super::scene::Rgb;

/// How a picture looks. Colours are sRGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Background at the top.
    pub sky: Rgb,
    /// Background at the bottom.
    pub horizon: Rgb,
    /// Floor.
    pub ground: Rgb,
    /// Lines on the floor, 0..=1.
    pub grid: f32,
    /// Light from everywhere, 0..=1.
    pub ambient: f32,
    /// Light from the lamp above the eye's left shoulder, 0..=1.
    pub key: f32,
    /// How dark the lamp's shadows are, 0..=1.
    pub shadow: f32,
    /// How dark hollows are, 0..=1; 0 skips the passes.
    pub occlusion: f32,
    /// Logical pixels to pixels.
    pub pixels_per_point: f32,
    /// The edges of the triangles of cloth are drawn over it.
    pub wire: bool,
    /// What is no cloth is half transparent.
    pub sheer: bool,
    /// Lines and labels show faintly through what hides them.
    pub xray: bool,
    /// Neither background nor floor: the picture is transparent where nothing is.
    pub cut_out: bool,
}

/// Outside of the cloth: the soft green of paper A's figures.
pub const CLOTH_FRONT: Rgb = [138, 186, 134];
/// Inside of the cloth: pink.
pub const CLOTH_BACK: Rgb = [231, 163, 176];
/// Outsides of what is worn over that, layer by layer; from there on again: lake, straw, heather, slate.
const OVER: [Rgb; 4] = [[128, 166, 200], [218, 190, 128], [182, 152, 192], [150, 158, 166]];
/// The body: warm plaster.
pub const BODY: Rgb = [222, 201, 184];

impl Look {
    /// On a light background.
    pub fn light() -> Self {
        Self {
            sky: [226, 231, 237],
            horizon: [247, 248, 249],
            ground: [226, 228, 232],
            grid: 0.5,
            ambient: 0.48,
            key: 0.84,
            shadow: 0.48,
            occlusion: 0.85,
            pixels_per_point: 1.0,
            wire: false,
            sheer: false,
            xray: false,
            cut_out: false,
        }
    }

    /// On a dark background.
    pub fn dark() -> Self {
        Self { sky: [31, 34, 39], horizon: [52, 56, 62], ground: [62, 66, 72], grid: 0.45, ..Self::light() }
    }
}

impl Default for Look {
    fn default() -> Self {
        Self::light()
    }
}

/// The outside of cloth that is worn on `layer`; 0 lies next to the skin.
pub fn cloth_front(layer: u8) -> Rgb {
    match usize::from(layer) {
        0 => CLOTH_FRONT,
        layer => OVER[(layer - 1) % OVER.len()],
    }
}

/// Colours of numbered marks, told apart in dark and light and by most colour-blind eyes; the numbers tell the rest.
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

/// The colour of mark `number` (from 1), on the cloth and on the body.
pub fn mark_colour(number: usize) -> Rgb {
    MARKS[number.saturating_sub(1) % MARKS.len()]
}
