//! An orbit camera.

use glam::camera::rh::proj::directx;
use glam::{Mat4, Quat, Vec2, Vec3, Vec4};

use super::View;

/// The projection of a camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// Perspective: far things are smaller.
    #[default]
    Perspective,
    /// Parallel (orthographic): sizes can be compared at any depth.
    Orthographic,
}

/// A ray into the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelRay {
    /// Origin, metres: the eye, or for a parallel projection a point in front of everything.
    pub origin: Vec3,
    /// Direction, unit length.
    pub direction: Vec3,
}

/// A world point projected to a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected {
    /// Position in pixels from the upper left corner.
    pub pixel: Vec2,
    /// Depth in metres in front of the plane through the eye.
    pub depth: f32,
}

/// A camera at `distance` from `pivot`, which it looks at. Metres and radians; pixels count right and down from the upper left
/// corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Centre of rotation, metres.
    pub pivot: Vec3,
    /// Rotation from view to world; in view space x is right, y is up and z points towards the eye.
    pub rotation: Quat,
    /// Distance from the pivot to the eye, metres.
    pub distance: f32,
    /// Vertical field of view, radians.
    pub fov_y: f32,
    /// Perspective or parallel projection.
    pub projection: Projection,
    /// Centre and radius (metres) of a sphere that the near and far planes never cut.
    pub bounds: (Vec3, f32),
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            pivot: Vec3::new(0.0, 0.9, 0.0),
            rotation: Quat::IDENTITY,
            distance: 4.0,
            fov_y: 28f32.to_radians(),
            projection: Projection::Perspective,
            bounds: (Vec3::new(0.0, 0.9, 0.0), 1.2),
        }
    }
}

/// Size of the picture relative to that of a framed box; the excess is free space around it.
const MARGIN: f32 = 1.07;

impl Camera {
    /// A camera that shows the whole box from `view`. `aspect` is width over height.
    pub fn framing(lower: Vec3, upper: Vec3, view: View, aspect: f32) -> Self {
        let mut camera = Self::default();
        camera.look(view);
        camera.frame(lower, upper, aspect);
        camera
    }

    /// Turns to a named view; pivot and distance stay.
    pub fn look(&mut self, view: View) {
        let (yaw, pitch) = view.angles();
        self.rotation = Quat::from_rotation_y(yaw) * Quat::from_rotation_x(-pitch);
    }

    /// Moves the pivot and the eye so that the whole box is visible, without turning. `aspect` is width over height.
    pub fn frame(&mut self, lower: Vec3, upper: Vec3, aspect: f32) {
        let corner = |i: i32| {
            let pick = |bit: i32, lo: f32, hi: f32| if i & bit == 0 { lo } else { hi };
            Vec3::new(pick(1, lower.x, upper.x), pick(2, lower.y, upper.y), pick(4, lower.z, upper.z))
        };
        self.frame_points(&(0..8).map(corner).collect::<Vec<_>>(), aspect);
    }

    /// Moves the pivot and the eye so that all of `points` are visible and fill the picture, without turning. Without points
    /// nothing moves.
    pub fn frame_points(&mut self, points: &[Vec3], aspect: f32) {
        let Some(&first) = points.first() else { return };
        let (lower, upper) = points.iter().fold((first, first), |(lo, hi), &p| (lo.min(p), hi.max(p)));
        self.set_bounds(lower, upper);
        self.pivot = (lower + upper) / 2.0;
        // In perspective the centre of the picture is not the centre of the points; a few iterations find it.
        for _ in 0..4 {
            self.distance = self.fitting_distance(points, aspect);
            self.pivot += self.rotation * self.off_centre(points).extend(0.0);
        }
        self.distance = self.fitting_distance(points, aspect);
    }

    /// The distance (metres) from which all of `points` are visible with the present pivot.
    fn fitting_distance(&self, points: &[Vec3], aspect: f32) -> f32 {
        let tan_y = (self.fov_y / 2.0).tan();
        let tan_x = tan_y * aspect.max(1e-3);
        let turn = self.rotation.inverse();
        let distance = points.iter().fold(0.0f32, |far, &p| {
            let p = turn * (p - self.pivot);
            let towards = if self.projection == Projection::Perspective { p.z } else { 0.0 };
            far.max(towards + MARGIN * (p.x.abs() / tan_x).max(p.y.abs() / tan_y))
        });
        distance.max(1e-3)
    }

