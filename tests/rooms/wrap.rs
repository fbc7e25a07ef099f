//! Wrapping against exact answers.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use toile::body::Surface;
use toile::cloth::{ClothState, Garment, build};
use toile::pattern::Pattern;
use toile::relax::RelaxSettings;
use toile::wrap::roots::roots;
use toile::wrap::{Dressing, Marks, Phase, coarser, stretches};

use crate::common::exact::{cylinder, lowest, quantile, strains, tube, tube_marks};

const RADIUS: f64 = 0.15;
const OFFSET: f64 = 0.004;

fn settings(surface: &Surface) -> RelaxSettings {
    RelaxSettings { offset: OFFSET / surface.scale(), ..RelaxSettings::default() }
}

fn dressed(pattern: &Pattern, marks: &Marks, edge: f64) -> (Arc<Garment>, Arc<Surface>, ClothState, usize) {
    let (garment, problems) = build(pattern, edge);
    assert!(problems.is_empty(), "{problems:?}");
    let surface = Arc::new(Surface::new(cylinder(RADIUS, 1.0, 128, 60)).expect("a body"));
    let garment = Arc::new(garment);
    let (dressing, mut state, problems) =
        Dressing::new(garment.clone(), surface.clone(), marks, settings(&surface));
    assert!(problems.is_empty(), "{problems:?}");
    let mut dressing = dressing.expect("a dressing");
    let mut ticks = 0;
    while dressing.step(&mut state) != Phase::AtRest {
        ticks += 1;
        assert!(ticks < 1000);
    }
    (garment, surface, state, ticks)
}

#[test]
fn a_tube_that_fits_wraps_a_cylinder_without_strain() {
    // As long round as the offset surface: B11.
    let width = std::f64::consts::PI * (RADIUS + OFFSET);
    let pattern = tube(width, 0.5);
    let marks = tube_marks(&pattern, width, 0.5, RADIUS, 0.25);
    let (garment, surface, state, ticks) = dressed(&pattern, &marks, 0.02);
    let strains = strains(&garment, &state);
    println!("ticks {ticks} p99 {} max {}", quantile(&strains, 0.99), quantile(&strains, 1.0));
    assert!(state.mapped.iter().all(|&m| m));
    assert!(quantile(&strains, 0.99) < 0.005, "p99 strain {}", quantile(&strains, 0.99));
    assert!(lowest(&surface, &state) > 0.5 * OFFSET, "lowest {}", lowest(&surface, &state));
}

/// The fast path, coarse to fine, and the plain one come to lie in the same place.
#[test]
fn coarse_to_fine_ends_where_one_mesh_does() {
    let width = std::f64::consts::PI * (RADIUS + OFFSET);
    let pattern = tube(width, 0.5);
    let marks = tube_marks(&pattern, width, 0.5, RADIUS, 0.25);
    let edge = 0.01;
    let (garment, surface, plain, ticks) = dressed(&pattern, &marks, edge);
    let coarser = coarser(&pattern, &garment, edge, surface.scale());
    assert!(!coarser.is_empty());
    let (dressing, mut fast, problems) =
        Dressing::coarse_to_fine(&coarser, garment.clone(), surface.clone(), &marks, settings(&surface));
    assert!(problems.is_empty(), "{problems:?}");
    let mut dressing = dressing.expect("a dressing");
    let fast_ticks = (0..1000).take_while(|_| dressing.step(&mut fast) != Phase::AtRest).count();
    println!("{ticks} ticks at once, {fast_ticks} coarse to fine");
    for state in [&plain, &fast] {
        assert!(quantile(&strains(&garment, state), 0.99) < 0.005);
    }
    let apart = plain.positions.iter().zip(&fast.positions).map(|(a, b)| (*a - *b).length());
    assert!(apart.fold(0.0, f64::max) < edge, "they lie up to an edge apart");
}

/// Its back laid upside down over its front, a tube crosses itself however it grows.
#[test]
fn plans_whose_faults_do_not_get_fewer_are_given_up_and_the_best_comes_to_rest() {
    let width = std::f64::consts::PI * (RADIUS + OFFSET);
    let pattern = tube(width, 0.5);
    let (garment, _) = build(&pattern, 0.03);
    let surface = Arc::new(Surface::new(cylinder(RADIUS, 1.0, 64, 30)).expect("a body"));
    // Numbers of steps for which each plan settled.
    let settled = |marks: &Marks| {
        let (dressing, mut state, problems) =
            Dressing::new(Arc::new(garment.clone()), surface.clone(), marks, settings(&surface));
        assert!(problems.is_empty(), "{problems:?}");
        let (mut dressing, mut runs) = (dressing.expect("a dressing"), vec![0]);
        for _ in 0..5000 {
            match dressing.step(&mut state) {
                Phase::Settling => *runs.last_mut().expect("a run") += 1,
                Phase::Growing if runs.last() != Some(&0) => runs.push(0),
                Phase::Growing => {}
                Phase::AtRest => return runs,
            }
        }
        panic!("never at rest: {runs:?}")
    };
    let good = tube_marks(&pattern, width, 0.5, RADIUS, 0.25);
    let mut crossed = good.clone();
    crossed.body[1].points = good.body[0].points.iter().rev().copied().collect();
    let (good, crossed) = (settled(&good), settled(&crossed));
    println!("{good:?} {crossed:?}");
    assert_eq!((good.len(), crossed.len()), (1, 4), "number of plans that are tried");
    assert!(crossed.iter().any(|&steps| steps < 300), "one is given up");
    assert!(crossed.iter().any(|&steps| steps > 400), "what still changes is not");
}

