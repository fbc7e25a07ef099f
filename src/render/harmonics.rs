//! Light from all around in spherical harmonics of order 2: nine coefficients of each colour are enough for what a matt surface
//! reflects (Ramamoorthi and Hanrahan, "An efficient representation for irradiance environment maps", SIGGRAPH 2001).

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};
use image::Rgb32FImage;

use super::srgb::luminance;

/// Radiance from every direction, as its coefficients in the real spherical harmonics of order 0 to 2: 1; y, z, x;
/// xy, yz, 3z² − 1, xz, x² − y², each normalised. Linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonics([Vec3; 9]);

/// Factors that normalise the polynomials of the harmonics.
const NORMS: [f64; 9] = [
    0.282_094_791_773_878_14,
    0.488_602_511_902_919_9,
    0.488_602_511_902_919_9,
    0.488_602_511_902_919_9,
    1.092_548_430_592_079_2,
    1.092_548_430_592_079_2,
    0.315_391_565_252_520_05,
    1.092_548_430_592_079_2,
    0.546_274_215_296_039_6,
];
/// What a matt surface makes of the harmonics of order 0, 1 and 2: the coefficients of the clamped cosine.
const COSINE: [f64; 3] = [PI, 2.0 * PI / 3.0, PI / 4.0];
/// Order of each coefficient.
const ORDER: [usize; 9] = [0, 1, 1, 1, 2, 2, 2, 2, 2];
/// Places between a pole and the equator, and round it, at which radiance is read.
const RINGS: usize = 24;
const ROUND: usize = 192;

impl Harmonics {
    /// The coefficients of `radiance` (linear RGB) of unit directions, by quadrature: exact to rounding for polynomials on either
    /// side of the horizon (y = 0).
    pub(super) fn of(radiance: impl Fn(Vec3) -> Vec3) -> Self {
        let mut sum = [DVec3::ZERO; 9];
        let nodes = gauss_legendre(RINGS);
        for half in [-0.5, 0.5] {
            for &(node, weight) in &nodes {
                let y = half + 0.5 * node;
                for i in 0..ROUND {
                    let turn = TAU * (i as f64 + 0.5) / ROUND as f64;
                    let away = (1.0 - y * y).sqrt();
                    let direction = DVec3::new(away * turn.sin(), y, away * turn.cos());
                    let light = radiance(direction.as_vec3()).as_dvec3();
                    add(&mut sum, direction, light * (0.5 * weight * TAU / ROUND as f64));
                }
            }
        }
        Self(sum.map(|c| c.as_vec3()))
    }

    /// The coefficients of an equirectangular image (linear, rows from straight above to straight below) whose middle is towards
    /// +z and whose right half is towards -x, as someone sees it who stands in it with the back to -z.
    pub fn of_image(image: &Rgb32FImage) -> Self {
        let mut sum = [DVec3::ZERO; 9];
        let (width, height) = (f64::from(image.width()), f64::from(image.height()));
        for (column, row, pixel) in image.enumerate_pixels() {
            let [upper, lower] = [0.0, 1.0].map(|below| (PI * (f64::from(row) + below) / height).cos());
            let turn = TAU * ((f64::from(column) + 0.5) / width - 0.5);
            let y = (upper + lower) / 2.0;
            let away = (1.0 - y * y).max(0.0).sqrt();
            let direction = DVec3::new(-away * turn.sin(), y, away * turn.cos());
            let solid_angle = (upper - lower) * TAU / width;
            add(&mut sum, direction, Vec3::from(pixel.0).as_dvec3() * solid_angle);
        }
        Self(sum.map(|c| c.as_vec3()))
    }

    /// The same light, of which the mean over all directions is as bright as `mean` (linear luminance); None if there is no light.
    pub fn with_mean(self, mean: f32) -> Option<Self> {
        let own = luminance(self.0[0] * NORMS[0] as f32);
        let factor = mean / own;
        (own > 0.0 && factor.is_finite()).then(|| Self(self.0.map(|c| c * factor)))
    }

