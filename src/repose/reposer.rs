//! Carries dressed cloth to other poses of its body, always from the pose in which it was dressed, so that errors do not add up.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use rayon::prelude::*;

use crate::body::Surface;
use crate::cloth::{ClothState, Counters, Garment};
use crate::contact::faces::FACE_CLEARANCE;
use crate::contact::{BodyOverlaps, Intersections};
use crate::geometry::parallel::LEAST_SEARCHES;
use crate::geometry::rebuild::Rebuild;
use crate::relax::step::{HEAVY_CONTACT, STEP_CAP};
use crate::relax::{Acceleration, GlobalStep, RelaxSettings, Relaxer, global};
use crate::repose::conform::carried;
use crate::repose::distance_map::DistanceMap;
use crate::repose::excess::Lengths;
use crate::repose::fastened::Fastened;
use crate::repose::folds::Folds;
use crate::repose::pose_path::between;
use crate::repose::settings::{Outcome, ReposeSettings};
use crate::repose::transfer::Transfer;

/// Acceleration of global steps in the same contacts. (Chebyshev's semi-iteration would amplify cloth that intersects itself.)
/// Chosen by trial.
const PACES: [Acceleration; 3] = Acceleration::longer(1.7);
/// Global steps between two looks at what they reached: the strain and folds of the cloth, and whether its layers intersect, which
/// are then separated. Chosen by trial.
pub(super) const STEPS_PER_LOOK: usize = 4;

/// A dressed garment bound to its body.
#[derive(Clone, Debug)]
pub struct Reposer {
    from: Arc<Surface>,
    pub(super) cloth: ClothState,
    map: DistanceMap,
    transfer: Transfer,
    pub(super) lengths: Lengths,
    /// Relaxes towards the shape that every triangle had when bound: strain present then remains.
    pub(super) relaxer: Relaxer,
    /// Solver for intermediate poses, made when first needed.
    rebuild: Option<Arc<Rebuild>>,
    pub(super) folds: Folds,
    fastened: Fastened,
    /// Self-intersections when the cloth was bound.
    crossings: usize,
    /// Parts of the body that overlap each other in the pose.
    pub(super) apart: Option<Arc<BodyOverlaps>>,
    /// Displacement of each vertex from its conformed place in the last preview, in the frame of the skin before it rotated,
    /// metres.
    beside: Option<Vec<DVec3>>,
}

impl Reposer {
    /// Binds `cloth` to `surface`. None when the matrix cannot be factored (out of memory).
    pub fn new(
        garment: &Garment,
        surface: Arc<Surface>,
        cloth: ClothState,
        settings: RelaxSettings,
    ) -> Option<Self> {
        let map = DistanceMap::new(&surface, &cloth);
        let lengths = Lengths::of(garment, &cloth);
        let transfer = Transfer::new(garment, &cloth, surface.scale())?;
        let as_it_lies = Arc::new(with_shape_of(garment, &cloth));
        let mut relaxer = Relaxer::new(as_it_lies, Arc::clone(&surface), settings)?;
        relaxer.set_mapped(&cloth.mapped);
        let (folds, fastened) = (Folds::of(garment, &cloth), Fastened::of(garment));
        let crossings = Intersections::new(garment, &cloth).places.len();
        let (rebuild, apart, beside) = (None, None, None);
        Some(Self {
            from: surface,
            cloth,
            map,
            transfer,
            lengths,
            relaxer,
            rebuild,
            folds,
            fastened,
            crossings,
            apart,
            beside,
        })
    }

    /// The body that the cloth is bound to.
    pub fn from(&self) -> &Arc<Surface> {
        &self.from
    }

    /// Self-intersections of the cloth when it was bound.
    pub fn crossings(&self) -> usize {
        self.crossings
    }

    /// Self-intersections of the cloth in `state`.
    pub(super) fn crossings_of(&self, state: &ClothState) -> usize {
        Intersections::new(&self.relaxer.garment, state).places.len()
    }

    /// The cloth as it was bound.
    pub fn cloth(&self) -> &ClothState {
        &self.cloth
    }

