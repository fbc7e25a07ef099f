//! What crosses at a detection, and so has no plane to keep it apart.

use crate::contact::separation::Separation;
use crate::geometry::bvh::Aabb;
use crate::geometry::crossings::segment_meets_triangle;

/// Pairs of features that are free, sorted.
#[derive(Debug, Default)]
pub(super) struct Crossings {
    /// Edges through triangles.
    places: usize,
    /// Vertices and triangles of the cloth; edges of it, the smaller first.
    vertices: Vec<[u32; 2]>,
    edges: Vec<[u32; 2]>,
    /// The cloth's vertices and the obstacle's triangles; edges of both; the cloth's triangles and the obstacle's vertices.
    of_obstacle: [Vec<[u32; 2]>; 3],
    /// Vertices inside the obstacle; empty where none is,
    inside: Vec<bool>,
    /// and triangles and edges with one.
    triangles_inside: Vec<bool>,
    edges_inside: Vec<bool>,
}

impl Crossings {
    /// Of the cloth where it is.
    pub fn found(this: &Separation, boxes: &[Aabb], is_inside: impl Fn(usize) -> bool + Sync) -> Self {
        let x = &this.anchors;
        let all = this.search(
            boxes,
            |s, t, found: &mut Self| {
                for [s, t] in [[s, t], [t, s]] {
                    let vs = this.cloth.triangles[t as usize];
                    for e in this.cloth.edges_of(s) {
                        let is_through = !this.joined(&this.cloth.edges[e as usize], &vs)
                            && segment_meets_triangle(this.cloth.ends(x, e), this.cloth.corners(x, t));
                        if is_through {
                            found.places += 1;
                            found.vertices.extend(this.cloth.edges[e as usize].map(|v| [v, t]));
                            let edges = this.cloth.triangle_edges[t as usize];
                            found.edges.extend(edges.map(|f| [e.min(f), e.max(f)]));
                        }
                    }
                }
            },
            |s, t, found| found.add_obstacle(this, s, t),
        );
        let mut whole = Self::default();
        for found in all {
            whole.places += found.places;
            whole.vertices.extend(found.vertices);
            whole.edges.extend(found.edges);
            whole.of_obstacle.iter_mut().zip(found.of_obstacle).for_each(|(all, some)| all.extend(some));
        }
        let [a, b, c] = &mut whole.of_obstacle;
        for pairs in [&mut whole.vertices, &mut whole.edges, a, b, c] {
            pairs.sort_unstable();
        }
        if this.obstacle.is_some() {
            whole.look_inside(this, is_inside);
        }
        whole
    }

    fn add_obstacle(&mut self, this: &Separation, s: u32, t: u32) {
        let Some(obstacle) = this.obstacle.as_deref() else { return };
        let (topology, still, x) = (&obstacle.topology, &obstacle.positions, &this.anchors);
        let [vertices, edges, triangles] = &mut self.of_obstacle;
        for e in this.cloth.edges_of(s) {
            if segment_meets_triangle(this.cloth.ends(x, e), topology.corners(still, t)) {
                self.places += 1;
                vertices.extend(this.cloth.edges[e as usize].map(|v| [v, t]));
                edges.extend(topology.triangle_edges[t as usize].map(|f| [e, f]));
            }
        }
        for e in topology.edges_of(t) {
            if segment_meets_triangle(topology.ends(still, e), this.cloth.corners(x, s)) {
                self.places += 1;
                triangles.extend(topology.edges[e as usize].map(|v| [s, v]));
                edges.extend(this.cloth.triangle_edges[s as usize].map(|f| [f, e]));
            }
        }
    }

    fn look_inside(&mut self, this: &Separation, is_inside: impl Fn(usize) -> bool + Sync) {
        use rayon::prelude::*;
        let count = this.anchors.len();
        let inside: Vec<bool> = (0..count).into_par_iter().with_min_len(64).map(&is_inside).collect();
        if inside.contains(&true) {
            self.triangles_inside =
                this.cloth.triangles.iter().map(|vs| vs.iter().any(|&v| inside[v as usize])).collect();
            self.edges_inside =
                this.cloth.edges.iter().map(|vs| vs.iter().any(|&v| inside[v as usize])).collect();
            self.inside = inside;
        }
    }

    /// Edges through triangles.
    pub fn count(&self) -> usize {
        self.places
    }

    /// Nothing crosses, and nothing is inside.
    pub fn is_none(&self) -> bool {
        self.places == 0 && self.inside.is_empty()
    }

    /// Whether vertex `v` may pass through triangle `t`, both of the cloth.
    pub fn vertex_is_free(&self, v: u32, t: u32) -> bool {
        has(&self.vertices, [v, t])
    }

    /// Whether edges of the cloth may pass through each other.
    pub fn edges_are_free(&self, e: u32, f: u32) -> bool {
        has(&self.edges, [e.min(f), e.max(f)])
    }

    /// The same of the cloth's vertex and the obstacle's triangle,
    pub fn vertex_is_free_of_obstacle(&self, v: u32, t: u32) -> bool {
        is(&self.inside, v) || has(&self.of_obstacle[0], [v, t])
    }

    /// of an edge of either,
    pub fn edge_is_free_of_obstacle(&self, e: u32, f: u32) -> bool {
        is(&self.edges_inside, e) || has(&self.of_obstacle[1], [e, f])
    }

    /// and of the cloth's triangle and the obstacle's vertex.
    pub fn triangle_is_free_of_obstacle(&self, s: u32, v: u32) -> bool {
        is(&self.triangles_inside, s) || has(&self.of_obstacle[2], [s, v])
    }
}

fn has(sorted: &[[u32; 2]], pair: [u32; 2]) -> bool {
    !sorted.is_empty() && sorted.binary_search(&pair).is_ok()
}

fn is(of: &[bool], i: u32) -> bool {
    of.get(i as usize).copied().unwrap_or(false)
}
