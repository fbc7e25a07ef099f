//! The springs of small steps, partitioned for parallel work: ranges of neighbouring vertices with the edges inside each, then
//! the edges between ranges. The partition depends on the cloth alone, so results have the same bits on any number of threads.

use std::ops::Range;

use glam::DVec3;

pub use crate::card::Spring;

/// Vertices per part at least, as a smaller part is not worth it.
const PART: usize = 1250;
/// Most parts. It bounds how many processor cores help, since the result must not depend on their number.
const MOST_PARTS: usize = 8;
/// Largest share of edges between parts with which a partition is used; otherwise the net stays in one part. Those are projected
/// one after the other.
const MOST_BETWEEN: f64 = 0.35;

/// Net of springs that become rigid beyond a strain.
#[derive(Clone, Debug)]
pub struct Net {
    /// Edges of each part, then those between parts; each ordered in groups without common vertices, so that work on an edge need
    /// not wait for the one before it.
    edges: Vec<Edge>,
    /// Stiffness of each edge, N/m.
    stiffness: Vec<f64>,
    /// Strain, either way, beyond which edges are rigid.
    limit: f64,
    /// The parts, in order.
    parts: Vec<Part>,
    /// Step size that the edges' `shares` and `stiffen` were computed for, s; 0 for none.
    ready_for: f64,
}

#[derive(Clone, Debug, PartialEq)]
struct Part {
    vertices: Range<usize>,
    edges: Range<usize>,
}

/// Only what a pass needs: its speed is bound by reading edges from memory.
#[derive(Clone, Copy, Debug)]
struct Edge {
    ends: [u32; 2],
    /// Square of the rest length, m².
    squared: f64,
    /// Share of the length correction that each end takes (compliant, as in XPBD).
    shares: [f64; 2],
    /// Factor on the correction beyond the strain limit, which makes it rigid.
    stiffen: f64,
}

impl Net {
    /// A net of `springs` over `vertices` vertices, rigid beyond a strain of `limit`.
    pub fn new(vertices: usize, springs: &[Spring], limit: f64) -> Self {
        let wanted = (vertices / PART).clamp(1, MOST_PARTS);
        let (parts, springs) = [wanted, 1]
            .into_iter()
            .map(|count| cut(vertices, springs, count))
            .find(|(parts, _)| {
                let within: usize = parts.iter().map(|p| p.edges.len()).sum();
                (springs.len() - within) as f64 <= MOST_BETWEEN * springs.len() as f64
            })
            .unwrap_or_default();
        let edge =
            |s: &Spring| Edge { ends: s.ends, squared: s.length * s.length, shares: [0.0; 2], stiffen: 1.0 };
        Self {
            edges: springs.iter().map(edge).collect(),
            stiffness: springs.iter().map(|s| s.stiffness).collect(),
            limit,
            parts,
            ready_for: 0.0,
        }
    }

    /// Strain, either way, beyond which edges are rigid.
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// Vertex range of each part, in order.
    pub fn parts(&self) -> impl ExactSizeIterator<Item = Range<usize>> {
        self.parts.iter().map(|part| part.vertices.clone())
    }

    /// Discards what was computed from the masses, which have changed.
    pub fn forget(&mut self) {
        self.ready_for = 0.0;
    }

    /// Prepares the edges for steps of `h` seconds; `inverse_mass` per vertex, 1/kg.
    pub fn ready(&mut self, h: f64, inverse_mass: &[f64]) {
        if self.ready_for == h {
            return;
        }
        self.ready_for = h;
        for (edge, stiffness) in self.edges.iter_mut().zip(&self.stiffness) {
            let [a, b] = edge.ends.map(|v| inverse_mass[v as usize]);
            let whole = a + b + 1.0 / (stiffness * h * h);
            edge.shares = [a / whole, b / whole];
            edge.stiffen = if a + b > 0.0 { whole / (a + b) } else { 1.0 };
        }
    }

    /// Projects every edge within part `p` towards its rest length; `x` are the positions of that part's vertices, metres.
    pub fn project_part(&self, p: usize, x: &mut [DVec3]) {
        let part = &self.parts[p];
        project(&self.edges[part.edges.clone()], self.limit, x, part.vertices.start);
    }

    /// Projects every edge between parts; `x` are the positions of all vertices, metres.
    pub fn project_between(&self, x: &mut [DVec3]) {
        let within = self.parts.last().map_or(0, |part| part.edges.end);
        project(&self.edges[within..], self.limit, x, 0);
    }
}

