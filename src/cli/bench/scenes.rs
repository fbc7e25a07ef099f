//! The garments on bodies that benchmarks use, and how one is wrapped.

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::body::{Mannequin, Surface};
use crate::cli::bench::tube::{self, Tube};
use crate::cli::bench::{median, one_hash};
use crate::cli::failure::Failure;
use crate::cli::interrupt;
use crate::cloth::{ClothState, Counters, Garment, Skip, Skips, build};
use crate::pattern::Pattern;
use crate::relax::RelaxSettings;
use crate::session::samples::Sample;
use crate::sim::GarmentSource;
use crate::sim::hash::cloth_hash;
use crate::wrap::{Dressing, Marks, Phase, coarser};

/// Edge length with which the search for a number of triangles starts, metres.
const FIRST_EDGE: f64 = 0.0125;
/// Number of iterations of that search.
const EDGE_STEPS: usize = 3;
/// Limit of ticks: a wrap that is not at rest by then oscillates.
const MOST_TICKS: u64 = 20_000;

/// A garment with its marks, and a body.
#[derive(Clone)]
pub struct Scene {
    pub pattern: Arc<Pattern>,
    pub marks: Arc<Marks>,
    pub surface: Arc<Surface>,
    pub relax: RelaxSettings,
    /// Edge length of the triangles, metres.
    pub edge_length: f64,
}

/// The result of a wrap that has come to rest.
pub struct Wrapped {
    pub garment: Arc<Garment>,
    pub state: ClothState,
    pub dressing: Dressing,
    pub ticks: u64,
    /// Wall-clock seconds from pattern and marks to rest.
    pub seconds: f64,
    /// Wall-clock seconds before the first tick, part of `seconds`.
    pub build_seconds: f64,
    /// Counters of the work done until all cloth was on the body.
    pub grown: Counters,
}

impl Scene {
    /// A sample on the mannequin it was drafted for, with about `triangles` triangles.
    pub fn sample(sample: Sample, body: &Mannequin, triangles: usize) -> Result<Self, Failure> {
        let surface = Surface::new(body.mesh.clone()).ok_or_else(no_body)?;
        let document = sample.project(body).document;
        Ok(Self {
            edge_length: edge_length(&document.pattern, triangles),
            pattern: document.pattern,
            marks: document.marks,
            surface: Arc::new(surface),
            relax: document.settings.relax,
        })
    }

    /// The same scene without gravity, for which the exact solution of a tube holds.
    pub fn weightless(self) -> Self {
        Self { relax: RelaxSettings { gravity: 0.0, ..self.relax }, ..self }
    }

    /// The same scene with other optimisations switched off.
    pub fn skipping(self, skips: Skips) -> Self {
        Self { relax: RelaxSettings { skips, ..self.relax }, ..self }
    }

    /// A tube on a cylinder.
    pub fn tube(tube: &Tube, edge_length: f64) -> Result<Self, Failure> {
        let surface = Surface::new(tube::cylinder()).ok_or_else(no_body)?;
        let offset = tube::OFFSET / surface.scale();
        Ok(Self {
            pattern: Arc::new(tube.pattern.clone()),
            marks: Arc::new(tube.marks.clone()),
            surface: Arc::new(surface),
            relax: RelaxSettings { offset, ..RelaxSettings::default() },
            edge_length,
        })
    }

    /// The source that the simulation builds the garment from.
    pub fn source(&self) -> GarmentSource {
        GarmentSource {
            pattern: Arc::clone(&self.pattern),
            marks: Arc::clone(&self.marks),
            edge_length: self.edge_length,
            relax: self.relax,
        }
    }

    /// Wraps `runs` times, at least once. `watch` is called with the index of the run as in [`Self::wrap_watched`]. Returns the
    /// median time in seconds, the hash of all runs, and the result of the last one. `name` is for the error when the hashes
    /// differ.
    pub fn wraps(
        &self,
        name: &str,
        runs: usize,
        mut watch: impl FnMut(usize, &Garment, &ClothState, f64),
    ) -> Result<(f64, String, Wrapped), Failure> {
        let mut wrap = |run| self.wrap_watched(|garment, state, seconds| watch(run, garment, state, seconds));
        let mut last = wrap(0)?;
        let (mut seconds, mut hashes) = (vec![last.seconds], vec![last.hash()]);
        for run in 1..runs {
            last = wrap(run)?;
            seconds.push(last.seconds);
            hashes.push(last.hash());
        }
        Ok((median(seconds), one_hash(name, &hashes)?, last))
    }

    /// Builds the garment from pattern and marks and wraps it until nothing moves.
    pub fn wrap(&self) -> Result<Wrapped, Failure> {
        self.wrap_watched(|_, _, _| ())
    }

    /// Wraps as [`Self::wrap`] does; `watch` is called after every tick with the cloth and the seconds taken so far, which do not
    /// include its own time.
    pub fn wrap_watched(
        &self,
        mut watch: impl FnMut(&Garment, &ClothState, f64),
    ) -> Result<Wrapped, Failure> {
        let start = Instant::now();
        let mut watched = Duration::ZERO;
        let garment = Arc::new(build(&self.pattern, self.edge_length).0);
        let coarser = match self.relax.skips.allow(Skip::Fine) {
            true => coarser(&self.pattern, &garment, self.edge_length, self.surface.scale()),
            false => Vec::new(),
        };
        let (dressing, mut state, _) = Dressing::coarse_to_fine(
            &coarser,
            Arc::clone(&garment),
            Arc::clone(&self.surface),
            &self.marks,
            self.relax,
        );
        let words = || "the garment is too large for this machine's memory".to_owned();
        let mut dressing = dressing.ok_or_else(|| Failure::Limit(words()))?;
        let build_seconds = start.elapsed().as_secs_f64();
        let mut grown = Counters::default();
        let mut ticks = 0;
        loop {
            interrupt::check()?;
            let phase = dressing.step(&mut state);
            ticks += 1;
            let now = Instant::now();
            watch(&garment, &state, (now - start - watched).as_secs_f64());
            watched += now.elapsed();
            match phase {
                Phase::AtRest => break,
                Phase::Growing => grown = dressing.counters(),
                Phase::Settling if ticks > MOST_TICKS => {
                    return Err(Failure::Limit(format!("the cloth still moves after {ticks} ticks")));
                }
                Phase::Settling => {}
            }
        }
        let seconds = (start.elapsed() - watched).as_secs_f64();
        Ok(Wrapped { garment, state, dressing, ticks, seconds, build_seconds, grown })
    }
}

impl Wrapped {
    /// Hash of the cloth's state.
    pub fn hash(&self) -> u64 {
        cloth_hash(&self.state, Some(Phase::AtRest), true)
    }
}

/// The edge length (metres) at which `pattern` has about `triangles` triangles.
pub fn edge_length(pattern: &Pattern, triangles: usize) -> f64 {
    (0..EDGE_STEPS).fold(FIRST_EDGE, |edge, _| {
        let got = build(pattern, edge).0.triangles.len();
        edge * (got as f64 / triangles as f64).sqrt()
    })
}

fn no_body() -> Failure {
    Failure::Internal("a body without triangles".to_owned())
}
