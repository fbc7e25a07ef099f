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
    /// Whether all of it is lower than the body, which therefore ends above it.
    #[serde(default)]
    pub below_body: bool,
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
    let lowest = body.bounds().0.y;
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
                below_body: points.iter().all(|p| p.y < lowest),
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
    use crate::fit::Report;
    use crate::geometry::shapes::icosphere;

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

    #[test]
    fn a_hem_may_hang_lower_than_the_body_it_is_on() {
        let passed = Opening { body_through: true, ..Opening::default() };
        let hem = Opening { below_body: true, ..Opening::default() };
        let cuff = Opening::default();
        let missed = |openings: &[Opening]| {
            let report = Report { openings: openings.to_vec(), ..Report::default() };
            report.missed_openings().map(|(i, _)| i).collect::<Vec<_>>()
        };
        assert!(missed(&[passed, hem]).is_empty());
        assert_eq!(missed(&[passed, hem, cuff]), [2], "it lies beside an arm");
        assert_eq!(missed(&[hem, hem]), [0, 1], "all of it has fallen off");
        assert!(missed(&[hem]).is_empty(), "a cloth");
    }

    #[test]
    fn an_opening_is_below_the_body_where_all_of_it_is() {
        let (mut mesh, n) = (TriMesh::default(), 8u32);
        for (k, y) in [0.0, -0.1, -0.2].into_iter().enumerate() {
            let ring = (0..n).map(|i| f64::from(i) / f64::from(n) * std::f64::consts::TAU);
            // The lowest ring is tilted.
            let tilt = if k == 2 { 0.3 } else { 0.0 };
            mesh.positions.extend(ring.map(|a| DVec3::new(a.sin(), y + tilt * a.sin(), a.cos())));
        }
        let mut body = icosphere(0.05, 1);
        let below = |mesh: &TriMesh, body: &TriMesh| {
            let found = openings(mesh, body, &body.tree(), |_| 0.5, |_| true);
            found.iter().map(|o| (o.below_body, o.body_through)).collect::<Vec<_>>()
        };
        let band = |mesh: &TriMesh, rows: [u32; 2]| {
            let [upper, lower] = rows.map(|row| row * n);
            let quads = (0..n).map(|k| [upper + k, upper + (k + 1) % n, lower + k, lower + (k + 1) % n]);
            let triangles = quads.flat_map(|[a, b, c, d]| [[a, c, b], [b, c, d]]).collect();
            TriMesh { positions: mesh.positions.clone(), triangles }
        };
        let mut straight = below(&band(&mesh, [0, 1]), &body);
        straight.sort_unstable();
        assert_eq!(straight, [(false, true), (true, false)]);
        assert!(below(&band(&mesh, [0, 2]), &body).iter().all(|(below, _)| !below), "it reaches up");
        body.positions.iter_mut().for_each(|p| p.y -= 1.0);
        assert!(below(&band(&mesh, [0, 1]), &body).iter().all(|(below, _)| !below), "it hangs over the body");
    }
}
