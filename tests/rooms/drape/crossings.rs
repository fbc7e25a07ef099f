//! Cloth that cannot cross: after every step brute force finds no edge through a triangle, of the cloth or of the body.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::body::Surface;
use toile::cloth::Fabric;
use toile::drape::{Collider, Drape, DrapeSettings, Elastic, Method, Scene, Sheet, State};
use toile::geometry::crossings::segment_meets_triangle;
use toile::geometry::mesh::TriMesh;
use toile::geometry::shapes::icosphere;

use super::meshes::{Flat, Kind, flat, scene};
use super::moves;

const FRAME: f64 = 1.0 / 60.0;

fn settings() -> DrapeSettings {
    DrapeSettings { self_collision: true, thickness: 2e-3, ..moves::settings(Method::SmallSteps) }
}

fn soft() -> Fabric {
    Fabric::isotropic(1000.0, 0.3, 1e-5, 0.2)
}

/// Several pieces of cloth as one.
fn joined(parts: &[Flat]) -> Flat {
    let mut all = Flat { points: Vec::new(), triangles: Vec::new() };
    for part in parts {
        let first = all.points.len() as u32;
        all.points.extend(&part.points);
        all.triangles.extend(part.triangles.iter().map(|vs| vs.map(|v| v + first)));
    }
    all
}

