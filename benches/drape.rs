//! The peers' scenes: a sheet of 1 m² and 0.2 kg that falls from two pinned corners (S1), or on a ball of 0.3 m (S2), for two
//! seconds at 60 frames. Prints seconds of work per simulated second, edge strain and depth. With the argument `reference` the
//! small sheets are also held against implicit steps of 1/480 s.

#[path = "../tests/common/mod.rs"]
mod common;

use std::sync::Arc;
use std::time::Instant;

use glam::{DVec2, DVec3};
use toile::body::Surface;
use toile::cloth::Fabric;
use toile::drape::{Collider, Drape, DrapeSettings, Elastic, Integrator, Method, Scene, Sheet, State};

const FRAMES: usize = 120;
const RADIUS: f64 = 0.3;
const OFFSET: f64 = 1e-3;

#[derive(Clone, Copy, PartialEq)]
enum Peer {
    Hangs,
    OnBall,
}

fn ball() -> Collider {
    Collider::still(Arc::new(Surface::new(common::ball(RADIUS, 80, 128)).expect("a ball")))
}

fn drape(peer: Peer, n: u32, method: Method, self_collision: bool, step: f64) -> Drape {
    let at = |i: u32, j: u32| j * (n + 1) + i;
    let points: Vec<DVec2> = (0..(n + 1) * (n + 1))
        .map(|k| DVec2::new(f64::from(k % (n + 1)), f64::from(k / (n + 1))) / f64::from(n))
        .collect();
    let cells = (0..n * n).map(|k| (k % n, k / n));
    let triangles: Vec<[u32; 3]> = cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let rest = triangles.iter().map(|vs| vs.map(|v| points[v as usize])).collect();
    let sheet = Sheet::new(points.len(), triangles, rest).expect("a sheet");
    let fabric = Fabric::isotropic(5000.0, 0.3, 5e-5, 0.2);
    let mut pinned = vec![false; points.len()];
    if peer == Peer::Hangs {
        pinned[at(0, n) as usize] = true;
        pinned[at(n, n) as usize] = true;
    }
    let height = if peer == Peer::Hangs { 0.0 } else { RADIUS + 0.05 };
    let scene = Scene {
        elastic: Elastic::new(&sheet, &fabric, 1.0),
        mass: sheet.vertex_area.iter().map(|a| a * fabric.density_kg_per_m2).collect(),
        sheet,
        pinned,
        gravity: DVec3::new(0.0, -9.81, 0.0),
        damping: 0.0,
        collider: (peer == Peer::OnBall).then(ball),
    };
    let settings = DrapeSettings {
        method: Some(method),
        strain: 0.003,
        thickness: OFFSET,
        friction: 0.3,
        self_collision,
        integrator: Integrator::Bdf2,
        stiffness: 5000.0,
        accuracy: 1e-4,
    };
    let x = points.iter().map(|p| DVec3::new(p.x - 0.5, height, p.y - 0.5)).collect();
    Drape::new(scene, State::at_rest(x), settings, step).expect("room")
}

fn p99(drape: &Drape) -> f64 {
    let (sheet, x) = (&drape.scene.sheet, &drape.state().positions);
    let strain =
        |(e, &[a, b]): (usize, &[u32; 2])| x[a as usize].distance(x[b as usize]) / sheet.rest_length(e) - 1.0;
    let mut strains: Vec<f64> = sheet.adjacency.edges.iter().enumerate().map(strain).collect();
    strains.sort_unstable_by(f64::total_cmp);
    strains[strains.len() * 99 / 100]
}

fn row(peer: Peer, n: u32, self_collision: bool) -> Vec<Vec<DVec3>> {
    let step = 1.0 / 60.0;
    let mut drape = drape(peer, n, Method::SmallSteps, self_collision, step);
    let (mut seconds, mut worst, mut deepest) = (0.0, 0.0f64, f64::MIN);
    let mut frames = Vec::new();
    for _ in 0..FRAMES {
        let begun = Instant::now();
        drape.step(step).expect("a step");
        seconds += begun.elapsed().as_secs_f64();
        worst = worst.max(p99(&drape));
        let depth = drape.state().positions.iter().map(|x| RADIUS - x.length());
        deepest = depth.fold(deepest, f64::max);
        frames.push(drape.state().positions.clone());
    }
    let name = if peer == Peer::Hangs { "S1" } else { "S2" };
    let depth =
        if peer == Peer::Hangs { String::new() } else { format!(", deepest {:.2} mm", deepest * 1e3) };
    let with = if self_collision { " with self-collision" } else { "" };
    println!(
        "{name} {} triangles{with}, {}: {:.3} s per simulated second, p99 edge strain {:.2} % at the end, {:.2} % in the \
         worst frame{depth}",
        2 * n * n,
        drape.chosen(),
        seconds / 2.0,
        p99(&drape) * 100.0,
        worst * 100.0
    );
    frames
}

/// Mean over frames of the root mean square distance, metres.
fn reference(peer: Peer, n: u32, frames: &[Vec<DVec3>]) {
    let step = 1.0 / 480.0;
    let mut drape = drape(peer, n, Method::Implicit, false, step);
    let mut sum = 0.0;
    for frame in frames {
        (0..8).for_each(|_| drape.step(step).expect("a step"));
        let squares = frame.iter().zip(&drape.state().positions).map(|(a, b)| a.distance_squared(*b));
        sum += (squares.sum::<f64>() / frame.len() as f64).sqrt();
    }
    println!("   from the reference {:.1} mm in the mean", sum / frames.len() as f64 * 1e3);
}

fn main() {
    let with_reference = std::env::args().any(|a| a == "reference");
    for peer in [Peer::Hangs, Peer::OnBall] {
        for n in [22, 71, 141] {
            let frames = row(peer, n, false);
            if with_reference && n == 22 {
                reference(peer, n, &frames);
            }
        }
    }
    row(Peer::OnBall, 22, true);
    row(Peer::OnBall, 71, true);
}
