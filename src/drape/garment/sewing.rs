//! Sewing placed pieces together: sewing springs shrink until the seams are shut, then the joined vertices are merged.
//!
//! A seam is a set of distance constraints of shrinking length (zero in the end), not a force: paper B's adaptive force is
//! constant near the end and chatters there, and its printed signs and units do not agree (ALGORITHMS.md 1.B). Kept from the
//! paper: gravity and friction act only once all is sewn, and vertices are merged with mass and momentum conserved.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Surface;
use crate::cloth::{ClothState, Fabric, Garment};
use crate::contact::separation;
use crate::drape::garment::routes::{self, Route};
use crate::drape::garment::{DrapedGarment, DrapedSettings, TICK, Undrapable};
use crate::drape::solver::ties::SewingSpring;
use crate::geometry::adjacency::Adjacency;
use crate::geometry::ids::PieceId;
use crate::geometry::words::words;

/// How seams are shut, and when sewing is done.
struct Pace {
    /// Small steps in a tick; few suffice, since nothing hangs yet.
    substeps: usize,
    /// Speed at which a seam shrinks, m/s.
    shrink: f64,
    /// Fewest and most ticks in which the seams are shut.
    shut_in: [u32; 2],
    /// Speed (m/s) below which sewn cloth counts as slow. After the seams are shut it slides without weight and friction until it
    /// is under the least tension.
    slow: f64,
    /// Consecutive slow ticks after which sewing is done.
    still: u32,
    /// Most ticks that cloth may slide after the seams are shut.
    patience: u32,
}

/// Chosen by trial; at most `shut_in` and `patience` ticks together bound how long sewing takes.
const PACE: Pace =
    Pace { substeps: 24, shrink: 0.4, shut_in: [45, 120], slow: 0.02, still: 20, patience: 240 };

/// A garment being sewn.
#[derive(Clone, Debug)]
pub struct Sewing {
    worn: DrapedGarment,
    sewn: Arc<Garment>,
    open: Arc<Garment>,
    /// For each vertex of `open` the vertex of `sewn` that it becomes.
    becomes: Arc<Vec<u32>>,
    threads: Vec<Thread>,
    /// The body, and the cloth worn on it already, as a surface.
    surface: Arc<Surface>,
    closing: u32,
    ticks: u32,
    /// Whether a tick is partly done.
    is_begun: bool,
    /// Ticks since no vertex is fast.
    still: u32,
    widest: f64,
}

/// A sewing spring between two vertices of the open garment.
#[derive(Clone, Copy, Debug)]
struct Thread {
    ends: [u32; 2],
    /// Length at the start, metres.
    length: f64,
    route: Route,
}

/// Result of sewing.
#[derive(Clone, Debug)]
pub struct Sewn {
    /// Cloth of the sewn garment.
    pub cloth: ClothState,
    /// Velocity of each vertex of the sewn garment, m/s.
    pub velocities: Vec<DVec3>,
}

/// What is sewn in one stage.
#[derive(Clone, Copy)]
pub struct Stage<'a> {
    /// Position of each flat corner of the garment, metres; None: not placed.
    pub places: &'a [Option<DVec3>],
    /// Pieces that are sewn now.
    pub now: &'a dyn Fn(PieceId) -> bool,
    /// Cloth of the garment. Its draped part was sewn before, and yields to the pieces sewn over it.
    pub worn: &'a ClothState,
}

