//! A sheet of cloth that swings on two pins, and one that falls on a ball. Other programs were measured with the same scenes.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::body::Surface;
use crate::cli::bench::row::{Check, Figure, Row, Unit};
use crate::cli::bench::{median, one_hash};
use crate::cli::failure::Failure;
use crate::cli::interrupt;
use crate::cli::simulate::times::Stopwatch;
use crate::cloth::Fabric;
use crate::drape::{Collider, Drape, DrapeSettings, Elastic, Integrator, Method, Scene, Sheet, State};
use crate::geometry::crossings::self_crossings;
use crate::geometry::mesh::TriMesh;
use crate::geometry::shapes;
use crate::sim::hash::Fnv;

/// Frames per second.
const FPS: f64 = 60.0;
/// Number of frames of a run.
const FRAMES: usize = 120;
/// Number of frames after which the sheet on pins is compared with implicit steps.
const SWUNG: usize = 30;
/// Number of frames after which the sheet over the ball is compared with free fall; it does not touch the ball yet.
const FALLEN: usize = 5;
/// Density of the cloth, kg/m².
const DENSITY: f64 = 0.2;
/// Gravity, downward, m/s².
const GRAVITY: f64 = 9.81;
/// Nearly inextensible cloth: stretch stiffness (N/m), Poisson's ratio, bending stiffness (N·m).
const STIFFNESS: (f64, f64, f64) = (5000.0, 0.3, 4e-5);
/// Distance that the cloth keeps from the ball and from itself, metres.
const THICKNESS: f64 = 3e-3;
/// Radius of the ball, metres.
const RADIUS: f64 = 0.3;
/// Height of the sheet above the ball at the start, metres.
const ABOVE: f64 = 0.05;

/// A scene with a sheet of 1 m².
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scenario {
    /// The sheet is released flat, with two corners pinned.
    Swings,
    /// The sheet is dropped 5 cm on a ball, where it touches itself.
    Falls,
}

/// Limits of the processor time for each second of the sheet's motion, seconds, at 1,000, 10,000 and 40,000 triangles: the time
/// of the best other accurate program, and our goal. No other program finished with 40,000.
const LIMITS: [(Scenario, [(f64, f64); 3]); 2] = [
    (Scenario::Swings, [(0.21, 0.04), (7.7, 0.8), (5.0, 5.0)]),
    (Scenario::Falls, [(0.136, 0.06), (12.8, 1.2), (8.0, 8.0)]),
];

/// Names of both scenarios at the three sizes.
const NAMES: [[&str; 3]; 2] = [
    ["sheet on two pins, a tenth", "sheet on two pins", "sheet on two pins, four times"],
    ["sheet on a ball, a tenth", "sheet on a ball", "sheet on a ball, four times"],
];

/// Measures both scenarios at `sizes`, which are approximate numbers of triangles.
pub fn sheets(
    sizes: [usize; 3],
    runs: usize,
    mut tell: impl FnMut(Row) -> Result<(), Failure>,
) -> Result<(), Failure> {
    for ((scenario, limits), names) in LIMITS.into_iter().zip(NAMES) {
        let reference = match scenario {
            Scenario::Swings => {
                Some(fall_after(&mut Run::new(scenario, sizes[0], Some(Method::Implicit))?, SWUNG)?)
            }
            Scenario::Falls => None,
        };
        for ((size, limits), name) in sizes.into_iter().zip(limits).zip(names) {
            tell(row(name, scenario, (size, runs), limits, reference)?)?;
        }
    }
    Ok(())
}

/// A running simulation of a sheet.
struct Run {
    drape: Drape,
    start: Vec<DVec3>,
    /// Largest depth of a vertex in the ball after any frame, metres; negative outside.
    deepest: f64,
}

