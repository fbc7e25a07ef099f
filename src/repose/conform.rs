//! Mesh conforming: each vertex follows the skin that it is bound to (paper C).
//!
//! The paper's P' = Q' + R |PQ| multiplies a matrix by a number. It must mean P' = Q' + R (P - Q) (ALGORITHMS.md 1.C), here as
//! the weighted mean over all bindings of a vertex.

use glam::{DQuat, DVec3};
use rayon::prelude::*;

use crate::body::Surface;
use crate::geometry::barycentric;
use crate::geometry::parallel::LEAST_SHARE;
use crate::repose::distance_map::{Binding, DistanceMap};
use crate::repose::turns::{mean, turns};

/// Positions of the vertices on `to`, a body of the same topology, given their `positions` on `from`, to which `map` binds them.
/// Vertices bound to skin that has not moved, or to nothing, keep their positions bit for bit.
pub fn conformed(map: &DistanceMap, from: &Surface, to: &Surface, positions: &[DVec3]) -> Vec<DVec3> {
    carried(map, from, to, positions).into_iter().map(|(p, _)| p).collect()
}

/// The positions that [`conformed`] returns, each with the rotation of its skin.
pub(super) fn carried(
    map: &DistanceMap,
    from: &Surface,
    to: &Surface,
    positions: &[DVec3],
) -> Vec<(DVec3, DQuat)> {
    let mut used: Vec<u32> =
        map.bindings().iter().flat_map(|b| from.mesh.triangles[b.triangle as usize]).collect();
    used.sort_unstable();
    used.dedup();
    let found = turns(from, to, &used);
    let mut of_vertex: Vec<Option<DQuat>> = vec![None; from.mesh.positions.len()];
    used.iter().zip(found).for_each(|(&v, turn)| of_vertex[v as usize] = turn);
    let moved = |binding: &Binding| {
        let corners = from.mesh.triangles[binding.triangle as usize];
        corners.iter().any(|&v| of_vertex[v as usize].is_some())
    };
    let turn_of = |binding: &Binding| {
        let corners = from.mesh.triangles[binding.triangle as usize];
        let turned = |k: usize| of_vertex[corners[k] as usize].unwrap_or(DQuat::IDENTITY);
        mean((0..3).map(|k| (turned(k), binding.shares[k])))
    };
    let image = |binding: &Binding, turn: DQuat| {
        let point = barycentric::place(binding.shares, to.mesh.corners(binding.triangle as usize));
        (point + turn * binding.beside) * binding.weight
    };
    let place = |v: usize| match map.of(v) {
        bindings if bindings.iter().any(moved) => {
            let turns = || bindings.iter().map(|binding| (turn_of(binding), binding.weight));
            let place = bindings.iter().zip(turns()).map(|(binding, (turn, _))| image(binding, turn)).sum();
            (place, mean(turns()))
        }
        _ => (positions[v], DQuat::IDENTITY),
    };
    (0..positions.len()).into_par_iter().with_min_len(LEAST_SHARE).map(place).collect()
}
