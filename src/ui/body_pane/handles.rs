//! Handles (arrows and rings) that move and turn placed pieces along and about the axes of space.

use egui::{Color32, Painter, Pos2, Shape, Stroke};
use glam::{DQuat, DVec3};

use crate::drag::Ray;

/// Length of an arrow, points.
const ARROW: f32 = 78.0;
/// Radius of a ring seen from the front, points.
const RING: f32 = 56.0;
/// Half the size of an arrow's head, points.
const HEAD: f32 = 6.0;
/// Number of straight segments of a ring.
const SIDES: usize = 48;
/// Largest distance of the pointer from a handle, points.
const NEAR: f32 = 7.0;
/// Smallest cosine between the pointer's ray and a ring's axis, or sine between the ray and an arrow, at which the handle can be
/// dragged.
const FLAT: f64 = 0.08;
/// The axes of the handles: across the body, up, and to the front.
pub(super) const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];
const COLOURS: [Color32; 3] = [
    Color32::from_rgb(0xc8, 0x4a, 0x42),
    Color32::from_rgb(0x3f, 0x8f, 0x3c),
    Color32::from_rgb(0x3d, 0x6f, 0xc4),
];

/// A handle that can be dragged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Handle {
    /// Moves along an axis of space.
    Arrow(usize),
    /// Turns about an axis of space.
    Ring(usize),
    /// The piece itself: moves in the plane of the screen.
    Piece,
}

/// The handles around a point, in screen coordinates.
pub(super) struct Handles {
    arrows: Vec<(usize, [Pos2; 2])>,
    rings: Vec<(usize, Vec<Pos2>)>,
}

impl Handles {
    /// Handles around `centre`, where a screen point is `metres` long. `at` projects points of space to the screen.
    pub fn new(centre: DVec3, metres: f64, at: impl Fn(DVec3) -> Option<Pos2>) -> Self {
        let arrow = |k: usize| Some((k, [at(centre)?, at(centre + AXES[k] * (metres * f64::from(ARROW)))?]));
        let ring = |k: usize| {
            let [u, v] = [AXES[(k + 1) % 3], AXES[(k + 2) % 3]];
            let point = |i: usize| {
                let (sin, cos) = (std::f64::consts::TAU * i as f64 / SIDES as f64).sin_cos();
                at(centre + (u * cos + v * sin) * (metres * f64::from(RING)))
            };
            Some((k, (0..=SIDES).map(point).collect::<Option<Vec<Pos2>>>()?))
        };
        Self { arrows: (0..3).filter_map(arrow).collect(), rings: (0..3).filter_map(ring).collect() }
    }

    /// The handle under a point of the screen.
    pub fn under(&self, at: Pos2) -> Option<Handle> {
        let arrows = self.arrows.iter().filter_map(|(k, [from, to])| {
            let (away, share) = from_line(at, *from, *to);
            // Near the centre all handles would be under the pointer.
            (share > 0.25).then_some((Handle::Arrow(*k), away))
        });
        let rings = self.rings.iter().map(|(k, points)| {
            let sides = points.windows(2).map(|w| from_line(at, w[0], w[1]).0);
            (Handle::Ring(*k), sides.fold(f32::INFINITY, f32::min))
        });
        let nearest = arrows.chain(rings).min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.filter(|(_, away)| *away <= NEAR).map(|(handle, _)| handle)
    }

    pub fn draw(&self, painter: &Painter, hot: Option<Handle>, halo: Color32) {
        for (width, is_halo) in [(4.5, true), (2.0, false)] {
            for (k, points) in &self.rings {
                let ink = ink(COLOURS[*k], hot == Some(Handle::Ring(*k)));
                let stroke = Stroke::new(width, if is_halo { halo } else { ink });
                painter.add(Shape::line(points.clone(), stroke));
            }
            for (k, [from, to]) in &self.arrows {
                let ink = ink(COLOURS[*k], hot == Some(Handle::Arrow(*k)));
                let stroke = Stroke::new(width, if is_halo { halo } else { ink });
                let along = (*to - *from).normalized();
                if (*to - *from).length() < 2.0 * HEAD {
                    continue; // It points at the eye.
                }
                painter.line_segment([*from, *to - along * HEAD], stroke);
                if !is_halo {
                    let across = along.rot90() * HEAD * 0.8;
                    let base = *to - along * (2.0 * HEAD);
                    painter.add(Shape::convex_polygon(
                        vec![*to, base + across, base - across],
                        ink,
                        Stroke::NONE,
                    ));
                }
            }
        }
    }
}

fn ink(colour: Color32, hot: bool) -> Color32 {
    if hot { Color32::from_rgb(0xf2, 0xb0, 0x1e) } else { colour }
}

/// Distance of `at` from a line segment, and the fraction along it of the nearest point.
fn from_line(at: Pos2, from: Pos2, to: Pos2) -> (f32, f32) {
    let along = to - from;
    let share = ((at - from).dot(along) / along.length_sq().max(1e-6)).clamp(0.0, 1.0);
    ((from + along * share).distance(at), share)
}