    /// The same light turned by `angle` radians about the axis y, counter-clockwise as seen from above: at a quarter turn, what came
    /// from +z comes from +x.
    #[must_use]
    pub fn turned(&self, angle: f32) -> Self {
        let angle = f64::from(angle);
        let ((sin, cos), (sin_2, cos_2)) = (angle.sin_cos(), (2.0 * angle).sin_cos());
        let [constant, y, z, x, xy, yz, zz, xz, xx_yy] = self.0.map(|c| c.as_dvec3());
        // The normalised 3z² - 1 and x² - y² are combinations of 3y² - 1, which stays, and of x² - z², which turns with xz by twice
        // the angle.
        let half_root_3 = 0.75_f64.sqrt();
        let upright = -0.5 * zz - half_root_3 * xx_yy;
        let level = -half_root_3 * zz + 0.5 * xx_yy;
        let level_turned = level * cos_2 + xz * sin_2;
        let turned = [
            constant,
            y,
            z * cos - x * sin,
            x * cos + z * sin,
            xy * cos + yz * sin,
            yz * cos - xy * sin,
            -0.5 * upright - half_root_3 * level_turned,
            xz * cos_2 - level * sin_2,
            -half_root_3 * upright + 0.5 * level_turned,
        ];
        Self(turned.map(|c| c.as_vec3()))
    }

    /// Factors of the polynomials 1; y, z, x; xy, yz, 3z² - 1, xz, x² - y² of a normal, of which the sum is the light that a matt
    /// white surface reflects: the irradiance over π.
    pub(super) fn reflected(&self) -> [Vec3; 9] {
        std::array::from_fn(|i| self.0[i] * (COSINE[ORDER[i]] / PI * NORMS[i]) as f32)
    }
}

/// Adds `light` from a unit direction, radiance times solid angle.
fn add(sum: &mut [DVec3; 9], direction: DVec3, light: DVec3) {
    for ((c, polynomial), norm) in sum.iter_mut().zip(polynomials(direction)).zip(NORMS) {
        *c += light * (polynomial * norm);
    }
}

fn polynomials(d: DVec3) -> [f64; 9] {
    let DVec3 { x, y, z } = d;
    [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y]
}

