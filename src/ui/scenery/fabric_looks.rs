//! Appearance of pieces from their fabrics. Without egui, so that headless pictures use it too.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::Vec2;

use crate::cloth::{Fabric, FabricLook, Garment};
use crate::geometry::ids::PieceId;
use crate::pattern::{Pattern, Piece};
use crate::render::{Rgb, Textile};
use crate::session::Fabrics;

/// Appearance of each piece.
pub type PieceLooks = BTreeMap<PieceId, PieceLook>;

/// Appearance of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceLook {
    /// Colours of the outside and the inside; None: those of the layer.
    pub colours: Option<[Rgb; 2]>,
    /// Surface.
    pub textile: Textile,
    /// Unit vector along the grain, in the piece's plane.
    pub grain: Vec2,
}

/// Appearance of the pieces of `pattern`; `fabric` gives the fabric of each.
pub fn piece_looks<'f>(pattern: &Pattern, fabric: impl Fn(PieceId) -> Option<&'f Fabric>) -> PieceLooks {
    let look = |(&id, piece): (&PieceId, &Arc<Piece>)| {
        let look = fabric(id).map(|fabric| fabric.look).unwrap_or_default();
        let along = piece.grainline.and_then(|[tail, head]| (head - tail).as_vec2().try_normalize());
        let colours = look.colour.map(|outside| [outside, inside(&look, outside)]);
        (id, PieceLook { colours, textile: textile(&look), grain: along.unwrap_or(Vec2::Y) })
    };
    pattern.pieces.iter().map(look).collect()
}

/// Appearance of the pieces of `pattern`, made of presets.
pub fn named_looks(pattern: &Pattern, fabrics: &Fabrics) -> PieceLooks {
    piece_looks(pattern, |piece| Fabric::preset(fabrics.name(Some(piece))))
}

/// Colour of the inside: half weft, and slightly darker.
fn inside(look: &FabricLook, own: Rgb) -> Rgb {
    let weft = look.weft.unwrap_or(own);
    [0, 1, 2].map(|k| ((f32::from(own[k]) + f32::from(weft[k])) * 0.46) as u8)
}

/// The renderer's surface for `look`.
pub fn textile(look: &FabricLook) -> Textile {
    Textile {
        weave: look.weave as u32,
        second: look.weft,
        pitch: look.pitch_m as f32,
        relief: look.relief as f32,
        gloss: look.gloss as f32,
        roughness: look.roughness as f32,
        along: look.along as f32,
        sheen: look.sheen as f32,
        slubs: look.slubs as f32,
        cover: look.cover as f32,
        is_open: look.is_open(),
    }
}

/// Texture coordinates (metres) of the corners of triangle `t`: y along `grain`, a unit vector in the piece's plane.
pub fn flat(garment: &Garment, t: usize, grain: Vec2) -> [Vec2; 3] {
    garment.triangle_corners[t].map(|corner| {
        let uv = garment.corners[corner as usize].uv.as_vec2();
        Vec2::new(uv.dot(-grain.perp()), uv.dot(grain))
    })
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::cloth::Corner;

    #[test]
    fn the_grain_runs_up_in_the_cloth() {
        let corner = |uv| Corner { piece: PieceId(1), uv, vertex: 0 };
        let garment = Garment {
            corners: [DVec2::X, DVec2::Y, DVec2::ZERO].map(corner).to_vec(),
            triangle_corners: vec![[0, 1, 2]],
            ..Garment::default()
        };
        assert_eq!(flat(&garment, 0, Vec2::Y), [Vec2::X, Vec2::Y, Vec2::ZERO]);
        assert_eq!(
            flat(&garment, 0, Vec2::X),
            [Vec2::Y, -Vec2::X, Vec2::ZERO],
            "along x: x of the piece runs up"
        );
    }

    #[test]
    fn a_piece_looks_like_its_own_fabric_else_like_that_of_all() {
        let mut pattern = Pattern::default();
        let square = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let [one, two] = ["one", "two"].map(|name| pattern.add_piece(Piece::polygon(name, &square)));
        let mut fabrics = Fabrics::default();
        assert!(named_looks(&pattern, &fabrics).values().all(|look| look.colours.is_none()), "undyed");
        fabrics.pieces.insert(two, "denim-11oz".to_owned());
        let looks = named_looks(&pattern, &fabrics);
        assert!(looks[&one].colours.is_none() && looks[&two].colours.is_some());
        assert!(looks[&two].textile.second.is_some(), "white threads in blue");
        let turned =
            Piece { grainline: Some([DVec2::ZERO, DVec2::X * 0.2]), ..(*pattern.pieces[&one]).clone() };
        pattern.pieces.insert(one, Arc::new(turned));
        assert_eq!(named_looks(&pattern, &fabrics)[&one].grain, Vec2::X);
    }
}
