//! Cloth against itself, where two layers have run a little way into one another: between the legs, in armpits, in folds.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::cloth::{ClothState, Garment};
use crate::geometry::crossings::self_crossings;
use crate::geometry::mesh::TriMesh;

/// Rings of vertices round a crossing that tell on which side a layer belongs.
const RINGS: usize = 2;

/// For each vertex where to send it so that layers part, in units (zero: nowhere), and in how many places they cross.
///
/// Which layer came from where nothing remembers; but as long as they crossed only a little, most of the cloth round the
/// crossing still lies on its own side of the other layer, and there each goes back. `normals` are the cloth's, per vertex.
pub fn parting(garment: &Garment, state: &ClothState, normals: &[DVec3]) -> (Vec<DVec3>, usize) {
    let laid = |vs: &[u32]| vs.iter().all(|&v| state.mapped[v as usize]);
    let triangles = garment.triangles.iter().copied().filter(|vs| laid(vs)).collect();
    let mesh = TriMesh { positions: state.positions.clone(), triangles };
    let edges: Vec<[u32; 2]> = garment.adjacency.edges.iter().copied().filter(|e| laid(e)).collect();
    let mut ways = vec![DVec3::ZERO; state.positions.len()];
    let crossings = self_crossings(&mesh, &edges, &mesh.tree());
    for &[e, t] in &crossings {
        let (edge, triangle) = (&edges[e as usize][..], &mesh.triangles[t as usize][..]);
        for (one, other) in [(edge, triangle), (triangle, edge)] {
            let across = mean(normals, other).normalize_or_zero();
            let own_side = mean(&state.positions, &ring(garment, state, one));
            let side = (own_side - mean(&state.positions, other)).dot(across);
            one.iter().for_each(|&v| ways[v as usize] += across * side.signum());
        }
    }
    ways.iter_mut().for_each(|way| *way = way.clamp_length_max(1.0));
    (ways, crossings.len())
}

fn mean(of: &[DVec3], vertices: &[u32]) -> DVec3 {
    vertices.iter().map(|&v| of[v as usize]).sum::<DVec3>() / vertices.len().max(1) as f64
}

/// The laid vertices up to [`RINGS`] rings round `vertices`, ascending.
fn ring(garment: &Garment, state: &ClothState, vertices: &[u32]) -> Vec<u32> {
    let mut near: BTreeSet<u32> = vertices.iter().copied().collect();
    for _ in 0..RINGS {
        let next: Vec<u32> =
            near.iter().flat_map(|&v| garment.adjacency.vertex_neighbours.of(v)).copied().collect();
        near.extend(next.into_iter().filter(|&v| state.mapped[v as usize]));
    }
    near.into_iter().collect()
}
