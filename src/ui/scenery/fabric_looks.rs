//! Appearance of pieces from their fabrics. Without egui, so that headless pictures use it too.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, Vec2};

use crate::cloth::{Fabric, FabricLook, Garment};
use crate::geometry::ids::PieceId;
use crate::io::materials::{ClothMaterial, Colours, ROUGHNESS};
use crate::pattern::{Pattern, Piece};
use crate::render::{Decal, Rgb, Textile, linear};
use crate::session::{Document, Dye, Dyes, Print};
use crate::ui::scenery::pictures::decals;

/// Thickness of cloth of no fabric, metres.
const USUAL_THICKNESS: f64 = 5e-4;

/// Appearance of each piece.
pub type PieceLooks = BTreeMap<PieceId, PieceLook>;

/// Appearance of a piece.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceLook {
    /// Colours of the outside and the inside; None: those of the layer.
    pub colours: Option<[Rgb; 2]>,
    /// Surface.
    pub textile: Textile,
    /// Unit vector along the grain, in the piece's plane.
    pub grain: DVec2,
    /// Distance that the cloth keeps from what it touches, metres.
    pub thickness: f64,
    /// Pictures on it.
    pub decals: Arc<Vec<Decal>>,
}

impl Default for PieceLook {
    fn default() -> Self {
        let (textile, decals) = (Textile::default(), Arc::default());
        Self { colours: None, textile, grain: DVec2::Y, thickness: USUAL_THICKNESS, decals }
    }
}

/// Appearance of the pieces of `pattern`; `fabric` gives the fabric of each, `dyes` colours and prints. Without pictures.
pub fn piece_looks<'f>(
    pattern: &Pattern,
    fabric: impl Fn(PieceId) -> Option<&'f Fabric>,
    dyes: &Dyes,
) -> PieceLooks {
    let look = |(&id, piece): (&PieceId, &Arc<Piece>)| {
        let thickness = fabric(id).map_or(USUAL_THICKNESS, |fabric| fabric.thickness_m);
        let mut look = fabric(id).map(|fabric| fabric.look).unwrap_or_default();
        let Dye { colour, print, image: _ } = dyes.of(id);
        if colour.is_some() {
            (look.colour, look.weft) = (colour, None);
        }
        let colours = look.colour.map(|outside| [outside, inside(&look, outside)]);
        let textile = printed(textile(&look), print);
        (id, PieceLook { colours, textile, grain: piece.grain(), thickness, decals: Arc::default() })
    };
    pattern.pieces.iter().map(look).collect()
}

/// Appearance of the pieces of `document`.
pub fn looks_of(document: &Document) -> PieceLooks {
    let fabric = |piece| Fabric::preset(document.fabrics.name(Some(piece)));
    let mut looks = piece_looks(&document.pattern, fabric, &document.dyes);
    for (&piece, look) in &mut looks {
        look.decals = Arc::new(decals(document, piece, look.grain));
    }
    looks
}

/// Colour of the outside of `piece`: its own, else that of its fabric. None: that of its layer.
pub fn outside_colour(document: &Document, piece: PieceId) -> Option<Rgb> {
    let fabric = || Fabric::preset(document.fabrics.name(Some(piece)))?.look.colour;
    document.dyes.of(piece).colour.or_else(fabric)
}

/// Materials of the pieces of `document` for export. Weave and print are left out.
pub fn materials(document: &Document) -> Colours {
    let material = |(id, look): (PieceId, PieceLook)| {
        let sides = look.colours?;
        Some((id, material_of(document, id, &look, sides)))
    };
    Colours { pieces: looks_of(document).into_iter().filter_map(material).collect(), ..Colours::default() }
}

