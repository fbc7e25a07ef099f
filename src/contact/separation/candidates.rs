//! Candidate pairs: items whose grown boxes meet, kept for as long as no box has left its grown one (a Verlet list).

use rayon::prelude::*;

use crate::contact::separation::broad::{Around, Broad, Pairs};
use crate::geometry::bvh::Aabb;

/// Margin by which the box of an item is grown, in distances that it may go until the next detection. With it the trees are
/// searched in about every third detection; what is found does not depend on it.
const MARGIN: f64 = 3.0;

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
    /// Forgets the pairs, as the other boxes have changed.
    pub fn forget(&mut self) {
        self.pairs.clear();
    }

    /// Moves the boxes to `boxes`; `reach` tells how far each may go until the next call, metres. `other` holds boxes that stay.
    /// Two items of which `passes_over` is true are no pair. Returns whether the trees were searched.
    pub fn fit(
        &mut self,
        boxes: &[Aabb],
        reach: impl Fn(usize) -> f64,
        other: Option<&Broad>,
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
            self.pairs = self.wide.pairs(other, passes_over);
        }
        !is_known
    }

    /// Calls `look` for every pair of items whose boxes meet, and `look_at` for every item and item of `other`, which is that of the last
    /// [`Self::fit`], whose boxes meet. The results come in an order that does not depend on threads.
    pub fn search<T: Default + Send>(
        &self,
        other: Option<&Broad>,
        look: impl Fn(u32, u32, &mut T) + Sync,
        look_at: impl Fn(u32, u32, &mut T) + Sync,
    ) -> Vec<T> {
        let order = self.wide.order();
        let (theirs, their_order) = other.map_or((&[][..], &[][..]), |other| (other.items(), other.order()));
        let part = |pairs: &Pairs| {
            let mut found = T::default();
            for pair in pairs {
                let (k, own) = (order[pair.one as usize], &self.items[pair.one as usize]);
                let two = pair.two as usize;
                if pair.is_of_other {
                    if own.meets(&theirs[two]) {
                        look_at(k, their_order[two], &mut found);
                    }
                } else if own.meets(&self.items[two]) {
                    look(k, order[two], &mut found);
                }
            }
            found
        };
        self.pairs.par_iter().map(part).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::random::Random;
    use glam::DVec3;

    fn found(candidates: &Candidates, other: &Broad) -> Vec<(bool, u32, u32)> {
        let all = candidates.search(
            Some(other),
            |s, t, found: &mut Vec<_>| found.push((false, s, t)),
            |s, t, found| found.push((true, s, t)),
        );
        all.into_iter().flatten().collect()
    }

    #[test]
    fn pairs_that_are_kept_are_those_of_a_fresh_search_in_the_same_order() {
        let mut random = Random::stream(5, 0);
        let mut place = || DVec3::from_array([0; 3].map(|_| random.between(0.0, 1.0)));
        let mut boxes = |count: usize| -> Vec<Aabb> {
            let one = |at: DVec3| Aabb { lower: at, upper: at + DVec3::splat(0.08) };
            (0..count).map(|_| one(place())).collect()
        };
        let (mut moving, still) = (boxes(500), boxes(300));
        let other = Broad::over(&still);
        let mut kept = Candidates::default();
        let mut fresh = Candidates::default();
        for candidates in [&mut kept, &mut fresh] {
            candidates.wide.plant(&moving);
        }
        let count =
            |found: &[(bool, u32, u32)]| found.iter().filter(|(is_of_other, ..)| *is_of_other).count();
        let mut searches = 0;
        for step in 0..40 {
            for (i, item) in moving.iter_mut().enumerate() {
                let way = DVec3::new(0.001 * (i % 7) as f64, 0.0008 * (step % 5) as f64, -0.001);
                *item = Aabb { lower: item.lower + way, upper: item.upper + way };
            }
            searches += usize::from(kept.fit(&moving, |_| 0.006, Some(&other), |_, _| false));
            fresh.forget();
            fresh.fit(&moving, |_| 0.006, Some(&other), |_, _| false);
            let pairs = found(&kept, &other);
            assert!(pairs == found(&fresh, &other), "step {step}");
            let mut own: Vec<[u32; 2]> = pairs
                .iter()
                .filter(|(is_of_other, ..)| !is_of_other)
                .map(|&(_, s, t)| [s.min(t), s.max(t)])
                .collect();
            own.sort_unstable();
            let meet = |i: usize, j: usize| moving[i].meets(&moving[j]);
            let exact: Vec<[u32; 2]> = (0..moving.len())
                .flat_map(|i| (i + 1..moving.len()).map(move |j| (i, j)))
                .filter(|&(i, j)| meet(i, j))
                .map(|(i, j)| [i as u32, j as u32])
                .collect();
            assert!(own == exact, "step {step}: {} pairs for {}", own.len(), exact.len());
            let exact =
                moving.iter().map(|item| still.iter().filter(|at| at.meets(item)).count()).sum::<usize>();
            assert_eq!(count(&pairs), exact, "step {step}");
        }
        assert!((2..20).contains(&searches), "{searches} searches of 40");
        assert!(!kept.fit(&moving, |_| 0.006, Some(&other), |_, _| false), "nothing moved");
    }
}
