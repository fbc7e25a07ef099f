//! Adaptive √3 subdivision (paper A): some edges of a garment are split, one level deep.
//!
//! The centroids of the two triangles at an edge are inserted, and the edge is flipped to join them. At a border, and
//! along a seam, where the two sides are in different planes of the pattern, the midpoint of the edge is inserted
//! instead: both sides then keep their own plane and the pattern's flat lengths.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::cloth::{ClothState, Corner, Garment};
use crate::geometry::adjacency::Adjacency;

/// A dependent vertex: inserted by subdivision, with its position interpolated from other vertices (its masters).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DependentVertex {
    /// The masters and their weights, which sum to one.
    pub shares: [(u32, f64); 3],
    /// A triangle of the unrefined garment that the vertex is on.
    pub triangle: u32,
}

/// A garment with some edges split. *Plain* means the garment before.
#[derive(Clone, Debug)]
pub struct Refined {
    /// The refined garment. Its vertices are those of the plain garment, followed by the dependent ones.
    pub garment: Arc<Garment>,
    /// The dependent vertices.
    pub dependents: Vec<DependentVertex>,
    /// Triangles of the plain garment that were subdivided, ascending.
    pub opened: Vec<u32>,
    /// Index of the first triangle of `garment` that was subdivided; those before it are whole triangles of the plain garment.
    pub first_cut: usize,
    /// For each triangle of `garment` from `first_cut` on, the plain triangle that it is a part of. Its flat corners
    /// are corners of that triangle, except those of dependent vertices, which have corners of their own.
    pub cut_from: Vec<u32>,
}

/// How an edge is split.
#[derive(Clone, Copy, Debug)]
enum Split {
    /// The edge is flipped to join the centroids of these two triangles.
    Turned([u32; 2]),
    /// A vertex is inserted at its midpoint.
    Halved,
}

/// A refined garment under construction. Corners of the plain garment come first; they are renumbered at the end.
struct Builder<'a> {
    plain: &'a Garment,
    dependents: Vec<DependentVertex>,
    corners: Vec<Corner>,
    /// For each subdivided triangle the corner at its centroid.
    centroids: BTreeMap<u32, u32>,
    /// For each edge split at its midpoint and each triangle beside it, the corner at the midpoint.
    middles: BTreeMap<(u32, u32), u32>,
    triangles: Vec<([u32; 3], u32)>,
}

/// Splits `edges` (ascending) of the garment `plain`.
pub fn refine(plain: &Garment, edges: &[u32]) -> Refined {
    let mut builder = Builder {
        plain,
        dependents: Vec::new(),
        corners: plain.corners.clone(),
        centroids: BTreeMap::new(),
        middles: BTreeMap::new(),
        triangles: Vec::new(),
    };
    let opened: BTreeSet<u32> =
        edges.iter().flat_map(|&e| plain.adjacency.edge_triangles.of(e)).copied().collect();
    let opened: Vec<u32> = opened.into_iter().collect();
    opened.iter().for_each(|&t| builder.put_centroid(t));
    let splits: BTreeMap<u32, Split> = edges.iter().map(|&e| (e, builder.split(e))).collect();
    opened.iter().for_each(|&t| builder.cut(t, &splits));
    builder.finish(opened)
}

