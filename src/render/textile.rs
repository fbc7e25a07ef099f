//! Surface of cloth: weave in relief, colours of the threads, and reflection of light.

/// The surface of a cloth, drawn by shaders/textile.wgsl.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Textile {
    /// Kind of weave, knit or grain, as numbered in shaders/textile.wgsl; 0: smooth.
    pub weave: u32,
    /// Colour of the weft, sRGB; None: that of the warp.
    pub second: Option<[u8; 3]>,
    /// Width of a thread, stitch column, ridge or cell, metres, 1e-5..=0.05.
    pub pitch: f32,
    /// Height of a thread above the gaps, in pitches, 0..=1.
    pub relief: f32,
    /// Roughness of the specular reflection, 0.05..=1.
    pub roughness: f32,
    /// Strength of the specular reflection, 0..=1.
    pub gloss: f32,
    /// Anisotropy of the specular reflection along the warp, 0..=1.
    pub along: f32,
    /// Strength of the sheen (light scattered by fuzz at grazing angles), 0..=1.
    pub sheen: f32,
    /// Variation of the yarn's lightness, 0..=0.5.
    pub slubs: f32,
    /// Opacity of the threads, 0.05..=1.
    pub cover: f32,
    /// Opacity of threads and gaps together, 0..=1.
    pub mean_cover: f32,
    /// Kind of print, as numbered in shaders/textile.wgsl; 0: none.
    pub print: u32,
    /// Length of a repeat of the print, metres.
    pub repeat: f32,
    /// Colour of the print, sRGB.
    pub ink: [u8; 3],
}

impl Default for Textile {
    fn default() -> Self {
        Self {
            weave: 0,
            second: None,
            pitch: 5e-4,
            relief: 0.0,
            roughness: 0.8,
            gloss: 0.0,
            along: 0.0,
            sheen: 0.16,
            slubs: 0.0,
            cover: 1.0,
            mean_cover: 1.0,
            print: 0,
            repeat: 0.1,
            ink: [255; 3],
        }
    }
}
