//! The surface of a body for contact queries: signed distance, rays, bounds.

use std::sync::{Arc, OnceLock};

use glam::{DVec3, Vec3};
use parry3d::math::Pose;
use parry3d::query::{Ray, RayCast};
use parry3d::shape::TriMesh as ParryMesh;
use rayon::prelude::*;

use crate::body::closest::{ClosestTree, Part, pseudonormal};
use crate::body::landmarks::{self, Landmarks};
use crate::body::readings::{Reading, read};
use crate::geometry::adjacency::{Adjacency, NONE};
use crate::geometry::crossings::self_crossings;
use crate::geometry::mesh::TriMesh;
use crate::geometry::parallel::LEAST_SUMS;
use crate::geometry::winding::{Winding, WindingTree};

/// Distance by which a ray that slipped between triangles is shifted and cast again, metres on a body 1.5 m large.
const RAY_ASIDE: f64 = 1e-5;

/// The point of a surface nearest to a query point, with the signed distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The nearest point, metres.
    pub point: DVec3,
    /// Outward unit normal: the gradient of the signed distance, or the pseudonormal where the query point is on the surface.
    pub normal: DVec3,
    /// Signed distance, metres, negative inside. The sign comes from angle-weighted pseudonormals (Baerentzen and Aanaes 2005).
    pub distance: f64,
    /// The triangle that `point` is on.
    pub triangle: u32,
}

/// The hit of a ray on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The point hit, metres.
    pub point: DVec3,
    /// Unit outward normal of the triangle.
    pub normal: DVec3,
    /// The triangle hit.
    pub triangle: u32,
    /// Distance from the ray's origin, metres.
    pub distance: f64,
}

/// What takes long and few bodies are asked for: found out at the first question.
#[derive(Default)]
struct Lazily {
    /// The mesh at which rays are cast.
    parry: OnceLock<Option<ParryMesh>>,
    winding: OnceLock<WindingTree>,
    landmarks: OnceLock<Option<Landmarks>>,
    floor: OnceLock<Option<f64>>,
    readings: OnceLock<Option<Vec<Reading>>>,
    self_crossings: OnceLock<Vec<[u32; 2]>>,
}

/// The surface of a body, prepared for queries. Built once and shared.
pub struct Surface {
    /// The mesh: closed, manifold, facing outward; metres. `body::import` reports meshes that are not.
    pub mesh: TriMesh,
    /// Adjacency of the mesh.
    pub adjacency: Arc<Adjacency>,
    /// Unit normal of each triangle.
    pub face_normals: Vec<DVec3>,
    /// Angle-weighted unit normal of each vertex.
    pub vertex_normals: Vec<DVec3>,
    closest: ClosestTree,
    lazily: Lazily,
    // Rays run in f32 relative to this point, so that bodies far from the origin keep their accuracy.
    origin: DVec3,
    lower: DVec3,
    upper: DVec3,
}

impl std::fmt::Debug for Surface {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Surface({} triangles)", self.mesh.triangles.len())
    }
}

impl Surface {
    /// Builds the queries over `mesh`. None when the mesh has no triangle or parry3d refuses it.
    pub fn new(mesh: TriMesh) -> Option<Self> {
        let adjacency = Arc::new(Adjacency::new(mesh.positions.len(), &mesh.triangles));
        let closest = ClosestTree::new(&mesh);
        let surface = Self::with(mesh, adjacency, closest);
        surface.parry().is_some().then_some(surface)
    }

    /// The same body with its vertices at new `positions`, in the same order: the topology is shared and the tree
    /// refitted. None when the number of positions differs, or one is not finite.
    pub fn reposed(&self, positions: Vec<DVec3>) -> Option<Self> {
        if positions.len() != self.mesh.positions.len() || positions.iter().any(|p| !p.is_finite()) {
            return None;
        }
        let mesh = TriMesh { positions, triangles: self.mesh.triangles.clone() };
        let closest = self.closest.moved(&mesh);
        let reposed = Self::with(mesh, Arc::clone(&self.adjacency), closest);
        let floor = self.floor().map(|floor| floor.min(reposed.lower.y));
        let lazily = Lazily { floor: OnceLock::from(floor), ..reposed.lazily };
        Some(Self { lazily, ..reposed })
    }

