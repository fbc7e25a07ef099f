//! When draped cloth rests, and how time slows down until it does.

use glam::DVec3;

use crate::cloth::{ClothState, GRAVITY};
use crate::drape::garment::{DrapedGarment, Progress, TICK};
use crate::drape::state::State;

/// How draped cloth comes to rest.
struct ComingToRest {
    /// Cloth rests only if no vertex moves farther than this in a tick, metres.
    way: f64,
    /// Cloth rests only if the unbalanced force is at most this share of its weight.
    residual: f64,
    /// Consecutive ticks in which both must hold before the cloth counts as resting.
    quiet_ticks: u32,
    /// Ticks after which it is left as it is in any case.
    most_ticks: u64,
    /// Time is slowed down once the unbalanced force is below this share of the weight: the cloth has come down. One pass in a small
    /// step leaves edges only as stiff as mass over the step squared, far softer than woven cloth, so cloth that hangs from a tight
    /// place is overstretched; shorter steps take that strain away.
    down: f64,
    /// Ticks after which time is slowed down in any case, since cloth caught somewhere may tremble for ever; and after which cloth
    /// that has fallen off the body is left as it is.
    down_by: u64,
    /// Factor by which time slows down in each tick.
    slowing: f64,
    /// Slowest time scale. The extra strain left by the solver shrinks with its square, here to a sixteenth.
    slowest: f64,
}

/// Chosen by trial, but for the slowest time scale; `most_ticks` bounds how long what never rests is draped.
const COMING_TO_REST: ComingToRest = ComingToRest {
    way: 5e-5,
    residual: 0.01,
    quiet_ticks: 12,
    most_ticks: 1200,
    down: 0.1,
    down_by: 300,
    slowing: 0.9,
    slowest: 0.25,
};

impl DrapedGarment {
    /// Whether the cloth has been still for long enough to rest.
    pub(super) fn is_quiet(&self) -> bool {
        self.quiet >= COMING_TO_REST.quiet_ticks
    }

    /// Goes on with cloth that rested in another simulation, as [`Self::resume`] does.
    pub fn rested(mut self, cloth: &ClothState) -> Self {
        self.lift_as_it_lies(cloth);
        self.resume();
        self
    }

    /// Goes on with cloth that rested. Time begins as slowly as it ended: with the longer steps of unslowed time cloth at rest would
    /// sink under its own weight, and slip. Where it is seen soon that it does not rest any more, time is not slowed.
    pub fn resume(&mut self) {
        self.stir();
        (self.pace, self.resumes) = (COMING_TO_REST.slowest, true);
    }

    /// Makes cloth move again that is held otherwise now: as if it rested, once time is slowed down, since it has come down then.
    pub(super) fn hold_otherwise(&mut self) {
        if self.pace < 1.0 { self.resume() } else { self.wake() }
    }

    /// Makes cloth move again that is in the hand. Once it has come down, time goes on half way between the slowest scale, at which
    /// it would lag behind the hand, and unslowed time, but in steps as short as at the slowest: in longer ones it would sink.
    pub(super) fn follow_hand(&mut self) {
        if self.pace < 1.0 {
            self.resume();
            self.pace = COMING_TO_REST.slowest.sqrt();
        } else {
            self.wake();
        }
    }

    /// The number of small steps of a tick that has `steps` of them while it is in no hand, see [`Self::follow_hand`].
    pub(super) fn finer(&self, steps: usize) -> usize {
        let longer = if self.small.hand.is_some() && self.pace < 1.0 {
            self.pace / COMING_TO_REST.slowest
        } else {
            1.0
        };
        (steps as f64 * longer).ceil() as usize
    }

