//! Contact that cannot cross: between two detections every vertex stays on its side of planes that separate what is near, and
//! within a distance that what is not near cannot bridge.
//!
//! At a detection each vertex gets a reach, metres. Two features (a vertex and a triangle, or two edges) that are nearer than the sum
//! of their reaches get a plane between them, across the line of their closest points; two that are farther apart cannot meet.
//! Features are convex hulls of their vertices: while these keep to their sides of the plane, the features do not meet. What moved
//! is truncated to the intersection of its half-spaces and its ball. Both contain the place of the detection, so that there is
//! always a way, and tangential motion stays free. After Offset Geometric Contact (Chen et al., SIGGRAPH 2025), whose isotropic
//! bound becomes planes here.
//!
//! What crosses at a detection has no plane: it may come apart.

mod crossing;
mod features;
mod repulsion;
mod topology;

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

use crate::contact::separation::crossing::Crossings;
use crate::contact::separation::features::Seen;
use crate::contact::separation::repulsion::Pair;
pub use crate::contact::separation::repulsion::Touch;
pub use crate::contact::separation::topology::Obstacle;
use crate::contact::separation::topology::{PlacedTriangle, Topology};
use crate::geometry::adjacency::Adjacency;
use crate::geometry::bvh::{Aabb, Bvh};

/// Until the next detection two features come no nearer than this share of their distance,
const KEPT: f64 = 0.1;
/// and never nearer than this, metres: what is written with six digits behind the point, or in single precision, stays apart.
const FLOOR: f64 = 1e-5;
/// Between two cloths each gets at least this share of the distance, however little it is to move.
const LEAST_ROOM: f64 = 0.2;
/// Sweeps of projections onto half-spaces before a vertex goes straight back.
const SWEEPS: usize = 3;
/// Vertices or nodes of a tree one thread takes at a time.
const LEAST_SHARE: usize = 256;

/// A half-space: normal · x ≥ height.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: DVec3,
    height: f64,
}

/// What keeps cloth apart from itself and from an obstacle.
#[derive(Clone, Debug)]
pub struct Separation {
    cloth: Topology,
    obstacle: Option<Arc<Obstacle>>,
    /// For each vertex the one it is, or will be, sewn to; None: itself.
    names: Option<Vec<u32>>,
    /// The distance it keeps from itself, metres,
    thickness: f64,
    /// and the rest length of each edge between two such vertices, the smaller first, sorted: beside each other it keeps less.
    rest: Vec<([u32; 2], f64)>,
    tree: Bvh,
    /// Where the vertices were at the last detection; empty before the first,
    anchors: Vec<DVec3>,
    /// and how far each may go from there, metres.
    reach: Vec<f64>,
    /// Its triangles there.
    placed: Vec<PlacedTriangle>,
    /// Squared distance (m²) from its anchor within which a vertex meets no plane and keeps its reach.
    free: Vec<f64>,
    /// The planes of all vertices,
    planes: Vec<Plane>,
    /// and where those of each begin; one more than vertices.
    starts: Vec<u32>,
    /// Features of the cloth that may come nearer than the thickness,
    pairs: Vec<Pair>,
    /// and how far each vertex has come from its anchor, metres.
    come: Vec<f64>,
    /// What crossed when it was looked for, and whether it must be looked for again.
    crossings: usize,
    is_clean: bool,
    /// Work done.
    pub counters: Counters,
}

/// Work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// Detections of what is near.
    pub detections: u64,
    /// Pairs of features looked at.
    pub pairs: u64,
    /// Planes between them.
    pub planes: u64,
    /// Times a vertex was truncated.
    pub truncated_vertices: u64,
    /// The smallest distance of two features of the cloth when last looked at, nanometres; None: none were near.
    pub smallest_distance_nm: Option<u64>,
}

impl Counters {
    /// With what `other` did after it.
    pub fn and(self, other: Self) -> Self {
        Self {
            detections: self.detections + other.detections,
            pairs: self.pairs + other.pairs,
            planes: self.planes + other.planes,
            truncated_vertices: self.truncated_vertices + other.truncated_vertices,
            smallest_distance_nm: other.smallest_distance_nm.or(self.smallest_distance_nm),
        }
    }
}

