//! Strain limiting. The global steps leave little strain nearly everywhere and much of it in a few places. Here all edges are solved for
//! at once so that those beyond their limit come back to it and the others keep their length: damped least squares (Levenberg 1944) of
//! the linearised lengths, as in Goldenthal et al. 2007, "Efficient Simulation of Inextensible Cloth", but with a band within which a
//! length is free. Projecting one edge after the other (Provot 1995) took 124 rounds where this takes 18.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::cloth::ClothState;
use crate::geometry::conjugate_gradients;
use crate::geometry::parallel::{LEAST_SHARE, LEAST_SUMS};
use crate::relax::Relaxer;
use crate::relax::relaxer::LEAST_HEIGHT;
use crate::relax::step::STEP_CAP;
use crate::repose::excess::Lengths;

/// Edges are brought back to this share of the allowed strain, which leaves a margin for later repairs. Those beyond half of it are
/// held as firmly. Chosen by trial.
const AIM: f64 = 0.8;
/// Weight of an edge well within its limit, and of the damping, against that of an edge beyond it. Chosen by trial: with ten times
/// the damping it takes a quarter more rounds, with a tenth of it nearly half more; the first weight hardly matters.
const WEIGHTS: [f64; 2] = [0.1, 0.001];
/// Iterations of a round. Chosen by trial: contacts and directions are found anew after that.
const ITERATIONS: usize = 20;

/// One round of strain limiting with contacts found anew: moves the edges of `state` towards strains of at most `most` relative
/// to `lengths`, and its vertices out of the body. Returns whether nearly all edges are within.
pub(super) fn limited(lengths: &Lengths, relaxer: &mut Relaxer, state: &mut ClothState, most: f64) -> bool {
    let cap = far(relaxer);
    relaxer.track(state, cap);
    let rows = Rows::new(lengths, relaxer, state, most * AIM);
    for ((p, way), mapped) in state.positions.iter_mut().zip(rows.solved()).zip(&state.mapped) {
        if *mapped {
            *p += way.clamp_length_max(cap);
        }
    }
    raise(relaxer, state);
    lengths.p99(state) <= most * (1.0 + AIM) / 2.0
}

/// Raises vertices to where the faces round them keep clear of the body.
pub(super) fn raised(relaxer: &mut Relaxer, state: &mut ClothState) {
    relaxer.track(state, far(relaxer));
    raise(relaxer, state);
}

/// How far a vertex may go in a round, metres. Skin within that is looked for.
fn far(relaxer: &Relaxer) -> f64 {
    STEP_CAP * relaxer.surface.scale()
}

fn raise(relaxer: &Relaxer, state: &mut ClothState) {
    for (v, p) in state.positions.iter_mut().enumerate() {
        if let Some((height, normal)) = height(relaxer, v, *p) {
            *p += normal * (-height).max(0.0);
        }
    }
}

/// Height of vertex `v` at `p` above its lowest place, metres, and the normal of the skin there; None where no skin is near.
fn height(relaxer: &Relaxer, v: usize, p: DVec3) -> Option<(f64, DVec3)> {
    let plane = relaxer.plane(v as u32)?;
    Some((plane.height(p) - LEAST_HEIGHT * relaxer.offset() - relaxer.lift(v as u32), plane.normal))
}

/// The linearised lengths of all edges.
struct Rows<'a> {
    lengths: &'a Lengths,
    /// Direction of each edge from its first to its second end, times the root of its weight.
    ways: Vec<DVec3>,
    /// What each edge pulls its first end with, and pushes its second one.
    pulls: Vec<DVec3>,
    /// Normal of the skin that each vertex lies on; zero where it lies on none.
    normals: Vec<DVec3>,
}

impl<'a> Rows<'a> {
    /// Strains beyond `most` are to go.
    fn new(lengths: &'a Lengths, relaxer: &Relaxer, state: &ClothState, most: f64) -> Self {
        let row = |&([a, b], before): &([u32; 2], f64)| {
            let side = state.positions[b as usize] - state.positions[a as usize];
            let length = side.length();
            if length == 0.0 {
                return (DVec3::ZERO, DVec3::ZERO);
            }
            let excess = length - length.clamp(before * (1.0 - most), before * (1.0 + most));
            let is_firm = (length / before - 1.0).abs() > most / 2.0;
            let (way, weight) = (side / length, if is_firm { 1.0 } else { WEIGHTS[0] });
            (way * weight.sqrt(), way * (excess * weight))
        };
        // Raised to its lowest place it is above or below that by rounding.
        let lying = most * relaxer.offset();
        let normal = |(v, p): (usize, &DVec3)| match height(relaxer, v, *p) {
            Some((height, normal)) if height < lying => normal,
            _ => DVec3::ZERO,
        };
        let (ways, pulls) = lengths.edges().par_iter().with_min_len(LEAST_SHARE).map(row).unzip();
        let normals = state.positions.iter().enumerate().map(normal).collect();
        Self { lengths, ways, pulls, normals }
    }

    /// The moves of all vertices, metres.
    fn solved(&self) -> Vec<DVec3> {
        let damping = DMat3::from_diagonal(DVec3::splat(WEIGHTS[1]));
        let squared = |way: DVec3| DMat3::from_cols(way * way.x, way * way.y, way * way.z);
        let at = |v: usize| {
            let (mut pull, mut block) = (DVec3::ZERO, damping + squared(self.normals[v]));
            for (e, _) in self.lengths.around(v as u32) {
                let e = e as usize;
                block += squared(self.ways[e]);
                pull +=
                    if self.lengths.edges()[e].0[0] as usize == v { self.pulls[e] } else { -self.pulls[e] };
            }
            (pull, block.inverse())
        };
        let vertices = (0..self.normals.len()).into_par_iter().with_min_len(LEAST_SHARE);
        let (right, inverses): (Vec<DVec3>, Vec<DMat3>) = vertices.map(at).unzip();
        conjugate_gradients::solve(|x, y| self.times(x, y), &inverses, right, ITERATIONS, 0.01)
    }

    /// The matrix of the least squares, times `x`.
    fn times(&self, x: &[DVec3], y: &mut [DVec3]) {
        let row = |(v, y): (usize, &mut DVec3)| {
            let here = x[v];
            let mut sum = here * WEIGHTS[1] + self.normals[v] * self.normals[v].dot(here);
            for (e, other) in self.lengths.around(v as u32) {
                let way = self.ways[e as usize];
                sum += way * way.dot(here - x[other as usize]);
            }
            *y = sum;
        };
        y.par_iter_mut().with_min_len(LEAST_SUMS).enumerate().for_each(row);
    }
}
