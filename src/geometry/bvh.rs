//! A bounding volume hierarchy: a binary tree of axis-aligned boxes, in f64.

use glam::DVec3;

/// Most items in a leaf.
pub const LEAF: usize = 4;
/// Number of items above which the two halves of a tree are built in parallel.
const MANY: usize = 1024;
/// Rounding error allowed for in the test of a segment against a box, as a fraction of the largest coordinate.
const SLACK: f64 = 1e-12;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Smallest coordinates.
    pub lower: DVec3,
    /// Largest coordinates.
    pub upper: DVec3,
}

impl Aabb {
    /// The empty box: it contains no point.
    pub const EMPTY: Self = Self { lower: DVec3::INFINITY, upper: DVec3::NEG_INFINITY };

    /// The smallest box around `points`.
    pub fn around(points: &[DVec3]) -> Self {
        points.iter().fold(Self::EMPTY, |b, &p| b.joined(&Self { lower: p, upper: p }))
    }

    /// The smallest box around this one and `other`.
    pub fn joined(&self, other: &Self) -> Self {
        Self { lower: self.lower.min(other.lower), upper: self.upper.max(other.upper) }
    }

    /// Whether this box and `other` share a point.
    pub fn meets(&self, other: &Self) -> bool {
        self.lower.cmple(other.upper).all() && self.upper.cmpge(other.lower).all()
    }

    /// Whether the segment between `ends` may meet this box. Conservative: never false where they meet; also true
    /// where the gap between them is smaller than rounding errors can be.
    pub fn meets_segment(&self, ends: [DVec3; 2]) -> bool {
        let [p, q] = ends;
        let (reach, half) = ((p - q).abs() / 2.0, (q - p) / 2.0);
        let slack = SLACK * p.abs().max(q.abs()).max(self.lower.abs()).max(self.upper.abs()).max_element();
        let away = (p + q) / 2.0 - self.centre();
        let extent = (self.upper - self.lower) / 2.0 + slack;
        if away.abs().cmpgt(extent + reach).any() {
            return false;
        }
        // Separating axis test: the box's axes are done; what remains are their cross products with the segment.
        let apart = away.cross(half).abs();
        let limit = DVec3::new(
            extent.y * reach.z + extent.z * reach.y,
            extent.z * reach.x + extent.x * reach.z,
            extent.x * reach.y + extent.y * reach.x,
        );
        !apart.cmpgt(limit).any()
    }

    /// The centre of the box.
    pub fn centre(&self) -> DVec3 {
        (self.lower + self.upper) / 2.0
    }
}

/// A node of a [`Bvh`]: either two children or, in a leaf, a few items.
#[derive(Clone, Debug)]
pub struct BvhNode {
    /// Box around all items below the node.
    pub bounds: Aabb,
    /// Index of the right child; 0 for a leaf. The left child is the next node.
    pub right: u32,
    /// Index in [`Bvh::items`] of the first item below the node.
    pub first: u32,
    /// Number of items below the node.
    pub count: u32,
}

impl BvhNode {
    /// Whether the node is a leaf.
    pub fn is_leaf(&self) -> bool {
        self.right == 0
    }
}

/// A bounding volume hierarchy: nodes in depth-first order, the root first. Equal input gives an equal tree.
#[derive(Clone, Debug, Default)]
pub struct Bvh {
    /// The nodes; empty when there are no items.
    pub nodes: Vec<BvhNode>,
    /// Items (indices into the input) in the order of the leaves.
    pub items: Vec<u32>,
}

impl Bvh {
    /// Builds the tree over `boxes`: splits at the median along the longest side, down to leaves of a few items.
    pub fn new(boxes: &[Aabb]) -> Self {
        Self::grown(boxes, |count| count / 2)
    }

    /// Like [`Bvh::new`], but splits only near medians, so that all leaves but the last hold [`LEAF`] items.
    pub fn with_full_leaves(boxes: &[Aabb]) -> Self {
        Self::grown(boxes, |count| (count / 2).next_multiple_of(LEAF))
    }

