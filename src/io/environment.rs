//! Light from all sides out of an image: equirectangular PNG, JPEG or Radiance HDR files.

use image::{DynamicImage, ImageFormat, Rgb32FImage};

use crate::geometry::words::{Words, words};
use crate::io::materials::decoded;
use crate::io::picture::{decoder, in_words};

/// Largest size of a file, bytes.
pub const MOST_BYTES: usize = 256 << 20;

/// Reads an image of all directions, twice as wide as high: linear RGB, rows from straight above to straight below. PNG and JPEG are
/// taken as sRGB.
///
/// # Errors
/// A message: another format or shape, damaged, larger than [`MOST_BYTES`] or the sides of a picture.
pub fn read(bytes: &[u8]) -> Result<Rgb32FImage, Words> {
    if bytes.len() > MOST_BYTES {
        let (size, most) = (bytes.len() >> 20, MOST_BYTES >> 20);
        return Err(words!(
            "it has {size} MiB, more than the {most} MiB that an environment may have",
            size,
            most
        ));
    }
    let formats = [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Hdr];
    let format = image::guess_format(bytes).ok().filter(|format| formats.contains(format));
    let unknown = || words!("it is neither PNG, JPEG nor Radiance HDR");
    let decoder = decoder(bytes, format.ok_or_else(unknown)?)?;
    let image = DynamicImage::from_decoder(decoder).map_err(in_words)?;
    let (width, height) = (image.width(), image.height());
    if height == 0 || width != 2 * height {
        return Err(words!(
            "it has {width} by {height} pixels; an image of all directions is twice as wide as high (equirectangular)",
            width,
            height
        ));
    }
    let is_linear = matches!(image, DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_));
    let mut image = image.into_rgb32f();
    if !is_linear {
        image.iter_mut().for_each(|c| *c = decoded(*c));
    }
    if image.iter().any(|c| !c.is_finite() || *c < 0.0) {
        return Err(words!("it has a pixel that is no brightness"));
    }
    Ok(image)
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    fn png(width: u32, height: u32) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        let grey = image::RgbImage::from_pixel(width, height, image::Rgb([188, 0, 255]));
        grey.write_to(&mut bytes, ImageFormat::Png).expect("written");
        bytes.into_inner()
    }

    fn hdr(light: f32) -> Vec<u8> {
        let mut bytes = Vec::new();
        let pixels = vec![image::Rgb([light, 2.0 * light, 0.0]); 32];
        image::codecs::hdr::HdrEncoder::new(&mut bytes).encode(&pixels, 8, 4).expect("written");
        bytes
    }

    #[test]
    fn light_is_linear_in_every_format() {
        let image = read(&png(8, 4)).expect("an environment");
        let [r, g, b] = image.get_pixel(3, 2).0;
        assert!((r - 0.503).abs() < 0.002 && g == 0.0 && (b - 1.0).abs() < 1e-6, "{r} {g} {b}");
        let image = read(&hdr(20.0)).expect("an environment");
        let [r, g, b] = image.get_pixel(7, 3).0;
        assert!((r / 20.0 - 1.0).abs() < 0.01 && (g / 40.0 - 1.0).abs() < 0.01 && b < 0.2, "{r} {g} {b}");
    }

    #[test]
    fn what_is_no_environment_is_refused_in_words() {
        let (square, hdr) = (png(8, 8), hdr(1.0));
        // A header that promises more than fits.
        let huge = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 8192\n".to_vec();
        for (bytes, words) in [
            (&b"GIF89a"[..], "neither PNG, JPEG nor Radiance HDR"),
            (&[], "neither PNG, JPEG nor Radiance HDR"),
            (&square, "8 by 8 pixels; an image of all directions is twice as wide as high"),
            (&hdr[..hdr.len() / 2], "it is damaged: "),
            (&huge, "MiB in memory"),
        ] {
            let why = read(bytes).expect_err(words);
            assert!(why.contains(words), "{why:?} has no {words:?}");
        }
    }
}