    /// The displacement of each vertex of `cloth`, metres, that goes along with the body from `from` to `to`, a pose a little further
    /// on: with the skin near it, and with its triangles in their shape as far as can be.
    pub fn along(&mut self, from: &Surface, to: &Surface, cloth: &ClothState) -> Vec<DVec3> {
        let map = DistanceMap::new(from, cloth);
        let mut carried = carried(&map, from, to, &cloth.positions);
        self.transfer.join(&self.relaxer.garment, cloth, &mut carried, &mut self.relaxer.counters);
        carried.iter().zip(&cloth.positions).map(|((there, _), here)| *there - *here).collect()
    }

    /// Work counters.
    pub fn counters(&self) -> Counters {
        self.relaxer.counters
    }

    /// The distance map.
    pub fn map(&self) -> &DistanceMap {
        &self.map
    }

    /// Sets how often the matrix is factored again, as `care` requires.
    pub(super) fn refactor(&mut self, care: ReposeSettings) {
        let is_live = care.mends == 0;
        self.relaxer.refactor_beyond(if is_live { global::LIVE_STALE_SHARE } else { global::STALE_SHARE });
    }

    /// Joins the triangles that followed their own skin, see [`Transfer::join`].
    pub(super) fn join(&mut self, carried: &mut [(DVec3, DQuat)]) {
        self.transfer.join(&self.relaxer.garment, &self.cloth, carried, &mut self.relaxer.counters);
    }

    /// Starts a preview from the displacements of the last one, where that strains the cloth less than `joined_p99`: little
    /// changes from one preview to the next.
    pub(super) fn go_on(&self, state: &mut ClothState, carried: &[(DVec3, DQuat)], joined_p99: f64) {
        let Some(beside) = &self.beside else { return };
        let near = |((p, turn), beside): (&(DVec3, DQuat), &DVec3)| *p + *turn * *beside;
        let positions = carried.iter().zip(beside).map(near).collect();
        let near = ClothState { positions, mapped: state.mapped.clone() };
        if self.lengths.p99(&near) < joined_p99 {
            *state = near;
        }
    }

    /// Stores the displacements of a preview for the next one.
    pub(super) fn remember(&mut self, state: &ClothState, carried: &[(DVec3, DQuat)]) {
        let beside = |((p, (q, turn)), _): ((&DVec3, &(DVec3, DQuat)), &bool)| turn.inverse() * (*p - *q);
        self.beside = Some(state.positions.iter().zip(carried).zip(&state.mapped).map(beside).collect());
    }

    /// At most `most` intermediate poses on the way to `to`.
    pub(super) fn between(&mut self, to: &Surface, most: usize) -> Vec<Arc<Surface>> {
        between(&self.from, to, most, &mut self.rebuild)
    }

    /// Finds faces that are too near the body, and raises them from now on. Returns how many there are.
    pub(super) fn lift_faces(&mut self, state: &ClothState) -> usize {
        let clearance = self.relaxer.offset() * FACE_CLEARANCE;
        self.relaxer.lift_faces(state, clearance)
    }

    /// The skin of `body` that each vertex must ignore, given the skin it is bound to: overlapping parts of the body.
    pub(super) fn parts_of(&self, body: &Surface) -> Option<Arc<BodyOverlaps>> {
        let bound: Vec<Option<u32>> =
            (0..self.map.len()).map(|v| self.map.of(v).first().map(|b| b.triangle)).collect();
        BodyOverlaps::of(body, &bound).map(Arc::new)
    }

    /// Whether the strain is within `care`, and the cloth has no more faults than when it was bound.
    pub(super) fn is_well(&mut self, state: &ClothState, care: ReposeSettings, outcome: Outcome) -> bool {
        if outcome.excess_p99 > care.excess || outcome.inside > 0 {
            return false;
        }
        self.relaxer.track(state, 2.0 * self.relaxer.offset());
        // Faces that are too near the body may stay, not such that cut it.
        self.relaxer.lift_faces(state, 0.0) == 0
            && self.folds.count(state) <= self.folds.most
            && self.relaxer.part_layers(state) <= self.crossings
    }

    /// Replaces the body by `body`, with the cloth in `state`.
    pub(super) fn enter(&mut self, body: &Arc<Surface>, state: &ClothState) {
        self.relaxer.change_body(Arc::clone(body));
        self.relaxer.keep_apart(self.apart.clone());
        self.relaxer.forget_motion(state);
    }

