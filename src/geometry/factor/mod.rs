//! Sparse Cholesky factorisation (faer), solved for one right-hand side or for three (x, y and z) at once. For so
//! few, the calls of a general solver take longer than the arithmetic.

mod axes;
mod trees;

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

use crate::geometry::factor::axes::{Axes, axes, solve_axes};
use crate::geometry::factor::trees::Trees;
use crate::geometry::wide::wide;

/// Number of partial sums for one right-hand side: fixed, so that the order of sums is the same on every machine.
const LANES: usize = 8;
/// Limits for merging supernodes where the caller gives the elimination order: (number of columns, fraction of
/// zeros). A merged supernode with up to this many columns may hold at most this fraction of zeros.
const RELAX: [(usize, f64); 3] = [(4, 1.0), (16, 0.8), (48, 0.1)];

/// The symbolic part of a factor: elimination order and sparsity, shared by all matrices with the same pattern.
#[derive(Clone, Debug)]
pub struct Symbolic {
    matrix: Arc<SymbolicCholesky<usize>>,
    trees: Arc<Trees>,
}

/// A numeric Cholesky factor.
#[derive(Clone, Debug)]
pub struct Factor {
    symbolic: Symbolic,
    values: Vec<f64>,
}

impl Symbolic {
    /// Analyses a symmetric matrix, of which `pattern` is the lower triangle; the order is approximate minimum
    /// degree. None when it does not fit in memory.
    pub fn new(pattern: SymbolicSparseColMatRef<'_, usize>) -> Option<Self> {
        Self::by(pattern, SymmetricOrdering::Amd, Default::default())
    }

    /// Analyses a symmetric matrix, of which `pattern` is the lower triangle, with rows eliminated in `order`. None
    /// when it does not fit in memory.
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
        let matrix = factorize_symbolic_cholesky(pattern, Side::Lower, ordering, params).ok()?;
        let mut symbolic = Self { matrix: Arc::new(matrix), trees: Arc::default() };
        symbolic.trees = Arc::new(symbolic.groups().map(trees).unwrap_or_default());
        Some(symbolic)
    }

    /// Number of values stored in a factor.
    pub fn fill(&self) -> usize {
        self.matrix.len_val()
    }

    /// The supernodes: adjacent columns with the same rows below them.
    fn groups(&self) -> Option<&SymbolicSupernodalCholesky<usize>> {
        match self.matrix.raw() {
            SymbolicCholeskyRaw::Supernodal(groups) => Some(groups),
            SymbolicCholeskyRaw::Simplicial(_) => None,
        }
    }

    /// Factors `matrix`, reusing the memory of a factor that is no longer needed. None when it is not positive
    /// definite, or does not fit in memory.
    pub fn factor(&self, matrix: SparseColMatRef<'_, usize, f64>, memory: Option<Factor>) -> Option<Factor> {
        let mut values = memory.map(|f| f.values).unwrap_or_default();
        values.clear();
        values.resize(self.matrix.len_val(), 0.0);
        let need = self.matrix.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(need).ok()?;
        let stack = MemStack::new(&mut memory);
        self.matrix
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

#[inline(always)]
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

#[inline(always)]
fn add_times(sum: &mut [f64], column: &[f64], times: f64) {
    sum.iter_mut().zip(column).for_each(|(sum, l)| *sum += l * times);
}

impl Factor {
    /// Solves in place for three right-hand sides, the axes of `sides`. False when the factor has no supernodes. Same
    /// input, same bits, on any number of threads.
    pub fn solve(&self, sides: &mut [DVec3]) -> bool {
        let (Some(groups), Some(order)) = (self.symbolic.groups(), self.symbolic.matrix.perm()) else {
            return false;
        };
        let (forward, back) = order.arrays();
        let mut x: Vec<Axes> = forward.iter().map(|&v| axes(sides[v])).collect();
        solve_axes(|s| self.group(groups, s), &self.symbolic.trees, &mut x);
        sides.iter_mut().zip(back).for_each(|(side, &at)| *side = DVec3::new(x[at][0], x[at][1], x[at][2]));
        true
    }

    /// Solves in place for one right-hand side. False when the factor has no supernodes.
    pub fn solve_one(&self, side: &mut [f64]) -> bool {
        wide(
            #[inline(always)]
            || self.solve_axis(side),
        )
    }

    #[inline(always)]
    fn solve_axis(&self, side: &mut [f64]) -> bool {
        let (Some(groups), Some(order)) = (self.symbolic.groups(), self.symbolic.matrix.perm()) else {
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
                let sum = dot(&below, &column[group.size..]) + dot(&own[j + 1..], &column[j + 1..group.size]);
                own[j] = (own[j] - sum) / column[j];
            }
        }
        forward.iter().zip(&x).for_each(|(&v, &x)| side[v] = x);
        true
    }

    #[inline(always)]
    fn group<'a>(&'a self, groups: &'a SymbolicSupernodalCholesky<usize>, s: usize) -> Group<'a> {
        let (start, end) = (groups.supernode_begin()[s], groups.supernode_end()[s]);
        let rows = &groups.row_idx()[groups.col_ptr_for_row_idx()[s]..][..groups.nnz_per_super()[s]];
        let values = &self.values[groups.col_ptr_for_val()[s]..groups.col_ptr_for_val()[s + 1]];
        Group { start, size: end - start, rows, values }
    }
}

