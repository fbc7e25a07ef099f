//! For each cloth vertex the part of the body near it (paper A's track point), asked for only when it may have changed.
//!
//! The paper walks from the last triangle to nearer neighbours, which misses parts that were never covered and parts that
//! come from elsewhere. Here every answer is that of the exact tree; a look round the last triangle replaces it only where
//! a certificate says that nothing else can be nearer (ALGORITHMS.md 1.A7), and the paper's walk only on the way to where the
//! next exact one is asked for.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::body::{Nearest, Surface};
use crate::cloth::{ClothState, Counters, Skip, Skips};
use crate::contact::BodyOverlaps;
use crate::geometry::adjacency::NONE;

/// A track plane is kept while its vertex has moved less than this, metres on a body 1.5 m large.
const PLANE_REUSE: f64 = 0.0002;
/// Bodies farther than this are not looked for exactly, metres on a body 1.5 m large.
const SIGHT: f64 = 0.03;
/// Cloth that moved less than this since it asked is taken to move slowly on: it is worth finding out how far it may go
/// before another part of the body can be nearest. Metres on a body 1.5 m large.
const SLOW: f64 = 0.0005;
/// Far beyond rounding errors, metres on a body 1.5 m large.
const CERTAIN: f64 = 1e-6;
/// Parts farther than the nearest by this are not looked for then, metres on a body 1.5 m large.
const MOST_GAP: f64 = 0.004;

/// The body near a vertex, as a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Nearest point of the skin.
    pub point: DVec3,
    /// Unit, outward.
    pub normal: DVec3,
}

impl Plane {
    /// Height of `p` above the plane.
    pub fn height(&self, p: DVec3) -> f64 {
        (p - self.point).dot(self.normal)
    }
}

#[derive(Clone, Copy, Debug)]
enum Track {
    /// Not asked yet on this body; on the last one `triangle` was near, or none.
    Unknown { triangle: u32 },
    /// Outside, and at least `distance` from the skin when it was at `at`: the signed distance is 1-Lipschitz, so it
    /// stays outside until it has moved that far.
    Clear { at: DVec3, distance: f64 },
    /// Found: near, inside, or outside as far as the plane was from `at`. While it moves less than `slack` metres its
    /// nearest point is on `triangle` or those that touch it. [`WALKED`]: found by walking, for the time being;
    /// all of the body is then at least `least` metres away.
    Found { at: DVec3, plane: Plane, triangle: u32, slack: f32, least: f32 },
}

/// The slack of what was found by walking: no part of the body far from the last one was looked at.
const WALKED: f32 = f32::NEG_INFINITY;

/// What bringing a track up to date took.
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
    /// Of the last update: planes of what is farther are not given out.
    pub reach: f64,
    /// Cloth that lay near the skin walks there from where it was, until this is false again: then it asks anew.
    pub walks: bool,
    /// Skin that some vertices do not touch.
    pub apart: Option<Arc<BodyOverlaps>>,
}

impl Tracker {
    /// Nothing known yet about `count` vertices.
    pub fn new(count: usize) -> Self {
        Self { tracks: vec![Track::Unknown { triangle: NONE }; count], reach: 0.0, walks: false, apart: None }
    }

    /// Brings the tracks of all mapped vertices up to date. Those within `reach` metres of the skin have a plane afterwards.
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

    /// The same for one vertex; its plane if it is within `reach` of the skin.
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

    /// The track plane of a vertex, when the body is near.
    pub fn plane(&self, vertex: usize) -> Option<Plane> {
        match self.tracks[vertex] {
            Track::Found { at, plane, .. } if plane.height(at) <= self.reach => Some(plane),
            _ => None,
        }
    }

    /// At least so far outside of the body (negative: perhaps inside) a vertex at `p` is by what is known of it.
    pub fn at_least(&self, vertex: usize, p: DVec3) -> f64 {
        match self.tracks[vertex] {
            Track::Unknown { .. } => f64::NEG_INFINITY,
            Track::Clear { at, distance } => distance - p.distance(at),
            Track::Found { at, least, .. } => f64::from(least) - p.distance(at),
        }
    }

