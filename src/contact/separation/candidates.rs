//! Candidate pairs: triangles that can come within reach of each other, kept for as long as no vertex has gone farther than was
//! allowed for when they were searched for (a Verlet list).

use glam::DVec3;
use rayon::prelude::*;

use crate::contact::separation::broad::{Around, Broad, Pairs};
use crate::contact::separation::topology::{Obstacle, PlacedTriangle};
use crate::contact::separation::{LEAST_SHARE, grown};
use crate::geometry::bvh::Aabb;

/// How far a vertex may go besides its reach before pairs are searched for anew, in reaches.
const MARGIN: f64 = 2.0;

/// Cloth at a detection.
#[derive(Clone, Copy)]
pub(super) struct Moving<'a> {
    /// Positions of the vertices, metres.
    pub x: &'a [DVec3],
    /// For each vertex how far it may go until the next detection, metres.
    pub reach: &'a [f64],
    /// The triangles there.
    pub placed: &'a [PlacedTriangle],
    /// Distance that the cloth keeps from itself, metres.
    pub thickness: f64,
}

impl Moving<'_> {
    /// The box of a triangle of which no vertex goes farther than `reach`, metres; those of two triangles meet where features may
    /// come within the thickness.
    fn bounds(&self, placed: &PlacedTriangle, reach: f64) -> Aabb {
        grown(&placed.around, reach + self.thickness / 2.0)
    }
}

/// The pairs of the cloth's triangles with each other and with those of an obstacle. What a search finds, and in which order, does not
/// depend on how old they are.
#[derive(Clone, Debug, Default)]
pub(super) struct Candidates {
    /// The boxes at the last search.
    wide: Broad,
    /// The present box of each triangle, in the order of the leaves.
    items: Vec<Around>,
    /// The pairs, in the order in which the tree gives them, in parts for parallel tasks.
    pairs: Vec<Pairs>,
    /// Positions of the vertices at the last search, metres.
    from: Vec<DVec3>,
    /// How far from there the reach of each vertex may extend, metres.
    limits: Vec<f64>,
    /// Number of searches in the trees.
    pub searches: u64,
}

impl Candidates {
    /// Forgets the pairs, as the obstacle has changed.
    pub fn forget(&mut self) {
        self.pairs.clear();
    }

    /// Finds the pairs of cloth, of which some triangles are `beside` each other and no pair, with itself and `obstacle`.
    pub fn fit(
        &mut self,
        cloth: Moving<'_>,
        obstacle: Option<&Obstacle>,
        beside: impl Fn(u32, u32) -> bool + Sync,
    ) {
        let placed = cloth.placed;
        let bounds = |t: &PlacedTriangle| cloth.bounds(t, t.farthest);
        if !self.wide.is_over(placed.len()) {
            self.wide.plant(&placed.iter().map(bounds).collect::<Vec<_>>());
        }
        let order = self.wide.order().par_iter().with_min_len(LEAST_SHARE);
        order.map(|&t| Around::of(&bounds(&placed[t as usize]))).collect_into_vec(&mut self.items);
        if !self.are_known(cloth) {
            self.renew(cloth, obstacle, beside);
        }
    }

    /// Whether the pairs still hold.
    fn are_known(&self, cloth: Moving<'_>) -> bool {
        let holds = |v: usize| cloth.x[v].distance(self.from[v]) + cloth.reach[v] <= self.limits[v];
        !self.pairs.is_empty()
            && self.from.len() == cloth.x.len()
            && (0..cloth.x.len()).into_par_iter().with_min_len(LEAST_SHARE).all(holds)
    }

    fn renew(
        &mut self,
        cloth: Moving<'_>,
        obstacle: Option<&Obstacle>,
        beside: impl Fn(u32, u32) -> bool + Sync,
    ) {
        self.searches += 1;
        self.from.clear();
        self.from.extend_from_slice(cloth.x);
        self.limits.clear();
        self.limits.extend(cloth.reach.iter().map(|reach| reach * (1.0 + MARGIN)));
        let (placed, limits) = (cloth.placed, &self.limits);
        let limit = |t: &PlacedTriangle| t.vertices.iter().map(|&v| limits[v as usize]).fold(0.0, f64::max);
        let wide = |&t: &u32| Around::of(&cloth.bounds(&placed[t as usize], limit(&placed[t as usize])));
        self.wide.fit(self.wide.order().iter().map(wide).collect());
        let is_pair = |s: u32, t: u32| {
            let [one, two] = [s, t].map(|t| &placed[t as usize]);
            !beside(s, t) && !one.is_apart(two, limit(one) + limit(two) + cloth.thickness)
        };
        let is_pair_with = |s: u32, t: u32| {
            let one = &placed[s as usize];
            obstacle.is_some_and(|obstacle| !one.is_apart(&obstacle.placed[t as usize], limit(one)))
        };
        self.pairs = self.wide.pairs(obstacle.map(|obstacle| &obstacle.broad), is_pair, is_pair_with);
    }

