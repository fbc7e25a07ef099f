//! Settling: when the cloth counts as at rest, and how often it is repaired then.

/// When settling cloth counts as at rest, and how long it may take.
#[derive(Clone, Copy, Debug)]
struct Limits {
    /// Steps of the first part, without gravity.
    light_steps: usize,
    /// Most steps: cloth that still moves then jitters in a fold.
    steps: usize,
    /// Most repairs of resting cloth: raising it off the body that it cuts, moving it to its own side.
    mends: usize,
    /// Number of steps in which a repair must take effect.
    steps_per_mend: usize,
    /// Largest move in a step, in edge lengths, below which the step counts as quiet.
    quiet_move: f64,
    /// Number of quiet steps in a row after which the cloth may be at rest.
    quiet_steps: usize,
    /// Relative change of the shape matching energy over the quiet steps up to which the cloth is at rest: slow creep at
    /// constant energy is ignored.
    energy_fall: f64,
    /// Energy up to which the cloth is at rest in any case: a strain of 0.01 %.
    least_energy: f64,
}

/// For the mesh that is asked for.
const FINE: Limits = Limits {
    light_steps: 80,
    steps: 400,
    mends: 12,
    steps_per_mend: 25,
    quiet_move: 0.01,
    quiet_steps: 5,
    energy_fall: 0.03,
    least_energy: 1e-8,
};
/// For a coarse mesh, which only has to be roughly in place: as long with gravity as without.
const DRAFT: Limits = Limits { steps: 2 * FINE.light_steps, mends: 2, ..FINE };

/// State of settling.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settling {
    /// Number of steps done.
    pub done: usize,
    /// Whether layers intersected at the last search, or none was made yet.
    pub crossed: bool,
    limits: Limits,
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
    /// Number of faults when it was last looked at, see [`Settling::is_to_be_looked_at`].
    pub faults: Option<usize>,
}

impl Settling {
    /// Settling of cloth that has just grown. `draft`: a finer mesh continues from the result.
    pub fn new(draft: bool) -> Self {
        let limits = if draft { DRAFT } else { FINE };
        let until = limits.steps;
        let (energy, creeps, faults) = (0.0, false, None);
        Self { done: 0, crossed: true, limits, quiet: 0, mends: 0, until, energy, creeps, faults }
    }

    /// Settling of cloth that is roughly in place, with gravity from the beginning.
    pub fn with_gravity(draft: bool) -> Self {
        let settling = Self::new(draft);
        Self { done: settling.limits.light_steps, ..settling }
    }

    /// Progress, 0..=1, by what it takes most often: as long with gravity as without.
    pub fn progress(&self) -> f64 {
        (self.done as f64 / (2 * self.limits.light_steps) as f64).min(1.0)
    }

    /// Whether settling is in its first part, without gravity.
    pub fn is_first(&self) -> bool {
        self.done < self.limits.light_steps
    }

    /// Whether faults are to be counted after this step, to tell whether they get fewer: as long after gravity began, which makes some
    /// that go again, as a repair takes, and then whenever as many steps are done as the first part has.
    pub fn is_to_be_looked_at(&self) -> bool {
        let calm = self.limits.light_steps + self.limits.steps_per_mend;
        self.done >= calm && (self.done - calm).is_multiple_of(self.limits.light_steps)
    }

    /// Records a step in which the largest move was `moved` edge lengths. Returns whether the cloth is at rest now.
    /// `energy` is [`Relaxer::energy`](crate::relax::Relaxer::energy).
    pub fn is_still(&mut self, moved: f64, energy: impl Fn() -> f64) -> bool {
        let Limits { quiet_move, quiet_steps, energy_fall, least_energy, .. } = self.limits;
        self.quiet = if moved < quiet_move { self.quiet + 1 } else { 0 };
        if self.quiet == 1 {
            self.energy = energy();
        }
        // Where the energy still changed the first time it is compared again after longer.
        let enough = if self.creeps { 3 * quiet_steps } else { quiet_steps };
        if self.quiet >= enough && !self.is_first() {
            let energy = energy();
            let changes = (self.energy - energy).abs() > energy_fall * energy && energy > least_energy;
            if !changes {
                return true;
            }
            (self.creeps, self.quiet) = (true, 0);
        }
        self.done >= self.until
    }

    /// Whether resting cloth may be repaired once more.
    pub fn may_mend(&self) -> bool {
        self.mends < self.limits.mends
    }

    /// The state after a step.
    pub fn stepped(self) -> Self {
        Self { done: self.done + 1, ..self }
    }

    /// The state after a step that ended with a repair, which gets time to take effect.
    pub fn mended(self) -> Self {
        let (mends, until) = (self.mends + 1, self.done + self.limits.steps_per_mend);
        Self { mends, until, quiet: 0, crossed: true, creeps: false, ..self.stepped() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_counted_a_while_after_gravity_began_and_then_now_and_then() {
        let counted = |mut settling: Settling| {
            let mut steps = Vec::new();
            while settling.done < 300 {
                steps.extend(settling.is_to_be_looked_at().then_some(settling.done));
                settling = settling.stepped();
            }
            steps
        };
        assert_eq!(counted(Settling::new(false)), [105, 185, 265]);
        assert_eq!(counted(Settling::new(true)), [105, 185, 265]);
    }
}
