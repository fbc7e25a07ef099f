//! The mannequin's skin over its skeleton.
//!
//! A share tells how much of a joint's turn each point of the skin takes: none above the joint, all below, smoothly in
//! between. The turns of the joints above a triangle, each by its share, make the triangle's turn, and of all places of the
//! vertices those are taken whose triangles come nearest to their turns ([`Rebuild`]). Blending places, as linear and
//! dual-quaternion skinning do, thins or swells limbs at joints; here nothing asks a triangle to change its size, so that
//! elbows, knees, hips and shoulders keep theirs.

use std::sync::{Arc, Mutex};

use glam::{DMat3, DQuat, DVec3};
use rayon::prelude::*;

use crate::body::landmarks::Landmarks;
use crate::body::mannequin::{Mannequin, MannequinError, Measurements, mannequin};
use crate::body::pose::Pose;
use crate::body::pose::motion::Placement;
use crate::body::pose::regions::{JOINTS, Regions};
use crate::body::skeleton::{Joint, Skeleton};
use crate::body::surface::Surface;
use crate::geometry::rebuild::Rebuild;

/// Of a joint's turn less than this is none.
const LEAST: f64 = 1e-4;
/// A joint goes along with the skin about so far round it, metres on a figure of default height.
const ROUND: f64 = 0.05;
/// Rigs kept, so that a change of measurements and back is quick.
const MOST_KEPT: usize = 4;
/// Triangles one thread takes at a time.
const LEAST_SHARE: usize = 512;

/// A mannequin that can be posed.
#[derive(Debug)]
pub struct Rig {
    figure: Arc<Mannequin>,
    surface: Arc<Surface>,
    rebuild: Rebuild,
    /// For each of `JOINTS` its share at each vertex, 0..=1.
    shares: Vec<Vec<f64>>,
    /// Vertices of the pelvis: those that every joint turns by less than half.
    still: Vec<u32>,
}

/// The mannequin in a pose.
#[derive(Clone, Debug)]
pub struct Posed {
    /// Its skin: the vertices of the built one, in their order. The feet, or what is lowest, on y = 0.
    pub surface: Arc<Surface>,
    /// Its joints.
    pub skeleton: Skeleton,
    /// Named points on its skin.
    pub landmarks: Landmarks,
}

/// The rig of the mannequin with measurements `m`; made once in a process for each (the last four are kept).
pub fn rig(m: &Measurements) -> Result<Arc<Rig>, MannequinError> {
    static KEPT: Mutex<Vec<Arc<Rig>>> = Mutex::new(Vec::new());
    let mut kept = KEPT.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    if let Some(found) = kept.iter().find(|rig| rig.figure.measurements == *m) {
        return Ok(Arc::clone(found));
    }
    let made = Arc::new(Rig::new(mannequin(m)?).ok_or(MannequinError::Unreachable)?);
    if kept.len() == MOST_KEPT {
        kept.remove(0);
    }
    kept.push(Arc::clone(&made));
    Ok(made)
}

impl Rig {
    /// None when the figure has no skin or lacks a joint, or does not fit in memory.
    pub fn new(figure: Arc<Mannequin>) -> Option<Self> {
        let surface = Arc::new(Surface::new(figure.mesh.clone())?);
        let rebuild = Rebuild::new(&figure.mesh)?;
        let shares = shares(&figure, &rebuild)?;
        let is_still = |v: &u32| shares.iter().all(|of| of[*v as usize] < 0.5);
        let still = (0..figure.mesh.positions.len() as u32).filter(is_still).collect();
        Some(Self { figure, surface, rebuild, shares, still })
    }

    /// The figure as it was built.
    pub fn figure(&self) -> &Arc<Mannequin> {
        &self.figure
    }

    /// The figure in `pose`. None when a turn in it is no number.
    pub fn posed(&self, pose: &Pose) -> Option<Posed> {
        let mut positions = self.positions(pose)?;
        self.put_down(&mut positions);
        let skeleton = self.skeleton(&positions, pose);
        let landmarks = self.figure.landmarks.clone().map(|p| self.carried(p, &positions));
        let surface = Arc::new(self.surface.reposed(positions)?);
        Some(Posed { surface, skeleton, landmarks })
    }

    /// Its skin in `pose`, its pelvis turned about itself and moved from where it was built: on no floor. None when a turn
    /// or the place is no number.
    pub fn placed(&self, pose: &Pose, place: &Placement) -> Option<Arc<Surface>> {
        let mut positions = self.positions(pose)?;
        let pelvis = self.figure.skeleton.position("pelvis")?;
        let aside = self.middle(&self.figure.mesh.positions) - self.middle(&positions);
        positions.iter_mut().for_each(|p| *p = place.turn * (*p + aside - pelvis) + pelvis + place.shift);
        self.surface.reposed(positions).map(Arc::new)
    }

    /// Vertices in `pose`, somewhere.
    fn positions(&self, pose: &Pose) -> Option<Vec<DVec3>> {
        let turns: Vec<DVec3> =
            JOINTS.iter().map(|(name, _)| pose.turns.get(*name).copied().unwrap_or_default()).collect();
        let built = &self.figure.mesh.positions;
        self.rebuild.positions(&self.gradients(&turns), |v| built[v])
    }

