//! A garment on a body at rest: draped by small steps until it rests too.
//!
//! Chosen over implicit steps by measurement (`toile bench speed`): on a body most of a garment is held by contact, what hangs is
//! short, and the law of small steps then asks for few of them.

pub mod clear;
mod laid;
mod routes;
pub mod sewing;
mod tangles;

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::body::Surface;
use crate::cloth::{ClothState, Counters, Fabric, Garment, Skips};
use crate::contact::faces::Lying;
use crate::contact::{Faces, Obstacle, Separation, separation};
use crate::drape::contact::body::Collider;
use crate::drape::forces::bending::Bending;
use crate::drape::garment::laid::{ordered, shortest_sides, springs};
use crate::drape::garment::tangles::Pulling;
use crate::drape::sheet::Sheet;
use crate::drape::solver::small_steps::{
    Advance, GrabConstraint, SewingSpring, SmallSteps, Surroundings, stable_rate, substeps,
};
use crate::drape::state::State;
use crate::geometry::crossings::meetings;
use crate::geometry::ids::PieceId;
use crate::geometry::mesh::TriMesh;

/// Seconds a tick goes on.
pub const TICK: f64 = 1.0 / 60.0;
/// m/s².
const GRAVITY: DVec3 = DVec3::new(0.0, -9.81, 0.0);
/// Nearest that cloth comes to skin, metres: its thickness, and what skin gives way.
const SKIN: f64 = 0.001;
/// Faces and edges keep this share of the distance.
const FACE_CLEARANCE: f64 = 0.5;
/// Those that lack no more than this share of that are left as they are.
const NEARLY_CLEAR: f64 = 0.02;
/// Most that vertices are raised to keep faces between them off the body, in distances kept.
const MOST_LIFT: f64 = 8.0;
/// Ticks between two looks at faces.
const LIFT_TICKS: u64 = 6;
/// Ticks between two looks for layers that run through each other; the first is after the first tick, the roughest,
const LOOK_TICKS: u64 = 12;
/// and between two partings of them.
const PART_TICKS: u64 = 4;
/// Air takes this share of motion, 1/s.
const AIR: f64 = 1.5;
/// Damping of bending in proportion to its stiffness, seconds.
const BENDING_DAMPING: f64 = 0.001;
/// The greatest pressure that friction knows, Pa: some times what cloth weighs. What presses more is strain control, of which one
/// pass in each small step feels far softer than the cloth is; held by friction of the full pressure, tight cloth would keep
/// whatever strain it came with (ALGORITHMS.md 0.5).
const GRIP: f64 = 10.0;
/// At rest when no vertex goes farther in a tick, metres,
const REST_WAY: f64 = 5e-5;
/// and the forces that move the cloth are no larger a share of its weight,
const REST_RESIDUAL: f64 = 0.01;
/// for this many ticks.
const QUIET_TICKS: u32 = 12;
/// Cloth that is as good as still is calmed: what little moves then creeps or trembles. Seconds until that begins,
const CALM_AFTER: f64 = 0.5;
/// by how much air thickens in each second from then on, 1/s²,
const CALMING: f64 = 10.0;
/// and how far, 1/s: slow swings are then about critically damped.
const CALMEST: f64 = 8.0;
/// One pass in a small step leaves edges as soft as mass over its square, which is far softer than woven cloth: what hangs from
/// a tight place stretches that. So once the cloth has come down, which is when the forces that move it are no larger a share
/// of its weight than this,
const DOWN: f64 = 0.1;
/// or after this many ticks, as what is caught somewhere may tremble for ever,
const DOWN_BY: u64 = 300;
/// time goes slower by this factor with every tick,
const SLOWING: f64 = 0.9;
/// down to this: strain that is left then is its square of what it was.
const SLOWEST: f64 = 0.25;
/// Ticks after which cloth is taken to rest in any case.
const MOST_TICKS: u64 = 1200;
/// Vertices moved in small steps and pairs of features looked at in one part of a tick: about 0.03 s.
const MOST_WORK: u64 = 60_000;
/// Stiffness of a hand's pull, N/m, and the most it pulls with, in weights of the garment.
const HAND: (f64, f64) = (60.0, 1.0);

