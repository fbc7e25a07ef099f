//! Transport of motion from vertex to vertex in local frames (paper A, "Surface dragging").

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::drag::Graph;
use crate::geometry::parallel::LEAST_SHARE;

/// Smallest tangential fraction of an edge's length; an edge nearer to the normal gives no frame.
const UPRIGHT: f64 = 1e-4;
/// Ratio of the mean of transported motions to their mean length below which they cancel each other.
const CANCELLED: f64 = 0.2;

/// The motion of every vertex of `graph` when the hand moves by `hand`; zero elsewhere. Pins do not weaken it here,
/// because their fractions would multiply along the graph. `normals` are unit, one per vertex.
pub fn motions(graph: &Graph, positions: &[DVec3], normals: &[DVec3], hand: DVec3) -> Vec<DVec3> {
    let turn_of = |(parent, child): (u32, u32)| {
        let (p, c) = (parent as usize, child as usize);
        turn(positions[c] - positions[p], normals[p], normals[c])
    };
    let turns: Vec<DMat3> = graph.links().with_min_len(LEAST_SHARE).map(turn_of).collect();
    let mut turns = turns.iter();
    let mut motions = vec![DVec3::ZERO; positions.len()];
    let mut lengths = vec![0.0; positions.len()];
    for (child, _, parents) in graph.steps() {
        let c = child as usize;
        if parents.is_empty() {
            (motions[c], lengths[c]) = (hand, hand.length());
            continue;
        }
        let (mut sum, mut all) = (DVec3::ZERO, 0.0);
        for (&parent, turn) in parents.iter().zip(&mut turns) {
            sum += *turn * motions[parent as usize];
            all += lengths[parent as usize];
        }
        let count = parents.len() as f64;
        let (mean, length) = (sum / count, all / count);
        // Averaging directions shortens a motion: restore its length.
        let short = mean.length();
        (motions[c], lengths[c]) = match short > CANCELLED * length && short > 0.0 {
            true => (mean * (length / short), length),
            false => (mean, short),
        };
    }
    motions
}

/// The rotation that takes a motion at a parent with normal `from` to a child with normal `to`; `along` is the vector
/// between them.
fn turn(along: DVec3, from: DVec3, to: DVec3) -> DMat3 {
    match (frame(along, from), frame(along, to)) {
        (Some(parent), Some(child)) => child * parent.transpose(),
        _ => DMat3::from_quat(glam::DQuat::from_rotation_arc(from, to)),
    }
}

fn frame(along: DVec3, normal: DVec3) -> Option<DMat3> {
    let flat = along - normal * along.dot(normal);
    let (length, all) = (flat.length_squared(), along.length_squared());
    (length > UPRIGHT * UPRIGHT * all && length > 0.0).then(|| {
        let x = flat / length.sqrt();
        DMat3::from_cols(x, normal.cross(x), normal)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_a_cylinder_motion_turns_with_the_skin() {
        let at = |angle: f64| DVec3::new(angle.cos(), 0.3 * angle, angle.sin());
        let normal = |angle: f64| DVec3::new(angle.cos(), 0.0, angle.sin());
        let round = |angle: f64| DVec3::new(-angle.sin(), 0.0, angle.cos());
        let carried = turn(at(0.5) - at(0.2), normal(0.2), normal(0.5)) * (round(0.2) + DVec3::Y);
        assert!((carried - (round(0.5) + DVec3::Y)).length() < 1e-12, "{carried}");
    }

    #[test]
    fn along_the_normal_there_is_still_a_way() {
        let carried = turn(DVec3::Y, DVec3::Y, DVec3::Z) * DVec3::X;
        assert!((carried - DVec3::X).length() < 1e-12);
    }
}
