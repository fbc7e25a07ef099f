//! Folds of cloth: neighbouring faces whose normals point against each other.

use glam::DVec3;

use crate::cloth::{ClothState, Garment};
use crate::relax::step::FOLDED;

/// Inner edges of a garment, where folds are counted.
#[derive(Clone, Debug)]
pub(super) struct Folds {
    faces: Vec<[[u32; 3]; 2]>,
    /// Folded edges when the cloth was bound.
    pub bound: usize,
    /// Folded edges up to which the cloth counts as no more folded than then.
    pub most: usize,
}

impl Folds {
    /// The inner edges of the laid part of `garment`.
    pub fn of(garment: &Garment, cloth: &ClothState) -> Self {
        let laid = |t: u32| garment.triangles[t as usize].iter().all(|&v| cloth.mapped[v as usize]);
        let sides = |e: usize| match garment.adjacency.edge_triangles.of(e as u32) {
            &[s, t] if laid(s) && laid(t) => Some([s, t].map(|t| garment.triangles[t as usize])),
            _ => None,
        };
        let faces = (0..garment.adjacency.edges.len()).filter_map(sides).collect();
        let mut folds = Self { faces, bound: 0, most: 0 };
        folds.bound = folds.count(cloth);
        // Where sleeves come down some cloth has to fold. Intermediate poses leave such folds, too: 15 among the 15,000 inner edges of
        // a T-shirt that comes to walking directly with 11.
        folds.most = folds.bound + folds.faces.len() / 1000;
        folds
    }

    /// Number of folded edges.
    pub fn count(&self, cloth: &ClothState) -> usize {
        let normal = |vs: [u32; 3]| {
            let [a, b, c] = vs.map(|v| cloth.positions[v as usize]);
            (b - a).cross(c - a)
        };
        let folded = |[s, t]: &&[[u32; 3]; 2]| {
            let [m, n]: [DVec3; 2] = [normal(*s), normal(*t)];
            m.dot(n) < FOLDED * m.length() * n.length()
        };
        self.faces.iter().filter(folded).count()
    }
}
