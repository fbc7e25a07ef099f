//! Triangulates polygons in space. It is our own, as it must accept any polygon, also one that is not flat or crosses itself,
//! within a budget of work.

use glam::{DVec2, DVec3};

/// The triangulation of a polygon.
pub(super) struct Cut {
    /// Triangles as indices into the polygon's list of corners, with its orientation.
    pub triangles: Vec<[usize; 3]>,
    /// Whether the polygon is not convex, so that a fan from its first corner would not do.
    pub concave: bool,
}

/// Triangulates a polygon of three or more corners: as a fan when it is convex, else by ear clipping in the plane of its mean
/// (Newell) normal. `budget` is the number of corner tests that are left; None when it runs out.
pub(super) fn triangles(points: &[DVec3], budget: &mut usize) -> Option<Cut> {
    let flat = in_own_plane(points);
    let n = flat.len();
    let scale = flat.iter().map(|p| p.length_squared()).fold(0.0, f64::max);
    let convex = (0..n).all(|i| turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) >= -1e-9 * scale);
    if convex {
        return Some(Cut { triangles: (1..n - 1).map(|k| [0, k, k + 1]).collect(), concave: false });
    }
    Some(Cut { triangles: ears(&flat, budget)?, concave: true })
}

/// Corners projected along the mean normal, about their centre; the polygon then runs counter-clockwise.
fn in_own_plane(points: &[DVec3]) -> Vec<DVec2> {
    let n = points.len();
    let centre = points.iter().sum::<DVec3>() / n as f64;
    let normal: DVec3 = (0..n).map(|i| (points[i] - centre).cross(points[(i + 1) % n] - centre)).sum();
    let normal = normal.try_normalize().unwrap_or(DVec3::Z);
    let u = normal.any_orthonormal_vector();
    let v = normal.cross(u);
    points.iter().map(|&p| DVec2::new((p - centre).dot(u), (p - centre).dot(v))).collect()
}

/// Twice the signed area of `abc`.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Ear clipping (Meisters 1975), with at most n² tests of n corners. Where no ear is left, as in a polygon that crosses itself,
/// the sharpest convex corner is cut off.
fn ears(points: &[DVec2], budget: &mut usize) -> Option<Vec<[usize; 3]>> {
    let mut left: Vec<usize> = (0..points.len()).collect();
    let mut triangles = Vec::with_capacity(points.len() - 2);
    while left.len() > 3 {
        let n = left.len();
        let corner = |i: usize| [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
        let ear = (0..n).find(|&i| is_ear(points, &left, corner(i)));
        *budget = budget.checked_sub(n * (ear.unwrap_or(n) + 1))?;
        let ear = ear.unwrap_or_else(|| {
            let area = |i: usize| turn_of(points, corner(i));
            (0..n).max_by(|&i, &j| area(i).total_cmp(&area(j))).unwrap_or(0)
        });
        triangles.push(corner(ear));
        left.remove(ear);
    }
    triangles.push([left[0], left[1], left[2]]);
    Some(triangles)
}

fn turn_of(points: &[DVec2], [a, b, c]: [usize; 3]) -> f64 {
    turn(points[a], points[b], points[c])
}

fn is_ear(points: &[DVec2], left: &[usize], [a, b, c]: [usize; 3]) -> bool {
    if turn_of(points, [a, b, c]) <= 0.0 {
        return false;
    }
    left.iter().filter(|&&k| k != a && k != b && k != c).all(|&k| {
        let inside = [[a, b, k], [b, c, k], [c, a, k]].iter().all(|&t| turn_of(points, t) >= 0.0);
        !inside
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn areas(points: &[DVec3], cut: &Cut) -> Vec<f64> {
        cut.triangles
            .iter()
            .map(|&[a, b, c]| (points[b] - points[a]).cross(points[c] - points[a]).z / 2.0)
            .collect()
    }

    fn cut(points: &[DVec3]) -> Cut {
        triangles(points, &mut 10_000).expect("within the budget")
    }

    #[test]
    fn the_budget_ends() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::new(0.1, 0.1, 0.0), DVec3::Y];
        assert!(cut(&points).concave);
        assert!(triangles(&points, &mut 3).is_none());
    }

    #[test]
    fn a_square_is_a_fan() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
        let cut = cut(&points);
        assert!(!cut.concave);
        assert_eq!(cut.triangles, [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn a_comb_is_cut_by_ears() {
        let mut points = vec![DVec3::new(0.0, -1.0, 0.0), DVec3::new(8.0, -1.0, 0.0)];
        points
            .extend((0..=8).rev().map(|k| DVec3::new(f64::from(k), if k % 2 == 0 { 2.0 } else { 0.0 }, 0.0)));
        let cut = cut(&points);
        assert!(cut.concave);
        let areas = areas(&points, &cut);
        assert_eq!(areas.len(), points.len() - 2);
        assert!(areas.iter().all(|&a| a > 0.0), "{areas:?}");
        assert!((areas.iter().sum::<f64>() - 16.0).abs() < 1e-12);
    }

    #[test]
    fn a_star_that_crosses_itself_ends() {
        let points: Vec<DVec3> =
            (0..5).map(|k| DVec2::from_angle(f64::from(k * 2) * 1.2566).extend(0.0)).collect();
        assert_eq!(cut(&points).triangles.len(), 3);
    }
}
