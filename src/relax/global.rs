//! The global step: with every triangle's turn held, all vertices at once.
//!
//! The energy sum over triangles of sum over corners |x - c - R w|^2 has, with c eliminated, the constant matrix
//! sum of (I - 1 1^T / 3): a graph Laplacian, factored by sparse Cholesky. Contact sits on its diagonal, with the same
//! active set on the right-hand side; the factor is renewed when that set has changed by more than a fiftieth.

use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use glam::DVec3;

use crate::cloth::{Counters, Garment};
use crate::geometry::factor::{Factor, Symbolic};

/// Refactor when more than this share of the weights on the diagonal changed, unless told otherwise.
pub const STALE_SHARE: f64 = 0.02;

/// The factored matrix of a garment, over the triangles mapped so far.
#[derive(Clone, Debug)]
pub struct GlobalSolver {
    pattern: SymbolicSparseColMat<usize>,
    symbolic: Symbolic,
    /// Where each vertex's diagonal value stands.
    diagonal: Vec<usize>,
    /// Where each edge's value stands.
    off_diagonal: Vec<usize>,
    /// Values of the triangles alone.
    base: Vec<f64>,
    /// Diagonal weights that are in the factor.
    weights: Vec<f64>,
    factor: Option<Factor>,
    stale_share: f64,
}

impl GlobalSolver {
    /// The matrix over all of `garment`, with no triangle in it yet. None when the factor would not fit in memory.
    pub fn new(garment: &Garment) -> Option<Self> {
        // One thread: the order of sums must not depend on how many there are.
        faer::set_global_parallelism(faer::Par::Seq);
        let n = garment.vertex_count;
        let edges = &garment.adjacency.edges;
        // Lower triangle, by column: the diagonal, then the higher neighbours in order.
        let mut columns: Vec<usize> = vec![1; n];
        for e in edges {
            columns[e[0] as usize] += 1;
        }
        let mut starts = vec![0; n + 1];
        for v in 0..n {
            starts[v + 1] = starts[v] + columns[v];
        }
        let mut rows = vec![0; starts[n]];
        let diagonal: Vec<usize> = starts[..n].to_vec();
        for v in 0..n {
            rows[starts[v]] = v;
        }
        let mut next: Vec<usize> = diagonal.iter().map(|&s| s + 1).collect();
        let mut off_diagonal = Vec::with_capacity(edges.len());
        for e in edges {
            let slot = &mut next[e[0] as usize];
            rows[*slot] = e[1] as usize;
            off_diagonal.push(*slot);
            *slot += 1;
        }
        let values = rows.len();
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let symbolic = Symbolic::new(pattern.as_ref())?;
        Some(Self {
            pattern,
            symbolic,
            diagonal,
            off_diagonal,
            base: vec![0.0; values],
            weights: vec![0.0; n],
            factor: None,
            stale_share: STALE_SHARE,
        })
    }

    /// Bytes it takes without the factor, which is made from the rest.
    pub fn bytes(&self) -> usize {
        let index =
            self.diagonal.len() + self.off_diagonal.len() + self.pattern.compute_nnz() + self.weights.len();
        (index + self.base.len() + self.weights.len()) * size_of::<f64>()
    }

    /// Sets which triangles take part. The next solve factors anew.
    pub fn set_triangles(&mut self, garment: &Garment, mapped: &[bool]) {
        self.base.fill(0.0);
        for (t, vs) in garment.triangles.iter().enumerate() {
            if !vs.iter().all(|&v| mapped[v as usize]) {
                continue;
            }
            for v in vs {
                self.base[self.diagonal[*v as usize]] += 2.0 / 3.0;
            }
            for e in garment.adjacency.triangle_edges[t] {
                self.base[self.off_diagonal[e as usize]] -= 1.0 / 3.0;
            }
        }
        self.factor = None;
    }

    /// From now on the factor is renewed when more than this share (0..=1) of the weights has changed.
    pub fn refactor_beyond(&mut self, share: f64) {
        self.stale_share = share;
    }

    /// The next solve factors anew, however few weights have changed.
    pub fn forget_factor(&mut self) {
        self.factor = None;
    }

    /// Solves for how far each vertex goes, in place of the `forces` on them (of turned corners, and others). `weights`
    /// stands on the diagonal and pulls each vertex by the way to its target in `pulls`; where the factor holds older
    /// weights, those pull, so that matrix and right-hand side always agree.
    pub fn solve(
        &mut self,
        weights: &[f64],
        forces: &mut [DVec3],
        pulls: &[DVec3],
        counters: &mut Counters,
    ) -> bool {
        if self.factor.is_none() || self.stale(weights) {
            self.weights.copy_from_slice(weights);
            if !self.refactor(counters) {
                return false;
            }
        }
        let Some(factor) = &self.factor else { return false };
        for ((force, pull), weight) in forces.iter_mut().zip(pulls).zip(&self.weights) {
            *force += *pull * *weight;
        }
        if !factor.solve(forces) {
            return false;
        }
        counters.solves += 1;
        true
    }

    fn stale(&self, weights: &[f64]) -> bool {
        let changed = weights.iter().zip(&self.weights).filter(|(a, b)| a != b).count();
        changed as f64 > self.stale_share * weights.len() as f64
    }

    fn refactor(&mut self, counters: &mut Counters) -> bool {
        let mut values = self.base.clone();
        for (v, &slot) in self.diagonal.iter().enumerate() {
            values[slot] += self.weights[v];
        }
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), &values);
        self.factor = self.symbolic.factor(matrix, self.factor.take());
        counters.factorisations += 1;
        self.factor.is_some()
    }
}