/// What a search found: vertices with a plane each.
#[derive(Default)]
struct Found {
    planes: Vec<(u32, Plane)>,
    pairs: Vec<Pair>,
    looked_at: u64,
    touching: u64,
    /// Of two features of the cloth, metres.
    nearest: Option<f64>,
}

impl Separation {
    /// Of cloth with these triangles, rest lengths of its edges (metres) and, for each vertex, the one it is or will be sewn to (None:
    /// itself). It keeps `thickness` metres from itself, and what it is beside, `obstacle`, is not crossed.
    pub fn new(
        vertices: usize,
        triangles: &[[u32; 3]],
        adjacency: &Adjacency,
        (rest, thickness): (&[f64], f64),
        names: Option<Vec<u32>>,
        obstacle: Option<Arc<Obstacle>>,
    ) -> Self {
        Self {
            cloth: Topology::new(vertices, triangles, adjacency),
            obstacle,
            rest: repulsion::rest_lengths(&adjacency.edges, rest, names.as_deref()),
            thickness,
            names,
            pairs: Vec::new(),
            come: Vec::new(),
            tree: Bvh::default(),
            anchors: Vec::new(),
            reach: Vec::new(),
            placed: Vec::new(),
            free: Vec::new(),
            planes: Vec::new(),
            starts: Vec::new(),
            crossings: 0,
            is_clean: false,
            counters: Counters::default(),
        }
    }

    /// From now on this is what it is beside; what crosses is looked for again.
    pub fn set_obstacle(&mut self, obstacle: Option<Arc<Obstacle>>) {
        self.obstacle = obstacle;
        self.anchors.clear();
        self.is_clean = false;
    }

    /// Whether nothing was known at the last detection that crosses, is inside or touches.
    pub fn is_clean(&self) -> bool {
        self.is_clean
    }

    /// Edges that passed through triangles when that was last looked for.
    pub fn crossings(&self) -> usize {
        self.crossings
    }

    /// Finds what is near of vertices at `x`, each of which may then go `reach` metres; `is_inside` tells which are inside of the
    /// obstacle (asked only while it is not known that none is): they may come out.
    pub fn detect(
        &mut self,
        x: &[DVec3],
        reach: impl Fn(usize) -> f64,
        is_inside: impl Fn(usize) -> bool + Sync,
    ) {
        self.reach.clear();
        self.reach.extend((0..x.len()).map(reach));
        self.anchors.clear();
        self.anchors.extend_from_slice(x);
        let triangles = (0..self.cloth.triangles.len() as u32).into_par_iter().with_min_len(LEAST_SHARE);
        triangles
            .map(|t| PlacedTriangle::new(&self.cloth, &self.anchors, &self.reach, t))
            .collect_into_vec(&mut self.placed);
        let box_of = |placed: &PlacedTriangle| grown(&placed.around, placed.farthest + self.thickness / 2.0);
        let boxes: Vec<Aabb> = self.placed.par_iter().with_min_len(LEAST_SHARE).map(box_of).collect();
        match self.tree.items.len() == boxes.len() {
            true => self.tree.refit(&boxes),
            false => self.tree = Bvh::new(&boxes),
        }
        let crossings =
            if self.is_clean { Crossings::default() } else { Crossings::found(self, &boxes, is_inside) };
        let found = self.gathered(&boxes, &crossings);
        self.crossings = crossings.count();
        self.is_clean = crossings.is_none() && found.iter().all(|found| found.touching == 0);
        self.counters.detections += 1;
        self.counters.pairs += found.iter().map(|found| found.looked_at).sum::<u64>();
        let nearest = found.iter().filter_map(|found| found.nearest).reduce(f64::min);
        self.counters.smallest_distance_nm = nearest.map(|metres| (metres * 1e9) as u64);
        self.pairs.clear();
        self.pairs.extend(found.iter().flat_map(|found| &found.pairs));
        self.sort(&found);
    }

