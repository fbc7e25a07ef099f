use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use super::*;
use crate::body::Surface;
use crate::cloth::{ClothState, Counters, Garment, build};
use crate::geometry::mesh::TriMesh;
use crate::pattern::{EdgeRef, Pattern, Piece, Seam};
use crate::relax::RelaxSettings;
use crate::repose::excess::Lengths;
use crate::repose::limit::limited;
use crate::repose::transfer::Transfer;

/// Radius and length of the arm, metres.
const ARM: [f64; 2] = [0.06, 0.9];
/// How far above it the sleeve lies, metres.
const LOOSE: f64 = 0.006;
/// From where to where along the arm it reaches, metres.
const SLEEVE: [f64; 2] = [0.25, 0.65];

/// A closed cylinder along y.
fn arm() -> TriMesh {
    let (n, rows) = (48u32, 60u32);
    let mut mesh = TriMesh::default();
    for row in 0..=rows {
        let y = ARM[1] * f64::from(row) / f64::from(rows);
        for k in 0..n {
            let a = f64::from(k) / f64::from(n) * std::f64::consts::TAU;
            mesh.positions.push(DVec3::new(ARM[0] * a.sin(), y, ARM[0] * a.cos()));
        }
    }
    for row in 0..rows {
        for k in 0..n {
            let (a, b) = (row * n + k, row * n + (k + 1) % n);
            mesh.triangles.extend([[a, b, b + n], [a, b + n, a + n]]);
        }
    }
    let (bottom, top) = (mesh.positions.len() as u32, mesh.positions.len() as u32 + 1);
    mesh.positions.extend([DVec3::ZERO, DVec3::Y * ARM[1]]);
    for k in 0..n {
        let next = (k + 1) % n;
        mesh.triangles.extend([[bottom, next, k], [top, rows * n + k, rows * n + next]]);
    }
    mesh
}

/// A sleeve round the arm, sewn along one line, unstrained but for its chords.
fn sleeve() -> (Garment, ClothState) {
    let (round, length) = (std::f64::consts::TAU * (ARM[0] + LOOSE), SLEEVE[1] - SLEEVE[0]);
    let sheet = [DVec2::ZERO, DVec2::X * round, DVec2::new(round, length), DVec2::Y * length];
    let mut pattern = Pattern::default();
    let piece = pattern.add_piece(Piece::polygon("sleeve", &sheet));
    pattern.add_seam(Seam::of_edges([EdgeRef { piece, edge: 1 }, EdgeRef { piece, edge: 3 }], false));
    let (garment, problems) = build(&pattern, 0.015);
    assert!(problems.iter().all(|p| p.kind.is_note()), "{problems:?}");
    let mut state = ClothState {
        positions: vec![DVec3::ZERO; garment.vertex_count],
        mapped: vec![true; garment.vertex_count],
    };
    for c in &garment.corners {
        let a = c.uv.x / (ARM[0] + LOOSE);
        let r = ARM[0] + LOOSE;
        state.positions[c.vertex as usize] = DVec3::new(r * a.sin(), SLEEVE[0] + c.uv.y, r * a.cos());
    }
    (garment, state)
}

fn reposer() -> (Garment, ClothState, Reposer, Arc<Surface>) {
    let surface = Arc::new(Surface::new(arm()).expect("a body"));
    let (garment, state) = sleeve();
    let settings = RelaxSettings::default();
    let reposer = Reposer::new(&garment, Arc::clone(&surface), state.clone(), settings).expect("it fits");
    (garment, state, reposer, surface)
}

fn moved(surface: &Surface, map: impl Fn(DVec3) -> DVec3) -> Arc<Surface> {
    let positions = surface.mesh.positions.iter().map(|&p| map(p)).collect();
    Arc::new(surface.reposed(positions).expect("as many vertices"))
}

