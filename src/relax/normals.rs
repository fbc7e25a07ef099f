//! Normals of the cloth.

use glam::DVec3;
use rayon::prelude::*;

use crate::cloth::{ClothState, Garment};
use crate::geometry::parallel::LEAST_SUMS;

/// For each vertex its normal as from [`normal_round`].
pub(super) fn vertex_normals(garment: &Garment, state: &ClothState) -> Vec<DVec3> {
    let triangles = garment.triangles.par_iter().with_min_len(LEAST_SUMS);
    let areas: Vec<DVec3> = triangles.map(|vs| area(vs, state)).collect();
    let around = |v: u32| garment.adjacency.vertex_triangles.of(v).iter();
    let vertices = (0..garment.vertex_count as u32).into_par_iter().with_min_len(LEAST_SUMS);
    vertices.map(|v| around(v).map(|&t| areas[t as usize]).sum::<DVec3>().normalize_or_zero()).collect()
}

/// Area-weighted unit normal of the placed triangles round `v`, on the front side; zero where there is none.
pub(super) fn normal_round(garment: &Garment, state: &ClothState, v: u32) -> DVec3 {
    let around = garment.adjacency.vertex_triangles.of(v).iter();
    around.map(|&t| area(&garment.triangles[t as usize], state)).sum::<DVec3>().normalize_or_zero()
}

/// Normal of a placed triangle on its front side, with twice the area as length (m²); zero where it is not placed.
fn area(vs: &[u32; 3], state: &ClothState) -> DVec3 {
    if !vs.iter().all(|&v| state.mapped[v as usize]) {
        return DVec3::ZERO;
    }
    let [a, b, c] = vs.map(|v| state.positions[v as usize]);
    (b - a).cross(c - a)
}
