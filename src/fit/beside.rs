//! Cloth that has other skin beside its outer side, such as a skirt beside a hand: it lies the right way round all the same.

use crate::fit::laid::Laid;
use crate::fit::shape::neighbours;
use crate::geometry::disjoint_sets::DisjointSets;

/// Largest share of the triangles near the body that may have skin beside their outer side. A hand or an arm is beside a few in a
/// hundred; of a sleeve inside out it is nearly all.
const MOST_BESIDE: f64 = 0.1;

/// Whether a triangle that shows the skin its outer side has other skin beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Beside {
    No,
    /// It is in cloth nearly all of which is the right way round, but a crease divides it, or wrong ones round it, from such cloth.
    Crumpled,
    /// It is in such cloth, and no crease divides it from that.
    Smooth,
}

/// For each triangle whether it has other skin beside it, given which are `wrong` side out, see
/// [`wrong_side_out`](crate::fit::on_body::wrong_side_out).
pub(super) fn beside(laid: &Laid, wrong: &[Option<bool>]) -> Vec<Beside> {
    let count = laid.mesh.triangles.len();
    if !wrong.contains(&Some(true)) {
        return vec![Beside::No; count];
    }
    let is_wrong = |t: usize| wrong[t] == Some(true);
    // Cloth without a crease, and in it what is wrong side out.
    let [mut smooth, mut patches] = [(); 2].map(|()| DisjointSets::new(count));
    let mut creased = vec![false; count];
    for [s, t] in neighbours(laid) {
        let [m, n] = [s, t].map(|t| {
            let [a, b, c] = laid.mesh.corners(t);
            (b - a).cross(c - a)
        });
        if m.dot(n) <= 0.0 {
            // Where both show their outer side there is a wrinkle beside the same skin.
            creased[s] |= wrong[t] == Some(false);
            creased[t] |= wrong[s] == Some(false);
            continue;
        }
        smooth.join(s as u32, t as u32);
        if is_wrong(s) && is_wrong(t) {
            patches.join(s as u32, t as u32);
        }
    }
    let sheets: Vec<usize> = (0..count).map(|t| smooth.root(t as u32) as usize).collect();
    let patches: Vec<usize> = (0..count).map(|t| patches.root(t as u32) as usize).collect();
    let (mut near, mut against, mut is_creased) =
        (vec![0usize; count], vec![0usize; count], vec![false; count]);
    for t in 0..count {
        near[sheets[t]] += usize::from(wrong[t].is_some());
        against[sheets[t]] += usize::from(is_wrong(t));
        is_creased[patches[t]] |= is_wrong(t) && creased[t];
    }
    let beside = |t: usize| match against[sheets[t]] as f64 <= MOST_BESIDE * near[sheets[t]] as f64 {
        true if is_wrong(t) && is_creased[patches[t]] => Beside::Crumpled,
        true if is_wrong(t) => Beside::Smooth,
        _ => Beside::No,
    };
    (0..count).map(beside).collect()
}
