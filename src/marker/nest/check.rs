//! Whether outlines lie apart, by their sides and corners alone.

use glam::DVec2;

use crate::geometry::polygon::{contains, distance_to_segment, sides};

/// The least distance between two outlines, metres; 0 where they cross or one lies in the other.
pub fn distance(a: &[DVec2], b: &[DVec2]) -> f64 {
    let inside = |inner: &[DVec2], outer: &[DVec2]| inner.first().is_some_and(|&p| contains(outer, p));
    if sides(a).any(|s| sides(b).any(|t| cross(s, t))) || inside(a, b) || inside(b, a) {
        return 0.0;
    }
    let to_sides = |points: &[DVec2], outline: &[DVec2]| {
        let each =
            points.iter().flat_map(|&p| sides(outline).map(move |[a, b]| distance_to_segment(p, a, b)));
        each.fold(f64::INFINITY, f64::min)
    };
    to_sides(a, b).min(to_sides(b, a))
}

/// Whether two lines cross between their ends.
fn cross(s: [DVec2; 2], t: [DVec2; 2]) -> bool {
    let side = |[a, b]: [DVec2; 2], p: DVec2| (b - a).perp_dot(p - a);
    side(s, t[0]) * side(s, t[1]) < 0.0 && side(t, s[0]) * side(t, s[1]) < 0.0
}

/// Whether two outlines overlap by more than `reach` metres: their sides cross, or one lies in the other. Outlines that only touch
/// do not.
pub fn overlap(a: &[DVec2], b: &[DVec2], reach: f64) -> bool {
    let is_deep = |p: DVec2, outline: &[DVec2]| {
        contains(outline, p) && sides(outline).all(|[a, b]| distance_to_segment(p, a, b) > reach)
    };
    // Corners, and points along the sides between them where those of the other cross: a cross of two bars has no corner inside.
    let deep_point = |points: &[DVec2], outline: &[DVec2]| {
        sides(points).any(|[p, q]| {
            let mut at: Vec<f64> = sides(outline).filter_map(|side| meeting([p, q], side)).collect();
            at.extend([0.0, 1.0]);
            at.sort_by(f64::total_cmp);
            at.windows(2).any(|pair| is_deep(p.lerp(q, (pair[0] + pair[1]) / 2.0), outline))
                || is_deep(p, outline)
        })
    };
    deep_point(a, b) || deep_point(b, a) || is_same(a, b, reach)
}

/// Where on `s`, a share of it, the line through `t` crosses it between the ends of both.
fn meeting(s: [DVec2; 2], t: [DVec2; 2]) -> Option<f64> {
    let (along, other) = (s[1] - s[0], t[1] - t[0]);
    let across = along.perp_dot(other);
    let (u, v) = ((t[0] - s[0]).perp_dot(other) / across, (t[0] - s[0]).perp_dot(along) / across);
    ((0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v)).then_some(u)
}

/// Whether two outlines have the same corners.
fn is_same(a: &[DVec2], b: &[DVec2], reach: f64) -> bool {
    let near = |p: &DVec2| b.iter().any(|q| p.distance(*q) <= reach);
    a.len() == b.len() && a.iter().all(near)
}