    fn with(mesh: TriMesh, adjacency: Arc<Adjacency>, closest: ClosestTree) -> Self {
        let (lower, upper) = mesh.bounds();
        let origin = (lower + upper) / 2.0;
        let face_normals: Vec<DVec3> = (0..mesh.triangles.len())
            .into_par_iter()
            .with_min_len(LEAST_SUMS)
            .map(|t| {
                let [a, b, c] = mesh.corners(t);
                (b - a).cross(c - a).normalize_or_zero()
            })
            .collect();
        let vertex_normals = angle_weighted_normals(&mesh, &adjacency, &face_normals);
        let lazily = Lazily::default();
        Self { mesh, adjacency, face_normals, vertex_normals, closest, lazily, origin, lower, upper }
    }

    /// The mesh at which rays are cast, built on first use; None when parry3d refuses it.
    fn parry(&self) -> Option<&ParryMesh> {
        let build = || {
            let vertices: Vec<Vec3> =
                self.mesh.positions.iter().map(|&p| (p - self.origin).as_vec3()).collect();
            ParryMesh::new(vertices, self.mesh.triangles.clone()).ok()
        };
        self.lazily.parry.get_or_init(build).as_ref()
    }

    /// Winding numbers of the mesh.
    pub fn winding(&self) -> Winding<'_> {
        Winding::with(&self.mesh, self.lazily.winding.get_or_init(|| WindingTree::new(&self.mesh)))
    }

    /// The landmarks; None where the body does not look human.
    pub fn landmarks(&self) -> Option<&Landmarks> {
        self.lazily.landmarks.get_or_init(|| landmarks::found(&self.mesh)).as_ref()
    }

    /// Height of the floor that the body stands on, metres: that of its lowest point, or of its lowest point as it was built where it
    /// has another pose. None for what does not look human, a bust for example: nobody knows how high that stands.
    pub fn floor(&self) -> Option<f64> {
        *self.lazily.floor.get_or_init(|| self.landmarks().map(|_| self.lower.y))
    }

    /// The measurements read on the body; None where it does not look human.
    pub fn readings(&self) -> Option<&[Reading]> {
        self.lazily.readings.get_or_init(|| read(&self.mesh, self.landmarks()?, None)).as_deref()
    }

    /// Where the body passes through itself: pairs of an edge of [`Self::adjacency`] and a triangle.
    pub fn self_crossings(&self) -> &[[u32; 2]] {
        let found = || self_crossings(&self.mesh, &self.adjacency.edges, &self.mesh.tree());
        self.lazily.self_crossings.get_or_init(found)
    }

    /// Lower and upper corner of the bounding box, metres.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        (self.lower, self.upper)
    }

    /// Scale of the body, by which paper A's lengths are multiplied: the longest side of its bounding box over 1.5 m.
    pub fn scale(&self) -> f64 {
        (self.upper - self.lower).max_element() / 1.5
    }

    /// The point of the surface nearest to `p`.
    pub fn nearest(&self, p: DVec3) -> Nearest {
        self.nearest_within(p, f64::INFINITY).unwrap_or(Nearest {
            point: p,
            normal: DVec3::Y,
            distance: 0.0,
            triangle: 0,
        })
    }

    /// The point of the surface nearest to `p`, if one is within `limit` metres.
    pub fn nearest_within(&self, p: DVec3, limit: f64) -> Option<Nearest> {
        self.closest.nearest(p, limit).map(|found| self.signed(p, found))
    }

    /// The point nearest to `p` within `limit` metres on triangles that are not `left_out`.
    pub fn nearest_within_but(
        &self,
        p: DVec3,
        limit: f64,
        left_out: impl Fn(u32) -> bool,
    ) -> Option<Nearest> {
        self.closest.nearest_but(p, limit, left_out).map(|found| self.signed(p, found))
    }

    /// The points within `reach` metres of `p` at which the distance to `p` has a local minimum over the surface, with
    /// their triangles: sorted by distance, then by triangle. Of triangles that share such a point the lowest is given.
    pub fn nearest_round_about(&self, p: DVec3, reach: f64) -> Vec<(DVec3, u32)> {
        let mut found: Vec<(f64, u32, DVec3)> = Vec::new();
        self.closest.within(p, reach, |t| {
            let (point, _, part) = self.closest.on_triangle(p, t);
            let far = point.distance_squared(p);
            let beats = |&other: &u32| {
                let others = self.closest.on_triangle(p, other).0.distance_squared(p);
                others < far || (others == far && other < t)
            };
            let beaten = match part {
                Part::Face => false,
                Part::Side(k) => match self.adjacency.across[t as usize][k] {
                    NONE => false,
                    other => beats(&other),
                },
                Part::Corner(k) => {
                    let corner = self.mesh.triangles[t as usize][k];
                    self.adjacency.vertex_triangles.of(corner).iter().any(beats)
                }
            };
            if !beaten {
                found.push((far, t, point));
            }
        });
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.into_iter().map(|(_, t, point)| (point, t)).collect()
    }

    /// The point nearest to `p` on `triangle` and the triangles that share a vertex with it.
    pub fn nearest_round(&self, p: DVec3, triangle: u32) -> Nearest {
        let found = self.closest.nearest_of(p, self.round(triangle)).unwrap_or((p, triangle, Part::Face));
        self.signed(p, found)
    }

    /// Distance from `p` to `triangle`, metres.
    pub fn distance_to(&self, p: DVec3, triangle: u32) -> f64 {
        self.closest.on_triangle(p, triangle).0.distance(p)
    }

    /// Lower bound of how much farther than `distance` all triangles are from `p` that share no vertex with
    /// `triangle`, metres; at most `most`.
    pub fn gap_round(&self, p: DVec3, triangle: u32, distance: f64, most: f64) -> f64 {
        let own = self.mesh.triangles[triangle as usize];
        let touches = |t: u32| self.mesh.triangles[t as usize].iter().any(|v| own.contains(v));
        let next = self.closest.nearest_but(p, distance + most, touches);
        next.map_or(most, |(point, ..)| (point - p).length() - distance)
    }

    /// A local nearest point to `p`: walks from `triangle` to neighbouring triangles while they are nearer. Parts of
    /// the surface that are nearer elsewhere are not found.
    pub fn nearest_by_walk(&self, p: DVec3, triangle: u32) -> Nearest {
        let mut at = self.closest.on_triangle(p, triangle);
        let mut least = at.0.distance_squared(p);
        loop {
            let (_, triangle, part) = at;
            let before = least;
            let mut look = |t: u32| {
                let other = self.closest.on_triangle(p, t);
                let distance = other.0.distance_squared(p);
                if distance < least {
                    (at, least) = (other, distance);
                }
            };
            match part {
                Part::Face => {}
                Part::Side(k) => match self.adjacency.across[triangle as usize][k] {
                    NONE => {}
                    other => look(other),
                },
                Part::Corner(k) => {
                    let corner = self.mesh.triangles[triangle as usize][k];
                    self.adjacency.vertex_triangles.of(corner).iter().for_each(|&t| look(t));
                }
            }
            // This also ends the walk where `p` is not finite: then nothing is nearer.
            let is_nearer = least < before;
            if !is_nearer {
                return self.signed(p, at);
            }
        }
    }

    /// `triangle` and the triangles that share a vertex with it, each once.
    fn round(&self, triangle: u32) -> impl Iterator<Item = u32> {
        let own = self.mesh.triangles[triangle as usize];
        (0..3).flat_map(move |k| {
            let beside = self.adjacency.vertex_triangles.of(own[k]).iter().copied();
            let earlier = &own[..k];
            let seen: [Option<u32>; 2] = [earlier.first().copied(), earlier.get(1).copied()];
            beside.filter(move |&t| {
                let vs = self.mesh.triangles[t as usize];
                !seen.iter().flatten().any(|v| vs.contains(v))
            })
        })
    }

    /// Pseudonormals of each triangle: of its face, its sides (from corner k to the next) and its corners. See
    /// [`pseudonormal`](crate::body::closest::pseudonormal).
    pub fn pseudonormals(&self) -> Vec<[DVec3; 7]> {
        let parts = [
            Part::Face,
            Part::Side(0),
            Part::Side(1),
            Part::Side(2),
            Part::Corner(0),
            Part::Corner(1),
            Part::Corner(2),
        ];
        (0..self.mesh.triangles.len() as u32).map(|t| parts.map(|part| self.outward(t, part))).collect()
    }

    fn outward(&self, triangle: u32, part: Part) -> DVec3 {
        pseudonormal(&self.mesh, &self.adjacency, &self.face_normals, &self.vertex_normals, triangle, part)
    }

    fn signed(&self, p: DVec3, (point, triangle, part): (DVec3, u32, Part)) -> Nearest {
        let along = p - point;
        let length = along.length();
        let outward = self.outward(triangle, part);
        let inside = along.dot(outward) < 0.0;
        let normal = match length > 1e-7 {
            true if inside => -along / length,
            true => along / length,
            false => outward.normalize_or_zero(),
        };
        Nearest { point, normal, distance: if inside { -length } else { length }, triangle }
    }

    /// The smallest cosine between `direction` (unit) and the normals of the facets nearest to `p`, with the nearest point;
    /// None when they are farther than `limit` metres. At an edge two facets are equally near, at a corner all those round it.
    pub fn least_facing(&self, p: DVec3, limit: f64, direction: DVec3) -> Option<(f64, Nearest)> {
        let found = self.closest.nearest(p, limit)?;
        let (_, triangle, part) = found;
        let cosine = |t: u32| self.face_normals[t as usize].dot(direction);
        let own = cosine(triangle);
        let least = match part {
            Part::Face => own,
            Part::Side(k) => match self.adjacency.across[triangle as usize][k] {
                NONE => own,
                other => own.min(cosine(other)),
            },
            Part::Corner(k) => {
                let round = self.mesh.triangles[triangle as usize][k];
                let facets = self.adjacency.vertex_triangles.of(round);
                facets.iter().map(|&t| cosine(t)).fold(own, f64::min)
            }
        };
        Some((least, self.signed(p, found)))
    }

    /// The smallest cosine between `direction` (unit) and the normals of all facets within `reach` metres of `p`;
    /// None when there are none.
    pub fn least_facing_within(&self, p: DVec3, reach: f64, direction: DVec3) -> Option<f64> {
        let mut least: Option<f64> = None;
        self.closest.within(p, reach, |t| {
            let cosine = self.face_normals[t as usize].dot(direction);
            least = Some(least.map_or(cosine, |l| l.min(cosine)));
        });
        least
    }

    /// Whether the segment between two points intersects the surface.
    pub fn meets_segment(&self, ends: [DVec3; 2]) -> bool {
        self.closest.meets_segment(ends)
    }

    /// The first hit of a ray from `origin` along `direction` (any length), from either side of the surface.
    pub fn ray(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let direction = direction.normalize_or_zero();
        if direction == DVec3::ZERO {
            return None;
        }
        let hit = self.cast(origin, direction);
        // Along an edge a ray can slip between two triangles, and then seems to come from within: cast it again beside itself.
        let slipped = hit.is_none_or(|h| h.normal.dot(direction) > 0.0) && !self.contains(origin);
        if slipped {
            let aside = direction.any_orthonormal_vector() * (RAY_ASIDE * self.scale());
            return self.cast(origin + aside, direction);
        }
        hit
    }

    fn cast(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let ray = Ray::new((origin - self.origin).as_vec3(), direction.as_vec3());
        let hit = self.parry()?.cast_ray_and_get_normal(&Pose::IDENTITY, &ray, f32::MAX, false)?;
        let triangle = hit.subshape;
        let distance = f64::from(hit.time_of_impact);
        Some(Hit {
            point: origin + direction * distance,
            normal: self.face_normals[triangle as usize],
            triangle,
            distance,
        })
    }

    /// Whether `p` is inside the body.
    pub fn contains(&self, p: DVec3) -> bool {
        self.nearest(p).distance < 0.0
    }
}