/// Projects every edge towards its rest length; `x` begins with vertex `first`. With squared lengths d² and l² the strain (d² -
/// l²)/(d² + l²) agrees with (d - l)/l to first order, and takes no square root.
fn project(edges: &[Edge], limit: f64, x: &mut [DVec3], first: usize) {
    for edge in edges {
        let [a, b] = edge.ends.map(|v| v as usize - first);
        let along = x[b] - x[a];
        let squared = along.length_squared();
        let strain = (squared - edge.squared) / (squared + edge.squared);
        let over = strain - strain.clamp(-limit, limit);
        let pull = along * (strain + over * (edge.stiffen - 1.0));
        x[a] += pull * edge.shares[0];
        x[b] -= pull * edge.shares[1];
    }
}

/// Partition into `count` ranges of about equally many vertices, and the springs in the order of [`Net::edges`].
fn cut(vertices: usize, springs: &[Spring], count: usize) -> (Vec<Part>, Vec<Spring>) {
    let bound = |p: usize| vertices * p / count;
    let part_of = |v: u32| (0..count).find(|&p| (v as usize) < bound(p + 1)).unwrap_or(count);
    let mut classes: Vec<Vec<Spring>> = vec![Vec::new(); count + 1];
    for spring in springs {
        let [a, b] = spring.ends.map(part_of);
        classes[if a == b { a } else { count }].push(*spring);
    }
    let mut ordered = Vec::with_capacity(springs.len());
    let mut parts = Vec::with_capacity(count);
    for (p, class) in classes.iter().enumerate() {
        let first = ordered.len();
        ordered.extend(in_groups(vertices, class));
        if p < count {
            parts.push(Part { vertices: bound(p)..bound(p + 1), edges: first..ordered.len() });
        }
    }
    (parts, ordered)
}

/// The edges sorted into groups in which no vertex occurs twice; stable within a group.
fn in_groups(vertices: usize, edges: &[Spring]) -> Vec<Spring> {
    let mut taken = vec![0u64; vertices];
    let mut groups: Vec<(u32, usize)> = Vec::with_capacity(edges.len());
    for (e, edge) in edges.iter().enumerate() {
        let [a, b] = edge.ends.map(|v| v as usize);
        let group = (taken[a] | taken[b]).trailing_ones().min(63);
        taken[a] |= 1 << group;
        taken[b] |= 1 << group;
        groups.push((group, e));
    }
    groups.sort_unstable();
    groups.into_iter().map(|(_, e)| edges[e]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square grid of vertices, row by row, with the edges along rows and columns.
    fn grid(side: u32) -> Vec<Spring> {
        let spring = |a, b| Spring { ends: [a, b], length: 0.01, stiffness: 100.0 };
        let across = (0..side * side).filter(|v| v % side + 1 < side).map(|v| spring(v, v + 1));
        let along = (0..side * (side - 1)).map(|v| spring(v, v + side));
        across.chain(along).collect()
    }

    #[test]
    fn every_edge_is_in_one_part_or_between() {
        let (side, springs) = (100, grid(100));
        let net = Net::new(side * side, &springs, 0.01);
        assert_eq!(net.parts.len(), MOST_PARTS);
        assert_eq!(net.parts().flatten().collect::<Vec<_>>(), (0..side * side).collect::<Vec<_>>());
        let mut ends: Vec<[u32; 2]> = net.edges.iter().map(|e| e.ends).collect();
        let mut wanted: Vec<[u32; 2]> = springs.iter().map(|s| s.ends).collect();
        ends.sort_unstable();
        wanted.sort_unstable();
        assert_eq!(ends, wanted);
        for part in &net.parts {
            let inside = |e: &Edge| e.ends.iter().all(|&v| part.vertices.contains(&(v as usize)));
            assert!(net.edges[part.edges.clone()].iter().all(inside));
        }
        let between = net.edges.len() - net.parts[MOST_PARTS - 1].edges.end;
        assert!(between > 0 && between < springs.len() / 10, "{between}");
    }

    #[test]
    fn cloth_whose_neighbours_are_far_apart_is_one_part() {
        let n = 8000u32;
        let far: Vec<Spring> =
            (0..n).map(|v| Spring { ends: [v, (v + n / 2) % n], length: 1.0, stiffness: 1.0 }).collect();
        let net = Net::new(n as usize, &far, 0.01);
        assert_eq!((net.parts().len(), net.parts().next()), (1, Some(0..n as usize)));
        assert_eq!(net.edges.len(), far.len());
    }
}
