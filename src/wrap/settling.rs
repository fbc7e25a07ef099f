//! When settling cloth lies still, and how often it is mended then.

/// Global steps of the first, ungraviated settling.
pub(super) const SETTLE_STEPS: usize = 80;
/// At rest when nothing moved farther than this many edge lengths for [`QUIET_STEPS`] steps.
const REST_MOTION: f64 = 0.01;
/// See [`REST_MOTION`].
const QUIET_STEPS: usize = 5;
/// And when the energy of matching changed by no larger share meanwhile: what creeps on then costs no strain.
const REST_FALL: f64 = 0.03;
/// Or is no larger than this: a strain of 0.01 %.
const REST_ENERGY: f64 = 1e-8;
/// Quiet steps after which cloth whose energy still changed is asked again.
const CREEP_STEPS: usize = 15;
/// Most settling steps: what still moves then trembles in a fold.
const MOST_SETTLE_STEPS: usize = 400;
/// The same for a coarse mesh, which only has to lie roughly right.
const DRAFT_SETTLE_STEPS: usize = 160;
/// Most times that lying cloth is mended: raised off the body it cuts, sent to its own side.
const MOST_MENDS: usize = 12;
/// The same for a coarse mesh.
const DRAFT_MENDS: usize = 2;
/// Steps in which a mend must take effect.
const STEPS_PER_MEND: usize = 25;

/// How far settling has come.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settling {
    /// Steps done.
    pub done: usize,
    /// Layers ran through each other when last looked at, or nobody looked.
    pub crossed: bool,
    /// A finer mesh goes on from here.
    draft: bool,
    /// Quiet steps in a row up to now.
    quiet: usize,
    /// How often lying cloth was mended.
    mends: usize,
    /// At this step it is taken to lie still in any case.
    until: usize,
    /// Of matching when it last became quiet.
    energy: f64,
    /// It was quiet once, but its energy still changed.
    creeps: bool,
}

impl Settling {
    /// From step `done` on.
    pub fn from(done: usize, draft: bool) -> Self {
        let until = if draft { DRAFT_SETTLE_STEPS } else { MOST_SETTLE_STEPS };
        Self { done, crossed: true, draft, quiet: 0, mends: 0, until, energy: 0.0, creeps: false }
    }

    /// Without gravity yet.
    pub fn is_first(&self) -> bool {
        self.done < SETTLE_STEPS
    }

    /// Takes note of a step in which nothing moved farther than `moved` edge lengths; whether the cloth lies still now.
    /// `energy` is [`Relaxer::energy`](crate::relax::Relaxer::energy).
    pub fn is_still(&mut self, moved: f64, energy: impl Fn() -> f64) -> bool {
        self.quiet = if moved < REST_MOTION { self.quiet + 1 } else { 0 };
        if self.quiet == 1 {
            self.energy = energy();
        }
        let enough = if self.creeps { CREEP_STEPS } else { QUIET_STEPS };
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

    /// Lying cloth may be mended once more.
    pub fn may_mend(&self) -> bool {
        self.mends < if self.draft { DRAFT_MENDS } else { MOST_MENDS }
    }

    /// After a step.
    pub fn stepped(self) -> Self {
        Self { done: self.done + 1, ..self }
    }

    /// After a step that ended with a mend: it has its time to take effect.
    pub fn mended(self) -> Self {
        let (mends, until) = (self.mends + 1, self.done + STEPS_PER_MEND);
        Self { mends, until, quiet: 0, crossed: true, creeps: false, ..self.stepped() }
    }
}
