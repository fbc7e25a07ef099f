//! Rims of cloth: its thickness at open edges, as a rolled hem. No egui here: pictures without a window use it too.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};

use crate::cloth::{ClothState, Garment};
use crate::geometry::adjacency::NONE;
use crate::geometry::ids::PieceId;
use crate::render::Mesh;
use crate::ui::scenery::fabric_looks::{PieceLooks, flat};

/// Thickness of a rim over that of the cloth: hems are folded over twice.
const FOLDS: f32 = 3.0;
/// Range of the thickness of a rim, metres.
const RANGE: [f32; 2] = [0.0012, 0.005];
/// Width of the fold inside, in thicknesses of the rim.
const INSIDE: f32 = 3.0;

/// The profile of a rim: how far out of the edge, and how far inwards from the outer side, both in thicknesses; and the part of
/// the normal that points out of the edge, and that which points along the cloth's own.
const PROFILE: [([f32; 2], [f32; 2]); 5] = [
    ([0.0, 0.0], [0.3, 0.95]),
    ([0.4, 0.2], [0.75, 0.65]),
    ([0.55, 0.55], [1.0, 0.0]),
    ([0.35, 0.9], [0.7, -0.7]),
    ([-INSIDE, 0.75], [-0.1, -1.0]),
];

/// An open edge of a triangle of cloth that is on the body.
#[derive(Clone, Copy, Debug)]
pub struct OpenEdge {
    triangle: usize,
    /// The edge runs from this corner of the triangle to the next.
    corner: usize,
}

/// The open edges of the cloth that is on the body and not hidden: hems and openings, no seams.
pub fn open_edges(garment: &Garment, state: &ClothState, is_seen: &dyn Fn(u32) -> bool) -> Vec<OpenEdge> {
    let is_laid = |t: usize| garment.triangles[t].iter().all(|&v| state.mapped[v as usize]);
    let mut edges = Vec::new();
    for t in (0..garment.triangles.len()).filter(|&t| is_laid(t)) {
        for k in 0..3 {
            let ends = [garment.triangles[t][k], garment.triangles[t][(k + 1) % 3]];
            let is_open = garment.adjacency.across[t][k] == NONE
                && garment.adjacency.edge_triangles.of(garment.adjacency.triangle_edges[t][k]).len() == 1;
            if is_open && ends.into_iter().all(is_seen) {
                edges.push(OpenEdge { triangle: t, corner: k });
            }
        }
    }
    edges
}

/// The mean direction out of the cloth at the vertices of `edges`, unit, in the cloth's tangent plane.
fn outward(garment: &Garment, whole: &Mesh, edges: &[OpenEdge]) -> BTreeMap<u32, Vec3> {
    let mut out: BTreeMap<u32, Vec3> = BTreeMap::new();
    for edge in edges {
        let [a, b, c] = [0, 1, 2].map(|i| garment.triangles[edge.triangle][(edge.corner + i) % 3]);
        let [p, q, r] = [a, b, c].map(|v| whole.positions[v as usize]);
        let away = (p - r).reject_from((q - p).normalize_or_zero()).normalize_or_zero() * p.distance(q);
        for v in [a, b] {
            *out.entry(v).or_default() += away;
        }
    }
    for (&v, away) in &mut out {
        *away = away.reject_from(whole.normals[v as usize]).normalize_or_zero();
    }
    out
}

/// Rims along `edges` of the cloth `whole`, one mesh for each piece that has any and for which `painted` gives one without
/// triangles in its colours. `thickness` is that of the cloth of a piece, metres.
pub fn rims(
    garment: &Garment,
    whole: &Mesh,
    edges: &[OpenEdge],
    looks: &PieceLooks,
    thickness: impl Fn(PieceId) -> f32,
    painted: impl Fn(PieceId) -> Option<Mesh>,
) -> Vec<Mesh> {
    if whole.normals.len() != whole.positions.len() {
        return Vec::new();
    }
    let out = outward(garment, whole, edges);
    let mut pieces: BTreeMap<PieceId, Vec<OpenEdge>> = BTreeMap::new();
    for edge in edges {
        pieces.entry(garment.triangle_pieces[edge.triangle]).or_default().push(*edge);
    }
    let mesh = |(piece, edges): (PieceId, Vec<OpenEdge>)| {
        let thick = (thickness(piece) * FOLDS).clamp(RANGE[0], RANGE[1]);
        let grain = looks.get(&piece).map(|look| look.grain);
        let mut mesh = painted(piece)?;
        (mesh.positions, mesh.normals) = (Vec::new(), Vec::new());
        (mesh.triangles, mesh.flat, mesh.colours) = (Vec::new(), Vec::new(), Vec::new());
        for edge in edges {
            push_rim(
                &mut mesh,
                garment,
                whole,
                edge,
                &out,
                thick,
                grain.map(|g| flat(garment, edge.triangle, g)),
            );
        }
        Some(mesh)
    };
    pieces.into_iter().filter_map(mesh).collect()
}