    /// Centre of the points' bounding box in the picture, as an offset from the pivot in the plane through it, metres right and
    /// up.
    fn off_centre(&self, points: &[Vec3]) -> Vec2 {
        let turn = self.rotation.inverse();
        let seen = points.iter().map(|&p| {
            let p = turn * (p - self.pivot);
            let scale = match self.projection {
                Projection::Perspective => self.distance / (self.distance - p.z).max(1e-6),
                Projection::Orthographic => 1.0,
            };
            p.truncate() * scale
        });
        let range = seen.map(|p| (p, p)).reduce(|(a, b), (c, d)| (a.min(c), b.max(d)));
        range.map_or(Vec2::ZERO, |(lower, upper)| (lower + upper) / 2.0)
    }

    /// Sets `bounds` to the sphere around a box, without moving.
    pub fn set_bounds(&mut self, lower: Vec3, upper: Vec3) {
        self.bounds = ((lower + upper) / 2.0, ((upper - lower) / 2.0).length().max(1e-3));
    }

    /// Unit vector from the pivot to the eye.
    pub fn towards_eye(&self) -> Vec3 {
        self.rotation * Vec3::Z
    }

    /// Position of the eye, metres. With a parallel projection the picture does not depend on its distance.
    pub fn eye(&self) -> Vec3 {
        self.pivot + self.towards_eye() * self.eye_distance()
    }

    fn eye_distance(&self) -> f32 {
        match self.projection {
            Projection::Perspective => self.distance,
            Projection::Orthographic => (self.pivot - self.bounds.0).length() + self.bounds.1 * 1.5,
        }
    }

    /// The view matrix: view space from world space.
    pub fn view(&self) -> Mat4 {
        let turn = self.rotation.inverse();
        Mat4::from_rotation_translation(turn, turn * -self.eye())
    }

    /// The projection matrix: clip space from view space, with reversed depth (1 near, 0 far).
    pub fn projection(&self, aspect: f32) -> Mat4 {
        match self.projection {
            // An infinite far plane, and a near plane close enough to pass between the eye and anything it can look at.
            Projection::Perspective => directx::perspective_infinite_reverse(self.fov_y, aspect, self.near()),
            Projection::Orthographic => {
                let (w, h) = (self.half_height() * aspect, self.half_height());
                let far = self.eye_distance() + (self.pivot - self.bounds.0).length() + self.bounds.1 * 1.5;
                directx::orthographic(-w, w, -h, h, far, 0.0)
            }
        }
    }

    /// Depth of the near plane of a perspective picture, metres: what is nearer is not drawn.
    pub(super) fn near(&self) -> f32 {
        self.distance * 2e-3
    }

    /// Half the height of the picture in the plane through the pivot, metres.
    pub fn half_height(&self) -> f32 {
        self.distance * (self.fov_y / 2.0).tan()
    }

    /// Size of a pixel in the plane through the pivot, metres.
    pub fn metres_per_pixel(&self, size: Vec2) -> f32 {
        2.0 * self.half_height() / size.y.max(1.0)
    }

    /// The ray through `pixel` of a picture of `size` pixels.
    pub fn ray(&self, pixel: Vec2, size: Vec2) -> PixelRay {
        let ndc = Vec2::new(2.0 * pixel.x / size.x - 1.0, 1.0 - 2.0 * pixel.y / size.y);
        let aspect = size.x / size.y;
        let tan = (self.fov_y / 2.0).tan();
        match self.projection {
            Projection::Perspective => PixelRay {
                origin: self.eye(),
                direction: (self.rotation * Vec3::new(ndc.x * tan * aspect, ndc.y * tan, -1.0)).normalize(),
            },
            Projection::Orthographic => {
                let h = self.half_height();
                PixelRay {
                    origin: self.eye() + self.rotation * Vec3::new(ndc.x * h * aspect, ndc.y * h, 0.0),
                    direction: self.rotation * Vec3::NEG_Z,
                }
            }
        }
    }