/// Nodes and weights of Gauss and Legendre's quadrature with `count` nodes on -1..=1, by Newton's method.
fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    let node = |i: usize| {
        let mut x = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut before, mut here) = (1.0, x);
            for k in 2..=count {
                let k = k as f64;
                (before, here) = (here, ((2.0 * k - 1.0) * x * here - (k - 1.0) * before) / k);
            }
            slope = n * (x * here - before) / (x * x - 1.0);
            x -= here / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(node).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Irradiance of a surface with the normal `n`.
    fn irradiance(light: &Harmonics, n: Vec3) -> Vec3 {
        let n = n.normalize().as_dvec3();
        let terms = light.reflected().into_iter().zip(polynomials(n));
        terms.map(|(c, p)| c.as_dvec3() * p).sum::<DVec3>().as_vec3() * PI as f32
    }

    const NORMALS: [Vec3; 6] = [
        Vec3::X,
        Vec3::NEG_Y,
        Vec3::Z,
        Vec3::new(1.0, 2.0, -3.0),
        Vec3::new(-0.5, 0.1, 0.2),
        Vec3::new(0.3, 0.9, 0.1),
    ];

    #[test]
    fn constant_light_gives_pi_times_itself_everywhere() {
        let sky = Vec3::new(0.2, 1.0, 3.0);
        let light = Harmonics::of(|_| sky);
        for n in NORMALS {
            let error = (irradiance(&light, n) / sky - PI as f32).abs().max_element();
            assert!(error < 1e-5, "{n}: {error}");
        }
    }

    #[test]
    fn a_cosine_lobe_has_the_coefficients_of_the_paper() {
        // About the axis y the zonal coefficients are √π / 2, √(π / 3) and √(5 π) / 8; times √(4 π / (2 l + 1)) they are the
        // paper's 3.141593, 2.094395 and 0.785398.
        let Harmonics(c) = Harmonics::of(|d| Vec3::splat(d.y.max(0.0)));
        let order_2 = (5.0 * PI).sqrt() / 8.0;
        // The zonal harmonic about y is -½ (3z² - 1) - √3/2 (x² - y²) of the normalised ones.
        let wanted = [
            PI.sqrt() / 2.0,
            (PI / 3.0).sqrt(),
            0.0,
            0.0,
            0.0,
            0.0,
            -0.5 * order_2,
            0.0,
            -(3.0f64.sqrt()) / 2.0 * order_2,
        ];
        for (got, want) in c.iter().zip(wanted) {
            assert!((f64::from(got.x) - want).abs() < 1e-5, "{got} {want}");
        }
        let light = Harmonics::of(|d| Vec3::splat(d.y.max(0.0)));
        // 2 π / 3 is exact above; order 2 gives π (1/4 + 1/3 + 5/64) = 2.0780.
        let above = irradiance(&light, Vec3::Y).x;
        assert!((f64::from(above) - PI * (0.25 + 1.0 / 3.0 + 5.0 / 64.0)).abs() < 1e-5, "{above}");
        assert!((f64::from(above) / (2.0 * PI / 3.0) - 1.0).abs() < 0.01, "within the error of the method");
    }

    #[test]
    fn light_of_order_one_is_exact_in_every_direction() {
        for axis in NORMALS {
            let axis = axis.normalize();
            let light = Harmonics::of(|d| Vec3::splat(1.0 + d.dot(axis)));
            for n in NORMALS {
                let want = PI * (1.0 + 2.0 / 3.0 * f64::from(n.normalize().dot(axis)));
                let got = f64::from(irradiance(&light, n).y);
                assert!((got - want).abs() < 1e-5, "{axis} {n}: {got} {want}");
            }
        }
    }

    #[test]
    fn an_image_is_read_from_inside() {
        // Bright in the right half, which is towards -x, and below.
        let image = Rgb32FImage::from_fn(128, 64, |x, y| {
            image::Rgb([if x >= 64 { 1.0 } else { 0.0 }, if y >= 32 { 1.0 } else { 0.0 }, 1.0])
        });
        let light = Harmonics::of_image(&image);
        let [right, left] = [Vec3::NEG_X, Vec3::X].map(|n| irradiance(&light, n).x);
        let [down, up] = [Vec3::NEG_Y, Vec3::Y].map(|n| irradiance(&light, n).y);
        for (bright, dark) in [(right, left), (down, up)] {
            // A bright half gives π and 0; order 2 comes within a tenth.
            assert!((bright - PI as f32).abs() < 0.2 && dark.abs() < 0.2, "{bright} {dark}");
        }
        assert!((irradiance(&light, Vec3::Z).z - PI as f32).abs() < 1e-3, "even light");
        let middle =
            Rgb32FImage::from_fn(128, 64, |x, _| image::Rgb([f32::from(u8::from((48..80).contains(&x))); 3]));
        let light = Harmonics::of_image(&middle);
        assert!(
            irradiance(&light, Vec3::Z).x > 4.0 * irradiance(&light, Vec3::NEG_Z).x,
            "the middle is before one"
        );
    }

    /// The largest difference of two lights' coefficients.
    fn apart(a: &Harmonics, b: &Harmonics) -> f32 {
        a.0.iter().zip(b.0).map(|(a, b)| (*a - b).abs().max_element()).fold(0.0, f32::max)
    }

    #[test]
    fn the_light_of_a_turned_image_is_its_light_turned() {
        // Different in every pixel, and like itself in no turn.
        let image = Rgb32FImage::from_fn(64, 32, |x, y| {
            let (x, y) = (x as f32, y as f32);
            image::Rgb([x * x / 64.0 + y, (x * 0.7 + y * 0.31).sin() + 2.0, if x < 9.0 { 40.0 } else { 1.0 }])
        });
        let light = Harmonics::of_image(&image);
        assert!(apart(&light.turned(0.0), &light) < 1e-5);
        for columns in [1, 16, 21, 32, 50] {
            let turned = Rgb32FImage::from_fn(64, 32, |x, y| *image.get_pixel((x + columns) % 64, y));
            let angle = TAU as f32 * columns as f32 / 64.0;
            let turned = Harmonics::of_image(&turned);
            let [error, change] = [light.turned(angle), light].map(|light| apart(&light, &turned));
            assert!(error < 1e-5 * apart(&light, &Harmonics([Vec3::ZERO; 9])), "{columns}: {error}");
            assert!(change > 0.1, "{columns}: the image is another, {change}");
        }
    }

    #[test]
    fn light_turns_counter_clockwise_from_above() {
        let front = Harmonics::of(|d| Vec3::splat(d.z.max(0.0)));
        let left = Harmonics::of(|d| Vec3::splat(d.x.max(0.0)));
        assert!(apart(&front.turned(std::f32::consts::FRAC_PI_2), &left) < 1e-5);
        let up = Harmonics::of(|d| Vec3::splat(d.y.max(0.0)));
        assert!(apart(&up.turned(1.0), &up) < 1e-5, "light from above stays");
        assert!(apart(&front.turned(0.4).turned(0.5), &front.turned(0.9)) < 1e-5);
    }

    #[test]
    fn brightness_is_set_and_darkness_refused() {
        let light = Harmonics::of(|d| Vec3::splat(50.0 + d.x)).with_mean(0.8).expect("light");
        assert!((irradiance(&light, Vec3::Y).x / PI as f32 - 0.8).abs() < 1e-4);
        assert_eq!(Harmonics::of(|_| Vec3::ZERO).with_mean(0.8), None);
    }
}
