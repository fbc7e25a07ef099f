//! Curvature of the cloth at its vertices.

use glam::DVec3;
use rayon::prelude::*;

use crate::fit::maps::{Worn, laid_corners, per_vertex};
use crate::geometry::parallel::LEAST_SHARE;

/// Paper C's curvature: the largest angle between the normals of two triangles that share the vertex, radians. NaN where
/// fewer than two have an area.
pub(super) fn largest_angle(worn: Worn<'_>) -> Vec<f64> {
    let normals: Vec<DVec3> = (0..worn.garment.triangles.len())
        .into_par_iter()
        .with_min_len(LEAST_SHARE)
        .map(|t| {
            laid_corners(worn, t).map_or(DVec3::ZERO, |[a, b, c]| (b - a).cross(c - a).normalize_or_zero())
        })
        .collect();
    per_vertex(worn, |v| {
        let around = worn.garment.adjacency.vertex_triangles.of(v);
        let normal = |t: &u32| Some(normals[*t as usize]).filter(|n| *n != DVec3::ZERO);
        // The chord between two unit normals grows with the angle, and resolves small angles, which the cosine does not.
        let mut widest = f64::NAN;
        for (i, n) in around.iter().enumerate().filter_map(|(i, t)| Some((i, normal(t)?))) {
            let chords = around[..i].iter().filter_map(normal).map(|m| m.distance_squared(n));
            widest = chords.fold(widest, f64::max);
        }
        2.0 * (widest.sqrt() / 2.0).clamp(0.0, 1.0).asin()
    })
}

/// Mean curvature, 1/m: half the length of the cotangent Laplacian of the position over the mixed Voronoi area, positive
/// where the front side bulges (Meyer, Desbrun, Schröder and Barr, Discrete differential-geometry operators for triangulated
/// 2-manifolds, 2003, eqs. 8 and 10). NaN on borders, where half of the neighbourhood is missing.
pub(super) fn mean(worn: Worn<'_>) -> Vec<f64> {
    let adjacency = &worn.garment.adjacency;
    let mut border = vec![false; worn.garment.vertex_count];
    for (e, ends) in adjacency.edges.iter().enumerate() {
        let around = adjacency.edge_triangles.of(e as u32);
        if around.len() != 2 || around.iter().any(|&t| laid_corners(worn, t as usize).is_none()) {
            ends.iter().for_each(|&v| border[v as usize] = true);
        }
    }
    per_vertex(worn, |v| if border[v as usize] { f64::NAN } else { mean_at(worn, v) })
}

fn mean_at(worn: Worn<'_>, v: u32) -> f64 {
    let (mut laplacian, mut area, mut normal) = (DVec3::ZERO, 0.0, DVec3::ZERO);
    for &t in worn.garment.adjacency.vertex_triangles.of(v) {
        let Some(Corner { sides: [to_q, to_r], cotangents: [_, at_q, at_r], share, .. }) = corner(worn, t, v)
        else {
            continue;
        };
        laplacian -= to_q * at_r + to_r * at_q;
        normal += to_q.cross(to_r);
        area += share;
    }
    if area > 0.0 { laplacian.length().copysign(laplacian.dot(normal)) / (4.0 * area) } else { f64::NAN }
}

/// A laid triangle seen from one of its corners.
pub(super) struct Corner {
    /// Vectors to the two other corners, metres.
    sides: [DVec3; 2],
    /// Cotangents of the three angles, its own first.
    cotangents: [f64; 3],
    /// Its share of the triangle's area, m²: the mixed Voronoi area of Meyer et al.
    pub share: f64,
    /// The whole area, m².
    pub area: f64,
}

/// Triangle `t` seen from its vertex `v`. None where it is not laid or has no area.
pub(super) fn corner(worn: Worn<'_>, t: u32, v: u32) -> Option<Corner> {
    let corners = laid_corners(worn, t as usize)?;
    let k = worn.garment.triangles[t as usize].iter().position(|&w| w == v)?;
    let [p, q, r] = [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]];
    let size = (q - p).cross(r - p).length();
    if size == 0.0 {
        return None;
    }
    let cotangent = |at: DVec3, one: DVec3, other: DVec3| (one - at).dot(other - at) / size;
    let cotangents @ [at_p, at_q, at_r] = [cotangent(p, q, r), cotangent(q, r, p), cotangent(r, p, q)];
    let share = if at_p < 0.0 {
        size / 4.0
    } else if at_q < 0.0 || at_r < 0.0 {
        size / 8.0
    } else {
        ((p - q).length_squared() * at_r + (p - r).length_squared() * at_q) / 8.0
    };
    Some(Corner { sides: [q - p, r - p], cotangents, share, area: size / 2.0 })
}
