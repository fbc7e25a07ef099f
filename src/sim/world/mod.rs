//! All moving state and all settings that decide how it moves: the content of a checkpoint. Cloning it clones pointers.

mod activity;
mod coarse;
mod draped;
pub(in crate::sim) mod posed;
mod sewn;
pub(in crate::sim) mod trials;
mod trimmed;

use std::sync::Arc;

use glam::DVec3;

use crate::body::Surface;
use crate::card::CardSlot;
use crate::cloth::{self, Carry, ClothState, Counters, FlatPiece, Garment, Skip};
use crate::contact::{Bone, Bones, Splits, separation};
use crate::drag::{DragMode, Dragging, Ray};
use crate::fit::Moved;
use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, words};
use crate::pattern::edit::Carried;
use crate::pattern::triangulate::Meshes;
use crate::pattern::{Pattern, Problem, ProblemKind};
use crate::relax::RelaxSettings;
use crate::sim::hash::cloth_hash;
use crate::sim::source::{ClothPlace, GarmentSource};
use crate::sim::start::Started;
use crate::sim::world::activity::staying;
use crate::sim::world::draped::Draping;
use crate::sim::world::posed::{Posed, Posing};
use crate::sim::world::sewn::{Outfit, Placed};
use crate::sim::world::trials::Trials;
use crate::sim::world::trimmed::Built;
use crate::wrap::{Dressed, Dressing, Marks, Phase, coarser};

/// The state of the simulation.
#[derive(Clone, Debug)]
pub struct World {
    /// What the garment was built from.
    pub source: Option<Arc<GarmentSource>>,
    /// The body.
    pub body: Option<Arc<Surface>>,
    /// The garment.
    pub garment: Option<Arc<Garment>>,
    /// Positions of the garment's vertices. Shared with snapshots and checkpoints until they change.
    pub cloth: Arc<ClothState>,
    /// The wrap, in progress or at rest. None for cloth that was adopted and not touched since, or that is dragged.
    pub dressing: Option<Arc<Dressing>>,
    /// The drag in progress.
    pub dragging: Option<Arc<Dragging>>,
    /// Share of the drag that reaches each vertex, 0..=1.
    pub dragged: Option<Arc<Vec<f32>>>,
    /// Points of the flat cloth that are pinned.
    pub places: Arc<Vec<ClothPlace>>,
    /// The vertex under each pin, in the pins' order; None where no cloth is laid.
    pub pinned: Arc<Vec<Option<u32>>>,
    /// Split edges of cloth that was adopted, carried to another pose or draped, and not touched since.
    pub splits: Option<Arc<Splits>>,
    /// Whether the simulation runs; false while paused.
    pub relaxing: bool,
    /// Problems found by building, wrapping and sewing.
    pub problems: Arc<Vec<Problem>>,
    /// Triangulations of the flat pieces, kept while the pattern is edited.
    pub meshes: Arc<Meshes>,
    /// The last change of pose.
    pub posed: Option<Arc<Posed>>,
    /// The change of pose in progress.
    pub posing: Option<Arc<Posing>>,
    /// Draping: controls the cloth, or waits until it is laid.
    pub draping: Option<Arc<Draping>>,
    /// How the cloth came to where it lies since it was grown: what may have folds keeps them after it moved on.
    pub moved: Moved,
    /// Whether the cloth was sewn from the placement of its pieces, on the body in its present pose.
    pub was_sewn: bool,
    /// Heights of the highest points of its pieces before a start draped it, metres; None where none did, or the body has moved.
    pub hung_at: Option<Arc<[f64]>>,
    /// Whether seams that are too short are still to be reported.
    pub seams_unseen: bool,
    /// The sewing in progress: `garment` is then the one with open seams.
    pub sewing: Option<Arc<Placed>>,
    /// The garment without its deactivated pieces; None while it has none.
    pub active: Option<Arc<Garment>>,
    /// Garment and next layer to be sewn over the cloth once it rests.
    pub outer: Option<(Arc<Outfit>, u8)>,
    /// Starts being tried: the cloth is that of the present one.
    pub trials: Option<Arc<Trials>>,
    /// Results of the starts that were tried; None for cloth that was dressed otherwise.
    pub started: Option<Arc<Started>>,
    /// Work counters of collision in sewing and draping.
    pub separated: separation::Counters,
    /// Graphics card to drape on, if any.
    pub card: Option<Arc<CardSlot>>,
    /// Whether a graphics card has moved the cloth: it is then not the same on every machine.
    pub moved_by_card: bool,
}

