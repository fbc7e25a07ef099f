//! For each cloth vertex the nearest part of the body (paper A's track point), updated only when it may have changed.
//!
//! The paper walks from the last triangle to nearer neighbours, which misses parts that were never covered and parts
//! that come from elsewhere. Here every result is that of an exact query. A search round the last triangle replaces
//! it only where a certificate proves that nothing else can be nearer (ALGORITHMS.md 1.A7), and the paper's walk only
//! between two exact queries.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::body::{Nearest, Surface};
use crate::cloth::{ClothState, Counters, Skip, Skips};
use crate::contact::BodyOverlaps;
use crate::geometry::adjacency::NONE;

/// Lengths that decide what is looked for, and where, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lengths {
    /// Distance from the skin up to which the body is searched for exactly, and within which the edges of resting cloth may cut it.
    pub sight: f64,
    /// Distance that a vertex may move with its track plane kept.
    kept: f64,
    /// Motion since the last query below which a vertex counts as slow. For slow vertices it is worth computing how far they may
    /// move before another part of the body can be nearest.
    slow: f64,
    /// Margin well above rounding errors.
    certain: f64,
    /// Motion over which what is found of the body is meant to stay valid: it is searched that much farther.
    pub ahead: f64,
}

/// On a body 1.5 m large. `kept` is a twentieth of the usual offset. `slow`, `certain` and `ahead` change no result, only how much
/// is searched.
const LENGTHS: Lengths = Lengths { sight: 0.03, kept: 0.0002, slow: 0.0005, certain: 1e-6, ahead: 0.002 };

impl Lengths {
    /// The lengths on the body of `surface`.
    pub fn on(surface: &Surface) -> Self {
        let scale = surface.scale();
        let Self { sight, kept, slow, certain, ahead } = LENGTHS;
        Self {
            sight: sight * scale,
            kept: kept * scale,
            slow: slow * scale,
            certain: certain * scale,
            ahead: ahead * scale,
        }
    }
}

/// The tangent plane of the body near a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Nearest point of the skin, metres.
    pub point: DVec3,
    /// Outward unit normal.
    pub normal: DVec3,
}

impl Plane {
    /// Signed height of `p` above the plane, metres.
    pub fn height(&self, p: DVec3) -> f64 {
        (p - self.point).dot(self.normal)
    }
}

#[derive(Clone, Copy, Debug)]
enum Track {
    /// Not queried yet on this body. `triangle` is what was near on the body before, or `NONE`.
    Unknown { triangle: u32 },
    /// Outside of the body, and at least `distance` from the skin when at `at`. The signed distance is 1-Lipschitz,
    /// so that the vertex stays outside until it has moved that far.
    Clear { at: DVec3, distance: f64 },
    /// The nearest point is known: inside, near, or outside at the height of `at` above the plane. While the vertex
    /// moves less than `slack` metres its nearest point is on `triangle` or triangles that touch it; None: found by a walk, for
    /// the time being, which did not look at parts of the body far from the last one. The signed distance to the body is at
    /// least `least` metres at `at`.
    Found { at: DVec3, plane: Plane, triangle: u32, slack: Option<f32>, least: f32 },
}

/// The work done to update a track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Effort {
    Nothing,
    Walk,
    Query,
    QueryAndGap,
}

/// Track planes of all vertices.
#[derive(Clone, Debug)]
pub struct Tracker {
    tracks: Vec<Track>,
    /// Reach of the last update, metres: vertices higher above the skin have no plane.
    pub reach: f64,
    /// While true, tracks of vertices near the skin are updated by a walk from their last triangle; the first update
    /// after that queries them exactly.
    pub walks: bool,
    /// Which skin each vertex ignores; None: no skin.
    pub apart: Option<Arc<BodyOverlaps>>,
}

impl Tracker {
    /// A tracker of `count` vertices, with nothing known yet.
    pub fn new(count: usize) -> Self {
        Self { tracks: vec![Track::Unknown { triangle: NONE }; count], reach: 0.0, walks: false, apart: None }
    }

