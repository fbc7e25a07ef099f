//! Wedges of cloth: its flat corners, split where fold lines run through them within a piece, so that the sides of a pressed fold can
//! have normals of their own as the sides of a seam have.

use std::collections::BTreeSet;

use crate::cloth::Garment;

/// The wedges of a garment. They do not depend on its shape.
#[derive(Clone, Debug)]
pub struct Wedges {
    /// The flat corner that each belongs to: every corner once in their order, then, in the same order, the corners whose triangles
    /// fold lines part, once for each further part.
    pub corners: Vec<u32>,
    /// The three wedges of each triangle of the garment.
    pub triangles: Vec<[u32; 3]>,
}

impl Wedges {
    /// The wedges of `garment`.
    pub fn new(garment: &Garment) -> Self {
        let mut corners: Vec<u32> = (0..garment.corners.len() as u32).collect();
        let mut triangles = garment.triangle_corners.clone();
        let folds: BTreeSet<[u32; 2]> =
            garment.trims.folds.iter().map(|fold| ordered(fold.corners)).collect();
        let mut around: Vec<Option<Vec<usize>>> = vec![None; corners.len()];
        for &corner in folds.iter().flatten() {
            around[corner as usize] = Some(Vec::new());
        }
        for (t, own) in garment.triangle_corners.iter().enumerate() {
            for corner in own {
                if let Some(triangles) = &mut around[*corner as usize] {
                    triangles.push(t);
                }
            }
        }
        for (corner, around) in around.into_iter().enumerate() {
            let (corner, Some(around)) = (corner as u32, around) else { continue };
            let parts = parts(corner, &around, &garment.triangle_corners, &folds);
            for part in parts.iter().skip(1) {
                let wedge = corners.len() as u32;
                corners.push(corner);
                for &t in part {
                    triangles[t].iter_mut().filter(|c| **c == corner).for_each(|c| *c = wedge);
                }
            }
        }
        Self { corners, triangles }
    }
}

fn ordered([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The triangles `around` a corner in parts that are joined by edges that are no `folds`, that of the first triangle first.
fn parts(
    corner: u32,
    around: &[usize],
    triangles: &[[u32; 3]],
    folds: &BTreeSet<[u32; 2]>,
) -> Vec<Vec<usize>> {
    let is_joined = |a: usize, b: usize| {
        let is_shared = |c: &&u32| **c != corner && triangles[b].contains(c);
        triangles[a].iter().filter(is_shared).any(|&c| !folds.contains(&ordered([corner, c])))
    };
    let mut left: Vec<usize> = around.to_vec();
    let mut parts = Vec::new();
    while !left.is_empty() {
        let mut part = vec![left.remove(0)];
        let mut next = 0;
        while let Some(&t) = part.get(next) {
            let (joined, others): (Vec<usize>, Vec<usize>) =
                left.iter().partition(|&&other| is_joined(t, other));
            part.extend(joined);
            left = others;
            next += 1;
        }
        parts.push(part);
    }
    parts
}
