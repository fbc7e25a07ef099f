//! Light out of an environment map: its sun, if it has one, as a lamp that casts shadows, and all other light from all sides as
//! spherical harmonics.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Quat, Vec3};
use image::Rgb32FImage;

use super::harmonics::{Harmonics, Pixel, pixel, pixels};
use super::srgb::luminance;

/// Radii about the brightest pixel, radians: of the disc that is the sun with its glow (5 degrees), and of the ring round it (10).
const DISC: f64 = 5.0 * PI / 180.0;
const RING: f64 = 10.0 * PI / 180.0;
/// Least height of an image in which a sun is looked for, pixels: a disc then has some ten.
const LEAST_ROWS: u32 = 64;
/// Least share of the sun in all light: less makes no shadow that one would miss.
const LEAST_SHARE: f64 = 0.1;
/// Least share of the rest in all light: less is hardly more than the rounding of the sun's light that was taken away.
const LEAST_REST: f32 = 1e-3;
/// Least height of the sun, the sine of its angle over the horizon (about 3 degrees): bright spots below light no floor.
const LOWEST: f64 = 0.05;
/// Most of one channel in the colour of the sun; about that of the evening's lamp.
const MOST_COLOUR: f32 = 1.5;

/// Light of an image of all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageLight {
    around: Harmonics,
    sun: Option<Sun>,
}

/// A small light that is so bright that shadows are its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sun {
    /// Unit vector towards it.
    pub toward: Vec3,
    /// Linear RGB of luminance 1, or less where a channel would be more than [`MOST_COLOUR`].
    pub colour: Vec3,
}

impl ImageLight {
    /// The light of an equirectangular image as by [`Harmonics::of_image`]. The light from all sides, without the sun, is as bright
    /// as `mean` (linear luminance) in the mean over all directions; None if there is no light.
    pub fn of_image(image: &Rgb32FImage, mean: f32) -> Option<Self> {
        let all = Harmonics::of_image(image);
        let around = |light: Harmonics| light.without_ringing().with_mean(mean);
        let parted = parted(image, &all).and_then(|(sun, rest)| Some((around(rest)?, Some(sun))));
        let (around, sun) = parted.or_else(|| Some((around(all)?, None)))?;
        Some(Self { around, sun })
    }

    /// The same light turned by `angle` radians about the axis y, as by [`Harmonics::turned`].
    #[must_use]
    pub fn turned(&self, angle: f32) -> Self {
        let toward = |sun: Sun| Quat::from_rotation_y(angle) * sun.toward;
        Self {
            around: self.around.turned(angle),
            sun: self.sun.map(|sun| Sun { toward: toward(sun), ..sun }),
        }
    }

    /// The light from all sides, without the sun.
    pub(super) fn around(&self) -> &Harmonics {
        &self.around
    }

    /// The sun; None where the image has none.
    pub(super) fn sun(&self) -> Option<Sun> {
        self.sun
    }
}

