//! What surrounds a picture's scene and lights it from all sides: a sky and a ground, and bright rectangles in them, such as
//! softboxes. Matt surfaces take it as spherical harmonics, glossy ones reflect it. It turns with the eye, as the lamp does.

use std::sync::LazyLock;

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3, Vec4};

use super::harmonics::Harmonics;
use super::light::Light;
use super::wgsl::smoothstep;

/// Radiance around a scene, relative to the strength of light from everywhere (`Look::ambient`). Linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Environment {
    /// Straight above, at the horizon and straight below; linear in the height between them.
    gradient: [Vec3; 3],
    boxes: [Softbox; 2],
}

/// A bright rectangle far away.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Softbox {
    /// How far left of the eye its middle is, and how far above the horizon, radians.
    turn_rise: Vec2,
    /// Tangents of half its width and height, seen from the scene.
    half: Vec2,
    /// Width of its soft border, as a tangent.
    edge: f32,
    /// Its radiance, linear.
    light: Vec3,
}

/// The environment as shaders read it. It matches `Surroundings` in shaders/frame.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Surroundings {
    reflected: [Vec4; 9],
    gradient: [Vec4; 3],
    boxes: [[Vec4; 3]; 2],
    turned: Vec4,
}

/// Mean luminance of the studio's environment, to which images are set.
pub const MEAN_LIGHT: f32 = 0.8;

impl Environment {
    // The mean light on what the eye sees, and how it grows from below to above, are those of a plain two-colour light from above
    // and below that the rest of the look was tuned for.
    fn of(light: Light) -> Self {
        let softbox = |turn, rise, half: [f32; 2], edge, light: [f32; 3]| Softbox {
            turn_rise: Vec2::new(turn, rise),
            half: half.into(),
            edge,
            light: light.into(),
        };
        let of = |gradient: [[f32; 3]; 3], boxes| Self { gradient: gradient.map(Vec3::from), boxes };
        match light {
            // A softbox round the lamp, and a narrow upright one on the other side.
            Light::Studio => of(
                [[0.788, 0.811, 0.844], [0.714, 0.699, 0.699], [0.640, 0.588, 0.554]],
                [
                    softbox(0.72, 0.5, [0.17, 0.28], 0.06, [4.0, 4.0, 4.1]),
                    softbox(-1.2, 0.15, [0.06, 0.75], 0.05, [3.0, 3.0, 3.15]),
                ],
            ),
            // The glow round the sun, and a bright cloud.
            Light::Daylight => of(
                [[0.556, 0.780, 1.176], [0.854, 0.871, 0.886], [0.592, 0.562, 0.517]],
                [
                    softbox(0.5, 0.95, [0.2, 0.2], 0.2, [3.2, 3.0, 2.5]),
                    softbox(-1.6, 0.2, [0.6, 0.22], 0.2, [0.5, 0.52, 0.56]),
                ],
            ),
            // The glow round the low sun, and the paler sky across from it.
            Light::Evening => of(
                [[0.398, 0.628, 1.207], [0.702, 0.569, 0.633], [0.606, 0.430, 0.299]],
                [
                    softbox(1.05, 0.26, [0.3, 0.15], 0.15, [4.6, 2.4, 0.95]),
                    softbox(-1.7, 0.12, [0.8, 0.16], 0.15, [0.6, 0.36, 0.45]),
                ],
            ),
        }
    }

    /// Radiance from the unit `direction`, in the frame in which the eye is towards +z. As `mirrored_light` in
    /// shaders/material.wgsl for a perfect mirror.
    fn radiance(&self, direction: Vec3) -> Vec3 {
        let [zenith, horizon, nadir] = self.gradient;
        let [up, down] = [direction.y.max(0.0), (-direction.y).max(0.0)];
        let sky = horizon + (zenith - horizon) * up + (nadir - horizon) * down;
        self.boxes.iter().fold(sky, |light, softbox| light + softbox.light * softbox.share(direction))
    }
}

impl Softbox {
    /// Unit vectors towards its middle and to its right.
    fn axes(&self) -> [Vec3; 2] {
        let [(turned, ahead), (risen, level)] = self.turn_rise.to_array().map(f32::sin_cos);
        let toward = Vec3::new(-turned * level, risen, ahead * level);
        [toward, Vec3::Y.cross(toward).normalize()]
    }

    /// How much of it is seen in the unit `direction`, 0..=1.
    fn share(&self, direction: Vec3) -> f32 {
        let [toward, right] = self.axes();
        let ahead = direction.dot(toward);
        let place = Vec2::new(direction.dot(right), direction.dot(toward.cross(right))) / ahead.max(0.05);
        let within = |at: f32, half: f32| {
            smoothstep(-1.0, 1.0, (at + half) / self.edge) - smoothstep(-1.0, 1.0, (at - half) / self.edge)
        };
        within(place.x, self.half.x) * within(place.y, self.half.y) * smoothstep(0.0, 0.2, ahead)
    }
}

