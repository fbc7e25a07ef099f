//! Sparse symmetric matrix of 3 × 3 blocks, one block row per vertex, and its Cholesky factor.

use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use glam::{DMat3, DVec3};

use crate::drape::solver::ordering::nested_dissection;
use crate::geometry::adjacency::Lists;
use crate::geometry::factor::{Factor, Symbolic};

/// The lower triangle of the matrix, stored by columns.
#[derive(Debug)]
pub struct BlockMatrix {
    /// For each vertex the later vertices with which it shares a block, ascending.
    below: Lists,
    /// Index in `values` at which each block column begins.
    starts: Vec<usize>,
    pattern: SymbolicSparseColMat<usize>,
    symbolic: Symbolic,
    values: Vec<f64>,
}

/// Storage position of a block; a flipped one is stored transposed.
#[derive(Clone, Copy, Debug)]
pub struct Slot {
    at: usize,
    /// Number of blocks below the diagonal in its column.
    below: usize,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Diagonal,
    Lower,
    Flipped,
}

impl BlockMatrix {
    /// A matrix with a block for each vertex and for each of `pairs` (any order, repeats allowed). None when it does not fit in
    /// memory.
    pub fn new(vertices: usize, pairs: impl Iterator<Item = [u32; 2]>) -> Option<Self> {
        let mut both: Vec<(u32, u32)> =
            pairs.filter(|[a, b]| a != b).flat_map(|[a, b]| [(a, b), (b, a)]).collect();
        both.sort_unstable();
        both.dedup();
        let order = nested_dissection(&Lists::grouped(vertices, both.iter().copied()));
        both.retain(|(a, b)| a < b);
        let below = Lists::grouped(vertices, both.iter().copied());
        let (mut starts, mut columns, mut rows) = (vec![0], vec![0], Vec::new());
        for j in 0..vertices {
            for c in 0..3 {
                rows.extend((c..3).map(|r| 3 * j + r));
                for &i in below.of(j as u32) {
                    rows.extend((0..3).map(|r| 3 * i as usize + r));
                }
                columns.push(rows.len());
            }
            starts.push(rows.len());
        }
        let order: Vec<usize> = order.iter().flat_map(|&v| (0..3).map(move |r| 3 * v as usize + r)).collect();
        let values = vec![0.0; rows.len()];
        let pattern = SymbolicSparseColMat::new_checked(3 * vertices, 3 * vertices, columns, None, rows);
        let symbolic = Symbolic::ordered(pattern.as_ref(), &order)?;
        Some(Self { below, starts, pattern, symbolic, values })
    }

    /// Number of nonzeros in the Cholesky factor.
    pub fn fill(&self) -> usize {
        self.symbolic.fill()
    }

    /// Position of the block in the rows of `i` and the columns of `j`; None where the matrix has none.
    pub fn slot(&self, i: u32, j: u32) -> Option<Slot> {
        let (low, high) = (i.min(j), i.max(j));
        let below = self.below.of(low);
        let start = self.starts[low as usize];
        if i == j {
            return Some(Slot { at: start, below: below.len(), kind: Kind::Diagonal });
        }
        let at = below.binary_search(&high).ok()?;
        let kind = if i > j { Kind::Lower } else { Kind::Flipped };
        Some(Slot { at: start + 3 + 3 * at, below: below.len(), kind })
    }

    /// Largest absolute value.
    pub fn largest(&self) -> f64 {
        self.values.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
    }

    /// Sets all values to zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Adds `block` at `slot`.
    pub fn add(&mut self, slot: Slot, block: &DMat3) {
        let step = 3 * slot.below;
        match slot.kind {
            Kind::Diagonal => {
                let [x, y, z] = [block.x_axis, block.y_axis, block.z_axis];
                let v = &mut self.values[slot.at..slot.at + 6 + 3 * step];
                v[0] += x.x;
                v[1] += x.y;
                v[2] += x.z;
                v[3 + step] += y.y;
                v[4 + step] += y.z;
                v[5 + 2 * step] += z.z;
            }
            Kind::Lower => self.add_lower(slot.at, step, block.to_cols_array()),
            Kind::Flipped => self.add_lower(slot.at, step, block.transpose().to_cols_array()),
        }
    }

    fn add_lower(&mut self, at: usize, step: usize, block: [f64; 9]) {
        let second = at + 2 + step;
        let third = second + 1 + step;
        for (c, at) in [at, second, third].into_iter().enumerate() {
            let column = &mut self.values[at..at + 3];
            (0..3).for_each(|r| column[r] += block[3 * c + r]);
        }
    }

    /// Replaces the rows and columns of the vertices `held` by those of the identity.
    pub fn hold(&mut self, held: &[bool]) {
        for j in 0..held.len() {
            let below = self.below.of(j as u32);
            let mut at = self.starts[j];
            for c in 0..3 {
                let own = 3 - c;
                if held[j] {
                    self.values[at..at + own + 3 * below.len()].fill(0.0);
                    self.values[at] = 1.0;
                } else {
                    for (k, _) in below.iter().enumerate().filter(|&(_, &i)| held[i as usize]) {
                        self.values[at + own + 3 * k..][..3].fill(0.0);
                    }
                }
                at += own + 3 * below.len();
            }
        }
    }

    /// Computes the Cholesky factor, reusing `memory`. None when the matrix is not positive definite.
    pub(in crate::drape) fn factor(&self, memory: Option<Factor>) -> Option<Factor> {
        self.symbolic.factor(SparseColMatRef::new(self.pattern.as_ref(), &self.values), memory)
    }
}

/// Solves for one vector per vertex, in place. False when the result is not finite.
pub(in crate::drape) fn solve(factor: &Factor, side: &mut [DVec3], scratch: &mut Vec<f64>) -> bool {
    scratch.clear();
    scratch.extend(side.iter().flat_map(|s| s.to_array()));
    let solved = factor.solve_one(scratch);
    side.iter_mut().zip(scratch.chunks_exact(3)).for_each(|(s, x)| *s = DVec3::new(x[0], x[1], x[2]));
    solved
}
