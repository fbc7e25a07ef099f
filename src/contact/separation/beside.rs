//! Features of neighbouring triangles, found once: their boxes always meet, so that a tree would find them in every
//! detection, and in flat cloth nearly all of them are too far apart to matter.

use glam::DVec3;
use rayon::prelude::*;

use crate::contact::separation::features;
use crate::contact::separation::topology::{PlacedTriangle, Topology, surely};
use crate::geometry::parallel::LEAST_SUMS;

/// Pairs of features of two neighbouring triangles: corners of the first against the second, or sides of both.
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub triangles: [u32; 2],
    /// Which pairs: for corners bit k for corner k, for sides bit 3 k + m for side k of the first and side m of the second.
    features: u16,
    /// The smallest distance of its features when it was measured, metres; negative where that is not known.
    gap: f32,
}

impl Group {
    /// The corners of the first triangle in a group of corners.
    pub fn corners(&self) -> impl Iterator<Item = usize> {
        let features = self.features;
        (0..3).filter(move |k| features & (1 << k) != 0)
    }

    /// The sides of both triangles in a group of sides.
    pub fn sides(&self) -> impl Iterator<Item = [usize; 2]> {
        let features = self.features;
        (0..9).filter(move |bit| features & (1 << bit) != 0).map(|bit| [bit / 3, bit % 3])
    }
}

/// Pairs of features that share no vertex, but whose owning triangles do.
///
/// The distance of two features changes by no more than their vertices move relative to each other. Where two triangles share a
/// vertex, that is at most how far the corners of the one have moved relative to each other, plus the same of the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Beside {
    /// Neighbouring triangles, the smaller number first.
    pub triangles: Vec<[u32; 2]>,
    /// A corner of the first triangle against the second.
    pub corners: Vec<Group>,
    /// A side of each.
    pub sides: Vec<Group>,
    /// The names of the corners of each triangle.
    names: Vec<[u32; 3]>,
    /// Positions of the vertices when the groups were measured, metres; empty before.
    measured_at: Vec<DVec3>,
    /// For each triangle how far its corners have moved relative to each other since then, plus its reach, metres.
    near: Vec<f64>,
    /// Number of groups looked at since then, besides those of the first look.
    in_vain: u64,
    /// Number of groups looked at first after they were measured; None: not yet.
    first: Option<u64>,
    /// Factor on how much is spent before the groups are measured anew, 1..=64; 0 before they are first measured.
    patience: u64,
}

impl Beside {
    /// The pairs in a mesh whose vertices are, or will be, sewn to those that `names` tells; None: each to itself.
    pub fn new(cloth: &Topology, names: Option<&[u32]>) -> Self {
        let name = |v: u32| names.map_or(v, |names| names[v as usize]);
        let named: Vec<[u32; 3]> = cloth.triangles.iter().map(|vs| vs.map(name)).collect();
        let most = named.iter().flatten().max().map_or(0, |most| *most as usize + 1);
        let mut round: Vec<Vec<u32>> = vec![Vec::new(); most];
        for (t, vs) in named.iter().enumerate() {
            vs.iter().for_each(|&v| round[v as usize].push(t as u32));
        }
        let (mut triangles, mut corners, mut sides) = (Vec::new(), Vec::new(), Vec::new());
        let mut near: Vec<u32> = Vec::new();
        for (s, vs) in named.iter().enumerate() {
            near.clear();
            near.extend(vs.iter().flat_map(|&v| &round[v as usize]));
            near.sort_unstable();
            near.dedup();
            let s = s as u32;
            for &t in near.iter().filter(|&&t| t != s) {
                let others = named[t as usize];
                let group = |features: u16| Group { triangles: [s, t], features, gap: -1.0 };
                let apart = cloth.corners_of(s).filter(|&k| !others.contains(&vs[k]));
                corners.extend(Some(apart.fold(0, |all, k| all | 1 << k)).filter(|all| *all != 0).map(group));
                if t < s {
                    continue;
                }
                triangles.push([s, t]);
                let pairs = cloth.sides_of(s).flat_map(|k| cloth.sides_of(t).map(move |m| [k, m]));
                let is_apart = |[k, m]: &[usize; 2]| {
                    let ends = [vs[*k], vs[(k + 1) % 3]];
                    !ends.contains(&others[*m]) && !ends.contains(&others[(m + 1) % 3])
                };
                let apart = pairs.filter(is_apart).fold(0, |all, [k, m]| all | 1 << (3 * k + m));
                sides.extend(Some(apart).filter(|all| *all != 0).map(group));
            }
        }
        Self { triangles, corners, sides, names: named, ..Self::default() }
    }

