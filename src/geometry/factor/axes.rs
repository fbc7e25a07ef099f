//! Triangular solves with a factor for three right-hand sides (x, y and z) at once.

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::factor::Group;
use crate::geometry::factor::trees::{Part, Trees};
use crate::geometry::wide::wide;

/// Number of partial sums of a dot product: fixed, so that the order of sums is the same on every machine.
const LANES: usize = 4;

/// A row of the right-hand sides: x, y, z and a fourth value that stays 0, to fill a vector register.
pub(super) type Axes = [f64; 4];

pub(super) fn axes(v: DVec3) -> Axes {
    [v.x, v.y, v.z, 0.0]
}

/// Solves for `x` in place; its rows are in the factor's column order, and `group` gives a supernode by its number.
/// Forward substitution goes through the subtrees in parallel, then through the supernodes above them; back
/// substitution goes the other way. Same input, same bits, on any number of threads.
pub(super) fn solve_axes<'a>(group: impl Fn(usize) -> Group<'a> + Sync, trees: &Trees, x: &mut [Axes]) {
    let group = &group;
    let sum_above = |(own, part): (&mut [Axes], &Part)| {
        let mut above = vec![[0.0; 4]; trees.columns.len()];
        let rows = Rows { first: part.columns.start, place: &trees.place };
        wide(
            #[inline(always)]
            || forward(part.groups.clone().map(group), rows, own, &mut above),
        );
        above
    };
    let sums: Vec<Vec<Axes>> =
        pieces(x, &trees.parts).into_par_iter().zip(&trees.parts).map(sum_above).collect();
    for sum in &sums {
        trees.columns.iter().zip(sum).for_each(|(&column, sum)| add(&mut x[column], sum, 1.0));
    }
    let rows = Rows { first: 0, place: &trees.place };
    wide(
        #[inline(always)]
        || {
            forward(trees.top.iter().map(|&s| group(s)), rows, x, &mut []);
            backward(trees.top.iter().rev().map(|&s| group(s)), rows, x, &[]);
        },
    );
    let above: Vec<Axes> = trees.columns.iter().map(|&column| x[column]).collect();
    pieces(x, &trees.parts).into_par_iter().zip(&trees.parts).for_each(|(own, part)| {
        let rows = Rows { first: part.columns.start, place: &trees.place };
        wide(
            #[inline(always)]
            || backward(part.groups.clone().rev().map(group), rows, own, &above),
        );
    });
}

/// Splits `x` into the rows of each subtree.
fn pieces<'a>(mut x: &'a mut [Axes], parts: &[Part]) -> Vec<&'a mut [Axes]> {
    let mut taken = 0;
    let mut take = |part: &Part| {
        let (own, after) =
            std::mem::take(&mut x)[part.columns.start - taken..].split_at_mut(part.columns.len());
        (x, taken) = (after, part.columns.end);
        own
    };
    parts.iter().map(&mut take).collect()
}

/// How row numbers of the factor map to slices: rows of the subtree at hand start at `first` of its slice, those
/// after it are at `place` among the rows above.
#[derive(Clone, Copy)]
struct Rows<'a> {
    first: usize,
    place: &'a [u32],
}

/// Forward substitution through `groups`, whose rows are `own`; what they contribute to rows above them is added to
/// `above`.
#[inline(always)]
fn forward<'a>(
    groups: impl Iterator<Item = Group<'a>>,
    rows: Rows<'_>,
    own: &mut [Axes],
    above: &mut [Axes],
) {
    let end = rows.first + own.len();
    let mut below: Vec<Axes> = Vec::new();
    for group in groups {
        below.clear();
        below.resize(group.rows.len(), [0.0; 4]);
        let columns = &mut own[group.start - rows.first..][..group.size];
        for (j, column) in group.columns().enumerate() {
            let (column, under) = column.split_at(group.size);
            let done = columns[j].map(|x| x / column[j]);
            columns[j] = done;
            columns[j + 1..].iter_mut().zip(&column[j + 1..]).for_each(|(x, l)| add(x, &done, -l));
            below.iter_mut().zip(under).for_each(|(x, l)| add(x, &done, *l));
        }
        let inside = rows_before(group.rows, end);
        for (&row, sum) in group.rows[..inside].iter().zip(&below) {
            add(&mut own[row - rows.first], sum, -1.0);
        }
        for (&row, sum) in group.rows[inside..].iter().zip(&below[inside..]) {
            add(&mut above[rows.place[row] as usize], sum, -1.0);
        }
    }
}

/// Back substitution through `groups`, whose rows are `own`; the rows above them are solved already and given in
/// `above`.
#[inline(always)]
fn backward<'a>(groups: impl Iterator<Item = Group<'a>>, rows: Rows<'_>, own: &mut [Axes], above: &[Axes]) {
    let end = rows.first + own.len();
    let mut below: Vec<Axes> = Vec::new();
    for group in groups {
        below.clear();
        let inside = rows_before(group.rows, end);
        below.extend(group.rows[..inside].iter().map(|&row| own[row - rows.first]));
        below.extend(group.rows[inside..].iter().map(|&row| above[rows.place[row] as usize]));
        let columns = &mut own[group.start - rows.first..][..group.size];
        for (j, column) in group.columns().enumerate().rev() {
            let (column, under) = column.split_at(group.size);
            let mut left = columns[j];
            add(&mut left, &dot(&below, under), -1.0);
            columns[j + 1..].iter().zip(&column[j + 1..]).for_each(|(x, l)| add(&mut left, x, -l));
            columns[j] = left.map(|x| x / column[j]);
        }
    }
}

/// The number of `rows`, ascending, that come before `end`.
#[inline(always)]
fn rows_before(rows: &[usize], end: usize) -> usize {
    match rows.last() {
        Some(&last) if last >= end => rows.partition_point(|&row| row < end),
        _ => rows.len(),
    }
}

/// Adds `x` times `times` to `sum`.
#[inline(always)]
fn add(sum: &mut Axes, x: &Axes, times: f64) {
    for k in 0..4 {
        sum[k] += x[k] * times;
    }
}

/// The dot product of `column` with each of the axes of `rows`.
#[inline(always)]
fn dot(rows: &[Axes], column: &[f64]) -> Axes {
    let mut sums = [[0.0; 4]; LANES];
    let (rows, column) = (rows.chunks_exact(LANES), column.chunks_exact(LANES));
    for (x, l) in rows.remainder().iter().zip(column.remainder()) {
        add(&mut sums[0], x, *l);
    }
    for (rows, column) in rows.zip(column) {
        for k in 0..LANES {
            add(&mut sums[k], &rows[k], column[k]);
        }
    }
    let mut sum = sums[0];
    sums[1..].iter().for_each(|other| add(&mut sum, other, 1.0));
    sum
}
