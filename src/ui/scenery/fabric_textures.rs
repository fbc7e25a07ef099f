//! Textures of a garment's fabrics for export: base colours and normals in an atlas of its pieces, weaves as tiles. Without egui,
//! so that the command line uses it too.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::sync::Arc;

use glam::{DAffine2, DMat2, DVec2, Mat2, Vec2};
use image::{ImageFormat, RgbImage};

use crate::cloth::Garment;
use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, words};
use crate::io::atlas::{Atlas, AtlasLayout, AtlasPlace};
use crate::io::materials::{ClothMaterial, ClothTextures, Colours, TextureImage, Textures};
use crate::pattern::Pattern;
use crate::render::bake::{self, Chart, Side};
use crate::render::{CLOTH_BACK, Textile, cloth_front};
use crate::session::Document;
use crate::ui::scenery::fabric_looks::{PieceLook, looks_of, material_of};
use crate::ui::scenery::pictures::cloth_from_piece;

/// Default width and height of a texture, pixels.
pub const USUAL_SIDE: u32 = 2048;
/// Texels a side in which it is tested whether pieces cover each other on the table.
const TEST_SIDE: u32 = 512;

/// How relief is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relief {
    /// As a small texture of each weave that is repeated all over the cloth: fine from near.
    Tiles,
    /// In the atlas, for formats that know one set of texture coordinates. Threads smaller than a texel are lost.
    Atlas,
}

/// What textures are made.
#[derive(Clone, Copy, Debug)]
pub struct TextureOptions {
    /// Width and height of a texture, pixels.
    pub side: u32,
    /// Where the pieces are in it.
    pub layout: AtlasLayout,
    /// How relief is written.
    pub relief: Relief,
    /// Whether the inner side has base colours of its own, for formats that know sides of a surface.
    pub inside: bool,
}

/// Materials with textures of the pieces of `garment`, cut from `pattern`, with the fabrics of `document`. Pieces that cover each
/// other on the table are packed.
///
/// # Errors
/// In words: a texture that cannot be encoded.
pub fn textured(
    garment: &Garment,
    pattern: &Pattern,
    document: &Document,
    options: TextureOptions,
) -> Result<Colours, Words> {
    let looks = looks_of(document);
    let look = |piece: PieceId| looks.get(&piece).cloned().unwrap_or_default();
    let mut atlas = Atlas::new(garment, pattern, options.layout);
    let mut charts = charts(garment, &atlas, &look);
    if options.layout == AtlasLayout::Pattern && bake::overlap(&all(&charts), TEST_SIDE) {
        atlas = Atlas::new(garment, pattern, AtlasLayout::Packed);
        charts = self::charts(garment, &atlas, &look);
    }
    let mut images = Images::default();
    let mut textures: Vec<([usize; 2], Option<usize>)> = Vec::new();
    for texture in 0..atlas.textures() {
        let own: Vec<Chart> =
            charts.iter().filter(|(_, at, _)| *at == texture).map(|(_, _, chart)| chart.clone()).collect();
        let ending = if texture > 0 { format!("-{}", texture + 1) } else { String::new() };
        let mut add = |side, name: &str| {
            images.add(format!("{name}{ending}"), &bake::base_colour(&own, side, options.side))
        };
        let outside = add(Side::Outside, "colour")?;
        let inside = if options.inside { add(Side::Inside, "inside")? } else { outside };
        let normal = match options.relief {
            Relief::Tiles => None,
            Relief::Atlas => Some(images.add(format!("normal{ending}"), &bake::normals(&own, options.side))?),
        };
        textures.push(([outside, inside], normal));
    }
    let mut pieces = BTreeMap::new();
    let mut weave_from_piece = BTreeMap::new();
    for (&piece, place) in &atlas.places {
        let look = look(piece);
        let weave = match options.relief {
            Relief::Tiles => images.weave(&look.textile)?,
            Relief::Atlas => None,
        };
        if let Some((_, size)) = weave {
            weave_from_piece.insert(piece, weave_from(look.grain, size));
        }
        let (sides, normal) = textures[place.texture];
        let maps = ClothTextures { sides, normal, weave: weave.map(|(image, _)| image) };
        let material = material_of(document, piece, &look, sides_of(garment, piece, &look));
        pieces.insert(piece, ClothMaterial { textures: Some(maps), ..material });
    }
    let textures = Textures { images: images.written, atlas, weave_from_piece };
    Ok(Colours { pieces, textures: Some(Arc::new(textures)), ..Colours::default() })
}

