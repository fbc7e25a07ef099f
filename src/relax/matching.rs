//! Pulls of triangles on their corners: towards the rest shape, rotated on to the present one.

use glam::DVec3;
use rayon::prelude::*;

use crate::cloth::{ClothState, Garment};
use crate::contact::Tracker;
use crate::geometry::adjacency::Lists;
use crate::geometry::parallel::LEAST_SHARE;
use crate::relax::Rotation;
use crate::relax::goals::{turned_rest, turned_rest_facing};
use crate::relax::step::FOLDED;

/// Pulls of all triangles of a garment. Recomputed in every step, except `corners`.
#[derive(Clone, Debug)]
pub(super) struct Matching {
    /// For each vertex its places in triangles: three times the triangle, plus the index of the vertex in it.
    corners: Lists,
    /// For each corner of each triangle the vector from its position to its goal, metres.
    pub pulls: Vec<[DVec3; 3]>,
    /// For each triangle its energy: the sum over corners of |x - c - R w|^2.
    energies: Vec<f64>,
}

impl Matching {
    pub fn new(garment: &Garment) -> Self {
        let slots = |(t, vs): (usize, &[u32; 3])| {
            let vs = *vs;
            (0..3).map(move |k| (vs[k], (3 * t + k) as u32))
        };
        let count = garment.triangles.len();
        Self {
            corners: Lists::grouped(
                garment.vertex_count,
                garment.triangles.iter().enumerate().flat_map(slots),
            ),
            pulls: vec![[DVec3::ZERO; 3]; count],
            energies: vec![0.0; count],
        }
    }

    /// Matches the rest shape of every placed triangle to its present one. With the `normals` of the cloth at its
    /// vertices, a triangle that faces against them is turned over.
    pub fn turn(
        &mut self,
        garment: &Garment,
        state: &ClothState,
        tracker: &Tracker,
        normals: Option<&[DVec3]>,
        by: Rotation,
    ) {
        let triangles = self.pulls.par_iter_mut().zip(&mut self.energies).enumerate();
        triangles.with_min_len(LEAST_SHARE).for_each(|(t, (pulls, energy))| {
            let vs = garment.triangles[t];
            let [a, b, c] = [vs[0] as usize, vs[1] as usize, vs[2] as usize];
            if !(state.mapped[a] && state.mapped[b] && state.mapped[c]) {
                (*pulls, *energy) = ([DVec3::ZERO; 3], 0.0);
                return;
            }
            let corners = [state.positions[a], state.positions[b], state.positions[c]];
            let rest = &garment.rest[t];
            let cloth = normals.map_or(DVec3::ZERO, |n| n[a] + n[b] + n[c]);
            let turned = match faces_away(corners, cloth) {
                true => turned_rest_facing(corners, rest, cloth, by),
                false => turned_rest(corners, rest, || body_normal(tracker, &vs).unwrap_or(DVec3::Z), by),
            };
            let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
            let pull = |k: usize| turned[k] + centre - corners[k];
            *pulls = [pull(0), pull(1), pull(2)];
            *energy = pulls[0].length_squared() + pulls[1].length_squared() + pulls[2].length_squared();
        });
    }

    /// The sum of the pulls on `vertex`.
    pub fn force(&self, vertex: u32) -> DVec3 {
        let pulls = self.pulls.as_flattened();
        self.corners.of(vertex).iter().map(|&slot| pulls[slot as usize]).sum()
    }

    /// Energy of all triangles at the last [`Matching::turn`].
    pub fn energy(&self) -> f64 {
        self.energies.iter().sum()
    }

    /// Memory used, bytes: by the lists, and by values that every step recomputes.
    pub fn bytes(&self) -> [usize; 2] {
        let scratch = self.pulls.len() * (size_of::<[DVec3; 3]>() + size_of::<f64>());
        [self.corners.bytes(), scratch]
    }
}

/// The mean normal of the skin near three vertices; None where there is none.
pub(super) fn body_normal(tracker: &Tracker, vs: &[u32; 3]) -> Option<DVec3> {
    let sum: DVec3 = vs.iter().filter_map(|&v| tracker.plane(v as usize)).map(|p| p.normal).sum();
    sum.try_normalize()
}

fn faces_away(corners: [DVec3; 3], normal: DVec3) -> bool {
    let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let along = area.dot(normal);
    along < 0.0 && along * along > FOLDED * FOLDED * area.length_squared() * normal.length_squared()
}