#[test]
fn a_loose_tube_closes_round_a_cylinder() {
    let width = 1.2 * std::f64::consts::PI * RADIUS;
    let pattern = tube(width, 0.4);
    let marks = tube_marks(&pattern, width, 0.4, RADIUS, 0.3);
    let (garment, surface, state, ticks) = dressed(&pattern, &marks, 0.02);
    let strains = strains(&garment, &state);
    println!("ticks {ticks} p99 {} max {}", quantile(&strains, 0.99), quantile(&strains, 1.0));
    assert!(quantile(&strains, 0.99) < 0.02);
    assert!(lowest(&surface, &state) > 0.0);
}

/// A tube, its marks and a cylinder of `round` flat facets.
fn tube_on_prism(round: u32) -> (Garment, Surface, Marks, f64) {
    let width = std::f64::consts::PI * RADIUS;
    let pattern = tube(width, 0.5);
    let marks =
        tube_marks(&pattern, width, 0.5, RADIUS * (std::f64::consts::PI / f64::from(round)).cos(), 0.25);
    let (garment, _) = build(&pattern, 0.02);
    let surface = Surface::new(cylinder(RADIUS, 1.0, round, 60)).expect("a body");
    (garment, surface, marks, width)
}

#[test]
fn root_edges_keep_their_angle_and_length_round_a_cylinder() {
    let round = 96;
    let (garment, surface, mut marks, _) = tube_on_prism(round);
    // The stroke runs down the middle of a facet, so that facets and arc lengths agree.
    let half = std::f64::consts::PI / f64::from(round);
    let turn = |p: DVec3| glam::DQuat::from_rotation_y(half) * p;
    for mark in &mut marks.body {
        mark.points.iter_mut().for_each(|p| *p = turn(*p));
    }
    let (roots, stretches, problems) = roots(&garment, &surface, &marks, OFFSET);
    assert!(problems.is_empty(), "{problems:?}");
    assert!(roots.len() > 100);
    assert!(stretches.iter().all(|s| s.stretch().abs() < 1e-9), "{stretches:?}");
    let facet = 2.0 * RADIUS * half.sin();
    let front = &marks.cloth[0];
    for root in &roots {
        let corner = garment.corners.iter().find(|c| c.vertex == root.vertex && c.piece == front.piece);
        let Some(corner) = corner else { continue };
        let along = corner.uv.x - front.points[0].x;
        let skin = surface.nearest(root.position);
        assert!((skin.distance - OFFSET).abs() < 1e-6);
        assert!(
            (skin.point.y - (corner.uv.y + 0.25)).abs() < 0.02 * 1e-4,
            "{} {}",
            skin.point.y,
            corner.uv.y
        );
        // Way round from the stroke, measured along the facets.
        let angle = skin.point.x.atan2(skin.point.z) - half;
        let whole = (angle / (2.0 * half)).round();
        let middle = turn(
            glam::DQuat::from_rotation_y(whole * 2.0 * half) * DVec3::new(0.0, 0.0, RADIUS * half.cos()),
        );
        let tangent = DVec3::Y.cross(middle).normalize();
        let round_way = whole * facet + (skin.point - middle).dot(tangent);
        assert!((round_way - along).abs() < 0.02 * 1e-4, "{round_way} {along}");
    }
}

#[test]
fn stretches_are_known_before_cloth_is_cut() {
    let (garment, surface, mut marks, _) = tube_on_prism(64);
    assert_eq!(stretches(&marks, &surface, OFFSET), roots(&garment, &surface, &marks, OFFSET).1);
    let middle = marks.cloth[0].points.iter().sum::<DVec2>() / marks.cloth[0].points.len() as f64;
    marks.cloth[0].points.iter_mut().for_each(|p| *p = middle + (*p - middle) / 1.1);
    marks.cloth[1].points.truncate(1);
    let found = stretches(&marks, &surface, OFFSET);
    assert!((found[0].stretch() - 0.1).abs() < 1e-3 && found[0].is_large(), "{found:?}");
    assert!(found[1].stretch() == 0.0 && !found[1].is_large(), "a point has no stretch");
    marks.body[0].points.clear();
    assert_eq!(stretches(&marks, &surface, OFFSET).len(), 1);
}

