//! Adjacency of a triangle mesh: edges, and the neighbours of triangles and vertices.

use std::collections::BTreeMap;

/// Marks a missing neighbour in [`Adjacency::across`], and no number at all in other lists of numbers.
pub const NONE: u32 = u32::MAX;

/// Lists of varying length, one per owner (an index), stored in one array (compressed sparse rows).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lists {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// Groups `(owner, item)` pairs by owner, keeping their order. Owners are `0..count`.
    pub fn grouped(count: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        let mut starts = vec![0u32; count + 1];
        for (owner, _) in pairs.clone() {
            starts[owner as usize + 1] += 1;
        }
        for i in 0..count {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut items = vec![0; *starts.last().unwrap_or(&0) as usize];
        for (owner, item) in pairs {
            items[next[owner as usize] as usize] = item;
            next[owner as usize] += 1;
        }
        Self { starts, items }
    }

    /// The items of `owner`.
    pub fn of(&self, owner: u32) -> &[u32] {
        &self.items[self.places(owner)]
    }

    /// The range of `owner`'s items within [`Lists::items`].
    pub fn places(&self, owner: u32) -> std::ops::Range<usize> {
        self.starts[owner as usize] as usize..self.starts[owner as usize + 1] as usize
    }

    /// The items of all owners, one owner after the other.
    pub fn items(&self) -> &[u32] {
        &self.items
    }

    /// Memory used by both arrays, bytes.
    pub fn bytes(&self) -> usize {
        (self.starts.len() + self.items.len()) * size_of::<u32>()
    }

    /// Number of owners.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// True when there is no owner.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Edges and neighbours of a triangle mesh; any number of triangles may share an edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Adjacency {
    /// Every edge once as its two vertices, the lower first; sorted.
    pub edges: Vec<[u32; 2]>,
    /// For triangle `t` and corner `k`: the edge from corner `k` to corner `k + 1`.
    pub triangle_edges: Vec<[u32; 3]>,
    /// For triangle `t` and corner `k`: the triangle across that edge, or [`NONE`] (border or non-manifold).
    pub across: Vec<[u32; 3]>,
    /// Triangles of each edge, ascending.
    pub edge_triangles: Lists,
    /// Triangles of each vertex, ascending.
    pub vertex_triangles: Lists,
    /// Neighbouring vertices of each vertex, ascending.
    pub vertex_neighbours: Lists,
}

impl Adjacency {
    /// Adjacency of `triangles` over `vertex_count` vertices.
    pub fn new(vertex_count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut ids: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        for t in triangles {
            for k in 0..3 {
                ids.insert(key(t[k], t[(k + 1) % 3]), 0);
            }
        }
        let edges: Vec<[u32; 2]> = ids.keys().copied().collect();
        for (i, id) in ids.values_mut().enumerate() {
            *id = i as u32;
        }
        let triangle_edges: Vec<[u32; 3]> =
            triangles.iter().map(|t| [0, 1, 2].map(|k| ids[&key(t[k], t[(k + 1) % 3])])).collect();
        let edge_triangles = Lists::grouped(
            edges.len(),
            triangle_edges.iter().enumerate().flat_map(|(t, es)| es.iter().map(move |&e| (e, t as u32))),
        );
        let across = triangle_edges
            .iter()
            .enumerate()
            .map(|(t, es)| {
                es.map(|e| match edge_triangles.of(e) {
                    [a, b] if *a == t as u32 => *b,
                    [a, b] if *b == t as u32 => *a,
                    _ => NONE,
                })
            })
            .collect();
        let vertex_triangles = Lists::grouped(
            vertex_count,
            triangles.iter().enumerate().flat_map(|(t, vs)| vs.iter().map(move |&v| (v, t as u32))),
        );
        let mut pairs: Vec<(u32, u32)> = edges.iter().flat_map(|&[a, b]| [(a, b), (b, a)]).collect();
        pairs.sort_unstable();
        let vertex_neighbours = Lists::grouped(vertex_count, pairs.iter().copied());
        Self { edges, triangle_edges, across, edge_triangles, vertex_triangles, vertex_neighbours }
    }

    /// For each vertex the first vertex of its connected component.
    pub fn parts(&self) -> Vec<u32> {
        let count = self.vertex_neighbours.len();
        let mut parts = vec![u32::MAX; count];
        let mut open = Vec::new();
        for first in 0..count as u32 {
            open.push(first);
            while let Some(v) = open.pop() {
                if parts[v as usize] == u32::MAX {
                    parts[v as usize] = first;
                    open.extend(self.vertex_neighbours.of(v));
                }
            }
        }
        parts
    }

    /// One owner for every corner and edge: for each of `triangles` (those that this is the adjacency of) which corners (bits 0..3)
    /// and sides (bits 3..6, from that corner to the next) it owns.
    pub fn owned(&self, triangles: &[[u32; 3]]) -> Vec<u8> {
        let mut known = vec![false; self.vertex_triangles.len()];
        let mut known_edges = vec![false; self.edges.len()];
        let bits = |(vs, es): (&[u32; 3], &[u32; 3])| {
            (0..3).fold(0, |bits, k| {
                let corner = !std::mem::replace(&mut known[vs[k] as usize], true);
                let side = !std::mem::replace(&mut known_edges[es[k] as usize], true);
                bits | u8::from(corner) << k | u8::from(side) << (3 + k)
            })
        };
        triangles.iter().zip(&self.triangle_edges).map(bits).collect()
    }

    /// The hinge at edge `e` of `triangles` (those that this is the adjacency of): the ends of the edge in the order in which its
    /// first triangle traverses it, that triangle's third corner, and that of the other triangle. None on the border.
    pub fn hinge(&self, triangles: &[[u32; 3]], e: u32) -> Option<[u32; 4]> {
        let &[s, t] = self.edge_triangles.of(e) else { return None };
        let from = |t: u32| {
            let k = self.triangle_edges[t as usize].iter().position(|&side| side == e)?;
            let vs = triangles[t as usize];
            Some([vs[k], vs[(k + 1) % 3], vs[(k + 2) % 3]])
        };
        let ([a, b, c], [_, _, d]) = (from(s)?, from(t)?);
        Some([a, b, c, d])
    }

    /// Memory used by all lists, bytes.
    pub fn bytes(&self) -> usize {
        let Self { edges, triangle_edges, across, edge_triangles, vertex_triangles, vertex_neighbours } =
            self;
        edges.len() * size_of::<[u32; 2]>()
            + (triangle_edges.len() + across.len()) * size_of::<[u32; 3]>()
            + [edge_triangles, vertex_triangles, vertex_neighbours].map(Lists::bytes).iter().sum::<usize>()
    }
}

fn key(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_triangles_share_one_edge() {
        let a = Adjacency::new(4, &[[0, 1, 2], [0, 2, 3]]);
        assert_eq!(a.edges.len(), 5);
        assert_eq!(a.across[0], [NONE, NONE, 1]);
        assert_eq!(a.across[1], [0, NONE, NONE]);
        assert_eq!(a.vertex_neighbours.of(0), [1, 2, 3]);
        assert_eq!(a.vertex_triangles.of(1), [0]);
    }
}
