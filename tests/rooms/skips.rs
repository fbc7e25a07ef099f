//! What is skipped changes nothing: cloth dressed and dragged with and without each skip.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;
use toile::body::{Surface, mannequin};
use toile::cloth::{ClothState, Counters, Fabric, Garment, Skip, Skips, build};
use toile::drag::{DragMode, Dragging, Ray};
use toile::drape::{DrapedGarment, DrapedSettings};
use toile::relax::{GlobalStep, RelaxSettings, Relaxer};
use toile::session::samples::Sample;
use toile::session::{Command, Session};
use toile::sim::{Runner, Simulation, Snapshot};

use crate::common::exact::{cylinder, quantile, rolled, strains, tube};

const RADIUS: f64 = 0.15;
const OFFSET: f64 = 0.004;
const EDGE: f64 = 0.025;

/// A coarse T-shirt dressed on the mannequin, and the hash of the cloth.
fn dressed(skips: Skips) -> (Snapshot, u64) {
    let mut project = Sample::Tshirt.project(&mannequin::default());
    project.document.settings.edge_length = 0.03;
    let mut session = Session::new(project, Runner::inline(Simulation::default()));
    session.runner().simulation().expect("inline").set_skips(skips);
    session.apply_alone(Command::Wrap).expect("wrapped");
    let simulation = session.runner().simulation().expect("inline");
    while simulation.tick() {}
    (simulation.snapshot(), simulation.hash())
}

/// The hash of a coarse T-shirt dressed on the mannequin, the work, and its p99 strain.
fn shirt(skips: Skips) -> (u64, Counters, f64) {
    let (snapshot, hash) = dressed(skips);
    let garment = snapshot.garment.expect("a garment");
    let p99 = quantile(&strains(&garment, &snapshot.cloth), 0.99);
    (hash, snapshot.stats.work, p99)
}

/// Certificates, walks round the last triangle and remembered faces: the same bits with a fraction of the queries.
#[test]
fn exact_skips_change_no_bit_of_a_dressed_shirt() {
    let (usual, with, _) = shirt(Skips::default());
    for skip in Skip::ALL.into_iter().filter(|skip| skip.is_exact()) {
        let (hash, without, _) = shirt(Skips::without(&[skip]));
        assert_eq!(hash, usual, "{}", skip.name());
        let asked = |c: Counters| c.contact_queries + c.contact_gaps + c.face_queries;
        println!("{}: {} queries, {} without", skip.name(), asked(with), asked(without));
        assert!(asked(with) < asked(without) || skip == Skip::Bones, "{}", skip.name());
    }
    let all: Vec<Skip> = Skip::ALL.into_iter().filter(|skip| skip.is_exact()).collect();
    assert_eq!(shirt(Skips::without(&all)).0, usual);
}

/// Contact keeps draped cloth from crossing itself and the body, so that crossings need not be sought: the same bits.
#[test]
fn draped_cloth_that_cannot_cross_is_not_searched_for_crossings() {
    let (snapshot, _) = dressed(Skips::default());
    let (garment, body) = (snapshot.garment.expect("a garment"), snapshot.body.expect("a body"));
    let cotton = Fabric::preset("cotton").expect("a preset");
    let draped = |skips| {
        let (mut cloth, fabrics) = (snapshot.cloth.as_ref().clone(), BTreeMap::new());
        let settings = DrapedSettings { strain: 0.01, self_collision: true, skips };
        let (garment, body) = (Arc::clone(&garment), Arc::clone(&body));
        let mut worn = DrapedGarment::new(garment, &cloth, body, (&fabrics, cotton), &[], settings)
            .expect("it can be draped");
        while !worn.progress().at_rest {
            worn.tick(&mut cloth).expect("it stays in place");
        }
        (cloth, worn.counters.self_tests)
    };
    let (cloth, tests) = draped(Skips::default());
    let (same, all) = draped(Skips::without(&[Skip::Crossings]));
    assert!(cloth == same);
    assert!(2 * tests < all, "{tests} searches, {all} without the skip");
}

/// A skip that takes another way to rest leads to another place: friction holds cloth where it comes to lie. It is as well
/// dressed there. Where there is but one place of rest, see `cloth_comes_to_rest_in_the_same_place`.
#[test]
fn other_skips_leave_a_shirt_as_well_dressed() {
    let (_, _, usual) = shirt(Skips::default());
    for skip in Skip::ALL.into_iter().filter(|skip| !skip.is_exact()) {
        let (_, counters, p99) = shirt(Skips::without(&[skip]));
        println!("{}: p99 {p99:.4} against {usual:.4}, {counters:?}", skip.name());
        // Without coarser meshes its longest swings are not over when it seems to lie still.
        let near = if skip == Skip::Fine { 0.04 } else { 0.01 };
        assert!((p99 - usual).abs() < near, "{}: p99 strain {p99}, not {usual}", skip.name());
    }
}

/// A tube a little too narrow for a cylinder, one vertex of it fixed: it has one place of rest.
struct Tight {
    garment: Arc<Garment>,
    surface: Arc<Surface>,
    state: ClothState,
}

