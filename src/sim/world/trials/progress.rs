//! Progress over all starts that are tried. It never falls: nobody knows beforehand how many of them it takes, so each part of the work
//! takes a share of what is left.

use std::sync::Arc;

use crate::sim::world::World;
use crate::sim::world::trials::{Refinement, Trials};

/// A kind of work on a start; the progress of each begins at 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Work {
    Wrapping,
    Sewing,
    Draping,
    Posing,
}

/// A part of the work: the number of the start, what is done, and the stage of settling in the garment's own mesh.
type Part = (usize, Work, Option<Refinement>);

/// Progress of the trials.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Overall {
    /// The part being worked on.
    part: Option<Part>,
    /// Progress when that part began, 0..=1.
    begun_at: f64,
    /// Progress now, 0..=1.
    now: f64,
}

impl Overall {
    /// Progress, 0..=1.
    pub fn now(&self) -> f64 {
        self.now
    }

    /// Notes that `done` (0..=1) of `part` is done, which takes the share `share` of what was left when it began.
    fn note(&mut self, part: Part, done: f64, share: f64) {
        if self.part != Some(part) {
            (self.part, self.begun_at) = (Some(part), self.now);
        }
        let reached = self.begun_at + (1.0 - self.begun_at) * share * done.clamp(0.0, 1.0);
        // The residual of draping rises and falls.
        self.now = self.now.max(reached);
    }
}

impl Trials {
    /// Share of what is left that the present work takes, by what may follow it.
    fn share(&self, work: Work) -> f64 {
        match (work, &self.refining, self.fine) {
            (Work::Wrapping | Work::Sewing | Work::Posing, ..) => 0.4,
            (Work::Draping, None, Some(_)) => 0.4, // The garment's own mesh is still to come.
            (Work::Draping, None, None) if !self.left.is_empty() => 0.7,
            (Work::Draping, ..) => 0.9,
        }
    }
}

impl World {
    /// Notes in the trials, if starts are tried, how far the work has come.
    pub(super) fn note_progress(&mut self) {
        if self.trials.is_none() || self.lies_still() {
            return;
        }
        let (work, done) = if let Some(posing) = &self.posing {
            (Work::Posing, posing.progress())
        } else if let Some(placed) = &self.sewing {
            (Work::Sewing, placed.progress())
        } else if self.drapes_now() {
            let drape = self.drape_state().filter(|drape| !drape.waits);
            (Work::Draping, drape.map_or(0.0, |drape| drape.progress()))
        } else {
            (Work::Wrapping, self.dressing.as_ref().map_or(0.0, |dressing| dressing.progress()))
        };
        let Some(trials) = &mut self.trials else { return };
        let trials = Arc::make_mut(trials);
        let refinement = trials.refining.as_ref().map(|_| trials.refinement);
        let share = trials.share(work);
        trials.overall.note((trials.begun, work, refinement), done, share);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_never_falls_and_ends_before_the_end() {
        let mut overall = Overall::default();
        let mut last = 0.0;
        for (start, work, done) in [
            (1, Work::Wrapping, 0.5),
            (1, Work::Wrapping, 1.0),
            (1, Work::Draping, 0.0),
            (1, Work::Draping, 0.6),
            (1, Work::Draping, 0.2),
            (2, Work::Sewing, 0.0),
            (2, Work::Sewing, 2.0),
            (2, Work::Draping, 1.0),
        ] {
            overall.note((start, work, None), done, 0.5);
            assert!((last..1.0).contains(&overall.now()), "{overall:?} after {last}");
            last = overall.now();
        }
        assert!(last > 0.9, "{last}");
    }
}