/// A level stroke round a cylinder is as long as the circle the cloth lies on, not as the skin.
#[test]
fn a_stretch_is_that_of_the_offset_surface() {
    let (_, surface, mut marks, _) = tube_on_prism(256);
    let offset = 0.012;
    marks.body[0].points = (0..=40)
        .map(|i| glam::DQuat::from_rotation_y(f64::from(i) * 0.025) * DVec3::new(0.0, 0.5, RADIUS))
        .collect();
    marks.cloth[0].points = vec![DVec2::new(0.1, 0.2), DVec2::new(0.1 + RADIUS, 0.2)];
    let found = stretches(&marks, &surface, offset)[0];
    assert!((found.stretch() - offset / RADIUS).abs() < 1e-3, "{found:?}");
}

#[test]
fn marks_without_a_partner_or_off_their_piece_are_named() {
    let (garment, surface, mut marks, _) = tube_on_prism(64);
    marks.body.pop();
    let (_, _, problems) = roots(&garment, &surface, &marks, OFFSET);
    assert_eq!(problems.len(), 1);
    assert!(problems[0].place.contains("mark 2") && problems[0].words.contains("body"));
    marks.cloth[0].points.iter_mut().for_each(|p| *p += DVec2::X * 5.0);
    let (roots, _, problems) = roots(&garment, &surface, &marks, OFFSET);
    assert!(roots.is_empty());
    assert!(problems.iter().any(|p| p.words.contains("off its piece")));
}

#[test]
fn a_point_mark_lays_one_triangle_upright() {
    let (garment, surface, mut marks, _) = tube_on_prism(64);
    marks.cloth.truncate(1);
    marks.body.truncate(1);
    marks.cloth[0].points.truncate(1);
    marks.body[0].points.truncate(1);
    let (roots, _, problems) = roots(&garment, &surface, &marks, OFFSET);
    assert!(problems.is_empty());
    assert_eq!(roots.len(), 3);
    for root in &roots {
        let corner = garment.corners.iter().find(|c| c.vertex == root.vertex).expect("a corner");
        let up = corner.uv.y - marks.cloth[0].points[0].y;
        assert!((root.position.y - marks.body[0].points[0].y - up).abs() < 1e-3);
    }
}

#[test]
fn strokes_of_no_sense_end_well() {
    let (garment, surface, good, _) = tube_on_prism(64);
    let breakages: [fn(&mut Marks); 5] = [
        |m| m.cloth[0].points.clear(),
        |m| m.body[0].points.clear(),
        |m| m.cloth[0].points[3] = DVec2::NAN,
        |m| m.body[0].points = vec![DVec3::splat(1e9), DVec3::splat(-1e9)],
        |m| m.cloth[0].points.reverse(),
    ];
    for broken in breakages {
        let mut marks = good.clone();
        broken(&mut marks);
        let (roots, _, _) = roots(&garment, &surface, &marks, OFFSET);
        assert!(roots.iter().all(|r| r.position.is_finite()));
    }
}

#[test]
fn without_marks_nothing_is_laid() {
    let (garment, surface, _, _) = tube_on_prism(32);
    let (dressing, mut state, _) =
        Dressing::new(Arc::new(garment), Arc::new(surface), &Marks::default(), RelaxSettings::default());
    let mut dressing = dressing.expect("a dressing");
    assert_eq!(dressing.step(&mut state), Phase::AtRest);
    assert!(state.mapped.iter().all(|m| !m));
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let width = 1.1 * std::f64::consts::PI * RADIUS;
            let pattern = tube(width, 0.4);
            let marks = tube_marks(&pattern, width, 0.4, RADIUS, 0.3);
            dressed(&pattern, &marks, 0.025).2.positions
        })
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(8));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Whatever strokes a hand paints, the wrap ends, and every position is a number near the body.
    #[test]
    fn any_strokes_end_well(
        flat in proptest::collection::vec(proptest::array::uniform2(-0.1..0.6f64), 2..6),
        solid in proptest::collection::vec(proptest::array::uniform3(-0.3..0.9f64), 2..6),
    ) {
        let (garment, surface, mut marks, _) = tube_on_prism(24);
        marks.cloth[0].points = flat.iter().map(|&p| DVec2::from(p)).collect();
        marks.body[0].points = solid.iter().map(|&p| surface.nearest(DVec3::from(p)).point).collect();
        let (dressing, mut state, _) = Dressing::new(
            Arc::new(garment),
            Arc::new(surface),
            &marks,
            RelaxSettings::default(),
        );
        let mut dressing = dressing.expect("a dressing");
        for _ in 0..120 {
            if dressing.step(&mut state) == Phase::AtRest {
                break;
            }
            prop_assert!(state.positions.iter().all(|p| p.is_finite() && p.length() < 100.0));
        }
    }
}
