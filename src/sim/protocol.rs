//! Messages of the simulation: requests in, events and snapshots out.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Serialize;

use crate::body::Surface;
use crate::card::CardSlot;
use crate::cloth::{ClothState, Garment};
use crate::contact::Bone;
use crate::drag::{DragMode, Ray};
use crate::fit::{Moved, TightPlace};
use crate::geometry::ids::PieceId;
use crate::geometry::words::Words;
use crate::pattern::activity::Activity;
use crate::pattern::edit::Carried;
use crate::pattern::{Pattern, Problem};
use crate::relax::RelaxSettings;
use crate::repose::Outcome;
use crate::sim::fault::{Fault, Lies};
use crate::sim::source::{ClothPlace, DrapeSource, GarmentSource};
use crate::sim::start::{StartChoice, Started, Trying};
use crate::sim::stats::Stats;
use crate::wrap::{Marks, Phase};

/// A request to the simulation. It takes effect between two ticks, in order of `seq`.
#[derive(Clone, Debug)]
pub struct Request {
    /// Strictly ascending number, by which `Restore` and `Applied` refer to the request.
    pub seq: u64,
    /// Keep the state before this request, so that `Restore { before_seq: seq }` can return to it.
    pub checkpoint: bool,
    /// The request itself.
    pub kind: RequestKind,
}

/// Kinds of requests to the simulation.
#[derive(Clone, Debug)]
pub enum RequestKind {
    /// Build the garment and grow it round the body from its marks, then relax it until it is at rest.
    Wrap { source: Arc<GarmentSource>, body: Arc<Surface> },
    /// Grow the dressed cloth anew from the pairs of marks with these numbers (none: all), except where pins hold it. Where
    /// nothing is dressed, or the pattern has changed since, all of the garment is wrapped from these pairs.
    Rewrap { source: Arc<GarmentSource>, body: Arc<Surface>, pairs: Vec<usize> },
    /// The pattern was edited: triangulate the garment again, move each point of it to where the same point of the dressed cloth
    /// was, then settle. `carried` are pieces that were moved in the pattern plane. Does nothing where nothing is dressed.
    Resew { pattern: Arc<Pattern>, marks: Arc<Marks>, pins: Arc<Vec<ClothPlace>>, carried: Arc<Vec<Carried>> },
    /// Take over cloth that was dressed, and perhaps draped, before (from a project file). It is at rest until something changes.
    Adopt { source: Arc<GarmentSource>, body: Arc<Surface>, cloth: Arc<ClothState>, moved: Moved },
    /// The body takes another pose; `body` has the triangles of the present body. The cloth follows and, with `settle`, settles
    /// there; if it intersects itself more than before, it is draped with `fabrics`. A `draft` is a quick preview of lower
    /// quality. Does nothing where nothing is dressed.
    Repose { body: Arc<Surface>, marks: Arc<Marks>, fabrics: Arc<DrapeSource>, settle: bool, draft: bool },
    /// The body gets another size; `through` is the new size in the triangles of the present body. The cloth follows and settles
    /// unless it was draped; if it intersects itself more than before, it is draped. Does nothing where nothing is dressed.
    Resize { through: Arc<Surface>, body: Arc<Surface>, marks: Arc<Marks>, fabrics: Arc<DrapeSource> },
    /// Change the settings of relaxation.
    SetRelax(RelaxSettings),
    /// Pin exactly these points of the cloth where they are.
    SetPins(Arc<Vec<ClothPlace>>),
    /// Begin to drag the cloth; does nothing where there is none, or while it grows. It cannot be pulled across `bones`.
    Grab { at: ClothPlace, mode: DragMode, bones: Arc<Vec<Bone>> },
    /// Move the dragged point to this ray of the pointer; does nothing while nothing is dragged.
    DragTo(Ray),
    /// End the drag; the cloth settles.
    Release,
    /// Pause (false) or go on (true).
    SetRelaxing(bool),
    /// Start draping (physics) as soon as all of the cloth is laid, until it rests; or stop it. Does nothing where there is no
    /// cloth.
    SetDraping { on: bool, source: Arc<DrapeSource> },
    /// Drape for `ticks` ticks.
    StepDraping { ticks: u32, source: Arc<DrapeSource> },
    /// Build the garment, sew it together from the placement of its pieces, and drape it.
    Sew { source: Arc<GarmentSource>, body: Arc<Surface>, fabrics: Arc<DrapeSource> },
    /// Build the garment and try the starts that `choice` allows, one after the other, until one has no fault. Dragging, draping
    /// or wrapping the cloth meanwhile ends this, and the cloth stays as it is.
    Dress {
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
        /// The mannequin in the pose that it is built in, where it has another.
        built: Option<Arc<Surface>>,
        fabrics: Arc<DrapeSource>,
        choice: StartChoice,
    },
    /// Change the fabrics of draped cloth.
    SetFabrics(Arc<DrapeSource>),
    /// Set which pieces are frozen or deactivated; all others are active.
    SetActivities(Arc<BTreeMap<PieceId, Activity>>),
    /// Take the cloth off.
    Clear,
    /// Return to the state before the request numbered `before_seq`, bit for bit.
    Restore { before_seq: u64 },
    /// Drape on this graphics card from the next start of draping on; None: on the processor. The cloth is then not the same on
    /// every machine: nothing tells its hash.
    UseCard(Option<Arc<CardSlot>>),
    /// Report the state hash. Changes nothing.
    Hash,
}