/// Material of `piece`, which looks like `look`, in the colours `sides`; without textures.
pub fn material_of(document: &Document, piece: PieceId, look: &PieceLook, sides: [Rgb; 2]) -> ClothMaterial {
    let textile = &look.textile;
    ClothMaterial {
        name: document.fabrics.name(Some(piece)).to_owned(),
        sides: sides.map(|side| linear(side).to_array()),
        roughness: if textile.gloss > 0.0 { textile.roughness } else { ROUGHNESS },
        opacity: textile.mean_cover,
        textures: None,
    }
}

/// `textile` with `print` on it.
fn printed(textile: Textile, print: Option<Print>) -> Textile {
    let Some(print) = print else { return textile };
    Textile { print: print.motif as u32, repeat: print.repeat_m as f32, ink: print.colour, ..textile }
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
        mean_cover: look.mean_cover() as f32,
        ..Textile::default()
    }
}

/// Texture coordinates (metres) of the corners of triangle `t`: y along `grain`, a unit vector in the piece's plane.
pub fn flat(garment: &Garment, t: usize, grain: DVec2) -> [Vec2; 3] {
    garment.triangle_corners[t].map(|c| on_fabric(garment.corners[c as usize].uv, grain).as_vec2())
}

/// Place in the fabric, metres, of the point `uv` of a piece: y along `grain`, a unit vector in the piece's plane.
pub fn on_fabric(uv: DVec2, grain: DVec2) -> DVec2 {
    DVec2::new(uv.perp_dot(grain), uv.dot(grain))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::Corner;
    use crate::session::Motif;

    #[test]
    fn files_and_pictures_have_the_same_colours() {
        for c in 0..=255 {
            let colour = [c, 255 - c, c / 2];
            assert_eq!(crate::io::materials::linear(colour), linear(colour).to_array());
        }
    }

    #[test]
    fn the_grain_runs_up_in_the_cloth() {
        let corner = |uv| Corner { piece: PieceId(1), uv, vertex: 0 };
        let garment = Garment {
            corners: [DVec2::X, DVec2::Y, DVec2::ZERO].map(corner).to_vec(),
            triangle_corners: vec![[0, 1, 2]],
            ..Garment::default()
        };
        assert_eq!(flat(&garment, 0, DVec2::Y), [Vec2::X, Vec2::Y, Vec2::ZERO]);
        assert_eq!(
            flat(&garment, 0, DVec2::X),
            [Vec2::Y, -Vec2::X, Vec2::ZERO],
            "along x: x of the piece runs up"
        );
    }

    #[test]
    fn a_piece_looks_like_its_own_fabric_else_like_that_of_all() {
        let mut document = Document::default();
        let square = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let pattern = Arc::make_mut(&mut document.pattern);
        let [one, two] = ["one", "two"].map(|name| pattern.add_piece(Piece::polygon(name, &square)));
        let turned =
            Piece { grainline: Some([DVec2::ZERO, DVec2::X * 0.2]), ..(*pattern.pieces[&one]).clone() };
        pattern.pieces.insert(one, Arc::new(turned));
        assert!(looks_of(&document).values().all(|look| look.colours.is_none()), "undyed");
        document.fabrics.pieces.insert(two, "denim-11oz".to_owned());
        let looks = looks_of(&document);
        assert!(looks[&one].colours.is_none() && looks[&two].colours.is_some());
        assert!(looks[&two].textile.second.is_some(), "white threads in blue");
        assert_eq!((looks[&one].grain, looks[&two].grain), (DVec2::X, DVec2::Y));
        let print = Print { motif: Motif::Dots, repeat_m: 0.03, colour: [7; 3] };
        document.dyes.set(None, Dye { colour: Some([200, 0, 0]), ..Dye::default() });
        document.dyes.set(Some(two), Dye { print: Some(print), ..Dye::default() });
        let looks = looks_of(&document);
        assert!(looks.values().all(|look| look.colours.is_some_and(|[outside, _]| outside == [200, 0, 0])));
        assert_eq!([looks[&one].textile.print, looks[&two].textile.print], [0, Motif::Dots as u32]);
    }
}