    /// The turn of each triangle.
    fn gradients(&self, turns: &[DVec3]) -> Vec<DMat3> {
        let part = |j: usize| JOINTS[j].0.split('_').next();
        let turned: Vec<usize> = (0..turns.len()).filter(|&j| turns[j] != DVec3::ZERO).collect();
        let turned: Vec<&[usize]> = turned.chunk_by(|&i, &j| part(i) == part(j)).collect();
        let gradient = |corners: &[u32; 3]| {
            let mut whole = DQuat::IDENTITY;
            for joints in &turned {
                // Both sides at once: where both have a share, neither comes first.
                let turn = |&j: &usize| {
                    let share = corners.iter().map(|&v| self.shares[j][v as usize]).sum::<f64>() / 3.0;
                    if share > LEAST { turns[j] * share } else { DVec3::ZERO }
                };
                let turn: DVec3 = joints.iter().map(turn).sum();
                if turn != DVec3::ZERO {
                    whole *= DQuat::from_scaled_axis(turn);
                }
            }
            DMat3::from_quat(whole)
        };
        self.figure.mesh.triangles.par_iter().with_min_len(LEAST_SHARE).map(gradient).collect()
    }

    /// The pelvis stays over its place, and the lowest point on the floor.
    fn put_down(&self, positions: &mut [DVec3]) {
        let aside = self.middle(&self.figure.mesh.positions) - self.middle(positions);
        let lowest = positions.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
        let shift = DVec3::new(aside.x, -lowest, aside.z);
        positions.iter_mut().for_each(|p| *p += shift);
    }

    /// Of the pelvis.
    fn middle(&self, positions: &[DVec3]) -> DVec3 {
        self.still.iter().map(|&v| positions[v as usize]).sum::<DVec3>() / self.still.len().max(1) as f64
    }

    /// Each joint as it lies in the skin round it.
    fn skeleton(&self, positions: &[DVec3], pose: &Pose) -> Skeleton {
        let built = &self.figure.mesh.positions;
        let joints = &self.figure.skeleton.joints;
        let reach = ROUND * self.figure.measurements.height / Measurements::default().height;
        let mut whole: Vec<DQuat> = Vec::new();
        let posed = joints.iter().map(|joint| {
            let before = joint.parent.map_or(DQuat::IDENTITY, |parent| whole[parent]);
            let own = pose.turn(&joint.name);
            whole.push(before * own);
            let half = before * DQuat::IDENTITY.slerp(own, 0.5);
            let mut sums = (DVec3::ZERO, DVec3::ZERO, 0.0);
            for (p, q) in built.iter().zip(positions) {
                let weight = (-p.distance_squared(joint.position) / (2.0 * reach * reach)).exp();
                sums = (sums.0 + *p * weight, sums.1 + *q * weight, sums.2 + weight);
            }
            let [was, is] = [sums.0 / sums.2, sums.1 / sums.2];
            Joint { position: is + half * (joint.position - was), ..joint.clone() }
        });
        Skeleton { joints: posed.collect() }
    }

    /// Where a point of the built skin is.
    fn carried(&self, p: DVec3, positions: &[DVec3]) -> DVec3 {
        let near = self.surface.nearest(p);
        let [a, b, c] = self.surface.mesh.corners(near.triangle as usize);
        let normal = (b - a).cross(c - a);
        let share = |u: DVec3, v: DVec3| (u - p).cross(v - p).dot(normal) / normal.length_squared();
        let shares = [share(b, c), share(c, a), share(a, b)];
        let corners = self.surface.mesh.triangles[near.triangle as usize];
        (0..3).map(|k| positions[corners[k] as usize] * shares[k]).sum()
    }
}

/// The share of each joint at each vertex: all or nothing by regions, then smoothed over the skin.
fn shares(figure: &Mannequin, rebuild: &Rebuild) -> Option<Vec<Vec<f64>>> {
    let regions = Regions::new(&figure.skeleton)?;
    let size = figure.measurements.height / Measurements::default().height;
    let base = JOINTS.iter().map(|(_, reach)| *reach).fold(f64::INFINITY, f64::min);
    let smoother = rebuild.smoother(base * size)?;
    let mut order: Vec<usize> = (0..JOINTS.len()).collect();
    order.sort_by(|&i, &j| JOINTS[j].1.total_cmp(&JOINTS[i].1).then(i.cmp(&j)));
    let mut shares = vec![Vec::new(); JOINTS.len()];
    // Three fields are smoothed at once, those that take as many rounds together.
    for three in order.chunks(3) {
        let is_below = |p: &DVec3| {
            let share = |k: usize| match three.get(k) {
                Some(&j) if regions.is_below(JOINTS[j].0, *p) => 1.0,
                _ => 0.0,
            };
            DVec3::new(share(0), share(1), share(2))
        };
        let mut values: Vec<DVec3> = figure.mesh.positions.iter().map(is_below).collect();
        let mut done = 0;
        for (k, &j) in three.iter().enumerate().rev() {
            let rounds = (JOINTS[j].1 / base).powi(2).round() as usize;
            while done < rounds {
                smoother.smooth(&mut values).then_some(())?;
                done += 1;
            }
            shares[j] = values.iter().map(|v| v[k].clamp(0.0, 1.0)).collect();
        }
    }
    Some(shares)
}
