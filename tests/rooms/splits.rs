//! Edges that cut the body are split, and joined again: the drawn cloth never shows the body.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;
use toile::body::Surface;
use toile::cloth::{ClothState, Counters, Garment, Skips, build};
use toile::contact::splits::Ground;
use toile::contact::{Splits, Tracker};
use toile::geometry::crossings::meetings;
use toile::relax::{GlobalStep, RelaxSettings, Relaxer};

use crate::common::exact::{cylinder, lowest, quantile, rolled, strains, tube};

/// Thinner than an edge can go round: with these an edge's chord cuts every cylinder below 0.0526 m (ALGORITHMS.md 1.A11).
const RADIUS: f64 = 0.04;
const EDGE: f64 = 0.055;
const OFFSET: f64 = 0.012;

struct Scene {
    garment: Arc<Garment>,
    surface: Arc<Surface>,
    state: ClothState,
}

/// A tube that lies round a thin cylinder at the offset, but for being narrower by the share `tight`.
fn scene(edge: f64, tight: f64) -> Scene {
    let width = PI * (RADIUS + OFFSET);
    let (garment, problems) = build(&tube(width * (1.0 - tight), 0.4), edge);
    assert!(problems.is_empty(), "{problems:?}");
    let surface = Surface::new(cylinder(RADIUS, 1.0, 256, 4)).expect("a body");
    let state = rolled(&garment, width * (1.0 - tight), RADIUS + OFFSET, 0.3);
    Scene { garment: Arc::new(garment), surface: Arc::new(surface), state }
}

fn through(garment: &Garment, state: &ClothState, surface: &Surface) -> usize {
    let body = &surface.mesh;
    meetings(&state.positions, &garment.adjacency.edges, body, &body.tree()).len()
}

impl Scene {
    fn ground(&self) -> Ground<'_> {
        Ground { surface: &self.surface, offset: OFFSET, skips: Skips::default() }
    }

    /// The tube about the same axis, wider by `factor`.
    fn wider(&self, factor: f64) -> ClothState {
        let mut state = self.state.clone();
        state.positions.iter_mut().for_each(|p| *p = DVec3::new(p.x * factor, p.y, p.z * factor));
        state
    }

    fn tracked(&self, state: &ClothState) -> Tracker {
        let mut tracker = Tracker::new(self.garment.vertex_count);
        tracker.update(&self.surface, state, 0.2, Skips::default(), &mut Counters::default());
        tracker
    }

    fn relaxer(&self, splitting: bool) -> Relaxer {
        let offset = OFFSET / self.surface.scale();
        let settings = RelaxSettings { offset, gravity: 0.0, friction: 0.0, ..RelaxSettings::default() };
        let mut relaxer =
            Relaxer::new(self.garment.clone(), self.surface.clone(), settings).expect("enough memory");
        relaxer.set_mapped(&self.state.mapped);
        relaxer.splitting = splitting;
        relaxer
    }
}

#[test]
fn edges_split_where_they_cut_and_join_without_flicker() {
    let scene = scene(EDGE, 0.0);
    let before = through(&scene.garment, &scene.state, &scene.surface);
    assert!(before > 0, "chords cut the cylinder");
    let mut splits = Splits::default();
    let mut counters = Counters::default();
    let mut look = |state: &ClothState, counters: &mut Counters| {
        let tracker = scene.tracked(state);
        splits.split(&scene.garment, state, &tracker, scene.ground(), None, counters);
        splits.join(&scene.garment, state, &tracker, scene.ground(), counters);
        splits.place(state, &tracker, scene.ground());
        splits.drawn(state)
    };
    let (garment, state) = look(&scene.state, &mut counters).expect("split");
    assert_eq!(through(&garment, &state, &scene.surface), 0, "nothing shows");
    assert!(lowest(&scene.surface, &state) > 0.99 * OFFSET);
    let split = counters.split_edges;
    assert!(split >= before as u64 / 2 && counters.edge_tests < counters.edge_checks, "{counters:?}");
    // To and fro over the limit where it cuts: nothing changes.
    let wide = scene.wider(1.25);
    assert_eq!(through(&scene.garment, &wide, &scene.surface), 0);
    for k in 0..60 {
        look(if k % 9 == 0 { &scene.state } else { &wide }, &mut counters);
    }
    assert_eq!((counters.split_edges, counters.joined_edges), (split, 0));
    // Off for good: joined after ten looks, and the garment is the plain one again.
    look(&scene.state, &mut counters);
    let far = scene.wider(2.0);
    for k in 0..11 {
        assert_eq!(look(&far, &mut counters).is_none(), k >= 9, "look {k}");
    }
    assert_eq!(counters.joined_edges, split);
}

/// Round a limb too thin for its edges cloth stays at about the offset when they are split: their chords are shorter than
/// the way round, which takes it some millimetres off. Lifted off the limb by those chords it does not stay on it.
#[test]
fn split_cloth_fits_a_thin_limb() {
    let scene = scene(EDGE, 0.03);
    let step = GlobalStep { cap: 0.02, contact: 0.03, hold: 0.0, slack: 0.0, unfold: true, weight: false };
    let relaxed = |splitting: bool| {
        let mut relaxer = scene.relaxer(splitting);
        let mut state = scene.state.clone();
        for _ in 0..12 {
            (0..150).for_each(|_| {
                relaxer.global_step(&mut state, step);
            });
            if relaxer.lift_faces(&state, OFFSET * 0.25) == 0 {
                break;
            }
        }
        let plain = (Arc::clone(&scene.garment), state.clone());
        let (garment, drawn) = relaxer.drawn(&state).unwrap_or(plain);
        assert_eq!(through(&garment, &drawn, &scene.surface), 0, "splitting {splitting}");
        let heights = state.positions.iter().map(|&p| scene.surface.nearest(p).distance / OFFSET - 1.0);
        let heights: Vec<f64> = heights.collect();
        let off = quantile(&heights, 0.95);
        let strain = quantile(&strains(&garment, &drawn), 0.99);
        println!("splitting {splitting}: off by {off:.3} offsets, p99 {strain:.4}, {:?}", relaxer.counters);
        (off, strain, relaxer.counters)
    };
    let (lifted, _, none) = relaxed(false);
    let (off, strain, counters) = relaxed(true);
    assert_eq!((none.split_edges, none.edge_checks), (0, 0));
    assert!(counters.split_edges > 0 && counters.joined_edges == 0, "{counters:?}");
    assert!(counters.factorisations <= none.factorisations, "dependents are in no matrix");
    assert!(off < 0.7 && off < lifted / 2.0 && strain < 0.1, "off by {off}, strained by {strain}");
}

/// On a body no edge cuts: the same bits whether edges may be split or not, and no work for it but the looks.
#[test]
fn nothing_split_costs_nothing() {
    let scene = scene(0.02, 0.03);
    let step = GlobalStep { cap: 0.02, contact: 0.03, hold: 0.0, slack: 0.0, unfold: true, weight: true };
    let relaxed = |splitting: bool| {
        let mut relaxer = scene.relaxer(splitting);
        let mut state = scene.state.clone();
        for _ in 0..50 {
            relaxer.global_step(&mut state, step);
        }
        relaxer.lift_faces(&state, OFFSET * 0.25);
        assert!(relaxer.drawn(&state).is_none());
        (state, relaxer.counters)
    };
    assert!(relaxed(true) == relaxed(false));
}
