//! The same places on mannequins of two sizes, whose triangles are not the same: each is meshed by itself.

use glam::DVec3;

use super::Mannequin;
use crate::body::surface::Surface;
use crate::body::warp::Warp;
use crate::geometry::barycentric;
use crate::geometry::mesh::TriMesh;

/// For each vertex of one mannequin its place on another.
#[derive(Clone, Debug)]
pub struct Counterpart {
    /// A triangle of the other, and how much of each of its corners.
    places: Vec<(u32, [f64; 3])>,
}

impl Counterpart {
    /// Of `one` on `other`. A smooth map takes landmarks and joints of the one to those of the other, as both were built; from
    /// there it is the nearest skin. None when the other has no skin or they have too little in common.
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

    /// Where the vertices of the one are on the skin of the other, which is `mesh` now: in any pose.
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
