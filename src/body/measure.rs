//! Tape measurements: sections of a mesh, girths that bridge hollows, lengths of a taut string.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::geometry::mesh::TriMesh;

/// A tape round a body: in the plane through `origin` with normal `normal`, round the part of the section that
/// encloses `origin`.
#[derive(Clone, Debug, PartialEq)]
pub struct Tape {
    /// Name of the measurement.
    pub name: &'static str,
    /// A point inside the body, metres.
    pub origin: DVec3,
    /// Normal of the plane, a unit vector.
    pub normal: DVec3,
}

/// Section of a closed, oriented, manifold mesh by the plane through `origin`: closed polylines, the first point not repeated.
pub fn section(mesh: &TriMesh, origin: DVec3, normal: DVec3) -> Vec<Vec<DVec3>> {
    let above: Vec<f64> = mesh.positions.iter().map(|&p| (p - origin).dot(normal)).collect();
    let is_above = |v: u32| above[v as usize] >= 0.0;
    let key = |a: u32, b: u32| [a.min(b), a.max(b)];
    // In every cut triangle the section enters through one edge and leaves through another.
    let mut next: BTreeMap<[u32; 2], [u32; 2]> = BTreeMap::new();
    for t in &mesh.triangles {
        let edge = |up: bool| (0..3).find(|&k| is_above(t[k]) == up && is_above(t[(k + 1) % 3]) != up);
        if let (Some(i), Some(j)) = (edge(true), edge(false)) {
            next.insert(key(t[i], t[(i + 1) % 3]), key(t[j], t[(j + 1) % 3]));
        }
    }
    let point = |[a, b]: [u32; 2]| {
        let (u, v) = (above[a as usize], above[b as usize]);
        mesh.positions[a as usize].lerp(mesh.positions[b as usize], u / (u - v))
    };
    let mut loops = Vec::new();
    while let Some((first, mut edge)) = next.pop_first() {
        let mut points = vec![point(first)];
        while let Some(following) = next.remove(&edge) {
            points.push(point(edge));
            edge = following;
        }
        loops.push(points);
    }
    loops
}

/// Girth: the length of a tape round the part of the mesh that encloses `tape.origin`, metres. None when nothing encloses it.
pub fn girth(mesh: &TriMesh, tape: &Tape) -> Option<f64> {
    let (x, y) = tape.normal.any_orthonormal_pair();
    section(mesh, tape.origin, tape.normal)
        .into_iter()
        .map(|points| {
            points
                .iter()
                .map(|&p| DVec2::new((p - tape.origin).dot(x), (p - tape.origin).dot(y)))
                .collect::<Vec<_>>()
        })
        .filter(|flat| encloses_origin(flat))
        .map(hull_perimeter)
        .min_by(f64::total_cmp)
}

/// Whether a closed polygon in a plane winds round the origin.
pub fn encloses_origin(polygon: &[DVec2]) -> bool {
    let turned: f64 = (0..polygon.len())
        .map(|i| {
            let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
            a.perp_dot(b).atan2(a.dot(b))
        })
        .sum();
    turned.abs() > std::f64::consts::PI
}

/// Perimeter of the convex hull of points in a plane, metres (Andrew's monotone chain).
pub fn hull_perimeter(mut points: Vec<DVec2>) -> f64 {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let lower = taut(points.iter().copied());
    let upper = taut(points.iter().rev().copied());
    length(&lower) + length(&upper)
}

/// A taut string from the first to the last of `points` that keeps them to its right: a half of their convex hull.
/// `points` are sorted along the string.
pub fn taut(points: impl Iterator<Item = DVec2>) -> Vec<DVec2> {
    let mut chain: Vec<DVec2> = Vec::new();
    for p in points {
        while let [.., a, b] = chain[..]
            && (b - a).perp_dot(p - b) <= 0.0
        {
            chain.pop();
        }
        chain.push(p);
    }
    chain
}

/// Length of a polyline, metres.
pub fn length(points: &[DVec2]) -> f64 {
    points.windows(2).map(|w| w[0].distance(w[1])).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tape_bridges_a_hollow() {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.5, 0.3), (0.2, 0.5)];
        let points = square.map(|(x, y)| DVec2::new(x, y)).to_vec();
        assert!((hull_perimeter(points) - 4.0).abs() < 1e-12);
    }

    #[test]
    fn a_cube_is_four_sides_round() {
        let positions = (0..8)
            .map(|i| DVec3::new((i & 1) as f64, ((i >> 1) & 1) as f64, ((i >> 2) & 1) as f64))
            .collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let cube = TriMesh { positions, triangles };
        let tape = |y: f64| Tape { name: "cube", origin: DVec3::new(0.5, y, 0.5), normal: DVec3::Y };
        assert_eq!(section(&cube, DVec3::splat(0.4), DVec3::Y).len(), 1);
        assert!((girth(&cube, &tape(0.4)).expect("enclosed") - 4.0).abs() < 1e-12);
        assert_eq!(girth(&cube, &tape(1.4)), None);
    }
}
