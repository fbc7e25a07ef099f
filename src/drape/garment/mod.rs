//! Simulation of a garment on a body at rest: draped by small steps until the garment rests too.
//!
//! Small steps are used, not implicit ones, by measurement (`toile bench speed`): on a body most of a garment is held by contact,
//! the parts that hang free are short, and then few small steps suffice.

mod calm;
mod carry;
pub mod clear;
mod hanging;
mod laid;
mod lift;
pub mod on_card;
mod rest;
mod routes;
pub mod sewing;
mod tangles;
mod worked;

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::body::Surface;
use crate::cloth::{ClothState, Counters, Fabric, GRAVITY, Garment, Skips};
use crate::contact::{Faces, Obstacle, Separation, separation};
use crate::drape::contact::body::Collider;
use crate::drape::forces::bending::Bending;
use crate::drape::garment::calm::{calming, gentle};
use crate::drape::garment::hanging::Hanging;
use crate::drape::garment::laid::{ordered, shortest_sides, springs};
use crate::drape::garment::lift::LIFTING;
use crate::drape::garment::on_card::OnCard;
use crate::drape::garment::tangles::{PARTING, Pulling};
use crate::drape::garment::worked::{Worked, plates, weighted};
use crate::drape::sheet::Sheet;
use crate::drape::solver::advance::Advance;
use crate::drape::solver::net::Spring;
use crate::drape::solver::small_steps::{GrabConstraint, SmallSteps, stable_rate};
use crate::drape::solver::surroundings::Surroundings;
use crate::drape::solver::ties::SewingSpring;
use crate::drape::state::State;
use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, words};

/// Simulated time of a tick, seconds.
pub const TICK: f64 = 1.0 / 60.0;
/// Step in which what is placed is moved until nothing is in its way, metres: pieces off inner layers, waypoints of seams off the body.
/// It bounds how much farther than needed they come to be.
const SEARCH_STEP: f64 = 0.01;
/// Clearance that cloth keeps from the skin besides its own thickness, metres: skin yields by about as much.
const SKIN: f64 = 0.001;
/// Rate at which air damps motion, 1/s. Chosen by trial; it bounds for how long what hangs freely swings.
const AIR: f64 = 1.5;
/// Stiffness-proportional damping of bending, seconds. Chosen by trial; it bounds for how long folds tremble. More would need
/// softer bending or shorter steps.
const BENDING_DAMPING: f64 = 0.001;
/// Largest contact pressure that friction sees, Pa: a few times the weight of cloth per area. More pressure than that comes from
/// strain control, whose single pass per small step acts far softer than the cloth is; under friction of the full pressure, tight
/// cloth would keep whatever strain it came with (ALGORITHMS.md 0.5).
const GRIP: f64 = 10.0;
/// Work in one call of [`DrapedGarment::go_on`]: vertices moved in small steps plus pairs of features tested, or triangles tested
/// for intersections while deep ones are pulled out; about 0.03 s.
const MOST_WORK: u64 = 60_000;
/// Stiffness of the drag constraint, N/m; it pulls with at most the weight of the garment. Chosen by trial: it bounds how far cloth
/// lags behind the hand.
const HAND: f64 = 60.0;

/// Settings of a [`DrapedGarment`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrapedSettings {
    /// Strain beyond which cloth is rigid, 1e-3..=0.2.
    pub strain: f64,
    /// Whether the cloth collides with itself.
    pub self_collision: bool,
    /// Which savings of work are allowed.
    pub skips: Skips,
}

/// Why a garment cannot be draped, in words.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Undrapable(pub Words);

/// State of convergence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Ticks since the simulation began or was disturbed.
    pub ticks: u64,
    /// Unbalanced force as a share of the weight: Σ m |Δv| / Δt over the weight.
    pub residual: f64,
    /// Speed of the fastest vertex, m/s.
    pub speed: f64,
    /// Whether the cloth rests, or is left as it is.
    pub at_rest: bool,
    /// Whether it is left as it is though it still moves.
    pub restless: bool,
}

