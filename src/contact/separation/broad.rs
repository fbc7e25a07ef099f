//! Broad phase: a bounding volume hierarchy over triangles whose boxes are kept in single precision, rounded outwards.

use std::ops::Range;

use glam::Vec3A;
use rayon::prelude::*;

use crate::geometry::bvh::{Aabb, Bvh};
use crate::geometry::parallel::LEAST_SEARCHES;

/// A box in single precision, which contains the box in double precision that it was made from.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Around {
    lower: Vec3A,
    upper: Vec3A,
}

impl Around {
    pub fn of(exact: &Aabb) -> Self {
        let [lower, upper] = [exact.lower.as_vec3a(), exact.upper.as_vec3a()];
        Self {
            lower: Vec3A::from_array(lower.to_array().map(f32::next_down)),
            upper: Vec3A::from_array(upper.to_array().map(f32::next_up)),
        }
    }

    fn joined(&self, other: &Self) -> Self {
        Self { lower: self.lower.min(other.lower), upper: self.upper.max(other.upper) }
    }

    /// This box grown on all sides by `margin`, metres.
    pub fn grown(&self, margin: f32) -> Self {
        Self { lower: self.lower - margin, upper: self.upper + margin }
    }

    /// How far `inner`, which is in this box, is from its border at least, metres.
    pub fn room_round(&self, inner: &Self) -> f64 {
        let room = (inner.lower - self.lower).min(self.upper - inner.upper);
        f64::from(room.min_element().next_down())
    }

    /// The largest gap along an axis between this box and `other`, metres: what is in them is at least so far apart. At most 0 where
    /// they meet.
    pub fn gap(&self, other: &Self) -> f64 {
        let gap = (self.lower - other.upper).max(other.lower - self.upper);
        f64::from(gap.max_element().next_down())
    }

    pub fn contains(&self, other: &Self) -> bool {
        (self.lower.cmple(other.lower) & self.upper.cmpge(other.upper)).all()
    }

    pub fn meets(&self, other: &Self) -> bool {
        (self.lower.cmple(other.upper) & self.upper.cmpge(other.lower)).all()
    }
}

/// A hierarchy over boxes, which can move.
#[derive(Clone, Debug, Default)]
pub(super) struct Broad {
    tree: Bvh,
    /// Box of each node.
    nodes: Vec<Around>,
    /// Box of each item, in the order of the leaves.
    items: Vec<Around>,
}

/// Pairs for a parallel task, and the leaves among them.
#[derive(Clone, Debug, Default)]
pub(super) struct Pairs {
    /// Two items each, as indices in the order of the leaves.
    pub met: Vec<[u32; 2]>,
    /// The items of each leaf, one after the other, and how many of the pairs come before the leaf.
    pub leaves: Vec<(Range<usize>, usize)>,
}

impl Broad {
    /// A hierarchy over boxes that stay.
    pub fn over(boxes: &[Aabb]) -> Self {
        let mut broad = Self::default();
        broad.plant(boxes);
        broad.fit(broad.order().iter().map(|&i| Around::of(&boxes[i as usize])).collect());
        broad
    }

    /// Builds the tree over `boxes`, unless it has as many.
    pub fn plant(&mut self, boxes: &[Aabb]) {
        if self.tree.items.len() != boxes.len() {
            self.tree = Bvh::new(boxes);
        }
    }

    /// The items in the order of the leaves.
    pub fn order(&self) -> &[u32] {
        &self.tree.items
    }

    /// The box of each item, in the order of the leaves.
    pub fn items(&self) -> &[Around] {
        &self.items
    }

    /// Moves the boxes, which come in the order of the leaves.
    pub fn fit(&mut self, items: Vec<Around>) {
        self.items = items;
        self.nodes.resize(self.tree.nodes.len(), Around::default());
        // Children come after their parents.
        for (at, node) in self.tree.nodes.iter().enumerate().rev() {
            self.nodes[at] = if node.is_leaf() {
                let first = node.first as usize;
                let items = &self.items[first..first + node.count as usize];
                items.iter().skip(1).fold(items[0], |all, one| all.joined(one))
            } else {
                self.nodes[at + 1].joined(&self.nodes[node.right as usize])
            };
        }
    }

    /// Every two items whose boxes meet, but those of which `passes_over` is true, and every leaf, in an order that depends only on
    /// the shape of the tree.
    pub fn pairs(&self, passes_over: impl Fn(u32, u32) -> bool + Sync) -> Vec<Pairs> {
        let count = self.nodes.len();
        let share = |share: usize| {
            let (mut found, mut open) = (Pairs::default(), Vec::new());
            for node in share * LEAST_SEARCHES..count.min((share + 1) * LEAST_SEARCHES) {
                self.pairs_below(node as u32, &mut open, |one, two| {
                    let items = [one, two].map(|at| self.tree.items[at as usize]);
                    if !passes_over(items[0], items[1]) {
                        found.met.push([one, two]);
                    }
                });
                if self.tree.nodes[node].is_leaf() {
                    found.leaves.push((self.range(node as u32), found.met.len()));
                }
            }
            found
        };
        (0..count.div_ceil(LEAST_SEARCHES)).into_par_iter().map(share).collect()
    }

    /// Calls `found` for every two items whose boxes meet, one below each child of `node`; for a leaf for every two of it.
    fn pairs_below(&self, node: u32, open: &mut Vec<[u32; 2]>, mut found: impl FnMut(u32, u32)) {
        let tree = &self.tree;
        if tree.nodes[node as usize].is_leaf() {
            let range = self.range(node);
            for k in range.clone() {
                let others = (k + 1..range.end).filter(|&m| self.items[k].meets(&self.items[m]));
                others.for_each(|m| found(k as u32, m as u32));
            }
            return;
        }
        open.push([node + 1, tree.nodes[node as usize].right]);
        while let Some([a, b]) = open.pop() {
            if !self.nodes[a as usize].meets(&self.nodes[b as usize]) {
                continue;
            }
            let [one, two] = [a, b].map(|at| &tree.nodes[at as usize]);
            if one.is_leaf() && two.is_leaf() {
                for k in self.range(a) {
                    let others = self.range(b).filter(|&m| self.items[k].meets(&self.items[m]));
                    others.for_each(|m| found(k as u32, m as u32));
                }
            } else if two.is_leaf() || (!one.is_leaf() && one.count >= two.count) {
                open.extend([[a + 1, b], [one.right, b]]);
            } else {
                open.extend([[a, b + 1], [a, two.right]]);
            }
        }
    }

    /// Calls `found` for every item whose box meets `around`, as an index in the order of the leaves, which rises.
    pub fn meeting(&self, around: &Around, mut found: impl FnMut(u32)) {
        if self.nodes.is_empty() {
            return;
        }
        // The tree is halved at every level, so that no tree of 2³² items is deeper than this.
        let mut open = [0u32; 40];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let at = open[count];
            if !self.nodes[at as usize].meets(around) {
                continue;
            }
            let node = &self.tree.nodes[at as usize];
            if node.is_leaf() {
                let met = self.range(at).filter(|&m| self.items[m].meets(around));
                met.for_each(|m| found(m as u32));
            } else {
                (open[count], open[count + 1]) = (node.right, at + 1);
                count += 2;
            }
        }
    }

    /// The items of a leaf, as indices in the order of the leaves.
    fn range(&self, leaf: u32) -> Range<usize> {
        let node = &self.tree.nodes[leaf as usize];
        node.first as usize..(node.first + node.count) as usize
    }
}