    /// Updates the tracks of all mapped vertices. Those within `reach` metres of the skin have a plane afterwards.
    pub fn update(
        &mut self,
        surface: &Surface,
        state: &ClothState,
        reach: f64,
        skips: Skips,
        counters: &mut Counters,
    ) {
        self.reach = reach;
        let ask = Ask::new(surface, reach, skips, self.walks, self.apart.as_deref());
        let [queries, gaps, walks] = self
            .tracks
            .par_iter_mut()
            .zip(&state.positions)
            .zip(&state.mapped)
            .enumerate()
            .filter(|(_, (_, mapped))| **mapped)
            .map(|(v, ((track, &p), _))| work(ask.refresh(track, v, p)))
            .reduce(|| [0; 3], |a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
        counters.contact_queries += queries;
        counters.contact_gaps += gaps;
        counters.contact_walks += walks;
        counters.contact_checks += state.positions.len() as u64;
    }

    /// Updates the track of one vertex. Returns its plane if it is within `reach` metres of the skin.
    pub fn update_one(
        &mut self,
        vertex: u32,
        position: DVec3,
        surface: &Surface,
        reach: f64,
        skips: Skips,
        counters: &mut Counters,
    ) -> Option<Plane> {
        self.reach = reach;
        let ask = Ask::new(surface, reach, skips, self.walks, self.apart.as_deref());
        let [queries, gaps, walks] =
            work(ask.refresh(&mut self.tracks[vertex as usize], vertex as usize, position));
        counters.contact_queries += queries;
        counters.contact_gaps += gaps;
        counters.contact_walks += walks;
        counters.contact_checks += 1;
        self.plane(vertex as usize)
    }

    /// The track plane of a vertex, if it is within the reach of the last update.
    pub fn plane(&self, vertex: usize) -> Option<Plane> {
        match self.tracks[vertex] {
            Track::Found { at, plane, .. } if plane.height(at) <= self.reach => Some(plane),
            _ => None,
        }
    }

    /// Lower bound of the signed distance to the body for a vertex at `p`, metres, by what is known of it; negative:
    /// perhaps inside.
    pub fn at_least(&self, vertex: usize, p: DVec3) -> f64 {
        match self.tracks[vertex] {
            Track::Unknown { .. } => f64::NEG_INFINITY,
            Track::Clear { at, distance } => distance - p.distance(at),
            Track::Found { at, least, .. } => f64::from(least) - p.distance(at),
        }
    }

    /// Tells that a vertex was moved to `position` along its plane's normal, so that its nearest point of the skin is the same.
    pub fn moved_along_normal(&mut self, vertex: usize, position: DVec3) {
        if let Track::Found { at, slack, least, .. } = &mut self.tracks[vertex] {
            let moved = ((position - *at).length() as f32).next_up();
            *slack = slack.map(|slack| slack - moved);
            *least -= moved;
            *at = position;
        }
    }

    /// Memory used, bytes.
    pub fn bytes(&self) -> usize {
        self.tracks.len() * size_of::<Track>()
    }

    /// Forgets all tracks because the body has changed, except the triangles from which the next search starts.
    pub fn forget(&mut self) {
        for track in &mut self.tracks {
            let triangle = match *track {
                Track::Unknown { triangle } | Track::Found { triangle, .. } => triangle,
                Track::Clear { .. } => NONE,
            };
            *track = Track::Unknown { triangle };
        }
    }
}

/// Counts an effort as queries, gaps and walks, in this order.
fn work(effort: Effort) -> [u64; 3] {
    match effort {
        Effort::Nothing => [0, 0, 0],
        Effort::Walk => [0, 0, 1],
        Effort::Query => [1, 0, 0],
        Effort::QueryAndGap => [1, 1, 0],
    }
}

/// What an update of a track needs to know.
struct Ask<'a> {
    surface: &'a Surface,
    reach: f64,
    lengths: Lengths,
    skips: Skips,
    walks: bool,
    apart: Option<&'a BodyOverlaps>,
}

