//! What goes into the simulation and what comes out.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Serialize;

use crate::body::Surface;
use crate::cloth::{ClothState, Garment};
use crate::contact::Bone;
use crate::drag::{DragMode, Ray};
use crate::fit::TightPlace;
use crate::geometry::ids::PieceId;
use crate::pattern::activity::Activity;
use crate::pattern::edit::Carried;
use crate::pattern::{Pattern, Problem};
use crate::relax::RelaxSettings;
use crate::repose::Outcome;
use crate::sim::fault::{Fault, Lies};
use crate::sim::source::{ClothPlace, DrapeSource, GarmentSource};
use crate::sim::start::{Start, StartChoice, Started};
use crate::sim::stats::Stats;
use crate::wrap::{Marks, Phase};

/// Something asked of the simulation. Taken up between two ticks, in order of `seq`.
#[derive(Clone, Debug)]
pub struct Request {
    /// Strictly ascending. What `Restore` and `Applied` name.
    pub seq: u64,
    /// Keep the state before this request, so that `Restore { before_seq: seq }` can return to it.
    pub checkpoint: bool,
    /// What is asked.
    pub kind: RequestKind,
}

/// What can be asked of the simulation.
#[derive(Clone, Debug)]
pub enum RequestKind {
    /// Build the garment and grow it round the body from its marks, then relax it until it is at rest.
    Wrap { source: Arc<GarmentSource>, body: Arc<Surface> },
    /// Grow the dressed cloth anew from the pairs of marks with these numbers (none: all), as far as pins let it. Where
    /// nothing is dressed, or the pattern has changed since, all of it is wrapped by them.
    Rewrap { source: Arc<GarmentSource>, body: Arc<Surface>, pairs: Vec<usize> },
    /// The pattern was edited: the dressed cloth is cut anew and lies where the same places lay, then settles. `carried`:
    /// pieces whose places have moved. Nothing happens where nothing is dressed.
    Resew { pattern: Arc<Pattern>, marks: Arc<Marks>, pins: Arc<Vec<ClothPlace>>, carried: Arc<Vec<Carried>> },
    /// Take over cloth that was dressed before (from a project file), and perhaps draped. It is at rest until something
    /// changes.
    Adopt { source: Arc<GarmentSource>, body: Arc<Surface>, cloth: Arc<ClothState>, was_draped: bool },
    /// The body takes another pose: `body` has the triangles of the one that is dressed. The cloth goes along and, with
    /// `settle`, settles there; cloth that comes to run through itself is draped there as what it is made of. A `draft` is quick and
    /// not so exact. Nothing happens where nothing is dressed.
    Repose { body: Arc<Surface>, marks: Arc<Marks>, fabrics: Arc<DrapeSource>, settle: bool, draft: bool },
    /// The body is built in another size: `through` is it in the triangles of the one that is dressed. The cloth goes along
    /// and, unless it was draped, settles there; or it is draped as in another pose. Nothing happens where nothing is dressed.
    Resize { through: Arc<Surface>, body: Arc<Surface>, marks: Arc<Marks>, fabrics: Arc<DrapeSource> },
    /// Relax differently from now on.
    SetRelax(RelaxSettings),
    /// Exactly these places of the cloth are pinned to where they are.
    SetPins(Arc<Vec<ClothPlace>>),
    /// Take the cloth in the hand; nothing happens where there is none, or while it grows. It cannot be pulled across `bones`.
    Grab { at: ClothPlace, mode: DragMode, bones: Arc<Vec<Bone>> },
    /// The hand is there now; nothing happens when nothing is in it.
    DragTo(Ray),
    /// Let go; the cloth settles.
    Release,
    /// Pause (false) or go on (true).
    SetRelaxing(bool),
    /// Let physics move the cloth, once all of it lies, until it rests; or stop that. Nothing happens where there is none.
    SetDraping { on: bool, source: Arc<DrapeSource> },
    /// The same for `ticks` ticks.
    StepDraping { ticks: u32, source: Arc<DrapeSource> },
    /// Build the garment, sew it together from where its pieces were placed, and drape it.
    Sew { source: Arc<GarmentSource>, body: Arc<Surface>, fabrics: Arc<DrapeSource> },
    /// Build the garment and try the starts that `choice` allows, one after the other, until one has no fault. Cloth that is
    /// taken in the hand, draped or wrapped meanwhile stays as it lies then.
    Dress { source: Arc<GarmentSource>, body: Arc<Surface>, fabrics: Arc<DrapeSource>, choice: StartChoice },
    /// What is draped is made of something else.
    SetFabrics(Arc<DrapeSource>),
    /// These pieces are frozen or not, all others active.
    SetActivities(Arc<BTreeMap<PieceId, Activity>>),
    /// Take the cloth off.
    Clear,
    /// Return, bit for bit, to the state before the request numbered `before_seq`.
    Restore { before_seq: u64 },
    /// Report the state hash. Changes nothing.
    Hash,
}

