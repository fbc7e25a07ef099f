//! The contents of a picture as plain lists.

use std::sync::Arc;

use glam::{Vec2, Vec3};

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
}
