//! Flattening of folds across inner edges (paper A, Figure 22).
//!
//! For edge (0, 1) with opposite vertices 2 and 3 the vector K holds the cotangents of isometric bending; its entries sum to
//! zero, so that dx = -alpha K (sum K X) / (sum K^2) keeps momentum and, at alpha 1, flattens that hinge exactly.

use glam::{DVec2, DVec3};

use crate::cloth::Garment;

/// One inner edge and its two opposite vertices.
#[derive(Clone, Copy, Debug)]
struct Hinge {
    vertices: [u32; 4],
    k: [f64; 4],
}

/// All hinges of a garment, with their vertices' lists.
#[derive(Clone, Debug, Default)]
pub struct Hinges {
    hinges: Vec<Hinge>,
    per_vertex: crate::geometry::adjacency::Lists,
}

impl Hinges {
    /// The hinges of `garment`: edges between exactly two triangles.
    pub fn new(garment: &Garment) -> Self {
        let mut hinges = Vec::new();
        for (e, &[a, b]) in garment.adjacency.edges.iter().enumerate() {
            if let &[s, t] = garment.adjacency.edge_triangles.of(e as u32)
                && let Some(hinge) = hinge(garment, a, b, s, t)
            {
                hinges.push(hinge);
            }
        }
        let per_vertex = crate::geometry::adjacency::Lists::grouped(
            garment.vertex_count,
            hinges
                .iter()
                .enumerate()
                .flat_map(|(h, hinge)| (0..4).map(move |k| (hinge.vertices[k], (h * 4 + k) as u32))),
        );
        Self { hinges, per_vertex }
    }

    /// Bytes they take.
    pub fn bytes(&self) -> usize {
        self.hinges.len() * size_of::<Hinge>() + self.per_vertex.bytes()
    }

    /// The flattening move of `vertex`: the mean over its hinges, `alpha` in 0..=1. Hinges not fully mapped count nothing.
    pub fn displacement(&self, vertex: u32, positions: &[DVec3], mapped: &[bool], alpha: f64) -> DVec3 {
        let mine = self.per_vertex.of(vertex);
        let sum: DVec3 = mine
            .iter()
            .map(|&slot| {
                let hinge = &self.hinges[slot as usize / 4];
                if !hinge.vertices.iter().all(|&v| mapped[v as usize]) {
                    return DVec3::ZERO;
                }
                let bend: DVec3 = (0..4).map(|k| positions[hinge.vertices[k] as usize] * hinge.k[k]).sum();
                let size: f64 = hinge.k.iter().map(|k| k * k).sum();
                bend * (-alpha * hinge.k[slot as usize % 4] / size)
            })
            .sum();
        sum / mine.len().max(1) as f64
    }
}

fn hinge(garment: &Garment, a: u32, b: u32, s: u32, t: u32) -> Option<Hinge> {
    let (c, cot_a_s, cot_b_s) = cotangents(garment, s, a, b)?;
    let (d, cot_a_t, cot_b_t) = cotangents(garment, t, a, b)?;
    if c == d {
        return None;
    }
    let k = [cot_b_s + cot_b_t, cot_a_s + cot_a_t, -cot_a_s - cot_b_s, -cot_a_t - cot_b_t];
    k.iter().all(|k| k.is_finite()).then_some(Hinge { vertices: [a, b, c, d], k })
}

/// The vertex of triangle `t` opposite edge `ab`, and the cotangents of its flat angles at `a` and `b`.
fn cotangents(garment: &Garment, t: u32, a: u32, b: u32) -> Option<(u32, f64, f64)> {
    let vs = garment.triangles[t as usize];
    let corner = |v: u32| vs.iter().position(|&w| w == v);
    let (ia, ib) = (corner(a)?, corner(b)?);
    let ic = 3 - ia - ib;
    let rest = &garment.rest[t as usize];
    let cot = |at: usize, p: usize, q: usize| {
        let (u, v): (DVec2, DVec2) = (rest[p] - rest[at], rest[q] - rest[at]);
        u.dot(v) / u.perp_dot(v).abs()
    };
    Some((vs[ic], cot(ia, ib, ic), cot(ib, ia, ic)))
}
