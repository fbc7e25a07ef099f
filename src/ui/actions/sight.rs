//! Display options of body and cloth.

use crate::render::{ImageLight, Lens, Light, Look};
use crate::ui::scenery::body_look::BodyLook;

/// Display options of body and cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Draw the edges of the cloth's triangles (wireframe).
    pub wire: bool,
    /// Draw the body half transparent.
    pub sheer: bool,
    /// Let marks, pins and seams show through.
    pub xray: bool,
    /// Draw lines from marks on the pattern to their partners on the body.
    pub pairs: bool,
    /// Light of the surroundings.
    pub light: Light,
    /// Light from all sides out of an environment map, turned as chosen, in place of that of `light`.
    pub environment: Option<ImageLight>,
    /// The lens that blurs what is out of focus; without a focus, each picture focuses it by what its middle shows.
    pub lens: Option<Lens>,
    /// How the body is shown.
    pub body_look: BodyLook,
    /// Draw seams as lines alone, without stitches.
    pub plain_seams: bool,
}

impl Default for Sight {
    fn default() -> Self {
        Self {
            wire: false,
            sheer: false,
            xray: false,
            pairs: true,
            light: Light::Studio,
            environment: None,
            lens: None,
            body_look: BodyLook::Skin,
            plain_seams: false,
        }
    }
}

impl Sight {
    /// `look` with the options of these that the renderer knows.
    pub fn on(self, look: Look) -> Look {
        let Self { wire, sheer, xray, light, environment, lens, pairs: _, body_look: _, plain_seams: _ } =
            self;
        Look { wire, sheer, xray, light, environment, lens, ..look }
    }
}
