//! Small steps on a graphics card, here in software, against exact answers and the processor's. Without an adapter these tests
//! say so and pass.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::body::Surface;
use toile::card::{Body, Card, CardFault, CardSteps, Cloth, Hand, Shares, Span, Spring};
use toile::cloth::Fabric;
use toile::drape::forces::limits::StrainLimits;
use toile::drape::solver::small_steps::substeps;
use toile::drape::{Drape, DrapeSettings, Integrator, Method, Scene, State};
use toile::geometry::crossings::{meetings, self_crossings};
use toile::geometry::mesh::TriMesh;
use toile::geometry::shapes;

use super::meshes::{KINDS, Kind, flat, scene};

/// Seconds of a frame.
const FRAME: f64 = 1.0 / 60.0;
const GRAVITY: f64 = 10.0;
/// Nearly inextensible cloth.
const STIFFNESS: f64 = 5000.0;
const THICKNESS: f64 = 0.003;

fn card() -> Option<Arc<Card>> {
    match Card::find(true) {
        Ok(card) => Some(Arc::new(card)),
        Err(why) => {
            assert!(std::env::var_os("TOILE_REQUIRE_ADAPTER").is_none(), "{why}");
            println!("skipped: {why}");
            None
        }
    }
}

/// A square of 1 m², level, `height` metres up, with pins where `held` says.
struct Sheet {
    scene: Scene,
    start: Vec<DVec3>,
    springs: Vec<Spring>,
}

impl Sheet {
    fn new(kind: Kind, cells: u32, height: f64, held: impl Fn(DVec2) -> bool) -> Self {
        let flat = flat(kind, DVec2::ONE, [cells; 2]);
        let fabric = Fabric::isotropic(STIFFNESS, 0.3, 4e-5, 0.2);
        let mut scene = scene(&flat, &fabric, flat.picked(held));
        scene.damping = 0.0;
        let start = flat.placed(|p| DVec3::new(p.x - 0.5, height, 0.5 - p.y));
        let limits = StrainLimits::new(&scene.sheet, 0.0, STIFFNESS);
        let springs = limits.springs().map(|(ends, length, stiffness)| Spring { ends, length, stiffness });
        Self { springs: springs.collect(), scene, start }
    }

    /// Small steps in a frame for 1 % of strain, as [`Drape`] takes them.
    fn substeps(&self) -> f64 {
        let edge = self.scene.sheet.mean_edge();
        substeps(FRAME, 0.01, GRAVITY, (0.5 / edge).min(4.0), edge) as f64
    }

    fn strain(&self, x: &[DVec3]) -> f64 {
        let strain =
            |s: &Spring| (x[s.ends[0] as usize].distance(x[s.ends[1] as usize]) / s.length - 1.0).abs();
        let mut all: Vec<f64> = self.springs.iter().map(strain).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() * 99 / 100]
    }

    fn fall(&self, x: &[DVec3]) -> f64 {
        self.start.iter().zip(x).map(|(before, after)| before.y - after.y).sum::<f64>() / x.len() as f64
    }

    fn mesh(&self, x: &[DVec3]) -> TriMesh {
        TriMesh { positions: x.to_vec(), triangles: self.scene.sheet.triangles.clone() }
    }
}

/// A sheet on a card.
struct Run<'a> {
    sheet: &'a Sheet,
    steps: CardSteps,
    state: State,
    inverse_mass: Vec<f64>,
    count: usize,
    hand: Option<Hand>,
}

impl<'a> Run<'a> {
    fn new(card: Arc<Card>, sheet: &'a Sheet, ball: Option<&Surface>) -> Self {
        let Scene { sheet: mesh, mass, pinned, elastic, .. } = &sheet.scene;
        let rows: Vec<Vec<(u32, f64)>> = (0..mesh.len()).map(|v| elastic.bending.row(v).collect()).collect();
        let friction = vec![0.3; mesh.len()];
        let cloth = Cloth {
            triangles: &mesh.triangles,
            adjacency: &mesh.adjacency,
            springs: &sheet.springs,
            limit: f64::INFINITY,
            bending: &rows,
            mass,
            area: &mesh.vertex_area,
            friction: &friction,
            thickness: ball.map(|_| THICKNESS),
        };
        let normals = ball.map(Surface::pseudonormals).unwrap_or_default();
        let body = ball.map(|ball| Body { mesh: &ball.mesh, adjacency: &ball.adjacency, normals: &normals });
        let steps = CardSteps::new(card, &cloth, body.as_ref(), &sheet.start).expect("room");
        let count = (sheet.substeps() * steps.slowness()).ceil() as usize;
        let inverse = |(m, held): (&f64, &bool)| if *held { 0.0 } else { 1.0 / m };
        let inverse_mass = mass.iter().zip(pinned).map(inverse).collect();
        Self { sheet, steps, state: State::at_rest(sheet.start.clone()), inverse_mass, count, hand: None }
    }

