//! Textures of cloth for other programs, computed on the processor: base colours and normals of flat pieces in an atlas, and a
//! weave as a tile. The formulas are those of shaders/textile.wgsl. The same input gives the same pixels.

mod owners;
mod yarn;

use std::sync::Arc;

use glam::{Mat2, UVec2, Vec2, Vec3};
use image::{Rgb as Pixel, RgbImage};
use rayon::prelude::*;

use self::owners::{NOBODY, owners};
use self::yarn::{Lattice, mean_yarn, printed, repeat, yarn};
use super::decal::{Decal, pictures};
use super::pyramid::Pyramid;
use super::scene::Rgb;
use super::srgb::{encoded, linear};
use super::textile::Textile;
use super::wgsl::{mix, smoothstep};

pub use self::owners::overlap;

/// Border round each chart, texels: neighbouring texels and smaller mip levels find its own colour there.
pub const GUTTER: u32 = 8;
/// Pixels of a thread in a tile of a weave.
const PIXELS_PER_THREAD: f32 = 48.0;
/// Colour of texels that belong to no chart.
const EMPTY: Rgb = [128; 3];

/// Flat pieces of one appearance in a texture.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Triangles in the texture, 0..1, v upwards.
    pub triangles: Vec<[Vec2; 3]>,
    /// The place in the flat cloth (metres, y along the grain) of a place in the texture: a matrix and a translation.
    pub flat_from_uv: (Mat2, Vec2),
    /// Colours of the outside and the inside.
    pub sides: [Rgb; 2],
    /// The surface.
    pub textile: Textile,
    /// Pictures on it, the last on top.
    pub decals: Arc<Vec<Decal>>,
}

/// A side of the cloth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The outside.
    Outside,
    /// The inside.
    Inside,
}

impl Chart {
    fn flat(&self, uv: Vec2) -> Vec2 {
        self.flat_from_uv.0 * uv + self.flat_from_uv.1
    }

    /// Metres of flat cloth in the width of the texture.
    fn extent(&self) -> f32 {
        let axes = self.flat_from_uv.0;
        axes.x_axis.length().max(axes.y_axis.length())
    }
}

/// Base colours of one side of `charts` in a texture of `side` pixels: the colour without any light.
pub fn base_colour(charts: &[Chart], which: Side, side: u32) -> RgbImage {
    let all: Vec<Decal> = charts.iter().flat_map(|chart| chart.decals.iter().cloned()).collect();
    let (pictures, _) = pictures(&all);
    let pyramids: Vec<Pyramid> = pictures.iter().map(|picture| Pyramid::new(picture)).collect();
    let pyramid = |decal: &Decal| {
        let own = pictures.iter().position(|picture| Arc::ptr_eq(picture, &decal.picture));
        own.map(|i| &pyramids[i])
    };
    baked(charts, side, EMPTY, |chart, uv| {
        let own = chart.sides[usize::from(which == Side::Inside)];
        let (at, width) = (chart.flat(uv), chart.extent() / side as f32);
        let seen = chart.decals.iter().filter(|decal| decal.repeats || which == Side::Outside);
        let decals = seen.filter_map(|decal| Some((decal, pyramid(decal)?)));
        encoded(albedo(&chart.textile, own, at, width, decals))
    })
}

/// Normals of `charts` in a texture of `side` pixels: x along u, y along v, z out of the cloth.
pub fn normals(charts: &[Chart], side: u32) -> RgbImage {
    let flat = [128, 128, 255];
    baked(charts, side, flat, |chart, uv| {
        let slope = slope(&chart.textile, chart.flat(uv), chart.extent() / side as f32, Lattice::default());
        // The gradient over the flat cloth, in the directions of the texture.
        let axes = chart.flat_from_uv.0;
        let along = |axis: Vec2| slope.dot(axis.normalize_or_zero());
        normal(Vec2::new(along(axes.x_axis), along(axes.y_axis)))
    })
}