/// The middle half of the arm's axis becomes an arc of `angle`, the ends stay straight; sections stay round.
fn bent(p: DVec3, angle: f64) -> DVec3 {
    let (low, high) = (ARM[1] * 0.25, ARM[1] * 0.75);
    let radius = (high - low) / angle;
    let turned = (p.y.clamp(low, high) - low) / radius;
    let beyond = p.y - p.y.clamp(low, high);
    let (sin, cos) = turned.sin_cos();
    // About the point (radius, low, 0): the axis leaves along y and turns to x.
    let out = DVec3::new(-cos, sin, 0.0);
    let along = DVec3::new(sin, cos, 0.0);
    DVec3::new(radius, low, p.z) + out * (radius - p.x) + along * beyond
}

/// Vertices that a brute-force look at all triangles finds inside: by the winding number.
fn inside(surface: &Surface, state: &ClothState) -> usize {
    let winding = crate::geometry::winding::Winding::new(&surface.mesh);
    state.positions.iter().filter(|&&p| winding.contains(p)).count()
}

#[test]
fn the_pose_it_was_dressed_in_leaves_every_bit() {
    let (_, state, mut reposer, surface) = reposer();
    let same = moved(&surface, |p| p);
    let (reposed, outcome) = reposer.reposed(&same, ReposeSettings::THOROUGH).expect("the same body");
    assert_eq!(reposed, state);
    assert_eq!(outcome.steps, 0);
}

#[test]
fn strain_beyond_its_limit_goes_and_no_vertex_is_left_in_the_body() {
    let (_, bound, mut reposer, _) = reposer();
    let middle = (SLEEVE[0] + SLEEVE[1]) / 2.0;
    // A band of the sleeve is pressed together by up to 8 %, and some of it into the arm.
    let pressed = |p: DVec3| {
        let near = (-(p.y - middle).powi(2) / 0.003).exp();
        DVec3::new(p.x * (1.0 - 0.12 * near), p.y - 0.03 * (p.y - middle) * near, p.z * (1.0 - 0.12 * near))
    };
    let mut state = ClothState { positions: bound.positions.iter().map(|&p| pressed(p)).collect(), ..bound };
    assert!(reposer.lengths.p99(&state) > 0.03);
    let (lengths, relaxer) = (reposer.lengths.clone(), &mut reposer.relaxer);
    let rounds = (1..=20).find(|_| limited(&lengths, relaxer, &mut state, 0.01));
    assert!(rounds.is_some(), "{}", lengths.p99(&state));
    let closest = state.positions.iter().map(|p| p.x.hypot(p.z)).fold(f64::INFINITY, f64::min);
    assert!(closest > ARM[0] * (std::f64::consts::PI / 48.0).cos(), "{closest}");
}

#[test]
fn a_rigid_motion_carries_the_cloth_rigidly() {
    let (_, state, mut reposer, surface) = reposer();
    let turn = DQuat::from_axis_angle(DVec3::new(0.3, -1.0, 0.6).normalize(), 2.2);
    let rigid = |p: DVec3| turn * p + DVec3::new(0.3, 1.0, -2.0);
    let to = moved(&surface, rigid);
    let (reposed, outcome) = reposer.reposed(&to, ReposeSettings::THOROUGH).expect("the same body");
    for (p, before) in reposed.positions.iter().zip(&state.positions) {
        assert!(p.distance(rigid(*before)) < 1e-6);
    }
    assert_eq!((outcome.steps, outcome.inside), (0, 0));
}