impl Default for World {
    fn default() -> Self {
        Self {
            source: None,
            body: None,
            garment: None,
            cloth: Arc::default(),
            dressing: None,
            dragging: None,
            dragged: None,
            places: Arc::default(),
            pinned: Arc::default(),
            splits: None,
            relaxing: true,
            problems: Arc::default(),
            meshes: Arc::default(),
            posed: None,
            posing: None,
            draping: None,
            moved: Moved::default(),
            was_sewn: false,
            hung_at: None,
            seams_unseen: false,
            sewing: None,
            active: None,
            outer: None,
            trials: None,
            started: None,
            separated: separation::Counters::default(),
            card: None,
            moved_by_card: false,
        }
    }
}

impl World {
    /// A garment just built, with the wrap from its marks begun.
    pub fn wrapped(source: Arc<GarmentSource>, body: Arc<Surface>) -> Self {
        let mut meshes = Meshes::default();
        let (garment, problems) = cloth::build_again(&source.pattern, source.edge_length, &mut meshes);
        let garment = Arc::new(garment);
        let coarser = match source.relax.skips.allow(Skip::Fine) {
            true => coarser(&source.pattern, &garment, source.edge_length, body.scale()),
            false => Vec::new(),
        };
        let begun = Dressing::coarse_to_fine(
            &coarser,
            Arc::clone(&garment),
            Arc::clone(&body),
            &source.marks,
            source.relax,
        );
        Self { meshes: Arc::new(meshes), ..Self::begun(source, body, garment, problems, begun) }
    }

    fn begun(
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
        garment: Arc<Garment>,
        mut problems: Vec<Problem>,
        (dressing, cloth, more): (Option<Dressing>, ClothState, Vec<Problem>),
    ) -> Self {
        problems.extend(more);
        Self {
            source: Some(source),
            body: Some(body),
            garment: Some(garment),
            cloth: Arc::new(cloth),
            dressing: dressing.map(Arc::new),
            problems: Arc::new(problems),
            ..Self::default()
        }
    }

    /// The dressed cloth, grown anew from some pairs of marks. Where the pattern has changed since, the cloth is transferred to
    /// it first: pins hold the same points.
    pub fn rewrapped(&mut self, source: Arc<GarmentSource>, body: Arc<Surface>, pairs: &[usize]) -> Self {
        self.trials = None;
        self.release();
        let marks = source.marks.only(pairs);
        let places = Arc::clone(&self.places);
        let here = self.body.as_ref().is_some_and(|old| Arc::ptr_eq(old, &body));
        let cut = self.garment.clone().filter(|_| here).map(|old| self.recut(&source, old));
        let holds = |cut: &Cut| {
            cut.pinned.iter().any(|v| v.is_some())
                || !staying(&source.pattern, &cut.garment, &cut.cloth).is_empty()
        };
        let held = cut.filter(|cut| cut.is_as_before || holds(cut));
        let Some(Cut { garment, cloth, pinned, problems, .. }) = held else {
            let chosen = GarmentSource { marks: Arc::new(marks), ..GarmentSource::clone(&source) };
            let pinned = Arc::new(vec![None; places.len()]);
            return Self { source: Some(source), places, pinned, ..Self::wrapped(Arc::new(chosen), body) };
        };
        let staying = staying(&source.pattern, &garment, &cloth);
        let pins: Vec<u32> = pinned.iter().flatten().copied().chain(staying).collect();
        let dressed = Dressed { cloth: &cloth, pins: &pins };
        let begun =
            Dressing::rewrapped(Arc::clone(&garment), Arc::clone(&body), &marks, source.relax, dressed);
        Self { places, pinned: Arc::new(pinned), ..Self::begun(source, body, garment, problems, begun) }
    }

