//! The dependency graph of a drag: from which neighbours each vertex takes its motion (paper A, Figure 8).

use rayon::prelude::*;

use crate::cloth::EdgeMetric;
use crate::drag::pins::share;

/// The dependency graph: vertices in the order in which motion reaches them, each with its parents.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    order: Vec<u32>,
    starts: Vec<u32>,
    parents: Vec<u32>,
    /// For each entry of `parents` the vertex whose parent it is.
    children: Vec<u32>,
    shares: Vec<f64>,
}

impl Graph {
    /// The graph from `hand` outward over vertices that are `laid`. Vertices to which pins leave no motion are not in it.
    pub fn new(metric: &EdgeMetric, hand: u32, pins: &[u32], laid: &[bool]) -> Self {
        let from_hand = metric.from(&[(hand, 0.0)], |v| laid[v as usize]);
        let mut shares = vec![1.0f64; laid.len()];
        for &pin in pins {
            let from_pin = metric.from(&[(pin, 0.0)], |v| laid[v as usize]);
            let apart = from_pin.distance[hand as usize];
            for &v in &from_hand.order {
                let v = v as usize;
                shares[v] = shares[v].min(share(from_hand.distance[v], from_pin.distance[v], apart));
            }
        }
        let mut graph = Self { starts: vec![0], ..Self::default() };
        let mut within = vec![false; laid.len()];
        for &v in &from_hand.order {
            if shares[v as usize] <= 0.0 {
                continue;
            }
            let before = graph.parents.len();
            graph.parents.extend(metric.neighbours(v).map(|(w, _)| w).filter(|&w| within[w as usize]));
            if graph.parents.len() == before && v != hand {
                continue; // Cut off by pins.
            }
            graph.children.resize(graph.parents.len(), v);
            within[v as usize] = true;
            graph.order.push(v);
            graph.shares.push(shares[v as usize]);
            graph.starts.push(graph.parents.len() as u32);
        }
        graph
    }

    /// Number of vertices in the graph, the hand included.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// Whether the graph is empty, because the hand itself is pinned.
    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// All pairs of parent and child, in the order of [`Graph::steps`].
    pub fn links(&self) -> impl IndexedParallelIterator<Item = (u32, u32)> {
        self.parents.par_iter().copied().zip(self.children.par_iter().copied())
    }

    /// Each vertex with the fraction of the motion that pins leave it (0..=1) and its parents; parents come before
    /// children. The first vertex is the hand, without parents.
    pub fn steps(&self) -> impl Iterator<Item = (u32, f64, &[u32])> {
        self.order.iter().enumerate().map(|(i, &v)| {
            let parents = &self.parents[self.starts[i] as usize..self.starts[i + 1] as usize];
            (v, self.shares[i], parents)
        })
    }

    /// For each of `count` vertices the fraction of the motion that pins leave it; 0 where the drag does not reach.
    pub fn shares(&self, count: usize) -> Vec<f32> {
        let mut shares = vec![0.0; count];
        self.steps().for_each(|(v, share, _)| shares[v as usize] = share as f32);
        shares
    }
}
