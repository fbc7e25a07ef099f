//! Relaxation of a garment on a body: global steps with contact in the matrix, and local passes for newly placed cloth.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Surface;
use crate::cloth::{Carry, ClothState, Counters, Garment, Skip};
use crate::contact::faces::Lying;
use crate::contact::splits::{Ground, Suspects};
use crate::contact::{BodyOverlaps, Bones, Faces, Intersections, Plane, Splits, Tracker};
use crate::geometry::crossings::meetings;
use crate::geometry::parallel::LEAST_SHARE;
use crate::relax::acceleration::Acceleration;
use crate::relax::flatten::{Hinges, Lies};
use crate::relax::global::{GlobalSolver, STALE_SHARE};
use crate::relax::goals::turned_rest;
use crate::relax::matching::{Matching, body_normal};
use crate::relax::normals::{normal_round, vertex_normals};
use crate::relax::step::GlobalStep;
use crate::relax::targets::Targets;
use crate::relax::{Memory, RelaxSettings};

/// Force by which touching cloth clings to the skin, in weights of the whole cloth, per unit of friction: four weights at the usual
/// friction of 0.3 (ALGORITHMS.md 1: the friction step is twice the gravity step; contact is uneven).
const CLING: f64 = 4.0 / 0.3;
/// Fraction of the offset that a vertex keeps above its track plane in every step. Chosen by trial; the solve brings it back to the
/// offset.
pub const LEAST_HEIGHT: f64 = 0.5;
/// Distance from the skin within which cloth is tested for being on the wrong side, metres on a body 1.5 m large. Chosen by trial;
/// farther off, as between arm and trunk, the nearest skin is often not that to which the cloth belongs.
const WRONG_SIDE_REACH: f64 = 0.015;
/// Factor on the directions that separate layers, per parting: they fade out, which keeps layers apart for a while.
const STILL_PARTING: f64 = 0.9;

/// Everything that relaxation of one garment on one body needs.
#[derive(Clone)]
pub struct Relaxer {
    /// The cloth.
    pub garment: Arc<Garment>,
    /// The body.
    pub surface: Arc<Surface>,
    /// Settings of the user.
    pub settings: RelaxSettings,
    /// Counters of the work done.
    pub counters: Counters,
    /// Whether edges that cut the body are split.
    pub splitting: bool,
    splits: Splits,
    /// Bones that no edge may cross.
    pub bones: Arc<Bones>,
    tracker: Tracker,
    faces: Faces,
    solver: GlobalSolver,
    hinges: Arc<Hinges>,
    /// For each vertex the height beyond the offset to which its contact is pressed, metres: the scaled multiplier of
    /// the contact constraint.
    push: Vec<f64>,
    /// The weight of contact for which `push` holds.
    contact: f64,
    /// For each vertex the extra offset where a face would cut the body, metres.
    lift: Vec<f64>,
    /// For each vertex the position to which a mark holds it, if any.
    held: Vec<Option<DVec3>>,
    /// For each vertex whether it must not move: pinned, dragged, or not to be rewrapped.
    fixed: Vec<bool>,
    previous: Vec<DVec3>,
    matching: Matching,
    /// Sum over placed triangles and their corners of |w|^2, by which energies are divided, m².
    size: f64,
    weights: Vec<f64>,
    /// For each vertex the force on it, then, after the solve, its move.
    forces: Vec<DVec3>,
    areas: Vec<f64>,
    /// For each vertex the force by which it clings to skin that it touches, per unit of friction.
    cling: Vec<f64>,
    /// For each vertex the normal of the cloth on its front side.
    normals: Vec<DVec3>,
    /// For each vertex the direction away from skin on whose wrong side it was, in steps of `targets::SEND_AWAY`.
    sent: Vec<DVec3>,
    /// For each vertex the direction that separates intersecting layers, in steps of `targets::SEND_AWAY`.
    parted: Vec<DVec3>,
}

impl std::fmt::Debug for Relaxer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Relaxer({} vertices)", self.garment.vertex_count)
    }
}

