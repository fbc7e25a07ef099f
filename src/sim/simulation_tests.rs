use std::collections::BTreeMap;

use glam::DVec3;

use super::*;
use crate::body::Surface;
use crate::cloth::Fabric;
use crate::drag::{DragMode, Ray};
use crate::fit::Moved;
use crate::geometry::mesh::TriMesh;
use crate::pattern::{Pattern, Piece, SpacePose};
use crate::relax::RelaxSettings;
use crate::sim::source::DrapeSource;
use crate::sim::source::{ClothPlace, GarmentSource};
use crate::sim::start::StartChoice;
use crate::wrap::{BodyMark, ClothMark, Marks};

pub(in crate::sim) fn ball() -> Arc<Surface> {
    // An octahedron, 1.5 m from corner to corner.
    let corner = |axis: usize, sign: f64| DVec3::AXES[axis] * (0.75 * sign);
    let positions = vec![
        corner(0, 1.0),
        corner(0, -1.0),
        corner(1, 1.0),
        corner(1, -1.0),
        corner(2, 1.0),
        corner(2, -1.0),
    ];
    let mut triangles = Vec::new();
    for (x, y, z) in (0..8).map(|i| (i & 1, 2 + ((i >> 1) & 1), 4 + ((i >> 2) & 1))) {
        let flipped = (x + y + z) % 2 == 1;
        triangles.push(if flipped { [x, z, y] } else { [x, y, z] });
    }
    Arc::new(Surface::new(TriMesh { positions, triangles }).expect("an octahedron"))
}

pub(in crate::sim) fn source() -> Arc<GarmentSource> {
    let corners = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.1), (0.0, 0.1)].map(glam::DVec2::from);
    let mut pattern = Pattern::default();
    let piece = pattern.add_piece(Piece::polygon("patch", &corners));
    let marks = Marks {
        cloth: vec![ClothMark {
            id: crate::geometry::ids::MarkId(1),
            piece,
            side: Default::default(),
            points: vec![(0.05, 0.05).into(), (0.15, 0.05).into()],
        }],
        body: vec![BodyMark {
            id: crate::geometry::ids::MarkId(2),
            points: vec![DVec3::new(0.2, 0.25, 0.3), DVec3::new(0.3, 0.25, 0.2)],
        }],
        ..Marks::default()
    };
    Arc::new(GarmentSource {
        pattern: Arc::new(pattern),
        marks: Arc::new(marks),
        edge_length: 0.05,
        relax: RelaxSettings::default(),
    })
}

fn request(seq: u64, kind: RequestKind) -> Request {
    Request { seq, checkpoint: true, kind }
}

fn wrapped() -> Simulation {
    let mut simulation = Simulation::default();
    simulation.apply(request(1, RequestKind::Wrap { source: source(), body: ball() }));
    assert!(!simulation.is_at_rest(), "{:?}", simulation.world.problems);
    simulation
}

fn failures(simulation: &mut Simulation) -> Vec<Words> {
    let events = simulation.take_events().into_iter();
    events.filter_map(|e| if let Event::Failed { words, .. } = e { Some(words) } else { None }).collect()
}

#[test]
fn the_octahedron_is_outward() {
    assert!(ball().mesh.volume() > 0.0);
}

#[test]
fn a_wrap_comes_to_rest_and_then_no_tick_counts() {
    let mut simulation = wrapped();
    while simulation.tick() {}
    let ticks = simulation.ticks();
    assert!(ticks > 0 && !simulation.tick() && simulation.ticks() == ticks);
    let snapshot = simulation.snapshot();
    assert!(snapshot.is_dressed() && snapshot.cloth.mapped.iter().all(|&m| m));
    assert_eq!(snapshot.phase, Some(Phase::AtRest));
    let hashes = simulation.take_events().into_iter().filter(|e| matches!(e, Event::Hash { .. })).count();
    assert_eq!(hashes, 1);
}

