//! Depth of field: how a thin lens blurs what is nearer or farther than the plane in focus.

use std::ops::RangeInclusive;

use glam::UVec2;

use super::{Camera, Projection, Scene};

/// Longer side of the sensor behind the lens, metres: that of full-frame cameras, which is turned as the picture is.
const SENSOR: f32 = 0.036;
/// Largest radius of a circle of confusion relative to the longer side of the picture.
const LARGEST: f32 = 1.0 / 40.0;

/// A thin lens, which sees what the camera sees on a sensor whose longer side is 36 mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Focal length divided by the diameter of the aperture, in [`Lens::F_NUMBERS`].
    pub f_number: f32,
    /// Depth of the plane in focus, metres in front of the plane through the eye, above 0; None: that of the camera's pivot,
    /// unless [`Lens::focused`] finds a surface.
    pub focus: Option<f32>,
}

/// The circles of confusion of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Defocus {
    /// Depth of the plane in focus, metres, above 0.
    pub focus: f32,
    /// Radius of the circle of confusion of what is infinitely far, pixels; not limited.
    pub farthest: f32,
    /// Largest radius that is drawn, pixels: a fortieth of the longer side of the picture.
    pub most: f32,
}

impl Lens {
    /// The f-numbers that a lens may have.
    pub const F_NUMBERS: RangeInclusive<f32> = 1.4..=22.0;

    /// The same, focused on the first surface in the middle of a picture of `scene` from `camera`. A given plane stays in focus;
    /// where the middle shows no mesh, and with a parallel projection, nothing changes.
    pub fn focused(self, camera: &Camera, scene: &Scene) -> Self {
        if self.focus.is_some() || camera.projection == Projection::Orthographic {
            return self;
        }
        Self { focus: scene.depth_ahead(camera), ..self }
    }

    /// The circles of confusion in a picture of `size` pixels from `camera`; None with a parallel projection, which no lens has.
    ///
    /// Of a point at depth z the circle has the diameter |z - f| / z · A · F / (f - F) on the sensor, with the depth f of the plane
    /// in focus, the focal length F and the diameter A = F / N of the aperture. F is that of the lens which, focused at f, sees the
    /// field of view of the camera: 1 / F = 1 / f + 1 / v with the distance v of the sensor behind it. So F / (f - F) = v / f.
    pub fn defocus(&self, camera: &Camera, size: UVec2) -> Option<Defocus> {
        if camera.projection == Projection::Orthographic {
            return None;
        }
        let size = size.max(UVec2::ONE).as_vec2();
        let longer = size.max_element();
        let focus = self.focus.unwrap_or(camera.distance).max(1e-6);
        // Half of the sensor over its distance is half of the picture over the same distance in pixels.
        let sensor = SENSOR / longer * size.y / 2.0 / (camera.fov_y / 2.0).tan();
        let focal_length = sensor * focus / (focus + sensor);
        let aperture = focal_length / self.f_number;
        let diameter = aperture * sensor / focus;
        Some(Defocus { focus, farthest: diameter / 2.0 / SENSOR * longer, most: longer * LARGEST })
    }
}

impl Defocus {
    /// Radius (pixels) of the circle of confusion of what is at `depth` (metres, above 0). As in shaders/focus.wgsl.
    pub fn radius(&self, depth: f32) -> f32 {
        (self.farthest * (depth - self.focus).abs() / depth).min(self.most)
    }

