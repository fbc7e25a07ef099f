//! Closest point queries on a triangle mesh, exact in f64, and pseudonormals that give the sign of the distance.

use glam::DVec3;

use crate::geometry::adjacency::{Adjacency, NONE};
use crate::geometry::bvh::Aabb;
use crate::geometry::bvh4::Bvh4;
use crate::geometry::crossings::segment_meets_triangle;
use crate::geometry::mesh::TriMesh;

/// The feature of a triangle that a closest point is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Corner 0, 1 or 2.
    Corner(usize),
    /// The edge from corner 0, 1 or 2 to the next.
    Side(usize),
    /// The interior.
    Face,
}

/// A bounding volume hierarchy over triangles for closest point queries.
#[derive(Clone, Debug)]
pub struct ClosestTree {
    tree: Bvh4,
    /// Corners of the triangles, metres, in the order of the tree's leaves, so that a query reads adjacent memory.
    corners: Vec<[DVec3; 3]>,
    /// For each triangle its index in `corners`.
    slots: Vec<u32>,
}

impl ClosestTree {
    /// Builds the tree over all triangles of `mesh`.
    pub fn new(mesh: &TriMesh) -> Self {
        let tree = Bvh4::new(mesh.tree());
        let corners = tree.items.iter().map(|&t| mesh.corners(t as usize)).collect();
        let mut slots = vec![0; tree.items.len()];
        tree.items.iter().enumerate().for_each(|(slot, &t)| slots[t as usize] = slot as u32);
        Self { tree, corners, slots }
    }

    /// The same tree for new positions of the vertices in `mesh`: cheaper than a new tree, as boxes are only refitted.
    pub fn moved(&self, mesh: &TriMesh) -> Self {
        let mut moved = self.clone();
        moved.corners = self.tree.items.iter().map(|&t| mesh.corners(t as usize)).collect();
        moved.tree.refit(|slot| Aabb::around(&moved.corners[slot]));
        moved
    }

    /// The closest point within `limit` metres, its triangle, and the triangle's feature it is on. Of triangles that
    /// share the point the lowest is given.
    pub fn nearest(&self, p: DVec3, limit: f64) -> Option<(DVec3, u32, Part)> {
        self.nearest_but(p, limit, |_| false)
    }

    /// The closest point within `limit` metres on triangles that are not `left_out`; see [`ClosestTree::nearest`].
    pub fn nearest_but(
        &self,
        p: DVec3,
        limit: f64,
        left_out: impl Fn(u32) -> bool,
    ) -> Option<(DVec3, u32, Part)> {
        let (slot, _) = self.tree.nearest(
            p,
            limit * limit,
            #[inline(always)]
            |slot| match left_out(self.tree.items[slot]) {
                true => f64::INFINITY,
                false => (self.on(slot, p).0 - p).length_squared(),
            },
        )?;
        let (point, part) = self.on(slot, p);
        Some((point, self.tree.items[slot], part))
    }

    /// The closest point on the given triangles. Of those that share the point the lowest is given.
    pub fn nearest_of(&self, p: DVec3, triangles: impl Iterator<Item = u32>) -> Option<(DVec3, u32, Part)> {
        let far = |t: u32| {
            let found = self.on_triangle(p, t);
            ((found.0 - p).length_squared(), found)
        };
        triangles.map(far).min_by(|(a, x), (b, y)| a.total_cmp(b).then(x.1.cmp(&y.1))).map(|(_, found)| found)
    }

    /// The closest point on one triangle.
    pub fn on_triangle(&self, p: DVec3, triangle: u32) -> (DVec3, u32, Part) {
        let (point, part) = self.on(self.slots[triangle as usize] as usize, p);
        (point, triangle, part)
    }

    /// Calls `found` for every triangle within `reach` metres of `p`, in no particular order.
    pub fn within(&self, p: DVec3, reach: f64, mut found: impl FnMut(u32)) {
        let limit = reach * reach;
        self.tree.visit(p, limit, |slot| {
            if (self.on(slot, p).0 - p).length_squared() <= limit {
                found(self.tree.items[slot]);
            }
            limit
        });
    }

    /// Whether the segment between `ends` intersects a triangle, see [`segment_meets_triangle`]. The cost grows with
    /// the number of triangles near the segment.
    pub fn meets_segment(&self, ends: [DVec3; 2]) -> bool {
        self.tree.any_along(
            ends,
            #[inline(always)]
            |slot| segment_meets_triangle(ends, self.corners[slot]),
        )
    }

    #[inline(always)]
    fn on(&self, slot: usize, p: DVec3) -> (DVec3, Part) {
        let [a, b, c] = self.corners[slot];
        closest_on_triangle(p, a, b, c)
    }
}

/// The angle-weighted pseudonormal (Baerentzen and Aanaes 2005) of `part` of triangle `t`: a point whose closest point is
/// there is outside when its offset from it has a positive dot product with this direction. Not normalised on an edge.
pub fn pseudonormal(
    mesh: &TriMesh,
    adjacency: &Adjacency,
    face_normals: &[DVec3],
    vertex_normals: &[DVec3],
    t: u32,
    part: Part,
) -> DVec3 {
    let own = face_normals[t as usize];
    match part {
        Part::Face => own,
        Part::Side(k) => match adjacency.across[t as usize][k] {
            NONE => own,
            other => own + face_normals[other as usize],
        },
        Part::Corner(k) => vertex_normals[mesh.triangles[t as usize][k] as usize],
    }
}

