//! Contact without penetration: between two detections every vertex stays on its side of planes that separate nearby
//! features, and within a distance (its reach) over which other features cannot be met.
//!
//! At a detection each vertex gets a reach, metres. Two features (a vertex and a triangle, or two edges) nearer than the
//! sum of their reaches get a plane between them, perpendicular to the line of their closest points; features farther
//! apart cannot meet. Features are convex hulls of their vertices: while these keep to their sides of the plane, the
//! features do not meet. Moved vertices are truncated to the intersection of their half-spaces and their ball. Both
//! contain the position at the detection, so that the intersection is never empty, and tangential motion stays free.
//! After Offset Geometric Contact (Chen et al., SIGGRAPH 2025), whose isotropic bound is replaced by planes here.
//!
//! Features that intersect at a detection get no plane: they may separate.

mod approach;
mod beside;
mod broad;
mod candidates;
mod crossing;
mod features;
mod repulsion;
#[cfg(test)]
mod tests;
mod topology;

use std::ops::Range;
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

use crate::contact::separation::approach::Approach;
use crate::contact::separation::beside::{Beside, Group};
use crate::contact::separation::candidates::Candidates;
use crate::contact::separation::crossing::Crossings;
use crate::contact::separation::features::Seen;
pub use crate::contact::separation::repulsion::Touch;
use crate::contact::separation::repulsion::{Pair, RestLengths};
pub use crate::contact::separation::topology::Obstacle;
use crate::contact::separation::topology::{PlacedTriangle, Topology};
use crate::geometry::adjacency::Adjacency;
use crate::geometry::bvh::Aabb;
use crate::geometry::parallel::{LEAST_SHARE, LEAST_SUMS};

/// Smallest fraction of the room between two features of cloth that each of them gets, however small its reach is. Without it what
/// moves fast would leave what is slow no room. Chosen by trial.
const LEAST_ROOM: f64 = 0.2;

/// A half-space: normal · x ≥ height.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: DVec3,
    height: f64,
}

/// Keeps cloth from intersecting itself and an obstacle.
#[derive(Clone, Debug)]
pub struct Separation {
    cloth: Topology,
    obstacle: Option<Arc<Obstacle>>,
    /// For each vertex the one to which it is, or will be, sewn; None: each is separate.
    names: Option<Vec<u32>>,
    /// Distance that the cloth keeps from itself, metres.
    thickness: f64,
    /// Rest lengths of the edges. Features that are joined by an edge keep less than the thickness.
    rest: RestLengths,
    candidates: Candidates,
    /// Each triangle of the cloth before the obstacle, in the order in which candidates are searched; empty without an obstacle.
    approaches: Vec<Approach>,
    beside: Beside,
    /// Positions of the vertices at the last detection (anchors), metres; empty before the first.
    anchors: Vec<DVec3>,
    /// Reach: for each vertex how far it may move from its anchor, metres.
    reach: Vec<f64>,
    /// The triangles at their anchors.
    placed: Vec<PlacedTriangle>,
    /// Squared distance (m²) from its anchor within which a vertex is not truncated by a plane or its reach.
    free: Vec<f64>,
    /// Planes of all vertices, in the order of the vertices.
    planes: Vec<Plane>,
    /// For each vertex the index of its first plane; then the number of planes.
    starts: Vec<u32>,
    /// Pairs of features of the cloth that may come nearer than the thickness.
    pairs: Vec<Pair>,
    /// Distance of each vertex from its anchor, metres.
    come: Vec<f64>,
    /// Number of intersections when they were last searched for.
    crossings: usize,
    /// Whether the last detection found nothing that intersects, is inside the obstacle, or touches: then
    /// intersections are not searched for again.
    is_clean: bool,
    /// Counters of the work done.
    pub counters: Counters,
}

