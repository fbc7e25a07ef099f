//! The relaxer against its own energy (B20), and its two ways to the minimum against each other.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use toile::body::Surface;
use toile::cloth::{ClothState, Garment, build};
use toile::pattern::{Pattern, Piece};
use toile::relax::{GlobalStep, RelaxSettings, Relaxer};

use super::shapes::ball;

const EDGE: f64 = 0.03;
/// The body is far away from all cloth.
const FAR: f64 = 5.0;

/// A square of cloth, and a relaxer with a body far away.
fn square(side: f64) -> (Arc<Garment>, Relaxer) {
    let corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(DVec2::from);
    let mut pattern = Pattern::default();
    pattern.add_piece(Piece::polygon("square", &corners));
    let garment = Arc::new(build(&pattern, EDGE).0);
    let mut body = ball(0.75, 12, 24);
    body.positions.iter_mut().for_each(|p| *p += DVec3::NEG_Y * FAR);
    let surface = Arc::new(Surface::new(body).expect("a body"));
    // Flattening is no part of the energy, and moves strained cloth in its plane, too.
    let settings = RelaxSettings { gravity: 0.0, friction: 0.0, flatten: 0.0, ..RelaxSettings::default() };
    let mut relaxer = Relaxer::new(garment.clone(), surface, settings).expect("enough memory");
    relaxer.set_mapped(&vec![true; garment.vertex_count]);
    (garment, relaxer)
}

fn flat(garment: &Garment) -> ClothState {
    let mut positions = vec![DVec3::ZERO; garment.vertex_count];
    for corner in &garment.corners {
        positions[corner.vertex as usize] = corner.uv.extend(0.0);
    }
    ClothState { positions, mapped: vec![true; garment.vertex_count] }
}

/// Sum over triangles of the least sum of squares |x - c - R w|^2 that a turn R and a shift c allow.
fn energy(garment: &Garment, state: &ClothState) -> f64 {
    garment
        .triangles
        .iter()
        .zip(&garment.rest)
        .map(|(vs, rest)| {
            let p = vs.map(|v| state.positions[v as usize]);
            let centre = (p[0] + p[1] + p[2]) / 3.0;
            let x = (p[1] - p[0]).normalize();
            let y = (p[1] - p[0]).cross(p[2] - p[0]).cross(x).normalize();
            let (mut sum, mut turn) = (0.0, DVec2::ZERO);
            for (p, w) in p.iter().zip(rest) {
                let z = DVec2::new((*p - centre).dot(x), (*p - centre).dot(y));
                sum += z.length_squared() + w.length_squared();
                turn += DVec2::new(z.dot(*w), w.perp_dot(z));
            }
            sum - 2.0 * turn.length()
        })
        .sum()
}

fn all(garment: &Garment) -> (Vec<u32>, Vec<u32>) {
    ((0..garment.vertex_count as u32).collect(), (0..garment.triangles.len() as u32).collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// However crumpled the cloth and whatever part of it is relaxed, a local pass never raises the energy.
    #[test]
    fn local_passes_never_raise_the_energy(
        seed in any::<u64>(),
        crumpled in 0.0..2.0f64,
        factor in 0.01..1.99f64,
        part in 0.1..1.0f64,
    ) {
        let (garment, mut relaxer) = square(0.15);
        let mut state = flat(&garment);
        let mut chance = seed;
        let mut next = || {
            chance = chance.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (chance >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        for p in &mut state.positions {
            *p += DVec3::new(next(), next(), next()) * (crumpled * EDGE);
        }
        let (mut vertices, triangles) = all(&garment);
        vertices.retain(|_| next() + 0.5 < part);
        let mut before = energy(&garment, &state);
        for pass in 0..20 {
            relaxer.local_pass(&mut state, &vertices, &triangles, factor);
            let after = energy(&garment, &state);
            // It is a small difference of sums of about 0.1 m², which are known to 1e-17.
            prop_assert!(after <= before * (1.0 + 1e-9) + 1e-16, "pass {pass}: {before} to {after}");
            before = after;
        }
    }
}

/// Cloth held stretched and sheared by its border: global steps and plain Jacobi passes come to the same place.
#[test]
fn global_steps_and_local_passes_find_the_same_minimum() {
    let (garment, mut relaxer) = square(0.3);
    let mut start = flat(&garment);
    let border: Vec<u32> = (0..garment.vertex_count as u32)
        .filter(|&v| {
            let p = start.positions[v as usize];
            p.x < 1e-9 || p.x > 0.3 - 1e-9
        })
        .collect();
    for p in &mut start.positions {
        *p = DVec3::new(p.x * 1.1 + p.y * 0.1, p.y * (1.0 + 0.3 * p.x), 0.0);
    }
    relaxer.fix(border);
    let step = GlobalStep { cap: 1.0, contact: 0.03, hold: 0.0, slack: 0.0, unfold: false, weight: false };
    let mut global = start.clone();
    let mut steps = 0;
    while relaxer.global_step(&mut global, step) > 1e-12 {
        steps += 1;
        assert!(steps < 5000, "global steps do not converge");
    }
    let (vertices, triangles) = all(&garment);
    let mut local = start;
    let mut passes = 0;
    loop {
        let before = local.positions.clone();
        relaxer.local_pass(&mut local, &vertices, &triangles, 1.6);
        passes += 1;
        let moved = before.iter().zip(&local.positions).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        if moved < 1e-12 {
            break;
        }
        assert!(passes < 50_000, "local passes do not converge");
    }
    let apart =
        global.positions.iter().zip(&local.positions).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    println!(
        "{steps} steps, {passes} passes, {:.2e} l apart, energies {:.9e} {:.9e}",
        apart / EDGE,
        energy(&garment, &global),
        energy(&garment, &local)
    );
    assert!(apart < 1e-4 * EDGE, "{} l", apart / EDGE);
}