    /// Calls `look` for every two triangles of the cloth whose `boxes` meet, and `look_at_obstacle` for every one of the cloth and one of
    /// the obstacle. What they add to is given in an order that does not depend on threads.
    fn search<T: Default + Send>(
        &self,
        boxes: &[Aabb],
        look: impl Fn(u32, u32, &mut T) + Sync,
        look_at_obstacle: impl Fn(u32, u32, &mut T) + Sync,
    ) -> Vec<T> {
        let tree = &self.tree;
        let nodes = (0..tree.nodes.len() as u32).into_par_iter().with_min_len(LEAST_SHARE);
        let found = nodes.map(|node| {
            let mut found = T::default();
            tree.leaves_between(node, |one, other| {
                let [ones, others] = [one, other].map(|leaf| tree.items_of(leaf));
                for (k, &s) in ones.iter().enumerate() {
                    let others = if one == other { &others[k + 1..] } else { others };
                    others
                        .iter()
                        .filter(|&&t| boxes[t as usize].meets(&boxes[s as usize]))
                        .for_each(|&t| look(s, t, &mut found));
                }
            });
            if let (Some(obstacle), true) = (&self.obstacle, tree.nodes[node as usize].is_leaf()) {
                let ones = tree.items_of(node);
                obstacle.tree.leaves_near(&tree.nodes[node as usize].bounds, |leaf| {
                    for &t in obstacle.tree.items_of(leaf) {
                        let around = &obstacle.placed[t as usize].around;
                        ones.iter()
                            .filter(|&&s| boxes[s as usize].meets(around))
                            .for_each(|&s| look_at_obstacle(s, t, &mut found));
                    }
                });
            }
            found
        });
        found.collect()
    }

    fn gathered(&self, boxes: &[Aabb], crossings: &Crossings) -> Vec<Found> {
        self.search(
            boxes,
            |s, t, found| {
                self.vertices_at(s, t, crossings, found);
                self.vertices_at(t, s, crossings, found);
                self.edges_at(s, t, crossings, found);
            },
            |s, t, found| self.at_obstacle(s, t, crossings, found),
        )
    }

    /// Vertices that `s` owns, at `t`.
    fn vertices_at(&self, s: u32, t: u32, crossings: &Crossings, found: &mut Found) {
        let (own, other) = (&self.placed[s as usize], &self.placed[t as usize]);
        for k in self.cloth.corners_of(s) {
            let (v, p, reach) = (own.vertices[k], own.corners[k], own.reach[k]);
            if !holds(&other.around, p, reach + other.farthest + self.thickness)
                || self.joined(&[v], &other.vertices)
                || crossings.vertex_is_free(v, t)
            {
                continue;
            }
            found.looked_at += 1;
            let seen = features::vertex_and_triangle(p, other.corners);
            self.part(seen, [&[v], &other.vertices], [reach, other.farthest], found);
        }
    }

    /// Edges that the triangles own, at each other.
    fn edges_at(&self, s: u32, t: u32, crossings: &Crossings, found: &mut Found) {
        let (own, other) = (&self.placed[s as usize], &self.placed[t as usize]);
        for k in self.cloth.sides_of(s) {
            let (e, ends, one, reach) =
                (self.cloth.triangle_edges[s as usize][k], own.ends(k), own.side(k), own.side_reach(k));
            let around = grown(&Aabb::around(&one), reach + self.thickness);
            if !near(&around, &other.around, other.farthest) {
                continue;
            }
            for m in self.cloth.sides_of(t) {
                let (f, others, other_reach) =
                    (self.cloth.triangle_edges[t as usize][m], other.ends(m), other.side_reach(m));
                let two = other.side(m);
                if !near(&around, &Aabb::around(&two), other_reach)
                    || self.joined(&ends, &others)
                    || crossings.edges_are_free(e, f)
                {
                    continue;
                }
                found.looked_at += 1;
                self.part(features::edges(one, two), [&ends, &others], [reach, other_reach], found);
            }
        }
    }

