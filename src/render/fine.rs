//! A picture with several samples for each of its pixels: drawn larger, tile by tile, and averaged in linear light. Only one tile
//! is on the device at a time, so that the large picture may be larger than the device's textures.

use glam::{UVec2, Vec4};
use image::RgbaImage;
use rayon::prelude::*;

use super::alpha::straightened;
use super::frame::occlusion_margin;
use super::lens_blur::blur_margin;
use super::part::Part;
use super::pyramid::encoded;
use super::srgb::{LINEAR, decoded};
use super::target::check_size;
use super::{Camera, Gpu, Look, OffscreenTarget, Quality, RenderError, Renderer, Scene};

/// How finely a picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fineness {
    /// Drawn pixels along each side of a pixel, 1..=[`MOST_TIMES`](Self::MOST_TIMES).
    pub times: u32,
    /// Longest side of a tile, drawn pixels; rounded down to a multiple of `32 * times`, at least that. Where `times` is 1 the
    /// picture is drawn in one piece, unless a processor has to blur it.
    pub tile: u32,
}

impl Fineness {
    /// The largest number of drawn pixels along each side of a pixel.
    pub const MOST_TIMES: u32 = 8;

    /// `times` drawn pixels along each side of a pixel, in tiles of the usual size.
    pub fn new(times: u32) -> Self {
        Self { times, tile: 2048 }
    }
}

/// Longest side of a tile where a processor draws, pixels: between two tiles the work can be stopped.
const SOFTWARE_TILE: u32 = 1024;

/// Pixels round a tile within which triangles are not clipped.
const CLIP_MARGIN: u32 = 256;

/// A picture that is being drawn, tile by tile.
#[derive(Debug)]
pub struct FinePicture {
    scene: Scene,
    camera: Camera,
    look: Look,
    times: u32,
    parts: Vec<Part>,
    /// Pixels round a tile that are drawn with it, for its blur; even.
    blur_margin: u32,
    done: usize,
    target: Option<OffscreenTarget>,
    picture: RgbaImage,
}

impl FinePicture {
    /// Plans a picture of `size` pixels of `scene` from `camera`. Widths on the screen, as of lines, are those of a picture of
    /// `size` pixels, however finely it is drawn. A picture with sides longer than the device's textures is refused.
    pub fn new(
        gpu: &Gpu,
        scene: Scene,
        camera: Camera,
        look: &Look,
        size: UVec2,
        fineness: Fineness,
    ) -> Result<Self, RenderError> {
        let size = size.max(UVec2::ONE);
        check_size(gpu, size)?;
        let times = fineness.times.clamp(1, Fineness::MOST_TIMES);
        let whole = size * times;
        // The blur of a large picture in one piece would keep a processor busy for too long.
        let is_tiled = times > 1 || gpu.software;
        let blur_margin = if is_tiled { blur_margin(&camera, &scene, look, whole) } else { 0 };
        let parts = if times == 1 && blur_margin == 0 {
            vec![Part::all(whole)]
        } else {
            let room = gpu.max_side().saturating_sub(2 * blur_margin);
            let most = (room / 2).min(if gpu.software { SOFTWARE_TILE } else { u32::MAX });
            let step = 32 * times;
            let side = (fineness.tile.min(most) / step).max(1) * step;
            // A tile with its surroundings is a viewport, which is no larger than a texture.
            let margin = occlusion_margin(&camera, &scene, look, whole).max(CLIP_MARGIN);
            Part::tiles(whole, side, margin.min(room.saturating_sub(side) / 4 * 2))
        };
        let look = Look {
            pixels_per_point: look.pixels_per_point * times as f32,
            drawn_per_pixel: times as f32,
            ..*look
        };
        let picture = RgbaImage::new(size.x, size.y);
        Ok(Self { scene, camera, look, times, parts, blur_margin, done: 0, target: None, picture })
    }

    /// Number of tiles that are drawn, and of all of them.
    pub fn progress(&self) -> (usize, usize) {
        (self.done, self.parts.len())
    }

    /// Whether all tiles are drawn.
    pub fn is_done(&self) -> bool {
        self.done == self.parts.len()
    }