impl Relaxer {
    /// A relaxer with no triangle mapped. None when the matrix cannot be analysed (out of memory).
    pub fn new(garment: Arc<Garment>, surface: Arc<Surface>, settings: RelaxSettings) -> Option<Self> {
        let n = garment.vertex_count;
        let mut relaxer = Self {
            splitting: false,
            splits: Splits::default(),
            bones: Arc::default(),
            tracker: Tracker::new(n),
            faces: Faces::default(),
            solver: GlobalSolver::new(&garment)?,
            hinges: Arc::new(Hinges::new(&garment)),
            counters: Counters::default(),
            push: vec![0.0; n],
            contact: 0.0,
            lift: vec![0.0; n],
            held: vec![None; n],
            fixed: vec![false; n],
            previous: vec![DVec3::ZERO; n],
            matching: Matching::new(&garment),
            size: 0.0,
            weights: vec![0.0; n],
            forces: vec![DVec3::ZERO; n],
            areas: vertex_areas(&garment),
            cling: vec![0.0; n],
            normals: vec![DVec3::ZERO; n],
            sent: vec![DVec3::ZERO; n],
            parted: vec![DVec3::ZERO; n],
            garment,
            surface,
            settings,
        };
        relaxer.refactor_beyond(STALE_SHARE);
        Some(relaxer)
    }

    /// Memory used, including the cloth that is relaxed.
    pub fn memory(&self) -> Memory {
        let (n, vector) = (self.garment.vertex_count, size_of::<DVec3>());
        let cloth = n * (vector + size_of::<bool>());
        let remembered = n * (3 * vector + 2 * size_of::<f64>() + size_of::<bool>())
            + self.held.len() * size_of::<Option<DVec3>>();
        let [corners, pulls] = self.matching.bytes();
        Memory {
            garment: self.garment.bytes(),
            state: cloth + remembered + self.tracker.bytes() + self.faces.bytes() + self.splits.bytes(),
            tables: self.hinges.bytes() + self.solver.bytes() + corners,
            scratch: pulls + n * (2 * vector + 3 * size_of::<f64>()),
        }
    }

    /// Offset: height above the skin that the cloth keeps, metres.
    pub fn offset(&self) -> f64 {
        self.settings.offset * self.surface.scale()
    }

    /// Holds `vertex` at `target` in global steps with a weight of hold.
    pub fn hold(&mut self, vertex: u32, target: DVec3) {
        self.held[vertex as usize] = Some(target);
    }

    /// Releases all held vertices.
    pub fn release(&mut self) {
        self.held.fill(None);
    }

    /// Fixes exactly these vertices, so that they do not move.
    pub fn fix(&mut self, vertices: impl IntoIterator<Item = u32>) {
        let before = std::mem::replace(&mut self.fixed, vec![false; self.garment.vertex_count]);
        vertices.into_iter().for_each(|v| self.fixed[v as usize] = true);
        if before != self.fixed {
            self.solver.forget_factor();
        }
    }

    /// Sets the fraction (0..=1) of vertices that must gain or lose contact before the matrix is factored again.
    pub fn refactor_beyond(&mut self, share: f64) {
        let skips = self.settings.skips.allow(Skip::Refactor);
        self.solver.refactor_beyond(if skips { share } else { 0.0 });
    }

    /// Updates the track planes of all vertices within `reach` metres of the skin.
    pub fn track(&mut self, state: &ClothState, reach: f64) {
        self.tracker.update(&self.surface, state, reach, self.settings.skips, &mut self.counters);
    }

    /// Sets whether vertices near the skin are tracked by a walk along it, or (false) by exact queries.
    pub fn walk(&mut self, walks: bool) {
        self.tracker.walks = walks;
    }

    /// The track plane of `vertex`, if the skin was near at the last update.
    pub fn plane(&self, vertex: u32) -> Option<Plane> {
        self.tracker.plane(vertex as usize)
    }

    /// Whether `vertex` at `p` is known to be outside of the body. False where it is not known.
    pub fn is_clear(&self, vertex: u32, p: DVec3) -> bool {
        self.tracker.at_least(vertex as usize, p) > 0.0
    }

    /// Normals of the cloth on its front side, one per vertex.
    pub fn cloth_normals(&self, state: &ClothState) -> Vec<DVec3> {
        vertex_normals(&self.garment, state)
    }

    /// Normal of the cloth at one vertex, on its front side.
    pub fn cloth_normal(&self, vertex: u32, state: &ClothState) -> DVec3 {
        normal_round(&self.garment, state, vertex)
    }

