//! The global step: solves for all vertices at once, with the rotation of every triangle held.
//!
//! The energy, the sum over triangles of sum over corners |x - c - R w|^2, has, with c eliminated, the constant matrix
//! sum of (I - 1 1^T / 3): a graph Laplacian, factored by sparse Cholesky. Contact is on its diagonal, with the same
//! active set on the right-hand side; the factor is renewed when more than a fiftieth of that set has changed.

use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use glam::DVec3;

use crate::cloth::{Counters, Garment};
use crate::geometry::factor::{Factor, Symbolic};

/// Default fraction of changed diagonal weights above which the matrix is factored again. Chosen by trial; until then contacts act
/// with the weights of the last factor.
pub const STALE_SHARE: f64 = 0.02;
/// That fraction while cloth follows a hand or a body live: contacts come and go all the time. With it, dragging a skirt factored
/// in 6 % of the substeps instead of 19 %.
pub const LIVE_STALE_SHARE: f64 = 0.05;

/// The factored matrix of a garment, over the triangles that are mapped.
#[derive(Clone, Debug)]
pub struct GlobalSolver {
    pattern: SymbolicSparseColMat<usize>,
    symbolic: Symbolic,
    /// For each vertex the index of its diagonal value in the matrix.
    diagonal: Vec<usize>,
    /// For each edge the index of its value in the matrix.
    off_diagonal: Vec<usize>,
    /// Values of the matrix from the triangles alone.
    base: Vec<f64>,
    /// For each vertex the weight that the factor has on the diagonal.
    weights: Vec<f64>,
    factor: Option<Factor>,
    stale_share: f64,
}

impl GlobalSolver {
    /// The matrix over all of `garment`, without triangles yet. None when the factor would not fit in memory.
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

    /// Memory used, bytes, without the factor, which is computed from the rest.
    pub fn bytes(&self) -> usize {
        let index =
            self.diagonal.len() + self.off_diagonal.len() + self.pattern.compute_nnz() + self.weights.len();
        (index + self.base.len() + self.weights.len()) * size_of::<f64>()
    }

    /// Sets which triangles take part, those with all vertices `mapped`. The next solve factors again.
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

    /// Sets the fraction (0..=1) of changed weights above which the matrix is factored again.
    pub fn refactor_beyond(&mut self, share: f64) {
        self.stale_share = share;
    }

    /// Makes the next solve factor again.
    pub fn forget_factor(&mut self) {
        self.factor = None;
    }

    /// Solves for the moves of all vertices, metres, in place of the `forces` on them. `weights` are on the diagonal;
    /// each pulls its vertex along `pulls` to its target. Where the factor has older weights these are used for both,
    /// so that matrix and right-hand side always agree. False when the factorisation fails.
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
