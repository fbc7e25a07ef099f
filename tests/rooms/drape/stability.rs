//! What breaks solvers: triangles without shape, cloth that begins nowhere or inside out, great ratios of stiffness, other sizes
//! and places, bodies that jump, and long runs.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use toile::body::Surface;
use toile::cloth::Fabric;
use toile::drape::{Collider, Drape, DrapeError, Integrator, Method, Scene, Sheet, SheetError, State};
use toile::geometry::mesh::TriMesh;

use super::meshes::{Flat, Kind, flat, scene};
use super::moves::settings;

const BOTH: [Method; 2] = [Method::Implicit, Method::SmallSteps];
const FRAME: f64 = 1.0 / 60.0;

fn soft() -> Fabric {
    Fabric::isotropic(1000.0, 0.3, 1e-5, 0.2)
}

/// `scene` from `start` for so many frames: every step is finite, and what is pinned stays to the bit.
fn run(scene: Scene, start: State, method: Method, frames: usize) -> Drape {
    let (pinned, first) = (scene.pinned.clone(), start.positions.clone());
    let mut settings = settings(method);
    settings.accuracy = 1e-4;
    let mut drape = Drape::new(scene, start, settings, FRAME).expect("room");
    for frame in 0..frames {
        drape.step(FRAME).unwrap_or_else(|e| panic!("{method:?}: frame {frame}: {e}"));
    }
    for ((x, start), _) in drape.state().positions.iter().zip(&first).zip(&pinned).filter(|(_, held)| **held)
    {
        assert!(x == start, "{method:?}: a pin moved from {start} to {x}");
    }
    drape
}

/// Held by its first corner.
fn held_by_a_corner(cloth: &Flat) -> Vec<bool> {
    (0..cloth.points.len()).map(|v| v == 0).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Slivers, needles and mirrored triangles: refused, or moved.
    #[test]
    fn slivers_are_refused_or_moved(moves in prop::collection::vec((-1.2..1.2f64, -1.2..1.2f64), 25)) {
        let mut cloth = flat(Kind::Diagonal, DVec2::splat(0.2), [4, 4]);
        for (p, (x, y)) in cloth.points.iter_mut().zip(moves) {
            *p += DVec2::new(x, y) * 0.05;
        }
        let rest = cloth.triangles.iter().map(|vs| vs.map(|v| cloth.points[v as usize])).collect();
        if Sheet::new(25, cloth.triangles.clone(), rest).is_ok() {
            for method in BOTH {
                let start = State::at_rest(cloth.placed(|p| p.extend(0.0)));
                run(scene(&cloth, &soft(), held_by_a_corner(&cloth)), start, method, 10);
            }
        }
    }
}

/// Bending is explicit in small steps: the corner of a sliver would swing faster than they are short, and blow up.
#[test]
fn a_sliver_does_not_throw_the_cloth_about() {
    let mut cloth = flat(Kind::Diagonal, DVec2::splat(0.3), [20, 20]);
    for corner in [10 * 21 + 10, 11 * 21 + 10, 9 * 21 + 10] {
        cloth.points[corner] = cloth.points[corner - 1] + DVec2::new(1e-4, 0.0);
    }
    for method in BOTH {
        let held = cloth.picked(|p| p.y > 0.3 - 1e-9);
        let start =
            State::at_rest(cloth.placed(|p| p.extend(0.002 * (40.0 * p.x).sin() * (30.0 * p.y).cos())));
        let drape = run(scene(&cloth, &soft(), held), start, method, 20);
        assert!(drape.speed() < 1.0, "{method:?}: {} m/s", drape.speed());
    }
}

#[test]
fn a_needle_is_no_cloth_and_one_triangle_is() {
    assert_eq!(Sheet::new(0, Vec::new(), Vec::new()).err(), Some(SheetError::Empty));
    let thin = [DVec2::ZERO, DVec2::X, DVec2::new(0.5, 1e-12)];
    let whole = [DVec2::ZERO, DVec2::X, DVec2::Y];
    assert_eq!(Sheet::new(4, vec![[0, 1, 2], [1, 0, 3]], vec![whole, thin]).err(), Some(SheetError::Area(1)));
    let one = Flat { points: whole.to_vec(), triangles: vec![[0, 1, 2]] };
    for method in BOTH {
        let drape = run(
            scene(&one, &soft(), vec![false; 3]),
            State::at_rest(one.placed(|p| p.extend(0.0))),
            method,
            60,
        );
        assert!((drape.state().positions[0].y + 5.0).abs() < 1e-6, "{method:?}: it falls");
    }
}

