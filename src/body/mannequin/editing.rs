//! Edge splits, collapses and flips on a triangle mesh that may be open along the plane x = 0.
//!
//! Invariants: the mesh stays a manifold; vertices on the open edge (`rim`) stay on it; two rim vertices are joined
//! by an edge only along the rim, so that mirroring closes the mesh without doubled triangles.

use glam::DVec3;
use smallvec::SmallVec;

/// A few vertices or triangles round a vertex or an edge.
pub type Few = SmallVec<[u32; 16]>;

/// A triangle mesh being edited. Removed triangles and vertices stay in the lists until `compacted`.
pub struct Editing {
    /// Positions of the vertices, metres.
    pub positions: Vec<DVec3>,
    /// The triangles; a removed triangle has all corners equal.
    pub triangles: Vec<[u32; 3]>,
    /// Triangles round each vertex, in no particular order; empty for removed vertices.
    pub around: Vec<Vec<u32>>,
    /// For each vertex whether it is on the open edge.
    pub rim: Vec<bool>,
}

impl Editing {
    /// Starts editing a mesh whose open edges are all at x = 0.
    pub fn new(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        let mut around = vec![Vec::new(); positions.len()];
        for (t, corners) in triangles.iter().enumerate() {
            for &v in corners {
                around[v as usize].push(t as u32);
            }
        }
        let rim = positions.iter().map(|p| p.x == 0.0).collect();
        Self { positions, triangles, around, rim }
    }

