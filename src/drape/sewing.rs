//! Sewing placed pieces together: seams shrink until they are shut, then what they join becomes one.
//!
//! A seam is a thread of shrinking length between the two sides (zero-length constraints in the end), not a force: paper B's
//! adaptive force is constant near the end and chatters there, and its printed signs and units do not agree (ALGORITHMS.md 1.B).
//! What is kept of the paper: gravity and friction act only once all is sewn, sides are merged at 1e-5 m with mass and momentum
//! kept, and seams that do not come together round this body are told.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;

use crate::body::Surface;
use crate::cloth::{ClothState, Fabric, Garment};
use crate::drape::small_steps::Tie;
use crate::drape::worn::{TICK, Undrapable, Worn, WornSettings};
use crate::geometry::adjacency::Adjacency;
use crate::geometry::ids::{PieceId, SeamId};

/// Sides nearer than this are one, metres (paper B).
pub const SHUT: f64 = 1e-5;
/// Seams that stay farther open than this before they are pulled shut are told, metres.
const TOLD: f64 = 5e-4;
/// How fast a seam shrinks, m/s; it takes between so many ticks.
const SHRINK: (f64, [u32; 2]) = (0.4, [45, 120]);
/// Seams have so many ticks more to come together, and then those of [`SLIDE`].
const PATIENCE: u32 = 90;
/// What is sewn slides free of weight and friction to where it is least tight: until no vertex is faster, m/s, and for so many
/// ticks.
const SLIDE: (f64, [u32; 2]) = (0.02, [20, 150]);
/// Small steps in each tick: nothing hangs yet.
const SUBSTEPS: usize = 24;

/// A garment that is being sewn.
#[derive(Clone, Debug)]
pub struct Sewing {
    worn: Worn,
    sewn: Arc<Garment>,
    open: Arc<Garment>,
    /// Sewn corners and how far they were apart, metres.
    threads: Vec<([u32; 2], f64)>,
    closing: u32,
    ticks: u32,
    /// Since all seams were shut.
    shut: u32,
    widest: f64,
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Sewn {
    /// The sewn garment's.
    pub cloth: ClothState,
    /// Of its vertices, m/s.
    pub velocities: Vec<DVec3>,
    /// Seams that did not come together, by more than half a millimetre, with their widest gap, metres.
    pub open: Vec<(SeamId, f64)>,
}

impl Sewing {
    /// Of `garment`, whose flat corners lie at `places` (None: not placed). The rest as for [`Worn::new`].
    pub fn new(
        garment: Arc<Garment>,
        places: &[Option<DVec3>],
        surface: Arc<Surface>,
        fabrics: (&BTreeMap<PieceId, Fabric>, &Fabric),
        settings: WornSettings,
    ) -> Result<(Self, ClothState), Undrapable> {
        let open = Arc::new(unsewn(&garment));
        let cloth = ClothState {
            positions: places.iter().map(|p| p.unwrap_or_default()).collect(),
            mapped: places.iter().map(Option::is_some).collect(),
        };
        if !cloth.mapped.contains(&true) {
            return Err(Undrapable("none of its pieces is placed in space".to_owned()));
        }
        let sewn = Arc::clone(&garment);
        let mut worn = Worn::unsewn(Arc::clone(&open), &cloth, surface, fabrics, settings, sewn)?;
        worn.float(SUBSTEPS);
        let pairs = garment.seam_pairs.iter().flat_map(|(_, pairs)| pairs);
        let threads: Vec<([u32; 2], f64)> = pairs
            .filter(|pair| pair.iter().all(|&c| cloth.mapped[c as usize]))
            .map(|&[a, b]| ([a, b], cloth.positions[a as usize].distance(cloth.positions[b as usize])))
            .collect();
        let widest = threads.iter().map(|t| t.1).fold(0.0, f64::max);
        let (speed, [least, most]) = SHRINK;
        let closing = ((widest / speed / TICK).ceil() as u32).clamp(least, most);
        Ok((Self { worn, sewn: garment, open, threads, closing, ticks: 0, shut: 0, widest }, cloth))
    }

    /// The garment with its seams open: a vertex for each flat corner.
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

    /// A tick. True when the seams are shut, or have had their time.
    pub fn tick(&mut self, cloth: &mut ClothState) -> Result<bool, Undrapable> {
        self.ticks += 1;
        let left = 1.0 - (f64::from(self.ticks) / f64::from(self.closing)).min(1.0);
        let ties: Vec<Tie> =
            self.threads.iter().map(|&(ends, length)| Tie { ends, length: length * left }).collect();
        self.worn.tie(&ties);
        self.worn.tick(cloth)?;
        let gap = |[a, b]: [u32; 2]| cloth.positions[a as usize].distance(cloth.positions[b as usize]);
        self.widest = self.threads.iter().map(|t| gap(t.0)).fold(0.0, f64::max);
        let is_shut = self.ticks >= self.closing && self.widest <= SHUT;
        self.shut = if is_shut { self.shut + 1 } else { 0 };
        let (slow, [least, most]) = SLIDE;
        let slid = self.shut >= most || (self.shut >= least && self.worn.progress().speed < slow);
        Ok(slid || self.ticks >= self.closing + PATIENCE + most)
    }

    /// Makes one of what is sewn, with the mass and momentum of its parts.
    pub fn merged(&self, cloth: &ClothState) -> Sewn {
        let count = self.sewn.vertex_count;
        let mut sums = vec![(0.0, DVec3::ZERO, DVec3::ZERO); count];
        for (c, corner) in self.sewn.corners.iter().enumerate() {
            if let Some((mass, velocity)) = self.worn.motion(c as u32) {
                let (m, x, v) = &mut sums[corner.vertex as usize];
                *m += mass;
                *x += cloth.positions[c] * mass;
                *v += velocity * mass;
            }
        }
        let mean = |sum: DVec3, m: f64| if m > 0.0 { sum / m } else { DVec3::ZERO };
        let gap = |&[a, b]: &[u32; 2]| match cloth.mapped[a as usize] && cloth.mapped[b as usize] {
            true => cloth.positions[a as usize].distance(cloth.positions[b as usize]),
            false => 0.0,
        };
        let widest =
            self.sewn.seam_pairs.iter().map(|(id, pairs)| (*id, pairs.iter().map(gap).fold(0.0, f64::max)));
        Sewn {
            cloth: ClothState {
                positions: sums.iter().map(|(m, x, _)| mean(*x, *m)).collect(),
                mapped: sums.iter().map(|(m, ..)| *m > 0.0).collect(),
            },
            velocities: sums.iter().map(|(m, _, v)| mean(*v, *m)).collect(),
            open: widest.filter(|(_, gap)| *gap > TOLD).collect(),
        }
    }
}

/// The same pieces, none sewn.
fn unsewn(garment: &Garment) -> Garment {
    let vertex_count = garment.corners.len();
    let mut corners = garment.corners.clone();
    corners.iter_mut().zip(0..).for_each(|(corner, c)| corner.vertex = c);
    Garment {
        vertex_count,
        triangles: garment.triangle_corners.clone(),
        corners,
        adjacency: Adjacency::new(vertex_count, &garment.triangle_corners),
        seam_pairs: Vec::new(),
        ..garment.clone()
    }
}
