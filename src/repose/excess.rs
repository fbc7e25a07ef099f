//! Strain relative to the lengths that edges had when the cloth was bound.

use crate::cloth::{ClothState, Garment};

/// Edge lengths at binding.
#[derive(Clone, Debug)]
pub(super) struct Lengths {
    edges: Vec<([u32; 2], f64)>,
}

impl Lengths {
    /// Lengths of the laid edges of `garment`.
    pub fn of(garment: &Garment, cloth: &ClothState) -> Self {
        let laid = |e: &&[u32; 2]| e.iter().all(|&v| cloth.mapped[v as usize]);
        let length = |[a, b]: [u32; 2]| cloth.positions[a as usize].distance(cloth.positions[b as usize]);
        let edges = garment.adjacency.edges.iter().filter(laid).map(|&e| (e, length(e)));
        // Edges without a length have no strain.
        Self { edges: edges.filter(|(_, l)| *l > 1e-9).collect() }
    }

    /// Each edge with its length at binding, metres.
    pub fn edges(&self) -> &[([u32; 2], f64)] {
        &self.edges
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
