//! A tube dress sewn round a torso from two panels, one in front of it and one behind.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use crate::body::Surface;
use crate::cli::bench::row::{Check, Figure, Row, Unit};
use crate::cli::bench::scenes::edge_length;
use crate::cli::bench::{median, one_hash};
use crate::cli::failure::Failure;
use crate::cli::interrupt;
use crate::cli::simulate::times::Stopwatch;
use crate::cloth::Fabric;
use crate::fit::{self, BodyIndex};
use crate::geometry::mesh::TriMesh;
use crate::geometry::shapes;
use crate::pattern::{EdgeRef, Pattern, Piece, Seam, SpacePose};
use crate::relax::RelaxSettings;
use crate::sim::{DrapeSource, GarmentSource, Request, RequestKind, Simulation};
use crate::wrap::Phase;

/// Width and height of each panel, metres: together wider than the waist of the torso and narrower than its hips.
const PANEL: DVec2 = DVec2::new(0.46, 0.6);
/// Distance between the panels, metres.
const APART: f64 = 0.3;
/// Height of the panels' lower edge, metres.
const LOW: f64 = 0.3;
/// Height of the torso, metres.
const HEIGHT: f64 = 1.2;
/// Half the width and half the depth of the torso at the waist, metres; it is wider above and below.
const WAIST: [f64; 2] = [0.165, 0.115];
/// Limit of ticks; dressing that takes longer has failed.
const MOST_TICKS: u64 = 3000;
/// Limits of the processor time until the dress is on, seconds, by size: acceptable and good.
const LIMITS: [[f64; 2]; 3] = [[0.5, 0.12], [0.5, 0.37], [5.0, 0.5]];
const NAMES: [&str; 3] =
    ["dress round a torso, a tenth", "dress round a torso", "dress round a torso, four times"];

/// Measures the dress at `sizes`, which are approximate numbers of triangles.
pub fn torso(
    sizes: [usize; 3],
    runs: usize,
    mut tell: impl FnMut(Row) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let body = Arc::new(Surface::new(body()).ok_or_else(|| internal("a torso without a surface"))?);
    for ((size, limits), name) in sizes.into_iter().zip(LIMITS).zip(NAMES) {
        tell(row(name, &body, (size, runs), limits)?)?;
    }
    Ok(())
}

fn internal(words: &str) -> Failure {
    Failure::Internal(words.to_owned())
}

/// The torso, with 25,856 triangles.
pub fn body() -> TriMesh {
    let mut mesh = shapes::cylinder(1.0, HEIGHT, 128, 100);
    for x in &mut mesh.positions {
        let wide = 1.05 - 0.05 * (TAU * (x.y - 0.65) / 0.8).cos();
        (x.x, x.z) = (x.x * WAIST[0] * wide, x.z * WAIST[1] * wide);
    }
    mesh
}

/// Two panels, placed in front of the torso and behind it.
pub fn pattern() -> Pattern {
    let corners = [DVec2::ZERO, PANEL.with_y(0.0), PANEL, PANEL.with_x(0.0)];
    let mut pattern = Pattern::default();
    let [front, back] = [("front", 0.0), ("back", TAU / 2.0)].map(|(name, turn)| {
        let rotation = DQuat::from_rotation_y(turn);
        let translation = rotation * DVec3::new(-PANEL.x / 2.0, LOW, APART / 2.0);
        let placement = Some(SpacePose::flat(translation, rotation));
        pattern.add_piece(Piece { placement, ..Piece::polygon(name, &corners) })
    });
    for (edge, other) in [(1, 3), (3, 1)] {
        let sides = [EdgeRef { piece: front, edge }, EdgeRef { piece: back, edge: other }];
        pattern.add_seam(Seam::of_edges(sides, false));
    }
    pattern
}

fn row(
    scene: &'static str,
    body: &Arc<Surface>,
    (size, runs): (usize, usize),
    [solid, goal]: [f64; 2],
) -> Result<Row, Failure> {
    let pattern = Arc::new(pattern());
    let fabric = Fabric::preset(Fabric::USUAL).ok_or_else(|| internal("there is no cotton"))?.clone();
    let fabrics = Arc::new(DrapeSource { fabric, of_pieces: BTreeMap::new(), strain: 0.01 });
    let source = Arc::new(GarmentSource {
        edge_length: edge_length(&pattern, size),
        pattern: Arc::clone(&pattern),
        marks: Arc::default(),
        relax: RelaxSettings::default(),
    });
    let (mut wall, mut sewn, mut rested, mut hashes) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut last = None;
    for _ in 0..runs.max(1) {
        let mut watch = Stopwatch::default();
        let mut simulation = Simulation::default();
        let kind = RequestKind::Sew {
            source: Arc::clone(&source),
            body: Arc::clone(body),
            fabrics: Arc::clone(&fabrics),
        };
        watch.time(|| simulation.apply(Request { seq: 1, checkpoint: false, kind }));
        let mut until_sewn = None;
        while !simulation.is_at_rest() && simulation.ticks() < MOST_TICKS {
            interrupt::check()?;
            watch.time(|| simulation.tick());
            if simulation.phase() != Some(Phase::Growing) && until_sewn.is_none() {
                until_sewn = Some(watch.processor());
            }
        }
        sewn.push(until_sewn.unwrap_or(f64::NAN));
        rested.push(watch.processor());
        wall.push(watch.wall());
        hashes.push(simulation.hash());
        last = Some(simulation);
    }
    let simulation = last.ok_or_else(|| internal("no run was made"))?;
    let snapshot = simulation.snapshot();
    let (garment, cloth) = snapshot.drawn().ok_or_else(|| internal("the dress was not sewn"))?;
    let report = fit::measure(&pattern, garment, cloth, &BodyIndex::new(body));
    let count = |what, value: usize| Figure { what, value: value as f64, unit: Unit::Count };
    Ok(Row {
        scene,
        triangles: garment.triangles.len(),
        runs,
        seconds: median(wall),
        threads: rayon::current_num_threads(),
        checks: vec![
            Check::new("processor time until it is sewn", median(sewn), Unit::Seconds, solid, goal),
            Check::new("p99 strain at rest", report.strain.p99, Unit::Share, 0.01, 0.01),
            Check::new("edges through the body", report.edges_through_body as f64, Unit::Count, 0.0, 0.0),
            Check::new("self crossings", report.self_crossings as f64, Unit::Count, 0.0, 0.0),
            Check::new("open seams", report.seams.open as f64, Unit::Count, 0.0, 0.0),
        ],
        figures: vec![
            Figure { what: "processor time until it rests", value: median(rested), unit: Unit::Seconds },
            Figure { what: "largest strain", value: report.strain.max, unit: Unit::Share },
            count("ticks until it rests", simulation.ticks() as usize),
        ],
        counters: Some(snapshot.stats.work),
        hash: one_hash(scene, &hashes)?,
    })
}
