//! Benchmarks of what a user waits for, against limits.

use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;

use crate::body::{Surface, mannequin};
use crate::cli::bench::drape::drape;
use crate::cli::bench::poses::poses;
use crate::cli::bench::row::{Check, Figure, Row, Unit};
use crate::cli::bench::scenes::{Scene, Wrapped, edge_length};
use crate::cli::bench::tube::{Errors, Tube};
use crate::cli::bench::{median, one_hash};
use crate::cli::failure::Failure;
use crate::cli::interrupt;
use crate::cloth::{ClothState, Counters, Skips};
use crate::drag::{DragMode, Dragging, Ray};
use crate::fit::{self, BodyIndex};
use crate::session::samples::Sample;
use crate::sim::hash::{Fnv, cloth_hash};
use crate::sim::{Request, RequestKind, Simulation};
use crate::wrap::Phase;

/// Length of the fast drag round the body, metres.
const DRAG_LENGTH: f64 = 0.3;
/// Number of ticks of the fast drag (0.2 s).
const DRAG_TICKS: u32 = 12;
/// Number of ticks for which the pointer then stays in place (0.5 s).
const WAIT_TICKS: u32 = 30;
/// Height of the dragged point below the top of the skirt, metres.
const DRAG_BELOW: f64 = 0.2;
/// Largest excess of the 99th percentile of strain over the exact solution's at which a tube is good enough for its user.
const GOOD: f64 = 0.01;
/// Number of closest-point queries in a run.
const QUERIES: usize = 100_000;
/// Range of offsets above the skin at which closest points are queried, metres.
const WORN: [f64; 2] = [0.004, 0.009];
/// Number of ticks at rest (10 s).
const IDLE_TICKS: u32 = 600;

/// Runs all scenes; `tell` is called with the row of each. Garments have about `triangles` triangles.
pub fn speed(
    triangles: usize,
    runs: usize,
    skips: Skips,
    mut tell: impl FnMut(&Row) -> Result<(), Failure>,
) -> Result<(), Failure> {
    tell(&cylinder(triangles, runs, skips)?)?;
    let body = mannequin::default();
    let shirt = Scene::sample(Sample::Tshirt, &body, triangles)?.skipping(skips);
    let (row, worn) = tshirt(&shirt, runs)?;
    tell(&row)?;
    let skirt = Scene::sample(Sample::Skirt, &body, triangles)?.skipping(skips);
    for row in drag(&skirt, runs)? {
        tell(&row)?;
    }
    tell(&closest(&shirt.surface, &worn.state, runs)?)?;
    tell(&idle(&shirt)?)?;
    let dress = Scene::sample(Sample::Dress, &body, triangles)?.skipping(skips);
    tell(&drape(&dress, runs, None)?)?;
    poses(&shirt, &worn, runs)?.iter().try_for_each(tell)
}

fn cylinder(triangles: usize, runs: usize, skips: Skips) -> Result<Row, Failure> {
    let scene_name = "wrap of a tube on a cylinder";
    let tube = Tube::new(1.0);
    let scene = Scene::tube(&tube, edge_length(&tube.pattern, triangles))?.skipping(skips);
    let mut exact = None;
    // Seconds since which each run has continuously been good; infinite while it is not.
    let mut good = vec![f64::INFINITY; runs.max(1)];
    let (seconds, hash, wrapped) = scene.wraps(scene_name, runs, |run, garment, state, seconds| {
        let exact = exact.get_or_insert_with(|| tube.exact(garment));
        let laid = state.mapped.iter().all(|&mapped| mapped);
        good[run] = match laid && Errors::new(garment, state, exact).excess <= GOOD {
            true => good[run].min(seconds),
            false => f64::INFINITY,
        };
    })?;
    let errors = Errors::new(&wrapped.garment, &wrapped.state, &tube.exact(&wrapped.garment));
    Ok(Row {
        scene: scene_name,
        triangles: wrapped.garment.triangles.len(),
        runs,
        seconds,
        threads: rayon::current_num_threads(),
        checks: vec![
            Check::new(
                "to p99 strain of 1 % in excess of the exact map's",
                median(good),
                Unit::Seconds,
                0.2,
                0.05,
            ),
            Check::new("in excess of it at rest", errors.excess, Unit::Share, 0.0005, 0.0005),
        ],
        figures: vec![
            Figure { what: "to rest, from pattern and marks", value: seconds, unit: Unit::Seconds },
            Figure { what: "p99 strain", value: errors.strain, unit: Unit::Share },
            Figure { what: "p99 strain of the exact map's chords", value: errors.chords, unit: Unit::Share },
            Figure {
                what: "farthest vertex from the exact map",
                value: errors.position / wrapped.garment.mean_edge(),
                unit: Unit::EdgeLengths,
            },
            Figure { what: "before the first tick", value: wrapped.build_seconds, unit: Unit::Seconds },
            Figure { what: "ticks", value: wrapped.ticks as f64, unit: Unit::Count },
        ],
        counters: Some(wrapped.dressing.counters()),
        hash,
    })
}

