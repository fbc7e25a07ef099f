//! Closest point queries on a triangle mesh, exact in f64, and pseudonormals that give the sign of the distance.

use glam::DVec3;

use crate::geometry::adjacency::{Adjacency, NONE};
use crate::geometry::bvh::{Aabb, Bvh, LEAF};
use crate::geometry::bvh4::Bvh4;
use crate::geometry::crossings::segment_meets_triangle;
use crate::geometry::mesh::TriMesh;

/// Rounding error allowed for in the quick distance of a triangle: a fraction of it, and square metres.
const SLACK: [f64; 2] = [1e-9, 1e-22];
/// Square of the sine of a triangle's first angle up to which its quick distance is not exact enough. Chosen by trial: with it, and
/// this slack, none was too large of 20,000 random triangles and points.
const THIN: f64 = 1e-4;

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

/// Corners of the triangles of a leaf, metres, coordinate by coordinate: for each corner and axis one number per triangle.
#[derive(Clone, Copy, Debug)]
struct Block([[[f64; LEAF]; 3]; 3]);

impl Block {
    /// The corners of triangle `k`.
    #[inline(always)]
    fn corners(&self, k: usize) -> [DVec3; 3] {
        [0, 1, 2].map(|i| DVec3::new(self.0[i][0][k], self.0[i][1][k], self.0[i][2][k]))
    }

    /// Squared distances from `p` to the triangles, square metres, but for rounding; 0 for thin ones. The closest points of all
    /// features of every triangle are found, so that there is no branch and all triangles are done at once (SIMD).
    #[inline(always)]
    fn distances_squared(&self, p: DVec3) -> [f64; LEAF] {
        let mut all = [0.0; LEAF];
        for (k, least) in all.iter_mut().enumerate() {
            let [a, b, c] = self.corners(k);
            let (ab, ac, ap, bp, cp) = (b - a, c - a, p - a, p - b, p - c);
            let sides = [on_side(ap, ab), on_side(ap, ac), on_side(bp, c - b)];
            let (d1, d2, aa, cc, m) = (ab.dot(ap), ac.dot(ap), ab.dot(ab), ac.dot(ac), ab.dot(ac));
            let (v, w, whole) = (d1 * cc - d2 * m, d2 * aa - d1 * m, aa * cc - m * m);
            let over = 1.0 / whole;
            let off = (ap - (ab * (v * over) + ac * (w * over))).length_squared();
            let is_within = (v >= 0.0) & (w >= 0.0) & (v + w <= whole);
            let face = if is_within { off } else { f64::INFINITY };
            let corners = less(ap.length_squared(), less(bp.length_squared(), cp.length_squared()));
            let found = less(less(corners, face), less(sides[0], less(sides[1], sides[2])));
            *least = if whole > THIN * aa * cc { found } else { 0.0 };
        }
        all
    }
}

/// Squared distance of a point from a segment, square metres; infinite where an end of it is closest. `from` leads from the first
/// end to the point, `way` to the other end.
#[inline(always)]
fn on_side(from: DVec3, way: DVec3) -> f64 {
    let (along, whole) = (from.dot(way), way.length_squared());
    let off = (from - way * (along / whole)).length_squared();
    if (along > 0.0) & (along < whole) { off } else { f64::INFINITY }
}

