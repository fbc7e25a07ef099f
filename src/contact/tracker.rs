//! For each cloth vertex the part of the body near it (paper A's track point), asked for only when it may have changed.

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Surface;
use crate::cloth::{ClothState, Counters};

/// A track plane is kept while its vertex has moved less than this, metres on a body 1.5 m large.
const PLANE_REUSE: f64 = 0.0002;
/// Bodies farther than this are not looked for exactly, metres on a body 1.5 m large.
const SIGHT: f64 = 0.03;

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
    /// Not asked yet.
    Unknown,
    /// Outside, and at least `distance` from the skin when it was at `at`: the signed distance is 1-Lipschitz, so it
    /// stays outside until it has moved that far.
    Clear { at: DVec3, distance: f64 },
    /// Near or inside.
    Near { at: DVec3, plane: Plane },
}

/// Track planes of all vertices.
#[derive(Clone, Debug)]
pub struct Tracker {
    tracks: Vec<Track>,
}

impl Tracker {
    /// Nothing known yet about `count` vertices.
    pub fn new(count: usize) -> Self {
        Self { tracks: vec![Track::Unknown; count] }
    }

    /// Brings the tracks of all mapped vertices up to date. Those within `reach` metres of the skin have a plane afterwards.
    pub fn update(&mut self, surface: &Surface, state: &ClothState, reach: f64, counters: &mut Counters) {
        let queries: u64 = self
            .tracks
            .par_iter_mut()
            .enumerate()
            .filter(|(v, _)| state.mapped[*v])
            .map(|(v, track)| u64::from(refresh(track, surface, state.positions[v], reach)))
            .sum();
        counters.contact_queries += queries;
        counters.contact_checks += state.positions.len() as u64;
    }

    /// The same for one vertex; its plane if it is within `reach` of the skin.
    pub fn update_one(
        &mut self,
        vertex: u32,
        position: DVec3,
        surface: &Surface,
        reach: f64,
        counters: &mut Counters,
    ) -> Option<Plane> {
        let asked = refresh(&mut self.tracks[vertex as usize], surface, position, reach);
        counters.contact_queries += u64::from(asked);
        counters.contact_checks += 1;
        self.plane(vertex as usize)
    }

    /// The track plane of a vertex, when the body is near.
    pub fn plane(&self, vertex: usize) -> Option<Plane> {
        match self.tracks[vertex] {
            Track::Near { plane, .. } => Some(plane),
            _ => None,
        }
    }

    /// A vertex was carried to `position` along its plane's normal: its nearest point of the skin is the same.
    pub fn moved_along_normal(&mut self, vertex: usize, position: DVec3) {
        if let Track::Near { at, .. } = &mut self.tracks[vertex] {
            *at = position;
        }
    }

    /// Forgets everything: the body has changed.
    pub fn forget(&mut self) {
        self.tracks.fill(Track::Unknown);
    }
}

/// Returns whether the body had to be asked.
fn refresh(track: &mut Track, surface: &Surface, p: DVec3, reach: f64) -> bool {
    let scale = surface.scale();
    let far = match *track {
        Track::Clear { at, distance } if distance - (p - at).length() > reach => return false,
        Track::Near { at, .. } if (p - at).length() < PLANE_REUSE * scale => return false,
        // It was outside and cannot have come through the whole body: no need to look farther than this.
        Track::Clear { .. } => SIGHT * scale,
        _ => f64::INFINITY,
    };
    *track = match surface.nearest_within(p, far.max(reach)) {
        None => Track::Clear { at: p, distance: far.max(reach) },
        Some(n) if n.distance > reach => Track::Clear { at: p, distance: n.distance },
        Some(n) => Track::Near { at: p, plane: Plane { point: n.point, normal: n.normal } },
    };
    true
}
