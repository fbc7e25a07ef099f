//! Dressed cloth as the arrays of each of its pieces, which scene formats hold.

use glam::{DVec2, DVec3};

use crate::cloth::{ClothState, Corner, Garment, TrimPart, Wedges};
use crate::geometry::ids::PieceId;
use crate::io::materials::{ClothMaterial, Colours, Textures};
use crate::io::normals::{Normals, wedges_of_piece};
use crate::pattern::Pattern;

/// A garment with its current vertex positions.
#[derive(Clone, Copy, Debug)]
pub struct Dressed<'a> {
    /// Topology and rest shape of the cloth.
    pub garment: &'a Garment,
    /// Current positions.
    pub state: &'a ClothState,
    /// The pattern, for the poses of its pieces in the pattern plane.
    pub pattern: &'a Pattern,
    /// Its trims, which are written after its pieces; empty: without.
    pub trims: &'a [TrimPart],
}

impl Dressed<'_> {
    /// Indices of the triangles all of whose vertices are placed on the body.
    pub(super) fn laid(&self) -> Vec<usize> {
        let is_laid = |t: &usize| {
            self.garment.triangles[*t].iter().all(|&v| self.state.mapped.get(v as usize) == Some(&true))
        };
        (0..self.garment.triangles.len()).filter(is_laid).collect()
    }

    /// The trims, each with its material, whose name no other of them has.
    pub(super) fn trims(&self, colours: &Colours) -> Vec<(&TrimPart, ClothMaterial)> {
        let mut made: Vec<(&TrimPart, ClothMaterial)> = Vec::new();
        for part in self.trims {
            let alike = made.iter().filter(|(other, _)| other.kind == part.kind).count();
            made.push((part, colours.of_trim(part, alike + 1)));
        }
        made
    }
}

/// Vertex positions of the garment and the body in one frame.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Positions of the garment's vertices, metres.
    pub cloth: Vec<DVec3>,
    /// Positions of the body's vertices, metres.
    pub body: Vec<DVec3>,
}

/// Vertex arrays of a piece: one entry per wedge, which is a flat corner (a vertex of one piece in the pattern plane) on one side of
/// the fold lines through it.
#[derive(Clone, Debug)]
pub(super) struct PieceArrays {
    pub positions: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    /// Texture coordinates, v upwards: the pattern plane in metres, or the atlas.
    pub uv: Vec<DVec2>,
    /// Places in repeats of the weave; empty: no weave.
    pub weave: Vec<DVec2>,
    pub triangles: Vec<[u32; 3]>,
}

impl PieceArrays {
    /// The arrays of `piece` with its `triangles`; wedges and normals are those of the whole garment.
    pub fn new(
        dressed: &Dressed<'_>,
        piece: PieceId,
        triangles: impl Iterator<Item = usize>,
        (wedges, normals): (&Wedges, &Normals),
        textures: Option<&Textures>,
    ) -> Self {
        let Dressed { garment, state, pattern, trims: _ } = dressed;
        let own = wedges_of_piece(wedges, garment, piece);
        let corners: Vec<Corner> =
            own.iter().map(|wedge| garment.corners[wedges.corners[wedge] as usize]).collect();
        let pose = pattern.pieces.get(&piece).map(|p| p.pose).unwrap_or_default();
        let weave = textures.and_then(|textures| textures.weave_from_piece.get(&piece));
        let uv = |at: DVec2| match textures {
            Some(textures) => textures.atlas.uv(piece, at),
            None => pose.plane_from_piece(at),
        };
        Self {
            weave: weave
                .map(|map| corners.iter().map(|c| map.transform_point2(c.uv)).collect())
                .unwrap_or_default(),
            positions: corners.iter().map(|c| state.positions[c.vertex as usize]).collect(),
            normals: own.iter().map(|wedge| normals.wedges[wedge]).collect(),
            uv: corners.iter().map(|c| uv(c.uv)).collect(),
            triangles: triangles.map(|t| wedges.triangles[t].map(|wedge| own.place(wedge))).collect(),
        }
    }
}

