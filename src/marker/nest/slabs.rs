//! Outlines cut into slabs: horizontal bands in which each part of the inside is a trapezoid.

use glam::DVec2;

use crate::geometry::polygon::sides;

/// Most that simplification moves a side outward, metres.
const SIMPLE: f64 = 2e-4;
/// Bands lower than this are left out, metres.
const THIN: f64 = 1e-7;
/// Bands of a grown outline are at most this high before they are simplified, metres: what they cover beyond it is less.
const BAND: f64 = 4e-3;
/// Most bands that are simplified into one.
const RUN: usize = 64;
/// The tangent of an eighth of half a turn: half the side of an octagon whose inner circle has radius 1.
const OCTAGON: f64 = 0.414_213_562_373_095_03;

/// A trapezoid with its two parallel sides horizontal: left and right ends at its lower and upper side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trapezoid {
    /// Left ends, lower and upper.
    pub left: [f64; 2],
    /// Right ends, lower and upper.
    pub right: [f64; 2],
}

/// A band of an outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Lower and upper height.
    pub y: [f64; 2],
    /// What of the inside lies in it, from left to right.
    pub inside: Vec<Trapezoid>,
}

/// An outline as bands from below to above. They cover all of it, and beyond it no more than [`SIMPLE`].
#[derive(Clone, Debug, Default)]
pub struct Slabs {
    pub bands: Vec<Band>,
}

impl Slabs {
    /// The slabs of a polygon that does not cross itself.
    pub fn new(polygon: &[DVec2]) -> Self {
        Self::simplified(bands(heights(polygon, &[0.0]), |y| own(polygon, y)))
    }

    /// The slabs of the points within `reach` of a polygon, or a little further: within an octagon round the circle.
    pub fn grown(polygon: &[DVec2], reach: f64) -> Self {
        if reach <= 0.0 {
            return Self::new(polygon);
        }
        let corner = reach * OCTAGON;
        let heights = heights(polygon, &[-reach, -corner, 0.0, corner, reach]);
        let swept: Vec<Vec<DVec2>> = sides(polygon).map(|side| swept(side, reach)).collect();
        let inside = |y: [f64; 2]| {
            let mut all = own(polygon, y);
            all.extend(swept.iter().filter_map(|convex| of_convex(convex, y)));
            joined(all)
        };
        Self::simplified(bands(finer(&heights), inside))
    }

    /// Lower and upper end.
    pub fn ends(&self) -> [f64; 2] {
        let lower = self.bands.first().map_or(0.0, |band| band.y[0]);
        [lower, self.bands.last().map_or(0.0, |band| band.y[1])]
    }

    fn simplified(bands: Vec<Band>) -> Self {
        let mut simple: Vec<Band> = Vec::new();
        let mut run: Vec<Band> = Vec::new();
        let mut whole: Option<Band> = None;
        for band in bands {
            run.push(band);
            match one_of(&run) {
                Some(one) if run.len() <= RUN => whole = Some(one),
                _ => {
                    simple.extend(whole.take());
                    run.drain(..run.len() - 1);
                    whole = run.last().cloned();
                }
            }
        }
        simple.extend(whole);
        Self { bands: simple }
    }
}

/// The heights of all corners of `polygon`, moved by each of `by`, ascending and apart.
fn heights(polygon: &[DVec2], by: &[f64]) -> Vec<f64> {
    let mut all: Vec<f64> = polygon.iter().flat_map(|p| by.iter().map(|by| p.y + by)).collect();
    all.sort_by(f64::total_cmp);
    // The highest is kept, so that the bands cover everything.
    let mut apart: Vec<f64> = Vec::new();
    for y in all {
        match apart.last() {
            Some(last) if y - last <= THIN && apart.len() > 1 => drop(apart.pop()),
            Some(last) if y - last <= THIN => continue,
            _ => {}
        }
        apart.push(y);
    }
    apart
}

/// The same heights, and more where they are further apart than [`BAND`].
fn finer(heights: &[f64]) -> Vec<f64> {
    let mut all = Vec::new();
    for pair in heights.windows(2) {
        let count = ((pair[1] - pair[0]) / BAND).ceil().max(1.0);
        all.extend((0..count as usize).map(|k| pair[0] + (pair[1] - pair[0]) * k as f64 / count));
    }
    all.extend(heights.last());
    all
}

fn bands(heights: Vec<f64>, inside: impl Fn([f64; 2]) -> Vec<Trapezoid>) -> Vec<Band> {
    let between = heights.windows(2).map(|y| [y[0], y[1]]);
    between.map(|y| Band { y, inside: inside(y) }).filter(|band| !band.inside.is_empty()).collect()
}

