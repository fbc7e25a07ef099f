//! Pictures from PNG and JPEG files, for cloth.

use std::io::Cursor;

use crate::geometry::words::{Words, words};
use crate::io::words::readable;
use image::{ImageDecoder, ImageFormat, ImageReader, Limits, RgbaImage};

/// Largest size of a picture file, bytes.
pub const MOST_BYTES: usize = 32 << 20;
/// Largest width and height, pixels.
pub const MOST_SIDE: u32 = 8192;
/// Most memory that reading a picture may take, bytes.
const MEMORY: u64 = 640 << 20;

/// Reads a PNG or JPEG file: rows from the top, straight alpha, sRGB, turned upright as the file says.
///
/// # Errors
/// A message: another format, damaged, or larger than [`MOST_BYTES`] or [`MOST_SIDE`].
pub fn read(bytes: &[u8]) -> Result<RgbaImage, Words> {
    if bytes.len() > MOST_BYTES {
        let (size, most) = (bytes.len() >> 20, MOST_BYTES >> 20);
        return Err(words!(
            "it has {size} MiB, more than the {most} MiB that a picture may have",
            size,
            most
        ));
    }
    let format = image::guess_format(bytes).ok();
    let format = format.filter(|format| [ImageFormat::Png, ImageFormat::Jpeg].contains(format));
    let mut decoder = decoder(bytes, format.ok_or_else(|| words!("it is neither PNG nor JPEG"))?)?;
    let turned = decoder.orientation().map_err(in_words)?;
    let mut picture = image::DynamicImage::from_decoder(decoder).map_err(in_words)?;
    picture.apply_orientation(turned);
    Ok(picture.into_rgba8())
}

/// A decoder of `bytes` in a format, of at most [`MOST_SIDE`] pixels a side and a bounded size in memory.
pub(super) fn decoder(bytes: &[u8], format: ImageFormat) -> Result<impl ImageDecoder + '_, Words> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::default();
    limits.max_image_width = Some(MOST_SIDE);
    limits.max_image_height = Some(MOST_SIDE);
    limits.max_alloc = Some(MEMORY);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(in_words)?;
    // Not every format asks the limits before it takes the memory of the whole picture.
    if decoder.total_bytes() > MEMORY {
        return Err(words!("it takes more than {most} MiB in memory", most = MEMORY >> 20));
    }
    Ok(decoder)
}

pub(super) fn in_words(error: image::ImageError) -> Words {
    match error {
        image::ImageError::Limits(_) => {
            words!("it is larger than {most} by {most} pixels, which a picture may have", most = MOST_SIDE)
        }
        image::ImageError::Unsupported(why) => {
            words!("it is of a kind that is not known: {why}", why = readable(&why.to_string()))
        }
        other => words!("it is damaged: {why}", why = readable(&other.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(format: ImageFormat) -> Vec<u8> {
        let picture =
            image::RgbImage::from_fn(20, 10, |x, _| image::Rgb([if x < 10 { 200 } else { 20 }, 90, 40]));
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).expect("written");
        bytes.into_inner()
    }

    #[test]
    fn png_and_jpeg_are_read() {
        for format in [ImageFormat::Png, ImageFormat::Jpeg] {
            let picture = read(&written(format)).expect("a picture");
            assert_eq!(picture.dimensions(), (20, 10));
            let [r, _, _, a] = picture.get_pixel(2, 5).0;
            assert!(r > 180 && a == 255, "{format:?}: {r} {a}");
        }
    }

    #[test]
    fn what_is_no_picture_is_refused_in_words() {
        let png = written(ImageFormat::Png);
        for (bytes, words) in [
            (&b"GIF89a"[..], "neither PNG nor JPEG"),
            (&[], "neither PNG nor JPEG"),
            (&png[..png.len() / 2], "it is damaged: "),
        ] {
            assert!(read(bytes).is_err_and(|why| why.contains(words)), "{words}");
        }
        let mut wide = png;
        wide[16..20].copy_from_slice(&20_000_u32.to_be_bytes());
        let sum = crc32fast::hash(&wide[12..29]);
        wide[29..33].copy_from_slice(&sum.to_be_bytes());
        assert!(read(&wide).is_err_and(|why| why.contains("8192")));
        assert!(read(&vec![0; MOST_BYTES + 1]).is_err_and(|why| why.contains("32 MiB")));
    }
}
