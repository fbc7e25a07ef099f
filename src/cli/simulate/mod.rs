//! `toile simulate`: simulates any cloth mesh, for comparison with other programs.

pub mod scene;
pub mod times;

use std::time::Instant;

use glam::DVec3;
use serde::Serialize;

use crate::cli::arguments::Simulate;
use crate::cli::failure::Failure;
use crate::cli::simulate::scene::{Loaded, MembraneChoice, SceneFile};
use crate::cli::simulate::times::cpu_seconds;
use crate::cli::{interrupt, output};
use crate::drape::solver::newton::Work;
use crate::drape::{Collider, Drape, DrapeSettings, Integrator, Method, State};

/// Default strain limit, in addition to the fabric's own strain.
const STRAIN: f64 = 0.01;
/// Largest size of all frames' positions, bytes; they are kept in memory until the end.
const MOST_BYTES: u64 = 4 << 30;
/// Tolerance of implicit steps, relative to an edge length.
const ACCURACY: f64 = 1e-4;

/// The contents of simulate.json.
#[derive(Debug, Serialize)]
struct Report {
    frames: usize,
    vertices: usize,
    triangles: usize,
    fps: f64,
    fabric: String,
    solver: String,
    /// The membrane model that was used.
    membrane: MembraneChoice,
    build_s: f64,
    /// Processor seconds of each frame; null where the system does not tell. Fields that end in `_in_all` are the sums of all
    /// frames.
    cpu_s: Vec<Option<f64>>,
    wall_s: Vec<f64>,
    cpu_s_in_all: Option<f64>,
    wall_s_in_all: f64,
    /// Largest force (N) on a vertex after the last frame that is not balanced by its acceleration; null for small steps.
    residual_n: Option<f64>,
    steps_not_converged: u64,
    edge_strain: Strain,
    counters: Work,
}

/// Strain of the edges at the end.
#[derive(Debug, Default, Serialize)]
struct Strain {
    p99: f64,
    max: f64,
    rms: f64,
}

/// Runs the simulation and writes positions.f32 and simulate.json.
pub fn simulate(arguments: &Simulate) -> Result<(), Failure> {
    let path = &arguments.scene;
    let begun = Instant::now();
    let Loaded { file, mut scene, positions, fabric, thickness, bodies } = scene::load(path)?;
    let size = 12 * positions.len() as u64 * (file.frames() as u64 + 1);
    if size > MOST_BYTES {
        let (path, frames, vertices) = (path.display(), file.frames(), positions.len());
        return Err(Failure::Limit(format!(
            "{path}: {frames} frames of {vertices} vertices are {size} bytes, at most {MOST_BYTES} are written"
        )));
    }
    if let Some(first) = bodies.first() {
        scene.collider = Some(Collider::still(scene::surface(path, first)?));
    }
    let settings = DrapeSettings {
        method: file.solver.map(Into::into),
        strain: file.strain.unwrap_or(STRAIN),
        thickness,
        friction: fabric.friction,
        self_collision: file.self_collision,
        integrator: file.integrator.map_or(Integrator::Bdf2, Into::into),
        stiffness: (fabric.stretch.warp * fabric.stretch.weft).sqrt(),
        accuracy: ACCURACY,
    };
    let step = 1.0 / (file.fps * f64::from(file.steps_per_frame));
    let mut bytes = Vec::new();
    write_positions(&mut bytes, &positions);
    let mut drape = Drape::new(scene, State::at_rest(positions), settings, step)
        .map_err(|e| Failure::Limit(format!("{}: {e}", path.display())))?;
    let build_s = begun.elapsed().as_secs_f64();
    let frames = file.frames();
    let (mut cpu_s, mut wall_s) = (Vec::new(), Vec::new());
    for frame in 0..frames {
        output::progress(&format!("frame {} of {frames}", frame + 1));
        let (wall, cpu) = (Instant::now(), cpu_seconds());
        for part in 1..=file.steps_per_frame {
            interrupt::check()?;
            let done = (
                frame as f64 + f64::from(part) / f64::from(file.steps_per_frame),
                f64::from(file.steps_per_frame),
            );
            move_body(arguments, &bodies, &mut drape, done)?;
            drape
                .step(step)
                .map_err(|e| Failure::Check(format!("{}: frame {frame}: {e}", path.display())))?;
        }
        wall_s.push(wall.elapsed().as_secs_f64());
        cpu_s.push(cpu.and_then(|before| cpu_seconds().map(|now| now - before)));
        write_positions(&mut bytes, &drape.state().positions);
    }
    output::progress("");
    let report = report(&file, fabric.name, &drape, build_s, (cpu_s, wall_s));
    let text = serde_json::to_string_pretty(&report).map_err(|e| Failure::Internal(e.to_string()))?;
    output::make_folder(&arguments.out)?;
    let into = |name: &str, bytes: Vec<u8>| (arguments.out.join(name), bytes);
    output::write_together(&[into("positions.f32", bytes), into("simulate.json", text.into_bytes())])?;
    output::say(&format!(
        "{}: {frames} frames of {} triangles by {}, {:.3} s, p99 edge strain {:.2} %",
        path.display(),
        report.triangles,
        report.solver,
        report.wall_s_in_all,
        report.edge_strain.p99 * 100.0
    ));
    Ok(())
}

