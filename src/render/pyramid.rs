//! Pictures in halves of halves (mip levels), with premultiplied alpha: colours of transparent parts never show.

use glam::{UVec2, Vec2, Vec4};
use image::{Rgba, RgbaImage};
use rayon::prelude::*;

use super::srgb::{self, LINEAR, byte, linear};

/// A picture and its smaller versions down to one pixel. Colours are sRGB of premultiplied linear ones.
#[derive(Clone, Debug)]
pub(super) struct Pyramid {
    pub levels: Vec<RgbaImage>,
}

impl Pyramid {
    /// The levels of `picture`, straight alpha.
    pub fn new(picture: &RgbaImage) -> Self {
        let mut first = picture.clone();
        first.par_chunks_mut(4).for_each(|pixel| {
            if pixel[3] < 255 {
                let straight = linear([pixel[0], pixel[1], pixel[2]]);
                let alpha = f32::from(pixel[3]) / 255.0;
                pixel.copy_from_slice(&encoded((straight * alpha).extend(alpha)).0);
            }
        });
        Self::of_premultiplied(first)
    }

    fn of_premultiplied(first: RgbaImage) -> Self {
        let mut levels = vec![first];
        while let Some(last) = levels.last().filter(|last| last.width() > 1 || last.height() > 1) {
            let next = halved(last);
            levels.push(next);
        }
        Self { levels }
    }

    /// The same picture drawn out to a square of `side` pixels.
    pub fn square(&self, side: u32) -> Self {
        // From the smallest level that is not smaller, so that nothing is skipped over.
        let is_enough = |level: &&RgbaImage| level.width().min(level.height()) >= side;
        let from = self.levels.iter().rev().find(is_enough).unwrap_or(&self.levels[0]);
        let wide = from.width().max(side) > side || from.height().max(side) > side;
        let filter = if wide {
            image::imageops::FilterType::Triangle
        } else {
            image::imageops::FilterType::CatmullRom
        };
        Self::of_premultiplied(image::imageops::resize(from, side, side, filter))
    }

    /// Linear premultiplied colour at a place 0..1 from the lower left corner, averaged over `footprint` of it each way. Beyond
    /// the picture it is repeated, or its border goes on.
    pub fn sample(&self, at: Vec2, footprint: Vec2, repeats: bool) -> Vec4 {
        let size = UVec2::from(self.levels[0].dimensions()).as_vec2();
        let texels = (footprint * size).max_element().max(1.0);
        let level = texels.log2();
        let last = self.levels.len() - 1;
        let lower = (level.floor() as usize).min(last);
        let upper = (lower + 1).min(last);
        let part = (level - lower as f32).clamp(0.0, 1.0);
        let one = |level: usize| bilinear(&self.levels[level], at, repeats);
        if part > 0.0 { one(lower).lerp(one(upper), part) } else { one(lower) }
    }
}

fn bilinear(image: &RgbaImage, at: Vec2, repeats: bool) -> Vec4 {
    let size = UVec2::from(image.dimensions()).as_vec2();
    let p = Vec2::new(at.x, 1.0 - at.y) * size - 0.5;
    let (base, part) = (p.floor(), p - p.floor());
    let within = |i: f32, n: u32| {
        let i = i as i64;
        let n = i64::from(n);
        (if repeats { i.rem_euclid(n) } else { i.clamp(0, n - 1) }) as u32
    };
    let pixel = |dx: f32, dy: f32| {
        decoded(image.get_pixel(within(base.x + dx, image.width()), within(base.y + dy, image.height())))
    };
    let upper = pixel(0.0, 0.0).lerp(pixel(1.0, 0.0), part.x);
    let lower = pixel(0.0, 1.0).lerp(pixel(1.0, 1.0), part.x);
    upper.lerp(lower, part.y)
}

/// Half the size, each pixel the mean of four.
fn halved(image: &RgbaImage) -> RgbaImage {
    let (width, height) = image.dimensions();
    let (w, h) = ((width / 2).max(1), (height / 2).max(1));
    let mut half = RgbaImage::new(w, h);
    half.par_chunks_mut(4 * w as usize).enumerate().for_each(|(y, row)| {
        let (pixels, _) = row.as_chunks_mut::<4>();
        for (x, pixel) in pixels.iter_mut().enumerate() {
            let (x, y) = (2 * x as u32, 2 * y as u32);
            let (right, below) = ((x + 1).min(width - 1), (y + 1).min(height - 1));
            let four = [[x, y], [right, y], [x, below], [right, below]];
            let sum: Vec4 = four.iter().map(|&[x, y]| decoded(image.get_pixel(x, y))).sum();
            *pixel = encoded(sum / 4.0).0;
        }
    });
    half
}

fn decoded(pixel: &Rgba<u8>) -> Vec4 {
    let [r, g, b, a] = pixel.0;
    let table = &*LINEAR;
    Vec4::new(table[usize::from(r)], table[usize::from(g)], table[usize::from(b)], f32::from(a) / 255.0)
}

/// sRGB of a linear colour; alpha stays.
pub(super) fn encoded(colour: Vec4) -> Rgba<u8> {
    let [r, g, b] = srgb::encoded(colour.truncate());
    Rgba([r, g, b, byte(colour.w)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transparent_parts_give_no_colour_to_their_neighbours() {
        // White where it is opaque, bright red where it is not.
        let picture =
            RgbaImage::from_fn(8, 8, |x, _| if x < 4 { Rgba([255; 4]) } else { Rgba([255, 0, 0, 0]) });
        let pyramid = Pyramid::new(&picture);
        assert_eq!(pyramid.levels.len(), 4);
        let mean = pyramid.sample(Vec2::splat(0.5), Vec2::ONE, false);
        assert!((mean - Vec4::splat(0.5)).abs().max_element() < 0.02, "{mean}");
        assert_eq!(pyramid.sample(Vec2::new(0.1, 0.5), Vec2::ZERO, false), Vec4::ONE);
        let over = pyramid.sample(Vec2::new(1.1, 0.5), Vec2::ZERO, true);
        assert_eq!(over, Vec4::ONE, "repeated");
        assert_eq!(pyramid.sample(Vec2::new(1.1, 0.5), Vec2::ZERO, false), Vec4::ZERO, "its border goes on");
        assert_eq!(pyramid.square(4).levels[0].dimensions(), (4, 4));
    }
}