/// Colours of both sides of `piece`: those of its look, else of its layer.
fn sides_of(garment: &Garment, piece: PieceId, look: &PieceLook) -> [[u8; 3]; 2] {
    look.colours.unwrap_or([cloth_front(garment.layer(piece)), CLOTH_BACK])
}

/// Place in repeats of a weave, of a point of a piece.
fn weave_from(grain: DVec2, size: Vec2) -> DAffine2 {
    DAffine2::from_scale(size.as_dvec2().recip()) * DAffine2::from_mat2(cloth_from_piece(grain))
}

/// A chart of each piece in `atlas`, and its texture.
fn charts(
    garment: &Garment,
    atlas: &Atlas,
    look: &impl Fn(PieceId) -> PieceLook,
) -> Vec<(PieceId, usize, Chart)> {
    let chart = |(&piece, place): (&PieceId, &AtlasPlace)| {
        let look = look(piece);
        let own = (0..garment.triangles.len()).filter(|&t| garment.triangle_pieces[t] == piece);
        let uv = |c: u32| atlas.uv(piece, garment.corners[c as usize].uv).as_vec2();
        let flat_from_uv = DAffine2::from_mat2(cloth_from_piece(look.grain)) * place.uv_from_piece.inverse();
        let DMat2 { x_axis, y_axis } = flat_from_uv.matrix2;
        let chart = Chart {
            triangles: own.map(|t| garment.triangle_corners[t].map(uv)).collect(),
            flat_from_uv: (
                Mat2::from_cols(x_axis.as_vec2(), y_axis.as_vec2()),
                flat_from_uv.translation.as_vec2(),
            ),
            sides: sides_of(garment, piece, &look),
            textile: look.textile,
            decals: Arc::clone(&look.decals),
        };
        (piece, place.texture, chart)
    };
    atlas.places.iter().map(chart).collect()
}

fn all(charts: &[(PieceId, usize, Chart)]) -> Vec<Chart> {
    charts.iter().map(|(_, _, chart)| chart.clone()).collect()
}

/// Images that are written, and the weaves among them.
#[derive(Default)]
struct Images {
    written: Vec<TextureImage>,
    weaves: Vec<(Textile, usize, Vec2)>,
}

impl Images {
    fn add(&mut self, name: String, image: &RgbImage) -> Result<usize, Words> {
        let mut bytes = Cursor::new(Vec::new());
        let written = image.write_to(&mut bytes, ImageFormat::Png);
        written.map_err(|why| {
            words!("the texture {name} cannot be encoded: {why}", name, why = why.to_string())
        })?;
        self.written.push(TextureImage { name, png: Arc::new(bytes.into_inner()) });
        Ok(self.written.len() - 1)
    }

    /// The tile of the weave of `textile` and its size in metres.
    fn weave(&mut self, textile: &Textile) -> Result<Option<(usize, Vec2)>, Words> {
        let is_alike = |other: &Textile| {
            (other.weave, other.pitch, other.relief) == (textile.weave, textile.pitch, textile.relief)
        };
        if let Some((_, image, size)) = self.weaves.iter().find(|(other, ..)| is_alike(other)) {
            return Ok(Some((*image, *size)));
        }
        let Some((tile, size)) = bake::weave(textile) else { return Ok(None) };
        let image = self.add(format!("weave-{}", self.weaves.len() + 1), &tile)?;
        self.weaves.push((*textile, image, size));
        Ok(Some((image, size)))
    }
}