/// Parts that do not change during a simulation.
#[derive(Debug)]
struct Fixed {
    garment: Arc<Garment>,
    sheet: Sheet,
    hanging: Hanging,
    /// Garment vertex of each simulated vertex: the draped ones, in an order in which neighbours are near in memory.
    vertices: Vec<u32>,
    /// Simulated vertex of each garment vertex; `u32::MAX` where it is not draped.
    own: Vec<u32>,
    bending: Bending,
    springs: Vec<Spring>,
    mass: Vec<f64>,
    friction: Vec<f64>,
    offset: f64,
    thickness: f64,
    damping: f64,
}

/// A garment simulated on a body.
#[derive(Clone, Debug)]
pub struct DrapedGarment {
    fixed: Arc<Fixed>,
    collider: Arc<Collider>,
    obstacle: Arc<Obstacle>,
    settings: DrapedSettings,
    small: SmallSteps,
    /// While pieces are being sewn: for each simulated vertex the vertex of the sewn garment that it will become. None otherwise.
    will_be: Option<Vec<u32>>,
    state: State,
    faces: Faces,
    /// Displacement of each vertex in the last tick, metres.
    ways: Vec<DVec3>,
    pinned: Vec<bool>,
    substeps: usize,
    /// Whether gravity is off; friction is then off too, except as `rubs` says.
    floats: bool,
    /// Friction coefficient per vertex while `floats`, above zero only for cloth of inner layers; None: no friction.
    rubs: Option<Vec<f64>>,
    progress: Progress,
    /// Time scale of a tick, above 0 and up to 1: see [`rest`].
    pace: f64,
    /// Whether it goes on from rest: see [`DrapedGarment::resume`].
    resumes: bool,
    quiet: u32,
    /// Self-intersections at the last check.
    crossings: usize,
    /// Fewest self-intersections since there were none, and how many separation steps in a row did not lower that.
    parting: (usize, u32),
    /// How many attempts in a row to pull out deep intersections failed.
    in_vain: u32,
    /// The tick that is partly done.
    begun: Option<Box<Begun>>,
    /// Time for which it has been let down, seconds of unslowed time; infinite where it was not.
    age: f64,
    /// The attempt under way to pull out deep intersections.
    pulling: Option<Box<Pulling>>,
    /// Faces too near the body at the last check.
    lacking: usize,
    /// Checks since the cloth last moved that found it too near the body: raising it had no effect.
    lifted_in_vain: i32,
    /// The garment on a graphics card, if one is used.
    card: Option<OnCard>,
    /// Whether a card has moved it.
    was_on_card: bool,
    /// Work done.
    pub counters: Counters,
}

impl DrapedGarment {
    /// Simulates the draped part of `garment` from its position in `cloth`. Fabrics are `fabrics` by piece, else `default`.
    /// Vertices `pins` are held.
    pub fn new(
        garment: Arc<Garment>,
        cloth: &ClothState,
        surface: Arc<Surface>,
        (fabrics, default): (&BTreeMap<PieceId, Fabric>, &Fabric),
        pins: &[u32],
        settings: DrapedSettings,
    ) -> Result<Self, Undrapable> {
        let mut worn = Self::made(garment, cloth, surface, (fabrics, default), pins, settings, None)?;
        worn.separate(cloth);
        Ok(worn)
    }

    /// Simulates open pieces that are to be sewn: `garment` is the open one, and the last pair holds the sewn garment and the
    /// vertex of it that each open vertex becomes. There is neither gravity nor friction; a tick has `substeps` small steps.
    pub fn unsewn(
        garment: Arc<Garment>,
        cloth: &ClothState,
        surface: Arc<Surface>,
        fabrics: (&BTreeMap<PieceId, Fabric>, &Fabric),
        settings: DrapedSettings,
        (sewn, becomes): (Arc<Garment>, Arc<Vec<u32>>),
        substeps: usize,
    ) -> Result<Self, Undrapable> {
        let will_be = Some((&*sewn, &becomes[..], substeps));
        let mut worn = Self::made(garment, cloth, surface, fabrics, &[], settings, will_be)?;
        let will_be = worn.fixed.vertices.iter().map(|&v| becomes[v as usize]).collect();
        worn.will_be = Some(will_be);
        worn.separate(cloth);
        Ok(worn)
    }