    /// Edges, lower vertex first, ascending.
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let mut edges: Vec<u64> = Vec::with_capacity(self.triangles.len() * 3 / 2);
        for t in self.triangles.iter().filter(|t| t[0] != t[1]) {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                // The two triangles of an edge run along it in opposite directions; one on the rim has only one.
                if a < b || (self.rim[a as usize] && self.rim[b as usize]) {
                    edges.push(u64::from(a.min(b)) << 32 | u64::from(a.max(b)));
                }
            }
        }
        edges.sort_unstable();
        edges.dedup();
        edges.into_iter().map(|edge| [(edge >> 32) as u32, edge as u32]).collect()
    }

    /// Length of an edge, metres.
    pub fn length(&self, [a, b]: [u32; 2]) -> f64 {
        self.positions[a as usize].distance(self.positions[b as usize])
    }

    /// The triangles of an edge: one on the rim, else two.
    pub fn across(&self, [a, b]: [u32; 2]) -> Few {
        self.around[a as usize].iter().copied().filter(|&t| self.triangles[t as usize].contains(&b)).collect()
    }

    /// Vertices joined to `v`, ascending.
    pub fn neighbours(&self, v: u32) -> Few {
        let mut near: Few = self.around[v as usize]
            .iter()
            .flat_map(|&t| self.triangles[t as usize])
            .filter(|&w| w != v)
            .collect();
        near.sort_unstable();
        near.dedup();
        near
    }

    fn third(&self, t: u32, [a, b]: [u32; 2]) -> u32 {
        let [x, y, z] = self.triangles[t as usize];
        if x != a && x != b {
            x
        } else if y != a && y != b {
            y
        } else {
            z
        }
    }

    fn normal(&self, corners: [u32; 3]) -> DVec3 {
        let [a, b, c] = corners.map(|v| self.positions[v as usize]);
        (b - a).cross(c - a)
    }

    fn replace(&mut self, t: u32, from: u32, to: u32) {
        for v in &mut self.triangles[t as usize] {
            if *v == from {
                *v = to;
            }
        }
    }

    fn forget(&mut self, v: u32, t: u32) {
        self.around[v as usize].retain(|&x| x != t);
    }

    /// Splits an edge at its midpoint.
    pub fn split(&mut self, edge: [u32; 2]) {
        let [a, b] = edge;
        let sides = self.across(edge);
        let middle = self.positions.len() as u32;
        self.positions.push((self.positions[a as usize] + self.positions[b as usize]) / 2.0);
        self.rim.push(sides.len() == 1);
        self.around.push(Vec::new());
        for t in sides {
            let c = self.third(t, edge);
            let new = self.triangles.len() as u32;
            self.triangles.push(self.triangles[t as usize]);
            self.replace(t, b, middle);
            self.replace(new, a, middle);
            self.forget(b, t);
            self.around[b as usize].push(new);
            self.around[c as usize].push(new);
            self.around[middle as usize].extend([t, new]);
        }
    }

    /// Collapses an edge if the mesh stays a well-shaped manifold with no edge longer than `longest`; returns whether it did.
    pub fn collapse(&mut self, edge: [u32; 2], longest: f64) -> bool {
        let sides = self.across(edge);
        let [a, b] = edge;
        let both_rim = self.rim[a as usize] && self.rim[b as usize];
        // Keep the rim vertex; an edge across between two rim vertices must not be collapsed.
        let (keep, drop) = if self.rim[b as usize] { (b, a) } else { (a, b) };
        if both_rim != (sides.len() == 1) || !self.link_allows(keep, drop, &sides) {
            return false;
        }
        let place = if self.rim[keep as usize] && !both_rim {
            self.positions[keep as usize]
        } else {
            (self.positions[a as usize] + self.positions[b as usize]) / 2.0
        };
        if !self.shape_allows(keep, drop, &sides, place, longest) {
            return false;
        }
        self.positions[keep as usize] = place;
        for &t in &sides {
            let c = self.third(t, edge);
            self.forget(c, t);
            self.forget(keep, t);
            self.triangles[t as usize] = [0; 3];
        }
        let moved: Few = self.around[drop as usize].iter().copied().filter(|t| !sides.contains(t)).collect();
        for &t in &moved {
            self.replace(t, drop, keep);
        }
        self.around[keep as usize].extend(moved);
        self.around[drop as usize].clear();
        true
    }

    fn link_allows(&self, keep: u32, drop: u32, sides: &[u32]) -> bool {
        let (near_keep, near_drop) = (self.neighbours(keep), self.neighbours(drop));
        let common = near_drop.iter().filter(|v| near_keep.binary_search(v).is_ok()).count();
        if common != sides.len() {
            return false;
        }
        // No new edge across between two rim vertices.
        let chord = |v: &&u32| **v != keep && self.rim[**v as usize] && near_keep.binary_search(v).is_err();
        let drop_on_rim = self.rim[drop as usize];
        let chords = near_drop.iter().filter(chord).count();
        !self.rim[keep as usize] || chords <= usize::from(drop_on_rim)
    }

    fn shape_allows(&self, keep: u32, drop: u32, sides: &[u32], place: DVec3, longest: f64) -> bool {
        let moved = |v: u32| if v == keep || v == drop { place } else { self.positions[v as usize] };
        [keep, drop].iter().flat_map(|&v| &self.around[v as usize]).filter(|t| !sides.contains(t)).all(|&t| {
            let corners = self.triangles[t as usize];
            let [a, b, c] = corners.map(moved);
            let (old, new) = (self.normal(corners), (b - a).cross(c - a));
            let reach = (b - a).length().max((c - b).length()).max((a - c).length());
            reach < longest
                && new.dot(old) > 0.5 * new.length() * old.length()
                && new.length() > 0.05 * reach * reach
        })
    }

    /// Flips an edge, so that it joins the other two corners of its triangles, if that brings valences nearer to six
    /// (four on the rim) and inverts no triangle.
    pub fn turn_for_valence(&mut self, edge: [u32; 2]) {
        let sides = self.across(edge);
        let [t, u] = sides[..] else { return };
        let [a, b] = edge;
        let (c, d) = (self.third(t, edge), self.third(u, edge));
        if (self.rim[c as usize] && self.rim[d as usize]) || self.neighbours(c).binary_search(&d).is_ok() {
            return;
        }
        let excess = |v: u32, change: i32| {
            let ideal = if self.rim[v as usize] { 3 } else { 6 };
            (self.around[v as usize].len() as i32 + change - ideal).pow(2)
        };
        let before = excess(a, 0) + excess(b, 0) + excess(c, 0) + excess(d, 0);
        let after = excess(a, -1) + excess(b, -1) + excess(c, 1) + excess(d, 1);
        if after >= before {
            return;
        }
        // Triangle t holds the directed edge from `first` to `second`.
        let (first, second) = if self.runs(t, a, b) { (a, b) } else { (b, a) };
        let (new_t, new_u) = ([first, d, c], [d, second, c]);
        let old = self.normal(self.triangles[t as usize]).normalize_or_zero()
            + self.normal(self.triangles[u as usize]).normalize_or_zero();
        let fair = |corners: [u32; 3]| {
            let n = self.normal(corners);
            n.dot(old) > 1.2 * n.length() && self.smallest_sine(corners) > 0.2
        };
        if !fair(new_t) || !fair(new_u) {
            return;
        }
        self.triangles[t as usize] = new_t;
        self.triangles[u as usize] = new_u;
        self.forget(second, t);
        self.forget(first, u);
        self.around[c as usize].push(u);
        self.around[d as usize].push(t);
    }

    fn runs(&self, t: u32, a: u32, b: u32) -> bool {
        let c = self.triangles[t as usize];
        (0..3).any(|k| c[k] == a && c[(k + 1) % 3] == b)
    }

    fn smallest_sine(&self, corners: [u32; 3]) -> f64 {
        let p = corners.map(|v| self.positions[v as usize]);
        (0..3)
            .map(|k| {
                let (u, v) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
                u.cross(v).length() / (u.length() * v.length()).max(1e-12)
            })
            .fold(1.0, f64::min)
    }

    /// The mesh without removed vertices and triangles, in the same order.
    pub fn compacted(self) -> Self {
        let lives: Vec<bool> = self.around.iter().map(|triangles| !triangles.is_empty()).collect();
        let mut count = 0;
        let new: Vec<u32> = lives
            .iter()
            .map(|&lives| {
                count += u32::from(lives);
                count.wrapping_sub(1)
            })
            .collect();
        let positions = self.positions.iter().zip(&lives).filter(|(_, l)| **l).map(|(&p, _)| p).collect();
        let rim = self.rim.iter().zip(&lives).filter(|(_, l)| **l).map(|(&r, _)| r).collect();
        let triangles: Vec<[u32; 3]> =
            self.triangles.iter().filter(|t| t[0] != t[1]).map(|t| t.map(|v| new[v as usize])).collect();
        let mut fresh = Self::new(positions, triangles);
        fresh.rim = rim;
        fresh
    }
}
