//! Deviation of cloth from a known exact solution, for benches and tests.

use glam::{DQuat, DVec3};

use crate::cloth::{ClothState, Garment};

/// Strain l / l0 - 1 of every side of every triangle.
pub fn strains(garment: &Garment, state: &ClothState) -> Vec<f64> {
    let mut strains = Vec::with_capacity(3 * garment.triangles.len());
    for (vs, rest) in garment.triangles.iter().zip(&garment.rest) {
        for (k, j) in [(0, 1), (1, 2), (2, 0)] {
            let [a, b] = [vs[k], vs[j]].map(|v| state.positions[v as usize]);
            strains.push(a.distance(b) / rest[k].distance(rest[j]) - 1.0);
        }
    }
    strains
}

/// Strain beyond that of the exact solution, whose edges are chords: an edge between the chord's strain and zero is slack, not
/// wrong.
pub fn excess(garment: &Garment, state: &ClothState, exact: &ClothState) -> Vec<f64> {
    let pairs = strains(garment, state).into_iter().zip(strains(garment, exact));
    pairs.map(|(s, c)| s - s.clamp(c.min(0.0), c.max(0.0))).collect()
}

/// The `q`-quantile of absolute values; 0 without values.
pub fn quantile(values: &[f64], q: f64) -> f64 {
    let mut sorted: Vec<f64> = values.iter().map(|v| v.abs()).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let at = (sorted.len().saturating_sub(1) as f64 * q).round() as usize;
    sorted.get(at).copied().unwrap_or_default()
}

/// Largest distance of a vertex from its exact position, after the best rotation about y and shift along y; metres.
pub fn residual(exact: &ClothState, state: &ClothState) -> f64 {
    let pairs = || exact.positions.iter().zip(&state.positions);
    let (mut sin, mut cos, mut up) = (0.0, 0.0, 0.0);
    for (a, b) in pairs() {
        sin += b.x * a.z - b.z * a.x;
        cos += a.x * b.x + a.z * b.z;
        up += b.y - a.y;
    }
    let turn = DQuat::from_rotation_y(sin.atan2(cos));
    let shift = DVec3::Y * (up / exact.positions.len().max(1) as f64);
    pairs().map(|(a, b)| (turn * *a + shift).distance(*b)).fold(0.0, f64::max)
}