impl Builder<'_> {
    fn put(&mut self, dependent: DependentVertex, corners: &[u32]) -> u32 {
        let vertex = (self.plain.vertex_count + self.dependents.len()) as u32;
        self.dependents.push(dependent);
        self.put_corner(vertex, corners)
    }

    /// Adds a corner of `vertex` at the mean of the corners `others`.
    fn put_corner(&mut self, vertex: u32, others: &[u32]) -> u32 {
        let at = |c: &u32| self.corners[*c as usize];
        let uv = others.iter().map(|c| at(c).uv).sum::<DVec2>() / others.len() as f64;
        let piece = others.first().map(at).map(|c| c.piece).unwrap_or_default();
        self.corners.push(Corner { piece, uv, vertex });
        self.corners.len() as u32 - 1
    }

    fn put_centroid(&mut self, t: u32) {
        let shares = self.plain.triangles[t as usize].map(|v| (v, 1.0 / 3.0));
        let corner =
            self.put(DependentVertex { shares, triangle: t }, &self.plain.triangle_corners[t as usize]);
        self.centroids.insert(t, corner);
    }

    /// The corners at the ends of side `k` of triangle `t`.
    fn side(&self, t: u32, k: usize) -> [u32; 2] {
        let corners = self.plain.triangle_corners[t as usize];
        [corners[k], corners[(k + 1) % 3]]
    }

    fn side_of(&self, t: u32, e: u32) -> usize {
        self.plain.adjacency.triangle_edges[t as usize].iter().position(|&other| other == e).unwrap_or(0)
    }

    fn split(&mut self, e: u32) -> Split {
        let beside = self.plain.adjacency.edge_triangles.of(e);
        if let &[s, t] = beside {
            let [a, b] = self.side(s, self.side_of(s, e));
            let [c, d] = self.side(t, self.side_of(t, e));
            if a == d && b == c {
                return Split::Turned([s, t]);
            }
        }
        let [a, b] = self.plain.adjacency.edges[e as usize];
        let triangle = beside.first().copied().unwrap_or_default();
        let dependent = DependentVertex { shares: [(a, 0.5), (b, 0.5), (a, 0.0)], triangle };
        let mut vertex = None;
        for &t in beside {
            let ends = self.side(t, self.side_of(t, e));
            let corner = match vertex {
                None => self.put(dependent, &ends),
                Some(v) => self.put_corner(v, &ends),
            };
            vertex = Some(self.corners[corner as usize].vertex);
            self.middles.insert((e, t), corner);
        }
        Split::Halved
    }

    /// Adds the triangles into which triangle `t` is subdivided.
    fn cut(&mut self, t: u32, splits: &BTreeMap<u32, Split>) {
        let centre = self.centroids[&t];
        for k in 0..3 {
            let [a, b] = self.side(t, k);
            let e = self.plain.adjacency.triangle_edges[t as usize][k];
            match splits.get(&e) {
                None => self.triangles.push(([a, b, centre], t)),
                Some(Split::Halved) => {
                    let middle = self.middles[&(e, t)];
                    self.triangles.extend([([a, middle, centre], t), ([middle, b, centre], t)]);
                }
                // A flipped edge is handled once, by the first of its two triangles.
                Some(Split::Turned([first, other])) if *first == t => {
                    let across = self.centroids[other];
                    self.triangles.extend([([a, across, centre], t), ([across, b, centre], t)]);
                }
                Some(Split::Turned(_)) => {}
            }
        }
    }

    fn finish(self, opened: Vec<u32>) -> Refined {
        let Self { plain, dependents, corners, triangles, .. } = self;
        // Renumber the corners, so that those of each piece are together.
        let mut order: Vec<u32> = (0..corners.len() as u32).collect();
        order.sort_by_key(|&c| (corners[c as usize].piece, c));
        let mut place = vec![0u32; corners.len()];
        order.iter().enumerate().for_each(|(i, &c)| place[c as usize] = i as u32);
        let mut garment = Garment {
            vertex_count: plain.vertex_count + dependents.len(),
            corners: order.iter().map(|&c| corners[c as usize]).collect(),
            pieces: plain.pieces.clone(),
            layers: plain.layers.clone(),
            grains: plain.grains.clone(),
            seam_pairs: plain.seam_pairs.clone(),
            trims: plain.trims.renumbered(&place),
            ..Garment::default()
        };
        let pairs = garment.seam_pairs.iter_mut().flat_map(|(_, pairs)| pairs);
        pairs.for_each(|pair| *pair = pair.map(|c| place[c as usize]));
        for t in (0..plain.triangles.len()).filter(|&t| opened.binary_search(&(t as u32)).is_err()) {
            garment.triangles.push(plain.triangles[t]);
            garment.triangle_corners.push(plain.triangle_corners[t].map(|c| place[c as usize]));
            garment.triangle_pieces.push(plain.triangle_pieces[t]);
            garment.rest.push(plain.rest[t]);
        }
        let first_cut = garment.triangles.len();
        let mut cut_from = Vec::with_capacity(triangles.len());
        for (cs, t) in triangles {
            let uv = front(plain, t, cs.map(|c| corners[c as usize].uv));
            cut_from.push(t);
            let centre = (uv[0] + uv[1] + uv[2]) / 3.0;
            garment.triangles.push(cs.map(|c| corners[c as usize].vertex));
            garment.triangle_corners.push(cs.map(|c| place[c as usize]));
            let piece = plain.triangle_pieces[t as usize];
            garment.triangle_pieces.push(piece);
            garment.rest.push(plain.along_grain(piece, uv.map(|p| p - centre)));
        }
        garment.adjacency = Adjacency::new(garment.vertex_count, &garment.triangles);
        Refined { garment: Arc::new(garment), dependents, opened, first_cut, cut_from }
    }
}

/// Flat points of the piece of triangle `t` as seen from the front of the cloth: mirrored where the front is the far side.
fn front(plain: &Garment, t: u32, uv: [DVec2; 3]) -> [DVec2; 3] {
    let [a, b, c] = plain.triangle_corners[t as usize].map(|c| plain.corners[c as usize].uv);
    let far = (b - a).perp_dot(c - a) < 0.0;
    if far { uv.map(|p| DVec2::new(-p.x, p.y)) } else { uv }
}

impl Refined {
    /// The state of the refined garment from that of the plain one: dependent vertices are interpolated from their
    /// masters and displaced by `beside` (metres).
    pub fn state(&self, state: &ClothState, beside: impl Fn(usize) -> DVec3) -> ClothState {
        let mut state = state.clone();
        for (i, dependent) in self.dependents.iter().enumerate() {
            let between = dependent.between(&state);
            state.mapped.push(dependent.shares.iter().all(|&(v, _)| state.mapped[v as usize]));
            state.positions.push(between + beside(i));
        }
        state
    }