/// The state after a tick or a request, for reading. A newer one replaces those not read yet.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Ticks executed so far. Sleep does not count.
    pub tick: u64,
    /// Number of the last request that took effect; 0: none.
    pub seq: u64,
    /// The garment on the body, if any.
    pub garment: Option<Arc<Garment>>,
    /// What the garment was built from.
    pub source: Option<Arc<GarmentSource>>,
    /// The body it was put on.
    pub body: Option<Arc<Surface>>,
    /// Positions and which vertices are mapped. Empty without a garment.
    pub cloth: Arc<ClothState>,
    /// The garment and its cloth as drawn, measured and exported, where they differ from `garment` and `cloth`: edges split where
    /// they would cut the body, and deactivated pieces left out. The vertices are those of `garment`, then those inserted. None
    /// where nothing differs.
    pub split: Option<(Arc<Garment>, Arc<ClothState>)>,
    /// Phase of dressing. None without a garment.
    pub phase: Option<Phase>,
    /// Progress of growing and settling, 0..=1.
    pub progress: f64,
    /// The vertex under each pin, in the pins' order; None where no cloth is laid.
    pub pinned: Arc<Vec<Option<u32>>>,
    /// Share of the drag that reaches each vertex, 0..=1; None while nothing is dragged.
    pub dragged: Option<Arc<Vec<f32>>>,
    /// Whether the simulation runs; false while paused.
    pub relaxing: bool,
    /// Whether the next tick would do something.
    pub working: bool,
    /// Work counters.
    pub stats: Stats,
    /// Problems found by building, wrapping and sewing.
    pub problems: Arc<Vec<Problem>>,
    /// Statistics of the last change of pose; None once the cloth has moved since.
    pub reposed: Option<Outcome>,
    /// Faults of the cloth; None until they were looked for.
    pub verdict: Option<Arc<Vec<Fault>>>,
    /// Tight places, the tightest piece first; empty until they were looked for.
    pub tight: Arc<Vec<TightPlace>>,
    /// Whether the cloth is being carried to another pose.
    pub is_posing: bool,
    /// Whether the cloth lies as it was carried to the pose of the body, not draped there.
    pub is_carried: bool,
    /// State of draping; None where nothing is draped.
    pub drape: Option<DrapeState>,
    /// How the cloth came to where it lies, which tells whether folds are a fault.
    pub moved: Moved,
    /// Whether the cloth was sewn from the placement of its pieces on the body in its present pose; then it should still be
    /// there.
    pub was_sewn: bool,
    /// Heights of the highest points of its pieces before a start draped it, metres; None where none did, or the body has moved.
    pub hung_at: Option<Arc<[f64]>>,
    /// Pieces are being sewn: `garment` then has open seams.
    pub is_sewing: bool,
    /// While starts are tried: the present one.
    pub trying: Option<Trying>,
    /// Results of the starts that were tried; None once the cloth is dressed otherwise.
    pub started: Option<Arc<Started>>,
}

