//! A span of time made in small steps.

use glam::DVec3;

/// A time span divided into small steps, and how many of them are done.
#[derive(Clone, Debug)]
pub struct Advance {
    /// Size of a small step, s.
    pub(super) small: f64,
    /// Number of small steps.
    pub(super) count: usize,
    /// Small steps done.
    pub(super) done: usize,
    /// Velocity change by bending in each small step, m/s, for every vertex, while the bending force is held constant.
    pub(super) bent: Vec<DVec3>,
    /// Positions before the current small step.
    pub(super) before: Vec<DVec3>,
    /// How far the current small step is done.
    pub(super) at: At,
}

/// How far a small step is done. It is cut where features near each other are searched for: that takes by far the longest, and may be
/// needed four times in a step.
#[derive(Clone, Debug, Default)]
pub(super) enum At {
    /// At its beginning.
    #[default]
    Begin,
    /// What is near where the cloth is about to go has been searched for.
    Known,
    /// The cloth has moved towards the positions `wanted` (metres) as far as it may without another search; there were `searches` before.
    Truncated { wanted: Vec<DVec3>, searches: usize },
}

impl Advance {
    /// A span of `h` seconds in `count` small steps.
    pub fn new(h: f64, count: usize) -> Self {
        let (bent, before, at) = (Vec::new(), Vec::new(), At::Begin);
        Self { small: h / count as f64, count, done: 0, bent, before, at }
    }

    /// Whether all small steps are done.
    pub fn is_done(&self) -> bool {
        self.done == self.count
    }

    /// Size of a small step, s.
    pub fn small(&self) -> f64 {
        self.small
    }

    /// Takes at most `count` of the small steps that are left, which are made elsewhere. Returns how many.
    pub fn take(&mut self, count: usize) -> usize {
        let taken = count.min(self.count - self.done);
        self.done += taken;
        taken
    }
}