/// Vertex arrays of trims of one kind and colour.
#[derive(Clone, Debug)]
pub(super) struct TrimArrays {
    pub positions: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

impl TrimArrays {
    /// The arrays of `part` on `dressed`; `normals` are those of the whole garment.
    pub fn new(dressed: &Dressed<'_>, part: &TrimPart, normals: &Normals) -> Self {
        let solid = part.solid(dressed.garment, dressed.state, &normals.vertices);
        Self {
            positions: solid.positions.iter().map(|p| p.as_dvec3()).collect(),
            normals: solid.normals.iter().map(|n| n.as_dvec3()).collect(),
            triangles: solid.triangles,
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::cloth::TrimParts;
    use crate::cloth::TrimShapes;
    use crate::pattern::{
        Button, Edge, EdgeRef, Fold, InternalLine, Piece, PiecePoint, Piping, Seam, Topstitch, Trims,
    };

    /// Two squares sewn along one edge, bent at the seam by 90 degrees.
    pub(in crate::io) fn two_squares() -> (Pattern, Garment, ClothState) {
        bent_squares(90.0)
    }

    /// Two squares sewn along one edge; the second is turned back by `angle` degrees at the seam, over the back of the first.
    pub(in crate::io) fn bent_squares(angle: f64) -> (Pattern, Garment, ClothState) {
        let square = [DVec2::ZERO, DVec2::X * 0.1, DVec2::splat(0.1), DVec2::Y * 0.1];
        let mut pattern = Pattern::default();
        let ids = ["a", "b"].map(|name| pattern.add_piece(Piece::polygon(name, &square)));
        let sides = [EdgeRef { piece: ids[0], edge: 1 }, EdgeRef { piece: ids[1], edge: 3 }];
        pattern.add_seam(Seam::of_edges(sides, false));
        let (garment, problems) = crate::cloth::build(&pattern, 0.03);
        assert!(problems.is_empty(), "{problems:?}");
        let state = bent(&garment, angle, |c| if c.piece == ids[0] { c.uv.x } else { 0.1 + c.uv.x });
        (pattern, garment, state)
    }

    /// A piece of 0.2 x 0.1 m with a fold line across its middle, at which its right half is turned back by `angle` degrees.
    pub(in crate::io) fn folded_square(angle: f64) -> (Pattern, Garment, ClothState) {
        let corners = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.1], [0.0, 0.1]].map(DVec2::from);
        let trims = Trims::from(Fold::pressed(-angle.to_radians()));
        let edges = vec![Edge { start: DVec2::new(0.1, 0.0), trims, ..Edge::default() }];
        let line = InternalLine { edges, end: DVec2::splat(0.1), ..InternalLine::default() };
        let mut pattern = Pattern::default();
        pattern.add_piece(Piece { lines: vec![line], ..Piece::polygon("folded", &corners) });
        let (garment, problems) = crate::cloth::build(&pattern, 0.03);
        assert!(problems.is_empty(), "{problems:?}");
        let state = bent(&garment, angle, |c| c.uv.x);
        (pattern, garment, state)
    }

    /// Cloth that lies flat up to 0.1 m of the `way` of its corners, and from there is turned back by `angle` degrees.
    fn bent(garment: &Garment, angle: f64, way: impl Fn(&Corner) -> f64) -> ClothState {
        let (sin, cos) = angle.to_radians().sin_cos();
        let mut positions = vec![DVec3::ZERO; garment.vertex_count];
        for c in &garment.corners {
            let (flat, turned) = (way(c).min(0.1), (way(c) - 0.1).max(0.0));
            positions[c.vertex as usize] = DVec3::new(flat + turned * cos, c.uv.y, -turned * sin);
        }
        ClothState { positions, mapped: vec![true; garment.vertex_count] }
    }

    /// The two squares with a button on the first, piping along its lower edge and a row of stitches along its left one.
    pub(in crate::io) fn trimmed_squares() -> (Pattern, Garment, ClothState, Vec<TrimPart>) {
        let (mut pattern, ..) = two_squares();
        let id = *pattern.pieces.keys().next().expect("a piece");
        let mut piece = (*pattern.pieces[&id]).clone();
        piece.outline[0].trims.piping = Some(Piping { radius: 0.002, colour: [200, 0, 0] });
        piece.outline[3].trims.topstitch = Some(Topstitch { distance: 0.01, ..Topstitch::default() });
        pattern.pieces.insert(id, piece.into());
        let at = |x: f64| PiecePoint { piece: id, at: DVec2::new(x, 0.05) };
        let (button, hole) = (at(0.03), at(0.06));
        let (diameter, colour) = (Button::SHIRT, Button::PEARL);
        pattern.add_button(Button { button, hole, diameter, colour, open: false, tack: false });
        let (garment, problems) = crate::cloth::build(&pattern, 0.03);
        assert!(problems.is_empty(), "{problems:?}");
        let mut positions = vec![DVec3::ZERO; garment.vertex_count];
        for c in &garment.corners {
            positions[c.vertex as usize] =
                if c.piece == id { c.uv.extend(0.0) } else { DVec3::new(0.1, c.uv.y, -c.uv.x) };
        }
        let state = ClothState { positions, mapped: vec![true; garment.vertex_count] };
        let trims = TrimParts::new(&TrimShapes::new(&garment, &pattern), &garment, &state, usize::MAX);
        (pattern, garment, state, trims.parts)
    }

    #[test]
    fn trims_of_one_kind_have_numbered_names_and_the_colours_they_should() {
        let (mut pattern, garment, state, _) = trimmed_squares();
        let id = *pattern.pieces.keys().next().expect("a piece");
        let mut piece = (*pattern.pieces[&id]).clone();
        piece.outline[2].trims.topstitch = Some(Topstitch { colour: [255, 0, 0], ..Topstitch::default() });
        piece.outline[1].trims.hem = Some(crate::pattern::Hem::USUAL);
        pattern.pieces.insert(id, piece.into());
        let parts = TrimParts::new(&TrimShapes::new(&garment, &pattern), &garment, &state, usize::MAX).parts;
        let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &parts };
        let colours = Colours::default();
        let named = dressed.trims(&colours);
        let names: Vec<&str> = named.iter().map(|(_, material)| material.name.as_str()).collect();
        assert_eq!(
            names,
            ["Piping", "Button", "Button thread", "Buttonhole", "Stitches", "Stitches 2", "Hem"],
            "the hem's own stitches are of plain thread"
        );
        let colour = |name: &str| {
            named.iter().find(|(_, m)| m.name == name).map(|(_, m)| m.sides[0]).expect("the material")
        };
        assert_eq!(colour("Stitches 2"), [1.0, 0.0, 0.0]);
        assert_eq!(colour("Hem"), colours.back);
        assert!((colour("Piping")[0] - 0.578).abs() < 1e-3 && colour("Piping")[1] == 0.0);
    }
}
