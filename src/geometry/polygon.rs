//! Closed polygons in a plane; the last point is joined to the first and does not repeat it.

use glam::DVec2;

use crate::geometry::bvh::{Aabb, Bvh};

/// The sides in order, each from its point to the next.
pub fn sides(polygon: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> {
    (0..polygon.len()).map(|i| [polygon[i], polygon[(i + 1) % polygon.len()]])
}

/// Signed area; positive when the polygon runs counter-clockwise.
pub fn signed_area(polygon: &[DVec2]) -> f64 {
    sides(polygon).map(|[a, b]| a.perp_dot(b) / 2.0).sum()
}

/// Centroid of the area inside the polygon; None where that is nothing.
pub fn centroid(polygon: &[DVec2]) -> Option<DVec2> {
    let (sum, area) = sides(polygon).fold((DVec2::ZERO, 0.0), |(sum, area), [a, b]| {
        let twice = a.perp_dot(b);
        (sum + (a + b) * (twice / 3.0), area + twice)
    });
    (area.abs() > 1e-12).then(|| sum / area)
}

/// Whether `p` lies inside the polygon, by the even-odd rule.
pub fn contains(polygon: &[DVec2], p: DVec2) -> bool {
    is_inside(sides(polygon), p)
}

/// Whether `p` lies inside the region bounded by all of `sides` together, by the even-odd rule: not inside its holes.
pub fn is_inside(sides: impl Iterator<Item = [DVec2; 2]>, p: DVec2) -> bool {
    let passed = |&[a, b]: &[DVec2; 2]| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    sides.filter(passed).count() % 2 == 1
}

/// Distance of `p` from the segment from `a` to `b`.
pub fn distance_to_segment(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let ab = b - a;
    let t = ((p - a).dot(ab) / ab.length_squared().max(1e-300)).clamp(0.0, 1.0);
    (p - a - ab * t).length()
}

/// The first two of `segments` that meet, apart from those that `are_neighbours`: the lowest first, and of those that it meets the
/// lowest.
pub fn first_crossing(
    segments: &[[DVec2; 2]],
    are_neighbours: impl Fn(usize, usize) -> bool,
) -> Option<(usize, usize)> {
    let around = |[a, b]: &[DVec2; 2]| Aabb::around(&[a.extend(0.0), b.extend(0.0)]);
    let boxes: Vec<Aabb> = segments.iter().map(around).collect();
    let tree = Bvh::new(&boxes);
    (0..boxes.len()).find_map(|i| {
        let mut first: Option<usize> = None;
        tree.near(&boxes[i], |j| {
            let j = j as usize;
            let is_nearer = j > i && first.is_none_or(|first| j < first);
            if is_nearer && !are_neighbours(i, j) && segments_meet(segments[i], segments[j]) {
                first = Some(j);
            }
        });
        first.map(|j| (i, j))
    })
}

fn segments_meet([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let side = |p: DVec2, q: DVec2, r: DVec2| robust_orientation(p, q, r);
    let (o1, o2, o3, o4) = (side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b));
    if o1 * o2 < 0.0 && o3 * o4 < 0.0 {
        return true;
    }
    let on = |p: DVec2, q: DVec2, r: DVec2| r.cmpge(p.min(q)).all() && r.cmple(p.max(q)).all();
    (o1 == 0.0 && on(a, b, c))
        || (o2 == 0.0 && on(a, b, d))
        || (o3 == 0.0 && on(c, d, a))
        || (o4 == 0.0 && on(c, d, b))
}

fn robust_orientation(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    // Values below the accuracy of curve sampling are rounded to zero.
    let o = (b - a).perp_dot(c - a);
    if o.abs() < 1e-16 { 0.0 } else { o }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hole_is_outside() {
        let square = |r: f64| [(-r, -r), (r, -r), (r, r), (-r, r)].map(DVec2::from);
        let (outer, inner) = (square(2.0), square(1.0));
        assert_eq!((signed_area(&outer), contains(&outer, DVec2::ZERO)), (16.0, true));
        let ring = || sides(&outer).chain(sides(&inner));
        assert!(!is_inside(ring(), DVec2::ZERO) && is_inside(ring(), DVec2::new(1.5, 0.3)));
    }

    #[test]
    fn the_first_crossing_is_that_of_all_pairs() {
        let mut state = 7u64;
        let mut chance = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as f64 / f64::from(1u32 << 31)
        };
        let crossing = |points: &[DVec2]| {
            let (segments, count) = (sides(points).collect::<Vec<_>>(), points.len());
            let are_neighbours = move |i: usize, j: usize| (i + 1) % count == j || (j + 1) % count == i;
            (first_crossing(&segments, are_neighbours), segments, are_neighbours)
        };
        let mut clean = 0;
        for round in 0..300 {
            let count = 4 + round % 30;
            let points = (0..count).map(|k| {
                let angle = std::f64::consts::TAU * k as f64 / count as f64;
                // Rough ones cross, fine ones do not.
                DVec2::from_angle(angle) + DVec2::new(chance(), chance()) * (0.006 * f64::from(round as u32))
            });
            let (found, segments, are_neighbours) = crossing(&points.collect::<Vec<_>>());
            let meet = |i: usize, j: usize| {
                j > i && !are_neighbours(i, j) && segments_meet(segments[i], segments[j])
            };
            let pairs = (0..count).flat_map(|i| (0..count).map(move |j| (i, j)));
            let first = pairs.into_iter().find(|&(i, j)| meet(i, j));
            assert_eq!(found, first, "round {round}");
            clean += usize::from(first.is_none());
        }
        assert!((50..250).contains(&clean), "{clean} of 300 do not cross");
        // What runs to and fro over itself meets at once.
        let to_and_fro: Vec<DVec2> = (0..50_000).map(|k| DVec2::new(f64::from(k % 2), 0.0)).collect();
        assert_eq!(crossing(&to_and_fro).0, Some((0, 2)));
    }
}