impl Sewing {
    /// Prepares the sewing of `garment` as `stage` says; the other arguments are those of [`DrapedGarment::new`]. Also returns
    /// the cloth of the open garment.
    pub fn new(
        garment: Arc<Garment>,
        stage: Stage<'_>,
        surface: Arc<Surface>,
        fabrics: (&BTreeMap<PieceId, Fabric>, &Fabric),
        settings: DrapedSettings,
    ) -> Result<(Self, ClothState), Undrapable> {
        let (open, becomes) = unsewn(&garment, stage.now);
        let mut cloth = ClothState {
            positions: becomes.iter().map(|&v| stage.worn.positions[v as usize]).collect(),
            mapped: vec![false; open.vertex_count],
        };
        let mut inner = Vec::new();
        let mut some = false;
        for (corner, place) in open.corners.iter().zip(stage.places) {
            let v = corner.vertex as usize;
            if !(stage.now)(corner.piece) {
                if stage.worn.mapped[becomes[v] as usize] && !cloth.mapped[v] {
                    cloth.mapped[v] = true;
                    inner.push(corner.vertex);
                }
            } else if let Some(place) = place {
                (cloth.positions[v], cloth.mapped[v], some) = (*place, true, true);
            }
        }
        if !some {
            return Err(Undrapable(words!("none of its pieces is placed in space")));
        }
        let (open, becomes) = (Arc::new(open), Arc::new(becomes));
        let will_be = (Arc::clone(&garment), Arc::clone(&becomes));
        let mut worn = DrapedGarment::unsewn(
            Arc::clone(&open),
            &cloth,
            Arc::clone(&surface),
            fabrics,
            settings,
            will_be,
            PACE.substeps,
        )?;
        if !inner.is_empty() {
            worn.pull_over(&inner);
        }
        let surface = with_cloth(surface, &open, &cloth, &inner);
        let seams = garment.seam_pairs.iter();
        let threads: Vec<Thread> =
            seams.flat_map(|(_, pairs)| threads(&open, &cloth, pairs, &surface)).collect();
        let widest = threads.iter().map(|t| t.length).fold(0.0, f64::max);
        let [least, most] = PACE.shut_in;
        let closing = ((widest / PACE.shrink / TICK).ceil() as u32).clamp(least, most);
        let sewing = Self {
            worn,
            sewn: garment,
            open,
            becomes,
            threads,
            surface,
            closing,
            ticks: 0,
            is_begun: false,
            still: 0,
            widest,
        };
        Ok((sewing, cloth))
    }

    /// The open garment: in the pieces sewn now it has a vertex for each flat corner.
    pub fn garment(&self) -> &Arc<Garment> {
        &self.open
    }

    /// Largest gap of all seams, metres.
    pub fn widest(&self) -> f64 {
        self.widest
    }

    /// Progress, 0..=1.
    pub fn progress(&self) -> f64 {
        (f64::from(self.ticks) / f64::from(self.closing + PACE.patience)).min(1.0)
    }

    /// Whether a tick is partly done.
    pub fn is_mid_tick(&self) -> bool {
        self.is_begun
    }

    /// Work counters of collision since they were last taken; resets them.
    pub fn take_separation(&mut self) -> separation::Counters {
        self.worn.take_separation()
    }

    /// Does part of the work of a tick. True when the cloth is slow, or the time is up.
    pub fn go_on(&mut self, cloth: &mut ClothState) -> Result<bool, Undrapable> {
        if !self.is_begun {
            self.tie(cloth);
        }
        self.is_begun = !self.worn.go_on(cloth)?;
        if self.is_begun {
            return Ok(false);
        }
        let gap = |[a, b]: [u32; 2]| cloth.positions[a as usize].distance(cloth.positions[b as usize]);
        self.widest = self.threads.iter().map(|t| gap(t.ends)).fold(0.0, f64::max);
        let is_slow = self.ticks >= self.closing && self.worn.progress().speed < PACE.slow;
        self.still = if is_slow { self.still + 1 } else { 0 };
        Ok(self.still >= PACE.still || self.ticks >= self.closing + PACE.patience)
    }

    /// Shortens the sewing springs for the next tick.
    fn tie(&mut self, cloth: &ClothState) {
        self.ticks += 1;
        let left = 1.0 - (f64::from(self.ticks) / f64::from(self.closing)).min(1.0);
        let surface = &self.surface;
        self.threads.par_iter_mut().for_each(|thread| {
            let ends = thread.ends.map(|v| cloth.positions[v as usize]);
            thread.route.go_on(surface, ends);
        });
        let tie = |thread: &Thread| SewingSpring {
            ends: thread.ends,
            length: thread.length * left,
            over: thread.route.over,
        };
        let ties: Vec<SewingSpring> = self.threads.iter().map(tie).collect();
        self.worn.tie(&ties);
    }

