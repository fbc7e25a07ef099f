//! A bounding volume hierarchy with four children per node, for nearest-item queries: it has half the levels of
//! [`Bvh`], and the four boxes of a node are tested together (SIMD).

use std::ops::Range;

use glam::DVec3;

use crate::geometry::bvh::{Aabb, Bvh};
use crate::geometry::wide::wide;

/// Flag of a child that is a leaf. Its other bits hold the index of the leaf's first item times eight plus the number
/// of its items.
const LEAF: u32 = 1 << 31;
/// Marks a missing child.
const NONE: u32 = u32::MAX;
/// Capacity of the stack of open nodes: enough for a tree over 2³² items split at medians, where each level leaves at
/// most three nodes waiting.
const DEPTH: usize = 64;
/// Rounding error allowed for in the test of a segment against a box, as a fraction of the largest coordinate.
const SLACK: f64 = 1e-12;

/// The boxes of a node's four children, stored axis by axis, and the children themselves.
#[derive(Clone, Debug)]
struct Node {
    lower: [[f64; 4]; 3],
    upper: [[f64; 4]; 3],
    children: [u32; 4],
}

impl Node {
    /// The box around all four children; missing children have empty boxes.
    fn bounds(&self) -> Aabb {
        let least =
            |of: &[[f64; 4]; 3]| DVec3::from_array(of.map(|c| c.into_iter().fold(f64::INFINITY, f64::min)));
        let most = |of: &[[f64; 4]; 3]| {
            DVec3::from_array(of.map(|c| c.into_iter().fold(f64::NEG_INFINITY, f64::max)))
        };
        Aabb { lower: least(&self.lower), upper: most(&self.upper) }
    }

    /// Squared distances from `p` to the four boxes, square metres.
    #[inline(always)]
    fn distances_squared(&self, p: DVec3) -> [f64; 4] {
        let mut sum = [0.0; 4];
        for (axis, x) in p.to_array().into_iter().enumerate() {
            let (lower, upper) = (&self.lower[axis], &self.upper[axis]);
            for k in 0..4 {
                let below = lower[k] - x;
                let above = x - upper[k];
                let off = if below > above { below } else { above };
                let off = if off > 0.0 { off } else { 0.0 };
                sum[k] += off * off;
            }
        }
        sum
    }
}

/// A segment prepared for tests against boxes: its midpoint and half its direction.
struct Slab {
    middle: [f64; 3],
    half: [f64; 3],
    /// The absolute values of `half`.
    reach: [f64; 3],
    /// Margin by which boxes are enlarged on every side, metres; it covers rounding errors.
    slack: f64,
}

impl Slab {
    fn new([p, q]: [DVec3; 2], all: Aabb) -> Self {
        let (middle, half) = ((p + q) / 2.0, (q - p) / 2.0);
        let largest = [p, q, all.lower, all.upper].map(|p| p.abs().max_element());
        let slack = SLACK * largest.into_iter().fold(0.0, f64::max);
        Self { middle: middle.to_array(), half: half.to_array(), reach: half.abs().to_array(), slack }
    }

    /// For each of the four boxes whether the segment may meet it. Conservative: no box that is met is missed; boxes
    /// within `slack` of the segment may be reported too. Separating axis test (Ericson, Real-Time Collision
    /// Detection, 5.3.3).
    #[inline(always)]
    fn meets(&self, node: &Node) -> [bool; 4] {
        let mut is_clear = [false; 4];
        let (mut away, mut extent) = ([[0.0; 4]; 3], [[0.0; 4]; 3]);
        for axis in 0..3 {
            let (lower, upper) = (&node.lower[axis], &node.upper[axis]);
            for k in 0..4 {
                away[axis][k] = self.middle[axis] - (lower[k] + upper[k]) / 2.0;
                extent[axis][k] = (upper[k] - lower[k]) / 2.0 + self.slack;
                is_clear[k] |= away[axis][k].abs() > extent[axis][k] + self.reach[axis];
            }
        }
        for [i, j] in [[0, 1], [1, 2], [2, 0]] {
            for k in 0..4 {
                let apart = (away[i][k] * self.half[j] - away[j][k] * self.half[i]).abs();
                is_clear[k] |= apart > extent[i][k] * self.reach[j] + extent[j][k] * self.reach[i];
            }
        }
        is_clear.map(|clear| !clear)
    }
}

