//! Garments on bodies to measure with, and how one is wrapped.

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

/// Edge length that a search for a number of triangles starts from, metres.
const FIRST_EDGE: f64 = 0.0125;
/// Steps of that search.
const EDGE_STEPS: usize = 3;
/// A wrap that is not at rest by then trembles.
const MOST_TICKS: u64 = 20_000;

/// A garment, where its marks are, and a body.
#[derive(Clone)]
pub struct Scene {
    pub pattern: Arc<Pattern>,
    pub marks: Arc<Marks>,
    pub surface: Arc<Surface>,
    pub relax: RelaxSettings,
    /// Metres.
    pub edge_length: f64,
}

/// A wrap that has come to rest.
pub struct Wrapped {
    pub garment: Arc<Garment>,
    pub state: ClothState,
    pub dressing: Dressing,
    pub ticks: u64,
    /// Wall-clock seconds, from pattern and marks on.
    pub seconds: f64,
    /// Those of them that went by before the first tick.
    pub build_seconds: f64,
    /// Work done before all cloth lay.
    pub grown: Counters,
}

impl Scene {
    /// A sample on the mannequin it was drafted for.
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

    /// The same cloth without weight: what is known exactly of a tube holds for that.
    pub fn weightless(self) -> Self {
        Self { relax: RelaxSettings { gravity: 0.0, ..self.relax }, ..self }
    }

    /// The same cloth with less or more work.
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

    /// What the simulation builds it from.
    pub fn source(&self) -> GarmentSource {
        GarmentSource {
            pattern: Arc::clone(&self.pattern),
            marks: Arc::clone(&self.marks),
            edge_length: self.edge_length,
            relax: self.relax,
        }
    }

    /// Wraps `runs` times, at least once; `watch` sees the cloth of each run after every tick, as [`Self::wrap_watched`] says.
    /// Returns the median seconds, the hash they all have, and the last one. `name` is said when the hashes differ.
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

    /// Wraps from pattern and marks until nothing moves.
    pub fn wrap(&self) -> Result<Wrapped, Failure> {
        self.wrap_watched(|_, _, _| ())
    }

    /// The same; `watch` sees the cloth after every tick, with the seconds taken so far. Its own time does not count.
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
    /// Of what moves.
    pub fn hash(&self) -> u64 {
        cloth_hash(&self.state, Some(Phase::AtRest), true)
    }
}

/// The edge length at which `pattern` has about `triangles` triangles, metres.
pub fn edge_length(pattern: &Pattern, triangles: usize) -> f64 {
    (0..EDGE_STEPS).fold(FIRST_EDGE, |edge, _| {
        let got = build(pattern, edge).0.triangles.len();
        edge * (got as f64 / triangles as f64).sqrt()
    })
}

fn no_body() -> Failure {
    Failure::Internal("a body without triangles".to_owned())
}