    /// The dressed cloth, transferred to the edited `pattern`: each point of a piece stays where it was, then all settles. Cloth
    /// that is still growing starts again. None where nothing is dressed.
    pub fn resewn(
        &mut self,
        pattern: Arc<Pattern>,
        marks: Arc<Marks>,
        places: Arc<Vec<ClothPlace>>,
        carried: &[Carried],
    ) -> Option<Self> {
        let (old, body) = (self.garment.clone()?, self.body.clone()?);
        self.release();
        let source =
            Arc::new(GarmentSource { pattern, marks, ..GarmentSource::clone(self.source.as_ref()?) });
        if let Some(Ok(world)) = self.tried_again(Arc::clone(&source), Arc::clone(&body)) {
            return Some(Self { places, ..world });
        }
        if let Some(Ok(world)) = self.placed_again(Arc::clone(&source), Arc::clone(&body)) {
            return Some(Self { places, ..world });
        }
        if self.dressing.as_ref().is_some_and(|dressing| dressing.relaxer().is_none()) {
            return Some(Self { relaxing: self.relaxing, places, ..Self::wrapped(source, body) });
        }
        let mut meshes = Arc::clone(&self.meshes);
        let (garment, problems) =
            cloth::build_again(&source.pattern, source.edge_length, Arc::make_mut(&mut meshes));
        let built = Built { source, garment: Arc::new(garment), problems, meshes };
        if let Some(world) = self.retrimmed(&built, &places) {
            return Some(world);
        }
        let Built { source, garment, mut problems, meshes } = built;
        let mut cloth = unlaid(&garment);
        Carry::moved(&old, &garment, carried).places(&self.cloth, &mut cloth);
        let under = |place: &ClothPlace| vertex_under(&garment, &cloth, *place).map(|(v, _)| v);
        let pinned: Vec<Option<u32>> = places.iter().map(under).collect();
        problems.extend(unlaid_pieces(&garment, &cloth));
        let mut world = Self {
            source: Some(source),
            body: Some(body),
            garment: Some(garment),
            cloth: Arc::new(cloth),
            places,
            pinned: Arc::new(pinned),
            relaxing: self.relaxing,
            problems: Arc::new(problems),
            meshes,
            moved: self.moved,
            ..Self::default()
        };
        if !world.worked_as_draped(self) {
            world.settle();
        }
        Some(world)
    }

    /// Transfers the cloth of `old` to the mesh of `source`: the same flat point keeps its position.
    fn recut(&self, source: &GarmentSource, old: Arc<Garment>) -> Cut {
        let same = |old: &GarmentSource| {
            (Arc::ptr_eq(&old.pattern, &source.pattern) || old.pattern == source.pattern)
                && old.edge_length == source.edge_length
        };
        if self.source.as_deref().is_some_and(same) {
            let (cloth, pinned) = (Arc::clone(&self.cloth), self.pinned.to_vec());
            return Cut { is_as_before: true, garment: old, cloth, pinned, problems: Vec::new() };
        }
        let (garment, problems) = cloth::build(&source.pattern, source.edge_length);
        let mut cloth = unlaid(&garment);
        Carry::new(&old, &garment).places(&self.cloth, &mut cloth);
        let pinned = self.places.iter().map(|&p| vertex_under(&garment, &cloth, p).map(|(v, _)| v)).collect();
        Cut { is_as_before: false, garment: Arc::new(garment), cloth: Arc::new(cloth), pinned, problems }
    }

