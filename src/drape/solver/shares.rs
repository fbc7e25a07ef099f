//! The parts into which cloth is divided for parallel work in small steps, with what is known of the body near each vertex.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use crate::drape::solver::net::Net;

/// Vertices in creases of a body, each with the half-space of the side that is not nearest.
pub(super) type Creases = Vec<(usize, Plane)>;

/// Half-space that approximates the body near a vertex: the vertex is free where n·x ≥ height.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Plane {
    pub normal: DVec3,
    pub height: f64,
    /// Position of the vertex at its last nearest-point query, metres.
    pub place: DVec3,
    /// Distance from `place` within which that query stays valid, metres.
    pub good_for: f64,
}

/// One part of the cloth for parallel work.
pub(super) struct Share<'a> {
    /// Index of the part's first vertex.
    pub first: usize,
    pub x: &'a mut [DVec3],
    pub before: &'a mut [DVec3],
    pub velocities: &'a mut [DVec3],
    pub planes: &'a mut [Plane],
    pub creases: &'a mut Creases,
}

/// The arrays divided into the parts of `net`.
pub(super) fn shares<'a>(
    net: &Net,
    mut x: &'a mut [DVec3],
    mut before: &'a mut [DVec3],
    mut velocities: &'a mut [DVec3],
    (mut planes, creases): (&'a mut [Plane], &'a mut [Creases]),
) -> Vec<Share<'a>> {
    fn taken<'a, T>(from: &mut &'a mut [T], count: usize) -> &'a mut [T] {
        let (head, tail) = std::mem::take(from).split_at_mut(count);
        *from = tail;
        head
    }
    let share = |(part, creases): (Range<usize>, &'a mut Creases)| Share {
        first: part.start,
        x: taken(&mut x, part.len()),
        before: taken(&mut before, part.len()),
        velocities: taken(&mut velocities, part.len()),
        planes: taken(&mut planes, part.len()),
        creases,
    };
    net.parts().zip(creases).map(share).collect()
}

/// Runs `work` on each share, in parallel where there is more than one.
pub(super) fn side_by_side<T: Send>(
    shares: &mut [Share<'_>],
    work: impl Fn(usize, &mut Share<'_>) -> T + Sync,
) -> Vec<T> {
    match shares {
        [one] => vec![work(0, one)],
        many => many.par_iter_mut().enumerate().map(|(p, share)| work(p, share)).collect(),
    }
}