    fn grown(boxes: &[Aabb], split: fn(usize) -> usize) -> Self {
        let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = Vec::new();
        if !boxes.is_empty() {
            grow(boxes, &mut items, 0, split, &mut nodes);
        }
        Self { nodes, items }
    }

    /// Updates the boxes of the nodes after items have moved, keeping the shape of the tree. `boxes` holds as many
    /// boxes, in the same order, as the tree was built over.
    pub fn refit(&mut self, boxes: &[Aabb]) {
        // Children come after their parents.
        for at in (0..self.nodes.len()).rev() {
            let node = &self.nodes[at];
            let bounds = if node.is_leaf() {
                let first = node.first as usize;
                let items = &self.items[first..first + node.count as usize];
                items.iter().fold(Aabb::EMPTY, |b, &i| b.joined(&boxes[i as usize]))
            } else {
                self.nodes[at + 1].bounds.joined(&self.nodes[node.right as usize].bounds)
            };
            self.nodes[at].bounds = bounds;
        }
    }

    /// Calls `found` for every item whose leaf's box meets `query`; the caller tests the item itself.
    pub fn near(&self, query: &Aabb, mut found: impl FnMut(u32)) {
        self.leaves_near(query, |leaf| self.items_of(leaf).iter().copied().for_each(&mut found));
    }

    /// The items of a leaf, as indices into the input.
    pub fn items_of(&self, leaf: u32) -> &[u32] {
        let node = &self.nodes[leaf as usize];
        &self.items[node.first as usize..(node.first + node.count) as usize]
    }

    /// The leaves, as indices of nodes.
    pub fn leaves(&self) -> impl Iterator<Item = u32> {
        (0u32..).zip(&self.nodes).filter(|(_, node)| node.is_leaf()).map(|(at, _)| at)
    }

    /// Calls `found` for every item whose leaf's box the segment between `ends` meets; the caller tests the item
    /// itself. Cheaper than [`Bvh::near`] with the segment's box, which also holds items beside a slanted segment.
    pub fn along(&self, ends: [DVec3; 2], mut found: impl FnMut(u32)) {
        self.leaves_where(
            |bounds| bounds.meets_segment(ends),
            |leaf| self.items_of(leaf).iter().copied().for_each(&mut found),
        );
    }

    /// Calls `found` for every leaf (index of its node) whose box meets `query`.
    pub fn leaves_near(&self, query: &Aabb, found: impl FnMut(u32)) {
        self.leaves_where(|bounds| bounds.meets(query), found);
    }

    /// Calls `found` for every leaf whose box and whose ancestors' boxes all fulfil `met`.
    fn leaves_where(&self, met: impl Fn(&Aabb) -> bool, mut found: impl FnMut(u32)) {
        if self.nodes.is_empty() {
            return;
        }
        // The tree is halved at every level, so that no tree of 2³² items is deeper than this.
        let mut open = [0u32; 40];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let at = open[count];
            let node = &self.nodes[at as usize];
            if !met(&node.bounds) {
                continue;
            }
            if node.is_leaf() {
                found(at);
            } else {
                (open[count], open[count + 1]) = (node.right, at + 1);
                count += 2;
            }
        }
    }

    /// Calls `found` for every two leaves whose boxes meet, one below each child of `node`; for a leaf it is called
    /// once with the leaf twice. Called for every node, it finds every pair of leaves of the tree once.
    pub fn leaves_between(&self, node: u32, mut found: impl FnMut(u32, u32)) {
        if self.nodes[node as usize].is_leaf() {
            found(node, node);
            return;
        }
        let mut open = vec![[node + 1, self.nodes[node as usize].right]];
        while let Some([a, b]) = open.pop() {
            let [one, two] = [a, b].map(|at| &self.nodes[at as usize]);
            if !one.bounds.meets(&two.bounds) {
                continue;
            }
            if one.is_leaf() && two.is_leaf() {
                found(a, b);
            } else if two.is_leaf() || (!one.is_leaf() && one.count >= two.count) {
                open.extend([[a + 1, b], [one.right, b]]);
            } else {
                open.extend([[a, b + 1], [a, two.right]]);
            }
        }
    }
}