/// Normals of a repeat of the weave of `textile`, and the size of that repeat in metres; None where it has no relief.
pub fn weave(textile: &Textile) -> Option<(RgbImage, Vec2)> {
    if textile.weave == 0 || textile.relief <= 0.0 {
        return None;
    }
    let threads = repeat(textile.weave);
    let size: UVec2 = (threads * PIXELS_PER_THREAD).round().as_uvec2();
    let metres = threads * textile.pitch;
    let lattice = Lattice(threads.round().as_ivec2());
    let image = RgbImage::from_fn(size.x, size.y, |x, y| {
        let uv = Vec2::new((x as f32 + 0.5) / size.x as f32, 1.0 - (y as f32 + 0.5) / size.y as f32);
        Pixel(normal(slope(textile, uv * metres, metres.x / size.x as f32, lattice)))
    });
    Some((image, metres))
}

/// Colours every texel that belongs to a chart by `colour`, which is given the chart and the place in the texture.
fn baked(charts: &[Chart], side: u32, empty: Rgb, colour: impl Fn(&Chart, Vec2) -> Rgb + Sync) -> RgbImage {
    let side = side.max(1);
    let owners = owners(charts, side, GUTTER);
    let mut image = RgbImage::from_pixel(side, side, Pixel(empty));
    let width = side as usize;
    let rows = image.par_chunks_mut(width * 3).zip(owners.par_chunks(width)).enumerate();
    rows.for_each(|(y, (row, owners))| {
        let v = 1.0 - (y as f32 + 0.5) / side as f32;
        let (pixels, _) = row.as_chunks_mut::<3>();
        for (x, (pixel, &owner)) in pixels.iter_mut().zip(owners).enumerate() {
            if owner != NOBODY {
                *pixel = colour(&charts[usize::from(owner)], Vec2::new((x as f32 + 0.5) / side as f32, v));
            }
        }
    });
    image
}

/// `colour` with a picture over it, at a place of the flat cloth, averaged over `width` metres.
fn over(colour: Vec3, decal: &Decal, pyramid: &Pyramid, at: Vec2, width: f32) -> Vec3 {
    let (map, move_by) = decal.picture_from_flat;
    let place = map * at + move_by;
    let footprint = width * Vec2::new(map.row(0).length(), map.row(1).length());
    // How much of a texel at the border of a picture it covers.
    let border =
        (place.min(1.0 - place) / footprint.max(Vec2::splat(1e-9)) + 0.5).clamp(Vec2::ZERO, Vec2::ONE);
    let share = if decal.repeats { 1.0 } else { border.x * border.y };
    if share <= 0.0 {
        return colour;
    }
    let ink = pyramid.sample(place, footprint, decal.repeats) * share;
    colour * (1.0 - ink.w) + ink.truncate()
}

/// Linear colour of the cloth at a place of the flat cloth, averaged over `width` metres.
fn albedo<'d>(
    textile: &Textile,
    own: Rgb,
    at: Vec2,
    width: f32,
    decals: impl Iterator<Item = (&'d Decal, &'d Pyramid)>,
) -> Vec3 {
    let pitch = textile.pitch.max(1e-6);
    let (p, threads) = (at / pitch, width / pitch);
    let sharp = 1.0 - smoothstep(0.3, 0.75, threads);
    let mean = mean_yarn(textile.weave);
    let here = if sharp > 0.0 { yarn(textile.weave, p, Lattice::default()) } else { mean };
    let noise = |scale: Vec2| Lattice::default().noise(p * scale);
    let uneven = noise(Vec2::new(0.31, 0.043)) + noise(Vec2::new(0.043, 0.31)) - 1.0;
    let slubs = 1.0 + textile.slubs * uneven * (1.0 - smoothstep(0.3, 0.9, threads * 0.31));
    let (height, share) = (mix(mean.height, here.height, sharp), mix(mean.second, here.second, sharp));
    let repeat = textile.repeat.max(1e-6);
    let inked = printed(textile.print, at / repeat, width / repeat);
    let depth = 0.45 + 0.55 * height / mean.height.max(0.1);
    let depth = mix(1.0, depth, (textile.relief * 1.5).clamp(0.0, 1.0));
    let first = linear(own);
    let second = textile.second.map_or(first, linear);
    let colour = first.lerp(second, share).lerp(linear(textile.ink), inked);
    decals.fold(colour, |colour, (decal, pyramid)| over(colour, decal, pyramid, at, width))
        * slubs
        * depth.min(1.25)
}