    /// Whether two triangles share a vertex, or will when they are sewn.
    pub fn are(&self, s: u32, t: u32) -> bool {
        let [a, b, c] = self.names[s as usize];
        self.names[t as usize].iter().fold(false, |are, v| are | (*v == a) | (*v == b) | (*v == c))
    }

    /// Takes in where the triangles are.
    pub fn see(&mut self, placed: &[PlacedTriangle]) {
        let from = &self.measured_at;
        if from.is_empty() {
            return;
        }
        let near = |triangle: &PlacedTriangle| {
            let [a, b, c] = [0, 1, 2].map(|k| triangle.corners[k] - from[triangle.vertices[k] as usize]);
            let moved = (a - b).length_squared().max((b - c).length_squared()).max((c - a).length_squared());
            moved.sqrt() + triangle.farthest
        };
        placed.par_iter().with_min_len(LEAST_SUMS).map(near).collect_into_vec(&mut self.near);
    }

    /// Whether the features of a group are known to be farther apart than their reach and `thickness`, metres.
    pub fn are_off(&self, group: &Group, thickness: f64) -> bool {
        if group.gap <= 0.0 {
            return false;
        }
        let [s, t] = group.triangles.map(|t| self.near[t as usize]);
        f64::from(group.gap) > surely(s + t + thickness)
    }

    /// Counts the groups that a detection `looked` at; measures them anew where that is likely to save work.
    pub fn learn(&mut self, looked: u64, placed: &[PlacedTriangle], x: &[DVec3]) {
        let all = (self.corners.len() + self.sides.len()) as u64;
        let first = *self.first.get_or_insert(if self.patience == 0 { 0 } else { looked });
        self.in_vain += looked.saturating_sub(first);
        // To measure a group anew costs four looks at it: groups are measured when as much was spent on looks in vain.
        if self.in_vain < 4 * self.patience.max(1) * all || all == 0 {
            return;
        }
        // Measuring helps where more than half of the groups are passed over after it.
        let has_helped = self.patience == 0 || 2 * first < all;
        self.patience = if has_helped { 1 } else { (2 * self.patience).min(64) };
        (self.first, self.in_vain) = (None, 0);
        self.measured_at.clear();
        self.measured_at.extend_from_slice(x);
        let of = |t: u32| &placed[t as usize];
        let share = |group: &Group| {
            let [one, two] = group.triangles.map(of);
            one.vertices.iter().any(|v| two.vertices.contains(v))
        };
        let gap = |seen: Option<features::Seen>| seen.map_or(0.0, |seen| seen.gap);
        // Features of triangles that will be sewn but are not yet move independently.
        let measure = |group: &mut Group, smallest: f64| {
            group.gap = if share(group) { (smallest as f32).next_down() } else { -1.0 };
        };
        self.corners.par_iter_mut().with_min_len(LEAST_SUMS).for_each(|group| {
            let [one, two] = group.triangles.map(of);
            let gaps =
                group.corners().map(|k| gap(features::vertex_and_triangle(one.corners[k], two.corners)));
            measure(group, gaps.fold(f64::INFINITY, f64::min));
        });
        self.sides.par_iter_mut().with_min_len(LEAST_SUMS).for_each(|group| {
            let [one, two] = group.triangles.map(of);
            let gaps = group.sides().map(|[k, m]| gap(features::edges(one.side(k), two.side(m))));
            measure(group, gaps.fold(f64::INFINITY, f64::min));
        });
    }
}
