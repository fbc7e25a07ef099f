//! Strain relative to the lengths that edges had when the cloth was bound.

use crate::cloth::{ClothState, Garment};
use crate::geometry::adjacency::Lists;

/// Edge lengths at binding.
#[derive(Clone, Debug)]
pub(super) struct Lengths {
    edges: Vec<([u32; 2], f64)>,
    /// For each vertex its edges, as indices into `edges`.
    around: Lists,
    /// The other end of each of these.
    others: Vec<u32>,
}

impl Lengths {
    /// Lengths of the laid edges of `garment`.
    pub fn of(garment: &Garment, cloth: &ClothState) -> Self {
        let laid = |e: &&[u32; 2]| e.iter().all(|&v| cloth.mapped[v as usize]);
        let length = |[a, b]: [u32; 2]| cloth.positions[a as usize].distance(cloth.positions[b as usize]);
        let edges = garment.adjacency.edges.iter().filter(laid).map(|&e| (e, length(e)));
        // Edges without a length have no strain.
        let edges: Vec<([u32; 2], f64)> = edges.filter(|(_, l)| *l > 1e-9).collect();
        let ends = (0u32..).zip(&edges).flat_map(|(e, (ends, _))| ends.map(|v| (v, e)));
        let around = Lists::grouped(garment.vertex_count, ends);
        let other = |v: u32, e: u32| {
            let [a, b] = edges[e as usize].0;
            if a == v { b } else { a }
        };
        let vertices = 0..garment.vertex_count as u32;
        let others = vertices.flat_map(|v| around.of(v).iter().map(move |&e| (v, e)));
        let others = others.map(|(v, e)| other(v, e)).collect();
        Self { edges, around, others }
    }

    /// Each edge with its length at binding, metres.
    pub fn edges(&self) -> &[([u32; 2], f64)] {
        &self.edges
    }

    /// The edges at `vertex`, as indices into [`Lengths::edges`], each with its other end.
    pub fn around(&self, vertex: u32) -> impl Iterator<Item = (u32, u32)> {
        let others = &self.others[self.around.places(vertex)];
        self.around.of(vertex).iter().copied().zip(others.iter().copied())
    }

    /// 99th percentile of |l / l_before - 1|; zero without edges.
    pub fn p99(&self, cloth: &ClothState) -> f64 {
        let change = |&([a, b], before): &([u32; 2], f64)| {
            let now = cloth.positions[a as usize].distance(cloth.positions[b as usize]);
            (now / before - 1.0).abs()
        };
        let mut changes: Vec<f64> = self.edges.iter().map(change).collect();
        let at = (changes.len() * 99 / 100).min(changes.len().saturating_sub(1));
        if changes.is_empty() {
            return 0.0;
        }
        *changes.select_nth_unstable_by(at, f64::total_cmp).1
    }
}
