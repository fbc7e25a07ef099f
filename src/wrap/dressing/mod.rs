//! A wrap in steps: root edges, growth in bands, settling. One step is one tick of the simulation.

mod plans;

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;

use crate::body::Surface;
use crate::cloth::{Carry, ClothState, Counters, EdgeMetric, Garment, Skip};
use crate::contact::faces::FACE_CLEARANCE;
use crate::geometry::ids::PieceId;
use crate::geometry::words::words;
use crate::pattern::{Problem, ProblemKind};
use crate::relax::step::STEP_CAP;
use crate::relax::{GlobalStep, RelaxSettings, Relaxer};
use crate::wrap::Marks;
use crate::wrap::dressing::plans::Attempt;
use crate::wrap::growth::{Growth, placed};
use crate::wrap::hold::Hold;
use crate::wrap::limbs::Limbs;
use crate::wrap::order::Order;
use crate::wrap::plan::{PLAIN, PLANS, Plan};
use crate::wrap::roots::{PairStretch, Root, roots};
use crate::wrap::settling::Settling;

/// Number of settling steps between two separations of intersecting layers. Flipped cloth, and cloth on the wrong side, is turned
/// over only after as many: by then it is roughly in place. Chosen by trial.
const STEPS_PER_PARTING: usize = 10;

/// Phase of a dressing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Phase {
    /// Cloth is being placed from the marks outward.
    Growing,
    /// All cloth is placed and is being relaxed.
    Settling,
    /// The cloth is at rest.
    AtRest,
}

#[derive(Clone, Debug)]
enum Stage {
    Grow {
        limit: f64,
        bands: usize,
        fresh: Vec<u32>,
    },
    BetweenTiers {
        left: usize,
    },
    Settle(Settling),
    /// The plan is given up.
    GivenUp(Settling),
    Rest,
}

/// A wrap in progress.
#[derive(Clone, Debug)]
pub struct Dressing {
    relaxer: Relaxer,
    order: Arc<Order>,
    growth: Growth,
    limbs: Limbs,
    tier: u32,
    stage: Stage,
    edge_length: f64,
    to_map: usize,
    mapped: usize,
    /// Vertices to be fixed once all cloth is placed.
    pins: Vec<u32>,
    /// Whether a finer mesh continues from the result, so that this one need not come quite to rest.
    draft: bool,
    /// The coarser mesh that is dressed first; while it is there, it moves and this cloth follows it.
    coarse: Option<Box<Coarse>>,
    /// The roots with which growth begins.
    roots: Vec<Root>,
    /// Index in [`PLANS`] of the plan by which it grows; None once the result was accepted.
    plan: Option<usize>,
    /// Weight of contact once the cloth is roughly in place.
    contact: f64,
    /// The best result of the plans before.
    best: Option<Box<Attempt>>,
    /// Lengths of each pair of marks on cloth and body.
    pub stretches: Vec<PairStretch>,
}

/// Cloth that is dressed already.
#[derive(Clone, Copy, Debug)]
pub struct Dressed<'a> {
    /// State of the cloth.
    pub cloth: &'a ClothState,
    /// Pinned vertices.
    pub pins: &'a [u32],
}

impl Dressed<'_> {
    /// Vertices that a rewrap from `roots` keeps: those at least as far from the marks as the nearest pin.
    fn kept(&self, garment: &Garment, roots: &[Root]) -> Vec<u32> {
        let sources: Vec<(u32, f64)> = roots.iter().map(|root| (root.vertex, root.distance)).collect();
        let far = EdgeMetric::new(garment).from(&sources, |v| self.cloth.mapped[v as usize]).distance;
        let nearest_pin = self.pins.iter().map(|&pin| far[pin as usize]).fold(f64::INFINITY, f64::min);
        let laid = (0..garment.vertex_count as u32).filter(|&v| self.cloth.mapped[v as usize]);
        laid.filter(|&v| far[v as usize] >= nearest_pin).collect()
    }
}

/// A coarser mesh of the same garment that is dressed first.
#[derive(Clone, Debug)]
struct Coarse {
    dressing: Dressing,
    cloth: ClothState,
    carry: Carry,
}

