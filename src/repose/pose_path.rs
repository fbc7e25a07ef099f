//! Pose interpolation path: intermediate poses between two poses of a body.
//!
//! Each triangle's deformation gradient F = R S is interpolated as exp(t log R) ((1 - t) I + t S), and the vertices are placed
//! where the triangles fit that best (Xu, Zhang, Wang and Bao 2005, "Poisson Shape Interpolation"). So limbs rotate; linear
//! interpolation of the vertices would make them thin.

use std::collections::VecDeque;
use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DMat3, DQuat, DVec3};
use rayon::prelude::*;

use crate::body::Surface;
use crate::geometry::adjacency::NONE;
use crate::geometry::parallel::LEAST_SHARE;
use crate::geometry::rebuild::Rebuild;
use crate::repose::turns::{gradient, triangle_turn, turns, whole_turn};

/// Intermediate bodies between `from` and `to`: enough for a few degrees of rotation from one to the next, but at most `most`.
/// They keep the position and orientation of `from`; the rigid motion of the whole body is left for the last step, where
/// conforming is exact. `rebuild` is made from `from` when first needed.
pub(super) fn between(
    from: &Surface,
    to: &Surface,
    most: usize,
    rebuild: &mut Option<Arc<Rebuild>>,
) -> Vec<Arc<Surface>> {
    let vertices: Vec<u32> = (0..from.mesh.positions.len() as u32).collect();
    let turned: Vec<DQuat> =
        turns(from, to, &vertices).into_iter().map(|turn| turn.unwrap_or(DQuat::IDENTITY)).collect();
    let whole = whole_turn(from, to);
    let mut angles: Vec<f64> = turned.iter().map(|&turn| turn.angle_between(whole)).collect();
    // One in twenty vertices may turn further: fingers and toes are not covered by cloth.
    let at = ((angles.len() as f64 * (1.0 - 0.05)) as usize).min(angles.len().saturating_sub(1));
    if angles.is_empty() {
        return Vec::new();
    }
    let largest = *angles.select_nth_unstable_by(at, f64::total_cmp).1;
    // A part of the body turns by at most 0.2 radians, about 11°, from one body to the next. Chosen by trial.
    let count = ((largest / 0.2).ceil() as usize).saturating_sub(1).min(most);
    if count == 0 {
        return Vec::new();
    }
    let made = rebuild.take().or_else(|| Rebuild::new(&from.mesh).map(Arc::new));
    let Some(made) = made else { return Vec::new() };
    let standing = Standing::new(from, to, whole);
    let body = |i: usize| {
        let positions = standing.at(from, &made, i as f64 / (count + 1) as f64)?;
        from.reposed(positions).map(Arc::new)
    };
    let bodies = (1..=count).into_par_iter().filter_map(body).collect();
    *rebuild = Some(made);
    bodies
}

/// Interpolation between two poses of a body, including its rigid motion.
#[derive(Debug)]
pub struct PosePath {
    from: Arc<Surface>,
    to: Arc<Surface>,
    rebuild: Rebuild,
    standing: Standing,
}

impl PosePath {
    /// The path between two poses. None when `to` has other triangles than `from`, or memory runs out.
    pub fn new(from: &Arc<Surface>, to: &Arc<Surface>) -> Option<Self> {
        let count = from.mesh.positions.len();
        if from.mesh.triangles != to.mesh.triangles || to.mesh.positions.len() != count {
            return None;
        }
        let standing = Standing::new(from, to, whole_turn(from, to));
        Some(Self {
            from: Arc::clone(from),
            to: Arc::clone(to),
            rebuild: Rebuild::new(&from.mesh)?,
            standing,
        })
    }

    /// Vertex positions at `share` 0..=1 of the path; at 0 and 1 they equal the two poses bit for bit. None when the solve fails.
    pub fn positions(&self, share: f64) -> Option<Vec<DVec3>> {
        if share <= 0.0 || share >= 1.0 {
            let end = if share <= 0.0 { &self.from } else { &self.to };
            return Some(end.mesh.positions.clone());
        }
        let mut positions = self.standing.at(&self.from, &self.rebuild, share)?;
        let Standing { whole, here, there, .. } = self.standing;
        let turn = DQuat::IDENTITY.slerp(if whole.w < 0.0 { -whole } else { whole }, share);
        let middle = here.lerp(there, share);
        positions.iter_mut().for_each(|p| *p = turn * (*p - here) + middle);
        Some(positions)
    }
}

