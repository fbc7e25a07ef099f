//! Flattening of folds at inner edges (paper A, Figure 22).
//!
//! For edge (0, 1) with opposite vertices 2 and 3 the vector K holds the cotangents of isometric bending. Its entries
//! sum to zero, so that dx = -alpha K (sum K X) / (sum K^2) keeps momentum and, at alpha 1, flattens that hinge exactly.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::cloth::Garment;
use crate::geometry::adjacency::Lists;
use crate::geometry::parallel::LEAST_SHARE;

/// Cosines between the skin normals at a hinge and their mean. All above the second value: one surface; any below the first: two
/// limbs, or the two sides of a fold; between them it is blended. About 45° and 26°. Chosen by trial.
const AGREE: [f64; 2] = [0.7, 0.9];

/// A hinge: an inner edge and its two opposite vertices, with the weights K.
#[derive(Clone, Copy, Debug)]
struct Hinge {
    vertices: [u32; 4],
    k: [f64; 4],
}

/// All hinges of a garment, and for each vertex its hinges.
#[derive(Clone, Debug, Default)]
pub struct Hinges {
    hinges: Vec<Hinge>,
    /// For each vertex its places in hinges: four times the hinge, plus the index of the vertex in it.
    per_vertex: Lists,
    /// For each item of `per_vertex` the weight K of the vertex in that hinge.
    shares: Vec<f64>,
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
        let per_vertex = Lists::grouped(
            garment.vertex_count,
            hinges
                .iter()
                .enumerate()
                .flat_map(|(h, hinge)| (0..4).map(move |k| (hinge.vertices[k], (h * 4 + k) as u32))),
        );
        let share = |&slot: &u32| hinges[slot as usize / 4].k[slot as usize % 4];
        let shares = per_vertex.items().iter().map(share).collect();
        Self { hinges, per_vertex, shares }
    }

    /// Memory used, bytes.
    pub fn bytes(&self) -> usize {
        self.hinges.len() * size_of::<Hinge>()
            + self.per_vertex.bytes()
            + self.shares.len() * size_of::<f64>()
    }

    /// For each hinge the bend to be removed, as (sum K X) / (sum K^2). `lies` tells how vertices are in contact with
    /// the body. A hinge in contact is bent as the body is: only its deviation from the skin is flattened, because to
    /// flatten all of it would strain the cloth.
    pub fn bends(&self, positions: &[DVec3], lies: &Lies) -> Vec<DVec3> {
        let bend = |hinge: &Hinge| {
            let size: f64 = hinge.k.iter().map(|k| k * k).sum();
            hinge.bend(positions, lies).unwrap_or_default() / size
        };
        self.hinges.par_iter().with_min_len(LEAST_SHARE).map(bend).collect()
    }

    /// The flattening move of `vertex`, metres: the mean over its hinges with these `bends`; `alpha` in 0..=1.
    pub fn displacement(&self, vertex: u32, bends: &[DVec3], alpha: f64) -> DVec3 {
        let mine = self.per_vertex.of(vertex);
        let shares = &self.shares[self.per_vertex.places(vertex)];
        let move_of = |(&slot, &share): (&u32, &f64)| bends[slot as usize / 4] * (-alpha * share);
        mine.iter().zip(shares).map(move_of).sum::<DVec3>() / mine.len().max(1) as f64
    }
}

/// Contact of vertices with the body, as flattening needs it.
#[derive(Clone, Debug, Default)]
pub struct Lies {
    /// For each vertex the outward normal of the skin next to it (zero where there is none), and its height above the
    /// kept offset, metres.
    pub skin: Vec<(DVec3, f64)>,
    /// For each vertex its degree of contact: 1 on the skin, 0 away from it, and between; None where it is not placed.
    pub touch: Vec<Option<f64>>,
}

impl Hinge {
    /// The bend to be removed, as sum of K X. None when not all vertices are placed.
    fn bend(&self, positions: &[DVec3], lies: &Lies) -> Option<DVec3> {
        let mut touch: f64 = 1.0;
        for v in self.vertices {
            touch = touch.min(lies.touch[v as usize]?);
        }
        let all: DVec3 = (0..4).map(|i| positions[self.vertices[i] as usize] * self.k[i]).sum();
        if touch == 0.0 {
            return Some(all);
        }
        let lies = self.vertices.map(|v| lies.skin[v as usize]);
        let mean: DVec3 = lies.iter().map(|(normal, _)| normal).sum::<DVec3>().normalize_or_zero();
        let agree = lies.iter().map(|(normal, _)| normal.dot(mean)).fold(1.0, f64::min);
        let with_body = touch * ((agree - AGREE[0]) / (AGREE[1] - AGREE[0])).clamp(0.0, 1.0);
        if with_body == 0.0 {
            return Some(all);
        }
        let standing_out: DVec3 = (0..4).map(|i| lies[i].0 * (lies[i].1 * self.k[i])).sum();
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

/// The vertex of triangle `t` opposite edge `ab`, and the cotangents of its rest angles at `a` and `b`.
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