fn tshirt(scene: &Scene, runs: usize) -> Result<(Row, Wrapped), Failure> {
    let scene_name = "wrap of the T-shirt, to rest";
    let (seconds, hash, wrapped) = scene.wraps(scene_name, runs, |_, _, _, _| ())?;
    let fit = fit::measure(&scene.pattern, &wrapped.garment, &wrapped.state, &BodyIndex::new(&scene.surface));
    let (all, grown) = (wrapped.dressing.counters(), wrapped.grown);
    let checked = (all.contact_checks - grown.contact_checks).max(1);
    let queries = |c: &Counters| c.contact_queries + c.contact_gaps;
    let asked = queries(&all) - queries(&grown);
    let memory = wrapped.dressing.relaxer().map(|relaxer| relaxer.memory()).unwrap_or_default();
    let each = |bytes: usize| bytes as f64 / wrapped.garment.triangles.len().max(1) as f64;
    let bytes = |what, bytes| Figure { what, value: each(bytes), unit: Unit::Count };
    let row = Row {
        scene: scene_name,
        triangles: wrapped.garment.triangles.len(),
        runs,
        seconds,
        threads: rayon::current_num_threads(),
        checks: vec![
            Check::new("to rest, from pattern and marks", seconds, Unit::Seconds, 1.0, 0.25),
            Check::new("bytes of state a triangle", each(memory.state), Unit::Count, 200.0, 200.0),
        ],
        figures: vec![
            bytes("bytes of the garment a triangle", memory.garment),
            bytes("bytes of tables a triangle", memory.tables),
            bytes("bytes of scratch a triangle", memory.scratch),
            Figure { what: "p99 strain", value: fit.strain.p99, unit: Unit::Share },
            Figure {
                what: "closest points skipped while it settles",
                value: 1.0 - asked as f64 / checked as f64,
                unit: Unit::Share,
            },
            Figure { what: "before the first tick", value: wrapped.build_seconds, unit: Unit::Seconds },
            Figure { what: "ticks", value: wrapped.ticks as f64, unit: Unit::Count },
        ],
        counters: Some(all),
        hash,
    };
    Ok((row, wrapped))
}

/// The dragged vertex of a skirt, and the pointer's path round the body.
struct Hand {
    vertex: u32,
    axis: DVec3,
    start: f64,
    radius: f64,
}

impl Hand {
    /// The vertex at the front of the skirt, [`DRAG_BELOW`] under its top.
    fn new(cloth: &ClothState) -> Self {
        let top = cloth.positions.iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
        let y = top - DRAG_BELOW;
        let level = cloth.positions.iter().filter(|p| (p.y - y).abs() < DRAG_BELOW / 8.0);
        let (near, far) =
            level.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (p.z.min(a), p.z.max(b)));
        let axis = DVec3::new(0.0, y, (near + far) / 2.0);
        let front = DVec3::new(0.0, y, far);
        let distance = |v: &u32| cloth.positions[*v as usize].distance_squared(front);
        let count = cloth.positions.len() as u32;
        let vertex = (0..count).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or_default();
        let out = cloth.positions.get(vertex as usize).copied().unwrap_or(front) - axis;
        Self { vertex, axis, start: out.x.atan2(out.z), radius: out.x.hypot(out.z) }
    }

    /// The ray of the pointer after `tick` of [`DRAG_TICKS`] ticks, from outside towards the body's axis.
    fn pointer(&self, tick: u32) -> Ray {
        let share = f64::from(tick.min(DRAG_TICKS)) / f64::from(DRAG_TICKS);
        let angle = self.start + (DRAG_LENGTH / self.radius * share).min(TAU);
        let out = DVec3::new(angle.sin(), 0.0, angle.cos());
        Ray { origin: self.axis + out * 1.5, direction: -out }
    }

    fn take(&self, skirt: &Wrapped) -> Result<Dragging, Failure> {
        let words = || Failure::Internal("cloth at rest cannot be relaxed".to_owned());
        let relaxer = skirt.dressing.relaxer().ok_or_else(words)?.clone();
        Ok(Dragging::new(relaxer, &skirt.state, self.vertex, DVec3::ZERO, DragMode::Surface, &[]))
    }
}

