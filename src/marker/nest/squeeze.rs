//! Shorter and shorter strips: the parts are laid over each other and then moved apart, one at a time to where it costs least,
//! while the price of the overlaps that stay goes up (guided local search after Egeblad, Nielsen and Odgaard, "Fast neighborhood
//! search for two- and three-dimensional nesting problems", 2007).

use super::fill::compact;
use super::strip::{Block, Spot, Strip, cheapest};
use crate::geometry::random::Random;

/// By what share the strip is shortened at first; after each failure by half of it.
const SHORTER: f64 = 0.02;
/// The least share by which it is shortened.
const LEAST: f64 = 0.001;
/// Rounds in which the overlap may stay as large as it is before a length is given up.
const PATIENCE: usize = 40;
/// Heights at random that are tried in each move, and heights near the present one.
const RANDOM: usize = 10;
const NEAR: usize = 6;
/// Most parts whose heights of contact are tried in each move.
const CONTACTS: usize = 24;

/// A search from one layout, with what it may spend.
pub struct Squeeze<'a, 's> {
    strip: &'a Strip<'s>,
    random: Random,
    /// Looks at a pair of parts that are left.
    work: u64,
    /// What was left when the watch was told last.
    told: u64,
    /// What a metre of overlap of two parts costs, a row of all parts for each.
    weights: Vec<f64>,
    spots: Vec<Spot>,
    blocks: Vec<Block>,
    heights: Vec<f64>,
}

impl<'a, 's> Squeeze<'a, 's> {
    /// A search that spends `work`.
    pub fn new(strip: &'a Strip<'s>, random: Random, work: u64) -> Self {
        let (blocks, heights, weights, spots) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { strip, random, work, told: work, weights, spots, blocks, heights }
    }

    /// The shortest layout found from `start`, whose parts lie apart. `least` is a length that none can be shorter than.
    pub fn shortest(mut self, start: Vec<Spot>, least: f64) -> Vec<Spot> {
        let mut best = start;
        let mut length = self.strip.length(&best);
        let mut by = SHORTER;
        while self.is_to_go_on() && length > least * (1.0 + 1e-6) && best.len() > 1 {
            let goal = (length * (1.0 - by)).max(least);
            self.spots.clone_from(&best);
            if by <= SHORTER / 8.0 {
                self.swap_two();
            }
            if !self.separate(goal) {
                by = if by / 2.0 < LEAST { SHORTER } else { by / 2.0 };
                continue;
            }
            let mut found = self.strip.settled(&self.spots);
            compact(self.strip, &mut found, 2, &mut self.work);
            found = self.strip.settled(&found);
            let own = self.strip.length(&found);
            if own < length - 1e-9 {
                (best, length) = (found, own);
            } else {
                by = if by / 2.0 < LEAST { SHORTER } else { by / 2.0 };
            }
        }
        best
    }

    /// Whether there is work left to spend and nobody has stopped the layout; tells the watch what was spent.
    fn is_to_go_on(&mut self) -> bool {
        self.strip.watch.spend(self.told - self.work);
        self.told = self.work;
        self.work > 0 && !self.strip.watch.is_stopped()
    }

    /// Exchanges the places of two parts.
    fn swap_two(&mut self) {
        let count = self.spots.len();
        let (i, j) = (self.random.below(count), self.random.below(count));
        let (a, b) = (self.spots[i], self.spots[j]);
        (self.spots[i].x, self.spots[i].y) = (b.x, b.y);
        (self.spots[j].x, self.spots[j].y) = (a.x, a.y);
    }

    /// Moves the parts apart on a strip of `length`; whether that was done.
    fn separate(&mut self, length: f64) -> bool {
        let count = self.spots.len();
        for spot in &mut self.spots {
            let size = self.strip.turned[spot.turned].size;
            (spot.x, spot.y) =
                (spot.x.min(length - size[0]).max(0.0), spot.y.min(self.strip.width - size[1]).max(0.0));
        }
        self.weights = vec![1.0; count * count];
        let (mut least, mut waited) = (f64::INFINITY, 0);
        let mut order: Vec<usize> = (0..count).collect();
        loop {
            for k in (1..count).rev() {
                order.swap(k, self.random.below(k + 1));
            }
            for &i in &order {
                self.relocate(i, length);
            }
            let overlap = self.raise_prices();
            if overlap == 0.0 {
                return true;
            }
            if overlap < least * 0.98 {
                (least, waited) = (overlap, 0);
            } else {
                waited += 1;
            }
            if waited > PATIENCE || !self.is_to_go_on() {
                return false;
            }
        }
    }

    /// The sum of all overlaps; those that there are become dearer, the others cheaper again.
    fn raise_prices(&mut self) -> f64 {
        let count = self.spots.len();
        let mut found = Vec::new();
        let (mut sum, mut most) = (0.0, 0.0_f64);
        for i in 0..count {
            for j in 0..i {
                let overlap = self.strip.overlap(&self.spots[i], &self.spots[j]);
                if overlap > 0.0 {
                    found.push((i, j, overlap));
                    sum += overlap;
                    most = most.max(overlap);
                } else {
                    let cheaper = (self.weights[i * count + j] * 0.95).max(1.0);
                    (self.weights[i * count + j], self.weights[j * count + i]) = (cheaper, cheaper);
                }
            }
        }
        self.work = self.work.saturating_sub((count * count / 2) as u64);
        for (i, j, overlap) in found {
            let dearer = self.weights[i * count + j] * (1.2 + 0.8 * overlap / most);
            (self.weights[i * count + j], self.weights[j * count + i]) = (dearer, dearer);
        }
        sum
    }

    /// Moves part `i`, if it lies in another, to where that costs least.
    fn relocate(&mut self, i: usize, length: f64) {
        let strip = self.strip;
        let count = self.spots.len();
        let spot = self.spots[i];
        let weights = &self.weights[i * count..(i + 1) * count];
        let others = || (0..count).filter(move |&j| j != i);
        let now: f64 = others().map(|j| strip.overlap(&spot, &self.spots[j]) * weights[j]).sum();
        self.work = self.work.saturating_sub(count as u64);
        if now == 0.0 {
            return;
        }
        let mut best = (now, spot);
        for &turned in &strip.parts[i] {
            let (highest, most) = (strip.highest(turned), length - strip.turned[turned].size[0]);
            if most < 0.0 {
                continue;
            }
            let mut heights = std::mem::take(&mut self.heights);
            heights.clear();
            if count <= CONTACTS {
                strip.contacts(turned, others().map(|j| &self.spots[j]), &mut heights);
            } else {
                let some: Vec<usize> =
                    (0..CONTACTS).map(|_| self.random.below(count)).filter(|&j| j != i).collect();
                strip.contacts(turned, some.iter().map(|&j| &self.spots[j]), &mut heights);
            }
            for _ in 0..RANDOM {
                heights.push(self.random.between(0.0, highest));
            }
            for k in 0..NEAR {
                let near = 0.05 * 0.5_f64.powi(k as i32);
                heights.push((spot.y + self.random.between(-near, near)).clamp(0.0, highest));
            }
            heights.push(spot.y.min(highest));
            let tried = heights.len();
            for &y in &heights {
                strip.blocks(turned, y, others().map(|j| (&self.spots[j], weights[j])), &mut self.blocks);
                if let Some((x, cost)) = cheapest(&self.blocks, most, best.0) {
                    best = (cost, Spot { turned, x, y });
                    if cost == 0.0 {
                        break;
                    }
                }
            }
            self.heights = heights;
            self.work = self.work.saturating_sub((tried * count) as u64);
        }
        self.spots[i] = best.1;
    }
}