    /// Memory used, bytes.
    pub fn bytes(&self) -> usize {
        self.garment.bytes()
            + self.dependents.capacity() * size_of::<DependentVertex>()
            + (self.opened.capacity() + self.cut_from.capacity()) * 4
    }
}

impl DependentVertex {
    /// Position interpolated from the masters, metres.
    pub fn between(&self, state: &ClothState) -> DVec3 {
        self.shares.iter().map(|&(v, share)| state.positions[v as usize] * share).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::build;
    use crate::pattern::{EdgeRef, Pattern, Piece, Seam};

    /// Two squares sewn along one side; the warp of the second runs aslant.
    fn sewn() -> Garment {
        let corners = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.2), (0.0, 0.2)].map(|(x, y)| DVec2::new(x, y));
        let mut pattern = Pattern::default();
        let grainlines = [None, Some([DVec2::ZERO, DVec2::new(0.03, 0.04)])];
        let [a, b] = ["a", "b"].map(|name| Piece::polygon(name, &corners)).map(|piece| {
            let grainline = grainlines[usize::from(piece.name == "b")];
            pattern.add_piece(Piece { grainline, ..piece })
        });
        let sides = [EdgeRef { piece: a, edge: 1 }, EdgeRef { piece: b, edge: 3 }];
        pattern.add_seam(Seam::of_edges(sides, false));
        build(&pattern, 0.05).0
    }

    fn area(garment: &Garment) -> f64 {
        let area = |rest: &[DVec2; 3]| (rest[1] - rest[0]).perp_dot(rest[2] - rest[0]) / 2.0;
        assert!(garment.rest.iter().all(|rest| area(rest) > 0.0), "front up");
        garment.rest.iter().map(area).sum()
    }

    /// Any set of edges: the same area, a mesh without holes or doubled edges, flat places where they were.
    #[test]
    fn splitting_keeps_the_cloth_whole() {
        let plain = sewn();
        let border = |g: &Garment| {
            let lists = &g.adjacency;
            (0..lists.edges.len()).filter(|&e| lists.edge_triangles.of(e as u32).len() == 1).count()
        };
        let edges = plain.adjacency.edges.len() as u32;
        for (every, from) in [(1, 0), (2, 0), (3, 1), (7, 2), (1000, 5)] {
            let some: Vec<u32> = (from..edges).step_by(every).collect();
            let refined = refine(&plain, &some);
            let fine = &refined.garment;
            assert!((area(fine) - area(&plain)).abs() < 1e-12);
            let counts = (0..fine.adjacency.edges.len()).map(|e| fine.adjacency.edge_triangles.of(e as u32));
            assert!(counts.clone().all(|ts| ts.len() <= 2), "two triangles at an edge");
            let halved = some.iter().filter(|&&e| plain.adjacency.edge_triangles.of(e).len() == 1).count();
            assert_eq!(border(fine), border(&plain) + halved);
            // Vertices less edges plus faces: still one disc.
            let euler = |g: &Garment| {
                g.vertex_count as i64 - g.adjacency.edges.len() as i64 + g.triangles.len() as i64
            };
            assert_eq!(euler(fine), euler(&plain));
            assert!(fine.corners.is_sorted_by_key(|c| c.piece));
            for (t, cs) in fine.triangle_corners.iter().enumerate() {
                let corners = cs.map(|c| fine.corners[c as usize]);
                assert_eq!(corners.map(|c| c.vertex), fine.triangles[t]);
                assert!(corners.iter().all(|c| c.piece == fine.triangle_pieces[t]));
                for k in 0..3 {
                    let flat = (corners[k].uv - corners[(k + 1) % 3].uv).length();
                    assert!((flat - fine.rest[t][k].distance(fine.rest[t][(k + 1) % 3])).abs() < 1e-12);
                    let [warp, weft] = match fine.triangle_pieces[t] == plain.pieces[1].0 {
                        true => [DVec2::new(0.6, 0.8), DVec2::new(0.8, -0.6)],
                        false => [DVec2::Y, DVec2::X],
                    };
                    let (way, rest) = (corners[k].uv - corners[0].uv, fine.rest[t][k] - fine.rest[t][0]);
                    assert!(
                        rest.abs_diff_eq(DVec2::new(way.dot(weft), way.dot(warp)), 1e-12),
                        "along the grain"
                    );
                }
            }
        }
    }

    #[test]
    fn nothing_split_is_the_same_garment() {
        let plain = sewn();
        let refined = refine(&plain, &[]);
        assert_eq!(refined.garment.triangles, plain.triangles);
        assert_eq!(refined.garment.corners, plain.corners);
        assert!(refined.dependents.is_empty() && refined.opened.is_empty());
    }
}