    /// Projects `point` to a picture of `size` pixels; None if it is behind the eye.
    pub fn project(&self, point: Vec3, size: Vec2) -> Option<Projected> {
        let in_view = self.view().transform_point3(point);
        let clip: Vec4 = self.projection(size.x / size.y) * in_view.extend(1.0);
        if in_view.z >= 0.0 || clip.w <= 0.0 {
            return None;
        }
        let ndc = clip.truncate() / clip.w;
        Some(Projected {
            pixel: Vec2::new((ndc.x + 1.0) * size.x / 2.0, (1.0 - ndc.y) * size.y / 2.0),
            depth: -in_view.z,
        })
    }

    /// Turntable rotation: right and left about the world's y axis, up and down about the view's x axis, which stops at the
    /// poles. `turn` is the rotation of the scene with the pointer, radians, right and down.
    pub fn orbit(&mut self, turn: Vec2) {
        let upright = (self.rotation * Vec3::Y).y >= -1e-4;
        let pitch = self.towards_eye().y.clamp(-1.0, 1.0).asin();
        let right_angle = std::f32::consts::FRAC_PI_2;
        let tilt = if upright { (pitch + turn.y).clamp(-right_angle, right_angle) - pitch } else { turn.y };
        self.rotation =
            (Quat::from_rotation_y(-turn.x) * self.rotation * Quat::from_rotation_x(-tilt)).normalize();
    }

    /// Virtual trackball rotation for a drag from one pixel to another: a sphere that continues as a hyperbolic sheet (Bell's,
    /// described in Henriksen, Sporring and Hornbaek 2004).
    pub fn trackball(&mut self, from: Vec2, to: Vec2, size: Vec2) {
        let on_ball = |p: Vec2| {
            let q = (p - size / 2.0) * Vec2::new(1.0, -1.0) / (0.5 * size.min_element().max(1.0));
            let r2 = q.length_squared();
            let z = if r2 < 0.5 { (1.0 - r2).sqrt() } else { 0.5 / r2.sqrt() };
            q.extend(z).normalize()
        };
        let turn = Quat::from_rotation_arc(on_ball(from), on_ball(to));
        self.rotation = (self.rotation * turn.inverse()).normalize();
    }

    /// Moves the pivot so that the scene follows the pointer, by `pixels` right and down.
    pub fn pan(&mut self, pixels: Vec2, size: Vec2) {
        let scale = self.metres_per_pixel(size);
        self.pivot += self.rotation * Vec3::new(-pixels.x * scale, pixels.y * scale, 0.0);
    }

    /// Scales the distance by `factor` (below 1 moves closer) while `target` stays under the same pixel. The distance is limited
    /// by the size of `bounds`.
    pub fn zoom(&mut self, factor: f32, target: Vec3) {
        let reach = self.bounds.1;
        let wanted = (self.distance * factor).clamp(reach * 0.01, reach * 40.0);
        let factor = wanted / self.distance;
        self.pivot = target + (self.pivot - target) * factor;
        self.distance = wanted;
    }

