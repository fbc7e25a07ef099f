//! Bones: segments inside a body that no cloth edge may cross, however hard it is pulled (paper A).

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Surface;
use crate::cloth::{Counters, Garment, Skip, Skips};
use crate::contact::Tracker;
use crate::geometry::parallel::LEAST_SHARE;

/// A bone as a segment between two ends, metres.
pub type Bone = [DVec3; 2];

/// The bones of a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bones {
    bones: Vec<Bone>,
    /// Lower bound of the distance from any point of the bones to the skin, metres.
    depth: f64,
}

impl Bones {
    /// Prepares the bones of a body. Without bones nothing is tested.
    pub fn new(bones: &[Bone], surface: &Surface) -> Self {
        let depth = bones
            .iter()
            .map(|[a, b]| {
                // Between two points the bone is at most half their distance nearer to the skin: a bound for any number of them.
                let count = 32;
                let apart = a.distance(*b) / f64::from(count);
                let at = |k| surface.nearest(a.lerp(*b, f64::from(k) / f64::from(count))).distance;
                -(0..=count).map(at).fold(f64::NEG_INFINITY, f64::max) - apart / 2.0
            })
            .fold(f64::INFINITY, f64::min);
        Self { bones: bones.to_vec(), depth }
    }

    /// Whether there are no bones.
    pub fn is_empty(&self) -> bool {
        self.bones.is_empty()
    }

    /// Stops edges of cloth that moved from `before` to `after` from crossing bones. The ends of a crossing edge lose their
    /// motion across edge and bone; if edges still cross in the next round, all their motion. Afterwards none has crossed.
    pub fn hold_back(
        &self,
        garment: &Garment,
        mapped: &[bool],
        tracker: Option<(&Tracker, Skips)>,
        before: &[DVec3],
        after: &mut [DVec3],
        counters: &mut Counters,
    ) {
        if self.bones.is_empty() {
            return;
        }
        let edges = &garment.adjacency.edges;
        for round in 0.. {
            let at = |e: &[u32; 2]| [e.map(|v| before[v as usize]), e.map(|v| after[v as usize])];
            let tests: Vec<(u32, DVec3)> = (0..edges.len() as u32)
                .into_par_iter()
                .with_min_len(LEAST_SHARE)
                .filter(|&e| edges[e as usize].iter().all(|&v| mapped[v as usize]))
                .filter(|&e| self.may_cross(edges[e as usize], at(&edges[e as usize]), tracker))
                .map(|e| (e, self.crossed(at(&edges[e as usize]))))
                .collect();
            counters.bone_tests += tests.len() as u64;
            let crossing: Vec<(u32, DVec3)> = tests.into_iter().filter(|(_, n)| *n != DVec3::ZERO).collect();
            if crossing.is_empty() {
                return;
            }
            counters.bone_stops += crossing.len() as u64;
            for (e, across) in crossing {
                for v in edges[e as usize].map(|v| v as usize) {
                    // A vertex that does not move cannot cross: this ends.
                    let along = |d: DVec3| if round == 0 { d - across * d.dot(across) } else { DVec3::ZERO };
                    after[v] = before[v] + along(after[v] - before[v]);
                }
            }
        }
    }

    /// Whether an edge moves at all, and may be as deep as the bones: the signed distance is 1-Lipschitz.
    fn may_cross(
        &self,
        vertices: [u32; 2],
        [before, after]: [[DVec3; 2]; 2],
        tracker: Option<(&Tracker, Skips)>,
    ) -> bool {
        if before == after {
            return false;
        }
        let Some((tracker, skips)) = tracker else { return true };
        if !skips.allow(Skip::Bones) {
            return true;
        }
        let low = |k: usize| tracker.at_least(vertices[k] as usize, before[k]) - before[k].distance(after[k]);
        let half = before[0].distance(before[1]).max(after[0].distance(after[1])) / 2.0;
        low(0).min(low(1)) - half < -self.depth
    }

    /// The unit direction across edge and bone where the edge crosses a bone; zero where it crosses none.
    fn crossed(&self, motion: [[DVec3; 2]; 2]) -> DVec3 {
        self.bones.iter().find_map(|&bone| crossing(motion, bone)).unwrap_or_default()
    }
}

/// The unit direction across edge and bone at the moment when an edge in linear motion crosses a bone: the signed
/// volume of the two changes sign while their nearest points are within both segments. None where it does not cross.
fn crossing([before, after]: [[DVec3; 2]; 2], bone: Bone) -> Option<DVec3> {
    let edge = |t: f64| [before[0].lerp(after[0], t), before[1].lerp(after[1], t)];
    let volume = |t: f64| {
        let [a, b] = edge(t);
        (b - a).cross(bone[1] - bone[0]).dot(bone[0] - a)
    };
    // The volume is cubic in time, so that it changes its sign at most three times; in each part of a step it is taken to do so once.
    let parts = 4;
    (0..parts).find_map(|k| {
        let [mut early, mut late] = [k, k + 1].map(|k| f64::from(k) / f64::from(parts));
        // A volume of zero counts as negative: a step that ends just on the bone is seen in this interval or in the next.
        let first = volume(early) > 0.0;
        if first == (volume(late) > 0.0) {
            return None;
        }
        // To a billionth of the interval.
        for _ in 0..30 {
            let middle = (early + late) / 2.0;
            if (volume(middle) > 0.0) == first { early = middle } else { late = middle }
        }
        let [a, b] = edge(late);
        meet([a, b], bone).then(|| (b - a).cross(bone[1] - bone[0]).try_normalize()).flatten()
    })
}

/// Whether the nearest points of two coplanar lines are within both segments.
fn meet([a, b]: [DVec3; 2], [c, d]: Bone) -> bool {
    let (u, v, w) = (b - a, d - c, c - a);
    let n = u.cross(v);
    let size = n.length_squared();
    if size <= 1e-24 * u.length_squared() * v.length_squared() {
        return false;
    }
    let (s, t) = (w.cross(v).dot(n) / size, w.cross(u).dot(n) / size);
    (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(from: f64, to: f64, y: f64) -> [[DVec3; 2]; 2] {
        [from, to].map(|z| [DVec3::new(-0.2, y, z), DVec3::new(0.3, y + 0.1, z)])
    }

    #[test]
    fn an_edge_that_passes_a_bone_is_seen() {
        let bone = [DVec3::NEG_Y, DVec3::Y];
        assert!(crossing(moved(0.1, -0.1, 0.0), bone).is_some_and(|n| (n.z.abs() - 1.0).abs() < 0.05));
        assert!(crossing(moved(0.1, 0.01, 0.0), bone).is_none(), "not there yet");
        assert!(crossing(moved(0.1, -0.1, 1.2), bone).is_none(), "beyond its end");
        let beside = moved(0.1, -0.1, 0.0).map(|e| e.map(|p| p + DVec3::X));
        assert!(crossing(beside, bone).is_none(), "beside it");
        let parallel = [0.1, -0.1].map(|z| [DVec3::new(0.0, -0.1, z), DVec3::new(0.0, 0.1, z)]);
        assert!(crossing(parallel, bone).is_none(), "along it: its neighbours are seen");
    }
}