impl Dressing {
    /// Dresses the `coarser` meshes of the same pattern first, the coarsest being last in the list, and each finer
    /// mesh from the result of the one before: the slow large motions that take a fine mesh hundreds of steps take a
    /// coarse one a tenth of the time.
    pub fn coarse_to_fine(
        coarser: &[Arc<Garment>],
        garment: Arc<Garment>,
        surface: Arc<Surface>,
        marks: &Marks,
        settings: RelaxSettings,
    ) -> (Option<Self>, ClothState, Vec<Problem>) {
        let Some((next, coarser)) = coarser.split_first() else {
            return Self::new(garment, surface, marks, settings);
        };
        let (dressing, cloth, mut problems) =
            Self::coarse_to_fine(coarser, next.clone(), surface.clone(), marks, settings);
        let mut state = ClothState {
            positions: vec![DVec3::ZERO; garment.vertex_count],
            mapped: vec![false; garment.vertex_count],
        };
        let Some(mut dressing) = dressing else { return (None, state, problems) };
        dressing.draft = true;
        let carry = Carry::new(next, &garment);
        carry.places(&cloth, &mut state);
        let Some(mut fine) = Self::resumed(garment, surface.clone(), settings, &state) else {
            problems.push(too_large());
            return (None, state, problems);
        };
        // Problems of marks were reported for the coarsest mesh.
        let (held, ..) = roots(&fine.relaxer.garment, &surface, marks, fine.relaxer.offset());
        held.iter().for_each(|root| fine.relaxer.hold(root.vertex, root.position));
        fine.stretches = dressing.stretches.clone();
        fine.coarse = Some(Box::new(Coarse { dressing, cloth, carry }));
        (Some(fine), state, problems)
    }

    /// Starts wrapping the cloth round its marks. Problems tell what was left out; without a usable pair of marks no
    /// vertex is mapped and the phase is `AtRest`.
    pub fn new(
        garment: Arc<Garment>,
        surface: Arc<Surface>,
        marks: &Marks,
        settings: RelaxSettings,
    ) -> (Option<Self>, ClothState, Vec<Problem>) {
        Self::begun(garment, surface, marks, settings, None)
    }

    /// Takes dressed cloth off and wraps it again round `marks` (paper A, "Rewrapping"): all cloth nearer to them
    /// than the nearest pin. Cloth beyond, and cloth that no edge connects with them, stays in place.
    pub fn rewrapped(
        garment: Arc<Garment>,
        surface: Arc<Surface>,
        marks: &Marks,
        settings: RelaxSettings,
        dressed: Dressed<'_>,
    ) -> (Option<Self>, ClothState, Vec<Problem>) {
        Self::begun(garment, surface, marks, settings, Some(dressed))
    }

    fn begun(
        garment: Arc<Garment>,
        surface: Arc<Surface>,
        marks: &Marks,
        settings: RelaxSettings,
        dressed: Option<Dressed<'_>>,
    ) -> (Option<Self>, ClothState, Vec<Problem>) {
        let mut state = ClothState {
            positions: vec![DVec3::ZERO; garment.vertex_count],
            mapped: vec![false; garment.vertex_count],
        };
        let Some(mut relaxer) = Relaxer::new(garment.clone(), surface.clone(), settings) else {
            return (None, state, vec![too_large()]);
        };
        let (roots, stretches, mut problems) = roots(&garment, &surface, marks, relaxer.offset());
        let marked: Vec<PieceId> = marks.pairs().map(|(c, _)| c.piece).collect();
        let order = Order::new(&garment, &roots, &marked);
        let kept = dressed.map(|dressed| dressed.kept(&garment, &roots)).unwrap_or_default();
        if let Some(dressed) = dressed {
            for &v in &kept {
                state.positions[v as usize] = dressed.cloth.positions[v as usize];
                state.mapped[v as usize] = true;
            }
        }
        for root in &roots {
            state.positions[root.vertex as usize] = root.position;
            state.mapped[root.vertex as usize] = true;
            relaxer.hold(root.vertex, root.position);
        }
        if kept.is_empty() {
            report_unreached(&garment, &order, &mut problems);
        }
        relaxer.fix(kept.iter().copied());
        let growth = Growth::new(&garment, &order, &state.mapped);
        let to_map = order.tier.iter().flatten().count();
        let stage = if roots.is_empty() {
            Stage::Rest
        } else {
            let fresh = roots.iter().map(|r| r.vertex).collect();
            Stage::Grow { limit: 0.0, bands: 0, fresh }
        };
        let dressing = Self {
            limbs: Limbs::new(&garment, &order),
            edge_length: garment.mean_edge(),
            mapped: state.mapped.iter().filter(|&&m| m).count(),
            relaxer,
            order: Arc::new(order),
            growth,
            tier: 0,
            stage,
            to_map,
            pins: dressed.map(|dressed| dressed.pins.to_vec()).unwrap_or_default(),
            draft: false,
            coarse: None,
            plan: (!roots.is_empty() && dressed.is_none()).then_some(0),
            roots,
            contact: PLAIN.contact,
            best: None,
            stretches,
        };
        (Some(dressing), state, problems)
    }

