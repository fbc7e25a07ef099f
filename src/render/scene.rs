//! What is to be drawn: plain lists.

use std::sync::Arc;

use glam::{Vec2, Vec3};

/// Colour as people name it: sRGB, red, green, blue, 0..=255.
pub type Rgb = [u8; 3];

/// A triangle mesh.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Metres.
    pub positions: Vec<Vec3>,
    /// Unit, one per position; empty: area-weighted ones are computed.
    pub normals: Vec<Vec3>,
    /// Counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// sRGB, one per position, multiplied with `front` and `back`; empty: white.
    pub colours: Vec<Rgb>,
    /// Colour of the side from which triangles run counter-clockwise.
    pub front: Rgb,
    /// Colour of the other side.
    pub back: Rgb,
    /// 0 skin and plaster, 1 woven cloth (a soft sheen where it turns away).
    pub cloth: f32,
}

impl Mesh {
    /// Lower and upper corner; None when there is nothing.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let first = *self.positions.first()?;
        Some(self.positions.iter().fold((first, first), |(lo, hi), &p| (lo.min(p), hi.max(p))))
    }
}

/// A polyline in space with a constant width on the screen. One point makes a dot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyline {
    /// Metres.
    pub points: Vec<Vec3>,
    /// The last point is joined to the first.
    pub closed: bool,
    /// Colour and opacity.
    pub colour: [u8; 4],
    /// Logical pixels.
    pub width: f32,
    /// Colour and opacity of the border round it; drawn below every line.
    pub halo: [u8; 4],
    /// Width of the border on each side, logical pixels.
    pub halo_width: f32,
    /// Drawn as if this much nearer to the eye, metres, so that it is not swallowed by the surface it lies on.
    pub lift: f32,
    /// And nearer by this many of its half widths: 1.5 keeps both sides above a surface seen at a slant.
    pub lift_widths: f32,
}

/// A number on a badge that always faces the eye.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// What it belongs to, metres.
    pub anchor: Vec3,
    /// From the anchor to the middle of the text, logical pixels, right and up.
    pub offset: Vec2,
    /// Digits; other characters leave a gap.
    pub text: String,
    /// Height of a digit, logical pixels.
    pub height: f32,
    /// Colour of the badge.
    pub colour: [u8; 4],
    /// Colour of its border and of the digits.
    pub halo: [u8; 4],
    /// As for [`Polyline::lift`].
    pub lift: f32,
}

/// A floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Its height, metres.
    pub height: f32,
    /// Where it is brightest: x and z, metres.
    pub centre: Vec2,
    /// How far it reaches before it fades away, metres.
    pub radius: f32,
}

/// Everything in one picture. Meshes are shared: one that is drawn again stays on the device.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Opaque.
    pub meshes: Vec<Arc<Mesh>>,
    /// Over the meshes, hidden behind them.
    pub lines: Vec<Polyline>,
    /// Over the lines.
    pub labels: Vec<Label>,
    /// Under everything.
    pub ground: Option<Ground>,
}

impl Scene {
    /// Every point of meshes and lines.
    pub fn points(&self) -> Vec<Vec3> {
        // Points that no triangle uses are not seen.
        let corners = self.meshes.iter().flat_map(|m| {
            let seen = m.triangles.iter().flatten();
            seen.filter_map(|&v| m.positions.get(v as usize).copied())
        });
        corners.chain(self.lines.iter().flat_map(|l| l.points.iter().copied())).collect()
    }
}
