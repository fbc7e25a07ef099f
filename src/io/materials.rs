//! What cloth and body are made of, for files that other programs draw.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DAffine2;

use crate::cloth::TrimPart;
use crate::cloth::trim_parts::{Paint, TrimKind};
use crate::geometry::ids::PieceId;
use crate::io::atlas::Atlas;

/// Roughness of materials that name none.
pub const ROUGHNESS: f32 = 0.9;
/// Roughness of buttons and of the teeth of zips: polished, without being metal.
const POLISHED: f32 = 0.4;

/// Material of a piece.
#[derive(Clone, Debug, PartialEq)]
pub struct ClothMaterial {
    /// Name of the fabric.
    pub name: String,
    /// Base colours of the outer and of the inner side, linear RGB, 0..=1.
    pub sides: [[f32; 3]; 2],
    /// Roughness, 0..=1.
    pub roughness: f32,
    /// Opacity, 0..=1.
    pub opacity: f32,
    /// Textures, as indices of [`Textures::images`]; they replace the base colours.
    pub textures: Option<ClothTextures>,
}

/// Textures of a material, as indices of [`Textures::images`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClothTextures {
    /// Base colours of the outer and of the inner side, in the atlas.
    pub sides: [usize; 2],
    /// Normals in the atlas.
    pub normal: Option<usize>,
    /// Normals of a repeat of the weave.
    pub weave: Option<usize>,
}

/// An image file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextureImage {
    /// Name without ending, unique among the images: "colour", "normal".
    pub name: String,
    /// The PNG file.
    pub png: Arc<Vec<u8>>,
}

/// Images for the pieces of a garment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Textures {
    /// The images.
    pub images: Vec<TextureImage>,
    /// Where the pieces are in them.
    pub atlas: Atlas,
    /// Place in the repeats of its weave, of a point of each piece whose material has one.
    pub weave_from_piece: BTreeMap<PieceId, DAffine2>,
}

/// Base colours, linear RGB, 0..=1, and materials.
#[derive(Clone, Debug, PartialEq)]
pub struct Colours {
    /// Outer side of the cloth.
    pub front: [f32; 3],
    /// Inner side of the cloth.
    pub back: [f32; 3],
    /// Skin of the body.
    pub body: [f32; 3],
    /// Materials of single pieces, in place of `front` and `back`.
    pub pieces: BTreeMap<PieceId, ClothMaterial>,
    /// The images that materials name.
    pub textures: Option<Arc<Textures>>,
}

impl Default for Colours {
    fn default() -> Self {
        Self {
            front: [0.18, 0.42, 0.22],
            back: [0.72, 0.32, 0.38],
            body: [0.5, 0.48, 0.46],
            pieces: BTreeMap::new(),
            textures: None,
        }
    }
}

impl Colours {
    /// The material of `piece`.
    pub fn of(&self, piece: PieceId) -> ClothMaterial {
        self.pieces.get(&piece).cloned().unwrap_or_else(|| ClothMaterial {
            name: "cloth".to_owned(),
            sides: [self.front, self.back],
            roughness: ROUGHNESS,
            opacity: 1.0,
            textures: None,
        })
    }

    /// The material of trims, which are the `number`th of their kind, from 1: "Button", "Stitches 2".
    pub fn of_trim(&self, part: &TrimPart, number: usize) -> ClothMaterial {
        let name = part.kind.name();
        let colour = match part.paint {
            Paint::Colour(colour) => linear(colour),
            Paint::Inside(piece) => self.of(piece).sides[1],
        };
        let roughness = match part.kind {
            TrimKind::Button | TrimKind::ZipTeeth => POLISHED,
            TrimKind::Piping
            | TrimKind::ButtonThread
            | TrimKind::Buttonhole
            | TrimKind::Stitches
            | TrimKind::ZipTape
            | TrimKind::Hem => ROUGHNESS,
        };
        ClothMaterial {
            name: if number > 1 { format!("{name} {number}") } else { name.to_owned() },
            sides: [colour; 2],
            roughness,
            opacity: 1.0,
            textures: None,
        }
    }
}

/// Linear RGB, 0..=1, of an sRGB colour (IEC 61966-2-1).
pub fn linear(colour: [u8; 3]) -> [f32; 3] {
    colour.map(|c| decoded(f32::from(c) / 255.0))
}

/// Linear value of an sRGB one, both 0..=1 (IEC 61966-2-1).
pub(super) fn decoded(c: f32) -> f32 {
    if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}
