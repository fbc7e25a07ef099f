//! How far one outline has to be from another: the distances along x that are forbidden at a given distance along y.

use std::sync::OnceLock;

use super::slabs::{Slabs, Trapezoid};

/// Contact: outlines may be in each other by this much, metres, so that rounding is no collision.
pub const CONTACT: f64 = 1e-9;
/// Distance of the heights at which forbidden distances are tabulated, metres.
const STEP: f64 = 2.5e-3;
/// Most heights of a table.
const MOST_ROWS: usize = 800;

/// One way in which a shape may lie, with its lower left corner at the origin.
#[derive(Clone, Debug, Default)]
pub struct Turned {
    /// Its own outline.
    pub own: Slabs,
    /// Its outline grown by the gap.
    pub grown: Slabs,
    /// Width and height of its own outline.
    pub size: [f64; 2],
}

/// Where the second of two outlines may not be, seen from the first, both at a fixed difference of heights: open intervals of
/// the difference in x, ascending, apart.
pub fn forbidden(fixed: &Slabs, moving: &Slabs, by: f64, found: &mut Vec<[f64; 2]>) {
    found.clear();
    let (mut i, mut j) = (0, 0);
    while let (Some(one), Some(other)) = (fixed.bands.get(i), moving.bands.get(j)) {
        let range = [one.y[0].max(other.y[0] + by), one.y[1].min(other.y[1] + by)];
        if range[1] - range[0] > CONTACT {
            for a in &one.inside {
                for b in &other.inside {
                    found.push(between(one.y, a, [other.y[0] + by, other.y[1] + by], b, range));
                }
            }
        }
        if one.y[1] < other.y[1] + by { i += 1 } else { j += 1 }
    }
    union(found);
}

/// Joins intervals that overlap.
fn union(all: &mut Vec<[f64; 2]>) {
    all.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    let mut kept = 0;
    for k in 0..all.len() {
        if kept > 0 && all[k][0] < all[kept - 1][1] - CONTACT {
            all[kept - 1][1] = all[kept - 1][1].max(all[k][1]);
        } else {
            all[kept] = all[k];
            kept += 1;
        }
    }
    all.truncate(kept);
}

/// The differences in x at which two trapezoids overlap within a range of heights.
fn between(of_a: [f64; 2], a: &Trapezoid, of_b: [f64; 2], b: &Trapezoid, range: [f64; 2]) -> [f64; 2] {
    let at = |of: [f64; 2], ends: [f64; 2], y: f64| {
        ends[0] + (ends[1] - ends[0]) * ((y - of[0]) / (of[1] - of[0]))
    };
    let low = range.map(|y| at(of_a, a.left, y) - at(of_b, b.right, y));
    let high = range.map(|y| at(of_a, a.right, y) - at(of_b, b.left, y));
    [low[0].min(low[1]), high[0].max(high[1])]
}

/// The forbidden distances of one pair of outlines, tabulated: between two heights they are interpolated, which may be wrong by a
/// part of a millimetre where the outlines have corners.
#[derive(Debug)]
pub struct Table {
    /// Range of the difference in y outside which nothing is forbidden.
    pub range: [f64; 2],
    rows: f64,
    first: Vec<u32>,
    inside: Vec<Trapezoid>,
}

impl Table {
    fn new(fixed: &Turned, moving: &Turned) -> Self {
        let ([low, high], [own_low, own_high]) = (fixed.grown.ends(), moving.own.ends());
        let range = [low - own_high, high - own_low];
        let count = (((range[1] - range[0]) / STEP).ceil() as usize).clamp(1, MOST_ROWS);
        let at = |k: usize| {
            // At the ends themselves the outlines only touch.
            let by = range[0] + (range[1] - range[0]) * k as f64 / count as f64;
            let mut found = Vec::new();
            let inner = [range[0] + 1e-6, range[1] - 1e-6];
            forbidden(&fixed.grown, &moving.own, by.max(inner[0]).min(inner[1]), &mut found);
            found
        };
        let (mut first, mut inside) = (vec![0], Vec::new());
        let mut below = at(0);
        for k in 0..count {
            let above = at(k + 1);
            inside.extend(row(&below, &above));
            first.push(inside.len() as u32);
            below = above;
        }
        Self { range, rows: count as f64, first, inside }
    }

    /// What is forbidden at the difference `by` in y, which is inside the range: intervals of the difference in x.
    pub fn at(&self, by: f64) -> impl Iterator<Item = [f64; 2]> + '_ {
        let row = (by - self.range[0]) / (self.range[1] - self.range[0]) * self.rows;
        let k = (row as usize).min(self.first.len() - 2);
        let share = row - k as f64;
        let own = &self.inside[self.first[k] as usize..self.first[k + 1] as usize];
        let at = move |ends: [f64; 2]| ends[0] + (ends[1] - ends[0]) * share;
        own.iter().map(move |t| [at(t.left), at(t.right)])
    }
}

/// Trapezoids between the intervals of two heights: where they do not answer one to one, what covers both.
fn row(below: &[[f64; 2]], above: &[[f64; 2]]) -> Vec<Trapezoid> {
    let answers = |(a, b): (&[f64; 2], &[f64; 2])| a[0] < b[1] && b[0] < a[1];
    if below.len() == above.len() && below.iter().zip(above).all(answers) {
        let pairs = below.iter().zip(above);
        return pairs.map(|(a, b)| Trapezoid { left: [a[0], b[0]], right: [a[1], b[1]] }).collect();
    }
    let mut all: Vec<[f64; 2]> = below.iter().chain(above).copied().collect();
    union(&mut all);
    all.into_iter().map(|[a, b]| Trapezoid { left: [a, a], right: [b, b] }).collect()
}

/// The tables of all pairs of turned shapes, each made when it is first asked for.
#[derive(Debug)]
pub struct Tables<'a> {
    turned: &'a [Turned],
    tables: Vec<OnceLock<Table>>,
}

impl<'a> Tables<'a> {
    pub fn new(turned: &'a [Turned]) -> Self {
        let count = turned.len() * turned.len();
        Self { turned, tables: std::iter::repeat_with(OnceLock::new).take(count).collect() }
    }

    /// The table of shape `moving` seen from shape `fixed`, by their numbers.
    pub fn of(&self, fixed: usize, moving: usize) -> &Table {
        let table = &self.tables[fixed * self.turned.len() + moving];
        table.get_or_init(|| Table::new(&self.turned[fixed], &self.turned[moving]))
    }
}
