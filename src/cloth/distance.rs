//! Distances over the cloth along its edges, by rest length.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::cloth::Garment;
use crate::geometry::adjacency::Lists;

/// Rest lengths of a garment's edges, and the edges of each vertex.
#[derive(Clone, Debug, Default)]
pub struct EdgeMetric {
    lengths: Vec<f64>,
    edges: Vec<[u32; 2]>,
    vertex_edges: Lists,
}

impl EdgeMetric {
    /// Rest lengths of `garment`. An edge on a seam whose two sides differ in length gets their mean.
    pub fn new(garment: &Garment) -> Self {
        let edges = garment.adjacency.edges.clone();
        let mut lengths = vec![0.0; edges.len()];
        let mut counts = vec![0.0; edges.len()];
        for (rest, ids) in garment.rest.iter().zip(&garment.adjacency.triangle_edges) {
            for k in 0..3 {
                lengths[ids[k] as usize] += (rest[(k + 1) % 3] - rest[k]).length();
                counts[ids[k] as usize] += 1.0;
            }
        }
        lengths.iter_mut().zip(counts).for_each(|(l, n)| *l /= n);
        let ends = edges.iter().enumerate().flat_map(|(e, vs)| vs.iter().map(move |&v| (v, e as u32)));
        let vertex_edges = Lists::grouped(garment.vertex_count, ends);
        Self { lengths, edges, vertex_edges }
    }

    /// Neighbours of `vertex`, each with the rest length of the edge to it, metres.
    pub fn neighbours(&self, vertex: u32) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.vertex_edges.of(vertex).iter().map(move |&e| {
            let [a, b] = self.edges[e as usize];
            (if a == vertex { b } else { a }, self.lengths[e as usize])
        })
    }

    /// Shortest edge distance (Dijkstra) of every vertex from the nearest of `sources` (vertex, initial distance),
    /// metres. Only vertices for which `enters` is true are entered; others are infinite. At most 2/sqrt(3) times the
    /// distance in the plane. Equal input gives equal order in [`Reached::order`].
    pub fn from(&self, sources: &[(u32, f64)], enters: impl Fn(u32) -> bool) -> Reached {
        let count = self.vertex_edges.len();
        let mut reached = Reached { distance: vec![f64::INFINITY; count], order: Vec::new() };
        // Distances are not negative, so that their bits sort as they do.
        let mut queue = BinaryHeap::new();
        for &(v, d) in sources {
            if d < reached.distance[v as usize] {
                reached.distance[v as usize] = d;
                queue.push(Reverse((d.to_bits(), v)));
            }
        }
        let mut done = vec![false; count];
        while let Some(Reverse((bits, v))) = queue.pop() {
            if std::mem::replace(&mut done[v as usize], true) {
                continue;
            }
            reached.order.push(v);
            for (w, length) in self.neighbours(v) {
                let next = f64::from_bits(bits) + length;
                if next < reached.distance[w as usize] && enters(w) {
                    reached.distance[w as usize] = next;
                    queue.push(Reverse((next.to_bits(), w)));
                }
            }
        }
        reached
    }
}

/// Result of [`EdgeMetric::from`].
#[derive(Clone, Debug, Default)]
pub struct Reached {
    /// For each vertex its distance, metres; infinite where not reached.
    pub distance: Vec<f64>,
    /// Vertices reached, nearest first; equally near ones by number.
    pub order: Vec<u32>,
}
