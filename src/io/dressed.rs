//! Dressed cloth as the arrays of each of its pieces, which scene formats hold.

use glam::{DVec2, DVec3};

use crate::cloth::{ClothState, Corner, Garment, TrimPart};
use crate::geometry::ids::PieceId;
use crate::geometry::mesh::vertex_normals;
use crate::io::materials::{ClothMaterial, Colours, Textures};
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

    /// The flat corners of `piece`, and the number of the first.
    pub(super) fn corners(&self, piece: PieceId) -> (&[Corner], usize) {
        let all = &self.garment.corners;
        let first = all.partition_point(|c| c.piece < piece);
        (&all[first..all.partition_point(|c| c.piece <= piece)], first)
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

/// Cosine of the angle between the normal of a vertex and that of one side of its seam beyond which the seam is a sharp fold, as in
/// src/render/buffers.rs.
const SHARP: f64 = 0.5;

/// Area-weighted unit normals of cloth; zero where no triangle is on the body.
#[derive(Clone, Debug)]
pub(super) struct Normals {
    /// Of each vertex of the garment, over all sides of its seams.
    pub vertices: Vec<DVec3>,
    /// Of each flat corner: that of its vertex, but that of its own side where the seam is folded sharply, as a turn-up is. There
    /// the normals of both sides cancel each other out.
    pub corners: Vec<DVec3>,
}

impl Normals {
    /// The normals at `positions` of the triangles with the indices `laid`.
    pub fn new(garment: &Garment, positions: &[DVec3], laid: &[usize]) -> Self {
        let triangles: Vec<[u32; 3]> = laid.iter().map(|&t| garment.triangles[t]).collect();
        let vertices = vertex_normals(positions, &triangles);
        let mut own = vec![DVec3::ZERO; garment.corners.len()];
        for &t in laid {
            let [a, b, c] = garment.triangles[t].map(|v| positions[v as usize]);
            let normal = (b - a).cross(c - a);
            garment.triangle_corners[t].iter().for_each(|&corner| own[corner as usize] += normal);
        }
        let of_corner = |(corner, own): (&Corner, DVec3)| {
            let common = vertices[corner.vertex as usize];
            own.try_normalize().filter(|own| own.dot(common) < SHARP).unwrap_or(common)
        };
        let corners = garment.corners.iter().zip(own).map(of_corner).collect();
        Self { vertices, corners }
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

/// Vertex arrays of a piece: one entry per flat corner (a vertex of one piece in the pattern plane).
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
    /// The arrays of `piece` with its `triangles`; `normals` are those of the whole garment.
    pub fn new(
        dressed: &Dressed<'_>,
        piece: PieceId,
        triangles: impl Iterator<Item = usize>,
        normals: &Normals,
        textures: Option<&Textures>,
    ) -> Self {
        let Dressed { garment, state, pattern, trims: _ } = dressed;
        let (corners, first) = dressed.corners(piece);
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
            normals: normals.corners[first..first + corners.len()].to_vec(),
            uv: corners.iter().map(|c| uv(c.uv)).collect(),
            triangles: triangles.map(|t| garment.triangle_corners[t].map(|c| c - first as u32)).collect(),
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
    use crate::pattern::{Button, EdgeRef, Piece, PiecePoint, Piping, Seam, Topstitch};

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
        let (sin, cos) = angle.to_radians().sin_cos();
        let mut positions = vec![DVec3::ZERO; garment.vertex_count];
        for c in &garment.corners {
            let DVec2 { x, y } = c.uv;
            positions[c.vertex as usize] =
                if c.piece == ids[0] { c.uv.extend(0.0) } else { DVec3::new(0.1 + x * cos, y, -x * sin) };
        }
        let mapped = vec![true; garment.vertex_count];
        (pattern, garment, ClothState { positions, mapped })
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
        pattern.add_button(Button { button, hole, diameter, colour, open: false });
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
    fn the_sides_of_a_seam_that_is_folded_sharply_have_normals_of_their_own() {
        // Up to 60 degrees no side is far enough from the common normal, beyond 120 at least one is.
        for (angle, is_parted) in [(0.0, false), (60.0, false), (125.0, true), (175.0, true)] {
            let (_, garment, state) = bent_squares(angle);
            let all: Vec<usize> = (0..garment.triangles.len()).collect();
            let normals = Normals::new(&garment, &state.positions, &all);
            let (sin, cos) = f64::to_radians(angle).sin_cos();
            let first = garment.corners[0].piece;
            let (_, pairs) = &garment.seam_pairs[0];
            let on_seam: Vec<usize> = pairs.iter().flatten().map(|&c| c as usize).collect();
            for (i, (corner, normal)) in garment.corners.iter().zip(&normals.corners).enumerate() {
                let face = if corner.piece == first { DVec3::Z } else { DVec3::new(sin, 0.0, cos) };
                assert!(normal.dot(face) > SHARP - 1e-9, "{angle}: {normal} on {face}");
                assert!(on_seam.contains(&i) || normal.distance(face) < 1e-9, "{angle}: {normal} on {face}");
            }
            assert!(pairs.len() > 3);
            for [a, b] in pairs.iter().map(|pair| pair.map(|c| normals.corners[c as usize])) {
                assert_eq!(a.dot(b) < SHARP, is_parted, "{angle}: {a} {b}");
                assert_eq!(a != b, is_parted, "{angle}: {a} {b}");
            }
        }
    }

    #[test]
    fn cloth_that_is_not_laid_has_no_normals() {
        let (_, garment, mut state) = two_squares();
        state.positions.fill(DVec3::NAN);
        let normals = Normals::new(&garment, &state.positions, &[]);
        assert!(normals.corners.iter().chain(&normals.vertices).all(|n| *n == DVec3::ZERO));
        assert_eq!(normals.corners.len(), garment.corners.len());
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