/// What one is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrapedSettings {
    /// Strain beyond which cloth is rigid, 1e-3..=0.2.
    pub strain: f64,
    /// Whether it meets itself.
    pub self_collision: bool,
    /// What may be left out.
    pub skips: Skips,
}

/// Why a garment cannot be draped, in words.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Undrapable(pub String);

/// How far it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Ticks since it began or was disturbed.
    pub ticks: u64,
    /// What moves it: Σ m |Δv| / Δt over its weight.
    pub residual: f64,
    /// The fastest vertex, m/s.
    pub speed: f64,
    /// Whether it lies still.
    pub at_rest: bool,
}

/// What does not change while it is draped.
#[derive(Debug)]
struct Fixed {
    garment: Arc<Garment>,
    sheet: Sheet,
    /// The garment's number of each vertex here: those that are laid, in an order in which neighbours are near.
    vertices: Vec<u32>,
    /// The other way round; `u32::MAX` where nothing is laid.
    own: Vec<u32>,
    bending: Bending,
    mass: Vec<f64>,
    friction: Vec<f64>,
    collider: Collider,
    obstacle: Arc<Obstacle>,
    offset: f64,
    thickness: f64,
    damping: f64,
}

/// A garment that is being draped.
#[derive(Clone, Debug)]
pub struct DrapedGarment {
    fixed: Arc<Fixed>,
    settings: DrapedSettings,
    small: SmallSteps,
    /// For each vertex the garment's that it will be sewn to become; None: nothing is to be sewn.
    will_be: Option<Vec<u32>>,
    state: State,
    faces: Faces,
    /// How far each vertex came in the last tick, metres.
    ways: Vec<DVec3>,
    pinned: Vec<bool>,
    substeps: usize,
    /// Without weight and friction.
    floats: bool,
    /// While it floats, what there is of friction all the same: of what lies below.
    rubs: Option<Vec<f64>>,
    progress: Progress,
    /// How fast time goes, [`SLOWEST`]..=1.
    pace: f64,
    quiet: u32,
    /// Places where layers ran through each other when last looked at.
    crossings: usize,
    /// The fewest of them since there were none, and how often in a row there were no fewer.
    parting: (usize, u32),
    /// How often in a row what lay deep did not come out.
    in_vain: u32,
    /// A tick under way.
    begun: Option<Box<Begun>>,
    /// What lies deep is being pulled out.
    pulling: Option<Box<Pulling>>,
    /// Faces that came too near the body when last looked at.
    lacking: usize,
    /// Work done.
    pub counters: Counters,
}

impl DrapedGarment {
    /// The laid part of `garment` where it lies, of `fabrics` by piece (else `default`). Vertices `pins` stay.
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

