//! Rows of links between vertices that are shortened together.
//!
//! Projected one after another the links of a ring hardly move it inwards: each pulls its ends past each other, and what is left
//! points inwards by no more than the angle between two links. So all links of a row are solved at once (XPBD with the exact
//! solution of its linear system, which is tridiagonal).

use std::collections::BTreeMap;

use glam::DVec3;

/// A row of links; the last of a closed one ends where the first begins.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chain {
    /// For each link its number and its vertices, in the direction of the row.
    links: Vec<(u32, [u32; 2])>,
    is_closed: bool,
}

/// What a link is drawn to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawn {
    /// Length beyond which it is drawn, metres.
    pub length: f64,
    /// Stiffness, N/m, above 0.
    pub stiffness: f64,
}

/// The rows that `links`, each given by its two vertices, form: they end where other than two links meet.
pub fn chains(links: &[[u32; 2]]) -> Vec<Chain> {
    let mut at: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (i, ends) in links.iter().enumerate() {
        ends.iter().for_each(|&v| at.entry(v).or_default().push(i as u32));
    }
    let mut is_taken = vec![false; links.len()];
    let mut walk = |start: u32, first: u32| -> Option<Chain> {
        let (mut chain, mut from, mut next) = (Chain::default(), start, Some(first));
        while let Some(i) = next.filter(|&i| !is_taken[i as usize]) {
            is_taken[i as usize] = true;
            let [a, b] = links[i as usize];
            let to = if a == from { b } else { a };
            chain.links.push((i, [from, to]));
            next = match at[&to][..] {
                [a, b] if to != start => Some(if a == i { b } else { a }),
                _ => None,
            };
            from = to;
        }
        chain.is_closed = from == start && chain.links.len() > 2;
        (!chain.links.is_empty()).then_some(chain)
    };
    let ends = at.iter().filter(|(_, near)| near.len() != 2);
    let rest = at.iter().filter(|(_, near)| near.len() == 2);
    ends.chain(rest)
        .flat_map(|(&v, near)| near.iter().map(move |&i| (v, i)))
        .filter_map(|(v, i)| walk(v, i))
        .collect()
}

impl Chain {
    /// Shortens the links that are too long in a small step of `small` seconds. No vertex moves by more than `most` metres.
    /// `inverse_mass` in 1/kg.
    pub fn project(
        &self,
        x: &mut [DVec3],
        inverse_mass: &[f64],
        drawn: impl Fn(u32) -> Drawn,
        (small, most): (f64, f64),
    ) {
        let count = self.links.len();
        let mass = |v: u32| inverse_mass[v as usize];
        // Directions, zero where a link is slack; a row of the system for each link.
        let (mut ways, mut diagonal, mut pulls) =
            (vec![DVec3::ZERO; count], vec![1.0; count], vec![0.0; count]);
        for (i, &(link, [a, b])) in self.links.iter().enumerate() {
            let Drawn { length, stiffness } = drawn(link);
            let along = x[b as usize] - x[a as usize];
            let (long, give) = (along.length(), mass(a) + mass(b));
            if long > length && give > 0.0 {
                ways[i] = along / long;
                diagonal[i] = give + 1.0 / (stiffness * small * small);
                pulls[i] = long - length;
            }
        }
        if pulls.iter().all(|&pull| pull == 0.0) {
            return;
        }
        let beside: Vec<f64> =
            (0..count).map(|i| -mass(self.links[i].1[1]) * ways[i].dot(ways[(i + 1) % count])).collect();
        match self.is_closed {
            true => solve_closed(&diagonal, &beside, &mut pulls),
            false => solve(&diagonal, &beside, &mut pulls),
        }
        let mut moves = vec![DVec3::ZERO; count + 1];
        for (i, &(_, [a, b])) in self.links.iter().enumerate() {
            // A link never pushes.
            let way = ways[i] * pulls[i].max(0.0);
            let end = if self.is_closed && i + 1 == count { 0 } else { i + 1 };
            moves[i] += way * mass(a);
            moves[end] -= way * mass(b);
        }
        let farthest = moves.iter().map(|way| way.length_squared()).fold(0.0, f64::max).sqrt();
        let share = if farthest > most { most / farthest } else { 1.0 };
        for (&(_, [a, b]), i) in self.links.iter().zip(0..) {
            x[a as usize] += moves[i] * share;
            if i + 1 == count && !self.is_closed {
                x[b as usize] += moves[count] * share;
            }
        }
    }
}

/// Solves a symmetric positive definite tridiagonal system in place; `beside[i]` couples `i` and `i + 1`.
fn solve(diagonal: &[f64], beside: &[f64], right: &mut [f64]) {
    let count = diagonal.len();
    let mut pivots = diagonal.to_vec();
    for i in 1..count {
        let factor = beside[i - 1] / pivots[i - 1];
        pivots[i] -= factor * beside[i - 1];
        right[i] -= factor * right[i - 1];
    }
    for i in (0..count).rev() {
        let after = if i + 1 < count { beside[i] * right[i + 1] } else { 0.0 };
        right[i] = (right[i] - after) / pivots[i];
    }
}

