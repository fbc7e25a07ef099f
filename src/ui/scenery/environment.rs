//! Light from all sides out of an environment map.

use crate::geometry::words::{Words, words};
use crate::io::environment;
use crate::render::{ImageLight, MEAN_LIGHT};

/// The light of an environment map, the bytes of an image file: as bright as the studio's, its middle before the body. The error is
/// a message without the file's name.
pub fn light_of(bytes: &[u8]) -> Result<ImageLight, Words> {
    let light = ImageLight::of_image(&environment::read(bytes)?, MEAN_LIGHT);
    light.ok_or_else(|| words!("it is black: no light comes from it"))
}
