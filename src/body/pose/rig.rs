//! Skinning: the mannequin's skin deformed by its skeleton.
//!
//! A weight tells how much of a joint's rotation each point of the skin takes: none above the joint, all below,
//! smoothly in between. The rotations of the joints above a triangle, each scaled by its weight, make the triangle's
//! rotation, and the vertices are placed so that triangles come as near as possible to their rotations ([`Rebuild`]).
//! Blending positions, as linear and dual-quaternion skinning do, thins or swells limbs at joints; here no triangle
//! is asked to change its size, so that elbows, knees, hips and shoulders keep theirs.

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
use crate::geometry::parallel::LEAST_SHARE;
use crate::geometry::rebuild::Rebuild;

/// Weight up to which a joint does not move a triangle.
const LEAST: f64 = 1e-4;
/// Radius of the skin round a joint that the joint follows (standard deviation of a Gaussian), metres on a figure of
/// default height.
const ROUND: f64 = 0.05;
/// Number of rigs in the cache, so that a change of measurements and back is quick.
const MOST_KEPT: usize = 4;

/// A mannequin prepared for posing.
#[derive(Debug)]
pub struct Rig {
    figure: Arc<Mannequin>,
    surface: Arc<Surface>,
    rebuild: Rebuild,
    /// For each of `JOINTS` its skinning weight at each vertex, 0..=1.
    shares: Vec<Vec<f64>>,
    /// Vertices of the pelvis: those where every joint has a weight below one half.
    still: Vec<u32>,
}

/// The mannequin in a pose.
#[derive(Clone, Debug)]
pub struct Posed {
    /// The skin, with the vertices of the built one in their order. Its lowest point is at y = 0.
    pub surface: Arc<Surface>,
    /// The joints in the pose.
    pub skeleton: Skeleton,
    /// The landmarks on the posed skin.
    pub landmarks: Landmarks,
}

/// The rig of the mannequin with measurements `m`. Cached: made once in a process for each (the last four are kept).
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
    /// Computes the rig of a figure. None when the figure has no skin, lacks a joint, or does not fit in memory.
    pub fn new(figure: Arc<Mannequin>) -> Option<Self> {
        let surface = Arc::new(Surface::new(figure.mesh.clone())?);
        let rebuild = Rebuild::new(&figure.mesh)?;
        let shares = shares(&figure, &rebuild)?;
        let is_still = |v: &u32| shares.iter().all(|of| of[*v as usize] < 0.5);
        let still = (0..figure.mesh.positions.len() as u32).filter(is_still).collect();
        Some(Self { figure, surface, rebuild, shares, still })
    }

    /// The figure in the built pose.
    pub fn figure(&self) -> &Arc<Mannequin> {
        &self.figure
    }

    /// The figure in `pose`, standing on the floor. None when a rotation is not finite.
    pub fn posed(&self, pose: &Pose) -> Option<Posed> {
        let mut positions = self.positions(pose)?;
        self.put_down(&mut positions);
        let skeleton = self.skeleton(&positions, pose);
        let landmarks = self.figure.landmarks.clone().map(|p| self.carried(p, &positions));
        let surface = Arc::new(self.surface.reposed(positions)?);
        Some(Posed { surface, skeleton, landmarks })
    }

    /// The skin in `pose` with its pelvis at `place`, not put on a floor. None when a rotation or the place is not finite.
    pub fn placed(&self, pose: &Pose, place: &Placement) -> Option<Arc<Surface>> {
        let mut positions = self.positions(pose)?;
        let pelvis = self.figure.skeleton.position("pelvis")?;
        let aside = self.middle(&self.figure.mesh.positions) - self.middle(&positions);
        positions.iter_mut().for_each(|p| *p = place.turn * (*p + aside - pelvis) + pelvis + place.shift);
        self.surface.reposed(positions).map(Arc::new)
    }

    /// Positions of the vertices in `pose`, up to a translation.
    fn positions(&self, pose: &Pose) -> Option<Vec<DVec3>> {
        let turns: Vec<DVec3> =
            JOINTS.iter().map(|(name, _)| pose.turns.get(*name).copied().unwrap_or_default()).collect();
        let built = &self.figure.mesh.positions;
        self.rebuild.positions(&self.gradients(&turns), |v| built[v])
    }

    /// The rotation of each triangle, from the rotation vectors of `JOINTS`.
    fn gradients(&self, turns: &[DVec3]) -> Vec<DMat3> {
        let part = |j: usize| JOINTS[j].0.split('_').next();
        let turned: Vec<usize> = (0..turns.len()).filter(|&j| turns[j] != DVec3::ZERO).collect();
        let turned: Vec<&[usize]> = turned.chunk_by(|&i, &j| part(i) == part(j)).collect();
        let gradient = |corners: &[u32; 3]| {
            let mut whole = DQuat::IDENTITY;
            for joints in &turned {
                // Add the rotations of both sides: where both have a weight, neither comes first.
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

    /// Moves the body so that its pelvis is horizontally where it was built and its lowest point is on the floor.
    fn put_down(&self, positions: &mut [DVec3]) {
        let aside = self.middle(&self.figure.mesh.positions) - self.middle(positions);
        let lowest = positions.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
        let shift = DVec3::new(aside.x, -lowest, aside.z);
        positions.iter_mut().for_each(|p| *p += shift);
    }

    /// Mean position of the vertices of the pelvis.
    fn middle(&self, positions: &[DVec3]) -> DVec3 {
        self.still.iter().map(|&v| positions[v as usize]).sum::<DVec3>() / self.still.len().max(1) as f64
    }

    /// The posed skeleton: each joint follows the skin round it.
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

    /// The posed position of a point on the built skin.
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

/// The weight of each joint at each vertex: 0 or 1 by regions, then smoothed over the skin.
fn shares(figure: &Mannequin, rebuild: &Rebuild) -> Option<Vec<Vec<f64>>> {
    let regions = Regions::new(&figure.skeleton)?;
    let size = figure.measurements.height / Measurements::default().height;
    let base = JOINTS.iter().map(|(_, reach)| *reach).fold(f64::INFINITY, f64::min);
    let smoother = rebuild.smoother(base * size)?;
    let mut order: Vec<usize> = (0..JOINTS.len()).collect();
    order.sort_by(|&i, &j| JOINTS[j].1.total_cmp(&JOINTS[i].1).then(i.cmp(&j)));
    let mut shares = vec![Vec::new(); JOINTS.len()];
    // Three fields are smoothed at a time; those that take a similar number of rounds go together.
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
