//! The distance map: the points of the skin that each cloth vertex is bound to (paper C, "distance map").
//!
//! The paper binds to the nearest body *vertex* of overlapping boxes; here it is the nearest *point*, found exactly. Between two
//! limbs (armpit, crotch) several points are about equally near: up to [`MOST`] are blended, so that neighbours bound to
//! different limbs do not move apart (ALGORITHMS.md 1.C).

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Surface;
use crate::cloth::ClothState;
use crate::contact::BodyOverlaps;
use crate::geometry::barycentric;
use crate::geometry::parallel::LEAST_SEARCHES;

/// Most points that a vertex is bound to. Chosen by trial; it bounds the work for a vertex in the middle of a round hollow.
const MOST: usize = 4;
/// Largest distance of a bound point, as a multiple of the distance to the nearest. Chosen by trial.
const FARTHEST: f64 = 1.3;
/// Smallest distance between two bound points, as a multiple of the distance to the nearest: closer ones belong to one hollow.
/// Chosen by trial.
const APART: f64 = 0.5;

/// A vertex bound to a point of the skin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Binding {
    /// Triangle of the skin that the point is on.
    pub triangle: u32,
    /// Barycentric coordinates of the point.
    pub shares: [f64; 3],
    /// Vector from the point to the vertex in the pose of binding, metres.
    pub beside: DVec3,
    /// Weight of this binding, 0..=1; the weights of a vertex sum to one.
    pub weight: f64,
}

/// The bindings of all vertices of a garment.
#[derive(Clone, Debug, Default)]
pub struct DistanceMap {
    starts: Vec<u32>,
    bindings: Vec<Binding>,
    /// Signed distance of each vertex above the nearest skin, metres, negative inside; infinite where no cloth is laid.
    pub heights: Vec<f64>,
}

impl DistanceMap {
    /// Binds the laid vertices of `cloth` to `surface`, the others to nothing.
    pub fn new(surface: &Surface, cloth: &ClothState) -> Self {
        Self::apart(surface, cloth, None)
    }

    /// Binds like [`Self::new`], but to no triangle that `apart` leaves out for a vertex.
    pub fn apart(surface: &Surface, cloth: &ClothState, apart: Option<&BodyOverlaps>) -> Self {
        let bound: Vec<(Vec<Binding>, f64)> = cloth
            .positions
            .par_iter()
            .zip(&cloth.mapped)
            .enumerate()
            .with_min_len(LEAST_SEARCHES)
            .map(|(v, (&p, &mapped))| match mapped {
                true => bound(surface, p, |t| apart.is_some_and(|apart| apart.leaves_out(v, t))),
                false => (Vec::new(), f64::INFINITY),
            })
            .collect();
        let mut map = Self { starts: vec![0], ..Self::default() };
        for (bindings, height) in bound {
            map.bindings.extend(bindings);
            map.starts.push(map.bindings.len() as u32);
            map.heights.push(height);
        }
        map
    }

    /// Bindings of `vertex`, the nearest first.
    pub fn of(&self, vertex: usize) -> &[Binding] {
        &self.bindings[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }

    /// All bindings.
    pub fn bindings(&self) -> &[Binding] {
        &self.bindings
    }

    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.heights.len()
    }

    /// Whether there is no vertex.
    pub fn is_empty(&self) -> bool {
        self.heights.is_empty()
    }
}

/// The bindings of a vertex at `p`, and its signed distance from the skin, metres.
fn bound(surface: &Surface, p: DVec3, left_out: impl Fn(u32) -> bool) -> (Vec<Binding>, f64) {
    let nearest = surface.nearest_within_but(p, f64::INFINITY, &left_out);
    let nearest = nearest.unwrap_or_else(|| surface.nearest(p));
    let least = nearest.distance.abs();
    let mut chosen = vec![(nearest.point, nearest.triangle)];
    for (point, triangle) in surface.nearest_round_about(p, least * FARTHEST) {
        if left_out(triangle) {
            continue;
        }
        if chosen.len() < MOST && chosen.iter().all(|(other, _)| other.distance(point) > APART * least) {
            chosen.push((point, triangle));
        }
    }
    // The weight falls to zero at the farthest distance, so that it is continuous where the number of bound points changes.
    let weight = |point: DVec3| {
        let t = (FARTHEST - p.distance(point) / least.max(f64::MIN_POSITIVE)) / (FARTHEST - 1.0);
        let t = t.clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let weights: Vec<f64> = match chosen.len() {
        1 => vec![1.0],
        _ => chosen.iter().map(|(point, _)| weight(*point)).collect(),
    };
    let sum: f64 = weights.iter().sum();
    let binding = |((point, triangle), weight): ((DVec3, u32), f64)| {
        let shares = barycentric::on_triangle(point, surface.mesh.corners(triangle as usize));
        // Measured from the point that the shares give: then a body that has not moved leaves the vertex where it is.
        let point = barycentric::place(shares, surface.mesh.corners(triangle as usize));
        Binding { triangle, shares, beside: p - point, weight: weight / sum }
    };
    let bindings = chosen.into_iter().zip(weights).filter(|(_, w)| *w > 0.0).map(binding).collect();
    (bindings, nearest.distance)
}