    /// Decides at the end of a tick whether the cloth rests.
    pub(super) fn conclude(&mut self) {
        let quiet_ticks = u64::from(COMING_TO_REST.quiet_ticks);
        if self.resumes && self.small.hand.is_none() && self.progress.ticks == quiet_ticks {
            let span = TICK * self.pace;
            let freely = GRAVITY.length() * span * span * quiet_ticks as f64;
            if falls(&self.ways, &self.fixed.mass, freely) {
                self.wake();
            }
        }
        let (ticks, quiet, moves) = (self.progress.ticks, self.is_quiet(), self.quiet == 0);
        let sound = self.lacking == 0 && (self.crossings == 0 || self.is_tangled());
        if quiet && !sound {
            self.quiet = 0;
        }
        if self.small.hand.is_none() {
            let slowed = self.slow_down();
            let ComingToRest { down_by, most_ticks, .. } = COMING_TO_REST;
            let is_left = ticks >= most_ticks || (ticks > down_by && self.has_fallen_off());
            self.progress.at_rest = (quiet && sound && !slowed) || is_left;
            self.progress.restless = is_left && moves;
        }
    }

    /// Whether all of the cloth falls below the body, where nothing will hold it any more.
    fn has_fallen_off(&self) -> bool {
        let lowest = self.collider.surface.bounds().0.y;
        let is_held = self.floats || self.pinned.contains(&true);
        !is_held && self.state.positions.iter().all(|x| x.y < lowest)
    }

    /// Lowers the time scale if it is time to. False where it did not change.
    fn slow_down(&mut self) -> bool {
        let ComingToRest { down, down_by, slowing, slowest, .. } = COMING_TO_REST;
        let Progress { residual, ticks, .. } = self.progress;
        let begins = self.pace < 1.0 || residual < down || ticks > down_by;
        if self.floats || self.pace == slowest || !begins {
            return false;
        }
        let slower = (self.pace * slowing).max(slowest);
        self.ways.iter_mut().for_each(|way| *way *= slower / self.pace);
        self.pace = slower;
        self.quiet = 0;
        true
    }

    /// Updates residual and speed from the last `span` seconds.
    pub(super) fn measure(&mut self, before: &State, span: f64) {
        let mass = &self.fixed.mass;
        let (mut unbalanced, mut fastest) = (0.0, 0.0f64);
        for (v, way) in self.ways.iter_mut().enumerate() {
            let now = self.state.positions[v] - before.positions[v];
            unbalanced += mass[v] * (now - *way).length() / (span * span);
            fastest = fastest.max(now.length() / span);
            *way = now;
        }
        self.age += TICK;
        let weight = mass.iter().sum::<f64>() * GRAVITY.length();
        let (residual, speed) = (unbalanced / weight, fastest);
        self.progress =
            Progress { ticks: self.progress.ticks + 1, residual, speed, at_rest: false, restless: false };
        let still = speed * span < COMING_TO_REST.way && residual < COMING_TO_REST.residual;
        self.quiet = if still { self.quiet + 1 } else { 0 };
    }
}

/// Whether cloth whose vertices, of `mass` kg, went these `ways` in a tick moves as a whole like what falls, by order of magnitude: what
/// falls freely goes as far as `freely`, metres. What only trembles or stretches does not.
fn falls(ways: &[DVec3], mass: &[f64], freely: f64) -> bool {
    let way: DVec3 = ways.iter().zip(mass).map(|(way, m)| *way * *m).sum();
    // Half way between what has come down and what falls freely, on a logarithmic scale.
    way.length() / mass.iter().sum::<f64>() >= COMING_TO_REST.down.sqrt() * freely
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_trembles_is_told_from_what_falls() {
        let (mass, freely) = ([0.1; 10], 0.002);
        let ways =
            |way: fn(usize) -> f64| [0, 1, 2, 3, 4, 5, 6, 7, 8, 9].map(|v| DVec3::Y * (0.002 * way(v)));
        assert!(falls(&ways(|_| -1.0), &mass, freely), "all of it falls");
        assert!(falls(&ways(|v| -f64::from(v < 5)), &mass, freely), "half of it falls");
        assert!(
            !falls(&ways(|v| if v % 2 == 0 { 3.0 } else { -3.0 }), &mass, freely),
            "it trembles thrice as fast"
        );
        assert!(!falls(&ways(|v| -f64::from(v < 2)), &mass, freely), "a fifth of it falls");
    }
}