/// The state after a tick or a request, for reading. The newest replaces the ones not yet looked at.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Ticks executed so far. Sleep does not count.
    pub tick: u64,
    /// The last request that took effect; 0: none.
    pub seq: u64,
    /// The garment on the body, if any.
    pub garment: Option<Arc<Garment>>,
    /// What it was built from.
    pub source: Option<Arc<GarmentSource>>,
    /// The body it was put on.
    pub body: Option<Arc<Surface>>,
    /// Positions and which vertices are mapped. Empty without a garment.
    pub cloth: Arc<ClothState>,
    /// The same as it is drawn, measured and written, where edges are split to go over the body, or without its deactivated
    /// pieces: its vertices are those of `garment`, then those put in. None where no edge is split and all pieces count.
    pub split: Option<(Arc<Garment>, Arc<ClothState>)>,
    /// How far the dressing has come. None without a garment.
    pub phase: Option<Phase>,
    /// 0..=1 over growing and settling.
    pub progress: f64,
    /// The vertex under each pin, in the pins' order; None where no cloth lies.
    pub pinned: Arc<Vec<Option<u32>>>,
    /// While cloth is in the hand: how much of the drag reaches each vertex, 0..=1.
    pub dragged: Option<Arc<Vec<f32>>>,
    /// False while paused.
    pub relaxing: bool,
    /// Whether the next tick would do something.
    pub working: bool,
    /// Counts of work.
    pub stats: Stats,
    /// What building and wrapping found wrong.
    pub problems: Arc<Vec<Problem>>,
    /// What came of the last change of pose, while the cloth lies as it left it.
    pub reposed: Option<Outcome>,
    /// What is wrong with the cloth as it lies; None until somebody has looked.
    pub verdict: Option<Arc<Vec<Fault>>>,
    /// Where it is tight, the tightest piece first; none until somebody has looked.
    pub tight: Arc<Vec<TightPlace>>,
    /// How draping stands; None where nothing is draped.
    pub drape: Option<DrapeState>,
    /// Physics has moved the cloth since it was grown: folds are no fault.
    pub was_draped: bool,
    /// It was sewn from where its pieces were placed, round the body as it is: it should lie about there.
    pub was_sewn: bool,
    /// Pieces are being sewn: `garment` is not the one that `source` gives, but one with open seams, or coarser.
    pub is_sewing: bool,
    /// While starts are tried: the one under way, and whether it is draped already.
    pub trying: Option<(Start, bool)>,
    /// What came of the starts that were tried, until the cloth is dressed otherwise.
    pub started: Option<Arc<Started>>,
}

impl DrapeState {
    /// 0..=1: how many of the powers of ten between free fall and rest (1 %) what moves the cloth has fallen by.
    pub fn progress(&self) -> f64 {
        (-self.residual.max(f64::MIN_POSITIVE).log10() / 2.0).clamp(0.0, 1.0)
    }
}

/// How draping stands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DrapeState {
    /// Until the cloth rests; false: paused.
    pub on: bool,
    /// For all cloth to lie.
    pub waits: bool,
    /// It has not come to rest or to its last tick.
    pub runs: bool,
    /// The forces that move the cloth as a share of its weight: Σ m |Δv| / Δt over Σ m g.
    pub residual: f64,
    /// The fastest vertex, m/s.
    pub speed: f64,
    /// Ticks of physics so far, each done in one tick of the simulation or, of large cloth, in several.
    pub ticks: u64,
    /// Small steps in each tick of physics.
    pub substeps: usize,
}

impl Snapshot {
    /// The garment as it is drawn, measured and written, and where that is.
    pub fn drawn(&self) -> Option<(&Arc<Garment>, &Arc<ClothState>)> {
        let whole = self.garment.as_ref().map(|garment| (garment, &self.cloth));
        self.split.as_ref().map(|(garment, cloth)| (garment, cloth)).or(whole)
    }

    /// How the cloth came to lie.
    pub fn lies(&self) -> Lies {
        Lies { draped: self.was_draped, sewn: self.was_sewn }
    }

    /// Whether there is cloth on the body, however little of it.
    pub fn is_dressed(&self) -> bool {
        self.cloth.mapped.iter().any(|&m| m)
    }
}

/// What the simulation tells besides snapshots. None is ever dropped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// Request `seq` took effect before tick number `tick + 1`.
    Applied { seq: u64, tick: u64 },
    /// The state hash after request `seq`, when asked for (by the request with that number) and whenever the cloth comes
    /// to rest.
    Hash { tick: u64, seq: u64, cloth: u64, asked: Option<u64> },
    /// A step or a request failed (not a number, or a panic); the last checkpoint is back and relaxing paused.
    Failed { tick: u64, seq: u64, words: String },
    /// To save memory, states before requests numbered below `before_seq` are gone.
    Forgotten { before_seq: u64 },
}