    /// Features of the cloth's triangle `s` and the obstacle's `t`.
    fn at_obstacle(&self, s: u32, t: u32, crossings: &Crossings, found: &mut Found) {
        let Some(obstacle) = self.obstacle.as_deref() else { return };
        let (own, other, topology) =
            (&self.placed[s as usize], &obstacle.placed[t as usize], &obstacle.topology);
        for k in self.cloth.corners_of(s) {
            let (v, p, reach) = (own.vertices[k], own.corners[k], own.reach[k]);
            if holds(&other.around, p, reach) && !crossings.vertex_is_free_of_obstacle(v, t) {
                found.looked_at += 1;
                self.hold(features::vertex_and_triangle(p, other.corners), &[v], reach, found);
            }
        }
        for k in topology.corners_of(t) {
            let (v, p) = (other.vertices[k], other.corners[k]);
            if holds(&own.around, p, own.farthest) && !crossings.triangle_is_free_of_obstacle(s, v) {
                found.looked_at += 1;
                let seen = features::vertex_and_triangle(p, own.corners).map(turned);
                self.hold(seen, &own.vertices, own.farthest, found);
            }
        }
        for k in self.cloth.sides_of(s) {
            let (e, one, reach) = (self.cloth.triangle_edges[s as usize][k], own.side(k), own.side_reach(k));
            let around = grown(&Aabb::around(&one), reach);
            if !around.meets(&other.around) {
                continue;
            }
            for m in topology.sides_of(t) {
                let (f, two) = (topology.triangle_edges[t as usize][m], other.side(m));
                if around.meets(&Aabb::around(&two)) && !crossings.edge_is_free_of_obstacle(e, f) {
                    found.looked_at += 1;
                    self.hold(features::edges(one, two), &own.ends(k), reach, found);
                }
            }
        }
    }

    /// A plane between two features of the cloth that may reach each other.
    fn part(&self, seen: Option<Seen>, vertices: [&[u32]; 2], reach: [f64; 2], found: &mut Found) {
        let Some(seen) = seen else {
            found.touching += 1;
            return;
        };
        found.nearest = Some(found.nearest.map_or(seen.gap, |nearest| nearest.min(seen.gap)));
        let whole = reach[0] + reach[1];
        self.remember(&seen, vertices, whole, found);
        if seen.gap > whole {
            return;
        }
        let room = seen.gap - kept(seen.gap);
        let share = (reach[1] / whole).clamp(LEAST_ROOM, 1.0 - LEAST_ROOM);
        let second = seen.below + room * share;
        let first = seen.below + seen.gap - room * (1.0 - share);
        self.keep(vertices[0], Plane { normal: seen.normal, height: first }, found);
        self.keep(vertices[1], Plane { normal: -seen.normal, height: -second }, found);
    }

    /// A plane between a feature of the cloth and one that does not move.
    fn hold(&self, seen: Option<Seen>, vertices: &[u32], reach: f64, found: &mut Found) {
        match seen {
            None => found.touching += 1,
            Some(seen) if seen.gap > reach => {}
            Some(seen) => {
                self.keep(
                    vertices,
                    Plane { normal: seen.normal, height: seen.below + kept(seen.gap) },
                    found,
                );
            }
        }
    }

    /// Keeps `plane` for those that may reach it.
    fn keep(&self, vertices: &[u32], plane: Plane, found: &mut Found) {
        for &v in vertices {
            if plane.normal.dot(self.anchors[v as usize]) - plane.height < self.reach[v as usize] {
                found.planes.push((v, plane));
            }
        }
    }

    /// Whether two features share a vertex, or will.
    fn joined(&self, one: &[u32], other: &[u32]) -> bool {
        match &self.names {
            None => one.iter().any(|v| other.contains(v)),
            Some(names) => one.iter().any(|&v| other.iter().any(|&w| names[v as usize] == names[w as usize])),
        }
    }

    /// Puts planes in the order of their vertices.
    fn sort(&mut self, found: &[Found]) {
        let count = self.anchors.len();
        let all = || found.iter().flat_map(|found| &found.planes);
        self.starts.clear();
        self.starts.resize(count + 1, 0);
        all().for_each(|(v, _)| self.starts[*v as usize + 1] += 1);
        (0..count).for_each(|v| self.starts[v + 1] += self.starts[v]);
        let mut next = self.starts.clone();
        self.planes.clear();
        self.planes.resize(self.starts[count] as usize, Plane { normal: DVec3::ZERO, height: 0.0 });
        self.free.clear();
        self.free.extend_from_slice(&self.reach);
        for (v, plane) in all() {
            let v = *v as usize;
            self.planes[next[v] as usize] = *plane;
            next[v] += 1;
            self.free[v] = self.free[v].min(plane.normal.dot(self.anchors[v]) - plane.height);
        }
        self.free.iter_mut().for_each(|free| *free = free.max(0.0).powi(2));
        self.counters.planes += self.planes.len() as u64;
    }

