//! Thickness of cloth: pairs of features nearer than it are pushed apart, with friction.

use glam::DVec3;

use crate::contact::separation::features::{self, Seen};
use crate::contact::separation::{Found, Separation};
use crate::geometry::adjacency::Lists;

/// Thickness of features joined by an edge, as a fraction of that edge's rest length. A triangle with an angle of 30°
/// has half of a side as its height, and half of that avoids that the triangulation itself holds features apart.
const BESIDE: f64 = 0.25;

/// Two features of the cloth that may come nearer than their thickness.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// A vertex and the corners of a triangle, or the ends of two edges.
    vertices: [u32; 4],
    is_edges: bool,
    /// Distance of the two features at the detection, metres.
    gap: f64,
    /// Distance that the two features keep, metres.
    thickness: f64,
}

impl Pair {
    /// The vertices of the first and of the second feature.
    fn features(&self) -> [&[u32]; 2] {
        let (first, second) = self.vertices.split_at(if self.is_edges { 2 } else { 1 });
        [first, second]
    }
}

/// Parameters of contact within a substep.
#[derive(Clone, Copy, Debug)]
pub struct Touch<'a> {
    /// Inverse mass of each vertex, 1/kg; zero where it is held.
    pub inverse_mass: &'a [f64],
    /// Coefficient of Coulomb friction of each vertex; empty for none.
    pub friction: &'a [f64],
    /// Largest distance, metres, by which penetration older than this step is reduced in a step, without momentum.
    pub ease: f64,
}

/// Rest lengths of the edges between sewn vertices, found by their ends.
#[derive(Clone, Debug, Default)]
pub(super) struct RestLengths {
    /// For each name the larger names that edges lead to from it.
    larger: Lists,
    /// The lengths of these edges in the order of the items, metres; of several between the same names the shortest counts.
    lengths: Vec<f64>,
}

impl RestLengths {
    /// The lengths `rest` (m) of `edges`. `names` gives for each vertex the one it is sewn to (None: itself).
    pub fn new(edges: &[[u32; 2]], rest: &[f64], names: Option<&[u32]>) -> Self {
        let name = |v: u32| names.map_or(v, |names| names[v as usize]);
        let named = |[a, b]: [u32; 2]| [name(a).min(name(b)), name(a).max(name(b))];
        let mut all: Vec<([u32; 2], f64)> = edges.iter().zip(rest).map(|(e, l)| (named(*e), *l)).collect();
        all.sort_by(|(a, l), (b, k)| a.cmp(b).then(l.total_cmp(k)));
        all.dedup_by_key(|(edge, _)| *edge);
        let count = all.iter().map(|([_, larger], _)| *larger as usize + 1).max().unwrap_or(0);
        let larger = Lists::grouped(count, all.iter().map(|([smaller, larger], _)| (*smaller, *larger)));
        Self { larger, lengths: all.into_iter().map(|(_, length)| length).collect() }
    }

    /// Rest length of the edge between two names, metres; infinite where there is none.
    fn between(&self, a: u32, b: u32) -> f64 {
        let (smaller, larger) = (a.min(b), a.max(b));
        if smaller as usize >= self.larger.len() {
            return f64::INFINITY;
        }
        let at = self.larger.of(smaller).iter().position(|&end| end == larger);
        at.map_or(f64::INFINITY, |at| self.lengths[self.larger.places(smaller).start + at])
    }
}

impl Separation {
    /// Stores two features that may come nearer than the thickness while their vertices move up to `whole` metres together.
    pub(super) fn remember(&self, seen: &Seen, features: [&[u32]; 2], whole: f64, found: &mut Found) {
        let [one, other] = features;
        if seen.gap >= self.thickness + whole {
            return;
        }
        let thickness = self.kept(one, other);
        if seen.gap < thickness + whole {
            let mut vertices = [0; 4];
            one.iter().chain(other).zip(&mut vertices).for_each(|(v, place)| *place = *v);
            found.pairs.push(Pair { vertices, is_edges: one.len() == 2, gap: seen.gap, thickness });
        }
    }

    /// The distance that two features keep, metres.
    fn kept(&self, one: &[u32], other: &[u32]) -> f64 {
        let name = |v: u32| self.names.as_ref().map_or(v, |names| names[v as usize]);
        let length = |a: u32, b: u32| self.rest.between(name(a), name(b));
        let between = one.iter().flat_map(|&a| other.iter().map(move |&b| length(a, b)));
        self.thickness.min(BESIDE * between.fold(f64::INFINITY, f64::min))
    }

    /// Pushes features at `x` apart that are nearer than their thickness, with friction against their motion from
    /// `before`. To be called after a detection and before [`truncate`](Self::truncate).
    pub fn push_apart(&mut self, x: &mut [DVec3], before: &mut [DVec3], touch: Touch<'_>) {
        if self.anchors.len() != x.len() || self.pairs.is_empty() {
            return;
        }
        self.come.clear();
        self.come.extend(x.iter().zip(&self.anchors).map(|(x, anchor)| x.distance(*anchor)));
        for pair in &self.pairs {
            let come =
                pair.features().map(|vs| vs.iter().map(|&v| self.come[v as usize]).fold(0.0, f64::max));
            if pair.gap - come[0] - come[1] < pair.thickness {
                push(pair, x, before, touch);
            }
        }
    }
}

fn push(pair: &Pair, x: &mut [DVec3], before: &mut [DVec3], touch: Touch<'_>) {
    let at = pair.vertices.map(|v| v as usize);
    let (weights, way) = features::contact(pair.is_edges, at.map(|v| x[v]));
    let distance = way.length();
    let depth = pair.thickness - distance;
    if depth <= 0.0 || distance == 0.0 {
        return;
    }
    let inverse = at.map(|v| touch.inverse_mass[v]);
    let whole: f64 = weights.iter().zip(&inverse).map(|(w, inverse)| w * w * inverse).sum();
    if whole == 0.0 {
        return;
    }
    let normal = way / distance;
    let come: DVec3 = at.iter().zip(weights).map(|(&v, w)| (x[v] - before[v]) * w).sum();
    let approach = -normal.dot(come);
    let now = approach.clamp(0.0, depth);
    let eased = (depth - now).min(touch.ease);
    let slip = come + normal * approach;
    let rubs = |v: usize| touch.friction.get(v).copied().unwrap_or(0.0);
    let (length, friction) = (slip.length(), at.map(rubs).iter().sum::<f64>() / 4.0);
    let hold = if length > 0.0 { (friction * now / length).min(1.0) } else { 0.0 };
    for ((v, w), inverse) in at.into_iter().zip(weights).zip(inverse) {
        let share = w * inverse / whole;
        let out = normal * (share * eased);
        x[v] += normal * (share * now) + out - slip * (share * hold);
        before[v] += out;
    }
}
