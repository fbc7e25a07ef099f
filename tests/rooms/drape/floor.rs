//! The floor under a body: cloth lies on it, slips over it with friction, and is not found below.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::body::{Surface, mannequin};
use toile::cloth::{ClothState, Fabric, GRAVITY, Garment, Skips, build};
use toile::contact::Intersections;
use toile::drape::{DrapedGarment, DrapedSettings};
use toile::geometry::shapes::icosphere;
use toile::pattern::{Pattern, Piece};

/// Rate at which air damps motion, 1/s, as for every garment.
const AIR: f64 = 1.5;
/// Distance that cloth keeps from bodies and the floor besides its own thickness, metres.
const SKIN: f64 = 0.001;

fn figure() -> Arc<Surface> {
    Arc::new(Surface::new(mannequin::default().mesh.clone()).expect("a body"))
}

/// A rectangle `size` metres large where `place` lays it, with the vertices held whose place in the pattern `is_held`.
fn cloth(
    size: DVec2,
    body: Arc<Surface>,
    place: impl Fn(DVec2) -> DVec3,
    is_held: impl Fn(DVec2) -> bool,
) -> (Arc<Garment>, ClothState, DrapedGarment) {
    made((size, true), body, place, is_held)
}

/// The same, which may collide with itself or not.
fn made(
    (size, self_collision): (DVec2, bool),
    body: Arc<Surface>,
    place: impl Fn(DVec2) -> DVec3,
    is_held: impl Fn(DVec2) -> bool,
) -> (Arc<Garment>, ClothState, DrapedGarment) {
    let corners = [(0.0, 0.0), (size.x, 0.0), (size.x, size.y), (0.0, size.y)].map(DVec2::from);
    let mut pattern = Pattern::default();
    pattern.add_piece(Piece::polygon("cloth", &corners));
    let (garment, _) = build(&pattern, 0.03);
    let garment = Arc::new(garment);
    let count = garment.vertex_count;
    let mut cloth = ClothState { positions: vec![DVec3::ZERO; count], mapped: vec![true; count] };
    let mut pins = Vec::new();
    for corner in &garment.corners {
        cloth.positions[corner.vertex as usize] = place(corner.uv);
        if is_held(corner.uv) {
            pins.push(corner.vertex);
        }
    }
    let settings = DrapedSettings { strain: 0.01, self_collision, skips: Skips::default() };
    let fabrics = (&BTreeMap::new(), Fabric::preset("cotton").expect("a preset"));
    let worn = DrapedGarment::new(Arc::clone(&garment), &cloth, body, fabrics, &pins, settings);
    (garment, cloth, worn.expect("it can be draped"))
}

fn rested(worn: &mut DrapedGarment, cloth: &mut ClothState) {
    while !worn.progress().at_rest {
        worn.tick(cloth).expect("it stays in place");
    }
    assert!(!worn.progress().restless, "{:?}", worn.progress());
}

fn heights(cloth: &ClothState) -> (f64, f64) {
    let heights = cloth.positions.iter().map(|p| p.y);
    heights.fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(y), high.max(y)))
}

/// What lies beside the mannequin, flat, `height` metres above the floor.
fn beside(height: f64) -> impl Fn(DVec2) -> DVec3 {
    move |uv| DVec3::new(1.5 + uv.x, height, -uv.y)
}

#[test]
fn cloth_that_falls_comes_to_lie_on_the_floor() {
    let body = figure();
    let floor = body.floor().expect("it stands on one");
    assert_eq!(floor, body.bounds().0.y);
    let (_, mut cloth, mut worn) = cloth(DVec2::splat(0.3), body, beside(floor + 0.3), |_| false);
    rested(&mut worn, &mut cloth);
    let (low, high) = heights(&cloth);
    assert!((low - floor - worn.offset()).abs() < 1e-6 && high - low < 1e-4, "{low} to {high}");
}

