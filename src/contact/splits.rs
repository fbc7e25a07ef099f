//! Adaptive splitting of edges that would cut the body, and positions of the inserted vertices (paper A, adaptive √3).
//!
//! A split edge passes over the body in three or four parts, each with its own height; the plain edge would have to
//! be lifted off by the height of its chord. The inserted vertices depend on the plain ones: they are in no matrix,
//! and nothing pulls at them. (Passing the forces of the small triangles on to the plain vertices was tried: with
//! their height given by the body the steps did not come to rest.)

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Surface;
use crate::cloth::refine::{DependentVertex, Refined, refine};
use crate::cloth::{ClothState, Counters, Garment, Skip, Skips};
use crate::contact::Tracker;
use crate::contact::faces::FACE_CLEARANCE;
use crate::contact::tracker::Lengths;
use crate::geometry::parallel::LEAST_SHARE;

/// A body that cloth may cut, and the offset of the cloth.
#[derive(Clone, Copy, Debug)]
pub struct Ground<'a> {
    /// The body.
    pub surface: &'a Surface,
    /// Distance that cloth keeps from the skin, metres.
    pub offset: f64,
    /// Allowed shortcuts.
    pub skips: Skips,
}

/// Edges that may have to be split.
#[derive(Clone, Copy, Debug)]
pub struct Suspects<'a> {
    /// Edges of the garment, by number.
    pub edges: &'a [u32],
    /// Whether to split also edges that only come nearer to the body than cloth may.
    pub near: bool,
}

/// The split edges of a garment.
#[derive(Clone, Debug, Default)]
pub struct Splits {
    /// Each split edge, and the number of consecutive checks in which it was clear.
    edges: BTreeMap<u32, u8>,
    refined: Option<Arc<Refined>>,
    /// For each inserted vertex its displacement from the mean of its masters, metres.
    beside: Vec<DVec3>,
}

impl Splits {
    /// Splits the edges of resting cloth that cut the body, without anything known of it before. None when no edge is
    /// split. `offset` is in metres on a body 1.5 m large.
    pub fn of_lying(garment: &Garment, state: &ClothState, surface: &Surface, offset: f64) -> Option<Self> {
        let mut splits = Self::default();
        let mut counters = Counters::default();
        let mut tracker = Tracker::new(garment.vertex_count);
        let ground = Ground { surface, offset: offset * surface.scale(), skips: Skips::default() };
        let reach = Lengths::on(surface).sight.max(garment.mean_edge());
        tracker.update(surface, state, reach, ground.skips, &mut counters);
        let all: Vec<u32> = (0..garment.adjacency.edges.len() as u32).collect();
        let found = splits.split(
            garment,
            state,
            &tracker,
            ground,
            Some(Suspects { edges: &all, near: false }),
            &mut counters,
        );
        splits.place(state, &tracker, ground);
        (found > 0).then_some(splits)
    }

    /// The garment with split edges; None when none is split.
    pub fn refined(&self) -> Option<&Arc<Refined>> {
        self.refined.as_ref()
    }

    /// The garment with split edges and its state, for drawing and measuring; None when no edge is split.
    pub fn drawn(&self, state: &ClothState) -> Option<(Arc<Garment>, ClothState)> {
        let refined = self.refined.as_ref()?;
        Some((Arc::clone(&refined.garment), self.state(refined, state)))
    }

    /// `state` with the inserted vertices added.
    pub fn state(&self, refined: &Refined, state: &ClothState) -> ClothState {
        refined.state(state, |dependent| self.beside.get(dependent).copied().unwrap_or_default())
    }

    /// Splits edges that cut the body: of `suspects`, or of all edges those that pass the paper's test. Returns the
    /// number of new splits.
    pub fn split(
        &mut self,
        garment: &Garment,
        state: &ClothState,
        tracker: &Tracker,
        ground: Ground<'_>,
        suspects: Option<Suspects<'_>>,
        counters: &mut Counters,
    ) -> usize {
        let edges = &garment.adjacency.edges;
        let all = suspects.is_some() || !ground.skips.allow(Skip::Edges);
        let test = |e: u32| {
            let edge = Edge::new(edges[e as usize], state, tracker)?;
            let tested = !self.edges.contains_key(&e) && edge.may_cut(all);
            let cuts = |edge: &Edge| match suspects {
                Some(Suspects { near: true, .. }) => edge.is_near(ground, 1.0),
                _ => ground.surface.meets_segment(edge.ends),
            };
            tested.then(|| (e, cuts(&edge)))
        };
        let tests: Vec<(u32, bool)> = match suspects {
            Some(suspects) => suspects.edges.par_iter().filter_map(|&e| test(e)).collect(),
            None => {
                (0..edges.len() as u32).into_par_iter().with_min_len(LEAST_SHARE).filter_map(test).collect()
            }
        };
        counters.edge_checks += suspects.map_or(edges.len(), |s| s.edges.len()) as u64;
        counters.edge_tests += tests.len() as u64;
        let before = self.edges.len();
        self.edges.extend(tests.iter().filter(|(_, cut)| *cut).map(|&(e, _)| (e, 0)));
        let found = self.edges.len() - before;
        counters.split_edges += found as u64;
        if found > 0 {
            self.refine(garment);
        }
        found
    }

