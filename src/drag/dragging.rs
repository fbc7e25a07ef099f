//! A drag in steps: the cloth follows the pointer in substeps short enough to be stable, and relaxes after each.
//!
//! The *hand* is the dragged vertex.

use std::sync::Arc;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::cloth::{ClothState, Counters, EdgeMetric, Garment};
use crate::drag::Graph;
use crate::drag::transport::motions;
use crate::relax::step::STEP_CAP;
use crate::relax::{Acceleration, GlobalStep, RelaxSettings, Relaxer, global};

/// Largest move of a vertex in a substep, in edge lengths (ALGORITHMS.md 1.A5).
const SUBSTEP: f64 = 0.25;
/// Most substeps in a tick; the rest of a fast drag waits for later ticks.
const MOST_SUBSTEPS: usize = 4;
/// Height above the skin up to which cloth follows it, metres on a body 1.5 m large (paper A).
const FOLLOWS: f64 = 0.036;
/// Pull towards the skin: the fraction, in a whole substep, of the move by which the paper halves the distance to the
/// skin in every step. It fades with height, see [`PULLED`]: loose cloth that is sucked in has nowhere to go and folds.
const PULL: f64 = 0.02;
/// Height above the offset, in offsets, at which the pull towards the skin has faded to zero.
const PULLED: f64 = 2.0;
/// Cosine between pointer ray and normal below which the ray is too oblique to tell where on the skin the cloth should go.
const GRAZING: f64 = 0.1;
/// Weight of the hand in relaxation, on the matrix diagonal: soft, so that a pull that the cloth cannot follow does
/// not tear it.
const HAND_WEIGHT: f64 = 1.0;
/// Weight of contact while dragging: light, so that strained cloth slides.
const CONTACT: f64 = 0.01;
/// Acceleration of the global steps of a relaxation: error components that a plain step reduces by less than a fifth
/// are too slow to be seen.
const PACES: [Acceleration; 3] = Acceleration::chebyshev(0.2);
/// Distance from the pointer at which the hand has arrived, in edge lengths.
const ARRIVED: f64 = 1e-3;
/// Largest move in a tick, in edge lengths, below which the tick counts as quiet; see [`QUIET_TICKS`].
const STILL: f64 = 0.01;
/// Number of quiet ticks in a row after which the cloth is still.
const QUIET_TICKS: usize = 5;

/// How the cloth follows the hand (paper A, Figure 7).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DragMode {
    /// All cloth slides along the skin as one.
    #[default]
    Surface,
    /// Only the hand is moved; relaxation brings the rest along.
    Vertex,
    /// All cloth is translated in space.
    Rigid,
}

/// Pointer ray into the scene, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ray {
    /// Origin of the ray, metres.
    pub origin: DVec3,
    /// Direction of the ray; any length but zero.
    pub direction: DVec3,
}

impl Ray {
    /// Whether the ray is finite and its direction not zero.
    pub fn is_valid(&self) -> bool {
        self.origin.is_finite() && self.direction.is_finite() && self.direction.length() > 1e-12
    }

    fn nearest_to(&self, p: DVec3) -> DVec3 {
        let d = self.direction.normalize();
        self.origin + d * (p - self.origin).dot(d).max(0.0)
    }

    /// Intersection of the ray with the plane through `p` perpendicular to `normal`; for an oblique ray the point of
    /// the plane nearest to the ray's nearest point to `p`.
    fn on_plane(&self, p: DVec3, normal: DVec3) -> DVec3 {
        let d = self.direction.normalize();
        let cos = d.dot(normal);
        let t = (p - self.origin).dot(normal) / cos;
        if cos.abs() > GRAZING && t > 0.0 {
            return self.origin + d * t;
        }
        let near = self.nearest_to(p);
        near - normal * (near - p).dot(normal)
    }
}

/// A drag in progress.
#[derive(Clone, Debug)]
pub struct Dragging {
    relaxer: Relaxer,
    graph: Arc<Graph>,
    mode: DragMode,
    hand: u32,
    /// From the hand to the point where the cloth was grabbed, metres.
    beside: DVec3,
    pins: Vec<u32>,
    pointer: Option<Ray>,
    edge_length: f64,
    quiet: usize,
    substeps: u64,
}