fn edges_of(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let sides = |[a, b, c]: &[u32; 3]| [[*a, *b], [*b, *c], [*c, *a]].map(|[a, b]| [a.min(b), a.max(b)]);
    let mut edges: Vec<[u32; 2]> = triangles.iter().flat_map(sides).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Edges of `x` through triangles of `y` that share no vertex with them when both are one mesh: every pair is tried.
pub fn through(
    (x, edges): (&[DVec3], &[[u32; 2]]),
    (y, triangles): (&[DVec3], &[[u32; 3]]),
    is_one: bool,
) -> usize {
    let shares = |e: &[u32; 2], t: &[u32; 3]| is_one && t.iter().any(|v| e.contains(v));
    let corners: Vec<[DVec3; 3]> = triangles.iter().map(|t| t.map(|v| y[v as usize])).collect();
    let boxes: Vec<[DVec3; 2]> =
        corners.iter().map(|[a, b, c]| [a.min(*b).min(*c), a.max(*b).max(*c)]).collect();
    let mut count = 0;
    for e in edges {
        let [p, q] = e.map(|v| x[v as usize]);
        let [low, high] = [p.min(q), p.max(q)];
        let near = |[lower, upper]: &[DVec3; 2]| lower.cmple(high).all() && upper.cmpge(low).all();
        let meets = |(k, around): (usize, &[DVec3; 2])| {
            near(around) && !shares(e, &triangles[k]) && segment_meets_triangle([p, q], corners[k])
        };
        count += boxes.iter().enumerate().filter(|b| meets(*b)).count();
    }
    count
}

/// Moves `scene` from `start` for so many frames and finds no crossing in any of them. Where it is then, and the hash of it.
fn never_crosses(
    what: &str,
    scene: Scene,
    start: State,
    settings: DrapeSettings,
    frames: usize,
) -> Vec<DVec3> {
    let triangles = scene.sheet.triangles.clone();
    let edges = edges_of(&triangles);
    let body = scene.collider.as_ref().map(|collider| Arc::clone(&collider.surface));
    let mut drape = Drape::new(scene, start, settings, FRAME).expect("room");
    for frame in 0..frames {
        drape.step(FRAME).unwrap_or_else(|e| panic!("{what}, frame {frame}: {e}"));
        let x = &drape.state().positions;
        assert_eq!(through((x, &edges), (x, &triangles), true), 0, "{what}, frame {frame}: through itself");
        if let Some(body) = &body {
            let (mesh, sides) = (&body.mesh, &body.adjacency.edges);
            let cut = through((x, &edges), (&mesh.positions, &mesh.triangles), false)
                + through((&mesh.positions, sides), (x, &triangles), false);
            assert_eq!(cut, 0, "{what}, frame {frame}: through the body");
        }
    }
    drape.state().positions.clone()
}

fn with_workers<T: Send>(workers: usize, run: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(workers).build().expect("workers").install(run)
}

/// The same on any number of threads.
fn everywhere(run: impl Fn() -> Vec<DVec3> + Sync) {
    let one = with_workers(1, &run);
    assert_eq!(one, with_workers(2, &run));
    assert_eq!(one, with_workers(8, &run));
}

#[test]
fn two_sheets_thrown_at_each_other_at_fifty_metres_a_second_do_not_pass() {
    everywhere(|| {
        let cloth = joined(&[
            flat(Kind::Jittered, DVec2::splat(0.2), [12, 12]),
            flat(Kind::Alternating, DVec2::splat(0.23), [11, 13]),
        ]);
        let half = 13 * 13;
        let mut scene = scene(&cloth, &soft(), vec![false; cloth.points.len()]);
        scene.gravity = DVec3::ZERO;
        let height = |v: usize| if v < half { 0.05 } else { -0.05 };
        let positions = cloth.points.iter().enumerate();
        let positions: Vec<DVec3> =
            positions.map(|(v, p)| DVec3::new(p.x + 0.3 * p.y, height(v), p.y)).collect();
        let velocities = (0..positions.len()).map(|v| DVec3::Y * (-50.0 * height(v).signum())).collect();
        never_crosses("two sheets", scene, State { positions, velocities }, settings(), 20)
    });
}

#[test]
fn ten_layers_dropped_on_a_ball_stay_ten_layers() {
    everywhere(|| {
        let layers: Vec<Flat> = (0..10)
            .map(|k| {
                flat(if k % 2 == 0 { Kind::Jittered } else { Kind::Diagonal }, DVec2::splat(0.2), [8, 8])
            })
            .collect();
        let cloth = joined(&layers);
        let mut scene = scene(&cloth, &soft(), vec![false; cloth.points.len()]);
        let ball = Surface::new(icosphere(0.05, 3)).expect("a ball");
        scene.collider = Some(Collider::still(Arc::new(ball)));
        let of_layer = cloth.points.len() / 10;
        let at = |(v, p): (usize, &DVec2)| {
            let (layer, turn) = ((v / of_layer) as f64, 0.3 * (v / of_layer) as f64);
            let p = DVec2::from_angle(turn).rotate(*p - 0.1);
            DVec3::new(p.x, 0.06 + 0.004 * layer, p.y)
        };
        let start = State::at_rest(cloth.points.iter().enumerate().map(at).collect());
        never_crosses("ten layers", scene, start, settings(), 60)
    });
}

#[test]
fn a_clean_start_a_thousandth_of_a_millimetre_apart_stays_clean() {
    let cloth = joined(&[
        flat(Kind::Jittered, DVec2::splat(0.1), [8, 8]),
        flat(Kind::Diagonal, DVec2::splat(0.1), [7, 9]),
    ]);
    let mut scene = scene(&cloth, &soft(), vec![false; cloth.points.len()]);
    scene.gravity = DVec3::ZERO;
    let height = |v: usize| if v < 81 { 0.0 } else { 1e-6 };
    let positions = cloth.points.iter().enumerate();
    let positions: Vec<DVec3> = positions.map(|(v, p)| DVec3::new(p.x, height(v), p.y)).collect();
    // The lower one goes up, the upper one down, and each is twisted.
    let velocities = positions.iter().enumerate().map(|(v, x)| {
        DVec3::Y * if v < 81 { 2.0 } else { -2.0 } + DVec3::new(x.z, 10.0 * x.x * x.z, -x.x) * 10.0
    });
    let velocities = velocities.collect();
    never_crosses("a thousandth apart", scene, State { positions, velocities }, settings(), 60);
}

/// A cone that stands on y = 0, `high` metres, and what of it is a needle.
fn cone(radius: f64, high: f64) -> Surface {
    let round = 12u32;
    let mut positions: Vec<DVec3> = (0..round)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(round)).sin_cos();
            DVec3::new(radius * cos, 0.0, radius * sin)
        })
        .collect();
    positions.extend([DVec3::new(0.0, high, 0.0), DVec3::ZERO]);
    let side = |k: u32| [[k, round, (k + 1) % round], [(k + 1) % round, round + 1, k]];
    let mesh = TriMesh { positions, triangles: (0..round).flat_map(side).collect() };
    assert!(mesh.volume() > 0.0);
    Surface::new(mesh).expect("a cone")
}

