//! Which coarser meshes of a pattern are dressed before the one that is asked for.

use std::sync::Arc;

use crate::cloth::{self, Garment};
use crate::pattern::Pattern;

/// Edges of the coarsest mesh, metres on a body 1.5 m large: as large as an arm and its hole bear.
const COARSEST: f64 = 0.028;
/// A mesh is at most this much coarser than the next.
const MOST_RATIO: f64 = 2.6;
/// With fewer edges than this between it and the coarsest a mesh is dressed at once.
const LEAST_RATIO: f64 = 1.4;

/// Coarser meshes of `pattern` than `garment` (built at `edge_length` metres), the coarsest last; none when it is coarse
/// itself. `scale` is the body's.
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

/// Whether nothing was lost by triangulating with longer edges.
fn is_the_same(a: &Garment, b: &Garment) -> bool {
    a.pieces == b.pieces && a.seam_pairs.len() == b.seam_pairs.len()
}