    /// The point under `pixel` in the plane through the pivot that is perpendicular to the view.
    pub fn point_on_pivot_plane(&self, pixel: Vec2, size: Vec2) -> Vec3 {
        let ray = self.ray(pixel, size);
        let normal = self.towards_eye();
        let along = (self.pivot - ray.origin).dot(normal) / ray.direction.dot(normal).min(-1e-6);
        ray.origin + ray.direction * along
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Vec2 = Vec2::new(800.0, 600.0);

    fn both() -> [Camera; 2] {
        let camera = Camera::framing(
            Vec3::new(-0.8, 0.0, -0.3),
            Vec3::new(0.8, 1.8, 0.3),
            View::Angles { yaw: 40.0, pitch: 25.0 },
            SIZE.x / SIZE.y,
        );
        [camera, Camera { projection: Projection::Orthographic, ..camera }]
    }

    #[test]
    fn a_ray_and_a_projection_are_inverse() {
        for camera in both() {
            for pixel in [Vec2::new(10.0, 20.0), Vec2::new(400.0, 300.0), Vec2::new(790.0, 1.0)] {
                let ray = camera.ray(pixel, SIZE);
                let p = camera.project(ray.origin + ray.direction * 2.0, SIZE).expect("in front");
                assert!((p.pixel - pixel).length() < 0.01, "{pixel} {p:?}");
            }
        }
    }

    #[test]
    fn a_framed_box_is_inside_the_picture_and_between_the_planes() {
        for camera in both() {
            for i in 0..8 {
                let pick = |bit: i32, lo: f32, hi: f32| if i & bit == 0 { lo } else { hi };
                let corner = Vec3::new(pick(1, -0.8, 0.8), pick(2, 0.0, 1.8), pick(4, -0.3, 0.3));
                let p = camera.project(corner, SIZE).expect("in front").pixel;
                assert!(p.cmpge(Vec2::ZERO).all() && p.cmple(SIZE).all(), "{p}");
                let clip = camera.projection(SIZE.x / SIZE.y) * camera.view() * corner.extend(1.0);
                assert!(clip.z >= 0.0 && clip.z <= clip.w, "{clip}");
            }
        }
    }

    #[test]
    fn left_is_seen_from_the_bodys_left() {
        let mut camera = Camera::default();
        camera.look(View::Left);
        assert!((camera.towards_eye() - Vec3::X).length() < 1e-6);
        camera.look(View::Top);
        assert!((camera.towards_eye() - Vec3::Y).length() < 1e-6);
        assert!((camera.rotation * Vec3::Y - Vec3::NEG_Z).length() < 1e-6);
    }

    #[test]
    fn zoom_keeps_the_target_under_its_pixel() {
        for mut camera in both() {
            let pixel = Vec2::new(123.0, 456.0);
            let target = camera.point_on_pivot_plane(pixel, SIZE);
            camera.zoom(0.4, target);
            let p = camera.project(target, SIZE).expect("in front").pixel;
            assert!((p - pixel).length() < 0.05, "{p}");
        }
    }

    #[test]
    fn nothing_before_the_eye_is_cut_off_at_any_zoom() {
        for mut camera in both() {
            let target = Vec3::new(0.1, 1.2, 0.25);
            for factor in std::iter::repeat_n(0.5, 14).chain(std::iter::repeat_n(2.0, 30)) {
                camera.zoom(factor, target);
                // What is zoomed to, and what stands a little nearer or behind it.
                for part in [-0.5, 0.0, 0.9] {
                    let point = target + camera.towards_eye() * (camera.distance * part).clamp(-0.2, 0.2);
                    let clip = camera.projection(SIZE.x / SIZE.y) * camera.view() * point.extend(1.0);
                    assert!(clip.z >= 0.0 && clip.z <= clip.w, "{clip} at {} {part}", camera.distance);
                }
            }
        }
    }

    #[test]
    fn orbit_stops_upright_at_the_poles_and_follows_the_pointer() {
        let mut camera = Camera::default();
        camera.orbit(Vec2::new(0.0, 10.0));
        assert!((camera.towards_eye() - Vec3::Y).length() < 1e-3);
        camera.orbit(Vec2::new(0.3, -1.0));
        assert!((camera.rotation * Vec3::Y).y > 0.0);
        // Dragged to the right, the front of the scene moves to the right.
        let mut camera = Camera::default();
        let front = camera.pivot + Vec3::Z * 0.2;
        let before = camera.project(front, SIZE).expect("in front").pixel;
        camera.orbit(Vec2::new(0.2, 0.0));
        assert!(camera.project(front, SIZE).expect("in front").pixel.x > before.x + 1.0);
        camera.look(View::Front);
        camera.trackball(Vec2::new(400.0, 300.0), Vec2::new(450.0, 300.0), SIZE);
        assert!(camera.project(front, SIZE).expect("in front").pixel.x > before.x + 1.0);
    }
}