    /// Cloth that was dressed, and perhaps draped, before. The error is in words.
    pub fn adopted(
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
        cloth: Arc<ClothState>,
        moved: Moved,
    ) -> Result<Self, Words> {
        let (garment, problems) = cloth::build(&source.pattern, source.edge_length);
        let count = garment.vertex_count;
        if cloth.positions.len() != count || cloth.mapped.len() != count {
            return Err(words!(
                "the dressed cloth has {n} vertices, the pattern it belongs to gives {count}",
                n = cloth.positions.len(),
                count
            ));
        }
        let splits = Splits::of_lying(&garment, &cloth, &body, source.relax.offset);
        Ok(Self {
            source: Some(source),
            body: Some(body),
            garment: Some(Arc::new(garment)),
            splits: splits.map(Arc::new),
            cloth,
            moved,
            problems: Arc::new(problems),
            ..Self::default()
        })
    }

    /// Changes the settings of relaxation; cloth at rest wakes.
    pub fn set_relax(&mut self, relax: RelaxSettings) {
        if let Some(source) = &mut self.source {
            Arc::make_mut(source).relax = relax;
        }
        self.change_trials(|source| source.relax = relax);
        if let Some(dragging) = &mut self.dragging {
            return Arc::make_mut(dragging).set_settings(relax);
        }
        if self.is_draped() || self.sewing.is_some() {
            return;
        }
        self.resume();
        let held = self.held();
        if let Some(dressing) = self.dressing.as_mut().map(Arc::make_mut) {
            dressing.set_settings(relax);
            if dressing.relaxer().is_some() {
                dressing.fix(&held);
            }
        }
    }

    /// Pins exactly the vertices nearest to `places`. Cloth at rest wakes when a pin is removed.
    pub fn set_pins(&mut self, places: &[ClothPlace]) {
        let before = self.held();
        self.places = Arc::new(places.to_vec());
        self.pinned = Arc::new(places.iter().map(|&place| Some(self.under(place)?.0)).collect());
        self.hold(&before);
    }

    /// Begins to drag the cloth at `at`. Does nothing where no cloth is laid, or while it grows.
    pub fn grab(&mut self, at: ClothPlace, mode: DragMode, bones: &[Bone]) {
        self.trials = None;
        self.release();
        if self.sewing.is_some() || self.grab_draped(at) {
            return;
        }
        let Some((hand, place)) = self.under(at) else { return };
        self.resume();
        let Some(mut relaxer) = self.dressing.as_ref().and_then(|d| d.relaxer()).cloned() else { return };
        relaxer.bones = Arc::new(Bones::new(bones, &relaxer.surface));
        let beside = place - self.cloth.positions[hand as usize];
        let dragging = Dragging::new(relaxer, &self.cloth, hand, beside, mode, &self.held());
        self.dragged = Some(Arc::new(dragging.shares()));
        self.dragging = Some(Arc::new(dragging));
        self.dressing = None;
    }

    /// Moves the target of the drag.
    pub fn drag_to(&mut self, pointer: Ray) {
        self.drag_draped(pointer);
        if let Some(dragging) = &mut self.dragging {
            Arc::make_mut(dragging).drag_to(pointer);
        }
    }

    /// Ends the drag; the cloth settles.
    pub fn release(&mut self) {
        self.release_draped();
        if let Some(dragging) = self.dragging.take() {
            let relaxer = Arc::unwrap_or_clone(dragging).into_relaxer();
            self.dressing = Some(Arc::new(Dressing::lying(relaxer, &self.cloth)));
            self.dragged = None;
            self.settle();
        }
    }

    pub(in crate::sim) fn settle(&mut self) {
        self.resume();
        let pinned = self.held();
        if let Some(dressing) = &mut self.dressing {
            let dressing = Arc::make_mut(dressing);
            dressing.fix(&pinned);
            dressing.settle_again();
        }
    }

    pub(in crate::sim) fn under(&self, place: ClothPlace) -> Option<(u32, DVec3)> {
        vertex_under(self.garment.as_deref()?, &self.cloth, place)
    }

    /// Pins placed before the cloth was laid hold it now.
    fn find_lost_pins(&mut self) {
        if self.pinned.contains(&None) {
            self.set_pins(&Arc::clone(&self.places));
        }
    }

    /// Prepares adopted cloth for relaxation.
    fn resume(&mut self) {
        if self.dressing.is_none() && self.dragging.is_none() {
            self.dressing = self.resumed();
        }
    }

