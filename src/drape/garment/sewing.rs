//! Sewing placed pieces together: seams shrink until they are shut, then what they join becomes one.
//!
//! A seam is a thread of shrinking length between the two sides (zero-length constraints in the end), not a force: paper B's
//! adaptive force is constant near the end and chatters there, and its printed signs and units do not agree (ALGORITHMS.md 1.B).
//! What is kept of the paper: gravity and friction act only once all is sewn, sides are merged with mass and momentum kept.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Surface;
use crate::cloth::{ClothState, Fabric, Garment};
use crate::contact::separation;
use crate::drape::garment::routes::{self, Route};
use crate::drape::garment::{DrapedGarment, DrapedSettings, TICK, Undrapable};
use crate::drape::solver::small_steps::SewingSpring;
use crate::geometry::adjacency::Adjacency;
use crate::geometry::ids::PieceId;

/// How fast a seam shrinks, m/s, and the fewest and the most ticks that takes.
const SHRINK: (f64, [u32; 2]) = (0.4, [45, 120]);
/// What is sewn then slides free of weight and friction to where it is least tight: until no vertex is faster, m/s,
const SLOW: f64 = 0.02;
/// for this many ticks,
const STILL: u32 = 20;
/// and for this many at most.
const PATIENCE: u32 = 240;
/// Small steps in each tick: nothing hangs yet.
const SUBSTEPS: usize = 24;

/// A garment that is being sewn.
#[derive(Clone, Debug)]
pub struct Sewing {
    worn: DrapedGarment,
    sewn: Arc<Garment>,
    open: Arc<Garment>,
    /// For each vertex of `open` that of `sewn`.
    becomes: Arc<Vec<u32>>,
    threads: Vec<Thread>,
    /// The body, with what is worn on it already.
    surface: Arc<Surface>,
    closing: u32,
    ticks: u32,
    /// A tick is under way.
    is_begun: bool,
    /// Since nothing in it is fast.
    still: u32,
    widest: f64,
}

/// What pulls two vertices of the open garment together.
#[derive(Clone, Copy, Debug)]
struct Thread {
    ends: [u32; 2],
    /// How long it was, metres.
    length: f64,
    route: Route,
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Sewn {
    /// The sewn garment's.
    pub cloth: ClothState,
    /// Of its vertices, m/s.
    pub velocities: Vec<DVec3>,
}

/// What is sewn in one go.
#[derive(Clone, Copy)]
pub struct Stage<'a> {
    /// The flat corners of the garment lie there, metres; None: not placed.
    pub places: &'a [Option<DVec3>],
    /// Pieces that are sewn now.
    pub now: &'a dyn Fn(PieceId) -> bool,
    /// The garment's cloth: what of it is laid already was sewn before; it gives way to what is sewn over it.
    pub worn: &'a ClothState,
}

impl Sewing {
    /// Of `garment`, as `stage` says. The rest as for [`DrapedGarment::new`].
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
            return Err(Undrapable("none of its pieces is placed in space".to_owned()));
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
            SUBSTEPS,
        )?;
        if !inner.is_empty() {
            worn.pull_over(&inner);
        }
        let surface = with_cloth(surface, &open, &cloth, &inner);
        let seams = garment.seam_pairs.iter();
        let threads: Vec<Thread> =
            seams.flat_map(|(_, pairs)| threads(&open, &cloth, pairs, &surface)).collect();
        let widest = threads.iter().map(|t| t.length).fold(0.0, f64::max);
        let (speed, [least, most]) = SHRINK;
        let closing = ((widest / speed / TICK).ceil() as u32).clamp(least, most);
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

    /// The garment with the seams of what is sewn now open: a vertex for each flat corner there.
    pub fn garment(&self) -> &Arc<Garment> {
        &self.open
    }

    /// The widest gap of all seams, metres.
    pub fn widest(&self) -> f64 {
        self.widest
    }

    /// 0..=1.
    pub fn progress(&self) -> f64 {
        (f64::from(self.ticks) / f64::from(self.closing + PATIENCE)).min(1.0)
    }

    /// What contact took since it was last asked.
    pub fn take_separation(&mut self) -> separation::Counters {
        self.worn.take_separation()
    }

    /// Some of the work of a tick. True when the seams are shut, or have had their time.
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
        let is_slow = self.ticks >= self.closing && self.worn.progress().speed < SLOW;
        self.still = if is_slow { self.still + 1 } else { 0 };
        Ok(self.still >= STILL || self.ticks >= self.closing + PATIENCE)
    }

    /// Shortens the threads for another tick.
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

    /// Makes one of what is sewn, with the mass and momentum of its parts.
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

/// The body with those triangles of `cloth` all of whose vertices are among `inner`, as it lies.
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

/// The threads of a seam that has these `pairs` of flat corners.
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

/// The same pieces, those that are sewn `now` not yet: they have a vertex for each flat corner. For each vertex that of
/// `garment` which it becomes.
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