/// Interpolation between two poses without the rigid motion of the whole body.
#[derive(Debug)]
struct Standing {
    ways: Ways,
    /// The second pose, moved to the position and orientation of the first.
    back: Vec<DVec3>,
    whole: DQuat,
    here: DVec3,
    there: DVec3,
}

impl Standing {
    fn new(from: &Surface, to: &Surface, whole: DQuat) -> Self {
        let (here, there) = (centre(&from.mesh.positions), centre(&to.mesh.positions));
        let back: Vec<DVec3> =
            to.mesh.positions.iter().map(|&p| whole.inverse() * (p - there) + here).collect();
        Self { ways: Ways::new(from, &back), back, whole, here, there }
    }

    /// Vertex positions at `share` of the path.
    fn at(&self, from: &Surface, rebuild: &Rebuild, share: f64) -> Option<Vec<DVec3>> {
        let straight = |v: usize| from.mesh.positions[v].lerp(self.back[v], share);
        let mut positions = rebuild.positions(&self.ways.at(share), straight)?;
        let shift = self.here - centre(&positions);
        positions.iter_mut().for_each(|p| *p += shift);
        Some(positions)
    }
}

fn centre(positions: &[DVec3]) -> DVec3 {
    positions.iter().sum::<DVec3>() / positions.len().max(1) as f64
}

/// Rotation and stretch of each triangle from one pose to the other.
#[derive(Debug)]
struct Ways {
    /// Rotation vectors, radians.
    turns: Vec<DVec3>,
    /// The deformation gradient without its rotation.
    stretches: Vec<DMat3>,
}

impl Ways {
    fn new(from: &Surface, to: &[DVec3]) -> Self {
        let way = |t: usize| {
            let corners = from.mesh.triangles[t];
            let (before, after) = (from.mesh.corners(t), corners.map(|v| to[v as usize]));
            let turn = triangle_turn(before, after);
            let stretch = gradient(before, after)
                .map_or(DMat3::IDENTITY, |gradient| DMat3::from_quat(turn.inverse()) * gradient);
            let shorter = if turn.w < 0.0 { -turn } else { turn };
            (shorter.to_scaled_axis(), stretch)
        };
        let count = from.mesh.triangles.len();
        let (turns, stretches) = (0..count).into_par_iter().with_min_len(LEAST_SHARE).map(way).unzip();
        let mut ways = Self { turns, stretches };
        ways.agree(from);
        ways
    }

    /// Makes neighbouring rotation vectors agree. Full turns more or less give the same rotation, so each triangle takes the
    /// vector nearest to its neighbour's, beginning with the smallest rotation.
    fn agree(&mut self, surface: &Surface) {
        let count = self.turns.len();
        let mut seen = vec![false; count];
        let mut order: Vec<u32> = (0..count as u32).collect();
        order.sort_by(|&a, &b| {
            let length = |t: u32| self.turns[t as usize].length_squared();
            length(a).total_cmp(&length(b)).then(a.cmp(&b))
        });
        for first in order {
            if std::mem::replace(&mut seen[first as usize], true) {
                continue;
            }
            let mut open = VecDeque::from([first]);
            while let Some(t) = open.pop_front() {
                for next in surface.adjacency.across[t as usize] {
                    if next != NONE && !std::mem::replace(&mut seen[next as usize], true) {
                        self.turns[next as usize] =
                            nearest(self.turns[next as usize], self.turns[t as usize]);
                        open.push_back(next);
                    }
                }
            }
        }
    }

    /// Deformation gradients at `share` of the path.
    fn at(&self, share: f64) -> Vec<DMat3> {
        let stretches = self.stretches.par_iter().with_min_len(LEAST_SHARE);
        let gradient = |(&turn, &stretch): (&DVec3, &DMat3)| {
            DMat3::from_quat(DQuat::from_scaled_axis(turn * share))
                * (DMat3::IDENTITY * (1.0 - share) + stretch * share)
        };
        self.turns.par_iter().with_min_len(LEAST_SHARE).zip(stretches).map(gradient).collect()
    }
}