    fn frame(&mut self) -> Result<(), CardFault> {
        let lift = vec![0.0; self.inverse_mass.len()];
        let span = Span {
            small: FRAME / self.count as f64,
            gravity: DVec3::NEG_Y * GRAVITY,
            damping: self.sheet.scene.damping,
            bending_damping: 0.0,
            offset: THICKNESS,
            grip: f64::INFINITY,
            ease: 0.3,
            eases_off_body: false,
            lift: &lift,
            inverse_mass: &self.inverse_mass,
            hand: self.hand,
        };
        let State { positions, velocities } = &mut self.state;
        self.steps.run((positions, velocities), &span, self.count)
    }

    fn frames(&mut self, count: usize) -> &[DVec3] {
        (0..count).for_each(|_| self.frame().expect("a frame"));
        &self.state.positions
    }
}

fn on_pins(p: DVec2) -> bool {
    p.y < 1e-9 && (p.x < 1e-9 || p.x > 1.0 - 1e-9)
}

#[test]
fn cloth_falls_on_a_card_as_galileo_says() {
    let Some(card) = card() else { return };
    let sheet = Sheet::new(Kind::Jittered, 8, 0.0, |_| false);
    let mut run = Run::new(card, &sheet, None);
    let small = FRAME / run.count as f64;
    let x = run.frames(12).to_vec();
    let time = 12.0 * FRAME;
    // Steps of this kind are exact but for a small step of lead.
    let exact = GRAVITY * time * (time + small) / 2.0;
    assert!((sheet.fall(&x) - exact).abs() < 1e-5, "{} not {exact}", sheet.fall(&x));
    assert!(sheet.strain(&x) < 1e-6, "{}", sheet.strain(&x));
    let speeds = run.state.velocities.iter().map(|v| (v.y + GRAVITY * time).abs()).fold(0.0, f64::max);
    assert!(speeds < 1e-4, "{speeds}");
}

#[test]
fn a_sheet_swings_on_a_card_as_on_the_processor() {
    let Some(card) = card() else { return };
    let sheet = Sheet::new(Kind::Alternating, 14, 0.0, on_pins);
    let mut run = Run::new(card, &sheet, None);
    let settings = DrapeSettings {
        method: Some(Method::SmallSteps),
        strain: 0.01,
        thickness: THICKNESS,
        friction: 0.3,
        self_collision: false,
        integrator: Integrator::Bdf2,
        stiffness: STIFFNESS,
        accuracy: 1e-4,
    };
    let start = State::at_rest(sheet.start.clone());
    let mut drape = Drape::new(sheet.scene.clone(), start, settings, FRAME).expect("a drape");
    for frame in 1..=24 {
        run.frames(1);
        drape.step(FRAME).expect("a step");
        let [ours, theirs] = [&run.state.positions, &drape.state().positions].map(|x| sheet.fall(x));
        assert!((ours / theirs - 1.0).abs() < 0.02 || frame < 4, "frame {frame}: {ours} not {theirs}");
    }
    assert!(sheet.strain(&run.state.positions) < 0.02, "{}", sheet.strain(&run.state.positions));
}

#[test]
fn cloth_on_a_ball_crosses_neither_it_nor_itself_on_a_card() {
    let Some(card) = card() else { return };
    let ball = Surface::new(shapes::icosphere(0.3, 4)).expect("a ball");
    let sheet = Sheet::new(Kind::Alternating, 18, 0.32, |_| false);
    let mut run = Run::new(card, &sheet, Some(&ball));
    for frame in 1..=16 {
        let x = run.frames(1);
        let deepest = x.iter().map(|x| 0.3 - x.length()).fold(f64::MIN, f64::max);
        assert!(deepest < 1e-4, "frame {frame}: {deepest} m in the ball");
        let (mesh, edges) = (sheet.mesh(x), &sheet.scene.sheet.adjacency.edges);
        assert_eq!(self_crossings(&mesh, edges, &mesh.tree()).len(), 0, "frame {frame}");
        assert_eq!(meetings(x, edges, &ball.mesh, &ball.mesh.tree()).len(), 0, "frame {frame}");
    }
    assert!(sheet.fall(&run.state.positions) > 0.15, "{}", sheet.fall(&run.state.positions));
    assert!(run.steps.detections > 16);
}