#[test]
fn cloth_round_a_bent_arm_is_strained_by_the_arc_ratio() {
    let (garment, state, reposer, surface) = reposer();
    let angle = 0.8;
    let to = moved(&surface, |p| bent(p, angle));
    let positions = conformed(reposer.map(), &surface, &to, &state.positions);
    // Well within the bend, a cloth edge along the arm at x before lies at radius R - x after.
    let radius = ARM[1] * 0.5 / angle;
    let mut looked_at = 0;
    for &[a, b] in &garment.adjacency.edges {
        let [p, q] = [a, b].map(|v| state.positions[v as usize]);
        let middle = (p + q) / 2.0;
        let along = (q - p).normalize();
        if along.y.abs() < 0.9999 || (middle.y - ARM[1] * 0.5).abs() > ARM[1] * 0.12 {
            continue;
        }
        let ratio = positions[a as usize].distance(positions[b as usize]) / p.distance(q);
        let exact = (radius - middle.x) / radius;
        looked_at += 1;
        assert!((ratio - exact).abs() < 2e-3, "at x {}: {ratio}, exactly {exact}", middle.x);
    }
    assert!(looked_at > 10, "{looked_at}");
}

#[test]
fn a_bent_arm_stays_outside_of_its_sleeve_which_keeps_its_lengths() {
    let (_, _, mut reposer, surface) = reposer();
    let to = moved(&surface, |p| bent(p, 0.5));
    let (state, outcome) = reposer.reposed(&to, ReposeSettings::THOROUGH).expect("the same body");
    assert_eq!(inside(&to, &state), 0);
    assert!(outcome.excess_p99 < outcome.conformed_p99, "{outcome:?}");
    let (live, fewer) = reposer.reposed(&to, ReposeSettings::LIVE).expect("the same body");
    assert_eq!((inside(&to, &live), fewer.steps <= ReposeSettings::LIVE.most_steps), (0, true));
}

#[test]
fn from_picture_to_picture_the_strain_gets_no_more() {
    let (_, state, mut reposer, surface) = reposer();
    let to = moved(&surface, |p| bent(p, 0.4));
    let strained = |reposer: &mut Reposer| {
        reposer.reposed(&to, ReposeSettings::LIVE).expect("the same body").1.excess_p99
    };
    let first = strained(&mut reposer);
    let later = (0..6).map(|_| strained(&mut reposer)).last().expect("six");
    assert!(later <= first.max(ReposeSettings::LIVE.excess), "{first}, {later}");
    let (back, _) = reposer.reposed(&moved(&surface, |p| p), ReposeSettings::LIVE).expect("the same body");
    assert_eq!(back, state, "the pose it was dressed in still leaves every bit");
}

#[test]
fn an_arm_that_runs_through_the_trunk_leaves_the_cloth_of_the_trunk() {
    let (garment, state) = sleeve();
    let (mut both, other) = (arm(), crate::geometry::shapes::cylinder(0.03, 0.8, 24, 60));
    let first = both.positions.len() as u32;
    // Beside the trunk, across it.
    both.positions.extend(other.positions.iter().map(|p| DVec3::new(p.z + 0.3, p.x + 0.45, p.y - 0.4)));
    both.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
    let surface = Arc::new(Surface::new(both).expect("two bodies"));
    let settings = RelaxSettings::default();
    let mut reposer = Reposer::new(&garment, Arc::clone(&surface), state.clone(), settings).expect("it fits");
    let mut positions = surface.mesh.positions.clone();
    positions[first as usize..].iter_mut().for_each(|p| p.x -= 0.23);
    let to = Arc::new(surface.reposed(positions).expect("as many vertices"));
    let of_trunk = arm().triangles.len() as u32;
    let within = |p: &&DVec3| {
        let skin = to.nearest_within_but(**p, 1.0, |t| t < of_trunk);
        skin.is_some_and(|skin| skin.distance < 0.0)
    };
    assert!(state.positions.iter().filter(within).count() > 10, "the arm runs through the cloth");
    let (reposed, outcome) = reposer.reposed(&to, ReposeSettings::THOROUGH).expect("the same body");
    assert_eq!((reposed, outcome.inside), (state, 0));
}

#[test]
fn threads_do_not_change_a_bit() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let (_, _, mut reposer, surface) = reposer();
            let to = moved(&surface, |p| bent(p, 0.7));
            reposer.reposed(&to, ReposeSettings::THOROUGH).expect("the same body").0
        })
    };
    assert_eq!(run(1), run(3));
}