#[test]
fn cloth_may_begin_in_one_point_or_mirrored_or_folded_flat() {
    let cloth = flat(Kind::Jittered, DVec2::splat(0.2), [6, 6]);
    let starts: [fn(DVec2) -> DVec3; 4] = [
        |_| DVec3::ZERO,
        |p| DVec3::new(p.x, 0.0, 0.0),
        |p| DVec3::new(-p.x, p.y, 0.0),
        |p| DVec3::new((p.x - 0.1).abs(), p.y, 0.0),
    ];
    for (i, place) in starts.into_iter().enumerate() {
        for method in BOTH {
            let start = State::at_rest(cloth.placed(place));
            let drape = run(scene(&cloth, &soft(), held_by_a_corner(&cloth)), start, method, 100);
            let far = drape.state().positions.iter().map(|x| x.length()).fold(0.0, f64::max);
            assert!(far < 1.0, "{method:?}, start {i}: {far} m away");
        }
    }
}

/// Warp to weft, and stretching to bending over the edge squared, from 1e-6 to 1e6.
#[test]
fn no_ratio_of_stiffness_makes_energy() {
    for (warp, weft, bending) in
        [(1e6, 1.0, 1e-6), (1.0, 1e6, 1e-6), (1e3, 1e3, 1.0), (1.0, 1.0, 1e-9), (1e6, 1e6, 1e-9)]
    {
        let cloth = flat(Kind::Jittered, DVec2::splat(0.2), [6, 6]);
        let mut fabric = Fabric::isotropic(warp, 0.0, bending, 0.2);
        fabric.stretch.weft = weft;
        fabric.stretch.shear = warp.min(weft) / 2.0;
        let mut scene = scene(&cloth, &fabric, held_by_a_corner(&cloth));
        scene.gravity = DVec3::ZERO;
        let x = cloth.placed(|p| DVec3::new(p.x * 1.03, 0.02 * (20.0 * p.x).sin(), p.y * 0.98));
        let mut settings = settings(Method::Implicit);
        settings.integrator = Integrator::Euler;
        settings.accuracy = 1e-9;
        let mut drape = Drape::new(scene, State::at_rest(x), settings, FRAME).expect("room");
        let energy = |drape: &Drape| {
            let moving = drape
                .scene
                .mass
                .iter()
                .zip(&drape.state().velocities)
                .map(|(m, v)| m * v.length_squared() / 2.0);
            let mut force = vec![DVec3::ZERO; drape.scene.mass.len()];
            moving.sum::<f64>() + drape.scene.elastic.add_gradient(&drape.state().positions, &mut force)
        };
        let first = energy(&drape);
        let mut before = first;
        for step in 0..30 {
            drape.step(FRAME).expect("a step");
            let now = energy(&drape);
            assert!(
                now <= before + 1e-9 * first,
                "{warp} {weft} {bending}, step {step}: {now} J from {before} J"
            );
            before = now;
        }
    }
}

/// Half a second of a kerchief held by a corner, at `size` times its size, `away` from the origin. Masses and N/m stay, N·m grow
/// with the square, gravity with the size: the motion is the same but for its size.
fn swung(size: f64, away: DVec3, method: Method) -> Vec<DVec3> {
    let cloth = flat(Kind::Alternating, DVec2::splat(0.2 * size), [6, 6]);
    let fabric = Fabric::isotropic(1000.0, 0.3, 1e-5 * size * size, 0.2 / (size * size));
    let mut scene = scene(&cloth, &fabric, held_by_a_corner(&cloth));
    scene.gravity *= size;
    let start = State::at_rest(cloth.placed(|p| away + DVec3::new(p.x, 0.0, p.y)));
    let drape = run(scene, start, method, 30);
    drape.state().positions.iter().map(|x| (*x - away) / size).collect()
}

