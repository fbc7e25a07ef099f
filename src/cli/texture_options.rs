//! Command line options of textures.

use clap::Args;

use crate::io::atlas::AtlasLayout;

/// Options of textures.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct TextureOptions {
    /// Width and height in pixels of the textures with colours, prints and pictures, 16 to 8192; 0: colours alone. If left out,
    /// 2048 for .glb, .usda and .usdz, and 0 for .obj, whose texture coordinates then are metres of the pattern
    #[arg(long, value_name = "PIXELS", value_parser = side)]
    pub textures: Option<u32>,
    /// Where the pieces are in the textures: pattern (all in one as they lie on the table; packed where they cover each other),
    /// packed (all in one, as large as fits) or pieces (each fills one of its own)
    #[arg(long, value_name = "pattern|packed|pieces", default_value = "pattern")]
    pub atlas: AtlasLayout,
}

fn side(text: &str) -> Result<u32, String> {
    let side = text.parse().ok().filter(|side| *side == 0 || (16..=8192).contains(side));
    side.ok_or_else(|| format!("{text:?} is neither 0 nor a number of pixels from 16 to 8192"))
}