    fn made(
        garment: Arc<Garment>,
        cloth: &ClothState,
        surface: Arc<Surface>,
        (fabrics, default): (&BTreeMap<PieceId, Fabric>, &Fabric),
        pins: &[u32],
        settings: DrapedSettings,
        sewn: Option<(&Garment, &[u32], usize)>,
    ) -> Result<Self, Undrapable> {
        let laid = laid_triangles(&garment, cloth);
        let (vertices, own) = ordered(&garment, &laid);
        let fabric = |t: usize| fabrics.get(&garment.triangle_pieces[t]).unwrap_or(default);
        let triangles = laid.iter().map(|&t| garment.triangles[t].map(|v| own[v as usize])).collect();
        let rest: Vec<[DVec2; 3]> = laid.iter().map(|&t| garment.rest[t]).collect();
        let sheet = Sheet::new(vertices.len(), triangles, rest)
            .map_err(|why| Undrapable(words!("the cloth cannot be draped: {why}", why = why.words())))?;
        let of_triangle: Vec<&Fabric> = laid.iter().map(|&t| fabric(t)).collect();
        let beside = |sheet: &Sheet, v: u32| of_triangle[sheet.adjacency.vertex_triangles.of(v)[0] as usize];
        let positions: Vec<DVec3> = vertices.iter().map(|&v| cloth.positions[v as usize]).collect();
        let (sheet, mut worked) = Worked::new(sheet, &garment, &own, beside, sewn.map(|_| &positions[..]));
        let mass = weighted(masses(&sheet, &of_triangle), &garment, &own, sewn.is_some());
        let most = |of: fn(&Fabric) -> f64| of_triangle.iter().map(|f| of(f)).fold(0.0, f64::max);
        let (thickness, damping) = (most(|f| f.thickness_m), most(|f| f.damping_per_s));
        let friction = (0..sheet.len() as u32).map(|v| beside(&sheet, v).friction).collect();
        let hanging = Hanging::new(&sheet, settings.strain);
        let count = sewn.map_or_else(|| hanging.steps_a_tick(&positions), |(.., substeps)| substeps);
        let slow = stable_rate(TICK / count as f64, BENDING_DAMPING);
        let plates = plates(&garment, &own, sheet.len(), |v| beside(&sheet, v).bending);
        let bending = Bending::slower_than(slow, &mass, &sheet, |v| &plates[v as usize]);
        let pinned = among(pins, &own, sheet.len());
        let length = shortest_lengths(&garment, sewn, &vertices);
        let springs = worked.bands.take_springs(springs(&sheet, &of_triangle, length));
        let mut small =
            SmallSteps::of(springs.iter().copied(), settings.strain, &sheet, &bending, &mass, &pinned);
        worked.give(&mut small, thickness);
        Ok(Self {
            settings,
            small: small.easing(),
            will_be: None,
            ways: vec![DVec3::ZERO; sheet.len()],
            state: State::at_rest(positions),
            faces: Faces::default(),
            pinned,
            substeps: count,
            floats: sewn.is_some(),
            rubs: None,
            progress: Progress { ticks: 0, residual: 1.0, speed: 0.0, at_rest: false, restless: false },
            pace: 1.0,
            resumes: false,
            quiet: 0,
            crossings: 0,
            parting: (usize::MAX, 0),
            in_vain: 0,
            begun: None,
            age: f64::INFINITY,
            pulling: None,
            lacking: 0,
            lifted_in_vain: 0,
            card: None,
            was_on_card: false,
            counters: Counters::default(),
            obstacle: Arc::new(Obstacle::of(&surface)),
            collider: Arc::new(Collider::still(surface)),
            fixed: Arc::new(Fixed {
                garment,
                sheet,
                hanging,
                vertices,
                own,
                bending,
                springs,
                mass,
                friction,
                offset: thickness + SKIN,
                thickness,
                damping: damping + AIR,
            }),
        })
    }