    /// Calls `look` for every pair of triangles of the cloth whose boxes meet, and `look_at` for every one with a triangle of `obstacle`,
    /// which is that of the last [`Self::fit`]. The results come in an order that does not depend on threads.
    pub fn search<T: Default + Send>(
        &self,
        obstacle: Option<&Obstacle>,
        look: impl Fn(u32, u32, &mut T) + Sync,
        look_at: impl Fn(u32, u32, &mut T) + Sync,
    ) -> Vec<T> {
        let order = self.wide.order();
        let other = obstacle.map(|obstacle| &obstacle.broad);
        let (theirs, their_order) = other.map_or((&[][..], &[][..]), |other| (other.items(), other.order()));
        let part = |pairs: &Pairs| {
            let mut found = T::default();
            for pair in pairs {
                let (s, own) = (order[pair.one as usize], &self.items[pair.one as usize]);
                let two = pair.two as usize;
                if pair.is_of_other {
                    if own.meets(&theirs[two]) {
                        look_at(s, their_order[two], &mut found);
                    }
                } else if own.meets(&self.items[two]) {
                    look(s, order[two], &mut found);
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
    use crate::contact::separation::topology::Topology;
    use crate::geometry::adjacency::Adjacency;
    use crate::geometry::random::Random;

    /// Many separate triangles in a box of 1 m.
    fn scattered(random: &mut Random, count: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let mut vector = |size: f64| DVec3::from_array([0; 3].map(|_| random.between(-size, size)));
        let corners = |_| {
            let at = vector(0.5);
            [at, at + vector(0.05), at + vector(0.05)]
        };
        ((0..count).flat_map(corners).collect(), (0..count).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect())
    }

    #[test]
    fn pairs_that_are_kept_are_those_of_a_fresh_search_in_the_same_order() {
        let mut random = Random::stream(5, 0);
        let (mut x, triangles) = scattered(&mut random, 400);
        let (still, other) = scattered(&mut random, 200);
        let obstacle = Obstacle::new(&still, &other, &Adjacency::new(still.len(), &other));
        let topology = Topology::new(&triangles, &Adjacency::new(x.len(), &triangles));
        let reach: Vec<f64> = (0..x.len()).map(|v| 0.002 + 0.001 * (v % 3) as f64).collect();
        let (mut kept, mut fresh) = (Candidates::default(), Candidates::default());
        for step in 0..40 {
            for (v, x) in x.iter_mut().enumerate() {
                *x += DVec3::new(3e-4 * (v % 7) as f64, 2e-4 * f64::from(step % 5), -3e-4);
            }
            let place = |t: u32| PlacedTriangle::new(&topology, &x, &reach, t);
            let placed: Vec<PlacedTriangle> = (0..400).map(place).collect();
            let cloth = Moving { x: &x, reach: &reach, placed: &placed, thickness: 0.003 };
            fresh.forget();
            let found = [&mut kept, &mut fresh].map(|candidates| {
                candidates.fit(cloth, Some(&obstacle), |_, _| false);
                let all = candidates.search(
                    Some(&obstacle),
                    |s, t, found: &mut Vec<_>| found.push((false, s, t)),
                    |s, t, found| found.push((true, s, t)),
                );
                all.into_iter().flatten().collect::<Vec<_>>()
            });
            let near = |&(is_of_other, s, t): &(bool, u32, u32)| {
                let one = &placed[s as usize];
                let (two, far) = match is_of_other {
                    true => (&obstacle.placed[t as usize], one.farthest),
                    false => {
                        let two = &placed[t as usize];
                        (two, one.farthest + two.farthest + cloth.thickness)
                    }
                };
                grown(&one.around, far).meets(&two.around) && !one.is_apart(two, far)
            };
            let [kept, fresh] = found.map(|pairs| pairs.into_iter().filter(near).collect::<Vec<_>>());
            assert!(kept == fresh, "step {step}: {} and {} pairs", kept.len(), fresh.len());
            let all = |count: u32, is_of_other: bool| {
                (0..400).flat_map(move |s| (0..count).map(move |t| (is_of_other, s, t)))
            };
            let exact = all(400, false).filter(|(_, s, t)| s < t).chain(all(200, true)).filter(near).count();
            assert!(exact > 40 && kept.len() == exact, "step {step}: {} pairs of {exact}", kept.len());
        }
        assert!((4..25).contains(&kept.searches) && fresh.searches == 40, "{} of 40", kept.searches);
    }
}
