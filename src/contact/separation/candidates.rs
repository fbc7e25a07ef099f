//! Candidate pairs: items whose grown boxes meet, kept for as long as no box has left its grown one (a Verlet list).

use std::ops::Range;

use rayon::prelude::*;

use crate::contact::separation::broad::{Around, Broad, Pairs};
use crate::geometry::bvh::Aabb;

/// Margin by which the box of an item is grown, in distances that it may go until the next detection. With it a tree is searched in
/// about every third detection; what is found does not depend on it.
pub(super) const MARGIN: f64 = 3.0;

/// Boxes that move, and their pairs. What a search finds, and in which order, does not depend on how old the pairs are.
#[derive(Clone, Debug, Default)]
pub(super) struct Candidates {
    /// The grown boxes.
    wide: Broad,
    /// The present box of each item, in the order of the leaves.
    items: Vec<Around>,
    /// Pairs whose grown boxes meet, in the order in which the tree gives them, in parts for parallel tasks.
    pairs: Vec<Pairs>,
}

impl Candidates {
    /// Moves the boxes to `boxes`; `reach` tells how far each may go until the next call, metres. Two items
    /// of which `passes_over` is true are no pair. Returns whether the trees were searched.
    pub fn fit(
        &mut self,
        boxes: &[Aabb],
        reach: impl Fn(usize) -> f64,
        passes_over: impl Fn(u32, u32) -> bool + Sync,
    ) -> bool {
        self.wide.plant(boxes);
        let order = self.wide.order();
        self.items.clear();
        self.items.extend(order.iter().map(|&i| Around::of(&boxes[i as usize])));
        let is_known = !self.pairs.is_empty()
            && self.items.iter().zip(self.wide.items()).all(|(now, wide)| wide.contains(now));
        if !is_known {
            let margin = |i: u32| (MARGIN * reach(i as usize)) as f32;
            let grown = self.items.iter().zip(order).map(|(now, &i)| now.grown(margin(i))).collect();
            self.wide.fit(grown);
            self.pairs = self.wide.pairs(passes_over);
        }
        !is_known
    }

    /// The items in the order of the leaves.
    pub fn order(&self) -> &[u32] {
        self.wide.order()
    }

    /// Calls `look` for every pair of items whose boxes meet, and `look_at_leaf` for the items of every leaf, as indices in the order of
    /// the leaves, and those of `with`, which come in that order, too, or are none. The results come in an order that does not depend
    /// on threads.
    pub fn search<T: Default + Send, W: Send>(
        &self,
        mut with: &mut [W],
        look: impl Fn(u32, u32, &mut T) + Sync,
        look_at_leaf: impl Fn(Range<usize>, &mut [W], &mut T) + Sync,
    ) -> Vec<T> {
        let order = self.order();
        let mut parts = Vec::with_capacity(self.pairs.len());
        for pairs in &self.pairs {
            let count = pairs.leaves.iter().map(|(leaf, _)| leaf.len()).sum::<usize>().min(with.len());
            let (own, rest) = with.split_at_mut(count);
            parts.push((pairs, own));
            with = rest;
        }
        let part = |(pairs, mut with): (&Pairs, &mut [W])| {
            let (mut found, mut done) = (T::default(), 0);
            let mut look_up_to = |end: usize, found: &mut T| {
                for &[one, two] in &pairs.met[done..end] {
                    if self.items[one as usize].meets(&self.items[two as usize]) {
                        look(order[one as usize], order[two as usize], found);
                    }
                }
                done = end;
            };
            let leaves = if with.is_empty() { &[][..] } else { &pairs.leaves };
            for (leaf, before) in leaves {
                look_up_to(*before, &mut found);
                let (own, rest) = with.split_at_mut(leaf.len());
                look_at_leaf(leaf.clone(), own, &mut found);
                with = rest;
            }
            look_up_to(pairs.met.len(), &mut found);
            found
        };
        parts.into_par_iter().map(part).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::random::Random;
    use glam::DVec3;

    fn found(candidates: &Candidates) -> Vec<[u32; 2]> {
        let look = |s, t, found: &mut Vec<_>| found.push([s, t]);
        candidates.search(&mut [(); 0], look, |_, _, _| {}).into_iter().flatten().collect()
    }

    #[test]
    fn pairs_that_are_kept_are_those_of_a_fresh_search_in_the_same_order() {
        let mut random = Random::stream(5, 0);
        let mut place = || DVec3::from_array([0; 3].map(|_| random.between(0.0, 1.0)));
        let one = |at: DVec3| Aabb { lower: at, upper: at + DVec3::splat(0.08) };
        let mut moving: Vec<Aabb> = (0..500).map(|_| one(place())).collect();
        let mut kept = Candidates::default();
        let mut fresh = Candidates::default();
        for candidates in [&mut kept, &mut fresh] {
            candidates.wide.plant(&moving);
        }
        let mut searches = 0;
        for step in 0..40 {
            for (i, item) in moving.iter_mut().enumerate() {
                let way = DVec3::new(0.001 * (i % 7) as f64, 0.0008 * (step % 5) as f64, -0.001);
                *item = Aabb { lower: item.lower + way, upper: item.upper + way };
            }
            searches += usize::from(kept.fit(&moving, |_| 0.006, |_, _| false));
            fresh.pairs.clear();
            fresh.fit(&moving, |_| 0.006, |_, _| false);
            let pairs = found(&kept);
            assert!(pairs == found(&fresh), "step {step}");
            let mut own: Vec<[u32; 2]> = pairs.iter().map(|&[s, t]| [s.min(t), s.max(t)]).collect();
            own.sort_unstable();
            let meet = |i: usize, j: usize| moving[i].meets(&moving[j]);
            let exact: Vec<[u32; 2]> = (0..moving.len())
                .flat_map(|i| (i + 1..moving.len()).map(move |j| (i, j)))
                .filter(|&(i, j)| meet(i, j))
                .map(|(i, j)| [i as u32, j as u32])
                .collect();
            assert!(own == exact, "step {step}: {} pairs for {}", own.len(), exact.len());
        }
        assert!((2..20).contains(&searches), "{searches} searches of 40");
        assert!(!kept.fit(&moving, |_| 0.006, |_, _| false), "nothing moved");
    }
}