    /// Turns on self-collision: nothing that does not intersect yet can from now on. Existing intersections begin to be
    /// separated.
    fn separate(&mut self, cloth: &ClothState) {
        if !self.settings.self_collision {
            return;
        }
        let Fixed { sheet, thickness, .. } = &*self.fixed;
        let rest: Vec<f64> = (0..sheet.adjacency.edges.len()).map(|e| sheet.rest_length(e)).collect();
        self.small.separation = Some(Separation::new(
            &sheet.triangles,
            &sheet.adjacency,
            (&rest, *thickness),
            self.will_be.clone(),
            Some(Arc::clone(&self.obstacle)),
        ));
        self.part(&mut cloth.clone());
    }

    /// Begins damped: see [`gentle`]. For cloth that nobody watches or holds, since it also falls slowly.
    pub fn let_down(mut self) -> Self {
        self.age = 0.0;
        self
    }

    /// The state of convergence.
    pub fn progress(&self) -> Progress {
        self.progress
    }

    /// Offset from the skin, metres.
    pub fn offset(&self) -> f64 {
        self.fixed.offset
    }

    /// Height of the floor, metres. None where there is none, and for cloth that floats: it may be placed lower.
    fn floor(&self) -> Option<f64> {
        self.collider.surface.floor().filter(|_| !self.floats)
    }

    /// Number of small steps in a tick.
    pub fn substeps(&self) -> usize {
        self.substeps
    }

    /// Self-intersections, and faces too near the body, at the last checks.
    pub fn faults(&self) -> (usize, usize) {
        (self.crossings, self.lacking)
    }

    /// Work counters of collision of the cloth with itself and the body.
    pub fn separation(&self) -> separation::Counters {
        self.small.separation.as_ref().map(|separation| separation.counters).unwrap_or_default()
    }

    /// Work counters of collision since they were last taken; resets them.
    pub fn take_separation(&mut self) -> separation::Counters {
        let taken = self.small.separation.as_mut().map(|separation| std::mem::take(&mut separation.counters));
        taken.unwrap_or_default()
    }

    /// Replaces the set of pinned vertices; cloth at rest wakes.
    pub fn pin(&mut self, pins: &[u32]) {
        let fixed = Arc::clone(&self.fixed);
        self.pinned = among(pins, &fixed.own, self.pinned.len());
        self.small.pin(&fixed.mass, &self.pinned);
        for (v, velocity) in self.state.velocities.iter_mut().enumerate() {
            if self.pinned[v] {
                *velocity = DVec3::ZERO;
            }
        }
        self.hold_otherwise();
    }

    /// Begins to drag `vertex`, with its present position as the target. Does nothing where no cloth is draped.
    pub fn take(&mut self, vertex: u32) {
        let Some(v) = own_number(&self.fixed.own, vertex) else { return };
        let weight: f64 = self.fixed.mass.iter().sum::<f64>() * GRAVITY.length();
        let target = self.state.positions[v];
        self.small.hand = Some(GrabConstraint { vertex: v as u32, target, stiffness: HAND, most: weight });
        self.follow_hand();
    }

    /// Position of the dragged vertex, metres; None while nothing is dragged.
    pub fn in_hand(&self) -> Option<DVec3> {
        self.small.hand.map(|hand| self.state.positions[hand.vertex as usize])
    }

    /// Moves the target of the drag, metres.
    pub fn pull_to(&mut self, target: DVec3) {
        if let Some(hand) = &mut self.small.hand {
            hand.target = target;
            self.follow_hand();
        }
    }

    /// Ends the drag.
    pub fn let_go(&mut self) {
        self.small.hand = None;
        self.hold_otherwise();
    }

    /// Turns on friction for the garment's vertices `inner`: an inner layer, over which sewing springs pull the rest.
    pub fn pull_over(&mut self, inner: &[u32]) {
        let mut rubs = vec![0.0; self.fixed.vertices.len()];
        let own = inner.iter().filter_map(|&v| own_number(&self.fixed.own, v));
        own.for_each(|v| rubs[v] = self.fixed.friction[v]);
        self.rubs = Some(rubs);
    }

    /// Replaces all sewing springs; their ends are vertices of the garment. Springs at vertices that are not draped are left out.
    pub fn tie(&mut self, ties: &[SewingSpring]) {
        let own = |tie: &SewingSpring| {
            let [a, b] = tie.ends.map(|v| own_number(&self.fixed.own, v));
            Some(SewingSpring { ends: [a? as u32, b? as u32], ..*tie })
        };
        self.small.ties = ties.iter().filter_map(own).collect();
    }