fn farthest(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

#[test]
fn size_and_place_do_not_matter() {
    let edge = 0.2 / 6.0;
    for method in BOTH {
        let usual = swung(1.0, DVec3::ZERO, method);
        for size in [1e-3, 1e-1, 1e1, 1e3] {
            let off = farthest(&usual, &swung(size, DVec3::ZERO, method));
            assert!(off < 1e-4 * edge, "{method:?}: {off} m at {size} times the size");
        }
        let off = farthest(&usual, &swung(1.0, DVec3::new(1e4, -1e4, 1e4), method));
        assert!(off < 1e-4 * edge, "{method:?}: {off} m far away");
    }
}

#[test]
fn what_is_no_number_is_told_and_taken_back() {
    let cloth = flat(Kind::Diagonal, DVec2::splat(0.2), [4, 4]);
    let spoil: [fn(&mut Scene, &mut State); 5] = [
        |scene, _| scene.gravity.y = f64::NAN,
        |scene, _| scene.mass[7] = f64::NAN,
        |scene, _| scene.damping = f64::NAN,
        |_, state| state.positions[7].x = f64::NAN,
        |_, state| state.velocities[7].z = f64::INFINITY,
    ];
    for method in BOTH {
        for (i, spoil) in spoil.iter().enumerate() {
            let mut scene = scene(&cloth, &soft(), held_by_a_corner(&cloth));
            let mut state = State::at_rest(cloth.placed(|p| p.extend(0.0)));
            spoil(&mut scene, &mut state);
            let before = format!("{state:?}");
            let mut drape = Drape::new(scene, state, settings(method), FRAME).expect("room");
            assert!(matches!(drape.step(FRAME), Err(DrapeError::Lost(_))), "{method:?}, input {i}");
            assert_eq!(format!("{:?}", drape.state()), before, "{method:?}, input {i}");
        }
    }
}

/// A ball under a cloth jumps about by up to its own radius a step, then stays: no cloth is left in it.
#[test]
fn a_body_that_jumps_leaves_no_cloth_inside() {
    let radius = 0.1;
    let cloth = flat(Kind::Diagonal, DVec2::splat(0.3), [12, 12]);
    for method in BOTH {
        let TriMesh { positions, triangles } = crate::common::ball(radius, 24, 48);
        let body = |at: DVec3| {
            let positions = positions.iter().map(|x| *x + at).collect();
            Arc::new(Surface::new(TriMesh { positions, triangles: triangles.clone() }).expect("a ball"))
        };
        let mut scene = scene(&cloth, &soft(), vec![false; cloth.points.len()]);
        scene.collider = Some(Collider::still(body(DVec3::ZERO)));
        let start = cloth.placed(|p| DVec3::new(p.x - 0.15, radius + 0.003, p.y - 0.15));
        let mut settings = settings(method);
        settings.accuracy = 1e-4;
        let mut drape = Drape::new(scene, State::at_rest(start), settings, FRAME).expect("room");
        let mut at = DVec3::ZERO;
        for way in [
            (0.05, 0.06, 0.0),
            (-0.08, 0.02, 0.05),
            (0.02, 0.09, -0.03),
            (0.0, -0.02, 0.0),
            (0.06, 0.0, 0.07),
        ] {
            let way = DVec3::from(way);
            at += way;
            drape.scene.collider = Some(Collider { surface: body(at), motion: vec![way; positions.len()] });
            drape.step(FRAME).expect("a step");
        }
        drape.scene.collider = Some(Collider::still(body(at)));
        for _ in 0..20 {
            drape.step(FRAME).expect("a step");
        }
        let deepest =
            drape.state().positions.iter().map(|x| radius - x.distance(at)).fold(f64::MIN, f64::max);
        assert!(deepest < 5e-4, "{method:?}: {deepest} m inside");
    }
}

#[test]
fn cloth_at_rest_does_not_creep_in_a_hundred_thousand_steps() {
    let cloth = flat(Kind::Diagonal, DVec2::splat(0.1), [2, 2]);
    for (method, frames) in [(Method::Implicit, 5_000), (Method::SmallSteps, 100_000)] {
        let mut scene = scene(&cloth, &soft(), cloth.picked(|p| p.y > 0.1 - 1e-9));
        scene.damping = 5.0;
        let start = State::at_rest(cloth.placed(|p| p.extend(0.0)));
        let hung = run(scene, start, method, 600);
        let before = hung.state().clone();
        let after = run(hung.scene, before.clone(), method, frames);
        let crept = farthest(&before.positions, &after.state().positions);
        assert!(crept < 1e-6, "{method:?}: {crept} m");
    }
}

#[test]
fn large_cloth_has_the_same_bits_on_one_and_two_threads() {
    let cloth = flat(Kind::Diagonal, DVec2::splat(0.5), [60, 60]);
    let run = |threads: usize, method: Method, frames: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let mut settings = settings(method);
            (settings.self_collision, settings.accuracy) = (true, 1e-4);
            let held = held_by_a_corner(&cloth);
            let start = State::at_rest(cloth.placed(|p| DVec3::new(p.x, 0.0, p.y)));
            let mut drape = Drape::new(scene(&cloth, &soft(), held), start, settings, FRAME).expect("room");
            (0..frames).for_each(|_| drape.step(FRAME).expect("a step"));
            drape.state().positions.iter().flat_map(|x| x.to_array().map(f64::to_bits)).collect::<Vec<_>>()
        })
    };
    for (method, frames) in [(Method::Implicit, 3), (Method::SmallSteps, 10)] {
        assert!(run(1, method, frames) == run(2, method, frames), "{method:?}");
    }
}