/// Slope of the surface at a place of the flat cloth, averaged over `width` metres.
fn slope(textile: &Textile, at: Vec2, width: f32, lattice: Lattice) -> Vec2 {
    let pitch = textile.pitch.max(1e-6);
    let (p, threads) = (at / pitch, width / pitch);
    let sharp = 1.0 - smoothstep(0.3, 0.75, threads);
    if textile.weave == 0 || sharp <= 0.0 {
        return Vec2::ZERO;
    }
    let step = (threads * 0.5).clamp(0.02, 0.2);
    let height = |p| yarn(textile.weave, p, lattice).height;
    let here = height(p);
    let rise = Vec2::new(height(p + Vec2::X * step) - here, height(p + Vec2::Y * step) - here) / step;
    // Half of the relief, as the shader has it.
    rise * (0.5 * textile.relief * sharp)
}

/// The colour that stands for the normal of a surface of this slope.
fn normal(slope: Vec2) -> Rgb {
    let unit = Vec3::new(-slope.x, -slope.y, 1.0).normalize();
    (unit * 127.0 + 128.0).round().to_array().map(|c| c as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(textile: Textile) -> Chart {
        let [a, b, c, d] =
            [Vec2::splat(0.25), Vec2::new(0.75, 0.25), Vec2::splat(0.75), Vec2::new(0.25, 0.75)];
        Chart {
            triangles: vec![[a, b, c], [a, c, d]],
            flat_from_uv: (Mat2::IDENTITY, Vec2::ZERO),
            sides: [[200, 40, 40], [20, 20, 90]],
            textile,
            decals: Arc::default(),
        }
    }

    fn at(image: &RgbImage, u: f32, v: f32) -> Rgb {
        let side = image.width() as f32;
        image.get_pixel((u * side) as u32, ((1.0 - v) * side) as u32).0
    }

    #[test]
    fn prints_are_where_the_flat_cloth_has_them_and_the_sides_have_their_colours() {
        let ink = [250, 250, 240];
        let chart = square(Textile { print: 1, repeat: 0.25, ink, relief: 0.0, ..Textile::default() });
        let outside = base_colour(std::slice::from_ref(&chart), Side::Outside, 256);
        // Stripes of 0.125: of ink about odd multiples of an eighth, 0.375 for one.
        assert_eq!([at(&outside, 0.375, 0.5), at(&outside, 0.5, 0.5)], [ink, [200, 40, 40]]);
        assert_eq!(at(&outside, 0.05, 0.5), EMPTY, "beyond the gutter");
        assert_ne!(at(&outside, 0.24, 0.5), EMPTY, "in the gutter");
        let inside = base_colour(&[chart], Side::Inside, 256);
        assert_eq!(at(&inside, 0.5, 0.5), [20, 20, 90]);
    }

    #[test]
    fn relief_bends_normals_in_the_directions_of_the_texture() {
        // Wales of 0.1 m along the grain: they bend normals across the grain only.
        let wales = Textile { weave: 6, pitch: 0.1, relief: 0.8, ..Textile::default() };
        let mut chart = square(wales);
        let spread = |image: &RgbImage| {
            [0, 1].map(|k| image.pixels().map(|p| f64::from(p[k]) - 128.0).map(f64::abs).sum::<f64>())
        };
        let [u, v] = spread(&normals(std::slice::from_ref(&chart), 256));
        assert!(u > 3.0 * v, "{u} {v}");
        chart.flat_from_uv.0 = Mat2::from_cols(Vec2::Y, -Vec2::X);
        let [u, v] = spread(&normals(&[chart], 256));
        assert!(v > 3.0 * u, "{u} {v}");
        let (tile, size) = weave(&wales).expect("a tile");
        assert!((size - Vec2::splat(0.4)).length() < 1e-6 && tile.dimensions() == (192, 192));
        assert!(weave(&Textile::default()).is_none());
    }

    #[test]
    fn charts_that_cover_each_other_are_found() {
        let one = square(Textile::default());
        let mut other = one.clone();
        assert!(overlap(&[one.clone(), other.clone()], 128));
        other.triangles.iter_mut().flatten().for_each(|p| p.x += 0.5);
        assert!(!overlap(&[one, other], 128), "side by side");
    }
}