/// The sun of an image and the rest of its light, of which `all` are the harmonics; None where it has no sun. The sun is what is
/// brighter, in a disc about the brightest pixel, than the mean of the ring round the disc; the rest has that mean there.
fn parted(image: &Rgb32FImage, all: &Harmonics) -> Option<(Sun, Harmonics)> {
    if image.height() < LEAST_ROWS {
        return None;
    }
    let brighter = |light: &image::Rgb<f32>| luminance(Vec3::from(light.0));
    let brightest = image.enumerate_pixels().reduce(|a, b| if brighter(b.2) > brighter(a.2) { b } else { a });
    let (column, row, _) = brightest?;
    let middle = pixel(image, column, row).direction;
    let reach = (f64::from(image.height()) * RING / PI).ceil() as u32 + 1;
    let rows = row.saturating_sub(reach)..row.saturating_add(reach + 1).min(image.height());
    let within = |radius: f64| {
        let nearest = radius.cos();
        pixels(image, rows.clone()).filter(move |pixel| pixel.direction.dot(middle) > nearest)
    };
    let sum = |radius: f64| {
        within(radius).fold((DVec3::ZERO, 0.0), |(light, size), pixel| {
            (light + pixel.light * pixel.solid_angle, size + pixel.solid_angle)
        })
    };
    let ((in_disc, disc), (in_both, both)) = (sum(DISC), sum(RING));
    let ring = (in_both - in_disc) / (both - disc);
    let more = |pixel: &Pixel| (pixel.light - ring) * pixel.solid_angle;
    let flux = (in_disc - ring * disc).max(DVec3::ZERO).as_vec3();
    let [of_sun, of_all] = [luminance(flux), all.mean() * 2.0 * TAU as f32];
    let rest = all.without(within(DISC).map(|pixel| (pixel.direction, more(&pixel))));
    let weighed = within(DISC).map(|pixel| pixel.direction * f64::from(luminance(more(&pixel).as_vec3())));
    let toward = weighed.sum::<DVec3>().try_normalize()?;
    let is_sun = f64::from(of_sun) >= LEAST_SHARE * f64::from(of_all)
        && rest.mean() >= LEAST_REST * all.mean()
        && toward.y >= LOWEST;
    let colour = flux / of_sun.max(flux.max_element() / MOST_COLOUR);
    is_sun.then(|| (Sun { toward: toward.as_vec3(), colour }, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image of `sky` (grey) and half as much below, with a disc of `radius` degrees of `sun` at `row` and `column` of 256 x 512.
    fn image(sky: f32, sun: [f32; 3], radius: f64, [column, row]: [u32; 2]) -> Rgb32FImage {
        let blank = Rgb32FImage::new(512, 256);
        let middle = pixel(&blank, column, row).direction;
        Rgb32FImage::from_fn(512, 256, |x, y| {
            let is_sun = pixel(&blank, x, y).direction.dot(middle) > radius.to_radians().cos();
            image::Rgb(if is_sun { sun } else { [if y < 128 { sky } else { sky / 2.0 }; 3] })
        })
    }

    /// Light that a matt white surface reflects with the normal `n`, without the lamp.
    fn reflected(light: &ImageLight, n: Vec3) -> Vec3 {
        let Vec3 { x, y, z } = n;
        let polynomials = [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y];
        light.around().reflected().iter().zip(polynomials).map(|(c, p)| *c * p).sum()
    }

    const SUN: [f32; 3] = [30_000.0, 24_000.0, 15_000.0];

    #[test]
    fn a_strong_sun_is_a_lamp_and_no_longer_in_the_light_from_all_sides() {
        for place in [[100, 60], [300, 20], [5, 100]] {
            let with = ImageLight::of_image(&image(1.0, SUN, 1.0, place), 0.8).expect("light");
            let sun = with.sun().expect("a sun");
            let toward = pixel(&image(1.0, SUN, 1.0, place), place[0], place[1]).direction.as_vec3();
            assert!(sun.toward.distance(toward) < 5e-3, "{} {toward}", sun.toward);
            assert!((luminance(sun.colour) - 1.0).abs() < 1e-3, "{}", sun.colour);
            let wanted = Vec3::from(SUN) / luminance(Vec3::from(SUN));
            assert!(sun.colour.distance(wanted) < 0.01, "{} {wanted}", sun.colour);
            // The rest is the light of the same image without it.
            let without = ImageLight::of_image(&image(1.0, [1.0; 3], 1.0, place), 0.8).expect("light");
            assert_eq!(without.sun(), None);
            for n in [Vec3::X, Vec3::Y, Vec3::NEG_Y, Vec3::NEG_Z, toward, -toward] {
                let apart = (reflected(&with, n) - reflected(&without, n)).abs().max_element();
                assert!(apart < 0.01, "{n}: {apart}");
            }
        }
    }

    #[test]
    fn what_is_no_sun_stays_in_the_light_from_all_sides() {
        let low = [100, 140];
        for (name, image) in [
            ("even", image(1.0, [1.0; 3], 1.0, [100, 60])),
            ("faint", image(1.0, [100.0; 3], 1.0, [100, 60])),
            ("wide", image(1.0, [40.0; 3], 25.0, [100, 60])),
            ("below the horizon", image(1.0, SUN, 1.0, low)),
            ("alone", image(0.0, SUN, 1.0, [100, 60])),
        ] {
            let light = ImageLight::of_image(&image, 0.8).expect("light");
            assert_eq!(light.sun(), None, "{name}");
            let whole = Harmonics::of_image(&image).without_ringing().with_mean(0.8);
            assert_eq!(Some(*light.around()), whole, "{name}");
        }
        assert_eq!(ImageLight::of_image(&image(0.0, [0.0; 3], 1.0, low), 0.8), None, "no light");
    }

    #[test]
    fn an_image_of_few_pixels_has_no_sun() {
        let mut image = Rgb32FImage::from_pixel(64, 32, image::Rgb([1.0; 3]));
        image.put_pixel(20, 8, image::Rgb(SUN));
        assert_eq!(ImageLight::of_image(&image, 0.8).expect("light").sun(), None);
    }

    #[test]
    fn the_sun_turns_with_the_rest() {
        let light = ImageLight::of_image(&image(1.0, SUN, 1.0, [256, 60]), 0.8).expect("light");
        let from_front = light.sun().expect("a sun").toward;
        assert!(from_front.x.abs() < 0.01 && from_front.z > 0.5, "{from_front}");
        let turned = light.turned(std::f32::consts::FRAC_PI_2);
        let from_left = turned.sun().expect("a sun").toward;
        assert!(from_left.x > 0.5 && (from_left.y - from_front.y).abs() < 1e-6, "{from_left}");
        assert_eq!(*turned.around(), light.around().turned(std::f32::consts::FRAC_PI_2));
    }

    #[test]
    fn a_sun_of_one_colour_is_not_brighter_than_the_lamp_of_the_evening() {
        let light = ImageLight::of_image(&image(1.0, [0.0, 0.0, 90_000.0], 1.0, [100, 60]), 0.8);
        let colour = light.expect("light").sun().expect("a sun").colour;
        assert!((colour.z - MOST_COLOUR).abs() < 1e-3 && colour.x < 0.01, "{colour}");
    }
}
