//! The longest tick of every stage. A cancel or another request may have to wait for one tick.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::DVec3;

use crate::body::pose::rig;
use crate::body::{Measurements, NamedPose, Pose, Surface, mannequin};
use crate::cli::bench::one_hash;
use crate::cli::bench::row::{Check, Figure, Row, Unit};
use crate::cli::bench::scenes::{Scene, edge_length};
use crate::cli::bench::torso;
use crate::cli::failure::Failure;
use crate::cli::interrupt;
use crate::cli::simulate::times::Stopwatch;
use crate::cloth::{Fabric, FlatPiece, Skips};
use crate::drag::{DragMode, Ray};
use crate::pattern::Pattern;
use crate::relax::RelaxSettings;
use crate::session::samples::Sample;
use crate::sim::{ClothPlace, DrapeSource, GarmentSource, Request, RequestKind, Simulation};
use crate::wrap::{Marks, Phase};

/// Limits of a tick, seconds: acceptable, and good.
const LIMITS: [f64; 2] = [0.2, 0.1];
/// Limit of ticks: cloth that still moves then oscillates.
const MOST_TICKS: usize = 20_000;
/// Number of ticks of the drag.
const DRAG_TICKS: usize = 30;
/// Length of the drag along the body, metres.
const DRAG_LENGTH: f64 = 0.3;

/// Runs each garment with about `triangles` triangles `runs` times and calls `tell` with its row; the longest tick of all runs
/// counts.
pub fn ticks(
    triangles: usize,
    runs: usize,
    skips: Skips,
    mut tell: impl FnMut(&Row) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let body = mannequin::default();
    let sample = |sample| Ok::<_, Failure>(Scene::sample(sample, &body, triangles)?.skipping(skips));
    let shirt = sample(Sample::Tshirt)?;
    tell(&row("ticks of the T-shirt: wrapped, re-posed, carried back", runs, |watch| {
        reposed(&shirt, watch)
    })?)?;
    let skirt = sample(Sample::Skirt)?;
    tell(&row("ticks of the skirt: wrapped and dragged", runs, |watch| dragged(&skirt, watch))?)?;
    let dress = sample(Sample::Dress)?;
    tell(&row("ticks of the dress: wrapped, draped and recut", runs, |watch| draped(&dress, watch))?)?;
    tell(&row("ticks of a dress sewn round a torso", runs, |watch| sewn(triangles, watch))?)
}

/// Runs a simulation and keeps the longest tick or request of each stage.
#[derive(Default)]
struct Watch {
    simulation: Simulation,
    seq: u64,
    /// For each stage the largest wall-clock time and the largest processor time of a tick or request, seconds.
    longest: BTreeMap<&'static str, [f64; 2]>,
    seconds: f64,
    triangles: usize,
}

impl Watch {
    fn note(&mut self, stage: &'static str, watch: &Stopwatch) {
        let [wall, processor] = self.longest.entry(stage).or_default();
        *wall = wall.max(watch.wall());
        *processor = processor.max(watch.processor());
        self.seconds += watch.wall();
    }

    /// Applies a request and counts its time for `stage`.
    fn ask(&mut self, stage: &'static str, kind: RequestKind) -> Result<(), Failure> {
        interrupt::check()?;
        self.seq += 1;
        let request = Request { seq: self.seq, checkpoint: false, kind };
        let mut watch = Stopwatch::default();
        watch.time(|| self.simulation.apply(request));
        self.note(stage, &watch);
        Ok(())
    }

    /// Runs a tick and counts its time for the stage that `stage` gives for the phase.
    fn tick(&mut self, stage: impl Fn(Option<Phase>) -> &'static str) -> Result<(), Failure> {
        interrupt::check()?;
        let stage = stage(self.simulation.phase());
        let mut watch = Stopwatch::default();
        watch.time(|| self.simulation.tick());
        self.note(stage, &watch);
        Ok(())
    }

    /// Runs ticks until nothing moves, then judges the cloth as the window does.
    fn rest(&mut self, stage: impl Fn(Option<Phase>) -> &'static str) -> Result<(), Failure> {
        for _ in 0..MOST_TICKS {
            if self.simulation.is_at_rest() {
                break;
            }
            self.tick(&stage)?;
        }
        let mut watch = Stopwatch::default();
        watch.time(|| self.simulation.judge());
        self.note("looking at what is wrong with it", &watch);
        let triangles = self.simulation.snapshot().garment.map_or(0, |garment| garment.triangles.len());
        self.triangles = self.triangles.max(triangles);
        Ok(())
    }
}

/// The stage of a wrap, by its phase.
fn wrapping(phase: Option<Phase>) -> &'static str {
    if phase == Some(Phase::Growing) { "growing" } else { "settling" }
}