/// Subtrees of the elimination tree that can be solved in parallel.
fn trees(groups: &SymbolicSupernodalCholesky<usize>) -> Trees {
    let count = groups.n_supernodes();
    let columns: Vec<_> =
        (0..count).map(|s| groups.supernode_begin()[s]..groups.supernode_end()[s]).collect();
    // The parent of a supernode is the one that holds the first row below it.
    let parent = |s: usize| match groups.nnz_per_super()[s] {
        0 => count,
        _ => {
            let row = groups.row_idx()[groups.col_ptr_for_row_idx()[s]];
            columns.partition_point(|columns| columns.end <= row)
        }
    };
    let parents: Vec<usize> = (0..count).map(parent).collect();
    let work: Vec<usize> =
        (0..count).map(|s| groups.col_ptr_for_val()[s + 1] - groups.col_ptr_for_val()[s]).collect();
    Trees::new(&columns, &parents, &work)
}

/// A supernode: `size` adjacent columns from `start` on, a triangle on the diagonal and the `rows` below it.
struct Group<'a> {
    start: usize,
    size: usize,
    rows: &'a [usize],
    values: &'a [f64],
}

impl Group<'_> {
    #[inline(always)]
    fn columns(&self) -> impl DoubleEndedIterator<Item = &[f64]> + ExactSizeIterator {
        self.values.chunks_exact(self.size + self.rows.len())
    }
}

#[cfg(test)]
mod tests {
    use faer::sparse::SymbolicSparseColMat;

    use super::*;

    const SIDE: usize = 60;

    /// A membrane over a square of points, a little heavier from one to the next: its lower triangle, and where that stands.
    fn membrane() -> (SymbolicSparseColMat<usize>, Vec<f64>) {
        let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        for v in 0..SIDE * SIDE {
            rows.push(v);
            values.push(4.0 + 0.01 * (v % 7) as f64);
            let right = (v % SIDE + 1 < SIDE).then_some(v + 1);
            for row in right.into_iter().chain((v + SIDE < SIDE * SIDE).then_some(v + SIDE)) {
                rows.push(row);
                values.push(-1.0);
            }
            starts.push(rows.len());
        }
        (SymbolicSparseColMat::new_checked(SIDE * SIDE, SIDE * SIDE, starts, None, rows), values)
    }

    fn sides() -> Vec<DVec3> {
        (0..SIDE * SIDE)
            .map(|v| DVec3::new((v % 13) as f64, (v % 5) as f64 - 2.0, (v * v % 31) as f64))
            .collect()
    }

    /// The trees gone through at once against the plain solve, axis by axis, and against the matrix itself.
    #[test]
    fn three_axes_at_once_are_what_one_after_the_other_gives() {
        let (pattern, values) = membrane();
        let symbolic = Symbolic::new(pattern.as_ref()).expect("memory");
        assert!(
            symbolic.trees.parts.len() > 2 && !symbolic.trees.top.is_empty(),
            "{:?}",
            symbolic.trees.parts
        );
        let matrix = SparseColMatRef::new(pattern.as_ref(), &values);
        let factor = symbolic.factor(matrix, None).expect("positive definite");
        let mut at_once = sides();
        assert!(factor.solve(&mut at_once));
        for axis in 0..3 {
            let mut alone: Vec<f64> = sides().iter().map(|side| side[axis]).collect();
            assert!(factor.solve_one(&mut alone));
            let off = at_once.iter().zip(&alone).map(|(a, b)| (a[axis] - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-12, "axis {axis}: {off}");
        }
        let mut left = sides();
        for column in 0..SIDE * SIDE {
            let stored = pattern.col_range(column);
            for (&row, value) in pattern.row_idx()[stored.clone()].iter().zip(&values[stored]) {
                left[row] -= at_once[column] * *value;
                if row != column {
                    left[column] -= at_once[row] * *value;
                }
            }
        }
        assert!(left.iter().all(|left| left.length() < 1e-11));
    }

    #[test]
    fn any_number_of_threads_solves_to_the_same_bits() {
        let (pattern, values) = membrane();
        let symbolic = Symbolic::new(pattern.as_ref()).expect("memory");
        let matrix = SparseColMatRef::new(pattern.as_ref(), &values);
        let factor = symbolic.factor(matrix, None).expect("positive definite");
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            let mut x = sides();
            assert!(pool.install(|| factor.solve(&mut x)));
            x
        };
        let one = on(1);
        assert!([2, 3, 8].into_iter().all(|threads| on(threads) == one));
    }
}