#[test]
fn the_same_cloth_gives_the_same_bits_twice_on_a_card() {
    let Some(card) = card() else { return };
    let ball = Surface::new(shapes::icosphere(0.3, 3)).expect("a ball");
    let sheet = Sheet::new(Kind::Jittered, 10, 0.305, |_| false);
    let [one, other] = [0, 1].map(|_| Run::new(Arc::clone(&card), &sheet, Some(&ball)).frames(10).to_vec());
    assert_eq!(one, other);
    assert!(one.iter().any(|x| x.length() < 0.306), "it touches the ball");
}

/// Corrections of all springs at once grow where they are too large: on the pins a limp sheet would fly apart.
#[test]
fn every_kind_of_mesh_stays_stable_on_a_card() {
    let Some(card) = card() else { return };
    for kind in KINDS {
        let mut sheet = Sheet::new(kind, 8, 0.0, on_pins);
        sheet.scene.damping = 4.0;
        // Crumpled: neighbours are displaced by a third of an edge.
        for (v, x) in sheet.start.iter_mut().enumerate() {
            let way = |k: usize| ((v * k) % 17) as f64 / 16.0 - 0.5;
            *x += DVec3::new(way(5), way(7), way(11)) * 0.08;
        }
        let mut run = Run::new(Arc::clone(&card), &sheet, None);
        run.frames(20);
        let fastest = run.state.velocities.iter().map(|v| v.length()).fold(0.0, f64::max);
        assert!(fastest < 8.0, "{kind:?}: {fastest} m/s");
        assert!(
            sheet.strain(&run.state.positions) < 0.06,
            "{kind:?}: {}",
            sheet.strain(&run.state.positions)
        );
    }
}

#[test]
fn shares_are_smaller_where_more_springs_meet() {
    for kind in KINDS {
        let sheet = Sheet::new(kind, 12, 0.0, |_| false);
        let inverse: Vec<f64> = sheet.scene.mass.iter().map(|m| 1.0 / m).collect();
        let shares = Shares::new(&sheet.springs, &inverse);
        assert!(shares.most.iter().all(|&share| share > 0.05 && share < 0.7), "{kind:?}");
        // No vertex can be overshot by all of its springs together: the bound by rows is above that by eigenvalues.
        let mut whole = vec![0.0; inverse.len()];
        for (spring, share) in sheet.springs.iter().zip(&shares.most) {
            let [wa, wb] = spring.ends.map(|v| inverse[v as usize]);
            for (v, w) in spring.ends.into_iter().zip([wa, wb]) {
                whole[v as usize] += share * w / (wa + wb);
            }
        }
        assert!(whole.iter().all(|&sum| sum < 4.0 / 3.0), "{kind:?}");
    }
}

#[test]
fn a_vertex_is_dragged_on_a_card() {
    let Some(card) = card() else { return };
    let sheet = Sheet::new(Kind::Diagonal, 6, 0.0, on_pins);
    let mut run = Run::new(card, &sheet, None);
    let target = sheet.start[24] + DVec3::new(0.0, 0.1, 0.05);
    run.hand = Some(Hand { vertex: 24, target, stiffness: 600.0, most: 100.0 });
    let x = run.frames(30);
    assert!(x[24].distance(target) < 0.05, "{}", x[24].distance(target));
}

#[test]
fn what_a_card_cannot_do_is_told_and_changes_nothing() {
    let Some(card) = card() else { return };
    let ball = Surface::new(shapes::icosphere(0.3, 3)).expect("a ball");
    // Half of the sheet is in the ball.
    let sheet = Sheet::new(Kind::Diagonal, 8, 0.1, |_| false);
    let mut run = Run::new(Arc::clone(&card), &sheet, Some(&ball));
    assert_eq!(run.frame(), Err(CardFault::Touching));
    assert_eq!(run.state.positions, sheet.start);
    let far = Sheet::new(Kind::Diagonal, 4, 9.0, |_| false);
    let mut run = Run::new(Arc::clone(&card), &far, Some(&ball));
    assert_eq!(run.frame(), Err(CardFault::Far));
    let mut lost = Run::new(card, &sheet, None);
    lost.state.velocities[3].x = f64::NAN;
    assert!(matches!(lost.frame(), Err(CardFault::Lost(_))));
    assert_eq!(lost.state.positions, sheet.start);
}