    /// Mass (kg) and velocity (m/s) of the garment's vertex `v`; None where it is not draped.
    pub fn motion(&self, v: u32) -> Option<(f64, DVec3)> {
        let v = own_number(&self.fixed.own, v)?;
        Some((self.fixed.mass[v], self.state.velocities[v]))
    }

    /// Sets the velocity of each vertex of the garment, m/s; pinned vertices keep theirs.
    pub fn set_velocities(&mut self, velocities: &[DVec3]) {
        for (v, velocity) in self.state.velocities.iter_mut().enumerate() {
            if !self.pinned[v] {
                *velocity = velocities[self.fixed.vertices[v] as usize];
            }
        }
        if let Some(pulling) = &mut self.pulling {
            pulling.least.velocities.clone_from(&self.state.velocities);
        }
    }

    /// Makes cloth at rest move again, and restarts the tick count.
    pub fn wake(&mut self) {
        (self.pace, self.resumes) = (1.0, false);
        self.stir();
    }

    /// As [`Self::wake`], while time goes on as slowly as it does.
    fn stir(&mut self) {
        if let Some(pulling) = self.pulling.take() {
            self.state = pulling.least;
        }
        (self.quiet, self.parting, self.in_vain) = (0, (usize::MAX, 0), 0);
        self.progress = Progress { ticks: 0, at_rest: false, restless: false, ..self.progress };
    }

    /// Runs a tick: [`TICK`] seconds, or less while time is slowed down. Deep self-intersections are then pulled out, while time
    /// stands still. Writes the new positions into `cloth`, the cloth of the garment.
    pub fn tick(&mut self, cloth: &mut ClothState) -> Result<(), Undrapable> {
        while !self.go_on(cloth)? {}
        Ok(())
    }

    /// Whether a tick is partly done.
    pub fn is_mid_tick(&self) -> bool {
        self.begun.is_some() || self.pulling.is_some()
    }

    /// Does part of the work of a tick. True when the tick is complete.
    pub fn go_on(&mut self, cloth: &mut ClothState) -> Result<bool, Undrapable> {
        if self.pulling.is_some() {
            self.pull(cloth);
        } else if self.move_on()? {
            self.write(cloth);
            self.look_at(cloth);
        } else {
            self.write(cloth);
            return Ok(false);
        }
        if self.pulling.is_none() {
            self.conclude();
        }
        Ok(self.pulling.is_none())
    }

    /// Makes some small steps. True when they are the last of a tick.
    fn move_on(&mut self) -> Result<bool, Undrapable> {
        let (fixed, collider) = (Arc::clone(&self.fixed), Arc::clone(&self.collider));
        let mut begun = match self.begun.take() {
            Some(begun) => begun,
            None => {
                if !self.floats {
                    // What began flat may hang down now.
                    self.substeps = self.substeps.max(fixed.hanging.steps_a_tick(&self.state.positions));
                }
                let (span, steps) = (TICK * self.pace, self.steps_on_card());
                let advance = Advance::new(span, self.finer(steps.unwrap_or(self.substeps)));
                Box::new(Begun { span, before: self.state.clone(), advance, on_card: steps.is_some() })
            }
        };
        let grip = if self.floats && self.rubs.is_none() { 0.0 } else { GRIP };
        let calms = calming(self.progress.ticks, self.pace);
        let mut around = Surroundings {
            bending: &fixed.bending,
            bending_damping: BENDING_DAMPING,
            settles: (calms > 0.0 || self.resumes) && !self.floats,
            gravity: if self.floats { DVec3::ZERO } else { GRAVITY },
            damping: fixed.damping + calms + gentle(self.age),
            collider: Some(&collider),
            floor: self.floor(),
            offset: fixed.offset,
            friction: &fixed.friction,
            grip,
        };
        let mut moved = 0;
        if begun.on_card {
            self.move_on_card(&mut begun, &around);
            moved += self.state.positions.len() as u64;
        }
        around.friction = self.rubs.as_ref().unwrap_or(&fixed.friction);
        let asked = self.small.queries;
        let work = self.small.pairs() + MOST_WORK;
        while !begun.on_card && !begun.advance.is_done() && self.small.pairs() + moved < work {
            if self.small.go_on(&mut begun.advance, &around, &mut self.state) {
                moved += self.state.positions.len() as u64;
            }
        }
        self.counters.contact_queries += self.small.queries - asked;
        self.counters.contact_checks += moved;
        if let Some(lost) = self.state.lost() {
            self.state = begun.before;
            return Err(Undrapable(words!("vertex {n} of the cloth went nowhere", n = fixed.vertices[lost])));
        }
        if begun.advance.is_done() {
            self.measure(&begun.before, begun.span);
            return Ok(true);
        }
        self.begun = Some(begun);
        Ok(false)
    }

