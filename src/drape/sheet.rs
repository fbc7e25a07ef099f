//! A sheet of cloth: triangle mesh with a flat rest shape, the part of the cloth that does not change while it moves.

use glam::{DMat2, DVec2};

use crate::geometry::adjacency::{Adjacency, NONE};
use crate::geometry::words::{Words, words};

/// Connectivity and rest shape. Rest coordinates are stored per triangle corner, so that several pattern pieces can share sewn
/// vertices.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Corner vertices, counter-clockwise on the cloth's front.
    pub triangles: Vec<[u32; 3]>,
    /// Rest position of each triangle's corners in the pattern plane (x along the weft, y along the warp), metres;
    /// counter-clockwise.
    pub rest: Vec<[DVec2; 3]>,
    /// Area of each rest triangle, m².
    pub areas: Vec<f64>,
    /// A third of the area of the triangles round each vertex, m².
    pub vertex_area: Vec<f64>,
    /// Adjacency of vertices, edges and triangles.
    pub adjacency: Adjacency,
    /// Edges at which the cloth is creased, ascending: it does not bend across them.
    creases: Vec<u32>,
}

/// Why triangles do not form a sheet.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub enum SheetError {
    /// There is no triangle, or the number of rest triangles differs.
    Empty,
    /// A corner refers to a vertex that does not exist, or its rest position is not finite.
    Corner(usize),
    /// The rest triangle has no area.
    Area(usize),
    /// A vertex belongs to no triangle.
    Lonely(usize),
}

impl SheetError {
    /// The error in words; triangles and vertices are counted from 0.
    pub fn words(&self) -> Words {
        match *self {
            Self::Empty => words!("there is no triangle"),
            Self::Corner(n) => words!("triangle {n} (from 0) has a corner that is missing or not finite", n),
            Self::Area(n) => words!("triangle {n} (from 0) has no area in its rest shape", n),
            Self::Lonely(n) => words!("vertex {n} (from 0) belongs to no triangle", n),
        }
    }
}

impl Sheet {
    /// A sheet over vertices `0..vertices`. Rest triangles given clockwise are mirrored in x.
    pub fn new(
        vertices: usize,
        triangles: Vec<[u32; 3]>,
        mut rest: Vec<[DVec2; 3]>,
    ) -> Result<Self, SheetError> {
        if triangles.is_empty() || rest.len() != triangles.len() {
            return Err(SheetError::Empty);
        }
        for (t, (vs, corners)) in triangles.iter().zip(&mut rest).enumerate() {
            let known = vs.iter().all(|&v| (v as usize) < vertices) && corners.iter().all(|c| c.is_finite());
            if !known {
                return Err(SheetError::Corner(t));
            }
            if signed_area(corners) < 0.0 {
                corners.iter_mut().for_each(|c| c.x = -c.x);
            }
        }
        let areas: Vec<f64> = rest.iter().map(signed_area).collect();
        let mean = areas.iter().sum::<f64>() / areas.len() as f64;
        // Far above rounding, far below what any mesh of cloth has.
        if let Some(t) = areas.iter().position(|&a| a.is_nan() || a <= 1e-8 * mean) {
            return Err(SheetError::Area(t));
        }
        let mut vertex_area = vec![0.0; vertices];
        for (vs, area) in triangles.iter().zip(&areas) {
            vs.iter().for_each(|&v| vertex_area[v as usize] += area / 3.0);
        }
        if let Some(v) = vertex_area.iter().position(|&a| a == 0.0) {
            return Err(SheetError::Lonely(v));
        }
        let adjacency = Adjacency::new(vertices, &triangles);
        Ok(Self { triangles, rest, areas, vertex_area, adjacency, creases: Vec::new() })
    }

    /// The sheet with creases at these edges, each given by its ends; what is no edge of the sheet is left out.
    pub fn creased(mut self, edges: impl IntoIterator<Item = [u32; 2]>) -> Self {
        self.creases = edges.into_iter().filter_map(|ends| self.edge_between(ends)).collect();
        self.creases.sort_unstable();
        self.creases.dedup();
        self
    }

    /// The edge between two vertices.
    pub fn edge_between(&self, [a, b]: [u32; 2]) -> Option<u32> {
        let beside = self.adjacency.vertex_triangles.of(a);
        let edges = beside.iter().flat_map(|&t| self.adjacency.triangle_edges[t as usize]);
        let is_it = |e: &u32| {
            let [p, q] = self.adjacency.edges[*e as usize];
            (p, q) == (a, b) || (q, p) == (a, b)
        };
        edges.into_iter().find(is_it)
    }