impl<'a> Ask<'a> {
    fn new(
        surface: &'a Surface,
        reach: f64,
        skips: Skips,
        walks: bool,
        apart: Option<&'a BodyOverlaps>,
    ) -> Self {
        Self { surface, reach, lengths: Lengths::on(surface), skips, walks, apart }
    }

    /// Whether `triangle` exists on this body and vertex `v` does not ignore it.
    fn is_known(&self, v: usize, triangle: u32) -> bool {
        (triangle as usize) < self.surface.mesh.triangles.len()
            && !self.apart.is_some_and(|apart| apart.leaves_out(v, triangle))
    }

    fn refresh(&self, track: &mut Track, v: usize, p: DVec3) -> Effort {
        let allow = |skip| self.skips.allow(skip);
        let mut slow = false;
        let far = match *track {
            Track::Clear { at, distance } => {
                if allow(Skip::Certificates) && distance - (p - at).length() > self.reach {
                    return Effort::Nothing;
                }
                // The vertex was outside and cannot have passed through the whole body: it need not search farther than this.
                self.lengths.sight
            }
            Track::Found { slack: None, plane, .. } if !self.walks => {
                if plane.height(p) > 0.0 {
                    self.lengths.sight
                } else {
                    f64::INFINITY
                }
            }
            Track::Found { at, plane, triangle, slack, least } => {
                let moved = (p - at).length();
                let kept = allow(Skip::Planes) && moved < self.lengths.kept;
                let clear = allow(Skip::Certificates) && plane.height(at) - moved > self.reach;
                if kept || clear {
                    return Effort::Nothing;
                }
                if self.walks && allow(Skip::Walks) {
                    let near = self.surface.nearest_by_walk(p, triangle);
                    let least = least - (moved as f32).next_up();
                    let plane = Plane { point: near.point, normal: near.normal };
                    *track = Track::Found { at: p, plane, triangle: near.triangle, slack: None, least };
                    return Effort::Walk;
                }
                if let Some(slack) = slack.filter(|&slack| allow(Skip::Triangles) && moved < f64::from(slack))
                {
                    let left = slack - (moved as f32).next_up();
                    *track = found(p, self.surface.nearest_round(p, triangle), left, triangle);
                    return Effort::Walk;
                }
                slow = moved < self.lengths.slow;
                // Not farther than it can have moved, and no farther than for a Clear track.
                let height = plane.height(at);
                let most = height.abs() + moved + self.lengths.certain;
                let most = if height > 0.0 { most.min(self.lengths.sight) } else { most };
                most.min(self.surface.distance_to(p, triangle) + self.lengths.certain)
            }
            // In another pose of the same body the part that was near still is.
            Track::Unknown { triangle } if self.is_known(v, triangle) => {
                self.surface.distance_to(p, triangle) + self.lengths.certain
            }
            Track::Unknown { .. } => f64::INFINITY,
        };
        let far = far.max(self.reach);
        let left_out = |t: u32| self.apart.is_some_and(|apart| apart.leaves_out(v, t));
        let Some(n) = self.surface.nearest_within_but(p, far, left_out) else {
            *track = Track::Clear { at: p, distance: far };
            return Effort::Query;
        };
        // A vertex comes nearer to the next nearest part by what it goes away from the nearest.
        let most_gap = 2.0 * self.lengths.ahead;
        let gap = match slow && allow(Skip::Triangles) {
            true => self.surface.gap_round(p, n.triangle, n.distance.abs(), most_gap),
            false => 0.0,
        };
        *track = found(p, n, ((gap / 2.0) as f32).next_down(), n.triangle);
        if slow { Effort::QueryAndGap } else { Effort::Query }
    }
}

/// A track with the plane of `n`, found from `p`. `slack` belongs to `triangle`.
fn found(p: DVec3, n: Nearest, slack: f32, triangle: u32) -> Track {
    let plane = Plane { point: n.point, normal: n.normal };
    Track::Found { at: p, plane, triangle, slack: Some(slack), least: (n.distance as f32).next_down() }
}
