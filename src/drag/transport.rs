//! Motion carried from vertex to vertex in local frames (paper A, "Surface dragging").

use glam::{DMat3, DVec3};

use crate::drag::Graph;

/// An edge nearer to the normal than this (its tangential share) gives no frame.
const UPRIGHT: f64 = 1e-4;
/// When the mean of the carried motions is shorter than this share of their length, they really cancel.
const CANCELLED: f64 = 0.2;

/// The motion of every vertex of `graph` when the first moves by `hand`; zero elsewhere. Not weakened by pins: shares
/// would multiply on the way. `normals` are unit, one per vertex.
pub fn motions(graph: &Graph, positions: &[DVec3], normals: &[DVec3], hand: DVec3) -> Vec<DVec3> {
    let mut motions = vec![DVec3::ZERO; positions.len()];
    for (child, _, parents) in graph.steps() {
        let c = child as usize;
        if parents.is_empty() {
            motions[c] = hand;
            continue;
        }
        let (mut sum, mut lengths) = (DVec3::ZERO, 0.0);
        for &parent in parents {
            let p = parent as usize;
            let along = positions[c] - positions[p];
            sum += carried(motions[p], along, normals[p], normals[c]);
            lengths += motions[p].length();
        }
        let count = parents.len() as f64;
        let (mean, length) = (sum / count, lengths / count);
        // Averaging directions shortens; a drag keeps its length.
        let short = mean.length();
        motions[c] = if short > CANCELLED * length && short > 0.0 { mean * (length / short) } else { mean };
    }
    motions
}

/// `motion` at a parent with normal `from`, carried to a child `along` away with normal `to`.
fn carried(motion: DVec3, along: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    match (frame(along, from), frame(along, to)) {
        (Some(parent), Some(child)) => child * (parent.transpose() * motion),
        _ => glam::DQuat::from_rotation_arc(from, to) * motion,
    }
}

fn frame(along: DVec3, normal: DVec3) -> Option<DMat3> {
    let u = along.normalize_or_zero();
    let flat = u - normal * u.dot(normal);
    (flat.length() > UPRIGHT).then(|| {
        let x = flat.normalize();
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
        let carried = carried(round(0.2) + DVec3::Y, at(0.5) - at(0.2), normal(0.2), normal(0.5));
        assert!((carried - (round(0.5) + DVec3::Y)).length() < 1e-12, "{carried}");
    }

    #[test]
    fn along_the_normal_there_is_still_a_way() {
        let carried = carried(DVec3::X, DVec3::Y, DVec3::Y, DVec3::Z);
        assert!((carried - DVec3::X).length() < 1e-12);
    }
}