/// Where a ray grabs a handle around `centre`: metres along an arrow's axis, radians on a ring, or for a piece the point in the
/// plane through `centre` perpendicular to `eye`. None where this cannot be determined.
pub(super) fn hold(handle: Handle, centre: DVec3, eye: DVec3, ray: Ray) -> Option<Held> {
    let direction = ray.direction.normalize_or_zero();
    let on_plane = |normal: DVec3| {
        let slope = direction.dot(normal);
        let far = (centre - ray.origin).dot(normal) / slope;
        (slope.abs() > FLAT && far > 0.0).then(|| ray.origin + direction * far)
    };
    match handle {
        Handle::Arrow(k) => {
            // The point of the axis nearest to the ray.
            let (axis, off) = (AXES[k], centre - ray.origin);
            let cosine = axis.dot(direction);
            let square = 1.0 - cosine * cosine;
            (square > FLAT * FLAT)
                .then(|| Held::Along((off.dot(direction) * cosine - off.dot(axis)) / square))
        }
        Handle::Ring(k) => {
            let at = on_plane(AXES[k])? - centre;
            let (x, y) = (at.dot(AXES[(k + 1) % 3]), at.dot(AXES[(k + 2) % 3]));
            Some(Held::Round(y.atan2(x)))
        }
        Handle::Piece => on_plane(eye).map(Held::At),
    }
}

/// The position at which a handle is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Held {
    Along(f64),
    Round(f64),
    At(DVec3),
}

/// The rotation about the centre and the translation of a handle dragged `from` one position `to` another. `steps`: the rotation
/// is a multiple of 15 degrees.
pub(super) fn done(handle: Handle, from: Held, to: Held, steps: bool) -> (DQuat, DVec3) {
    match (handle, from, to) {
        (Handle::Arrow(k), Held::Along(from), Held::Along(to)) => (DQuat::IDENTITY, AXES[k] * (to - from)),
        (Handle::Ring(k), Held::Round(from), Held::Round(to)) => {
            let step = std::f64::consts::PI / 12.0;
            let angle = if steps { ((to - from) / step).round() * step } else { to - from };
            (DQuat::from_axis_angle(AXES[k], angle), DVec3::ZERO)
        }
        (_, Held::At(from), Held::At(to)) => (DQuat::IDENTITY, to - from),
        _ => (DQuat::IDENTITY, DVec3::ZERO),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From the front: a metre is a hundred points, y runs down.
    fn on_screen(p: DVec3) -> Option<Pos2> {
        Some(Pos2::new(p.x as f32 * 100.0, -p.y as f32 * 100.0))
    }

    fn ray(x: f64, y: f64) -> Ray {
        Ray { origin: DVec3::new(x, y, 10.0), direction: DVec3::NEG_Z }
    }

    #[test]
    fn each_handle_is_found_where_it_is_drawn() {
        let handles = Handles::new(DVec3::ZERO, 0.01, on_screen);
        assert_eq!(handles.under(Pos2::new(70.0, 1.0)), Some(Handle::Arrow(0)));
        assert_eq!(handles.under(Pos2::new(0.0, -72.0)), Some(Handle::Arrow(1)));
        let turned = RING * std::f32::consts::FRAC_1_SQRT_2;
        assert_eq!(
            handles.under(Pos2::new(turned, turned)),
            Some(Handle::Ring(2)),
            "the ring that faces the eye"
        );
        assert_eq!(handles.under(Pos2::new(20.0, 20.0)), None);
        assert_eq!(handles.under(Pos2::new(200.0, 0.0)), None);
    }

    #[test]
    fn what_is_held_follows_the_pointer() {
        let (centre, eye) = (DVec3::new(0.5, 1.0, 0.0), DVec3::Z);
        let moved = |handle: Handle, from: Ray, to: Ray, steps: bool| {
            let [a, b] = [from, to].map(|ray| hold(handle, centre, eye, ray).expect("held"));
            done(handle, a, b, steps)
        };
        let (turn, by) = moved(Handle::Arrow(0), ray(0.6, 1.0), ray(0.9, 1.4), false);
        assert!(turn.is_near_identity() && by.distance(DVec3::X * 0.3) < 1e-12, "{by}");
        let (_, by) = moved(Handle::Piece, ray(0.6, 1.0), ray(0.9, 1.4), false);
        assert!(by.distance(DVec3::new(0.3, 0.4, 0.0)) < 1e-12);
        let (turn, by) = moved(Handle::Ring(2), ray(1.0, 1.0), ray(0.5, 1.7), false);
        assert!((turn * DVec3::X).distance(DVec3::Y) < 1e-12 && by == DVec3::ZERO);
        let (turn, _) = moved(Handle::Ring(2), ray(1.0, 1.0), ray(1.0, 1.2), true);
        assert!((turn * DVec3::X).angle_between(DVec3::X) - std::f64::consts::PI / 12.0 < 1e-12, "in steps");
        // A ring seen from its edge and an arrow that points at the eye cannot be held.
        assert!(hold(Handle::Ring(0), centre, eye, ray(0.5, 1.2)).is_none());
        assert!(hold(Handle::Arrow(2), centre, eye, ray(0.5, 1.0)).is_none());
    }
}