fn tight() -> Tight {
    let width = PI * (RADIUS + OFFSET) * 0.97;
    let (garment, _) = build(&tube(width, 0.2), EDGE);
    let surface = Surface::new(cylinder(RADIUS, 1.0, 512, 2)).expect("a body");
    let mut state = rolled(&garment, width, RADIUS + OFFSET, 0.35);
    // Not at rest: here it stands off the skin, there it lies in it.
    for p in state.positions.iter_mut().skip(1) {
        *p += DVec3::new((9.0 * p.y).sin(), (7.0 * p.x).cos(), (8.0 * p.y).cos()) * 0.012;
    }
    Tight { garment: Arc::new(garment), surface: Arc::new(surface), state }
}

impl Tight {
    fn relaxer(&self, skips: Skips) -> Relaxer {
        let settings = RelaxSettings {
            offset: OFFSET / self.surface.scale(),
            gravity: 0.0,
            friction: 0.0,
            skips,
            ..RelaxSettings::default()
        };
        let mut relaxer =
            Relaxer::new(self.garment.clone(), self.surface.clone(), settings).expect("enough memory");
        relaxer.set_mapped(&self.state.mapped);
        relaxer
    }

    fn at_rest(&self, skips: Skips) -> ClothState {
        let mut relaxer = self.relaxer(skips);
        relaxer.fix([0]);
        let mut state = self.state.clone();
        let step =
            GlobalStep { cap: 0.02, contact: 0.03, hold: 0.0, slack: 0.0, unfold: true, weight: false };
        let mut moved = 0.0;
        for _ in 0..3000 {
            moved = relaxer.global_step(&mut state, step);
            if moved < 1e-9 * EDGE {
                break;
            }
        }
        println!("moved {:.1e} l in the last step", moved / EDGE);
        state
    }
}

/// Where a skip takes another way to rest, it is to the same place: 1e-5 edge lengths. A plane kept while its vertex moved
/// by less than 0.2 mm is another plane at rest too, turned by up to 0.08 degrees on this body: 5e-3.
#[test]
fn cloth_comes_to_rest_in_the_same_place() {
    let tight = tight();
    let usual = tight.at_rest(Skips::default());
    for skip in [Skip::Refactor, Skip::Certificates, Skip::Triangles, Skip::Planes] {
        let other = tight.at_rest(Skips::without(&[skip]));
        let apart = usual.positions.iter().zip(&other.positions).map(|(a, b)| (*a - *b).length());
        let apart = apart.fold(0.0, f64::max) / EDGE;
        println!("{}: {apart:.2e} l", skip.name());
        assert!(apart < if skip == Skip::Planes { 5e-3 } else { 1e-5 }, "{}: {apart:.2e} l", skip.name());
    }
}

/// The same for cloth in the hand: tick by tick the same bits.
#[test]
fn exact_skips_change_no_bit_of_a_drag() {
    let tight = tight();
    let hand = 7;
    let dragged = |skips| {
        let mut state = tight.state.clone();
        let relaxer = tight.relaxer(skips);
        let mut dragging = Dragging::new(relaxer, &state, hand, DVec3::ZERO, DragMode::Surface, &[]);
        let at = state.positions[hand as usize];
        let mut places = Vec::new();
        for tick in 1..40 {
            let angle = at.x.atan2(at.z) + 0.02 * f64::from(tick);
            let out = DVec3::new(angle.sin(), 0.0, angle.cos());
            dragging.drag_to(Ray { origin: out + DVec3::Y * at.y, direction: -out });
            dragging.step(&mut state, true);
            places.push(state.clone());
        }
        places
    };
    let usual = dragged(Skips::default());
    for skip in Skip::ALL.into_iter().filter(|skip| skip.is_exact()) {
        assert!(dragged(Skips::without(&[skip])) == usual, "{}", skip.name());
    }
}

/// Paper A's limitation: a track point found by walking misses parts of the body that the cloth never lay on. Cloth that
/// comes to another limb from afar, or from above, finds it.
#[test]
fn parts_never_covered_are_found() {
    let mut two = cylinder(0.05, 1.0, 64, 4);
    let other = cylinder(0.05, 1.0, 64, 4);
    let count = two.positions.len() as u32;
    two.positions.extend(other.positions.iter().map(|p| *p + DVec3::X * 0.25));
    two.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + count)));
    let surface = Surface::new(two).expect("two limbs");
    let mut tracker = toile::contact::Tracker::new(1);
    let mut counters = Counters::default();
    let mut state = ClothState { positions: vec![DVec3::new(0.054, 0.5, 0.0)], mapped: vec![true] };
    for step in 0..=4000 {
        // Along one limb, then across to the other in small steps, then onto its lid from above.
        let s = f64::from(step) / 4000.0;
        let p = match step {
            0..2000 => DVec3::new(0.054 + s * 0.29, 0.5, 0.0),
            _ => DVec3::new(0.25, 1.2 - (s - 0.5) * 0.39, 0.0),
        };
        state.positions[0] = p;
        tracker.update(&surface, &state, 0.02, Skips::default(), &mut counters);
        let exact = surface.nearest(p);
        match tracker.plane(0) {
            Some(plane) => assert!((plane.height(p) - exact.distance).abs() < 1e-5, "{step}: {exact:?}"),
            None => assert!(exact.distance > 0.02, "{step}: {exact:?}"),
        }
    }
    assert!(counters.contact_walks > 100, "{counters:?}");
}