    /// The largest radius (pixels) of what is at `nearest` (metres, above 0) and beyond.
    pub(super) fn largest(&self, nearest: f32) -> f32 {
        self.radius(nearest).max(self.farthest.min(self.most))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::Vec3;

    use super::*;
    use crate::render::Mesh;

    const SIZE: UVec2 = UVec2::new(1200, 800);

    fn near(a: f32, b: f32) -> bool {
        (a - b).abs() <= 1e-4 * a.abs().max(b.abs())
    }

    /// A camera whose picture of [`SIZE`] has the field of view of a lens with `sensor` metres to a full-frame sensor.
    fn camera(sensor: f32) -> Camera {
        Camera { distance: 2.5, fov_y: 2.0 * (0.012 / sensor).atan(), ..Camera::default() }
    }

    #[test]
    fn circles_are_those_of_a_thin_lens() {
        for (f_number, focus, sensor) in [(1.4, 2.5, 0.05), (8.0, 0.9, 0.085), (22.0, 0.2, 0.05)] {
            let lens = Lens { f_number, focus: Some(focus) };
            let defocus = lens.defocus(&camera(sensor), SIZE).expect("perspective");
            assert!(near(defocus.focus, focus));
            // The lens equation says where each point is sharp; the cone of rays behind the aperture ends there.
            let focal_length = 1.0 / (1.0 / focus + 1.0 / sensor);
            let aperture = focal_length / f_number;
            for depth in [0.5 * focus, 0.9 * focus, 1.2 * focus, 4.0 * focus, 1e6] {
                let sharp = 1.0 / (1.0 / focal_length - 1.0 / depth);
                let diameter = aperture * (sharp - sensor).abs() / sharp;
                let pixels = diameter / 0.036 * 1200.0;
                let got = 2.0 * defocus.radius(depth);
                assert!(near(got, pixels.min(60.0)), "f/{f_number}, {depth} m: {got} and {pixels} pixels");
                let formula =
                    (depth - focus).abs() / depth * aperture * focal_length / (focus - focal_length);
                assert!(near(diameter, formula), "{diameter} and {formula} m");
            }
            assert_eq!(defocus.radius(focus), 0.0);
        }
    }

    #[test]
    fn the_longer_side_is_that_of_the_sensor() {
        let lens = Lens { f_number: 2.0, focus: None };
        let lying = lens.defocus(&camera(0.05), SIZE).expect("perspective");
        assert!(near(lying.focus, 2.5), "at the pivot");
        // The same camera turned by a right angle.
        let fov_y = 2.0 * ((camera(0.05).fov_y / 2.0).tan() * 1.5).atan();
        let turned = Camera { fov_y, ..camera(0.05) };
        let standing = lens.defocus(&turned, UVec2::new(800, 1200)).expect("perspective");
        assert!(near(lying.farthest, standing.farthest) && lying.most == 30.0 && standing.most == 30.0);
        // Twice as many pixels, twice the radius.
        let fine = lens.defocus(&camera(0.05), 2 * SIZE).expect("perspective");
        assert!(near(fine.farthest, 2.0 * lying.farthest) && fine.most == 60.0);
        let parallel = Camera { projection: Projection::Orthographic, ..camera(0.05) };
        assert_eq!(lens.defocus(&parallel, SIZE), None);
    }

    #[test]
    fn the_surface_in_the_middle_is_in_focus_or_else_the_pivot() {
        let camera = camera(0.05);
        // A triangle half a metre before the pivot.
        let before = |x: f32| {
            let corners = [(-0.1, -0.1), (0.1, -0.1), (0.0, 0.1)];
            let place = |(right, up)| camera.pivot + Vec3::new(x + right, up, 0.5);
            let mesh = Mesh {
                positions: corners.map(place).to_vec(),
                triangles: vec![[0, 1, 2]],
                ..Mesh::default()
            };
            Scene { meshes: vec![Arc::new(mesh)], ..Scene::default() }
        };
        let focus = |focus: Option<f32>, camera: &Camera, scene: &Scene| {
            Lens { f_number: 2.0, focus }.focused(camera, scene).focus
        };
        assert!(focus(None, &camera, &before(0.0)).is_some_and(|depth| near(depth, 2.0)));
        assert_eq!(focus(Some(0.7), &camera, &before(0.0)), Some(0.7), "as it is given");
        let beside = Lens { f_number: 2.0, focus: None }.focused(&camera, &before(0.3));
        assert_eq!(beside.focus, None);
        assert!(near(beside.defocus(&camera, SIZE).expect("perspective").focus, 2.5), "at the pivot");
        let parallel = Camera { projection: Projection::Orthographic, ..camera };
        assert_eq!(focus(None, &parallel, &before(0.0)), None);
    }

    #[test]
    fn nothing_is_blurred_more_than_the_largest_radius() {
        let lens = Lens { f_number: 1.4, focus: Some(0.02) };
        let defocus = lens.defocus(&camera(0.05), SIZE).expect("perspective");
        assert!(defocus.farthest > defocus.most && defocus.farthest.is_finite());
        for depth in [1e-3, 0.01, 0.5, 1e9] {
            assert!(defocus.radius(depth) <= defocus.most && defocus.radius(depth) <= defocus.largest(1e-3));
        }
        let calm = Lens { f_number: 22.0, focus: Some(2.5) };
        let calm = calm.defocus(&camera(0.05), SIZE).expect("perspective");
        assert!(near(calm.largest(2.0), calm.farthest) && calm.largest(0.5) > calm.farthest);
    }
}
