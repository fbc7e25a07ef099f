//! Pressure of the cloth on the skin.

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Nearest;
use crate::cloth::fabric::{GRAVITY, green, stress, wrinkled};
use crate::fit::maps::curvature::corner;
use crate::fit::maps::strain::{flat, grain};
use crate::fit::maps::{Worn, laid_corners, per_vertex};
use crate::geometry::parallel::LEAST_SHARE;

/// Distance from the skin, in offsets of a wrap, up to which cloth counts as touching it.
const LIES: f64 = 1.25;

/// Pressure on the skin at each vertex that touches it, Pa: the normal component of the forces at the vertex over its mixed
/// Voronoi area. The forces are those of the membrane in its present strain, wrinkled where compressed, and the weight. This is
/// Laplace's law p = T1 k1 + T2 k2 (for cloth: Kirk and Ibrahim, Fundamental relationship of fabric extensibility to
/// anthropometric requirements and garment performance, 1966) in its weak form, which needs no curvatures. 0 where the forces
/// would lift the cloth off; NaN where it does not touch the skin or has no fabric.
///
/// Left out are bending (B/r³, 0.3 Pa for 4e-5 N·m and r = 5 cm) and the pressure of outer layers.
///
/// `skin` is the nearest point of the body to each vertex.
pub(super) fn pressure(worn: Worn<'_>, skin: &[Option<Nearest>]) -> Vec<f64> {
    let garment = worn.garment;
    let forces = corner_forces(worn);
    per_vertex(worn, |v| {
        let Some(skin) = skin[v as usize].filter(|skin| skin.distance <= LIES * worn.offset) else {
            return f64::NAN;
        };
        let (mut inward, mut area) = (0.0, 0.0);
        for &t in garment.adjacency.vertex_triangles.of(v) {
            let Some(of_triangle) = &forces[t as usize] else { return f64::NAN };
            let Some(corner) = corner(worn, t, v) else { continue };
            let k = garment.triangles[t as usize].iter().position(|&w| w == v).unwrap_or(0);
            let weight = GRAVITY * (of_triangle.mass * corner.share / corner.area);
            inward -= (of_triangle.corners[k] + weight).dot(skin.normal);
            area += corner.share;
        }
        if area > 0.0 { (inward / area).max(0.0) } else { f64::NAN }
    })
}

struct Forces {
    /// Membrane force on each corner, N.
    corners: [DVec3; 3],
    /// Mass of the triangle, kg.
    mass: f64,
}

/// Membrane forces of each triangle. None where it is not laid, has no flat area, or has no fabric.
fn corner_forces(worn: Worn<'_>) -> Vec<Option<Forces>> {
    let grain = grain(worn);
    let of_triangle = |t: usize| {
        let piece = worn.garment.triangle_pieces[t];
        let (fabric, &along) = (worn.fabrics.get(&piece)?, grain.get(&piece)?);
        let [a, b, c] = laid_corners(worn, t)?;
        let (area, [warp, weft]) = flat(worn, t, along)?;
        let frame = [warp, weft].map(|slope| (b - a) * slope.y + (c - a) * slope.z);
        let strain = green(frame);
        let [s0, s1, s01] = stress(wrinkled(fabric.stretch.tangent(), strain), strain);
        let [p0, p1] = [frame[0] * s0 + frame[1] * s01, frame[0] * s01 + frame[1] * s1];
        let corners = [0, 1, 2].map(|k| (p0 * warp[k] + p1 * weft[k]) * -area);
        Some(Forces { corners, mass: fabric.density_kg_per_m2 * area })
    };
    (0..worn.garment.triangles.len()).into_par_iter().with_min_len(LEAST_SHARE).map(of_triangle).collect()
}
