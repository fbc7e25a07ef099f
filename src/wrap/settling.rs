//! Settling: when the cloth counts as at rest, and how often it is repaired then.

/// Number of global steps in the first part of settling, without gravity.
pub(super) const SETTLE_STEPS: usize = 80;
/// Largest move in a step, in edge lengths, below which the step counts as quiet; see [`QUIET_STEPS`].
const REST_MOTION: f64 = 0.01;
/// Number of quiet steps in a row after which the cloth may be at rest.
const QUIET_STEPS: usize = 5;
/// Relative change of the shape matching energy over the quiet steps up to which the cloth is at rest: slow creep at
/// constant energy is ignored.
const REST_FALL: f64 = 0.03;
/// Energy up to which the cloth is at rest in any case: a strain of 0.01 %.
const REST_ENERGY: f64 = 1e-8;
/// Number of steps in which a repair must take effect.
const STEPS_PER_MEND: usize = 25;

/// How long settling may take.
#[derive(Clone, Copy, Debug)]
struct Limits {
    /// Most steps: cloth that still moves then jitters in a fold.
    steps: usize,
    /// Most repairs of resting cloth: raising it off the body that it cuts, moving it to its own side.
    mends: usize,
}

/// For the mesh that is asked for.
const FINE: Limits = Limits { steps: 400, mends: 12 };
/// For a coarse mesh, which only has to be roughly in place: as long with gravity as without.
const DRAFT: Limits = Limits { steps: 2 * SETTLE_STEPS, mends: 2 };

/// State of settling.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settling {
    /// Number of steps done.
    pub done: usize,
    /// Whether layers intersected at the last search, or none was made yet.
    pub crossed: bool,
    /// Most repairs.
    most_mends: usize,
    /// Number of quiet steps in a row.
    quiet: usize,
    /// Number of repairs made.
    mends: usize,
    /// Step at which the cloth is taken to be at rest in any case.
    until: usize,
    /// Shape matching energy at the first of the quiet steps.
    energy: f64,
    /// Whether the energy still changed after the first quiet steps.
    creeps: bool,
}

impl Settling {
    /// Settling from step `done` on. `draft`: a finer mesh continues from the result.
    pub fn from(done: usize, draft: bool) -> Self {
        let Limits { steps: until, mends: most_mends } = if draft { DRAFT } else { FINE };
        Self { done, crossed: true, most_mends, quiet: 0, mends: 0, until, energy: 0.0, creeps: false }
    }

    /// Whether settling is in its first part, without gravity.
    pub fn is_first(&self) -> bool {
        self.done < SETTLE_STEPS
    }

    /// Records a step in which the largest move was `moved` edge lengths. Returns whether the cloth is at rest now.
    /// `energy` is [`Relaxer::energy`](crate::relax::Relaxer::energy).
    pub fn is_still(&mut self, moved: f64, energy: impl Fn() -> f64) -> bool {
        self.quiet = if moved < REST_MOTION { self.quiet + 1 } else { 0 };
        if self.quiet == 1 {
            self.energy = energy();
        }
        // Where the energy still changed the first time it is compared again after longer.
        let enough = if self.creeps { 3 * QUIET_STEPS } else { QUIET_STEPS };
        if self.quiet >= enough && !self.is_first() {
            let energy = energy();
            let changes = (self.energy - energy).abs() > REST_FALL * energy && energy > REST_ENERGY;
            if !changes {
                return true;
            }
            (self.creeps, self.quiet) = (true, 0);
        }
        self.done >= self.until
    }

    /// Whether resting cloth may be repaired once more.
    pub fn may_mend(&self) -> bool {
        self.mends < self.most_mends
    }

    /// The state after a step.
    pub fn stepped(self) -> Self {
        Self { done: self.done + 1, ..self }
    }

    /// The state after a step that ended with a repair, which gets time to take effect.
    pub fn mended(self) -> Self {
        let (mends, until) = (self.mends + 1, self.done + STEPS_PER_MEND);
        Self { mends, until, quiet: 0, crossed: true, creeps: false, ..self.stepped() }
    }
}