    /// One tick of work on `state`: a band of growth, or a settling step. Same input, same bits.
    pub fn step(&mut self, state: &mut ClothState) -> Phase {
        if let Some(coarse) = self.coarse.take() {
            self.follow(state, coarse);
            return self.phase();
        }
        match std::mem::replace(&mut self.stage, Stage::Rest) {
            Stage::Grow { limit, bands, fresh } => self.grow(state, limit, bands, fresh),
            Stage::BetweenTiers { left } => self.between_tiers(state, left),
            Stage::Settle(settling) => self.settle(state, settling),
            Stage::GivenUp(_) | Stage::Rest => {}
        }
        if matches!(self.stage, Stage::GivenUp(_) | Stage::Rest) {
            self.judge(state);
        }
        self.phase()
    }

    /// The phase of the dressing.
    pub fn phase(&self) -> Phase {
        if let Some(coarse) = &self.coarse {
            return coarse.dressing.phase();
        }
        match self.stage {
            Stage::Grow { .. } | Stage::BetweenTiers { .. } => Phase::Growing,
            Stage::Settle(_) | Stage::GivenUp(_) => Phase::Settling,
            Stage::Rest => Phase::AtRest,
        }
    }

    /// Progress over growing and settling, 0..=1.
    pub fn progress(&self) -> f64 {
        if let Some(coarse) = &self.coarse {
            return 0.8 * coarse.dressing.progress();
        }
        let grown = self.mapped as f64 / self.to_map.max(1) as f64;
        match self.stage {
            Stage::Grow { .. } | Stage::BetweenTiers { .. } => 0.6 * grown,
            Stage::Settle(settling) | Stage::GivenUp(settling) => 0.6 + 0.4 * settling.progress(),
            Stage::Rest => 1.0,
        }
    }

    /// Counters of the work done.
    pub fn counters(&self) -> Counters {
        match &self.coarse {
            Some(coarse) => coarse.dressing.counters(),
            None => self.relaxer.counters,
        }
    }

    /// Resumes cloth that was dressed before, at rest. None when the matrix cannot be analysed (out of memory).
    pub fn resumed(
        garment: Arc<Garment>,
        surface: Arc<Surface>,
        settings: RelaxSettings,
        state: &ClothState,
    ) -> Option<Self> {
        let mut relaxer = Relaxer::new(garment, surface, settings)?;
        relaxer.set_mapped(&state.mapped);
        Some(Self::lying(relaxer, state))
    }

    /// Cloth at rest with its `relaxer`.
    pub fn lying(relaxer: Relaxer, state: &ClothState) -> Self {
        let garment = relaxer.garment.clone();
        let order = Order::new(&garment, &[], &[]);
        let mapped = state.mapped.iter().filter(|&&m| m).count();
        Self {
            edge_length: garment.mean_edge(),
            growth: Growth::new(&garment, &order, &state.mapped),
            limbs: Limbs::default(),
            relaxer,
            order: Arc::new(order),
            tier: 0,
            stage: Stage::Rest,
            to_map: mapped,
            mapped,
            pins: Vec::new(),
            draft: false,
            coarse: None,
            roots: Vec::new(),
            plan: None,
            contact: PLAIN.contact,
            best: None,
            stretches: Vec::new(),
        }
    }

    /// The relaxer, once all cloth is placed; None while it grows.
    pub fn relaxer(&self) -> Option<&Relaxer> {
        let lies = self.coarse.is_none() && matches!(self.stage, Stage::Settle(_) | Stage::Rest);
        lies.then_some(&self.relaxer)
    }