fn row(
    scene: &'static str,
    runs: usize,
    run: impl Fn(&mut Watch) -> Result<(), Failure>,
) -> Result<Row, Failure> {
    let mut all: Vec<Watch> = Vec::new();
    for _ in 0..runs.max(1) {
        let mut watch = Watch::default();
        run(&mut watch)?;
        all.push(watch);
    }
    let stages: BTreeSet<&'static str> = all.iter().flat_map(|watch| watch.longest.keys().copied()).collect();
    let longest = |stage: &str, k: usize| {
        let of_runs = all.iter().filter_map(|watch| watch.longest.get(stage));
        of_runs.map(|longest| longest[k]).fold(0.0, f64::max)
    };
    let [solid, goal] = LIMITS;
    let check = |&stage: &&'static str| Check::new(stage, longest(stage, 0), Unit::Seconds, solid, goal);
    // Processor time of all cores, which other programs on the machine do not lengthen as they do wall-clock time.
    let processor =
        |&stage: &&'static str| Figure { what: stage, value: longest(stage, 1), unit: Unit::Seconds };
    let ticks = Figure {
        what: "ticks",
        value: all.iter().map(|watch| watch.simulation.ticks()).max().unwrap_or_default() as f64,
        unit: Unit::Count,
    };
    let hashes: Vec<u64> = all.iter().map(|watch| watch.simulation.hash()).collect();
    Ok(Row {
        scene,
        triangles: all.iter().map(|watch| watch.triangles).max().unwrap_or_default(),
        runs,
        seconds: super::median(all.iter().map(|watch| watch.seconds).collect()),
        threads: rayon::current_num_threads(),
        checks: stages.iter().map(check).collect(),
        figures: stages.iter().map(processor).chain([ticks]).collect(),
        counters: None,
        hash: one_hash(scene, &hashes)?,
    })
}

fn wrapped(scene: &Scene, watch: &mut Watch) -> Result<(), Failure> {
    watch.simulation.set_skips(scene.relax.skips);
    let kind = RequestKind::Wrap { source: Arc::new(scene.source()), body: Arc::clone(&scene.surface) };
    watch.ask("building it", kind)?;
    watch.rest(wrapping)
}

fn reposed(scene: &Scene, watch: &mut Watch) -> Result<(), Failure> {
    wrapped(scene, watch)?;
    let words = || internal("the mannequin takes no pose");
    let rig = rig(&Measurements::default()).map_err(|_| words())?;
    let walking = NamedPose::Walking.pose(&rig.figure().skeleton);
    for pose in [walking, Pose::default()] {
        let body = rig.posed(&pose).ok_or_else(words)?.surface;
        let marks = Arc::clone(&scene.marks);
        let kind = RequestKind::Repose { body, marks, fabrics: fabrics()?, settle: true, draft: false };
        watch.ask("re-posing it", kind)?;
        watch.rest(wrapping)?;
    }
    Ok(())
}

fn dragged(scene: &Scene, watch: &mut Watch) -> Result<(), Failure> {
    wrapped(scene, watch)?;
    let snapshot = watch.simulation.snapshot();
    let garment = snapshot.garment.as_ref().ok_or_else(|| internal("no skirt"))?;
    let piece = garment.pieces.first().ok_or_else(|| internal("a skirt without a piece"))?.0;
    let corners: Vec<_> = garment.corners.iter().filter(|corner| corner.piece == piece).collect();
    let middle = corners.iter().map(|corner| corner.uv).sum::<glam::DVec2>() / corners.len().max(1) as f64;
    let place = FlatPiece::new(garment, piece).nearest(garment, middle);
    let from = place.and_then(|place| place.point(garment, &snapshot.cloth));
    let from = from.ok_or_else(|| internal("the hand finds no cloth"))?;
    let at = ClothPlace { piece, at: middle };
    let grab = RequestKind::Grab { at, mode: DragMode::Surface, bones: Arc::default() };
    watch.ask("taking it in the hand", grab)?;
    let out = DVec3::new(from.x, 0.0, from.z).normalize_or(DVec3::Z);
    for tick in 1..=DRAG_TICKS {
        let way = DVec3::Y.cross(out) * (DRAG_LENGTH * tick as f64 / DRAG_TICKS as f64);
        let ray = Ray { origin: from + way + out * 1.5, direction: -out };
        watch.ask("taking it in the hand", RequestKind::DragTo(ray))?;
        watch.tick(|_| "dragging")?;
    }
    watch.ask("letting it go", RequestKind::Release)?;
    watch.rest(wrapping)
}

fn fabrics() -> Result<Arc<DrapeSource>, Failure> {
    let fabric = Fabric::preset(Fabric::USUAL).ok_or_else(|| internal("there is no cotton"))?.clone();
    Ok(Arc::new(DrapeSource { fabric, of_pieces: BTreeMap::new(), strain: 0.01 }))
}

fn draped(scene: &Scene, watch: &mut Watch) -> Result<(), Failure> {
    wrapped(scene, watch)?;
    watch.ask("beginning to drape", RequestKind::SetDraping { on: true, source: fabrics()? })?;
    watch.rest(|_| "draping")?;
    let (pattern, marks) = (Arc::new(Pattern::clone(&scene.pattern)), Arc::new(Marks::clone(&scene.marks)));
    let kind = RequestKind::Resew { pattern, marks, pins: Arc::default(), carried: Arc::default() };
    watch.ask("cutting it anew", kind)?;
    watch.rest(wrapping)
}

fn sewn(triangles: usize, watch: &mut Watch) -> Result<(), Failure> {
    let pattern = Arc::new(torso::pattern());
    let body = Surface::new(torso::body()).ok_or_else(|| internal("a torso without a surface"))?;
    let source = GarmentSource {
        edge_length: edge_length(&pattern, triangles),
        pattern,
        marks: Arc::default(),
        relax: RelaxSettings::default(),
    };
    let kind = RequestKind::Sew { source: Arc::new(source), body: Arc::new(body), fabrics: fabrics()? };
    watch.ask("placing it", kind)?;
    watch.rest(|phase| if phase == Some(Phase::Growing) { "sewing" } else { "draping" })
}

fn internal(words: &str) -> Failure {
    Failure::Internal(words.to_owned())
}