    /// Checks, after some ticks, for faces too near the body and for self-intersections.
    fn look_at(&mut self, cloth: &mut ClothState) {
        let (ticks, quiet) = (self.progress.ticks, self.is_quiet());
        if quiet || ticks.is_multiple_of(LIFTING.ticks) {
            self.lift(cloth, quiet);
        }
        let every = if self.crossings > 0 { PARTING.ticks } else { PARTING.look_ticks };
        if (quiet || ticks == 1 || ticks.is_multiple_of(every)) && !self.is_tangled() {
            self.part(cloth);
        }
    }

    fn write(&self, cloth: &mut ClothState) {
        for (&v, x) in self.fixed.vertices.iter().zip(&self.state.positions) {
            cloth.positions[v as usize] = *x;
        }
    }
}

/// A tick that is partly done.
#[derive(Clone, Debug)]
struct Begun {
    /// Simulated time of the tick, seconds.
    span: f64,
    /// State before the tick.
    before: State,
    advance: Advance,
    /// Whether a graphics card makes it.
    on_card: bool,
}

/// Indices of the triangles of `garment` that are laid.
fn laid_triangles(garment: &Garment, cloth: &ClothState) -> Vec<usize> {
    let is_laid = |t: &usize| garment.triangles[*t].iter().all(|&v| cloth.mapped[v as usize]);
    (0..garment.triangles.len()).filter(is_laid).collect()
}

/// Rest length (metres) of an edge between simulated vertices, whose garment vertices are `vertices`. Along a seam, or a future
/// seam of `sewn`, it is the length of the shorter side. None where the edge is not one of the garment.
fn shortest_lengths(
    garment: &Garment,
    sewn: Option<(&Garment, &[u32], usize)>,
    vertices: &[u32],
) -> impl Fn([u32; 2]) -> Option<f64> {
    let sides = shortest_sides(sewn.map_or(garment, |(sewn, ..)| sewn));
    let name = |v: &u32| sewn.map_or(*v, |(_, becomes, _)| becomes[*v as usize]);
    let names: Vec<u32> = vertices.iter().map(name).collect();
    move |ends| {
        let [a, b] = ends.map(|v| names[v as usize]);
        sides.get(&[a.min(b), a.max(b)]).copied()
    }
}

/// Mass of each vertex, kg: a third of that of its triangles.
fn masses(sheet: &Sheet, fabrics: &[&Fabric]) -> Vec<f64> {
    let mut mass = vec![0.0; sheet.len()];
    for ((vs, area), fabric) in sheet.triangles.iter().zip(&sheet.areas).zip(fabrics) {
        vs.iter().for_each(|&v| mass[v as usize] += fabric.density_kg_per_m2 * area / 3.0);
    }
    mass
}

/// For each of `count` simulated vertices whether it is one of the garment's `vertices`.
fn among(vertices: &[u32], own: &[u32], count: usize) -> Vec<bool> {
    let mut is_among = vec![false; count];
    vertices.iter().filter_map(|&v| own_number(own, v)).for_each(|v| is_among[v] = true);
    is_among
}

/// The simulated vertex of garment vertex `v`; None where it is not draped.
fn own_number(own: &[u32], v: u32) -> Option<usize> {
    own.get(v as usize).filter(|&&o| o != u32::MAX).map(|&o| o as usize)
}
