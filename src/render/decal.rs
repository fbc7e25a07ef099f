//! Pictures on cloth: repeated all over it, or at one place.

use std::sync::Arc;

use glam::{Mat2, Vec2};
use image::RgbaImage;

/// Most pictures on one mesh.
pub const MOST_DECALS: usize = 25;

/// A picture on the flat cloth.
#[derive(Clone, Debug)]
pub struct Decal {
    /// The picture: sRGB, straight alpha, rows from the top. Shared, so that it is uploaded once.
    pub picture: Arc<RgbaImage>,
    /// The place in the picture, 0..1 from its lower left corner, of a place in the flat cloth (metres): a matrix and a
    /// translation.
    pub picture_from_flat: (Mat2, Vec2),
    /// Whether it is repeated all over the cloth and seen on both sides; else it is at one place of the outside.
    pub repeats: bool,
}

impl PartialEq for Decal {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.picture, &other.picture)
            && self.picture_from_flat == other.picture_from_flat
            && self.repeats == other.repeats
    }
}

/// The different pictures of `decals`, and for each decal the index of its own.
pub(super) fn pictures(decals: &[Decal]) -> (Vec<Arc<RgbaImage>>, Vec<usize>) {
    let mut pictures: Vec<Arc<RgbaImage>> = Vec::new();
    let index = |decal: &Decal| {
        let known = pictures.iter().position(|picture| Arc::ptr_eq(picture, &decal.picture));
        known.unwrap_or_else(|| {
            pictures.push(Arc::clone(&decal.picture));
            pictures.len() - 1
        })
    };
    let indices = decals.iter().map(index).collect();
    (pictures, indices)
}