impl Run {
    fn new(scenario: Scenario, triangles: usize, method: Option<Method>) -> Result<Self, Failure> {
        let (sheet, start) = flat(triangles)?;
        let (stretch, poisson, bending) = STIFFNESS;
        let mut fabric = Fabric::isotropic(stretch, poisson, bending, DENSITY);
        fabric.thickness_m = THICKNESS;
        let last = start.len() - 1;
        let side = (start.len() as f64).sqrt().round() as usize;
        let swings = scenario == Scenario::Swings;
        let pinned = (0..=last).map(|v| swings && (v == 0 || v == side - 1)).collect();
        let collider = match scenario {
            Scenario::Swings => None,
            Scenario::Falls => Some(Collider::still(Arc::new(ball()?))),
        };
        let scene = Scene {
            elastic: Elastic::new(&sheet, &fabric, 0.1),
            mass: sheet.vertex_area.iter().map(|a| a * DENSITY).collect(),
            sheet,
            pinned,
            gravity: DVec3::NEG_Y * GRAVITY,
            damping: 0.0,
            collider,
        };
        let settings = DrapeSettings {
            method,
            strain: 0.01,
            thickness: THICKNESS,
            friction: fabric.friction,
            self_collision: !swings,
            integrator: Integrator::Bdf2,
            stiffness: stretch,
            accuracy: 1e-4,
        };
        let drape = Drape::new(scene, State::at_rest(start.clone()), settings, 1.0 / FPS)
            .map_err(|e| Failure::Limit(e.to_string()))?;
        Ok(Self { drape, start, deepest: f64::NEG_INFINITY })
    }

    fn frame(&mut self) -> Result<(), Failure> {
        interrupt::check()?;
        self.drape.step(1.0 / FPS).map_err(|e| Failure::Internal(e.to_string()))
    }

    /// Updates `deepest` with the current positions.
    fn look(&mut self) {
        if self.drape.scene.collider.is_some() {
            let depth = |x: &DVec3| RADIUS - x.length();
            let deepest = self.drape.state().positions.iter().map(depth).fold(f64::NEG_INFINITY, f64::max);
            self.deepest = self.deepest.max(deepest);
        }
    }

    /// Mean height lost since the start, metres.
    fn fall(&self) -> f64 {
        let lost = self.start.iter().zip(&self.drape.state().positions).map(|(from, to)| from.y - to.y);
        lost.sum::<f64>() / self.start.len() as f64
    }

    /// 99th percentile and maximum of the edges' strain |l / l0 - 1|.
    fn strain(&self) -> (f64, f64) {
        let (sheet, x) = (&self.drape.scene.sheet, &self.drape.state().positions);
        let of = |(e, &[a, b]): (usize, &[u32; 2])| {
            (x[a as usize].distance(x[b as usize]) / sheet.rest_length(e) - 1.0).abs()
        };
        let mut strains: Vec<f64> = sheet.adjacency.edges.iter().enumerate().map(of).collect();
        strains.sort_unstable_by(f64::total_cmp);
        (strains[strains.len() * 99 / 100], strains[strains.len() - 1])
    }

    fn crossings(&self) -> usize {
        let sheet = &self.drape.scene.sheet;
        let positions = self.drape.state().positions.clone();
        let mesh = TriMesh { positions, triangles: sheet.triangles.clone() };
        self_crossings(&mesh, &sheet.adjacency.edges, &mesh.tree()).len()
    }

    fn hash(&self) -> u64 {
        let mut hash = Fnv::default();
        self.drape.state().positions.iter().for_each(|x| hash.point(*x));
        hash.finish()
    }
}

fn fall_after(run: &mut Run, frames: usize) -> Result<f64, Failure> {
    (0..frames).try_for_each(|_| run.frame())?;
    Ok(run.fall())
}

