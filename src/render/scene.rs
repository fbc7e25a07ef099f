//! The contents of a picture as plain lists.

use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::Camera;
use super::decal::Decal;
use super::textile::Textile;

/// An sRGB colour: red, green, blue, 0..=255.
pub type Rgb = [u8; 3];

/// A triangle mesh.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Vertex positions, metres.
    pub positions: Vec<Vec3>,
    /// Unit normals, one per position; if empty, area-weighted normals are computed.
    pub normals: Vec<Vec3>,
    /// Vertex indices, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// sRGB colours, one per position, multiplied with `front` and `back`; if empty, white.
    pub colours: Vec<Rgb>,
    /// Colour of the front, where triangles run counter-clockwise.
    pub front: Rgb,
    /// Colour of the back.
    pub back: Rgb,
    /// Material: 0 is skin and plaster, 1 woven cloth, which has a soft sheen at grazing angles.
    pub cloth: f32,
    /// Whether it is skin covered in cloth: it takes light as cloth does, and is drawn in the passes of skin.
    pub covered: bool,
    /// Texture coordinates of the corners of each triangle: places in the flat cloth, metres, y along the grain. Empty: no texture.
    pub flat: Vec<[Vec2; 3]>,
    /// For each triangle a number for each corner: corners of a vertex with different ones have normals of their own where the mesh is
    /// folded sharply, as the sides of a seam have, which have different texture coordinates. Empty: all have the same.
    pub wedges: Vec<[u32; 3]>,
    /// Surface of the cloth; its weave needs `flat`.
    pub textile: Textile,
    /// Pictures on the cloth, the last on top; at most [`MOST_DECALS`](super::decal::MOST_DECALS) are drawn. They need `flat`.
    pub decals: Arc<Vec<Decal>>,
}

impl Mesh {
    /// Lower and upper corner of the bounding box; None when there is nothing.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let first = *self.positions.first()?;
        Some(self.positions.iter().fold((first, first), |(lo, hi), &p| (lo.min(p), hi.max(p))))
    }

    /// Depths (metres in front of the eye) at which the view axis of `camera` meets triangles, borders included.
    fn depths_ahead(&self, camera: &Camera) -> impl Iterator<Item = f32> {
        let view = camera.view();
        let place = move |v: u32| self.positions.get(v as usize).map(|&p| view.transform_point3(p));
        self.triangles.iter().filter_map(move |&[a, b, c]| {
            let [a, b, c] = [place(a)?, place(b)?, place(c)?];
            // The axis is the origin of the picture. Two triangles give their common edge weights that differ in sign alone, so
            // that no axis passes between them: symmetric bodies have edges all along the middle.
            let across = |p: Vec3, q: Vec3| p.truncate().perp_dot(q.truncate());
            let weights = Vec3::new(across(b, c), across(c, a), across(a, b));
            let is_met = weights.cmpge(Vec3::ZERO).all() || weights.cmple(Vec3::ZERO).all();
            // Edge-on all weights are 0, and this is not a number.
            let depth = -weights.dot(Vec3::new(a.z, b.z, c.z)) / weights.element_sum();
            is_met.then_some(depth)
        })
    }
}

/// A polyline in space with a constant width on the screen. A single point is drawn as a dot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyline {
    /// Points, metres.
    pub points: Vec<Vec3>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
    /// Colour and opacity.
    pub colour: [u8; 4],
    /// Width, logical pixels.
    pub width: f32,
    /// Colour and opacity of the border; the borders of all lines are below all lines.
    pub halo: [u8; 4],
    /// Width of the border on each side, logical pixels.
    pub halo_width: f32,
    /// Depth bias in metres: the line is drawn as if this much nearer to the eye, so that the surface it lies on does not hide
    /// it.
    pub lift: f32,
    /// Additional depth bias in half widths of the line: 1.5 keeps both sides above a surface seen at a slant.
    pub lift_widths: f32,
    /// Real width, metres: from afar the line is thinner than `width`, then paler. 0: `width` at any distance.
    pub thickness: f32,
}

/// A number on a badge that always faces the eye.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The point that the label belongs to, metres.
    pub anchor: Vec3,
    /// Offset of the text's centre from the anchor, logical pixels right and up.
    pub offset: Vec2,
    /// Digits; any other character leaves a gap.
    pub text: String,
    /// Height of a digit, logical pixels.
    pub height: f32,
    /// Colour of the badge.
    pub colour: [u8; 4],
    /// Colour of the badge's border and of the digits.
    pub halo: [u8; 4],
    /// Depth bias, metres; see [`Polyline::lift`].
    pub lift: f32,
}

/// A floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Height (y), metres.
    pub height: f32,
    /// Centre of the floor (x and z, metres), where it is brightest.
    pub centre: Vec2,
    /// Radius within which it fades away, metres.
    pub radius: f32,
}

/// The contents of one picture. Meshes are shared, so that one that is drawn again stays on the device.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Meshes, opaque unless [`Look::sheer`](super::Look::sheer) makes them transparent.
    pub meshes: Vec<Arc<Mesh>>,
    /// Lines, drawn after the meshes with depth test.
    pub lines: Vec<Polyline>,
    /// Labels, drawn after the lines.
    pub labels: Vec<Label>,
    /// Floor, drawn before everything else.
    pub ground: Option<Ground>,
}