/// The report on a simulation; `cpu_s` and `wall_s` are the processor and wall-clock seconds of each frame.
fn report(
    file: &SceneFile,
    fabric: String,
    drape: &Drape,
    build_s: f64,
    (cpu_s, wall_s): (Vec<Option<f64>>, Vec<f64>),
) -> Report {
    let residual_n = (drape.method() == Method::Implicit).then(|| drape.residual());
    Report {
        frames: file.frames() + 1,
        vertices: drape.scene.sheet.len(),
        triangles: drape.scene.sheet.triangles.len(),
        fps: file.fps,
        fabric,
        solver: drape.chosen(),
        membrane: match drape.method() {
            Method::Implicit => file.membrane,
            Method::SmallSteps => MembraneChoice::Springs,
        },
        build_s,
        cpu_s_in_all: cpu_s.iter().copied().sum(),
        wall_s_in_all: wall_s.iter().sum(),
        cpu_s,
        wall_s,
        residual_n,
        steps_not_converged: drape.unconverged(),
        edge_strain: strain(drape),
        counters: drape.work(),
    }
}

/// Moves the body to its interpolated position after `done` frames, with the motion of the last 1/`parts` frame; after its last
/// frame it stays.
fn move_body(
    arguments: &Simulate,
    bodies: &[crate::geometry::mesh::TriMesh],
    drape: &mut Drape,
    (done, parts): (f64, f64),
) -> Result<(), Failure> {
    let Some(last) = bodies.len().checked_sub(1).filter(|&last| last > 0) else { return Ok(()) };
    let at = |t: f64| -> Vec<DVec3> {
        let t = t.clamp(0.0, last as f64);
        let (from, share) = ((t as usize).min(last - 1), t - (t as usize).min(last - 1) as f64);
        let ends = bodies[from].positions.iter().zip(&bodies[from + 1].positions);
        ends.map(|(a, b)| a.lerp(*b, share)).collect()
    };
    let (now, before) = (at(done), at(done - 1.0 / parts));
    let motion: Vec<DVec3> = now.iter().zip(&before).map(|(a, b)| *a - *b).collect();
    if drape.scene.collider.as_ref().is_some_and(|c| c.motion.is_empty())
        && motion.iter().all(|m| *m == DVec3::ZERO)
    {
        return Ok(());
    }
    let mesh = crate::geometry::mesh::TriMesh { positions: now, triangles: bodies[0].triangles.clone() };
    drape.scene.collider = Some(Collider { surface: scene::surface(&arguments.scene, &mesh)?, motion });
    Ok(())
}

fn write_positions(bytes: &mut Vec<u8>, positions: &[DVec3]) {
    bytes.extend(positions.iter().flat_map(|x| x.to_array()).flat_map(|v| (v as f32).to_le_bytes()));
}

fn strain(drape: &Drape) -> Strain {
    let (sheet, x) = (&drape.scene.sheet, &drape.state().positions);
    let of = |(e, &[a, b]): (usize, &[u32; 2])| {
        (x[a as usize].distance(x[b as usize]) / sheet.rest_length(e) - 1.0).abs()
    };
    let mut strains: Vec<f64> = sheet.adjacency.edges.iter().enumerate().map(of).collect();
    strains.sort_unstable_by(f64::total_cmp);
    let count = strains.len();
    Strain {
        p99: strains[(count * 99 / 100).min(count - 1)],
        max: strains[count - 1],
        rms: (strains.iter().map(|s| s * s).sum::<f64>() / count as f64).sqrt(),
    }
}
