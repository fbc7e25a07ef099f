//! A body as contact sees it: nearest point with sign, rays, bounds.

use glam::{DVec3, Vec3};
use parry3d::math::Pose;
use parry3d::query::{Ray, RayCast};
use parry3d::shape::TriMesh as ParryMesh;

use crate::body::closest::{ClosestTree, Part, pseudonormal};
use crate::geometry::adjacency::{Adjacency, NONE};
use crate::geometry::crossings::segment_meets_triangle;
use crate::geometry::mesh::TriMesh;

/// A ray that slipped between triangles is cast again so far beside itself, metres on a body 1.5 m large.
const RAY_ASIDE: f64 = 1e-5;

/// The nearest point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// On the surface, metres.
    pub point: DVec3,
    /// Unit, outward: the gradient of the signed distance; the pseudonormal where the point lies on the surface.
    pub normal: DVec3,
    /// Metres, negative inside. Sign from angle-weighted pseudonormals (Baerentzen and Aanaes 2005).
    pub distance: f64,
    /// The triangle that `point` lies on.
    pub triangle: u32,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// On the surface, metres.
    pub point: DVec3,
    /// Unit outward normal of the triangle.
    pub normal: DVec3,
    /// The triangle.
    pub triangle: u32,
    /// Distance from the origin along the ray, metres.
    pub distance: f64,
}