#[test]
fn skin_that_has_not_moved_leaves_the_bits_of_its_cloth() {
    let (_, state, reposer, surface) = reposer();
    let to = moved(&surface, |p| if p.y > 0.5 { p + DVec3::X * (p.y - 0.5) } else { p });
    let positions = conformed(reposer.map(), &surface, &to, &state.positions);
    let low = |p: &DVec3| p.y < 0.45;
    let kept = positions.iter().zip(&state.positions).filter(|(_, before)| low(before));
    assert!(kept.clone().count() > 100 && kept.clone().all(|(p, before)| p == before));
    assert_ne!(positions, state.positions);
}

#[test]
fn between_two_limbs_a_vertex_is_bound_to_both() {
    let (a, b) = (arm(), arm());
    let mut both = a.clone();
    let first = both.positions.len() as u32;
    both.positions.extend(b.positions.iter().map(|&p| p + DVec3::X * 0.3));
    both.triangles.extend(b.triangles.iter().map(|t| t.map(|v| v + first)));
    let surface = Surface::new(both).expect("two bodies");
    let bound = |x: f64| {
        let cloth = ClothState { positions: vec![DVec3::new(x, 0.4, 0.0)], mapped: vec![true] };
        DistanceMap::new(&surface, &cloth)
    };
    let map = bound(0.15);
    let weights: Vec<f64> = map.of(0).iter().map(|b| b.weight).collect();
    assert_eq!(weights.len(), 2, "{weights:?}");
    assert!(weights.iter().all(|w| (w - 0.5).abs() < 1e-3), "{weights:?}");
    assert_eq!(bound(0.1).of(0).len(), 1);
    // Its weight fades in: no jump where the second limb comes within reach.
    let x = 0.06 + 0.18 / 2.3 - 1e-4;
    let second = bound(x).of(0).get(1).map_or(0.0, |b| b.weight);
    assert!(second < 0.02, "{second}");
}

#[test]
fn a_body_with_other_triangles_is_refused() {
    let (_, _, mut reposer, surface) = reposer();
    let mut other = surface.mesh.clone();
    other.triangles.swap(0, 1);
    let other = Arc::new(Surface::new(other).expect("a body"));
    assert!(reposer.reposed(&other, ReposeSettings::LIVE).is_none());
}

#[test]
fn turned_shapes_are_joined_where_neighbours_went_apart() {
    let (garment, state, ..) = reposer();
    let mut transfer = Transfer::new(&garment, &state, 1.0).expect("it fits");
    let turn = DQuat::from_rotation_z(0.9);
    let whole: Vec<_> = state.positions.iter().map(|&p| (turn * p + DVec3::X, turn)).collect();
    let mut rigid = whole.clone();
    transfer.join(&garment, &state, &mut rigid, &mut Counters::default());
    assert!(rigid.iter().zip(&whole).all(|(a, b)| a.0.distance(b.0) < 1e-12), "a rigid move stays one");
    // Every other vertex is bound to something that went 6 mm and 11 degrees elsewhere.
    let beside = DQuat::from_rotation_x(0.2);
    let apart = |(v, (p, turn)): (usize, (DVec3, DQuat))| match v % 2 {
        0 => (p, turn),
        _ => (p + DVec3::new(0.003, -0.004, 0.003), turn * beside),
    };
    let mut torn: Vec<_> = whole.into_iter().enumerate().map(apart).collect();
    let strain = |carried: &[(DVec3, DQuat)]| {
        let positions = carried.iter().map(|(p, _)| *p).collect();
        Lengths::of(&garment, &state).p99(&ClothState { positions, ..state.clone() })
    };
    let before = strain(&torn);
    transfer.join(&garment, &state, &mut torn, &mut Counters::default());
    assert!(before > 0.3 && strain(&torn) < 0.05, "{before} {}", strain(&torn));
}
