//! Features that intersect at a detection, and so get no plane to separate them.

use rayon::prelude::*;

use crate::contact::separation::Separation;
use crate::contact::separation::approach::Approach;
use crate::geometry::crossings::segment_meets_triangle;
use crate::geometry::parallel::{LEAST_SEARCHES, LEAST_SHARE};

/// Pairs of features that may pass through each other, because they intersect; sorted.
#[derive(Debug, Default)]
pub(super) struct Crossings {
    /// Number of edges that pass through triangles.
    places: usize,
    /// Pairs of a vertex and a triangle of the cloth.
    vertices: Vec<[u32; 2]>,
    /// Pairs of edges of the cloth, the smaller first.
    edges: Vec<[u32; 2]>,
    /// Pairs of a vertex of the cloth and a triangle of the obstacle, of an edge of each, and of a triangle of the
    /// cloth and a vertex of the obstacle.
    of_obstacle: [Vec<[u32; 2]>; 3],
    /// For each vertex whether it is inside the obstacle; empty where none is.
    inside: Vec<bool>,
    /// For each triangle whether a vertex of it is inside the obstacle.
    triangles_inside: Vec<bool>,
    /// For each edge whether a vertex of it is inside the obstacle.
    edges_inside: Vec<bool>,
}

impl Crossings {
    /// Finds the intersections of the cloth at its anchors.
    pub fn found(
        this: &Separation,
        approaches: &mut [Approach],
        is_inside: impl Fn(usize) -> bool + Sync,
    ) -> Self {
        let mut all = this.search(
            (approaches, Approach::touch),
            |s, t, found: &mut Self| found.add_cloth(this, s, t),
            |s, t, found| found.add_obstacle(this, s, t),
        );
        all.par_extend(this.beside.triangles.par_chunks(LEAST_SHARE).map(|pairs| {
            let mut found = Self::default();
            pairs.iter().for_each(|&[s, t]| found.add_cloth(this, s, t));
            found
        }));
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

    fn add_cloth(&mut self, this: &Separation, s: u32, t: u32) {
        let x = &this.anchors;
        let [one, other] = [s, t].map(|t| &this.placed[t as usize].around);
        if !one.meets(other) {
            return;
        }
        for [s, t] in [[s, t], [t, s]] {
            let vs = this.cloth.triangles[t as usize];
            for e in this.cloth.edges_of(s) {
                let is_through = !this.joined(&this.cloth.edges[e as usize], &vs)
                    && segment_meets_triangle(this.cloth.ends(x, e), this.cloth.corners(x, t));
                if is_through {
                    self.places += 1;
                    self.vertices.extend(this.cloth.edges[e as usize].map(|v| [v, t]));
                    let edges = this.cloth.triangle_edges[t as usize];
                    self.edges.extend(edges.map(|f| [e.min(f), e.max(f)]));
                }
            }
        }
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
        let count = this.anchors.len();
        let inside: Vec<bool> =
            (0..count).into_par_iter().with_min_len(LEAST_SEARCHES).map(&is_inside).collect();
        if inside.contains(&true) {
            self.triangles_inside =
                this.cloth.triangles.iter().map(|vs| vs.iter().any(|&v| inside[v as usize])).collect();
            self.edges_inside =
                this.cloth.edges.iter().map(|vs| vs.iter().any(|&v| inside[v as usize])).collect();
            self.inside = inside;
        }
    }

    /// Number of edges that pass through triangles.
    pub fn count(&self) -> usize {
        self.places
    }

    /// Whether nothing intersects, and nothing is inside the obstacle.
    pub fn is_none(&self) -> bool {
        self.places == 0 && self.inside.is_empty()
    }

    /// Whether vertex `v` may pass through triangle `t`, both of the cloth.
    pub fn vertex_is_free(&self, v: u32, t: u32) -> bool {
        has(&self.vertices, [v, t])
    }

    /// Whether edges `e` and `f` of the cloth may pass through each other.
    pub fn edges_are_free(&self, e: u32, f: u32) -> bool {
        has(&self.edges, [e.min(f), e.max(f)])
    }

    /// Whether vertex `v` of the cloth may pass through triangle `t` of the obstacle.
    pub fn vertex_is_free_of_obstacle(&self, v: u32, t: u32) -> bool {
        is(&self.inside, v) || has(&self.of_obstacle[0], [v, t])
    }

    /// Whether edge `e` of the cloth may pass through edge `f` of the obstacle.
    pub fn edge_is_free_of_obstacle(&self, e: u32, f: u32) -> bool {
        is(&self.edges_inside, e) || has(&self.of_obstacle[1], [e, f])
    }

    /// Whether triangle `s` of the cloth may pass through vertex `v` of the obstacle.
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