/// What matt surfaces reflect of each environment, in the order of [`Light::ALL`].
static REFLECTED: LazyLock<[[Vec3; 9]; 3]> = LazyLock::new(|| {
    Light::ALL.map(|light| {
        let environment = Environment::of(light);
        Harmonics::of(|direction| environment.radiance(direction)).reflected()
    })
});

impl Surroundings {
    /// Those of `light`, seen from `yaw` (radians about y, 0 from +z); or `image`, which stays where it is when the eye turns.
    pub(super) fn new(light: Light, image: Option<&Harmonics>, yaw: f32) -> Self {
        let (sin, cos) = if image.is_some() { (0.0, 1.0) } else { yaw.sin_cos() };
        let environment = Environment::of(light);
        let reflected = match image {
            Some(image) => image.reflected(),
            None => REFLECTED[Light::ALL.iter().position(|other| *other == light).unwrap_or(0)],
        };
        let boxes = environment.boxes.map(|softbox| {
            let [toward, right] = softbox.axes();
            let Vec2 { x: half_width, y: half_height } = softbox.half;
            [toward.extend(half_width), right.extend(half_height), softbox.light.extend(softbox.edge)]
        });
        Self {
            reflected: reflected.map(|c| c.extend(0.0)),
            gradient: environment.gradient.map(|c| c.extend(0.0)),
            boxes,
            turned: Vec4::new(cos, sin, f32::from(image.is_some()), 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::srgb::luminance;

    /// Light that a matt white surface reflects with the normal `n`, in the frame of the eye.
    fn reflected(light: Light, n: Vec3) -> Vec3 {
        let Vec3 { x, y, z } = n;
        let polynomials = [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y];
        let factors = Surroundings::new(light, None, 0.0).reflected;
        factors.iter().zip(polynomials).map(|(c, p)| c.truncate() * p).sum()
    }

    #[test]
    fn what_the_eye_sees_is_as_bright_as_in_plain_light() {
        // The two colours from below and above that pictures had before, times the tints of the lights.
        let [below, above] = [Vec3::new(0.72, 0.68, 0.66), Vec3::new(1.02, 1.03, 1.06)];
        let tints = [
            [Vec3::ONE; 2],
            [Vec3::new(0.98, 1.0, 0.96), Vec3::new(0.86, 0.98, 1.16)],
            [Vec3::new(1.02, 0.76, 0.62), Vec3::new(0.68, 0.68, 0.98)],
        ];
        for (light, tints) in Light::ALL.into_iter().zip(tints) {
            let plain = |n: Vec3| (below * tints[0]).lerp(above * tints[1], n.y * 0.5 + 0.5);
            let (mut new, mut old) = (Vec3::ZERO, Vec3::ZERO);
            for i in 0..40 {
                for j in 0..80 {
                    // Evenly over the disc that a sphere is in the picture.
                    let (r, turn) =
                        (((i as f32 + 0.5) / 40.0).sqrt(), j as f32 / 80.0 * std::f32::consts::TAU);
                    let n = Vec3::new(r * turn.cos(), r * turn.sin(), (1.0 - r * r).sqrt());
                    new += reflected(light, n);
                    old += plain(n);
                }
            }
            let change = (new / old - 1.0).abs().max_element();
            assert!(change < 0.02, "{light:?}: {}", new / old);
        }
    }

    #[test]
    fn no_surface_is_dark_and_the_side_of_the_lamp_is_brighter() {
        for light in Light::ALL {
            let lamp = Vec3::new(-0.6, 0.4, 0.7).normalize();
            assert!(reflected(light, lamp).y > reflected(light, -lamp).y, "{light:?}");
            for i in 0..200 {
                let (y, turn) = (i as f32 / 100.0 - 0.995, i as f32 * 2.4);
                let away = (1.0 - y * y).sqrt();
                let least =
                    reflected(light, Vec3::new(away * turn.cos(), y, away * turn.sin())).min_element();
                assert!(least > 0.2, "{light:?}: {least}");
            }
        }
    }

    #[test]
    fn a_softbox_is_bright_inside_and_nowhere_else() {
        let studio = Environment::of(Light::Studio);
        for softbox in studio.boxes {
            let [toward, right] = softbox.axes();
            assert!((softbox.share(toward) - 1.0).abs() < 1e-5);
            let beside = (toward + right * (softbox.half.x + softbox.edge) * 1.01).normalize();
            assert!(softbox.share(beside) < 1e-6 && softbox.share(-toward) == 0.0);
            let border = (toward + right * softbox.half.x).normalize();
            assert!((softbox.share(border) - 0.5).abs() < 1e-3, "half at its border");
        }
        let [zenith, ..] = studio.gradient;
        assert!((studio.radiance(Vec3::Y) - zenith).abs().max_element() < 1e-6);
    }

    #[test]
    fn images_are_as_bright_as_the_studio() {
        let mean = Harmonics::of(|d| Environment::of(Light::Studio).radiance(d)).reflected()[0];
        let luminance = luminance(mean);
        assert!((luminance / MEAN_LIGHT - 1.0).abs() < 0.02, "{luminance}");
    }
}
