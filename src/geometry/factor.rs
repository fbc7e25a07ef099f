//! A sparse Cholesky factor (faer), solved for one right-hand side or for all three axes at once: with so few of them the calls
//! of a general solver cost more than the numbers.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, SymbolicSupernodalParams};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Par, Side, Spec};
use glam::DVec3;

/// What sums run in at once, for three axes and for one: their order is fixed, whatever the machine has.
const LANES: [usize; 2] = [4, 8];
/// In a matrix with an order of its own, groups of up to so many columns may be joined when they then hold at most this share
/// of zeros.
const RELAX: [(usize, f64); 3] = [(4, 1.0), (16, 0.8), (48, 0.1)];

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
        Self::by(pattern, SymmetricOrdering::Amd, Default::default())
    }

    /// The same with rows eliminated in `order`.
    pub fn ordered(pattern: SymbolicSparseColMatRef<'_, usize>, order: &[usize]) -> Option<Self> {
        let mut back = vec![0; order.len()];
        order.iter().enumerate().for_each(|(at, &row)| back[row] = at);
        let order = PermRef::new_checked(order, &back, order.len());
        let params = SymbolicSupernodalParams { relax: Some(&RELAX) };
        Self::by(pattern, SymmetricOrdering::Custom(order), params)
    }

    fn by(
        pattern: SymbolicSparseColMatRef<'_, usize>,
        ordering: SymmetricOrdering<'_, usize>,
        supernodal_params: SymbolicSupernodalParams<'_>,
    ) -> Option<Self> {
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            supernodal_params,
            ..Default::default()
        };
        let symbolic = factorize_symbolic_cholesky(pattern, Side::Lower, ordering, params);
        Some(Self(Arc::new(symbolic.ok()?)))
    }

    /// Numbers a factor has.
    pub fn fill(&self) -> usize {
        self.0.len_val()
    }

    /// Columns whose rows below them are the same stand together.
    fn groups(&self) -> Option<&SymbolicSupernodalCholesky<usize>> {
        match self.0.raw() {
            SymbolicCholeskyRaw::Supernodal(groups) => Some(groups),
            SymbolicCholeskyRaw::Simplicial(_) => None,
        }
    }

    /// Factors `matrix`, in the memory of a factor that is no longer needed. None when it is not positive definite, or does not
    /// fit in memory.
    pub fn factor(&self, matrix: SparseColMatRef<'_, usize, f64>, memory: Option<Factor>) -> Option<Factor> {
        let mut values = memory.map(|f| f.values).unwrap_or_default();
        values.clear();
        values.resize(self.0.len_val(), 0.0);
        let need = self.0.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(need).ok()?;
        let stack = MemStack::new(&mut memory);
        self.0
            .factorize_numeric_llt(
                &mut values,
                matrix,
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                stack,
                Spec::default(),
            )
            .ok()?;
        values.iter().all(|v| v.is_finite()).then(|| Factor { symbolic: self.clone(), values })
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
            add_times(axis, column, times);
        }
    }

    fn dot(&self, column: &[f64]) -> DVec3 {
        DVec3::from_array([0, 1, 2].map(|axis| dot::<{ LANES[0] }>(&self.0[axis], column)))
    }

    fn get(&self, row: usize) -> DVec3 {
        DVec3::new(self.0[0][row], self.0[1][row], self.0[2][row])
    }

    fn set(&mut self, row: usize, x: DVec3) {
        self.0.iter_mut().zip(x.to_array()).for_each(|(axis, x)| axis[row] = x);
    }
}

fn dot<const LANES: usize>(a: &[f64], b: &[f64]) -> f64 {
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

fn add_times(sum: &mut [f64], column: &[f64], times: f64) {
    sum.iter_mut().zip(column).for_each(|(sum, l)| *sum += l * times);
}

impl Factor {
    /// Solves in place of the right-hand sides, one an axis. False when there is nothing to solve with.
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

    /// Solves in place of the right-hand side. False when there is nothing to solve with.
    pub fn solve_one(&self, side: &mut [f64]) -> bool {
        let (Some(groups), Some(order)) = (self.symbolic.groups(), self.symbolic.0.perm()) else {
            return false;
        };
        let (forward, _) = order.arrays();
        let mut x: Vec<f64> = forward.iter().map(|&v| side[v]).collect();
        let mut below: Vec<f64> = Vec::new();
        for s in 0..groups.n_supernodes() {
            let group = self.group(groups, s);
            below.clear();
            below.resize(group.rows.len(), 0.0);
            let own = &mut x[group.start..group.start + group.size];
            for (j, column) in group.columns().enumerate() {
                own[j] /= column[j];
                let done = own[j];
                add_times(&mut own[j + 1..], &column[j + 1..group.size], -done);
                add_times(&mut below, &column[group.size..], done);
            }
            for (&row, sum) in group.rows.iter().zip(&below) {
                x[row] -= sum;
            }
        }
        for s in (0..groups.n_supernodes()).rev() {
            let group = self.group(groups, s);
            below.clear();
            below.extend(group.rows.iter().map(|&row| x[row]));
            let own = &mut x[group.start..group.start + group.size];
            for (j, column) in group.columns().enumerate().rev() {
                let sum = dot::<{ LANES[1] }>(&below, &column[group.size..])
                    + dot::<{ LANES[1] }>(&own[j + 1..], &column[j + 1..group.size]);
                own[j] = (own[j] - sum) / column[j];
            }
        }
        forward.iter().zip(&x).for_each(|(&v, &x)| side[v] = x);
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