/// A body ready for queries. Built once, shared.
pub struct Surface {
    /// Closed, manifold, outward; metres. `body::import` reports what is not.
    pub mesh: TriMesh,
    /// Neighbours.
    pub adjacency: Adjacency,
    /// Unit normal per triangle.
    pub face_normals: Vec<DVec3>,
    /// Angle-weighted unit normal per vertex.
    pub vertex_normals: Vec<DVec3>,
    closest: ClosestTree,
    parry: ParryMesh,
    // Rays run in f32 about this point, so that bodies far from the origin keep their accuracy.
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
        let (lower, upper) = mesh.bounds();
        let origin = (lower + upper) / 2.0;
        let vertices: Vec<Vec3> = mesh.positions.iter().map(|&p| (p - origin).as_vec3()).collect();
        let parry = ParryMesh::new(vertices, mesh.triangles.clone()).ok()?;
        let adjacency = Adjacency::new(mesh.positions.len(), &mesh.triangles);
        let face_normals = (0..mesh.triangles.len())
            .map(|t| {
                let [a, b, c] = mesh.corners(t);
                (b - a).cross(c - a).normalize_or_zero()
            })
            .collect::<Vec<_>>();
        let vertex_normals = angle_weighted_normals(&mesh, &face_normals);
        let closest = ClosestTree::new(&mesh);
        Some(Self { mesh, adjacency, face_normals, vertex_normals, closest, parry, origin, lower, upper })
    }

    /// Lower and upper corner of the bounding box.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        (self.lower, self.upper)
    }

    /// The largest side of the bounding box over 1.5 m: what paper A's lengths are multiplied by.
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

    /// The point of the surface nearest to `p`, if it is within `limit` metres.
    pub fn nearest_within(&self, p: DVec3, limit: f64) -> Option<Nearest> {
        self.closest.nearest(p, limit).map(|found| self.signed(p, found))
    }

    /// The point nearest to `p` on `triangle` and the triangles that touch it.
    pub fn nearest_round(&self, p: DVec3, triangle: u32) -> Nearest {
        let found = self.closest.nearest_of(p, self.round(triangle)).unwrap_or((p, triangle, Part::Face));
        self.signed(p, found)
    }

    /// How far `p` is from `triangle`, metres.
    pub fn distance_to(&self, p: DVec3, triangle: u32) -> f64 {
        self.closest.on_triangle(p, triangle).0.distance(p)
    }

    /// How much farther from `p` than `distance` all triangles are that do not touch `triangle`, metres: at least this, and
    /// `most` where there are none so near.
    pub fn gap_round(&self, p: DVec3, triangle: u32, distance: f64, most: f64) -> f64 {
        let own = self.mesh.triangles[triangle as usize];
        let touches = |t: u32| self.mesh.triangles[t as usize].iter().any(|v| own.contains(v));
        let next = self.closest.nearest_but(p, distance + most, touches);
        next.map_or(most, |(point, ..)| (point - p).length() - distance)
    }

    /// Where a walk from `triangle` ends that goes on to the triangle next to it while that is nearer to `p`: the nearest point
    /// of the surface round about, but not of parts that are nearer elsewhere.
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
            if least >= before {
                return self.signed(p, at);
            }
        }
    }

    /// `triangle` and those that touch it, each once.
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

    fn signed(&self, p: DVec3, (point, triangle, part): (DVec3, u32, Part)) -> Nearest {
        let along = p - point;
        let length = along.length();
        let outward = pseudonormal(
            &self.mesh,
            &self.adjacency,
            &self.face_normals,
            &self.vertex_normals,
            triangle,
            part,
        );
        let inside = along.dot(outward) < 0.0;
        let normal = match length > 1e-7 {
            true if inside => -along / length,
            true => along / length,
            false => outward.normalize_or_zero(),
        };
        Nearest { point, normal, distance: if inside { -length } else { length }, triangle }
    }

    /// The smallest cosine between `direction` (unit) and the facets nearest to `p`, if they are within `limit` metres:
    /// over an edge two are equally near, over a corner all round it. With it the nearest point.
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

    /// The smallest cosine between `direction` (unit) and the facets within `reach` metres of `p`; none are: None.
    pub fn least_facing_within(&self, p: DVec3, reach: f64, direction: DVec3) -> Option<f64> {
        let mut least: Option<f64> = None;
        self.closest.within(p, reach, |t| {
            let cosine = self.face_normals[t as usize].dot(direction);
            least = Some(least.map_or(cosine, |l| l.min(cosine)));
        });
        least
    }

    /// Whether the segment between two points passes through the surface.
    pub fn meets_segment(&self, ends: [DVec3; 2]) -> bool {
        let (middle, half) = ((ends[0] + ends[1]) / 2.0, ends[0].distance(ends[1]) / 2.0);
        let mut meets = false;
        self.closest.within(middle, half, |t| {
            meets = meets || segment_meets_triangle(ends, self.mesh.corners(t as usize));
        });
        meets
    }

    /// The first hit of a ray from `origin` along `direction` (any length) from either side.
    pub fn ray(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let direction = direction.normalize_or_zero();
        if direction == DVec3::ZERO {
            return None;
        }
        let hit = self.cast(origin, direction);
        // Along an edge a ray can slip between two triangles; then it seems to come from within. Beside it, it does not.
        let slipped = hit.is_none_or(|h| h.normal.dot(direction) > 0.0) && !self.contains(origin);
        if slipped {
            let aside = direction.any_orthonormal_vector() * (RAY_ASIDE * self.scale());
            return self.cast(origin + aside, direction);
        }
        hit
    }

    fn cast(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let ray = Ray::new((origin - self.origin).as_vec3(), direction.as_vec3());
        let hit = self.parry.cast_ray_and_get_normal(&Pose::IDENTITY, &ray, f32::MAX, false)?;
        let triangle = hit.subshape;
        let distance = f64::from(hit.time_of_impact);
        Some(Hit {
            point: origin + direction * distance,
            normal: self.face_normals[triangle as usize],
            triangle,
            distance,
        })
    }

    /// Whether `p` lies inside.
    pub fn contains(&self, p: DVec3) -> bool {
        self.nearest(p).distance < 0.0
    }
}

fn angle_weighted_normals(mesh: &TriMesh, face_normals: &[DVec3]) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; mesh.positions.len()];
    for (t, vs) in mesh.triangles.iter().enumerate() {
        let p = mesh.corners(t);
        for k in 0..3 {
            let (u, v) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            normals[vs[k] as usize] += face_normals[t] * u.cross(v).length().atan2(u.dot(v));
        }
    }
    normals.into_iter().map(DVec3::normalize_or_zero).collect()
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
