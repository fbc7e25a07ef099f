//! Growth: each unmapped vertex is placed in the planes of the mapped triangles beside it (paper A, Figure 13).

use std::collections::BTreeSet;

use glam::DVec3;

use crate::body::Surface;
use crate::cloth::{ClothState, Garment};
use crate::geometry::adjacency::NONE;
use crate::relax::step::STEP_OUT;
use crate::wrap::order::Order;

/// The front of growth: vertices that can be placed next, sorted by tier, distance and number.
#[derive(Clone, Debug, Default)]
pub struct Growth {
    ready: BTreeSet<(u32, u64, u32)>,
}

impl Growth {
    /// The front round all mapped vertices.
    pub fn new(garment: &Garment, order: &Order, mapped: &[bool]) -> Self {
        let mut growth = Self::default();
        for v in 0..garment.vertex_count as u32 {
            if mapped[v as usize] {
                growth.wake_round(garment, order, mapped, v);
            }
        }
        growth
    }

    /// Takes the next vertex of the front if it is of `tier` and at most `limit` metres away from the start of the tier.
    pub fn pop(&mut self, tier: u32, limit: f64) -> Option<u32> {
        let &next = self.ready.iter().next()?;
        if next.0 != tier || f64::from_bits(next.1) > limit {
            return None;
        }
        self.ready.remove(&next);
        Some(next.2)
    }

    /// Tier and distance (m) of the next vertex of the front.
    pub fn next(&self) -> Option<(u32, f64)> {
        self.ready.iter().next().map(|&(t, d, _)| (t, f64::from_bits(d)))
    }

    /// Adds to the front what can be placed after vertex `v` was mapped: vertices opposite the edges of its mapped triangles.
    pub fn wake_round(&mut self, garment: &Garment, order: &Order, mapped: &[bool], v: u32) {
        for &t in garment.adjacency.vertex_triangles.of(v) {
            let vs = garment.triangles[t as usize];
            if !vs.iter().all(|&w| mapped[w as usize]) {
                continue;
            }
            for &beyond in &garment.adjacency.across[t as usize] {
                if beyond == NONE {
                    continue;
                }
                for w in garment.triangles[beyond as usize] {
                    let i = w as usize;
                    if let (false, Some(tier)) = (mapped[i], order.tier[i]) {
                        self.ready.insert((tier, order.distance[i].to_bits(), w));
                    }
                }
            }
        }
    }
}

/// Position of a new vertex `v` from its mapped parent triangles, at least `offset` metres out of the body. It is
/// pushed out in up to `pushes` steps, and then goes to the nearest skin.
pub fn placed(
    garment: &Garment,
    surface: &Surface,
    state: &ClothState,
    v: u32,
    offset: f64,
    pushes: usize,
) -> Option<DVec3> {
    let mut sum = DVec3::ZERO;
    let mut normals = DVec3::ZERO;
    let mut count = 0.0;
    for &t in garment.adjacency.vertex_triangles.of(v) {
        let vs = garment.triangles[t as usize];
        let Some(k) = vs.iter().position(|&w| w == v) else { continue };
        // The edge opposite `v` is the one that starts at the next corner.
        let parent = garment.adjacency.across[t as usize][(k + 1) % 3];
        if parent == NONE || !garment.triangles[parent as usize].iter().all(|&w| state.mapped[w as usize]) {
            continue;
        }
        let [pa, pb, pc] = garment.triangles[parent as usize].map(|w| state.positions[w as usize]);
        let normal = (pb - pa).cross(pc - pa).normalize_or_zero();
        let (ia, ib) = ((k + 1) % 3, (k + 2) % 3);
        let (a, b) = (state.positions[vs[ia] as usize], state.positions[vs[ib] as usize]);
        let rest = &garment.rest[t as usize];
        let (flat, to) = (rest[ib] - rest[ia], rest[k] - rest[ia]);
        let length = flat.length_squared();
        if normal == DVec3::ZERO || length == 0.0 {
            continue;
        }
        let along = to.dot(flat) / length;
        let altitude = flat.perp_dot(to) / length.sqrt();
        let edge = (b - a).normalize_or_zero();
        let onward = normal.cross(edge);
        sum += a + (b - a) * along + (onward - edge * onward.dot(edge)).normalize_or_zero() * altitude;
        normals += normal;
        count += 1.0;
    }
    (count > 0.0).then(|| pushed_out(surface, sum / count, normals.normalize_or_zero(), offset, pushes))
}

/// Pushes `p` out of the body along the parents' normal: beside an arm the nearest skin is often the wrong side.
fn pushed_out(surface: &Surface, p: DVec3, normal: DVec3, offset: f64, pushes: usize) -> DVec3 {
    let step = STEP_OUT * surface.scale();
    let mut q = p;
    for _ in 0..pushes {
        let near = surface.nearest(q);
        if near.distance >= offset {
            return q;
        }
        if near.distance > -step && near.normal.dot(normal) > 0.5 {
            break;
        }
        if normal == DVec3::ZERO {
            break;
        }
        q += normal * step;
    }
    let near = surface.nearest(q);
    if near.distance >= offset { q } else { near.point + near.normal * offset }
}