/// The smaller of two numbers, by a single instruction.
#[inline(always)]
fn less(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// A bounding volume hierarchy over triangles for closest point queries.
#[derive(Clone, Debug)]
pub struct ClosestTree {
    tree: Bvh4,
    /// The triangles in the order of the tree's slots, so that a query reads adjacent memory. Nobody asks for those missing in the
    /// last block.
    blocks: Vec<Block>,
    /// For each triangle its slot in the tree.
    slots: Vec<u32>,
}

impl ClosestTree {
    /// Builds the tree over all triangles of `mesh`.
    pub fn new(mesh: &TriMesh) -> Self {
        let tree = Bvh4::new(Bvh::with_full_leaves(&mesh.boxes()));
        let mut slots = vec![0; tree.items.len()];
        tree.items.iter().enumerate().for_each(|(slot, &t)| slots[t as usize] = slot as u32);
        Self { blocks: blocks(&tree.items, mesh), tree, slots }
    }

    /// The same tree for new positions of the vertices in `mesh`: cheaper than a new tree, as boxes are only refitted.
    pub fn moved(&self, mesh: &TriMesh) -> Self {
        let mut tree = self.tree.clone();
        tree.refit(|slot| Aabb::around(&mesh.corners(self.tree.items[slot] as usize)));
        Self { blocks: blocks(&tree.items, mesh), tree, slots: self.slots.clone() }
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
        let mut best: Option<(DVec3, u32, Part)> = None;
        let mut least = limit * limit;
        self.look_round(
            p,
            least,
            #[inline(always)]
            |d, item, (point, part)| {
                let is_first = best.is_none_or(|(_, other, _)| item < other);
                if (d < least || (d == least && is_first)) && !left_out(item) {
                    (best, least) = (Some((point, item, part)), d);
                }
                least
            },
        );
        best
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
        self.look_round(
            p,
            limit,
            #[inline(always)]
            |d, item, _| {
                if d <= limit {
                    found(item);
                }
                limit
            },
        );
    }

    /// Calls `look` with every triangle that may be within the square root of the limit of `p`: its squared distance, its number, and
    /// the closest point with its feature. The limit starts as `limit` and is replaced by each value that `look` returns.
    #[inline(always)]
    fn look_round(&self, p: DVec3, limit: f64, mut look: impl FnMut(f64, u32, (DVec3, Part)) -> f64) {
        let mut limit = limit;
        self.tree.visit(
            p,
            limit,
            #[inline(always)]
            |slots| {
                let quick = self.blocks[slots.start / LEAF].distances_squared(p);
                for (slot, quick) in slots.zip(quick) {
                    if quick <= limit * (1.0 + SLACK[0]) + SLACK[1] {
                        let on = self.on(slot, p);
                        limit = look((on.0 - p).length_squared(), self.tree.items[slot], on);
                    }
                }
                limit
            },
        );
    }

    /// Whether the segment between `ends` intersects a triangle, see [`segment_meets_triangle`]. The cost grows with
    /// the number of triangles near the segment.
    pub fn meets_segment(&self, ends: [DVec3; 2]) -> bool {
        self.tree.any_along(
            ends,
            #[inline(always)]
            |slot| segment_meets_triangle(ends, self.blocks[slot / LEAF].corners(slot % LEAF)),
        )
    }

    #[inline(always)]
    fn on(&self, slot: usize, p: DVec3) -> (DVec3, Part) {
        let [a, b, c] = self.blocks[slot / LEAF].corners(slot % LEAF);
        closest_on_triangle(p, a, b, c)
    }
}

/// The corners of `items`, the triangles of `mesh` in the order of a tree's slots.
fn blocks(items: &[u32], mesh: &TriMesh) -> Vec<Block> {
    let block = |items: &[u32]| {
        let mut block = Block([[[f64::INFINITY; LEAF]; 3]; 3]);
        for (k, &t) in items.iter().enumerate() {
            for (axes, corner) in block.0.iter_mut().zip(mesh.corners(t as usize)) {
                axes.iter_mut().zip(corner.to_array()).for_each(|(lanes, x)| lanes[k] = x);
            }
        }
        block
    };
    items.chunks(LEAF).map(block).collect()
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
    use crate::geometry::random::Random;
    use crate::geometry::winding::Winding;

    /// Of thin triangles and points in their planes, on their sides and at their corners, too.
    #[test]
    fn quick_distances_miss_no_nearest_triangle() {
        let mut random = Random::stream(7, 0);
        let mut place = |wide: f64| DVec3::from_array([0; 3].map(|_| random.between(-wide, wide)));
        let mut known = 0;
        for i in 0..20_000 {
            let (a, b) = (place(1.0), place(1.0));
            let thin = 10f64.powi(-(i % 9));
            let c = a + (b - a) * (f64::from(i % 7) / 6.0) + place(thin);
            let beside = place(10f64.powi(-(i % 11)));
            let p = [a, b, (a + c) / 2.0, (a + b + c) / 3.0, a * 2.0 - b][i as usize % 5] + beside;
            let mesh = TriMesh { positions: vec![a, b, c], triangles: vec![[0, 1, 2]] };
            let quick = blocks(&[0], &mesh)[0].distances_squared(p)[0];
            let exact = (closest_on_triangle(p, a, b, c).0 - p).length_squared();
            assert!(quick <= exact * (1.0 + SLACK[0]) + SLACK[1], "{i}: {quick:e} {exact:e}");
            // Too small costs time alone; the exact one is off by more where it takes differences of products of areas.
            assert!(quick == 0.0 || exact.sqrt() <= quick.sqrt() + 1e-6, "{i}: {quick:e} {exact:e}");
            known += u32::from(quick > 0.0);
        }
        assert!(known > 5_000, "{known}");
    }

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