/// The inside of a polygon between two heights that have no corner between them: all that it runs round, in either direction, as
/// cutting lines of narrow bays may cross themselves.
fn own(polygon: &[DVec2], y: [f64; 2]) -> Vec<Trapezoid> {
    let middle = (y[0] + y[1]) / 2.0;
    let through = sides(polygon).filter(|[a, b]| (a.y > middle) != (b.y > middle));
    let mut lines: Vec<(f64, [f64; 2], i32)> = through
        .map(|[a, b]| {
            let at = |y: f64| a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0);
            (at(middle), y.map(at), if b.y > a.y { 1 } else { -1 })
        })
        .collect();
    lines.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut inside, mut rounds, mut left) = (Vec::new(), 0, [0.0; 2]);
    for (_, ends, way) in lines {
        if rounds == 0 {
            left = ends;
        }
        rounds += way;
        if rounds == 0 {
            inside.push(Trapezoid { left, right: ends });
        }
    }
    inside
}

/// The convex polygon that an octagon whose inner circle has radius `reach` passes over on its way along a side.
fn swept([a, b]: [DVec2; 2], reach: f64) -> Vec<DVec2> {
    let corner = reach * OCTAGON;
    let octagon = [
        (reach, -corner),
        (reach, corner),
        (corner, reach),
        (-corner, reach),
        (-reach, corner),
        (-reach, -corner),
        (-corner, -reach),
        (corner, -reach),
    ]
    .map(DVec2::from);
    hull(octagon.iter().flat_map(|&p| [a + p, b + p]).collect())
}

/// The convex hull, counter-clockwise (Andrew's monotone chains).
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let chain = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for p in points {
            while chain.len() > 1 {
                let (a, b) = (chain[chain.len() - 2], chain[chain.len() - 1]);
                if (b - a).perp_dot(p - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = chain(&mut points.iter().copied());
    lower.extend(chain(&mut points.iter().rev().copied()));
    lower
}

/// What a convex polygon covers between two heights that have no corner of it between them; None where it does not reach there.
fn of_convex(convex: &[DVec2], y: [f64; 2]) -> Option<Trapezoid> {
    own(convex, y).into_iter().next()
}

/// Trapezoids of one band, those that touch joined into one that covers them: its sides are chords of the least left and the
/// greatest right ends, which those never pass.
fn joined(mut all: Vec<Trapezoid>) -> Vec<Trapezoid> {
    let middle = |ends: [f64; 2]| ends[0] + ends[1];
    loop {
        all.sort_by(|a, b| middle(a.left).total_cmp(&middle(b.left)));
        let before = all.len();
        let mut fewer: Vec<Trapezoid> = Vec::new();
        for next in all {
            let touches = |last: &Trapezoid| {
                (0..2).any(|k| last.right[k] >= next.left[k] && next.right[k] >= last.left[k])
            };
            match fewer.iter_mut().find(|last| touches(last)) {
                Some(last) => {
                    for k in 0..2 {
                        last.left[k] = last.left[k].min(next.left[k]);
                        last.right[k] = last.right[k].max(next.right[k]);
                    }
                }
                None => fewer.push(next),
            }
        }
        if fewer.len() == before {
            return fewer;
        }
        all = fewer;
    }
}

/// One band in place of several on each other; None where it would cover too much.
fn one_of(run: &[Band]) -> Option<Band> {
    let (first, last) = (run.first()?, run.last()?);
    let count = first.inside.len();
    let is_stack = |pair: &[Band]| (pair[1].y[0] - pair[0].y[1]).abs() <= 2.0 * THIN;
    if run.iter().any(|band| band.inside.len() != count) || !run.windows(2).all(is_stack) {
        return None;
    }
    let y = [first.y[0], last.y[1]];
    let mut inside = Vec::with_capacity(count);
    for i in 0..count {
        let side = |of: fn(&Trapezoid) -> [f64; 2], sign: f64| {
            let ends = [of(&first.inside[i])[0], of(&last.inside[i])[1]];
            let mut out = 0.0_f64;
            for band in run {
                for k in 0..2 {
                    let chord = ends[0] + (ends[1] - ends[0]) * ((band.y[k] - y[0]) / (y[1] - y[0]));
                    let beyond = (of(&band.inside[i])[k] - chord) * sign;
                    if beyond.abs() > SIMPLE {
                        return None;
                    }
                    out = out.max(beyond);
                }
            }
            Some(ends.map(|x| x + out * sign))
        };
        inside.push(Trapezoid { left: side(|t| t.left, -1.0)?, right: side(|t| t.right, 1.0)? });
    }
    Some(Band { y, inside })
}
