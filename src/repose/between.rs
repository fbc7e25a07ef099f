//! Poses on the way from one to another.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::body::Surface;
use crate::repose::turns::{mean, turns};

/// No part of the body turns further between two poses, radians.
const LARGEST_TURN: f64 = 0.15;
/// Of all vertices this share may turn further: fingers and toes are not covered by cloth.
const LEFT_OUT: f64 = 0.05;

/// Bodies between `from` and `to`, so many that its parts turn by a few degrees from one to the next, but `most`. They
/// stand as `from` does: the turn and shift of the whole body is left for the last step, which conforming takes exactly. Each
/// vertex goes straight, so that limbs are a little too thin between; cloth does not mind for the while.
pub(super) fn between(from: &Surface, to: &Surface, most: usize) -> Vec<Arc<Surface>> {
    let vertices: Vec<u32> = (0..from.mesh.positions.len() as u32).collect();
    let turned: Vec<DQuat> =
        turns(from, to, &vertices).into_iter().map(|turn| turn.unwrap_or(DQuat::IDENTITY)).collect();
    let whole = mean(turned.iter().map(|&turn| (turn, 1.0)));
    let mut angles: Vec<f64> = turned.iter().map(|&turn| turn.angle_between(whole)).collect();
    let at = ((angles.len() as f64 * (1.0 - LEFT_OUT)) as usize).min(angles.len().saturating_sub(1));
    if angles.is_empty() {
        return Vec::new();
    }
    let largest = *angles.select_nth_unstable_by(at, f64::total_cmp).1;
    let count = ((largest / LARGEST_TURN).ceil() as usize).saturating_sub(1).min(most);
    let centre = |surface: &Surface| {
        surface.mesh.positions.iter().sum::<DVec3>() / surface.mesh.positions.len().max(1) as f64
    };
    let (here, there) = (centre(from), centre(to));
    let back: Vec<DVec3> = to.mesh.positions.iter().map(|&p| whole.inverse() * (p - there) + here).collect();
    let at = |share: f64| from.mesh.positions.iter().zip(&back).map(|(&p, &q)| p.lerp(q, share)).collect();
    (1..=count).filter_map(|i| from.reposed(at(i as f64 / (count + 1) as f64)).map(Arc::new)).collect()
}