/// Of the rotation vectors equivalent to `turn` the one nearest to `other`.
fn nearest(turn: DVec3, other: DVec3) -> DVec3 {
    let angle = turn.length();
    // Without a turn there is no axis.
    if angle < 1e-6 {
        return turn;
    }
    let axis = turn / angle;
    turn + axis * (((other - turn).dot(axis)) / TAU).round() * TAU
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::shapes::cylinder;

    /// The upper half of a tall cylinder laid over by `angle` about its middle, through an arc.
    fn arm(angle: f64) -> [Arc<Surface>; 2] {
        let straight = Surface::new(cylinder(0.05, 1.0, 24, 80)).expect("a body");
        let bent = |p: &DVec3| {
            let (begin, length) = (0.4, 0.2);
            let t = ((p.y - begin) / length).clamp(0.0, 1.0);
            let turn = DQuat::from_rotation_z(-angle * t);
            let radius = length / angle;
            let centre =
                DVec3::new(radius * (1.0 - (angle * t).cos()), begin + radius * (angle * t).sin(), 0.0);
            let beyond = turn * DVec3::Y * (p.y - begin - length * t);
            let axis = if t > 0.0 { centre + beyond } else { DVec3::Y * p.y };
            axis + turn * DVec3::new(p.x, 0.0, p.z)
        };
        let positions = straight.mesh.positions.iter().map(bent).collect();
        let bent = Arc::new(straight.reposed(positions).expect("as many vertices"));
        [Arc::new(straight), bent]
    }

    #[test]
    fn a_limb_keeps_its_length_and_its_girth_on_the_way() {
        let [straight, bent] = arm(2.2);
        let bodies = between(&straight, &bent, 12, &mut None);
        // The mean turn of the whole, about half of it, is left for the last step.
        assert!((5..=12).contains(&bodies.len()), "{}", bodies.len());
        let volume = straight.mesh.volume();
        // Rows of 24 vertices; the ends of the straight parts.
        let row = |body: &Surface, row: usize| {
            body.mesh.positions[24 * row..24 * (row + 1)].iter().sum::<DVec3>() / 24.0
        };
        for body in &bodies {
            assert!((body.mesh.volume() / volume - 1.0).abs() < 0.01, "{}", body.mesh.volume() / volume);
            let length = row(body, 48).distance(row(body, 80));
            assert!((length - 0.4).abs() < 2e-3, "the forearm is {length} m long");
        }
    }

    #[test]
    fn a_way_begins_and_ends_exactly_and_turns_the_whole_evenly() {
        let [straight, _] = arm(1.0);
        let turn = DQuat::from_rotation_y(1.2);
        let moved = straight.mesh.positions.iter().map(|p| turn * *p + DVec3::X).collect();
        let moved = Arc::new(straight.reposed(moved).expect("as many vertices"));
        let way = PosePath::new(&straight, &moved).expect("the same triangles");
        assert_eq!(way.positions(0.0).as_ref(), Some(&straight.mesh.positions));
        assert_eq!(way.positions(1.0).as_ref(), Some(&moved.mesh.positions));
        let half = way.positions(0.5).expect("a body");
        let middle = centre(&straight.mesh.positions);
        let there = centre(&moved.mesh.positions);
        let turn = DQuat::from_rotation_y(0.6);
        for (p, q) in straight.mesh.positions.iter().zip(&half) {
            let expected = turn * (*p - middle) + middle.lerp(there, 0.5);
            assert!(expected.distance(*q) < 1e-6, "{expected} {q}");
        }
        let other = Arc::new(Surface::new(cylinder(0.05, 1.0, 12, 80)).expect("a body"));
        assert!(PosePath::new(&straight, &other).is_none());
    }

    #[test]
    fn the_same_turn_is_taken_the_shorter_way_round() {
        let turn = DVec3::Z * 3.0;
        assert!(nearest(-DVec3::Z * (TAU - 3.0), DVec3::Z * 2.9).distance(turn) < 1e-12);
        assert_eq!(nearest(turn, DVec3::ZERO), turn);
    }
}