/// A wedge along z with its edge up.
fn knife(high: f64) -> Surface {
    let (w, l) = (0.01, 0.3);
    let end = |z: f64| [DVec3::new(-w, 0.0, z), DVec3::new(w, 0.0, z), DVec3::new(0.0, high, z)];
    let positions = [end(-l), end(l)].concat();
    let mut triangles = vec![[0, 2, 1], [3, 4, 5]];
    for [a, b] in [[0, 1], [1, 2], [2, 0]] {
        triangles.extend([[a, b, b + 3], [a, b + 3, a + 3]]);
    }
    let mesh = TriMesh { positions, triangles };
    assert!(mesh.volume() > 0.0, "{}", mesh.volume());
    Surface::new(mesh).expect("a knife")
}

#[test]
fn a_needle_and_a_knife_do_not_come_through_a_sheet_thrown_on_them() {
    for (what, body) in [("needle", cone(0.01, 0.3)), ("knife", knife(0.3))] {
        let body = Arc::new(body);
        everywhere(|| {
            let cloth = flat(Kind::Jittered, DVec2::splat(0.3), [12, 12]);
            let mut scene = scene(&cloth, &soft(), vec![false; cloth.points.len()]);
            scene.collider = Some(Collider::still(Arc::clone(&body)));
            let positions = cloth.placed(|p| DVec3::new(p.x - 0.13, 0.32 + 0.1 * p.x, p.y - 0.14));
            let velocities = vec![DVec3::new(0.0, -5.0, 0.0); positions.len()];
            never_crosses(what, scene, State { positions, velocities }, settings(), 40)
        });
    }
}

/// The line of an overhand knot: most of a trefoil, its ends drawn out.
fn knot() -> Vec<DVec3> {
    let trefoil = |a: f64| {
        let (x, y) = (a.sin() + 2.0 * (2.0 * a).sin(), a.cos() - 2.0 * (2.0 * a).cos());
        DVec3::new(x, y, -1.5 * (3.0 * a).sin()) * 0.03
    };
    let (last, count, drawn) = (2.5, 100, 0.12);
    let arc: Vec<DVec3> =
        (0..=count).map(|k| trefoil(last * (2.0 * f64::from(k) / f64::from(count) - 1.0))).collect();
    let ways = [trefoil(-last) - trefoil(-last + 1e-4), trefoil(last) - trefoil(last - 1e-4)];
    let [before, after] = ways.map(|way| way.normalize() * (drawn / 25.0));
    let first = (1..=25).rev().map(|k| arc[0] + before * f64::from(k));
    let then = (1..=25).map(|k| trefoil(last) + after * f64::from(k));
    first.chain(arc.iter().copied()).chain(then).collect()
}

#[test]
fn a_ribbon_tied_in_a_knot_and_pulled_stays_tied() {
    // The ribbon is as long as the line.
    let line = knot();
    let count = line.len() as u32 - 1;
    let far: Vec<f64> = line
        .windows(2)
        .scan(0.0, |sum, w| {
            *sum += w[0].distance(w[1]);
            Some(*sum)
        })
        .collect();
    let length = far.last().copied().expect("a line");
    let cloth = flat(Kind::Alternating, DVec2::new(length, 0.008), [count, 2]);
    let at = |p: DVec2| {
        let s = p.x / length * f64::from(count);
        let k = (s as usize).min(count as usize - 1);
        let way = line[k + 1] - line[k];
        let side = way.cross(DVec3::Z).cross(way).normalize_or_zero();
        line[k].lerp(line[k + 1], s - k as f64) + side * (p.y - 0.004)
    };
    let positions = cloth.placed(at);
    let first = cloth.picked(|p| p.x < 1e-9);
    let mut scene = scene(&cloth, &soft(), first);
    // Its other end is heavy.
    for (m, p) in scene.mass.iter_mut().zip(&cloth.points) {
        *m *= if p.x > length - 1e-9 { 200.0 } else { 1.0 };
    }
    scene.gravity = (positions[count as usize] - positions[0]).normalize() * 10.0;
    let (triangles, edges) = (cloth.triangles.clone(), edges_of(&cloth.triangles));
    assert_eq!(through((&positions, &edges), (&positions, &triangles), true), 0, "the start is clean");
    let end = never_crosses(
        "knot",
        scene,
        State::at_rest(positions),
        DrapeSettings { thickness: 1e-3, ..settings() },
        240,
    );
    let reach = end[0].distance(end[count as usize]);
    assert!(reach < 0.97 * length, "it came untied: {reach} of {length} m");
}

