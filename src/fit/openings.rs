//! Openings of a garment: hems, neck, cuffs.

use glam::DVec3;

use crate::geometry::borders::border_loops;
use crate::geometry::bvh::{Aabb, Bvh};
use crate::geometry::crossings::segment_meets_triangle;
use crate::geometry::mesh::TriMesh;

/// A closed border loop of the cloth.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Opening {
    /// Length, metres.
    pub length: f64,
    /// Length on the flat pieces, metres.
    #[serde(default)]
    pub flat_length: f64,
    /// Mean height of its vertices, metres.
    pub height: f64,
    /// Whether the body passes through the opening, which is closed by a fan of triangles from its centroid.
    pub body_through: bool,
    /// Mean of its vertices, metres.
    #[serde(skip)]
    pub middle: DVec3,
}

/// The openings, longest first. `flat` gives the length of an edge on its flat piece, metres. `skin(t)` tells whether triangle `t` of
/// `body` is on its outside; `tree` is over these triangles.
pub(super) fn openings(
    cloth: &TriMesh,
    body: &TriMesh,
    tree: &Bvh,
    flat: impl Fn([u32; 2]) -> f64,
    skin: impl Fn(u32) -> bool,
) -> Vec<Opening> {
    let mut found: Vec<Opening> = border_loops(cloth)
        .into_iter()
        .map(|chain| {
            let points: Vec<DVec3> = chain.iter().map(|&v| cloth.positions[v as usize]).collect();
            let n = points.len();
            Opening {
                length: (0..n).map(|i| points[i].distance(points[(i + 1) % n])).sum(),
                flat_length: (0..n).map(|i| flat([chain[i], chain[(i + 1) % n]])).sum(),
                height: points.iter().map(|p| p.y).sum::<f64>() / n as f64,
                middle: points.iter().sum::<DVec3>() / n as f64,
                body_through: passes(&points, body, tree, &skin),
            }
        })
        .collect();
    found.sort_by(|a, b| b.length.total_cmp(&a.length));
    found
}

/// Whether an edge of the body's skin meets the fan of triangles over `points` from their mean.
fn passes(points: &[DVec3], body: &TriMesh, tree: &Bvh, skin: &impl Fn(u32) -> bool) -> bool {
    let n = points.len();
    let middle = points.iter().sum::<DVec3>() / n as f64;
    (0..n).any(|i| {
        let fan = [points[i], points[(i + 1) % n], middle];
        let mut meets = false;
        tree.near(&Aabb::around(&fan), |t| {
            let [a, b, c] = body.corners(t as usize);
            let crossed = || [[a, b], [b, c], [c, a]].iter().any(|&s| segment_meets_triangle(s, fan));
            meets = meets || (crossed() && skin(t));
        });
        meets
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_joined_round_has_two_borders() {
        let n = 8u32;
        let mut mesh = TriMesh::default();
        for y in 0..2 {
            for k in 0..n {
                let a = f64::from(k) / f64::from(n) * std::f64::consts::TAU;
                mesh.positions.push(DVec3::new(a.sin(), f64::from(y), a.cos()));
            }
        }
        for k in 0..n {
            let b = (k + 1) % n;
            mesh.triangles.extend([[k, b, b + n], [k, b + n, k + n]]);
        }
        let loops = border_loops(&mesh);
        assert_eq!(loops.iter().map(Vec::len).collect::<Vec<_>>(), [8, 8]);
        let nothing = TriMesh::default();
        let open = openings(&mesh, &nothing, &Bvh::new(&[]), |_| 0.5, |_| true);
        let octagon = 16.0 * (std::f64::consts::PI / 8.0).sin();
        assert!(open.iter().all(|o| (o.length - octagon).abs() < 1e-12 && !o.body_through));
        assert!((open[0].height - open[1].height).abs() == 1.0);
        assert!(open.iter().all(|o| o.flat_length == 4.0));
    }
}
