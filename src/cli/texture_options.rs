//! Command line options of what is written with dressed cloth: its textures and trims.

use clap::Args;

use crate::io::atlas::AtlasLayout;
use crate::ui::scenery::worn::WornOptions;

/// Options of textures and trims.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct TextureOptions {
    /// Width and height in pixels of the textures with colours, prints and pictures, 16 to 8192; 0: colours alone. If left out,
    /// 2048 for .glb, .usda and .usdz, and 0 for .obj, whose texture coordinates then are metres of the pattern
    #[arg(long, value_name = "PIXELS", value_parser = side)]
    pub textures: Option<u32>,
    /// Where the pieces are in the textures: pattern (all in one as they lie on the table; packed where they cover each other),
    /// packed (all in one, as large as fits) or pieces (each fills one of its own); if left out, pattern
    #[arg(long, value_name = "pattern|packed|pieces")]
    pub atlas: Option<AtlasLayout>,
    /// Leaves buttons, piping, stitches, zips and the layers of hems out: the cloth alone
    #[arg(long)]
    pub no_trims: bool,
}

impl TextureOptions {
    /// Whether any of them is given that would do nothing elsewhere.
    pub fn is_asked(&self) -> bool {
        self.textures.is_some() || self.atlas.is_some() || self.no_trims
    }

    /// What they ask for; textures have `usual` pixels each way where none are given.
    pub fn worn(&self, usual: u32) -> WornOptions {
        let side = self.textures.unwrap_or(usual);
        WornOptions { side, layout: self.atlas.unwrap_or_default(), trims: !self.no_trims }
    }
}

fn side(text: &str) -> Result<u32, String> {
    let side = text.parse().ok().filter(|side| *side == 0 || (16..=8192).contains(side));
    side.ok_or_else(|| format!("{text:?} is neither 0 nor a number of pixels from 16 to 8192"))
}