    /// The same of a garment that is to become another, with the vertex of that for each of its own. Nothing has weight, and nothing
    /// rubs; it goes on in `substeps` small steps a tick.
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
        let laid: Vec<usize> = (0..garment.triangles.len())
            .filter(|&t| garment.triangles[t].iter().all(|&v| cloth.mapped[v as usize]))
            .collect();
        let (vertices, own) = ordered(&garment, &laid);
        let fabric = |t: usize| fabrics.get(&garment.triangle_pieces[t]).unwrap_or(default);
        let triangles = laid.iter().map(|&t| garment.triangles[t].map(|v| own[v as usize])).collect();
        let rest: Vec<[DVec2; 3]> = laid.iter().map(|&t| garment.rest[t]).collect();
        let sheet = Sheet::new(vertices.len(), triangles, rest)
            .map_err(|why| Undrapable(format!("the cloth cannot be draped: {why}")))?;
        let of_triangle: Vec<&Fabric> = laid.iter().map(|&t| fabric(t)).collect();
        let first = |v: u32| of_triangle[sheet.adjacency.vertex_triangles.of(v)[0] as usize];
        let mass = masses(&sheet, &of_triangle);
        let most = |of: fn(&Fabric) -> f64| of_triangle.iter().map(|f| of(f)).fold(0.0, f64::max);
        let (thickness, damping) = (most(|f| f.thickness_m), most(|f| f.damping_per_s));
        let friction = (0..sheet.len() as u32).map(|v| first(v).friction).collect();
        let positions: Vec<DVec3> = vertices.iter().map(|&v| cloth.positions[v as usize]).collect();
        let hanging = || steps_a_tick(&positions, sheet.mean_edge(), settings.strain);
        let count = sewn.map_or_else(hanging, |(.., substeps)| substeps);
        let slow = stable_rate(TICK / count as f64, BENDING_DAMPING);
        let bending = Bending::slower_than(slow, &mass, &sheet, |v| &first(v).bending);
        let mut pinned = vec![false; sheet.len()];
        pins.iter().filter_map(|&v| own_number(&own, v)).for_each(|v| pinned[v] = true);
        let length = shortest_lengths(&garment, sewn, &vertices);
        let springs = springs(&sheet, &of_triangle, length);
        let small = SmallSteps::of(springs, settings.strain, &sheet, &bending, &mass, &pinned);
        let obstacle = Arc::new(Obstacle::of(&surface));
        let collider = Collider::still(surface);
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
            progress: Progress { ticks: 0, residual: 1.0, speed: 0.0, at_rest: false },
            pace: 1.0,
            quiet: 0,
            crossings: 0,
            parting: (usize::MAX, 0),
            in_vain: 0,
            begun: None,
            pulling: None,
            lacking: 0,
            counters: Counters::default(),
            fixed: Arc::new(Fixed {
                garment,
                sheet,
                vertices,
                own,
                bending,
                mass,
                friction,
                collider,
                obstacle,
                offset: thickness + SKIN,
                thickness,
                damping: damping + AIR,
            }),
        })
    }

    /// From now on nothing crosses that does not yet; what does begins to come apart.
    fn separate(&mut self, cloth: &ClothState) {
        if !self.settings.self_collision {
            return;
        }
        let Fixed { sheet, obstacle, thickness, .. } = &*self.fixed;
        let rest: Vec<f64> = (0..sheet.adjacency.edges.len()).map(|e| sheet.rest_length(e)).collect();
        self.small.separation = Some(Separation::new(
            sheet.len(),
            &sheet.triangles,
            &sheet.adjacency,
            (&rest, *thickness),
            self.will_be.clone(),
            Some(Arc::clone(obstacle)),
        ));
        self.part(&mut cloth.clone());
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        self.progress
    }

    /// Distance kept from the skin, metres.
    pub fn offset(&self) -> f64 {
        self.fixed.offset
    }

    /// Small steps in each tick.
    pub fn substeps(&self) -> usize {
        self.substeps
    }

    /// Places where the cloth passes through itself, and faces that come too near the body, when last looked at.
    pub fn faults(&self) -> (usize, usize) {
        (self.crossings, self.lacking)
    }

    /// What the contact of the cloth with itself and the body took.
    pub fn separation(&self) -> separation::Counters {
        self.small.separation.as_ref().map(|separation| separation.counters).unwrap_or_default()
    }

    /// The same since it was last taken.
    pub fn take_separation(&mut self) -> separation::Counters {
        let taken = self.small.separation.as_mut().map(|separation| std::mem::take(&mut separation.counters));
        taken.unwrap_or_default()
    }

    /// From now on exactly these vertices stay; cloth at rest wakes.
    pub fn pin(&mut self, pins: &[u32]) {
        self.pinned.fill(false);
        let fixed = Arc::clone(&self.fixed);
        pins.iter().filter_map(|&v| own_number(&fixed.own, v)).for_each(|v| self.pinned[v] = true);
        self.small.pin(&fixed.mass, &self.pinned);
        for (v, velocity) in self.state.velocities.iter_mut().enumerate() {
            if self.pinned[v] {
                *velocity = DVec3::ZERO;
            }
        }
        self.wake();
    }

    /// Takes `vertex` in the hand, where it is. Nothing happens where no cloth is laid.
    pub fn take(&mut self, vertex: u32) {
        let Some(v) = own_number(&self.fixed.own, vertex) else { return };
        let weight: f64 = self.fixed.mass.iter().sum::<f64>() * GRAVITY.length();
        let (stiffness, times) = HAND;
        let target = self.state.positions[v];
        self.small.hand = Some(GrabConstraint { vertex: v as u32, target, stiffness, most: times * weight });
        self.wake();
    }

    /// Where what is in the hand is, metres.
    pub fn in_hand(&self) -> Option<DVec3> {
        self.small.hand.map(|hand| self.state.positions[hand.vertex as usize])
    }

    /// The hand goes there.
    pub fn pull_to(&mut self, target: DVec3) {
        if let Some(hand) = &mut self.small.hand {
            hand.target = target;
            self.wake();
        }
    }

    /// Lets go.
    pub fn let_go(&mut self) {
        self.small.hand = None;
        self.wake();
    }

    /// From now on threads pull the rest of it over what lies at the garment's vertices `inner`.
    pub fn pull_over(&mut self, inner: &[u32]) {
        let mut rubs = vec![0.0; self.fixed.vertices.len()];
        let own = inner.iter().filter_map(|&v| own_number(&self.fixed.own, v));
        own.for_each(|v| rubs[v] = self.fixed.friction[v]);
        self.rubs = Some(rubs);
    }

    /// From now on exactly these threads hold; their ends are vertices of the garment.
    pub fn tie(&mut self, ties: &[SewingSpring]) {
        let own = |tie: &SewingSpring| {
            let [a, b] = tie.ends.map(|v| own_number(&self.fixed.own, v));
            Some(SewingSpring { ends: [a? as u32, b? as u32], ..*tie })
        };
        self.small.ties = ties.iter().filter_map(own).collect();
    }

    /// Mass, kg, and velocity, m/s, of the garment's vertex `v`; None where it is not laid.
    pub fn motion(&self, v: u32) -> Option<(f64, DVec3)> {
        let v = own_number(&self.fixed.own, v)?;
        Some((self.fixed.mass[v], self.state.velocities[v]))
    }

    /// The garment's vertices move so, m/s.
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

    /// What was at rest moves again, as far as it must.
    pub fn wake(&mut self) {
        if let Some(pulling) = self.pulling.take() {
            self.state = pulling.least;
        }
        (self.quiet, self.pace, self.parting, self.in_vain) = (0, 1.0, (usize::MAX, 0), 0);
        self.progress = Progress { ticks: 0, at_rest: false, ..self.progress };
    }

    /// A tick: [`TICK`] seconds, or fewer of cloth that is nearly still; then, while time stands still, what lies deep in itself is
    /// pulled out. `cloth` is the garment's, and gets where it is then.
    pub fn tick(&mut self, cloth: &mut ClothState) -> Result<(), Undrapable> {
        while !self.go_on(cloth)? {}
        Ok(())
    }

    /// Some of the work of a tick. True when that ends it.
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

    /// Some small steps. True when they are the last of a tick.
    fn move_on(&mut self) -> Result<bool, Undrapable> {
        let fixed = Arc::clone(&self.fixed);
        let mut begun = self.begun.take().unwrap_or_else(|| {
            let span = TICK * self.pace;
            Box::new(Begun { span, before: self.state.clone(), advance: Advance::new(span, self.substeps) })
        });
        let seconds = self.progress.ticks as f64 * TICK;
        let around = Surroundings {
            bending: &fixed.bending,
            bending_damping: BENDING_DAMPING,
            gravity: if self.floats { DVec3::ZERO } else { GRAVITY },
            damping: fixed.damping + (CALMING * (seconds - CALM_AFTER)).clamp(0.0, CALMEST) / self.pace,
            collider: Some(&fixed.collider),
            offset: fixed.offset,
            friction: self.rubs.as_ref().unwrap_or(&fixed.friction),
            grip: if self.floats && self.rubs.is_none() { 0.0 } else { GRIP },
        };
        let asked = self.small.queries;
        let work = self.small.pairs() + MOST_WORK;
        let mut moved = 0;
        while !begun.advance.is_done() && self.small.pairs() + moved < work {
            self.small.go_on(&mut begun.advance, &around, &mut self.state);
            moved += self.state.positions.len() as u64;
        }
        self.counters.contact_queries += self.small.queries - asked;
        self.counters.contact_checks += moved;
        if let Some(lost) = self.state.lost() {
            self.state = begun.before;
            return Err(Undrapable(format!("vertex {} of the cloth went nowhere", fixed.vertices[lost])));
        }
        if begun.advance.is_done() {
            self.measure(&begun.before, begun.span);
            return Ok(true);
        }
        self.begun = Some(begun);
        Ok(false)
    }

    /// At the end of a tick, now and then: is it clear of the body, and of itself?
    fn look_at(&mut self, cloth: &mut ClothState) {
        let (ticks, quiet) = (self.progress.ticks, self.quiet >= QUIET_TICKS);
        if quiet || ticks.is_multiple_of(LIFT_TICKS) {
            self.lift(cloth, quiet);
        }
        let every = if self.crossings > 0 { PART_TICKS } else { LOOK_TICKS };
        if (quiet || ticks == 1 || ticks.is_multiple_of(every)) && !self.is_tangled() {
            self.part(cloth);
        }
    }

    /// Whether it rests, at the end of a tick.
    fn conclude(&mut self) {
        let (ticks, quiet) = (self.progress.ticks, self.quiet >= QUIET_TICKS);
        let sound = self.lacking == 0 && (self.crossings == 0 || self.is_tangled());
        if quiet && !sound {
            self.quiet = 0;
        }
        if self.small.hand.is_none() {
            let slowed = self.slow_down();
            self.progress.at_rest = (quiet && sound && !slowed) || ticks >= MOST_TICKS;
        }
    }

    /// Makes time go slower where it should. False when it does not.
    fn slow_down(&mut self) -> bool {
        let begins = self.pace < 1.0 || self.progress.residual < DOWN || self.progress.ticks > DOWN_BY;
        if self.floats || self.pace == SLOWEST || !begins {
            return false;
        }
        let slower = (self.pace * SLOWING).max(SLOWEST);
        self.ways.iter_mut().for_each(|way| *way *= slower / self.pace);
        self.pace = slower;
        self.quiet = 0;
        true
    }

    /// What moved in the last `span` seconds.
    fn measure(&mut self, before: &State, span: f64) {
        let mass = &self.fixed.mass;
        let (mut unbalanced, mut fastest) = (0.0, 0.0f64);
        for (v, way) in self.ways.iter_mut().enumerate() {
            let now = self.state.positions[v] - before.positions[v];
            unbalanced += mass[v] * (now - *way).length() / (span * span);
            fastest = fastest.max(now.length() / span);
            *way = now;
        }
        let weight = mass.iter().sum::<f64>() * GRAVITY.length();
        let (residual, speed) = (unbalanced / weight, fastest);
        self.progress = Progress { ticks: self.progress.ticks + 1, residual, speed, at_rest: false };
        let still = speed * span < REST_WAY && residual < REST_RESIDUAL;
        self.quiet = if still { self.quiet + 1 } else { 0 };
    }

    fn write(&self, cloth: &mut ClothState) {
        for (&v, x) in self.fixed.vertices.iter().zip(&self.state.positions) {
            cloth.positions[v as usize] = *x;
        }
    }

    /// Raises vertices of faces that come too near the body between them; `precise`: also where only an edge does.
    fn lift(&mut self, cloth: &ClothState, precise: bool) {
        let fixed = Arc::clone(&self.fixed);
        let (garment, surface) = (&*fixed.garment, &*fixed.collider.surface);
        let mut near = vec![false; garment.vertex_count];
        for (v, x) in self.state.positions.iter().enumerate() {
            near[fixed.vertices[v] as usize] = self.small.height(v, *x).is_some();
        }
        let lying =
            Lying { garment, surface, state: cloth, skips: self.settings.skips, split: None, apart: None };
        let clearance = FACE_CLEARANCE * fixed.offset;
        let lacking = self.faces.lacking(lying, &near, clearance, &mut self.counters);
        let mut raised = self.small.lift().to_vec();
        self.lacking = 0;
        for (vs, &lack) in garment.triangles.iter().zip(&lacking) {
            for v in vs.iter().filter_map(|&v| own_number(&fixed.own, v)) {
                let most = MOST_LIFT * fixed.offset;
                if lack > NEARLY_CLEAR * clearance && raised[v] < most {
                    let wanted = (self.small.lift()[v] + lack).min(most);
                    self.lacking += usize::from(wanted > raised[v]);
                    raised[v] = raised[v].max(wanted);
                }
            }
        }
        if precise && self.lacking == 0 {
            self.lift_cuts(cloth, &mut raised);
        }
        self.small.set_lift(&raised);
    }

    /// Raises what an edge of the body passes through, or passes through it: samples of a face miss the sharpest edges.
    fn lift_cuts(&mut self, cloth: &ClothState, raised: &mut [f64]) {
        let fixed = Arc::clone(&self.fixed);
        let (garment, surface) = (&*fixed.garment, &*fixed.collider.surface);
        let laid = |vs: &[u32]| vs.iter().all(|&v| own_number(&fixed.own, v).is_some());
        let edges: Vec<[u32; 2]> = garment.adjacency.edges.iter().copied().filter(|e| laid(e)).collect();
        let triangles = garment.triangles.iter().copied().filter(|vs| laid(vs)).collect();
        let mesh = TriMesh { positions: cloth.positions.clone(), triangles };
        let body = &surface.mesh;
        let mut cut = vec![false; raised.len()];
        let mut mark =
            |vs: &[u32]| vs.iter().filter_map(|&v| own_number(&fixed.own, v)).for_each(|v| cut[v] = true);
        for [e, _] in meetings(&mesh.positions, &edges, body, &body.tree()) {
            mark(&edges[e as usize]);
        }
        for [_, t] in meetings(&body.positions, &surface.adjacency.edges, &mesh, &mesh.tree()) {
            mark(&mesh.triangles[t as usize]);
        }
        let most = MOST_LIFT * fixed.offset;
        for (raised, _) in raised.iter_mut().zip(cut).filter(|(raised, cut)| *cut && **raised < most) {
            *raised = (*raised + FACE_CLEARANCE * fixed.offset).min(most);
            self.lacking += 1;
        }
    }
}

