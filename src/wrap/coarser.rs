//! Coarser meshes of a pattern, which are dressed before the mesh that is asked for.

use std::sync::Arc;

use crate::cloth::{self, Garment};
use crate::pattern::Pattern;

/// Edge length of the coarsest mesh, metres on a body 1.5 m large: the longest that still fits an arm and its armhole.
const COARSEST: f64 = 0.028;
/// Largest ratio of edge lengths between a mesh and the next finer one. Chosen by trial; it bounds how much is left to the finer
/// mesh, in which long swings of free cloth take many steps.
const MOST_RATIO: f64 = 2.6;
/// Ratio of the coarsest edge length to the wanted one below which a mesh is dressed without coarser ones. Chosen by trial.
const LEAST_RATIO: f64 = 1.4;

/// Coarser meshes of `pattern` than `garment` (built at `edge_length` metres), the coarsest last; none when `garment`
/// is coarse itself. `scale` is that of the body.
pub fn coarser(pattern: &Pattern, garment: &Garment, edge_length: f64, scale: f64) -> Vec<Arc<Garment>> {
    let whole = COARSEST * scale / edge_length;
    if whole < LEAST_RATIO {
        return Vec::new();
    }
    let levels = (whole.ln() / MOST_RATIO.ln()).ceil().max(1.0);
    (1..=levels as i32)
        .map(|level| edge_length * whole.powf(f64::from(level) / levels))
        .map(|edge| cloth::build(pattern, edge).0)
        .take_while(|coarse| is_the_same(coarse, garment))
        .map(Arc::new)
        .collect()
}

/// Whether two meshes have the same pieces and number of seams, so that coarser triangulation lost nothing.
fn is_the_same(a: &Garment, b: &Garment) -> bool {
    a.pieces == b.pieces && a.seam_pairs.len() == b.seam_pairs.len()
}