    /// Cloth and velocities of the sewn garment: merged vertices conserve mass and momentum.
    pub fn merged(&self, cloth: &ClothState) -> Sewn {
        let count = self.sewn.vertex_count;
        let mut sums = vec![(0.0, DVec3::ZERO, DVec3::ZERO); count];
        for (o, &vertex) in self.becomes.iter().enumerate() {
            if let Some((mass, velocity)) = self.worn.motion(o as u32) {
                let (m, x, v) = &mut sums[vertex as usize];
                *m += mass;
                *x += cloth.positions[o] * mass;
                *v += velocity * mass;
            }
        }
        let mean = |sum: DVec3, m: f64| if m > 0.0 { sum / m } else { DVec3::ZERO };
        Sewn {
            cloth: ClothState {
                positions: sums.iter().map(|(m, x, _)| mean(*x, *m)).collect(),
                mapped: sums.iter().map(|(m, ..)| *m > 0.0).collect(),
            },
            velocities: sums.iter().map(|(m, _, v)| mean(*v, *m)).collect(),
        }
    }
}

/// The surface of the body together with the triangles of `cloth` whose vertices are all among `inner`.
fn with_cloth(body: Arc<Surface>, garment: &Garment, cloth: &ClothState, inner: &[u32]) -> Arc<Surface> {
    let mut is_inner = vec![false; garment.vertex_count];
    inner.iter().for_each(|&v| is_inner[v as usize] = true);
    let first = body.mesh.positions.len() as u32;
    let lies = garment.triangles.iter().filter(|vs| vs.iter().all(|&v| is_inner[v as usize]));
    let more: Vec<[u32; 3]> = lies.map(|vs| vs.map(|v| v + first)).collect();
    if more.is_empty() {
        return body;
    }
    let mut mesh = body.mesh.clone();
    mesh.positions.extend(
        cloth.positions.iter().zip(&is_inner).map(|(p, inner)| if *inner { *p } else { DVec3::ZERO }),
    );
    mesh.triangles.extend(more);
    Surface::new(mesh).map_or(body, Arc::new)
}

/// Sewing springs of a seam with these `pairs` of flat corners.
fn threads(garment: &Garment, cloth: &ClothState, pairs: &[[u32; 2]], surface: &Surface) -> Vec<Thread> {
    let ends: Vec<[u32; 2]> = pairs
        .iter()
        .map(|pair| pair.map(|c| garment.corners[c as usize].vertex))
        .filter(|[a, b]| a != b && cloth.mapped[*a as usize] && cloth.mapped[*b as usize])
        .collect();
    let places: Vec<[DVec3; 2]> = ends.iter().map(|ends| ends.map(|v| cloth.positions[v as usize])).collect();
    let over = routes::over(surface, &places);
    let thread = |((&ends, [a, b]), over): ((&[u32; 2], [DVec3; 2]), Option<DVec3>)| {
        let length = over.map_or(a.distance(b), |over| a.distance(over) + over.distance(b));
        Thread { ends, length, route: Route::new(over) }
    };
    ends.iter().zip(places).zip(over).map(thread).collect()
}

/// The garment with the pieces that are sewn `now` open: a vertex for each of their flat corners. Also, for each of its vertices,
/// the vertex of `garment` that it becomes.
fn unsewn(garment: &Garment, now: &dyn Fn(PieceId) -> bool) -> (Garment, Vec<u32>) {
    let mut corners = garment.corners.clone();
    let mut shared: Vec<Option<u32>> = vec![None; garment.vertex_count];
    let mut becomes = Vec::new();
    for corner in &mut corners {
        let sewn = corner.vertex;
        let mut add = || {
            becomes.push(sewn);
            becomes.len() as u32 - 1
        };
        corner.vertex = match now(corner.piece) {
            true => add(),
            false => *shared[sewn as usize].get_or_insert_with(add),
        };
    }
    let vertex_of = |vs: &[u32; 3]| vs.map(|c| corners[c as usize].vertex);
    let triangles: Vec<[u32; 3]> = garment.triangle_corners.iter().map(vertex_of).collect();
    let vertex_count = becomes.len();
    let adjacency = Adjacency::new(vertex_count, &triangles);
    let open =
        Garment { vertex_count, triangles, corners, adjacency, seam_pairs: Vec::new(), ..garment.clone() };
    (open, becomes)
}