/// A bounding volume hierarchy with four children per node. Equal input gives an equal tree.
#[derive(Clone, Debug, Default)]
pub struct Bvh4 {
    nodes: Vec<Node>,
    /// Items (indices into the input of the binary tree) in the order of the leaves; a *slot* is an index into this
    /// list.
    pub items: Vec<u32>,
}

impl Bvh4 {
    /// Collapses every two levels of `tree` into one; the leaves stay as they are.
    pub fn new(tree: Bvh) -> Self {
        let mut wide = Self { nodes: Vec::new(), items: Vec::new() };
        if !tree.nodes.is_empty() {
            wide.grow(&tree, 0);
        }
        wide.items = tree.items;
        wide
    }

    fn grow(&mut self, tree: &Bvh, root: u32) -> u32 {
        let halves = |at: u32| -> Vec<u32> {
            let node = &tree.nodes[at as usize];
            if node.is_leaf() { vec![at] } else { vec![at + 1, node.right] }
        };
        let below: Vec<u32> = halves(root).into_iter().flat_map(halves).collect();
        let place = self.nodes.len();
        self.nodes.push(Node {
            lower: [[f64::INFINITY; 4]; 3],
            upper: [[f64::NEG_INFINITY; 4]; 3],
            children: [NONE; 4],
        });
        for (k, &at) in below.iter().enumerate() {
            let node = &tree.nodes[at as usize];
            for axis in 0..3 {
                self.nodes[place].lower[axis][k] = node.bounds.lower[axis];
                self.nodes[place].upper[axis][k] = node.bounds.upper[axis];
            }
            // A root that is itself a leaf is its own only child.
            let child =
                if node.is_leaf() { LEAF | (node.first * 8 + node.count) } else { self.grow(tree, at) };
            self.nodes[place].children[k] = child;
        }
        place as u32
    }

    /// Updates the boxes after items have moved; `bounds` gives the new box of the item in each slot. The shape of
    /// the tree is kept: queries stay exact, but become slower where items that were close have moved apart.
    pub fn refit(&mut self, bounds: impl Fn(usize) -> Aabb) {
        // Children come after their parents.
        for at in (0..self.nodes.len()).rev() {
            for k in 0..4 {
                let child = self.nodes[at].children[k];
                let fitted = match child {
                    NONE => continue,
                    leaf if leaf & LEAF != 0 => {
                        let (first, count) = (((leaf & !LEAF) / 8) as usize, (leaf % 8) as usize);
                        (first..first + count).fold(Aabb::EMPTY, |b, slot| b.joined(&bounds(slot)))
                    }
                    inner => self.nodes[inner as usize].bounds(),
                };
                for axis in 0..3 {
                    self.nodes[at].lower[axis][k] = fitted.lower[axis];
                    self.nodes[at].upper[axis][k] = fitted.upper[axis];
                }
            }
        }
    }

    /// Calls `look` with the slots (indices in [`Bvh4::items`]) of every leaf whose box is within the square root of the limit
    /// of `p`, nearer boxes first. The limit starts as `limit` and is replaced by each value that `look` returns.
    pub fn visit(&self, p: DVec3, limit: f64, look: impl FnMut(Range<usize>) -> f64) {
        wide(
            #[inline(always)]
            || self.descend(p, limit, look),
        );
    }

    /// Whether `meets` is true for any slot whose leaf's box the segment between `ends` meets. Slots are tried in a
    /// fixed order, until the first for which it is.
    pub fn any_along(&self, ends: [DVec3; 2], meets: impl FnMut(usize) -> bool) -> bool {
        wide(
            #[inline(always)]
            || self.go_along(ends, meets),
        )
    }

