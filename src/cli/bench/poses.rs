//! Benchmarks of carrying dressed cloth to other poses of the mannequin, and of computing maps of it.

use std::sync::Arc;
use std::time::Instant;

use crate::body::pose::rig;
use crate::body::{Measurements, NamedPose, Pose, Surface};
use crate::cli::bench::row::{Check, Figure, Row, Unit};
use crate::cli::bench::scenes::{Scene, Wrapped};
use crate::cli::bench::{median, one_hash};
use crate::cli::failure::Failure;
use crate::cli::interrupt;
use crate::cloth::ClothState;
use crate::fit::{MapKind, MapReader, Worn};
use crate::repose::{Outcome, ReposeSettings, Reposer};
use crate::session::Fabrics;
use crate::sim::hash::{Fnv, cloth_hash};
use crate::wrap::Phase;

/// Number of poses of the walk.
const FRAMES: usize = 12;

/// Measures one garment: a single pose, a walk, and maps.
pub fn poses(scene: &Scene, worn: &Wrapped, runs: usize) -> Result<[Row; 3], Failure> {
    let words = || Failure::Internal("the mannequin takes no pose".to_owned());
    let rig = rig(&Measurements::default()).map_err(|_| words())?;
    let skeleton = &rig.figure().skeleton;
    let walking = NamedPose::Walking.pose(skeleton);
    let body = |pose: &Pose| rig.posed(pose).map(|posed| posed.surface).ok_or_else(words);
    let built = body(&Pose::default())?;
    let pose_seconds = {
        let start = Instant::now();
        body(&walking)?;
        start.elapsed().as_secs_f64()
    };
    let frames: Vec<Arc<Surface>> = (0..FRAMES)
        .map(|i| (std::f64::consts::TAU * i as f64 / FRAMES as f64).sin())
        .map(|share| body(&Pose::default().towards(&walking, share.abs())))
        .collect::<Result<_, _>>()?;
    let reposer = || {
        Reposer::new(&worn.garment, Arc::clone(&built), worn.state.clone(), scene.relax)
            .ok_or_else(|| Failure::Internal("cloth that cannot be bound".to_owned()))
    };
    let start = Instant::now();
    reposer()?;
    let bind_seconds = start.elapsed().as_secs_f64();
    let mut one = carry(scene, worn, &reposer, &[body(&walking)?], ReposeSettings::THOROUGH, runs)?;
    one.scene = "re-pose of the T-shirt, to walking";
    one.figures.push(Figure { what: "to bind it, once", value: bind_seconds, unit: Unit::Seconds });
    one.figures.push(Figure { what: "to pose the mannequin", value: pose_seconds, unit: Unit::Seconds });
    let mut walk = carry(scene, worn, &reposer, &frames, ReposeSettings::LIVE, runs)?;
    walk.scene = "walk of the T-shirt, a frame";
    Ok([one, walk, maps(scene, worn, runs)?])
}

/// Carries the garment to `bodies`, one after the other, and measures each.
fn carry(
    scene: &Scene,
    worn: &Wrapped,
    reposer: &dyn Fn() -> Result<Reposer, Failure>,
    bodies: &[Arc<Surface>],
    care: ReposeSettings,
    runs: usize,
) -> Result<Row, Failure> {
    let (mut each, mut all, mut hashes) = (Vec::new(), Vec::new(), Vec::new());
    let mut worst = Outcome::default();
    for _ in 0..runs {
        let mut reposer = reposer()?;
        let (mut hash, mut sum) = (Fnv::default(), 0.0);
        for body in bodies {
            interrupt::check()?;
            let start = Instant::now();
            let done = reposer.reposed(body, care);
            let seconds = start.elapsed().as_secs_f64();
            let (state, outcome): (ClothState, Outcome) =
                done.ok_or_else(|| Failure::Internal("a pose of another body".to_owned()))?;
            each.push(seconds);
            sum += seconds;
            hash.number(cloth_hash(&state, Some(Phase::AtRest), true));
            worst.excess_p99 = worst.excess_p99.max(outcome.excess_p99);
            worst.inside = worst.inside.max(outcome.inside);
            worst.steps = worst.steps.max(outcome.steps);
            worst.substeps = worst.substeps.max(outcome.substeps);
        }
        all.push(sum);
        hashes.push(hash.finish());
    }
    // The limits of one pose are set for 3,000 and for 10,000 triangles; a frame of a sequence has 33 ms at 30 a second.
    let small = worn.garment.triangles.len() <= 5_000;
    let limits = match (bodies.len(), small) {
        (1, true) => [0.015, 0.004],
        (1, false) => [0.040, 0.012],
        _ => [0.033, 0.016],
    };
    let count = |what, value: usize| Figure { what, value: value as f64, unit: Unit::Count };
    Ok(Row {
        scene: "",
        triangles: worn.garment.triangles.len(),
        runs,
        seconds: median(all),
        threads: rayon::current_num_threads(),
        checks: vec![
            Check::new("a pose", median(each), Unit::Seconds, limits[0], limits[1]),
            Check::new("vertices inside, worst pose", worst.inside as f64, Unit::Count, 0.0, 0.0),
            Check::new("p99 strain in excess, worst pose", worst.excess_p99, Unit::Share, 0.01, 0.01),
        ],
        figures: vec![
            count("triangles of the body", scene.surface.mesh.triangles.len()),
            count("global steps, most", worst.steps),
            count("poses on the way, most", worst.substeps),
        ],
        counters: None,
        hash: one_hash("poses", &hashes)?,
    })
}

/// Computes all maps.
fn maps(scene: &Scene, worn: &Wrapped, runs: usize) -> Result<Row, Failure> {
    let fabrics = Fabrics::default().of(&scene.pattern);
    let shown = Worn {
        pattern: &scene.pattern,
        garment: &worn.garment,
        state: &worn.state,
        surface: &scene.surface,
        fabrics: &fabrics,
        offset: scene.relax.offset * scene.surface.scale(),
    };
    let (mut seconds, mut hashes) = (Vec::new(), Vec::new());
    let mut each = vec![Vec::new(); MapKind::ALL.len()];
    for _ in 0..runs {
        interrupt::check()?;
        let (mut hash, start) = (Fnv::default(), Instant::now());
        let reader = MapReader::new(shown);
        for (kind, each) in MapKind::ALL.into_iter().zip(&mut each) {
            let begun = Instant::now();
            let map = reader.map(kind);
            each.push(begun.elapsed().as_secs_f64());
            map.vertices.iter().for_each(|v| hash.number(v.to_bits()));
        }
        seconds.push(start.elapsed().as_secs_f64());
        hashes.push(hash.finish());
    }
    let seconds = median(seconds);
    let figures = MapKind::ALL.into_iter().zip(each);
    Ok(Row {
        scene: "all maps over the T-shirt",
        triangles: worn.garment.triangles.len(),
        runs,
        seconds,
        threads: rayon::current_num_threads(),
        checks: vec![Check::new("all of them", seconds, Unit::Seconds, 0.010, 0.003)],
        figures: figures
            .map(|(kind, each)| Figure { what: kind.title(), value: median(each), unit: Unit::Seconds })
            .collect(),
        counters: None,
        hash: one_hash("maps", &hashes)?,
    })
}