    /// Fixes exactly these vertices, once all cloth is placed.
    pub fn fix(&mut self, vertices: &[u32]) {
        self.pins = vertices.to_vec();
        if self.relaxer().is_some() {
            self.relaxer.fix(vertices.iter().copied());
        }
    }

    /// Lets placed cloth settle again.
    pub fn settle_again(&mut self) {
        if self.relaxer().is_some() && self.mapped > 0 {
            self.stage = Stage::Settle(Settling::with_gravity(self.draft));
        }
    }

    /// Changes the settings of relaxation; cloth at rest settles again.
    pub fn set_settings(&mut self, settings: RelaxSettings) {
        self.relaxer.settings = settings;
        if let Some(coarse) = &mut self.coarse {
            coarse.dressing.set_settings(settings);
            return;
        }
        if matches!(self.stage, Stage::Rest) {
            self.settle_again();
        }
    }

    /// A step of the coarser mesh. When that is at rest, the finer one settles from its result.
    fn follow(&mut self, state: &mut ClothState, mut coarse: Box<Coarse>) {
        let phase = coarse.dressing.step(&mut coarse.cloth);
        coarse.carry.places(&coarse.cloth, state);
        self.mapped = state.mapped.iter().filter(|&&m| m).count();
        if phase != Phase::AtRest {
            self.coarse = Some(coarse);
            return;
        }
        self.relaxer.set_mapped(&state.mapped);
        self.relaxer.counters = coarse.dressing.counters();
        if self.mapped > 0 {
            let ratio = self.edge_length / coarse.dressing.edge_length;
            self.contact = coarse.dressing.contact;
            self.relaxer.take_over(&coarse.dressing.relaxer, &coarse.carry, ratio);
            self.relaxer.fix(self.pins.iter().copied());
            self.stage = Stage::Settle(Settling::with_gravity(self.draft));
        }
    }

    fn grow(&mut self, state: &mut ClothState, limit: f64, bands: usize, mut fresh: Vec<u32>) {
        let limit = match self.growth.next() {
            Some((tier, distance)) if tier == self.tier => limit.max(distance) + self.edge_length,
            next => {
                let last = next.is_none();
                self.relax_new(state, &fresh);
                self.tier = next.map_or(self.tier, |(tier, _)| tier);
                self.relaxer.set_mapped(&state.mapped);
                if last {
                    self.relaxer.fix(self.pins.iter().copied());
                }
                self.stage = if last {
                    Stage::Settle(Settling::new(self.draft))
                } else {
                    Stage::BetweenTiers { left: self.way().tier_steps }
                };
                return;
            }
        };
        let Plan { pushes, tubes, .. } = self.way();
        while let Some(v) = self.growth.pop(self.tier, limit) {
            let offset = self.relaxer.offset();
            let (garment, surface) = (&self.relaxer.garment, &self.relaxer.surface);
            let round = if tubes && self.tier > 0 { self.limbs.place(v) } else { None };
            if let Some(p) = round.or_else(|| placed(garment, surface, state, v, offset, pushes)) {
                state.positions[v as usize] = p;
                state.mapped[v as usize] = true;
                self.mapped += 1;
                self.relaxer.counters.grown_vertices += 1;
                fresh.push(v);
                self.growth.wake_round(&self.relaxer.garment, &self.order, &state.mapped, v);
            }
        }
        self.relax_new(state, &fresh);
        if (bands + 1).is_multiple_of(self.way().bands_per_global) {
            self.relaxer.set_mapped(&state.mapped);
            if self.way().part {
                self.relaxer.part_layers(state);
            }
            for _ in 0..self.way().globals_per_group {
                self.global(state, Hold::growing(), false, false);
            }
        }
        self.stage = Stage::Grow { limit, bands: bands + 1, fresh: Vec::new() };
    }

    fn between_tiers(&mut self, state: &mut ClothState, left: usize) {
        self.global(state, Hold::growing(), false, false);
        self.stage = if left > 1 {
            Stage::BetweenTiers { left: left - 1 }
        } else {
            if self.way().tubes {
                let Relaxer { garment, surface, .. } = &self.relaxer;
                self.limbs.begin(garment, surface, state, &self.order, self.relaxer.offset());
            }
            Stage::Grow { limit: 0.0, bands: 0, fresh: Vec::new() }
        };
    }