    /// The sheet cut along its creases, and for each of its vertices the one that it is a part of. None without creases.
    pub fn parted(&self) -> Option<(Self, Vec<u32>)> {
        if self.creases.is_empty() {
            return None;
        }
        let mut triangles = self.triangles.clone();
        let mut whole: Vec<u32> = (0..self.len() as u32).collect();
        let mut ends: Vec<u32> =
            self.creases.iter().flat_map(|&e| self.adjacency.edges[e as usize]).collect();
        ends.sort_unstable();
        ends.dedup();
        for v in ends {
            let mut left: Vec<u32> = self.adjacency.vertex_triangles.of(v).to_vec();
            let mut name = v;
            while let Some(&first) = left.first() {
                for t in self.fan(v, first) {
                    left.retain(|other| *other != t);
                    triangles[t as usize].iter_mut().filter(|c| **c == v).for_each(|c| *c = name);
                }
                if !left.is_empty() {
                    name = whole.len() as u32;
                    whole.push(v);
                }
            }
        }
        let parted = Self::new(whole.len(), triangles, self.rest.clone()).ok()?;
        Some((parted, whole))
    }

    /// The triangles round vertex `v` that are reached from `first` without crossing a crease.
    fn fan(&self, v: u32, first: u32) -> Vec<u32> {
        let mut fan = vec![first];
        let mut at = 0;
        while at < fan.len() {
            let t = fan[at] as usize;
            for k in 0..3 {
                let (e, other) = (self.adjacency.triangle_edges[t][k], self.adjacency.across[t][k]);
                let is_near = self.adjacency.edges[e as usize].contains(&v) && other != NONE;
                if is_near && !fan.contains(&other) && self.creases.binary_search(&e).is_err() {
                    fan.push(other);
                }
            }
            at += 1;
        }
        fan
    }

    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.vertex_area.len()
    }

    /// Always false: a sheet has triangles.
    pub fn is_empty(&self) -> bool {
        self.vertex_area.is_empty()
    }

    /// Rest length of edge `e` of the adjacency, metres: the mean over the triangles beside it.
    pub fn rest_length(&self, e: usize) -> f64 {
        let beside = self.adjacency.edge_triangles.of(e as u32);
        let length = |&t: &u32| {
            let k = self.side_of(t, e as u32);
            let corners = &self.rest[t as usize];
            corners[k].distance(corners[(k + 1) % 3])
        };
        beside.iter().map(length).sum::<f64>() / beside.len() as f64
    }

    /// Mean rest length of all edges, metres.
    pub fn mean_edge(&self) -> f64 {
        let count = self.adjacency.edges.len();
        (0..count).map(|e| self.rest_length(e)).sum::<f64>() / count as f64
    }

    /// Index 0..3 of edge `e` among the sides of triangle `t`.
    fn side_of(&self, t: u32, e: u32) -> usize {
        self.adjacency.triangle_edges[t as usize].iter().position(|&x| x == e).unwrap_or(0)
    }

    /// The triangle across side `k` of `t` and the positions of its corners when it is unfolded into the plane of `t`, whose
    /// corners are at `own`. None on the border.
    pub fn unfolded(&self, t: u32, own: &[DVec2; 3], k: usize) -> Option<(u32, [DVec2; 3])> {
        let other = self.adjacency.across[t as usize][k];
        if other == NONE {
            return None;
        }
        let j = self.side_of(other, self.adjacency.triangle_edges[t as usize][k]);
        let corners = &self.rest[other as usize];
        // The neighbour traverses the shared side in the same direction where the two triangles are oriented differently.
        let same_way = self.triangles[other as usize][j] == self.triangles[t as usize][k];
        let (a, b) = (own[k], own[(k + 1) % 3]);
        let (mut p, mut q) = (corners[j], corners[(j + 1) % 3]);
        let mut laid = *corners;
        if same_way {
            let mirrored = |c: DVec2| DVec2::new(-c.x, c.y);
            laid = laid.map(mirrored);
            (p, q) = (mirrored(p), mirrored(q));
        } else {
            std::mem::swap(&mut p, &mut q);
        }
        let (from, to) = ((q - p).normalize_or_zero(), (b - a).normalize_or_zero());
        let turn = DMat2::from_cols(
            DVec2::new(from.dot(to), from.perp_dot(to)),
            DVec2::new(-from.perp_dot(to), from.dot(to)),
        );
        let (middle, place) = ((p + q) / 2.0, (a + b) / 2.0);
        Some((other, laid.map(|c| place + turn * (c - middle))))
    }
}

fn signed_area(corners: &[DVec2; 3]) -> f64 {
    (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]) / 2.0
}
