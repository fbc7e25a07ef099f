//! Light from all around in spherical harmonics of order 2: nine coefficients of each colour are enough for what a matt surface
//! reflects (Ramamoorthi and Hanrahan, "An efficient representation for irradiance environment maps", SIGGRAPH 2001).

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use glam::{DMat3, DVec3, Vec3};
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
/// Turn between neighbours of directions that are spread evenly along a spiral over the sphere, radians.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
/// Order of each coefficient.
const ORDER: [usize; 9] = [0, 1, 1, 1, 2, 2, 2, 2, 2];
/// Places between a pole and the equator, and round it, at which radiance is read.
const RINGS: usize = 24;
const ROUND: usize = 192;
/// Blur beyond which even light from a single direction rings no more: that needs 0.094.
const MOST_BLUR: f64 = 1.0;
/// Halvings of the range that the blur is looked for in.
const HALVINGS: usize = 40;
/// Normals from which the darkest one is looked for, and steps from there.
const PLACES: usize = 256;
const STEPS: usize = 200;

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
        for pixel in pixels(image, 0..image.height()) {
            add(&mut sum, pixel.direction, pixel.light * pixel.solid_angle);
        }
        Self(sum.map(|c| c.as_vec3()))
    }

    /// The light without `others`: unit directions, and the light from each, radiance times solid angle.
    #[must_use]
    pub(super) fn without(&self, others: impl Iterator<Item = (DVec3, DVec3)>) -> Self {
        let mut sum = self.0.map(|c| c.as_dvec3());
        others.for_each(|(direction, light)| add(&mut sum, direction, -light));
        Self(sum.map(|c| c.as_vec3()))
    }

    /// Mean over all directions, linear luminance.
    pub(super) fn mean(&self) -> f32 {
        luminance(self.0[0] * NORMS[0] as f32)
    }

    /// The same light, of which the mean over all directions is as bright as `mean` (linear luminance); None if there is no light.
    pub fn with_mean(self, mean: f32) -> Option<Self> {
        let own = self.mean();
        let factor = mean / own;
        (own > 0.0 && factor.is_finite()).then(|| Self(self.0.map(|c| c * factor)))
    }

    /// The same light, blurred by just so much that no matt surface reflects less than nothing of any colour. Harmonics of order 2
    /// ring round a small bright light: surfaces a little turned away from it are darker than dark, those turned farther away are
    /// bright again. Light that does not ring so stays as it is.
    ///
    /// The strength is chosen as by Sloan ("Stupid spherical harmonics (SH) tricks", GDC 2008: windowing). The window is that of heat
    /// that spreads on the sphere, as more of it never makes light negative again.
    #[must_use]
    pub fn without_ringing(self) -> Self {
        if self.least_reflected() >= 0.0 {
            return self;
        }
        let [mut too_little, mut enough] = [0.0, MOST_BLUR];
        for _ in 0..HALVINGS {
            let middle = (too_little + enough) / 2.0;
            match self.blurred(middle).least_reflected() < 0.0 {
                true => too_little = middle,
                false => enough = middle,
            }
        }
        self.blurred(enough)
    }

    /// The light after heat has spread for the time `blur` at unit diffusivity: order l times exp(-l (l + 1) `blur`).
    fn blurred(self, blur: f64) -> Self {
        let window = |order: usize| (-blur * (order * (order + 1)) as f64).exp() as f32;
        Self(std::array::from_fn(|i| self.0[i] * window(ORDER[i])))
    }

    /// The least light of a colour that a matt white surface reflects, whatever its normal.
    fn least_reflected(&self) -> f64 {
        let factors = self.reflected().map(|c| c.as_dvec3().to_array());
        (0..3).map(|colour| least(&factors.map(|c| c[colour]))).fold(f64::INFINITY, f64::min)
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

/// A pixel of an image of all directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixel {
    /// Unit vector towards its middle.
    pub direction: DVec3,
    /// Steradians.
    pub solid_angle: f64,
    /// Its radiance, linear RGB.
    pub light: DVec3,
}

/// The pixels in `rows` of an equirectangular image, placed as by [`Harmonics::of_image`].
pub(super) fn pixels(image: &Rgb32FImage, rows: Range<u32>) -> impl Iterator<Item = Pixel> {
    rows.flat_map(move |row| (0..image.width()).map(move |column| pixel(image, column, row)))
}

/// The pixel in a column and a row of an equirectangular image, placed as by [`Harmonics::of_image`].
pub(super) fn pixel(image: &Rgb32FImage, column: u32, row: u32) -> Pixel {
    let (width, height) = (f64::from(image.width()), f64::from(image.height()));
    let [upper, lower] = [0.0, 1.0].map(|below| (PI * (f64::from(row) + below) / height).cos());
    let turn = TAU * ((f64::from(column) + 0.5) / width - 0.5);
    let y = (upper + lower) / 2.0;
    let away = (1.0 - y * y).max(0.0).sqrt();
    Pixel {
        direction: DVec3::new(-away * turn.sin(), y, away * turn.cos()),
        solid_angle: (upper - lower) * TAU / width,
        light: Vec3::from(image.get_pixel(column, row).0).as_dvec3(),
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

/// So many directions, spread evenly over the sphere.
fn spread(count: usize) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let (y, turn) = (1.0 - (2 * i + 1) as f64 / count as f64, i as f64 * GOLDEN_ANGLE);
        let away = (1.0 - y * y).sqrt();
        DVec3::new(away * turn.cos(), y, away * turn.sin())
    })
}

