//! Appearance of a fabric: weave, colours of the threads, and reflection of light.

use serde::{Deserialize, Serialize};

/// Share of a net that its threads cover; the same as in shaders/textile.wgsl.
const NET: f64 = 0.34;

/// Weave, knit or surface of a fabric. The numbers are those of shaders/textile.wgsl.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Weave {
    /// No visible structure.
    #[default]
    Smooth = 0,
    /// Plain weave: warp and weft cross over and under by turns.
    Plain = 1,
    /// Twill 3/1: the warp goes over three threads and under one, each column shifted by one.
    Twill = 2,
    /// Satin of five: the warp goes over four threads and under one, each column shifted by two.
    Satin = 3,
    /// Weft knit: columns of stitches.
    Jersey = 4,
    /// Rib knit: columns of face and back stitches by turns.
    Rib = 5,
    /// Wales of pile along the grain.
    Corduroy = 6,
    /// Hexagonal net.
    Tulle = 7,
    /// Grain of leather.
    Leather = 8,
    /// Fleece: pile without visible threads.
    Fleece = 9,
}

/// The appearance of a fabric.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FabricLook {
    /// Weave or knit.
    pub weave: Weave,
    /// Colour of the outside and the warp, sRGB; None: the colour of the garment's layer.
    pub colour: Option<[u8; 3]>,
    /// Colour of the weft, sRGB; None: as the warp.
    pub weft: Option<[u8; 3]>,
    /// Width of a thread, stitch column, wale or cell, metres, 1e-5..=0.05.
    pub pitch_m: f64,
    /// Height of a thread above the gaps, in pitches, 0..=1.
    pub relief: f64,
    /// Strength of the specular reflection, 0..=1.
    pub gloss: f64,
    /// Roughness of the specular reflection, 0.05..=1.
    pub roughness: f64,
    /// Anisotropy of the specular reflection along the warp, 0..=1.
    pub along: f64,
    /// Strength of the sheen (light scattered by fuzz at grazing angles), 0..=1.
    pub sheen: f64,
    /// Variation of the yarn's lightness, 0..=0.5.
    pub slubs: f64,
    /// Opacity of the threads, 0.05..=1.
    pub cover: f64,
}

impl Default for FabricLook {
    fn default() -> Self {
        Self {
            weave: Weave::Smooth,
            colour: None,
            weft: None,
            pitch_m: 5e-4,
            relief: 0.0,
            gloss: 0.0,
            roughness: 0.8,
            along: 0.0,
            sheen: 0.16,
            slubs: 0.0,
            cover: 1.0,
        }
    }
}

impl FabricLook {
    /// Whether light passes, through threads or between them.
    pub fn is_open(&self) -> bool {
        self.mean_cover() < 1.0
    }

    /// Opacity of the cloth, threads and holes together, 0..=1.
    pub fn mean_cover(&self) -> f64 {
        if self.weave == Weave::Tulle { self.cover * NET } else { self.cover }
    }

    /// The first value out of range, in words.
    pub fn problem(&self) -> Option<String> {
        let Self {
            weave: _,
            colour: _,
            weft: _,
            pitch_m,
            relief,
            gloss,
            roughness,
            along,
            sheen,
            slubs,
            cover,
        } = *self;
        let ranges = [
            ("pitch_m", pitch_m, 1e-5, 0.05),
            ("relief", relief, 0.0, 1.0),
            ("gloss", gloss, 0.0, 1.0),
            ("roughness", roughness, 0.05, 1.0),
            ("along", along, 0.0, 1.0),
            ("sheen", sheen, 0.0, 1.0),
            ("slubs", slubs, 0.0, 0.5),
            ("cover", cover, 0.05, 1.0),
        ];
        let wrong = ranges.into_iter().find(|(_, value, least, most)| !(least..=most).contains(&value));
        wrong.map(|(what, value, least, most)| format!("look {what} is {value}, not within {least}..{most}"))
    }
}