fn drag(scene: &Scene, runs: usize) -> Result<[Row; 2], Failure> {
    let skirt = scene.wrap()?;
    let hand = Hand::new(&skirt.state);
    Ok([substeps(&skirt, &hand, runs)?, fast_drag(scene, &skirt, &hand)?])
}

/// Measures the time of a substep, with relaxation and contact, while the pointer moves.
fn substeps(skirt: &Wrapped, hand: &Hand, runs: usize) -> Result<Row, Failure> {
    let scene_name = "substep of dragging the skirt along the body";
    let (mut all, mut each, mut hashes, mut worst_tick) = (Vec::new(), Vec::new(), Vec::new(), 0.0f64);
    let (mut counters, mut before, mut done) = (Counters::default(), Counters::default(), 0);
    for _ in 0..runs {
        let mut dragging = hand.take(skirt)?;
        before = dragging.counters();
        let mut state = skirt.state.clone();
        let mut sum = 0.0;
        for tick in 1..=DRAG_TICKS {
            interrupt::check()?;
            dragging.drag_to(hand.pointer(tick));
            let (substeps, start) = (dragging.substeps(), Instant::now());
            dragging.step(&mut state, true);
            let seconds = start.elapsed().as_secs_f64();
            let count = dragging.substeps() - substeps;
            each.push(seconds / count.max(1) as f64);
            worst_tick = worst_tick.max(seconds);
            sum += seconds;
        }
        all.push(sum);
        (counters, done) = (dragging.counters(), dragging.substeps());
        hashes.push(cloth_hash(&state, Some(Phase::Settling), true));
    }
    let substep = median(each);
    let done = done as f64;
    let queries = |c: &Counters| c.contact_queries + c.contact_gaps;
    let asked = queries(&counters) - queries(&before);
    let checked = (counters.contact_checks - before.contact_checks).max(1);
    Ok(Row {
        scene: scene_name,
        triangles: skirt.garment.triangles.len(),
        runs,
        seconds: median(all),
        threads: rayon::current_num_threads(),
        checks: vec![Check::new("a substep, relaxed and in contact", substep, Unit::Seconds, 0.004, 0.001)],
        figures: vec![
            Figure { what: "substeps a tick", value: done / f64::from(DRAG_TICKS), unit: Unit::Count },
            Figure { what: "the longest tick", value: worst_tick, unit: Unit::Seconds },
            Figure {
                what: "factorisations a substep",
                value: (counters.factorisations - before.factorisations) as f64 / done.max(1.0),
                unit: Unit::Share,
            },
            Figure {
                what: "closest points skipped",
                value: 1.0 - asked as f64 / checked as f64,
                unit: Unit::Share,
            },
        ],
        counters: Some(counters),
        hash: one_hash(scene_name, &hashes)?,
    })
}