impl Dragging {
    /// Grabs the cloth at the vertex `hand`; the pointer is at `beside` (m) from it. `pins` stay in place.
    pub fn new(
        mut relaxer: Relaxer,
        state: &ClothState,
        hand: u32,
        beside: DVec3,
        mode: DragMode,
        pins: &[u32],
    ) -> Self {
        let metric = EdgeMetric::new(&relaxer.garment);
        let graph = Arc::new(Graph::new(&metric, hand, pins, &state.mapped));
        let fixed_hand = (mode == DragMode::Vertex).then_some(hand);
        relaxer.release();
        relaxer.hold(hand, state.positions[hand as usize]);
        relaxer.fix(pins.iter().copied().chain(fixed_hand));
        relaxer.track(state, FOLLOWS * relaxer.surface.scale());
        relaxer.refactor_beyond(global::LIVE_STALE_SHARE);
        relaxer.splitting = true;
        relaxer.counters.drag_vertices += graph.len() as u64;
        let edge_length = relaxer.garment.mean_edge();
        Self {
            relaxer,
            graph,
            mode,
            hand,
            beside,
            pins: pins.to_vec(),
            pointer: None,
            edge_length,
            quiet: 0,
            substeps: 0,
        }
    }

    /// Sets the target of the drag to a pointer ray. An invalid ray is ignored.
    pub fn drag_to(&mut self, pointer: Ray) {
        if pointer.is_valid() {
            self.pointer = Some(pointer);
            self.quiet = 0;
        }
    }

    /// Changes the settings of relaxation.
    pub fn set_settings(&mut self, settings: RelaxSettings) {
        self.relaxer.settings = settings;
        self.quiet = 0;
    }

    /// Ends the drag. The relaxer is returned for settling; pins are still fixed.
    pub fn into_relaxer(mut self) -> Relaxer {
        self.relaxer.release();
        self.relaxer.refactor_beyond(global::STALE_SHARE);
        self.relaxer.fix(self.pins);
        self.relaxer
    }

    /// Whether the cloth is still, so that another step would change almost nothing.
    pub fn is_still(&self) -> bool {
        self.quiet >= QUIET_TICKS
    }

    /// The garment with its split edges and its state; None where no edge is split.
    pub fn drawn(&self, state: &ClothState) -> Option<(Arc<Garment>, ClothState)> {
        self.relaxer.drawn(state)
    }

    /// Number of substeps done.
    pub fn substeps(&self) -> u64 {
        self.substeps
    }

    /// Counters of the work done.
    pub fn counters(&self) -> Counters {
        self.relaxer.counters
    }

    /// For each vertex the fraction of the drag that reaches it, 0..=1.
    pub fn shares(&self) -> Vec<f32> {
        self.graph.shares(self.relaxer.garment.vertex_count)
    }

    /// One tick: substeps towards the pointer, each followed by a relaxation when `relaxing`. Same input, same bits.
    pub fn step(&mut self, state: &mut ClothState, relaxing: bool) {
        let mut moved = 0.0f64;
        for substep in 0..MOST_SUBSTEPS {
            let wanted = self.motion(state);
            let longest = SUBSTEP * self.edge_length;
            let motion = wanted.clamp_length_max(longest);
            let on = substep + 1 < MOST_SUBSTEPS && wanted.length() > longest + ARRIVED * self.edge_length;
            // The last relaxation queries the skin exactly; before it a walk is enough.
            self.relaxer.walk(on || (substep > 0 && relaxing));
            let arrived = motion.length() < ARRIVED * self.edge_length;
            if arrived && substep > 0 {
                break;
            }
            self.substeps += 1;
            if !arrived {
                moved = moved.max(self.move_along(state, motion));
            }
            self.relaxer.walk(on);
            if relaxing {
                moved = moved.max(self.relax(state));
            }
        }
        self.relaxer.split_edges(state, None);
        self.relaxer.join_edges(state);
        self.relaxer.place_split(state);
        self.quiet = if moved < STILL * self.edge_length { self.quiet + 1 } else { 0 };
    }

    /// The move of the hand that the pointer asks for, metres.
    fn motion(&self, state: &ClothState) -> DVec3 {
        let (Some(pointer), false) = (self.pointer, self.graph.is_empty()) else { return DVec3::ZERO };
        let x = state.positions[self.hand as usize];
        if self.mode != DragMode::Surface {
            return pointer.nearest_to(x + self.beside) - self.beside - x;
        }
        let normal = match self.relaxer.plane(self.hand) {
            Some(plane) => plane.normal,
            None => self.relaxer.cloth_normal(self.hand, state),
        };
        let taken = x + self.beside - normal * self.beside.dot(normal);
        pointer.on_plane(taken, normal) - taken
    }