/// The point of triangle `abc` closest to `p` (Ericson, Real-Time Collision Detection, 5.1.5).
#[inline(always)]
pub fn closest_on_triangle(p: DVec3, a: DVec3, b: DVec3, c: DVec3) -> (DVec3, Part) {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (a, Part::Corner(0));
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return (b, Part::Corner(1));
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (a + ab * (d1 / (d1 - d3)), Part::Side(0));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return (c, Part::Corner(2));
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (a + ac * (d2 / (d2 - d6)), Part::Side(2));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return (b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))), Part::Side(1));
    }
    let sum = va + vb + vc;
    if sum == 0.0 {
        return (a, Part::Corner(0));
    }
    (a + ab * (vb / sum) + ac * (vc / sum), Part::Face)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Surface, mannequin};
    use crate::geometry::winding::Winding;

    /// B23: against every triangle of the mannequin, near and far, distance and sign.
    #[test]
    fn the_tree_finds_what_brute_force_finds() {
        let mesh = mannequin::default().mesh.clone();
        let surface = Surface::new(mesh.clone()).expect("triangles");
        let (lower, upper) = surface.bounds();
        let winding = Winding::new(&mesh);
        for i in 0..120 {
            let at = |k: u32| f64::from((i * k) % 127) / 126.0 * 1.4 - 0.2;
            let p = lower + (upper - lower) * DVec3::new(at(13), at(29), at(51));
            let exact = (0..mesh.triangles.len())
                .map(|t| {
                    let [a, b, c] = mesh.corners(t);
                    (closest_on_triangle(p, a, b, c).0 - p).length()
                })
                .fold(f64::INFINITY, f64::min);
            let found = surface.nearest(p);
            assert!((found.distance.abs() - exact).abs() <= 1e-12, "{p}: {} not {exact}", found.distance);
            // Winding tells inside from outside without any nearest point.
            assert_eq!(found.distance < 0.0, winding.contains(p), "{p}");
        }
    }

    /// Threads of two designs took twenty minutes a tick when all triangles of a ball as large as the thread were tested.
    #[test]
    fn a_segment_meets_what_it_meets_triangle_by_triangle() {
        let mesh = mannequin::default().mesh.clone();
        let surface = Surface::new(mesh.clone()).expect("triangles");
        let (lower, upper) = surface.bounds();
        let at = |i: u32, k: u32| f64::from((i * k) % 127) / 126.0 * 1.4 - 0.2;
        let far = |i: u32| lower + (upper - lower) * DVec3::new(at(i, 13), at(i, 29), at(i, 51));
        let corners = |i: u32| mesh.corners((i as usize * 7919) % mesh.triangles.len());
        let mut segments: Vec<[DVec3; 2]> = Vec::new();
        for i in 0..60 {
            let ([a, b, c], p, q) = (corners(i), far(i), far(i + 77));
            let middle = (a + b + c) / 3.0;
            let out = (b - a).cross(c - a).normalize() * 0.002;
            // Any; short; of no length, anywhere, in a face and at a vertex.
            segments.extend([[p, q], [p, p + (q - p) * 0.01], [p; 2], [middle; 2], [a; 2]]);
            // Through a face; to a vertex; to an edge; along an edge; in the plane of a face; along an axis.
            segments.extend([[middle - out, middle + out], [p, a], [p, (a + b) / 2.0], [a, b]]);
            segments.extend([[middle * 2.0 - c, c * 2.0 - middle], [p, DVec3::new(q.x, p.y, p.z)]]);
            // Within: from just below the skin to a little deeper.
            segments.push([middle - out, middle - out * 1.5]);
        }
        let mut met = 0;
        for ends in &segments {
            let plain = (0..mesh.triangles.len()).any(|t| segment_meets_triangle(*ends, mesh.corners(t)));
            assert_eq!(surface.meets_segment(*ends), plain, "{ends:?}");
            met += usize::from(plain);
        }
        assert!(met > 200 && segments.len() - met > 200, "{met} of {}", segments.len());
    }

    #[test]
    fn a_segment_at_a_box_meets_its_faces_and_not_beyond() {
        let mesh = crate::geometry::shapes::cylinder(0.5, 1.0, 4, 1);
        let surface = Surface::new(mesh).expect("triangles");
        let along = |x: f64, y: f64| [DVec3::new(x, y, -3.0), DVec3::new(x, y, 3.0)];
        assert!(surface.meets_segment(along(0.01, 0.0)) && surface.meets_segment(along(0.01, 1.0)));
        assert!(!surface.meets_segment(along(0.01, 1.0 + 1e-9)) && !surface.meets_segment(along(0.6, 0.5)));
        assert!(!surface.meets_segment([DVec3::new(0.1, 0.4, 0.1), DVec3::new(-0.1, 0.6, -0.1)]), "inside");
        assert!(!surface.meets_segment([DVec3::NAN, DVec3::X]));
    }
}