    /// Joins edges that have been clear of the body for ten checks in a row, even if they were a fifth longer: so that they are not split
    /// again at once.
    pub fn join(
        &mut self,
        garment: &Garment,
        state: &ClothState,
        tracker: &Tracker,
        ground: Ground<'_>,
        counters: &mut Counters,
    ) {
        if self.edges.is_empty() {
            return;
        }
        let before = self.edges.len();
        self.edges.retain(|&e, clear| {
            let edge = Edge::new(garment.adjacency.edges[e as usize], state, tracker);
            let near = edge.is_some_and(|edge| edge.is_near(ground, 1.2));
            *clear = if near { 0 } else { *clear + 1 };
            *clear < 10
        });
        let joined = before - self.edges.len();
        counters.joined_edges += joined as u64;
        if joined > 0 {
            self.refine(garment);
        }
    }

    fn refine(&mut self, garment: &Garment) {
        let split: Vec<u32> = self.edges.keys().copied().collect();
        self.refined = (!split.is_empty()).then(|| Arc::new(refine(garment, &split)));
        self.beside.clear();
    }

    /// Updates the inserted vertices: at the mean of their masters, and raised to the offset above the body.
    pub fn place(&mut self, state: &ClothState, tracker: &Tracker, ground: Ground<'_>) {
        self.beside.clear();
        if let Some(refined) = &self.refined {
            let beside =
                refined.dependents.par_iter().map(|dependent| out(dependent, state, tracker, ground));
            beside.collect_into_vec(&mut self.beside);
        }
    }

    /// Memory used, bytes.
    pub fn bytes(&self) -> usize {
        let refined = self.refined.as_ref().map_or(0, |r| r.bytes());
        self.edges.len() * 16 + self.beside.capacity() * size_of::<DVec3>() + refined
    }
}

/// An edge with both ends outside of the body and near it.
struct Edge {
    ends: [DVec3; 2],
    /// For each end the nearest point of the skin.
    skin: [DVec3; 2],
}

impl Edge {
    fn new(vertices: [u32; 2], state: &ClothState, tracker: &Tracker) -> Option<Self> {
        let end = |v: u32| {
            let p = state.positions[v as usize];
            let plane = tracker.plane(v as usize).filter(|plane| plane.height(p) > 0.0)?;
            // For a vertex that moved since its plane was found, the nearest point is taken in that plane.
            state.mapped[v as usize].then(|| (p, p - plane.normal * plane.height(p)))
        };
        let ([a, p], [b, q]) =
            (end(vertices[0]).map(<[DVec3; 2]>::from)?, end(vertices[1]).map(<[DVec3; 2]>::from)?);
        Some(Self { ends: [a, b], skin: [p, q] })
    }

    /// Whether the body may be in the way of the edge: the sum of its ends' heights is at most its length, as the
    /// signed distance is 1-Lipschitz. Unless `all`, the paper's ball test must hold as well (paper A).
    fn may_cut(&self, all: bool) -> bool {
        let [a, b] = self.ends;
        let length = a.distance(b);
        let heights = a.distance(self.skin[0]) + b.distance(self.skin[1]);
        heights <= length && (all || self.meets_ball(length))
    }

    /// The paper's ball test for an edge of this length: a ball as large as the edge is long, under one of its ends,
    /// must reach it between its ends.
    fn meets_ball(&self, length: f64) -> bool {
        let [a, b] = self.ends;
        let along = (b - a).normalize_or_zero();
        [(a, self.skin[0], along), (b, self.skin[1], -along)].iter().any(|&(from, skin, along)| {
            let down = skin - from;
            let d = down.length();
            let cos = along.dot(down) / d;
            let sin = (1.0 - cos * cos).max(0.0).sqrt();
            cos > 0.0 && (d + length) * sin < length && (d + length) * cos < length
        })
    }

    /// Whether the edge comes nearer to the body than cloth may; it counts as `longer` times as long.
    fn is_near(&self, ground: Ground<'_>, longer: f64) -> bool {
        let [a, b] = self.ends;
        let heights = a.distance(self.skin[0]) + b.distance(self.skin[1]);
        let length = a.distance(b) * longer;
        heights <= length
            && (1..8).any(|eighths| {
                let p = a.lerp(b, f64::from(eighths) / 8.0);
                let low = FACE_CLEARANCE * ground.offset;
                let near = ground.surface.nearest_within(p, length);
                near.is_some_and(|n| n.distance < low)
            })
    }
}

/// Displacement of a dependent vertex from the mean of its masters: along their mean normal until it is at the offset, metres.
fn out(dependent: &DependentVertex, state: &ClothState, tracker: &Tracker, ground: Ground<'_>) -> DVec3 {
    let between = dependent.between(state);
    let sum: DVec3 = dependent
        .shares
        .iter()
        .filter_map(|&(v, share)| tracker.plane(v as usize).map(|plane| plane.normal * share))
        .sum();
    let Some(up) = sum.try_normalize() else { return DVec3::ZERO };
    let mut p = between;
    // Over flat skin one step arrives. Where sixteen do not, the vertex goes to the nearest skin.
    for _ in 0..16 {
        let lacking = ground.offset - ground.surface.nearest(p).distance;
        if lacking <= 1e-3 * ground.offset {
            return p - between;
        }
        // The signed distance grows by at most the length of the step: this does not overshoot.
        p += up * lacking;
    }
    let n = ground.surface.nearest(between);
    n.point + n.normal * ground.offset - between
}