/// A tick under way.
#[derive(Clone, Debug)]
struct Begun {
    /// Seconds.
    span: f64,
    /// As it was before.
    before: State,
    advance: Advance,
}

/// The rest length, metres, of an edge between own vertices, which are these of `garment`: where a seam is, or will be as in `sewn`, that
/// of its shorter side.
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

/// Small steps in a tick that keep the cloth at `positions`, with edges of `edge` metres, within `strain`.
fn steps_a_tick(positions: &[DVec3], edge: f64, strain: f64) -> usize {
    let (low, high) =
        positions.iter().fold((f64::MAX, f64::MIN), |(low, high), p| (p.y.min(low), p.y.max(high)));
    substeps(TICK, strain, GRAVITY.length(), (high - low).max(edge), edge)
}

/// Of each vertex a third of its triangles, kg.
fn masses(sheet: &Sheet, fabrics: &[&Fabric]) -> Vec<f64> {
    let mut mass = vec![0.0; sheet.len()];
    for ((vs, area), fabric) in sheet.triangles.iter().zip(&sheet.areas).zip(fabrics) {
        vs.iter().for_each(|&v| mass[v as usize] += fabric.density_kg_per_m2 * area / 3.0);
    }
    mass
}

fn own_number(own: &[u32], v: u32) -> Option<usize> {
    own.get(v as usize).filter(|&&o| o != u32::MAX).map(|&o| o as usize)
}
