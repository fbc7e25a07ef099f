//! Generalised winding number of a mesh about a point: 1 inside, 0 outside, 2 where two parts overlap.
//!
//! After Jacobson, Kavan and Sorkine-Hornung (2013); distant parts of the mesh are approximated by one dipole each
//! after Barill, Dickson, Schmidt, Levin and Jacobson (2018).

use std::borrow::Cow;

use glam::DVec3;

use crate::geometry::bvh::{Aabb, Bvh};
use crate::geometry::mesh::TriMesh;

/// A part counts as distant beyond this many of its radii. The error of the winding number then stays below 0.05.
const FAR: f64 = 2.0;

/// Dipole approximation of the triangles below a node of the tree.
#[derive(Clone, Copy, Debug)]
struct Dipole {
    /// Area-weighted centre, metres.
    centre: DVec3,
    /// Sum of area times normal, square metres.
    moment: DVec3,
    /// Square of the distance beyond which the dipole replaces its triangles, square metres.
    far_squared: f64,
}

/// The triangles of a mesh in a tree, with the dipoles of its nodes.
#[derive(Clone, Debug)]
pub struct WindingTree {
    tree: Bvh,
    dipoles: Vec<Dipole>,
}

/// A mesh prepared for winding number queries.
#[derive(Clone, Debug)]
pub struct Winding<'a> {
    mesh: &'a TriMesh,
    of: Cow<'a, WindingTree>,
}

impl WindingTree {
    /// Builds the tree over `mesh`.
    pub fn new(mesh: &TriMesh) -> Self {
        let tree = mesh.tree();
        let dipoles = tree
            .nodes
            .iter()
            .map(|node| {
                let (first, count) = (node.first as usize, node.count as usize);
                dipole(mesh, &tree.items[first..first + count], &node.bounds)
            })
            .collect();
        Self { tree, dipoles }
    }
}

impl<'a> Winding<'a> {
    /// Builds the tree over `mesh`.
    pub fn new(mesh: &'a TriMesh) -> Self {
        Self { mesh, of: Cow::Owned(WindingTree::new(mesh)) }
    }

    /// Queries of `mesh`, whose tree is known.
    pub fn with(mesh: &'a TriMesh, tree: &'a WindingTree) -> Self {
        Self { mesh, of: Cow::Borrowed(tree) }
    }

    /// The bounding volume hierarchy over the triangles.
    pub fn tree(&self) -> &Bvh {
        &self.of.tree
    }

    /// The winding number at `p`.
    pub fn at(&self, p: DVec3) -> f64 {
        let WindingTree { tree, dipoles } = &*self.of;
        if tree.nodes.is_empty() {
            return 0.0;
        }
        let mut solid_angle = 0.0;
        let mut open = vec![0usize];
        while let Some(at) = open.pop() {
            let (node, dipole) = (&tree.nodes[at], &dipoles[at]);
            let to_centre = dipole.centre - p;
            let squared = to_centre.length_squared();
            if squared > dipole.far_squared {
                solid_angle += to_centre.dot(dipole.moment) / (squared * squared.sqrt());
            } else if node.is_leaf() {
                let first = node.first as usize;
                for &t in &tree.items[first..first + node.count as usize] {
                    solid_angle += triangle_solid_angle(self.mesh.corners(t as usize).map(|c| c - p));
                }
            } else {
                open.push(node.right as usize);
                open.push(at + 1);
            }
        }
        solid_angle / (4.0 * std::f64::consts::PI)
    }

    /// Whether `p` lies inside: its winding number is more than 0.5.
    pub fn contains(&self, p: DVec3) -> bool {
        self.at(p) > 0.5
    }
}

fn dipole(mesh: &TriMesh, triangles: &[u32], bounds: &Aabb) -> Dipole {
    let (mut moment, mut weighted, mut area) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    for &t in triangles {
        let [a, b, c] = mesh.corners(t as usize);
        let normal = (b - a).cross(c - a) / 2.0;
        moment += normal;
        weighted += (a + b + c) / 3.0 * normal.length();
        area += normal.length();
    }
    let centre = if area > 0.0 { weighted / area } else { bounds.centre() };
    let radius = (centre - bounds.lower).abs().max((bounds.upper - centre).abs()).length();
    Dipole { centre, moment, far_squared: (FAR * radius).powi(2) }
}

/// Signed solid angle of a triangle seen from the origin; positive when the origin sees its back (van Oosterom and
/// Strackee 1983).
fn triangle_solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * a.dot(b.cross(c)).atan2(below)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sphere of radius 1 about the origin, `2 n²` triangles in rings.
    fn sphere(n: u32) -> TriMesh {
        let mut mesh = TriMesh::default();
        for i in 0..=n {
            for k in 0..n {
                let (a, b) = (f64::from(i) / f64::from(n), f64::from(k) / f64::from(n));
                let (sa, ca) = (a * std::f64::consts::PI).sin_cos();
                let (sb, cb) = (b * std::f64::consts::TAU).sin_cos();
                mesh.positions.push(DVec3::new(sa * sb, ca, sa * cb));
            }
        }
        for i in 0..n {
            for k in 0..n {
                let (a, b) = (i * n + k, i * n + (k + 1) % n);
                mesh.triangles.extend([[a, a + n, b], [b, a + n, b + n]]);
            }
        }
        mesh
    }

    fn exact(mesh: &TriMesh, p: DVec3) -> f64 {
        let sum: f64 =
            (0..mesh.triangles.len()).map(|t| triangle_solid_angle(mesh.corners(t).map(|c| c - p))).sum();
        sum / (4.0 * std::f64::consts::PI)
    }

    #[test]
    fn a_sphere_winds_once_inside_and_never_outside() {
        let mesh = sphere(40);
        assert!((mesh.volume() - 4.0 / 3.0 * std::f64::consts::PI).abs() < 0.05);
        let winding = Winding::new(&mesh);
        for (p, expected) in [(0.0, 1.0), (0.5, 1.0), (0.98, 1.0), (1.01, 0.0), (2.0, 0.0), (30.0, 0.0)] {
            let p = DVec3::new(0.6, 0.48, 0.64) * p;
            assert!((exact(&mesh, p) - expected).abs() < 1e-6);
            assert!((winding.at(p) - expected).abs() < 0.05, "{p}: {}", winding.at(p));
        }
    }

    #[test]
    fn where_two_spheres_overlap_it_is_two() {
        let mut mesh = sphere(24);
        let other = sphere(24);
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(other.positions.iter().map(|&p| p + DVec3::X));
        mesh.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
        let winding = Winding::new(&mesh);
        for (x, expected) in [(-0.5, 1.0), (0.5, 2.0), (1.5, 1.0), (2.5, 0.0)] {
            let found = winding.at(DVec3::new(x, 0.01, 0.02));
            assert!((found - expected).abs() < 0.05, "{x}: {found}");
        }
    }
}
