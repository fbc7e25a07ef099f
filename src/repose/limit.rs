//! Strain limiting (Provot 1995, "Deformation Constraints in a Mass-Spring Model to Describe Rigid Cloth Behavior"). The global
//! steps leave little strain nearly everywhere and much of it in a few places. Here every edge beyond its limit is projected back
//! to it, one after the other, until its neighbours have taken up the rest.

use crate::cloth::ClothState;
use crate::relax::Relaxer;
use crate::relax::relaxer::LEAST_HEIGHT;
use crate::repose::excess::Lengths;

/// Edges are projected to this share of the allowed strain, which leaves a margin for later repairs. Chosen by trial.
const AIM: f64 = 0.8;
/// Passes over all edges with the same contacts. Chosen by trial; it bounds how far strain spreads before contacts are found anew.
const SWEEPS: usize = 12;
/// Distance within which skin is searched for, in offsets. Chosen by trial; it bounds how far vertices may come down in the sweeps
/// of a round unseen.
const REACH: f64 = 4.0;

/// One round of strain limiting with contacts found anew: moves the edges of `state` towards strains of at most `most` relative
/// to `lengths`, and its vertices out of the body. Returns whether nearly all edges are within.
pub(super) fn limited(lengths: &Lengths, relaxer: &mut Relaxer, state: &mut ClothState, most: f64) -> bool {
    relaxer.track(state, REACH * relaxer.offset());
    for sweep in 0..SWEEPS {
        // In alternating order, so that neither end of the garment is favoured.
        match sweep % 2 {
            0 => lengths.edges().iter().for_each(|edge| limit(state, edge, most * AIM)),
            _ => lengths.edges().iter().rev().for_each(|edge| limit(state, edge, most * AIM)),
        }
        raise(relaxer, state);
    }
    lengths.p99(state) <= most * (1.0 + AIM) / 2.0
}

/// Raises vertices to where the faces round them keep clear of the body.
pub(super) fn raised(relaxer: &mut Relaxer, state: &mut ClothState) {
    relaxer.track(state, REACH * relaxer.offset());
    raise(relaxer, state);
}

fn limit(state: &mut ClothState, &([a, b], before): &([u32; 2], f64), most: f64) {
    let [a, b] = [a as usize, b as usize];
    let side = state.positions[b] - state.positions[a];
    let [least, most] = [before * (1.0 - most), before * (1.0 + most)];
    let square = side.length_squared();
    // Fast path: most edges are well within.
    if (least * least..=most * most).contains(&square) || square == 0.0 {
        return;
    }
    let length = square.sqrt();
    let half = side * ((length - length.clamp(least, most)) / length / 2.0);
    state.positions[a] += half;
    state.positions[b] -= half;
}

fn raise(relaxer: &Relaxer, state: &mut ClothState) {
    let least = LEAST_HEIGHT * relaxer.offset();
    for (v, p) in state.positions.iter_mut().enumerate() {
        if let Some(plane) = relaxer.plane(v as u32) {
            let lacks = least + relaxer.lift(v as u32) - plane.height(*p);
            *p += plane.normal * lacks.max(0.0);
        }
    }
}