    #[inline(always)]
    fn go_along(&self, ends: [DVec3; 2], mut meets: impl FnMut(usize) -> bool) -> bool {
        let Some(root) = self.nodes.first() else { return false };
        let slab = Slab::new(ends, root.bounds());
        let mut open = [0u32; DEPTH];
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let node = &self.nodes[open[waiting] as usize];
            for (&child, met) in node.children.iter().zip(slab.meets(node)) {
                if !met || child == NONE {
                    continue;
                }
                if child & LEAF == 0 {
                    open[waiting] = child;
                    waiting += 1;
                    continue;
                }
                let (first, count) = ((child & !LEAF) / 8, child % 8);
                if (first..first + count).any(|slot| meets(slot as usize)) {
                    return true;
                }
            }
        }
        false
    }

    #[inline(always)]
    fn descend(&self, p: DVec3, limit: f64, mut look: impl FnMut(Range<usize>) -> f64) {
        let mut least = limit;
        let mut open = [(0.0f64, 0u32); DEPTH];
        let mut waiting = usize::from(!self.nodes.is_empty());
        while waiting > 0 {
            waiting -= 1;
            let (from, at) = open[waiting];
            if from > least {
                continue;
            }
            if at & LEAF != 0 {
                let (first, count) = (((at & !LEAF) / 8) as usize, (at % 8) as usize);
                least = look(first..first + count);
                continue;
            }
            let node = &self.nodes[at as usize];
            let away = node.distances_squared(p);
            let start = waiting;
            for (&d, &child) in away.iter().zip(&node.children) {
                if child == NONE || d > least {
                    continue;
                }
                // Keep the stack sorted with the farthest child first, so that the nearest is taken next.
                let mut k = waiting;
                while k > start && open[k - 1].0 < d {
                    open[k] = open[k - 1];
                    k -= 1;
                }
                open[k] = (d, child);
                waiting += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(count: u32) -> Vec<DVec3> {
        let at = |i: u32, k: u32| f64::from((i * k) % 997) / 996.0;
        (0..count).map(|i| DVec3::new(at(i, 131), at(i, 377), at(i, 613))).collect()
    }

    /// The item nearest to `p` within the square root of `limit`, and its squared distance.
    fn nearest(tree: &Bvh4, p: DVec3, limit: f64, far: impl Fn(u32) -> f64) -> Option<(u32, f64)> {
        let mut best = None;
        let mut least = limit;
        tree.visit(p, limit, |slots| {
            for &item in &tree.items[slots] {
                if far(item) < least {
                    (best, least) = (Some((item, far(item))), far(item));
                }
            }
            least
        });
        best
    }

    #[test]
    fn the_nearest_is_what_brute_force_says() {
        for count in [0, 1, 3, 5, 17, 500] {
            let points = points(count);
            let boxes: Vec<Aabb> = points.iter().map(|p| Aabb::around(&[*p])).collect();
            let tree = Bvh4::new(Bvh::new(&boxes));
            for query in points.iter().map(|p| *p * 1.3 - 0.1) {
                let far = |i: u32| (points[i as usize] - query).length_squared();
                let exact = (0..count).min_by(|&i, &j| far(i).total_cmp(&far(j))).map(|i| (i, far(i)));
                assert_eq!(nearest(&tree, query, f64::INFINITY, far), exact);
                let nearer = exact.expect("one").1 * 0.99;
                assert_eq!(nearest(&tree, query, nearer, far), None);
            }
        }
    }

    #[test]
    fn a_refitted_tree_finds_what_brute_force_finds() {
        for count in [0, 1, 4, 5, 300] {
            let before = points(count);
            let boxes: Vec<Aabb> = before.iter().map(|p| Aabb::around(&[*p])).collect();
            let mut tree = Bvh4::new(Bvh::new(&boxes));
            let after: Vec<DVec3> = before.iter().map(|p| DVec3::new(p.z * 2.0, p.x - p.y, p.y)).collect();
            let items = tree.items.clone();
            tree.refit(|slot| Aabb::around(&[after[items[slot] as usize]]));
            for query in before.iter().map(|p| *p * 1.4 - 0.2) {
                let far = |i: u32| (after[i as usize] - query).length_squared();
                let exact = (0..count).map(far).fold(f64::INFINITY, f64::min);
                let found = nearest(&tree, query, f64::INFINITY, far);
                assert_eq!(found.map(|(_, d)| d), Some(exact));
            }
        }
    }

    #[test]
    fn all_within_reach_are_visited() {
        let points = points(300);
        let boxes: Vec<Aabb> = points.iter().map(|p| Aabb::around(&[*p])).collect();
        let tree = Bvh4::new(Bvh::new(&boxes));
        let (query, limit) = (DVec3::splat(0.4), 0.04);
        let mut found = Vec::new();
        tree.visit(query, limit, |slots| {
            let near = |item: &&u32| (points[**item as usize] - query).length_squared() <= limit;
            found.extend(tree.items[slots].iter().filter(near).copied());
            limit
        });
        found.sort_unstable();
        let exact: Vec<u32> =
            (0..300).filter(|&i| (points[i as usize] - query).length_squared() <= limit).collect();
        assert_eq!(found, exact);
    }
}
