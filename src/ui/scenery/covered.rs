//! Finds cloth that is covered by another layer. Its seams and hems are hidden; since lines are drawn slightly nearer to the eye,
//! they would otherwise show through. No egui here: pictures without a window use it too.

use glam::DVec3;

use crate::body::Surface;
use crate::cloth::{ClothState, Garment};
use crate::geometry::mesh::TriMesh;

/// Largest distance of an outer layer that covers cloth, metres on a body 1.5 m tall.
const NEAR: f64 = 0.012;

/// For each vertex of `garment` whether cloth of a higher layer covers it; empty if there is only one layer.
pub fn covered(garment: &Garment, state: &ClothState, scale: f64) -> Vec<bool> {
    if garment.layers.is_empty() {
        return Vec::new();
    }
    let mut layers: Vec<Option<u8>> = vec![None; state.positions.len()];
    for (vs, piece) in garment.triangles.iter().zip(&garment.triangle_pieces) {
        vs.iter().for_each(|&v| layers[v as usize] = Some(garment.layer(*piece)));
    }
    let mut covered = vec![false; state.positions.len()];
    let mut worn: Vec<u8> = layers.iter().flatten().copied().collect();
    worn.sort_unstable();
    worn.dedup();
    for pair in worn.windows(2) {
        let over = pair[1];
        let is_over = |(vs, piece): &(&[u32; 3], _)| {
            garment.layer(*piece) >= over && vs.iter().all(|&v| state.mapped[v as usize])
        };
        let triangles: Vec<[u32; 3]> = garment
            .triangles
            .iter()
            .zip(garment.triangle_pieces.iter().copied())
            .filter(is_over)
            .map(|(vs, _)| *vs)
            .collect();
        let Some(outer) = Surface::new(TriMesh { positions: state.positions.clone(), triangles }) else {
            continue;
        };
        for (v, p) in state.positions.iter().enumerate() {
            if layers[v].is_some_and(|layer| layer < over) && state.mapped[v] {
                covered[v] |= is_under(&outer, *p, NEAR * scale);
            }
        }
    }
    covered
}

/// Whether `outer` is in front of `p` within `near` metres, and not beside it, where it ends.
fn is_under(outer: &Surface, p: DVec3, near: f64) -> bool {
    outer.nearest_within(p, near).is_some_and(|found| {
        let normal = outer.face_normals[found.triangle as usize];
        let across = found.point - p;
        across.length() < 1e-9 || across.normalize().dot(normal) > 0.7
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::geometry::ids::PieceId;

    /// Two squares of 0.1 m, the second `above` the first and half beside it.
    fn stacked(above: f64) -> (Garment, ClothState) {
        let square = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)];
        let at = |first: f64, z: f64| square.map(|(x, y)| DVec3::new(x + first, y, z));
        let positions = [at(0.0, 0.0), at(0.05, above)].concat();
        let garment = Garment {
            vertex_count: 8,
            triangles: vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]],
            triangle_pieces: [1, 1, 2, 2].map(PieceId).to_vec(),
            layers: BTreeMap::from([(PieceId(2), 1)]),
            ..Garment::default()
        };
        (garment, ClothState { positions, mapped: vec![true; 8] })
    }

    #[test]
    fn what_lies_under_a_higher_layer_is_covered_and_what_lies_beside_it_not() {
        let (mut garment, state) = stacked(0.002);
        assert_eq!(covered(&garment, &state, 1.0), [false, true, true, false, false, false, false, false]);
        garment.layers.clear();
        assert!(covered(&garment, &state, 1.0).is_empty());
    }

    #[test]
    fn what_is_far_over_it_or_under_it_does_not_cover() {
        for above in [0.05, -0.002] {
            let (garment, state) = stacked(above);
            assert!(!covered(&garment, &state, 1.0).contains(&true), "{above}");
        }
    }
}