/// Counters of the work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// Number of detections.
    pub detections: u64,
    /// Number of detections for which the tree of the cloth was searched; for the others its pairs were known.
    pub searches: u64,
    /// Groups of features of neighbouring triangles that were not known to be too far apart.
    pub neighbours: u64,
    /// Pairs of features tested.
    pub pairs: u64,
    /// Separating planes made, counted for each vertex.
    pub planes: u64,
    /// Vertices truncated, summed over steps.
    pub truncated_vertices: u64,
    /// Smallest distance between two features of the cloth at the last detection, nanometres; None: none were near.
    pub smallest_distance_nm: Option<u64>,
}

impl Counters {
    /// These counters plus those of `other`, which came after.
    pub fn and(self, other: Self) -> Self {
        Self {
            detections: self.detections + other.detections,
            searches: self.searches + other.searches,
            neighbours: self.neighbours + other.neighbours,
            pairs: self.pairs + other.pairs,
            planes: self.planes + other.planes,
            truncated_vertices: self.truncated_vertices + other.truncated_vertices,
            smallest_distance_nm: other.smallest_distance_nm.or(self.smallest_distance_nm),
        }
    }
}

/// Calls the last argument for those triangles of an obstacle that count as near a triangle of the cloth.
type Nearness = fn(&mut Approach, &PlacedTriangle, &Obstacle, &mut dyn FnMut(u32));

/// Result of a search: planes with their vertices, and pairs within the thickness.
#[derive(Default)]
struct Found {
    planes: Vec<(u32, Plane)>,
    pairs: Vec<Pair>,
    looked_at: u64,
    touching: u64,
    /// Number of groups of features of neighbouring triangles that were looked at.
    groups: u64,
    /// Smallest distance of two features of the cloth, metres.
    nearest: Option<f64>,
}