    /// Tells that `vertex` was moved to `position` along the normal of its track plane, which stays valid.
    pub fn carried_along_normal(&mut self, vertex: u32, position: DVec3) {
        self.tracker.moved_along_normal(vertex as usize, position);
    }

    /// Raises cloth out of the skin next to it, after it slid so far that its former track planes do not hold.
    pub fn raise_out(&mut self, state: &mut ClothState) {
        let least = self.offset() * LEAST_HEIGHT;
        self.walk(true);
        self.track(state, self.tracker.reach);
        for v in (0..state.positions.len()).filter(|&v| state.mapped[v] && !self.fixed[v]) {
            let Some(plane) = self.tracker.plane(v) else { continue };
            let lacks = least - plane.height(state.positions[v]);
            if lacks > 0.0 {
                state.positions[v] += plane.normal * lacks;
                self.tracker.moved_along_normal(v, state.positions[v]);
            }
        }
    }

    /// Replaces the body by `surface` and forgets all contact with the old one.
    pub fn change_body(&mut self, surface: Arc<Surface>) {
        self.surface = surface;
        self.tracker.forget();
        self.splits = Splits::default();
        self.faces = Faces::default();
        self.push.fill(0.0);
        self.lift.fill(0.0);
        self.sent.fill(DVec3::ZERO);
        self.parted.fill(DVec3::ZERO);
    }

    /// Sets which skin each vertex ignores.
    pub fn keep_apart(&mut self, apart: Option<Arc<BodyOverlaps>>) {
        self.tracker.apart = apart;
        self.tracker.forget();
        self.faces = Faces::default();
    }

    /// Tells that the cloth was moved by something else, so that the move is not taken for sliding.
    pub fn forget_motion(&mut self, state: &ClothState) {
        self.previous.copy_from_slice(&state.positions);
    }

    /// Relative energy of shape matching before the last global step: the sum over triangles and corners of |x - c -
    /// R w|^2, divided by that of |w|^2. About the mean square strain.
    pub fn energy(&self) -> f64 {
        self.matching.energy() / self.size.max(f64::MIN_POSITIVE)
    }

    /// Sets which vertices are placed, and so which triangles take part.
    pub fn set_mapped(&mut self, mapped: &[bool]) {
        let laid = self.garment.triangles.iter().zip(&self.garment.rest);
        let laid = laid.filter(|(vs, _)| vs.iter().all(|&v| mapped[v as usize]));
        self.size = laid.flat_map(|(_, rest)| rest).map(|w| w.length_squared()).sum();
        self.solver.set_triangles(&self.garment, mapped);
    }

    /// Takes over the contact pressure of a `coarser` relaxer, whose edges are `1 / ratio` times as long: at equal
    /// pressure the push on a vertex is proportional to the area round it.
    pub fn take_over(&mut self, coarser: &Self, carry: &Carry, ratio: f64) {
        self.push = carry.values(&coarser.push);
        self.push.iter_mut().for_each(|push| *push *= ratio * ratio);
        self.contact = coarser.contact;
    }

    /// One global step. Returns the largest move of a vertex, metres.
    pub fn global_step(&mut self, state: &mut ClothState, step: GlobalStep) -> f64 {
        self.global_steps(state, step, &[Acceleration::PLAIN])
    }