    /// Draws the next tile and waits for it; nothing where all are drawn.
    pub fn draw_next(&mut self, gpu: &Gpu, renderer: &mut Renderer) -> Result<(), RenderError> {
        let Some(&part) = self.parts.get(self.done) else { return Ok(()) };
        let drawn = part.widened(self.blur_margin);
        let target = match self.target.take() {
            Some(last) => last.moved_to(gpu, drawn)?,
            None => OffscreenTarget::of_part(gpu, drawn, Quality::Finished)?,
        };
        renderer.draw(gpu, &self.scene, &self.camera, &self.look, &target)?;
        let mut tile = target.read(gpu)?;
        if drawn != part {
            let [at, size] = [part.at - drawn.at, part.size];
            tile = image::imageops::crop_imm(&tile, at.x, at.y, size.x, size.y).to_image();
        }
        self.target = Some(target);
        self.done += 1;
        let part_of_picture = match self.times {
            1 if self.look.cut_out => straightened(tile),
            1 => tile,
            times => averaged(&tile, times),
        };
        let at = (part.at / self.times).as_i64vec2();
        image::imageops::replace(&mut self.picture, &part_of_picture, at.x, at.y);
        Ok(())
    }

    /// The picture, with straight alpha as image files have it; transparent where a tile is not drawn.
    pub fn finish(self) -> RgbaImage {
        self.picture
    }
}

/// A picture `times` smaller each way: each pixel the mean of a square of `tile`, in linear light. `tile` is premultiplied as it was
/// drawn, the result has straight alpha.
fn averaged(tile: &RgbaImage, times: u32) -> RgbaImage {
    let (width, height) = (tile.width() / times, tile.height() / times);
    let mut small = RgbaImage::new(width, height);
    small.par_chunks_mut(4 * width.max(1) as usize).zip(0..height).for_each(|(row, y)| {
        let (pixels, _) = row.as_chunks_mut::<4>();
        for (pixel, x) in pixels.iter_mut().zip(0..) {
            let square = (0..times * times).map(|i| [x * times + i % times, y * times + i / times]);
            let sum: Vec4 = square.map(|[x, y]| light(tile.get_pixel(x, y).0)).sum();
            let mean = sum / (times * times) as f32;
            let alpha = mean.w.max(1e-9);
            *pixel = encoded((mean.truncate() / alpha).extend(mean.w)).0;
        }
    });
    small
}

/// Linear light, premultiplied, of a pixel whose encoded values were multiplied with its alpha.
fn light([r, g, b, a]: [u8; 4]) -> Vec4 {
    let table = &*LINEAR;
    match a {
        0 => Vec4::ZERO,
        255 => Vec4::new(table[usize::from(r)], table[usize::from(g)], table[usize::from(b)], 1.0),
        _ => {
            let alpha = f32::from(a) / 255.0;
            let [r, g, b] = [r, g, b].map(|c| decoded((f32::from(c) / f32::from(a)).min(1.0)) * alpha);
            Vec4::new(r, g, b, alpha)
        }
    }
}

#[cfg(test)]
mod tests {
    use image::Rgba;

    use super::*;

    #[test]
    fn thin_bright_threads_keep_their_light() {
        // One white column of two on black: half of the light, which is 188 encoded. A mean of the encoded values would be 128.
        let threads = RgbaImage::from_fn(8, 4, |x, _| {
            let c = if x % 2 == 0 { 255 } else { 0 };
            Rgba([c, c, c, 255])
        });
        let small = averaged(&threads, 2);
        assert_eq!(small.dimensions(), (4, 2));
        assert!(small.pixels().all(|p| p.0 == [188, 188, 188, 255]), "{:?}", small.get_pixel(0, 0));
    }

    #[test]
    fn every_plain_colour_is_kept() {
        for c in 0..=255u8 {
            let plain = RgbaImage::from_pixel(3, 3, Rgba([c, 255 - c, c / 2, 255]));
            assert_eq!(averaged(&plain, 3).get_pixel(0, 0).0, [c, 255 - c, c / 2, 255]);
        }
    }

    #[test]
    fn a_border_has_its_own_colour_and_half_the_alpha() {
        let (own, nothing) = (Rgba([200, 100, 40, 255]), Rgba([0; 4]));
        let border = RgbaImage::from_fn(2, 2, |x, _| if x == 0 { own } else { nothing });
        assert_eq!(averaged(&border, 2).get_pixel(0, 0).0, [200, 100, 40, 128]);
        // As the device leaves a pixel that is half covered.
        let half = RgbaImage::from_pixel(2, 2, Rgba([100, 50, 20, 128]));
        let [r, g, b, a] = averaged(&half, 2).get_pixel(0, 0).0;
        for (got, want) in [(r, 199), (g, 100), (b, 40), (a, 128)] {
            assert!(got.abs_diff(want) <= 1, "{:?}", [r, g, b, a]);
        }
        assert_eq!(averaged(&RgbaImage::new(2, 2), 2).get_pixel(0, 0).0, [0; 4]);
    }
}
