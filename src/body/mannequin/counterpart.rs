//! Correspondence between mannequins of two sizes, which are meshed separately and have different triangles.

use glam::DVec3;

use super::Mannequin;
use crate::body::surface::Surface;
use crate::body::warp::Warp;
use crate::geometry::barycentric;
use crate::geometry::mesh::TriMesh;

/// For each vertex of one mannequin the corresponding point on the skin of another.
#[derive(Clone, Debug)]
pub struct Counterpart {
    /// For each vertex a triangle of the other mannequin and barycentric coordinates in it.
    places: Vec<(u32, [f64; 3])>,
}

impl Counterpart {
    /// Maps the vertices of `one` to `other`: a smooth map takes the landmarks and joints of `one` to those of `other`, both
    /// as built; then the nearest point of the skin is taken. None when `other` has no skin or they share too few points.
    pub fn new(one: &Mannequin, other: &Mannequin) -> Option<Self> {
        let skin = Surface::new(other.mesh.clone())?;
        let marks = one.landmarks.iter().filter_map(|(name, p)| Some((p, other.landmarks.get(name)?)));
        let joints = one.skeleton.joints.iter();
        let joints = joints.filter_map(|joint| Some((joint.position, other.skeleton.position(&joint.name)?)));
        let warp = Warp::new(&marks.chain(joints).collect::<Vec<_>>())?;
        let place = |p: &DVec3| {
            let near = skin.nearest(warp.image(*p));
            (near.triangle, barycentric::on_triangle(near.point, skin.mesh.corners(near.triangle as usize)))
        };
        Some(Self { places: one.mesh.positions.iter().map(place).collect() })
    }

    /// Positions of the mapped vertices, where `mesh` is the other mannequin's mesh in any pose.
    pub fn positions(&self, mesh: &TriMesh) -> Vec<DVec3> {
        let place = |&(t, shares): &(u32, [f64; 3])| barycentric::place(shares, mesh.corners(t as usize));
        self.places.iter().map(place).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::mannequin::{self, Measurements};

    #[test]
    fn places_of_one_size_are_found_on_another() {
        let one = mannequin::default();
        let large = [("height", 1.72), ("bust", 1.04), ("waist", 0.86), ("hip", 1.12)];
        let large =
            Measurements::completed(|name| large.iter().find(|(known, _)| *known == name).map(|(_, x)| *x));
        let other = mannequin::mannequin(&large).expect("a size");
        let same = Counterpart::new(&one, &other).expect("the same figure");
        let there = TriMesh { positions: same.positions(&other.mesh), ..one.mesh.clone() };
        // It is the other's skin, no part of it inside out.
        let skin = Surface::new(other.mesh.clone()).expect("a skin");
        let turned = (0..there.triangles.len()).filter(|&t| {
            let [a, b, c] = there.corners(t);
            let normal = skin.nearest((a + b + c) / 3.0);
            (b - a).cross(c - a).dot(skin.face_normals[normal.triangle as usize]) <= 0.0
        });
        let share = turned.count() as f64 / there.triangles.len() as f64;
        assert!(share < 0.01, "{share}");
        let marks = ["bust_point_left", "waist_side_right", "hip_back", "elbow_left", "armpit_right"];
        for name in marks {
            let at = one.landmarks.get(name).expect(name);
            let nearest = |p: DVec3, mesh: &TriMesh| {
                let off = |v: &usize| mesh.positions[*v].distance(p);
                (0..mesh.positions.len()).min_by(|a, b| off(a).total_cmp(&off(b))).expect("vertices")
            };
            let v = nearest(at, &one.mesh);
            let expected = other.landmarks.get(name).expect(name);
            let off = there.positions[v].distance(expected);
            assert!(off < 0.02, "{name}: {off}");
        }
        let itself = Counterpart::new(&one, &one).expect("itself").positions(&one.mesh);
        assert!(itself.iter().zip(&one.mesh.positions).all(|(p, q)| p.distance(*q) < 1e-9));
    }
}
