//! The uniform buffer that all passes of a picture share: camera, lamp, colours. It matches `Frame` in shaders/frame.wgsl.

use bytemuck::{Pod, Zeroable};
use glam::camera::rh::{proj::directx, view::look_at_mat4};
use glam::{Mat4, Quat, UVec2, Vec2, Vec3, Vec4};

use super::environment::Surroundings;
use super::image_light::ImageLight;
use super::light::Light;
use super::part::{BLUR_MARGIN, Part};
use super::srgb::{gamma, linear};
use super::{Camera, Look, Projection, Scene};

/// The uniform buffer of a picture.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Frame {
    view: Mat4,
    projection: Mat4,
    clip_from_world: Mat4,
    lamp_from_world: Mat4,
    eye: Vec4,
    towards_eye: Vec4,
    viewport: Vec4,
    lamp: Vec4,
    sky: Vec4,
    horizon: Vec4,
    ground: Vec4,
    floor: Vec4,
    hollows: Vec4,
    lamp_tint: Vec4,
    part: Vec4,
    around: Vec4,
    surroundings: Surroundings,
}

/// Radius of ambient occlusion relative to the radius of the sphere around all meshes: 7 cm on a person.
const HOLLOW_REACH: f32 = 0.07;

impl Frame {
    /// The uniform buffer of `part` of a picture.
    pub(super) fn new(camera: &Camera, scene: &Scene, look: &Look, part: &Part) -> Self {
        let viewport = part.whole.max(UVec2::ONE).as_vec2();
        let (view, projection) = (camera.view(), camera.projection(viewport.x / viewport.y));
        let sun = look.environment.and_then(|light| light.sun());
        let lamp = sun.map_or_else(|| lamp_direction(camera, look.light), |sun| sun.toward);
        let [sky, horizon, floor_colour] =
            look.light.backdrop().unwrap_or([look.sky, look.horizon, look.ground]);
        let (centre, radius) = mesh_ball(scene).unwrap_or(camera.bounds);
        let perspective = f32::from(camera.projection == Projection::Perspective);
        let floor =
            scene.ground.map_or(Vec4::ZERO, |g| Vec4::new(g.centre.x, g.centre.y, g.height, g.radius));
        Self {
            view,
            projection,
            clip_from_world: projection * view,
            lamp_from_world: lamp_matrix(lamp, centre, radius),
            eye: camera.eye().extend(perspective),
            towards_eye: camera.towards_eye().extend(look.drawn_per_pixel),
            viewport: Vec4::new(viewport.x, viewport.y, viewport.x.recip(), viewport.y.recip()),
            lamp: lamp.extend(look.key),
            sky: gamma(sky).extend(look.ambient),
            horizon: gamma(horizon).extend(look.shadow),
            ground: linear(floor_colour).extend(look.grid),
            floor,
            hollows: Vec4::new(
                radius * HOLLOW_REACH,
                look.occlusion,
                f32::from(look.occlusion > 0.0),
                radius * 0.004,
            ),
            lamp_tint: sun.map_or_else(|| look.light.tint(), |sun| sun.colour).extend(0.0),
            part: rectangle(part.at, part.size),
            around: rectangle(part.around_at, part.around_size),
            surroundings: Surroundings::new(
                look.light,
                look.environment.as_ref().map(ImageLight::around),
                yaw(camera),
            ),
        }
    }
}

impl Frame {
    /// How much nearer to the eye than the cloth its edges are drawn, metres. As in shaders/wire.wgsl.
    pub(super) fn wire_lift(&self) -> f32 {
        self.hollows.w * 0.3
    }
}

/// Corner and size of a rectangle of pixels.
fn rectangle(at: UVec2, size: UVec2) -> Vec4 {
    let (at, size) = (at.as_vec2(), size.as_vec2());
    Vec4::new(at.x, at.y, size.x, size.y)
}

/// Largest distance at which ambient occlusion reads depths, relative to the height of the picture. As in shaders/hollows.wgsl.
const FARTHEST_READ: f32 = 0.3;

/// How far beyond a tile ambient occlusion depends on depths, in pixels of a picture of `size` pixels; even.
pub(super) fn occlusion_margin(camera: &Camera, scene: &Scene, look: &Look, size: UVec2) -> u32 {
    if look.occlusion <= 0.0 {
        return 0;
    }
    let height = size.y as f32;
    let (_, radius) = mesh_ball(scene).unwrap_or(camera.bounds);
    let scale = match camera.projection {
        Projection::Perspective => nearest_depth(camera, scene, size.as_vec2()).recip(),
        Projection::Orthographic => 1.0,
    };
    let up = camera.projection(size.x as f32 / height).y_axis.y;
    let reach = (radius * HOLLOW_REACH * up * 0.5 * scale).min(FARTHEST_READ) * height;
    (reach.ceil() as u32 + BLUR_MARGIN).next_multiple_of(2)
}

/// A lower bound of the depth (metres, above 0) of what a perspective picture of `size` pixels shows.
pub(super) fn nearest_depth(camera: &Camera, scene: &Scene, size: Vec2) -> f32 {
    let view = camera.view();
    let meshes = scene.meshes.iter().flat_map(|mesh| &mesh.positions);
    let of_meshes = meshes.map(|&p| -view.transform_point3(p).z);
    let corners = [Vec2::ZERO, Vec2::new(size.x, 0.0), Vec2::new(0.0, size.y), size];
    let of_ground = scene.ground.iter().flat_map(|ground| {
        corners.map(|corner| {
            let ray = camera.ray(corner, size);
            let ahead = -ray.direction.dot(camera.towards_eye());
            let below = ray.origin.y - ground.height;
            if ray.direction.y < 0.0 { below / -ray.direction.y * ahead } else { f32::INFINITY }
        })
    });
    // Nothing is nearer than the near plane.
    of_meshes.chain(of_ground).fold(f32::INFINITY, f32::min).max(camera.near())
}

/// Unit vector towards the lamp: above and left of the eye, so that folds show from every side.
fn lamp_direction(camera: &Camera, light: Light) -> Vec3 {
    let [turn, up, before] = light.lamp();
    Quat::from_rotation_y(yaw(camera) - turn) * Vec3::new(0.0, up, before).normalize()
}

/// Direction of the eye about y, radians from +z towards +x; 0 where it is straight above or below.
fn yaw(camera: &Camera) -> f32 {
    let back = camera.towards_eye();
    if back.x.hypot(back.z) < 1e-3 { 0.0 } else { back.x.atan2(back.z) }
}

fn mesh_ball(scene: &Scene) -> Option<(Vec3, f32)> {
    let (lower, upper) =
        scene.meshes.iter().filter_map(|m| m.bounds()).reduce(|(a, b), (c, d)| (a.min(c), b.max(d)))?;
    Some(((lower + upper) / 2.0, ((upper - lower) / 2.0).length().max(1e-3)))
}

fn lamp_matrix(lamp: Vec3, centre: Vec3, radius: f32) -> Mat4 {
    let r = radius * 1.02;
    // A sun may be straight above.
    let up = if lamp.y > 0.99 { Vec3::Z } else { Vec3::Y };
    let view = look_at_mat4(centre + lamp * r * 2.0, centre, up);
    directx::orthographic(-r, r, -r, r, r * 0.9, r * 4.5) * view
}
