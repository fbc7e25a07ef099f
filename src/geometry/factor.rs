//! A sparse Cholesky factor (faer), solved for all three axes at once: with so few right-hand sides the calls of a general
//! solver cost more than the numbers.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Par, Side, Spec};
use glam::DVec3;

/// What sums run in at once: their order is fixed, whatever the machine has.
const LANES: usize = 4;

/// Where the numbers of a factor stand.
#[derive(Clone, Debug)]
pub struct Symbolic(Arc<SymbolicCholesky<usize>>);

/// The numbers.
#[derive(Clone, Debug)]
pub struct Factor {
    symbolic: Symbolic,
    values: Vec<f64>,
}

impl Symbolic {
    /// For a matrix of which the lower triangle is given. None when it does not fit in memory.
    pub fn new(pattern: SymbolicSparseColMatRef<'_, usize>) -> Option<Self> {
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic = factorize_symbolic_cholesky(pattern, Side::Lower, SymmetricOrdering::Amd, params);
        Some(Self(Arc::new(symbolic.ok()?)))
    }

    /// Columns whose rows below them are the same stand together.
    fn groups(&self) -> Option<&SymbolicSupernodalCholesky<usize>> {
        match self.0.raw() {
            SymbolicCholeskyRaw::Supernodal(groups) => Some(groups),
            SymbolicCholeskyRaw::Simplicial(_) => None,
        }
    }

    /// Factors `matrix`. None when it is not positive definite, or does not fit in memory.
    pub fn factor(&self, matrix: SparseColMatRef<'_, usize, f64>) -> Option<Factor> {
        let mut values = vec![0.0; self.0.len_val()];
        let need = self.0.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(need).ok()?;
        let stack = MemStack::new(&mut memory);
        let regularization = LltRegularization::default();
        self.0
            .factorize_numeric_llt(
                &mut values,
                matrix,
                Side::Lower,
                regularization,
                Par::Seq,
                stack,
                Spec::default(),
            )
            .ok()?;
        Some(Factor { symbolic: self.clone(), values })
    }
}

/// Rows below a group, axis by axis.
struct Below([Vec<f64>; 3]);

impl Below {
    fn clear(&mut self, count: usize) {
        for axis in &mut self.0 {
            axis.clear();
            axis.resize(count, 0.0);
        }
    }

    fn add(&mut self, column: &[f64], times: DVec3) {
        for (axis, times) in self.0.iter_mut().zip(times.to_array()) {
            axis.iter_mut().zip(column).for_each(|(sum, l)| *sum += l * times);
        }
    }

    fn dot(&self, column: &[f64]) -> DVec3 {
        DVec3::from_array([0, 1, 2].map(|axis| dot(&self.0[axis], column)))
    }

    fn get(&self, row: usize) -> DVec3 {
        DVec3::new(self.0[0][row], self.0[1][row], self.0[2][row])
    }

    fn set(&mut self, row: usize, x: DVec3) {
        self.0.iter_mut().zip(x.to_array()).for_each(|(axis, x)| axis[row] = x);
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    let (a, b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for k in 0..LANES {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum::<f64>() + rest
}

impl Factor {
    /// Solves in place of the right-hand sides. False when there is nothing to solve with.
    pub fn solve(&self, sides: &mut [DVec3]) -> bool {
        let (Some(groups), Some(order)) = (self.symbolic.groups(), self.symbolic.0.perm()) else {
            return false;
        };
        let (forward, back) = order.arrays();
        let mut x: Vec<DVec3> = forward.iter().map(|&v| sides[v]).collect();
        let mut below = Below(Default::default());
        for s in 0..groups.n_supernodes() {
            let group = self.group(groups, s);
            below.clear(group.rows.len());
            for (j, column) in group.columns().enumerate() {
                let (at, own) = (group.start + j, &column[..group.size]);
                x[at] /= own[j];
                let done = x[at];
                for i in j + 1..group.size {
                    x[group.start + i] -= done * own[i];
                }
                below.add(&column[group.size..], done);
            }
            for (k, &row) in group.rows.iter().enumerate() {
                x[row] -= below.get(k);
            }
        }
        for s in (0..groups.n_supernodes()).rev() {
            let group = self.group(groups, s);
            below.clear(group.rows.len());
            for (k, &row) in group.rows.iter().enumerate() {
                below.set(k, x[row]);
            }
            for (j, column) in group.columns().enumerate().rev() {
                let (at, own) = (group.start + j, &column[..group.size]);
                let mut sum = below.dot(&column[group.size..]);
                for i in j + 1..group.size {
                    sum += x[group.start + i] * own[i];
                }
                x[at] = (x[at] - sum) / own[j];
            }
        }
        sides.iter_mut().zip(back).for_each(|(side, &at)| *side = x[at]);
        true
    }

    fn group<'a>(&'a self, groups: &'a SymbolicSupernodalCholesky<usize>, s: usize) -> Group<'a> {
        let (start, end) = (groups.supernode_begin()[s], groups.supernode_end()[s]);
        let rows = &groups.row_idx()[groups.col_ptr_for_row_idx()[s]..][..groups.nnz_per_super()[s]];
        let values = &self.values[groups.col_ptr_for_val()[s]..groups.col_ptr_for_val()[s + 1]];
        Group { start, size: end - start, rows, values }
    }
}

/// Columns that stand together: a triangle on the diagonal, and the rows below it.
struct Group<'a> {
    start: usize,
    size: usize,
    rows: &'a [usize],
    values: &'a [f64],
}

impl Group<'_> {
    fn columns(&self) -> impl DoubleEndedIterator<Item = &[f64]> + ExactSizeIterator {
        self.values.chunks_exact(self.size + self.rows.len())
    }
}