    fn resumed(&self) -> Option<Arc<Dressing>> {
        let (garment, body, source) = (self.garment.clone()?, self.body.clone()?, self.source.as_ref()?);
        let mut dressing = Dressing::resumed(garment, body, source.relax, &self.cloth)?;
        dressing.fix(&self.held());
        Some(Arc::new(dressing))
    }

    /// Work counters of the wrap or of the drag.
    pub fn work(&self) -> Counters {
        let dragging = self.dragging.as_ref().map(|d| d.counters());
        dragging.or_else(|| self.dressing.as_ref().map(|d| d.counters())).unwrap_or_default()
    }

    /// The garment and its cloth as drawn and measured, where edges are split or pieces are deactivated; None where neither is
    /// so.
    pub fn drawn(&self) -> Option<(Arc<Garment>, Arc<ClothState>)> {
        if let Some(active) = self.active.as_ref().filter(|_| self.sewing.is_none()) {
            return Some((Arc::clone(active), Arc::clone(self.shown().0)));
        }
        if self.posing.is_some() {
            return None;
        }
        let drawn = match (&self.dragging, &self.dressing) {
            (Some(dragging), _) => dragging.drawn(&self.cloth),
            (None, Some(dressing)) => dressing.relaxer().and_then(|relaxer| relaxer.drawn(&self.cloth)),
            (None, None) => self.splits.as_ref().and_then(|splits| splits.drawn(&self.cloth)),
        };
        drawn.map(|(garment, cloth)| (garment, Arc::new(cloth)))
    }

    /// Does a tick of work.
    pub fn step(&mut self) {
        match (&self.posing, &self.trials) {
            (Some(_), _) => self.pose(),
            (None, Some(_)) => self.try_on(),
            (None, None) => self.advance(),
        }
    }

    /// Does a tick of work on the present cloth, leaving changes of pose and trials aside.
    pub(in crate::sim) fn advance(&mut self) {
        if self.sewing.is_some() {
            self.sew();
        } else if self.drapes_now() {
            self.drape();
        } else if let Some(dragging) = &mut self.dragging {
            Arc::make_mut(dragging).step(Arc::make_mut(&mut self.cloth), self.relaxing);
        } else if let Some(dressing) = &mut self.dressing {
            let lay = dressing.relaxer().is_some();
            Arc::make_mut(dressing).step(Arc::make_mut(&mut self.cloth));
            if !lay && dressing.relaxer().is_some() {
                self.find_lost_pins();
            }
        }
    }

    /// Whether a tick of sewing or draping is partly done: where much lies near each other it takes several ticks of the simulation.
    pub(in crate::sim) fn is_mid_tick(&self) -> bool {
        match &self.sewing {
            Some(placed) => placed.is_mid_tick(),
            None => self.draping.as_ref().is_some_and(|draping| draping.is_mid_tick()),
        }
    }

    /// Phase of dressing; None without a garment.
    pub fn phase(&self) -> Option<Phase> {
        self.garment.as_ref()?;
        if self.posing.is_some() || (self.trials.is_some() && self.lies_still()) {
            return Some(Phase::Settling);
        }
        if let Some(dragging) = &self.dragging {
            return Some(if dragging.is_still() { Phase::AtRest } else { Phase::Settling });
        }
        if self.sewing.is_some() {
            return Some(Phase::Growing);
        }
        if self.drapes_now() {
            return Some(Phase::Settling);
        }
        Some(self.dressing.as_ref().map_or(Phase::AtRest, |d| d.phase()))
    }

    /// Progress of growing and settling, or over all starts while they are tried, 0..=1.
    pub fn progress(&self) -> f64 {
        if let Some(trials) = &self.trials {
            return trials.progress();
        }
        if let Some(posing) = &self.posing {
            return posing.progress();
        }
        if let Some(progress) = self.sewing.as_ref().map(|placed| placed.progress()) {
            return progress;
        }
        if let Some(drape) = self.drape_state().filter(|drape| drape.runs && !drape.waits) {
            return drape.progress();
        }
        self.dressing.as_ref().map_or(1.0, |d| d.progress())
    }