#[test]
fn a_restore_goes_on_bit_for_bit() {
    let mut simulation = wrapped();
    simulation.tick();
    let mut after = Vec::new();
    simulation.apply(request(2, RequestKind::SetRelax(RelaxSettings::default())));
    for _ in 0..5 {
        simulation.tick();
        after.push(simulation.hash());
    }
    simulation.apply(request(3, RequestKind::Restore { before_seq: 2 }));
    let again: Vec<u64> = (0..5)
        .map(|_| {
            simulation.tick();
            simulation.hash()
        })
        .collect();
    assert_eq!(after, again);
    simulation.apply(request(4, RequestKind::Restore { before_seq: 1 }));
    assert_eq!(simulation.hash(), Simulation::default().hash());
}

#[test]
fn a_number_that_is_none_is_taken_back_and_told() {
    let mut simulation = wrapped();
    simulation.tick();
    simulation.apply(request(2, RequestKind::SetRelaxing(true)));
    let before = simulation.snapshot();
    Arc::make_mut(&mut simulation.world.cloth).positions[0].x = f64::NAN;
    simulation.tick();
    let words = failures(&mut simulation);
    assert!(words.len() == 1 && words[0].contains("finite"), "{words:?}");
    assert!(simulation.is_at_rest(), "paused");
    assert_eq!(simulation.snapshot().cloth, before.cloth);
    simulation.apply(request(3, RequestKind::SetRelaxing(true)));
    assert!(simulation.tick(), "and it can go on");
}

#[test]
fn a_panic_in_a_step_is_taken_back_and_told() {
    let mut simulation = wrapped();
    Arc::make_mut(&mut simulation.world.cloth).positions.truncate(1);
    simulation.tick();
    let words = failures(&mut simulation);
    assert!(words.len() == 1 && words[0].contains("index out of bounds"), "{words:?}");
    assert!(simulation.world.garment.is_none(), "before the wrap there was none");
}

#[test]
fn cloth_of_another_size_is_not_adopted() {
    let mut simulation = wrapped();
    let before = simulation.hash();
    let kind =
        RequestKind::Adopt { source: source(), body: ball(), cloth: Arc::default(), moved: Moved::Wrapped };
    simulation.apply(request(2, kind));
    let words = failures(&mut simulation);
    assert!(words[0].contains("0 vertices"), "{words:?}");
    simulation.world.relaxing = true;
    assert_eq!(simulation.hash(), before);
}

#[test]
fn the_oldest_checkpoints_go_first() {
    let mut simulation = Simulation::with_memory(100_000);
    for seq in 1..=20 {
        simulation.apply(request(seq, RequestKind::Wrap { source: source(), body: ball() }));
    }
    let forgotten = simulation.take_events().into_iter().filter_map(|e| match e {
        Event::Forgotten { before_seq } => Some(before_seq),
        _ => None,
    });
    let forgotten: Vec<u64> = forgotten.collect();
    assert!(forgotten.is_sorted() && forgotten.last().is_some_and(|&s| s > 2 && s <= 20), "{forgotten:?}");
    simulation.apply(request(21, RequestKind::Restore { before_seq: 1 }));
    assert!(failures(&mut simulation)[0].contains("no longer kept"));
    simulation.apply(request(22, RequestKind::Restore { before_seq: 20 }));
    assert!(failures(&mut simulation).is_empty());
}

#[test]
fn cloth_that_lies_still_is_looked_at_once() {
    assert!(!Simulation::default().judge(), "there is nothing to look at");
    let mut simulation = wrapped();
    if simulation.tick() {
        assert!(!simulation.judge(), "it is moving");
    }
    while simulation.tick() {}
    let hash = simulation.hash();
    assert!(simulation.judge() && !simulation.judge(), "looked at not once");
    assert!(simulation.snapshot().verdict.is_some());
    assert_eq!(simulation.hash(), hash);
    simulation.apply(request(9, RequestKind::SetRelaxing(false)));
    assert!(simulation.snapshot().verdict.is_none(), "an old verdict on what may have changed");
    assert!(simulation.snapshot().tight.is_empty());
}

pub(in crate::sim) fn cotton() -> Arc<DrapeSource> {
    let fabric = Fabric::preset("cotton").cloned().expect("a preset");
    Arc::new(DrapeSource { fabric, of_pieces: BTreeMap::new(), strain: 0.01 })
}

/// The patch, placed before the ball.
fn placed() -> Arc<GarmentSource> {
    let mut source = source();
    let pattern = Arc::make_mut(&mut Arc::make_mut(&mut source).pattern);
    for piece in pattern.pieces.values_mut() {
        let turn = glam::DQuat::from_rotation_y(std::f64::consts::FRAC_PI_4);
        Arc::make_mut(piece).placement = Some(SpacePose::flat(DVec3::new(0.2, 0.25, 0.5), turn));
    }
    source
}