/// The same where the last row and the first are coupled, too, by the last of `beside` (Sherman and Morrison 1950).
fn solve_closed(diagonal: &[f64], beside: &[f64], right: &mut [f64]) {
    let last = diagonal.len() - 1;
    let (first, corner) = (diagonal[0], beside[last]);
    let mut cut = diagonal.to_vec();
    cut[0] += first;
    cut[last] += corner * corner / first;
    let mut other = vec![0.0; diagonal.len()];
    (other[0], other[last]) = (-first, corner);
    solve(&cut, beside, right);
    solve(&cut, beside, &mut other);
    let ratio = -corner / first;
    let share = (right[0] + ratio * right[last]) / (1.0 + other[0] + ratio * other[last]);
    right.iter_mut().zip(&other).for_each(|(own, other)| *own -= share * other);
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn ring(count: u32) -> (Vec<DVec3>, Vec<[u32; 2]>) {
        let at = |i: u32| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(count)).sin_cos();
            DVec3::new(cos, 0.3, sin)
        };
        let links = (0..count).map(|i| (i, (i + 1) % count)).map(|(a, b)| [a.min(b), a.max(b)]);
        ((0..count).map(at).collect(), links.collect())
    }

    #[test]
    fn rows_end_where_other_than_two_links_meet() {
        let shape = |links: &[[u32; 2]]| -> Vec<(Vec<u32>, bool)> {
            chains(links).iter().map(|c| (c.links.iter().map(|(i, _)| *i).collect(), c.is_closed)).collect()
        };
        assert_eq!(shape(&[[3, 4], [1, 2], [2, 3]]), [(vec![1, 2, 0], false)]);
        assert_eq!(shape(&ring(5).1), [(vec![0, 1, 2, 3, 4], true)]);
        assert_eq!(shape(&[[0, 1], [1, 2], [1, 3]]).len(), 3);
        // A ring with a tail.
        let mut links = ring(4).1;
        links.push([2, 9]);
        assert_eq!(shape(&links), [(vec![1, 0, 3, 2], true), (vec![4], false)]);
    }

    #[test]
    fn systems_are_solved() {
        let (diagonal, beside) = ([4.0, 5.0, 3.5, 6.0], [-1.0, 1.5, -0.5, 0.75]);
        for is_closed in [false, true] {
            let mut found = [1.0, -2.0, 0.5, 3.0];
            let right = found;
            if is_closed {
                solve_closed(&diagonal, &beside, &mut found)
            } else {
                solve(&diagonal, &beside, &mut found)
            }
            for i in 0..4 {
                let before = if i > 0 || is_closed { beside[(i + 3) % 4] * found[(i + 3) % 4] } else { 0.0 };
                let after = if i < 3 || is_closed { beside[i] * found[(i + 1) % 4] } else { 0.0 };
                let sum = diagonal[i] * found[i] + before + after;
                assert!((sum - right[i]).abs() < 1e-12, "{is_closed} {i}: {sum}");
            }
        }
    }

    #[test]
    fn a_ring_is_drawn_inwards_at_once_and_no_faster_than_it_may() {
        let count = 80;
        let (start, links) = ring(count);
        let [chain] = &chains(&links)[..] else { panic!("one ring") };
        let side = start[0].distance(start[1]);
        let inverse = vec![2.0; count as usize];
        let drawn = |_| Drawn { length: 0.9 * side, stiffness: 1e9 };
        let mut x = start.clone();
        chain.project(&mut x, &inverse, drawn, (0.01, 1.0));
        assert!(x.iter().all(|p| (p.with_y(0.0).length() - 0.9).abs() < 1e-3), "{}", x[0]);
        let mut slow = start.clone();
        chain.project(&mut slow, &inverse, drawn, (0.01, 0.001));
        assert!(slow.iter().all(|p| (p.with_y(0.0).length() - 0.999).abs() < 1e-9), "{}", slow[0]);
        // What is held stays, and what is slack is left.
        chain.project(&mut x, &vec![0.0; count as usize], drawn, (0.01, 1.0));
        let mut short: Vec<DVec3> = start.iter().map(|p| *p * 0.5).collect();
        let before = short.clone();
        chain.project(&mut short, &inverse, drawn, (0.01, 1.0));
        assert_eq!(short, before);
    }

    #[test]
    fn an_open_row_keeps_momentum_and_reaches_its_lengths() {
        let mut x: Vec<DVec3> =
            (0..6).map(|i| DVec3::new(f64::from(i), f64::from(i % 2) * 0.4, 0.0)).collect();
        let links: Vec<[u32; 2]> = (0..5).map(|i| [i, i + 1]).collect();
        let inverse = [1.0, 0.5, 2.0, 1.0, 0.25, 1.0];
        let sum = |x: &[DVec3]| x.iter().zip(inverse).map(|(x, w)| *x / w).sum::<DVec3>();
        let before = sum(&x);
        let [chain] = &chains(&links)[..] else { panic!("one row") };
        for _ in 0..20 {
            chain.project(&mut x, &inverse, |_| Drawn { length: 0.7, stiffness: 1e9 }, (0.1, 1.0));
        }
        assert!(sum(&x).distance(before) < 1e-9);
        assert!(x.windows(2).all(|w| (w[0].distance(w[1]) - 0.7).abs() < 1e-6), "{x:?}");
    }
}