    /// Whether a tick would change nothing.
    pub fn is_at_rest(&self) -> bool {
        self.posing.is_none() && self.lies_still() && (self.trials.is_none() || !self.relaxing)
    }

    /// Whether the present cloth has come to rest, or is paused.
    pub(in crate::sim) fn lies_still(&self) -> bool {
        if let Some(dragging) = &self.dragging {
            return dragging.is_still();
        }
        if self.sewing.is_some() {
            return !self.relaxing;
        }
        if self.drapes_now() {
            return false;
        }
        !self.relaxing || self.dressing.as_ref().is_none_or(|d| d.phase() == Phase::AtRest)
    }

    /// Hash of the moving state.
    pub fn hash(&self) -> u64 {
        cloth_hash(&self.cloth, self.phase(), self.relaxing)
    }

    /// The first mapped vertex that is not a finite point.
    pub fn not_finite(&self) -> Option<usize> {
        let cloth = &self.cloth;
        cloth.positions.iter().zip(&cloth.mapped).position(|(p, &mapped)| mapped && !p.is_finite())
    }

    /// Estimate of the memory that this takes and does not share with `other`, bytes.
    pub fn bytes_beside(&self, other: Option<&World>) -> usize {
        /// Bytes per vertex: position, flag and what a wrap stores, most of it the factored matrix.
        const PER_VERTEX: usize = 1000;
        /// Bytes per triangle: corners, rest shape and neighbours.
        const PER_TRIANGLE: usize = 250;
        /// Bytes of a world without a garment.
        const ALWAYS: usize = 256;
        let cloth_shared = other.is_some_and(|o| Arc::ptr_eq(&o.cloth, &self.cloth));
        let cloth = if cloth_shared { 0 } else { self.cloth.positions.len() * PER_VERTEX };
        let garment = match (&self.garment, other.and_then(|o| o.garment.as_ref())) {
            (Some(a), Some(b)) if Arc::ptr_eq(a, b) => 0,
            (Some(a), _) => a.triangles.len() * PER_TRIANGLE,
            (None, _) => 0,
        };
        ALWAYS + cloth + garment
    }
}

/// A garment, cloth in its mesh, and the vertices under the pins.
struct Cut {
    /// Whether the mesh is that of the dressed garment.
    is_as_before: bool,
    garment: Arc<Garment>,
    cloth: Arc<ClothState>,
    pinned: Vec<Option<u32>>,
    problems: Vec<Problem>,
}

/// Cloth of `garment` with no vertex laid.
pub(in crate::sim) fn unlaid(garment: &Garment) -> ClothState {
    let count = garment.vertex_count;
    ClothState { positions: vec![DVec3::ZERO; count], mapped: vec![false; count] }
}

/// A problem for each piece that was added to a dressed garment and is not laid yet.
fn unlaid_pieces(garment: &Garment, cloth: &ClothState) -> Vec<Problem> {
    let lies = |piece: PieceId| {
        let mut of_piece =
            garment.triangles.iter().zip(&garment.triangle_pieces).filter(|(_, p)| **p == piece);
        of_piece.any(|(t, _)| t.iter().all(|&v| cloth.mapped[v as usize]))
    };
    let unlaid = garment.pieces.iter().filter(|(id, _)| !lies(*id));
    unlaid
        .map(|(id, name)| Problem {
            kind: ProblemKind::Dressing,
            place: words!("{name} ({id})", name, id),
            words: words!("it came to the dressed garment and does not lie yet; wrap again to lay it"),
        })
        .collect()
}

/// The laid vertex nearest to a point of the flat cloth, and the position of that point, metres.
fn vertex_under(garment: &Garment, cloth: &ClothState, place: ClothPlace) -> Option<(u32, DVec3)> {
    let place = FlatPiece::new(garment, place.piece).nearest(garment, place.at)?;
    let point = place.point(garment, cloth)?;
    let (vertex, _) = place.vertices(garment).into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((vertex, point))
}