    /// Penetration recovery (paper C): P = Q + max(|PQ|, o) n with the exact closest point Q and its pseudonormal n. The length
    /// is the height at which the vertex was bound, so that layers keep their order. Returns how many vertices were inside.
    pub(super) fn recover(&mut self, state: &mut ClothState, heights: &[f64]) -> usize {
        let offset = self.relaxer.offset();
        self.relaxer.track(state, 2.0 * offset);
        let mut inside = 0;
        for v in (0..state.positions.len()).filter(|&v| state.mapped[v]) {
            let Some(plane) = self.relaxer.plane(v as u32) else { continue };
            let height = plane.height(state.positions[v]);
            if height < 0.0 {
                inside += 1;
                // Not lower than the faces round it may be.
                let wanted = heights[v].clamp(FACE_CLEARANCE * offset, 2.0 * offset);
                state.positions[v] = plane.point + plane.normal * wanted;
            }
        }
        inside
    }

    /// Makes the `done`-th global step in these contacts.
    pub(super) fn step(&mut self, state: &mut ClothState, care: ReposeSettings, done: usize) {
        let step = GlobalStep {
            cap: STEP_CAP * self.relaxer.surface.scale(),
            contact: HEAVY_CONTACT,
            hold: 0.0,
            slack: 0.0,
            unfold: care.mends > 0,
            weight: false,
        };
        self.relaxer.global_steps(state, step, &PACES);
        if self.fastened.follow(&self.relaxer.garment, state, self.relaxer.offset()) {
            self.relaxer.forget_motion(state);
        }
        if care.mends > 0 && done.is_multiple_of(STEPS_PER_LOOK) && self.relaxer.part_layers(state) == 0 {
            self.relaxer.ease_parting();
        }
    }

    /// Moves vertices that are still in the body to just above the nearest skin. Returns how many stay inside: between
    /// overlapping parts of a body there is no way out.
    pub(super) fn send_out(&self, state: &mut ClothState) -> usize {
        let surface = &self.relaxer.surface;
        let least = FACE_CLEARANCE * self.relaxer.offset();
        let sent = |(v, (p, &mapped)): (usize, (&mut DVec3, &bool))| {
            let left_out = |t: u32| self.apart.as_ref().is_some_and(|apart| apart.leaves_out(v, t));
            let near = |p: DVec3| surface.nearest_within_but(p, f64::INFINITY, left_out);
            if self.relaxer.is_clear(v as u32, *p) {
                return false;
            }
            // After a move other skin may be the nearest: it is tried again, four times in all.
            for _ in 0..4 {
                match near(*p) {
                    Some(skin) if mapped && skin.distance < 0.0 => *p = skin.point + skin.normal * least,
                    _ => return false,
                }
            }
            near(*p).is_some_and(|skin| skin.distance < 0.0)
        };
        let ClothState { positions, mapped } = state;
        positions
            .par_iter_mut()
            .zip(mapped.par_iter())
            .enumerate()
            .with_min_len(LEAST_SEARCHES)
            .filter_map(|x| sent(x).then_some(()))
            .count()
    }
}

/// `garment` with the present shape of each laid triangle as its rest shape.
fn with_shape_of(garment: &Garment, cloth: &ClothState) -> Garment {
    let mut shaped = garment.clone();
    for (vs, rest) in garment.triangles.iter().zip(&mut shaped.rest) {
        if vs.iter().all(|&v| cloth.mapped[v as usize])
            && let Some(shape) = flat_shape(vs.map(|v| cloth.positions[v as usize]))
        {
            *rest = shape;
        }
    }
    shaped
}

/// A triangle in the plane with its centroid at the origin, counter-clockwise. None where it has no area.
fn flat_shape([a, b, c]: [DVec3; 3]) -> Option<[DVec2; 3]> {
    let (u, v) = (b - a, c - a);
    let (length, size) = (u.length(), u.cross(v).length());
    if size <= f64::EPSILON * length * length || length == 0.0 {
        return None;
    }
    let corners = [DVec2::ZERO, DVec2::new(length, 0.0), DVec2::new(u.dot(v) / length, size / length)];
    let centre = (corners[1] + corners[2]) / 3.0;
    Some(corners.map(|corner| corner - centre))
}