/// Adds the rim of one edge; `flat` are the texture coordinates of its triangle.
fn push_rim(
    mesh: &mut Mesh,
    garment: &Garment,
    whole: &Mesh,
    edge: OpenEdge,
    out: &BTreeMap<u32, Vec3>,
    thick: f32,
    flat: Option<[Vec2; 3]>,
) {
    let base = mesh.positions.len() as u32;
    let corners = [edge.corner, (edge.corner + 1) % 3];
    for k in corners {
        let v = garment.triangles[edge.triangle][k];
        let (at, normal) = (whole.positions[v as usize], whole.normals[v as usize]);
        let away = out.get(&v).copied().unwrap_or_default();
        for ([outwards, inwards], [by_out, by_normal]) in PROFILE {
            mesh.positions.push(at + (away * outwards - normal * inwards) * thick);
            mesh.normals.push((away * by_out + normal * by_normal).normalize_or_zero());
        }
    }
    let rings = PROFILE.len() as u32;
    for i in 0..rings - 1 {
        let [a, b] = [base + i, base + rings + i];
        // Seen from outside the profile runs to the right of the edge.
        mesh.triangles.extend([[a, a + 1, b], [b, a + 1, b + 1]]);
        if let Some(flat) = flat {
            let [p, q] = corners.map(|k| flat[k]);
            mesh.flat.extend([[p, p, q], [q, p, q]]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::adjacency::Adjacency;
    use glam::DVec3;

    /// A square of 0.2 m in the plane z = 0, its outside towards the viewer.
    fn square() -> (Garment, ClothState, Mesh) {
        let corners = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.0, 0.2]].map(|[x, y]| DVec3::new(x, y, 0.0));
        let triangles = vec![[0, 1, 2], [0, 2, 3]];
        let garment = Garment {
            vertex_count: 4,
            adjacency: Adjacency::new(4, &triangles),
            triangle_pieces: vec![PieceId(1); 2],
            triangles,
            ..Garment::default()
        };
        let whole = Mesh {
            positions: corners.map(|p| p.as_vec3()).to_vec(),
            normals: vec![Vec3::Z; 4],
            ..Mesh::default()
        };
        (garment, ClothState { positions: corners.to_vec(), mapped: vec![true; 4] }, whole)
    }

    #[test]
    fn a_square_has_a_rim_all_round_as_thick_as_its_cloth() {
        let (garment, state, whole) = square();
        let edges = open_edges(&garment, &state, &|_| true);
        assert_eq!(edges.len(), 4, "not the diagonal");
        let painted = |_| Some(Mesh::default());
        let made = rims(&garment, &whole, &edges, &PieceLooks::new(), |_| 1e-3, painted);
        let [rim] = &made[..] else { panic!("{} meshes", made.len()) };
        assert_eq!(rim.triangles.len(), 4 * 2 * (PROFILE.len() - 1));
        let (low, high) = rim.bounds().expect("points");
        assert!(low.z > -0.0031 && low.z < -0.0025 && high.z.abs() < 1e-7, "{low} {high}");
        assert!(low.x < -1e-3 && low.x > -2.5e-3 && high.y > 0.201 && high.y < 0.2025, "{low} {high}");
        for t in &rim.triangles {
            let [a, b, c] = t.map(|v| rim.positions[v as usize]);
            let normal = t.map(|v| rim.normals[v as usize]).into_iter().sum::<Vec3>();
            assert!((b - a).cross(c - a).dot(normal) > 0.0, "its front is outside");
        }
    }

    #[test]
    fn hidden_edges_and_cloth_that_is_not_on_yet_have_none() {
        let (garment, mut state, _) = square();
        assert!(open_edges(&garment, &state, &|v| v != 0).len() == 2);
        state.mapped[1] = false;
        assert_eq!(open_edges(&garment, &state, &|_| true).len(), 2, "the border of what is on is no hem");
    }
}
