//! Cloth against itself, where two layers have run a little way into one another: between the legs, in armpits, in folds.

use glam::DVec3;

use crate::cloth::{ClothState, Garment};
use crate::geometry::crossings::self_crossings;
use crate::geometry::mesh::TriMesh;

/// An edge that lies nearly in a triangle it crosses counts as this steep (a sine).
const LEAST_SLOPE: f64 = 0.1;

/// For each vertex where to send it so that layers part, in units (zero: nowhere), and in how many places they cross.
///
/// It is the way that shortens the lines in which they meet (Volino and Magnenat-Thalmann, Resolving surface collisions
/// through intersection contour minimization, 2006). That needs no memory of which layer came from where: lines end at
/// borders or close in themselves, and shrink from there.
pub fn parting(garment: &Garment, state: &ClothState) -> (Vec<DVec3>, usize) {
    let laid = |vs: &[u32]| vs.iter().all(|&v| state.mapped[v as usize]);
    let triangles = garment.triangles.iter().copied().filter(|vs| laid(vs)).collect();
    let mesh = TriMesh { positions: state.positions.clone(), triangles };
    let numbers: Vec<usize> =
        (0..garment.adjacency.edges.len()).filter(|&e| laid(&garment.adjacency.edges[e])).collect();
    let edges: Vec<[u32; 2]> = numbers.iter().map(|&e| garment.adjacency.edges[e]).collect();
    let mut ways = vec![DVec3::ZERO; state.positions.len()];
    let crossings = self_crossings(&mesh, &edges, &mesh.tree());
    let at = |v: u32| state.positions[v as usize];
    for &[e, t] in &crossings {
        let [a, b] = edges[e as usize];
        let along = (at(b) - at(a)).normalize_or_zero();
        let normal = {
            let [p, q, r] = mesh.corners(t as usize);
            (q - p).cross(r - p).normalize_or_zero()
        };
        let mut way = DVec3::ZERO;
        for &beside in garment.adjacency.edge_triangles.of(numbers[e as usize] as u32) {
            let vs = garment.triangles[beside as usize];
            if !laid(&vs) {
                continue;
            }
            let third = vs.iter().copied().find(|v| *v != a && *v != b).unwrap_or(a);
            let inward = at(third) - at(a);
            let inward = inward - along * inward.dot(along);
            // Along the line in which the two triangles meet, into the one beside the edge.
            let line = normal.cross(along.cross(inward)).normalize_or_zero();
            let line = if line.dot(inward) < 0.0 { -line } else { line };
            let slope = along.dot(normal);
            let slope = if slope.abs() < LEAST_SLOPE { LEAST_SLOPE.copysign(slope) } else { slope };
            way += line - normal * (2.0 * line.dot(along) / slope);
        }
        let way = way.clamp_length_max(1.0);
        [a, b].iter().for_each(|&v| ways[v as usize] += way);
        mesh.triangles[t as usize].iter().for_each(|&v| ways[v as usize] -= way);
    }
    ways.iter_mut().for_each(|way| *way = way.clamp_length_max(1.0));
    (ways, crossings.len())
}
