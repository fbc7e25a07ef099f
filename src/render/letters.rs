//! Text in pictures without a window, in the font of the window.

use std::sync::LazyLock;

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};
use image::{Rgba, RgbaImage};

static FONT: LazyLock<FontRef<'static>> = LazyLock::new(|| {
    FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT)
        .expect("the letters that come with the program")
});

/// The glyphs of `words` in a row that begins at x = 0, with a line height of `size` pixels, and the length of the row, pixels.
fn laid(words: &str, size: u32) -> (Vec<Glyph>, f32) {
    let font = FONT.as_scaled(PxScale::from(size as f32));
    let (mut glyphs, mut x, mut before) = (Vec::new(), 0.0, None);
    for letter in words.chars() {
        let id = font.glyph_id(letter);
        x += before.map_or(0.0, |before| font.kern(before, id));
        glyphs.push(id.with_scale_and_position(font.scale(), point(x, font.ascent())));
        x += font.h_advance(id);
        before = Some(id);
    }
    (glyphs, x)
}

/// Length of a line of text with a line height of `size` pixels, pixels.
pub fn width(words: &str, size: u32) -> u32 {
    laid(words, size).1.ceil() as u32
}

/// Draws text with a line height of `size` pixels, its upper left corner at `at`. Parts outside of the picture are left out;
/// characters missing from the font are drawn as boxes.
pub fn write(picture: &mut RgbaImage, words: &str, at: [u32; 2], size: u32, colour: Rgba<u8>) {
    for glyph in laid(words, size).0 {
        let Some(outline) = FONT.outline_glyph(glyph) else { continue };
        let corner = outline.px_bounds().min;
        outline.draw(|x, y, covered| {
            let place = [(x, corner.x, at[0]), (y, corner.y, at[1])];
            let [x, y] = place.map(|(i, corner, at)| i64::from(i) + corner as i64 + i64::from(at));
            let inside = u32::try_from(x).ok().zip(u32::try_from(y).ok());
            if let Some(pixel) = inside.and_then(|(x, y)| picture.get_pixel_mut_checked(x, y)) {
                for (below, ink) in pixel.0.iter_mut().zip(colour.0) {
                    let mixed = f32::from(*below) + (f32::from(ink) - f32::from(*below)) * covered.min(1.0);
                    *below = mixed.round() as u8;
                }
            }
        });
    }
}

/// Fills the part of a rectangle that is inside the picture.
pub fn fill(picture: &mut RgbaImage, at: [u32; 2], size: [u32; 2], colour: Rgba<u8>) {
    for y in at[1]..(at[1].saturating_add(size[1])).min(picture.height()) {
        for x in at[0]..(at[0].saturating_add(size[0])).min(picture.width()) {
            picture.put_pixel(x, y, colour);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_as_wide_as_they_are_drawn() {
        let (white, black) = (Rgba([255; 4]), Rgba([0, 0, 0, 255]));
        for words in ["Ease (cm)", "größer: 12,5 %"] {
            let wide = width(words, 40);
            let mut picture = RgbaImage::from_pixel(wide + 60, 40, white);
            write(&mut picture, words, [20, 0], 40, black);
            let inked = |x: u32| (0..40).any(|y| picture.get_pixel(x, y)[0] < 128);
            let ends = [(0..wide + 60).find(|&x| inked(x)), (0..wide + 60).rev().find(|&x| inked(x))];
            let [first, last] = ends.map(|x| x.expect("something is drawn"));
            assert!(
                (20..28).contains(&first) && (wide + 9..wide + 20).contains(&last),
                "{words}: {first} to {last} of {wide}"
            );
        }
        // Beyond the picture nothing is drawn and nothing breaks.
        write(&mut RgbaImage::new(3, 2), "words", [u32::MAX - 1, 0], 20, black);
    }
}
