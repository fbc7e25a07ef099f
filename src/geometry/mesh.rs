//! Triangle meshes in space.

use glam::DVec3;

use crate::geometry::bvh::{Aabb, Bvh};

/// A triangle mesh over shared vertices. Triangles are counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriMesh {
    /// Positions of the vertices, metres.
    pub positions: Vec<DVec3>,
    /// Indices into `positions`.
    pub triangles: Vec<[u32; 3]>,
}

impl TriMesh {
    /// The three corners of triangle `t`.
    pub fn corners(&self, t: usize) -> [DVec3; 3] {
        self.triangles[t].map(|v| self.positions[v as usize])
    }

    /// Lower and upper corner of the bounding box, metres; zeros for an empty mesh.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        bounds(&self.positions)
    }

    /// Signed enclosed volume, cubic metres; positive when the triangles face outward.
    pub fn volume(&self) -> f64 {
        let about = self.positions.first().copied().unwrap_or_default();
        (0..self.triangles.len())
            .map(|t| {
                let [a, b, c] = self.corners(t).map(|p| p - about);
                a.dot(b.cross(c)) / 6.0
            })
            .sum()
    }

    /// The bounding box of each triangle, metres.
    pub fn boxes(&self) -> Vec<Aabb> {
        (0..self.triangles.len()).map(|t| Aabb::around(&self.corners(t))).collect()
    }

    /// Builds a bounding volume hierarchy over the triangles.
    pub fn tree(&self) -> Bvh {
        Bvh::new(&self.boxes())
    }

    /// Area-weighted unit normals per vertex; zero where a vertex has no area around it.
    pub fn vertex_normals(&self) -> Vec<DVec3> {
        vertex_normals(&self.positions, &self.triangles)
    }
}

/// Lower and upper corner of the bounding box of `points`; zeros when there are none.
pub fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    let Some(&first) = points.first() else {
        return (DVec3::ZERO, DVec3::ZERO);
    };
    points.iter().fold((first, first), |(lo, hi), &p| (lo.min(p), hi.max(p)))
}

/// Area-weighted unit normals per vertex; zero where a vertex has no area around it.
pub fn vertex_normals(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; positions.len()];
    for t in triangles {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        let n = (b - a).cross(c - a);
        for &v in t {
            normals[v as usize] += n;
        }
    }
    for n in &mut normals {
        *n = n.normalize_or_zero();
    }
    normals
}