    /// Moves the hand and the cloth that follows it. Returns how far the hand moved, metres.
    fn move_along(&mut self, state: &mut ClothState, motion: DVec3) -> f64 {
        if self.relaxer.bones.is_empty() {
            self.carry(state, motion);
            return motion.length();
        }
        let before = state.clone();
        self.carry(state, motion);
        self.relaxer.keep_off_bones(&before, &mut state.positions);
        let hand = self.hand as usize;
        self.relaxer.hold(self.hand, state.positions[hand]);
        self.relaxer.forget_motion(state);
        state.positions[hand].distance(before.positions[hand])
    }

    fn carry(&mut self, state: &mut ClothState, motion: DVec3) {
        let reach = FOLLOWS * self.relaxer.surface.scale();
        match self.mode {
            DragMode::Vertex => state.positions[self.hand as usize] += motion,
            DragMode::Rigid => {
                self.graph.steps().for_each(|(v, share, _)| state.positions[v as usize] += motion * share);
            }
            DragMode::Surface => {
                // The track planes from before the last relaxation are accurate enough for directions.
                let cloth = self.relaxer.cloth_normals(state);
                let normals = self.frame_normals(state, &cloth, reach);
                let motions = motions(&self.graph, &state.positions, &normals, motion);
                let heights = self.heights(state);
                for (v, share, _) in self.graph.steps() {
                    state.positions[v as usize] += motions[v as usize] * share;
                }
                self.relaxer.track(state, reach);
                let pull = PULL * (motion.length() / (SUBSTEP * self.edge_length)).min(1.0);
                self.follow_skin(state, &cloth, &heights, pull);
            }
        }
        self.relaxer.hold(self.hand, state.positions[self.hand as usize]);
        self.relaxer.forget_motion(state);
    }

    /// Paper A's temporary normals: those of the skin near it, those of the cloth far from it, blended between.
    fn frame_normals(&self, state: &ClothState, cloth: &[DVec3], reach: f64) -> Vec<DVec3> {
        let offset = self.relaxer.offset();
        (0..cloth.len())
            .map(|v| {
                let Some(plane) = self.relaxer.plane(v as u32) else { return cloth[v] };
                let far = (plane.height(state.positions[v]) - 2.0 * offset) / (reach - 2.0 * offset);
                let far = far.clamp(0.0, 1.0);
                (plane.normal * (1.0 - far) + cloth[v] * far).try_normalize().unwrap_or(plane.normal)
            })
            .collect()
    }

    fn heights(&self, state: &ClothState) -> Vec<f64> {
        let height = |(v, &x): (usize, &DVec3)| {
            self.relaxer.plane(v as u32).map_or(f64::INFINITY, |plane| plane.height(x))
        };
        state.positions.iter().enumerate().map(height).collect()
    }

    /// Keeps the height of cloth above the skin along which it slides, and pulls it a little nearer.
    fn follow_skin(&mut self, state: &mut ClothState, cloth: &[DVec3], before: &[f64], pull: f64) {
        let (offset, follows) = (self.relaxer.offset(), FOLLOWS * self.relaxer.surface.scale());
        for (v, share, _) in self.graph.steps() {
            let i = v as usize;
            let Some(plane) = self.relaxer.plane(v) else { continue };
            let x = state.positions[i];
            let height = plane.height(x);
            if height > follows || plane.normal.dot(cloth[i]) <= 0.0 {
                continue;
            }
            // Pressed cloth is a little deeper than the offset; relaxation determines how deep.
            let floor = before[i].clamp(offset * 0.5, offset);
            let kept = height.min(before[i]).max(floor);
            let near = (1.0 - (kept - offset) / (PULLED * offset)).clamp(0.0, 1.0);
            let pulled = kept + ((kept / 2.0).max(floor) - kept) * pull * near;
            // Move it wholly out of the skin, but towards the skin only by its share of the drag.
            let wanted = if height < floor { floor } else { height + (pulled - height) * share };
            state.positions[i] = x + plane.normal * (wanted - height);
            self.relaxer.carried_along_normal(v, state.positions[i]);
        }
    }

    fn relax(&mut self, state: &mut ClothState) -> f64 {
        let cap = STEP_CAP * self.relaxer.surface.scale();
        let step =
            GlobalStep { cap, contact: CONTACT, hold: HAND_WEIGHT, slack: 0.0, unfold: true, weight: true };
        // In the other modes relaxation determines how far the rest of the cloth follows: one plain step, as in the paper.
        let paces = match self.mode {
            DragMode::Surface => &PACES[..],
            _ => &[Acceleration::PLAIN],
        };
        let moved = self.relaxer.global_steps(state, step, paces);
        // On coarse cloth moves are long: the track planes may not be the skin at the new position.
        if moved > self.relaxer.offset() {
            self.relaxer.raise_out(state);
        }
        moved
    }
}