/// Angle-weighted unit normal of each vertex. Summed per vertex in the order of its triangles: the same bits on any
/// number of threads.
fn angle_weighted_normals(mesh: &TriMesh, adjacency: &Adjacency, face_normals: &[DVec3]) -> Vec<DVec3> {
    let weighted = |v: u32, t: u32| {
        let p = mesh.corners(t as usize);
        let k = mesh.triangles[t as usize].iter().position(|&w| w == v).unwrap_or(0);
        let (a, b) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
        face_normals[t as usize] * a.cross(b).length().atan2(a.dot(b))
    };
    (0..mesh.positions.len() as u32)
        .into_par_iter()
        .with_min_len(LEAST_SUMS)
        .map(|v| {
            let around = adjacency.vertex_triangles.of(v).iter();
            around.fold(DVec3::ZERO, |sum, &t| sum + weighted(v, t)).normalize_or_zero()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Surface {
        let positions = (0..8)
            .map(|i| DVec3::new((i & 1) as f64, ((i >> 1) & 1) as f64, ((i >> 2) & 1) as f64))
            .collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Surface::new(TriMesh { positions, triangles }).expect("a cube")
    }

    #[test]
    fn distance_is_signed() {
        let cube = cube();
        assert!((cube.mesh.volume() - 1.0).abs() < 1e-12);
        let outside = cube.nearest(DVec3::new(0.5, 0.25, 1.5));
        assert!((outside.distance - 0.5).abs() < 1e-9);
        assert!((outside.normal - DVec3::Z).length() < 1e-9);
        let inside = cube.nearest(DVec3::new(0.5, 0.3, 0.9));
        assert!((inside.distance + 0.1).abs() < 1e-9);
        assert!((inside.normal - DVec3::Z).length() < 1e-9);
        // Off a corner the nearest face alone could give either sign.
        assert!(cube.nearest(DVec3::splat(1.1)).distance > 0.0);
    }

    #[test]
    fn a_reposed_body_is_the_one_built_anew() {
        let cube = cube();
        let turned = |p: &DVec3| DVec3::new(p.y * 2.0, -p.x, p.z + p.x * 0.3);
        let positions: Vec<DVec3> = cube.mesh.positions.iter().map(turned).collect();
        let reposed = cube.reposed(positions.clone()).expect("as many vertices");
        let anew = Surface::new(TriMesh { positions, ..cube.mesh.clone() }).expect("a body");
        assert_eq!(reposed.vertex_normals, anew.vertex_normals);
        for i in 0..50 {
            let p = DVec3::new(f64::from(i % 5) - 1.5, f64::from(i % 7) * 0.4 - 1.6, f64::from(i) * 0.04);
            assert_eq!(reposed.nearest(p), anew.nearest(p));
        }
        let down = reposed.ray(DVec3::new(1.0, -0.5, 9.0), -DVec3::Z).expect("a hit").point;
        assert!(down.distance(anew.ray(DVec3::new(1.0, -0.5, 9.0), -DVec3::Z).expect("a hit").point) < 1e-6);
        assert!(cube.reposed(vec![DVec3::ZERO; 7]).is_none() && cube.reposed(vec![DVec3::NAN; 8]).is_none());
    }

    #[test]
    fn between_two_walls_both_are_nearest_round_about() {
        let cube = cube();
        let middle = cube.nearest_round_about(DVec3::new(0.5, 0.44, 0.55), 0.48);
        let exact = [DVec3::new(0.5, 0.0, 0.55), DVec3::new(0.5, 0.44, 1.0)];
        assert_eq!(middle.len(), 2, "{middle:?}");
        assert!(middle.iter().zip(exact).all(|((point, _), exact)| point.distance(exact) < 1e-12));
        // Off a corner, three faces share the one nearest point.
        assert_eq!(cube.nearest_round_about(DVec3::splat(1.1), 1.0).len(), 1);
    }

    #[test]
    fn rays_along_edges_hit() {
        let cube = cube();
        for y in 0..=64 {
            let at = f64::from(y) / 64.0 * 0.98 + 0.01;
            let hit = cube.ray(DVec3::new(at, at, 3.0), -DVec3::Z).expect("a hit");
            assert!((hit.distance - 2.0).abs() < 1e-5, "{at}: {hit:?}");
        }
    }

    #[test]
    fn rays_hit_from_both_sides() {
        let cube = cube();
        let hit = cube.ray(DVec3::new(0.5, 0.4, 3.0), -DVec3::Z).expect("a hit");
        assert!((hit.distance - 2.0).abs() < 1e-6);
        assert!((hit.normal - DVec3::Z).length() < 1e-9);
        let out = cube.ray(DVec3::new(0.5, 0.4, 0.5), DVec3::Z).expect("a hit");
        assert!((out.normal - DVec3::Z).length() < 1e-9);
        assert!(cube.ray(DVec3::new(0.5, 0.4, 3.0), DVec3::Z).is_none());
    }
}