impl Scene {
    /// All points of lines, and of meshes those that a triangle uses.
    pub fn points(&self) -> Vec<Vec3> {
        // Points that no triangle uses are not visible.
        let corners = self.meshes.iter().flat_map(|m| {
            let seen = m.triangles.iter().flatten();
            seen.filter_map(|&v| m.positions.get(v as usize).copied())
        });
        corners.chain(self.lines.iter().flat_map(|l| l.points.iter().copied())).collect()
    }

    /// Depth (metres in front of the eye, above 0) of the first triangle of a mesh, seen from either side, in the middle of a
    /// picture from `camera`, which has a perspective projection; None where there is none. All triangles are looked at.
    pub fn depth_ahead(&self, camera: &Camera) -> Option<f32> {
        let depths = self.meshes.iter().flat_map(|mesh| mesh.depths_ahead(camera));
        depths.filter(|depth| *depth >= camera.near()).min_by(f32::total_cmp)
    }
}

#[cfg(test)]
mod tests {
    use glam::Quat;

    use super::*;

    /// A camera 2 m from a pivot that is not the origin, turned in all directions.
    fn camera() -> Camera {
        let rotation = Quat::from_rotation_y(0.7) * Quat::from_rotation_x(-0.3) * Quat::from_rotation_z(0.2);
        Camera { pivot: Vec3::new(0.1, 0.9, -0.2), rotation, distance: 2.0, ..Camera::default() }
    }

    /// A square sheet with sides of 0.2 m, `depth` metres in front of the eye of [`camera`], its middle `right` metres beside its
    /// view axis.
    fn sheet(depth: f32, right: f32) -> Arc<Mesh> {
        let camera = camera();
        let at = |x: f32, y: f32| camera.eye() + camera.rotation * Vec3::new(right + x, y, -depth);
        Arc::new(Mesh {
            positions: vec![at(-0.1, -0.1), at(0.1, -0.1), at(0.1, 0.1), at(-0.1, 0.1)],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        })
    }

    fn ahead<const N: usize>(sheets: [(f32, f32); N]) -> Option<f32> {
        let meshes = sheets.into_iter().map(|(depth, right)| sheet(depth, right)).collect();
        let depth = Scene { meshes, ..Scene::default() }.depth_ahead(&camera())?;
        Some((depth * 1e4).round() / 1e4)
    }

    #[test]
    fn the_nearest_surface_in_the_middle_is_found() {
        assert_eq!(ahead([(1.2, 0.0)]), Some(1.2));
        assert_eq!(ahead([(1.2, 0.05), (2.5, 0.0)]), Some(1.2));
        assert_eq!(
            ahead([(2.5, -0.05), (1.2, 0.0), (0.8, 0.3)]),
            Some(1.2),
            "the nearest is beside the middle"
        );
        assert_eq!(ahead([(1.2, 0.11)]), None);
        assert_eq!(ahead([]), None);
        assert_eq!(ahead([(-1.0, 0.0)]), None, "behind the eye");
        assert_eq!(ahead([(0.003, 0.0), (1.5, 0.0)]), Some(1.5), "before the near plane nothing is drawn");
    }

    #[test]
    fn either_side_counts_and_the_depth_is_that_on_the_axis() {
        let camera = camera();
        let mut mesh = Mesh::clone(&sheet(1.0, 0.0));
        // Slanted: its depth falls by 0.5 m from the left to the right, which are 0.15 and 0.05 m beside the axis.
        let at = |x: f32, y: f32| camera.eye() + camera.rotation * Vec3::new(x, y, -(1.0 - 2.5 * (x + 0.15)));
        mesh.positions = vec![at(-0.15, -0.1), at(0.05, -0.1), at(0.05, 0.1), at(-0.15, 0.1)];
        for turned in [false, true] {
            if turned {
                mesh.triangles.iter_mut().for_each(|corners| corners.reverse());
            }
            let scene = Scene { meshes: vec![Arc::new(mesh.clone())], ..Scene::default() };
            let depth = scene.depth_ahead(&camera).expect("a surface");
            assert!((depth - 0.625).abs() < 1e-4, "{depth}");
        }
    }

    #[test]
    fn an_axis_along_a_common_edge_or_through_a_corner_passes_between_no_triangles() {
        for i in 0..200 {
            let turn = Quat::from_rotation_z(0.1 * i as f32) * Quat::from_rotation_y(0.03 * i as f32);
            let at = |x: f32, y: f32| turn * Vec3::new(x, y, 0.0);
            // A fan round the pivot, which all its triangles share.
            let rim = (0..7).map(|k| Vec2::from_angle(0.9 * k as f32) * 0.3);
            let positions = std::iter::once(Vec3::ZERO).chain(rim.map(|p| at(p.x, p.y))).collect();
            let triangles = (0..7).map(|k| [0, 1 + k, 1 + (k + 1) % 7]).collect();
            let fan = Mesh { positions, triangles, ..Mesh::default() };
            let scene = Scene { meshes: vec![Arc::new(fan)], ..Scene::default() };
            let pivot = turn * Vec3::new(0.001 * i as f32, 0.0, 0.0);
            let camera = Camera { pivot, rotation: turn, distance: 1.0, ..Camera::default() };
            let depth = scene.depth_ahead(&camera).expect("no gap");
            assert!((depth - 1.0).abs() < 1e-4, "{i}: {depth}");
        }
    }
}
