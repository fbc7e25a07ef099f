//! Closed polygons in a plane; the last point is joined to the first and does not repeat it.

use glam::DVec2;

/// The sides in order, each from its point to the next.
pub fn sides(polygon: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> {
    (0..polygon.len()).map(|i| [polygon[i], polygon[(i + 1) % polygon.len()]])
}

/// Signed area; positive when the polygon runs counter-clockwise.
pub fn signed_area(polygon: &[DVec2]) -> f64 {
    sides(polygon).map(|[a, b]| a.perp_dot(b) / 2.0).sum()
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
}