impl Separation {
    /// Separation for cloth with these triangles. `rest` are the rest lengths of its edges and `thickness` the
    /// distance it keeps from itself, metres. `names` gives for each vertex the one to which it is or will be sewn
    /// (None: itself). The cloth does not cross `obstacle`.
    pub fn new(
        triangles: &[[u32; 3]],
        adjacency: &Adjacency,
        (rest, thickness): (&[f64], f64),
        names: Option<Vec<u32>>,
        obstacle: Option<Arc<Obstacle>>,
    ) -> Self {
        let cloth = Topology::new(triangles, adjacency);
        let beside = Beside::new(&cloth, names.as_deref());
        Self {
            beside,
            obstacle,
            rest: RestLengths::new(&adjacency.edges, rest, names.as_deref()),
            thickness,
            pairs: Vec::new(),
            come: Vec::new(),
            cloth,
            names,
            candidates: Candidates::default(),
            approaches: Vec::new(),
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

    /// Replaces the obstacle; intersections are searched for again at the next detection.
    pub fn set_obstacle(&mut self, obstacle: Option<Arc<Obstacle>>) {
        self.obstacle = obstacle;
        self.anchors.clear();
        self.approaches.clear();
        self.is_clean = false;
    }

    /// Whether the last detection found nothing that intersects, is inside the obstacle, or touches.
    pub fn is_clean(&self) -> bool {
        self.is_clean
    }

    /// Number of edges that passed through triangles when that was last searched for.
    pub fn crossings(&self) -> usize {
        self.crossings
    }

    /// Detects nearby features with the vertices at `x`, each of which may then move by `reach` metres. `is_inside` tells
    /// which vertices are inside the obstacle; these may come out. It is called only while the state is not known to be clean.
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
        let (placed, beside) = (&self.placed, &self.beside);
        let is_searched = self.candidates.fit(&boxes, |t| placed[t].farthest, |s, t| beside.are(s, t));
        self.counters.searches += u64::from(is_searched);
        let mut approaches = std::mem::take(&mut self.approaches);
        if self.obstacle.is_some() {
            approaches.resize_with(self.placed.len(), Approach::unknown);
        }
        let crossings = match self.is_clean {
            true => Crossings::default(),
            false => Crossings::found(self, &mut approaches, is_inside),
        };
        self.beside.see(&self.placed);
        let found = self.gathered(&mut approaches, &crossings);
        self.approaches = approaches;
        let groups = found.iter().map(|found| found.groups).sum();
        self.beside.learn(groups, &self.placed, &self.anchors);
        self.crossings = crossings.count();
        self.is_clean = crossings.is_none() && found.iter().all(|found| found.touching == 0);
        self.counters.detections += 1;
        self.counters.neighbours += groups;
        self.counters.pairs += found.iter().map(|found| found.looked_at).sum::<u64>();
        let nearest = found.iter().filter_map(|found| found.nearest).reduce(f64::min);
        self.counters.smallest_distance_nm = nearest.map(|metres| (metres * 1e9) as u64);
        self.pairs.clear();
        self.pairs.extend(found.iter().flat_map(|found| &found.pairs));
        self.sort(&found);
    }

    /// Calls `look` for every two triangles of the cloth that may be near each other and are not neighbours, and `look_at_obstacle`
    /// for every triangle of the cloth and triangle of the obstacle that is `near`. The results come in an order that does not
    /// depend on threads.
    fn search<T: Default + Send>(
        &self,
        (approaches, near): (&mut [Approach], Nearness),
        look: impl Fn(u32, u32, &mut T) + Sync,
        look_at_obstacle: impl Fn(u32, u32, &mut T) + Sync,
    ) -> Vec<T> {
        let order = self.candidates.order();
        let look_at_leaf = |leaf: Range<usize>, approaches: &mut [Approach], found: &mut T| {
            let Some(obstacle) = self.obstacle.as_deref() else { return };
            let mut met = Vec::new();
            for (k, approach) in leaf.zip(approaches) {
                let own = &self.placed[order[k] as usize];
                if !approach.is_off(own) {
                    near(approach, own, obstacle, &mut |at| met.push((at, order[k])));
                }
            }
            met.sort_by_key(|(at, _)| *at);
            met.iter().for_each(|&(at, s)| look_at_obstacle(s, obstacle.broad.order()[at as usize], found));
        };
        self.candidates.search(approaches, look, look_at_leaf)
    }

    fn gathered(&self, approaches: &mut [Approach], crossings: &Crossings) -> Vec<Found> {
        let mut found = self.search(
            (approaches, Approach::look),
            |s, t, found: &mut Found| {
                let [own, other] = [s, t].map(|t| &self.placed[t as usize]);
                let far = own.farthest + other.farthest + self.thickness;
                if own.is_off(other, far) || other.is_off(own, far) {
                    return;
                }
                self.cloth.corners_of(s).for_each(|k| self.vertex_at([s, t], k, crossings, found));
                self.cloth.corners_of(t).for_each(|k| self.vertex_at([t, s], k, crossings, found));
                for k in self.cloth.sides_of(s) {
                    self.cloth.sides_of(t).for_each(|m| self.edges_at([s, t], [k, m], crossings, found));
                }
            },
            |s, t, found| self.at_obstacle(s, t, crossings, found),
        );
        let corners = self.beside.corners.par_chunks(LEAST_SUMS).map(|groups| {
            self.beside_of(groups, |group, found| {
                group.corners().for_each(|k| self.vertex_at(group.triangles, k, crossings, found));
            })
        });
        found.par_extend(corners);
        let sides = self.beside.sides.par_chunks(LEAST_SUMS).map(|groups| {
            self.beside_of(groups, |group, found| {
                group.sides().for_each(|sides| self.edges_at(group.triangles, sides, crossings, found));
            })
        });
        found.par_extend(sides);
        found
    }

    /// What `look` finds in those of the `groups` that are not known to be too far apart.
    fn beside_of(&self, groups: &[Group], look: impl Fn(&Group, &mut Found)) -> Found {
        let mut found = Found::default();
        for group in groups.iter().filter(|group| !self.beside.are_off(group, self.thickness)) {
            found.groups += 1;
            look(group, &mut found);
        }
        found
    }

    /// Corner `k` of triangle `s` against triangle `t`, which does not have it.
    fn vertex_at(&self, [s, t]: [u32; 2], k: usize, crossings: &Crossings, found: &mut Found) {
        let [own, other] = [s, t].map(|t| &self.placed[t as usize]);
        let (v, p, reach) = (own.vertices[k], own.corners[k], own.reach[k]);
        if holds(&other.around, p, reach + other.farthest + self.thickness) && !crossings.vertex_is_free(v, t)
        {
            found.looked_at += 1;
            let seen = features::vertex_and_triangle(p, other.corners);
            self.part(seen, [&[v], &other.vertices], [reach, other.farthest], found);
        }
    }

    /// Side `k` of triangle `s` against side `m` of triangle `t`, which share no vertex.
    fn edges_at(&self, [s, t]: [u32; 2], [k, m]: [usize; 2], crossings: &Crossings, found: &mut Found) {
        let [own, other] = [s, t].map(|t| &self.placed[t as usize]);
        let (one, two, reach) = (own.side(k), other.side(m), [own.side_reach(k), other.side_reach(m)]);
        if !near(&Aabb::around(&one), &Aabb::around(&two), reach[0] + reach[1] + self.thickness) {
            return;
        }
        let [e, f] = [(s, k), (t, m)].map(|(t, k)| self.cloth.triangle_edges[t as usize][k]);
        if !crossings.edges_are_free(e, f) {
            found.looked_at += 1;
            self.part(features::edges(one, two), [&own.ends(k), &other.ends(m)], reach, found);
        }
    }

    /// Features of the cloth's triangle `s` against those of the obstacle's triangle `t`.
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

    /// Makes a plane between two features of the cloth that may reach each other.
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

    /// Makes a plane between a feature of the cloth and one of the obstacle, which does not move.
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

    /// Stores `plane` for those of the vertices that may reach it.
    fn keep(&self, vertices: &[u32], plane: Plane, found: &mut Found) {
        for &v in vertices {
            if plane.normal.dot(self.anchors[v as usize]) - plane.height < self.reach[v as usize] {
                found.planes.push((v, plane));
            }
        }
    }

    /// Whether two features share a vertex, or will when they are sewn.
    fn joined(&self, one: &[u32], other: &[u32]) -> bool {
        match &self.names {
            None => one.iter().any(|v| other.contains(v)),
            Some(names) => one.iter().any(|&v| other.iter().any(|&w| names[v as usize] == names[w as usize])),
        }
    }

    /// Sorts planes by their vertices.
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

    /// Whether all vertices stay within their reach when they move to `then`.
    pub fn holds(&self, then: impl Fn(usize) -> DVec3 + Sync) -> bool {
        let stays = |v: usize| then(v).distance_squared(self.anchors[v]) <= self.reach[v] * self.reach[v];
        !self.anchors.is_empty()
            && (0..self.anchors.len()).into_par_iter().with_min_len(LEAST_SHARE).all(stays)
    }

    /// Truncates positions `x`, so that features cannot meet. Returns how many vertices wanted to move beyond their reach.
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

    /// Truncated position of vertex `v`, which was to move to `x`; and whether its reach stopped it.
    fn truncated(&self, v: usize, mut x: DVec3) -> (DVec3, bool) {
        let anchor = self.anchors[v];
        let way = x.distance(anchor);
        let is_stopped = way > self.reach[v];
        if is_stopped {
            x = anchor + (x - anchor) * (self.reach[v] / way);
        }
        let planes = &self.planes[self.starts[v] as usize..self.starts[v + 1] as usize];
        let mut is_in = true;
        // Where three sweeps of projections do not end, the vertex is pulled straight back towards its anchor.
        for _ in 0..3 {
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

/// The distance that two features `gap` metres apart keep at least until the next detection, metres: a tenth, and if they were not
/// nearer so much that they stay apart when written with six decimals or in single precision.
fn kept(gap: f64) -> f64 {
    (0.1 * gap).max(gap.min(1e-5))
}

/// The same two features in the other order.
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
