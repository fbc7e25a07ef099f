//! Nesting: outlines laid out on a strip of a given width, as short as can be found, with a gap between all of them.
//!
//! | file | holds |
//! | --- | --- |
//! | `slabs` | an outline as trapezoids between heights, also grown by the gap |
//! | `apart` | where a second outline may not be, seen from a first: intervals along the strip, exact at any height; tables of them |
//! | `strip` | a layout, its overlaps, free places at a height |
//! | `fill` | bottom-left fill |
//! | `squeeze` | shorter strips by guided local search |
//! | `shelves` | bounding boxes in columns: the plain way, which a layout is never worse than |
//! | `watch` | progress, and the wish to stop |
//! | `check` | whether outlines lie apart, by their sides alone: what is handed out is checked by it |
//!
//! What may be spent is counted in looks at pairs of parts, not timed: the same input gives the same layout on any machine.

mod apart;
pub mod check;
mod fill;
mod shelves;
mod slabs;
mod squeeze;
mod strip;
mod watch;

pub use watch::Watch;

use glam::DVec2;
use rayon::prelude::*;

use crate::geometry::polygon::signed_area;
use crate::geometry::random::Random;
use apart::{Tables, Turned};
use slabs::Slabs;
use squeeze::Squeeze;
use strip::{Spot, Strip};

/// Searches that are made beside each other, each from its own random numbers.
const SEARCHES: u64 = 4;
/// Looks at pairs of parts that a usual processor core makes in a second.
const LOOKS_PER_SECOND: f64 = 1.2e7;

/// What is laid out: x runs along the strip, y across it, metres.
#[derive(Clone, Debug, Default)]
pub struct Nesting {
    /// Width of the strip.
    pub width: f64,
    /// Least distance between any two parts.
    pub gap: f64,
    /// Of each shape the outlines it may have, one for each way in which it may be turned: closed polygons that do not cross
    /// themselves.
    pub shapes: Vec<Vec<Vec<DVec2>>>,
    /// Number of the shape of each part.
    pub parts: Vec<usize>,
}

/// How much a search may spend, and from which random numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// What a usual processor with two cores does in this many seconds. It is counted, not timed.
    pub seconds: f64,
    pub seed: u64,
}

/// Where a part is laid: the outline of its shape with number `turn`, moved by `by`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    pub turn: usize,
    pub by: DVec2,
}

/// A layout.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// Of each part.
    pub places: Vec<Place>,
    /// Length of the strip that is used.
    pub length: f64,
    /// Length that bounding boxes in columns would take: the plain way.
    pub plain_length: f64,
}

/// Why there is no layout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoLayout {
    /// The first shape that is wider than the strip in every way it may be turned, and the width it needs, metres.
    TooWide { shape: usize, needs: f64 },
    /// It was stopped.
    Stopped,
}

/// The shortest layout that is found. `watch` tells of its progress and may stop it.
///
/// # Errors
/// A shape that is too wide, or a stop.
pub fn nest(nesting: &Nesting, effort: Effort, watch: &Watch) -> Result<Layout, NoLayout> {
    let (turned, numbers) = turned(nesting)?;
    let parts = nesting.parts.iter().map(|&shape| numbers[shape].iter().map(|n| n.0).collect()).collect();
    let strip = Strip { width: nesting.width, parts, turned: &turned, tables: Tables::new(&turned), watch };
    let area: f64 = nesting.parts.iter().map(|&shape| signed_area(&nesting.shapes[shape][0]).abs()).sum();
    let longest = |part: &Vec<usize>| part.iter().map(|&n| turned[n].size[0]).fold(f64::INFINITY, f64::min);
    let least = strip.parts.iter().map(longest).fold(area / nesting.width, f64::max);
    let shelves = shelves::shelves(nesting, &numbers);
    let plain_length = strip.length(&shelves);
    let start = first(&strip, shelves);
    let work = (effort.seconds.max(0.0) * 2.0 * LOOKS_PER_SECOND) as u64 / SEARCHES;
    watch.begin(work * SEARCHES);
    let searches: Vec<u64> = (0..SEARCHES).collect();
    let found: Vec<Vec<Spot>> = searches
        .par_iter()
        .map(|&k| Squeeze::new(&strip, Random::stream(effort.seed, k), work).shortest(start.clone(), least))
        .collect();
    if watch.is_stopped() {
        return Err(NoLayout::Stopped);
    }
    let best = shorter(&strip, std::iter::once(start).chain(found));
    let place = |spot: &Spot| {
        let (_, turn, lower) =
            numbers.iter().flatten().find(|n| n.0 == spot.turned).copied().unwrap_or_default();
        Place { turn, by: DVec2::new(spot.x, spot.y) - lower }
    };
    Ok(Layout { length: strip.length(&best), places: best.iter().map(place).collect(), plain_length })
}

/// A way to turn a shape: its number among all, its number among those of its shape, and the lower left corner of its outline.
type Numbered = (usize, usize, DVec2);

/// All shapes in all ways that fit the strip, and of each shape the numbers of its ways.
fn turned(nesting: &Nesting) -> Result<(Vec<Turned>, Vec<Vec<Numbered>>), NoLayout> {
    let (mut all, mut numbers) = (Vec::new(), Vec::new());
    for (shape, outlines) in nesting.shapes.iter().enumerate() {
        let (mut own, mut needs) = (Vec::new(), f64::INFINITY);
        for (turn, outline) in outlines.iter().enumerate() {
            let lower = outline.iter().copied().reduce(DVec2::min).unwrap_or_default();
            let size = outline.iter().copied().reduce(DVec2::max).unwrap_or_default() - lower;
            needs = needs.min(size.y);
            if size.y <= nesting.width + 1e-9 {
                own.push((all.len(), turn, lower));
                let outline: Vec<DVec2> = outline.iter().map(|p| *p - lower).collect();
                let grown = Slabs::grown(&outline, nesting.gap);
                all.push(Turned { own: Slabs::new(&outline), grown, size: size.to_array() });
            }
        }
        if own.is_empty() {
            return Err(NoLayout::TooWide { shape, needs });
        }
        numbers.push(own);
    }
    Ok((all, numbers))
}

/// The best of some plain layouts: `shelves`, and fills in orders of size.
fn first(strip: &Strip<'_>, shelves: Vec<Spot>) -> Vec<Spot> {
    let size = |part: usize| strip.turned[strip.parts[part][0]].size;
    let keys: [fn([f64; 2]) -> f64; 4] = [|s| s[0], |s| s[1], |s| s[0] * s[1], |s| s[0] + s[1]];
    let fills = keys.map(|key| {
        let mut order: Vec<usize> = (0..strip.parts.len()).collect();
        order.sort_by(|&i, &j| key(size(j)).total_cmp(&key(size(i))).then(i.cmp(&j)));
        strip.settled(&fill::fill(strip, &order, &mut u64::MAX.clone()))
    });
    shorter(strip, std::iter::once(shelves).chain(fills))
}

/// The shortest of layouts; the first of several as short.
fn shorter(strip: &Strip<'_>, layouts: impl Iterator<Item = Vec<Spot>>) -> Vec<Spot> {
    let longer = |a: &Vec<Spot>, b: &Vec<Spot>| strip.length(b) < strip.length(a) - 1e-9;
    layouts.reduce(|best, next| if longer(&best, &next) { next } else { best }).unwrap_or_default()
}

#[cfg(test)]
mod tests;