/// The least value of the sum of the polynomials times `factors` for unit vectors: from the lowest of directions all round it goes
/// downhill by power iteration. To rounding, unless two valleys are equally deep, of which either is right.
fn least(factors: &[f64; 9]) -> f64 {
    let [_, y, z, x, xy, yz, zz, xz, xx_yy] = *factors;
    let value = |d: DVec3| factors.iter().zip(polynomials(d)).map(|(f, p)| f * p).sum::<f64>();
    let slope = DVec3::new(x, y, z);
    let twice_quadratic = DMat3::from_cols(
        DVec3::new(2.0 * xx_yy, xy, xz),
        DVec3::new(xy, -2.0 * xx_yy, yz),
        DVec3::new(xz, yz, 6.0 * zz),
    );
    // With its Frobenius norm on the diagonal the negated quadratic part is convex, so that no step goes uphill.
    let norm = twice_quadratic.to_cols_array().iter().map(|c| c * c).sum::<f64>().sqrt();
    let lowest = spread(PLACES).reduce(|a, b| if value(b) < value(a) { b } else { a }).unwrap_or(DVec3::Y);
    let downhill = |d: DVec3, _: usize| (d * norm - slope - twice_quadratic * d).normalize_or(d);
    value((0..STEPS).fold(lowest, downhill))
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

    /// A bright region of 2 by 2 pixels in a sky of even light, and the direction of its middle.
    fn sun_in(sky: f32) -> (Harmonics, Vec3) {
        let image = Rgb32FImage::from_fn(256, 128, |x, y| {
            let is_sun = (40..42).contains(&x) && (30..32).contains(&y);
            image::Rgb(if is_sun { [20_000.0, 18_000.0, 15_000.0] } else { [sky; 3] })
        });
        let [turn, from_above] = [(41.0 / 256.0 - 0.5) * TAU, 31.0 / 128.0 * PI];
        let (sin, cos) = from_above.sin_cos();
        (Harmonics::of_image(&image), DVec3::new(-sin * turn.sin(), cos, sin * turn.cos()).as_vec3())
    }

    /// Irradiance at these many degrees from `sun`, in several directions from it.
    fn away_from(light: &Harmonics, sun: Vec3, degrees: f32) -> Vec<Vec3> {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (side, other) = sun.any_orthonormal_pair();
        let around = (0..8).map(|i| (i as f32 * TAU as f32 / 8.0).sin_cos());
        around.map(|(s, c)| irradiance(light, sun * cos + (side * c + other * s) * sin)).collect()
    }

    #[test]
    fn light_of_a_small_sun_is_nowhere_negative_and_falls_off_away_from_it() {
        let (ringing, sun) = sun_in(0.001);
        let light = ringing.without_ringing();
        let peak = irradiance(&light, sun);
        assert!(ringing.least_reflected() < -0.01 * f64::from(peak.x), "it would ring");
        assert!(light.least_reflected() >= 0.0);
        let mut before = vec![peak; 8];
        for degrees in 1..=180 {
            let here = away_from(&light, sun, degrees as f32);
            for (here, before) in here.iter().zip(&before) {
                // Nine terms in single precision.
                assert!(here.cmpge(Vec3::splat(-1e-5) * peak).all(), "{degrees}: {here} of {peak}");
                assert!((*here - *before).cmple(0.002 * peak).all(), "{degrees}: {here} after {before}");
            }
            before = here;
        }
        let behind = irradiance(&light, -sun);
        assert!(behind.cmple(0.02 * peak).all(), "and it is dark behind: {behind} of {peak}");
        // The light as a whole stays, and so does where it comes from.
        assert_eq!(light.0[0], ringing.0[0]);
        let toward = |light: &Harmonics| Vec3::new(light.0[3].y, light.0[1].y, light.0[2].y).normalize();
        assert!(toward(&light).distance(toward(&ringing)) < 1e-5 && toward(&light).dot(sun) > 0.999);
    }

    #[test]
    fn light_that_does_not_ring_stays_as_it_is() {
        let smooth = Harmonics::of(|d| Vec3::new(1.0 + d.y, 1.2 + d.x * d.z, 0.7 + 0.5 * d.z));
        let (hazy, _) = sun_in(6.0);
        for light in [smooth, hazy, Harmonics([Vec3::ZERO; 9])] {
            assert_eq!(light.without_ringing(), light);
        }
        // Sky above and nothing below is dark just below.
        let half = Harmonics::of(|d| Vec3::splat(f32::from(u8::from(d.y > 0.0))));
        assert!(apart(&half.without_ringing(), &half) < 1e-3);
    }

    #[test]
    fn the_least_of_polynomials_is_found() {
        let mut random = [0.3, -0.8, 0.1, 0.9, -0.4, 0.6, 0.2, -0.7, 0.5];
        for _ in 0..20 {
            random.rotate_left(1);
            random[0] = -random[0] * 1.1 + 0.05;
            let value = |d: DVec3| random.iter().zip(polynomials(d)).map(|(f, p)| f * p).sum::<f64>();
            let mut lowest = f64::INFINITY;
            spread(20_000).for_each(|d| lowest = lowest.min(value(d)));
            let found = least(&random);
            assert!(found <= lowest + 1e-9 && found > lowest - 5e-3, "{found} {lowest}");
        }
    }

    #[test]
    fn brightness_is_set_and_darkness_refused() {
        let light = Harmonics::of(|d| Vec3::splat(50.0 + d.x)).with_mean(0.8).expect("light");
        assert!((irradiance(&light, Vec3::Y).x / PI as f32 - 0.8).abs() < 1e-4);
        assert_eq!(Harmonics::of(|_| Vec3::ZERO).with_mean(0.8), None);
    }
}