/// What moves at a plane loses energy, if anything: sheets that meet never have more than they came with.
#[test]
fn truncation_adds_no_energy() {
    let cloth = joined(&[
        flat(Kind::Jittered, DVec2::splat(0.15), [8, 8]),
        flat(Kind::Alternating, DVec2::splat(0.15), [7, 9]),
    ]);
    let mut scene = scene(&cloth, &soft(), vec![false; cloth.points.len()]);
    scene.gravity = DVec3::ZERO;
    let positions: Vec<DVec3> = cloth
        .points
        .iter()
        .enumerate()
        .map(|(v, p)| DVec3::new(p.x + 0.2 * p.y, if v < 81 { 0.01 } else { -0.01 }, p.y))
        .collect();
    let velocities: Vec<DVec3> =
        (0..positions.len()).map(|v| DVec3::Y * if v < 81 { -3.0 } else { 3.0 }).collect();
    let mass = scene.mass.clone();
    let energy = |velocities: &[DVec3]| -> f64 {
        velocities.iter().zip(&mass).map(|(v, m)| m * v.length_squared() / 2.0).sum()
    };
    let first = energy(&velocities);
    let mut drape = Drape::new(scene, State { positions, velocities }, settings(), FRAME).expect("room");
    for frame in 0..30 {
        drape.step(FRAME).expect("a step");
        let now = energy(&drape.state().velocities);
        assert!(now <= first * (1.0 + 1e-9), "frame {frame}: {now} J of {first} J");
    }
}

/// A tube of so many columns round and rows high, and its size round and high, metres: rows of columns, its outer side its front.
fn tube([round, high]: [u32; 2], size: DVec2) -> Sheet {
    let cells = flat(Kind::Alternating, size, [round, high]);
    let rest = cells.triangles.iter().map(|vs| vs.map(|v| cells.points[v as usize])).collect();
    let closed = |v: u32| v / (round + 1) * round + v % (round + 1) % round;
    let triangles = cells.triangles.iter().map(|vs| vs.map(closed)).collect();
    Sheet::new((round * (high + 1)) as usize, triangles, rest).expect("a tube")
}

/// Its lower rim is held; its upper one is turned inwards and heavy, and falls through it: it is pulled inside out, whole.
#[test]
fn a_tube_pulled_inside_out_does_not_run_through_itself() {
    let ([round, high], radius, length) = ([20_u32, 16_u32], 0.06, 0.2);
    let sheet = tube([round, high], DVec2::new(TAU * radius, length));
    let fabric = soft();
    // Up as far as it is turned in, over a small bend, and down again.
    let (straight, bend) = (0.13, 0.006);
    let place = |s: f64| match s - straight {
        past if past < 0.0 => [radius, s],
        past if past < PI * bend => {
            let (sin, cos) = (past / bend).sin_cos();
            [radius - bend * (1.0 - cos), straight + bend * sin]
        }
        past => [radius - 2.0 * bend, straight + PI * bend - past],
    };
    let at = |v: u32| {
        let (column, row) = (v % round, v / round);
        let [r, y] = place(length * f64::from(row) / f64::from(high));
        let (sin, cos) = (TAU * f64::from(column) / f64::from(round)).sin_cos();
        DVec3::new(r * sin, y, r * cos)
    };
    let (count, rim) = (round * (high + 1), round * high);
    let mut mass: Vec<f64> = sheet.vertex_area.iter().map(|a| a * fabric.density_kg_per_m2).collect();
    mass[rim as usize..].iter_mut().for_each(|m| *m *= 400.0);
    let scene = Scene {
        elastic: Elastic::new(&sheet, &fabric, 1.0),
        sheet,
        mass,
        pinned: (0..count).map(|v| v < round).collect(),
        gravity: DVec3::NEG_Y * 10.0,
        damping: fabric.damping_per_s,
        collider: None,
    };
    let start = State::at_rest((0..count).map(at).collect());
    let thin = DrapeSettings { thickness: 1e-3, ..settings() };
    let end = never_crosses("tube", scene, start, thin, 90);
    let highest = end[rim as usize..].iter().map(|p| p.y).fold(f64::MIN, f64::max);
    assert!(highest < -0.8 * length, "its rim hangs at {highest} m: it is not all inside out");
}