/// Residual above which cloth that never comes to rest is seen to move: trembling at 5 Hz, it swings by half a millimetre.
const SEEN: f64 = 0.05;

impl DrapeState {
    /// Progress, 0..=1: the share of the way, else the residual on a logarithmic scale from 1 (free fall) to 0.01 (at rest).
    pub fn progress(&self) -> f64 {
        self.way.unwrap_or_else(|| (-self.residual.max(f64::MIN_POSITIVE).log10() / 2.0).clamp(0.0, 1.0))
    }

    /// The residual of cloth that was draped, never came to rest, and is seen to move.
    pub fn unbalanced(&self) -> Option<f64> {
        (self.restless && self.residual > SEEN).then_some(self.residual)
    }
}

/// State of draping.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DrapeState {
    /// Whether the cloth is draped until it rests; false: paused.
    pub on: bool,
    /// Whether it waits until all of the cloth is laid.
    pub waits: bool,
    /// Whether it goes on: the cloth is not at rest, and ticks are left.
    pub runs: bool,
    /// Whether draping has ended though the cloth still moves.
    pub restless: bool,
    /// Unbalanced force as a share of the weight: Σ m |Δv| / Δt over Σ m g.
    pub residual: f64,
    /// Speed of the fastest vertex, m/s.
    pub speed: f64,
    /// Ticks of physics so far. For large cloth one takes several ticks of the simulation.
    pub ticks: u64,
    /// Small steps in each tick of physics, on the processor.
    pub substeps: usize,
    /// Whether a graphics card has moved the cloth.
    pub card: bool,
    /// While it is draped along the way to another pose: the share that lies behind, 0..=1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub way: Option<f64>,
}

impl Snapshot {
    /// The garment as drawn, measured and exported, and its cloth.
    pub fn drawn(&self) -> Option<(&Arc<Garment>, &Arc<ClothState>)> {
        let whole = self.garment.as_ref().map(|garment| (garment, &self.cloth));
        self.split.as_ref().map(|(garment, cloth)| (garment, cloth)).or(whole)
    }

    /// How the cloth came to its present position.
    pub fn lies(&self) -> Lies<'_> {
        let unbalanced = self.drape.and_then(|drape| drape.unbalanced());
        Lies { moved: self.moved, sewn: self.was_sewn, hung_at: self.hung_at.as_deref(), unbalanced }
    }

    /// Whether any cloth is on the body.
    pub fn is_dressed(&self) -> bool {
        self.cloth.mapped.iter().any(|&m| m)
    }
}

/// Events of the simulation, besides snapshots. None is ever dropped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// Request `seq` took effect before tick number `tick + 1`.
    Applied { seq: u64, tick: u64 },
    /// The state hash after request `seq`: sent when a request asks for it (`asked` is its number) and whenever the cloth comes
    /// to rest. None for cloth that a graphics card has moved.
    Hash { tick: u64, seq: u64, cloth: Option<u64>, asked: Option<u64> },
    /// A tick or a request failed (not a number, or a panic). The state is that of before the request, or of the last checkpoint,
    /// and relaxing is paused.
    Failed { tick: u64, seq: u64, words: Words },
    /// To save memory, the states before requests numbered below `before_seq` were dropped.
    Forgotten { before_seq: u64 },
}