fn row(
    scene: &'static str,
    scenario: Scenario,
    (size, runs): (usize, usize),
    (solid, goal): (f64, f64),
    reference: Option<f64>,
) -> Result<Row, Failure> {
    let (mut wall, mut processor, mut hashes) = (Vec::new(), Vec::new(), Vec::new());
    let (mut last, mut early) = (None, 0.0);
    let when = if scenario == Scenario::Swings { SWUNG } else { FALLEN };
    for _ in 0..runs.max(1) {
        let mut run = Run::new(scenario, size, None)?;
        let mut watch = Stopwatch::default();
        for frame in 1..=FRAMES {
            watch.time(|| run.frame())?;
            run.look();
            if frame == when {
                early = run.fall();
            }
        }
        wall.push(watch.wall());
        processor.push(watch.processor() / (FRAMES as f64 / FPS));
        hashes.push(run.hash());
        last = Some(run);
    }
    let run = last.ok_or_else(|| Failure::Internal("no run was made".to_owned()))?;
    let (p99, largest) = run.strain();
    // For free fall the exact distance is known: g t² / 2.
    let exact = reference.unwrap_or(GRAVITY * (FALLEN as f64 / FPS).powi(2) / 2.0);
    let what = match scenario {
        Scenario::Swings => "fall in half a second against implicit steps",
        Scenario::Falls => "free fall against the exact one",
    };
    let off = Check::new(what, (early / exact - 1.0).abs(), Unit::Share, 0.03, 0.01);
    let mut checks = vec![
        Check::new("processor time for a second of it", median(processor), Unit::Seconds, solid, goal),
        Check::new("p99 strain", p99, Unit::Share, 0.01, 0.01),
        off,
    ];
    if scenario == Scenario::Falls {
        let crossings = run.crossings() as f64;
        checks.push(Check::new("deepest in the ball in any frame", run.deepest, Unit::Metres, 5e-4, 5e-4));
        checks.push(Check::new("self crossings at the end", crossings, Unit::Count, 0.0, 0.0));
    }
    let work = run.drape.work();
    let count = |what, value: u64| Figure { what, value: value as f64, unit: Unit::Count };
    Ok(Row {
        scene,
        triangles: run.drape.scene.sheet.triangles.len(),
        runs,
        seconds: median(wall),
        threads: rayon::current_num_threads(),
        checks,
        figures: vec![
            Figure { what: "largest strain", value: largest, unit: Unit::Share },
            count("small steps a frame, 0: implicit", run.drape.substeps() as u64),
            count("nearest points of the ball looked up", work.queries),
            count("vertices known to be far without", work.skipped_queries),
            count("pairs of cloth and cloth looked at", work.self_pairs),
            count("known not to touch in a small step", work.skipped_self_pairs),
        ],
        counters: None,
        hash: one_hash(scene, &hashes)?,
    })
}

/// A square of 1 m² of about `triangles` triangles, above the ball; the diagonals of its cells alternate.
fn flat(triangles: usize) -> Result<(Sheet, Vec<DVec3>), Failure> {
    let cells = ((triangles as f64 / 2.0).sqrt().round() as u32).max(2);
    let at = |k: u32| f64::from(k) / f64::from(cells);
    let points: Vec<DVec2> =
        (0..=cells).flat_map(|j| (0..=cells).map(move |i| DVec2::new(at(i), at(j)))).collect();
    let corner = |i: u32, j: u32| j * (cells + 1) + i;
    let mut corners = Vec::new();
    for (i, j) in (0..cells).flat_map(|j| (0..cells).map(move |i| (i, j))) {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        corners.extend(if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
    }
    let rest = corners.iter().map(|vs| vs.map(|v| points[v as usize])).collect();
    let height = RADIUS + ABOVE;
    let start = points.iter().map(|p| DVec3::new(p.x - 0.5, height, 0.5 - p.y)).collect();
    let sheet = Sheet::new(points.len(), corners, rest).map_err(|e| Failure::Internal(e.to_string()))?;
    Ok((sheet, start))
}

/// The ball, with 20,480 triangles.
fn ball() -> Result<Surface, Failure> {
    Surface::new(shapes::icosphere(RADIUS, 5))
        .ok_or_else(|| Failure::Internal("a ball without a surface".to_owned()))
}