    fn settle(&mut self, state: &mut ClothState, mut settling: Settling) {
        let done = settling.done;
        self.relaxer.splitting = !self.draft;
        let first = settling.is_first();
        let fading = if first { Hold::fading(done) } else { None };
        let kept = Hold::kept(self.edge_length, self.relaxer.surface.scale());
        let in_place = done > STEPS_PER_PARTING;
        let moved = self.global(state, fading.unwrap_or(kept), in_place, !first);
        let look = settling.crossed || !self.relaxer.settings.skips.allow(Skip::Crossings);
        if look && in_place && done.is_multiple_of(STEPS_PER_PARTING) {
            settling.crossed = self.relaxer.part_layers(state) > 0;
        }
        if !settling.crossed {
            self.relaxer.ease_parting();
        }
        let still = settling.is_still(moved / self.edge_length, || self.relaxer.energy());
        // Resting cloth may cut the body between its vertices, or be on the wrong side: repair it there and go on.
        let mended = still && settling.may_mend() && {
            let clearance = self.relaxer.offset() * FACE_CLEARANCE;
            let wrong = self.relaxer.lift_faces(state, clearance) + self.relaxer.send_wrong_faces(state);
            wrong + self.relaxer.part_layers(state) > 0
        };
        self.stage = match (still, mended) {
            (true, false) => Stage::Rest,
            (true, true) => Stage::Settle(settling.mended()),
            (false, _) if self.is_hopeless(state, &mut settling) => Stage::GivenUp(settling.stepped()),
            (false, _) => Stage::Settle(settling.stepped()),
        };
    }

    fn global(&mut self, state: &mut ClothState, hold: Hold, unfold: bool, weight: bool) -> f64 {
        let step = GlobalStep {
            cap: STEP_CAP * self.relaxer.surface.scale(),
            contact: if unfold { self.contact } else { self.way().growing_contact },
            hold: hold.weight,
            slack: hold.slack,
            unfold,
            weight,
        };
        self.relaxer.global_step(state, step)
    }

    fn way(&self) -> Plan {
        PLANS[self.plan.unwrap_or(0)]
    }

    /// Local passes over the placed cloth round the `fresh` vertices.
    fn relax_new(&mut self, state: &mut ClothState, fresh: &[u32]) {
        let garment = self.relaxer.garment.clone();
        let mut near: BTreeSet<u32> = fresh.iter().copied().collect();
        let Plan { rings, local_passes, local_factor, .. } = self.way();
        for _ in 0..rings {
            let ring: Vec<u32> = near
                .iter()
                .flat_map(|&v| garment.adjacency.vertex_neighbours.of(v))
                .copied()
                .filter(|&v| state.mapped[v as usize])
                .collect();
            near.extend(ring);
        }
        let vertices: Vec<u32> = near.into_iter().collect();
        let triangles: BTreeSet<u32> = vertices
            .iter()
            .flat_map(|&v| garment.adjacency.vertex_triangles.of(v))
            .copied()
            .filter(|&t| garment.triangles[t as usize].iter().all(|&v| state.mapped[v as usize]))
            .collect();
        let triangles: Vec<u32> = triangles.into_iter().collect();
        for _ in 0..local_passes {
            self.relaxer.local_pass(state, &vertices, &triangles, local_factor);
        }
    }
}

fn too_large() -> Problem {
    let words = words!("the garment is too large for this machine's memory");
    Problem { kind: ProblemKind::Dressing, place: words!("garment"), words }
}

fn report_unreached(garment: &Garment, order: &Order, problems: &mut Vec<Problem>) {
    for (piece, name) in &garment.pieces {
        let lost = garment
            .triangles
            .iter()
            .zip(&garment.triangle_pieces)
            .any(|(vs, p)| p == piece && vs.iter().any(|&v| order.tier[v as usize].is_none()));
        if lost {
            problems.push(Problem {
                kind: ProblemKind::Dressing,
                place: words!("{name} ({piece})", name, piece),
                words: words!("no seam joins this piece to a mark; it stays in the pattern"),
            });
        }
    }
}