    /// Global steps in the same contacts, one for each of `paces`. When cloth is inside the body there is one plain
    /// step instead, as the track planes say little about where it will get to. Returns the largest move of a vertex
    /// over all steps, metres.
    pub fn global_steps(&mut self, state: &mut ClothState, step: GlobalStep, paces: &[Acceleration]) -> f64 {
        let offset = self.offset();
        let mut reach = offset * 2.0 + step.cap.min(offset);
        if step.unfold {
            reach = reach.max(WRONG_SIDE_REACH * self.surface.scale());
            self.normals = vertex_normals(&self.garment, state);
        }
        self.tracker.update(&self.surface, state, reach, self.settings.skips, &mut self.counters);
        self.keep_pressure(step.contact);
        self.find_cling(state);
        let weighs = step.weight && self.touches_anything(state);
        let before = state.positions.clone();
        let paces = if self.is_inside(state) { &[Acceleration::PLAIN] } else { paces };
        for &pace in paces {
            let normals = step.unfold.then_some(&*self.normals);
            self.matching.turn(&self.garment, state, &self.tracker, normals, self.settings.rotation);
            let pulls = self.weigh(state, step, weighs, pace.along);
            if !self.solver.solve(&self.weights, &mut self.forces, &pulls, &mut self.counters) {
                break;
            }
            self.go_on(state, pace);
            self.previous.copy_from_slice(&state.positions);
            self.advance(state, step.cap, pace.flattens);
        }
        self.place_split(state);
        before.iter().zip(&state.positions).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max)
    }

    /// Joins split edges that have been clear of the body in many checks.
    pub fn join_edges(&mut self, state: &ClothState) {
        let (tracker, ground) = (&self.tracker, ground(&self.surface, &self.settings));
        self.splits.join(&self.garment, state, tracker, ground, &mut self.counters);
    }

    /// Splits edges that cut the body, of all edges or of `suspects`. Returns the number of new splits.
    pub fn split_edges(&mut self, state: &ClothState, suspects: Option<Suspects<'_>>) -> usize {
        if !self.splitting {
            return 0;
        }
        let (tracker, ground) = (&self.tracker, ground(&self.surface, &self.settings));
        let found = self.splits.split(&self.garment, state, tracker, ground, suspects, &mut self.counters);
        if found > 0 {
            self.place_split(state);
        }
        found
    }

    /// Stops cloth from crossing a bone on its way from `state` to `after`.
    pub fn keep_off_bones(&mut self, state: &ClothState, after: &mut [DVec3]) {
        let known = Some((&self.tracker, self.settings.skips));
        let (garment, before) = (&self.garment, &state.positions);
        self.bones.hold_back(garment, &state.mapped, known, before, after, &mut self.counters);
    }

    /// Updates the positions of the vertices inserted on split edges.
    pub fn place_split(&mut self, state: &ClothState) {
        self.splits.place(state, &self.tracker, ground(&self.surface, &self.settings));
    }

    /// The garment with its split edges and its state; None where no edge is split.
    pub fn drawn(&self, state: &ClothState) -> Option<(Arc<Garment>, ClothState)> {
        self.splits.drawn(state)
    }

    /// Rescales the multipliers to a new contact weight, so that they stand for the same force.
    fn keep_pressure(&mut self, contact: f64) {
        if self.contact > 0.0 && self.contact != contact {
            let factor = self.contact / contact;
            self.push.iter_mut().for_each(|push| *push *= factor);
        }
        self.contact = contact;
    }

    /// Computes for each vertex the force (of its triangles, gravity and friction) and its weight. Returns the moves
    /// to the targets of the weights, metres.
    fn weigh(&mut self, state: &ClothState, step: GlobalStep, weighs: bool, pace: f64) -> Vec<DVec3> {
        let scale = self.surface.scale();
        let targets = Targets {
            tracker: &self.tracker,
            normals: &self.normals,
            sent: &self.sent,
            parted: &self.parted,
            lift: &self.lift,
            held: &self.held,
            previous: &self.previous,
            step,
            pace,
            offset: self.settings.offset * scale,
            friction: self.settings.friction,
            cling: &self.cling,
            reach: WRONG_SIDE_REACH * scale,
            scale,
        };
        let gravity = if weighs { self.settings.gravity } else { 0.0 };
        let (matching, areas, stretch) = (&self.matching, &self.areas, self.settings.stretch);
        let (mapped, fixed) = (&state.mapped, &self.fixed);
        self.push
            .par_iter_mut()
            .zip(&mut self.forces)
            .zip(&mut self.weights)
            .with_min_len(LEAST_SHARE)
            .enumerate()
            .map(|(v, ((push, force), weight))| {
                *force = matching.force(v as u32) * stretch + DVec3::NEG_Y * (gravity * areas[v]);
                let pull;
                (*weight, pull) = match (mapped[v], fixed[v]) {
                    (true, false) => targets.of(v, state.positions[v], push, force),
                    // So heavy that its neighbours, whose triangles weigh 2/3 each, see it as fixed.
                    (true, true) => (1e4, DVec3::ZERO),
                    // Any weight keeps the matrix regular where nothing is placed.
                    (false, _) => (1.0, DVec3::ZERO),
                };
                pull
            })
            .collect()
    }

    fn is_inside(&self, state: &ClothState) -> bool {
        let height = |v: usize| self.tracker.plane(v).map(|plane| plane.height(state.positions[v]));
        (0..state.positions.len()).any(|v| state.mapped[v] && height(v).is_some_and(|h| h < 0.0))
    }

    /// Whether any cloth touches the body. Where none does, gravity is left out, so that the cloth floats and does
    /// not fall for ever.
    fn touches_anything(&self, state: &ClothState) -> bool {
        (0..state.positions.len()).any(|v| self.touches(state, v))
    }

    fn touches(&self, state: &ClothState, v: usize) -> bool {
        let near = 2.0 * self.offset() + self.lift[v];
        state.mapped[v] && self.tracker.plane(v).is_some_and(|p| p.height(state.positions[v]) < near)
    }

    /// Computes the cling of each vertex: cloth clings to skin that it touches, so that its weight alone does not make
    /// it creep down (paper A's threshold). All touching cloth together holds [`CLING`] times the weight of all cloth.
    fn find_cling(&mut self, state: &ClothState) {
        let (mut all, mut touching) = (0.0, 0.0);
        for v in (0..state.positions.len()).filter(|&v| state.mapped[v]) {
            all += self.areas[v];
            touching += if self.touches(state, v) { self.areas[v] } else { 0.0 };
        }
        // Where less than a fiftieth touches, the garment falls.
        let share = if touching > 0.0 { (all / touching).min(50.0) } else { 0.0 };
        let each = CLING * self.settings.gravity * share;
        self.cling.iter_mut().zip(&self.areas).for_each(|(cling, area)| *cling = area * each);
    }

    /// Applies the acceleration `pace` to the solved moves.
    fn go_on(&mut self, state: &ClothState, pace: Acceleration) {
        let before = state.positions.iter().zip(&self.previous);
        for (way, (x, previous)) in self.forces.iter_mut().zip(before) {
            *way = *way * pace.along + (*x - *previous) * pace.on;
        }
    }

    /// Moves the cloth by the solved moves, at most `cap` metres, then flattens, keeps it off the skin and off bones.
    fn advance(&mut self, state: &mut ClothState, cap: f64, flattens: bool) {
        let offset = self.offset();
        let (mapped, fixed) = (&state.mapped, &self.fixed);
        let bends = if flattens { self.hinges.bends(&self.previous, &self.lies(state)) } else { Vec::new() };
        let mut new: Vec<DVec3> = (0..state.positions.len())
            .into_par_iter()
            .with_min_len(LEAST_SHARE)
            .map(|v| {
                let old = self.previous[v];
                if !mapped[v] || fixed[v] {
                    return old;
                }
                let mut shift = self.forces[v].clamp_length_max(cap);
                if flattens {
                    shift += self.hinges.displacement(v as u32, &bends, self.settings.flatten);
                }
                let new = old + shift;
                match self.tracker.plane(v) {
                    Some(plane) => {
                        let low = offset * LEAST_HEIGHT + self.lift[v] - plane.height(new);
                        if low > 0.0 { new + plane.normal * low } else { new }
                    }
                    None => new,
                }
            })
            .collect();
        if !self.bones.is_empty() {
            self.keep_off_bones(state, &mut new);
        }
        state.positions = new;
    }

    /// Contact of each vertex with the body before this step.
    fn lies(&self, state: &ClothState) -> Lies {
        let offset = self.offset();
        let lie = |v: usize| {
            if !state.mapped[v] {
                return (Default::default(), None);
            }
            let Some(plane) = self.tracker.plane(v) else { return (Default::default(), Some(0.0)) };
            let height = plane.height(self.previous[v]) - self.lift[v] - offset;
            ((plane.normal, height), Some(1.0 - (height / offset).clamp(0.0, 1.0)))
        };
        let vertices = (0..state.positions.len()).into_par_iter().with_min_len(LEAST_SHARE);
        let (skin, touch) = vertices.map(lie).unzip();
        Lies { skin, touch }
    }

    /// A local pass over `vertices`: each moves to the mean of its goals in the placed triangles, over-relaxed by
    /// `factor` in 0..=2, and then out of the body.
    pub fn local_pass(&mut self, state: &mut ClothState, vertices: &[u32], triangles: &[u32], factor: f64) {
        let garment = self.garment.clone();
        for &t in triangles {
            let vs = garment.triangles[t as usize];
            let corners = vs.map(|v| state.positions[v as usize]);
            let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
            let n = || body_normal(&self.tracker, &vs).unwrap_or(DVec3::Z);
            let turned = turned_rest(corners, &garment.rest[t as usize], n, self.settings.rotation);
            self.matching.pulls[t as usize] = [0, 1, 2].map(|k| turned[k] + centre - corners[k]);
        }
        self.counters.local_triangles += triangles.len() as u64;
        let offset = self.offset();
        let moved: Vec<DVec3> = vertices
            .iter()
            .map(|&v| {
                let mut sum = DVec3::ZERO;
                let mut count = 0.0;
                for &t in garment.adjacency.vertex_triangles.of(v) {
                    let vs = garment.triangles[t as usize];
                    if vs.iter().all(|&w| state.mapped[w as usize]) {
                        let k = vs.iter().position(|&w| w == v).unwrap_or(0);
                        sum += self.matching.pulls[t as usize][k];
                        count += 1.0;
                    }
                }
                let x = state.positions[v as usize];
                if count == 0.0 || self.fixed[v as usize] { x } else { x + sum / count * factor }
            })
            .collect();
        for (&v, new) in vertices.iter().zip(moved) {
            if self.fixed[v as usize] {
                continue;
            }
            let mut new = new;
            let skips = self.settings.skips;
            if let Some(plane) =
                self.tracker.update_one(v, new, &self.surface, offset * 2.0, skips, &mut self.counters)
            {
                let low = offset - plane.height(new);
                if low > 0.0 {
                    new += plane.normal * low;
                }
            }
            state.positions[v as usize] = new;
        }
    }

    /// Adds directions away from the skin to vertices of faces on the wrong side of the skin next to them, which
    /// belong to another limb. Returns the number of such faces.
    pub fn send_wrong_faces(&mut self, state: &ClothState) -> usize {
        let wrong = self.wrong_faces(state);
        for (vs, away) in self.garment.triangles.iter().zip(&wrong) {
            for &v in vs {
                self.sent[v as usize] += away.unwrap_or_default();
            }
        }
        wrong.iter().flatten().count()
    }

    /// For each face on the wrong side of the skin next to it the direction off that skin; None for the others.
    fn wrong_faces(&mut self, state: &ClothState) -> Vec<Option<DVec3>> {
        let (garment, surface, skips) = (&*self.garment, &*self.surface, self.settings.skips);
        let apart = self.tracker.apart.as_deref();
        self.faces.wrong(Lying { garment, surface, state, skips, split: None, apart }, &mut self.counters)
    }

    /// Number of faults, weighted: intersections of cloth with the body, faces on the wrong side of the skin, and
    /// self-intersections.
    pub fn faults(&mut self, state: &ClothState) -> usize {
        let drawn = self.drawn(state);
        let (garment, drawn) = drawn.as_ref().map_or((&self.garment, state), |(g, s)| (g, s));
        let laid = |e: &[u32; 2]| e.iter().all(|&v| drawn.mapped[v as usize]);
        let edges: Vec<[u32; 2]> = garment.adjacency.edges.iter().copied().filter(laid).collect();
        let (body, winding) = (&self.surface.mesh, self.surface.winding());
        // A self-intersection counts for twenty: finer meshes seldom repair it.
        meetings(&drawn.positions, &edges, body, winding.tree()).len()
            + self.wrong_faces(state).iter().flatten().count()
            + 20 * Intersections::new(&self.garment, state).places.len()
    }

    /// Adds directions that separate intersecting layers. Returns the number of self-intersections.
    pub fn part_layers(&mut self, state: &ClothState) -> usize {
        self.counters.self_tests += 1;
        let met = Intersections::new(&self.garment, state);
        for (parted, way) in self.parted.iter_mut().zip(met.ways(&self.garment, state)) {
            *parted = *parted * STILL_PARTING + way;
        }
        met.places.len()
    }

    /// Fades the directions that separate layers once these are apart: held for ever, they would stay strained.
    pub fn ease_parting(&mut self) {
        for parted in &mut self.parted {
            let eased = *parted * STILL_PARTING;
            // It is dropped below a fiftieth of a unit, which a unit takes some forty times to fade to.
            *parted = if eased.length_squared() > 0.02 * 0.02 { eased } else { DVec3::ZERO };
        }
    }

    /// Extra offset of a vertex, metres, so that the faces round it keep clear of the body.
    pub fn lift(&self, vertex: u32) -> f64 {
        self.lift.get(vertex as usize).copied().unwrap_or_default()
    }

    /// Repairs faces that are too near the body between their vertices: splits edges that cut it, and raises the
    /// offset of the other faces' vertices. Returns the number of such faces.
    pub fn lift_faces(&mut self, state: &ClothState, clearance: f64) -> usize {
        self.join_edges(state);
        let near: Vec<bool> = (0..state.positions.len()).map(|v| self.tracker.plane(v).is_some()).collect();
        let refined = self.splits.refined().cloned();
        let split_state = refined.as_ref().map(|r| self.splits.state(r, state));
        let (garment, surface, skips) = (&*self.garment, &*self.surface, self.settings.skips);
        let split = refined.as_deref().zip(split_state.as_ref());
        let apart = self.tracker.apart.as_deref();
        let lying = Lying { garment, surface, state, skips, split, apart };
        let mut lacking = self.faces.lacking(lying, &near, clearance, &mut self.counters);
        let lack = lacking.iter().filter(|&&l| l > 0.0).count();
        if lack > 0 && self.splitting {
            self.split_lacking(state, &mut lacking);
        }
        let most = self.offset() * 2.0;
        let mut raised = vec![0.0f64; self.lift.len()];
        for (vs, &lack) in self.garment.triangles.iter().zip(&lacking) {
            for &v in vs {
                raised[v as usize] = raised[v as usize].max(lack);
            }
        }
        for (lift, raise) in self.lift.iter_mut().zip(&raised) {
            *lift = (*lift + raise * 0.7).min(most);
        }
        lack
    }

    /// Splits edges of `lacking` faces that cut the body and, next to subdivided faces, edges that are too near it.
    /// If any was split, the other faces wait: they may be clear soon, or the splits may spread to them.
    fn split_lacking(&mut self, state: &ClothState, lacking: &mut [f64]) {
        let garment = self.garment.clone();
        let edges_of = |faces: &mut dyn Iterator<Item = usize>| {
            let mut edges: Vec<u32> = faces.flat_map(|t| garment.adjacency.triangle_edges[t]).collect();
            edges.sort_unstable();
            edges.dedup();
            edges
        };
        let suspects = edges_of(&mut (0..lacking.len()).filter(|&t| lacking[t] > 0.0));
        let mut found = self.split_edges(state, Some(Suspects { edges: &suspects, near: false }));
        let Some(refined) = self.splits.refined().cloned() else { return };
        let mut round = vec![false; lacking.len()];
        for &v in refined.opened.iter().flat_map(|&t| &garment.triangles[t as usize]) {
            garment.adjacency.vertex_triangles.of(v).iter().for_each(|&t| round[t as usize] = true);
        }
        let suspects = edges_of(&mut (0..lacking.len()).filter(|&t| lacking[t] > 0.0 && round[t]));
        found += self.split_edges(state, Some(Suspects { edges: &suspects, near: true }));
        if found > 0 {
            lacking.fill(0.0);
        }
    }
}

/// The body and offset for splitting edges.
fn ground<'a>(surface: &'a Surface, settings: &RelaxSettings) -> Ground<'a> {
    Ground { surface, offset: settings.offset * surface.scale(), skips: settings.skips }
}

/// Rest area round each vertex, square metres.
fn vertex_areas(garment: &Garment) -> Vec<f64> {
    let mut areas = vec![0.0; garment.vertex_count];
    for (vs, rest) in garment.triangles.iter().zip(&garment.rest) {
        let area = (rest[1] - rest[0]).perp_dot(rest[2] - rest[0]) / 2.0;
        for &v in vs {
            areas[v as usize] += area / 3.0;
        }
    }
    areas
}