/// Checks the skirt at every tick of a fast drag, and after the pointer has stayed in place.
fn fast_drag(scene: &Scene, skirt: &Wrapped, hand: &Hand) -> Result<Row, Failure> {
    let index = BodyIndex::new(&scene.surface);
    let measured = |state: &ClothState| fit::measure(&scene.pattern, &skirt.garment, state, &index);
    let rest = measured(&skirt.state);
    let mut dragging = hand.take(skirt)?;
    let mut state = skirt.state.clone();
    let (mut flips, mut inside, mut worst, mut seconds) = (0, 0, 0.0f64, 0.0);
    let mut later = rest.clone();
    for tick in 1..=DRAG_TICKS + WAIT_TICKS {
        interrupt::check()?;
        dragging.drag_to(hand.pointer(tick));
        let start = Instant::now();
        dragging.step(&mut state, true);
        seconds += start.elapsed().as_secs_f64();
        later = measured(&state);
        flips = flips.max(later.flipped_faces);
        inside = inside.max(later.penetration.vertices);
        worst = worst.max(later.strain.p99);
    }
    let arrived = hand.pointer(DRAG_TICKS);
    let p = state.positions.get(hand.vertex as usize).copied().unwrap_or_default() - hand.axis;
    let lag = p.dot(arrived.direction.cross(DVec3::Y)).abs();
    let share = |what, value, solid, goal| Check::new(what, value, Unit::Share, solid, goal);
    Ok(Row {
        scene: "fast drag of the skirt, 0.3 m round the body in 0.2 s",
        triangles: skirt.garment.triangles.len(),
        runs: 1,
        seconds,
        threads: rayon::current_num_threads(),
        checks: vec![
            Check::new("faces wrong side out, worst tick", flips as f64, Unit::Count, 0.0, 0.0),
            Check::new("vertices inside, worst tick", inside as f64, Unit::Count, 0.0, 0.0),
            share("p99 strain, worst tick", worst, 0.03, 0.03),
            share("p99 strain, half a second later", later.strain.p99, 0.01, 0.01),
        ],
        figures: vec![
            Figure { what: "p99 strain at rest, before", value: rest.strain.p99, unit: Unit::Share },
            Figure {
                what: "in excess of that, worst tick",
                value: worst - rest.strain.p99,
                unit: Unit::Share,
            },
            Figure {
                what: "in excess of that, half a second later",
                value: later.strain.p99 - rest.strain.p99,
                unit: Unit::Share,
            },
            Figure {
                what: "faces wrong side out at rest, before",
                value: rest.flipped_faces as f64,
                unit: Unit::Count,
            },
            Figure {
                what: "the hand lags behind, half a second later",
                value: lag / skirt.garment.mean_edge(),
                unit: Unit::EdgeLengths,
            },
        ],
        counters: Some(dragging.counters()),
        hash: one_hash("fast drag", &[cloth_hash(&state, Some(Phase::Settling), true)])?,
    })
}

/// Measures closest-point queries with sign, from points over the skin where worn cloth is, on one core.
fn closest(surface: &Arc<Surface>, worn: &ClothState, runs: usize) -> Result<Row, Failure> {
    let scene_name = "closest point and sign, from worn cloth";
    let [low, high] = WORN;
    let points: Vec<DVec3> = (0..QUERIES)
        .zip(worn.positions.iter().cycle())
        .map(|(i, &p)| {
            let near = surface.nearest(p);
            near.point + near.normal * (low + (high - low) * (i % 101) as f64 / 100.0)
        })
        .collect();
    let (mut seconds, mut hashes) = (Vec::new(), Vec::new());
    for _ in 0..runs {
        interrupt::check()?;
        let start = Instant::now();
        let sum: f64 = points.iter().map(|&p| surface.nearest(p).distance).sum();
        seconds.push(start.elapsed().as_secs_f64());
        let mut hash = Fnv::default();
        hash.number(sum.to_bits());
        hashes.push(hash.finish());
    }
    let seconds = median(seconds);
    let rate = points.len() as f64 / seconds;
    Ok(Row {
        scene: scene_name,
        triangles: surface.mesh.triangles.len(),
        runs,
        seconds,
        threads: 1,
        checks: vec![Check::new("closest points, one core", rate, Unit::PerSecond, 0.7e6, 1.5e6)],
        figures: vec![Figure { what: "points in a run", value: points.len() as f64, unit: Unit::Count }],
        counters: None,
        hash: one_hash(scene_name, &hashes)?,
    })
}

/// Checks that the simulation does no work when nothing moves.
fn idle(scene: &Scene) -> Result<Row, Failure> {
    let mut simulation = Simulation::default();
    simulation.set_skips(scene.relax.skips);
    let kind = RequestKind::Wrap { source: Arc::new(scene.source()), body: Arc::clone(&scene.surface) };
    simulation.apply(Request { seq: 1, checkpoint: false, kind });
    while simulation.tick() {
        interrupt::check()?;
    }
    let before = simulation.snapshot().stats;
    let start = Instant::now();
    (0..IDLE_TICKS).for_each(|_| {
        simulation.tick();
    });
    let seconds = start.elapsed().as_secs_f64();
    let snapshot = simulation.snapshot();
    let steps = snapshot.stats.ticks - before.ticks + (snapshot.stats.work.solves - before.work.solves);
    Ok(Row {
        scene: "T-shirt at rest for 600 ticks",
        triangles: snapshot.garment.as_ref().map_or(0, |g| g.triangles.len()),
        runs: 1,
        seconds,
        threads: rayon::current_num_threads(),
        checks: vec![Check::new("steps", steps as f64, Unit::Count, 0.0, 0.0)],
        figures: Vec::new(),
        counters: None,
        hash: one_hash("rest", &[simulation.hash()])?,
    })
}
