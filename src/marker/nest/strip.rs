//! A strip of cloth with parts on it: where a part is free, and by how much it lies in others.

use super::apart::{CONTACT, Table, Tables, Turned, forbidden};
use super::watch::Watch;

/// Where a part lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Number of its turned shape.
    pub turned: usize,
    /// Its lower left corner: x along the strip, y across it, metres.
    pub x: f64,
    pub y: f64,
}

/// What is laid out, and on what.
#[derive(Debug)]
pub struct Strip<'a> {
    /// Width of the cloth, metres.
    pub width: f64,
    /// Of each part the numbers of the turned shapes that it may have.
    pub parts: Vec<Vec<usize>>,
    pub turned: &'a [Turned],
    pub tables: Tables<'a>,
    /// Progress, and the wish to stop.
    pub watch: &'a Watch,
}

/// An interval of x that another part forbids at a height.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    pub from: f64,
    pub to: f64,
    /// What a metre of overlap costs.
    pub weight: f64,
    /// The way out across the strip, metres.
    pub across: f64,
}

impl Strip<'_> {
    /// Length that `spots` take.
    pub fn length(&self, spots: &[Spot]) -> f64 {
        spots.iter().map(|spot| spot.x + self.turned[spot.turned].size[0]).fold(0.0, f64::max)
    }

    /// The highest y at which a turned shape is on the cloth.
    pub fn highest(&self, turned: usize) -> f64 {
        (self.width - self.turned[turned].size[1]).max(0.0)
    }

    /// By how much a part at `spot` lies in one at `other`, by the shorter way out along or across the strip, metres.
    pub fn overlap(&self, spot: &Spot, other: &Spot) -> f64 {
        let table = self.tables.of(other.turned, spot.turned);
        let (dx, dy) = (spot.x - other.x, spot.y - other.y);
        let Some(across) = across(table, dy) else { return 0.0 };
        let inside = table.at(dy).map(|[a, b]| (dx - a).min(b - dx)).fold(0.0, f64::max);
        let deep = inside.min(across);
        if deep > CONTACT { deep } else { 0.0 }
    }

    /// What the parts at `others` forbid to `turned` at height `y`.
    pub fn blocks<'b>(
        &self,
        turned: usize,
        y: f64,
        others: impl Iterator<Item = (&'b Spot, f64)>,
        found: &mut Vec<Block>,
    ) {
        found.clear();
        for (other, weight) in others {
            let table = self.tables.of(other.turned, turned);
            let by = y - other.y;
            if let Some(across) = across(table, by) {
                let here = table.at(by);
                found.extend(here.map(|[a, b]| Block { from: a + other.x, to: b + other.x, weight, across }));
            }
        }
    }

    /// Heights at which `turned` touches the cloth's borders or one of `others` above or below it.
    pub fn contacts<'b>(&self, turned: usize, others: impl Iterator<Item = &'b Spot>, found: &mut Vec<f64>) {
        let highest = self.highest(turned);
        found.extend([0.0, highest]);
        for other in others {
            let range = self.tables.of(other.turned, turned).range;
            found.extend(range.map(|by| other.y + by).into_iter().filter(|y| (0.0..=highest).contains(y)));
        }
    }

    /// Sets the parts apart for certain, by outlines instead of tables: from left to right each goes as far left as it can at its
    /// own height.
    pub fn settled(&self, spots: &[Spot]) -> Vec<Spot> {
        let mut order: Vec<usize> = (0..spots.len()).collect();
        order.sort_by(|&i, &j| spots[i].x.total_cmp(&spots[j].x).then(i.cmp(&j)));
        let mut settled: Vec<Spot> = Vec::with_capacity(spots.len());
        let (mut ranges, mut blocks) = (Vec::new(), Vec::new());
        for &i in &order {
            let spot = spots[i];
            blocks.clear();
            for other in &settled {
                let [fixed, moving] = [&self.turned[other.turned].grown, &self.turned[spot.turned].own];
                forbidden(fixed, moving, spot.y - other.y, &mut ranges);
                let block = |&[a, b]: &[f64; 2]| Block {
                    from: a + other.x,
                    to: b + other.x,
                    weight: 1.0,
                    across: 1.0,
                };
                blocks.extend(ranges.iter().map(block));
            }
            settled.push(Spot { x: leftmost(&mut blocks), ..spot });
        }
        let mut back = spots.to_vec();
        for (k, &i) in order.iter().enumerate() {
            back[i] = settled[k];
        }
        back
    }
}

/// The way out across the strip at a difference in y; None where nothing is forbidden.
fn across(table: &Table, by: f64) -> Option<f64> {
    let way = (by - table.range[0]).min(table.range[1] - by);
    (way > CONTACT).then_some(way)
}

/// The least x from 0 that no block forbids.
pub fn leftmost(blocks: &mut [Block]) -> f64 {
    blocks.sort_unstable_by(|a, b| a.from.total_cmp(&b.from));
    let mut x = 0.0;
    for block in blocks {
        if block.from >= x - CONTACT {
            break;
        }
        if block.to > x + CONTACT {
            x = block.to;
        }
    }
    x
}

/// The x of 0..=`most` where blocks cost least, and that cost; only one cheaper than `below` counts.
pub fn cheapest(blocks: &[Block], most: f64, below: f64) -> Option<(f64, f64)> {
    let mut best: Option<(f64, f64)> = None;
    let ends = blocks.iter().flat_map(|block| [block.to, block.from]);
    for x in [0.0, most].into_iter().chain(ends) {
        if !(0.0..=most).contains(&x) {
            continue;
        }
        let limit = best.map_or(below, |best| best.1);
        let mut cost = 0.0;
        for block in blocks {
            let deep = (x - block.from).min(block.to - x).min(block.across);
            if deep > CONTACT {
                cost += deep * block.weight;
                if cost >= limit {
                    break;
                }
            }
        }
        if cost < limit || (cost == 0.0 && best.is_some_and(|best| best.1 == 0.0 && x < best.0)) {
            best = Some((x, cost));
        }
    }
    best
}