    /// A vertex was carried to `position` along its plane's normal: its nearest point of the skin is the same.
    pub fn moved_along_normal(&mut self, vertex: usize, position: DVec3) {
        if let Track::Found { at, slack, least, .. } = &mut self.tracks[vertex] {
            let moved = ((position - *at).length() as f32).next_up();
            *slack -= moved;
            *least -= moved;
            *at = position;
        }
    }

    /// Bytes it keeps.
    pub fn bytes(&self) -> usize {
        self.tracks.len() * size_of::<Track>()
    }

    /// Forgets everything, as the body has changed, but where on it to begin to look.
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

/// Queries, gaps looked for, walks.
fn work(effort: Effort) -> [u64; 3] {
    match effort {
        Effort::Nothing => [0, 0, 0],
        Effort::Walk => [0, 0, 1],
        Effort::Query => [1, 0, 0],
        Effort::QueryAndGap => [1, 1, 0],
    }
}

/// How a track is brought up to date.
struct Ask<'a> {
    surface: &'a Surface,
    reach: f64,
    scale: f64,
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
        Self { surface, reach, scale: surface.scale(), skips, walks, apart }
    }

    /// Whether `triangle` is one of this body, and `v` may touch it.
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
                // It was outside and cannot have come through the whole body: no need to look farther than this.
                SIGHT * self.scale
            }
            Track::Found { slack: WALKED, plane, .. } if !self.walks => {
                if plane.height(p) > 0.0 {
                    SIGHT * self.scale
                } else {
                    f64::INFINITY
                }
            }
            Track::Found { at, plane, triangle, slack, least } => {
                let moved = (p - at).length();
                let kept = allow(Skip::Planes) && moved < PLANE_REUSE * self.scale;
                let clear = allow(Skip::Certificates) && plane.height(at) - moved > self.reach;
                if kept || clear {
                    return Effort::Nothing;
                }
                if self.walks && allow(Skip::Walks) {
                    let near = self.surface.nearest_by_walk(p, triangle);
                    let least = least - (moved as f32).next_up();
                    let plane = Plane { point: near.point, normal: near.normal };
                    *track = Track::Found { at: p, plane, triangle: near.triangle, slack: WALKED, least };
                    return Effort::Walk;
                }
                if allow(Skip::Triangles) && moved < f64::from(slack) {
                    let left = slack - (moved as f32).next_up();
                    *track = found(p, self.surface.nearest_round(p, triangle), left, triangle);
                    return Effort::Walk;
                }
                slow = moved < SLOW * self.scale;
                // No farther than it can have come, and no farther than a Clear one is looked for.
                let height = plane.height(at);
                let most = height.abs() + moved + CERTAIN * self.scale;
                let most = if height > 0.0 { most.min(SIGHT * self.scale) } else { most };
                most.min(self.surface.distance_to(p, triangle) + CERTAIN * self.scale)
            }
            // In another pose of the same body what was near still is.
            Track::Unknown { triangle } if self.is_known(v, triangle) => {
                self.surface.distance_to(p, triangle) + CERTAIN * self.scale
            }
            Track::Unknown { .. } => f64::INFINITY,
        };
        let far = far.max(self.reach);
        let left_out = |t: u32| self.apart.is_some_and(|apart| apart.leaves_out(v, t));
        let Some(n) = self.surface.nearest_within_but(p, far, left_out) else {
            *track = Track::Clear { at: p, distance: far };
            return Effort::Query;
        };
        let gap = match slow && allow(Skip::Triangles) {
            true => self.surface.gap_round(p, n.triangle, n.distance.abs(), MOST_GAP * self.scale),
            false => 0.0,
        };
        *track = found(p, n, ((gap / 2.0) as f32).next_down(), n.triangle);
        if slow { Effort::QueryAndGap } else { Effort::Query }
    }
}

/// The plane of `n`, found from `p`. The `slack` is that of `triangle`.
fn found(p: DVec3, n: Nearest, slack: f32, triangle: u32) -> Track {
    let plane = Plane { point: n.point, normal: n.normal };
    Track::Found { at: p, plane, triangle, slack, least: (n.distance as f32).next_down() }
}