/// Every kind of work that takes several ticks, by name, one tick into it.
fn stages() -> Vec<(&'static str, Simulation)> {
    let piece = *source().pattern.pieces.keys().next().expect("a piece");
    let at = ClothPlace { piece, at: (0.1, 0.05).into() };
    let moved = || {
        let mut mesh = ball().mesh.clone();
        mesh.positions.iter_mut().for_each(|p| p.x += 0.01);
        Arc::new(Surface::new(mesh).expect("an octahedron"))
    };
    let lying: [(&str, Vec<RequestKind>); 5] = [
        ("relaxing", vec![RequestKind::SetRelax(RelaxSettings { stretch: 0.3, ..RelaxSettings::default() })]),
        (
            "in the hand",
            vec![
                RequestKind::Grab { at, mode: DragMode::Surface, bones: Arc::default() },
                RequestKind::DragTo(Ray {
                    origin: DVec3::new(2.0, 0.3, 2.0),
                    direction: DVec3::new(-1.0, 0.0, -1.1),
                }),
            ],
        ),
        ("draping", vec![RequestKind::SetDraping { on: true, source: cotton() }]),
        ("draped for some ticks", vec![RequestKind::StepDraping { ticks: 5, source: cotton() }]),
        (
            "in another pose",
            vec![RequestKind::Repose {
                body: moved(),
                marks: Arc::default(),
                settle: true,
                draft: false,
                fabrics: cotton(),
            }],
        ),
    ];
    let mut stages = vec![("wrapping", wrapped())];
    for (name, requests) in lying {
        let mut simulation = wrapped();
        while simulation.tick() {}
        (2..).zip(requests).for_each(|(seq, kind)| simulation.apply(request(seq, kind)));
        stages.push((name, simulation));
    }
    let (source, fabrics) = (placed(), cotton());
    let all: [(&str, RequestKind); 2] = [
        ("sewing", RequestKind::Sew { source: source.clone(), body: ball(), fabrics: fabrics.clone() }),
        (
            "trying starts",
            RequestKind::Dress { source, body: ball(), built: None, fabrics, choice: StartChoice::default() },
        ),
    ];
    for (name, kind) in all {
        let mut simulation = Simulation::default();
        simulation.apply(request(1, kind));
        stages.push((name, simulation));
    }
    for (name, simulation) in &mut stages {
        assert!(simulation.tick(), "{name} takes more than a tick");
        assert_eq!(failures(simulation), [""; 0], "{name}");
    }
    stages
}

/// Whatever happens to the numbers of a stage: it ends or is taken back, the cloth is where finite points are, and other work
/// can be begun.
#[test]
fn every_stage_survives_numbers_that_are_none_and_panics() {
    for damage in ["not a number", "infinite", "too few"] {
        for (name, mut simulation) in stages() {
            let cloth = Arc::make_mut(&mut simulation.world.cloth);
            match damage {
                "not a number" => cloth.positions.iter_mut().for_each(|p| p.y = f64::NAN),
                "infinite" => cloth.positions[0].x = f64::INFINITY,
                _ => cloth.positions.truncate(1),
            }
            // Starts that break down make room for others.
            let most = if name == "trying starts" { 20_000 } else { 3 };
            (0..most).take_while(|_| simulation.tick()).for_each(drop);
            let told = failures(&mut simulation);
            assert!(told.len() <= 1, "{name}, {damage}: {told:?}");
            let snapshot = simulation.snapshot();
            let count = snapshot.garment.as_ref().map_or(0, |garment| garment.vertex_count);
            assert_eq!(snapshot.cloth.positions.len(), count, "{name}, {damage}: {told:?}");
            assert!(snapshot.cloth.positions.iter().all(|p| p.is_finite()), "{name}, {damage}: {told:?}");
            simulation.apply(request(9, RequestKind::Wrap { source: source(), body: ball() }));
            while simulation.tick() {}
            assert!(
                failures(&mut simulation).is_empty() && simulation.snapshot().is_dressed(),
                "{name}, {damage}"
            );
        }
    }
}
