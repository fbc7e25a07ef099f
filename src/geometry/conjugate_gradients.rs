//! Preconditioned conjugate gradients (Hestenes and Stiefel 1952) for symmetric positive definite systems over points.

use glam::{DMat3, DVec3};

/// Solves `times`(x) = `right` for x, from zero, preconditioned by `inverses` of the diagonal blocks: at most `most` iterations, until
/// the residual is `share` (0..1) of that of zero, in the norm of the preconditioner. All slices have one entry per point. Sums are made
/// in order, so that the result does not depend on the number of threads.
pub fn solve(
    mut times: impl FnMut(&[DVec3], &mut [DVec3]),
    inverses: &[DMat3],
    right: Vec<DVec3>,
    most: usize,
    share: f64,
) -> Vec<DVec3> {
    let mut x = vec![DVec3::ZERO; right.len()];
    let mut residual = right;
    let mut scaled: Vec<DVec3> = residual.iter().zip(inverses).map(|(r, m)| *m * *r).collect();
    let mut along = scaled.clone();
    let mut image = vec![DVec3::ZERO; x.len()];
    let mut size = dot(&residual, &scaled);
    let enough = size * share * share;
    for _ in 0..most {
        if size <= enough {
            break;
        }
        times(&along, &mut image);
        let step = size / dot(&along, &image);
        for v in 0..x.len() {
            x[v] += along[v] * step;
            residual[v] -= image[v] * step;
            scaled[v] = inverses[v] * residual[v];
        }
        let next = dot(&residual, &scaled);
        along.iter_mut().zip(&scaled).for_each(|(along, scaled)| *along = *scaled + *along * (next / size));
        size = next;
    }
    x
}

fn dot(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Springs between neighbours of a chain, each along its own direction, and weak ones to the ground.
    fn chain(x: &[DVec3], y: &mut [DVec3]) {
        y.iter_mut().zip(x).for_each(|(y, x)| *y = *x * 0.1);
        for v in 1..x.len() {
            let way = DVec3::new(v as f64, 1.0, -2.0 * v as f64).normalize();
            let pull = way * way.dot(x[v] - x[v - 1]);
            y[v] += pull;
            y[v - 1] -= pull;
        }
    }

    #[test]
    fn a_system_is_solved_exactly_in_about_as_many_steps_as_it_has_unknowns() {
        let exact: Vec<DVec3> = (0..6).map(|v| DVec3::new(f64::from(v).sin(), 1.0, f64::from(v))).collect();
        let mut right = vec![DVec3::ZERO; 6];
        chain(&exact, &mut right);
        for preconditioner in [DMat3::IDENTITY, DMat3::from_diagonal(DVec3::new(0.5, 1.0, 0.25))] {
            let found = solve(chain, &[preconditioner; 6], right.clone(), 18 + 6, 1e-12);
            let off = found.iter().zip(&exact).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(off < 1e-9, "{off}");
        }
    }

    #[test]
    fn it_ends_at_the_wanted_share_and_at_once_where_there_is_nothing_to_solve() {
        let right: Vec<DVec3> = (0..40).map(|v| DVec3::new(1.0, f64::from(v % 7), 0.0)).collect();
        let mut calls = [0, 0, 0];
        for (calls, (right, share)) in
            calls.iter_mut().zip([(right.clone(), 0.1), (right, 1e-3), (vec![DVec3::ZERO; 40], 0.1)])
        {
            let counted = |x: &[DVec3], y: &mut [DVec3]| {
                *calls += 1;
                chain(x, y);
            };
            solve(counted, &[DMat3::IDENTITY; 40], right, 500, share);
        }
        assert!(0 < calls[0] && calls[0] < calls[1] && calls[1] < 200 && calls[2] == 0, "{calls:?}");
    }
}
