//! Flattening of folds across inner edges (paper A, Figure 22).
//!
//! For edge (0, 1) with opposite vertices 2 and 3 the vector K holds the cotangents of isometric bending; its entries sum to
//! zero, so that dx = -alpha K (sum K X) / (sum K^2) keeps momentum and, at alpha 1, flattens that hinge exactly.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::cloth::Garment;

/// Skin belongs to one surface when the cosines of its normals to their mean are above the second, to two limbs or the two
/// sides of a fold when below the first.
const AGREE: [f64; 2] = [0.7, 0.9];
/// Hinges one thread takes at a time.
const LEAST_SHARE: usize = 512;

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

    /// For each hinge what has to go of it, by its size. `lies` tells of every vertex how it lies, None where it is not laid.
    /// A hinge that lies on the body is bent as the body is: of it only what stands out from the skin is flattened, for to
    /// flatten all of it would strain the cloth.
    pub fn bends(&self, positions: &[DVec3], lies: &[Option<Lie>]) -> Vec<DVec3> {
        let bend = |hinge: &Hinge| {
            let size: f64 = hinge.k.iter().map(|k| k * k).sum();
            hinge.bend(positions, lies).unwrap_or_default() / size
        };
        self.hinges.par_iter().with_min_len(LEAST_SHARE).map(bend).collect()
    }

    /// The flattening move of `vertex`: the mean over its hinges, `alpha` in 0..=1, when they are bent by `bends`.
    pub fn displacement(&self, vertex: u32, bends: &[DVec3], alpha: f64) -> DVec3 {
        let mine = self.per_vertex.of(vertex);
        let move_of = |&slot: &u32| {
            let at = slot as usize / 4;
            bends[at] * (-alpha * self.hinges[at].k[slot as usize % 4])
        };
        mine.iter().map(move_of).sum::<DVec3>() / mine.len().max(1) as f64
    }
}

/// How a vertex lies on the body.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lie {
    /// Of the skin next to it, outward; zero where there is none.
    pub normal: DVec3,
    /// Metres above the height it is kept at.
    pub height: f64,
    /// 1 on the skin, 0 where it is free of it, and between.
    pub touch: f64,
}

impl Hinge {
    /// What has to go, as sum of K X. None when not all of it is laid.
    fn bend(&self, positions: &[DVec3], lies: &[Option<Lie>]) -> Option<DVec3> {
        let [a, b, c, d] = self.vertices.map(|v| lies[v as usize]);
        let lies = [a?, b?, c?, d?];
        let all: DVec3 = (0..4).map(|i| positions[self.vertices[i] as usize] * self.k[i]).sum();
        let touch = lies.iter().map(|lie| lie.touch).fold(1.0, f64::min);
        if touch == 0.0 {
            return Some(all);
        }
        let mean: DVec3 = lies.iter().map(|lie| lie.normal).sum::<DVec3>().normalize_or_zero();
        let agree = lies.iter().map(|lie| lie.normal.dot(mean)).fold(1.0, f64::min);
        let with_body = touch * ((agree - AGREE[0]) / (AGREE[1] - AGREE[0])).clamp(0.0, 1.0);
        if with_body == 0.0 {
            return Some(all);
        }
        let standing_out: DVec3 = (0..4).map(|i| lies[i].normal * (lies[i].height * self.k[i])).sum();
        Some(all.lerp(standing_out, with_body))
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