    /// Whether all vertices that go where `then` tells stay within their reach.
    pub fn holds(&self, then: impl Fn(usize) -> DVec3 + Sync) -> bool {
        let stays = |v: usize| then(v).distance_squared(self.anchors[v]) <= self.reach[v] * self.reach[v];
        !self.anchors.is_empty()
            && (0..self.anchors.len()).into_par_iter().with_min_len(LEAST_SHARE).all(stays)
    }

    /// Brings `x` back to where nothing can meet. How many vertices would have gone farther than their reach.
    pub fn truncate(&mut self, x: &mut [DVec3]) -> usize {
        if self.anchors.len() != x.len() {
            return 0;
        }
        let this = &*self;
        let count = |(first, part): (usize, &mut [DVec3])| {
            let (mut stopped, mut truncated) = (0, 0u64);
            for (k, x) in part.iter_mut().enumerate() {
                let v = first * LEAST_SHARE + k;
                if x.distance_squared(this.anchors[v]) > this.free[v] {
                    let (place, is_stopped) = this.truncated(v, *x);
                    truncated += u64::from(place != *x);
                    stopped += usize::from(is_stopped);
                    *x = place;
                }
            }
            (stopped, truncated)
        };
        let counts: Vec<(usize, u64)> = x.par_chunks_mut(LEAST_SHARE).enumerate().map(count).collect();
        self.counters.truncated_vertices += counts.iter().map(|(_, truncated)| truncated).sum::<u64>();
        counts.iter().map(|(stopped, _)| stopped).sum()
    }

    /// Where vertex `v` goes that was to go to `x`, and whether its reach stopped it.
    fn truncated(&self, v: usize, mut x: DVec3) -> (DVec3, bool) {
        let anchor = self.anchors[v];
        let way = x.distance(anchor);
        let is_stopped = way > self.reach[v];
        if is_stopped {
            x = anchor + (x - anchor) * (self.reach[v] / way);
        }
        let planes = &self.planes[self.starts[v] as usize..self.starts[v + 1] as usize];
        let mut is_in = true;
        for _ in 0..SWEEPS {
            is_in = true;
            for plane in planes {
                let depth = plane.height - plane.normal.dot(x);
                if depth > 0.0 {
                    x += plane.normal * depth;
                    is_in = false;
                }
            }
            if is_in {
                break;
            }
        }
        if !is_in {
            let share = planes.iter().map(|plane| {
                let (from, to) = (plane.normal.dot(anchor), plane.normal.dot(x));
                if to >= plane.height { 1.0 } else { ((from - plane.height) / (from - to)).max(0.0) }
            });
            let share = share.fold(1.0, f64::min);
            x = anchor + (x - anchor) * (share * (1.0 - 1e-9));
        }
        let way = x.distance(anchor);
        if way > self.reach[v] {
            x = anchor + (x - anchor) * (self.reach[v] / way);
        }
        (x, is_stopped)
    }
}

/// How much of a distance is left at least, metres.
fn kept(gap: f64) -> f64 {
    (KEPT * gap).max(gap.min(FLOOR))
}

/// Seen from the other side.
fn turned(seen: Seen) -> Seen {
    let Seen { normal, below, gap } = seen;
    Seen { normal: -normal, below: -(below + gap), gap }
}

fn holds(around: &Aabb, p: DVec3, reach: f64) -> bool {
    (p + reach).cmpge(around.lower).all() && (p - reach).cmple(around.upper).all()
}

fn near(one: &Aabb, other: &Aabb, reach: f64) -> bool {
    grown(one, reach).meets(other)
}

fn grown(around: &Aabb, reach: f64) -> Aabb {
    Aabb { lower: around.lower - reach, upper: around.upper + reach }
}