/// Thrown along the floor it is slowed by friction and air: dv/dt = -µg - cv. Without collision with itself, whose planes stand between
/// parts of the cloth that move side by side.
#[test]
fn cloth_slips_over_the_floor_as_far_as_friction_lets_it() {
    let body = figure();
    let cotton = Fabric::preset("cotton").expect("a preset");
    let floor = body.floor().expect("it stands on one");
    let on_it = beside(floor + cotton.thickness_m + SKIN);
    let (_, mut cloth, mut worn) = made((DVec2::splat(0.3), false), body, on_it, |_| false);
    let before = cloth.clone();
    let speed = 1.0;
    worn.set_velocities(&vec![DVec3::X * speed; cloth.positions.len()]);
    rested(&mut worn, &mut cloth);
    let ways = cloth.positions.iter().zip(&before.positions).map(|(to, from)| *to - *from);
    let mean = ways.sum::<DVec3>() / cloth.positions.len() as f64;
    let (slows, air) = (cotton.friction * GRAVITY.length(), cotton.damping_per_s + AIR);
    let expected = speed / air - slows / (air * air) * (air * speed / slows).ln_1p();
    assert!((mean.x - expected).abs() < 0.02 * expected, "{} not {expected}", mean.x);
    assert!(mean.y.abs() < 1e-4 && mean.z.abs() < 1e-4, "{mean}");
}

/// A train: what is longer than it is high lies on the floor, in folds, and the rest hangs.
#[test]
fn a_train_lies_on_the_floor() {
    let body = figure();
    let floor = body.floor().expect("it stands on one");
    let place = |uv: DVec2| DVec3::new(1.5 + uv.x, floor + 0.02 + 0.725 * uv.y, 0.688 * (0.8 - uv.y));
    let (garment, mut cloth, mut worn) = cloth(DVec2::new(0.2, 0.8), body, place, |uv| uv.y > 0.8 - 1e-9);
    rested(&mut worn, &mut cloth);
    let (low, high) = heights(&cloth);
    assert!(low > floor + 0.9 * worn.offset() && high > floor + 0.59, "{low} to {high}");
    // At least 20 of its 80 cm; a little more where it is curved.
    let lies = cloth.positions.iter().filter(|p| p.y < floor + 0.02).count();
    assert!(5 * lies >= cloth.positions.len(), "{lies} of {}", cloth.positions.len());
    assert!(Intersections::new(&garment, &cloth).places.is_empty());
}

/// Cloth that was placed below the floor is raised out of it slowly, and does not come to cross itself.
#[test]
fn cloth_that_begins_below_the_floor_comes_up() {
    let body = figure();
    let floor = body.floor().expect("it stands on one");
    let place = |uv: DVec2| DVec3::new(1.5 + uv.x, floor + uv.y - 0.3, 0.02 * (20.0 * uv.y).sin());
    let (garment, mut cloth, mut worn) = cloth(DVec2::new(0.2, 0.6), body, place, |uv| uv.y > 0.6 - 1e-9);
    for _ in 0..10 {
        let before = heights(&cloth).0;
        worn.tick(&mut cloth).expect("it stays in place");
        assert!(heights(&cloth).0 - before < 0.02, "it is not thrown up");
    }
    rested(&mut worn, &mut cloth);
    let low = heights(&cloth).0;
    assert!(low > floor + 0.9 * worn.offset(), "{low}");
    assert!(Intersections::new(&garment, &cloth).places.is_empty());
}

/// Nobody knows how high a bust stands: there is no floor.
#[test]
fn only_what_looks_human_stands_on_a_floor() {
    let ball = Surface::new(icosphere(0.3, 3)).expect("a ball");
    assert_eq!(ball.floor(), None);
    assert_eq!(ball.reposed(ball.mesh.positions.clone()).expect("as many vertices").floor(), None);
}

/// In another pose a body stands on the same floor, though none of its feet may be on it.
#[test]
fn the_floor_stays_where_it_is_when_the_body_moves() {
    let body = figure();
    let floor = body.floor();
    let moved = |by: f64| {
        let positions = body.mesh.positions.iter().map(|p| *p + DVec3::Y * by).collect();
        body.reposed(positions).expect("as many vertices").floor()
    };
    assert_eq!(moved(0.3), floor, "it jumps");
    assert_eq!(moved(-0.1), floor.map(|floor| floor - 0.1), "and does not sink into it");
}