/// Appends to `nodes` the subtree over `items`, a slice of all items that starts at index `first`. `split` gives how many of a number
/// of items go to the left.
fn grow(
    boxes: &[Aabb],
    items: &mut [u32],
    first: usize,
    split: fn(usize) -> usize,
    nodes: &mut Vec<BvhNode>,
) {
    let bounds = items.iter().fold(Aabb::EMPTY, |b, &i| b.joined(&boxes[i as usize]));
    let node = nodes.len();
    nodes.push(BvhNode { bounds, right: 0, first: first as u32, count: items.len() as u32 });
    if items.len() <= LEAF {
        // The median search decides which items a leaf holds, but not their order: sort, so that equal input gives an
        // equal tree.
        items.sort_unstable();
        return;
    }
    let axis = (bounds.upper - bounds.lower).max_position();
    let place = |i: u32| boxes[i as usize].centre()[axis];
    let (middle, many) = (split(items.len()), items.len() > MANY);
    items.select_nth_unstable_by(middle, |&i, &j| place(i).total_cmp(&place(j)).then(i.cmp(&j)));
    let (left, right) = items.split_at_mut(middle);
    if many {
        let half = |items: &mut [u32], first: usize| {
            let mut nodes = Vec::new();
            grow(boxes, items, first, split, &mut nodes);
            nodes
        };
        for half in <[_; 2]>::from(rayon::join(|| half(left, first), || half(right, first + middle))) {
            let base = nodes.len() as u32;
            nodes[node].right = base;
            let placed = |n: BvhNode| BvhNode { right: if n.is_leaf() { 0 } else { n.right + base }, ..n };
            nodes.extend(half.into_iter().map(placed));
        }
    } else {
        grow(boxes, left, first, split, nodes);
        nodes[node].right = nodes.len() as u32;
        grow(boxes, right, first + middle, split, nodes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A small linear congruential generator: the same points on every run.
    fn points(count: usize) -> Vec<DVec3> {
        let mut seed = 1u64;
        let mut next = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1u64 << 53) as f64
        };
        (0..count).map(|_| DVec3::new(next(), next(), next())).collect()
    }

    #[test]
    fn halves_grown_side_by_side_make_one_tree() {
        let boxes: Vec<Aabb> = points(5 * MANY).iter().map(|p| Aabb::around(&[*p])).collect();
        each_node_holds_what_is_below_it(&Bvh::new(&boxes), &boxes);
        for count in [0, 1, 4, 5, 9, 1023, boxes.len()] {
            let tree = Bvh::with_full_leaves(&boxes[..count]);
            each_node_holds_what_is_below_it(&tree, &boxes[..count]);
            let leaves: Vec<u32> =
                tree.nodes.iter().filter(|node| node.is_leaf()).map(|leaf| leaf.count).collect();
            assert!(leaves.iter().rev().skip(1).all(|&count| count as usize == LEAF), "of {count}");
        }
    }

    fn each_node_holds_what_is_below_it(tree: &Bvh, boxes: &[Aabb]) {
        let mut items = tree.items.clone();
        items.sort_unstable();
        assert!(items.iter().enumerate().all(|(i, &item)| item == i as u32), "each item once");
        assert_eq!(items.len(), boxes.len());
        for (at, node) in tree.nodes.iter().enumerate() {
            let below = &tree.items[node.first as usize..(node.first + node.count) as usize];
            let bounds = below.iter().fold(Aabb::EMPTY, |b, &i| b.joined(&boxes[i as usize]));
            assert_eq!(node.bounds, bounds, "node {at}");
            if !node.is_leaf() {
                let [left, right] = [at + 1, node.right as usize].map(|child| &tree.nodes[child]);
                assert_eq!([left.first, right.first], [node.first, node.first + left.count], "node {at}");
                assert_eq!(left.count + right.count, node.count, "node {at}");
            }
        }
    }

    #[test]
    fn a_query_finds_what_brute_force_finds() {
        let points = points(600);
        let boxes: Vec<Aabb> =
            points.chunks_exact(2).map(|p| Aabb::around(&[p[0], p[0] + (p[1] - 0.5) * 0.2])).collect();
        let tree = Bvh::new(&boxes);
        for query in boxes.iter().step_by(7) {
            let mut found = Vec::new();
            tree.near(query, |i| found.extend(boxes[i as usize].meets(query).then_some(i)));
            found.sort_unstable();
            let exact: Vec<u32> =
                (0..boxes.len() as u32).filter(|&i| boxes[i as usize].meets(query)).collect();
            assert_eq!(found, exact);
        }
    }

    #[test]
    fn along_a_segment_is_all_that_it_meets_and_little_else() {
        let points = points(4000);
        let boxes: Vec<Aabb> =
            points.chunks_exact(2).map(|p| Aabb::around(&[p[0], p[0] + (p[1] - 0.5) * 0.05])).collect();
        let tree = Bvh::new(&boxes);
        let steps = 2000;
        let mut proposed = 0;
        for ends in points.chunks_exact(2).step_by(40).map(|p| [p[0], p[1]]) {
            let mut found = Vec::new();
            tree.along(ends, |i| found.push(i));
            found.sort_unstable();
            proposed += found.len();
            for k in 0..=steps {
                let at = Aabb::around(&[ends[0].lerp(ends[1], f64::from(k) / f64::from(steps))]);
                let met = (0..boxes.len() as u32).filter(|&i| boxes[i as usize].meets(&at));
                met.for_each(|i| assert!(found.binary_search(&i).is_ok(), "{i} {ends:?}"));
            }
        }
        assert!(proposed < 50 * boxes.len() / 8, "{proposed}");
        let mut found = Vec::new();
        tree.along([points[0]; 2], |i| found.push(i));
        assert!(found.contains(&0), "a segment of no length at a corner of a box");
    }

    #[test]
    fn a_tree_refitted_finds_what_a_new_one_finds() {
        let (before, after) = (points(200), points(400));
        let small = |p: &DVec3| Aabb::around(&[*p - 0.03, *p + 0.03]);
        let boxes: Vec<Aabb> = after[200..].iter().map(small).collect();
        let mut tree = Bvh::new(&before.iter().map(small).collect::<Vec<_>>());
        tree.refit(&boxes);
        for query in &boxes {
            let mut found = Vec::new();
            tree.near(query, |i| found.extend(boxes[i as usize].meets(query).then_some(i)));
            found.sort_unstable();
            let exact: Vec<u32> =
                (0..boxes.len() as u32).filter(|&i| boxes[i as usize].meets(query)).collect();
            assert_eq!(found, exact);
        }
    }

    #[test]
    fn leaves_that_meet_hold_what_meets_by_brute_force() {
        let points = points(900);
        let boxes: Vec<Aabb> =
            points.chunks_exact(2).map(|p| Aabb::around(&[p[0], p[0] + (p[1] - 0.5) * 0.2])).collect();
        let tree = Bvh::new(&boxes);
        let mut found = Vec::new();
        for node in 0..tree.nodes.len() as u32 {
            tree.leaves_between(node, |a, b| {
                for &i in tree.items_of(a) {
                    let more = tree.items_of(b).iter().filter(|&&j| a != b || i < j);
                    let meets = |j: &&u32| boxes[**j as usize].meets(&boxes[i as usize]);
                    found.extend(more.filter(meets).map(|&j| [i.min(j), i.max(j)]));
                }
            });
        }
        found.sort_unstable();
        let count = boxes.len() as u32;
        let all = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
        let exact: Vec<[u32; 2]> =
            all.filter(|pair| boxes[pair[0] as usize].meets(&boxes[pair[1] as usize])).collect();
        assert_eq!(found, exact);
    }

    #[test]
    fn an_empty_tree_finds_nothing() {
        Bvh::new(&[]).near(&Aabb::around(&[DVec3::ZERO]), |_| panic!("an item"));
    }
}
